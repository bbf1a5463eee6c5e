"""Collision checks of arm configurations."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from etot_cli.skills.motion.collision import Attached, CollisionChecker
from etot_cli.skills.motion.kinematics import Arm
from etot_cli.world.pose import Pose, rotation_from_axes
from tests.skills.helpers import BALL, BOX, UNIT, drawers
from tests.world.helpers import Stage, make_scene, set_up

DOWN = rotation_from_axes(np.array([0.0, 0.0, -1.0]), np.array([0.0, 1.0, 0.0]))


@pytest.fixture(scope="module")
def stage() -> Stage:
    return set_up(
        make_scene(
            box=BOX | {"at": [0.4, 0.2], "size": [0.05, 0.05, 0.10]},
            ball=BALL | {"at": [0.4, -0.2]},
            unit=UNIT | {"at": [0.5, 0.0], "yaw_deg": -90, "drawers": drawers()},
        )
    )


@pytest.fixture(scope="module")
def arm(stage: Stage) -> Arm:
    return Arm(stage.world.robot.spec)


@pytest.fixture
def checker(stage: Stage) -> CollisionChecker:
    checker = CollisionChecker(stage.world)
    checker.freeze(stage.data)
    checker.set_fingers(0.04)
    return checker


def above(arm: Arm, x: float, y: float, z: float) -> np.ndarray:
    found = arm.reach(Pose(np.array([x, y, z]), DOWN), arm.home)
    assert found.reached
    return found.joints


def test_free_space_is_free(checker: CollisionChecker, arm: Arm) -> None:
    assert checker.hits(arm.home) == []
    assert checker.hits(above(arm, 0.4, 0.2, 0.36)) == []


def test_hand_in_an_object_names_it(checker: CollisionChecker, arm: Arm) -> None:
    assert checker.hits(above(arm, 0.4, 0.2, 0.20)) == ["box"]
    assert checker.hits(above(arm, 0.4, 0.2, 0.20), allow=["box"]) == []
    assert checker.hits(above(arm, 0.4, 0.2, 0.20), allow=["ball"]) == ["box"]


def test_hand_in_the_desk(checker: CollisionChecker, arm: Arm) -> None:
    assert checker.hits(above(arm, 0.35, 0.35, 0.13)) == ["desk"]
    assert checker.hits(above(arm, 0.35, 0.35, 0.13), allow=["desk"]) == []


def test_clearance_is_a_distance(checker: CollisionChecker, arm: Arm, stage: Stage) -> None:
    """The fingertips 5 mm above the box: too near for 8 mm, free for 2 mm."""
    pad = stage.world.robot.pads[0]
    data = mujoco.MjData(stage.world.model)
    data.qpos[stage.world.robot.qpos] = arm.home
    mujoco.mj_kinematics(stage.world.model, data)
    tool = data.site_xpos[stage.world.robot.tool_site]
    axis = data.site_xmat[stage.world.robot.tool_site].reshape(3, 3)[:, 2]
    beyond = float((data.geom_xpos[pad] - tool) @ axis) + stage.world.model.geom_size[pad][2]
    joints = above(arm, 0.4, 0.2, 0.13 + 0.10 + beyond + 0.005)
    assert checker.hits(joints, clearance=0.008) == ["box"]
    assert checker.hits(joints, clearance=0.002) == []


def test_arm_that_folds_into_itself_is_found(checker: CollisionChecker, arm: Arm) -> None:
    assert checker.hits(arm.home, clearance=0.0) == []
    folded = np.array([-2.05, 0.38, 0.05, 1.36, 3.05, 0.47])
    assert checker.hits(folded) == ["robot"]


def test_drawer_is_where_it_was_moved_to(checker: CollisionChecker, arm: Arm) -> None:
    front = above(arm, 0.5, -0.18, 0.22)
    assert checker.hits(front) == []
    checker.set_joint("unit.top", 0.10)
    assert "unit.top" in checker.hits(front)
    checker.set_joint("unit.top", 0.0)
    assert checker.hits(front) == []


def test_carried_object_collides_too(checker: CollisionChecker, arm: Arm) -> None:
    carried = Attached("ball", Pose(np.zeros(3), np.eye(3)))
    high = above(arm, 0.4, 0.2, 0.36)
    assert checker.hits(high, carried) == []
    low = above(arm, 0.4, 0.2, 0.13 + 0.10 + 0.025)
    assert "box" not in checker.hits(low, allow=["ball"])
    assert checker.hits(low, carried) == ["box"]
    assert checker.hits(low, carried, allow_attached=["box"]) == []


def test_check_leaves_the_world_alone(checker: CollisionChecker, arm: Arm, stage: Stage) -> None:
    before = stage.data.qpos.copy()
    checker.hits(above(arm, 0.4, 0.2, 0.20), Attached("ball", Pose(np.zeros(3), np.eye(3))))
    np.testing.assert_array_equal(stage.data.qpos, before)


def test_agrees_with_physics(checker: CollisionChecker, arm: Arm, stage: Stage) -> None:
    """Where physics reports a contact of the robot, the checker with no clearance does too."""
    rng = np.random.default_rng(3)
    world = stage.world
    data = mujoco.MjData(world.model)
    struck = agreed = 0
    for _ in range(150):
        joints = np.clip(arm.home + rng.uniform(-1.2, 1.2, 6), arm.lower, arm.upper)
        data.qpos[:] = stage.data.qpos
        data.qpos[world.robot.qpos] = joints
        data.qpos[world.robot.finger_qpos] = 0.02
        mujoco.mj_forward(world.model, data)
        touched = set()
        for index, pair in enumerate(data.contact.geom):
            names = [world.geom_address[geom] for geom in pair]
            robot = [name in ("robot", "gripper") for name in names]
            if sum(robot) == 1 and data.contact.dist[index] < 0:
                touched.add(names[1 - robot.index(True)])
        found = set(checker.hits(joints, clearance=0.0)) - {"robot", "gripper"}
        struck += bool(touched)
        agreed += touched == found
    assert struck > 10
    assert agreed == 150


def test_the_extent_of_what_is_turned(checker: CollisionChecker) -> None:
    low, high = checker.extent("box", np.eye(3))
    assert high - low == pytest.approx([0.05, 0.05, 0.10], abs=1e-6)
    turned = np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]])
    low, high = checker.extent("box", turned)
    assert high - low == pytest.approx([0.10, 0.05, 0.05], abs=1e-6)

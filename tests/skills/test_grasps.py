"""Grasp candidates on an object's geometry."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import pytest

from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.skills.action import GraspPose, parse_plan
from etot_cli.skills.grasps.candidates import sample_grasps
from etot_cli.skills.grasps.ranking import FINGER_ROOM, WIDTH_MARGIN, Grasp, GraspSet
from etot_cli.skills.grasps.solids import Solids
from etot_cli.skills.motion.motion import Motion
from etot_cli.skills.motions import plan_motions
from tests.skills.helpers import BALL, BOX, CUP, PEN
from tests.world.helpers import Stage, make_scene, set_up


def sample(
    thing: dict[str, Any], pose: GraspPose | None = None, **more: Any
) -> tuple[Stage, GraspSet]:
    stage = set_up(make_scene(thing=thing | more))
    return stage, sample_grasps(stage.world, Solids(stage.world), stage.data, "thing", pose)


def pads_free(stage: Stage, grasp: Grasp) -> bool:
    """Whether the opened pads at the grasp keep out of the object."""
    world, data = stage.world, mujoco.MjData(stage.world.model)
    data.qpos[:] = stage.data.qpos
    mujoco.mj_kinematics(world.model, data)
    solids = Solids(world)
    y = grasp.tool.rotation[:, 1]
    for side in (1.0, -1.0):
        face = grasp.tool.position + side * y * (grasp.opening / 2 + 1e-4)
        (line,) = solids.intervals(data, "thing", face[None], (side * y)[None])
        if any(piece.start < 0.008 and piece.end > 0.0 for piece in line):
            return False
    return True


THINGS = {
    "ball": BALL,
    "box": BOX | {"yaw_deg": 25},
    "cup": CUP,
    "pen": PEN | {"yaw_deg": 50},
    "can": {"kind": "cylinder", "diameter": 0.06, "height": 0.1, "at": [0.4, 0.1]},
}


@pytest.mark.parametrize("name", THINGS)
def test_candidates_fit_the_gripper_and_the_object(name: str) -> None:
    stage, found = sample(THINGS[name])
    opening = stage.world.robot.spec.gripper.opening
    assert len(found.grasps) >= 3
    scores = [grasp.score for grasp in found.grasps]
    assert scores == sorted(scores)
    for grasp in found.grasps:
        assert grasp.width + WIDTH_MARGIN <= opening + 1e-9
        assert grasp.width < grasp.opening <= opening
        rotation = grasp.tool.rotation
        assert rotation.T @ rotation == pytest.approx(np.eye(3), abs=1e-9)
        expected = -1.0 if grasp.pose is GraspPose.VERTICAL else 0.0
        assert rotation[2, 2] == pytest.approx(expected, abs=1e-6)
        assert pads_free(stage, grasp)


@pytest.mark.parametrize("name", THINGS)
def test_material_lies_between_the_fingers(name: str) -> None:
    """Along the closing direction through the tool point there is solid of the stated width."""
    stage, found = sample(THINGS[name])
    solids = Solids(stage.world)
    checked = 0
    for grasp in found.grasps:
        y = grasp.tool.rotation[:, 1]
        (line,) = solids.intervals(stage.data, "thing", grasp.tool.position[None], y[None])
        inside = [p for p in line if p.start > -grasp.opening / 2 and p.end < grasp.opening / 2]
        if not inside:
            continue
        checked += 1
        span = inside[-1].end - inside[0].start
        assert span == pytest.approx(grasp.width, abs=0.012)
        assert inside[0].start + inside[-1].end == pytest.approx(0.0, abs=0.012)
    assert checked >= 0.8 * len(found.grasps)


def test_width_of_a_ball_and_a_box() -> None:
    _, found = sample(BALL)
    assert max(g.width for g in found.grasps) == pytest.approx(0.07, abs=0.001)
    _, found = sample(BOX, yaw_deg=25)
    assert found.grasps[0].width == pytest.approx(0.05, abs=0.004)


@pytest.mark.parametrize("diameter", [0.078, 0.083, 0.085, 0.090, 0.095])
def test_a_ball_is_no_wider_at_the_lower_edge_of_the_pads(diameter: float) -> None:
    """Wherever the tool point is, the pads reach deeper, and meet the ball where it is wider."""
    stage, found = sample(BALL, GraspPose.VERTICAL, diameter=diameter)
    robot, center = stage.world.robot, stage.data.body("thing").xpos
    assert found.grasps
    for grasp in found.grasps:
        shift = grasp.tool.position - center
        above = max(float(shift[2]) - robot.tip, 0.0)
        aside = float(shift @ grasp.tool.rotation[:, 0])
        across = 2 * float(np.sqrt(max((diameter / 2) ** 2 - above**2 - aside**2, 0.0)))
        # Round things are cut as polygons.
        assert across + WIDTH_MARGIN <= robot.spec.gripper.opening + 0.01 * diameter


def test_wide_cup_is_grasped_at_its_rim() -> None:
    stage, found = sample(CUP, GraspPose.VERTICAL)
    rim = stage.top + CUP["height"]
    center = stage.data.body("thing").xpos
    assert len(found.grasps) > 8
    for grasp in found.grasps[:8]:
        assert grasp.width < 0.02, "a wall, not the whole cup"
        assert grasp.opening >= grasp.width + 2 * FINGER_ROOM - 1e-9
        tip = grasp.tool.position
        assert rim - 0.06 < tip[2] < rim
        radius = float(np.hypot(*(tip[:2] - center[:2])))
        assert radius == pytest.approx(CUP["diameter"] / 2 - 0.002, abs=0.01)


def test_wide_cup_from_the_side_is_kept_for_physics_to_refuse() -> None:
    _, found = sample(CUP, GraspPose.HORIZONTAL)
    assert not found.grasps
    assert found.too_wide
    for grasp in found.too_wide:
        assert grasp.width == pytest.approx(CUP["diameter"], rel=0.05)


def test_far_too_wide_things_are_not_taken_across() -> None:
    stage, found = sample(BALL, diameter=0.16)
    opening = stage.world.robot.spec.gripper.opening
    assert all(grasp.width <= 1.5 * opening for grasp in (*found.grasps, *found.too_wide))
    for thing in (BOX | {"size": [0.16, 0.16, 0.05]}, BALL | {"diameter": 0.3}):
        stage, found = sample(thing)
        center = stage.data.body("thing").xpos
        for grasp in (*found.grasps, *found.too_wide):
            assert np.linalg.norm(grasp.tool.position - center) > 0.05


@pytest.mark.parametrize("pose", GraspPose)
def test_pose_is_respected(pose: GraspPose) -> None:
    _, found = sample(BALL, pose)
    assert found.grasps
    assert {grasp.pose for grasp in found.grasps} == {pose}


@pytest.mark.parametrize("yaw", [0.0, 35.0, 110.0])
def test_lying_pen_is_grasped_across_and_not_at_its_point(yaw: float) -> None:
    stage, found = sample(PEN, GraspPose.VERTICAL, yaw_deg=yaw)
    axis = stage.data.body("thing").xmat.reshape(3, 3)[:, 0]
    for grasp in found.grasps:
        assert abs(float(grasp.tool.rotation[:, 1] @ axis)) < 0.2
        assert grasp.width == pytest.approx(PEN["diameter"], abs=0.002)
        along = float((grasp.tool.position - stage.data.body("thing").xpos) @ axis)
        assert along <= 0.02, "the point stays free"


def test_fingertips_stay_above_what_the_object_stands_on() -> None:
    for thing in (BALL, BOX, PEN, CUP):
        stage, found = sample(thing, GraspPose.VERTICAL)
        for grasp in found.grasps:
            assert grasp.tool.position[2] - 0.0075 >= stage.top - 1e-3


@pytest.mark.parametrize("name", ["ball", "box", "cup", "pen"])
def test_mirrored_scene_gives_mirrored_grasps(name: str) -> None:
    """For every candidate its mirror image is among those of the mirrored scene."""
    thing = THINGS[name] | {"at": [0.38, 0.17]}
    mirrored = thing | {"at": [0.38, -0.17], "yaw_deg": -thing.get("yaw_deg", 0.0)}
    (_, one), (_, two) = sample(thing), sample(mirrored)
    assert len(one.grasps) == len(two.grasps)
    flip = np.array([1.0, -1.0, 1.0])
    others = np.array([grasp.tool.position for grasp in two.grasps])
    closings = np.array([grasp.tool.rotation[:, 1] for grasp in two.grasps])
    for grasp in one.grasps:
        distance = np.linalg.norm(others - grasp.tool.position * flip, axis=1)
        alike = np.abs(closings @ (grasp.tool.rotation[:, 1] * flip)) > 0.99
        assert distance[alike].min() < 0.003


@pytest.mark.parametrize("yaw", [0, 15, 30, 45])
def test_a_line_across_a_corner_is_no_grasp(yaw: float) -> None:
    """A box wider than the hand on every side, however it is turned."""
    _, found = sample({"kind": "box", "size": [0.12, 0.11, 0.11], "at": [0.4, 0.1], "yaw_deg": yaw})
    assert not found.grasps


@pytest.mark.parametrize("thing", [{"kind": "sphere", "diameter": 0.11}, {
    "kind": "cylinder", "diameter": 0.12, "height": 0.1,
}])  # fmt: skip
def test_a_chord_of_a_wide_round_thing_is_no_grasp(thing: dict[str, Any]) -> None:
    _, found = sample(thing | {"at": [0.4, 0.1]})
    assert all(grasp.width > 0.06 for grasp in found.grasps), "only near its widest line"


def test_a_ball_as_wide_as_the_gripper_is_held_as_low_as_it_fits() -> None:
    """The fingers slide off less, the nearer to the equator they close."""
    apple = BALL | {"diameter": 0.085, "mass": 0.15, "at": [0.4, 0.0]}
    world = SimulatedWorld(make_scene(apple=apple, box=BOX | {"at": [0.4, 0.3]}), 0)
    belief = world.believe(world.start()[0])
    for name, least, most in (("apple", 0.25, 0.45), ("box", 0.0, 0.01)):
        found = sample_grasps(belief.world, belief.solids, belief.data, name, GraspPose.VERTICAL)
        assert least <= found.grasps[0].friction <= most
    motion = next(plan_motions(belief, parse_plan("[PICK UP, apple]")[0]))
    assert isinstance(motion, Motion)
    weight = 0.15 * 9.81 / (2 * 30.0)
    assert motion.details["friction_needed"] == pytest.approx(motion.details["slant"] + weight)
    assert motion.details["friction_share"] == pytest.approx(motion.details["friction_needed"])

"""What rests is not stepped, and nobody can tell: it is woken by a touch and read as if awake."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

from etot_cli.control.physics_world import PhysicsWorld
from etot_cli.control.robot import Guards
from etot_cli.control.simulated_robot import SimulatedRobot
from etot_cli.errors import WorldError
from etot_cli.world.snapshot import restore, save
from tests.world.helpers import BALL, CUP, PEN, UNIT, make_scene

CRATE = {"kind": "box", "size": [0.04, 0.04, 0.12]}
SCENE = {
    "cup": CUP | {"at": [0.40, 0.20]},
    "pen": PEN | {"inside": "cup"},
    "low": CRATE | {"at": [0.40, -0.10]},
    "high": CRATE | {"on": "low"},
    "ball": BALL | {"at": [0.30, -0.30]},
    "unit": UNIT | {"at": [0.50, -0.35], "yaw_deg": 90},
}


@pytest.fixture
def asleep() -> PhysicsWorld:
    """A scene that has come to rest, as stepped on."""
    world = PhysicsWorld(make_scene(**SCENE))
    world.start()
    SimulatedRobot(world.world, world.data).wait(1.5, Guards())
    return world


def trees_asleep(world: PhysicsWorld) -> int:
    return int((np.asarray(world.data.tree_asleep) >= 0).sum())


def test_all_but_the_robot_goes_to_sleep(asleep: PhysicsWorld) -> None:
    assert trees_asleep(asleep) == asleep.world.model.ntree - 1


def test_a_stored_state_of_sleepers_reads_as_if_awake(asleep: PhysicsWorld) -> None:
    before, _ = asleep.start()
    SimulatedRobot(asleep.world, asleep.data).wait(0.3, Guards())
    now = save(asleep.world, asleep.data, before.memory)
    scene = asleep.look(now)
    assert trees_asleep(asleep) == 0
    assert scene.states["high"].on == ("low",)
    assert scene.states["low"].on == scene.states["ball"].on == ("desk",)
    assert scene.states["pen"].inside == "cup"


def test_what_was_asleep_before_has_no_say(asleep: PhysicsWorld) -> None:
    start = save(asleep.world, asleep.data, asleep.start()[0].memory)
    ends = []
    for nap_s in (0.0, 0.3):
        SimulatedRobot(asleep.world, asleep.data).wait(nap_s, Guards())
        restore(asleep.world, asleep.data, start)
        SimulatedRobot(asleep.world, asleep.data).wait(0.1, Guards())
        ends.append(save(asleep.world, asleep.data, start.memory))
    assert ends[0] == ends[1]


def test_a_touch_wakes(asleep: PhysicsWorld) -> None:
    data, before = asleep.data, asleep.data.body("low").xpos.copy()
    data.joint("ball").qvel[:3] = [0.5, 1.0, 0.0]  # at the lower crate
    SimulatedRobot(asleep.world, data).wait(0.8, Guards())
    assert np.linalg.norm(data.body("low").xpos - before) > 1e-3


@pytest.mark.parametrize("beyond_deg, falls", [(-0.5, False), (0.5, True)])
def test_what_begins_to_topple_is_not_caught_by_sleep(beyond_deg: float, falls: bool) -> None:
    """Half a degree short of its balance a crate falls back, half a degree beyond it falls over."""
    world = PhysicsWorld(make_scene(crate=CRATE | {"at": [0.40, 0.0]}))
    world.start()
    width, height = CRATE["size"][0], CRATE["size"][2]  # type: ignore[index]
    tilt = math.atan2(width, height) + math.radians(beyond_deg)
    joint = world.data.joint("crate")
    half = math.hypot(width, height) / 2
    joint.qpos[2] = world.world.scene.desk.top + half * math.cos(math.radians(beyond_deg))
    joint.qpos[3:] = [math.cos(tilt / 2), 0.0, math.sin(tilt / 2), 0.0]
    joint.qvel[:] = 0.0
    mujoco.mj_forward(world.world.model, world.data)
    SimulatedRobot(world.world, world.data).wait(2.0, Guards())
    upright = world.data.body("crate").xmat[8]
    assert (abs(upright) < 0.1) if falls else (upright > 0.99)


def test_a_simulation_that_diverged_is_told(asleep: PhysicsWorld) -> None:
    asleep.data.qvel[asleep.world.model.joint("ball").dofadr[0]] = math.nan
    with pytest.raises(WorldError, match="diverged"):
        SimulatedRobot(asleep.world, asleep.data).wait(0.3, Guards())

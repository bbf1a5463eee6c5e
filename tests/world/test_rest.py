"""At the start nothing merely balances."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import pytest

from etot_cli.control.physics_world import PhysicsWorld
from etot_cli.world.rest import let_fall
from etot_cli.world.snapshot import STATE, restore
from tests.world.helpers import BALL, BOX, CUP, make_scene, set_up

AT = {"at": [0.4, 0.1]}
TIP_DOWN = {"quaternion": [0.70711, 0.0, 0.70711, 0.0]}


@pytest.mark.parametrize(("diameter", "length"), [(0.008, 0.14), (0.014, 0.15), (0.018, 0.195)])
@pytest.mark.parametrize("kind", ["pen", "capsule"])
@pytest.mark.parametrize("given", [{}, TIP_DOWN], ids=["as put in", "tip down"])
def test_a_rod_in_a_cup_leans_on_its_rim_from_the_start(
    kind: str, diameter: float, length: float, given: dict[str, Any]
) -> None:
    rod = {"kind": kind, "diameter": diameter, "length": length, "mass": 0.02, "inside": "cup"}
    cup = CUP | AT | {"mass": 0.3}
    world = PhysicsWorld(make_scene(cup=cup, rod=rod | given))
    start, scene = world.start()
    restore(world.world, world.data, start)
    body = world.data.body("rod")
    pose = np.array([*body.xpos, *body.xquat])
    assert abs(body.xmat.reshape(3, 3)[2, 0]) < np.cos(np.radians(10)), "it still balances"
    assert scene.states["rod"].inside == "cup"
    mujoco.mj_step(world.world.model, world.data, 1000)
    assert np.array([*body.xpos, *body.xquat]) == pytest.approx(pose, abs=0.003)


def test_rods_that_stand_side_by_side_in_a_vessel_all_lean() -> None:
    rod = {"kind": "pen", "diameter": 0.012, "length": 0.15, "mass": 0.02, "inside": "cup"}
    places = {"one": [0.4, 0.08], "two": [0.4, 0.12], "three": [0.38, 0.1]}
    cup = CUP | AT | {"mass": 0.4}
    rods = {name: rod | {"at": place} for name, place in places.items()}
    _, scene = PhysicsWorld(make_scene(cup=cup, **rods)).start()
    assert all(scene.states[name].inside == "cup" for name in rods)
    assert not scene.states["cup"].toppled


def test_what_stands_stays_as_it_is_to_the_last_bit() -> None:
    objects: dict[str, dict[str, Any]] = {
        "thin": BOX | {"at": [0.3, -0.2], "size": [0.1, 0.008, 0.12]},
        "rod": {"kind": "cylinder", "diameter": 0.014, "height": 0.15, "at": [0.3, 0.3]},
        "low": BOX | {"at": [0.5, 0.2]},
        "high": BOX | {"on": "low", "size": [0.03, 0.03, 0.06]},
        "ball": BALL | {"on": "high"},
        "cup": CUP | AT,
        "big": BALL | {"diameter": 0.1, "on": "cup"},
        "lying": {"kind": "pen", "diameter": 0.014, "length": 0.15, "at": [0.4, -0.3]},
        "end_up": {"kind": "pen", "diameter": 0.02, "length": 0.13, "at": [0.5, -0.2],
                   "quaternion": [0.70711, 0.0, -0.70711, 0.0]},
    }  # fmt: skip
    stage = set_up(make_scene(**objects), settle=1.0)
    before, after = (np.empty(mujoco.mj_stateSize(stage.world.model, STATE)) for _ in range(2))
    mujoco.mj_getState(stage.world.model, stage.data, before, STATE)
    assert not let_fall(stage.world, stage.data)
    mujoco.mj_getState(stage.world.model, stage.data, after, STATE)
    assert np.array_equal(before, after)

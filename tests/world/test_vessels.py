"""Cups and bowls are hollow: walls, floor and mouth as stated."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import pytest

from tests.world.helpers import BALL, CUP, make_scene, set_up

VESSELS: dict[str, dict[str, Any]] = {
    "cup": CUP,
    "thick": CUP | {"wall": 0.008, "floor": 0.01},
    "cone": CUP | {"foot_diameter": 0.05},
    "narrow": CUP | {"diameter": 0.05, "height": 0.11, "wall": 0.002},
    "bowl": {"kind": "bowl", "diameter": 0.16, "height": 0.05, "foot_diameter": 0.09, "mass": 0.2},
}


@pytest.mark.parametrize("name", VESSELS)
@pytest.mark.parametrize("offset", [0.0, 0.6])
@pytest.mark.parametrize("yaw", [0.0, 7.5])
def test_a_small_ball_falls_to_the_floor(name: str, offset: float, yaw: float) -> None:
    vessel = VESSELS[name]
    ball = BALL | {"diameter": 0.02, "mass": 0.004, "at": [0.4, -0.3]}
    stage = set_up(make_scene(vessel=vessel | {"at": [0.4, 0.1], "yaw_deg": yaw}, ball=ball))
    inner = min(vessel["diameter"], vessel.get("foot_diameter") or 1.0) / 2 - vessel.get(
        "wall", 0.003
    )
    stage.move("ball", [0.4, 0.1 + offset * (inner - 0.01), stage.top + vessel["height"] + 0.03])
    stage.step(1.5)
    ball_state = stage.see("ball")
    floor = stage.top + vessel.get("floor", 0.004)
    assert ball_state.inside == "vessel"
    assert ball_state.position[2] == pytest.approx(floor + 0.01, abs=0.003)
    assert not stage.see("vessel").toppled


@pytest.mark.parametrize("name", VESSELS)
def test_walls_are_as_thick_as_stated(name: str) -> None:
    vessel = VESSELS[name]
    stage = set_up(make_scene(vessel=vessel | {"at": [0.4, 0.1]}), settle=0.0)
    wall, height = vessel.get("wall", 0.003), vessel["height"]
    foot = vessel.get("foot_diameter") or vessel["diameter"]
    level = 0.8
    outer = foot / 2 + level * (vessel["diameter"] - foot) / 2
    base = stage.data.body("vessel").xpos - [0, 0, height / 2]
    group = np.array([0, 1, 0, 1, 0, 0], dtype=np.uint8)  # the walls that collide
    hit = np.zeros(1, dtype=np.int32)
    for angle in np.radians([0, 50, 133, 217, 301]):
        out = np.array([np.cos(angle), np.sin(angle), 0.0])
        center = base + np.array([0.0, 0.0, level * height])
        inward = mujoco.mj_ray(
            stage.world.model, stage.data, center + 0.3 * out, -out, group, 1, -1, hit
        )
        outward = mujoco.mj_ray(stage.world.model, stage.data, center, out, group, 1, -1, hit)
        assert 0.3 - inward == pytest.approx(outer, rel=0.015)
        assert outward == pytest.approx(outer - wall, rel=0.02)


@pytest.mark.parametrize("share", [0.85, 1.15])
def test_what_is_wider_than_the_mouth_stays_out(share: float) -> None:
    mouth = CUP["diameter"] - 2 * 0.003
    ball = BALL | {"diameter": share * mouth, "at": [0.4, -0.3]}
    stage = set_up(make_scene(cup=CUP | {"at": [0.4, 0.1]}, ball=ball))
    stage.move("ball", [0.4, 0.1, stage.top + CUP["height"] + share * mouth / 2 + 0.005])
    stage.step(1.0)
    assert (stage.see("ball").inside == "cup") is (share < 1)


def test_only_the_foot_disc_touches_the_desk() -> None:
    """Staves on the desk would cost several times the stepping time."""
    stage = set_up(make_scene(cup=CUP | {"at": [0.4, 0.1]}))
    touching = {
        int(stage.world.model.geom_type[geom])
        for pair in stage.data.contact.geom
        for geom in pair
        if {stage.world.geom_object[g] for g in pair} == {"cup", "desk"}
        and stage.world.geom_object[geom] == "cup"
    }
    assert touching == {int(mujoco.mjtGeom.mjGEOM_CYLINDER)}


def test_narrow_foot_tips_sooner() -> None:
    """The same push at the rim topples the cup with the narrow foot alone."""
    toppled = {}
    for name, foot in (("wide", None), ("narrow", 0.035)):
        stage = set_up(make_scene(cup=CUP | {"at": [0.4, 0.0], "foot_diameter": foot}))
        # A push of 0.55 of its weight, at the height of the rim.
        force = 0.55 * CUP["mass"] * 9.81
        stage.data.body("cup").xfrc_applied[0] = force
        stage.data.body("cup").xfrc_applied[4] = force * CUP["height"] / 2
        stage.step(0.35)
        stage.data.xfrc_applied[:] = 0.0
        stage.step(1.0)
        toppled[name] = stage.see("cup").toppled
    assert toppled == {"wide": False, "narrow": True}

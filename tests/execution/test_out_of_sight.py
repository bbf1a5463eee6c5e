"""Where things are that a picture hardly shows: in the hand, in a vessel, or let go by the hand."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from etot_cli.control.robot import RobotState
from etot_cli.execution.perception.following import Following
from etot_cli.execution.perception.hand import HandContents
from etot_cli.execution.perception.scan import Scan
from etot_cli.execution.perception.twin import KnownScene
from etot_cli.execution.perception.unseen import out_of_sight, with_its_container
from etot_cli.reconstruction.capture.view import View
from etot_cli.specs.scene import Scene
from etot_cli.world.pose import UP, Pose

MUG = {"kind": "cup", "at": [0.36, -0.12], "diameter": 0.075, "height": 0.085, "wall": 0.004}
BALL = {"kind": "sphere", "diameter": 0.042, "mass": 0.046}
CHEST = {
    "kind": "drawer_unit",
    "at": [0.48, 0.1],
    "yaw_deg": 180,
    "size": [0.22, 0.2, 0.16],
    "drawers": [{"name": "top", "travel": 0.12}],
}
TURNED = np.diag([1.0, -1.0, -1.0])
"""Of a hand that points down."""


def known_of(**objects: dict[str, Any]) -> KnownScene:
    return KnownScene(Scene.model_validate({"objects": objects}))


def at(*position: float, rotation: np.ndarray | None = None) -> Pose:
    return Pose(np.array(position), np.eye(3) if rotation is None else rotation)


def scan_with(points: np.ndarray) -> Scan:
    """A picture whose depth says nothing, with readings."""
    view = View(160, 120, 200.0, 200.0, 79.5, 59.5, np.eye(4))
    picture = np.zeros((120, 160, 3), np.uint8)
    return Scan(view, np.zeros((120, 160)), picture, points, np.zeros_like(points), 0.0)


def hand_of(known: KnownScene, opening: float) -> RobotState:
    joints = np.array(known.data.qpos[known.world.robot.qpos])
    return RobotState(joints, joints, opening, 0.0, sent=0.0, handled=tuple(joints))


@pytest.mark.parametrize("off", [-0.011, 0.0, 0.011])
def test_a_thin_thing_in_the_hand_is_between_the_pads(off: float):
    fork = {"kind": "capsule", "at": [0.22, -0.1], "diameter": 0.012, "length": 0.15}
    known = known_of(fork=fork)
    state, hand, tool = hand_of(known, 0.011), HandContents(known), known.tool()
    surface = known.surfaces["fork"]
    assert surface.long_axis is not None
    # Across the way that the fingers close, as it was picked up.
    away = off * tool.rotation[:, 1]
    along = np.column_stack([surface.long_axis, np.roll(surface.long_axis, 1),
                             np.roll(surface.long_axis, 2)])  # fmt: skip
    rotation = tool.rotation @ along.T
    seen = Pose(tool.position - rotation @ surface.middle + away, rotation)
    assert hand.grips("fork", seen, state)
    held = hand.between_pads("fork", seen, state)
    middle = held.place(surface.middle[None])[0] - tool.position
    assert abs(middle @ tool.rotation[:, 1]) < 0.001
    hand.remember({"fork": held}, state)
    assert hand.let_go(state) == {}
    opened = replace(state, opening=0.04, sent=0.04)
    assert hand.let_go(opened)["fork"].position == pytest.approx(held.position)


def test_what_is_in_a_vessel_goes_where_that_is_carried():
    known = known_of(mug=MUG, ball={**BALL, "inside": "mug"}, die={**BALL, "at": [0.36, -0.2]})
    mug, carried = known.nominal("mug"), Pose(np.array([0.02, 0.0, 0.1]), np.eye(3))
    known.put("mug", carried @ mug)
    moved = {known.world.entries["mug"].body: carried}
    for name, way in (("ball", carried.position), ("die", np.zeros(3)), ("mug", np.zeros(3))):
        then = known.nominal(name)
        assert with_its_container(known, name, then, moved).position == pytest.approx(
            then.position + way
        ), name


def test_what_lies_nearer_to_a_mug_is_no_ball_in_it():
    known = known_of(mug=MUG, ball={**BALL, "inside": "mug"})
    mug, ball = known.nominal("mug"), known.nominal("ball")
    wall = mug.place(known.surfaces["mug"].points)
    through = Pose(ball.position + np.array([0.02, 0.0, 0.0]), ball.rotation)
    ahead = known.surfaces["ball"].has(through, wall, 0.008)
    following = Following(known)
    both = {"mug": mug, "ball": through}
    assert following._is_another(scan_with(wall), "ball", both, ahead)
    own = through.place(known.surfaces["ball"].points)
    assert not following._is_another(scan_with(own), "ball", both, np.ones(len(own), dtype=bool))


@pytest.mark.parametrize("is_open", [False, True])
def test_what_was_let_go_above_a_chest_is_in_its_drawer_only_when_that_is_open(is_open: bool):
    known = known_of(chest=CHEST, die={"kind": "box", "at": [0.4, -0.3], "size": [0.03] * 3})
    chest = known.nominal("chest").position
    drawer = known.set_part("chest.top", 0.11 if is_open else 0.0)
    region = known.regions[0]
    room = drawer.place(np.array([region.center]))[0]
    top = known.scene.desk.top + 0.16
    # Over the middle of the drawer, in front of the chest when that is open.
    tool = at(room[0] - (0.03 if is_open else 0.0), chest[1], top + 0.017, rotation=TURNED)
    hidden = out_of_sight(
        known, "die", known.nominal("die"), at(0.0, 0.0, 0.0), tool, scan_with(np.zeros((0, 3)))
    )
    assert hidden is not None
    lowest = hidden.place(known.surfaces["die"].points)[:, 2].min()
    assert lowest == pytest.approx(room[2] - region.half[2] if is_open else top, abs=0.003)


def test_a_ray_passes_through_the_robot():
    known = known_of(mug=MUG)
    tool = known.tool().position
    owner, far = known.ahead(tool + 0.2 * UP, -UP, "world")
    assert owner not in ("robot", "gripper")
    assert far > 0.2

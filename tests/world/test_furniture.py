"""Drawer units, cabinets and shelves: clearances, travel and hinges."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from tests.world.helpers import CABINET, SHELF, UNIT, Stage, make_scene, set_up


def ray(stage: Stage, origin: np.ndarray, direction: np.ndarray, skip: int = -1) -> float:
    """Distance to the next geom [m], infinite when there is none."""
    hit = np.zeros(1, dtype=np.int32)
    distance = mujoco.mj_ray(
        stage.world.model, stage.data, origin, np.array(direction, dtype=float), None, 1, skip, hit
    )
    return float("inf") if distance < 0 else float(distance)


def inner_room(stage: Stage, address: str) -> np.ndarray:
    """Free extents (3,) around a container's middle along its own axes, by ray casting [m]."""
    region = stage.world.regions[address]
    body = stage.data.body(region.body)
    rotation = body.xmat.reshape(3, 3)
    center = body.xpos + rotation @ np.array(region.center)
    return np.array(
        [ray(stage, center, rotation[:, i]) + ray(stage, center, -rotation[:, i]) for i in range(3)]
    )


@pytest.mark.parametrize("height", [None, 0.05, 0.08])
@pytest.mark.parametrize("wall", [0.006, 0.01])
def test_clearance_of_a_drawer(height: float | None, wall: float) -> None:
    """What a thing in the drawer has above the drawer's floor, measured by rays."""
    drawers = [{"name": "top", "height": height}, {"name": "bottom", "travel": 0.0}]
    stage = set_up(make_scene(unit=UNIT | {"at": [0.45, 0.0], "drawers": drawers, "wall": wall,
                                           "yaw_deg": 40}))  # fmt: skip
    spec = stage.world.scene.objects["unit"]
    level = spec.compartment_heights()[0]  # type: ignore[union-attr]
    room = inner_room(stage, "unit")
    region = stage.world.regions["unit"]
    assert room == pytest.approx(2 * np.array(region.half), abs=0.002)
    # Drawer floor and play take some 5.5 mm of the compartment.
    assert level - 0.007 < room[2] < level - 0.003


def test_drawers_are_stacked_from_top_to_bottom() -> None:
    drawers = [{"name": name} for name in ("first", "second", "third")]
    stage = set_up(make_scene(unit=UNIT | {"at": [0.45, 0.0], "drawers": drawers,
                                           "size": [0.24, 0.18, 0.24]}))  # fmt: skip
    heights = [stage.world.regions[f"unit.{d['name']}"].center[2] for d in drawers]
    assert heights == sorted(heights, reverse=True)
    gaps = -np.diff(heights)
    assert gaps == pytest.approx(np.full(2, gaps[0]))


@pytest.mark.parametrize("yaw", [0, 61, -90, 180])
def test_drawer_slides_along_its_front_without_rubbing(yaw: float) -> None:
    stage = set_up(make_scene(unit=UNIT | {"at": [0.45, 0.0], "yaw_deg": yaw}))
    body = stage.data.body("unit.top")
    start = body.xpos.copy()
    for value in np.linspace(0.0, 0.14, 15):
        stage.slide("unit.top", value)
        mujoco.mj_forward(stage.world.model, stage.data)
        moved = body.xpos - start
        direction = np.array([np.cos(np.radians(yaw)), np.sin(np.radians(yaw)), 0.0])
        assert moved == pytest.approx(direction * value, abs=1e-9)
        own = [
            i for i in range(stage.data.ncon)
            if {stage.world.geom_address[g] for g in stage.data.contact.geom[i]}
            == {"unit", "unit.top"} and stage.data.contact.dist[i] < -1e-6
        ]  # fmt: skip
        assert not own, f"rubs at {value}"


def test_drawer_stops_at_the_ends_of_its_travel() -> None:
    stage = set_up(make_scene(unit=UNIT | {"at": [0.45, 0.0]}))
    joint = stage.data.joint("unit.top")
    for force, end in ((15.0, 0.14), (-15.0, 0.0)):
        joint.qfrc_applied[0] = force
        stage.step(1.5)
        assert joint.qpos[0] == pytest.approx(end, abs=0.002)


def test_runners_hold_a_drawer_against_less_than_their_friction() -> None:
    drawers = [{"name": "top", "friction_loss": 2.0}, {"name": "bottom", "travel": 0.0}]
    stage = set_up(make_scene(unit=UNIT | {"at": [0.45, 0.0], "drawers": drawers}))
    joint = stage.data.joint("unit.top")
    joint.qfrc_applied[0] = 1.5
    stage.step(1.0)
    assert joint.qpos[0] < 0.005
    joint.qfrc_applied[0] = 4.0
    stage.step(1.0)
    assert joint.qpos[0] > 0.05


def test_addresses_of_parts() -> None:
    stage = set_up(make_scene(one=UNIT | {"at": [0.45, 0.3]}, two=UNIT | {
        "at": [0.45, -0.3], "drawers": [{"name": "top"}, {"name": "low"}]}))  # fmt: skip
    assert set(stage.world.parts) == {"one", "one.top", "two.top", "two.low"}
    assert set(stage.world.regions) == {"one", "two.top", "two.low"}


@pytest.mark.parametrize("vertical", [False, True])
def test_handle_stands_before_the_front(vertical: bool) -> None:
    handle = {"width": 0.06, "depth": 0.03, "thickness": 0.008, "vertical": vertical}
    drawers = [{"name": "top", "handle": handle}, {"name": "bottom", "travel": 0.0}]
    stage = set_up(make_scene(unit=UNIT | {"at": [0.45, 0.0], "drawers": drawers}))
    grip = stage.world.parts["unit"].grasps[0]
    front = UNIT["size"][0] / 2
    assert grip.center[0] == pytest.approx(front + 0.03 - 0.004)
    assert grip.thickness == 0.008
    # Between bar and front a finger fits through.
    body = stage.data.body("unit.top")
    middle = body.xpos + np.array([front + 0.011, 0.0, grip.center[2]])
    sideways = np.array([0.0, 1.0, 0.0]) if not vertical else np.array([0.0, 0.0, 1.0])
    assert ray(stage, middle, np.array([-1.0, 0, 0])) == pytest.approx(0.011, abs=1e-3)
    assert ray(stage, middle, np.array([1.0, 0, 0])) == pytest.approx(0.011, abs=1e-3)
    assert ray(stage, middle, sideways) < 0.03, "the posts"


@pytest.mark.parametrize("hinge", ["left", "right"])
@pytest.mark.parametrize("yaw", [0, -90])
def test_door_swings_about_its_side(hinge: str, yaw: float) -> None:
    """The free edge runs on a circle about the stated side, out of the front."""
    oven = CABINET | {"at": [0.45, 0.1], "yaw_deg": yaw}
    stage = set_up(make_scene(oven=oven | {"door": {"hinge": hinge, "range_deg": 110}}))
    depth, width, height = (side / 2 for side in CABINET["size"])
    turn = np.radians(yaw)
    frame = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    # Who faces the front looks along the cabinet's -x, and has -y on the left hand.
    side = -1.0 if hinge == "left" else 1.0
    hinge_point = np.array([depth - 0.02, side * width])
    door = [g for g in stage.world.geoms_of("oven") if stage.world.geom_address[g] == "oven.door"]
    assert len(door) == 1
    for degrees in (0, 30, 90, 110):
        angle = np.radians(degrees)
        stage.slide("oven.door", angle)
        mujoco.mj_kinematics(stage.world.model, stage.data)
        swing = np.array([np.sin(angle), -side * np.cos(angle)])
        expected = np.array([0.45, 0.1]) + frame @ (hinge_point + width * swing)
        assert stage.data.geom_xpos[door[0]][:2] == pytest.approx(expected, abs=0.012)
    assert stage.world.model.geom_size[door[0]][2] == pytest.approx(height)
    assert stage.world.model.joint("oven.door").range == pytest.approx([0.0, np.radians(110)])


@pytest.mark.parametrize("hinge", ["left", "right"])
def test_closed_door_closes_and_open_door_opens(hinge: str) -> None:
    stage = set_up(make_scene(oven=CABINET | {"at": [0.45, 0.0], "door": {"hinge": hinge}}))
    outside = np.array([0.45 + 0.3, 0.05, stage.top + 0.12])
    inward = np.array([-1.0, 0.0, 0.0])
    mujoco.mj_forward(stage.world.model, stage.data)
    assert ray(stage, outside, inward) == pytest.approx(0.2, abs=0.003), "the door's face"
    stage.slide("oven.door", np.radians(105))
    mujoco.mj_forward(stage.world.model, stage.data)
    assert ray(stage, outside, inward) > 0.3 + 0.1 - 0.02 - 0.01, "through to the back wall"


def test_door_does_not_rub_on_its_cabinet() -> None:
    stage = set_up(make_scene(oven=CABINET | {"at": [0.45, 0.0]}))
    joint = stage.data.joint("oven.door")
    joint.qfrc_applied[0] = 0.6
    stage.step(3.0)
    assert joint.qpos[0] == pytest.approx(np.radians(110), abs=0.03)
    joint.qfrc_applied[0] = -0.6
    stage.step(3.0)
    assert joint.qpos[0] == pytest.approx(0.0, abs=0.01)


def test_boards_of_a_shelf_are_where_the_spec_says() -> None:
    stage = set_up(make_scene(shelf=SHELF | {"at": [0.45, 0.0], "boards": ["a", "b", "c"]}))
    heights = stage.world.scene.objects["shelf"].board_heights()  # type: ignore[union-attr]
    for board, height in zip("abc", heights, strict=True):
        surface = stage.world.surfaces[f"shelf.{board}"]
        assert surface.center[2] == pytest.approx(height - SHELF["size"][2] / 2)
        above = np.array([0.45, 0.0, stage.top + height + 0.03])
        assert ray(stage, above, np.array([0, 0, -1.0])) == pytest.approx(0.03, abs=1e-4)


def test_compartment_of_a_shelf_is_open_to_the_front() -> None:
    stage = set_up(make_scene(shelf=SHELF | {"at": [0.45, 0.0]}))
    inside = np.array([0.45, 0.0, stage.top + 0.12])
    assert ray(stage, inside, np.array([1.0, 0, 0])) > 0.2
    assert ray(stage, inside, np.array([-1.0, 0, 0])) < 0.1
    for side in (1.0, -1.0):
        assert ray(stage, inside, np.array([0, side, 0])) == pytest.approx(0.15 - 0.008, abs=1e-3)

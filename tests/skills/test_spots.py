"""Where things are put down."""

from __future__ import annotations

from collections.abc import Iterable

import mujoco
import numpy as np
import pytest

from etot_cli.skills.action import Keepout
from etot_cli.skills.placements.surface_spots import EDGE, MIN_GAP, surface_spots, sweep_rectangles
from tests.skills.helpers import BALL, BOX, OVEN, UNIT, drawers
from tests.world.helpers import Stage, make_scene, set_up

RADIUS = 0.03


def spots(
    stage: Stage,
    target: str = "desk",
    keepout: Iterable[Keepout] = (),
    ignore: Iterable[str] = (),
    prefer: tuple[float, float] = (0.4, 0.0),
    radius: float = RADIUS,
) -> np.ndarray:
    found = surface_spots(
        stage.world, stage.data, target, radius, keepout, ignore, np.array(prefer)
    )
    return np.array([spot for spot, _ in found]).reshape(-1, 2)


@pytest.fixture(scope="module")
def stage() -> Stage:
    return set_up(
        make_scene(
            box=BOX | {"at": [0.4, 0.25]},
            ball=BALL | {"at": [0.35, -0.35]},
            unit=UNIT | {"at": [0.47, 0.0], "yaw_deg": -90, "drawers": drawers()},
        )
    )


def test_spots_are_free_reachable_and_on_the_desk(stage: Stage) -> None:
    found = spots(stage)
    assert len(found) > 30
    desk, reach = stage.world.scene.desk, stage.world.robot.spec.reach
    for axis in range(2):
        edge = desk.size[axis] / 2 - EDGE - RADIUS
        assert np.abs(found[:, axis] - desk.center[axis]).max() <= edge + 1e-9
    assert np.hypot(found[:, 0], found[:, 1]).max() < reach
    for name, half in (("box", 0.03), ("ball", 0.035)):
        center = stage.data.body(name).xpos[:2]
        assert np.linalg.norm(found - center, axis=1).min() >= RADIUS + half + MIN_GAP - 0.01
    inside = (np.abs(found[:, 0] - 0.47) < 0.09) & (np.abs(found[:, 1]) < 0.12)
    assert not inside.any(), "not in the furniture"


def test_thing_in_the_hand_is_no_obstacle(stage: Stage) -> None:
    center = stage.data.body("box").xpos[:2]
    with_box = np.linalg.norm(spots(stage) - center, axis=1).min()
    without = np.linalg.norm(spots(stage, ignore=["box"]) - center, axis=1).min()
    assert without < 0.03 < with_box


def test_keepout_is_respected(stage: Stage) -> None:
    first = spots(stage)[0]
    disc = Keepout(float(first[0]), float(first[1]), 0.12)
    found = spots(stage, keepout=[disc])
    assert len(found) > 5
    distance = np.linalg.norm(found - first, axis=1)
    assert distance.min() >= disc.radius + RADIUS
    everywhere = Keepout(0.4, 0.0, 2.0)
    assert len(spots(stage, keepout=[everywhere])) == 0


def test_way_of_the_drawer_stays_free(stage: Stage) -> None:
    """The closed drawer slides 0.14 m towards -y; nobody is put there."""
    found = spots(stage)
    swept = (np.abs(found[:, 0] - 0.47) < 0.09 + RADIUS) & (found[:, 1] < -0.10) & (
        found[:, 1] > -0.12 - 0.14 - RADIUS
    )  # fmt: skip
    assert not swept.any()
    beyond = (np.abs(found[:, 0] - 0.47) < 0.06) & (found[:, 1] < -0.12 - 0.14 - RADIUS)
    assert beyond.any(), "but beyond its way"


def test_way_of_a_door_stays_free() -> None:
    stage = set_up(make_scene(oven=OVEN | {"at": [0.45, 0.35], "yaw_deg": -90}))
    found = spots(stage)
    hinge_side = stage.data.joint("oven.door").xanchor[:2]
    half_open = hinge_side + 0.26 * np.array([np.cos(np.pi * 1.25), np.sin(np.pi * 1.25)])
    middle = hinge_side + 0.2 * np.array([0.0, -1.0])
    for point in (half_open, middle):
        nearest = min(
            float(rectangle.distance(point[None])[0])
            for rectangle in sweep_rectangles(stage.world, stage.data)
        )
        if nearest == 0.0:
            assert np.linalg.norm(found - point, axis=1).min() > RADIUS
    clear = [
        min(float(r.distance(spot[None])[0]) for r in sweep_rectangles(stage.world, stage.data))
        for spot in found[:20]
    ]
    assert min(clear) >= RADIUS


def test_sweep_covers_the_door_in_every_position() -> None:
    stage = set_up(make_scene(oven=OVEN | {"at": [0.45, 0.3], "yaw_deg": -60}))
    rectangles = sweep_rectangles(stage.world, stage.data)
    door = next(g for g in stage.world.geoms_of("oven")
                if stage.world.geom_address[g] == "oven.door")  # fmt: skip
    for angle in np.linspace(0.0, np.radians(110), 23):
        stage.slide("oven.door", angle)
        mujoco.mj_kinematics(stage.world.model, stage.data)
        size = stage.world.model.geom_size[door]
        rotation = stage.data.geom_xmat[door].reshape(3, 3)
        for share in (-0.9, 0.0, 0.9):
            point = stage.data.geom_xpos[door] + rotation @ (np.array([0, share, 0]) * size)
            assert min(float(r.distance(point[None, :2])[0]) for r in rectangles) < 0.02


def test_spots_on_furniture_lie_on_its_top(stage: Stage) -> None:
    found = surface_spots(stage.world, stage.data, "unit", RADIUS, (), (), np.array([0.47, 0.0]))
    assert found
    for spot, height in found:
        assert height == pytest.approx(stage.top + UNIT["size"][2], abs=1e-3)
        assert abs(spot[0] - 0.47) <= 0.09 and abs(spot[1]) <= 0.12


def test_what_stands_on_furniture_is_an_obstacle_there() -> None:
    unit = UNIT | {"at": [0.47, 0.0], "yaw_deg": -90, "drawers": drawers()}
    stage = set_up(make_scene(unit=unit, box=BOX | {"on": "unit", "at": [0.47, 0.06]}))
    found = spots(stage, "unit")
    assert len(found)
    assert np.linalg.norm(found - [0.47, 0.06], axis=1).min() > RADIUS + 0.025
    assert len(spots(stage, "unit", ignore=["box"])) > len(found)


def test_nearer_spots_come_first_other_things_being_equal() -> None:
    stage = set_up(make_scene())
    left = spots(stage, prefer=(0.3, 0.3))[0]
    right = spots(stage, prefer=(0.3, -0.3))[0]
    assert left[1] > 0.1 and right[1] < -0.1


def test_same_question_same_answer(stage: Stage) -> None:
    np.testing.assert_array_equal(spots(stage), spots(stage))


def test_nothing_fits_on_a_full_top() -> None:
    lid = {"kind": "box", "on": "unit", "size": [0.22, 0.17, 0.02]}
    unit = UNIT | {"at": [0.47, 0.0], "drawers": drawers()}
    stage = set_up(make_scene(unit=unit, lid=lid))
    assert len(spots(stage, "unit")) == 0

"""Initial poses: objects start where the scene says, at rest on or in their supports."""

from __future__ import annotations

from contextlib import nullcontext

import mujoco
import numpy as np
import pytest

from etot_cli.errors import WorldError
from etot_cli.specs.scene import Scene
from etot_cli.world.model import build_world
from etot_cli.world.placing import check_robot_is_free, object_bounds, place_objects
from tests.world.helpers import BALL, BOX, CUP, PEN, SHELF, UNIT, make_scene, set_up

FAR = 0.003


def drift(**objects: dict[str, object]) -> dict[str, float]:
    """How far each free object moves while it settles for a second [m]."""
    stage = set_up(make_scene(**objects), settle=0.0)
    names = [name for name, entry in stage.world.entries.items() if entry.free]
    before = {name: stage.data.body(name).xpos.copy() for name in names}
    stage.step(1.0)
    return {name: float(np.linalg.norm(stage.data.body(name).xpos - before[name]))
            for name in names}  # fmt: skip


@pytest.mark.parametrize(
    "objects",
    [
        {"box": BOX | {"at": [0.4, 0.1], "yaw_deg": 33}},
        {"ball": BALL | {"at": [0.4, 0.1]}},
        {"pen": PEN | {"at": [0.4, 0.1], "yaw_deg": 70}},
        {"cup": CUP | {"at": [0.4, 0.1], "foot_diameter": 0.05}},
        {"box": BOX | {"at": [0.4, 0.1]}, "top": BOX | {"on": "box", "size": [0.04, 0.04, 0.02]}},
        {"unit": UNIT | {"at": [0.45, 0.0]}, "pen": PEN | {"on": "unit", "at": [0.45, 0.03]}},
        {"unit": UNIT | {"at": [0.45, 0.0]}, "ball": BALL | {"inside": "unit.top"}},
        {"shelf": SHELF | {"at": [0.45, 0.0]}, "box": BOX | {"on": "shelf.bottom"}},
        {"cup": CUP | {"at": [0.4, 0.1]}, "ball": BALL | {"inside": "cup"}},
        {"cup": CUP | {"at": [0.4, 0.1]}, "big": BALL | {"diameter": 0.1, "on": "cup"}},
    ],
    ids=lambda objects: "+".join(objects),
)
def test_placed_objects_are_at_rest(objects: dict[str, dict[str, object]]) -> None:
    for name, distance in drift(**objects).items():
        assert distance < FAR, name


def test_at_and_yaw_are_kept() -> None:
    stage = set_up(make_scene(box=BOX | {"at": [0.37, -0.21], "yaw_deg": 30}), settle=0.0)
    body = stage.data.body("box")
    assert body.xpos[:2] == pytest.approx([0.37, -0.21])
    assert body.xpos[2] == pytest.approx(stage.top + 0.035, abs=0.001)
    assert body.xmat[0] == pytest.approx(np.cos(np.radians(30)))


def test_full_position_is_taken_as_it_is() -> None:
    stage = set_up(make_scene(box=BOX | {"at": [0.4, 0.0, 0.5]}), settle=0.0)
    assert stage.data.body("box").xpos == pytest.approx([0.4, 0.0, 0.5])


def test_on_without_at_is_the_middle_of_a_turned_support() -> None:
    stage = set_up(
        make_scene(unit=UNIT | {"at": [0.45, 0.1], "yaw_deg": 60}, box=BOX | {"on": "unit"}),
        settle=0.0,
    )
    unit = UNIT["size"]
    assert stage.data.body("box").xpos[:2] == pytest.approx([0.45, 0.1], abs=0.01)
    assert stage.data.body("box").xpos[2] == pytest.approx(
        stage.top + unit[2] + BOX["size"][2] / 2, abs=0.003
    )


def test_order_of_the_document_does_not_matter() -> None:
    above = BOX | {"on": "box", "size": [0.04, 0.04, 0.02]}
    one = set_up(make_scene(box=BOX | {"at": [0.4, 0.1]}, above=above), settle=0.0)
    two = set_up(make_scene(above=above, box=BOX | {"at": [0.4, 0.1]}), settle=0.0)
    for name in ("box", "above"):
        assert one.data.body(name).xpos == pytest.approx(two.data.body(name).xpos)


def test_nothing_overlaps_after_placing() -> None:
    stage = set_up(
        make_scene(
            cup=CUP | {"at": [0.4, 0.2]},
            pen=PEN | {"inside": "cup"},
            unit=UNIT | {"at": [0.45, -0.1]},
            box=BOX | {"on": "unit"},
        ),
        settle=0.0,
    )
    for index in range(stage.data.ncon):
        pair = [stage.world.geom_object[g] for g in stage.data.contact.geom[index]]
        if "unit" in pair and set(pair) <= {"unit"}:
            continue
        assert stage.data.contact.dist[index] > -0.001, pair


@pytest.mark.parametrize("diameter", [0.06, 0.075, 0.09])
def test_rod_in_a_cup_stands_and_stays(diameter: float) -> None:
    stage = set_up(
        make_scene(cup=CUP | {"at": [0.4, 0.1], "diameter": diameter}, pen=PEN | {"inside": "cup"}),
        settle=1.5,
    )
    pen = stage.data.body("pen")
    axis = pen.xmat.reshape(3, 3)[:, 0]
    assert axis[2] < -0.7, "point down"
    low, high = object_bounds(stage.world, stage.data, "pen")
    assert low[2] == pytest.approx(stage.top + 0.004, abs=0.004), "on the cup's floor"
    assert high[2] > stage.top + CUP["height"]
    assert not stage.see("cup").toppled


@pytest.mark.parametrize("board", ["low", "middle", "high"])
def test_things_stand_on_the_board_that_was_named(board: str) -> None:
    shelf = SHELF | {"at": [0.45, 0.0], "boards": ["low", "middle", "high"]}
    stage = set_up(make_scene(shelf=shelf, box=BOX | {"on": f"shelf.{board}"}))
    heights = dict(zip(("low", "middle", "high"), stage.world.scene.objects["shelf"]  # type: ignore[union-attr]
                       .board_heights(), strict=True))  # fmt: skip
    low, _ = object_bounds(stage.world, stage.data, "box")
    assert low[2] == pytest.approx(stage.top + heights[board], abs=0.003)


def test_rod_that_fits_lies_in_the_drawer() -> None:
    stage = set_up(make_scene(unit=UNIT | {"at": [0.45, 0.0]}, pen=PEN | {"inside": "unit"}))
    assert abs(stage.data.body("pen").xmat.reshape(3, 3)[2, 0]) < 0.1


def test_initial_joint_values() -> None:
    drawers = [{"name": "top", "open": 0.05}, {"name": "bottom"}]
    oven = {"kind": "cabinet", "size": [0.2, 0.3, 0.25], "door": {"open_deg": 30}}
    stage = set_up(
        make_scene(
            unit=UNIT | {"at": [0.45, -0.3], "drawers": drawers}, oven=oven | {"at": [0.45, 0.25]}
        ),
        settle=0.0,
    )
    assert stage.data.joint("unit.top").qpos[0] == pytest.approx(0.05)
    assert stage.data.joint("unit.bottom").qpos[0] == 0.0
    assert stage.data.joint("oven.door").qpos[0] == pytest.approx(np.radians(30))


def test_inside_something_solid_is_refused() -> None:
    scene = make_scene(box=BOX | {"at": [0.4, 0.0]}, ball=BALL | {"inside": "box"})
    world = build_world(scene)
    with pytest.raises(WorldError, match="ball: nothing can be inside 'box'; containers are none"):
        place_objects(world, mujoco.MjData(world.model))


@pytest.mark.parametrize(
    ("desk", "height", "found"),
    [
        ({"top": 0.22}, 0.15, "stands in the desk, by .* at 0.22 m"),
        ({"top": 0.22, "center": [0.55, 0.0]}, 0.15, None),
        ({}, 0.15, None),
        ({}, 0.5, "objects.unit: the robot stands in it"),
    ],
)
def test_a_robot_that_stands_in_what_is_fastened_is_an_error(desk, height, found) -> None:
    unit = UNIT | {"at": [0.4, 0.0], "size": [0.2, 0.18, height]}
    world = build_world(Scene.model_validate({"desk": desk, "objects": {"unit": unit}}))
    data = mujoco.MjData(world.model)
    place_objects(world, data)
    data.qpos[world.robot.qpos] = world.robot.spec.home
    mujoco.mj_forward(world.model, data)
    with nullcontext() if found is None else pytest.raises(WorldError, match=found):
        check_robot_is_free(world, data)

"""What is on, inside, in hand, open, toppled, lost and reachable; tiny scenes."""

from __future__ import annotations

import math
from pathlib import Path

import mujoco
import numpy as np
import pytest

from etot_cli.world.stance import RIGHTED_DEG, TOPPLED_DEG
from etot_cli.world.state import OPEN_AT
from tests.world.helpers import BALL, BOX, CABINET, CUP, PEN, SHELF, UNIT, about_y, make_scene
from tests.world.helpers import set_up as set_up_stage

# -- on --------------------------------------------------------------------------------------------


def test_stack_rests_on_what_is_below_it() -> None:
    stage = set_up_stage(
        make_scene(box=BOX | {"at": [0.4, 0.0]}, plate=BOX | {"size": [0.04, 0.04, 0.02]} | {
            "on": "box"})
    )  # fmt: skip
    scene = stage.look()
    assert scene.states["box"].on == ("desk",)
    assert scene.states["plate"].on == ("box",)


def test_neighbour_that_only_touches_from_the_side_is_no_support() -> None:
    side = BOX["size"][0]
    stage = set_up_stage(
        make_scene(one=BOX | {"at": [0.4, 0.0]}, two=BOX | {"at": [0.4 + side - 1e-4, 0.0]})
    )
    touching = {tuple(sorted((stage.world.geom_object[a], stage.world.geom_object[b])))
                for a, b in stage.data.contact.geom}  # fmt: skip
    assert ("one", "two") in touching
    scene = stage.look()
    assert scene.states["one"].on == scene.states["two"].on == ("desk",)


def test_object_in_the_air_is_on_nothing() -> None:
    stage = set_up_stage(make_scene(box=BOX | {"at": [0.4, 0.0]}))
    stage.move("box", [0.4, 0.0, 0.5])
    assert stage.see("box").on == ()


def test_shelf_and_furniture_top_carry() -> None:
    stage = set_up_stage(
        make_scene(
            shelf=SHELF | {"at": [0.45, 0.35], "boards": ["low", "high"]},
            ball=BALL | {"on": "shelf.high"},
            unit=UNIT | {"at": [0.45, -0.1]},
            box=BOX | {"on": "unit"},
        ),
        settle=1.0,
    )
    scene = stage.look()
    assert scene.states["box"].on == ("unit",)
    assert scene.states["ball"].on == ("shelf.high",)


# -- inside ----------------------------------------------------------------------------------------


def test_ball_in_a_cup_is_inside() -> None:
    stage = set_up_stage(make_scene(cup=CUP | {"at": [0.4, 0.1]}, ball=BALL | {"inside": "cup"}))
    assert stage.see("ball").inside == "cup"
    assert stage.see("cup").inside is None


def test_ball_on_the_mouth_of_a_cup_is_not_inside() -> None:
    wide = BALL | {"diameter": 0.088}
    stage = set_up_stage(make_scene(cup=CUP | {"at": [0.4, 0.1]}, ball=wide | {"on": "cup"}))
    ball = stage.see("ball")
    assert ball.inside is None
    assert ball.on == ("cup",)


def test_toppled_cup_holds_nothing() -> None:
    stage = set_up_stage(make_scene(cup=CUP | {"at": [0.4, 0.1]}, ball=BALL | {"inside": "cup"}))
    assert stage.see("ball").inside == "cup"
    lying = [0.4, 0.1, stage.top + CUP["diameter"] / 2 + 0.001]
    stage.move("cup", lying, about_y(90))
    stage.move("ball", lying)
    scene = stage.look()
    assert scene.states["ball"].inside is None
    assert scene.states["cup"].toppled


def test_pen_that_stands_in_a_cup_is_inside_though_its_middle_is_above_the_rim() -> None:
    stage = set_up_stage(make_scene(cup=CUP | {"at": [0.4, 0.1]}, pen=PEN | {"inside": "cup"}))
    pen = stage.see("pen")
    assert pen.position[2] > stage.top + CUP["height"] - 0.02
    assert pen.inside == "cup"


def test_what_stands_in_a_bowl_is_inside_though_its_middle_is_above_the_rim() -> None:
    bowl = {"kind": "bowl", "diameter": 0.14, "height": 0.04, "mass": 0.4, "at": [0.4, 0.0]}
    tall = BOX | {"size": [0.04, 0.04, 0.10], "inside": "bowl"}
    stage = set_up_stage(make_scene(bowl=bowl, box=tall))
    assert stage.see("box").inside == "bowl"


def test_the_outer_of_nested_bowls_is_in_none() -> None:
    """Though its middle is where the inner ones take things in."""
    outer, middle, inner = (
        {"kind": "bowl", "diameter": diameter, "height": height, "mass": 0.2}
        for diameter, height in ((0.22, 0.08), (0.15, 0.055), (0.09, 0.04))
    )
    stage = set_up_stage(
        make_scene(
            outer=outer | {"at": [0.4, 0.1]},
            middle=middle | {"inside": "outer"},
            inner=inner | {"inside": "middle"},
        ),
        settle=0.3,
    )
    found = {name: state.inside for name, state in stage.look().states.items()}
    assert found == {"outer": None, "middle": "outer", "inner": "middle"}


def test_a_lid_that_has_its_origin_below_lies_on_the_rim(tmp_path: Path) -> None:
    (tmp_path / "lid.xml").write_text(
        """<mujoco><worldbody><body name="lid">
        <geom type="cylinder" size="0.05 0.004" pos="0 0 0.004"/>
        <geom type="cylinder" size="0.012 0.014" pos="0 0 0.022"/>
        </body></worldbody></mujoco>"""
    )
    lid = {"kind": "mjcf", "file": "lid.xml", "on": "cup", "mass": 0.1}
    stage = set_up_stage(make_scene(tmp_path, cup=CUP | {"at": [0.4, 0.1]}, lid=lid), settle=0.2)
    found = stage.see("lid")
    assert found.on == ("cup",) and found.inside is None


def test_a_model_from_a_file_need_not_name_its_bodies(tmp_path: Path) -> None:
    (tmp_path / "box.xml").write_text(
        """<mujoco><worldbody><body><body pos="0 0 0.01">
        <geom type="box" size="0.05 0.05 0.005"/>
        <site name="room" type="box" size="0.05 0.05 0.03" pos="0 0 0.035"/>
        </body></body></worldbody></mujoco>"""
    )
    box = {"kind": "mjcf", "file": "box.xml", "at": [0.4, 0.1], "container_site": "room"}
    stage = set_up_stage(make_scene(tmp_path, box=box, ball=BALL | {"inside": "box"}), settle=0.2)
    assert stage.see("ball").inside == "box"


def test_pen_across_a_cups_mouth_is_not_inside() -> None:
    stage = set_up_stage(make_scene(cup=CUP | {"at": [0.4, 0.1]}, pen=PEN | {"inside": "cup"}))
    stage.memory = type(stage.memory)(up=stage.memory.up)
    stage.move("pen", [0.4, 0.1, stage.top + CUP["height"] + 0.01], [1, 0, 0, 0])
    stage.step(0.3)
    assert stage.see("pen").inside is None


def test_inside_is_left_later_than_it_is_entered() -> None:
    """Hysteresis: what was inside may stick out by a margin; what was not, may not."""
    stage = set_up_stage(make_scene(cup=CUP | {"at": [0.4, 0.1]}, ball=BALL | {"at": [0.4, -0.2]}))
    rim = stage.top + CUP["height"]
    assert stage.see("ball").inside is None
    stage.move("ball", [0.4, 0.1, rim + 0.005])
    assert stage.see("ball").inside is None, "comes from outside"
    stage.move("ball", [0.4, 0.1, rim - 0.01])
    assert stage.see("ball").inside == "cup"
    stage.move("ball", [0.4, 0.1, rim + 0.005])
    assert stage.see("ball").inside == "cup", "was inside"
    stage.move("ball", [0.4, 0.1, rim + 0.02])
    assert stage.see("ball").inside is None
    stage.move("ball", [0.4, 0.1, rim + 0.005])
    assert stage.see("ball").inside is None, "has left"


@pytest.mark.parametrize(("length", "inside"), [(0.145, "unit"), (0.20, None)])
def test_what_hangs_on_a_drawers_sides_is_not_in_it(length: float, inside: str | None) -> None:
    drawers = [{"name": "top", "travel": 0.14, "open": 0.14}, {"name": "bottom", "travel": 0.0}]
    stage = set_up_stage(
        make_scene(
            unit=UNIT | {"at": [0.45, 0.0], "yaw_deg": -90, "drawers": drawers},
            bar=BOX | {"size": [length, 0.03, 0.02], "at": [0.3, 0.3]},
        )
    )
    stage.move("bar", [0.45, -0.17, stage.data.body("unit").xpos[2] + 0.11], [1.0, 0.0, 0.0, 0.0])
    stage.step(0.8)
    bar = stage.look().states["bar"]
    assert bar.on == ("unit.top",)
    assert bar.inside == inside


def test_what_lies_on_a_drawers_contents_is_in_it_too() -> None:
    drawers = [{"name": "top", "travel": 0.14, "open": 0.14}, {"name": "bottom", "travel": 0.0}]
    box = BOX | {"size": [0.04, 0.04, 0.028]}
    stage = set_up_stage(
        make_scene(
            unit=UNIT | {"at": [0.45, 0.0], "yaw_deg": -90, "drawers": drawers},
            low=box | {"inside": "unit"},
            high=box | {"on": "low"},
        ),
        settle=0.5,
    )
    assert stage.look().states["high"].on == ("low",)
    assert stage.look().states["high"].inside == "unit"


@pytest.mark.parametrize("opening", [0.0, 0.10])
def test_content_of_a_drawer_open_or_closed(opening: float) -> None:
    drawers = [{"name": "top", "travel": 0.14, "open": 0.10}, {"name": "bottom", "travel": 0.0}]
    stage = set_up_stage(
        make_scene(
            unit=UNIT | {"at": [0.45, 0.0], "yaw_deg": -90, "drawers": drawers},
            box=BOX | {"size": [0.03, 0.03, 0.03], "inside": "unit"},
        )
    )
    moved = opening - stage.data.joint("unit.top").qpos[0]
    stage.slide("unit.top", opening)
    position = stage.data.body("box").xpos.copy()
    stage.move("box", position + np.array([0.0, -moved, 0.0]))
    stage.step(0.3)
    scene = stage.look()
    assert scene.states["box"].inside == "unit"
    assert scene.states["box"].on == ("unit.top",)
    assert scene.states["box"].reachable


def test_two_drawers_are_told_apart() -> None:
    drawers = [{"name": "top"}, {"name": "bottom"}]
    stage = set_up_stage(
        make_scene(
            unit=UNIT | {"at": [0.45, 0.0], "drawers": drawers},
            one=BOX | {"size": [0.02, 0.02, 0.02], "inside": "unit.top"},
            two=BOX | {"size": [0.02, 0.02, 0.02], "inside": "unit.bottom"},
        )
    )
    scene = stage.look()
    assert scene.states["one"].inside == "unit.top"
    assert scene.states["two"].inside == "unit.bottom"


def test_smallest_container_counts() -> None:
    stage = set_up_stage(
        make_scene(
            oven=CABINET | {"at": [0.45, 0.0], "yaw_deg": 180},
            cup=CUP | {"inside": "oven"},
            ball=BALL | {"inside": "cup"},
        )
    )
    scene = stage.look()
    assert scene.states["cup"].inside == "oven"
    assert scene.states["ball"].inside == "cup"


# -- in hand ---------------------------------------------------------------------------------------


def test_in_hand_needs_both_fingers() -> None:
    stage = set_up_stage(make_scene(ball=BALL | {"at": [0.4, 0.0]}))
    world, data = stage.world, stage.data
    tool = data.site_xpos[world.robot.tool_site].copy()
    stage.move("ball", tool)
    assert stage.look().holding is None, "open fingers hold nothing"
    data.qpos[world.robot.finger_qpos] = BALL["diameter"] / 2 - 1e-4
    scene = stage.look()
    assert scene.holding == "ball"
    assert scene.states["ball"].in_hand and scene.states["ball"].on == ()
    across = data.site_xmat[world.robot.tool_site].reshape(3, 3)[:, 1]
    data.qpos[world.robot.finger_qpos] = BALL["diameter"] / 2 + 0.002
    stage.move("ball", tool + 0.0022 * across)
    mujoco.mj_forward(world.model, data)
    touched = {world.model.geom_bodyid[g] for pair in data.contact.geom for g in pair}
    sides = world.robot.finger_side
    assert len({sides[body] for body in touched & set(sides)}) == 1
    assert stage.look().holding is None, "one finger alone does not hold"


# -- open, closed ----------------------------------------------------------------------------------


def test_openness_is_a_share_of_the_travel() -> None:
    stage = set_up_stage(make_scene(unit=UNIT | {"at": [0.45, 0.0]}))
    for value in (0.0, 0.035, 0.07, 0.14):
        stage.slide("unit.top", value)
        assert stage.see("unit").openness["top"] == pytest.approx(value / 0.14, abs=1e-6)
    assert set(stage.see("unit").openness) == {"top"}, "a fixed front is no part"


def test_door_openness_and_parts() -> None:
    stage = set_up_stage(
        make_scene(oven=CABINET | {"at": [0.45, 0.0], "door": {"range_deg": 100, "open_deg": 25}})
    )
    scene = stage.look()
    assert scene.states["oven"].openness == {"door": pytest.approx(0.25, abs=0.01)}
    part = scene.part("oven")
    assert part is not None and part.joint_type == "hinge"
    assert scene.part("oven.door") == part
    assert part.travel == pytest.approx(np.radians(100))


def test_opened_has_hysteresis() -> None:
    stage = set_up_stage(make_scene(unit=UNIT | {"at": [0.45, 0.0]}))

    def opened(share: float) -> bool:
        stage.slide("unit.top", share * 0.14)
        return stage.see("unit").opened["top"]

    below = OPEN_AT - 0.03
    assert not opened(below)
    assert opened(OPEN_AT + 0.01)
    assert opened(below), "stays open a little below the threshold"
    assert not opened(0.4)
    assert not opened(below), "and has to pass the threshold again"


# -- toppled ---------------------------------------------------------------------------------------


def test_toppled_has_hysteresis() -> None:
    stage = set_up_stage(make_scene(box=BOX | {"at": [0.4, 0.0]}))

    def toppled(degrees: float) -> bool:
        stage.move("box", [0.4, 0.0, 0.4], about_y(degrees))
        state = stage.see("box")
        assert state.tilt_deg == pytest.approx(degrees, abs=0.5)
        return state.toppled

    between = (TOPPLED_DEG + RIGHTED_DEG) / 2
    assert not toppled(between)
    assert toppled(TOPPLED_DEG + 2)
    assert toppled(between)
    assert not toppled(RIGHTED_DEG - 2)
    assert not toppled(between)


@pytest.mark.parametrize("made_to_stand", [CUP, BOX | {"size": [0.05, 0.06, 0.15]}])
def test_what_is_made_to_stand_lies_from_the_start(made_to_stand: dict[str, object]) -> None:
    lying = {"at": [0.4, 0.0], "quaternion": about_y(90)}
    stage = set_up_stage(make_scene(thing=made_to_stand | lying))
    assert stage.see("thing").toppled
    stage.move("thing", [0.4, 0.0, 0.4], [1, 0, 0, 0])
    assert not stage.see("thing").toppled


@pytest.mark.parametrize(
    ("thing", "has_top"),
    [
        (CUP, True),
        ({"kind": "bowl", "diameter": 0.12, "height": 0.05, "mass": 0.2}, True),
        ({"kind": "cylinder", "diameter": 0.05, "height": 0.15, "mass": 0.2}, True),
        (BOX | {"size": [0.05, 0.06, 0.15]}, True),
        (BOX | {"size": [0.15, 0.2, 0.03]}, False),
        ({"kind": "cylinder", "diameter": 0.12, "height": 0.03, "mass": 0.2}, False),
    ],
    ids=["cup", "bowl", "bottle", "carton", "book", "puck"],
)
def test_what_has_a_top_does_not_stand_upside_down(thing: dict[str, object], has_top: bool) -> None:
    turned_over = {"at": [0.4, 0.0], "quaternion": about_y(180)}
    stage = set_up_stage(make_scene(thing=thing | turned_over))
    assert stage.see("thing").toppled is has_top, "from the start"
    stage.move("thing", [0.4, 0.0, 0.4], [1, 0, 0, 0])
    assert not stage.see("thing").toppled, "the same for what has none"


def test_what_has_no_side_of_its_own_stands_as_it_stood_however_it_is_turned() -> None:
    cube = BOX | {"size": [0.05, 0.05, 0.05]}
    stage = set_up_stage(make_scene(cube=cube | {"at": [0.4, 0.0], "quaternion": about_y(90)}))
    assert not stage.see("cube").toppled
    half = math.sqrt(0.5)
    stage.move("cube", [0.4, 0.0, 0.4], [0.5, -0.5, 0.5, 0.5])
    assert not stage.see("cube").toppled, "turned about the vertical"
    stage.move("cube", [0.4, 0.0, 0.4], [half, half, 0, 0])
    assert stage.see("cube").toppled, "another side is up"


@pytest.mark.parametrize("kind", [BALL, PEN])
def test_balls_and_rods_cannot_topple(kind: dict[str, object]) -> None:
    stage = set_up_stage(make_scene(thing=kind | {"at": [0.4, 0.0]}))
    stage.move("thing", [0.4, 0.0, 0.4], about_y(90))
    assert not stage.see("thing").toppled


def test_turning_about_the_vertical_does_not_topple() -> None:
    stage = set_up_stage(make_scene(box=BOX | {"at": [0.4, 0.0]}))
    stage.move("box", [0.4, 0.0, 0.4], [0.0, 0.0, 0.0, 1.0])
    assert stage.see("box").tilt_deg < 1.0


# -- lost and out of reach -------------------------------------------------------------------------


def test_lost_is_below_the_desk_top() -> None:
    stage = set_up_stage(make_scene(ball=BALL | {"at": [0.4, 0.0]}))
    assert not stage.see("ball").lost
    stage.move("ball", [0.4, 0.75, stage.top])
    stage.step(0.1)
    assert stage.see("ball").lost
    stage.step(0.5)
    assert stage.see("ball").lost, "on the floor"


@pytest.mark.parametrize(
    ("thing", "leaning"),
    [
        (BALL, True),
        (BOX | {"size": [0.04, 0.04, 0.02]}, False),
        (BOX | {"size": [0.1, 0.1, 0.06]}, False),
    ],
    ids=["narrow", "flat", "wide"],
)
def test_reachable_ends_with_the_arm(thing: dict[str, object], leaning: bool) -> None:
    """A hand that leans outwards gets farther, where there is something for it to grasp."""
    stage = set_up_stage(make_scene(thing=thing | {"at": [0.4, 0.0]}))
    spec = stage.world.robot.spec
    reach = spec.leaning_reach if leaning else spec.reach
    assert spec.leaning_reach > spec.reach
    for share, expected in ((0.98, True), (1.02, False)):
        stage.move("thing", [reach * share * 0.8, reach * share * 0.6, stage.top + 0.03])
        assert stage.see("thing").reachable is expected


def test_scene_state_knows_desk_and_infos() -> None:
    stage = set_up_stage(make_scene(cup=CUP | {"at": [0.4, 0.0], "color": "#fefefe"}))
    scene = stage.look()
    assert scene.desk_top == stage.top
    assert scene.desk_bounds == pytest.approx((0.02, 0.82, -0.6, 0.6))
    info = scene.infos["cup"]
    assert info.container and info.movable and not info.elongated and info.color == "white"

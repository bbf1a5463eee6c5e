"""PICK UP in physics: what can be held is held, what cannot slips or is refused."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from etot_cli.skills.action import GraspPose
from etot_cli.skills.grasps.ranking import Grasp, GraspSet
from etot_cli.skills.grasps.variants import variants
from etot_cli.world.pose import Pose
from etot_cli.world.state import CauseKind
from tests.skills.helpers import BALL, BOX, CUP, OVEN, PEN, UNIT, Episode, drawers, episode
from tests.world.helpers import make_scene

SEEDS = range(3)
THINGS = {
    "ball": BALL,
    "apple": BALL | {"diameter": 0.08, "mass": 0.15},
    "box": BOX,
    "turned box": BOX | {"yaw_deg": 30},
    "cup": CUP,
    "small cup": CUP | {"diameter": 0.06},
    "bowl": {"kind": "bowl", "diameter": 0.14, "height": 0.05, "mass": 0.2, "at": [0.42, 0.1]},
    "pen": PEN,
    "turned pen": PEN | {"yaw_deg": 80},
}


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("name", THINGS)
def test_things_are_picked_up(name: str, seed: int) -> None:
    run = episode(seed, thing=THINGS[name])
    start = run.state.states["thing"].position[2]
    after = run.must("[PICK UP, thing]")
    held = after.states["thing"]
    assert after.holding == "thing"
    assert held.in_hand and held.on == () and not held.lost
    assert held.position[2] > start + 0.05


@pytest.mark.parametrize("seed", SEEDS)
def test_wide_cup_is_held_by_its_rim_from_above(seed: int) -> None:
    run = episode(seed, cup=CUP | {"friction": 0.3, "slippery": True})
    after = run.must("[PICK UP, cup] (vertical)")
    assert after.holding == "cup"
    belief = run.simulated.believe(run.snapshot)
    assert belief.tool().rotation[2, 2] < -0.6
    assert belief.opening < 0.02


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("diameter", [0.095, 0.105])
def test_too_wide_slippery_cup_slips_from_the_side(seed: int, diameter: float) -> None:
    run = episode(seed, cup=CUP | {"diameter": diameter, "friction": 0.2, "slippery": True})
    record = run.do("[PICK UP, cup] (horizontal)").record
    assert not record.effect
    assert record.after.holding is None
    assert record.cause is not None
    assert record.cause.kind in (CauseKind.SLIP, CauseKind.NO_GRASP)
    assert record.cause.objects[0] == "cup"


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("board", [False, True])
@pytest.mark.parametrize("diameter", [0.09, 0.095, 0.1])
def test_what_is_wedged_before_open_fingers_is_not_held(
    seed: int, board: bool, diameter: float
) -> None:
    """On a desk as under a board, and of any friction."""
    can = {"kind": "cylinder", "diameter": diameter, "height": 0.09, "mass": 0.3}
    rack = {"kind": "shelf", "at": [0.60, 0.10], "yaw_deg": 180, "size": [0.20, 0.40, 0.22],
            "boards": ["bottom", "top"]}  # fmt: skip
    at = {"on": "rack.bottom", "at": [0.56, 0.10]} if board else {"at": [0.45, 0.1]}
    record = episode(seed, rack=rack, can=can | at).do("[PICK UP, can] (horizontal)").record
    assert not record.effect
    assert record.cause is not None
    assert record.cause.kind is CauseKind.NO_GRASP and record.cause.objects[0] == "can"
    assert "mm wide where the fingers would close" in record.cause.text


def test_a_hand_that_dips_goes_no_further_around_what_is_too_wide() -> None:
    pose = Pose(np.zeros(3), np.diag([1.0, -1.0, -1.0]))
    wide = Grasp(pose, 0.087, 0.085, GraspPose.HORIZONTAL, 0.0)
    fitting = replace(wide, width=0.06)
    assert [*variants(GraspSet((), (wide,), wide.width), pose)] == [wide]
    assert len([*variants(GraspSet((fitting,), (wide,), fitting.width), pose)]) > 1


@pytest.mark.parametrize("seed", SEEDS)
def test_a_filled_cup_is_taken_by_its_outside(seed: int) -> None:
    """What lies in it leaves no finger room at its rim, all around."""
    cup = CUP | {"diameter": 0.062, "height": 0.06}
    ball = {"kind": "sphere", "diameter": 0.034, "mass": 0.01, "inside": "cup"}
    state = episode(seed, cup=cup, ball=ball).must("[PICK UP, cup] (vertical)")
    assert state.states["ball"].inside == "cup"


@pytest.mark.parametrize("seed", range(3))
def test_thing_on_furniture_is_picked_up(seed: int) -> None:
    unit = UNIT | {"yaw_deg": -90, "drawers": drawers()}
    run = episode(seed, unit=unit, pen=PEN | {"on": "unit", "at": [0.45, 0.0]})
    assert run.must("[PICK UP, pen]").holding == "pen"


@pytest.mark.parametrize("seed", range(3))
def test_thing_in_an_open_drawer_is_picked_up(seed: int) -> None:
    unit = UNIT | {"yaw_deg": -90, "drawers": drawers(open=0.13)}
    box = BOX | {"inside": "unit", "size": [0.03, 0.03, 0.04], "at": [0.45, -0.17]}
    run = episode(seed, unit=unit, box=box)
    assert run.state.states["box"].inside == "unit"
    after = run.must("[PICK UP, box]")
    assert after.states["box"].inside is None


def test_thing_in_a_closed_drawer_is_not() -> None:
    unit = UNIT | {"yaw_deg": -90, "drawers": drawers()}
    box = {"kind": "box", "inside": "unit", "size": [0.03, 0.03, 0.04], "mass": 0.03}
    record = episode(unit=unit, box=box).do("[PICK UP, box]").record
    assert not record.effect and record.cause is not None
    assert "unit" in record.cause.objects
    assert record.displacement["box"] < 0.01


@pytest.mark.parametrize(
    ("thing", "kind"),
    [
        (BALL | {"diameter": 0.3, "mass": 0.3}, {CauseKind.NO_GRASP, CauseKind.UNREACHABLE}),
        (BOX | {"size": [0.15, 0.15, 0.15]}, {CauseKind.NO_GRASP}),
        (BALL | {"at": [0.80, 0.35]}, {CauseKind.UNREACHABLE}),
    ],
)
def test_what_cannot_be_grasped_is_a_result(thing: dict[str, object], kind: set[CauseKind]) -> None:
    record = episode(thing=thing).do("[PICK UP, thing]").record
    assert not record.effect
    assert record.cause is not None and record.cause.kind in kind
    assert record.cause.objects == ("thing",)


@pytest.mark.parametrize(
    ("plan", "text"),
    [
        (["[PICK UP, ball]", "[PICK UP, box]"], "the hand already holds ball"),
        (["[PICK UP, unit]"], "unit cannot be picked up"),
        (["[PICK UP, desk]"], "desk cannot be picked up"),
        (["[PUT ON, desk]"], "nothing is in the hand"),
        (["[PUT INTO, unit]"], "nothing is in the hand"),
        (["[PICK UP, ball]", "[OPEN, unit]"], "the hand still holds ball"),
        (["[PICK UP, ball]", "[PUT INTO, box]"], "box is no container"),
        (["[OPEN, box]"], "box has no movable part"),
    ],
)
def test_preconditions(plan: list[str], text: str) -> None:
    run = episode(ball=BALL | {"at": [0.4, 0.25]}, box=BOX | {"at": [0.35, -0.3]}, unit=UNIT | {
        "at": [0.45, -0.05], "yaw_deg": -90, "drawers": drawers()})  # fmt: skip
    run.must(*plan[:-1])
    record = run.do(plan[-1]).record
    assert not record.effect and record.steps == 0
    assert record.cause is not None
    assert record.cause.kind is CauseKind.PRECONDITION and record.cause.text == text


def test_part_must_be_named_where_there_are_several() -> None:
    unit = UNIT | {"yaw_deg": -90, "drawers": [{"name": "top"}, {"name": "low"}]}
    record = episode(unit=unit).do("[OPEN, unit]").record
    assert record.cause is not None
    assert record.cause.text == "unit has several movable parts: unit.top, unit.low"


def test_bystanders_stay_where_they_are() -> None:
    near = BALL | {"at": [0.40, 0.0], "diameter": 0.05}
    run = episode(ball=BALL | {"at": [0.40, 0.09]}, near=near)
    run.must("[PICK UP, ball]")
    assert run.done[-1].record.displacement["near"] < 0.03


FURNACE = OVEN | {
    "size": [0.30, 0.36, 0.28], "at": [0.55, 0.10], "yaw_deg": 180,
    "door": {"hinge": "right", "range_deg": 114, "open_deg": 112},
}  # fmt: skip
RACK = {"kind": "shelf", "size": [0.22, 0.36, 0.45], "mass": 6.0, "at": [0.52, 0.15],
        "yaw_deg": 180, "boards": ["lower", "middle", "top"]}  # fmt: skip
MUG = CUP | {"diameter": 0.075, "height": 0.10, "at": None}


@pytest.mark.parametrize("seed", range(3))
def test_comes_out_of_a_cabinet_through_the_front(seed: int) -> None:
    run = episode(seed, oven=FURNACE, mug=MUG | {"inside": "oven"})
    after = run.must("[PICK UP, mug] (horizontal)")
    assert after.states["mug"].in_hand and after.states["mug"].inside is None
    assert after.states["oven"].openness == run.done[-1].record.before.states["oven"].openness


@pytest.mark.parametrize("board", ["lower", "middle"])
def test_comes_off_a_covered_board(board: str) -> None:
    run = episode(rack=RACK, mug=MUG | {"on": f"rack.{board}"})
    after = run.must("[PICK UP, mug] (horizontal)")
    assert after.states["mug"].in_hand


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("diameter", [0.15, 0.17, 0.20])
@pytest.mark.slow
def test_the_hand_comes_down_along_a_wall_that_leans(diameter: float, seed: int) -> None:
    """Walls that lean by 37°, 42° and 49° from a foot of 6 cm."""
    bowl = {"kind": "bowl", "diameter": diameter, "height": 0.06, "foot_diameter": 0.06,
            "mass": 0.2, "at": [0.4, 0.1]}  # fmt: skip
    run = episode(seed, bowl=bowl)
    assert run.must("[PICK UP, bowl]").holding == "bowl"
    state = run.must("[PUT ON, desk]").states["bowl"]
    assert state.on == ("desk",) and not state.toppled


@pytest.mark.parametrize("yaw_deg", [0, 70, 200])
@pytest.mark.slow
def test_a_pan_too_wide_for_the_hand_is_taken_by_its_handle(tmp_path: Path, yaw_deg: int) -> None:
    """The handle is thin, and so high up that it lies off the object's own middle."""
    (tmp_path / "pan.xml").write_text(
        "<mujoco><worldbody><body name='pan'>"
        "<geom type='cylinder' size='0.09 0.018' pos='0 0 0.018'/>"
        "<geom type='box' size='0.075 0.009 0.006' pos='0.16 0 0.028'/>"
        "</body></worldbody></mujoco>"
    )
    pan = {"kind": "mjcf", "file": "pan.xml", "at": [0.42, 0.05], "mass": 0.4, "yaw_deg": yaw_deg}
    run = Episode(make_scene(tmp_path, pan=pan))
    assert run.must("[PICK UP, pan]").holding == "pan"
    assert run.must("[PUT ON, desk]").states["pan"].on == ("desk",)


@pytest.mark.parametrize(
    ("at", "quaternion"),
    [((0.40, 0.15), (0.7071, 0.0, -0.7071, 0.0)), ((0.42, 0.0), (0.7071, 0.7071, 0.0, 0.0))],
    ids=["facing the robot", "facing to the right"],
)
@pytest.mark.slow
def test_a_wide_vessel_that_lies_is_taken_through_its_mouth(
    at: tuple[float, float], quaternion: tuple[float, ...]
) -> None:
    """No two of its sides are near enough to each other, and a hand from above meets no rim."""
    cup = CUP | {"diameter": 0.095, "height": 0.09, "at": list(at), "quaternion": list(quaternion)}
    after = episode(cup=cup).must("[PICK UP, cup]", "[PUT ON, desk] (upright)")
    assert not after.states["cup"].toppled and after.states["cup"].on == ("desk",)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("far", [0.09, 0.10, 0.106])
@pytest.mark.slow
def test_what_lies_partly_under_the_edge_of_a_unit_comes_out_slanting(
    far: float, seed: int
) -> None:
    """Straight up it strikes the edge."""
    high = {"name": "high", "height": 0.08, "travel": 0.14, "open": far}
    unit = UNIT | {"at": [0.45, 0.24], "yaw_deg": -90, "size": [0.22, 0.22, 0.168]}
    unit |= {"drawers": [high, {"name": "low", "height": 0.07}]}
    ball = BALL | {"diameter": 0.04, "inside": "unit.high", "at": [0.45, 0.24 - far]}
    episode(seed, unit=unit, ball=ball).must("[PICK UP, ball]")


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.slow
def test_what_lies_round_before_a_wall_is_taken_by_a_hand_that_leans_aside(seed: int) -> None:
    """Straight down the outer finger would meet the unit, 26 mm behind the middle of the can."""
    high = {"name": "high", "height": 0.085, "travel": 0.15, "open": 0.15}
    unit = UNIT | {"at": [0.45, 0.24], "yaw_deg": -90, "size": [0.22, 0.22, 0.173]}
    unit |= {"drawers": [high, {"name": "low", "height": 0.07}]}
    can = {"kind": "cylinder", "diameter": 0.045, "height": 0.13, "mass": 0.12}
    can |= {"inside": "unit.high", "at": [0.45, 0.104], "quaternion": [0.7071068, 0, 0.7071068, 0]}
    episode(seed, unit=unit, can=can | {"rolling_friction": 0.002}).must("[PICK UP, can]")


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(("diameter", "length"), [(0.014, 0.114), (0.014, 0.15), (0.018, 0.19)])
def test_a_pen_that_was_said_to_be_in_a_cup_is_taken_out(
    diameter: float, length: float, seed: int
) -> None:
    """Nobody said how it stands there; it must not fall while the hand is on its way."""
    pen = PEN | {"diameter": diameter, "length": length, "inside": "cup"}
    del pen["at"]
    cup = CUP | {"diameter": 0.08, "height": 0.09, "mass": 0.4, "at": [0.42, 0.16]}
    state = episode(seed, cup=cup, pen=pen).must("[PICK UP, pen]")
    assert state.holding == "pen" and not state.states["cup"].toppled


@pytest.mark.parametrize("yaw", [180, 150])
def test_a_slanting_finger_does_not_come_down_on_the_rim_that_it_goes_along(yaw: float) -> None:
    """The hand slants below the handle above; straight back from a deep hold lies the rim."""
    handle = {"depth": 0.042}
    two = [{"name": "up", "travel": 0.16, "handle": handle},
           {"name": "low", "travel": 0.176, "open": 0.176, "handle": handle}]  # fmt: skip
    chest = UNIT | {"at": [0.494, 0.031], "yaw_deg": yaw, "size": [0.224, 0.2, 0.232]}
    cup = {"kind": "cup", "inside": "chest.low", "diameter": 0.062, "height": 0.088, "mass": 0.124}
    run = episode(chest=chest | {"drawers": two}, cup=cup)
    assert run.must("[PICK UP, cup]").states["chest"].openness["low"] > 0.97, "the hand pushed it"
    assert abs(run.state.states["cup"].tilt_deg) < 15.0


def _row(book: float, out: float, gap: float) -> dict[str, dict[str, object]]:
    """A book of some width that sticks ``out`` between two others, with gaps [m]."""
    low: dict[str, object] = {"kind": "box", "size": [0.11, 0.04, 0.12], "mass": 0.4}
    thing = low | {"size": [0.11, book, 0.12 + out], "mass": 0.25, "at": [0.4, 0.14]}
    away = (book + 0.04) / 2 + gap
    return {"thing": thing, "left": low | {"at": [0.4, 0.14 + away]},
            "right": low | {"at": [0.4, 0.14 - away]}}  # fmt: skip


def _in_cup(inside: float, deep: float, **thing: object) -> dict[str, dict[str, object]]:
    """Something in a cup of some width and height [m]."""
    cup: dict[str, object] = {"kind": "cup", "diameter": inside + 0.006, "wall": 0.003}
    cup |= {"height": deep, "mass": 0.3, "at": [0.38, 0.15]}
    return {"cup": cup, "thing": {"inside": "cup", "mass": 0.1, **thing}}


STICKING_OUT = {
    "book": _row(0.036, 0.015, 0.005),
    "jar": _in_cup(0.064, 0.06, kind="cylinder", diameter=0.05, height=0.074),
    "cup": _in_cup(0.066, 0.08, kind="cup", diameter=0.05, height=0.094),
    "stick": _in_cup(0.07, 0.066, kind="box", size=[0.024, 0.024, 0.05]),
    "egg": _in_cup(0.05, 0.026, kind="sphere", diameter=0.044, rolling_friction=0.003),
}


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("name", STICKING_OUT)
def test_what_sticks_out_little_is_held_by_the_fingertips(name: str, seed: int) -> None:
    """No finger gets as deep as where the thing is held firmly."""
    run = episode(seed, **STICKING_OUT[name])
    assert run.must("[PICK UP, thing]").holding == "thing"
    state = run.must("[PUT ON, desk]").states["thing"]
    assert state.on == ("desk",) and not state.toppled


@pytest.mark.parametrize("at", [[0.45, -0.25], [0.38, 0.15]])
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("diameter", "mass"), [(0.034, 0.015), (0.046, 0.008)])
def test_a_light_ball_is_held_as_low_as_the_hand_gets(
    diameter: float, mass: float, seed: int, at: list[float]
) -> None:
    """The hand is on the cup's rim before the pads get to the ball's middle. Much higher up than
    there the ball creeps out of them on the way.
    """
    objects = _in_cup(0.078, 0.06, kind="sphere", diameter=diameter)
    objects["thing"]["mass"] = mass
    objects["cup"]["at"] = at
    run = episode(seed, **objects)
    assert run.must("[PICK UP, thing]", "[PUT ON, desk]").states["thing"].on == ("desk",)


def test_what_hardly_sticks_out_is_obstructed_by_its_neighbours() -> None:
    record = episode(**_row(0.036, 0.007, 0.005)).do("[PICK UP, thing]").record
    assert not record.effect and record.cause is not None
    assert record.cause.kind is CauseKind.NO_GRASP
    assert {*record.cause.objects} == {"thing", "left", "right"}


NESTED = {
    "outer": CUP | {"diameter": 0.074, "wall": 0.003, "at": [0.40, 0.15]},
    "inner": {"kind": "cup", "diameter": 0.056, "height": 0.09, "mass": 0.08, "inside": "outer"},
}


@pytest.mark.parametrize("seed", [0, 1])
def test_a_cup_is_not_taken_by_the_walls_of_two(seed: int) -> None:
    """A finger in the inner cup presses it on the outer one's wall, and is not at that."""
    run = episode(seed, **NESTED)
    after = run.must("[PICK UP, outer]")
    assert after.holding == "outer" and after.states["inner"].inside == "outer"


def test_two_walls_between_the_fingers_are_no_slip() -> None:
    wide = NESTED["outer"] | {"diameter": 0.1}
    inner = NESTED["inner"] | {"diameter": 0.085}
    record = episode(outer=wide, inner=inner).do("[PICK UP, outer] (vertical)").record
    assert record.cause is not None and record.cause.kind is CauseKind.NO_GRASP
    assert record.cause.objects == ("inner", "outer")
    assert episode(outer=wide).must("[PICK UP, outer] (vertical)").holding == "outer"


@pytest.mark.parametrize("clearance", [0.18, 0.21, 0.24])
@pytest.mark.parametrize("x", [0.41, 0.46])
@pytest.mark.slow
def test_a_level_hand_takes_a_thing_out_from_under_whatever_is_above_it(
    x: float, clearance: float
) -> None:
    """The way it came in: there is no room to raise it."""
    roof = {"kind": "box", "size": [0.16, 0.276, 0.012], "at": [0.46, 0.04, 0.166 + clearance],
            "fixed": True}  # fmt: skip
    bottle = {"kind": "cylinder", "diameter": 0.05, "height": 0.14, "mass": 0.15, "at": [x, 0.03]}
    run = episode(roof=roof, bottle=bottle)
    after = run.must("[PICK UP, bottle] (horizontal)")
    assert after.holding == "bottle"
    run.must("[PUT ON, desk] (at 0.340 -0.280)")


@pytest.mark.parametrize(("mass", "slips"), [(0.3, False), (1.0, True), (4.2, True)])
def test_what_is_too_heavy_for_its_friction_is_said_to_be(mass: float, slips: bool) -> None:
    ingot = {"kind": "cylinder", "diameter": 0.06, "height": 0.2, "mass": mass, "friction": 0.1,
             "slippery": True, "at": [0.40, 0.20]}  # fmt: skip
    record = episode(ingot=ingot).do("[PICK UP, ingot]").record
    assert record.effect is not slips
    if slips:
        assert record.cause is not None and record.cause.kind is CauseKind.SLIP
        assert f"{mass:.2f} kg" in record.cause.text and "mm wide" not in record.cause.text

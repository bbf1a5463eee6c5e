"""PUT ON and PUT INTO in physics."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from etot_cli.skills.action import Action, Keepout, Verb, parse_plan
from etot_cli.skills.motion.motion import PhaseEnd, PhaseTrace, Trace
from etot_cli.skills.placements.motion import put_outcome
from etot_cli.world.spatial import holds
from etot_cli.world.state import CauseKind, ObjectState
from tests.skills.helpers import BALL, BOX, CUP, OVEN, PEN, UNIT, Episode, drawers, episode
from tests.world.helpers import make_scene
from tests.world.test_imported import DOOR, LOCKER

SEEDS = range(3)


def long_axis(state: ObjectState) -> np.ndarray:
    """Where a rod's point is, (3,)."""
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, np.array(state.quaternion))
    return matrix.reshape(3, 3)[:, 0]


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("thing", [BALL, BOX, PEN, CUP], ids=lambda item: str(item["kind"]))
def test_put_on_the_desk(thing: dict[str, object], seed: int) -> None:
    run = episode(seed, thing=thing)
    after = run.must("[PICK UP, thing]", "[PUT ON, desk]").states["thing"]
    assert after.on == ("desk",)
    assert not after.in_hand and not after.toppled and not after.lost and after.reachable


@pytest.mark.parametrize("seed", SEEDS)
def test_a_place_near_the_edge_is_taken_where_it_is_asked_for(seed: int) -> None:
    """10 mm of the desk remain beside it."""
    there = np.array([0.30, -0.565])
    run = episode(seed, thing=BOX | {"size": [0.05, 0.05, 0.05]})
    after = run.must("[PICK UP, thing]", "[PUT ON, desk] (at 0.300 -0.565)").states["thing"]
    assert after.on == ("desk",) and not after.lost
    assert np.linalg.norm(np.array(after.position[:2]) - there) < 0.025


@pytest.mark.slow
def test_what_lies_is_stood_up_where_that_is_asked_for() -> None:
    lying = {"kind": "cylinder", "diameter": 0.05, "height": 0.12, "mass": 0.15}
    lying |= {"at": [0.4, -0.15, 0.155], "quaternion": [0.7071068, 0, 0.7071068, 0]}
    run = episode(0, thing=lying)
    assert run.must("[PICK UP, thing]", "[PUT ON, desk]").states["thing"].toppled
    after = run.must("[PICK UP, thing]", "[PUT ON, desk] (upright)").states["thing"]
    assert after.on == ("desk",) and not after.toppled


TURNED_OVER = {"at": [0.38, 0.18], "quaternion": [0.0, 1.0, 0.0, 0.0]}
GLASS = {"kind": "cup", "diameter": 0.066, "height": 0.11, "mass": 0.2}
BOTTLE = {"kind": "cylinder", "diameter": 0.05, "height": 0.15, "mass": 0.25}
SHORT = {"kind": "cylinder", "diameter": 0.067, "height": 0.093, "mass": 0.25}


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("thing", [GLASS, BOTTLE, SHORT], ids=["glass", "bottle", "short"])
@pytest.mark.slow
def test_what_stands_upside_down_is_turned_over_by_a_level_hand(
    thing: dict[str, Any], seed: int
) -> None:
    run = episode(seed, thing=thing | TURNED_OVER)
    after = run.must("[PICK UP, thing] (horizontal)", "[PUT ON, desk] (upright)").states["thing"]
    assert after.on == ("desk",) and after.tilt_deg < 5


def test_a_hand_from_above_would_have_to_be_below_what_it_turns_over() -> None:
    run = episode(thing=GLASS | TURNED_OVER)
    run.must("[PICK UP, thing] (vertical)")
    cause = run.do("[PUT ON, desk] (upright)").record.cause
    assert cause is not None and cause.kind is CauseKind.UNREACHABLE
    assert cause.text == "the hand has no room on desk as it holds thing"


def test_a_vessel_that_stands_upside_down_takes_nothing_in() -> None:
    run = episode(glass=GLASS | TURNED_OVER, ball=BALL | {"at": [0.35, -0.2], "diameter": 0.04})
    run.must("[PICK UP, ball]")
    cause = run.do("[PUT INTO, glass]").record.cause
    assert cause is not None and cause.text == "glass stands upside down and takes nothing in"


@pytest.mark.parametrize("turn", [[0.5, 0.5, 0.5, 0.5], [0.5, -0.5, 0.5, -0.5]])
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.slow
def test_what_hangs_in_the_hand_is_not_put_on_its_head(turn: list[float], seed: int) -> None:
    """The drawer's walls leave room for a hand near one end alone, which the other hangs from."""
    chest = {"kind": "drawer_unit", "at": [0.50, -0.14], "yaw_deg": 165, "size": [0.26, 0.26, 0.17],
             "mass": 3, "drawers": [
                 {"name": "top", "travel": 0.20, "open": 0.20, "height": 0.085},
                 {"name": "bottom", "travel": 0.0}]}  # fmt: skip
    lying = {"inside": "chest", "at": [0.315, -0.09], "quaternion": turn}
    run = episode(seed, chest=chest, bottle=BOTTLE | lying | {"rolling_friction": 0.002})
    after = run.must("[PICK UP, bottle]", "[PUT ON, desk]").states["bottle"]
    assert after.on == ("desk",) and after.tilt_deg < 100
    after = run.must("[PICK UP, bottle]", "[PUT ON, desk] (upright)").states["bottle"]
    assert after.on == ("desk",) and after.tilt_deg < 5


def test_a_standing_rod_is_laid_down_by_a_hand_thicker_than_it() -> None:
    """The hand points down along the pen, so that flat on the desk it would have to be level."""
    # It leans on the rim: 10° in a cup of 70 mm.
    leaning = {"inside": "cup", "quaternion": [0.643, 0, 0.766, 0], "at": [0.415, 0.10, 0.219]}
    cup = CUP | {"at": [0.42, 0.10], "diameter": 0.07, "height": 0.10, "mass": 0.35}
    run = episode(cup=cup, pen=PEN | leaning)
    after = run.must("[PICK UP, pen]", "[PUT ON, desk]").states["pen"]
    assert after.on == ("desk",) and abs(long_axis(after)[2]) < 0.1


@pytest.mark.slow
def test_what_a_level_hand_took_from_a_board_is_let_go_just_above_the_desk() -> None:
    """Its wrist is thicker than half the mug is high."""
    shelf = {"kind": "shelf", "size": [0.22, 0.32, 0.36], "mass": 4.0, "at": [0.6, 0.0],
             "yaw_deg": 180, "boards": ["lower", "middle", "top"]}  # fmt: skip
    mug = {"kind": "cup", "diameter": 0.07, "height": 0.08, "mass": 0.2, "on": "shelf.middle"}
    run = episode(shelf=shelf, mug=mug)
    after = run.must("[PICK UP, mug] (horizontal)", "[PUT ON, desk]").states["mug"]
    assert after.on == ("desk",) and not after.toppled


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("thing", [BOX, PEN, CUP], ids=lambda item: str(item["kind"]))
@pytest.mark.slow
def test_put_on_furniture(thing: dict[str, object], seed: int) -> None:
    unit = UNIT | {"at": [0.44, 0.0], "yaw_deg": -90, "drawers": drawers()}
    run = episode(seed, unit=unit, thing=thing | {"at": [0.38, 0.27]})
    after = run.must("[PICK UP, thing]", "[PUT ON, unit]").states["thing"]
    assert after.on == ("unit",)
    assert not after.toppled


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("side", [1, -1])
def test_ball_into_a_cup(seed: int, side: int) -> None:
    run = episode(
        seed,
        ball=BALL | {"at": [0.38, 0.15 * side], "diameter": 0.06},
        cup=CUP | {"at": [0.42, -0.2 * side]},
    )
    after = run.must("[PICK UP, ball]", "[PUT INTO, cup]")
    assert after.states["ball"].inside == "cup"
    assert not after.states["cup"].toppled
    # Fingers that open inside a cup must not take it along.
    assert after.holding is None
    assert after.states["cup"].on == ("desk",)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("yaw", [0, 80])
@pytest.mark.slow
def test_pen_stands_in_a_cup(seed: int, yaw: float) -> None:
    """It lies on the desk, and goes in point down."""
    cup = CUP | {"diameter": 0.08, "height": 0.09, "mass": 0.2, "at": [0.42, -0.15]}
    run = episode(seed, pen=PEN | {"at": [0.36, 0.2], "yaw_deg": yaw}, cup=cup)
    after = run.must("[PICK UP, pen]", "[PUT INTO, cup]")
    assert after.states["pen"].inside == "cup"
    assert not after.states["cup"].toppled
    assert long_axis(after.states["pen"])[2] < -0.6


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    "thing",
    [
        {"kind": "cylinder", "diameter": 0.05, "height": 0.11},
        {"kind": "cylinder", "diameter": 0.06, "height": 0.12},
        {"kind": "box", "size": [0.045, 0.045, 0.11]},
    ],
    ids=["can", "larger can", "block"],
)
def test_what_is_too_high_for_a_drawer_stands_in_the_open_part_of_it(
    thing: dict[str, Any], seed: int
) -> None:
    """Beside the case, under which it does not get, and not pressed against that."""
    chest = {"kind": "drawer_unit", "size": [0.24, 0.2, 0.1], "mass": 2.5, "yaw_deg": -90}
    chest |= {"at": [0.46, 0.24], "drawers": [{"name": "only", "travel": 0.14, "open": 0.14}]}
    run = episode(seed, chest=chest, thing=thing | {"mass": 0.12, "at": [0.36, -0.22]})
    after = run.must("[PICK UP, thing]", "[PUT INTO, chest] (upright)").states["thing"]
    assert after.inside == "chest" and not after.toppled
    contacts = run.done[-1].record.contacts
    assert all("chest" not in (one.first, one.second) or one.peak_force < 15.0 for one in contacts)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(("ball", "mouth"), [(0.066, 0.057), (0.07, 0.057), (0.08, 0.042)])
def test_a_ball_lies_on_the_mouth_of_a_mug(ball: float, mouth: float, seed: int) -> None:
    mug = {"kind": "cup", "diameter": mouth + 0.008, "wall": 0.004, "height": 0.085, "mass": 0.3}
    run = episode(seed, mug=mug | {"at": [0.42, -0.14]}, ball=BALL | {"diameter": ball})
    after = run.must("[PICK UP, ball]", "[PUT ON, mug]").states
    assert after["ball"].on == ("mug",) and not after["mug"].toppled


def test_what_stands_on_the_floor_of_a_bowl_is_not_on_it() -> None:
    bowl = {"kind": "bowl", "diameter": 0.14, "height": 0.03, "mass": 0.3, "at": [0.42, -0.14]}
    run = episode(bowl=bowl, block=BOX | {"size": [0.04, 0.04, 0.07], "at": [0.38, 0.2]})
    run.must("[PICK UP, block]")
    cause = run.do("[PUT ON, bowl]").record.cause
    assert cause is not None and cause.kind is CauseKind.NO_ROOM


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(("length", "width"), [(0.13, 0.07), (0.17, 0.09)])
def test_a_pen_that_stands_on_its_blunt_end_goes_into_a_cup_as_it_is(
    length: float, width: float, seed: int
) -> None:
    """The hand came down along it, and would have to point up to put it in with its point down."""
    cup = CUP | {"diameter": width, "height": 0.09, "mass": 0.3}
    pen = {"length": length, "inside": "first", "quaternion": [0.7071068, 0, -0.7071068, 0]}
    run = episode(
        seed,
        first=cup | {"at": [0.42, 0.15]},
        second=cup | {"at": [0.42, -0.15]},
        pen={key: value for key, value in (PEN | pen).items() if key != "at"},
    )
    after = run.must("[PICK UP, pen] (vertical)", "[PUT INTO, second]")
    assert after.states["pen"].inside == "second" and not after.states["second"].toppled


@pytest.mark.parametrize("seed", SEEDS)
def test_a_standing_pen_that_is_held_from_the_side_is_laid_down_from_above(seed: int) -> None:
    """Whichever way its point is: laid down the other way round, the hand would be under it."""
    cup = CUP | {"at": [0.42, 0.10], "diameter": 0.05, "height": 0.10, "mass": 0.35}
    tray = BOX | {"size": [0.2, 0.16, 0.012], "mass": 0.5, "at": [0.4, -0.2]}
    pen = {key: value for key, value in PEN.items() if key != "at"} | {"inside": "cup"}
    run = episode(seed, cup=cup, pen=pen, tray=tray)
    after = run.must("[PICK UP, pen] (horizontal)", "[PUT ON, tray]").states["pen"]
    assert after.on == ("tray",) and abs(long_axis(after)[2]) < 0.1


@pytest.mark.parametrize(
    "thing",
    [
        {"kind": "box", "size": [0.16, 0.02, 0.01], "mass": 0.04, "at": [0.36, 0.2]},
        {"kind": "cylinder", "diameter": 0.012, "height": 0.16, "mass": 0.03,
         "at": [0.36, 0.2, 0.1365], "quaternion": [0.7071068, 0.0, 0.7071068, 0.0]},
    ],
    ids=["spoon", "stick"],
)  # fmt: skip
@pytest.mark.slow
def test_long_things_without_a_point_stand_in_a_cup_too(thing: dict[str, Any]) -> None:
    cup = CUP | {"diameter": 0.08, "height": 0.09, "mass": 0.3, "at": [0.42, -0.15]}
    run = episode(thing=thing, cup=cup)
    assert run.must("[PICK UP, thing]", "[PUT INTO, cup]").states["thing"].inside == "cup"


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("thing", [BOX | {"size": [0.04, 0.04, 0.04]}, BALL | {"diameter": 0.05}],
                         ids=lambda item: str(item["kind"]))  # fmt: skip
@pytest.mark.slow
def test_put_into_an_open_drawer(thing: dict[str, object], seed: int) -> None:
    unit = UNIT | {"at": [0.45, 0.05], "yaw_deg": -90, "drawers": drawers(open=0.13)}
    run = episode(seed, unit=unit, thing=thing | {"at": [0.35, -0.3]})
    after = run.must("[PICK UP, thing]", "[PUT INTO, unit]")
    assert after.states["thing"].inside == "unit"
    assert after.states["unit"].openness["top"] > 0.5


@pytest.mark.slow
def test_closed_drawer_takes_nothing() -> None:
    unit = UNIT | {"at": [0.45, 0.05], "yaw_deg": -90, "drawers": drawers()}
    run = episode(unit=unit, box=BOX | {"size": [0.04, 0.04, 0.04], "at": [0.35, -0.25]})
    run.must("[PICK UP, box]")
    record = run.do("[PUT INTO, unit]").record
    assert record.after.states["box"].inside is None
    assert record.after.states["unit"].openness["top"] < 0.1


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.slow
def test_ball_on_the_mouth_keeps_the_pen_out(seed: int) -> None:
    """The apple as wide as the mouth stays; the pen does not get in."""
    cup = CUP | {"diameter": 0.092, "wall": 0.008, "height": 0.079, "at": [0.42, -0.2]}
    apple = {"kind": "sphere", "diameter": 0.085, "mass": 0.15, "on": "cup"}
    run = episode(seed, cup=cup, apple=apple, pen=PEN | {"at": [0.36, 0.2]})
    run.must("[PICK UP, pen]")
    record = run.do("[PUT INTO, cup]").record
    assert record.after.states["pen"].inside is None


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.slow
def test_light_cup_with_a_narrow_foot_topples_under_the_pen(seed: int) -> None:
    cup = CUP | {"diameter": 0.044, "height": 0.075, "mass": 0.012, "wall": 0.002,
                 "floor": 0.002, "foot_diameter": 0.031, "at": [0.42, -0.2]}  # fmt: skip
    run = episode(seed, cup=cup, pen=PEN | {"mass": 0.025, "at": [0.36, 0.2], "length": 0.175})
    run.must("[PICK UP, pen]")
    record = run.do("[PUT INTO, cup]").record
    assert record.after.states["cup"].toppled
    assert record.after.states["pen"].inside is None


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.slow
def test_safe_place_keeps_clear_of_the_discs(seed: int) -> None:
    run = episode(seed, ball=BALL)
    run.must("[PICK UP, ball]")
    plain = run.simulated.perform(run.snapshot, Action(Verb.PUT_ON, "desk"))
    x, y, _ = plain.record.after.states["ball"].position
    disc = Keepout(x, y, 0.15)
    action = Action(Verb.PUT_ON, "desk", safe=True, keepout=(disc,))
    record = run.simulated.perform(run.snapshot, action).record
    assert record.effect
    u, v, _ = record.after.states["ball"].position
    assert np.hypot(u - x, v - y) > disc.radius + 0.03


@pytest.mark.slow
@pytest.mark.parametrize("height", [0.26, 0.28, 0.30])
def test_a_high_top_is_used_as_far_as_the_hand_gets_away_again(height: float) -> None:
    platform = BOX | {"at": [0.5, 0.0], "size": [0.2, 0.4, height], "mass": 3.0}
    run = episode(0, platform=platform, thing=BOX | {"at": [0.3, 0.3]})
    after = run.must("[PICK UP, thing]", "[PUT ON, platform]").states["thing"]
    assert after.on == ("platform",)


def test_full_surface_has_no_room() -> None:
    unit = UNIT | {"at": [0.44, 0.0], "yaw_deg": -90, "drawers": drawers()}
    lid = {"kind": "box", "on": "unit", "size": [0.17, 0.21, 0.02], "mass": 0.3}
    run = episode(unit=unit, lid=lid, box=BOX | {"at": [0.35, 0.3]})
    run.must("[PICK UP, box]")
    record = run.do("[PUT ON, unit]").record
    assert not record.effect
    assert record.cause is not None and record.cause.kind is CauseKind.NO_ROOM
    assert record.after.holding == "box", "a refused put leaves the hand as it was"


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.slow
def test_two_things_end_up_apart(seed: int) -> None:
    run = episode(seed, one=BOX, two=BALL)
    after = run.must("[PICK UP, one]", "[PUT ON, desk]", "[PICK UP, two]", "[PUT ON, desk]")
    one, two = (np.array(after.states[name].position[:2]) for name in ("one", "two"))
    assert np.linalg.norm(one - two) > 0.06


# -- through a front -------------------------------------------------------------------------------

FURNACE = OVEN | {
    "size": [0.30, 0.36, 0.28], "at": [0.40, 0.42], "yaw_deg": -90,
    "door": {"hinge": "right", "range_deg": 114, "open_deg": 110},
}  # fmt: skip
MUG = CUP | {"diameter": 0.075, "height": 0.10, "at": [0.42, -0.15]}
RACK = {"kind": "shelf", "size": [0.22, 0.36, 0.45], "mass": 6.0, "at": [0.52, 0.15],
        "yaw_deg": 180, "boards": ["lower", "middle", "top"]}  # fmt: skip


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    "thing",
    [MUG, BOX | {"size": [0.05, 0.05, 0.12]}, BOX | {"size": [0.05, 0.05, 0.035]}],
    ids=["mug", "box", "lower than half a wrist"],
)
@pytest.mark.slow
def test_goes_into_a_cabinet_from_the_front(thing: dict[str, Any], seed: int) -> None:
    run = episode(seed, oven=FURNACE, thing=thing | {"at": [0.42, -0.15]})
    after = run.must("[PICK UP, thing] (horizontal)", "[PUT INTO, oven]")
    state = after.states["thing"]
    assert state.inside == "oven" and not state.toppled
    door = after.infos["oven"].parts[0]
    assert after.openness(door) > 0.85, "the door stays as it was"


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.slow
def test_goes_in_well_above_the_edge_of_a_front(seed: int) -> None:
    """So that what has slid down in the fingers on the way there does not stumble over it."""
    can = {"kind": "cylinder", "diameter": 0.05, "height": 0.12, "mass": 0.15, "at": [0.42, -0.15]}
    run = episode(seed, keep_frames=True, oven=FURNACE, can=can)
    run.must("[PICK UP, can] (horizontal)")
    edge = run.must("[PUT INTO, oven]").states["oven"].position[1] - FURNACE["size"][0] / 2
    trajectory = run.done[-1].trajectory
    assert trajectory is not None
    model = run.simulated.world.model
    first = int(model.jnt_qposadr[model.body("can").jntadr[0]])
    way = np.array(trajectory.qpos)[:, first : first + 3]
    over = way[np.searchsorted(way[:, 1], edge), 2] - way[-1, 2]
    assert 0.010 < over < 0.03


@pytest.mark.slow
def test_what_lies_is_stood_up_where_the_hand_has_to_come_level() -> None:
    """From above it has no room under the roof."""
    can = {"kind": "cylinder", "diameter": 0.05, "height": 0.12, "mass": 0.15}
    on_its_side = can | {"at": [0.36, 0.30], "quaternion": [0.7071, 0.7071, 0.0, 0.0]}
    low = RACK | {"size": [0.18, 0.34, 0.34], "at": [0.56, 0.0], "boards": ["lower", "top"]}
    after = episode(rack=low, can=on_its_side).must("[PICK UP, can]", "[PUT ON, rack.lower]")
    assert after.states["can"].on == ("rack.lower",) and not after.states["can"].toppled


@pytest.mark.slow
def test_goes_into_a_cabinet_from_a_file(tmp_path: Path) -> None:
    (tmp_path / "locker.xml").write_text(LOCKER.format(axis="0 0 1"))
    locker = {"kind": "mjcf", "file": "locker.xml", "at": [0.40, 0.42], "yaw_deg": -90,
              "fixed": True, "parts": {"door": DOOR["door"] | {"open_deg": 110}}}  # fmt: skip
    scene = make_scene(tmp_path, locker=locker, mug=MUG)
    run = Episode(scene)
    after = run.must("[PICK UP, mug] (horizontal)", "[PUT INTO, locker]")
    assert after.states["mug"].inside == "locker"


@pytest.mark.slow
def test_hand_from_above_has_no_room_in_a_cabinet() -> None:
    run = episode(oven=FURNACE, mug=MUG)
    run.must("[PICK UP, mug] (vertical)")
    record = run.do("[PUT INTO, oven]").record
    assert record.cause is not None and record.cause.kind is CauseKind.NO_ROOM
    assert "oven" in record.cause.objects
    assert record.after.holding == "mug"


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("board", ["lower", "middle", "top"])
@pytest.mark.slow
def test_goes_on_every_board_of_a_shelf(board: str, seed: int) -> None:
    run = episode(seed, rack=RACK, mug=MUG | {"at": [0.36, -0.25]})
    after = run.must("[PICK UP, mug] (horizontal)", f"[PUT ON, rack.{board}]")
    assert after.states["mug"].on == (f"rack.{board}",)
    assert not after.states["mug"].toppled


BRIDGE = """<mujoco model="bridge"><worldbody><body name="bridge">
<geom type="box" size="0.08 0.008 0.12" pos="0 0.13 0.12"/>
<geom type="box" size="0.08 0.008 0.12" pos="0 -0.13 0.12"/>
<geom type="box" size="0.08 0.138 0.006" pos="0 0 0.246"/>
</body></worldbody></mujoco>"""
"""A deck on two walls, 0.24 m above the desk."""

CAN = {"kind": "cylinder", "diameter": 0.06, "height": 0.07, "mass": 0.12}
"""Something to stand another thing on."""


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    ("place", "furniture"),
    [
        ({"on": "place.lower", "at": [0.46, 0.15]}, RACK | {"yaw_deg": 190}),
        ({"inside": "place", "at": [0.40, 0.36]}, FURNACE),
    ],
    ids=["board", "cupboard"],
)
@pytest.mark.slow
def test_goes_on_top_of_what_stands_under_a_roof(
    place: dict[str, Any], furniture: dict[str, Any], seed: int
) -> None:
    cup = CAN | {"diameter": 0.05, "at": [0.36, -0.25]}
    run = episode(seed, place=furniture, can=CAN | place, cup=cup)
    after = run.must("[PICK UP, cup] (horizontal)", "[PUT ON, can]")
    assert after.states["cup"].on == ("can",)
    assert not (after.states["cup"].toppled or after.states["can"].toppled)
    assert run.done[-1].record.displacement["can"] < 0.01


@pytest.mark.slow
def test_what_is_too_tall_for_the_room_over_it_is_refused() -> None:
    tall = CAN | {"diameter": 0.05, "height": 0.17, "at": [0.36, -0.25]}
    run = episode(rack=RACK, can=CAN | {"on": "rack.lower"}, tall=tall)
    run.must("[PICK UP, tall] (horizontal)")
    record = run.do("[PUT ON, can]").record
    assert record.cause is not None and record.cause.kind is CauseKind.NO_ROOM


@pytest.mark.slow
def test_what_is_too_tall_for_a_board_is_refused() -> None:
    tall = BOX | {"size": [0.05, 0.05, 0.24], "at": [0.36, -0.25]}
    run = episode(rack=RACK, tall=tall)
    run.must("[PICK UP, tall] (horizontal)")
    record = run.do("[PUT ON, rack.lower]").record
    assert record.cause is not None and record.cause.kind is CauseKind.NO_ROOM


@pytest.mark.parametrize(
    "where",
    ["left of cup", "behind cup, near cup", "between cup and ball", "at left", "at 0.35 0.1"],
)
@pytest.mark.slow
def test_put_beside_things(where: str) -> None:
    run = episode(
        0,
        box=BOX | {"at": [0.30, -0.30]},
        cup=CUP | {"at": [0.42, -0.15]},
        ball=BALL | {"at": [0.42, 0.25]},
    )
    action = parse_plan(f"[PUT ON, desk] ({where})")[0]
    after = run.must("[PICK UP, box]", str(action))
    assert all(holds(item, "box", after) for item in action.where)
    assert after.states["box"].on == ("desk",)


@pytest.mark.parametrize("where", ["next to ball", "left of ball", "behind ball"])
@pytest.mark.slow
def test_put_beside_things_in_a_container(where: str) -> None:
    crate = {"kind": "bowl", "at": [0.45, -0.15], "diameter": 0.24, "height": 0.06, "mass": 0.3}
    small = {"diameter": 0.04, "mass": 0.03, "inside": "crate", "at": [0.47, -0.15]}
    run = episode(0, box=BOX | {"at": [0.36, 0.2]}, crate=crate, ball=BALL | small)
    action = parse_plan(f"[PUT INTO, crate] ({where})")[0]
    after = run.must("[PICK UP, box]", str(action))
    assert all(holds(item, "box", after) for item in action.where)
    assert after.states["box"].inside == "crate"


@pytest.mark.slow
def test_a_deep_cup_is_carried_with_what_is_in_it() -> None:
    ball = BALL | {"inside": "cup", "diameter": 0.06, "at": None}
    after = episode(cup=CUP, ball=ball).must("[PICK UP, cup]", "[PUT ON, desk]")
    assert after.states["cup"].on == ("desk",) and after.states["ball"].inside == "cup"


@pytest.mark.slow
def test_what_slips_its_last_centimetres_into_place_is_there() -> None:
    """Placements are told by where the object is; a slip elsewhere stays a failure."""
    run = episode(ball=BALL, cup=CUP)
    run.must("[PICK UP, ball]")
    before, belief = run.state, run.simulated.believe(run.snapshot)
    (action,) = parse_plan("[PUT INTO, cup]")
    after = run.must("[PUT INTO, cup]")

    def slipped(phase: str) -> Trace:
        return Trace((PhaseTrace(phase, PhaseEnd.SLIPPED, 0.0, 1.0, 0.0, ()),))

    assert put_outcome(belief, action, slipped("lower"), after).effect
    assert not put_outcome(belief, action, slipped("lower"), before).effect
    assert not put_outcome(belief, action, slipped("transit"), after).effect


@pytest.mark.parametrize("x", [0.28, 0.29])
@pytest.mark.parametrize("height", [0.09, 0.10])
@pytest.mark.slow
def test_an_arm_that_meets_what_stands_before_a_front_bends_otherwise(
    x: float, height: float
) -> None:
    """Next to how it stands after the can is up there, the forearm meets the chest."""
    rack = {"kind": "shelf", "at": [0.40, 0.42], "yaw_deg": -90, "size": [0.18, 0.3, 0.2],
            "boards": ["low", "top"]}  # fmt: skip
    chest = UNIT | {"at": [0.58, -0.05], "yaw_deg": 180, "size": [0.2, 0.18, 0.12],
                    "drawers": [{"name": "d", "travel": 0.12,
                                 "handle": {"width": 0.07, "depth": 0.04}}]}  # fmt: skip
    rod = {"kind": "cylinder"}
    run = episode(
        rack=rack, chest=chest,
        vial=rod | {"at": [0.42, -0.26], "diameter": 0.035, "height": height, "mass": 0.05},
        ball=BALL | {"at": [x, -0.10], "diameter": 0.05, "mass": 0.05},
        can=rod | {"at": [0.40, 0.16], "diameter": 0.06, "height": 0.09, "mass": 0.2},
        block={"kind": "box", "on": "rack.low", "at": [0.30, 0.42], "size": [0.06, 0.08, 0.08],
               "mass": 0.1},
    )  # fmt: skip
    run.must("[PICK UP, can]", "[PUT ON, rack.top]", "[PICK UP, vial] (horizontal)")
    after = run.must("[PUT ON, rack.low]")
    assert after.states["vial"].on == ("rack.low",)
    assert after.states["block"].on == ("rack.low",)


@pytest.mark.parametrize(
    ("yaw", "x", "place"),
    [(0, 0.46, "desk"), (-35, 0.48, "desk"), (90, 0.46, "desk"), (20, 0.46, "plate")],
)
@pytest.mark.slow
def test_a_level_hand_puts_a_thing_under_whatever_hangs_over_the_place(
    yaw: float, x: float, place: str, tmp_path: Path
) -> None:
    """From the side that is open: no front is marked there, and from above there is only a roof."""
    (tmp_path / "bridge.xml").write_text(BRIDGE)
    bridge = {"kind": "mjcf", "file": "bridge.xml", "at": [x, 0.04], "yaw_deg": yaw, "fixed": True}
    plate = {"kind": "cylinder", "diameter": 0.14, "height": 0.012, "mass": 0.3}
    where = [x, 0.04] if place == "plate" else [0.30, 0.32]
    can = {"kind": "cylinder", "diameter": 0.05, "height": 0.12, "mass": 0.15, "at": [0.34, -0.28]}
    run = Episode(make_scene(tmp_path, bridge=bridge, plate=plate | {"at": where}, can=can))
    run.must("[PICK UP, can] (horizontal)")
    told = "" if place == "plate" else f" (at {x:.3f} 0.030)"
    after = run.must(f"[PUT ON, {place}]{told}")
    assert after.states["can"].on == (place,) and not after.states["can"].toppled
    assert np.hypot(*np.subtract(after.states["can"].position[:2], [x, 0.035])) < 0.05


def test_from_above_it_is_the_roof_that_is_in_the_way() -> None:
    roof = {"kind": "box", "size": [0.2, 0.25, 0.02], "at": [0.46, 0.04, 0.38], "fixed": True}
    run = episode(roof=roof, ball=BALL | {"at": [0.34, -0.28]})
    run.must("[PICK UP, ball]")
    record = run.do("[PUT ON, desk] (at 0.460 0.030)").record
    assert record.cause is not None and record.cause.kind is CauseKind.NO_ROOM
    assert record.cause.objects == ("roof", "ball")

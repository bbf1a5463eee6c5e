"""PUT ON a place at which what comes later has room, in physics."""

from __future__ import annotations

from time import process_time

import pytest

from etot_cli.skills.action import read_whereabouts
from etot_cli.world.spatial import holds
from etot_cli.world.state import CauseKind, SceneState
from tests.skills.helpers import BOX, Episode, episode

SEEDS = range(3)
SOON = 25
"""How many times as long as to pick something up an action may take that has no place; 9 to 11 were
measured."""
CUP = {"kind": "cup", "at": [0.42, -0.28], "diameter": 0.075, "height": 0.09, "mass": 0.15}
CHEST = {"kind": "box", "at": [0.45, 0.15], "size": [0.16, 0.28, 0.08], "mass": 2, "fixed": True}
MAT = {"kind": "box", "at": [0.45, 0.05], "size": [0.22, 0.40, 0.008], "mass": 0.4}


def stands(state: SceneState, name: str, where: str) -> bool:
    wanted = read_whereabouts(where)
    assert wanted is not None
    return holds(wanted, name, state)


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_room_for_what_comes_to_its_side_on_a_narrow_top(seed: int) -> None:
    box = BOX | {"on": "chest", "at": [0.45, 0.24]}
    run = episode(seed, chest=CHEST, box=box, cup=CUP)
    run.must("[PICK UP, box]", "[PUT ON, chest] (room for cup left of box)")
    after = run.must("[PICK UP, cup]", "[PUT ON, chest] (left of box)")
    assert stands(after, "cup", "left of box")
    assert after.states["cup"].on == after.states["box"].on == ("chest",)


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_room_for_two_that_follow_in_a_row(seed: int) -> None:
    """With its middle in the middle of the mat the second and the third do not both fit in."""
    part = {"kind": "cylinder", "at": [0.30, -0.30], "diameter": 0.04, "height": 0.05, "mass": 0.08}
    first, second = BOX | {"at": [0.30, -0.25]}, BOX | {"at": [0.30, 0.35]}
    mat = MAT | {"size": [0.14, 0.32, 0.008]}
    run = episode(seed, mat=mat, first=first, second=second, part=part)
    both = "room for second left of first, room for part between second and first"
    run.must("[PICK UP, first]", f"[PUT ON, mat] ({both})", "[PICK UP, second]")
    run.must("[PUT ON, mat] (left of first, room for part between second and first)")
    after = run.must("[PICK UP, part]", "[PUT ON, mat] (between second and first)")
    assert stands(after, "part", "between second and first")
    assert stands(after, "second", "left of first")


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("side", ["left of", "right of", "behind", "in front of"])
def test_beside_what_comes_to_a_point_is_beside_that(side: str, seed: int) -> None:
    """The box makes way for the cup, and stands right once that is there."""
    run = episode(seed, box=BOX | {"at": [0.42, 0.10]}, cup=CUP)
    room = f"[PUT ON, desk] ({side} cup, room for cup at 0.420 0.100)"
    run.must("[PICK UP, box]", room)
    after = run.must("[PICK UP, cup]", "[PUT ON, desk] (at 0.420 0.100)")
    assert stands(after, "box", f"{side} cup")


def _refused(run: Episode, put: str) -> str:
    run.must("[PICK UP, cup]")
    cause = run.do(put).record.cause
    assert cause is not None and cause.kind is CauseKind.NO_ROOM
    assert cause.objects[0] == "box", cause
    return cause.text


def test_a_side_without_room_names_the_landmark() -> None:
    """Nothing stands between the box and the edge of the desk that could be taken away."""
    run = episode(box=BOX | {"at": [0.40, 0.54]}, cup=CUP)
    text = _refused(run, "[PUT ON, desk] (left of box)")
    assert text == "there is no room for cup on desk left of box"


def test_where_nothing_leaves_room_that_is_what_is_said() -> None:
    chest = CHEST | {"size": [0.10, 0.10, 0.08]}
    run = episode(chest=chest, box=BOX, cup=CUP)
    run.must("[PICK UP, box]")
    cause = run.do("[PUT ON, chest] (room for cup left of box)").record.cause
    assert cause is not None and cause.kind is CauseKind.NO_ROOM
    assert "room that is kept free" in cause.text


def test_no_is_said_soon_where_room_is_kept_for_many() -> None:
    """The row would have to end before what stands as near as the arm gets; whether it would with
    one or other of them away is looked for as well.
    """
    can = {"kind": "cylinder", "diameter": 0.05, "height": 0.07, "mass": 0.1}
    cup = CUP | {"diameter": 0.07, "height": 0.07}
    run = episode(
        first=can | {"at": [0.55, -0.23]}, second=can | {"at": [0.36, 0.08]},
        third=cup | {"at": [0.41, -0.06]}, end=cup | {"at": [0.28, -0.13]},
    )  # fmt: skip
    started = process_time()
    run.must("[PICK UP, first]")
    picking_s = process_time() - started
    row = "room for second behind first, room for third behind second, room for third in front of"
    started = process_time()
    record = run.do(f"[PUT ON, desk] ({row} end)").record
    assert process_time() - started < SOON * picking_s
    assert record.cause is not None
    assert record.cause.kind is CauseKind.NO_ROOM

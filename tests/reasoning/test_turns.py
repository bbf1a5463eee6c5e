"""Corrections by turns and by foresight: doors that cannot stand open together, and landmarks that
have yet to move.
"""

from __future__ import annotations

import pytest

from etot_cli.world.state import CauseKind, SceneState
from tests.reasoning import scenes
from tests.reasoning.records import cause, changed, failed, held, revisions

OUT = "[PICK UP, {0}] [PUT ON, desk]"
IN = "[PICK UP, {0}] [PUT INTO, {1}]"


def two_doors(left: float = 0.0) -> SceneState:
    """Two cabinets side by side, with something in each of them and a vase between."""
    return scenes.scene(
        scenes.cabinet("left", (0.55, 0.3), left),
        scenes.cabinet("right", (0.55, -0.3), 0.0),
        scenes.item("honey", at=(0.55, 0.3), on="left", inside="left"),
        scenes.item("jam", at=(0.55, -0.3), on="right", inside="right"),
        scenes.cup("vase", (0.4, 0.0)),
    )


def blocked(plan: str, start: SceneState, *others: str) -> list[str]:
    """What is made of a plan that opens the left door and then not the right one."""
    before = changed(start, left={"openness": {"door": 1.0}})
    return revisions(
        failed(start, plan, 1, cause(CauseKind.BLOCKED, "left", *others, "right"), before)
    )


def test_what_holds_the_door_in_the_way_is_taken_away() -> None:
    """Both doors are to stand open, so that opening them by turns is no way out."""
    found = blocked("[OPEN, left] [OPEN, right]", two_doors(), "vase")
    assert f"[OPEN, left] {OUT.format('vase')} [OPEN, right]" in found
    assert not [plan for plan in found if plan.endswith("[CLOSE, left]")]


def test_a_swap_behind_doors_that_meet_goes_by_turns() -> None:
    """What goes over waits elsewhere; no door is opened more than twice."""
    puts = f"{IN.format('jam', 'left')} {IN.format('honey', 'right')}"
    plan = f"[OPEN, left] [OPEN, right] {puts} [CLOSE, left] [CLOSE, right]"
    by_turns = (
        f"[OPEN, left] {OUT.format('honey')} [CLOSE, left] [OPEN, right] {OUT.format('jam')} "
        f"{IN.format('honey', 'right')} [CLOSE, right] [OPEN, left] {IN.format('jam', 'left')} "
        "[CLOSE, left]"
    )
    found = blocked(plan, two_doors())
    assert found.index(by_turns) >= 1, "closing one of them meanwhile may be enough"
    assert by_turns in blocked(plan, two_doors(), "vase")


@pytest.mark.parametrize("stays_open", [False, True])
def test_one_transfer_by_turns_leaves_the_doors_as_they_are_to_be(stays_open: bool) -> None:
    last = "" if stays_open else " [CLOSE, left]"
    plan = f"[OPEN, left] [OPEN, right] {IN.format('jam', 'left')}{last} [CLOSE, right]"
    by_turns = (
        f"[OPEN, right] {OUT.format('jam')} [CLOSE, right] [OPEN, left] {IN.format('jam', 'left')}"
        f"{last}"
    )
    assert by_turns in blocked(plan, two_doors())


def test_what_is_taken_last_keeps_the_hand_from_turning_doors() -> None:
    plan = f"[OPEN, left] [OPEN, right] {IN.format('jam', 'left')} [PICK UP, honey]"
    assert not [found for found in blocked(plan, two_doors()) if OUT.format("jam") in found]


def tray_taken(*more: scenes.Item) -> SceneState:
    """A can stands on the tray that a bowl is to go to."""
    return scenes.scene(
        scenes.item("tray", at=(0.5, 0.0), size=(0.2, 0.2, 0.01)),
        scenes.item("bowl", "bowl", (0.35, -0.3), size=(0.15, 0.15, 0.06)),
        scenes.item("can", "cylinder", (0.5, 0.0), on="tray", z=0.19),
        *more,
    )


def no_room(plan: str, start: SceneState) -> list[str]:
    """What is made of a plan whose second action finds the can in the way of the bowl."""
    return revisions(
        failed(start, plan, 1, cause(CauseKind.NO_ROOM, "can", "bowl"), held(start, "bowl"))
    )


BOWL = "[PICK UP, bowl] [PUT ON, tray]"


@pytest.mark.parametrize(
    ("beside", "foreseen"),
    [
        ("left of bowl", "left of tray"),
        ("left of bowl, upright", "left of tray, upright"),
        ("between bowl and post", "between tray and post"),
        ("between bowl and tray", "between bowl and tray"),
        ("not near bowl", "not near bowl"),
        ("left of post", "left of post"),
    ],
)
def test_what_is_beside_a_thing_that_has_yet_to_move_goes_where_that_will_be(
    beside: str, foreseen: str
) -> None:
    start = tray_taken(scenes.item("post", at=(0.5, 0.4)))
    found = no_room(f"{BOWL} [PICK UP, can] [PUT ON, desk] ({beside})", start)
    assert found[0] == f"[PICK UP, can] [PUT ON, desk] ({foreseen}) {BOWL}"


def test_a_landmark_on_what_moves_too_is_not_foreseen() -> None:
    start = tray_taken()
    rest = "[PICK UP, can] [PUT ON, desk] (left of bowl) [PICK UP, tray] [PUT ON, desk] (at front)"
    assert not [plan for plan in no_room(f"{BOWL} {rest}", start) if "left of tray" in plan]
    beside = "[PICK UP, can] [PUT ON, tray] (left of bowl)"
    assert not [plan for plan in no_room(f"{BOWL} {beside}", start) if "left of tray" in plan]

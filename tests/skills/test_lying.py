"""PUT with (lying) in physics: what stands is laid on its side."""

from __future__ import annotations

from typing import Any

import pytest

from etot_cli.world.state import CauseKind
from tests.skills.helpers import BALL, BOX, PEN, Episode, drawers, episode
from tests.world.stances import flat_by

SEEDS = range(4)
THINGS: dict[str, dict[str, Any]] = {
    "holder": {"kind": "cup", "diameter": 0.078, "height": 0.10, "wall": 0.004, "mass": 0.15},
    "glass": {"kind": "cup", "diameter": 0.066, "height": 0.11, "mass": 0.2},
    "bottle": {"kind": "cylinder", "diameter": 0.05, "height": 0.15, "mass": 0.25},
    "toy": {"kind": "box", "size": [0.05, 0.05, 0.12], "mass": 0.1},
}
LIES_WITHIN = 10.0
"""What is laid down is this far from level at most [deg]: a quarter of what would still do."""
DRAWER = {"kind": "drawer_unit", "at": [0.56, -0.10], "yaw_deg": 180, "size": [0.26, 0.26, 0.20],
          "mass": 4, "drawers": [
              {"name": "top", "travel": 0.22, "open": 0.22, "height": 0.12},
              {"name": "bottom", "travel": 0.0}]}  # fmt: skip
LEVEL = " (horizontal)"
"""A level hand points down once it has laid down what it holds, and gets into drawers with it."""


def laid(run: Episode, put: str, grasp: str = "") -> str:
    """Picks the thing up and puts it down; what it then rests in or on."""
    state = run.must(f"[PICK UP, thing]{grasp}", f"{put} (lying)").states["thing"]
    assert not (state.in_hand or state.lost) and state.reachable
    assert flat_by(run.state, "thing") < LIES_WITHIN
    return state.inside or ", ".join(state.on)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("name", THINGS)
def test_what_stands_is_laid_on_the_desk(name: str, seed: int) -> None:
    run = episode(seed, thing=THINGS[name] | {"at": [0.40, 0.18]})
    assert laid(run, "[PUT ON, desk]", LEVEL) == "desk"


@pytest.mark.parametrize("seed", SEEDS)
def test_a_finger_that_holds_a_wall_does_not_take_the_vessel_along(seed: int) -> None:
    """By the rim it is held from above; laid down, one finger is inside it."""
    run = episode(seed, thing=THINGS["holder"] | {"at": [0.40, 0.18]})
    assert laid(run, "[PUT ON, desk]", " (vertical)") == "desk"


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("name", THINGS)
def test_what_stands_is_laid_in_a_drawer_that_closes_over_it(name: str, seed: int) -> None:
    run = episode(seed, chest=DRAWER, thing=THINGS[name] | {"at": [0.40, 0.28]})
    assert laid(run, "[PUT INTO, chest]", LEVEL) == "chest"
    run.must("[CLOSE, chest]")
    assert run.state.states["thing"].inside == "chest"


@pytest.mark.parametrize("seed", range(2))
def test_what_is_held_from_the_side_is_laid_on_a_chest(seed: int) -> None:
    chest = {"kind": "drawer_unit", "size": [0.28, 0.28, 0.15], "mass": 4, "at": [0.48, -0.18],
             "drawers": drawers()}  # fmt: skip
    run = episode(seed, chest=chest, thing=THINGS["bottle"] | {"at": [0.40, 0.18]})
    assert laid(run, "[PUT ON, chest]", LEVEL) == "chest"


def board_and_bottle(
    diameter: float, height: float, x: float, clear: float, y: float = 0.2
) -> dict[str, Any]:
    """A shelf at ``x`` before the robot, so much clear above its lower board, and a bottle."""
    rack = {"kind": "shelf", "size": [0.24, 0.34, clear + 0.02], "mass": 3.0, "at": [x, -0.04],
            "yaw_deg": 180}  # fmt: skip
    bottle = {"kind": "cylinder", "diameter": diameter, "height": height, "mass": 0.3}
    return {"rack": rack, "thing": bottle | {"at": [0.31, y]}}


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    ("diameter", "height", "x"),
    [(0.056, 0.15, 0.64), (0.06, 0.18, 0.64), (0.052, 0.17, 0.55), (0.046, 0.17, 0.55)],
)
def test_what_is_round_is_laid_on_a_low_board_with_the_hand_level(
    diameter: float, height: float, x: float, seed: int
) -> None:
    """Held from above near its end; rolled onto a side of its own, it had one finger below it. Near
    the base the hand gets out at a slant only, and what is thin it lets go a little higher up.
    """
    run = episode(seed, **board_and_bottle(diameter, height, x, 0.135))
    assert laid(run, "[PUT ON, rack.bottom]", " (vertical)").startswith("rack")


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("diameter", [0.046, 0.054, 0.064])
def test_what_was_laid_on_the_desk_is_taken_as_it_lies(diameter: float, seed: int) -> None:
    """It lies across the way to the base, where a level hand has room at its end."""
    run = episode(seed, **board_and_bottle(diameter, 0.17, 0.55, 0.136, 0.24))
    assert laid(run, "[PUT ON, desk]", LEVEL) == "desk"
    assert laid(run, "[PUT ON, rack.bottom]", LEVEL).startswith("rack")


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(("diameter", "height"), [(0.05, 0.225), (0.063, 0.226)])
def test_what_is_nearly_as_long_as_a_board_is_deep_lies_on_it(
    diameter: float, height: float, seed: int
) -> None:
    """Nothing is left of the distance from the front that shorter things keep. What is round bears
    on a line, over an edge as in the middle.
    """
    run = episode(seed, **board_and_bottle(diameter, height, 0.55, 0.14))
    assert laid(run, "[PUT ON, rack.bottom]", " (vertical)").startswith("rack")


def test_what_fits_without_the_hand_is_not_too_large() -> None:
    """It lies along the board only, and the hand that holds it so cannot."""
    run = episode(**board_and_bottle(0.063, 0.245, 0.55, 0.14))
    run.must("[PICK UP, thing] (vertical)")
    cause = run.do("[PUT ON, rack.bottom] (lying)").record.cause
    assert cause is not None and cause.kind is CauseKind.UNREACHABLE
    assert cause.text == "the hand has no room on rack.bottom as it holds thing"


def test_what_lies_stays_lying_and_stands_up_again() -> None:
    run = episode(thing=THINGS["bottle"] | {"at": [0.40, 0.18]})
    assert laid(run, "[PUT ON, desk]", LEVEL) == laid(run, "[PUT ON, desk]") == "desk"
    after = run.must("[PICK UP, thing]", "[PUT ON, desk] (upright)").states["thing"]
    assert not after.toppled and after.tilt_deg < 5


def test_a_rod_that_would_stand_in_a_cup_does_not_lie_in_it() -> None:
    cup = THINGS["holder"] | {"at": [0.42, -0.15]}
    run = episode(cup=cup, pen=PEN)
    run.must("[PICK UP, pen]")
    cause = run.do("[PUT INTO, cup] (lying)").record.cause
    assert cause is not None and cause.kind in (CauseKind.NO_ROOM, CauseKind.UNREACHABLE)


@pytest.mark.parametrize("thing", [BALL, BOX | {"size": [0.05, 0.05, 0.05]}], ids=["ball", "cube"])
def test_what_is_as_high_any_way_round_does_not_lie(thing: dict[str, Any]) -> None:
    run = episode(thing=thing)
    run.must("[PICK UP, thing]")
    cause = run.do("[PUT ON, desk] (lying)").record.cause
    assert cause is not None and cause.kind is CauseKind.PRECONDITION
    assert cause.text.startswith("thing cannot be laid down: no side of it is one to lie on")


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_a_can_is_not_laid_on_top_of_a_can(seed: int) -> None:
    """So far out the hand from above gets none to stand there; a level one does."""
    can = {"kind": "cylinder", "height": 0.08, "mass": 0.15}
    objects = {
        "low": can | {"diameter": 0.069, "at": [0.589, 0.108]},
        "high": can | {"diameter": 0.067, "on": "low"},
        "can": can | {"diameter": 0.072, "height": 0.088, "at": [0.499, -0.185]},
    }
    from_above = episode(seed, **objects)
    from_above.must("[PICK UP, can] (vertical)")
    assert not from_above.do("[PUT ON, high]").record.effect
    after = episode(seed, **objects).must("[PICK UP, can] (horizontal)", "[PUT ON, high]")
    assert after.states["can"].on == ("high",)
    assert not after.states["can"].toppled

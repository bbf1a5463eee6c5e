"""A plan whose actions all succeed still has to do what was asked for."""

from __future__ import annotations

from dataclasses import replace

import pytest

from etot_cli.planning.acceptance import check_of
from etot_cli.reasoning.protocol import Assignment
from etot_cli.specs.task import Condition
from etot_cli.world.state import SceneState
from tests.vlm.scenes import kitchen

START = kitchen()


def scene(**changes: dict[str, object]) -> SceneState:
    """The kitchen with some states changed."""
    states = dict(START.states)
    for name, change in changes.items():
        states[name] = replace(states[name], **change)  # type: ignore[arg-type]
    return replace(START, states=states)


OPENED = {"openness": {"top": 1.0}, "opened": {"top": True}}


@pytest.mark.parametrize(
    ("instruction", "changes", "done"),
    [
        ("Close the chest.", {}, True),
        ("Open the chest.", {}, False),
        ("Open the chest.", {"chest": OPENED}, True),
        ("Open the chest, then close it.", {}, True),
        ("Open the chest, then close it.", {"chest": OPENED}, False),
        ("Put the spoon into a cup.", {"spoon": {"inside": "red_cup", "on": ()}}, True),
        ("Put the spoon into a cup.", {"spoon": {"inside": "blue_cup", "on": ()}}, True),
        ("Put the spoon into a cup.", {"ball": {"inside": "red_cup", "on": ()}}, False),
        ("Put the spoon into the red cup.", {"spoon": {"inside": "blue_cup", "on": ()}}, False),
        ("Pick up the ball.", {"ball": {"in_hand": True, "on": ()}}, True),
        ("Pick up the ball.", {"spoon": {"in_hand": True, "on": ()}}, False),
        # Beyond what is read here, nothing can be said.
        ("Make the kitchen look inviting.", {}, True),
    ],
)
def test_instructions(instruction: str, changes: dict[str, dict[str, object]], done: bool) -> None:
    final = scene(**changes)
    holding = next((name for name, state in final.states.items() if state.in_hand), None)
    check = check_of(Assignment(instruction, None), START)
    why = check(replace(final, holding=holding))
    assert (why == "") is done, why


@pytest.mark.parametrize(
    ("where", "done"),
    [({"on": ("desk",)}, True), ({"on": ("chest",)}, True), ({"inside": "red_cup"}, False)],
)
def test_taken_away_is_taken_anywhere(where: dict[str, object], done: bool) -> None:
    start = scene(ball={"inside": "red_cup", "on": ()})
    check = check_of(Assignment("Take the ball out of the red cup.", None), start)
    assert (check(scene(ball={"on": (), **where})) == "") is done


def test_a_formal_goal_is_checked_by_the_state() -> None:
    goal = (Condition.model_validate({"inside": ["spoon", "red_cup"]}),)
    check = check_of(Assignment("Whatever.", goal), START)
    assert "does not hold" in check(START) and "spoon" in check(START)
    assert check(scene(spoon={"inside": "red_cup", "on": ()})) == ""

"""A plan whose actions all succeed still has to do what was asked for."""

from __future__ import annotations

from dataclasses import replace
from itertools import islice

import pytest

from etot_cli.errors import InstructionError
from etot_cli.planning.acceptance import check_of
from etot_cli.reasoning.builtin.acceptance import undone
from etot_cli.reasoning.builtin.branching import branches_of
from etot_cli.reasoning.language.instructions import goal_of
from etot_cli.reasoning.protocol import Assignment
from etot_cli.skills.action import parse_plan
from etot_cli.specs.task import Condition
from etot_cli.world.state import SceneState
from tests.reasoning.intended import intended
from tests.reasoning.test_corpus import CORPUS, SCENES, sampled
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
        # What is put somewhere and taken from there again leaves no trace.
        (
            "Put the ball in the red cup, then pick it up.",
            {"ball": {"in_hand": True, "on": ()}},
            True,
        ),
        (
            "Put the ball and the spoon in the red cup. Then put the spoon in the blue cup.",
            {"ball": {"inside": "red_cup", "on": ()}, "spoon": {"inside": "blue_cup", "on": ()}},
            True,
        ),
        (
            "Put the ball and the spoon in the red cup. Then put the spoon in the blue cup.",
            {"spoon": {"inside": "blue_cup", "on": ()}},
            False,
        ),
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


def test_nothing_speaks_against_a_plan_that_goes_as_it_is_meant() -> None:
    """Of 40 sentences of the corpus one, but for those that put something beside something."""
    looked_at = 0
    for name, found in CORPUS.items():
        for text in (text for text in found.get("read", {}) if sampled(text, 40)):
            start = SCENES[name]
            try:
                (branch,) = islice(branches_of((goal_of(text, start),), start), 1)
            except (InstructionError, ValueError):  # refused for what it asks for, or done already
                continue
            final = intended(start, branch.actions)
            if final is not None:
                looked_at += 1
                assert check_of(Assignment(text, None), start)(final) == ""
                ends = [
                    intended(start, branch.actions[:n]) for n, _ in enumerate(branch.actions, 1)
                ]
                assert undone(zip(branch.actions, filter(None, ends), strict=True), final) == ""
    assert looked_at > 100


def test_what_left_with_a_vessel_is_told() -> None:
    there, elsewhere = (scene(ball={"inside": cup, "on": ()}) for cup in ("red_cup", "blue_cup"))
    pick, put = parse_plan("[PICK UP, ball] [PUT INTO, red_cup]")
    assert undone([(pick, START), (put, there)], there) == ""
    assert "ball does not stay" in undone([(pick, START), (put, there)], elsewhere)
    (_, down) = parse_plan("[PICK UP, ball] [PUT ON, desk]")
    back = scene(ball={"on": ("desk",)})
    assert undone([(pick, START), (put, there), (pick, there), (down, back)], back) == ""


def test_a_formal_goal_is_checked_by_the_state() -> None:
    goal = (Condition.model_validate({"inside": ["spoon", "red_cup"]}),)
    check = check_of(Assignment("Whatever.", goal), START)
    assert "does not hold" in check(START) and "spoon" in check(START)
    assert check(scene(spoon={"inside": "red_cup", "on": ()})) == ""

"""Planning again from the middle of a task: words keep the meaning that they had at first."""

from __future__ import annotations

from dataclasses import replace

import pytest

from etot_cli.benchmark.methods.nominal import predicted
from etot_cli.errors import InstructionError
from etot_cli.planning.acceptance import check_of
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Assignment
from etot_cli.skills.action import Action, format_plan
from etot_cli.specs.task import Condition
from etot_cli.world.state import SceneState
from tests.reasoning.scenes import ball, cabinet, cup, drawers, item, scene

ROOM = scene(
    cabinet("cupboard", (0.5, 0.45), 0.0),
    cup("white_mug", (0.5, 0.45), inside="cupboard", on="cupboard", color="white"),
    cup("red_mug", (0.3, 0.1), color="red"),
    drawers("chest", (0.6, -0.3), {"upper": 0.0, "lower": 0.9}),
    item("plate", "box", (0.42, -0.1), size=(0.16, 0.16, 0.01)),
    item("book_1", "box", (0.3, -0.4), size=(0.1, 0.08, 0.02), color="blue"),
    item("book_2", "box", (0.3, -0.4), size=(0.1, 0.08, 0.02), on="book_1", z=0.16),
    ball("ball_1", (0.25, 0.25), color="red"),
    ball("ball_2", (0.25, -0.15), color="green"),
    ball("ball_3", (0.35, 0.3), color="blue"),
    item("pen", "pen", (0.5, 0.15), size=(0.15, 0.012, 0.012)),
)


def proposed(text: str, now: SceneState, past: tuple[SceneState, ...] = ()) -> list[str]:
    branches = BuiltinReasoner().propose(Assignment(text, None, past), now)
    return [format_plan(branch.actions) for branch in branches]


def followed(actions: tuple[Action, ...], now: SceneState) -> list[SceneState]:
    """The scene before each action and after the last one, where all goes well."""
    scenes = [now]
    for action in actions:
        scenes.append(predicted(scenes[-1], action))
    return scenes


def arrangement(state: SceneState) -> dict[str, object]:
    return {
        name: (one.on, one.inside, one.in_hand, {p: v > 0.5 for p, v in one.openness.items()})
        for name, one in state.states.items()
    }


@pytest.mark.parametrize(
    "text",
    [
        # Named by where they were.
        "Take the white mug out of the cupboard and put it on the desk.",
        "Take the white mug out of the cupboard.",
        "Put the mug in the cupboard on the plate.",
        "Put the pen into the mug in the cupboard.",
        "Put the book that is on the blue book on the plate.",
        # Left and right, ordinals, superlatives.
        "Put the left ball into the red mug.",
        "Put the second ball from the left on the plate.",
        "Put the ball nearest to the plate into the red mug.",
        "Put one of the largest mugs on the plate.",
        "Pick up the right ball.",
        # Out of something that is closed or moved before it is put elsewhere.
        "Take the white mug out of the cupboard, close the cupboard and put the mug on the plate.",
        # Several.
        "Put two of the balls on the plate.",
        "Put all balls on the desk into the lower drawer.",
        "Put all the balls into the upper drawer.",
        "Put the ball on the right on the plate and the other balls into the cupboard.",
        "Put each ball on the plate without moving the pen.",
        # One after the other, there and back.
        "Swap the red mug and the pen.",
        "Put the pen into the red mug, then put it back where it was.",
        "Put the pen on the plate, then put the pen in the cupboard, then put it on the desk.",
        "Move the mug out of the cupboard and put the ball closest to it on the plate.",
        "Pick up the pen and put it back where it was.",
        "Lift the right ball, set it down again and pick up the pen.",
        # Doors and drawers.
        "Put the red ball into the upper drawer.",
        "Open the upper drawer, put the red ball in it and leave it open.",
        "Open the upper drawer and close it again.",
        "Close the lower drawer, then open the upper drawer.",
        "Close the drawer.",
    ],
)
def test_a_plan_that_is_broken_off_anywhere_is_gone_on_with(text: str) -> None:
    branch = next(iter(BuiltinReasoner().propose(Assignment(text), ROOM)))
    scenes = followed(branch.actions, ROOM)
    assert len(scenes) > 1
    for done in range(1, len(scenes)):
        now, past = scenes[done], tuple(scenes[:done])
        rest = next(iter(BuiltinReasoner().propose(Assignment(text, None, past), now)), None)
        actions = rest.actions if rest is not None else ()
        assert len(actions) <= len(branch.actions) - done, format_plan(actions)
        end = followed(actions, now)[-1]
        assert arrangement(end) == arrangement(scenes[-1]), (done, format_plan(actions))


def without(state: SceneState, *names: str) -> SceneState:
    """The scene after somebody has taken things away."""
    taken = {name: replace(state.states[name], lost=True, on=(), inside=None) for name in names}
    holding = None if state.holding in names else state.holding
    return replace(state, states={**state.states, **taken}, holding=holding)


def test_what_is_gone_is_left_out_where_others_were_meant_as_well() -> None:
    gone = without(ROOM, "ball_1")
    (rest,) = proposed("Put all the balls on the plate.", gone, (ROOM,))
    assert "ball_1" not in rest and "ball_2" in rest and "ball_3" in rest
    (two,) = proposed("Put two of the balls on the plate.", gone, (ROOM,))
    assert two == rest
    assert all("ball_1" not in plan for plan in proposed("Pick up a ball.", gone, (ROOM,)))
    # "The left ball" was one ball; another that is the left one now was not meant.
    with pytest.raises(InstructionError, match="cannot be done without ball_3"):
        proposed("Pick up the left ball.", without(ROOM, "ball_3"), (ROOM,))
    with pytest.raises(InstructionError, match="cannot be done without plate"):
        proposed("Put a ball on the plate.", without(ROOM, "plate"), (ROOM,))
    # What only told things apart is not needed.
    near = "Put the ball nearest to the plate into the red mug."
    assert proposed(near, without(ROOM, "plate"), (ROOM,)) == proposed(near, ROOM)


def test_what_is_new_was_not_meant() -> None:
    info, state = ball("ball_4", (0.2, -0.4), color="red")
    more = replace(
        ROOM,
        infos={**ROOM.infos, "ball_4": info},
        states={**ROOM.states, "ball_4": state},
    )
    for text in ("Put all the balls on the plate.", "Pick up the red ball.", "Take a ball."):
        assert proposed(text, more, (ROOM,)) == proposed(text, ROOM)
    assert len(proposed("Pick up a ball.", more)) == 4


def test_what_was_not_asked_for_is_put_down_and_what_others_opened_is_shut() -> None:
    text = "Put the red ball into the upper drawer."
    last = followed(next(iter(BuiltinReasoner().propose(Assignment(text), ROOM))).actions, ROOM)[-1]
    chest = last.states["chest"]
    ajar = replace(chest, openness={**chest.openness, "upper": 0.4})
    opened = replace(last, states={**last.states, "chest": ajar})
    assert proposed(text, opened, (ROOM, last)) == ["[CLOSE, chest.upper]"]
    mug = replace(last.states["red_mug"], in_hand=True, on=())
    held = replace(last, states={**last.states, "red_mug": mug}, holding="red_mug")
    assert proposed(text, held, (ROOM, last)) == ["[PUT ON, desk]"]


def test_conditions_are_to_become_true_of_what_is_there_now() -> None:
    goal = (Condition(upright="red_mug"),)
    assert list(BuiltinReasoner().propose(Assignment("", goal), ROOM)) == []
    lying = replace(ROOM.states["red_mug"], toppled=True)
    fallen = replace(ROOM, states={**ROOM.states, "red_mug": lying})
    (branch,) = BuiltinReasoner().propose(Assignment("", goal, (ROOM,)), fallen)
    assert format_plan(branch.actions) == "[PICK UP, red_mug] [PUT ON, desk] (upright)"


def test_a_plan_of_somebody_else_is_held_against_the_first_scene() -> None:
    text = "Put the mug in the cupboard on the plate."
    scenes = followed(next(iter(BuiltinReasoner().propose(Assignment(text), ROOM))).actions, ROOM)
    check = check_of(Assignment(text, None, tuple(scenes[:2])), scenes[2])
    assert check(scenes[-1]) == ""
    assert "still to do is white_mug on plate" in check(scenes[2])
    away = "Take the white mug out of the cupboard."
    check = check_of(Assignment(away, None, tuple(scenes[:2])), scenes[2])
    assert check(scenes[-1]) == ""
    assert "to take white_mug away" in check(ROOM)

"""What must not happen to what a choice leaves."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.builtin.branching import branches_of
from etot_cli.reasoning.builtin.constraints import spares_none
from etot_cli.reasoning.builtin.goal import (
    Constraint,
    Goal,
    Keep,
    Pick,
    Place,
    Put,
    Referent,
    Relation,
    Thing,
)
from etot_cli.reasoning.builtin.wording import formal
from etot_cli.reasoning.language.instructions import goal_of
from etot_cli.skills.action import parse_plan
from etot_cli.world.state import SceneState
from tests.reasoning import scenes

RED, BLUE, BOX = ((Thing(name),) for name in ("red_ball", "blue_ball", "box"))


def two_balls() -> SceneState:
    return scenes.scene(
        scenes.ball("red_ball", (0.4, 0.2)),
        scenes.ball("blue_ball", (0.4, -0.2)),
        scenes.cup("box", (0.5, 0.0)),
    )


def test_the_choice_decides_what_is_left_alone() -> None:
    """A red ball goes into the box, and one ball is picked up: where the other is not to be moved,
    that is the red one.
    """
    either = Referent((RED, BLUE), "one ball")
    referents = (
        either, replace(either, distinct_from=(0,)),
        Referent((RED,), "the red ball"), Referent((BOX,), "the box"),
    )  # fmt: skip
    steps = (Put((2,), (Place(Relation.INSIDE, 3),)), Pick(0))
    picked = {
        kept: {
            branch.actions[-1].target
            for branch in branches_of((Goal(referents, steps, kept),), two_balls())
        }
        for kept in ((), (Constraint(Keep.UNMOVED, (), referent=1),))
    }
    assert [*picked.values()] == [{"red_ball", "blue_ball"}, {"red_ball"}]


def test_a_revised_plan_spares_one() -> None:
    start = two_balls()
    goal = goal_of("Pick up one ball without touching the other.", start)
    assert formal(goal) == (
        "in_hand: red_ball or blue_ball; untouched: red_ball or blue_ball (another)"
    )
    both = parse_plan("[PICK UP, red_ball], [PUT INTO, box], [PICK UP, blue_ball]")
    assert spares_none(both, goal, start)
    assert not spares_none(both[2:], goal, start)

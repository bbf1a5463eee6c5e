"""The rules of a well-formed plan."""

from __future__ import annotations

import pytest

from etot_cli.reasoning.builtin import check_plan
from etot_cli.skills.action import Action, GraspPose, Verb, parse_plan
from tests.reasoning import scenes

CYCLE = "[OPEN, drawer] [PICK UP, apple] [PUT INTO, drawer] [CLOSE, drawer]"


@pytest.mark.parametrize(
    "plan",
    [
        "[PICK UP, apple]",
        "[PICK UP, apple] [PUT ON, desk]",
        "[PICK UP, apple] [PUT ON, drawer]",
        "[PICK UP, holder] (vertical) [PUT ON, drawer]",
        "[OPEN, drawer]",
        CYCLE,
        f"{CYCLE} {CYCLE.replace('apple', 'holder')}",
        f"{CYCLE} [OPEN, drawer]",
        # What is in the way may be taken out within a cycle.
        "[OPEN, drawer] [PICK UP, holder] [PUT ON, desk] [PICK UP, apple] [PUT INTO, drawer] "
        "[CLOSE, drawer]",
        "[OPEN, drawer] [PICK UP, apple] [PUT INTO, drawer] [PICK UP, holder] [PUT ON, desk] "
        "[CLOSE, drawer]",
    ],
)
def test_well_formed(plan: str) -> None:
    assert check_plan(parse_plan(plan), scenes.apple_and_holder()) == []


@pytest.mark.parametrize(
    ("plan", "index", "rule"),
    [
        ("[PICK UP, pear]", 0, 1),
        ("[PICK UP, drawer]", 0, 1),
        ("[OPEN, holder]", 0, 1),
        ("[CLOSE, apple]", 0, 1),
        ("[PUT ON, desk]", 0, 2),
        ("[PICK UP, apple] [PICK UP, holder]", 1, 2),
        ("[PICK UP, apple] [OPEN, drawer]", 1, 2),
        ("[PICK UP, apple] [CLOSE, drawer]", 1, 2),
        ("[PICK UP, holder] [PUT INTO, holder]", 1, 1),
        ("[PICK UP, apple] [PUT INTO, drawer] [CLOSE, drawer]", 1, 3),
        ("[OPEN, drawer] [PICK UP, apple] [PUT INTO, drawer]", 2, 3),
        (
            "[OPEN, drawer] [PICK UP, apple] [PUT INTO, drawer] [PICK UP, holder] "
            "[PUT INTO, drawer] [CLOSE, drawer]",
            4,
            3,
        ),
        ("[PICK UP, apple] [PUT INTO, desk]", 1, 6),
        ("[PICK UP, holder] [PUT ON, apple]", 1, 6),
        ("[PICK UP, holder] [PUT ON, drawer.top]", 1, 6),
        ("[PICK UP, holder] [PUT INTO, apple]", 1, 6),
    ],
)
def test_violations(plan: str, index: int, rule: int) -> None:
    found = check_plan(parse_plan(plan), scenes.apple_and_holder())
    assert (index, rule) in [(item.index, item.rule) for item in found]
    assert f"step {index + 1}" in " ".join(map(str, found))


def test_a_part_must_be_named_where_there_are_several() -> None:
    (found,) = check_plan(parse_plan("[OPEN, chest]"), scenes.kitchen())
    assert "chest.upper or chest.lower" in found.text


def test_only_pick_up_takes_a_pose() -> None:
    plan = (Action(Verb.OPEN, "drawer", GraspPose.VERTICAL),)
    assert [item.rule for item in check_plan(plan, scenes.apple_and_holder())] == [1]


def test_the_hand_may_be_full_at_the_start() -> None:
    apple, holder = scenes.ball("apple", (0.3, 0.2)), scenes.cup("holder", (0.4, -0.2))
    state = scenes.scene(apple, holder, holding="apple")
    assert check_plan(parse_plan("[PUT INTO, holder]"), state) == []
    assert check_plan(parse_plan("[PICK UP, holder]"), state)[0].rule == 2


def test_length_is_bounded() -> None:
    step = (Action(Verb.PICK_UP, "apple"), Action(Verb.PUT_ON, "desk"))
    assert check_plan(step * 40, scenes.apple_and_holder())[0].rule == 1

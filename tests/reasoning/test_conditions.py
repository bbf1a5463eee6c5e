"""Formal goals."""

from __future__ import annotations

from typing import Any

import pytest

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Assignment
from etot_cli.skills.action import format_plan
from etot_cli.specs.task import Condition
from etot_cli.world.state import SceneState
from tests.reasoning import scenes


def plans(state: SceneState, *conditions: dict[str, Any]) -> list[str]:
    goal = tuple(Condition.model_validate(item) for item in conditions)
    branches = BuiltinReasoner().propose(Assignment("ignored, whatever it says", goal), state)
    return [format_plan(branch.actions) for branch in branches]


INTO_HOLDER = "[PICK UP, apple] [PUT INTO, holder]"
ON_DRAWER = "[PICK UP, apple] [PUT ON, drawer]"


@pytest.mark.parametrize(
    ("conditions", "wanted"),
    [
        ([{"inside": ["apple", "holder"]}], [INTO_HOLDER]),
        ([{"on": ["apple", "drawer"]}], [ON_DRAWER]),
        ([{"on": ["apple", "desk"]}], []),
        ([{"in_hand": "apple"}, {"open": "drawer"}], ["[OPEN, drawer] [PICK UP, apple]"]),
        ([{"open": "drawer.top"}], ["[OPEN, drawer]"]),
        ([{"closed": "drawer"}, {"present": "apple"}, {"upright": "holder"}], []),
        ([{"not": {"closed": "drawer"}}], ["[OPEN, drawer]"]),
        (
            [{"any": [{"inside": ["apple", "holder"]}, {"on": ["apple", "drawer"]}]}],
            [INTO_HOLDER, ON_DRAWER],
        ),
        (
            [{"all": [{"on": ["holder", "drawer"]}, {"inside": ["apple", "holder"]}]}],
            [f"[PICK UP, holder] [PUT ON, drawer] {INTO_HOLDER}"],
        ),
        (
            [{"not": {"all": [{"closed": "drawer"}, {"not": {"in_hand": "apple"}}]}}],
            ["[OPEN, drawer]", "[PICK UP, apple]"],
        ),
        (
            [{"inside": ["apple", "drawer"]}, {"closed": "drawer"}],
            ["[OPEN, drawer] [PICK UP, apple] [PUT INTO, drawer] [CLOSE, drawer]"],
        ),
    ],
)
def test_branches(conditions: list[dict[str, Any]], wanted: list[str]) -> None:
    assert plans(scenes.apple_and_holder(), *conditions) == wanted


def test_denied_place() -> None:
    state = scenes.toy_in_drawer()
    assert plans(state, {"not": {"inside": ["toy", "drawer"]}}) == ["[PICK UP, toy] [PUT ON, desk]"]


@pytest.mark.parametrize(
    ("condition", "named"),
    [
        ({"inside": ["pear", "holder"]}, "no such object; it has holder, drawer, apple, desk"),
        ({"inside": ["apple", "desk"]}, "cannot be used as a container"),
        ({"open": "drawer.bottom"}, "no such part; it has top"),
        ({"in_hand": "drawer"}, "cannot be picked up"),
        ({"not": {"upright": "holder"}}, "no skill"),
    ],
)
def test_refusals(condition: dict[str, Any], named: str) -> None:
    with pytest.raises(InstructionError, match=named):
        plans(scenes.apple_and_holder(), condition)


def test_two_objects_cannot_be_in_the_hand() -> None:
    with pytest.raises(InstructionError, match="one object at a time"):
        plans(scenes.apple_and_holder(), {"in_hand": "apple"}, {"in_hand": "holder"})

"""What a branch leaves behind, without physics."""

from __future__ import annotations

import pytest

from etot_cli.reasoning.builtin.goal import Relation
from etot_cli.reasoning.builtin.sketch import Sketch
from etot_cli.skills.action import parse_plan
from tests.reasoning.corpus_scenes import kids_room


@pytest.mark.parametrize(
    ("plan", "name", "inside"),
    [
        ("[PICK UP, ball] [PUT INTO, toy_box]", "ball", True),
        ("[PICK UP, book] [PUT INTO, toy_box] [PICK UP, ball] [PUT ON, book]", "ball", True),
        ("[PICK UP, book] [PUT ON, dresser] [PICK UP, ball] [PUT ON, book]", "ball", False),
        (
            "[PICK UP, red_block] [PUT ON, yellow_block] "
            "[PICK UP, yellow_block] [PUT ON, red_block]",
            "red_block",
            False,
        ),
    ],
    ids=["into", "on what is inside", "on what is not", "on each other"],
)
def test_what_stands_on_something_is_where_that_is(plan: str, name: str, inside: bool) -> None:
    sketch = Sketch(kids_room(), parse_plan(plan))
    assert sketch.holds(name, Relation.INSIDE, "toy_box") is inside

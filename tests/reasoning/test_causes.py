"""What the judge blames for what happened, in physics: with those it names the action fails, and
without them it works. What the skills refuse beforehand stands in ``tests/skills``.
"""

from __future__ import annotations

from typing import Any

import pytest

from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Outcome, Verdict
from etot_cli.skills.action import parse_plan
from etot_cli.specs.scene import Scene
from etot_cli.world.state import Cause, CauseKind
from tests.skills.helpers import BALL, BOX, CUP, OVEN, PEN, UNIT, Episode, Objects, drawers

BLOCK = {"kind": "box", "size": [0.04, 0.04, 0.04], "mass": 0.06}
AJAR = OVEN | {"at": [0.45, 0.36], "yaw_deg": -90, "door": {"hinge": "left", "open_deg": 25}}
BACKWARDS = OVEN | {"at": [0.45, -0.2], "yaw_deg": -90, "door": {"hinge": "right", "open_deg": 25}}
HANDLE = {"width": 0.09, "depth": 0.04, "thickness": 0.012}
CHEST = UNIT | {"at": [0.45, 0.15], "yaw_deg": -90, "drawers": drawers(handle=HANDLE)}
LIGHT = CHEST | {"fixed": False, "mass": 0.3}
BOTTLE = {"kind": "cylinder", "diameter": 0.03, "height": 0.2, "mass": 0.1}
WIDE_DESK = {"size": [1.8, 2.0], "center": [1.0, 0.0]}
NARROW_DESK = {"size": [0.62, 1.2], "center": [0.5, 0.0]}
"""Its edge is 13 cm from what the door pushes towards it."""


def judged(plan: str, objects: Objects, desk: dict[str, Any] | None = None) -> Verdict:
    """The verdict on the last action of a plan whose others have to work."""
    document = {"objects": objects, "directory": "."} | ({} if desk is None else {"desk": desk})
    run = Episode(Scene.model_validate(document))
    *first, last = parse_plan(plan)
    run.must(*map(str, first))
    return BuiltinReasoner().judge(last, run.do(str(last)).record)


def cause(plan: str, objects: Objects, desk: dict[str, Any] | None = None) -> Cause:
    verdict = judged(plan, objects, desk)
    assert verdict.cause is not None, "the action worked"
    unsafe = verdict.cause.kind in (CauseKind.LOST, CauseKind.STRANDED)
    assert verdict.outcome is (Outcome.UNSAFE if unsafe else Outcome.FAILURE)
    return verdict.cause


@pytest.mark.parametrize(
    ("kind", "plan", "objects", "desk", "guilty"),
    [
        (CauseKind.COLLISION, "[OPEN, oven]",
         {"oven": AJAR, "near": BLOCK | {"at": [0.44, 0.10]}, "far": BLOCK | {"at": [0.3, -0.2]}},
         None, {"near"}),
        (CauseKind.COLLISION, "[PICK UP, box]",
         {"box": BOX, "rider": BLOCK | {"on": "box"}, "far": BLOCK | {"at": [0.3, 0.2]}},
         None, {"rider"}),
        (CauseKind.TOPPLED, "[OPEN, chest]",
         {"chest": CHEST, "bottle": BOTTLE | {"at": [0.52, -0.06]},
          "far": BOTTLE | {"at": [0.3, -0.2]}},
         None, {"bottle"}),
        (CauseKind.LOST, "[OPEN, oven]",
         {"oven": AJAR, "ball": BALL | {"at": [0.32, 0.16]}, "far": BALL | {"at": [0.4, -0.2]}},
         NARROW_DESK, {"ball"}),
        (CauseKind.STRANDED, "[OPEN, oven]",
         {"oven": BACKWARDS, "far": BALL | {"at": [0.4, 0.2]},
          "ball": BALL | {"diameter": 0.06, "at": [0.54, -0.44]}},
         WIDE_DESK, {"ball"}),
        (CauseKind.REBOUND, "[PICK UP, pen] [PUT INTO, cup]",
         {"pen": PEN | {"at": [0.35, 0.0]}, "cup": CUP | {"diameter": 0.085},
          "lid": BALL | {"diameter": 0.085, "mass": 0.15, "on": "cup", "at": None},
          "far": BALL | {"at": [0.4, 0.25]}},
         None, {"lid"}),
    ],
    ids=["pushed", "carried along", "toppled", "lost", "stranded", "rebound"],
)  # fmt: skip
@pytest.mark.slow
def test_without_the_blamed_objects_the_action_works(
    kind: CauseKind,
    plan: str,
    objects: Objects,
    desk: dict[str, Any] | None,
    guilty: set[str],
) -> None:
    found = cause(plan, objects, desk)
    actors = {action.target for action in parse_plan(plan)}
    assert found.kind is kind, found
    assert set(found.objects) - actors == guilty, found
    rest = {name: item for name, item in objects.items() if name not in guilty}
    assert judged(plan, rest, desk).outcome is Outcome.SUCCESS


@pytest.mark.slow
def test_what_the_action_acts_on_is_blamed_where_nothing_else_has_a_part_in_it() -> None:
    """A chest that comes along when its drawer is pulled: fastened it opens."""
    pull = "[OPEN, chest]"
    bystander = BALL | {"at": [0.4, -0.25]}
    found = cause(pull, {"chest": LIGHT, "ball": bystander})
    assert (found.kind, found.objects) == (CauseKind.NO_EFFECT, ("chest",))
    fastened = LIGHT | {"fixed": True}
    assert judged(pull, {"chest": fastened, "ball": bystander}).outcome is Outcome.SUCCESS

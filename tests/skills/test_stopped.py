"""What stopped the arm is named, also where only what it holds touched anything."""

from __future__ import annotations

from dataclasses import replace

import pytest

from etot_cli.skills.action import parse_plan
from etot_cli.skills.motion.motion import PhaseEnd, PhaseTrace, Press, Trace
from etot_cli.skills.outcome import arm_stopped
from etot_cli.skills.placements.motion import put_outcome
from etot_cli.world.state import CauseKind
from tests.skills.helpers import episode
from tests.world.helpers import BALL

STOPPED = PhaseTrace("transit", PhaseEnd.BLOCKED, 0.0, 0.8, 0.04, (0.0,) * 6)


def trace(touching: tuple[str, ...] = (), *presses: Press) -> Trace:
    return Trace((replace(STOPPED, touching=touching, presses=presses),))


def test_who_touches_the_robot_comes_before_who_presses_on_what_it_holds() -> None:
    stopped = trace(
        ("vase", "pen"), Press("pen", "shelf.low", 3.0), Press("oven.door", "pen", 9.0),
        Press("cup", "desk", 50.0),
    )  # fmt: skip
    assert stopped.against("pen") == ("vase", "oven.door", "shelf.low")


def test_what_is_held_ran_into_something() -> None:
    run = episode(pen=BALL | {"at": [0.4, 0.0]})
    run.must("[PICK UP, pen]")
    belief = run.simulated.believe(run.snapshot)
    (action,) = parse_plan("[PUT ON, desk]")
    stopped = trace(("pen",), Press("shelf.low", "pen", 3.0))
    outcome = put_outcome(belief, action, stopped, run.state)
    assert outcome.cause is not None and outcome.another_way
    assert outcome.cause.kind is CauseKind.BLOCKED
    assert outcome.cause.objects == ("shelf", "pen")
    assert outcome.cause.text == "the arm was stopped while carrying pen by shelf.low"


@pytest.mark.parametrize(
    ("against", "text"), [(("desk",), "stopped on its way by desk"), ((), "more than its drives")]
)
def test_the_desk_is_named_and_not_blamed(against: tuple[str, ...], text: str) -> None:
    cause = arm_stopped("on its way", against, ["pen"], 1.0).cause
    assert cause is not None and cause.objects == ("pen",) and text in cause.text

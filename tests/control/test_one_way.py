"""An action is tried one way; another way only after a failure of how it was done."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from etot_cli.control import physics_world, simulated_world
from etot_cli.control.physics_world import Performed
from etot_cli.control.simulated_world import ATTEMPTS
from etot_cli.skills.motion.motion import Motion, Trace
from etot_cli.skills.outcome import DONE, SkillOutcome, failed
from etot_cli.world.state import CauseKind
from tests.skills.helpers import BALL, Episode, episode

SLIP = failed(CauseKind.SLIP, ["ball"], "slipped", another_way=True)
STUCK = failed(CauseKind.BLOCKED, ["toy"], "blocked by the toy")


class Rehearsal:
    """Motions without phases, whose outcomes are given in order."""

    def __init__(self, patch: pytest.MonkeyPatch, outcomes: list[SkillOutcome]) -> None:
        self.worked_out = 0
        self._outcomes = iter(outcomes)
        patch.setattr(simulated_world, "plan_motions", lambda *_: self._motions())
        patch.setattr(physics_world, "outcome_of", lambda *_: next(self._outcomes))
        patch.setattr(physics_world, "run_motion", lambda *_, **__: Trace(()))

    def _motions(self) -> Iterator[Motion]:
        while True:
            self.worked_out += 1
            yield Motion(f"way {self.worked_out}", ())


@pytest.fixture
def run() -> Episode:
    return episode(ball=BALL)


def way(performed: Performed) -> str:
    assert performed.motion is not None
    return performed.motion.action


@pytest.mark.parametrize(
    ("outcomes", "tried", "counts"),
    [
        ([DONE], 1, "way 1"),
        ([STUCK], 1, "way 1"),
        ([SLIP, DONE], 2, "way 2"),
        ([SLIP, STUCK], 2, "way 2"),
        ([SLIP] * ATTEMPTS, ATTEMPTS, "way 1"),
    ],
    ids=["works", "blocked", "slips once", "then blocked", "slips always"],
)
def test_ways_are_tried_one_after_the_other(
    monkeypatch: pytest.MonkeyPatch,
    run: Episode,
    outcomes: list[SkillOutcome],
    tried: int,
    counts: str,
) -> None:
    rehearsal = Rehearsal(monkeypatch, outcomes)
    performed = run.do("[PICK UP, ball]")
    assert rehearsal.worked_out == tried
    assert way(performed) == counts


def test_no_way_at_all_is_a_result(monkeypatch: pytest.MonkeyPatch, run: Episode) -> None:
    monkeypatch.setattr(simulated_world, "plan_motions", lambda *_: iter([STUCK]))
    performed = run.do("[PICK UP, ball]")
    assert performed.record.cause == STUCK.cause and not performed.record.effect
    assert performed.record.steps == 0 and performed.motion is None


def test_what_is_wider_than_the_gripper_is_not_pinched_again_and_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Every chord of it is as wide; physics has its say once."""
    tried: list[Motion] = []
    carried_out = physics_world.run_motion

    def counted(motion: Motion, *given: object) -> Trace:
        tried.append(motion)
        return carried_out(motion, *given)  # type: ignore[arg-type]

    monkeypatch.setattr(physics_world, "run_motion", counted)
    wide = {"kind": "cup", "diameter": 0.09, "height": 0.07, "mass": 0.1, "friction": 0.2,
            "slippery": True, "at": [0.4, 0.1]}  # fmt: skip
    record = episode(mug=wide).do("[PICK UP, mug] (horizontal)").record
    assert record.cause is not None
    assert record.cause.kind in (CauseKind.SLIP, CauseKind.NO_GRASP)
    assert len(tried) == 1 and tried[0].details["width"] > 0.085

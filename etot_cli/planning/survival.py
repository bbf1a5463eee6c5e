"""Judging an action in several varied worlds at once, and what that says about the plan.

World 0 is the nominal one, with the task's own parameters; the others vary them. A world in which
an action fails is dead from then on: the plan has already gone wrong there.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import sqrt
from typing import NamedTuple

from etot_cli.control.simulated import Simulated
from etot_cli.planning.tree import WorldLoss
from etot_cli.reasoning.protocol import Outcome, Reasoner, Verdict
from etot_cli.skills.action import Action
from etot_cli.world.state import RolloutRecord

NOMINAL = 0
"""Index of the world with the task's own parameters."""
Z_95 = 1.959963984540054
"""Two-sided 95 % quantile of the normal distribution."""


class Interval(NamedTuple):
    """A confidence interval of a probability."""

    low: float
    high: float


def wilson(successes: int, trials: int) -> Interval:
    """The Wilson 95 % interval of a success rate; (0, 1) without trials.

    Source: E. B. Wilson, "Probable inference, the law of succession, and statistical inference",
    JASA 22 (1927).
    """
    if trials == 0:
        return Interval(0.0, 1.0)
    rate = successes / trials
    spread = Z_95**2 / trials
    centre = (rate + spread / 2) / (1 + spread)
    half = sqrt(rate * (1 - rate) * spread + spread**2 / 4) / (1 + spread)
    # Rounding must not push the bounds at 0 and 1 outside or off them.
    low = 0.0 if successes == 0 else max(0.0, centre - half)
    high = 1.0 if successes == trials else min(1.0, centre + half)
    return Interval(low, high)


@dataclass(frozen=True, slots=True)
class Survival:
    """In how many of the varied worlds a plan holds."""

    alive: int
    worlds: int

    @property
    def probability(self) -> float:
        """The share of worlds in which the whole plan succeeded."""
        return self.alive / self.worlds

    @property
    def interval(self) -> Interval:
        """Its Wilson 95 % interval."""
        return wilson(self.alive, self.worlds)


@dataclass(frozen=True, slots=True)
class Judgement:
    """The verdict on an action over all worlds, and the rollout that it rests on."""

    verdict: Verdict
    record: RolloutRecord
    survived: tuple[int, ...]
    losses: tuple[WorldLoss, ...]


def judge_worlds(
    reasoner: Reasoner,
    action: Action,
    simulated: Simulated,
    alive: Sequence[int],
    min_survival: float,
) -> Judgement:
    """Judges an action in every world that is still alive.

    It succeeds when the nominal world does and at least ``min_survival`` of all worlds still live:
    a long plan must hold as often as a short one.
    Otherwise the verdict is the nominal world's, or, when only the others fail, that of the first
    world with the most frequent cause, so that a revision works on a failure that really happened.

    Args:
        reasoner: the judge.
        action: the action that was carried out.
        simulated: its outcomes, one per world.
        alive: indices of the living worlds; the nominal one is among them.
        min_survival: share in 0…1.
    """
    verdicts = {world: reasoner.judge(action, simulated.outcomes[world].record) for world in alive}
    survived = tuple(w for w, verdict in verdicts.items() if verdict.outcome is Outcome.SUCCESS)
    losses = tuple(WorldLoss(w, v) for w, v in verdicts.items() if w not in survived)
    world = NOMINAL
    verdict = verdicts[NOMINAL]
    if verdict.outcome is Outcome.SUCCESS and len(survived) < min_survival * len(
        simulated.outcomes
    ):
        world, verdict = _typical(losses)
        if verdict.cause is not None:
            text = f"in {len(losses)} of {len(verdicts)} varied worlds: {verdict.cause.text}"
            verdict = replace(verdict, cause=replace(verdict.cause, text=text))
    if len(simulated.outcomes) == 1:
        losses = ()  # the verdict says it all
    return Judgement(verdict, simulated.outcomes[world].record, survived, losses)


def _typical(losses: Sequence[WorldLoss]) -> WorldLoss:
    """The first loss among those with the most frequent kind of cause."""
    kinds = [loss.verdict.cause.kind if loss.verdict.cause else None for loss in losses]
    # Counter keeps insertion order among equals: ties go to the lowest world.
    frequent = Counter(kinds).most_common(1)[0][0]
    return losses[kinds.index(frequent)]

"""How long a reasoner thinks, apart from the simulation that it waits for."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from etot_cli.planning.acceptance import check_of
from etot_cli.reasoning.protocol import (
    Assignment,
    Branch,
    Doubts,
    FailedStep,
    Reasoner,
    Verdict,
)
from etot_cli.skills.action import Action
from etot_cli.world.state import RolloutRecord, SceneState


class TimedReasoner:
    """Hands every question on to a reasoner and adds up the time that the answers take.

    Branches may be worked out one at a time: the time until each of them comes counts.
    """

    def __init__(self, reasoner: Reasoner) -> None:
        self.inner = reasoner
        self.spent_s = 0.0
        """Wall time in the reasoner [s]."""

    def propose(self, assignment: Assignment, scene: SceneState) -> Iterator[Branch]:
        """As the reasoner does."""
        with self._timed():
            branches = self.inner.propose(assignment, scene)
        return self._one_by_one(branches)

    def check(self, assignment: Assignment, start: SceneState) -> Doubts:
        """As the reasoner does, where it does."""
        with self._timed():
            return check_of(assignment, start, self.inner)

    def judge(self, action: Action, record: RolloutRecord) -> Verdict:
        """As the reasoner does."""
        with self._timed():
            return self.inner.judge(action, record)

    def reflect(self, failed: FailedStep) -> Iterator[Branch]:
        """As the reasoner does."""
        with self._timed():
            branches = self.inner.reflect(failed)
        return self._one_by_one(branches)

    def _one_by_one(self, branches: Iterable[Branch]) -> Iterator[Branch]:
        rest = iter(branches)
        while True:
            with self._timed():
                branch = next(rest, None)
            if branch is None:
                return
            yield branch

    @contextmanager
    def _timed(self) -> Iterator[None]:
        begun = time.monotonic()
        try:
            yield
        finally:
            self.spent_s += time.monotonic() - begun

"""When a run ends before all trials are done: a service that is gone, money that is spent."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from etot_cli.benchmark.trial import TrialResult
from etot_cli.errors import ServiceError

ROUNDS = 2
"""Trials of every worker that may end in a row for want of a service, before one more ends the
run. Each of them has asked several times; one can be chance, a whole night of them helps nobody."""
Status = Literal["success", "interrupted", "limit", "lost"]
"""How a run ended: all trials done; asked to stop; at a limit; for want of a service."""


@dataclass(frozen=True, slots=True)
class Ending:
    """How a run ended; ``reason`` in a sentence, empty for a success."""

    status: Status
    reason: str = ""


INTERRUPTED = Ending("interrupted", "stopped before all trials were done")


@dataclass(slots=True)
class Outage:
    """Tells a service that is gone from one that was away for a moment.

    Methods may use different services: what one of them lacks does not end the others.

    Args:
        jobs: trials that run, and so fail, at the same time.
    """

    jobs: int
    reason: str = ""
    """Of the latest method that was given up, or of the run; empty while there is none."""
    _in_row: Counter[str] = field(default_factory=Counter)
    _gone: set[str] = field(default_factory=set)

    def note(self, method: str, error: BaseException | None) -> None:
        """A trial of a method has ended, with or without an error."""
        for key in ("", method):  # no method is called "": it stands for all of them
            if not isinstance(error, ServiceError):
                self._in_row[key] = 0
                continue
            self._in_row[key] += 1
            if self._in_row[key] > ROUNDS * self.jobs:
                self._gone.add(key)
                self.reason = str(error)

    def over(self, method: str) -> bool:
        """Whether trials of a method need not be begun any more."""
        return bool(self._gone & {"", method})


class Budget:
    """What all trials of a run together may still cost.

    Args:
        most: by names of ``COSTS``.
    """

    def __init__(self, most: Mapping[str, float]) -> None:
        self._most = most
        self._spent = dict.fromkeys(most, 0.0)

    def book(self, result: TrialResult) -> None:
        """A trial has cost something."""
        for name in self._spent:
            self._spent[name] += result.costs.get(name, 0.0)

    @property
    def spent(self) -> str:
        """Why no further trial may be begun; empty while one may."""
        for name, most in self._most.items():
            if self._spent[name] >= most:
                return f"{self._spent[name]:.10g} of {most:.10g} {name} are spent"
        return ""

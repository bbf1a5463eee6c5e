"""Who watches trials, e.g. to draw them."""

from __future__ import annotations

import json
from pathlib import Path

from etot_cli.execution.records import Carried, Happened, Look, PlanMade, Trial
from etot_cli.skills.action import Action, format_plan


class TrialObserver:
    """Watches a trial, e.g. to draw it, and itself does nothing."""

    def planned(self, plan: PlanMade) -> None:
        """There is a plan, or none."""

    def looked(self, look: Look) -> None:
        """The robot has looked."""

    def acting(self, action: Action, index: int) -> None:
        """An action begins; ``index`` counts those of the trial from 0."""

    def acted(self, carried: Carried) -> None:
        """It has its verdict."""

    def disturbed(self, happened: Happened) -> None:
        """Somebody did something."""


class ExecutionObserver(TrialObserver):
    """Watches all trials; of those that run beside each other it is told in words."""

    def trial_started(self, number: int, total: int) -> None:
        """A trial begins; its number from 0."""

    def trial_doing(self, number: int, total: int, text: str) -> None:
        """What a trial that runs beside others has come to."""

    def trial_ended(self, trial: Trial, total: int) -> None:
        """It is over."""


class Notes(TrialObserver):
    """Writes what a trial does into a file that the trials of several processes share, a line each.

    Lines are appended whole, so nobody waits for anybody, and a process that dies leaves nothing
    locked.

    Args:
        file: to append to.
        number: of the trial, from 0.
    """

    def __init__(self, file: Path, number: int) -> None:
        self._file, self._number = file, number

    def planned(self, plan: PlanMade) -> None:
        """The plan."""
        self._write(f"{plan.reason}: {format_plan(plan.actions) or plan.stopped or plan.status}")

    def acting(self, action: Action, index: int) -> None:
        """What is tried."""
        self._write(str(action))

    def acted(self, carried: Carried) -> None:
        """Only what went wrong; otherwise the next action says it."""
        if carried.cause is not None:
            self._write(f"{carried.action} {carried.status}: {carried.cause.text}")

    def disturbed(self, happened: Happened) -> None:
        """What somebody did."""
        self._write(f"somebody: {happened.text}")

    def _write(self, text: str) -> None:
        with self._file.open("a", encoding="utf-8") as file:
            file.write(json.dumps([self._number, text]) + "\n")


class NotesReader:
    """Reads what :class:`Notes` wrote since the last time.

    Args:
        file: that they are in.
    """

    def __init__(self, file: Path) -> None:
        self._file = file
        self._read = 0

    def new(self) -> list[tuple[int, str]]:
        """Trial numbers and what they say, in the order in which it was written."""
        if not self._file.exists():
            return []
        with self._file.open("rb") as file:
            file.seek(self._read)
            lines = file.read().split(b"\n")[:-1]  # the last one is not whole yet, or empty
        self._read += sum(len(line) + 1 for line in lines)
        return [(int(number), str(text)) for number, text in map(json.loads, lines)]

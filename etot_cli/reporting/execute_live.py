"""Watching an execution: the plan with the action under way, what was seen, what differs."""

from __future__ import annotations

import time

from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

from etot_cli.execution.observers import ExecutionObserver
from etot_cli.execution.records import Carried, Happened, Look, PlanMade, Trial
from etot_cli.reporting.live import REFRESHES_PER_SECOND
from etot_cli.reporting.style import (
    LOOKS,
    RUNNING,
    Lines,
    badge,
    counted,
    hanging_lines,
    speaks_unicode,
    symbol,
)
from etot_cli.skills.action import Action, format_plan

EVENTS_KEPT = 8
"""Looks, replans and disturbances that stay in sight."""
TRIALS_KEPT = 12
"""Lines of finished trials that stay in sight."""


class ExecutionLog(Lines, ExecutionObserver):
    """One line per event; ``detailed``: every look too."""

    def trial_started(self, number: int, total: int) -> None:
        """Says which, of several."""
        if total > 1 and self._detailed:
            self._say(f"trial {number + 1} of {total}")

    def trial_doing(self, number: int, total: int, text: str) -> None:
        """Says it."""
        self._say(f"trial {number + 1} of {total}: {text}")

    def trial_ended(self, trial: Trial, total: int) -> None:
        """Says how it ended, of several."""
        if total > 1:
            mark = symbol("success" if trial.success else "failure", self._unicode)
            self._say(f"{mark} trial {trial.number + 1} of {total}: {trial.status}, {trial.reason}")

    def planned(self, plan: PlanMade) -> None:
        """The plan, and why it was made."""
        self._say(f"{plan.reason}: {_plan_words(plan)}")

    def looked(self, look: Look) -> None:
        """What differs; looks that show nothing new in detail only."""
        if self._detailed:
            self._say(f"  look {look.why}: {_seen_words(look)}")

    def acting(self, action: Action, index: int) -> None:
        """What is tried, in detail only."""
        if self._detailed:
            self._say(f"action {index + 1}: {action}")

    def acted(self, carried: Carried) -> None:
        """The verdict."""
        text = f"{symbol(carried.status, self._unicode)} {carried.action}"
        if carried.cause is not None:
            text += f"  {carried.status}: {carried.cause.text}"
        self._say(text)

    def disturbed(self, happened: Happened) -> None:
        """What somebody did."""
        self._say(f"somebody: {happened.text}")


class ExecutionView(ExecutionObserver):
    """Draws the execution in place. A context manager and an observer.

    Args:
        console: a terminal.
        title: what is carried out.
    """

    def __init__(self, console: Console, title: str) -> None:
        self._console, self._title = console, title
        self._unicode = speaks_unicode(console.file)
        self._started = time.monotonic()
        self._trials: list[Text] = []
        self._beside: dict[int, str] = {}
        self._trial = ""
        self._begin()
        self._live = Live(
            console=console, get_renderable=self._render, refresh_per_second=REFRESHES_PER_SECOND
        )

    def _begin(self) -> None:
        self._done: list[Carried] = []
        self._plan: tuple[Action, ...] = ()
        self._left = 0
        self._running: Action | None = None
        self._events: list[Text] = []
        self._replans = 0
        self._note = "planning"

    def __enter__(self) -> ExecutionView:
        self._live.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._running, self._note = None, ""
        self._live.stop()

    def trial_started(self, number: int, total: int) -> None:
        """Starts a new picture."""
        self._begin()
        self._trial = f"trial {number + 1} of {total}" if total > 1 else ""

    def trial_doing(self, number: int, total: int, text: str) -> None:
        """Keeps its last word in sight while it runs."""
        self._beside[number] = text
        self._note = f"{counted(len(self._beside), 'trial')} running"

    def trial_ended(self, trial: Trial, total: int) -> None:
        """Keeps a line of it, of several."""
        self._beside.pop(trial.number, None)
        if total > 1:
            line = badge("success" if trial.success else "failure", self._unicode)
            self._trials.append(line.append(f" trial {trial.number + 1}: {trial.reason}"))
        self._note = ""

    def planned(self, plan: PlanMade) -> None:
        """Shows the plan."""
        self._plan, self._left = plan.actions, len(plan.actions)
        if plan.after_actions or self._replans or self._events:
            self._replans += 1
            self._event(f"planned anew: {plan.reason}", "yellow")
        self._note = "looking"

    def looked(self, look: Look) -> None:
        """Shows what was not as before."""
        if look.differs and not look.why.startswith("after"):
            self._event(f"seen {look.why}: {_seen_words(look)}", "yellow")

    def acting(self, action: Action, index: int) -> None:
        """Marks the action under way."""
        self._running, self._note = action, f"carrying out {action}"

    def acted(self, carried: Carried) -> None:
        """Puts the verdict beside it."""
        self._done.append(carried)
        self._running = None
        if carried.status == "success":
            self._left -= 1
        self._note = "looking"

    def disturbed(self, happened: Happened) -> None:
        """Shows what somebody did."""
        self._event(f"somebody: {happened.text}", "bold magenta")

    def _event(self, text: str, style: str) -> None:
        self._events.append(Text(text, style=style))
        del self._events[:-EVENTS_KEPT]

    def _render(self) -> Group:
        lines = [Text(f"{self._title}  {self._trial}".rstrip(), style="bold")]

        def hang(text: Text, first: str = "  ", rest: str = "    ") -> None:
            lines.extend(hanging_lines(text, self._console, first, rest))

        for ended in self._trials[-TRIALS_KEPT:]:
            hang(ended, "", "  ")
        for number, words in sorted(self._beside.items()):
            line = badge(RUNNING, self._unicode).append(f" trial {number + 1}: {words}")
            line.no_wrap, line.overflow = True, "ellipsis"
            lines.append(line)
        for carried in self._done:
            line = badge(carried.status, self._unicode).append(f" {carried.action}")
            if carried.cause is not None:
                line.append(f"  {carried.cause.text}", style=LOOKS[carried.status].style)
            hang(line)
        coming = self._plan[len(self._plan) - self._left :] if self._left > 0 else ()
        for index, action in enumerate(coming):
            running = index == 0 and self._running is not None
            line = badge(RUNNING if running else "pending", self._unicode)
            hang(line.append(f" {action}", style="bold" if running else "dim"))
        for event in self._events:
            hang(event)
        footer = f"{counted(len(self._done), 'action')}, {counted(self._replans, 'replan')}, "
        footer += f"{time.monotonic() - self._started:.0f} s elapsed"
        lines.append(Text(f"{footer}  {self._note}".rstrip(), style="dim"))
        return Group(*lines)


def _plan_words(plan: PlanMade) -> str:
    if plan.status != "feasible":
        return f"no plan ({plan.stopped or plan.status})"
    return format_plan(plan.actions) or "nothing is to be done"


def _seen_words(look: Look) -> str:
    return "; ".join(f"{item.name} {item.text}" for item in look.differs) or "as expected"

"""What ``--plan`` was given: actions as text, or a plan report."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from etot_cli.errors import PlanSyntaxError
from etot_cli.reporting.replay import plan_from_report
from etot_cli.skills.action import Action, Verb, parse_plan


def report_of(given: str) -> Path:
    """The path of a plan report, from what ``--plan`` was given with ``--open-loop``.

    Raises:
        PlanSyntaxError: it is none.
    """
    path = _report_path(given)
    if path is None:
        raise PlanSyntaxError(
            f"{given[:200]!r} is no report file; --open-loop replays the trajectories of a report "
            "of etot plan"
        )
    return path


def read_plan(given: str) -> tuple[Action, ...]:
    """A plan from what ``--plan`` was given: actions, or the path of a plan report.

    Raises:
        PlanSyntaxError: it is neither.
    """
    if "[" in given and not given.rstrip().endswith(".json"):
        plan = parse_plan(given)
        _check_beside_others(plan)
        return plan
    path = _report_path(given)
    if path is not None:
        return plan_from_report(path)
    raise PlanSyntaxError(
        f"{given[:200]!r} is neither a plan such as '[PICK UP, pen] [PUT ON, desk]' nor a report "
        "file"
    )


def _check_beside_others(actions: Iterable[Action]) -> None:
    """Refuses a place beside the thing itself, or between one thing and itself."""
    held = ""
    for action in actions:
        if action.verb is Verb.PICK_UP:
            held = action.target
        for place in action.where:
            if held in place.landmarks or len(set(place.landmarks)) < len(place.landmarks):
                raise PlanSyntaxError(
                    f"{action}: {place} is no place for {held or 'anything'}; expected one beside "
                    "something else"
                )


def _report_path(given: str) -> Path | None:
    """The file that a text names, there or not; None where it names none."""
    path = Path(given)
    try:
        # An empty text would be the current folder.
        there = bool(given.strip()) and path.exists()
        if there and path.is_dir():
            path = path / "report.json"
    except (OSError, ValueError):  # a name that no file can have
        there = False
    return path if there or given.endswith(".json") else None

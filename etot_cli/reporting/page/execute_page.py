"""The page of an execution: one row per action and per look, and what was believed after each."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from typing import Any

from etot_cli.execution.trial import Trial
from etot_cli.reporting.execute_report import CLASSES, ExecuteReport, LookModel, TrialModel
from etot_cli.reporting.page.assemble import assemble
from etot_cli.reporting.page.pictures import Picture
from etot_cli.reporting.page.timeline import time_parts
from etot_cli.reporting.page.topview import top_view

MAX_PICTURES = 200
"""Views from above on one page; of later trials the rows say it in words."""
CHIPS = {"planned": "success", "lost": "failure"}
"""Statuses of trials that look like another one."""


def execute_page(
    report: ExecuteReport, trials: Sequence[Trial], films: Sequence[tuple[str, str]] = ()
) -> str:
    """The page as text.

    Args:
        report: what happened.
        trials: the same with the states that were believed, for the pictures.
        films: caption and address, shown side by side.
    """
    pictures: dict[str, Picture] = {}
    shown = []
    for model, trial in zip(report.trials, trials, strict=True):
        keys = _draw(trial, pictures)
        shown.append(
            {
                "model": model,
                "chip": CHIPS.get(model.status, model.status),
                "rows": _rows(model, keys),
            }
        )
    failed = sum(trial.status == "failure" for trial in report.trials)
    return assemble(
        "execute.html.j2",
        scripts=(),
        data={},
        pictures=pictures,
        command="execute",
        title=f"{report.task.name}: {report.status}",
        subject=report.task.file,
        heading=report.task.instruction or report.task.name,
        head=report,
        lead=report.reason or f"{report.successes} of {len(report.trials)} succeeded",
        notice="",
        trials=shown,
        films=films,
        failed=failed,
        classes=[(name.replace("_", " "), getattr(report.attribution, name)) for name in CLASSES]
        + [("nobody's", report.attribution.none)],
        repeat=_command(report),
        **time_parts(report.timing),
    )


def _draw(trial: Trial, pictures: dict[str, Picture]) -> dict[int, str]:
    """Views of what was believed after each look; their keys by the look's index."""
    keys: dict[int, str] = {}
    before = None
    for index, look in enumerate(trial.looks):
        if look.scene is None:
            continue
        if len(pictures) < MAX_PICTURES:
            key = f"t{trial.number}l{index}"
            culprits = [item.name for item in look.differs]
            pictures[key] = Picture("svg", top_view(look.scene, before=before, culprits=culprits))
            keys[index] = key
        before = look.scene
    return keys


def _rows(trial: TrialModel, keys: dict[int, str]) -> list[dict[str, Any]]:
    """Plans, looks, disturbances and actions in the order in which they came."""
    # Four places for every look: what somebody did before it, itself, its plan, its action.
    rows = [(look.index * 4, _look_row(look, keys.get(look.index))) for look in trial.looks]
    for plan in trial.plans:
        text = " ".join(plan.actions) or plan.stopped or "nothing is to be done"
        row = _row("plan", plan.reason, text, plan.wall_s, "")
        if plan.status != "feasible":
            row["status"] = "failure"
        rows.append((plan.look * 4 + 1, row))
    for action in trial.actions:
        last = action.looks[-1] if action.looks else 0
        text = action.cause.text if action.cause else ", ".join(
            f"{item.object}: {item.before} → {item.after}" for item in action.moved
        )  # fmt: skip
        row = _row("action", action.action, text, action.end_s - action.begin_s, action.status)
        rows.append((last * 4 + 2, row))
    for item in trial.disturbances:
        after = max((look.index for look in trial.looks if look.time_s <= item.time_s), default=0)
        rows.append((after * 4 + 3, _row("somebody", item.text, "", 0.0, "")))
    return [row for _, row in sorted(rows, key=lambda entry: entry[0])]


def _row(kind: str, what: str, text: str, spent_s: float, status: str) -> dict[str, Any]:
    return {
        "kind": kind, "what": what, "text": text, "seconds": spent_s, "status": status,
        "picture": None,
    }  # fmt: skip


def _look_row(look: LookModel, key: str | None) -> dict[str, Any]:
    text = "; ".join(f"{item.object} {item.text}" for item in look.differs) or "as believed"
    unseen = [f"{item.object} {item.mark}" for item in look.objects if item.mark != "seen"]
    row = _row("look", look.why, "; ".join([text, *unseen]), look.wall_s, "")
    row["picture"] = key
    return row


def _command(report: ExecuteReport) -> str:
    options = report.options
    words = ["etot", "execute", report.task.file, "--robot", options.robot]
    words += ["--perception", options.perception, "--seed", str(report.seed)]
    words += ["--trials", str(options.trials)] if options.trials > 1 else []
    words += [] if options.disturb else ["--no-disturb"]
    words += [] if options.replan else ["--without", "replan"]
    return shlex.join(words)

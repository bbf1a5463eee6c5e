"""The page of an execution: one row per action and per look, and what was believed after each."""

from __future__ import annotations

import shlex
from collections.abc import Sequence

from etot_cli.execution.records import Trial
from etot_cli.reporting.execute_report import CLASSES, ExecuteReport
from etot_cli.reporting.page.assemble import assemble
from etot_cli.reporting.page.pictures import Picture
from etot_cli.reporting.page.timeline import time_parts
from etot_cli.reporting.page.trial_rows import shown_trial


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
    shown = [
        shown_trial(model, trial, pictures)
        for model, trial in zip(report.trials, trials, strict=True)
    ]
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


def _command(report: ExecuteReport) -> str:
    options = report.options
    words = ["etot", "execute", report.task.file, "--robot", options.robot]
    words += ["--perception", options.perception, "--seed", str(report.seed)]
    words += ["--trials", str(options.trials)] if options.trials > 1 else []
    words += [] if options.disturb else ["--no-disturb"]
    words += [] if options.replan else ["--without", "replan"]
    return shlex.join(words)

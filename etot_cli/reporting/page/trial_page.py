"""The page of one trial of a benchmark; drawn, never rendered: a run has hundreds of them."""

from __future__ import annotations

import shlex

from etot_cli.execution.records import Trial
from etot_cli.reporting.page.assemble import assemble
from etot_cli.reporting.page.pictures import Picture
from etot_cli.reporting.page.trial_rows import shown_trial
from etot_cli.reporting.trial_report import TrialReport

SUFFIX = ".html"


def trial_page(report: TrialReport, trial: Trial, title: str, *, repeatable: bool) -> str:
    """The page as text; it stands beside the trial's report, two folders below the benchmark's.

    Args:
        report: of the trial.
        trial: the same with the states that were believed, for the views from above.
        title: the method's.
        repeatable: method, seed and number say all that the trial depends on.
    """
    pictures: dict[str, Picture] = {}
    shown = shown_trial(report.trial, trial, pictures)
    number = report.number + 1
    tiles = [
        (str(len(report.trial.actions)), "actions carried out"),
        (str(report.trial.replans), "replans"),
        (f"{report.costs['nodes']:.0f}", "nodes tried"),
        (f"{report.costs['simulated_s']:.0f} s", "simulated in planning"),
        (f"{report.trial.robot_s:.0f} s", "the robot acted"),
    ]
    return assemble(
        "trial.html.j2",
        scripts=(),
        data={},
        pictures=pictures,
        command="bench",
        title=f"{title}: {report.task.name}, trial {number}: {report.status}",
        subject=f"{report.task.file}, trial {number}",
        heading=f"{title}: {report.task.instruction or report.task.name}",
        head=report,
        lead="; ".join([report.trial.reason, *report.trial.harm]),
        notice="",
        file=f"{report.task.name}-{report.number}.json",
        tiles=tiles,
        shown=shown,
        time_parts=[
            {"name": name.replace("_", " "), "seconds": value, "note": ""}
            for name, value in report.times.items()
        ],
        time_total=sum(report.times.values()),
        repeat=_command(report, trial.number) if repeatable else "",
    )


def _command(report: TrialReport, draw: int) -> str:
    words = ["etot", "bench", report.task.file, "--methods", report.method]
    return shlex.join([*words, "--seed", str(report.seed), "--trials", str(draw + 1)])

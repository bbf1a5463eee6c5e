"""The page of a benchmark: a heat map with intervals, failure classes, costs, and every trial."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from pathlib import Path

from etot_cli.reporting.bench_report import BenchReport, PairedModel, TrialRowModel
from etot_cli.reporting.bench_table import chance, points
from etot_cli.reporting.page.assemble import assemble
from etot_cli.reporting.page.trial_page import SUFFIX
from etot_cli.reporting.style import counted

CLASS_COLOURS = {
    "execution": "p1", "perception": "p2", "world_model": "p4", "planning": "p6", "error": "p5",
}  # fmt: skip
"""Colours of failure classes, by the style sheet's names."""
OTHER = "p5"


def bench_page(report: BenchReport, folder: Path) -> str:
    """The page as text.

    Args:
        report: what was measured.
        folder: of the report; links lead to the pages of trials that are there, and to a trial's
            report where it has none.
    """
    pages = {
        trial.report: page.as_posix()
        for trial in report.trials
        if trial.report and (folder / (page := Path(trial.report).with_suffix(SUFFIX))).is_file()
    }
    cells = {(row.method, row.task): row for row in report.rows}
    means = {item.method: item for item in report.averages}
    titles = {method.name: method.title for method in report.methods}
    lines = []
    for method in report.methods:
        if method.name not in means:
            continue
        row = [cells.get((method.name, task.name)) for task in report.tasks]
        lines.append({"method": method, "cells": row, "mean": means[method.name]})
    failures = [
        {
            "title": titles[item.method],
            "trials": item.trials,
            "parts": [
                {"name": name, "count": count, "colour": CLASS_COLOURS.get(name, OTHER)}
                for name, count in item.failures.items()
            ],
        }
        for item in report.averages
        if item.failures
    ]
    classes = sorted({name for item in report.averages for name in item.failures})
    methods, tasks = counted(len(report.methods), "method"), counted(len(report.tasks), "task")
    return assemble(
        "bench.html.j2",
        scripts=("bench.js",),
        data={"trials": [_row(trial, pages) for trial in report.trials], "titles": titles},
        pictures={},
        command="bench",
        title=f"benchmark: {tasks}, {methods}",
        subject=" ".join(report.inputs),
        heading=f"{methods} on {tasks}",
        head=report,
        lead=f"{counted(len(report.trials), 'trial')}, "
        f"{report.trials_per_cell} per method and task",
        notice="" if report.status == "success" else _ended_early(report.reason),
        lines=lines,
        tasks=report.tasks,
        failures=failures,
        legend=[{"name": name, "colour": CLASS_COLOURS.get(name, OTHER)} for name in classes],
        means=report.averages,
        titles=titles,
        asked=any(item.model_calls for item in report.averages),
        pairs=[pair_row(pair, titles) for pair in report.comparisons],
        repeat=_repeat(report),
    )


def _ended_early(reason: str) -> str:
    return f"Not all trials were run{': ' if reason else ''}{reason.rstrip('.')}."


def _row(trial: TrialRowModel, pages: Mapping[str, str]) -> list[object]:
    """A trial as a short list: hundreds of them are in the page."""
    found = trial.model_dump()
    found["link"] = pages.get(trial.report, trial.report)
    keys = (
        "method", "task", "number", "status", "failure_class", "reason", "replans", "actions",
        "harm", "wall_s", "link", "seed",
    )  # fmt: skip
    return [found[key] for key in keys]


def pair_row(pair: PairedModel, titles: Mapping[str, str]) -> dict[str, object]:
    """A comparison as a row of a table; ``titles``: of the methods that have one."""
    low, high = pair.ci95
    return {
        "first": titles.get(pair.first, pair.first),
        "second": titles.get(pair.second, pair.second),
        "difference": points(pair.difference),
        "interval": f"{points(low)} to {points(high)}",
        "better": pair.second_only,
        "worse": pair.first_only,
        "p": chance(pair).removeprefix("= "),
    }


def _repeat(report: BenchReport) -> str:
    words = ["etot", "bench", *report.inputs, "--trials", str(report.trials_per_cell)]
    words += ["--methods", ",".join(method.name for method in report.methods)]
    words += ["--seed", str(report.seed), "--jobs", str(report.jobs)]
    if report.reasoner != "builtin":
        words += ["--reasoner", report.reasoner]
    return shlex.join(words)

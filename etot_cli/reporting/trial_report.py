"""The report of one trial of a benchmark: schema ``etot.trial/1``."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from etot_cli.benchmark.methods.catalogue import Method
from etot_cli.benchmark.trial import TrialResult
from etot_cli.execution.records import Trial
from etot_cli.reporting.execute_report import TrialModel, trial_model
from etot_cli.reporting.models import Count, Model, Seconds, TaskModel, VersionsModel
from etot_cli.reporting.provenance import versions
from etot_cli.specs.task import Task


class TrialReport(Model):
    """One trial of a benchmark, from its first look to its evaluation."""

    schema_: Literal["etot.trial/1"] = Field(default="etot.trial/1", alias="schema")
    status: Literal["success", "failure", "error"]
    method: str
    task: TaskModel
    number: Count
    """The trial's number in the benchmark, from 0."""
    seed: Count
    versions: VersionsModel
    reason: str
    """Why it failed; empty on success."""
    trial: TrialModel
    """What happened, as in the report of ``etot execute``."""
    costs: dict[str, float]
    times: dict[str, Seconds]
    wall_s: Seconds


def trial_report(task: Task, method: Method, trial: Trial, result: TrialResult) -> TrialReport:
    """A trial's report.

    Args:
        task: the task.
        method: who planned.
        trial: what happened.
        result: the same as a line of the journal.
    """
    return TrialReport.of(
        result,
        method=method.name,
        task=TaskModel.of(task),
        number=result.key.number,
        versions=versions(),
        trial=trial_model(trial, task.success),
    )

"""The report of ``etot bench``: schema ``etot.bench/1``, and that of each trial in it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict
from typing import Annotated, Literal

from pydantic import Field

from etot_cli.benchmark.statistics.paired import Paired, holm
from etot_cli.benchmark.statistics.table import averages, cells, comparisons
from etot_cli.benchmark.trial import TrialResult
from etot_cli.reporting.models import (
    Count,
    Model,
    Seconds,
    TimingModel,
    VersionsModel,
    rounded,
)

DECIMALS = 4
"""Of rates: a trial in ten thousand."""
Share = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False), rounded(DECIMALS)]
Signed = Annotated[float, Field(ge=-1.0, le=1.0, allow_inf_nan=False), rounded(DECIMALS)]
Amount = Annotated[float, Field(ge=0.0, allow_inf_nan=False), rounded(6)]
Probability = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False), rounded(6)]


class BenchTaskModel(Model):
    """A task that was run."""

    name: str
    file: str
    """As named on the command line or in the suite; random problems are in the run's folder."""
    instruction: str
    digest: str
    """SHA-256 of what is in the task and its scene."""


class MethodModel(Model):
    """A method that was run."""

    name: str
    title: str
    summary: str
    replans: bool
    """It plans anew after a failure."""


class RowModel(Model):
    """A method on a task."""

    method: str
    task: str
    successes: Count
    trials: Count
    rate: Share
    ci95: tuple[Share, Share] = Field(validation_alias="interval")
    """Wilson's 95 % interval."""
    errors: Count
    """Trials that could not be carried out; they count as failed."""
    failures: dict[str, Count]
    """Failed trials by class."""


class AverageModel(Model):
    """A method over all tasks; costs are means per trial."""

    method: str
    successes: Count
    trials: Count
    rate: Share
    """The mean of the tasks' rates."""
    ci95: tuple[Share, Share] = Field(validation_alias="interval")
    """Wilson's 95 % interval of all trials together: for these tasks, not for others."""
    failures: dict[str, Count]
    replans: Amount
    planning_s: Seconds
    nodes: Amount
    simulated_s: Seconds
    model_calls: Amount
    model_requests: Amount = 0.0
    """Of these calls, those that no cache had the answer to."""
    input_tokens: Amount
    output_tokens: Amount
    cost: Amount
    """US dollars."""
    wall_s: Seconds
    times: dict[str, Seconds]
    """What the wall time was spent on."""


class PairedModel(Model):
    """Two methods on the same trials."""

    first: str
    second: str
    both: Count
    first_only: Count
    second_only: Count
    neither: Count
    difference: Signed
    """Rate of the second less rate of the first."""
    ci95: tuple[Signed, Signed]
    """Newcombe's 95 % interval for paired proportions."""
    p_value: Probability
    """McNemar's exact test, two-sided."""
    p_adjusted: Probability
    """The same, adjusted by Holm for the number of comparisons."""


class TrialRowModel(Model):
    """A trial in short; the rest is in its own report."""

    method: str
    task: str
    number: Count
    seed: Count
    status: Literal["success", "failure", "error"]
    failure_class: str | None
    reason: str
    replans: Count
    actions: list[str]
    """Carried out, in order; the last one failed where the trial did."""
    harm: list[str]
    wall_s: Seconds
    report: str
    """Its own report, relative to this one's folder; empty where there is none."""


class BenchReport(Model):
    """Who succeeds how often, and at what cost."""

    schema_: Literal["etot.bench/1"] = Field(default="etot.bench/1", alias="schema")
    status: Literal["success", "interrupted", "limit", "lost"]
    """Success: all trials were run, whatever became of them; limit: the run's ``--max-calls`` or
    ``--max-cost`` is spent; lost: a service that trials need is gone."""
    reason: str = ""
    """Why not all trials were run; empty where they were."""
    seed: Count
    interrupted: bool
    versions: VersionsModel
    timing: TimingModel
    inputs: list[str]
    """What was asked for, as named on the command line."""
    tasks: list[BenchTaskModel]
    methods: list[MethodModel]
    trials_per_cell: Count
    reasoner: str
    engine: Literal["local", "ray"]
    jobs: Count
    peak_mib: Amount
    """Largest resident memory of a worker [MiB]."""
    rows: list[RowModel]
    averages: list[AverageModel]
    comparisons: list[PairedModel]
    """The first of these methods, ``etot`` where it is one of them, against each other one."""
    trials: list[TrialRowModel]
    files: dict[str, str]


class CompareReport(Model):
    """Two runs, method by method; the second is the newer one."""

    schema_: Literal["etot.compare/1"] = Field(default="etot.compare/1", alias="schema")
    status: Literal["success", "failure"]
    """Failure: a method got significantly worse."""
    versions: VersionsModel
    first: str
    second: str
    comparisons: list[PairedModel]
    """Each method against itself, on the trials that both runs have."""
    left_out: Count
    """Trials that only one of them has."""


def row_models(
    results: Sequence[TrialResult], methods: Sequence[str], tasks: Sequence[str]
) -> tuple[list[RowModel], list[AverageModel], list[PairedModel]]:
    """Everything that is computed from trials: cells, averages, comparisons."""
    table = cells(results, methods, tasks)
    rows = [RowModel.model_validate(cell) for cell in table]
    means = []
    for item in averages(table, results):
        fields = asdict(item)
        means.append(AverageModel.model_validate({**fields.pop("costs"), **fields}))
    first = [name for name in methods if name == "etot"] + [n for n in methods if n != "etot"]
    return rows, means, paired_models(comparisons(results, first))


def paired_models(found: Iterable[tuple[str, str, Paired]]) -> list[PairedModel]:
    """Comparisons as they stand in reports, with p values adjusted for their number."""
    given = list(found)
    adjusted = holm(pairs.p_value for _, _, pairs in given)
    return [
        PairedModel.of(pairs, first=first, second=second, ci95=pairs.interval, p_adjusted=corrected)
        for (first, second, pairs), corrected in zip(given, adjusted, strict=True)
    ]


def trial_rows(results: Iterable[TrialResult]) -> list[TrialRowModel]:
    """The trials in short."""
    return [
        TrialRowModel.of(
            item,
            method=item.key.method,
            task=item.key.task,
            number=item.key.number,
            actions=[taken.action for taken in item.actions],
        )
        for item in results
    ]

"""``etot bench --compare``: two reports, method by method."""

from __future__ import annotations

from pathlib import Path

from etot_cli.benchmark.statistics.paired import paired
from etot_cli.errors import EtotError
from etot_cli.reporting.bench_report import BenchReport, CompareReport, paired_models
from etot_cli.reporting.bench_table import significantly_worse
from etot_cli.reporting.provenance import versions
from etot_cli.specs.problems import read_json

MAX_REPORT_BYTES = 256 * 1024 * 1024
"""A report of ten thousand trials is a tenth of it."""


def compare(first: Path, second: Path) -> CompareReport:
    """Compares two reports, method by method, on the trials that both have.

    Raises:
        SpecError: a file is no benchmark's report.
        EtotError: they have no trial of the same method in common.
    """
    one, two = load_report(first), load_report(second)
    outcomes = [
        {
            (row.method, row.task, row.number, row.seed, digests.get(row.task)): row.status
            == "success"
            for row in report.trials
        }
        for report in (one, two)
        for digests in [{task.name: task.digest for task in report.tasks}]
    ]
    common = outcomes[0].keys() & outcomes[1].keys()
    found = []
    for method in [model.name for model in one.methods]:
        own = {key for key in common if key[0] == method}
        if own:
            before, after = ({key: given[key] for key in own} for given in outcomes)
            pairs = paired(before, after)
            found.append((method, method, pairs))
    if not found:
        raise EtotError(
            f"{first} and {second} have no trial in common; expected runs of the same tasks with "
            "the same methods and seeds"
        )
    left_out = len(outcomes[0].keys() ^ outcomes[1].keys())
    comparisons = paired_models(found)
    return CompareReport(
        status="failure" if any(map(significantly_worse, comparisons)) else "success",
        versions=versions(),
        first=str(first),
        second=str(second),
        comparisons=comparisons,
        left_out=left_out,
    )


def load_report(path: Path) -> BenchReport:
    """Reads a benchmark's report, from its file or its folder.

    Raises:
        SpecError: it is none.
    """
    file = path / "report.json" if path.is_dir() else path
    return read_json(
        BenchReport, file, MAX_REPORT_BYTES, "report of etot bench", "schema etot.bench/1"
    )

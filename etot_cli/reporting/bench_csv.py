"""A benchmark as CSV: one line per cell, and one per trial."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path

from etot_cli.benchmark.trial import COSTS, TIMES, TrialResult
from etot_cli.reporting.bench_report import RowModel
from etot_cli.reporting.files import write_atomically

ROWS, TRIALS = "rows.csv", "trials.csv"


def write_csv(
    cells: Iterable[RowModel], results: Sequence[TrialResult], folder: Path
) -> dict[str, str]:
    """Writes both files into a folder.

    Returns:
        File name by purpose.

    Raises:
        EtotError: the file system refuses.
    """
    rows = [(r.method, r.task, r.successes, r.trials, r.rate, *r.ci95, r.errors) for r in cells]
    heads = ("method", "task", "successes", "trials", "rate", "ci95_low", "ci95_high", "errors")
    write_atomically(folder / ROWS, _text(heads, rows))
    trials = [
        (
            item.key.method, item.key.task, item.key.number, item.seed, int(item.success),
            item.status.value, item.failure_class or "", item.replans, len(item.actions),
            "; ".join(item.harm), item.reason, *(item.costs.get(name, 0.0) for name in COSTS),
            *(item.times.get(name, 0.0) for name in TIMES), item.wall_s, item.report,
        )
        for item in results
    ]  # fmt: skip
    heads = (
        "method", "task", "number", "seed", "success", "status", "failure_class", "replans",
        "actions", "harm", "reason", *COSTS, *(f"{name}_s" for name in TIMES), "wall_s", "report",
    )  # type: ignore[assignment]  # fmt: skip
    write_atomically(folder / TRIALS, _text(heads, trials))
    return {"table": ROWS, "trials": TRIALS}


def _text(heads: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    stream = io.StringIO()
    # Every text in quotes: a carriage return alone, from a model's reply, would end the line.
    writer = csv.writer(stream, quoting=csv.QUOTE_NONNUMERIC, lineterminator="\n")
    writer.writerow(heads)
    writer.writerows(rows)
    return stream.getvalue()

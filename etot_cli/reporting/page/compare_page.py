"""The page of two runs of a benchmark: how every method's rate changed, with its interval."""

from __future__ import annotations

import shlex

from etot_cli.reporting.bench_report import CompareReport, PairedModel
from etot_cli.reporting.bench_table import significantly_worse
from etot_cli.reporting.page.assemble import assemble
from etot_cli.reporting.page.bench_page import pair_row
from etot_cli.reporting.style import counted


def compare_page(report: CompareReport) -> str:
    """The page as text."""
    worse = [pair.second for pair in report.comparisons if significantly_worse(pair)]
    return assemble(
        "compare.html.j2",
        scripts=(),
        data={},
        pictures={},
        command="bench --compare",
        title="benchmark: two runs compared",
        subject="",
        heading=f"{counted(len(report.comparisons), 'method')}, before and after",
        head=report,
        lead=f"significantly worse: {', '.join(worse)}"
        if worse
        else "no method got significantly worse",
        notice="",
        pairs=[_pair(pair) for pair in report.comparisons],
        left_out=report.left_out,
        before=report.first,
        after=report.second,
        repeat=shlex.join(["etot", "bench", "--compare", report.first, report.second]),
    )


def _pair(pair: PairedModel) -> dict[str, object]:
    low, high = pair.ci95
    return {
        **pair_row(pair, {}),
        "status": "failure" if significantly_worse(pair) else "success",
        # Where they lie on a scale from -100 to +100 points [%].
        "low": 50 + 50 * low,
        "high": 50 + 50 * high,
        "middle": 50 + 50 * pair.difference,
        "trials": pair.both + pair.first_only + pair.second_only + pair.neither,
    }

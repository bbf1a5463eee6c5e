"""The page of two runs of a benchmark: how every method's rate changed, with its interval."""

from __future__ import annotations

import shlex
from dataclasses import dataclass

from etot_cli.reporting.bench_report import CompareReport, PairedModel
from etot_cli.reporting.bench_table import chance, points, significantly_worse
from etot_cli.reporting.models import VersionsModel
from etot_cli.reporting.page.assemble import assemble
from etot_cli.reporting.style import counted


@dataclass(frozen=True, slots=True)
class _Head:
    status: str
    versions: VersionsModel


def compare_page(report: CompareReport, versions: VersionsModel) -> str:
    """The page as text.

    Args:
        report: the comparison.
        versions: of what made it.
    """
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
        head=_Head("failure" if worse else "success", versions),
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
        "second": pair.second,
        "status": "failure" if significantly_worse(pair) else "success",
        "difference": points(pair.difference),
        "interval": f"{points(low)} to {points(high)}",
        # Where they lie on a scale from -100 to +100 points [%].
        "low": 50 + 50 * low,
        "high": 50 + 50 * high,
        "middle": 50 + 50 * pair.difference,
        "better": pair.second_only,
        "worse": pair.first_only,
        "trials": pair.both + pair.first_only + pair.second_only + pair.neither,
        "p": chance(pair).removeprefix("= "),
    }

"""The page beside a benchmark's report."""

from __future__ import annotations

from pathlib import Path

from etot_cli.reporting.bench_report import BenchReport
from etot_cli.reporting.files import write_atomically
from etot_cli.reporting.page.bench_page import bench_page

PAGE_NAME = "report.html"


def write_bench_page(report: BenchReport, folder: Path) -> Path:
    """Writes the page into the report's folder.

    Raises:
        EtotError: the file system refuses.
    """
    path = folder / PAGE_NAME
    write_atomically(path, bench_page(report))
    return path

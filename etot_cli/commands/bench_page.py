"""The page beside a benchmark's report."""

from __future__ import annotations

from pathlib import Path

from etot_cli.reporting.bench_report import BenchReport, CompareReport
from etot_cli.reporting.files import write_atomically
from etot_cli.reporting.page.bench_page import bench_page
from etot_cli.reporting.page.compare_page import compare_page
from etot_cli.reporting.page.trial_page import SUFFIX

PAGE_NAME = "report.html"


def write_bench_page(report: BenchReport, folder: Path) -> Path:
    """Writes the page into the report's folder, with links to the trials' own pages there.

    Raises:
        EtotError: the file system refuses.
    """
    path = folder / PAGE_NAME
    pages = {
        trial.report: page.as_posix()
        for trial in report.trials
        if trial.report and (folder / (page := Path(trial.report).with_suffix(SUFFIX))).is_file()
    }
    write_atomically(path, bench_page(report, pages))
    return path


def write_compare_page(report: CompareReport, folder: Path) -> Path:
    """Writes the page of a comparison.

    Raises:
        EtotError: the file system refuses.
    """
    path = folder / PAGE_NAME
    write_atomically(path, compare_page(report))
    return path

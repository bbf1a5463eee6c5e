"""A benchmark in the terminal: the table of the paper's shape, what failed, and what it cost.

On a terminal a table that is too wide for it is turned: one line per task, methods as columns with
numbers. In a pipe every line is whole, whatever reads it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from rich.table import Table
from rich.text import Text

from etot_cli.reporting.bench_report import AverageModel, BenchReport, PairedModel
from etot_cli.reporting.printer import Printer
from etot_cli.reporting.style import Verbosity, counted

PIPE_WIDTH = 10_000
"""Of a table in a pipe: nothing is wrapped [columns]."""
GOOD, POOR = 0.8, 0.4
"""Rates from which a cell is green, and up to which it is red."""
SIGNIFICANT = 0.05
"""The usual level; p values are adjusted for the number of comparisons."""
LEAST_TOLD = 1e-4
"""P values below this say nothing more."""


class BenchSummary(Printer):
    """Prints a benchmark to a console, as much as the verbosity asks for."""

    def show(self, report: BenchReport, path: Path) -> None:
        """The whole summary."""
        done, total = len(report.trials), _planned_trials(report)
        if self.verbosity is Verbosity.QUIET:
            rates = ", ".join(f"{item.method} {_percent(item.rate)}" for item in report.averages)
            cause = f" ({report.reason})" if report.reason else ""
            self.line(f"{report.status}: {rates or 'no trial was finished'}{cause}")
            return
        self.line("")
        self.line(
            f"{counted(done, 'trial')} of {total}, {counted(len(report.tasks), 'task')}, "
            f"{counted(len(report.methods), 'method')}, seed {report.seed}"
        )
        if report.reason:
            self.line(f"{report.status}: {report.reason}")
        if report.averages:
            self._rates(report)
            self._averages(report)
            self._costs(report)
            for pair in report.comparisons if self.verbosity is Verbosity.VERBOSE else ():
                self.line(f"  {told(pair)}")
        self.files(path, report.files)

    def _rates(self, report: BenchReport) -> None:
        cells = {(row.method, row.task): row for row in report.rows}
        methods = [m for m in report.methods if any(r.method == m.name for r in report.rows)]
        tasks = [t.name for t in report.tasks if any(r.task == t.name for r in report.rows)]

        def cell(method: str, task: str) -> Text:
            row = cells.get((method, task))
            if row is None:
                return Text("-", style="dim")
            return Text(f"{row.successes}/{row.trials}", style=_style(row.rate))

        wide = Table(box=None, pad_edge=False, padding=(0, 1))
        wide.add_column("method", no_wrap=True)
        for task in tasks:
            wide.add_column(task, justify="right", no_wrap=True)
        wide.add_column("avg", justify="right", no_wrap=True)
        means = {item.method: item for item in report.averages}
        for method in methods:
            wide.add_row(
                method.title, *(cell(method.name, task) for task in tasks),
                _percent(means[method.name].rate),
            )  # fmt: skip
        if self._fits(wide):
            self._table(wide)
            return
        tall = Table(box=None, pad_edge=False, padding=(0, 1))
        tall.add_column("task", overflow="ellipsis", no_wrap=True)
        for number in range(1, len(methods) + 1):
            tall.add_column(str(number), justify="right", no_wrap=True)
        for task in tasks:
            tall.add_row(task, *(cell(method.name, task) for method in methods))
        tall.add_row("average", *(_percent(means[method.name].rate) for method in methods))
        self._table(tall)
        for number, method in enumerate(methods, 1):
            self.line(f"  {number} {method.title}: {method.summary}")

    def _averages(self, report: BenchReport) -> None:
        titles = {method.name: method.title for method in report.methods}
        rows = []
        for item in report.averages:
            low, high = item.ci95
            failures = ", ".join(f"{count} {name}" for name, count in item.failures.items())
            rows.append([
                titles[item.method], f"{item.successes}/{item.trials}",
                f"{_percent(low)} to {_percent(high)}", failures,
            ])  # fmt: skip
        self._listed(["over all trials", "rate", "95 % interval", "failures"], rows)

    def _costs(self, report: BenchReport) -> None:
        titles = {method.name: method.title for method in report.methods}
        asked = any(item.model_calls for item in report.averages)
        heads = ["cost per trial", "plan s", "nodes", "sim s", "total s"]
        heads += ["calls", "tokens", "US $"] if asked else []
        rows = [[titles[item.method], *_cost_cells(item, asked)] for item in report.averages]
        self._listed(heads, rows)

    def _listed(self, heads: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
        """A table whose last column may fold, or a line per row where even then it is too wide."""

        def table(filled: Iterable[Sequence[str]]) -> Table:
            made = Table(box=None, pad_edge=False, padding=(0, 1))
            made.add_column(heads[0], no_wrap=True)
            for head in heads[1:-1]:
                made.add_column(head, justify="right", no_wrap=True)
            words = rows[0][-1].replace(".", "").isdigit()
            made.add_column(heads[-1], justify="right" if words else "left", overflow="fold")
            for row in filled:
                made.add_row(*row)
            return made

        if self._fits(table([*row[:-1], max(row[-1].split() or [""], key=len)] for row in rows)):
            self._table(table(rows))
            return
        self.line(f"\n{heads[0]}")
        for row in rows:
            told = [f"{head} {cell}" for head, cell in zip(heads[1:], row[1:], strict=True) if cell]
            self.console.print(f"  {row[0]}: {', '.join(told)}", markup=False, highlight=False)

    def _fits(self, table: Table) -> bool:
        if not self.console.is_terminal:
            return True
        options = self.console.options.update(max_width=PIPE_WIDTH)
        return table.__rich_measure__(self.console, options).maximum <= self.console.width

    def _table(self, table: Table) -> None:
        self.console.print()
        width = self.console.width
        if not self.console.is_terminal:
            self.console.width = PIPE_WIDTH
        try:
            self.console.print(table)
        finally:
            self.console.width = width


def told(pair: PairedModel) -> str:
    """A comparison in a line."""
    low, high = pair.ci95
    return (
        f"{pair.second} against {pair.first}: {points(pair.difference)} points "
        f"(95 % interval {points(low)} to {points(high)}), "
        f"{pair.second_only} better, {pair.first_only} worse of "
        f"{pair.both + pair.first_only + pair.second_only + pair.neither}, "
        f"p {chance(pair)}"
    )


def chance(pair: PairedModel) -> str:
    """The p value as it reads after "p"; reports round it to six digits."""
    return f"= {pair.p_adjusted:.3g}" if pair.p_adjusted >= LEAST_TOLD else f"< {LEAST_TOLD:g}"


def significantly_worse(pair: PairedModel) -> bool:
    """Whether the second is worse beyond chance."""
    return pair.difference < 0 and pair.p_adjusted < SIGNIFICANT


def _planned_trials(report: BenchReport) -> int:
    return report.trials_per_cell * len(report.tasks) * len(report.methods)


def _cost_cells(item: AverageModel, asked: bool) -> list[str]:
    cells = [f"{item.planning_s:.1f}", f"{item.nodes:.1f}", f"{item.simulated_s:.0f}",
             f"{item.wall_s:.1f}"]  # fmt: skip
    if asked:
        tokens = item.input_tokens + item.output_tokens
        cells += [f"{item.model_calls:.1f}", f"{tokens:.0f}", f"{item.cost:.4f}"]
    return cells


def _percent(rate: float) -> str:
    return f"{100 * rate:.0f} %"


def points(difference: float) -> str:
    """A difference of rates as percentage points, with its sign."""
    return f"{100 * difference:+.0f}"


def _style(rate: float) -> str:
    return "green" if rate >= GOOD else "red" if rate <= POOR else "yellow"

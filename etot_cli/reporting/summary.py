"""The last words of a command in the terminal, made from its report."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from etot_cli.reporting.models import CauseModel
from etot_cli.reporting.plan_report import NodeModel, PlanReport, VlmModel
from etot_cli.reporting.simulate_report import SimulateReport
from etot_cli.reporting.style import LOOKS, Verbosity, badge, speaks_unicode

MAX_FAILURES = 6
"""Different failures shown unless more detail is asked for."""

HEADLINES = {
    "feasible": "feasible plan",
    "infeasible": "no feasible plan",
    "limit": "no plan within the limits",
    "interrupted": "interrupted",
    "success": "the plan works",
    "failure": "the plan fails",
    "unsafe": "the plan is unsafe",
}


class Summary:
    """Prints summaries to a console, as much as the verbosity asks for."""

    def __init__(self, console: Console, verbosity: Verbosity) -> None:
        self._console = console
        self._verbosity = verbosity
        self._unicode = speaks_unicode(console.file)

    def plan(self, report: PlanReport, path: Path) -> None:
        """What a search found."""
        if self._verbosity is Verbosity.QUIET:
            self._plain(" ".join([f"{report.status}:", *report.plan]))
            return
        self._headline(report.status, report.task.instruction)
        if report.understood.goal_holds:
            self._plain("  The goal already holds; there is nothing to do.")
        by_id = {node.id: node for node in report.tree.nodes}
        self._steps([by_id[number] for number in report.plan_nodes])
        self._failures(report)
        if report.stopped:
            self._plain(f"  {report.stopped}")
        self._numbers(report)
        self._files(path, report.files)

    def simulate(self, report: SimulateReport, path: Path) -> None:
        """How a plan went."""
        if self._verbosity is Verbosity.QUIET:
            self._plain(f"{report.status}: {report.cause or ' '.join(report.plan)}")
            return
        self._headline(report.status, report.task.instruction)
        table = _grid()
        for step in report.steps:
            table.add_row(
                str(step.index + 1),
                badge(step.status, self._unicode),
                _name(step.action, step.safe),
                _why(step.status, step.cause),
                ", ".join(step.changes),
            )
        for index, action in enumerate(report.plan[len(report.steps) :], len(report.steps)):
            table.add_row(str(index + 1), badge("pending", self._unicode), action, "not tried", "")
        self._show(table)
        if report.success_conditions is not None:
            for condition in report.success_conditions.conditions:
                status = "success" if condition.held else "failure"
                word = "holds" if condition.held else "does not hold"
                line = Text("  ").append_text(badge(status, self._unicode))
                self._console.print(line.append(f" {condition.condition}: {word}"))
        if report.cause is not None:
            self._plain(f"  {report.cause}")
        self._files(path, report.files)

    def _headline(self, status: str, instruction: str) -> None:
        line = badge(status, self._unicode)
        line.append(f" {HEADLINES[status]}", style=LOOKS[status].style)
        if instruction:
            line.append(f"  {instruction}", style="italic")
        self._console.print()
        self._console.print(line)

    def _steps(self, nodes: Sequence[NodeModel]) -> None:
        if not nodes:
            return
        table = _grid()
        for number, node in enumerate(nodes, 1):
            note = node.origin if self._verbosity is Verbosity.VERBOSE else ""
            table.add_row(
                str(number),
                badge(node.status, self._unicode),
                _name(node.action, node.safe),
                note,
                ", ".join(node.changes),
            )
        self._show(table)

    def _failures(self, report: PlanReport) -> None:
        failed = [node for node in report.tree.nodes if node.status in ("failure", "unsafe")]
        if not failed:
            return
        # One line per action and cause: the same failure often recurs behind other histories.
        distinct: dict[tuple[str, str], tuple[NodeModel, int]] = {}
        for node in failed:
            key = (node.action, node.cause.text if node.cause else node.status)
            first, count = distinct.get(key, (node, 0))
            distinct[key] = (first, count + 1)
        shown = list(distinct.values())
        if self._verbosity is not Verbosity.VERBOSE:
            shown = shown[:MAX_FAILURES]
        self._plain("  What did not work")
        table = _grid()
        for node, count in shown:
            times = f"{count} times" if count > 1 else ""
            table.add_row(
                "",
                badge(node.status, self._unicode),
                _name(node.action, node.safe),
                _why(node.status, node.cause),
                times,
            )
        self._show(table)
        hidden = len(distinct) - len(shown)
        if hidden:
            self._plain(f"     {hidden} more in the report")

    def _numbers(self, report: PlanReport) -> None:
        cost = report.statistics
        line = (
            f"  {cost.nodes_evaluated} nodes evaluated, {cost.reflections} reflections, "
            f"{cost.simulated_s:.1f} s simulated in {cost.wall_s:.1f} s"
        )
        if cost.limit is not None:
            named = f"--{cost.limit.replace('_', '-')}"
            line += f"; stopped by {'the service' if cost.limit == 'service' else named}"
        self._console.print(Text(line, style="dim"))
        if report.vlm is not None:
            self._model(report.vlm)
        survival = report.survival
        if survival is not None and survival.worlds > 1:
            low, high = survival.ci95
            self._plain(
                f"  holds in {survival.alive} of {survival.worlds} varied worlds: "
                f"{survival.probability:.0%} (95 % interval {low:.0%} to {high:.0%})"
            )

    def _model(self, vlm: VlmModel) -> None:
        total = vlm.total
        line = (
            f"  {vlm.model}: {total.requests} requests, {total.cached} cached, "
            f"{total.input_tokens} + {total.output_tokens} tokens"
        )
        if total.cost is not None and total.requests:
            line += f", ${total.cost:.4f}"
        self._console.print(Text(line, style="dim"))

    def _files(self, path: Path, files: dict[str, str]) -> None:
        for purpose, name in files.items():
            self._plain(f"  {purpose}: {path.parent / name}")
        self._plain(f"  report: {path}")

    def _plain(self, text: str) -> None:
        # Paths and actions hold brackets, which are no markup; nothing is cut at the width.
        self._console.print(text, markup=False, soft_wrap=True)

    def _show(self, table: Table) -> None:
        self._console.print(Padding(table, (0, 0, 0, 2)))


def _grid() -> Table:
    table = Table.grid(padding=(0, 2, 0, 0))
    table.add_column(justify="right", style="dim")
    table.add_column()
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    table.add_column(style="dim", overflow="fold")
    return table


def _name(action: str, safe: bool) -> Text:
    text = Text(action)
    return text.append(" safe place", style="dim") if safe else text


def _why(status: str, cause: CauseModel | None) -> Text:
    if status == "success":
        return Text("")
    kind = status if cause is None else f"{status}, {cause.kind.value}"
    text = Text().append(kind, style=LOOKS[status].style)
    return text if cause is None else text.append(f": {cause.text}")

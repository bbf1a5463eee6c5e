"""The last words of ``etot plan`` in the terminal, made from its report."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rich.text import Text

from etot_cli.reporting.failures import Failure, distinct_failures
from etot_cli.reporting.plan_report import DoubtModel, PlanReport
from etot_cli.reporting.printer import Printer, named, widest
from etot_cli.reporting.style import LOOKS, Verbosity, counted
from etot_cli.reporting.tree_report import NodeModel
from etot_cli.reporting.vlm_report import VlmModel

MAX_FAILURES = 6
"""Different failures shown unless more detail is asked for, and fewer on a low screen."""
LINES_PER_FAILURE = 2
"""What was done, and why it did not work."""
LINES_BESIDES = 10
"""Headline, numbers, files and the prompt: what else has to fit on the screen."""


def plan_summary(out: Printer, report: PlanReport, path: Path) -> None:
    """What a search found."""
    failures = distinct_failures(report.tree.nodes)
    if out.verbosity is Verbosity.QUIET:
        out.line(f"{report.status}: {_answer(report, failures)}")
        return
    out.headline(report.status, report.task.instruction, _stopped_by(report))
    if report.understood.goal:
        choices = "".join(f"; {choice}" for choice in report.understood.choices)
        out.say(f"understood as: {report.understood.goal}{choices}", 2)
    if report.understood.goal_holds:
        out.say("The goal already holds; there is nothing to do.", 2)
    by_id = {node.id: node for node in report.tree.nodes}
    _steps(out, [by_id[number] for number in report.plan_nodes])
    if report.prefix is not None and report.status != "infeasible":
        out.say("As far as it came", 2)
        _steps(out, [by_id[number] for number in report.prefix.nodes])
        if report.prefix.missing:  # else all of it works, and is not what was asked for
            out.say(f"then {' '.join(report.prefix.missing)}", 4)
    _failures(out, failures, len(report.plan_nodes))
    _doubts(out, report.doubts)
    if report.stopped:
        out.say(report.stopped, 2)
    shortfall = _shortfall(report)
    if report.success is not None and shortfall:
        out.say(shortfall, 2)
        for condition in report.success.conditions:
            out.condition(condition.condition, condition.holds)
    _numbers(out, report)
    out.files(path, report.files)


def _steps(out: Printer, nodes: Sequence[NodeModel]) -> None:
    columns = widest(nodes)
    for number, node in enumerate(nodes, 1):
        notes = [node.origin] if out.verbosity is Verbosity.VERBOSE else []
        out.action(number, node.status, node.action, node.safe, notes + node.told(), columns)


def _failures(out: Printer, failures: Sequence[Failure], steps: int) -> None:
    if not failures:
        return
    shown = list(failures)
    if out.verbosity is not Verbosity.VERBOSE:
        room = MAX_FAILURES
        if out.console.is_terminal:
            room = (out.console.height - steps - LINES_BESIDES) // LINES_PER_FAILURE
        shown = shown[: max(1, min(room, MAX_FAILURES))]
    out.say("What did not work", 2)
    for failure in shown:
        line = out.badge(failure.node.status).append(" ")
        if failure.history:
            line.append(f"{failure.history} ", style="dim")
        line.append_text(named(failure.node.action, failure.node.safe))
        if failure.times > 1:
            line.append(f"  {failure.times} times", style="dim")
        out.say(line, 4, 6)
        out.why(failure.node.status, failure.kind, failure.text, 6)
    hidden = len(failures) - len(shown)
    if hidden:
        out.say(f"{hidden} more in the report", 4)


def _doubts(out: Printer, doubts: Sequence[DoubtModel]) -> None:
    """Plans that were refused, those for the same reason told once."""
    alike: dict[str, list[DoubtModel]] = {}
    for doubt in doubts:
        alike.setdefault(doubt.why, []).append(doubt)
    shown = list(alike.values())
    if out.verbosity is not Verbosity.VERBOSE:
        shown = shown[:MAX_FAILURES]
    for same in shown:
        text = _refused(min(same, key=lambda doubt: len(doubt.actions)))
        if len(same) > 1:
            text += f"; so it is with {counted(len(same) - 1, 'other plan')}"
        out.say(Text(text, style=LOOKS["failure"].style), 2)
    hidden = len(alike) - len(shown)
    if hidden:
        out.say(f"{counted(hidden, 'other reason')} to refuse plans in the report", 4)


def _numbers(out: Printer, report: PlanReport) -> None:
    cost = report.statistics
    line = (
        f"{counted(cost.nodes_evaluated, 'node')} evaluated, "
        f"{counted(cost.reflections, 'reflection')}, "
        f"{cost.simulated_s:.1f} s simulated in {cost.wall_s:.1f} s"
    )
    out.say(Text(line, style="dim"), 2)
    if out.verbosity is Verbosity.VERBOSE and cost.physics_s + cost.kinematics_s > 0:
        line = (
            f"processes: physics {cost.physics_s:.1f} s, inverse kinematics "
            f"{cost.kinematics_s:.1f} s; reasoning {cost.reasoning_s:.1f} s"
        )
        out.say(Text(line, style="dim"), 2)
    if report.vlm is not None:
        _model(out, report.vlm)
    survival = report.survival
    if survival is not None and survival.worlds > 1:
        low, high = survival.ci95
        out.say(
            f"holds in {survival.alive} of {survival.worlds} varied worlds: "
            f"{survival.probability:.0%} (95 % interval {low:.0%} to {high:.0%})",
            2,
        )


def _model(out: Printer, vlm: VlmModel) -> None:
    total = vlm.total
    line = (
        f"{vlm.model}: {counted(total.requests, 'request')}, {total.cached} cached, "
        f"{total.input_tokens} + {total.output_tokens} tokens"
    )
    if total.cost is not None and total.requests:
        line += f", ${total.cost:.4f}"
    out.say(Text(line, style="dim"), 2)


def _stopped_by(report: PlanReport) -> str:
    """What to say instead of "no plan" where it was not the search that came to that."""
    if report.status == "limit" and report.statistics.limit == "service":
        return "stopped: the model cannot be asked"
    if report.status == "infeasible" and report.vlm is not None and report.stopped:
        return "stopped: the model gave no plan that can be used"
    return ""


def _refused(doubt: DoubtModel) -> str:
    """A plan that worked and does not do what was asked for, in a sentence."""
    if not doubt.actions:
        return f"the model says that nothing is to be done, but {doubt.why}"
    plan = " ".join(doubt.actions)
    return f"the proposed plan {plan} works, but it is not what was asked for: {doubt.why}"


def _shortfall(report: PlanReport) -> str:
    """Why a feasible plan is not the answer, in a sentence; empty when it is."""
    if report.success is None or report.success.holds:
        return ""
    missing = [item.condition for item in report.success.conditions if not item.holds]
    return f"the plan works, but the task is not done after it: {', '.join(missing)} does not hold"


def _answer(report: PlanReport, failures: Sequence[Failure]) -> str:
    """The plan in a line, or the cause that there is none."""
    if report.status == "feasible":
        plan = " ".join(report.plan) or "the goal already holds"
        return "; ".join(filter(None, [_shortfall(report), plan]))
    reasons = [report.stopped] if report.stopped else []
    if failures:
        first = failures[0]
        where = " ".join(filter(None, [first.history, first.node.action]))
        reasons.append(f"{where}: {first.text or first.node.status}")
    if len(failures) > 1:
        reasons.append(f"{len(failures) - 1} more")
    reasons += [_refused(doubt) for doubt in report.doubts[: not reasons]]
    return "; ".join(reasons) or "no branch was proposed"

"""The last words of a command in the terminal, made from its report.

On a terminal, lines wrap under their own indent, down to forty columns; in a pipe every line is
whole, whatever reads it.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.text import Text

from etot_cli.reporting.execute_report import CLASSES, ExecuteReport, HappenedModel, TrialModel
from etot_cli.reporting.failures import Failure, distinct_failures
from etot_cli.reporting.plan_report import DoubtModel, PlanReport
from etot_cli.reporting.simulate_report import SimulateReport
from etot_cli.reporting.style import LOOKS, Verbosity, badge, counted, speaks_unicode
from etot_cli.reporting.tree_report import NodeModel
from etot_cli.reporting.vlm_report import VlmModel

MAX_FAILURES = 6
"""Different failures shown unless more detail is asked for, and fewer on a low screen."""
LINES_PER_FAILURE = 2
LINES_BESIDES = 10
"""Headline, numbers, files and the prompt: what else has to fit on the screen."""
WIDE = 64
"""From this width on, what an action changed stands beside it [columns]."""
LONGEST_NAME = 44
"""Actions are padded to the longest one, up to this [columns]."""

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
        self._console = self.console = console
        self._verbosity = self.verbosity = verbosity
        self._unicode = speaks_unicode(console.file)

    def plan(self, report: PlanReport, path: Path) -> None:
        """What a search found."""
        failures = distinct_failures(report.tree.nodes)
        if self._verbosity is Verbosity.QUIET:
            self._line(f"{report.status}: {_answer(report, failures)}")
            return
        self._headline(report.status, report.task.instruction, _stopped_by(report))
        if report.understood.goal:
            choices = "".join(f"; {choice}" for choice in report.understood.choices)
            self._say(f"understood as: {report.understood.goal}{choices}", 2)
        if report.understood.goal_holds:
            self._say("The goal already holds; there is nothing to do.", 2)
        by_id = {node.id: node for node in report.tree.nodes}
        self._steps([by_id[number] for number in report.plan_nodes])
        if report.prefix is not None and report.status != "infeasible":
            self._say("As far as it came", 2)
            self._steps([by_id[number] for number in report.prefix.nodes])
            self._say(f"then {' '.join(report.prefix.missing)}", 4)
        self._failures(failures, len(report.plan_nodes))
        for doubt in report.doubts:
            self._say(Text(_refused(doubt), style=LOOKS["failure"].style), 2)
        if report.stopped:
            self._say(report.stopped, 2)
        shortfall = _shortfall(report)
        if report.success is not None and shortfall:
            self._say(shortfall, 2)
            for condition in report.success.conditions:
                self._condition(condition.condition, condition.holds)
        self._numbers(report)
        self._files(path, report.files)

    def simulate(self, report: SimulateReport, path: Path) -> None:
        """How a plan went."""
        if self._verbosity is Verbosity.QUIET:
            self._line(f"{report.status}: {report.cause or ' '.join(report.plan)}")
            return
        self._headline(report.status, report.task.instruction)
        widest = _widest([*report.plan])
        for step in report.steps:
            self._action(step.index + 1, step.status, step.action, step.safe, step.changes, widest)
            if step.status != "success":
                kind = step.status if step.cause is None else f"{step.status}, {step.cause.kind}"
                self._why(step.status, kind, step.cause.text if step.cause else "", 6)
        for index, action in enumerate(report.plan[len(report.steps) :], len(report.steps)):
            self._action(index + 1, "pending", action, False, ["not tried"], widest)
        if report.success_conditions is not None:
            for condition in report.success_conditions.conditions:
                self._condition(condition.condition, condition.held)
        if report.cause is not None:
            self._say(report.cause, 2)
        if report.open_loop is not None and report.open_loop.same_end_state is not None:
            same = report.open_loop.same_end_state
            word = "the same, to the byte, as" if same else "another than"
            self._say(f"the end state is {word} when it was planned", 2)
        self._files(path, report.files)

    def execute(self, report: ExecuteReport, path: Path) -> None:
        """How the trials went."""
        many = report.options.trials > 1
        told = f"{report.successes} of {counted(len(report.trials), 'trial')} succeeded"
        if self._verbosity is Verbosity.QUIET:
            why = report.reason or " ".join(item.action for item in report.trials[-1].actions)
            self._line(f"{report.status}: {f'{told}; ' if many else ''}{why}")
            return
        words = {"success": "the task is done", "failure": "the task is not done"}
        if report.options.dry_run:
            words["success"] = "there is a plan; nothing was moved"
        instead = told if many and not report.interrupted else words.get(report.status, "")
        self._headline(report.status, report.task.instruction, instead)
        if many:
            for trial in report.trials:
                self._trial(trial)
            failed = sum(trial.status == "failure" for trial in report.trials)
            if failed:
                self._attribution(report, failed)
        elif report.trials:
            self._only_trial(report.trials[0])
        elif report.reason:
            self._say(report.reason, 2)
        self._files(path, report.files)

    def _trial(self, trial: TrialModel) -> None:
        line = Text(f"{trial.number:>3} ", style="dim")
        line.append_text(badge(_as_verdict(trial.status), self._unicode))
        notes = [counted(len(trial.actions), "action")]
        if trial.replans:
            notes.append(counted(trial.replans, "replan"))
        line.append(f" {', '.join(notes)}")
        if trial.status not in ("success", "planned"):
            kind = f" ({trial.failure_class.replace('_', ' ')})" if trial.failure_class else ""
            line.append(f"  {trial.reason}{kind}")
        self._say(line, 2, 6)

    def _attribution(self, report: ExecuteReport, failed: int) -> None:
        self._say("Whose failure it was", 2)
        for name in (*CLASSES, "none"):
            count = getattr(report.attribution, name)
            word = "nobody's" if name == "none" else name.replace("_", " ")
            self._say(f"{word:<12} {count:>3}  {100 * count / failed:.0f} %", 4)

    def _only_trial(self, trial: TrialModel) -> None:
        widest = _widest([item.action for item in trial.actions])
        happened = list(trial.disturbances)
        for plan in trial.plans:
            # What was done before a plan was made is what it was made for.
            self._happened(happened, plan.after_actions if plan.index else -1)
            if plan.index:
                self._say(f"planned anew: {plan.reason}", 2, 4)
            for item in trial.actions:
                if item.plan != plan.index:
                    continue
                self._happened(happened, item.index)
                self._action(
                    item.index + 1, item.status, item.action, item.safe, item.changes, widest
                )
                if item.status != "success":
                    kind = item.status if item.cause is None else f"{item.cause.kind}"
                    self._why(item.status, kind, item.cause.text if item.cause else "", 6)
        self._happened(happened, len(trial.actions))
        for condition in trial.conditions:
            self._condition(condition.condition, condition.held)
        if trial.status not in ("success", "planned"):
            self._say(trial.reason, 2)
            if trial.failure_class:
                self._say(f"failure of: {trial.failure_class.replace('_', ' ')}", 2)
        numbers = (
            f"{counted(len(trial.actions), 'action')}, {counted(trial.replans, 'replan')}, "
            f"{counted(len(trial.looks), 'look')}, {trial.robot_s:.1f} s of the robot's time; "
            + ", ".join(f"{key} {value:.1f} s" for key, value in trial.timing.items())
        )
        self._say(Text(numbers, style="dim"), 2)

    def _happened(self, left: list[HappenedModel], after_actions: int) -> None:
        """Tells what somebody did up to then, each thing once."""
        while left and left[0].after_actions <= after_actions:
            self._say(f"somebody: {left.pop(0).text}", 2, 4)

    def _headline(self, status: str, instruction: str, instead: str = "") -> None:
        line = badge(status, self._unicode)
        line.append(f" {instead or HEADLINES[status]}", style=LOOKS[status].style)
        if instruction:
            line.append(f"  {instruction}", style="italic")
        self._console.print()
        self._say(line, 0, 2)

    def _steps(self, nodes: Sequence[NodeModel]) -> None:
        widest = _widest([node.action + (" safe place" if node.safe else "") for node in nodes])
        for number, node in enumerate(nodes, 1):
            notes = [node.origin] if self._verbosity is Verbosity.VERBOSE else []
            self._action(number, node.status, node.action, node.safe, notes + node.changes, widest)

    def _action(
        self,
        number: int,
        status: str,
        action: str,
        safe: bool,
        notes: Sequence[str],
        widest: int,
    ) -> None:
        line = Text(f"{number} ", style="dim")
        line = Text().append_text(line).append_text(badge(status, self._unicode))
        line.append(" ").append_text(_name(action, safe))
        if notes and (not self._console.is_terminal or self._console.width >= WIDE):
            line.append(" " * max(2, widest + 4 - line.cell_len + len(str(number)) + 1))
            line.append(", ".join(notes), style="dim")
        self._say(line, 2, 6)

    def _failures(self, failures: Sequence[Failure], steps: int) -> None:
        if not failures:
            return
        shown = list(failures)
        if self._verbosity is not Verbosity.VERBOSE:
            room = MAX_FAILURES
            if self._console.is_terminal:
                room = (self._console.height - steps - LINES_BESIDES) // LINES_PER_FAILURE
            shown = shown[: max(1, min(room, MAX_FAILURES))]
        self._say("What did not work", 2)
        for failure in shown:
            line = badge(failure.node.status, self._unicode).append(" ")
            if failure.history:
                line.append(f"{failure.history} ", style="dim")
            line.append_text(_name(failure.node.action, failure.node.safe))
            if failure.times > 1:
                line.append(f"  {failure.times} times", style="dim")
            self._say(line, 4, 6)
            self._why(failure.node.status, failure.kind, failure.text, 6)
        hidden = len(failures) - len(shown)
        if hidden:
            self._say(f"{hidden} more in the report", 4)

    def _why(self, status: str, kind: str, text: str, indent: int) -> None:
        line = Text().append(kind.replace("_", " "), style=LOOKS[status].style)
        self._say(line.append(f": {text}") if text else line, indent)

    def _condition(self, condition: str, holds: bool) -> None:
        line = badge("success" if holds else "failure", self._unicode)
        line.append(f" {condition}: {'holds' if holds else 'does not hold'}")
        self._say(line, 2, 4)

    def _numbers(self, report: PlanReport) -> None:
        cost = report.statistics
        line = (
            f"{counted(cost.nodes_evaluated, 'node')} evaluated, "
            f"{counted(cost.reflections, 'reflection')}, "
            f"{cost.simulated_s:.1f} s simulated in {cost.wall_s:.1f} s"
        )
        self._say(Text(line, style="dim"), 2)
        if self._verbosity is Verbosity.VERBOSE and cost.physics_s + cost.kinematics_s > 0:
            line = (
                f"processes: physics {cost.physics_s:.1f} s, inverse kinematics "
                f"{cost.kinematics_s:.1f} s; reasoning {cost.reasoning_s:.1f} s"
            )
            self._say(Text(line, style="dim"), 2)
        if report.vlm is not None:
            self._model(report.vlm)
        survival = report.survival
        if survival is not None and survival.worlds > 1:
            low, high = survival.ci95
            self._say(
                f"holds in {survival.alive} of {survival.worlds} varied worlds: "
                f"{survival.probability:.0%} (95 % interval {low:.0%} to {high:.0%})",
                2,
            )

    def _model(self, vlm: VlmModel) -> None:
        total = vlm.total
        line = (
            f"{vlm.model}: {counted(total.requests, 'request')}, {total.cached} cached, "
            f"{total.input_tokens} + {total.output_tokens} tokens"
        )
        if total.cost is not None and total.requests:
            line += f", ${total.cost:.4f}"
        self._say(Text(line, style="dim"), 2)

    def _files(self, path: Path, files: dict[str, str]) -> None:
        # Never wrapped: a path in two pieces cannot be copied.
        for purpose, name in [*files.items(), ("report", path.name)]:
            self._line(f"  {purpose}: {path.parent / name}")

    def _line(self, text: str) -> None:
        """One line, however long; brackets are no markup."""
        self._console.print(text, markup=False, soft_wrap=True)

    def _say(self, content: str | Text, indent: int = 0, hanging: int | None = None) -> None:
        """Prints a line; on a terminal what does not fit goes on below, indented by ``hanging``."""
        text = Text(content) if isinstance(content, str) else content
        first, rest = " " * indent, " " * (indent if hanging is None else hanging)
        if not self._console.is_terminal:
            self._console.print(Text(first).append_text(text), soft_wrap=True)
            return
        width = max(8, self._console.width - len(rest))
        for number, line in enumerate(text.wrap(self._console, width)):
            line.rstrip()
            start = Text(first if number == 0 else rest)
            self._console.print(start.append_text(line), soft_wrap=True)


def _name(action: str, safe: bool) -> Text:
    text = Text(action)
    return text.append(" safe place", style="dim") if safe else text


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
    return f"the model's plan {plan} works, but it is not what was asked for: {doubt.why}"


def _as_verdict(status: str) -> str:
    """How a trial's status looks."""
    return {"planned": "success", "lost": "failure"}.get(status, status)


def _widest(names: Sequence[str]) -> int:
    return min(LONGEST_NAME, max(map(len, names), default=0))


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
    return "; ".join(reasons) or "no branch was proposed"

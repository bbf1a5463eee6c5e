"""The last words of ``etot simulate`` and ``etot execute`` in the terminal, made from reports."""

from __future__ import annotations

from pathlib import Path

from rich.text import Text

from etot_cli.reporting.execute_report import CLASSES, ExecuteReport, HappenedModel, TrialModel
from etot_cli.reporting.printer import Printer, widest
from etot_cli.reporting.simulate_report import SimulateReport
from etot_cli.reporting.style import LOOKS_LIKE, Verbosity, counted


def simulate_summary(out: Printer, report: SimulateReport, path: Path) -> None:
    """How a plan went."""
    if out.verbosity is Verbosity.QUIET:
        out.line(f"{report.status}: {report.cause or ' '.join(report.plan)}")
        return
    out.headline(report.status, report.task.instruction)
    columns = widest(report.steps)
    for step in report.steps:
        out.action(step.index + 1, step.status, step.action, step.safe, step.told(), columns)
        if step.status != "success":
            kind = step.status if step.cause is None else f"{step.status}, {step.cause.kind}"
            out.why(step.status, kind, step.cause.text if step.cause else "", 6)
    for index, action in enumerate(report.plan[len(report.steps) :], len(report.steps)):
        out.action(index + 1, "pending", action, False, ["not tried"], columns)
    if report.success_conditions is not None:
        for condition in report.success_conditions.conditions:
            out.condition(condition.condition, condition.held)
    if report.cause is not None:
        out.say(report.cause, 2)
    if report.open_loop is not None and report.open_loop.same_end_state is not None:
        same = report.open_loop.same_end_state
        word = "the same, to the byte, as" if same else "another than"
        out.say(f"the end state is {word} when it was planned", 2)
    out.files(path, report.files)


def execute_summary(out: Printer, report: ExecuteReport, path: Path) -> None:
    """How the trials went."""
    many = report.options.trials > 1
    told = f"{report.successes} of {counted(len(report.trials), 'trial')} succeeded"
    if out.verbosity is Verbosity.QUIET:
        last = report.trials[-1] if report.trials else None
        planned = last is not None and last.status == "planned"  # nothing was done
        actions = [item.action for item in last.actions] if last else []
        if last and planned:
            actions = last.plans[-1].actions
        why = report.reason or " ".join(actions)
        status = "planned" if planned else report.status
        out.line(f"{status}: {f'{told}; ' if many else ''}{why}")
        return
    words = {"success": "the task is done", "failure": "the task is not done"}
    if report.options.dry_run:
        words["success"] = "there is a plan; nothing was moved"
    instead = told if many and not report.interrupted else words.get(report.status, "")
    out.headline(report.status, report.task.instruction, instead)
    if many:
        for trial in report.trials:
            _trial(out, trial)
        failed = sum(trial.status == "failure" for trial in report.trials)
        if failed:
            _attribution(out, report, failed)
    elif report.trials:
        _only_trial(out, report.trials[0])
    elif report.reason:
        out.say(report.reason, 2)
    out.files(path, report.files)


def _trial(out: Printer, trial: TrialModel) -> None:
    line = Text(f"{trial.number + 1:>3} ", style="dim")
    line.append_text(out.badge(LOOKS_LIKE.get(trial.status, trial.status)))
    notes = [counted(len(trial.actions), "action")]
    if trial.replans:
        notes.append(counted(trial.replans, "replan"))
    line.append(f" {', '.join(notes)}")
    if trial.status not in ("success", "planned"):
        kind = f" ({trial.failure_class.replace('_', ' ')})" if trial.failure_class else ""
        line.append(f"  {trial.reason}{kind}")
    out.say(line, 2, 6)


def _attribution(out: Printer, report: ExecuteReport, failed: int) -> None:
    out.say("Whose failure it was", 2)
    for name in (*CLASSES, "none"):
        count = getattr(report.attribution, name)
        word = "nobody's" if name == "none" else name.replace("_", " ")
        out.say(f"{word:<12} {count:>3}  {100 * count / failed:.0f} %", 4)


def _only_trial(out: Printer, trial: TrialModel) -> None:
    columns = widest(trial.actions)
    happened = list(trial.disturbances)
    for plan in trial.plans:
        # What was done before a plan was made is what it was made for.
        _happened(out, happened, plan.after_actions if plan.index else -1)
        if plan.index:
            out.say(f"planned anew: {plan.reason}", 2, 4)
        for item in trial.actions:
            if item.plan != plan.index:
                continue
            _happened(out, happened, item.index)
            out.action(item.index + 1, item.status, item.action, item.safe, item.changes, columns)
            if item.status != "success":
                kind = item.status if item.cause is None else f"{item.cause.kind}"
                out.why(item.status, kind, item.cause.text if item.cause else "", 6)
    _happened(out, happened, len(trial.actions))
    for condition in trial.conditions:
        out.condition(condition.condition, condition.held)
    if trial.status not in ("success", "planned"):
        out.say(trial.reason, 2)
        if trial.failure_class:
            out.say(f"failure of: {trial.failure_class.replace('_', ' ')}", 2)
    numbers = (
        f"{counted(len(trial.actions), 'action')}, {counted(trial.replans, 'replan')}, "
        f"{counted(len(trial.looks), 'look')}, {trial.robot_s:.1f} s of the robot's time; "
        + ", ".join(f"{key} {value:.1f} s" for key, value in trial.timing.items())
    )
    out.say(Text(numbers, style="dim"), 2)


def _happened(out: Printer, left: list[HappenedModel], after_actions: int) -> None:
    """Tells what somebody did up to then, each thing once."""
    while left and left[0].after_actions <= after_actions:
        out.say(f"somebody: {left.pop(0).text}", 2, 4)

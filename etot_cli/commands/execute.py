"""``etot execute``: carries a task out in closed loop, once or several times."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Literal

from etot_cli.commands.plan import task_model
from etot_cli.errors import EtotError, ServiceError
from etot_cli.execution.cell import TrialOptions
from etot_cli.execution.devices import SIMULATED, DeviceRequest, check_names, open_cell
from etot_cli.execution.observers import ExecutionObserver, Notes, NotesReader, TrialObserver
from etot_cli.execution.planner import TreePlanners
from etot_cli.execution.records import Trial
from etot_cli.execution.trial import run_trial
from etot_cli.planning.options import Limits
from etot_cli.reporting.execute_report import (
    ExecuteOptionsModel,
    ExecuteReport,
    attribution_of,
    trial_model,
)
from etot_cli.reporting.provenance import Stopwatch, versions
from etot_cli.services.redact import public_url, redactor_for
from etot_cli.specs.load import load_task
from etot_cli.specs.task import Task
from etot_cli.world.workers import WorkerLostError, WorkerPool

NOTES_EVERY_S = 0.3
"""Between two readings of what the trials beside each other do [s]; a person reads no faster."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ExecuteOptions:
    """What ``etot execute`` is asked to do."""

    task: Path
    seed: int = 0
    trials: int = 1
    jobs: int = 1
    """Trials that run side by side."""
    disturb: bool = True
    replan: bool = True
    robot: str = SIMULATED
    perception: str = "state"
    dry_run: bool = False
    yes: bool = False
    grasp_url: str | None = None
    record: bool = False
    """Keep the first trial's motions, and foresee them, for pages and films."""
    limits: Limits = field(default_factory=Limits)

    def trial(self, number: int) -> TrialOptions:
        """The options of one trial."""
        return TrialOptions(
            seed=self.seed,
            number=number,
            disturb=self.disturb,
            replan=self.replan,
            perception=self.perception,
            record=self.record and number == 0,
            dry_run=self.dry_run,
        )


@dataclass(slots=True)
class Execution:
    """The report, and what pages and films need besides it."""

    report: ExecuteReport
    task: Task | None
    trials: list[Trial]

    @property
    def lost(self) -> bool:
        """Whether a device was lost."""
        return any(trial.status == "lost" for trial in self.trials)


def run_execute(
    options: ExecuteOptions,
    observer: ExecutionObserver | None = None,
    *,
    given: Task | None = None,
) -> Execution:
    """Carries a task out.

    Ctrl-C (KeyboardInterrupt) does not escape: the robot is stopped and the report says
    ``interrupted``.

    Args:
        options: the task, the robot and how often.
        observer: told of everything.
        given: the task, where it has been read.

    Raises:
        EtotError: the input is unusable or something that is needed is missing.
    """
    watch = Stopwatch()
    task: Task | None = None
    trials: list[Trial] = []
    interrupted = False
    try:
        check_names(options.robot, options.perception)
        if options.jobs > 1 and options.robot.partition(":")[0] != SIMULATED:
            raise EtotError(
                f"--jobs {options.jobs}: there is one robot {options.robot.partition(':')[0]}"
            )
        with watch.phase("load"):
            task = given or load_task(options.task)
        with watch.phase("execute"):
            for trial in _trials(options, task, observer):
                trials.append(trial)
                if observer is not None:
                    observer.trial_ended(trial, options.trials)
                if trial.status in ("interrupted", "lost"):
                    break
    except KeyboardInterrupt:
        interrupted = True
    try:
        report = _report(options, task, trials, interrupted, watch)
    except KeyboardInterrupt:  # further ones are held off for longer than this takes
        report = _report(options, task, trials, True, watch)
    return Execution(report, task, trials)


def _trials(
    options: ExecuteOptions, task: Task, observer: ExecutionObserver | None
) -> Iterator[Trial]:
    if min(options.jobs, options.trials) > 1:
        yield from _side_by_side(options, task, observer)
        return
    with closing(Runner(options, task)) as runner:
        for number in range(options.trials):
            if observer is not None:
                observer.trial_started(number, options.trials)
            yield runner.run(number, observer)


def _side_by_side(
    options: ExecuteOptions, task: Task, observer: ExecutionObserver | None
) -> Iterator[Trial]:
    """Trials in worker processes, as they end.

    Raises:
        ServiceError: a trial's process was lost twice.
    """
    with TemporaryDirectory(prefix="etot-") as folder:
        notes = Path(folder, "notes.jsonl")
        reader = NotesReader(notes)
        with closing(WorkerPool(options.jobs, _begin, (options, task, notes))) as pool:
            waiting: set[Future[Trial]] = {
                pool.submit(_run_one, number) for number in range(options.trials)
            }
            while waiting:
                done, waiting = wait(waiting, NOTES_EVERY_S, return_when=FIRST_COMPLETED)
                if observer is not None:
                    for number, text in reader.new():
                        observer.trial_doing(number, options.trials, text)
                for future in done:
                    try:
                        yield future.result()
                    except WorkerLostError as error:
                        raise ServiceError(f"a trial was lost: {error}") from None


class Runner:
    """Runs trials of one task, one after the other, with planners that they share.

    Args:
        options: how; which trials is said to :meth:`run`.
        task: loaded already.
    """

    def __init__(self, options: ExecuteOptions, task: Task) -> None:
        self._options, self._task = options, task
        self._planners = TreePlanners(seed=options.seed, limits=options.limits)

    def run(self, number: int, observer: TrialObserver | None = None) -> Trial:
        """One trial; its result does not depend on those before it."""
        options = self._options
        trial = options.trial(number)
        request = DeviceRequest(
            task=self._task, options=trial, robot=options.robot, yes=options.yes,
            grasp_url=options.grasp_url,
        )  # fmt: skip
        return run_trial(self._task, self._planners, trial, observer, open_cell(request))

    def close(self) -> None:
        """Ends the planners' processes; idempotent."""
        self._planners.close()


def _begin(options: ExecuteOptions, task: Task, notes: Path) -> tuple[Runner, Path]:
    """Of a worker process: its runner, and where its trials write what they do."""
    return Runner(options, task), notes


def _run_one(begun: tuple[Runner, Path], number: int) -> Trial:
    runner, notes = begun
    return runner.run(number, Notes(notes, number))


def _report(
    options: ExecuteOptions,
    task: Task | None,
    trials: list[Trial],
    interrupted: bool,
    watch: Stopwatch,
) -> ExecuteReport:
    trials.sort(key=lambda trial: trial.number)
    interrupted = interrupted or any(trial.status == "interrupted" for trial in trials)
    successes = sum(trial.success for trial in trials)
    good = sum(trial.success or trial.status == "planned" for trial in trials)
    status: Literal["success", "failure"] = "failure"
    if trials and good == options.trials:
        status = "success"
    limits = options.trial(0)
    return ExecuteReport(
        status="interrupted" if interrupted else status,
        reason="" if status == "success" else _reason(trials, interrupted),
        seed=options.seed,
        interrupted=interrupted,
        versions=versions(),
        timing=watch.timing(),
        task=task_model(options.task, task),
        files={},
        options=ExecuteOptionsModel.of(
            options,
            robot=redactor_for(options.robot, os.environ)(options.robot),
            max_replans=limits.max_replans,
            max_actions=limits.max_actions,
            max_robot_s=limits.max_robot_s,
            max_nodes=options.limits.max_nodes,
            grasp_url=None if options.grasp_url is None else public_url(options.grasp_url),
        ),
        successes=successes,
        trials=[trial_model(trial, task.success if task else ()) for trial in trials],
        attribution=attribution_of(trials),
    )


def _reason(trials: list[Trial], interrupted: bool) -> str:
    failed = next((one for one in trials if one.status not in ("success", "planned")), None)
    if failed is not None:
        return failed.reason
    return "stopped before it began" if interrupted else "not all trials were run"

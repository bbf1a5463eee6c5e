"""``etot bench``: methods on tasks, trial by trial, to a report with rates and intervals."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from etot_cli.benchmark.methods.catalogue import Method, methods_of
from etot_cli.benchmark.running.engine import EngineName, open_engine
from etot_cli.benchmark.running.journal import NAME as JOURNAL
from etot_cli.benchmark.running.journal import Journal
from etot_cli.benchmark.running.manifest import Manifest, agree, read_manifest, throw_away
from etot_cli.benchmark.running.runner import (
    Perform,
    RunObserver,
    TrialWork,
    left_to_do,
    run_trials,
)
from etot_cli.benchmark.running.stopping import INTERRUPTED, Ending
from etot_cli.benchmark.suite import Selection, digest, seeds_of, select
from etot_cli.benchmark.trial import TrialKey, TrialResult
from etot_cli.commands.bench_services import ModelTerms, check_services, check_tasks
from etot_cli.errors import EtotError, SpecError
from etot_cli.reporting.bench_csv import write_csv
from etot_cli.reporting.bench_report import (
    BenchReport,
    BenchTaskModel,
    MethodModel,
    row_models,
    trial_rows,
)
from etot_cli.reporting.provenance import Stopwatch, versions

MAX_RUN = 100_000
"""Trials of a run, tasks and methods together; their report can still be read."""
DEFAULT_TRIALS = 10
"""As many as the paper's tables have."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BenchOptions:
    """What ``etot bench`` is asked to do; None: as the suite says, else the default."""

    inputs: tuple[str, ...]
    seed: int | None = None
    trials: int | None = None
    methods: tuple[str, ...] | None = None
    jobs: int = 1
    engine: str = EngineName.LOCAL.value
    reasoner: str = "builtin"
    vlm: Mapping[str, Any] = field(default_factory=dict)
    video_url: str | None = None
    pages: bool = True
    """A page beside each trial's report."""
    resume: bool = False
    force: bool = False
    """A run that is in the folder already is thrown away."""


@dataclass(frozen=True)
class _Run:
    """What is to be run, resolved."""

    selection: Selection
    inputs: tuple[str, ...]
    methods: list[Method]
    seed: int
    draws: list[tuple[int, int]]
    digests: dict[str, str]

    def work(self) -> list[TrialWork]:
        """All trials as reports list them: by task, then by world, then by method."""
        return [
            TrialWork(TrialKey(task.name, number, method.name), seed, draw)
            for task in self.selection.tasks
            for number, (seed, draw) in enumerate(self.draws)
            for method in self.methods
        ]

    def begun(self, jobs: int) -> list[TrialWork]:
        """The trials in the order in which they are begun.

        Task by task, so that a worker builds few twins, and ``jobs`` worlds at a time, so that
        methods can be compared wherever a run ends. Of these, methods that simulate most, the last
        of the table, come first: no worker is left alone with a long trial at the end.
        """
        tasks = {task.name: rank for rank, task in enumerate(self.selection.tasks)}
        dearest = {method.name: rank for rank, method in enumerate(reversed(self.methods))}

        def place(item: TrialWork) -> tuple[int, ...]:
            key = item.key
            return tasks[key.task], key.number // jobs, dearest[key.method], key.number

        return sorted(self.work(), key=place)


def run_bench(
    options: BenchOptions,
    folder: Path,
    observer: RunObserver | None = None,
    perform: tuple[Perform, Callable[..., None]] | None = None,
) -> BenchReport:
    """Runs all trials that the folder does not have yet.

    Ctrl-C (KeyboardInterrupt) does not escape: the report says ``interrupted``.

    Args:
        options: what to run.
        folder: of the run; trials, their reports and the tables go there.
        observer: told of every trial.
        perform: carries a trial out, and what prepares a worker for it; the real ones when None.

    Returns:
        The report, with all finished trials in the order of the table.

    Raises:
        EtotError: the input is unusable, or the folder holds another run.
    """
    watch = Stopwatch()
    with watch.phase("load"):
        known = None
        if options.resume or not options.force:
            known = read_manifest(folder, resume=options.resume)
        run = _resolved(options, folder, known)
    work = run.work()
    carry_out: Perform
    terms = ModelTerms()
    if perform is None:
        from etot_cli.commands import bench_trial

        terms = check_services(options.reasoner, options.vlm, options.video_url)
        check_tasks(run.selection.tasks, options.reasoner)
        tasks = {task.name: task for task in run.selection.tasks}
        setup: Any = bench_trial.Setup(
            str(folder.resolve()), tasks, run.seed, options.reasoner, options.vlm,
            video_url=options.video_url, pages=options.pages,
        )  # fmt: skip
        carry_out, begin = bench_trial.perform, bench_trial.begin
    else:
        setup = str(folder.resolve())
        carry_out, begin = perform
    if options.force and not options.resume:
        throw_away(folder)
    agree(_described(options, run, terms), known, folder)
    with Journal(folder) as journal, watch.phase("trials"):
        _check_seeds(work, journal)
        ending = Ending("success")
        if left_to_do(work, journal):
            try:
                engine = open_engine(EngineName(options.engine), options.jobs, begin, (setup,))
                try:
                    ending = run_trials(
                        run.begun(options.jobs), carry_out, engine, journal, options.jobs,
                        observer, terms.budget,
                    )  # fmt: skip
                finally:
                    engine.close()
            except KeyboardInterrupt:  # while processes were started or ended
                ending = INTERRUPTED
        finished = journal.results
    results = [finished[item.key] for item in work if item.key in finished]
    try:
        return _report(options, run, results, watch, ending, folder)
    except KeyboardInterrupt:  # further ones are held off for longer than this takes
        return _report(options, run, results, watch, INTERRUPTED, folder)


def _check_seeds(work: Sequence[TrialWork], journal: Journal) -> None:
    """Makes sure that trials that are kept had the worlds of this run.

    Raises:
        SpecError: one had another.
    """
    results = journal.results
    for item in work:
        found = results.get(item.key)
        if found is not None and found.seed != item.seed:
            raise SpecError(
                f"trial {item.key.name} has seed {found.seed}; expected {item.seed}",
                file=str(journal.path),
            )


def _resolved(options: BenchOptions, folder: Path, known: Manifest | None) -> _Run:
    """The options with the suite's wishes and defaults; those of the run that is gone on with."""
    inputs = options.inputs
    if not inputs and known is not None:
        inputs = tuple(known.inputs)
    selection = select(inputs, folder / "tasks")

    def chosen(name: str, default: Any) -> Any:
        own = getattr(options, name)
        if own is not None:
            return own
        wished = getattr(selection, name)
        return getattr(known, name, default) if wished is None else wished

    seed = int(chosen("seed", 0))
    seeds = selection.seeds if options.trials is None and options.seed is None else None
    draws = seeds_of(int(chosen("trials", DEFAULT_TRIALS)), seed, seeds)
    methods = methods_of(chosen("methods", None))
    total = len(selection.tasks) * len(draws) * len(methods)
    if total > MAX_RUN:
        raise EtotError(f"{total} trials; expected at most {MAX_RUN} in one run, do it in parts")
    digests = {task.name: digest(task) for task in selection.tasks}
    return _Run(selection, inputs, methods, seed, draws, digests)


def _described(options: BenchOptions, run: _Run, terms: ModelTerms) -> Manifest:
    found = versions()
    return Manifest(
        inputs=[*run.inputs],
        tasks=run.digests,
        methods=[method.name for method in run.methods],
        trials=len(run.draws),
        seed=run.seed,
        draws=run.draws,
        reasoner=options.reasoner,
        model=terms.name,
        thinking=dict(terms.deciding),
        video=options.video_url is not None,
        etot=found.etot,
        mujoco=found.mujoco,
    )


def _report(
    options: BenchOptions,
    run: _Run,
    results: Sequence[TrialResult],
    watch: Stopwatch,
    ending: Ending,
    folder: Path,
) -> BenchReport:
    """The report, with its tables written beside it."""
    names = [method.name for method in run.methods]
    rows, means, pairs = row_models(results, names, [task.name for task in run.selection.tasks])
    report = BenchReport(
        status=ending.status,
        reason=ending.reason,
        seed=run.seed,
        interrupted=ending.status == "interrupted",
        versions=versions(),
        timing=watch.timing(),
        inputs=[*run.inputs],
        tasks=[
            BenchTaskModel.of(task, digest=run.digests[task.name]) for task in run.selection.tasks
        ],
        methods=[MethodModel.of(method) for method in run.methods],
        trials_per_cell=len(run.draws),
        reasoner=options.reasoner,
        engine=EngineName(options.engine).value,
        jobs=options.jobs,
        peak_mib=max((result.peak_mib for result in results), default=0.0),
        rows=rows,
        averages=means,
        comparisons=pairs,
        trials=trial_rows(results),
        files={"lines": JOURNAL},
    )
    try:
        report.files.update(write_csv(rows, results, folder))
    except EtotError as error:  # the trials are there; the report must not be lost for a table
        report.status, report.reason = "lost", report.reason or str(error)
    return report

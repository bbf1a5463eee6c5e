"""``etot plan``: from a task file to a report with a plan, or with the reasons why not."""

from __future__ import annotations

import time
from collections.abc import Mapping
from contextlib import closing
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from etot_cli import rooms as doors
from etot_cli.commands.timed import TimedReasoner
from etot_cli.control.simulated import Step
from etot_cli.planning.options import Ablation, Limits
from etot_cli.planning.result import (
    SearchObserver,
    SearchResult,
    SearchStatus,
    Statistics,
)
from etot_cli.planning.search import search
from etot_cli.planning.tree import PlanTree
from etot_cli.planning.trials import CHOOSING_WORLDS, try_plan
from etot_cli.reasoning.protocol import Assignment, Explains, Reasoner, Understanding
from etot_cli.reasoning.vlm.accounts import VlmAccount
from etot_cli.reporting.models import TaskModel, seconds
from etot_cli.reporting.plan_report import (
    PlanOptionsModel,
    PlanReport,
    prefix_model,
    success_model,
    understood_model,
)
from etot_cli.reporting.provenance import Stopwatch, versions
from etot_cli.reporting.tree_report import tree_model
from etot_cli.skills.deadline import NEVER, OutOfTimeError
from etot_cli.specs.look import Look
from etot_cli.specs.reading import printable
from etot_cli.specs.scene import Scene
from etot_cli.specs.task import Task
from etot_cli.world.workers import cores

if TYPE_CHECKING:  # few plan with a model
    from etot_cli.reasoning.vlm.session import VlmSession

MODEL = "vlm"
"""Name of the reasoner that asks a vision-language model."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanOptions:
    """What ``etot plan`` is asked to do."""

    task: Path
    seed: int = 0
    reasoner: str = "builtin"
    vary: bool = False
    jobs: int | None = 1
    """One per processor core when None."""
    worlds: int | None = None
    """As the task says when None."""
    look: Look = Look.EACH
    """When the robot looks, in varied worlds."""
    without: frozenset[Ablation] = frozenset()
    limits: Limits = field(default_factory=Limits)
    record: bool = False
    """Keep trajectories, so that pictures can be rendered afterwards."""
    vlm: Mapping[str, Any] = field(default_factory=dict)
    """Settings of the reasoner ``vlm`` that the command line gives; the rest is environment."""


@dataclass(frozen=True, slots=True)
class Planning:
    """A plan report, and what its page needs besides it."""

    report: PlanReport
    scene: Scene | None
    """As planned in, varied or not; None when interrupted before it was read."""
    result: SearchResult


def plan_task(
    options: PlanOptions,
    observer: SearchObserver | None = None,
    rooms: doors.Rooms | None = None,
    *,
    given: Task | None = None,
) -> Planning:
    """Plans a task.

    Ctrl-C (KeyboardInterrupt) does not escape: the report says ``interrupted``.

    Args:
        options: the task and how to plan it.
        observer: told of every step of the search.
        rooms: the rooms below; this package's own when None.
        given: the task, where it has been read.

    Raises:
        EtotError: the input is unusable or something that is needed is missing.
    """
    jobs = options.jobs or cores()
    options = replace(options, jobs=jobs)
    watch = Stopwatch()
    begun_s = time.monotonic()
    task: Task | None = None
    scene: Scene | None = None
    result: SearchResult | None = None
    session: VlmSession | None = None
    reasoner: TimedReasoner | None = None
    interrupted = False
    try:
        rooms = rooms or doors.default_rooms()
        with watch.phase("load"):
            task = given or rooms.load_task(options.task)
            scene = rooms.vary(task.scene, options.seed) if options.vary else task.scene
        with watch.phase("world"):
            if options.reasoner == MODEL:
                # The HTTP client and OpenGL are imported only where a model is asked for.
                from etot_cli.reasoning.vlm.session import open_vlm

                session = open_vlm(
                    options.vlm, scene, seed=options.seed, state=rooms.reasoners["builtin"]()
                )
            reasoner = TimedReasoner(
                session.reasoner if session else rooms.reasoners[options.reasoner]()
            )
            simulator = rooms.open_simulator(
                scene,
                seed=options.seed,
                jobs=jobs,
                worlds=min(options.worlds or task.worlds, CHOOSING_WORLDS),
                look=options.look,
                record=options.record or (session is not None and session.needs_trajectories),
            )
        with closing(simulator), watch.phase("search"):
            result = search(
                Assignment(task.instruction, task.goal),
                session.watch(simulator) if session else simulator,
                reasoner,
                limits=options.limits,
                without=options.without,
                observer=observer,
                costless=session is None,
            )
        if (options.worlds or task.worlds) > 1 and result.final is not None:
            with watch.phase("trials"):
                # The one that planned knows what must not happen on the way.
                judge = rooms.reasoners["builtin"]() if session else reasoner.inner
                result = _tried(options, task, scene, result, begun_s, rooms, judge)
    except KeyboardInterrupt:
        interrupted = True
    finally:
        if session is not None:
            session.close()
    account = session.account() if session is not None else None
    found = result or _nothing()
    understanding = _understanding(None if reasoner is None else reasoner.inner)
    report = _report(options, task, found, interrupted, watch, account, understanding)
    if reasoner is not None:
        report.statistics.reasoning_s = seconds(reasoner.spent_s)
    return Planning(report, scene, found)


def _tried(
    options: PlanOptions,
    task: Task,
    scene: Scene,
    result: SearchResult,
    begun_s: float,
    rooms: doors.Rooms,
    judge: Reasoner,
) -> SearchResult:
    """The result with the odds of its plan, from worlds that did not choose it."""
    limit = options.limits.time_limit_s
    until_s = NEVER if limit is None else begun_s + limit
    nodes = () if result.leaf is None else result.leaf.path
    steps = [Step(node.action, result.rollouts[node.id].motion) for node in nodes]
    trials = rooms.open_trials(
        scene,
        seed=options.seed,
        jobs=options.jobs or cores(),
        worlds=options.worlds or task.worlds,
        look=options.look,
    )
    try:
        with closing(trials):
            survival = try_plan(steps, trials, judge, task.success, until_s)
    except OutOfTimeError:
        return replace(result, survival=None)
    return replace(result, survival=survival)


def _understanding(reasoner: object) -> Understanding | None:
    """What a reasoner says that it understood, if it is one that says so."""
    return reasoner.understanding if isinstance(reasoner, Explains) else None


def _nothing() -> SearchResult:
    """Stands for a search that was interrupted before it began."""
    return SearchResult(
        status=SearchStatus.INTERRUPTED,
        leaf=None,
        tree=PlanTree(),
        statistics=Statistics(),
        branches=(),
    )


def _report(
    options: PlanOptions,
    task: Task | None,
    result: SearchResult,
    interrupted: bool,
    watch: Stopwatch,
    account: VlmAccount | None,
    understanding: Understanding | None,
) -> PlanReport:
    status = SearchStatus.INTERRUPTED if interrupted else result.status
    return PlanReport.model_validate(
        {
            "status": status.value,
            "seed": options.seed,
            "interrupted": status is SearchStatus.INTERRUPTED,
            "versions": versions(),
            "timing": watch.timing(),
            "task": task_model(options.task, task),
            "files": {},
            "options": PlanOptionsModel.of(
                options,
                worlds=options.worlds or (task.worlds if task else 1),
                without=[ablation.value for ablation in Ablation if ablation in options.without],
                max_nodes=options.limits.max_nodes,
                time_limit_s=options.limits.time_limit_s,
            ),
            "plan": [str(action) for action in result.plan],
            "plan_nodes": [] if result.leaf is None else [node.id for node in result.leaf.path],
            "survival": result.survival,
            "success": None if task is None else success_model(task.success, result.final),
            "prefix": prefix_model(result.prefix),
            "understood": understood_model(result.goal_holds, result.branches, understanding),
            "tree": tree_model(result),
            "statistics": {**asdict(result.statistics), "limit": result.limit},
            "doubts": [{"actions": actions, "why": why} for actions, why in result.doubts.items()],
            "stopped": result.stopped,
            "vlm": account,
        }
    )


def task_model(file: Path, task: Task | None) -> TaskModel:
    """The task as it stands in reports; None when the command was stopped before it was read."""
    if task is None:
        return TaskModel(name=file.stem, file=printable(file), instruction="")
    return TaskModel.of(task, file=printable(file))

"""``etot simulate``: carries a given plan out in the simulator, judging every action."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Protocol

from etot_cli import rooms as doors
from etot_cli.commands.given_plan import read_plan, report_of
from etot_cli.commands.plan import task_model
from etot_cli.control.simulated import Simulator
from etot_cli.planning.conditions import holds
from etot_cli.reasoning.protocol import Outcome, Reasoner, Verdict
from etot_cli.reporting.evidence import judged_fields
from etot_cli.reporting.provenance import Stopwatch, versions
from etot_cli.reporting.recordings import RecordedPlan, recorded_plan
from etot_cli.reporting.simulate_report import (
    ConditionModel,
    OpenLoopModel,
    SimulateReport,
    StartErrorModel,
    StepModel,
    SuccessConditionsModel,
)
from etot_cli.skills.action import Action, parse_plan
from etot_cli.specs.look import Look
from etot_cli.specs.scene import Scene
from etot_cli.specs.start_error import StartError, with_start_error
from etot_cli.specs.task import Task
from etot_cli.specs.wording import describe
from etot_cli.world.state import RolloutRecord, SceneState


@dataclass(frozen=True, slots=True, kw_only=True)
class SimulateOptions:
    """What ``etot simulate`` is asked to do. ``plan``: the actions, or a plan report's path."""

    task: Path
    plan: str
    seed: int = 0
    vary: bool = False
    look: Look = Look.EACH
    """When the robot looks, in a varied world."""
    open_loop: bool = False
    """Send the trajectories of the plan report as they are."""
    error: StartError | None = None
    """With ``open_loop``: how far the start poses are off."""
    record: bool = False
    """Keep the trajectories, so that frames or a video can be rendered afterwards."""


class StepObserver(Protocol):
    """Watches a simulation."""

    def step_started(self, index: int, action: Action, total: int) -> None:
        """An action begins; ``index`` counts from 0."""
        ...

    def step_judged(self, step: StepModel) -> None:
        """It has its verdict."""
        ...


@dataclass(slots=True)
class Simulation:
    """A simulation's report, and what rendering needs of it."""

    report: SimulateReport
    scene: Scene | None
    """As simulated, varied or not; None when interrupted before it was read."""
    trajectories: list[object] = field(default_factory=list)
    records: list[RolloutRecord] = field(default_factory=list)
    """What each step did, in order."""


@dataclass(slots=True)
class _Run:
    """What a simulation has come to so far; complete enough for a report at any moment."""

    task: Task | None = None
    scene: Scene | None = None
    plan: tuple[Action, ...] = ()
    steps: list[StepModel] = field(default_factory=list)
    trajectories: list[object] = field(default_factory=list)
    records: list[RolloutRecord] = field(default_factory=list)
    final: SceneState | None = None
    end_digest: str | None = None
    recorded: RecordedPlan | None = None
    interrupted: bool = False


def run_simulate(
    options: SimulateOptions,
    observer: StepObserver | None = None,
    rooms: doors.Rooms | None = None,
    *,
    given: Task | None = None,
) -> Simulation:
    """Simulates a plan from the task's start, up to the first action that does not succeed.

    Ctrl-C (KeyboardInterrupt) does not escape: the report says ``interrupted``.

    Args:
        options: the task and the plan.
        observer: told of every action.
        rooms: the rooms below; this package's own when None.
        given: the task, where it has been read.

    Raises:
        EtotError: the input is unusable or something that is needed is missing.
    """
    watch = Stopwatch()
    run = _Run()
    try:
        rooms = rooms or doors.default_rooms()
        with watch.phase("load"):
            run.task = given or rooms.load_task(options.task)
            # Text that is no plan is refused before the world is built; names need the world.
            if options.open_loop:
                run.recorded = recorded_plan(report_of(options.plan))
                run.plan = run.recorded.actions
            else:
                run.plan = read_plan(options.plan)
        with watch.phase("world"):
            reasoner = rooms.reasoners["builtin"]()
            simulator = _opened(run, run.task.scene, options, rooms)
        with closing(simulator), watch.phase("simulate"):
            _carry_out(run, simulator, reasoner, rooms, observer)
    except KeyboardInterrupt:
        run.interrupted = True
    return Simulation(_report(options, run, watch), run.scene, run.trajectories, run.records)


def _opened(run: _Run, scene: Scene, options: SimulateOptions, rooms: doors.Rooms) -> Simulator:
    """The world to act in; ``run`` learns its scene."""
    if run.recorded is None:
        truth = rooms.vary_truth(scene, options.seed) if options.vary else None
        run.scene = truth or scene
        return rooms.open_simulator(
            scene,
            seed=options.seed,
            jobs=1,
            worlds=1,
            record=options.record,
            truth=truth,
            look=options.look,
        )
    if run.recorded.drawn_with is not None:
        scene = rooms.vary(scene, run.recorded.drawn_with)
    run.scene = scene
    if options.error is not None:
        run.scene = with_start_error(scene, options.error, vary=options.vary)
    if options.error is not None or options.vary:
        run.scene = rooms.vary_truth(run.scene, options.seed)
    # MuJoCo is imported only where something is simulated by this package's own rooms.
    from etot_cli.control.replaying import open_replay

    return open_replay(
        scene,
        run.recorded.recordings,
        truth=run.scene,
        seed=options.seed,
        record=options.record,
    )


def _carry_out(
    run: _Run,
    simulator: Simulator,
    reasoner: Reasoner,
    rooms: doors.Rooms,
    observer: StepObserver | None,
) -> None:
    state, run.final = simulator.start()
    _check_targets(run.plan, rooms.known_targets(run.final))
    for index, action in enumerate(run.plan):
        if observer is not None:
            observer.step_started(index, action, len(run.plan))
        simulated = simulator.submit(state, action).result()
        outcome = simulated.outcomes[-1]  # the true world where there is one, else the twin
        verdict = reasoner.judge(action, outcome.record)
        run.final, run.end_digest = outcome.record.after, outcome.end_digest
        state = simulated.end
        if outcome.trajectory is not None:
            run.trajectories.append(outcome.trajectory)
        run.records.append(outcome.record)
        step = _step(index, action, verdict, outcome.record, simulated.wall_s)
        run.steps.append(step)
        if observer is not None:
            observer.step_judged(step)
        if verdict.outcome is not Outcome.SUCCESS:
            return


def _check_targets(plan: Sequence[Action], targets: Sequence[str]) -> None:
    """Refuses names that the scene does not have, in the words of the plan parser."""
    for action in plan:
        parse_plan(str(action), targets)


def _step(
    index: int, action: Action, verdict: Verdict, record: RolloutRecord, wall_s: float
) -> StepModel:
    return StepModel.model_validate(
        {
            **judged_fields(action, verdict, record),
            "index": index,
            "status": verdict.outcome,
            "simulated_s": record.simulated_s,
            "wall_s": wall_s,
        }
    )


def _report(options: SimulateOptions, run: _Run, watch: Stopwatch) -> SimulateReport:
    conditions = None if run.interrupted else _conditions(run.task, run.final)
    status, cause = _conclude(run, conditions)
    return SimulateReport.model_validate(
        {
            "status": status,
            "seed": options.seed,
            "interrupted": run.interrupted,
            "versions": versions(),
            "timing": watch.timing(),
            "task": task_model(options.task, run.task),
            "files": {},
            "vary": options.vary,
            "look": options.look.value,
            "open_loop": _open_loop(options, run),
            "plan": [str(action) for action in run.plan],
            "steps": run.steps,
            "cause": cause,
            "success_conditions": conditions,
        }
    )


def _open_loop(options: SimulateOptions, run: _Run) -> OpenLoopModel | None:
    if not options.open_loop:
        return None
    error = options.error
    same, drawn = None, error is not None or options.vary
    if run.recorded is not None and len(run.steps) == len(run.plan) and not drawn:
        same = run.end_digest == run.recorded.recordings[-1].end_digest
    return OpenLoopModel(
        error=None if error is None else StartErrorModel(**asdict(error)),
        end_state=run.end_digest,
        same_end_state=same,
    )


def _conditions(task: Task | None, final: SceneState | None) -> SuccessConditionsModel | None:
    """The task's own for an evaluator, or its formal goal where it has none."""
    wanted = () if task is None else task.success or task.goal or ()
    if final is None or not wanted:
        return None
    conditions = [
        ConditionModel(condition=describe(condition), held=holds(condition, final))
        for condition in wanted
    ]
    return SuccessConditionsModel(
        held=all(condition.held for condition in conditions), conditions=conditions
    )


def _conclude(run: _Run, conditions: SuccessConditionsModel | None) -> tuple[str, str | None]:
    """The status and, unless it is success, the reason in one sentence."""
    if run.interrupted:
        return "interrupted", "stopped before the end of the plan"
    last = run.steps[-1]
    if last.status != Outcome.SUCCESS.value:
        return last.status, last.cause.text if last.cause else f"{last.action} did not succeed"
    if conditions is not None and not conditions.held:
        missing = ", ".join(item.condition for item in conditions.conditions if not item.held)
        return (
            Outcome.FAILURE.value,
            f"every action succeeded, but the task is not done: {missing} does not hold",
        )
    return Outcome.SUCCESS.value, None

"""One trial of ``etot bench``, in a worker: planner and world, the closed loop, and its report."""

from __future__ import annotations

import hashlib
import resource
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from etot_cli.benchmark.methods.blame import failure_class
from etot_cli.benchmark.methods.catalogue import METHODS, Means, Method
from etot_cli.benchmark.methods.kinematic import KinematicSimulator
from etot_cli.benchmark.methods.planners import WorldModel
from etot_cli.benchmark.methods.thinking import BuiltinThinking, Thinking
from etot_cli.benchmark.running.manifest import TRIALS
from etot_cli.benchmark.running.runner import TrialWork
from etot_cli.benchmark.trial import COSTS, ActionTaken, TrialResult, TrialStatus
from etot_cli.control.simulator import ActionSimulator, open_simulator
from etot_cli.errors import EtotError, ServiceError
from etot_cli.execution.cell import TrialOptions
from etot_cli.execution.protocols import Planner
from etot_cli.execution.records import Trial
from etot_cli.execution.trial import run_trial
from etot_cli.planning.options import Limits
from etot_cli.reporting.files import report_text, write_atomically
from etot_cli.reporting.trial_report import trial_report
from etot_cli.specs.scene import Scene
from etot_cli.specs.task import Task

TWINS_KEPT = 2
"""Twins that a worker keeps: of the task that it works on, and of one that something came onto."""
MIB = 1024.0**2
MAXRSS_BYTES = 1 if sys.platform == "darwin" else 1024
"""The unit in which the system tells the largest resident memory."""


@dataclass(frozen=True)
class Setup:
    """What all trials of a run have in common; plain data, sent to every worker.

    ``vlm``: settings of the reasoner ``vlm``; ``video_url``: an endpoint that generates videos,
    instead of the model without contact.
    """

    folder: str
    tasks: Mapping[str, Task]
    seed: int
    reasoner: str = "builtin"
    vlm: Mapping[str, Any] = field(default_factory=dict)
    limits: Limits = field(default_factory=Limits)
    video_url: str | None = None
    pages: bool = True
    """A page beside each trial's report."""


@dataclass
class _Shared:
    """What a worker keeps between trials."""

    setup: Setup | None = None
    twins: dict[str, ActionSimulator] = field(default_factory=dict)


_shared = _Shared()


def begin(setup: Setup) -> None:
    """Prepares a worker; again, with the same setup, it changes nothing."""
    if _shared.setup is None or _shared.setup.folder != setup.folder:
        _shared.setup = setup
        _shared.twins.clear()


def perform(work: TrialWork) -> TrialResult:
    """Carries a trial out and writes its report.

    Raises:
        EtotError: the task cannot be understood, or its world cannot be built.
        ServiceError: a service is gone, or the run's folder takes no more files.
    """
    setup = _shared.setup
    assert setup is not None  # every worker has begun
    task, method = setup.tasks[work.key.task], METHODS[work.key.method]
    begun = time.monotonic()
    bench = _Bench(setup, method)
    try:
        trial = run_trial(
            task,
            bench.make_planner,
            TrialOptions(seed=work.seed, number=work.draw, replan=method.replans),
        )
    finally:
        bench.close()
    if trial.status == "interrupted":
        raise KeyboardInterrupt
    if trial.status == "lost":
        # Not the method's failure: what it asked was not there.
        raise ServiceError(trial.reason)
    wall_s = time.monotonic() - begun
    report = f"{TRIALS}/{work.key.name}.json"
    result = bench.result(work, trial, wall_s, report)
    told = trial_report(task, method, trial, result)
    path = Path(setup.folder) / report
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(path, report_text(told))
        if setup.pages:
            from etot_cli.reporting.page.trial_page import SUFFIX, trial_page

            repeatable = setup.reasoner == "builtin" and setup.seed == work.seed
            page = trial_page(told, trial, method.title, repeatable=repeatable)
            write_atomically(path.with_suffix(SUFFIX), page)
    except (EtotError, OSError) as error:
        # A full disk: no trial's fault, and no further one would fare better.
        raise ServiceError(str(error)) from None
    return result


class _Bench:
    """The planner of one trial, and what it cost."""

    def __init__(self, setup: Setup, method: Method) -> None:
        self._setup, self._method = setup, method
        self._thinking: list[Thinking] = []

    def make_planner(self, scene: Scene) -> Planner:
        """A planner for a twin of a scene."""
        thinking, imagined = self._open(scene)
        self._thinking.append(thinking)
        twin = _twin(self._setup.seed, scene, recorded=self._setup.reasoner != "builtin")
        means = Means(
            thinking=thinking,
            world=twin.twin,
            physics=twin,
            imagined=imagined,
            limits=self._setup.limits,
        )
        return self._method.planner(means)

    def _open(self, scene: Scene) -> tuple[Thinking, WorldModel]:
        setup = self._setup
        if setup.video_url is not None and self._method.name == "etot_kinematic":
            from etot_cli.benchmark.methods.video_thinking import open_video

            return open_video(setup.video_url, setup.vlm, scene, seed=setup.seed)
        if setup.reasoner == "builtin":
            return BuiltinThinking(), KinematicSimulator()
        from etot_cli.benchmark.methods.model_thinking import ModelThinking
        from etot_cli.reasoning.builtin import BuiltinReasoner
        from etot_cli.reasoning.vlm.settings import VlmSettings

        settings, state = VlmSettings.load(**setup.vlm), BuiltinReasoner()
        thinking = ModelThinking(settings, scene, seed=setup.seed, state=state)
        return thinking, KinematicSimulator()

    def close(self) -> None:
        """Ends sessions; idempotent."""
        for thinking in self._thinking:
            thinking.close()

    def result(self, work: TrialWork, trial: Trial, wall_s: float, report: str) -> TrialResult:
        """The trial as a line of the journal."""
        account, spent = trial.account, trial.timing
        blamed = failure_class(trial, self._method.foresight)
        rendering_s = sum(thinking.rendering_s for thinking in self._thinking)
        physics_s = account.get("physics_s", 0.0)
        kinematics_s = account.get("kinematics_s", 0.0)
        times = {
            "physics": spent.get("execution", 0.0) + physics_s,
            "inverse_kinematics": spent.get("motions", 0.0) + kinematics_s,
            "rendering": rendering_s,
            "reasoning": max(
                spent.get("planning", 0.0) - physics_s - kinematics_s - rendering_s, 0.0
            ),
        }
        times["other"] = max(wall_s - sum(times.values()), 0.0)
        asked: dict[str, float] = {}
        for thinking in self._thinking:
            for name, value in thinking.costs().items():
                asked[name] = asked.get(name, 0.0) + value
        costs = {
            "planning_s": spent.get("planning", 0.0),
            "nodes": account.get("nodes", 0.0),
            "simulated_s": account.get("simulated_s", 0.0),
            **asked,
        }
        return TrialResult(
            key=work.key,
            seed=work.seed,
            status=TrialStatus.SUCCESS if trial.success else TrialStatus.FAILURE,
            actions=tuple(
                ActionTaken(
                    str(item.action), item.status, "" if item.cause is None else item.cause.text
                )
                for item in trial.actions
            ),
            replans=trial.replans,
            harm=tuple(trial.harm),
            failure_class=None if blamed is None else blamed.value,
            reason="" if trial.success else trial.reason,
            costs={name: round(costs.get(name, 0.0), 6) for name in COSTS},
            times={name: round(value, 4) for name, value in times.items()},
            wall_s=round(wall_s, 4),
            peak_mib=round(
                resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * MAXRSS_BYTES / MIB, 1
            ),
            report=report,
        )


def _twin(seed: int, scene: Scene, *, recorded: bool) -> ActionSimulator:
    """The twin of a scene, built once per worker; ``recorded``: so that pictures can be taken."""
    key = hashlib.sha256(f"{recorded}/{scene.directory}/{scene.model_dump_json()}".encode())
    name = key.hexdigest()
    if name not in _shared.twins:
        while len(_shared.twins) >= TWINS_KEPT:
            _shared.twins.pop(next(iter(_shared.twins))).close()
        _shared.twins[name] = open_simulator(scene, seed=seed, jobs=1, worlds=1, record=recorded)
    return _shared.twins[name]

"""The account of one trial, complete enough for a report at any moment."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np

from etot_cli.execution.cell import Cell, TrialOptions
from etot_cli.execution.evaluation import Evaluation, HarmWatch, evaluate
from etot_cli.execution.observation import Observation
from etot_cli.execution.records import (
    Carried,
    Ended,
    FailureClass,
    Happened,
    Look,
    PlanMade,
    Trial,
)
from etot_cli.specs.scene import Scene
from etot_cli.specs.task import Task
from etot_cli.world.state import SceneState


class Account:
    """What has happened so far.

    Args:
        task: whose conditions are looked at in the end.
        options: of the trial.
        cell: its robot, and the truth where it is known.
    """

    def __init__(self, task: Task, options: TrialOptions, cell: Cell) -> None:
        self._task, self._options, self._cell = task, options, cell
        self.harm = HarmWatch()
        self.looks: list[Look] = []
        self.plans: list[PlanMade] = []
        self.carried: list[Carried] = []
        self.happened: list[Happened] = []
        self._spent = dict.fromkeys(("planning", "motions", "execution", "looking"), 0.0)
        self._robot = ""
        self._begun_s: float | None = None

    def begin(self, robot: str) -> None:
        """The robot is there: what it is, and its clock begins."""
        self._robot = robot
        self._begun_s = self._cell.robot.state().time_s

    @property
    def scene(self) -> SceneState | None:
        """What was believed last; None before the first look."""
        return self.looks[-1].scene if self.looks else None

    def errors(self, seen: Observation) -> dict[str, float]:
        """How far each object was seen from where it truly is [m], where that is known."""
        world = self._cell.world
        if world is None:
            return {}
        return {
            name: round(float(np.linalg.norm(world.data.body(name).xpos - sighting.position)), 5)
            for name, sighting in seen.objects.items()
            if name in world.world.entries and name not in world.absent
        }

    def robot_s(self) -> float:
        """Time that the robot has acted [s]."""
        if self._begun_s is None:
            return 0.0
        try:
            return max(self._cell.robot.state().time_s - self._begun_s, 0.0)
        except Exception:  # a robot that is lost has no clock any more
            return self.carried[-1].end_s if self.carried else 0.0

    @contextmanager
    def timed(self, what: str) -> Iterator[Callable[[], float]]:
        """Adds the wall time of a block; gives a clock of it [s]."""
        begun = time.monotonic()
        try:
            yield lambda: time.monotonic() - begun
        finally:
            self._spent[what] += time.monotonic() - begun

    def trial(self, ended: Ended, reason: str, believed: Scene) -> Trial:
        """Everything that happened, with the evaluator's verdict.

        Args:
            ended: how the loop did.
            reason: why.
            believed: the nominal scene, with what came onto it.
        """
        world = self._cell.world
        final = self.scene if world is None else world.read()
        evaluation = None
        if ended in (Ended.CARRIED_OUT, Ended.FAILED) and final is not None:
            evaluation = evaluate(self._task.success, final, self.harm)
        told = (Ended.INTERRUPTED, Ended.LOST, Ended.PLANNED)
        status = ended.value if ended in told else "failure"
        if ended is Ended.CARRIED_OUT and evaluation is not None:
            status = "success" if evaluation.success else "failure"
            if status == "failure":
                reason = _unfulfilled(evaluation, self._taken_away())
        return Trial(
            seed=self._options.seed,
            number=self._options.number,
            status=status,
            reason=reason,
            robot=self._robot,
            actions=tuple(self.carried),
            looks=tuple(self.looks),
            plans=tuple(self.plans),
            disturbances=tuple(self.happened),
            evaluation=evaluation,
            failure_class=self._class_of(status, ended),
            timing={key: round(value, 4) for key, value in self._spent.items()},
            robot_s=round(self.robot_s(), 4),
            final=final,
            scene=believed,
            true_scene=None if world is None else world.world.scene,
        )

    def _class_of(self, status: str, ended: Ended) -> FailureClass | None:
        """The class of the failure that the trial did not recover from."""
        if status != "failure":
            return None
        if ended is Ended.CARRIED_OUT and self.scene is not None:
            # Nothing looked wrong: either the eyes were deceived, or the plan was no good.
            believed = evaluate(self._task.success, self.scene, HarmWatch())
            if believed.success:
                return FailureClass.PERCEPTION
        else:
            last = self.carried[-1] if self.carried else None
            if last is not None and last.failure_class is not None:
                return last.failure_class
        # Nobody's failure where somebody took something away; what was moved can be planned for.
        return None if self._taken_away() else FailureClass.PLANNING

    def _taken_away(self) -> list[str]:
        """What is gone, where somebody else did something."""
        if self.scene is None or not self.happened:
            return []
        return [name for name, state in self.scene.states.items() if state.lost]


def _unfulfilled(evaluation: Evaluation, taken_away: list[str]) -> str:
    if evaluation.harm:
        return "; ".join(evaluation.harm)
    without = f" without {' and '.join(taken_away)}" if taken_away else ""
    return f"the plan was carried out{without}, but the task's conditions do not hold"

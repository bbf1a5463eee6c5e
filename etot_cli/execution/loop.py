"""The closed loop: look, plan, and for every action look, move, look and judge; when the world
disagrees, plan anew from what is seen, with the same instruction.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np

from etot_cli.control.controller import run_motion
from etot_cli.control.simulated_world import ATTEMPTS
from etot_cli.errors import InstructionError
from etot_cli.execution.acting import FromNow, duration, last_command
from etot_cli.execution.attribution import class_of, true_observation
from etot_cli.execution.believed import BelievedTwin
from etot_cli.execution.differences import differences
from etot_cli.execution.disturbing import disturb, roles_of
from etot_cli.execution.evaluation import Evaluation, HarmWatch, evaluate
from etot_cli.execution.observation import Observation
from etot_cli.execution.protocols import Planned
from etot_cli.execution.simulated_device import SimulatedDevice
from etot_cli.execution.trial import (
    Carried,
    Cell,
    Describes,
    Difference,
    Ended,
    FailureClass,
    Happened,
    Look,
    MakePlanner,
    PlanMade,
    Trial,
    TrialObserver,
    TrialOptions,
)
from etot_cli.reasoning.builtin.judging import judge_action
from etot_cli.reasoning.protocol import Outcome
from etot_cli.skills.action import Action, Verb
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.motion import Motion, Trace
from etot_cli.skills.motions import outcome_of, plan_motions
from etot_cli.skills.outcome import SkillOutcome, failed
from etot_cli.specs.disturbance import Disturbance
from etot_cli.specs.task import Task
from etot_cli.world.recorder import Trajectory
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import CauseKind, RolloutRecord, SceneState

FEASIBLE = "feasible"
"""A planner's status that says that its actions, none where none is needed, lead to the goal."""
LOOKS_WITHOUT_PLAN = 2
"""Looks in a row from which there was no plan, and then there is none."""
UNMOVED = 0.01
"""What a person's deed displaced further than this is not the robot's doing [m]."""


class Loop:
    """One trial on its way; complete enough for a report at any moment."""

    def __init__(
        self,
        task: Task,
        make_planner: MakePlanner,
        options: TrialOptions,
        observer: TrialObserver,
        cell: Cell,
    ) -> None:
        self._task, self._make, self._options = task, make_planner, options
        self._observer, self._cell = observer, cell
        self._twin = BelievedTwin(task.scene, options.seed)
        self._planner = make_planner(task.scene)
        self._command: float | None = None
        self._chosen: str | None = None
        self._pending = list(task.disturbances) if options.disturb else []
        self._harm = HarmWatch()
        self._spare: set[str] = set()
        self._left: list[tuple[Action, Motion | None]] = []
        self._done: list[Action] = []
        self._looks: list[Look] = []
        self._plans: list[PlanMade] = []
        self._carried: list[Carried] = []
        self._happened: list[Happened] = []
        self._spent = dict.fromkeys(("planning", "motions", "execution", "looking"), 0.0)
        self._scene: SceneState | None = None
        self._snapshot: Snapshot | None = None
        self._robot = ""
        self._begun_s: float | None = None

    # -- what goes on -------------------------------------------------------------------------

    def run(self) -> tuple[Ended, str]:
        """Goes round until the task is done, or cannot be; how it ended, and why."""
        self._robot = self._cell.robot.connect()
        self._begun_s = self._cell.robot.state().time_s
        self._look("before planning")
        status = self._plan("the task begins")
        while True:
            if status.status != FEASIBLE and self._may_look_again():
                self._look("again, as there is no plan")
                status = self._plan(f"{self._plans[-1].reason}; no plan from the look before")
                continue
            if status.status != FEASIBLE:
                cause = self._plans[-1].reason.partition("; no plan from")[0]
                since = f" since {cause}" if len(self._plans) > LOOKS_WITHOUT_PLAN else ""
                return Ended.FAILED, f"no plan{since}: {status.reason or status.status}"
            if self._options.dry_run:
                return Ended.PLANNED, "there is a plan; nothing was moved (dry run)"
            ended, reason = self._follow_plan()
            if ended is not None:
                return ended, reason
            if not self._options.replan:
                return Ended.FAILED, f"{reason}; replanning is switched off"
            if len(self._plans) > self._options.max_replans:
                return Ended.FAILED, f"{reason}; given up after {len(self._plans) - 1} replans"
            status = self._plan(reason)

    def _may_look_again(self) -> bool:
        """Whether another look may show a way: what fails by a hair may be an error of the eyes."""
        if not self._options.replan or len(self._plans) > self._options.max_replans:
            return False
        without = [plan.status != FEASIBLE for plan in self._plans]
        return False in without[-LOOKS_WITHOUT_PLAN:] or len(without) < LOOKS_WITHOUT_PLAN

    def _follow_plan(self) -> tuple[Ended | None, str]:
        """Carries the plan out; (None, why) where a new one is needed."""
        while self._left:
            action, rehearsed = self._left[0]
            over = self._over()
            if over:
                return Ended.FAILED, over
            self._happen_before(action)
            unexpected = self._look(f"before {action}")
            if unexpected and self._options.replan:
                return None, _told(unexpected)
            carried = self._carry_out(action, rehearsed)
            if carried.status != Outcome.SUCCESS.value:
                text = carried.cause.text if carried.cause else carried.status
                return None, f"{action} failed: {text}"
            self._left.pop(0)
        self._happen_before(None)
        unexpected = self._look("at the end")
        if unexpected and self._options.replan:
            return None, _told(unexpected)
        return Ended.CARRIED_OUT, "the plan is carried out"

    def _over(self) -> str:
        options = self._options
        if len(self._carried) >= options.max_actions:
            return f"{len(self._carried)} actions were carried out, the most that are allowed"
        if self._robot_s() >= options.max_robot_s:
            return f"the robot has acted for {self._robot_s():.0f} s, the most that is allowed"
        return ""

    # -- looking ------------------------------------------------------------------------------

    def _look(self, why: str) -> tuple[Difference, ...]:
        """Looks, and brings the twin into the state that was seen; what is not as expected."""
        last = self._looks[-1].observation if self._looks else None
        with self._timed("looking") as spent:
            robot = FromNow(self._cell.robot, self._command, clock=False)
            seen = self._cell.eyes.look(robot, last or Observation(robot.state()))
            self._meet(seen)
            known = {name: item for name, item in seen.objects.items() if name in self._known}
            seen = replace(seen, objects=known)
            expected = self._scene
            self._snapshot, self._scene = self._twin.see(seen, self._command)
        differs = () if expected is None else differences(expected, self._scene)
        look = Look(self._robot_s(), why, seen, differs, self._scene, self._errors(seen), spent())
        self._looks.append(look)
        self._observer.looked(look)
        return differs

    @property
    def _known(self) -> frozenset[str]:
        return frozenset(self._twin.world.entries)

    def _meet(self, seen: Observation) -> None:
        """Takes what is new into the twin, and has a planner made for it."""
        eyes, new = self._cell.eyes, {}
        for name in seen.objects:
            item = eyes.what_is(name) if isinstance(eyes, Describes) else None
            if name not in self._known and item is not None:
                new[name] = item
        if not new:
            return
        scene = self._twin.scene
        scene = scene.model_copy(update={"objects": {**scene.objects, **new}})
        memory = self._twin.memory
        self._twin = BelievedTwin(scene, self._options.seed)
        if memory is not None:
            self._twin.remember(memory)
        self._planner = self._make(scene)

    def _errors(self, seen: Observation) -> dict[str, float]:
        world = self._cell.world
        if world is None:
            return {}
        return {
            name: round(float(np.linalg.norm(world.data.body(name).xpos - sighting.position)), 5)
            for name, sighting in seen.objects.items()
            if name in world.world.entries and name not in world.absent
        }

    # -- planning -----------------------------------------------------------------------------

    def _plan(self, reason: str) -> Planned:
        assert self._snapshot is not None  # every plan comes after a look
        assert self._scene is not None
        with self._timed("planning") as spent:
            try:
                planned = self._planner.plan(self._snapshot, self._scene, tuple(self._done))
            except InstructionError as error:
                if not self._plans:
                    raise
                # What it speaks of is no longer there to be understood.
                planned = Planned((), (), "infeasible", str(error))
        self._left = list(zip(planned.actions, planned.motions, strict=True))
        made = PlanMade(
            reason, planned.actions, planned.status, planned.reason, dict(planned.account),
            len(self._looks) - 1, spent(), len(self._carried),
        )  # fmt: skip
        self._plans.append(made)
        self._observer.planned(made)
        return planned

    # -- acting -------------------------------------------------------------------------------

    def _carry_out(self, action: Action, rehearsed: Motion | None) -> Carried:
        """Plans the motion from what is believed, runs it, looks, and judges.

        After a failure that lies in how it was done, the next motion is tried from what is then
        seen, as in the twin.
        """
        assert self._scene is not None
        index = len(self._carried)
        self._observer.acting(action, index)
        if action.verb is Verb.PICK_UP and self._chosen is None:
            self._chosen = action.target
        before, first_look, begin_s = self._scene, len(self._looks) - 1, self._robot_s()
        tried: list[_Tried] = []
        for _ in range(ATTEMPTS):
            latest = self._attempt(action, rehearsed, index)
            tried.append(latest)
            changed_hand = self._scene.holding != before.holding
            if not latest.outcome.another_way or latest.motion is None or changed_hand:
                break
        outcome = tried[-1].outcome
        record = RolloutRecord(
            before, self._scene, outcome.effect, outcome.cause,
            simulated_s=round(self._robot_s() - begin_s, 4),
        )  # fmt: skip
        verdict = judge_action(action, record)
        carried = Carried(
            action=action,
            status=verdict.outcome.value,
            cause=verdict.cause,
            changes=verdict.changes,
            motions=tuple(one.motion for one in tried if one.motion is not None),
            traces=tuple(one.trace for one in tried if one.trace is not None),
            looks=tuple(range(first_look, len(self._looks))),
            plan=len(self._plans) - 1,
            begin_s=round(begin_s, 4),
            end_s=round(self._robot_s(), 4),
            before=before,
            after=self._scene,
            trajectories=tuple(one.trajectory for one in tried if one.trajectory is not None),
            foreseen=tuple(one.foreseen for one in tried if one.foreseen is not None),
        )
        if verdict.outcome is not Outcome.SUCCESS:
            carried = replace(carried, failure_class=self._class_of(carried, tried[-1]))
        self._carried.append(carried)
        self._done.append(action)
        self._observer.acted(carried)
        return carried

    def _attempt(self, action: Action, rehearsed: Motion | None, index: int) -> _Tried:
        assert self._scene is not None
        truth = self._truth()
        command, look = self._command, self._looks[-1]
        with self._timed("motions"):
            belief = self._twin.belief(self._scene, f"{action}/{len(self._looks)}")
            motion = self._from_server(belief, action) or next(
                plan_motions(belief, action, rehearsed), None
            )
        if motion is None or isinstance(motion, SkillOutcome):
            nothing = failed(CauseKind.NO_EFFECT, [], "there is no motion for it")
            return _Tried(motion or nothing, look, command, truth)
        world, robot = self._cell.world, self._cell.robot
        foreseen = self._twin.foresee(motion) if self._options.record else None
        true_before = None if world is None else world.read()
        if world is not None:
            world.watch()
        self._schedule(motion, index)
        with self._timed("execution"):
            trace = run_motion(motion, FromNow(robot, self._command), self._twin.limits)
        self._command = last_command((trace,), self._command)
        trajectory = None
        if world is not None and true_before is not None:
            self._harm.motion(true_before, world.read(), tuple(self._spare))
            self._spare.clear()
            trajectory = world.watched()[1]
        self._look(f"after {action}")
        outcome = outcome_of(belief, action, motion, trace, self._scene)
        return _Tried(outcome, look, command, truth, motion, trace, trajectory, foreseen)

    def _from_server(self, belief: Belief, action: Action) -> Motion | None:
        grasps = self._cell.grasps
        if grasps is None or action.verb is not Verb.PICK_UP:
            return None
        return grasps.motion(belief, action)

    def _class_of(self, carried: Carried, last: _Tried) -> FailureClass | None:
        if last.truth is None:
            return None
        blamed = carried.cause.objects if carried.cause else ()
        held = carried.before.holding if carried.before else None
        about = (carried.action.target.split(".")[0], *blamed, *([held] if held else []))
        return class_of(
            self._twin.scene, last.truth, last.command, carried.action, last.motion,
            last.look.error_m, about,
        )  # fmt: skip

    def _truth(self) -> Observation | None:
        world = self._cell.world
        return None if world is None else true_observation(world, self._cell.robot.state())

    # -- what somebody else does --------------------------------------------------------------

    def _happen_before(self, action: Action | None) -> None:
        """Lets happen what is due before an action, or at the end (None)."""
        for given in list(self._pending):
            due = {
                "planned": True,
                "committed": action is not None and action.verb is Verb.PICK_UP,
                "after_action": len(self._carried) >= given.after_action,
                "during_action": False,
            }[given.when]
            if due:
                self._happen(given)

    def _schedule(self, motion: Motion, index: int) -> None:
        """Has what is due during this action happen while the robot moves."""
        device = self._cell.robot
        if not isinstance(device, SimulatedDevice):
            return
        for given in list(self._pending):
            if given.when == "during_action" and given.during_action == index + 1:
                sensed = device.state()
                seconds = duration(motion, sensed.targets, self._twin.limits)
                at_s = device.world.time_s + given.share * seconds
                device.at(at_s, lambda given=given: self._happen(given))  # type: ignore[misc]
                return

    def _happen(self, given: Disturbance) -> None:
        world = self._cell.world
        self._pending.remove(given)
        if world is None:
            return  # with a real robot, a person does it
        roles = roles_of(tuple(action for action, _ in self._left), self._chosen)
        before = world.read()
        text = disturb(world, given, roles)
        after = world.read()
        for name, state in before.states.items():
            now = after.states.get(name)
            far = UNMOVED + 1 if now is None else np.linalg.norm(
                np.subtract(now.position, state.position)
            )  # fmt: skip
            if far > UNMOVED:
                self._spare.add(name)
        happened = Happened(text, len(self._carried), self._robot_s())
        self._happened.append(happened)
        self._observer.disturbed(happened)

    # -- the account --------------------------------------------------------------------------

    def trial(self, ended: Ended, reason: str) -> Trial:
        """Everything that happened, with the evaluator's verdict."""
        world = self._cell.world
        final = self._scene if world is None else world.read()
        evaluation = None
        if ended in (Ended.CARRIED_OUT, Ended.FAILED) and final is not None:
            evaluation = evaluate(self._task.success, final, self._harm)
        told = (Ended.INTERRUPTED, Ended.LOST, Ended.PLANNED)
        status = ended.value if ended in told else "failure"
        if ended is Ended.CARRIED_OUT and evaluation is not None:
            status = "success" if evaluation.success else "failure"
            if status == "failure":
                reason = _unfulfilled(evaluation)
        return Trial(
            seed=self._options.seed,
            number=self._options.number,
            status=status,
            reason=reason,
            robot=self._robot,
            actions=tuple(self._carried),
            looks=tuple(self._looks),
            plans=tuple(self._plans),
            disturbances=tuple(self._happened),
            evaluation=evaluation,
            failure_class=self._trial_class(status, ended),
            timing={key: round(value, 4) for key, value in self._spent.items()},
            robot_s=round(self._robot_s(), 4),
            final=final,
            scene=self._twin.scene,
            true_scene=None if world is None else world.world.scene,
        )

    def _trial_class(self, status: str, ended: Ended) -> FailureClass | None:
        """The class of the failure that the trial did not recover from."""
        if status != "failure":
            return None
        if ended is Ended.CARRIED_OUT and self._scene is not None:
            # Nothing looked wrong: either the eyes were deceived, or the plan was no good.
            believed = evaluate(self._task.success, self._scene, HarmWatch())
            return FailureClass.PERCEPTION if believed.success else FailureClass.PLANNING
        last = self._carried[-1] if self._carried else None
        if last is not None and last.failure_class is not None:
            return last.failure_class
        # Nobody's failure where somebody took something away; what was moved can be planned for.
        scene = self._scene
        gone = scene is not None and any(state.lost for state in scene.states.values())
        return None if self._happened and gone else FailureClass.PLANNING

    def _robot_s(self) -> float:
        if self._begun_s is None:
            return 0.0
        try:
            return max(self._cell.robot.state().time_s - self._begun_s, 0.0)
        except Exception:  # a robot that is lost has no clock any more
            return self._carried[-1].end_s if self._carried else 0.0

    @contextmanager
    def _timed(self, what: str) -> Iterator[Callable[[], float]]:
        begun = time.monotonic()
        try:
            yield lambda: time.monotonic() - begun
        finally:
            self._spent[what] += time.monotonic() - begun


@dataclass(frozen=True)
class _Tried:
    """One attempt at an action: what it was worked out from, and what became of it."""

    outcome: SkillOutcome
    look: Look
    command: float | None
    truth: Observation | None
    motion: Motion | None = None
    trace: Trace | None = None
    trajectory: Trajectory | None = None
    foreseen: Trajectory | None = None


def _told(unexpected: tuple[Difference, ...]) -> str:
    return "; ".join(f"{item.name} {item.text}" for item in unexpected)


def _unfulfilled(evaluation: Evaluation) -> str:
    if evaluation.harm:
        return "; ".join(evaluation.harm)
    return "the plan was carried out, but the task's conditions do not hold"


__all__ = ["Loop"]

"""The closed loop: look, plan, and for every action look, move, look and judge; when the world
disagrees, plan anew from what is seen, with the same instruction.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from etot_cli.control.controller import run_motion
from etot_cli.control.simulated_world import ATTEMPTS
from etot_cli.errors import InstructionError
from etot_cli.execution.account import Account
from etot_cli.execution.attribution import class_of
from etot_cli.execution.cell import Cell, MakePlanner, TrialOptions
from etot_cli.execution.disturbing import Somebody
from etot_cli.execution.looking import Believed
from etot_cli.execution.observation import Observation
from etot_cli.execution.observers import TrialObserver
from etot_cli.execution.parting import parting
from etot_cli.execution.protocols import Planned
from etot_cli.execution.records import (
    Carried,
    Difference,
    Ended,
    FailureClass,
    Happened,
    Look,
    Parted,
    PlanMade,
    Trial,
)
from etot_cli.execution.state_eyes import true_observation
from etot_cli.reasoning.builtin.constraints import cause_of_breach
from etot_cli.reasoning.builtin.goal import Constraint
from etot_cli.reasoning.builtin.judging import judge_action
from etot_cli.reasoning.builtin.reasoner import forbidden_by
from etot_cli.reasoning.protocol import Assignment, Outcome, Verdict
from etot_cli.skills.action import Action, Verb
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.motion import Motion, Trace
from etot_cli.skills.motions import outcome_of, plan_motions
from etot_cli.skills.outcome import SkillOutcome, failed
from etot_cli.specs.scene import Scene
from etot_cli.specs.task import Task
from etot_cli.world.recorder import Trajectory
from etot_cli.world.state import CauseKind, RolloutRecord, owner_of

FEASIBLE = "feasible"
"""A planner's status that says that its actions, none where none is needed, lead to the goal."""
LOOKS_WITHOUT_PLAN = 2
"""Looks in a row from which there was no plan, and then there is none."""


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
        self._account = Account(task, options, cell)
        self._believed = Believed(task.scene, options.seed, cell, self._account, self._renew)
        self._planner = make_planner(task.scene)
        pending = task.disturbances if options.disturb else ()
        self._somebody = Somebody(pending, cell.world, self._happened)
        self._spare: set[str] = set()
        self._forbidden: tuple[Constraint, ...] = ()
        self._broken = ""
        self._left: list[tuple[Action, Motion | None]] = []
        self._done: list[Action] = []

    def trial(self, ended: Ended, reason: str) -> Trial:
        """Everything that happened, with the evaluator's verdict."""
        return self._account.trial(ended, reason, self._believed.twin.scene)

    # -- what goes on -------------------------------------------------------------------------

    def run(self) -> tuple[Ended, str]:
        """Goes round until the task is done, or cannot be; how it ended, and why."""
        account = self._account
        account.begin(self._cell.robot.connect())
        self._look("before planning")
        self._forbidden = forbidden_by(self._asked, self._believed.scene)
        status = self._plan("the task begins")
        while True:
            if status.status != FEASIBLE and self._may_look_again():
                self._look("again, as there is no plan")
                status = self._plan(f"{account.plans[-1].reason}; no plan from the look before")
                continue
            if status.status != FEASIBLE:
                cause = account.plans[-1].reason.partition("; no plan from")[0]
                since = f" since {cause}" if len(account.plans) > LOOKS_WITHOUT_PLAN else ""
                return Ended.FAILED, f"no plan{since}: {status.reason or status.status}"
            if self._options.dry_run:
                return Ended.PLANNED, "there is a plan; nothing was moved (dry run)"
            ended, reason = self._follow_plan()
            if ended is not None:
                return ended, reason
            if not self._options.replan:
                return Ended.FAILED, f"{reason}; replanning is switched off"
            replans = len(account.plans) - 1
            if replans >= self._options.max_replans:
                return Ended.FAILED, f"{reason}; given up after {replans} replans"
            status = self._plan(reason)

    def _may_look_again(self) -> bool:
        """Whether another look may show a way: what fails by a hair may be an error of the eyes."""
        if not self._options.replan or len(self._account.plans) > self._options.max_replans:
            return False
        without = [plan.status != FEASIBLE for plan in self._account.plans]
        return False in without[-LOOKS_WITHOUT_PLAN:] or len(without) < LOOKS_WITHOUT_PLAN

    def _follow_plan(self) -> tuple[Ended | None, str]:
        """Carries the plan out; (None, why) where a new one is needed."""
        while self._left:
            action, rehearsed = self._left[0]
            over = self._over()
            if over:
                return Ended.FAILED, over
            self._somebody.before(self._actions_left, len(self._account.carried))
            unexpected = self._look(f"before {action}")
            if unexpected and self._options.replan:
                return None, _told(unexpected)
            carried = self._carry_out(action, rehearsed)
            if self._broken:
                return Ended.FAILED, f"{action}: {self._broken}, and that cannot be undone"
            if carried.status != Outcome.SUCCESS.value:
                text = carried.cause.text if carried.cause else carried.status
                return None, f"{action} failed: {text}"
            self._left.pop(0)
        self._somebody.before((), len(self._account.carried))
        unexpected = self._look("at the end")
        if unexpected and self._options.replan:
            return None, _told(unexpected)
        return Ended.CARRIED_OUT, "the plan is carried out"

    def _over(self) -> str:
        options, done, robot_s = self._options, len(self._account.carried), self._account.robot_s()
        if done >= options.max_actions:
            return f"{done} actions were carried out, the most that are allowed"
        if robot_s >= options.max_robot_s:
            return f"the robot has acted for {robot_s:.0f} s, the most that is allowed"
        return ""

    def _look(self, why: str) -> tuple[Difference, ...]:
        differs = self._believed.look(why)
        self._observer.looked(self._account.looks[-1])
        return differs

    def _renew(self, scene: Scene) -> None:
        self._planner = self._make(scene)

    # -- planning -----------------------------------------------------------------------------

    @property
    def _asked(self) -> Assignment:
        """The words of the task, which speak of what was seen first, and what was seen since."""
        seen = [look.scene for look in self._account.looks[:-1] if look.scene is not None]
        return Assignment(self._task.instruction, self._task.goal, tuple(seen))

    def _plan(self, reason: str) -> Planned:
        believed = self._believed
        with self._account.timed("planning") as spent:
            try:
                planned = self._planner.plan(
                    self._asked, believed.snapshot, believed.scene, tuple(self._done)
                )
            except InstructionError as error:
                if not self._account.plans:
                    raise
                # What it speaks of is no longer there.
                planned = Planned((), (), "infeasible", str(error))
        self._left = list(zip(planned.actions, planned.motions, strict=True))
        made = PlanMade(
            reason, planned.actions, planned.status, planned.reason, dict(planned.account),
            len(self._account.looks) - 1, spent(), len(self._account.carried),
        )  # fmt: skip
        self._account.plans.append(made)
        self._observer.planned(made)
        return planned

    # -- acting -------------------------------------------------------------------------------

    def _carry_out(self, action: Action, rehearsed: Motion | None) -> Carried:
        """Plans the motion from what is believed, runs it, looks, and judges.

        After a failure that lies in how it was done, the next motion is tried from what is then
        seen, as in the twin.
        """
        account, believed = self._account, self._believed
        index = len(account.carried)
        self._observer.acting(action, index)
        self._somebody.acting(action)
        before, first_look, begin_s = believed.scene, len(account.looks) - 1, account.robot_s()
        tried: list[_Tried] = []
        for _ in range(ATTEMPTS):
            latest = self._attempt(action, rehearsed, index)
            tried.append(latest)
            changed_hand = believed.scene.holding != before.holding
            if not latest.outcome.another_way or latest.motion is None or changed_hand:
                break
        outcome = tried[-1].outcome
        record = RolloutRecord(
            before, believed.scene, outcome.effect, outcome.cause,
            simulated_s=round(account.robot_s() - begin_s, 4), watched=False,
        )  # fmt: skip
        verdict = self._judge(action, record)
        carried = Carried(
            action=action,
            status=verdict.outcome.value,
            cause=verdict.cause,
            changes=verdict.changes,
            motions=tuple(one.motion for one in tried if one.motion is not None),
            traces=tuple(one.trace for one in tried if one.trace is not None),
            looks=tuple(range(first_look, len(account.looks))),
            plan=len(account.plans) - 1,
            begin_s=round(begin_s, 4),
            end_s=round(account.robot_s(), 4),
            before=before,
            after=believed.scene,
            trajectories=tuple(one.trajectory for one in tried if one.trajectory is not None),
            foreseen=tuple(one.foreseen for one in tried if one.foreseen is not None),
            parted=next((one.parted for one in tried if one.parted is not None), None),
        )
        if verdict.outcome is not Outcome.SUCCESS:
            carried = replace(carried, failure_class=self._class_of(carried, tried[-1]))
        account.carried.append(carried)
        self._done.append(action)
        self._observer.acted(carried)
        return carried

    def _judge(self, action: Action, record: RolloutRecord) -> Verdict:
        """As the planner's judge does, with room for the errors of two looks."""
        verdict = judge_action(action, record)
        blur = 2 * 2**0.5 * self._believed.twin.scene.perception.position_m
        breach = cause_of_breach(record, self._forbidden, blur)
        if breach is None:
            return verdict
        self._broken = breach.text
        unsafe = verdict.outcome is Outcome.UNSAFE
        outcome = Outcome.UNSAFE if unsafe else Outcome.FAILURE
        return replace(verdict, outcome=outcome, cause=breach)

    def _attempt(self, action: Action, rehearsed: Motion | None, index: int) -> _Tried:
        account, believed, twin = self._account, self._believed, self._believed.twin
        world, robot = self._cell.world, self._cell.robot
        truth = None if world is None else true_observation(world, robot.state())
        command, look = believed.command, account.looks[-1]
        with account.timed("motions"):
            belief = twin.belief(believed.scene, f"{action}/{len(account.looks)}")
            motion = self._from_server(belief, action) or next(
                plan_motions(belief, action, rehearsed), None
            )
        if motion is None or isinstance(motion, SkillOutcome):
            nothing = failed(CauseKind.NO_EFFECT, [], "there is no motion for it")
            return _Tried(motion or nothing, look, command, truth)
        foreseen = twin.foresee(motion) if self._options.record else None
        begun_s = account.robot_s()
        true_before = None if world is None else world.read()
        if world is not None:
            world.watch()
        self._somebody.during(motion, self._actions_left, index, robot, twin.limits)
        with account.timed("execution"):
            trace = run_motion(motion, robot, twin.limits)
        believed.moved(trace)
        trajectory = parted = None
        if world is not None and true_before is not None:
            account.harm.motion(true_before, world.read(), tuple(self._spare))
            self._spare.clear()
            trajectory = world.watched()
            if trajectory is not None and foreseen is not None:
                parted = parting(world.world, trajectory, twin.world, foreseen, begun_s)
        self._look(f"after {action}")
        outcome = outcome_of(belief, action, motion, trace, believed.scene)
        return _Tried(outcome, look, command, truth, motion, trace, trajectory, foreseen, parted)

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
        about = (owner_of(carried.action.target), *blamed, *([held] if held else []))
        return class_of(
            self._believed.twin.scene, last.truth, last.command, carried.action, last.motion,
            last.look.error_m, about, self._forbidden,
        )  # fmt: skip

    # -- what somebody else does --------------------------------------------------------------

    @property
    def _actions_left(self) -> tuple[Action, ...]:
        return tuple(action for action, _ in self._left)

    def _happened(self, text: str, displaced: frozenset[str]) -> None:
        account = self._account
        self._spare |= displaced
        account.happened.append(Happened(text, len(account.carried), account.robot_s()))
        self._observer.disturbed(account.happened[-1])


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
    parted: Parted | None = None


def _told(unexpected: tuple[Difference, ...]) -> str:
    return "; ".join(f"{item.name} {item.text}" for item in unexpected)

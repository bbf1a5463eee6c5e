"""Drives the robot through contact dynamics: targets in, physics out, with guards on the way.

A motion is a row of phases; within a phase the joint targets are fixed beforehand, and a guard
says every other control period whether the phase may go on.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import WorldError
from etot_cli.skills.belief import Belief
from etot_cli.skills.deadline import Deadline
from etot_cli.skills.motion.collision import Attached, CollisionChecker
from etot_cli.skills.motion.kinematics import Arm
from etot_cli.skills.motion.timing import CONTROL_PERIOD, time_path, tool_speed_to_joint_speed
from etot_cli.skills.outcome import SkillOutcome
from etot_cli.world.build.surroundings import TIMESTEP
from etot_cli.world.model import World
from etot_cli.world.recorder import Recorder

Vector = NDArray[np.float64]
Guard = Callable[[], bool]
"""Looked at every other control period; True ends the phase."""

STEPS_PER_CONTROL = round(CONTROL_PERIOD / TIMESTEP)
OBSERVE_EVERY = 4
"""Control periods between observations of the recorder."""
GUARD_EVERY = 2
"""Control periods between looks at the guards."""
BLOCKED_ERROR = 0.06
"""Joint tracking error that means something is in the way [rad]."""
BLOCKED_PERIODS = 8
"""... when it lasts for so many control periods."""
GRIP_TIME = 0.45
"""Time for the fingers to close and the grasp to settle [s]."""
RELEASE_TIME = 0.35


class PhaseEnd(Enum):
    """How a phase ended."""

    DONE = "done"
    GUARD = "guard"
    BLOCKED = "blocked"


@dataclass
class Budget:
    """Bound on the simulated time of one action [s]."""

    limit_s: float = 60.0


class Pilot(Belief):
    """The robot in one world during one action.

    Holds the live ``data``, the arm's kinematics, a collision checker of the frozen scene, the
    recorder, the random generator of this action, ``scratch`` data for kinematics, and the
    deadline.
    """

    def __init__(
        self,
        world: World,
        data: mujoco.MjData,
        arm: Arm,
        checker: CollisionChecker,
        recorder: Recorder,
        rng: np.random.Generator,
        scratch: mujoco.MjData,
        deadline: Deadline | None = None,
    ) -> None:
        super().__init__(world, data, arm, checker, rng, scratch)
        self.recorder = recorder
        self._deadline = deadline or Deadline()
        self.steps = 0
        self._periods = 0
        self._wanted_opening: float | None = None
        self._limit = Budget().limit_s
        model = world.model
        gain = model.actuator_gainprm[world.robot.ctrl, 0]
        damping = -model.actuator_biasprm[world.robot.ctrl, 2]
        # A position servo with velocity damping follows this much later than its target.
        self._lag = damping / np.maximum(gain, 1e-9)
        self._speed = world.robot.spec.speed

    # -- stepping ------------------------------------------------------------------------------

    def tick(self) -> None:
        """One control period of physics.

        Raises:
            WorldError: the simulation diverged.
            OutOfTimeError: the deadline has passed.
        """
        self._deadline.check()
        mujoco.mj_step(self.world.model, self.data, STEPS_PER_CONTROL)
        self.steps += STEPS_PER_CONTROL
        self._periods += 1
        if self._periods % OBSERVE_EVERY == 0:
            self.recorder.observe(self.data)
            if not np.isfinite(self.data.qpos).all():
                raise WorldError("the simulation diverged (NaN)")

    @property
    def exhausted(self) -> bool:
        """Whether this action has used up its simulated time."""
        return self._periods * CONTROL_PERIOD > self._limit

    def wait(self, seconds: float) -> None:
        """Holds still."""
        for _ in range(round(seconds / CONTROL_PERIOD)):
            self.tick()

    def settle(self, seconds: float, speed: float = 0.01) -> None:
        """Waits until free objects move slower than ``speed`` [m/s], at most ``seconds``."""
        free = [n for n, e in self.world.entries.items() if e.free]
        dofs = np.array([self.world.model.joint(n).dofadr[0] for n in free], dtype=np.int64)
        index = (dofs[:, None] + np.arange(3)).ravel()
        quiet = 0
        for _ in range(round(seconds / CONTROL_PERIOD)):
            self.tick()
            calm = not len(index) or float(np.abs(self.data.qvel[index]).max()) < speed
            quiet = quiet + 1 if calm else 0
            if quiet >= 15:
                return

    def follow(
        self, targets: Vector, *, guard: Guard | None = None, stop_when_blocked: bool = True
    ) -> PhaseEnd:
        """Steps through joint targets (m, n), one per control period.

        The targets are led by the servo's lag, so the arm is where the path says, not behind it.
        """
        ctrl, limits = self.world.robot.ctrl, self.world.model.actuator_ctrlrange
        low, high = limits[self.world.robot.ctrl].T
        previous = np.vstack([self.commanded[None], targets[:-1]])
        lead = (targets - previous) / CONTROL_PERIOD * self._lag
        lead[0] = 0.0
        commands = np.clip(targets + lead, low, high)
        late = 0
        qpos = self.world.robot.qpos
        data = self.data
        for period, (target, command) in enumerate(zip(targets, commands, strict=True)):
            data.ctrl[ctrl] = command
            self.tick()
            if period % GUARD_EVERY:
                continue
            if guard is not None and guard():
                data.ctrl[ctrl] = target
                return PhaseEnd.GUARD
            error = float(np.abs(data.qpos[qpos] - target).max())
            late = late + GUARD_EVERY if error > BLOCKED_ERROR else 0
            if stop_when_blocked and late >= BLOCKED_PERIODS:
                data.ctrl[ctrl] = data.qpos[qpos]
                return PhaseEnd.BLOCKED
            if self.exhausted:
                return PhaseEnd.BLOCKED
        self.data.ctrl[ctrl] = targets[-1]
        return PhaseEnd.DONE

    def follow_path(
        self, path: Vector, *, speed: float | None = None, guard: Guard | None = None
    ) -> PhaseEnd:
        """Times a joint path (k, n) and follows it; ``speed`` in rad/s."""
        whole = np.vstack([self.commanded[None], path])
        return self.follow(time_path(whole, speed or self._speed), guard=guard)

    def follow_line(
        self, path: Vector, length: float, tool_speed: float, *, guard: Guard | None = None
    ) -> PhaseEnd:
        """Follows a joint path that is a tool path of ``length`` [m] at ``tool_speed`` [m/s]."""
        whole = np.vstack([self.commanded[None], path])
        speed = tool_speed_to_joint_speed(whole, length, tool_speed, self._speed)
        return self.follow(time_path(whole, speed), guard=guard)

    def transit(self, goal: Vector, attached: Attached | None = None) -> PhaseEnd | None:
        """Plans and follows a collision-free path to ``goal`` (n,); None when there is none."""
        path = self.plan_transit(
            goal, attached, opening=self._wanted_opening if attached is None else None
        )
        if path is None:
            return None
        guard = None
        if attached is not None:
            guard = self.drop_guard(attached)
        end = self.follow_path(path[1:], guard=guard)
        self.wait(0.05)
        return end

    def drop_guard(self, attached: Attached, tolerance: float = 0.05) -> Guard:
        """True once the object has moved in the hand by more than ``tolerance`` [m]."""
        body = self.world.model.body(attached.name).id
        site = self.world.robot.tool_site
        data, offset = self.data, attached.in_tool.position

        def dropped() -> bool:
            rotation = data.site_xmat[site].reshape(3, 3)
            expected = data.site_xpos[site] + rotation @ offset
            return bool(np.linalg.norm(data.xpos[body] - expected) > tolerance)

        return dropped

    # -- gripper -------------------------------------------------------------------------------

    def command_opening(self, opening: float) -> None:
        """Sets the gripper's target distance between the pads [m]; takes effect as time passes."""
        gripper = self.world.robot.spec.gripper
        self._wanted_opening = opening
        share = min(max(opening / gripper.opening, 0.0), 1.0)
        self.data.ctrl[self.world.robot.gripper_ctrl] = gripper.command_closed + share * (
            gripper.command_open - gripper.command_closed
        )

    def grip(self) -> None:
        """Closes the fingers until they hold."""
        self.command_opening(0.0)
        self.wait(GRIP_TIME)

    def release(self, opening: float) -> None:
        """Opens the fingers to a distance [m] and lets go."""
        self.command_opening(opening)
        self.wait(RELEASE_TIME)


Attempt = Callable[[Pilot], SkillOutcome]
"""A prepared way to carry out an action."""

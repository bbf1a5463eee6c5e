"""The robot in a simulated world: position servos, a gripper, and guards on what they sense."""

from __future__ import annotations

import math
from collections import deque

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.control.robot import Contacts, Guards, RobotState
from etot_cli.errors import WorldError
from etot_cli.skills.deadline import Deadline
from etot_cli.skills.motion.motion import PhaseEnd, Press
from etot_cli.skills.motion.timing import CONTROL_PERIOD
from etot_cli.world.arrays import Vector, consecutive
from etot_cli.world.model import World
from etot_cli.world.recorder import Recorder
from etot_cli.world.relations import touched_by_robot

OBSERVE_EVERY = 4
"""Control periods between observations of the recorder."""
GUARD_EVERY = 2
"""Control periods between looks at the guards."""
BLOCKED_ERROR = 0.06
"""Joint tracking error that means something is in the way [rad]; free motion stays below 0.02."""
BLOCKED_PERIODS = 8
"""... when it lasts for so many control periods."""
REST_SPEED = 0.01
"""Free objects slower than this [m/s] are at rest ..."""
REST_PERIODS = 15
"""... when they stay so for so many control periods."""
MOST_PERIODS = round(60.0 / CONTROL_PERIOD)
"""Bound on the control periods of one action, a minute; the longest one seen takes 21 s."""


class SimulatedRobot:
    """Implements :class:`etot_cli.control.robot.Robot` by stepping ``data``.

    Args:
        world: the world that it stands in.
        data: the state, which it steps.
        recorder: watches while it is stepped; None to step unwatched.
        deadline: by which stepping has to end; None for none.
    """

    def __init__(
        self,
        world: World,
        data: mujoco.MjData,
        recorder: Recorder | None = None,
        deadline: Deadline | None = None,
    ) -> None:
        self._world, self._data, self._recorder = world, data, recorder
        self._deadline = deadline or Deadline()
        self._periods = 0
        self._start_time = float(data.time)
        self._steps_per_period: int = round(CONTROL_PERIOD / world.model.opt.timestep)
        model, robot = world.model, world.robot
        self._model = model
        gain = model.actuator_gainprm[robot.ctrl, 0]
        damping = -model.actuator_biasprm[robot.ctrl, 2]
        # A position servo with velocity damping follows this much later than its target.
        self._lag = damping / np.maximum(gain, 1e-9)
        self._delay_steps = round(world.scene.actuation.delay_s / model.opt.timestep)
        # What was commanded last, and what is still to take effect.
        self._command: Vector = data.ctrl.copy()
        self._under_way: deque[Vector] = deque([data.ctrl.copy()] * self._delay_steps)
        self._shares = np.arange(1, self._steps_per_period + 1)[:, None] / self._steps_per_period
        self._low, self._high = model.actuator_ctrlrange[robot.ctrl].T
        free = [name for name, entry in world.entries.items() if entry.free]
        first = np.array([model.joint(name).dofadr[0] for name in free], dtype=np.int64)
        self._free_dofs = (first[:, None] + np.arange(3)).ravel()
        # Asking ``data`` for its arrays at every look takes longer than reading them.
        self._qpos, self._qvel, self._in_effect = data.qpos, data.qvel, data.ctrl
        self._ctrl, self._joints = consecutive(robot.ctrl), consecutive(robot.qpos)
        self._fingers = consecutive(robot.finger_qpos)

    @property
    def steps(self) -> int:
        """Physics steps so far."""
        return int(self._periods * self._steps_per_period)

    def state(self) -> RobotState:
        """What it senses now."""
        robot, data = self._world.robot, self._data
        return RobotState(
            np.asarray(data.qpos[robot.qpos].copy()),
            np.asarray(self._command[robot.ctrl].copy()),
            self._opening(),
            float(data.time) - self._start_time,
        )

    def follow(self, targets: Vector, guards: Guards) -> PhaseEnd:
        """Follows joint targets (m, n), one per control period.

        The targets are led by the servo's lag, so the arm is where the path says, not behind it.
        """
        ctrl, qpos, joints = self._ctrl, self._qpos, self._joints
        previous = np.vstack([self._command[ctrl][None], targets[:-1]])
        lead = (targets - previous) / CONTROL_PERIOD * self._lag
        lead[0] = 0.0
        commands = np.clip(targets + lead, self._low, self._high)
        late, guarded, holding = 0, guards.holding is not None, guards.holding or 0.0
        starts = np.vstack([self._command[ctrl][None], commands[:-1]])
        ways = starts[:, None] + self._shares * (commands - starts)[:, None]
        for period, (target, way) in enumerate(zip(targets, ways, strict=True)):
            self._tick(way)
            if period % GUARD_EVERY:
                continue
            if guarded and self._opening() < holding:
                self._jump(ctrl, target)
                return PhaseEnd.SLIPPED
            error = _largest(qpos[joints] - target)
            late = late + GUARD_EVERY if error > BLOCKED_ERROR else 0
            if late >= BLOCKED_PERIODS:
                self._jump(ctrl, qpos[joints])
                return PhaseEnd.BLOCKED
            if self._periods > MOST_PERIODS:
                return PhaseEnd.OUT_OF_TIME
        self._jump(ctrl, targets[-1])
        return PhaseEnd.DONE

    def set_opening(self, opening: float) -> None:
        """Sends the gripper to a distance between the pads [m]."""
        robot = self._world.robot
        self._jump(robot.gripper_ctrl, robot.spec.gripper.command(opening))

    def wait(self, seconds: float, guards: Guards, *, until_rest: bool = False) -> PhaseEnd:
        """Holds still; at rest, stepping on would change nothing."""
        quiet, guarded, holding = 0, guards.holding is not None, guards.holding or 0.0
        for period in range(round(seconds / CONTROL_PERIOD)):
            self._tick()
            if guarded and period % GUARD_EVERY == 0 and self._opening() < holding:
                return PhaseEnd.SLIPPED
            if until_rest:
                quiet = quiet + 1 if self._at_rest() else 0
                if quiet >= REST_PERIODS:
                    break
        return PhaseEnd.OUT_OF_TIME if self._periods > MOST_PERIODS else PhaseEnd.DONE

    def rest(self) -> None:
        """What has been commanded last is in effect from now on."""
        self._in_effect[:] = self._command
        self._under_way = deque([self._command.copy()] * self._delay_steps)

    def contacts(self) -> Contacts:
        """Who touches the robot, and who is pressed by whom, now."""
        data, world = self._data, self._world
        presses = []
        for index, (one, two) in enumerate(data.contact.geom):
            row = int(data.contact.efc_address[index])
            if row >= 0:
                rise = float(data.contact.frame[index][2])
                sideways = float(data.efc_force[row]) * math.sqrt(max(0.0, 1.0 - rise**2))
                pair = world.geom_address[int(one)], world.geom_address[int(two)]
                presses.append(Press(*pair, sideways))
        return Contacts(tuple(touched_by_robot(world, data)), tuple(presses))

    def _tick(self, way: Vector | None = None) -> None:
        """One control period of physics.

        Servos are led evenly to their next targets, as the robot's own controller does it. At a
        jump they would pull with all their force, hand and arm tremble, and what is held creeps out
        of the fingers by millimetres a transit.

        Args:
            way: targets of the joints (steps, n), one per physics step; None to stay.

        Raises:
            WorldError: the simulation diverged.
            OutOfTimeError: the deadline has passed.
        """
        model, data, ctrl, in_effect = self._model, self._data, self._ctrl, self._in_effect
        if self._delay_steps:
            for step in range(self._steps_per_period):
                self._command[ctrl] = self._command[ctrl] if way is None else way[step]
                self._under_way.append(self._command.copy())
                in_effect[:] = self._under_way.popleft()
                mujoco.mj_step(model, data)
        elif way is None:
            mujoco.mj_step(model, data, self._steps_per_period)
        else:
            for targets in way:
                in_effect[ctrl] = targets
                mujoco.mj_step(model, data)
            self._command[ctrl] = way[-1]
        self._periods += 1
        if self._periods % OBSERVE_EVERY == 0:
            self._deadline.check()
            if self._recorder is not None:
                self._recorder.observe(self._data)
            if not math.isfinite(self._qpos.dot(self._qpos)):
                raise WorldError("the simulation diverged (NaN)")

    def _jump(self, ctrl: slice | NDArray[np.int64] | int, command: Vector | float) -> None:
        """Commands what nothing leads to; where nothing is late, it is in effect."""
        self._command[ctrl] = command
        if not self._delay_steps:
            self._in_effect[ctrl] = command

    def _opening(self) -> float:
        return self._world.robot.fingers.opening(self._qpos[self._fingers])

    def _at_rest(self) -> bool:
        if not len(self._free_dofs):
            return True
        return _largest(self._qvel[self._free_dofs]) < REST_SPEED


def _largest(values: Vector) -> float:
    """The largest magnitude of a few values (n,); numpy takes three times as long for so few."""
    largest: float = max(map(abs, values.tolist()))
    return largest

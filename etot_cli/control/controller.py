"""Runs a motion on a robot, phase by phase, and keeps account of it.

The same code drives the simulated robot of the twin, that of an execution world, and a real arm.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from etot_cli.control.robot import Contacts, Guards, Robot
from etot_cli.skills.motion.motion import (
    SETTLE,
    Hand,
    Motion,
    Move,
    Phase,
    PhaseEnd,
    PhaseTrace,
    Trace,
    Wait,
)
from etot_cli.skills.motion.timing import JointLimits, time_line, time_path
from etot_cli.world.arrays import Vector

SETTLE_AFTER_FAILURE = 1.6
"""Time for what a failed motion has set moving to come to rest, at most [s]."""
COMMAND_DECIMALS = 9
"""Of the joint targets that are sent: nanoradians, far below what an encoder resolves, so that a
file of them holds what was sent to the last bit."""


def run_motion(motion: Motion, robot: Robot, limits: JointLimits) -> Trace:
    """Carries a motion out to its end or to the first phase that fails.

    Args:
        motion: what to do.
        robot: who does it.
        limits: of the joint targets that it is sent.
    """
    run = _Run(robot, limits)
    for phase in motion.phases:
        if not run.carry_out(phase):
            run.carry_out(Wait(SETTLE, SETTLE_AFTER_FAILURE, until_rest=True))
            break
    return Trace(tuple(run.phases))


class _Run:
    """One motion on its way."""

    def __init__(self, robot: Robot, limits: JointLimits) -> None:
        self._robot, self._limits = robot, limits
        self._origin = robot.state().time_s
        self._way_out: Vector | None = None
        self._sent: Vector | None = None
        self._held_from = 0.0
        self.phases: list[PhaseTrace] = []

    def carry_out(self, phase: Phase) -> bool:
        """Runs a phase; whether the motion goes on."""
        begun = self._robot.state().time_s
        self._sent, self._held_from = None, begun
        if isinstance(phase, Move):
            end, command = self._move(phase), phase.opening
        elif isinstance(phase, Hand):
            end, command = self._hand(phase), phase.opening
        else:
            end, command = self._wait(phase), None
        may_block = isinstance(phase, Move) and phase.may_block
        goes_on = end is PhaseEnd.DONE or (end is PhaseEnd.BLOCKED and may_block)
        contacts = self._robot.contacts() if may_block or not goes_on else Contacts()
        state = self._robot.state()
        self.phases.append(
            PhaseTrace(
                phase.name,
                end,
                round(begun - self._origin, 4),
                round(state.time_s - self._origin, 4),
                round(state.opening, 6),
                tuple(round(float(value), 6) for value in state.joints),
                command,
                self._sent,
                round(state.time_s - self._held_from, 4),
                phase.holding,
                contacts.touching,
                contacts.presses,
            )
        )
        return goes_on

    def _move(self, move: Move) -> PhaseEnd:
        if move.opening is not None:
            self._robot.set_opening(move.opening)
        path = move.path
        if self._way_out is not None:
            path, self._way_out = self._way_out, None
        start = self._robot.state().targets
        whole = np.vstack([start[None], path])
        if move.length is None or move.tool_speed is None:
            targets = time_path(whole, self._limits)
        else:
            targets = time_line(whole, move.length, move.tool_speed, self._limits)
        self._sent = np.round(targets, COMMAND_DECIMALS)
        guards = Guards(move.holding)
        end = self._robot.follow(self._sent, guards)
        self._held_from = self._robot.state().time_s
        if end is PhaseEnd.DONE or (end is PhaseEnd.BLOCKED and move.may_block):
            waited = self._robot.wait(move.dwell, guards)
            if end is PhaseEnd.DONE:
                end = waited
        if end is PhaseEnd.BLOCKED and move.exits:
            here = self._robot.state().joints
            nearest = int(np.abs(move.path - here).max(axis=1).argmin())
            self._way_out = move.exits[nearest]
        return end

    def _hand(self, hand: Hand) -> PhaseEnd:
        self._robot.set_opening(hand.opening)
        end = self._robot.wait(hand.seconds, Guards())
        if (
            end is PhaseEnd.DONE
            and hand.holding is not None
            and self._robot.state().opening < hand.holding
        ):
            return PhaseEnd.MISSED
        return end

    def _wait(self, wait: Wait) -> PhaseEnd:
        return self._robot.wait(wait.seconds, Guards(wait.holding), until_rest=wait.until_rest)


def replay(trace: Trace, robot: Robot) -> Trace:
    """Sends a robot what another one was sent, phase by phase, whatever becomes of it.

    No guard ends a phase; what one would have seen at the phase's end is in the account.

    Returns:
        What became of it, with the same commands in it.
    """
    phases = []
    for phase in trace.phases:
        begun = robot.state().time_s
        if phase.command is not None:
            robot.set_opening(phase.command)
        end = PhaseEnd.DONE
        if phase.targets is not None:
            end = robot.follow(phase.targets, Guards())
        robot.wait(phase.waited_s, Guards())
        state = robot.state()
        if end is PhaseEnd.DONE and phase.holding is not None and state.opening < phase.holding:
            closing = phase.targets is None and phase.command is not None
            end = PhaseEnd.MISSED if closing else PhaseEnd.SLIPPED
        contacts = robot.contacts()
        phases.append(
            replace(
                phase,
                end=end,
                start_s=round(begun, 4),
                end_s=round(state.time_s, 4),
                opening=round(state.opening, 6),
                joints=tuple(round(float(value), 6) for value in state.joints),
                touching=contacts.touching,
                presses=contacts.presses,
            )
        )
    return Trace(tuple(phases))

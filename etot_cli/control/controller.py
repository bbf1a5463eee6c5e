"""Runs a motion on a robot, phase by phase, and keeps account of it.

The same code drives the simulated robot of the twin, that of an execution world, and a real arm.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from etot_cli.control.robot import Contacts, Guards, Robot
from etot_cli.skills.motion.motion import (
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

Vector = NDArray[np.float64]

SETTLE_AFTER_FAILURE = 1.6
"""Time for what a failed motion has set moving to come to rest, at most [s]."""


def run_motion(
    motion: Motion, robot: Robot, limits: JointLimits, *, keep_targets: bool = False
) -> Trace:
    """Carries a motion out to its end or to the first phase that fails.

    Args:
        motion: what to do.
        robot: who does it.
        limits: of the joint targets that it is sent.
        keep_targets: put the joint targets that were sent into the trace.
    """
    run = _Run(robot, limits, keep_targets)
    for phase in motion.phases:
        if not run.carry_out(phase):
            robot.wait(SETTLE_AFTER_FAILURE, Guards(), until_rest=True)
            break
    return Trace(tuple(run.phases))


class _Run:
    """One motion on its way."""

    def __init__(self, robot: Robot, limits: JointLimits, keep_targets: bool) -> None:
        self._robot, self._limits, self._keep = robot, limits, keep_targets
        self._way_out: Vector | None = None
        self.phases: list[PhaseTrace] = []

    def carry_out(self, phase: Phase) -> bool:
        """Runs a phase; whether the motion goes on."""
        begun = self._robot.state().time_s
        targets: Vector | None = None
        if isinstance(phase, Move):
            end, targets = self._move(phase)
        elif isinstance(phase, Hand):
            end = self._hand(phase)
        else:
            end = self._wait(phase)
        may_block = isinstance(phase, Move) and phase.may_block
        goes_on = end is PhaseEnd.DONE or (end is PhaseEnd.BLOCKED and may_block)
        contacts = self._robot.contacts() if may_block or not goes_on else Contacts()
        state = self._robot.state()
        self.phases.append(
            PhaseTrace(
                phase.name,
                end,
                round(begun, 4),
                round(state.time_s, 4),
                round(state.opening, 6),
                tuple(round(float(value), 6) for value in state.joints),
                targets if self._keep else None,
                contacts.touching,
                contacts.presses,
            )
        )
        return goes_on

    def _move(self, move: Move) -> tuple[PhaseEnd, Vector]:
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
        guards = Guards(move.holding)
        end = self._robot.follow(targets, guards)
        if end is PhaseEnd.DONE or (end is PhaseEnd.BLOCKED and move.may_block):
            waited = self._robot.wait(move.dwell, guards)
            if end is PhaseEnd.DONE:
                end = waited
        if end is PhaseEnd.BLOCKED and move.exits:
            here = self._robot.state().joints
            nearest = int(np.abs(move.path - here).max(axis=1).argmin())
            self._way_out = move.exits[nearest]
        return end, targets

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

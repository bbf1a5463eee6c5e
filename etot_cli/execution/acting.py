"""What a motion takes, and what it has left the gripper at."""

from __future__ import annotations

import numpy as np

from etot_cli.skills.motion.motion import Hand, Motion, Move, PhaseEnd, Trace
from etot_cli.skills.motion.timing import CONTROL_PERIOD, JointLimits, time_line, time_path
from etot_cli.world.arrays import Vector


def duration(motion: Motion, start: Vector, limits: JointLimits) -> float:
    """How long a motion takes if nothing stops it, waits for rest left out [s].

    Args:
        motion: what is to be done.
        start: joint targets (n,) that it begins from [rad].
        limits: of the joint targets.
    """
    total, here = 0.0, start
    for phase in motion.phases:
        if isinstance(phase, Move):
            whole = np.vstack([here[None], phase.path])
            if phase.length is None or phase.tool_speed is None:
                sent = time_path(whole, limits)
            else:
                sent = time_line(whole, phase.length, phase.tool_speed, limits)
            total += len(sent) * CONTROL_PERIOD + phase.dwell
            here = whole[-1]
        elif isinstance(phase, Hand) or not phase.until_rest:
            total += phase.seconds
    return total


def last_command(traces: tuple[Trace, ...], before: float | None) -> float | None:
    """The opening that the gripper was last sent to [m]; ``before`` where no phase sent any."""
    for trace in reversed(traces):
        for phase in reversed(trace.phases):
            if phase.command is not None:
                return phase.command
    return before


def handled_at(
    trace: Trace, sent: float | None, before: tuple[float, ...] | None
) -> tuple[float, ...] | None:
    """Where the arm was when the fingers last closed, opened, or lost what they held.

    Args:
        trace: of the motion that has just ended.
        sent: the opening that the gripper was sent to before it [m].
        before: the answer before it, where they did nothing.

    Returns:
        Joint values (n,) [rad].
    """
    opened = False
    for phase in trace.phases:
        if phase.command is not None and sent is not None:
            opens = phase.command > sent
            # Fingers that open further on the way back have let go before.
            if phase.command < sent or (opens and not opened):
                before, opened = phase.joints, opens
        if phase.end is PhaseEnd.SLIPPED:
            before, opened = phase.joints, True
        sent = sent if phase.command is None else phase.command
    return before

"""Backing off after having been stopped: a little back the way the arm came, where it was free."""

from __future__ import annotations

import numpy as np

from etot_cli.skills.motion.motion import Motion, Move, PhaseEnd, Trace

FAR_BACK = 0.25
"""How far the joint that turns most goes back [rad]: 10 cm at half a metre, so that the hand comes
clear of what it struck, which may stand millimetres off where it is seen."""
SPACING = 0.05
"""Spacing of the waypoints [rad]; between them joints are interpolated, along a way that was
smooth."""


def withdrawal(trace: Trace) -> Motion | None:
    """The way back from where a motion was stopped by something in its way.

    Args:
        trace: what became of the motion.

    Returns:
        None where it was not stopped, where it has gone on since, or had not moved yet.
    """
    stopped = trace.stopped
    moved = [phase for phase in trace.phases if phase.targets is not None]
    # A phase that may be blocked is followed by others that have led the arm away already.
    if stopped is None or stopped.end is not PhaseEnd.BLOCKED or moved[-1] is not stopped:
        return None
    here = np.array(stopped.joints)
    sent = [phase.targets for phase in moved if phase.targets is not None]
    targets = np.concatenate(sent)
    reached = len(targets) - len(sent[-1]) + int(np.abs(sent[-1] - here).max(axis=1).argmin())
    way = []
    last = here
    for joints in targets[reached::-1]:
        if np.abs(joints - here).max() > FAR_BACK:
            break
        if np.abs(joints - last).max() >= SPACING:
            way.append(joints)
            last = joints
    return Motion("withdraw", (Move("withdraw", np.stack(way)),)) if way else None

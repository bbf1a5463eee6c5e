"""Joint paths become joint targets over time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

CONTROL_PERIOD = 0.01
"""Time between two joint targets [s]."""
ACCELERATION_TIME = 0.25
"""Time from rest to full speed [s]."""


def time_path(path: Vector, speed: float) -> Vector:
    """Samples a joint path at the control period with a smooth start and stop.

    Args:
        path: (k, n) joint values [rad], the first row where the arm is.
        speed: largest speed of any joint [rad/s].

    Returns:
        (m, n) joint targets, the first one period after the start, the last the path's end.
    """
    steps = np.abs(np.diff(path, axis=0)).max(axis=1) if len(path) > 1 else np.zeros(0)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    keep = np.concatenate([[True], np.diff(along) > 1e-9])
    path, along = path[keep], along[keep]
    total = float(along[-1])
    if total <= 1e-9:
        return path[-1:].copy()
    ramp = min(ACCELERATION_TIME, total / speed)
    duration = total / speed + ramp
    count = max(int(np.ceil(duration / CONTROL_PERIOD)), 1)
    times = np.minimum(np.arange(1, count + 1) * CONTROL_PERIOD, duration)
    peak = total / (duration - ramp)
    distance = np.where(
        times < ramp,
        0.5 * peak * times**2 / ramp,
        np.where(
            times > duration - ramp,
            total - 0.5 * peak * (duration - times) ** 2 / ramp,
            peak * (times - ramp / 2),
        ),
    )
    return np.stack(
        [np.interp(distance, along, path[:, joint]) for joint in range(path.shape[1])], axis=1
    )


def tool_speed_to_joint_speed(path: Vector, length: float, speed: float, limit: float) -> float:
    """Joint speed at which the tool covers ``length`` [m] of the path at ``speed`` [m/s].

    Capped at ``limit`` [rad/s].
    """
    travel = float(np.abs(np.diff(path, axis=0)).max(axis=1).sum()) if len(path) > 1 else 0.0
    if length <= 1e-6 or travel <= 1e-6:
        return limit
    return min(limit, travel * speed / length)


def time_line(path: Vector, length: float, tool_speed: float, limit: float) -> Vector:
    """Samples the joint path (k, n) of a straight tool way of ``length`` [m] at ``tool_speed``
    [m/s], no joint faster than ``limit`` [rad/s].
    """
    return time_path(path, tool_speed_to_joint_speed(path, length, tool_speed, limit))

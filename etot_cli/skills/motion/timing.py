"""Joint paths become joint targets over time, within limits of speed, acceleration and jerk.

A path's corners are rounded, its speed is limited where it bends, and the samples are averaged over
a short window, which bounds the jerk. toppra does the second step exactly, but takes 15 to 70 ms a
path, as long as the physics of the phase that the path is for, and knows no jerk.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from etot_cli.world.arrays import Vector

CONTROL_PERIOD = 0.01
"""Time between two joint targets [s]."""
BLEND = 0.05
"""Half-width of the window that rounds corners, along the path [rad]. A right angle is cut by
0.012 rad, less than a transit's clearance at arm's length; a line's joints stay within 0.001 rad of
where inverse kinematics puts them."""
GRID = 0.01
"""Spacing of the points at which speed is worked out [rad]."""
BEND_SHARE, PUSH_SHARE = 0.3, 0.35
"""Shares of the acceleration limit for bends and for changes of speed: they add up where a path
bends while it changes speed, and averaging the samples leaves the rest untouched."""


@dataclass(frozen=True)
class JointLimits:
    """Largest joint speed [rad/s], acceleration [rad/s²] and jerk [rad/s³] of commanded targets."""

    speed: float
    acceleration: float
    jerk: float

    def slowed(self, speed: float) -> JointLimits:
        """The same with a lower speed, if it is lower."""
        return JointLimits(min(speed, self.speed), self.acceleration, self.jerk)


def time_path(path: Vector, limits: JointLimits) -> Vector:
    """Samples a joint path at the control period, from rest to rest.

    Args:
        path: (k, n) joint values [rad], the first row where the arm is.
        limits: kept by the targets and their differences.

    Returns:
        (m, n) joint targets, the first one period after the start, the last the path's end.
    """
    return _timed(path, np.zeros(len(path)), limits)


def time_line(
    path: Vector, length: float | Vector, tool_speed: float, limits: JointLimits
) -> Vector:
    """Samples the joint path of a tool's way, as :func:`time_path` does.

    Args:
        path: (k, n) joint values [rad], the first row where the arm is.
        length: of the tool's way [m], or (k - 1,) of that from each row to the next.
        tool_speed: on the way as a whole [m/s]; where the length is told row by row, on each part.
        limits: kept besides.
    """
    if isinstance(length, float | int):
        joint_speed = _joint_speed(path, length, tool_speed, limits.speed)
        return time_path(path, limits.slowed(joint_speed))
    return _timed(path, np.concatenate([[0.0], np.cumsum(length)]) / tool_speed, limits)


def _timed(path: Vector, least: Vector, limits: JointLimits) -> Vector:
    """Samples a path (k, n) of which no part takes less time than between the moments ``least``
    (k,) [s].
    """
    path, along, least = _without_repeats(path, least)
    if along[-1] <= 1e-9:
        return path[-1:].copy()
    points, spacing = _rounded(path, along)
    slowness = np.diff(np.interp(np.arange(len(points)) * spacing, along, least)) / spacing
    speeds = _speeds(points, spacing, slowness, limits)
    samples = _sampled(points, spacing, speeds)
    return _averaged(path[0], samples, _window(limits))


def peaks(targets: Vector) -> tuple[float, float, float]:
    """Largest joint speed [rad/s], acceleration [rad/s²] and jerk [rad/s³] of targets (m, n)."""
    found = []
    for order in (1, 2, 3):
        change = np.diff(targets, order, axis=0) / CONTROL_PERIOD**order
        found.append(float(np.abs(change).max()) if len(change) else 0.0)
    return found[0], found[1], found[2]


def _without_repeats(path: Vector, least: Vector) -> tuple[Vector, Vector, Vector]:
    """The path's distinct points, how far along it they are, largest joint change [rad], and what
    goes with them.
    """
    steps = np.abs(np.diff(path, axis=0)).max(axis=1) if len(path) > 1 else np.zeros(0)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    keep = np.concatenate([[True], np.diff(along) > 1e-9])
    return path[keep], along[keep], least[keep]


def _rounded(path: Vector, along: Vector) -> tuple[Vector, float]:
    """Points along the path with its corners rounded (a triangular window), and their spacing.

    Beyond its ends the path is continued by its reflection in them, so the ends stay where they
    are.
    """
    total = float(along[-1])
    count = max(int(np.ceil(total / GRID)), 4)
    where = np.linspace(0.0, total, count + 1)
    points = np.stack([np.interp(where, along, joint) for joint in path.T], axis=1)
    half = min(round(BLEND / (total / count)), count)
    if half < 2 or len(path) == 2:
        return points, total / count
    window = np.bartlett(2 * half + 1)
    window /= window.sum()
    before, after = points[half:0:-1], points[-2 : -half - 2 : -1]
    padded = np.vstack([2 * points[0] - before, points, 2 * points[-1] - after])
    smooth = np.stack([np.convolve(joint, window, mode="valid") for joint in padded.T], axis=1)
    return smooth, total / count


def _speeds(points: Vector, spacing: float, slowness: Vector, limits: JointLimits) -> Vector:
    """Speed along the path at its points [rad/s], zero at both ends; between them at most the
    inverse of ``slowness`` [s/rad].

    Forward and backward passes as in Bobrow, Dubowsky and Gibson, "Time-optimal control of robotic
    manipulators along specified paths" (1985), with constant limits.
    """
    rate = _at_points(np.abs(np.diff(points, axis=0)).max(axis=1) / spacing)
    bend = np.zeros(len(points))
    bend[1:-1] = np.abs(np.diff(points, 2, axis=0)).max(axis=1) / spacing**2
    # Half a grid step on, a bend is as sharp as at the sharper of its neighbours.
    bend = np.maximum(bend, np.maximum(np.roll(bend, 1), np.roll(bend, -1)))
    allowed = limits.speed / np.maximum(rate, 1e-6)
    allowed = np.minimum(allowed, 1.0 / np.maximum(_at_points(slowness), 1e-6))
    allowed = np.minimum(
        allowed, np.sqrt(BEND_SHARE * limits.acceleration / np.maximum(bend, 1e-9))
    )
    squared = (allowed**2).tolist()
    squared[0] = squared[-1] = 0.0
    push = (2.0 * spacing * PUSH_SHARE * limits.acceleration / np.maximum(rate, 0.5)).tolist()
    forward = _pushed(squared, push)
    return np.asarray(np.sqrt(_pushed(forward[::-1], push[::-1])[::-1]))


def _pushed(squared: list[float], push: list[float]) -> list[float]:
    """Squared speeds of which none exceeds the one before it by more than its ``push``."""
    last, kept = np.inf, []
    for value, more in zip(squared, push, strict=True):
        last += more
        if value < last:
            last = value
        kept.append(last)
    return kept


def _at_points(cells: Vector) -> Vector:
    """The larger of the values (k,) between points, at the points (k + 1,)."""
    return np.asarray(np.maximum(np.append(cells, cells[-1]), np.insert(cells, 0, cells[0])))


def _sampled(points: Vector, spacing: float, speeds: Vector) -> Vector:
    """The path's points at every control period, at constant acceleration between grid points."""
    taken = 2.0 * spacing / (speeds[:-1] + speeds[1:])
    times = np.concatenate([[0.0], np.cumsum(taken)])
    count = int(np.ceil(times[-1] / CONTROL_PERIOD - 1e-9))
    now = np.minimum(np.arange(1, count + 1) * CONTROL_PERIOD, times[-1])
    cell = np.clip(np.searchsorted(times, now, side="right") - 1, 0, len(taken) - 1)
    since = now - times[cell]
    change = (speeds[cell + 1] - speeds[cell]) / taken[cell]
    share = (speeds[cell] * since + 0.5 * change * since**2) / spacing
    share = np.clip(share, 0.0, 1.0)[:, None]
    return np.asarray(points[cell] * (1.0 - share) + points[cell + 1] * share)


def _window(limits: JointLimits) -> int:
    """Samples to average over, so that an acceleration that jumps from one limit to the other
    changes no faster than the jerk limit.
    """
    share = BEND_SHARE + PUSH_SHARE
    seconds = 2.0 * share * limits.acceleration / limits.jerk
    return max(int(np.ceil(seconds / CONTROL_PERIOD)), 1)


def _averaged(start: Vector, samples: Vector, window: int) -> Vector:
    """A moving average over ``window`` samples, at rest before and after; ends at the end."""
    before = np.repeat(start[None], window - 1, axis=0)
    after = np.repeat(samples[-1:], window - 1, axis=0)
    padded = np.vstack([before, samples, after])
    sums = np.cumsum(np.vstack([np.zeros_like(start)[None], padded]), axis=0)
    averaged = (sums[window:] - sums[:-window]) / window
    averaged[-1] = samples[-1]
    return np.asarray(averaged)


def _joint_speed(path: Vector, length: float, speed: float, limit: float) -> float:
    """Joint speed at which the tool covers ``length`` [m] of the path at ``speed`` [m/s].

    Capped at ``limit`` [rad/s].
    """
    travel = float(np.abs(np.diff(path, axis=0)).max(axis=1).sum()) if len(path) > 1 else 0.0
    if length <= 1e-6 or travel <= 1e-6:
        return limit
    return min(limit, travel * speed / length)

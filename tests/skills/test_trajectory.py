"""Joint paths over time."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from etot_cli.skills.motion.timing import (
    CONTROL_PERIOD,
    JointLimits,
    peaks,
    time_line,
    time_path,
)

seeds = st.integers(0, 2**32 - 1)
speeds = st.floats(0.05, 3.14)
XARM = JointLimits(1.6, 20.0, 500.0)


def limits(speed: float) -> JointLimits:
    return JointLimits(speed, XARM.acceleration, XARM.jerk)


def random_path(seed: int, scale: float = 0.8) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return np.cumsum(rng.uniform(-scale, scale, (int(rng.integers(2, 7)), 6)), axis=0)


def at_rest_before_and_after(path: np.ndarray, timed: np.ndarray) -> np.ndarray:
    return np.vstack([path[:1]] * 4 + [timed] + [timed[-1:]] * 4)


@given(seeds, speeds, st.sampled_from([0.002, 0.05, 0.3, 1.5]))
@settings(deadline=None, max_examples=150)
@pytest.mark.slow
def test_speed_acceleration_and_jerk_stay_below_their_limits(
    seed: int, speed: float, scale: float
) -> None:
    path = random_path(seed, scale)
    wanted = limits(speed)
    speed_, acceleration, jerk = peaks(at_rest_before_and_after(path, time_path(path, wanted)))
    assert speed_ <= wanted.speed * 1.001
    assert acceleration <= wanted.acceleration
    assert jerk <= wanted.jerk


@given(seeds, speeds)
@settings(deadline=None, max_examples=50)
@pytest.mark.slow
def test_progress_is_monotonic_and_on_a_straight_path(seed: int, speed: float) -> None:
    path = random_path(seed)[:2]
    timed = time_path(path, limits(speed))
    direction = path[1] - path[0]
    share = (timed - path[0]) @ direction / float(direction @ direction)
    assert np.all(np.diff(share) >= -1e-12)
    assert timed == pytest.approx(path[0] + share[:, None] * direction, abs=1e-9)


@pytest.mark.slow
@given(seeds, speeds)
@settings(deadline=None, max_examples=50)
def test_corners_are_cut_by_less_than_a_clearance(seed: int, speed: float) -> None:
    """No target is farther from the path than what the rounding and the averaging may take."""
    path = random_path(seed)
    along = np.linspace(0.0, 1.0, 400)[:, None]
    dense = np.vstack([a + along * (b - a) for a, b in pairwise(path)])
    for target in time_path(path, limits(speed))[::3]:
        assert np.abs(dense - target).max(axis=1).min() < 0.02


@given(seeds, speeds)
@settings(deadline=None, max_examples=50)
def test_ends_at_the_end_and_starts_one_period_after_the_start(seed: int, speed: float) -> None:
    path = random_path(seed)
    timed = time_path(path, limits(speed))
    assert timed[-1] == pytest.approx(path[-1], abs=1e-9)
    assert np.abs(timed[0] - path[0]).max() <= speed * CONTROL_PERIOD


@given(seeds, st.floats(0.05, 1.5))
@settings(deadline=None, max_examples=50)
def test_slower_takes_no_less_time(seed: int, speed: float) -> None:
    path = random_path(seed)
    assert len(time_path(path, limits(speed / 2))) >= len(time_path(path, limits(speed)))


def test_path_without_motion_is_a_single_target() -> None:
    rest = np.full((3, 6), 0.4)
    np.testing.assert_array_equal(time_path(rest, XARM), rest[:1])
    np.testing.assert_array_equal(time_path(rest[:1], XARM), rest[:1])


def test_repeated_points_do_not_matter() -> None:
    path = np.array([[0.0, 0.0], [0.5, 0.1], [0.6, 0.8]])
    doubled = np.repeat(path, 3, axis=0)
    assert time_path(doubled, XARM) == pytest.approx(time_path(path, XARM))


def test_tool_speed() -> None:
    """A tool way of 0.5 m that takes 1 rad of the fastest joint, at 0.1 m/s: 0.2 rad/s."""
    path = np.linspace([0.0, 0.0], [1.0, 0.3], 12)
    assert peaks(time_line(path, 0.5, 0.1, XARM))[0] == pytest.approx(0.2, rel=0.01)
    assert peaks(time_line(path, 0.5, 100.0, XARM))[0] <= XARM.speed * 1.001


@given(seeds, st.floats(0.05, 0.5))
@settings(deadline=None, max_examples=50)
def test_tool_speed_part_by_part(seed: int, speed: float) -> None:
    """Where the tool's way is told from row to row it is nowhere much faster than meant, though the
    joints are; and where it is short the arm does not dawdle.
    """
    ways = np.random.default_rng(seed).uniform(0.006, 0.04, 12)
    path = np.linspace([0.0, 0.0], [1.2, 0.3], 13)
    timed = np.vstack([path[:1], time_line(path, ways, speed, XARM)])
    tool = np.interp(timed[:, 0], path[:, 0], np.concatenate([[0.0], np.cumsum(ways)]))
    # Between two points of the grid, and by averaging, a part takes over some of the next's speed.
    assert np.diff(tool).max() / CONTROL_PERIOD <= speed * 1.25
    fair = sum(max(way / speed, 0.1 / XARM.speed) for way in ways)
    assert len(timed) * CONTROL_PERIOD < fair + 0.7

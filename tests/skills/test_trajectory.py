"""Joint paths over time."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from etot_cli.skills.motion.timing import (
    ACCELERATION_TIME,
    CONTROL_PERIOD,
    time_path,
    tool_speed_to_joint_speed,
)

seeds = st.integers(0, 2**32 - 1)
speeds = st.floats(0.05, 3.14)


def random_path(seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return np.cumsum(rng.uniform(-0.8, 0.8, (int(rng.integers(2, 7)), 6)), axis=0)


@given(seeds, speeds)
@settings(deadline=None, max_examples=50)
def test_speed_and_acceleration_stay_below_their_limits(seed: int, speed: float) -> None:
    path = random_path(seed)
    timed = np.vstack([path[:1], time_path(path, speed)])
    velocity = np.diff(timed, axis=0) / CONTROL_PERIOD
    assert np.abs(velocity).max() <= speed * 1.001
    if len(path) == 2 and len(timed) > 4:
        # On a straight line the corner-free profile also bounds the acceleration.
        acceleration = np.diff(velocity, axis=0) / CONTROL_PERIOD
        total = float(np.abs(np.diff(path, axis=0)).max())
        ramp = min(ACCELERATION_TIME, total / speed)
        assert np.abs(acceleration).max() <= speed / ramp * 1.05


@given(seeds, speeds)
@settings(deadline=None, max_examples=50)
def test_progress_is_monotonic_and_on_the_path(seed: int, speed: float) -> None:
    path = random_path(seed)[:2]
    timed = time_path(path, speed)
    direction = path[1] - path[0]
    share = (timed - path[0]) @ direction / float(direction @ direction)
    assert np.all(np.diff(share) >= -1e-12)
    assert timed == pytest.approx(path[0] + share[:, None] * direction, abs=1e-9)


@given(seeds, speeds)
@settings(deadline=None, max_examples=50)
def test_ends_at_the_end_and_starts_one_period_after_the_start(seed: int, speed: float) -> None:
    path = random_path(seed)
    timed = time_path(path, speed)
    assert timed[-1] == pytest.approx(path[-1], abs=1e-9)
    assert np.abs(timed[0] - path[0]).max() <= speed * CONTROL_PERIOD


@given(seeds, speeds)
@settings(deadline=None, max_examples=50)
def test_slower_takes_longer(seed: int, speed: float) -> None:
    path = random_path(seed)
    assert len(time_path(path, speed / 2)) > len(time_path(path, speed))


def test_path_without_motion_is_a_single_target() -> None:
    rest = np.full((3, 6), 0.4)
    np.testing.assert_array_equal(time_path(rest, 1.0), rest[:1])
    np.testing.assert_array_equal(time_path(rest[:1], 1.0), rest[:1])


def test_repeated_points_do_not_matter() -> None:
    path = np.array([[0.0, 0.0], [0.5, 0.1], [0.6, 0.8]])
    doubled = np.repeat(path, 3, axis=0)
    assert time_path(doubled, 1.0) == pytest.approx(time_path(path, 1.0))


def test_tool_speed() -> None:
    path = np.array([[0.0], [0.5], [1.0]])
    assert tool_speed_to_joint_speed(path, 0.5, 0.1, 3.0) == pytest.approx(0.2)
    assert tool_speed_to_joint_speed(path, 0.5, 100.0, 3.0) == 3.0
    assert tool_speed_to_joint_speed(path[:1], 0.5, 0.1, 3.0) == 3.0

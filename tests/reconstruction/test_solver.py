"""The solver against SciPy's, and its bounds."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import least_squares

from etot_cli.reconstruction.fit.solver import ROBUST, minimize

ONES = np.ones(2)


def rosenbrock(x: np.ndarray) -> np.ndarray:
    return np.array([10 * (x[1] - x[0] ** 2), 1 - x[0]])


def circle(points: np.ndarray):
    return lambda x: (np.hypot(points[:, 0] - x[0], points[:, 1] - x[1]) - x[2]) / 0.01


@pytest.fixture
def arc() -> np.ndarray:
    """Points (60, 2) on half a circle about (0.3, −0.2), some far off it."""
    rng = np.random.default_rng(0)
    angle = rng.uniform(0, np.pi, 60)
    points = np.column_stack([0.3 + 0.5 * np.cos(angle), -0.2 + 0.5 * np.sin(angle)])
    points += rng.normal(0, 0.01, points.shape)
    points[:6] += rng.uniform(0.2, 0.6, (6, 2))
    return points


def test_a_curved_valley_is_followed() -> None:
    assert minimize(rosenbrock, np.array([-1.2, 1.0]), scale=ONES, steps=100).x == pytest.approx(
        ONES, abs=1e-4
    )


def test_outliers_count_as_with_scipy(arc: np.ndarray) -> None:
    start = np.array([0.0, 0.0, 0.3])
    own = minimize(circle(arc), start, scale=np.full(3, 0.1))
    other = least_squares(circle(arc), start, loss="soft_l1", f_scale=ROBUST)
    assert own.cost == pytest.approx(other.cost, rel=1e-5)
    assert own.x == pytest.approx(other.x, abs=1e-4)


def test_bounds_are_kept(arc: np.ndarray) -> None:
    low, high = np.array([-1.0, -0.1, 0.1]), np.array([1.0, 1.0, 0.45])
    start = np.array([0.0, 0.0, 0.3])
    own = minimize(circle(arc), start, scale=np.full(3, 0.1), low=low, high=high)
    other = least_squares(
        circle(arc), start, bounds=(low, high), loss="soft_l1", f_scale=ROBUST, xtol=1e-12
    )
    assert np.all((low <= own.x) & (own.x <= high))
    assert own.cost <= other.cost * (1 + 1e-4)


def test_steps_are_counted() -> None:
    calls: list[int] = []

    def residuals(x: np.ndarray) -> np.ndarray:
        calls.append(1)
        return rosenbrock(x)

    minimize(residuals, np.array([-1.2, 1.0]), scale=ONES, steps=5)
    assert len(calls) <= 5 * 3


def test_a_parameter_without_effect_stays() -> None:
    found = minimize(lambda x: np.array([x[0] - 2.0]), np.array([0.0, 7.0]), scale=ONES)
    assert found.x == pytest.approx([2.0, 7.0], abs=1e-6)

"""The choice of shapes and their fit, on exact pictures of known shapes."""

from __future__ import annotations

import numpy as np
import pytest

from etot_cli.reconstruction.fit.pose import best_fit, fit_shape, judge
from etot_cli.reconstruction.fit.refine import refine
from etot_cli.reconstruction.fit.strays import find_strays
from etot_cli.reconstruction.shapes.block import Block
from etot_cli.reconstruction.shapes.catalog import tiers
from etot_cli.reconstruction.shapes.furniture import OpenUnit
from etot_cli.reconstruction.shapes.rod import Capsule, Pen
from etot_cli.reconstruction.shapes.upright import ConicalCup
from tests.reconstruction.traced import DESK, observed, seen_as, trace


def fitted(families, observation, evidence):
    """The best shape, fitted to all that is seen of it."""
    best = best_fit(families, observation, evidence, 0)[0]
    params = fit_shape(best.family, observation, best.params)
    return judge(best.family, observation, params)


RODS = [
    (Capsule(), [0.42, 0.03, DESK, 0.7, 0.16, 0.025]),
    (Pen(), [0.42, 0.03, DESK, 0.7, 0.16, 0.018, 0.02]),
]


@pytest.mark.parametrize(("family", "values"), RODS, ids=["capsule", "pen"])
@pytest.mark.parametrize("hint", ["pen", "capsule", None])
@pytest.mark.slow
def test_rods_are_told_apart_by_their_ends_whatever_their_name(family, values, hint) -> None:
    truth = np.array(values)
    observation, evidence = observed(*trace(family, truth))
    best = fitted(tiers(hint), observation, evidence)
    assert best.family.kind == family.kind
    assert np.linalg.norm(best.params[:2] - truth[:2]) < 0.001
    assert best.params[4] == pytest.approx(truth[4], rel=0.02)


@pytest.mark.parametrize(("hint", "opened"), [("drawer_unit", 0.03), (None, 0.05)])
def test_an_open_drawer_seen_from_behind_is_no_deeper_chest(hint, opened) -> None:
    """Hardly more than a gap of it is seen, which a block as long as both explains but for that."""
    truth = np.array([0.48, 0.10, DESK, np.pi, 0.22, 0.20, 0.16, opened])
    observation, evidence = observed(*trace(OpenUnit(), truth))
    for seed in range(2):
        best = best_fit(tiers(hint), observation, evidence, seed)[0]
        assert isinstance(best.family, OpenUnit)
        assert best.params[4] == pytest.approx(0.22, abs=0.003)
        assert best.params[7] == pytest.approx(opened, abs=0.004)


@pytest.mark.slow
def test_a_thin_cup_gets_out_of_a_local_minimum() -> None:
    """Readings inside the far wall must not be taken for its outside."""
    family = ConicalCup()
    truth = np.array([0.42, 0.03, DESK, 0.074, 0.062, 0.002, 0.003, 0.034])
    mask, depth = trace(family, truth)
    observation, _ = observed(mask, depth)
    away = truth + np.array([0.003, 0, 0, 0, 0.001, -0.0005, 0.001, 0])
    start = judge(family, observation, away)
    fit, _, _ = refine(seen_as(depth), observation, [start], 0)
    assert np.linalg.norm(family.center(fit.params) - family.center(truth)) < 0.0005
    assert fit.params[3:5] == pytest.approx(truth[3:5], rel=0.01)


def test_which_points_are_drawn_depends_on_what_is_seen_of_the_thing_alone() -> None:
    """An unrelated thing that is fitted before it must not change the fit."""
    observation, _ = observed(*trace(Block(), np.array([0.42, 0.03, DESK, 0.4, 0.06, 0.06, 0.08])))
    first = observation.thinned(50, 50, 3)
    observation.thinned(20, 20, 3)
    again = observation.thinned(50, 50, 3)
    assert np.array_equal(first.pixels, again.pixels)
    assert np.array_equal(first.points, again.points)
    assert not np.array_equal(first.points, observation.thinned(50, 50, 4).points)


def test_a_strip_of_something_behind_is_not_the_objects() -> None:
    truth = np.array([0.42, 0.03, DESK, 0.4, 0.06, 0.06, 0.08])
    mask, depth = trace(Block(), truth)
    fit = judge(Block(), observed(mask, depth)[0], truth)
    assert find_strays(seen_as(depth), mask, fit) is None
    rows = np.flatnonzero(mask.any(axis=1))
    strip = np.zeros_like(mask)
    strip[rows[0] - 3 : rows[0] + 6] = mask[rows[0] + 6]
    wide = mask | strip
    found = find_strays(seen_as(depth), wide, fit)
    assert found is not None
    assert not found.before.any()
    assert (found.own ^ mask).sum() < 0.1 * (wide ^ mask).sum()


def test_a_strip_of_something_in_front_hides_the_object() -> None:
    truth = np.array([0.42, 0.03, DESK, 0.4, 0.06, 0.06, 0.08])
    mask, depth = trace(Block(), truth)
    fit = judge(Block(), observed(mask, depth)[0], truth)
    rows = np.flatnonzero(mask.any(axis=1))
    front = np.zeros_like(mask)
    front[rows[-1] - 7 :] = mask[rows[-1] - 7 :]
    depth = np.where(front, depth - 0.05, depth)
    found = find_strays(seen_as(depth), mask, fit)
    assert found is not None
    assert (found.before ^ front).sum() < 0.05 * front.sum()


@pytest.mark.slow
def test_a_drawer_that_stands_open_a_little_is_seen_despite_noise() -> None:
    """A longer block explains most of it, but not the step at the drawer's front."""
    truth = np.array([0.40, 0.02, DESK, 2.0, 0.211, 0.178, 0.155, 0.026])
    mask, depth = trace(OpenUnit(2, 0), truth)
    observation, evidence = observed(mask, depth, sigma=0.0032, edge=0.8)
    best = fitted(tiers(), observation, evidence)
    assert isinstance(best.family, OpenUnit)
    assert best.params[7] == pytest.approx(0.026, abs=0.004)
    assert best.params[4:7] == pytest.approx(truth[4:7], rel=0.03)


@pytest.mark.slow
def test_gross_errors_do_not_decide_between_shapes() -> None:
    truth = np.array([0.42, 0.03, DESK, 0.4, 0.08, 0.06, 0.05])
    mask, depth = trace(Block(), truth)
    rng = np.random.default_rng(1)
    depth = np.where(mask & (rng.random(mask.shape) < 0.04), depth - 0.2, depth)
    observation, evidence = observed(mask, depth)
    best = fitted([[Block(), *tiers()[0]]], observation, evidence)
    assert best.family.kind == "box"
    assert sorted(best.params[4:7]) == pytest.approx(sorted(truth[4:7]), rel=0.03)

"""Every shape family: distances, outlines and scene keys say the same thing."""

from __future__ import annotations

import numpy as np
import pytest

from etot_cli.reconstruction.capture.view import View
from etot_cli.reconstruction.fit.observation import Observation
from etot_cli.reconstruction.fit.pose import residuals_beside, residuals_of
from etot_cli.reconstruction.shapes.ball import Ball
from etot_cli.reconstruction.shapes.base import convex_distance
from etot_cli.reconstruction.shapes.block import Block
from etot_cli.reconstruction.shapes.furniture import OpenCabinet, OpenUnit
from etot_cli.reconstruction.shapes.rod import Capsule, Pen
from etot_cli.reconstruction.shapes.upright import ConicalCup, Cup, Cylinder
from etot_cli.specs.checks import check_scene
from etot_cli.specs.scene import Scene

POSE = np.array(
    [[0.0, 0.5, -0.8660254, 1.0], [1.0, 0.0, 0.0, 0.0], [0.0, -0.8660254, -0.5, 0.6], [0, 0, 0, 1]]
)
VIEW = View(640, 480, 500, 500, 320, 240, POSE)
SHAPES = [
    (Ball(), [0.4, 0.1, 0.1, 0.07]),
    (Block(), [0.4, 0.1, 0.1, 0.3, 0.1, 0.06, 0.05]),
    (Cylinder(), [0.4, 0.1, 0.1, 0.08, 0.1]),
    (Cup(), [0.4, 0.1, 0.1, 0.08, 0.1, 0.003, 0.004]),
    (ConicalCup(), [0.4, 0.1, 0.1, 0.08, 0.1, 0.003, 0.004, 0.05]),
    (Capsule(), [0.4, 0.1, 0.1, 0.3, 0.15, 0.02]),
    (Pen(), [0.4, 0.1, 0.1, 0.3, 0.15, 0.02, 0.02]),
    (OpenUnit(2, 0), [0.4, 0.1, 0.1, 0.3, 0.2, 0.15, 0.15, 0.05]),
    (OpenCabinet("right"), [0.4, 0.1, 0.1, 0.3, 0.3, 0.4, 0.3, 0.5]),
]
IDS = [f"{type(family).__name__}" for family, _ in SHAPES]


@pytest.mark.parametrize(("family", "values"), SHAPES, ids=IDS)
def test_outlines_enclose_the_surface(family, values) -> None:
    params = np.array(values)
    rng = np.random.default_rng(0)
    # Furniture reaches beyond its closed size by what is open.
    span = 0.5 * np.array(family.size(params)) + (0.02 if len(params) < 8 else 0.25)
    points = family.center(params) + rng.uniform(-1, 1, (200000, 3)) * span.max()
    surface = points[np.abs(family.distance(params, points)) < 0.0015]
    assert len(surface) > 30
    pixels = VIEW.project(surface)
    inside = np.min(
        [convex_distance(pixels, VIEW.project(hull)) for hull in family.hulls(params, VIEW)],
        axis=0,
    )
    assert np.percentile(inside, 99) < 2.5


@pytest.mark.parametrize(("family", "values"), SHAPES, ids=IDS)
def test_scene_keys_make_a_valid_object(family, values) -> None:
    spec = family.spec(np.array(values))
    scene = Scene.model_validate({"objects": {"thing": {**spec, "at": [0.4, 0.1]}}})
    assert scene.objects["thing"].kind == family.kind


@pytest.mark.parametrize("rim", [0.03, 0.08, 0.2])
def test_the_most_pointed_cup_with_the_thickest_wall_is_a_valid_object(rim) -> None:
    family = ConicalCup()
    start = np.array([0.4, 0.1, 0.1, rim, 0.6 * rim, 0.003, 0.004, 0.8 * rim])
    low, high = family.bounds(start)
    pointed = start.copy()
    pointed[5], pointed[7] = high[5], low[7]
    spec = {**family.spec(pointed), "at": [0.4, 0.1]}
    check_scene(Scene.model_validate({"objects": {"thing": spec}}))
    assert family.plausible(pointed)
    pointed[7] = 0.1 * rim
    assert not family.plausible(pointed)


@pytest.mark.parametrize(("family", "values"), SHAPES, ids=IDS)
def test_parameters_have_names_and_bounds(family, values) -> None:
    params = np.array(values)
    low, high = family.bounds(params)
    assert len(family.names) == len(params) == len(low) == len(high)
    assert (low <= params).all()
    assert (params <= high).all()
    assert family.volume(params) > 0


@pytest.mark.parametrize(("family", "values"), SHAPES, ids=IDS)
def test_residuals_change_with_parameters_as_those_of_shapes_beside(family, values) -> None:
    """What holds fast which edge bounds a pixel, and asks no other, says the same."""
    params, rng = np.array(values), np.random.default_rng(0)
    around = VIEW.project(np.vstack(family.hulls(params, VIEW)))
    pixels = rng.uniform(around.min(axis=0) - 10, around.max(axis=0) + 10, (300, 2))
    points = family.center(params) + rng.uniform(-0.1, 0.1, (100, 3))
    seen = Observation(VIEW, pixels[:100], pixels[100:200], pixels[200:], points, 0.1)
    step = 1e-6
    others = list(params + step * np.eye(len(params)))
    here = residuals_of(family, seen, params)
    slopes = (residuals_beside(family, seen, params, others) - here) / step
    exact = (np.array([residuals_of(family, seen, other) for other in others]) - here) / step
    assert np.abs(exact).max() > 1
    # Where two edges are equally far, the slope is that of the one or of the other.
    assert np.mean(np.abs(slopes - exact) < 1e-3 * np.abs(exact).max()) > 0.995

"""Plane geometry of outlines."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from etot_cli.specs.footprint import Disc, Polygon, contains, hull, overlap, rectangle

PLACE = st.floats(-1, 1)
SIZE = st.floats(0.01, 0.5)
YAW = st.floats(-180, 180)
RECTANGLES = st.builds(rectangle, PLACE, PLACE, YAW, SIZE, SIZE)
SHAPES = RECTANGLES | st.builds(Disc, PLACE, PLACE, SIZE)


def moved(shape: Disc | Polygon, x: float, y: float) -> Disc | Polygon:
    if isinstance(shape, Disc):
        return Disc(shape.x + x, shape.y + y, shape.radius)
    return Polygon(tuple((u + x, v + y) for u, v in shape.corners))


def test_known_overlaps() -> None:
    square = rectangle(0, 0, 0, 2, 2)
    assert overlap(square, rectangle(1.5, 0, 0, 2, 2)) == pytest.approx(0.5)
    assert overlap(square, rectangle(2.5, 0, 0, 2, 2)) <= 0
    # Turned by 45° a corner points at the square.
    assert overlap(square, rectangle(2.3, 0, 45, 2, 2)) == pytest.approx(1 + math.sqrt(2) - 2.3)
    assert overlap(Disc(0, 0, 1), Disc(1.5, 0, 1)) == pytest.approx(0.5)
    # A disc beyond a corner: its bounding box would overlap, it does not.
    assert overlap(square, Disc(1.8, 1.8, 1)) <= 0
    assert overlap(square, Disc(1.6, 1.6, 1)) == pytest.approx(1 - 0.6 * math.sqrt(2))
    assert overlap(square, Disc(0, 1.5, 1)) == pytest.approx(0.5)


@given(SHAPES, SHAPES)
def test_overlap_is_symmetric(first: Disc | Polygon, second: Disc | Polygon) -> None:
    one, other = overlap(first, second), overlap(second, first)
    assert (one > 1e-9) == (other > 1e-9)
    if one > 1e-9:
        assert one == pytest.approx(other)


@given(SHAPES, SHAPES)
def test_a_shape_on_a_point_of_another_overlaps(
    first: Disc | Polygon, second: Disc | Polygon
) -> None:
    x, y = (second.x, second.y) if isinstance(second, Disc) else second.corners[0]
    here = (first.x, first.y) if isinstance(first, Disc) else first.corners[0]
    assert overlap(first, moved(second, here[0] - x, here[1] - y)) > -1e-9


@given(SHAPES, SHAPES, st.floats(0, 360))
def test_far_apart_never_overlaps(
    first: Disc | Polygon, second: Disc | Polygon, angle: float
) -> None:
    x, y = 10 * math.cos(math.radians(angle)), 10 * math.sin(math.radians(angle))
    assert overlap(first, moved(second, x, y)) <= 0


@given(RECTANGLES)
def test_contains_its_middle_and_not_what_is_beyond_a_corner(shape: Polygon) -> None:
    x = sum(corner[0] for corner in shape.corners) / 4
    y = sum(corner[1] for corner in shape.corners) / 4
    assert contains(shape, (x, y))
    corner = shape.corners[0]
    assert not contains(shape, (2 * corner[0] - x, 2 * corner[1] - y))


def test_a_disc_contains_what_is_within_its_radius() -> None:
    assert contains(Disc(0, 0, 1), (0.5, 0))
    assert not contains(Disc(0, 0, 1), (0.8, 0.8))


@given(st.lists(st.tuples(PLACE, PLACE), min_size=3, max_size=12, unique=True))
@pytest.mark.slow
def test_hull_contains_its_points(points: list[tuple[float, float]]) -> None:
    outline = hull(points)
    following = (*outline.corners[1:], *outline.corners[:1])
    pairs = zip(outline.corners, following, strict=True)
    area = sum(x_1 * y_2 - x_2 * y_1 for (x_1, y_1), (x_2, y_2) in pairs) / 2
    if area > 1e-6:  # the middle of a narrower sliver is as good as on its outline
        # Rounding may put a corner of the outline just outside of it.
        x, y = (sum(values) / len(points) for values in zip(*points, strict=True))
        nearer = ((px + (x - px) * 1e-9, py + (y - py) * 1e-9) for px, py in points)
        assert all(contains(outline, point) for point in nearer)

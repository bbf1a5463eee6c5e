"""What "left of" and the like mean on the plane."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from etot_cli.planning import conditions
from etot_cli.specs.scene import Camera, Scene
from etot_cli.specs.task import Condition
from etot_cli.world.spatial import (
    Nearby,
    Outline,
    Whereabouts,
    fits,
    holds,
    outline_at,
    whereabouts,
)
from etot_cli.world.viewpoint import forward_of
from tests.reasoning import scenes

DESK = Outline((0.42, 0.0), (0.4, 0.6))
PLATE = Outline((0.4, 0.1), (0.08, 0.08))
BOX = Outline((0.4, -0.3), (0.05, 0.05))
RADIUS = 0.03
ROBOT = (1.0, 0.0)


def check(
    relation: Nearby,
    x: float,
    y: float,
    *landmarks: Outline,
    forward: tuple[float, float] = ROBOT,
    area: Outline = DESK,
) -> bool:
    where = Whereabouts(relation, tuple("ab"[: len(landmarks)]))
    return bool(fits(where, np.array([[x, y]]), RADIUS, landmarks, area, forward)[0])


@pytest.mark.parametrize(
    ("relation", "inside", "outside"),
    [
        (Nearby.LEFT, (0.40, 0.25), [(0.40, -0.05), (0.60, 0.25), (0.40, 0.12), (0.4, 0.55)]),
        (Nearby.RIGHT, (0.40, -0.05), [(0.40, 0.25), (0.10, -0.05)]),
        (Nearby.BEHIND, (0.55, 0.10), [(0.25, 0.10), (0.55, 0.30)]),
        (Nearby.FRONT, (0.25, 0.10), [(0.55, 0.10), (0.35, 0.10)]),
        (Nearby.NEXT_TO, (0.40, 0.30), [(0.40, 0.35)]),
        (Nearby.NEAR, (0.40, 0.40), [(0.40, 0.45)]),
        (Nearby.AWAY, (0.40, 0.45), [(0.40, 0.35)]),
    ],
)
def test_beside_one_thing(
    relation: Nearby, inside: tuple[float, float], outside: list[tuple[float, float]]
) -> None:
    assert check(relation, *inside, PLATE)
    assert not any(check(relation, *point, PLATE) for point in outside)


PEN = (0.12, 0.014, 0.014)


@pytest.mark.parametrize(("x", "free"), [(0.50, 0.203), (0.49, 0.193)])
def test_each_is_as_far_away_from_the_other(x: float, free: float) -> None:
    """However long they are along the other axis: the pen lies along the box's side."""
    along = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))
    box = outline_at((0.20, 0.0, 0.2), (1.0, 0.0, 0.0, 0.0), (0.18, 0.06, 0.05))
    pen = outline_at((x, 0.0, 0.2), along, PEN)
    assert box.free_distance(pen) == pytest.approx(free, abs=1e-6)
    assert pen.free_distance(box) == pytest.approx(free, abs=1e-6)
    beside = outline_at((0.20, 0.035, 0.2), (1.0, 0.0, 0.0, 0.0), (0.30, 0.30, 0.05))
    assert box.free_distance(beside) == 0.0


@given(st.floats(-0.4, 0.4), st.floats(-0.4, 0.4), st.floats(0.0, math.pi), st.floats(0.0, math.pi))
def test_where_it_fits_away_from_something_it_is_away_from_it(
    x: float, y: float, yaw: float, other: float
) -> None:
    """However it comes to lie there."""

    def turn(angle: float) -> tuple[float, float, float, float]:
        return (math.cos(angle / 2), 0.0, 0.0, math.sin(angle / 2))

    where = Whereabouts(Nearby.AWAY, ("a",))
    mark = outline_at((0.0, 0.0, 0.2), turn(other), (0.10, 0.05, 0.05))
    radius = max(PEN[:2]) / 2
    if fits(where, np.array([[x, y]]), radius, (mark,), DESK, ROBOT)[0]:
        assert outline_at((x, y, 0.2), turn(yaw), PEN).free_distance(mark) >= 0.20


def test_beyond_one_thing_that_is_between_it_and_the_other() -> None:
    assert check(Nearby.BEYOND, 0.40, 0.30, PLATE, BOX)
    assert check(Nearby.BEYOND, 0.40, -0.45, BOX, PLATE)
    for point in ((0.40, -0.10), (0.40, 0.19), (0.40, 0.60), (0.70, 0.15), (0.40, -0.50)):
        assert not check(Nearby.BEYOND, *point, PLATE, BOX), point


@given(st.floats(0.05, 0.75), st.floats(-0.55, 0.55), st.floats(0.05, 0.75), st.floats(-0.55, 0.55))
def test_what_is_beyond_one_thing_has_that_between_it_and_the_other(
    x: float, y: float, a: float, b: float
) -> None:
    start, thing = Outline((a, b), (0.04, 0.05)), Outline((x, y), (RADIUS / 2, RADIUS / 2))
    if check(Nearby.BEYOND, x, y, PLATE, start):
        assert check(Nearby.BETWEEN, *PLATE.center, start, thing)


def test_between_is_neither_beyond_nor_off_the_line_nor_on_one_of_them() -> None:
    assert check(Nearby.BETWEEN, 0.40, -0.10, PLATE, BOX)
    assert check(Nearby.BETWEEN, 0.40, -0.10, BOX, PLATE)
    for point in ((0.40, 0.25), (0.55, -0.10), (0.40, 0.05), (0.40, -0.4)):
        assert not check(Nearby.BETWEEN, *point, PLATE, BOX)


@pytest.mark.parametrize(
    ("relation", "inside", "outside"),
    [
        (Nearby.AT_LEFT, (0.42, 0.3), (0.42, 0.1)),
        (Nearby.AT_RIGHT, (0.42, -0.3), (0.42, 0.3)),
        (Nearby.AT_BACK, (0.60, 0.0), (0.50, 0.0)),
        (Nearby.AT_FRONT, (0.20, 0.0), (0.60, 0.0)),
        (Nearby.AT_CENTRE, (0.45, 0.1), (0.45, 0.3)),
        (Nearby.AT_EDGE, (0.42, 0.48), (0.42, 0.40)),
        (Nearby.AT_CORNER, (0.18, 0.45), (0.18, 0.30)),
    ],
)
def test_regions_of_a_surface(
    relation: Nearby, inside: tuple[float, float], outside: tuple[float, float]
) -> None:
    assert check(relation, *inside)
    assert not check(relation, *outside)


coordinates = st.floats(-0.5, 0.5)
OPPOSITE = {
    Nearby.LEFT: Nearby.RIGHT, Nearby.FRONT: Nearby.BEHIND, Nearby.AT_LEFT: Nearby.AT_RIGHT,
    Nearby.AT_FRONT: Nearby.AT_BACK,
}  # fmt: skip


@given(coordinates, coordinates, st.floats(-3, 3), st.sampled_from(Nearby), coordinates)
@settings(deadline=None, max_examples=150)
def test_relations_turn_with_the_viewer(
    x: float, y: float, turn: float, relation: Nearby, yaw: float
) -> None:
    """Turning everything, the viewer included, changes nothing; turning the viewer by half a turn
    exchanges left and right, front and back.
    """
    if relation is Nearby.AT_POINT:
        return
    landmarks = [Outline((0.1, 0.05), (0.08, 0.04), yaw), Outline((-0.2, -0.1), (0.03, 0.03))]
    area = Outline((0.0, 0.0), (0.6, 0.4))

    def turned(outline: Outline) -> Outline:
        at = rotated(*outline.center)
        return Outline(at, outline.half, outline.yaw + turn)

    def rotated(px: float, py: float) -> tuple[float, float]:
        cosine, sine = math.cos(turn), math.sin(turn)
        return (cosine * px - sine * py, sine * px + cosine * py)

    marks = landmarks[: relation.landmarks]
    before = check(relation, x, y, *marks, area=area)
    nudged = {check(relation, x + dx, y, *marks, area=area) for dx in (-1e-6, 1e-6)}
    if len(nudged) > 1:
        return  # on the border rounding decides
    after = check(
        relation, *rotated(x, y), *map(turned, marks), forward=rotated(1.0, 0.0), area=turned(area)
    )
    assert before == after
    if relation in OPPOSITE:
        opposite = check(OPPOSITE[relation], x, y, *marks, forward=(-1.0, 0.0), area=area)
        assert opposite == before


def test_the_keys_of_conditions_are_relations() -> None:
    assert whereabouts("in_front_of", ["cup"]) == Whereabouts(Nearby.FRONT, ("cup",))
    assert whereabouts("at", (), "edge") == Whereabouts(Nearby.AT_EDGE)
    assert str(whereabouts("at", (), (0.4, -0.1))) == "at 0.400 -0.100"


def test_viewpoint() -> None:
    def scene(viewpoint: str, **camera: object) -> Scene:
        return Scene(cameras={"eye": Camera.model_validate(camera)}, viewpoint=viewpoint)

    across = {"position": (1.2, 0.0, 0.8), "look_at": (0.4, 0.0, 0.13)}
    assert forward_of(scene("robot", **across)) == (1.0, 0.0)
    assert forward_of(scene("eye", **across)) == pytest.approx((-1.0, 0.0))
    above = {"position": (0.4, 0.0, 1.5), "quaternion": (0.0, 1.0, 0.0, 0.0)}
    assert forward_of(scene("eye", **above)) == pytest.approx((0.0, 1.0), abs=1e-9)


BESIDE = (Nearby.NEXT_TO, Nearby.NEAR)


@pytest.mark.parametrize("relation", BESIDE)
def test_what_stands_on_or_in_a_thing_is_not_beside_it(relation: Nearby) -> None:
    """However many are in between; nor is that beside it. Both are beside what stands there."""
    scene = scenes.scene(
        scenes.cup("box", (0.4, 0.0)),
        scenes.item("pea", at=(0.4, 0.0), inside="box", on="box"),
        scenes.item("plate", at=(0.4, 0.0), on="box", size=(0.1, 0.1, 0.01)),
        scenes.item("mug", "cup", (0.4, 0.0), on="plate"),
        scenes.item("jar", "cup", (0.4, 0.12)),
    )
    for name in ("pea", "plate", "mug"):
        for one, other in ((name, "box"), ("box", name)):
            where = Whereabouts(relation, (other,))
            assert not holds(where, one, scene)
            assert not holds(Whereabouts(relation, (other,), denied=True), one, scene)
            key = relation.value.replace(" ", "_")
            condition = Condition.model_validate({"not": {key: [one, other]}})
            assert not conditions.holds(condition, scene), "nor is it away from it"
        assert holds(Whereabouts(relation, ("jar",)), name, scene)
    assert holds(Whereabouts(relation, ("pea",)), "mug", scene), "neither bears the other"


def test_what_only_leans_on_a_thing_is_beside_it() -> None:
    name, rod = scenes.item("rod", at=(0.4, 0.05))
    leaning = dataclasses.replace(rod, on=("desk", "box"))
    scene = scenes.scene(scenes.item("box", at=(0.4, 0.0)), (name, leaning))
    assert holds(Whereabouts(Nearby.NEXT_TO, ("box",)), "rod", scene)

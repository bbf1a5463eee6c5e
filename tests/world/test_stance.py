"""What lies, and what has no side to lie on."""

from __future__ import annotations

import math

import pytest

from etot_cli.world.stance import TOPPLED_DEG, can_lie, lies
from etot_cli.world.state import ObjectInfo
from tests.reasoning import scenes

Size = tuple[float, float, float]


def info(kind: str, size: Size) -> ObjectInfo:
    return scenes.item("thing", kind, size=size)[0]


def tipped(deg: float) -> tuple[float, float, float, float]:
    """Turned about x, from upright."""
    half = math.radians(deg) / 2
    return (math.cos(half), math.sin(half), 0.0, 0.0)


def pitched(deg: float) -> tuple[float, float, float, float]:
    """Turned about y."""
    half = math.radians(deg) / 2
    return (math.cos(half), 0.0, math.sin(half), 0.0)


@pytest.mark.parametrize("kind", ["cup", "cylinder", "box"])
@pytest.mark.parametrize("way", [1, -1])
def test_what_has_a_top_lies_on_its_side(kind: str, way: int) -> None:
    thing = info(kind, (0.06, 0.05, 0.12))
    assert not lies(thing, tipped(0)) and not lies(thing, tipped(way * 180))
    assert lies(thing, tipped(way * 90))
    assert lies(thing, tipped(way * (90 - TOPPLED_DEG + 2)))
    assert not lies(thing, tipped(way * (90 - TOPPLED_DEG - 2)))


def test_a_wide_bowl_lies_on_its_side_though_it_is_higher_then() -> None:
    assert lies(info("cup", (0.15, 0.15, 0.06)), tipped(90))


@pytest.mark.parametrize("rolled", [0, 45, 90])
def test_a_rod_lies_however_it_has_rolled(rolled: float) -> None:
    pen = info("pen", (0.15, 0.012, 0.012))
    assert lies(pen, tipped(rolled)) and not lies(pen, pitched(90)) and not lies(pen, pitched(60))
    assert lies(pen, pitched(30))


def test_what_is_wider_than_high_lies_on_a_broad_side() -> None:
    book = info("box", (0.20, 0.15, 0.03))
    assert lies(book, tipped(0)) and lies(book, tipped(180))
    assert not lies(book, tipped(90)), "on its long edge"
    assert not lies(book, pitched(90)), "on its short edge"
    plank = info("box", (0.12, 0.05, 0.04))
    assert lies(plank, tipped(0)) and lies(plank, tipped(90)) and not lies(plank, pitched(90))
    plate = info("cylinder", (0.2, 0.2, 0.02))
    assert lies(plate, tipped(0)) and not lies(plate, tipped(90))


@pytest.mark.parametrize("size", [(0.05, 0.05, 0.05), (0.052, 0.05, 0.048)])
def test_cubes_and_balls_do_not_lie(size: Size) -> None:
    for kind in ("box", "sphere"):
        assert not can_lie(info(kind, size)) and not lies(info(kind, size), tipped(90))

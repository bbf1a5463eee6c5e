"""``--error``: what is read, what is refused, and what is drawn with it."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from etot_cli.specs.load import load_task
from etot_cli.specs.start_error import StartError, parse_start_error, with_start_error
from etot_cli.specs.vary import vary
from tests.shared import ROOT


@pytest.mark.parametrize(
    ("text", "position_m", "yaw_deg"),
    [
        ("5mm,3deg", 0.005, 3.0),
        ("3deg, 5 mm", 0.005, 3.0),
        ("1.5cm", 0.015, 0.0),
        ("0.05rad", 0.0, math.degrees(0.05)),
        (".01m,0deg", 0.01, 0.0),
        ("1e1mm", 0.01, 0.0),
    ],
)
def test_lengths_and_angles(text: str, position_m: float, yaw_deg: float) -> None:
    found = parse_start_error(text)
    assert found.position_m == pytest.approx(position_m)
    assert found.yaw_deg == pytest.approx(yaw_deg)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "found ''; expected a length and an angle"),
        ("5,3", "found '5'"),
        ("5mm,3", "found '3'"),
        ("-5mm", "found '-5mm'"),
        ("nan mm", "found 'nan mm'"),
        ("5mm,3mm", "two lengths"),
        ("5deg,3rad", "two angles"),
        ("1in", "found '1in'"),
        ("5mm,3deg,", "found ''"),
        ("101mm", "at most 100 mm"),
        ("4rad", "at most 180 degrees"),
        ("1e999mm", "at most 100 mm"),
    ],
)
def test_what_is_refused(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=message.replace("(", r"\(")):
        parse_start_error(text)


@given(st.text(max_size=30))
def test_anything_is_read_or_refused_in_words(text: str) -> None:
    try:
        found = parse_start_error(text)
    except ValueError as error:
        assert str(error).startswith("found ")
    else:
        assert 0.0 <= found.position_m <= 0.1 and 0.0 <= found.yaw_deg <= 180.0


@pytest.mark.parametrize("also", [False, True])
def test_only_poses_are_drawn_unless_the_rest_is_asked_for(also: bool) -> None:
    scene = load_task(ROOT / "tasks" / "task5.yaml").scene
    drawn = vary(with_start_error(scene, StartError(0.003, 2.0), vary=also), 7)
    moved = [
        abs(new.at[axis] - old.at[axis])
        for old, new in zip(scene.objects.values(), drawn.objects.values(), strict=True)
        if old.at is not None and new.at is not None
        for axis in (0, 1)
    ]
    assert 0.0 < max(moved) <= 0.003 * 1.3 + 1e-9
    masses = [(o.mass, o.friction) for o in scene.objects.values()]
    assert (masses != [(o.mass, o.friction) for o in drawn.objects.values()]) is also

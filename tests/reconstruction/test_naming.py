"""Names from instructions, colours and kinds."""

from __future__ import annotations

import numpy as np

from etot_cli.reconstruction.masks.naming import assign_names, color_of, hint_of, mentions

GRAY, BLUE, GREEN = (0.93, 0.93, 0.91), (0.16, 0.33, 0.72), (0.25, 0.6, 0.25)


def test_nouns_and_colours_are_read() -> None:
    found = mentions("Put the blue pencil into the small green cup, then close the drawer.")
    assert [(m.noun, m.kind, m.color) for m in found] == [
        ("pencil", "pen", "blue"), ("cup", "cup", "green"), ("drawer", "drawer_unit", None),
    ]  # fmt: skip


def test_several_of_a_kind_are_told_apart_by_colour() -> None:
    names = assign_names(
        {"a": "cup", "b": "cup", "c": "pen", "d": "sphere"},
        {"a": BLUE, "b": GREEN, "c": GRAY, "d": BLUE},
        "Place the marker in a mug.",
    )
    assert names == {"a": "blue_mug", "b": "green_mug", "c": "marker", "d": "sphere_1"}


def test_without_an_instruction_kind_and_number() -> None:
    assert assign_names({"x": "cup", "y": "cup"}, {"x": BLUE, "y": BLUE}, None) == {
        "x": "cup_1", "y": "cup_2",
    }  # fmt: skip


def test_names_hint_at_kinds() -> None:
    assert hint_of("left_mug") == "cup"
    assert hint_of("chest of drawers") == "drawer_unit"
    assert hint_of("thing") is None


def test_a_tinted_white_is_white() -> None:
    picture = np.full((20, 20, 3), (190, 170, 165), np.uint8)
    assert min(color_of(picture, np.ones((20, 20), bool))) > 0.85

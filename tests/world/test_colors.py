"""Colour words and values."""

from __future__ import annotations

import pytest

from etot_cli.errors import WorldError
from etot_cli.world.colors import BASIC_COLORS, is_basic, nearest_basic, rgb


def test_forms_agree() -> None:
    assert rgb("#ff8000") == pytest.approx((1.0, 128 / 255, 0.0))
    assert rgb((0.1, 0.2, 0.3)) == pytest.approx((0.1, 0.2, 0.3))
    assert rgb("white") == rgb("White")


@pytest.mark.parametrize("word", sorted(BASIC_COLORS))
def test_a_basic_word_is_its_own_nearest(word: str) -> None:
    assert nearest_basic(word) == word
    assert nearest_basic(BASIC_COLORS[word]) == word
    assert is_basic(word) and is_basic(BASIC_COLORS[word])


@pytest.mark.parametrize(
    ("color", "word"),
    [
        ("grey", "gray"), ("beech", "brown"), ("lime", "green"), ("silver", "gray"),
        ("#fa0505", "red"), ("#0a0a0a", "black"), ((0.95, 0.95, 0.97), "white"),
    ],
)  # fmt: skip
def test_nearest_word(color: str | tuple[float, float, float], word: str) -> None:
    assert nearest_basic(color) == word


@pytest.mark.parametrize(
    "color", ["cyan", "beech", "lime", "silver", "wheat", (0.22, 0.68, 0.74), "#cdad80"]
)
def test_a_neighbour_of_a_basic_colour_is_none(color: str | tuple[float, float, float]) -> None:
    assert not is_basic(color)


def test_unknown_name_lists_the_known_ones() -> None:
    with pytest.raises(WorldError, match="unknown colour 'mauveish'; expected #rrggbb or one of"):
        rgb("mauveish")

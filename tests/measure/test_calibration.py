"""The statistics of calibration, on tables whose answers are known."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from tests.measure.calibrate import LEAST_SETTINGS, settings
from tests.measure.calibration import Pair, bias, coverage, decompose, draw_diagram, explained


def pair(alive: int, held: int, worlds: int = 16, unseen: int = 24) -> Pair:
    return Pair("", alive, worlds, held, unseen)


def drawn(odds: np.ndarray, seed: int, off: float = 0.0, unseen: int = 24) -> list[Pair]:
    """Settings of these odds, told too high by ``off``."""
    rng = np.random.default_rng(seed)
    told = rng.binomial(16, np.clip(odds + off, 0.0, 1.0))
    held = rng.binomial(unseen, odds)
    return [pair(int(k), int(m), unseen=unseen) for k, m in zip(told, held, strict=True)]


def test_the_parts_add_up_to_the_brier_score() -> None:
    pairs = [pair(16, 20), pair(8, 6), pair(8, 14), pair(0, 1), pair(12, 24)]
    outcomes = [
        (p.predicted - outcome) ** 2
        for p in pairs
        for outcome in [1.0] * p.held + [0.0] * (p.unseen - p.held)
    ]
    parts = decompose(pairs)
    assert parts.brier == pytest.approx(np.mean(outcomes))
    assert parts.uncertainty == pytest.approx((65 / 120) * (55 / 120))


def test_odds_that_come_true_are_reliable_and_constant_ones_resolve_nothing() -> None:
    assert decompose([pair(8, 12), pair(16, 24), pair(4, 6)]).reliability == pytest.approx(0.0)
    same = decompose([pair(8, 3), pair(8, 20)])
    assert same.resolution == pytest.approx(0.0)


@pytest.mark.slow
def test_perfect_odds_are_explained_by_their_draws_and_optimistic_ones_are_not() -> None:
    odds = np.linspace(0.02, 0.98, 60)
    honest = np.mean(
        [
            decompose(p).reliability - explained(p).reliability
            for p in (drawn(odds, s) for s in range(4))
        ]
    )
    assert abs(honest) < 0.004
    optimistic = drawn(odds, 0, off=0.2)
    assert decompose(optimistic).reliability - explained(optimistic).reliability > 0.01
    assert bias(optimistic) > 0.1
    assert abs(np.mean([bias(drawn(odds, seed)) for seed in range(16)])) < 0.015


@pytest.mark.slow
def test_a_rate_of_few_worlds_leaves_the_interval_more_often_than_the_odds_do() -> None:
    odds = np.linspace(0.1, 0.9, 60)
    few, many = explained(drawn(odds, 0)), explained(drawn(odds, 0, unseen=2400))
    assert few.covered < 0.9 < 0.94 < few.covered_in_the_long_run
    assert many.covered == pytest.approx(many.covered_in_the_long_run, abs=0.01)


def test_coverage_counts_rates_within_the_told_interval() -> None:
    assert coverage([pair(8, 12), pair(16, 24), pair(16, 12), pair(0, 24)]) == 0.5


@pytest.mark.slow
def test_the_diagram_is_a_picture(tmp_path: Path) -> None:
    draw_diagram([pair(8, 12), pair(16, 24)], tmp_path / "deep" / "diagram.png")
    image = cv2.imread(str(tmp_path / "deep" / "diagram.png"))
    assert image is not None and image.shape[0] == image.shape[1]
    assert len(np.unique(image.reshape(-1, 3), axis=0)) > 10


def test_there_are_settings_enough_and_no_two_of_a_name() -> None:
    names = [setting.name for setting in settings()]
    assert len(set(names)) == len(names) >= LEAST_SETTINGS
    assert any(len(setting.plans) > 1 for setting in settings())

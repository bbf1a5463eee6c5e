"""A few kills of real runs; ``make soak`` has two hundred."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.measure.soak import jobs, kill_one


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc").is_dir(), reason="looks for processes in /proc")
@pytest.mark.parametrize(
    ("number", "after_s"), [("SIGKILL", 5.0), ("SIGTERM", 4.0), ("SIGHUP", 2.0)]
)
def test_nothing_is_left_of_a_killed_run(tmp_path: Path, number: str, after_s: float) -> None:
    plan = jobs(None)[0]
    assert kill_one(plan, number, after_s, tmp_path) == []

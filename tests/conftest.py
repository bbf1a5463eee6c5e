"""What all tests share: MuJoCo without OpenGL, no pages, and the marker of those that render."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from hypothesis.configuration import set_hypothesis_home_dir

from etot_cli.world.engine import import_mujoco
from tests.opengl import need_opengl

# Pages have tests of their own; the hundreds of other runs need not render pictures.
os.environ.setdefault("ETOT_HTML", "0")

# Hundreds of processes would otherwise compile the whole package, each for itself.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# What Hypothesis keeps takes seconds to make; some tests work in folders of their own.
set_hypothesis_home_dir(Path(__file__).parents[1] / ".hypothesis")

# How long an example takes says more about the machine's other work than about what is tested.
settings.register_profile(
    "shared machine", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("shared machine")

# Before any test module does it: a MUJOCO_GL that cannot be used would make that fail.
import_mujoco()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Where there is little time, the first case of a test stands for all of them."""
    seen: set[str] = set()
    for item in items:
        test = item.nodeid.partition("[")[0]
        if test in seen:
            item.add_marker(pytest.mark.slow)
        seen.add(test)


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Before any fixture renders."""
    if item.get_closest_marker("render"):
        need_opengl()

"""What all tests share: MuJoCo without OpenGL, no pages, and the marker of those that render."""

from __future__ import annotations

import gc
import os
import signal
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from hypothesis.configuration import set_hypothesis_home_dir

from etot_cli.cli.memory import COLLECT_EVERY, COLLECT_OLDER_EVERY
from etot_cli.world.engine import import_mujoco
from tests.opengl import need_opengl

# Pages have tests of their own; the hundreds of other runs need not render pictures.
os.environ.setdefault("ETOT_HTML", "0")

# Hundreds of processes would otherwise compile the whole package, each for itself.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# Under nohup the program goes on after a SIGHUP, as it should; what is started here must stop.
if hasattr(signal, "SIGHUP"):
    signal.signal(signal.SIGHUP, signal.SIG_DFL)

# What Hypothesis keeps takes seconds to make; some tests work in folders of their own.
set_hypothesis_home_dir(Path(__file__).parents[1] / ".hypothesis")

# How long an example takes says more about the machine's other work than about what is tested.
settings.register_profile(
    "shared machine", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("shared machine")

# Before any test module does it: a MUJOCO_GL that cannot be used would make that fail.
import_mujoco()


def pytest_addoption(parser: pytest.Parser) -> None:
    """What takes longer than a run of all tests may."""
    parser.addoption("--whole-corpus", action="store_true", help="read all sentences of the corpus")


@pytest.hookimpl(trylast=True)
def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Where there is little time, the first case of a test stands for all of them.

    The others are not even made: to deselect thousands takes each worker as long as to run a fifth
    of what is left.
    """
    if "not slow" in metafunc.config.getoption("markexpr"):
        del metafunc._calls[1:]  # pytest has no public way to take cases back


def pytest_collection_finish() -> None:
    """Garbage is looked for as seldom as the program does it, and not among the tests themselves:
    to look through 16,000 of them again and again took a tenth of a run, and more.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(COLLECT_EVERY, COLLECT_OLDER_EVERY)


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Before any fixture renders."""
    if item.get_closest_marker("render"):
        need_opengl()

"""Where a report comes from: versions and times."""

from __future__ import annotations

import platform
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from functools import lru_cache
from importlib.metadata import PackageNotFoundError, version

from etot_cli.reporting.models import UNKNOWN, TimingModel, VersionsModel, seconds


@lru_cache
def package_version(name: str) -> str:
    """The installed version of a distribution, read from its metadata without importing it."""
    try:
        return version(name)
    except PackageNotFoundError:
        return UNKNOWN


def versions() -> VersionsModel:
    """The versions that results depend on."""
    return VersionsModel(
        etot=package_version("etot"),
        python=platform.python_version(),
        mujoco=package_version("mujoco"),
        numpy=package_version("numpy"),
        scipy=package_version("scipy"),
        trimesh=package_version("trimesh"),
        coacd=package_version("coacd"),
        small_gicp=package_version("small_gicp"),
        opencv=package_version("opencv-python-headless"),
        machine=f"{platform.system()} {platform.machine()}",
    )


class Stopwatch:
    """Times a command and its phases."""

    def __init__(self) -> None:
        self._started_at = datetime.now(UTC)
        self._start = time.monotonic()
        self._phases: dict[str, float] = {}

    @contextmanager
    def phase(self, name: str) -> Iterator[None]:
        """Times the block, also when it is left by an exception."""
        start = time.monotonic()
        try:
            yield
        finally:
            spent = time.monotonic() - start
            self._phases[name] = self._phases.get(name, 0.0) + spent

    def timing(self) -> TimingModel:
        """What has been measured up to now."""
        return TimingModel(
            started=self._started_at.isoformat(timespec="milliseconds"),
            wall_s=seconds(time.monotonic() - self._start),
            phases={name: seconds(spent) for name, spent in self._phases.items()},
        )


@contextmanager
def rendering_phase(timing: TimingModel) -> Iterator[None]:
    """Times what is rendered after the report was made; where that fails, nothing is added."""
    begun = time.monotonic()
    yield
    spent_s = time.monotonic() - begun
    timing.phases["render"] = seconds(timing.phases.get("render", 0.0) + spent_s)
    timing.wall_s = seconds(timing.wall_s + spent_s)

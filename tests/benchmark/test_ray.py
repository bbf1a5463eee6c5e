"""Trials on a local Ray cluster of two workers: the same rows, whatever happens to a worker."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from etot_cli.benchmark.running.engine import Engine, EngineName, open_engine
from etot_cli.benchmark.running.journal import Journal
from etot_cli.benchmark.running.runner import run_trials
from etot_cli.benchmark.trial import TrialStatus
from etot_cli.errors import ServiceError
from tests.benchmark import toys

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("ray")


@pytest.fixture(scope="module")
def cluster(shared: Path) -> Iterator[Engine]:
    pytest.importorskip("ray", reason="Ray is not installed (pip install 'etot[ray]')")
    engine = open_engine(EngineName.RAY, 2, toys.begin, (str(shared),))
    yield engine
    engine.close()


def test_the_same_results_as_here(cluster: Engine, tmp_path: Path) -> None:
    """A worker that is killed in the middle of a trial costs nothing but that trial's time."""
    with Journal(tmp_path) as journal:
        assert run_trials(toys.work(), toys.dies_once, cluster, journal, 2).status == "success"
        found = [journal.results[item.key] for item in toys.work()]
    assert found == [toys.result(item) for item in toys.work()]


def test_what_cannot_be_done_is_on_record(cluster: Engine, tmp_path: Path) -> None:
    told = []
    for perform in (toys.dies_always, toys.defective):
        folder = tmp_path / perform.__name__
        folder.mkdir()
        with Journal(folder) as journal:
            assert run_trials(toys.work(1, 1, 2), perform, cluster, journal, 2).status == "success"
            found = journal.results.values()
        told += [item.reason for item in found if item.status is TrialStatus.ERROR]
    assert "ended 2 times" in told[0] and "ValueError: no such thing" in told[1]


def test_without_ray_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(ServiceError, match=r"pip install 'etot\[ray\]'"):
        open_engine(EngineName.RAY, 1, toys.begin, ())

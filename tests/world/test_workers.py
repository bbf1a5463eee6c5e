"""Worker processes: they end with their parent, and a lost one is replaced."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from etot_cli.skills.action import parse_plan
from etot_cli.world.state import CauseKind
from etot_cli.world.workers import WorkerLostError, WorkerPool

SOON_S = 15.0


def nothing() -> None:
    """Begins a worker."""


def add(one: int, two: int) -> int:
    return one + two


def who() -> int:
    return os.getpid()


def die_by(number: int) -> None:
    os.kill(os.getpid(), number)


def die_once(mark: Path) -> str:
    """Dies the first time, leaving a mark."""
    if mark.exists():
        return "done"
    mark.touch()
    os._exit(3)


def hungry() -> None:
    raise MemoryError


def wrong() -> None:
    raise ValueError("as it says")


class Tangled:
    """In a cycle with itself, as what a world is made of; leaves a mark when it goes."""

    def __init__(self, mark: Path) -> None:
        self.myself, self.mark = self, mark

    def __del__(self) -> None:
        self.mark.touch()


def tangle(mark: Path) -> None:
    Tangled(mark)


@pytest.fixture
def pool() -> Iterator[WorkerPool]:
    pool = WorkerPool(2, nothing)
    yield pool
    pool.close()


def gone(pid: int) -> bool:
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return True
    return state == "Z"


def test_results_and_errors_come_back(pool: WorkerPool) -> None:
    futures = [pool.submit(add, index, 1) for index in range(50)]
    assert [future.result(SOON_S) for future in futures] == list(range(1, 51))
    with pytest.raises(ValueError, match="as it says"):
        pool.submit(wrong).result(SOON_S)
    with pytest.raises(Exception, match="pickle"):
        pool.submit(lambda: 1).result(SOON_S)
    assert pool.submit(add, 1, 1).result(SOON_S) == 2


def test_what_a_worker_began_with_comes_first() -> None:
    with closing(WorkerPool(1, add, (1, 2))) as pool:
        assert pool.submit(add, 4).result(SOON_S) == 7


def test_what_a_call_leaves_behind_is_gone_before_the_next(tmp_path: Path) -> None:
    mark = tmp_path / "gone"
    with closing(WorkerPool(1, nothing)) as pool:
        pool.submit(tangle, mark).result(SOON_S)
        assert pool.submit(mark.exists).result(SOON_S)


def test_a_lost_worker_is_replaced_and_its_task_tried_again(
    pool: WorkerPool, tmp_path: Path
) -> None:
    lost = pool.submit(die_once, tmp_path / "mark")
    others = [pool.submit(add, index, 0) for index in range(20)]
    assert lost.result(SOON_S) == "done"
    assert [future.result(SOON_S) for future in others] == list(range(20))


@pytest.mark.slow
def test_a_task_that_kills_twice_is_given_up(pool: WorkerPool) -> None:
    with pytest.raises(WorkerLostError, match="ended 2 times, last time killed by SIGKILL"):
        pool.submit(die_by, signal.SIGKILL).result(SOON_S)
    with pytest.raises(WorkerLostError, match="out of memory"):
        pool.submit(hungry).result(SOON_S)
    assert pool.alive and pool.submit(add, 2, 2).result(SOON_S) == 4


@pytest.mark.slow
def test_idle_workers_that_die_are_replaced(pool: WorkerPool) -> None:
    for _ in range(3):
        os.kill(pool.submit(who).result(SOON_S), signal.SIGKILL)
    assert pool.submit(add, 1, 2).result(SOON_S) == 3


def test_closing_ends_what_is_under_way() -> None:
    pool = WorkerPool(2, nothing)
    pids = {pool.submit(who).result(SOON_S) for _ in range(10)}
    slow = [pool.submit(time.sleep, 60.0) for _ in range(5)]
    begun = time.monotonic()
    pool.close()
    pool.close()
    assert time.monotonic() - begun < 5.0
    assert all(future.done() for future in slow) and all(gone(pid) for pid in pids)
    with pytest.raises(WorkerLostError):
        pool.submit(who).result(SOON_S)


PARENT = """
import time
from etot_cli.world.workers import WorkerPool
from tests.world.test_workers import nothing, who

if __name__ == "__main__":
    pool = WorkerPool(2, nothing)
    pids = set()
    while len(pids) < 2:
        pids.add(pool.submit(who).result(15))
        pool.submit(time.sleep, 0.01)
    futures = [pool.submit(time.sleep, 60) for _ in range(2)]
    print(*pids, flush=True)
    time.sleep(60)
"""


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="looks for processes in /proc")
@pytest.mark.parametrize("method", ["fork", "spawn"])
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
@pytest.mark.slow
def test_no_worker_outlives_its_parent(tmp_path: Path, method: str, number: int) -> None:
    if method == "fork" and not sys.platform.startswith("linux"):
        pytest.skip("workers are forked on Linux alone")
    script = tmp_path / "parent.py"
    head = f"import etot_cli.world.workers as workers\nworkers.METHOD = {method!r}\n"
    script.write_text(head + PARENT)
    root = Path(__file__).parents[2]
    parent = subprocess.Popen(
        [sys.executable, str(script)], stdout=subprocess.PIPE, text=True, cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(root)},
    )  # fmt: skip
    assert parent.stdout is not None
    pids = [int(word) for word in parent.stdout.readline().split()]
    assert len(pids) == 2 and not any(gone(pid) for pid in pids)
    parent.send_signal(number)
    parent.wait()
    # The output pipe closes only when nobody holds it any more.
    begun = time.monotonic()
    assert parent.stdout.read() == ""
    while not all(gone(pid) for pid in pids):
        assert time.monotonic() - begun < 1.0
        time.sleep(0.01)
    parent.stdout.close()


def lose_worker(*_: object) -> None:
    os._exit(9)


@pytest.mark.slow
def test_an_action_that_kills_its_workers_has_failed(monkeypatch: pytest.MonkeyPatch) -> None:
    from etot_cli.control import simulator
    from tests.skills.helpers import BALL
    from tests.world.helpers import make_scene

    monkeypatch.setattr(simulator.Worlds, "perform", lose_worker)
    opened = simulator.open_simulator(make_scene(ball=BALL), seed=0, jobs=2, worlds=1, record=False)
    with closing(opened):
        state, scene = opened.start()
        (action,) = parse_plan("[PICK UP, ball]")
        simulated = opened.submit(state, action).result(SOON_S)
    record = simulated.outcomes[0].record
    assert not record.effect and record.after == scene and record.cause is not None
    assert record.cause.kind is CauseKind.ABANDONED and "exit code 9" in record.cause.text

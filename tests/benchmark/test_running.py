"""Trials run in processes, kept one by one, and gone on with after any interruption."""

from __future__ import annotations

import errno
import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from etot_cli.benchmark.running.engine import EngineName, open_engine
from etot_cli.benchmark.running.journal import MAX_LINE_BYTES, NAME, Journal
from etot_cli.benchmark.running.runner import Perform, RunObserver, run_trials
from etot_cli.benchmark.running.stopping import ROUNDS, Ending
from etot_cli.benchmark.trial import (
    ActionTaken,
    TrialKey,
    TrialResult,
    TrialStatus,
    from_document,
    to_document,
)
from etot_cli.errors import SpecError
from tests.benchmark import toys

WORDS = st.text(max_size=12)
RESULTS = st.builds(
    TrialResult,
    key=st.builds(TrialKey, WORDS, st.integers(0, 99), WORDS),
    seed=st.integers(0, 2**32 - 1),
    status=st.sampled_from(TrialStatus),
    actions=st.lists(st.builds(ActionTaken, WORDS, WORDS, WORDS), max_size=3).map(tuple),
    replans=st.integers(0, 5),
    harm=st.lists(WORDS, max_size=2).map(tuple),
    failure_class=st.none() | WORDS,
    reason=WORDS,
    costs=st.dictionaries(WORDS, st.floats(0, 1e6), max_size=3),
    report=WORDS,
)
DONE = Ending("success")
CHILD = """
import sys
from pathlib import Path
from etot_cli.benchmark.running.engine import EngineName, open_engine
from etot_cli.benchmark.running.journal import Journal
from etot_cli.benchmark.running.runner import run_trials
from tests.benchmark import toys
engine = open_engine(EngineName.LOCAL, 2, toys.begin, (sys.argv[1],))
with Journal(Path(sys.argv[1])) as journal:
    run_trials(toys.work(2, 2, 12), toys.slow, engine, journal, 2)
engine.close()
"""


def run(
    folder: Path, perform: Perform, jobs: int = 2, observer: RunObserver | None = None
) -> list[TrialResult]:
    work = toys.work()
    engine = open_engine(EngineName.LOCAL, jobs, toys.begin, (str(folder),))
    try:
        with Journal(folder) as journal:
            assert run_trials(work, perform, engine, journal, jobs, observer) == DONE
            return [journal.results[item.key] for item in work]
    finally:
        engine.close()


@given(RESULTS)
@pytest.mark.slow
def test_a_result_survives_its_line(result: TrialResult) -> None:
    assert from_document(json.loads(json.dumps(to_document(result)))) == result


@pytest.mark.parametrize(
    "document", [{}, {"method": "a"}, {"more": 1}, {"task": "t", "number": "x"}]
)
def test_other_documents_are_refused(document: dict[str, object]) -> None:
    with pytest.raises(ValueError, match="is no trial's result"):
        from_document(document)


@pytest.mark.parametrize("jobs", [1, 2])
def test_results_do_not_depend_on_jobs(tmp_path: Path, jobs: int) -> None:
    assert run(tmp_path, toys.perform, jobs) == [toys.result(item) for item in toys.work()]


def test_a_finished_trial_is_not_repeated(tmp_path: Path) -> None:
    first = run(tmp_path, toys.noted)
    assert run(tmp_path, toys.noted) == first
    begun = (tmp_path / "begun").read_text(encoding="utf-8").splitlines()
    assert sorted(begun) == sorted(item.key.name for item in toys.work())


@pytest.mark.slow
def test_a_process_that_dies_once_costs_nothing(tmp_path: Path) -> None:
    assert run(tmp_path, toys.dies_once) == [toys.result(item) for item in toys.work()]


@pytest.mark.parametrize(
    ("perform", "reason"), [(toys.dies_always, "SIGKILL"), (toys.defective, "no such thing")]
)
@pytest.mark.slow
def test_what_cannot_be_done_is_an_error_on_record(
    tmp_path: Path, perform: Perform, reason: str
) -> None:
    found = run(tmp_path, perform)
    errors = [item for item in found if item.status is TrialStatus.ERROR]
    assert {item.key.number for item in errors} == {1} and len(errors) == 4
    assert all(reason in item.reason for item in errors)
    again = run(tmp_path, toys.perform)
    assert again == [toys.result(item) for item in toys.work()], "an error is tried anew"


def test_a_torn_line_is_cut_off(tmp_path: Path) -> None:
    with Journal(tmp_path) as journal:
        for item in toys.work()[:3]:
            journal.add(toys.result(item))
    path = tmp_path / NAME
    whole = path.read_bytes()
    for cut in range(1, len(whole.splitlines()[-1]) + 1, 7):
        path.write_bytes(whole[:-cut])
        with Journal(tmp_path) as journal:
            assert len(journal.results) == 2
            journal.add(toys.result(toys.work()[5]))
        with Journal(tmp_path) as journal:
            assert len(journal.results) == 3


@pytest.mark.parametrize(
    "damage",
    [
        {"number": 1e400}, {"seed": "x"}, {"costs": "abc"}, {"costs": {"nodes": float("nan")}},
        {"costs": {"nodes": 10**400}}, {"wall_s": "x"}, {"peak_mib": None}, {"times": [1]},
        {"harm": [1]}, {"reason": 5}, {"replans": -3}, {"actions": [{"action": 1}]}, {"more": 1},
        "[]", "null", "", "[" * 100_000, "\xff", "x" * (MAX_LINE_BYTES + 1),
    ],
)  # fmt: skip
def test_a_line_that_is_no_result_is_named_and_kept(tmp_path: Path, damage: object) -> None:
    good = to_document(toys.result(toys.work()[0]))
    bad = damage if isinstance(damage, str) else json.dumps({**good, **dict(damage)})  # type: ignore[call-overload]
    path = tmp_path / NAME
    path.write_text(f"{json.dumps(good)}\n{bad}\n{json.dumps(good)}\n", encoding="latin-1")
    before = path.read_bytes()
    with pytest.raises(SpecError, match=r"trials\.jsonl:2: .*expected one finished trial"):
        Journal(tmp_path)
    assert path.read_bytes() == before


def test_a_journal_is_a_file(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / NAME)
    with pytest.raises(SpecError, match="no regular file"):
        Journal(tmp_path)


def test_interrupting_keeps_what_is_finished(tmp_path: Path) -> None:
    class Impatient:
        def trial_finished(self, result: TrialResult, done: int, total: int, left_s: float) -> None:
            assert total == len(toys.work()) and left_s >= 0.0
            if done == 3:
                raise KeyboardInterrupt

    engine = open_engine(EngineName.LOCAL, 1, toys.begin, ())
    with Journal(tmp_path) as journal:
        ended = run_trials(toys.work(), toys.perform, engine, journal, 1, Impatient())
        assert ended.status == "interrupted"
    engine.close()
    with Journal(tmp_path) as journal:
        assert len(journal.results) == 3


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_service_that_is_gone_is_not_asked_for_ever(tmp_path: Path, jobs: int) -> None:
    work = toys.work(2, 1, 40)
    engine = open_engine(EngineName.LOCAL, jobs, toys.begin, (str(tmp_path),))
    with Journal(tmp_path) as journal:
        ended = run_trials(work, toys.forsaken, engine, journal, jobs)
        assert ended == Ending("lost", "server http://x: no answer")
        errors = [one.key.method for one in journal.results.values() if not one.actions]
        assert {*errors} == {"method1"}, "what does not ask that service went on"
        assert ROUNDS * jobs < len(errors) <= (ROUNDS + 3) * jobs
        assert len(journal.results) == 40 + len(errors)
        assert run_trials(work, toys.perform, engine, journal, jobs) == DONE
        assert all(one.actions for one in journal.results.values())
    engine.close()


@pytest.mark.slow
def test_a_service_that_was_away_for_a_moment_costs_its_trials_alone(tmp_path: Path) -> None:
    # Two trials have ended whenever somebody looks: they count in the order of their beginning.
    work = toys.work(1, 1, 60)
    with Journal(tmp_path) as journal:
        assert run_trials(work, toys.forsaken_now_and_then, toys.AtOnce(), journal, 1) == DONE
        assert sum(one.status is TrialStatus.ERROR for one in journal.results.values()) == 40


def test_no_trial_is_begun_beyond_the_budget_of_the_run(tmp_path: Path) -> None:
    work = toys.work(1, 1, 30)
    for _ in range(2):  # gone on with, nothing is left to spend
        engine = open_engine(EngineName.LOCAL, 1, toys.begin, (str(tmp_path),))
        with Journal(tmp_path) as journal:
            ended = run_trials(work, toys.perform, engine, journal, 1, budget={"nodes": 10.0})
            assert ended.status == "limit" and ended.reason.endswith(" of 10 nodes are spent")
            assert 4 <= len(journal.results) <= 5, "one more was ready when the fourth ended"
        engine.close()
    engine = open_engine(EngineName.LOCAL, 1, toys.begin, (str(tmp_path),))
    with Journal(tmp_path) as journal:
        assert run_trials(work, toys.perform, engine, journal, 1, budget={"nodes": 1e3}) == DONE
    engine.close()


def test_a_disk_that_takes_no_more_ends_the_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    engine = open_engine(EngineName.LOCAL, 1, toys.begin, (str(tmp_path),))
    with Journal(tmp_path) as journal:
        kept = journal.add

        def full(result: TrialResult) -> None:
            if len(journal.results) == 2:
                raise OSError(errno.ENOSPC, "No space left on device")
            kept(result)

        monkeypatch.setattr(journal, "add", full)
        ended = run_trials(toys.work(), toys.perform, engine, journal, 1)
        assert ended.status == "lost" and ended.reason.endswith(f"{NAME}: No space left on device")
    engine.close()


@pytest.mark.slow
def test_killed_at_random_moments_and_gone_on_with(tmp_path: Path) -> None:
    root = Path(__file__).parents[2]
    rng = random.Random(5)
    for _ in range(3):
        process = subprocess.Popen(
            [sys.executable, "-c", CHILD, str(tmp_path)], cwd=root,
            env={**os.environ, "PYTHONPATH": str(root)},
        )  # fmt: skip
        deadline = time.monotonic() + 30
        size = (tmp_path / NAME).stat().st_size if (tmp_path / NAME).exists() else 0
        while time.monotonic() < deadline and process.poll() is None:
            if (tmp_path / NAME).exists() and (tmp_path / NAME).stat().st_size > size:
                break
            time.sleep(0.01)
        time.sleep(rng.uniform(0.0, 0.15))
        process.send_signal(signal.SIGKILL)
        process.wait()
    with Journal(tmp_path) as journal:
        assert 3 <= len(journal.results) < 48, "it was killed on the way"
    done = subprocess.run([sys.executable, "-c", CHILD, str(tmp_path)], cwd=root, check=False,
                          env={**os.environ, "PYTHONPATH": str(root)}, timeout=60)  # fmt: skip
    assert done.returncode == 0
    lines = (tmp_path / NAME).read_text(encoding="utf-8").splitlines()
    assert len(lines) == 48, "no trial stands there twice"
    with Journal(tmp_path) as journal:
        for item in toys.work(2, 2, 12):
            assert journal.results[item.key].outcome() == toys.result(item).outcome()

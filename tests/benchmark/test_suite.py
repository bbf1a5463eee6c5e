"""What the command line may name: tasks, folders, suites, random problems; and every way to err."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import get_args

import pytest

from etot_cli.benchmark.methods.catalogue import METHODS, methods_of
from etot_cli.benchmark.problems import FAMILIES
from etot_cli.benchmark.suite import MethodName, digest, random_problems, seeds_of, select
from etot_cli.errors import EtotError, SpecError

TASK = """\
name: {name}
instruction: Pick up the ball.
scene:
  objects:
    ball: {{kind: sphere, diameter: {diameter}, at: [0.4, 0.0]}}
success:
  - in_hand: ball
"""


def write(folder: Path, name: str, diameter: float = 0.05, stem: str = "") -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{stem or name}.yaml"
    path.write_text(TASK.format(name=name, diameter=diameter), encoding="utf-8")
    return path


def suite(folder: Path, text: str, name: str = "suite.yaml") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def names(*inputs: Path | str, folder: Path) -> list[str]:
    return [task.name for task in select([str(item) for item in inputs], folder).tasks]


def test_files_folders_and_suites_in_their_order(tmp_path: Path) -> None:
    one, _ = write(tmp_path / "a", "one"), write(tmp_path / "a", "two")
    write(tmp_path, "three")
    own = suite(tmp_path, "tasks: [three.yaml, a]\ntrials: 3\nmethods: [etot, rekep]\nseed: 5\n")
    found = select([str(own)], tmp_path / "tasks")
    assert [task.name for task in found.tasks] == ["three", "one", "two"]
    assert (found.trials, found.methods, found.seed) == (3, ("etot", "rekep"), 5)
    assert names(one, own, folder=tmp_path) == ["one", "three", "two"], "each task once"


def test_a_suite_within_a_suite(tmp_path: Path) -> None:
    write(tmp_path / "inner", "one")
    suite(tmp_path / "inner", "tasks: [one.yaml]\n")
    outer = suite(tmp_path, "tasks: [inner/suite.yaml]\ntrials: 2\n")
    assert names(outer, folder=tmp_path) == ["one"]
    for depth in range(10):
        suite(tmp_path / "inner", f"tasks: [s{depth + 1}.yaml]\n", f"s{depth}.yaml")
    with pytest.raises(SpecError, match="deeper than"):
        names(tmp_path / "inner" / "s0.yaml", folder=tmp_path)


def test_suites_that_name_each_other_come_to_an_end(tmp_path: Path) -> None:
    write(tmp_path, "one")
    assert names(suite(tmp_path, "tasks: ['.', suite.yaml]\n"), folder=tmp_path) == ["one"]
    loop = suite(tmp_path, "tasks: [loop.yaml]\n", "loop.yaml")
    with pytest.raises(SpecError, match=r"loop\.yaml: names suites alone"):
        names(loop, folder=tmp_path)
    # Read as often as they are named, these would be 200 to the power of 6.
    for depth in range(6):
        entries = f"s{depth + 1}.yaml, " * 200
        suite(tmp_path, f"tasks: [{entries}]\n", f"s{depth}.yaml")
    suite(tmp_path, "tasks: [one.yaml]\n", "s6.yaml")
    assert names(tmp_path / "s0.yaml", folder=tmp_path) == ["one"]


@pytest.mark.parametrize(
    ("text", "where", "expected"),
    [
        ("tasks: []\n", ":1", "tasks"),
        ("tasks: [one.yaml]\ntrails: 3\n", ":2", "trails"),
        ("tasks: [one.yaml]\ntrials: 0\n", ":2", "trials"),
        ("tasks: [one.yaml]\nmethods: [best]\n", ":2", "etot"),
        ("tasks: [one.yaml]\nseeds: [1]\ntrials: 2\n", ":1", "either 'seeds'"),
        ("tasks:\n  - one.yaml\n  - gone.yaml\n", ":3", "no file or folder 'gone.yaml'"),
        ("tasks:\n  - /etc/passwd\n", ":2", "relative"),
        ("tasks: [one.yaml]\nseed: -1\n", ":2", "and at most 4294967295"),
        ("tasks:\n  - random:0\n", ":2", "random:N"),
        ("tasks:\n  - random:many\n", ":2", "random:N"),
        ("tasks: [one.yaml]\nseeds: [3, 4, 3]\n", ":1", "has 3 twice"),
        ("tasks:\n  - " + "a" * 300 + "\n", ":2", "no file or folder"),
    ],
)
def test_a_bad_suite_is_told_file_line_and_what_is_expected(
    tmp_path: Path, text: str, where: str, expected: str
) -> None:
    write(tmp_path, "one")
    with pytest.raises(SpecError) as told:
        names(suite(tmp_path, text), folder=tmp_path)
    assert f"suite.yaml{where}" in str(told.value) and expected in str(told.value)


def test_two_tasks_of_one_name(tmp_path: Path) -> None:
    first, same = write(tmp_path, "one"), write(tmp_path / "copy", "one")
    assert names(first, same, folder=tmp_path) == ["one"], "the same task twice is one"
    other = write(tmp_path / "other", "one", 0.06)
    with pytest.raises(SpecError, match="another task is called 'one' too"):
        names(first, other, folder=tmp_path)


def test_suites_that_disagree(tmp_path: Path) -> None:
    write(tmp_path, "one")
    first = suite(tmp_path, "tasks: [one.yaml]\ntrials: 2\n")
    second = suite(tmp_path, "tasks: [one.yaml]\ntrials: 3\n", "second.yaml")
    with pytest.raises(SpecError, match="its 'trials' are others than those of"):
        names(first, second, folder=tmp_path)


def test_random_problems_are_of_all_families_and_the_same_every_time(tmp_path: Path) -> None:
    few, more = random_problems(len(FAMILIES)), random_problems(40)
    assert {family for family, _ in few} == set(FAMILIES)
    assert more[: len(few)] == few and len(set(more)) == 40
    found = select(["random:3"], tmp_path / "first").tasks
    again = select(["random:3"], tmp_path / "second").tasks
    assert [digest(task) for task in found] == [digest(task) for task in again]
    assert all(task.success for task in found)


def test_a_task_is_known_by_what_is_in_it(tmp_path: Path) -> None:
    first = write(tmp_path, "one")
    moved = tmp_path / "elsewhere" / "one.yaml"
    moved.parent.mkdir()
    shutil.copy(first, moved)
    (one,), (two,) = (select([str(path)], tmp_path).tasks for path in (first, moved))
    assert digest(one) == digest(two)
    (other,) = select([str(write(tmp_path, "one", 0.06))], tmp_path).tasks
    assert digest(other) != digest(one)


def test_a_task_that_says_not_what_success_is(tmp_path: Path) -> None:
    path = write(tmp_path, "one")
    path.write_text(TASK.format(name="one", diameter=0.05).partition("success")[0])
    with pytest.raises(SpecError, match=r"one\.yaml: no 'success' conditions"):
        names(path, folder=tmp_path)


def test_nothing_to_run(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    with pytest.raises(EtotError, match="no task files"):
        names(tmp_path / "empty", folder=tmp_path)
    with pytest.raises(EtotError, match="nothing to run"):
        select([], tmp_path)


def test_seeds_are_those_of_execute() -> None:
    assert seeds_of(3, 7, None) == [(7, 0), (7, 1), (7, 2)]
    assert seeds_of(3, 7, (5, 9)) == [(5, 0), (9, 0)]


def test_methods_by_name() -> None:
    assert [method.name for method in methods_of(["rekep", "etot"])] == ["rekep", "etot"]
    assert len(methods_of(None)) == len(METHODS) == 8
    with pytest.raises(EtotError, match=r"no method 'best'; there are rekep, "):
        methods_of(["best"])
    assert set(METHODS) == set(get_args(MethodName)), "a suite may name every method"

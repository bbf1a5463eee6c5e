"""What is to be run: task files, folders of them, suite files, and random problems."""

from __future__ import annotations

import hashlib
import os
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator

from etot_cli.errors import EtotError, SpecError
from etot_cli.specs.base import Spec, Title
from etot_cli.specs.bounds import MAX_TRIALS
from etot_cli.specs.document import Node, read_document
from etot_cli.specs.inputs import file_digest, referenced_files
from etot_cli.specs.load import load_task
from etot_cli.specs.problems import validate
from etot_cli.specs.reading import printable
from etot_cli.specs.task import Task

SUFFIXES = (".yaml", ".yml")
MAX_TASKS = 1000
"""More is a slip of the keyboard."""
RANDOM = re.compile(r"random:([0-9]{1,4})")
"""So many random problems."""
MAX_SUITES = 8
"""Suites within suites."""
MethodName = Literal[
    "etot", "rekep", "rekep_cot", "reflect", "etot_without_priori", "etot_without_reflective",
    "etot_without_replan", "etot_kinematic",
]  # fmt: skip
Trials = Annotated[int, Field(ge=1, le=MAX_TRIALS)]
Seed = Annotated[int, Field(ge=0, le=2**32 - 1)]


class Suite(Spec):
    """A benchmark as a file: tasks, and how often and by whom each is tried.

    ``tasks``: task files, folders or further suites, relative to this file, and ``random:N``.
    ``seeds``: the seed of each trial, instead of ``trials`` and ``seed``.
    """

    name: Title | None = None
    description: Annotated[str, Field(max_length=2000)] = ""
    tasks: Annotated[
        tuple[Annotated[str, Field(min_length=1, max_length=400)], ...],
        Field(min_length=1, max_length=MAX_TASKS),
    ]
    trials: Trials | None = None
    methods: Annotated[tuple[MethodName, ...], Field(min_length=1, max_length=8)] | None = None
    seed: Seed | None = None
    seeds: Annotated[tuple[Seed, ...], Field(min_length=1, max_length=MAX_TRIALS)] | None = None

    @model_validator(mode="after")
    def _seeds_or_trials(self) -> Suite:
        if self.seeds is not None and (self.trials is not None or self.seed is not None):
            raise ValueError("give either 'seeds', one per trial, or 'trials' and 'seed'")
        twice = [seed for seed, count in Counter(self.seeds or ()).items() if count > 1]
        if twice:
            raise ValueError(f"'seeds' has {twice[0]} twice, which is one world counted as two")
        return self


@dataclass(frozen=True)
class Selection:
    """What was asked for. ``tasks`` have different names; None: a suite says nothing of it."""

    tasks: tuple[Task, ...]
    trials: int | None = None
    methods: tuple[str, ...] | None = None
    seed: int | None = None
    seeds: tuple[int, ...] | None = None


def select(inputs: Sequence[str], folder: Path) -> Selection:
    """Loads what the command line names.

    Args:
        inputs: task files, folders, suite files and ``random:N``.
        folder: where the task files of random problems are written.

    Raises:
        SpecError: a file is unusable; the message says where and what is expected.
        EtotError: there is nothing to run, or two suites disagree.
    """
    reader = _Reader(folder)
    for text in inputs:
        reader.take(text, Path(), 0)
    return reader.selection()


def digest(task: Task) -> str:
    """Tells tasks apart by what is in them and in their meshes, wherever the files lie."""
    plain = task.model_copy(
        update={"file": "", "scene": task.scene.model_copy(update={"directory": "."})}
    )
    found = hashlib.sha256(plain.model_dump_json().encode())
    for content in sorted(map(file_digest, referenced_files(task.scene, task.added_objects))):
        found.update(content.encode())
    return found.hexdigest()


def random_problems(count: int) -> list[tuple[str, int]]:
    """Families and seeds of the first ``count`` random problems: every family in turn.

    So a few of them are already of many kinds, and more of them only add to these.
    """
    from etot_cli.benchmark.problems import FAMILIES  # of use for random problems alone

    names = [*FAMILIES]
    return [(names[index % len(names)], index // len(names)) for index in range(count)]


class _Reader:
    """Collects tasks in the order in which they are named."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._tasks: dict[str, Task] = {}
        self._suites: list[tuple[str, Suite]] = []
        self._taken: set[str] = set()

    def take(self, text: str, beside: Path, depth: int, asked: Node | None = None) -> None:
        """One input; ``beside``: what it is relative to; ``asked``: where a suite names it.

        What has been taken is not read again, so that suites that name each other, or one folder
        in many ways, come to an end.
        """
        if not text:
            raise _error(asked, "found '', expected a file, a folder or random:N")
        path = beside / text
        name = text if text.startswith("random:") else os.path.realpath(path)
        if name in self._taken:
            return
        self._taken.add(name)
        if text.startswith("random:"):
            self._random(text, asked)
        elif os.path.isdir(path):  # noqa: PTH112 - Path.is_dir raises for a name that is too long
            files = sorted(item for item in path.iterdir() if item.suffix in SUFFIXES)
            if not files:
                raise _error(asked, f"no task files (*.yaml) in the folder {printable(path)}")
            for file in files:
                self.take(str(file), Path(), depth)
        elif asked is not None and not os.path.isfile(path):  # noqa: PTH113 - as above
            raise _error(asked, f"there is no file or folder {text!r} beside this file")
        else:
            self._file(path, depth)

    def _file(self, path: Path, depth: int) -> None:
        node = read_document(path)
        if not isinstance(node.value, dict) or "tasks" not in node.value:
            self._add(load_task(path))
            return
        if depth == MAX_SUITES:
            raise node.error(("tasks",), f"suites within suites deeper than {MAX_SUITES}")
        suite = validate(Suite, node)
        self._suites.append((printable(path), suite))
        for index, text in enumerate(suite.tasks):
            entry = node.value["tasks"].child(index)
            if Path(text).is_absolute() or "\\" in text:
                raise _error(entry, f"found {text!r}, expected a path relative to this file")
            self.take(text, path.parent, depth + 1, entry)

    def _random(self, text: str, asked: Node | None) -> None:
        match = RANDOM.fullmatch(text)
        count = int(match[1]) if match else 0
        if not 1 <= count <= MAX_TASKS:
            raise _error(asked, f"found {text!r}, expected random:N with N from 1 to {MAX_TASKS}")
        from etot_cli.benchmark.problems import problem

        self._folder.mkdir(parents=True, exist_ok=True)
        for family, seed in random_problems(count):
            self._add(load_task(problem(family, seed).write(self._folder)))

    def _add(self, task: Task) -> None:
        if not task.success:
            raise SpecError(
                "no 'success' conditions, by which trials are judged; add them", file=task.file
            )
        known = self._tasks.get(task.name)
        if known is not None and digest(known) != digest(task):
            raise SpecError(
                f"another task is called {task.name!r} too, in {known.file}; tables tell tasks "
                "apart by their names: give one of them another 'name'",
                file=task.file,
            )
        if len(self._tasks) == MAX_TASKS and known is None:
            raise EtotError(f"more than {MAX_TASKS} tasks; run them in parts")
        self._tasks.setdefault(task.name, task)

    def selection(self) -> Selection:
        """All that was taken."""
        if not self._tasks and self._suites:
            raise SpecError(
                "names suites alone that name each other; expected task files, folders or random:N",
                file=self._suites[0][0],
            )
        if not self._tasks:
            raise EtotError("nothing to run; name task files, folders, suite files or random:N")
        found: dict[str, tuple[str, object]] = {}
        for file, suite in self._suites:
            for key in ("trials", "methods", "seed", "seeds"):
                value = getattr(suite, key)
                if value is None:
                    continue
                first, known = found.setdefault(key, (file, value))
                if known != value:
                    raise SpecError(
                        f"its {key!r} are others than those of {first}; run the suites one by one",
                        file=file,
                    )
        chosen = {key: value for key, (_, value) in found.items()}
        return Selection(tasks=tuple(self._tasks.values()), **chosen)  # type: ignore[arg-type]


def _error(asked: Node | None, message: str) -> EtotError:
    return EtotError(message) if asked is None else asked.error((), message)


def seeds_of(trials: int, seed: int, given: Sequence[int] | None) -> list[tuple[int, int]]:
    """Seed and number that draw each trial's world, the same for all methods and tasks.

    As ``etot execute --seed SEED --trials N`` counts its trials; seeds that are given one by one
    draw a first trial each.
    """
    if given is not None:
        return [(one, 0) for one in given]
    return [(seed, number) for number in range(trials)]

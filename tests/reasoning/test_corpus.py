"""Many sentences about many scenes: read as they are meant, or refused by the word."""

from __future__ import annotations

import statistics
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
import yaml

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.wording import formal
from etot_cli.reasoning.language.instructions import goal_of
from tests.reasoning import corpus_scenes

CORPUS: dict[str, dict[str, dict[str, str]]] = yaml.safe_load(
    (Path(__file__).parent / "corpus.yaml").read_text(encoding="utf-8")
)
SCENES = {name: getattr(corpus_scenes, name)() for name in CORPUS}


def cases(kind: str) -> list[Any]:
    return [
        pytest.param(name, text, wanted, id=f"{name}-{text[:60]}")
        for name, found in CORPUS.items()
        for text, wanted in found.get(kind, {}).items()
    ]


@pytest.mark.parametrize(("name", "text", "wanted"), cases("read"))
def test_read(name: str, text: str, wanted: str) -> None:
    goal = goal_of(text, SCENES[name])
    assert " | ".join([formal(goal), *goal.notes]) == wanted


@pytest.mark.parametrize(("name", "text", "wanted"), cases("refused"))
def test_refused(name: str, text: str, wanted: str) -> None:
    with pytest.raises(InstructionError) as raised:
        goal_of(text, SCENES[name])
    first = str(raised.value).splitlines()[0]
    for part in wanted.split(" | "):
        assert part in first


def test_the_corpus_is_large_and_has_many_traps() -> None:
    assert len(CORPUS) >= 12
    assert len(cases("read")) + len(cases("refused")) >= 400
    assert len(cases("refused")) >= 150


def test_reading_takes_little_time() -> None:
    """The bounds are ten times what an idle machine takes, so that a busy one passes, too."""
    taken = []
    for name, found in CORPUS.items():
        for text in [*found.get("read", {}), *found.get("refused", {})][::4]:
            start = time.process_time()
            with suppress(InstructionError):
                goal_of(text, SCENES[name])
            taken.append(time.process_time() - start)
    assert statistics.median(taken) < 0.1
    assert max(taken) < 1.0

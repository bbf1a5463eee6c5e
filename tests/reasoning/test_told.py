"""What is told in many words is read as what it means, or refused: never as anything else."""

from __future__ import annotations

import random
from collections import Counter

import pytest

from tests.reasoning import corpus_scenes
from tests.reasoning.test_metamorphic_reading import meaning
from tests.reasoning.told import Teller, Told
from tests.reasoning.told_families import FAMILIES, Family, terse

SCENES = {
    name: getattr(corpus_scenes, name)()
    for name in (
        "breakfast", "mugs", "blocks", "cups_and_balls", "drawers_and_desk", "sorting", "office",
        "cupboard", "kitchen", "workshop", "stationery", "galley", "writing_desk", "laboratory",
        "scullery", "canteen", "nursery", "bench", "atelier", "study", "toys", "counter",
        "craft_table", "garage", "repair_shop", "larder",
    )
}  # fmt: skip
"""Those in which things' names, which the plain sentences use, mean nothing else."""
TOLD = 16
"""Instructions of a family in each of its tests."""
REFUSED = 0.15
"""Share of a family that may be refused: 0.01 to 0.08 of some thousands were, by family, and 0.12
of those without articles."""


def steps_of(goal: str) -> list[frozenset[tuple[str, str]]]:
    """The parts of a goal in formal terms, one for each thing that it is about."""
    parts = []
    for part in goal.split("; "):
        key, _, rest = part.partition(": ")
        what, _, where = rest.strip("[]").partition(", ")
        parts.append(frozenset((f"{key} {where}", thing) for thing in what.split(" and ")))
    return parts


def is_same(told: Told, read: str, plain: str) -> bool:
    """Whether two goals ask for the same, in the same order where that counts."""
    read_steps, plain_steps = steps_of(read), steps_of(plain)
    if told.ordered and len(read_steps) == len(plain_steps):
        return read_steps == plain_steps
    return frozenset().union(*read_steps) == frozenset().union(*plain_steps)


@pytest.mark.parametrize("articles", [True, False], ids=["articles", "terse"])
@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.__name__)
def test_what_is_told_is_read_as_it_is_meant(family: Family, articles: bool) -> None:
    draw = random.Random(f"{family.__name__}")
    found: Counter[str] = Counter()
    refused = []
    while sum(found.values()) < TOLD:
        name = draw.choice(sorted(SCENES))
        told = family(Teller(SCENES[name], draw))
        plain = told and meaning(told.plain, SCENES[name])
        if told is None or plain is None:
            continue  # nothing of the sort in this scene, or it makes no sense there
        text = told.text if articles else terse(told.text)
        read = meaning(text, SCENES[name])
        found["read" if read else "refused"] += 1
        refused += [] if read else [f"{name}: {text}"]
        assert read is None or is_same(told, read, plain), f"{name}: {text}\n{read}\n{plain}"
    assert found["refused"] <= REFUSED * TOLD, refused

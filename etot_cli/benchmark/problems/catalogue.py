"""All families of problems, and how many of each make up the measured set."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from random import Random
from typing import TypeVar

from etot_cli.benchmark.problems.cabinet_and_shelf import CABINET_AND_SHELF
from etot_cli.benchmark.problems.crowd import crowd
from etot_cli.benchmark.problems.desk import Desk, FullDeskError
from etot_cli.benchmark.problems.drawer import DRAWER, handles
from etot_cli.benchmark.problems.hidden import HIDDEN
from etot_cli.benchmark.problems.into import INTO
from etot_cli.benchmark.problems.lids import LIDS
from etot_cli.benchmark.problems.nesting import NESTING
from etot_cli.benchmark.problems.order import ORDER
from etot_cli.benchmark.problems.problem import Problem
from etot_cli.benchmark.problems.relocation import RELOCATION
from etot_cli.benchmark.problems.stack import STACK
from etot_cli.benchmark.problems.surfaces import SURFACES
from etot_cli.benchmark.problems.tall import TALL

Family = tuple[Callable[[Desk, int], Problem], ...]
"""What makes a family's problems, taken in turn."""
FAMILIES: dict[str, tuple[Family, int]] = {
    "into": (INTO, 12),
    "stack": (STACK, 10),
    "drawer": (DRAWER, 12),
    "handles": ((handles,), 8),
    "cabinet_and_shelf": (CABINET_AND_SHELF, 14),
    "order": (ORDER, 8),
    "crowd": ((crowd,), 10),
    "relocation": (RELOCATION, 12),
    "surfaces": (SURFACES, 10),
    "nesting": (NESTING, 8),
    "lids": (LIDS, 4),
    "tall": (TALL, 8),
    "hidden": (HIDDEN, 4),
}
"""Families, and how many seeds of each are measured."""
DRAWS = 40
"""Sizes are drawn anew this often when the desk has no room for them."""
Made = TypeVar("Made", bound=Problem)


def problem(family: str, seed: int) -> Problem:
    """The problem of a family and seed; the same every time.

    Raises:
        KeyError: there is no such family.
        FullDeskError: the desk was too full in every draw.
    """
    return drawn(family, seed, FAMILIES[family][0])


def drawn(family: str, seed: int, variants: Sequence[Callable[[Desk, int], Made]]) -> Made:
    """The problem that one of the variants makes, taken in turn, of the first desk with room.

    Raises:
        FullDeskError: the desk was too full in every draw.
    """
    make = variants[seed % len(variants)]
    for draw in range(DRAWS):
        try:
            return make(Desk(Random(f"{family}:{seed}:{draw}")), seed)
        except FullDeskError:
            continue
    raise FullDeskError(f"{family}:{seed} finds no room on the desk in {DRAWS} draws")

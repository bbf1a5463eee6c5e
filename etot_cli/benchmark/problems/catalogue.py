"""All families of problems, and how many of each make up the measured set."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from etot_cli.benchmark.problems.cabinet_and_shelf import cabinet_and_shelf_family
from etot_cli.benchmark.problems.crowd import crowd_family
from etot_cli.benchmark.problems.desk import Desk, FullDeskError
from etot_cli.benchmark.problems.drawer import drawer_family, handles_family
from etot_cli.benchmark.problems.hidden import hidden_family
from etot_cli.benchmark.problems.infeasible import infeasible_family
from etot_cli.benchmark.problems.into import into_family
from etot_cli.benchmark.problems.lids import lids_family
from etot_cli.benchmark.problems.nesting import nesting_family
from etot_cli.benchmark.problems.order import order_family
from etot_cli.benchmark.problems.problem import Problem
from etot_cli.benchmark.problems.relocation import relocation_family
from etot_cli.benchmark.problems.stack import stack_family
from etot_cli.benchmark.problems.surfaces import surfaces_family
from etot_cli.benchmark.problems.tall import tall_family

Family = Callable[[Desk, int], Problem]
FAMILIES: dict[str, tuple[Family, int]] = {
    "into": (into_family, 12),
    "stack": (stack_family, 10),
    "drawer": (drawer_family, 12),
    "handles": (handles_family, 8),
    "cabinet_and_shelf": (cabinet_and_shelf_family, 14),
    "order": (order_family, 8),
    "crowd": (crowd_family, 10),
    "relocation": (relocation_family, 12),
    "surfaces": (surfaces_family, 10),
    "nesting": (nesting_family, 8),
    "lids": (lids_family, 4),
    "tall": (tall_family, 8),
    "hidden": (hidden_family, 4),
}
"""Families of solvable problems, and how many seeds of each are measured."""
INFEASIBLE: dict[str, tuple[Family, int]] = {"infeasible": (infeasible_family, 40)}
"""Families without a plan."""
DRAWS = 40
"""Sizes are drawn anew this often when the desk has no room for them."""


def problem(family: str, seed: int) -> Problem:
    """The problem of a family and seed; the same every time.

    Raises:
        KeyError: there is no such family.
        FullDeskError: the desk was too full in every draw.
    """
    make, _ = (FAMILIES | INFEASIBLE)[family]
    for draw in range(DRAWS):
        try:
            return make(Desk(Random(f"{family}:{seed}:{draw}")), seed)
        except FullDeskError:
            continue
    raise FullDeskError(f"{family}:{seed} finds no room on the desk in {DRAWS} draws")


def problems(*, solvable: bool = True) -> list[Problem]:
    """The measured set."""
    families = FAMILIES if solvable else INFEASIBLE
    return [problem(name, seed) for name, (_, count) in families.items() for seed in range(count)]

"""Which shapes are tried, simple ones first."""

from __future__ import annotations

from etot_cli.reconstruction.shapes.ball import Ball
from etot_cli.reconstruction.shapes.base import Family
from etot_cli.reconstruction.shapes.block import Block
from etot_cli.reconstruction.shapes.furniture import ClosedCase, OpenCabinet, OpenUnit
from etot_cli.reconstruction.shapes.rod import Capsule, Pen
from etot_cli.reconstruction.shapes.upright import ConicalCup, Cup, Cylinder

Tiers = list[list[Family]]
DRAWERS = (2, 1, 3)
"""Numbers of drawers of a unit that are told apart; each more makes shapes to compare. Where the
front is turned away nothing tells, and it is the first, as for a unit that is closed."""
RODS = ("pen", "capsule")
"""Kinds whose names people use for each other: a stick may be pointed or not."""


def tiers(hint: str | None = None) -> Tiers:
    """Families by tier; a later tier is for what the earlier ones do not explain.

    Args:
        hint: a kind that is known: only families of that kind are tried then (furniture may be
            closed, which is a plain block as far as shape goes, and rods may be pointed or blunt).
    """
    simple: list[Family] = [Ball(), Block(), Cylinder(), Cup(), Capsule(), Pen()]
    units: list[Family] = [OpenUnit(count, moving) for count in DRAWERS for moving in range(count)]
    doors: list[Family] = [OpenCabinet("left"), OpenCabinet("right")]
    if hint is None:
        return [simple, [ConicalCup()], [*units, *doors]]
    if hint == "drawer_unit":
        return [[ClosedCase()], units]
    if hint == "cabinet":
        return [[ClosedCase()], doors]
    if hint in ("cup", "bowl"):
        return [[Cup()], [ConicalCup()]]
    if hint in RODS:
        return [[family for family in simple if family.kind in RODS]]
    chosen = [family for family in simple if family.kind == hint]
    return [chosen] if chosen else tiers()

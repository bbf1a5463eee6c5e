"""The order in which placements can be carried out: goals are sets, and the world is not.

What stands on something comes after its support has its own place, what closes a vessel comes
after its contents, and what goes into a vessel after another one that is to leave it, whatever the
order given. Where nothing of that decides, the order given stays.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import NamedTuple

from etot_cli.reasoning.builtin.goal import Relation
from etot_cli.world.spatial import Nearby, Whereabouts
from etot_cli.world.state import owner_of


class Placement(NamedTuple):
    """An object and where it is to be; ``where`` says at which part of the surface."""

    name: str
    relation: Relation
    target: str
    where: tuple[Whereabouts, ...] = ()


def supports_first(
    placements: Sequence[Placement], nested: Collection[tuple[str, str | None]] = ()
) -> list[int]:
    """The places of the placements in an order in which they can be carried out.

    A vessel's own placement is not brought before its contents, as a filled cup can be carried,
    unless it is to be stood up.

    Args:
        placements: each object's final place, in the order given.
        nested: vessels, each with what it is in before anything is done.

    Returns:
        Indices into ``placements``. Placements that wait for each other keep the order given.
    """
    waiting = list(range(len(placements)))
    order: list[int] = []
    while waiting:
        free = (
            index
            for index in waiting
            if not any(
                _comes_before(placements[other], placements[index], nested)
                for other in waiting
                if other != index
            )
        )
        chosen = next(free, waiting[0])
        waiting.remove(chosen)
        order.append(chosen)
    return order


def _comes_before(
    first: Placement, second: Placement, nested: Collection[tuple[str, str | None]]
) -> bool:
    """Whether ``second`` cannot be done, or would be undone, unless ``first`` is done."""
    if second.relation is not Relation.ON:
        # What lies takes nothing in.
        is_raised = any(item.relation is Nearby.UPRIGHT for item in first.where)
        # What falls into a vessel that stands where it should be leaves with that.
        leaves = first.target != second.target and (first.name, second.target) in nested
        return leaves or (is_raised and first.name == owner_of(second.target))
    supports = {
        owner_of(second.target),
        *(mark for item in second.where for mark in item.landmarks),
    }
    is_content = first.relation is Relation.INSIDE and first.target == second.target
    return first.name in supports or is_content

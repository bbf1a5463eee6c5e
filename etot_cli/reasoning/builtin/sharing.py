"""Several things in or on one place: what comes first leaves room for the rest, and what is there
already and takes the floor away goes out.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from etot_cli.reasoning.builtin.keepouts import room_for
from etot_cli.reasoning.builtin.relations import (
    bearers,
    contents,
    enclosing,
    radius,
)
from etot_cli.reasoning.builtin.relocation import Correction, relocated
from etot_cli.reasoning.builtin.revision import brought_before, placed_by, reachable_throughout
from etot_cli.reasoning.protocol import FailedStep
from etot_cli.skills.action import Action
from etot_cli.world.state import DESK, PartInfo, owner_of


def side_by_side(failed: FailedStep, index: int, name: str, other: str) -> Iterator[Correction]:
    """The branch with an object beside one that it puts into or onto the same before: the larger
    one has the first choice, the other leaves room where it is now, or they come the other way
    round.

    Args:
        failed: the failed step.
        index: place of the object's PICK UP or PUT in the branch.
        name: the object.
        other: what takes its place.
    """
    actions, scene = failed.branch.actions, failed.record.before
    before = placed_by(actions, other, index)
    if before is None:
        return
    put = actions[before + 1]
    larger = radius(scene.infos[name]) > radius(scene.infos[other])
    # What comes to a place leaves room there for another of its own size.
    swapped = brought_before(actions, index, before) if put.target != DESK else None
    if swapped is not None and larger:
        ordered = reachable_throughout(swapped, failed.start)
        yield Correction(ordered, f"{name}, which is larger, comes before {other}")
    if not (put.keepout or _point_of(put)):
        # Once: further spots made no difference in 26 problems with just enough room, and where
        # there is too little for all there is no end of them.
        room = room_for(scene, other, name, _point_of(actions[failed.index]))
        kept = replace(put, keepout=(room,))
        changed = (*actions[: before + 1], kept, *actions[before + 2 :])
        yield Correction(changed, f"{other} leaves room for {name} in {put.target}")
    if swapped is not None and not larger:
        ordered = reachable_throughout(swapped, failed.start)
        yield Correction(ordered, f"{name} comes before {other}")


def come_since(failed: FailedStep) -> list[tuple[str, int]]:
    """What the branch has put beside the object that it picks up into the same container, the first
    one first, each with the place of its PICK UP: it takes room from the hand, or has pushed the
    object to a wall, though only that wall is named. What is named is left out.
    """
    actions, scene = failed.branch.actions, failed.record.before
    cause = failed.verdict.cause or failed.record.cause
    target = actions[failed.index].target
    around = enclosing(scene, target)
    beside = contents(scene, around[0]) if around else ()
    placed = ((name, placed_by(actions, name, failed.index)) for name in beside)
    since = [
        (name, index)
        for name, index in placed
        if index is not None and name != target and (cause is None or name not in cause.objects)
    ]
    return sorted(since, key=lambda item: item[1])


def _point_of(put: Action) -> tuple[float, float] | None:
    """The very point at which something is to be put down, if one was named."""
    return next((item.point for item in put.where if not item.denied and item.point), None)


def lowered(failed: FailedStep, placed: int, name: str, part: PartInfo) -> Iterator[Correction]:
    """The branch without what an object that it puts into a part comes to stand on in there, or
    leans on, which nothing tells apart from what lies beside it.

    Args:
        failed: the failed step, in which the object blocks the part.
        placed: place of the object's PICK UP in the branch.
        name: the object.
        part: the part.
    """
    actions, scene = failed.branch.actions, failed.record.before
    wanted = owner_of(actions[placed + 1].target)
    there = [other for other in contents(scene, part.address) if other != name]
    bearing = bearers(scene, name) - {wanted}
    for under in sorted(bearing.intersection(there)) or there:
        if placed_by(actions, under, placed) is None:
            yield from relocated(failed, under, None, placed)
        else:
            yield from side_by_side(failed, placed, name, under)

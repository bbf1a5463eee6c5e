"""Orders along a line that lead back to where they begin, which no arrangement has."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

from etot_cli.world.spatial import Nearby, Whereabouts

_LINES = {
    Nearby.LEFT: (Nearby.LEFT, False),
    Nearby.RIGHT: (Nearby.LEFT, True),
    Nearby.FRONT: (Nearby.FRONT, False),
    Nearby.BEHIND: (Nearby.FRONT, True),
}
"""The relation by which an order is told, and whether the two change places in it."""


def circle(wanted: Iterable[tuple[str, Whereabouts]]) -> str:
    """A circle among things that are to stand to one side of each other, in words; mostly none.

    What is to the left of something is further left by its centre, so that it is also further left
    than all that is to the right of that. The same goes for before and behind.

    Args:
        wanted: objects, each with where it is to be.
    """
    after: dict[Nearby, dict[str, list[str]]] = {Nearby.LEFT: {}, Nearby.FRONT: {}}
    for name, where in wanted:
        if where.relation not in _LINES or where.denied:
            continue
        line, turned = _LINES[where.relation]
        first, second = (where.landmarks[0], name) if turned else (name, where.landmarks[0])
        after[line].setdefault(first, []).append(second)
    for line, following in after.items():
        for name in following:
            way = _way_back(name, following)
            if way:
                pairs = pairwise(way)
                return ", ".join(f"{one} {line.value} {other}" for one, other in pairs)
    return ""


def _way_back(start: str, following: dict[str, list[str]]) -> tuple[str, ...]:
    """The shortest way along an order from a thing to itself; empty where there is none."""
    ways: list[tuple[str, ...]] = [(start,)]
    seen: set[str] = set()
    for way in ways:
        for name in following.get(way[-1], ()):
            if name == start:
                return (*way, name)
            if name not in seen:
                seen.add(name)
                ways.append((*way, name))
    return ()

"""Ways to carry out an action, dealt out to lanes.

The candidates of an action (grasps, spots, contacts) are dealt out before any is worked out, so
that lanes in different processes do not prepare the same ones. Lanes know nothing of each other:
what a lane finds depends on its number alone, wherever it runs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

from etot_cli.skills.outcome import Evidence, SkillOutcome
from etot_cli.skills.pilot import Attempt

Item = TypeVar("Item")

LANES = 2
"""Ways of an action that are tried side by side, in parallel worlds where there are workers."""


@dataclass(frozen=True)
class NoWay:
    """A lane found no way. ``explain`` puts the evidence of all lanes in words; it is picklable."""

    evidence: Evidence
    explain: Callable[[Evidence], SkillOutcome]


Ways = Callable[[int], Iterator[Attempt | NoWay]]
"""The ways of one lane, best first, prepared one at a time as they are asked for.

A :class:`NoWay` is the only item where there is none; no item at all means that another lane has
the only ones. The world must stand as it did at the start whenever the next item is asked for.
"""


def lane_of(index: int) -> int:
    """The lane that a candidate belongs to: dealt forth and back, so that no lane always comes
    second, nor gets all candidates of one kind where kinds alternate.
    """
    place = index % (2 * LANES)
    return min(place, 2 * LANES - 1 - place)


def dealt(items: Iterable[Item], lane: int) -> Iterator[Item]:
    """The items that belong to a lane, in order."""
    return (item for index, item in enumerate(items) if lane_of(index) == lane)


def no_way(found: Sequence[NoWay]) -> SkillOutcome:
    """The reason why none of the lanes has a way."""
    evidence = sum((item.evidence for item in found), Evidence())
    return found[0].explain(evidence)

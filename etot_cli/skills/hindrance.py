"""Who is in the way: what a candidate comes too close to, and what would have to be away.

A candidate is looked at over its whole way even where other objects are in it. What it would
have met is then known at once, and so is what would do without: no search has to be repeated.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable

from etot_cli.world.model import World
from etot_cli.world.state import owner_of


class Passage:
    """What a single candidate comes too close to on its way.

    Args:
        known: names of all objects.
        own: objects that cannot be thought away, such as the one that is to be moved.
    """

    def __init__(self, known: Collection[str], own: Iterable[str] = ()) -> None:
        self._removable = frozenset(known) - frozenset(own)
        self.others: frozenset[str] = frozenset()

    def admits(self, addresses: Iterable[str]) -> bool:
        """Notes what one configuration comes too close to.

        Returns:
            False where the candidate is impossible whatever else is taken away: the robot itself,
            the desk, or what is to be moved is in the way.
        """
        names = {owner_of(address) for address in addresses}
        self.others |= names & self._removable
        return names <= self._removable

    def copy(self) -> Passage:
        """Another passage that begins with what this one has met."""
        other = Passage(self._removable)
        other.others = self.others
        return other

    @property
    def free(self) -> bool:
        """Nothing was met."""
        return not self.others


class Hindrances:
    """The sets of objects without which single candidates would have worked."""

    def __init__(self, world: World) -> None:
        self._movable = {name for name, entry in world.entries.items() if entry.info.movable}
        self._sets: Counter[frozenset[str]] = Counter()

    def note(self, others: frozenset[str]) -> None:
        """A candidate that works as soon as ``others`` are away."""
        self._sets[others] += 1

    def blamed(self) -> tuple[str, ...]:
        """Objects whose absence makes a candidate work, the most effective first.

        Where single ones suffice these are all that do; else the fewest that have to go together.
        Movable ones come before what is fastened.
        """
        if not self._sets:
            return ()

        def cost(others: frozenset[str]) -> tuple[int, int]:
            return len(others - self._movable), len(others)

        least = min(cost(others) for others in self._sets)
        best = [others for others in self._sets if cost(others) == least]
        gain = Counter[str]()
        for others, count in self._sets.items():
            for name in others:
                gain[name] += count
        if sum(least) > 1 and least[1] > 1:
            best = [min(best, key=lambda others: (-self._sets[others], sorted(others)))]
        names = {name for others in best for name in others}
        return tuple(sorted(names, key=lambda name: (name not in self._movable, -gain[name], name)))

"""How things that go somewhere together stand there beside each other, told behind that."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

from etot_cli.reasoning.builtin.goal import Put, Referent, Relation, Step, Thing


def beside_each_other(said: Sequence[Step], referents: list[Referent]) -> list[Step]:
    """Steps, where "both bottles on the shelf, the green one to the right of the red one" puts each
    of them there once, and what the other stands beside before it; ``referents`` get what is left.
    """
    steps = list(said)

    def certain(indices: Iterable[int]) -> set[Thing]:
        """What is meant for sure; nothing where any of it is open."""
        ways = [referents[index].options for index in indices]
        return set() if any(len(way) > 1 for way in ways) else {t for (o,) in ways for t in o}

    for at, (both, one) in enumerate(pairwise(said)):
        if not (isinstance(both, Put) and isinstance(one, Put)) or both.run != one.run:
            continue
        if len(both.places) > 1 or len(one.places) > 1 or both.removal or one.removal:
            continue
        (place,), (side,) = both.places, one.places
        named = place.where is not None and place.relation is Relation.ON and not place.beside
        all_of_them, own = certain(both.what), certain(one.what)
        marks = certain(index for near in side.beside for index in near.landmarks)
        if not named or side.where is not None or not (marks and own):
            continue
        if not (own < all_of_them and marks <= all_of_them - own):
            continue
        left: list[int] = []
        for index in both.what:
            (things,) = referents[index].options
            kept = tuple(thing for thing in things if thing not in own)
            if kept and kept != things:
                referents.append(Referent((kept,), referents[index].text))
                index = len(referents) - 1
            left += [index] if kept else []
        steps[at] = replace(both, what=tuple(left))
        steps[at + 1] = replace(one, places=(replace(place, beside=side.beside),))
    return steps

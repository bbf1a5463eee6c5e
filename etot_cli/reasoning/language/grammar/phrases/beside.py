"""Rules for being beside things, or at a part of a surface, and for several things side by side."""

from __future__ import annotations

from operator import add
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    either,
    one_of,
    optional,
    phrase,
    separated,
    sequence,
    some,
    spanned,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import COMMA, EXACTLY, LIST, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.descriptions import BETWEEN
from etot_cli.reasoning.language.grammar.syntax.phrases import Beside, NounPhrase
from etot_cli.reasoning.language.words import places, predicates
from etot_cli.world.spatial import Nearby

EACH_OTHER = NounPhrase(pronoun="each other", text="each other")
"""What each of several things is to be beside."""
_CLOSE_BY = f"{places.NEARBY[Nearby.NEXT_TO]}, {places.NEARBY[Nearby.NEAR]}"
ABREAST = valued(
    either(
        "side by side, close[r] together, as close together",
        sequence(_CLOSE_BY, "each other, one another"),
    ),
    lambda _: (Beside(Nearby.NEXT_TO, (EACH_OTHER,)),),
)
_NO_MORE = Parser(
    lambda given, at: [(at, NOTHING)] if given.ahead[at] in ("", COMMA, "and") else []
)
_WHICH_ON_SIDE = sequence(
    noun_phrase,
    optional(f"being, standing, {predicates.BE}"),
    one_of(
        {
            Nearby.LEFT: "[(on|to|at) the] left [side|hand side]",
            Nearby.RIGHT: "[(on|to|at) the] right [side|hand side]",
            Nearby.FRONT: "in front, at the front",
            Nearby.BEHIND: "behind, at the back, in [the] back",
        }
    ),
    _NO_MORE,
    build=lambda np, side: Beside(side, (EACH_OTHER, np)),
)
ABREAST_SO = sequence(
    COMMA,
    optional("[and] with, and"),
    separated(_WHICH_ON_SIDE, LIST, most=1),
)
"""Behind "side by side": which of them is on which side of the others."""


def _region(regions: tuple[Nearby, ...], phrases: Any) -> tuple[Beside, ...]:
    return tuple(Beside(relation, () if phrases is None else (phrases,)) for relation in regions)


def _beside(relation: Nearby, *nps: NounPhrase) -> tuple[Beside, ...]:
    return (Beside(relation, nps),)


_NEARBY = one_of({**places.NEARBY, Nearby.NEAR: places.GOES_NEAR, Nearby.AWAY: places.GOES_AWAY})
_REGION = one_of(places.REGIONS)
_ITS_SIDE = one_of(places.ITS_SIDE)
_SIDE_OF_IT = one_of(
    {Nearby.LEFT: "left [hand] side, left", Nearby.RIGHT: "right [hand] side, right"}
)
_REGION_OF_IT = one_of(places.REGION_OF_IT)
BESIDE = spanned(
    either(
        sequence(
            EXACTLY,
            _NEARBY,
            noun_phrase,
            optional("than (it is|they are) [now], than (now|before), as possible"),
            build=_beside,
        ),
        sequence(places.ACROSS, noun_phrase, build=lambda np: _beside(Nearby.NEAR, np)),
        sequence(
            _ITS_SIDE,
            build=lambda relation: _beside(relation, NounPhrase(pronoun="it", text="its side")),
        ),
        sequence(
            "on, to, at, onto",
            noun_phrase,
            "'s",
            _SIDE_OF_IT,
            build=lambda np, relation: _beside(relation, np),
        ),
        sequence(
            "in, on, to, at, onto, near, by",
            noun_phrase,
            "'s",
            _REGION_OF_IT,
            build=lambda np, regions: _region(regions, np),
        ),
        ABREAST,
        sequence(ABREAST, ABREAST_SO, build=add),
        valued(BETWEEN, lambda pair: (Beside(Nearby.BETWEEN, pair),)),
        sequence(
            EXACTLY,
            _REGION,
            optional(sequence("of, belonging to", noun_phrase), None),
            build=_region,
        ),
    ),
    lambda text, found: tuple(replace(item, text=text) for item in found),
)
PART_OF_IT = sequence(
    optional("the"),
    spanned(_REGION_OF_IT, lambda text, near: tuple(Beside(region, text=text) for region in near)),
)
"""Behind a surface, where on that ("on the table, left side")."""
_SIDES_OF_IT = {Nearby.AT_LEFT: Nearby.LEFT, Nearby.AT_RIGHT: Nearby.RIGHT}
_OF_THE_DESK = frozenset({"far", "half", "part", "end", "edge", "border"})
"""With such words a side is that of the desk, whatever is said before."""


def _besides(first: tuple[Beside, ...], more: Any) -> tuple[Beside, ...]:
    """All that is said of where; "next to the cup, on the right" is on the cup's right."""
    found = list(first)
    for behind_comma, also in more:
        (near, *others), (item, *further) = found, also
        of_it = behind_comma and not (others or further)
        found += (side_of(near, item) if of_it else item, *further)
    return tuple(found)


def side_of(near: Beside, item: Beside) -> Beside:
    """A bare side behind "next to the cup" as a side of the cup."""
    side = _SIDES_OF_IT.get(item.relation)
    bare = not (item.phrases or _OF_THE_DESK & {*item.text.split()})
    known = near.relation in (Nearby.NEXT_TO, Nearby.NEAR) and near.phrases[1:] == ()
    if side is None or not (bare and known) or EACH_OTHER in near.phrases:
        return item
    return replace(item, relation=side, phrases=near.phrases)


BESIDES = sequence(
    BESIDE,
    some(
        either(
            sequence(COMMA, BESIDE, build=lambda also: (True, also)),
            sequence("and, but", BESIDE, build=lambda also: (False, also)),
        ),
        most=3,
    ),
    build=_besides,
)
BESIDE_IT = sequence(
    EXACTLY,
    one_of(places.NEARBY),
    phrase("it, them"),
    build=lambda near, said: _beside(near, NounPhrase(pronoun=said, text=said)),
)

"""Rules for stacking things, told by their ends, layer by layer or as a whole."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    separated,
    sequence,
    some,
    valued,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COLON,
    COMMA,
    LIST,
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.phrases.turns import TURN
from etot_cli.reasoning.language.grammar.requests.nesting import NESTED
from etot_cli.reasoning.language.grammar.requests.piles import (
    ON_EACH_OTHER,
    ONE_OF_TWO,
    PAIR_BY_PAIR,
    PILED,
)
from etot_cli.reasoning.language.grammar.requests.tower_bases import (
    A_TOWER,
    FIRST_TO_LAST,
    LAYERED,
    ON_A_BASE,
    ONE_ON_THE_OTHER,
    PLACED_LAYERS,
    SO,
)
from etot_cli.reasoning.language.grammar.requests.tower_ends import END, ENDS, NOT, STAYS
from etot_cli.reasoning.language.grammar.syntax.clauses import TowerClause
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, NounPhrase, Things
from etot_cli.reasoning.language.words import manner, places, predicates, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import (
    NUMBERS,
    is_descriptive,
    singular,
)

_UPWARDS = ("bottom", "middle", "top")


def _tower(
    things: Things, upward: bool | None, ends: Any, base: tuple[Destination, ...] = ()
) -> TowerClause | None:
    named = {end: np for np, end in ends or ()}
    if len(named) < len(ends or ()):
        return None
    still = named.pop(STAYS, None)
    denied = [(end.removeprefix(NOT), named.pop(end)) for end in [*named] if NOT in end]
    if any(end == "middle" for end, _ in denied):
        return None
    if still and (base or "bottom" in named):
        return None
    if still:
        named["bottom"] = still
    stays, not_at = still is not None, tuple(denied)
    return TowerClause(things, upward, base=base, stays=stays, not_at=not_at, **named)


_BETWEEN_SIZES = "medium"
"""No noun beside "large" and "small", though some label may have to have it."""


def _with_nouns(nps: tuple[NounPhrase, ...]) -> tuple[NounPhrase, ...]:
    """With the noun that the first of them has for those that are a colour or the like alone."""
    bare = [all(is_descriptive(word) or word == _BETWEEN_SIZES for word in np.words) for np in nps]
    nouns = [np.head for np, out in zip(nps, bare, strict=True) if np.words and not out]
    named = dict.fromkeys(noun for noun in nouns if noun != "one")
    if len(named) == 1:  # "the blue block on the big red one"
        nps = tuple(np.called(*named) if np.is_elliptic else np for np in nps)
    return tuple(
        replace(np, words=(*np.words, nouns[0])) if out and np.words and nouns else np
        for np, out in zip(nps, bare, strict=True)
    )


def _announced(
    tower: tuple[int, tuple[str, ...]], nps: tuple[NounPhrase, ...]
) -> tuple[NounPhrase, ...] | None:
    """The layers of a tower, by the noun that it was announced with; as many as were."""
    count, words = tower
    if count not in (0, len(nps)):
        return None
    nouns = [singular(word) for word in words[-1:]]
    return tuple(np.called(*nouns) if nouns and np.is_elliptic else np for np in nps)


def _of_its_ends(tower: Any, base: Any, ends: Any) -> TowerClause | None:
    """A tower of what is named at its ends and in the middle."""
    named = _announced(tower, tuple(np for np, _ in ends))
    if named is None or len(ends) < 2 or len(dict.fromkeys(end for _, end in ends)) < len(ends):
        return None
    nps = _with_nouns(named)
    full = [(np, end) for np, (_, end) in zip(nps, ends, strict=True)]
    if all(end in _UPWARDS for _, end in full):
        layers = sorted(full, key=lambda layer: _UPWARDS.index(layer[1]))
        return TowerClause(Things(tuple(np for np, _ in layers)), upward=True, base=base)
    return _tower(Things(nps), None, full, base)


def _rising(lowest: Any, more: Any) -> tuple[NounPhrase, ...] | None:
    """What is named one after the other from an end on, from the bottom up ("red at the bottom,
    then blue, then green").
    """
    begun = lowest[1]
    if ({"all", "both", *NUMBERS} - {"one"}) & {*lowest[0].determiner.split()}:
        return None  # "all blocks, smallest on top"
    *inner, (then, _, last) = [(then, np, end) for then, (np, end) in more]
    end = "bottom" if begun == "top" else "top"
    if begun == "top":
        told = all(then and side in ("", "middle") for then, _, side in inner)
    else:
        between = ("", "upon", "middle") if begun else ("upon",)
        told = all((then or side == "upon") and side in between for then, _, side in inner)
    upon = last == "upon" and begun != "top"
    whole = told and begun in ("", "top", "bottom")
    nps = (lowest[0], *(np for _, (np, _) in more))
    if not whole or not (last == end or upon or (begun and then and not last)):
        return None
    return nps[::-1] if begun == "top" else nps


def _one_by_one(turn: Any) -> tuple[NounPhrase, ...] | None:
    """All of a tower in the order in which it is built."""
    order, said = turn
    return said if order == "all" else None


def _as_named(things: Things, base: Any) -> TowerClause | None:
    """A tower of what is named in the order in which it is built."""
    several = len(things.phrases) > 1 and not things.either
    return TowerClause(things, upward=True, base=base) if several else None


def _of_these(things: Things, base: Any, nps: tuple[NounPhrase, ...]) -> TowerClause | None:
    """A tower of those of several things that are named in their order."""
    (np, *more) = things.phrases
    plural = singular(np.head) != np.head
    if more or not plural or np.modifiers:
        return None
    named = tuple(
        replace(told, words=(*told.words, singular(np.head)))
        if all(map(is_descriptive, told.words))
        else told
        for told in nps
    )
    return TowerClause(Things(named), upward=True, base=base, whole=things)


_UPWARD = sequence(
    OPTIONAL_COMMA, either(phrase(manner.BOTTOM_UP, True), phrase(manner.TOP_DOWN, False))
)
_LAYER = sequence(
    noun_phrase,
    optional(predicates.BE),
    optional(either(END, phrase(manner.UPON_THAT, "upon")), ""),
    build=lambda np, end: (np, end),
)
_MORE_LAYERS = some(
    sequence(
        either(
            sequence(OPTIONAL_COMMA, phrase(f"{small_words.THEN_JOINTS}, followed by")),
            sequence(LIST, build=lambda: ""),
        ),
        _LAYER,
        build=lambda then, layer: (then, layer),
    ),
    least=1,
    most=5,
)
_IN_A_ROW = separated(noun_phrase, LIST, most=6)
_ORDER = sequence(OPTIONAL_COMMA, manner.IN_THE_ORDER, OPTIONAL_COMMA)
_IN_ORDER = either(
    sequence(_ORDER, _IN_A_ROW, _UPWARD, build=lambda nps, up: nps if up else nps[::-1]),
    sequence(
        either(
            sequence(_ORDER, _UPWARD, COMMA),
            sequence(_UPWARD, _ORDER),
            sequence(_UPWARD, either(COLON, COMMA)),
        ),
        _IN_A_ROW,
        build=lambda up, nps: nps if up else nps[::-1],
    ),
    sequence(_ORDER, either(_IN_A_ROW, FIRST_TO_LAST)),
)
"""All of a tower from the bottom up; it is stacked in the order that is said."""
_LAYERS = valued(
    either(
        sequence(_LAYER, _MORE_LAYERS, build=_rising),
        ONE_ON_THE_OTHER,
        FIRST_TO_LAST,
        sequence(_IN_A_ROW, _UPWARD, build=lambda nps, up: nps if up else nps[::-1]),
        _IN_ORDER,
    ),
    _with_nouns,
)
"""All of a tower from the bottom up."""


def _begun_or_ended(turn: Any) -> tuple[tuple[NounPhrase, str], ...] | None:
    """What comes first is at the bottom of a tower, what comes last on top."""
    order, said = turn
    end = {"first": "bottom", "last": "top"}.get(order)
    named = len(said) == 1 and (said[0].determiner or all(map(is_descriptive, said[0].words)))
    return ((said[0], end),) if end and named else None


_TOWER_ENDS = optional(
    either(
        sequence(OPTIONAL_COMMA, TURN, build=_begun_or_ended),
        sequence(either(SO, sequence(OPTIONAL_COMMA, "but")), ENDS),
        # In "a tower with the blue block at the bottom" "the blue" is no thing of its own.
        sequence(ENDS, build=lambda ends: ends if ends[0][0].determiner else None),
        sequence(OPTIONAL_COMMA, manner.WIDEST_BELOW, build=lambda: ()),
    ),
    None,
)


_TOWER = either(
    sequence(
        # "Stack the red block on the green one on the blue one"
        verbs.STACK,
        noun_phrase,
        some(sequence(places.ONTO, noun_phrase), least=2, most=5),
        build=lambda top, below: TowerClause(Things((top, *below)), upward=False),
    ),
    sequence(
        either(
            sequence(verbs.STACK, THINGS, optional(f"{manner.UPON_EACH_OTHER}, up")),
            sequence(verbs.PUT, THINGS, manner.UPON_EACH_OTHER),
            sequence(verbs.TURN_INTO, THINGS, f"(in|into) {verbs.A_TOWER}"),
            sequence(
                predicates.WANT, THINGS, "(stacked|piled) [up]", optional(manner.UPON_EACH_OTHER)
            ),
        ),
        optional(_UPWARD, None),
        optional(DESTINATIONS, ()),
        _TOWER_ENDS,
        build=lambda things, upward, base, ends: _tower(things, upward, ends, base),
    ),
    PILED,
    ONE_OF_TWO,
    NESTED,
    sequence(
        # "Put the blocks on the tray, stacked", "the blocks go on the tray in a stack"
        either(sequence(verbs.PUT, THINGS), sequence(THINGS, predicates.MODAL)),
        DESTINATIONS,
        OPTIONAL_COMMA,
        either(f"(stacked|piled) [up] [{manner.UPON_EACH_OTHER}]", manner.UPON_EACH_OTHER),
        _TOWER_ENDS,
        build=lambda things, base, ends: _tower(things, None, ends, base),
    ),
    sequence(
        # "The blocks should be stacked on the tray"
        THINGS,
        predicates.MODAL,
        "(stacked|piled) [up]",
        optional(manner.UPON_EACH_OTHER),
        optional(DESTINATIONS, ()),
        _TOWER_ENDS,
        build=lambda things, base, ends: _tower(things, None, ends, base),
    ),
    sequence(
        f"{verbs.BUILD}, {predicates.WANT}",
        optional(_UPWARD, None),
        verbs.OUT_OF,
        THINGS,
        optional(_UPWARD, None),
        optional(DESTINATIONS, ()),
        _TOWER_ENDS,
        build=lambda before, things, after, base, ends: (
            None
            if before is not None and after is not None
            else _tower(things, before if after is None else after, ends, base)
        ),
    ),
    sequence(
        THINGS,
        predicates.FORM_A_TOWER,
        optional(_UPWARD, None),
        optional(DESTINATIONS, ()),
        _TOWER_ENDS,
        build=lambda things, upward, base, ends: _tower(things, upward, ends, base),
    ),
    sequence(
        THINGS,
        predicates.FORM_A_TOWER,
        SO,
        _LAYERS,
        build=lambda whole, nps: TowerClause(Things(nps), upward=True, whole=whole),
    ),
    ON_A_BASE,
    LAYERED,
    sequence(A_TOWER, optional(DESTINATIONS, ()), SO, ENDS, build=_of_its_ends),
    sequence(
        # "Make a pile: yellow on top of the red block"
        A_TOWER,
        SO,
        ON_EACH_OTHER,
        build=lambda tower, pile: (
            None
            if (named := _announced(tower, pile.things.phrases)) is None
            else replace(pile, things=Things(_with_nouns(named)))
        ),
    ),
    variants(
        sequence(A_TOWER, optional(DESTINATIONS, ()), optional(SO), _LAYERS),
        lambda found: [
            TowerClause(Things(nps), upward=True, base=found[1])
            for nps in [_announced(found[0], found[2])]
            if nps is not None
        ],
    ),
    sequence(
        either(
            verbs.STACK,
            sequence(verbs.BUILD, verbs.OUT_OF),
            "[the] (stack|stacking|tower) order [~comma|is]",
        ),
        optional(sequence(THINGS, optional("up"), SO), None),
        _LAYERS,
        build=lambda whole, nps: TowerClause(Things(nps), upward=True, whole=whole),
    ),
    sequence(
        # "Stack the blocks on the tray from bottom to top in the order red, blue"
        either(
            sequence(verbs.STACK, THINGS, optional("up")),
            sequence(verbs.TURN_INTO, THINGS, f"(in|into) {verbs.A_TOWER}"),
            sequence(THINGS, predicates.MODAL, "(stacked|piled) [up]"),
            sequence(verbs.BUILD, verbs.OUT_OF, THINGS),
        ),
        optional(DESTINATIONS, ()),
        either(_IN_ORDER, sequence(OPTIONAL_COMMA, TURN, build=_one_by_one)),
        build=_of_these,
    ),
    sequence(
        # "Stack the red cup and the blue one on the tray, in that order"
        verbs.STACK,
        THINGS,
        optional(DESTINATIONS, ()),
        OPTIONAL_COMMA,
        manner.IN_THIS_ORDER,
        build=_as_named,
    ),
)


_TOP_AND_BOTTOM = {"bottom", "top"}


def _only_ends(ends: Any) -> TowerClause | None:
    """A tower of what is said to be at the bottom, on top and perhaps in the middle."""
    whole = {end for _, end in ends} >= _TOP_AND_BOTTOM
    return _of_its_ends((0, ()), (), ends) if whole else None


def _only_layers(first: Any, more: Any) -> TowerClause | None:
    """A tower without a verb: one of its layers is said to be at the bottom and one on top."""
    ends = {first[1], *(end for _, (_, end) in more)}
    nps = _rising(first, more)
    layers = None if nps is None or not ends >= _TOP_AND_BOTTOM else Things(_with_nouns(nps))
    return None if layers is None else TowerClause(layers, upward=True)


STACKED = either(
    PLACED_LAYERS,
    PAIR_BY_PAIR,
    sequence(ENDS, build=_only_ends),
    sequence(_LAYER, _MORE_LAYERS, build=_only_layers),
    sequence(
        THINGS,
        either(
            f"(stacked|piled) [up] [{manner.UPON_EACH_OTHER}]",
            f"in a (tower|stack|pile), {manner.UPON_EACH_OTHER}",
        ),
        optional(DESTINATIONS, ()),
        _TOWER_ENDS,
        build=lambda things, base, ends: _tower(things, None, ends, base),
    ),
)
"""The same without a verb ("three blocks stacked, the red one on top")."""


def _based(base: tuple[Destination, ...], tower: TowerClause) -> TowerClause | None:
    """A tower of several things on what is named before it ("on the tray, build a tower …")."""
    (np, *more) = tower.things.phrases
    several = more or singular(np.head) != np.head
    return replace(tower, base=base) if several and not tower.base else None


TOWER = either(_TOWER, sequence(DESTINATIONS, OPTIONAL_COMMA, _TOWER, build=_based))

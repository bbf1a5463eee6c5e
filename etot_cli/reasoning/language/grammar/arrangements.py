"""Rules for turning things upright, stacking them and swapping their places."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from etot_cli.reasoning.language.grammar.common import COMMA, LIST, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.destinations import DESTINATIONS, INTO, ONTO
from etot_cli.reasoning.language.grammar.modifiers import noun_phrase
from etot_cli.reasoning.language.grammar.naming import WORDS
from etot_cli.reasoning.language.grammar.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    either,
    one_of,
    optional,
    phrase,
    separated,
    sequence,
    some,
    valued,
    variants,
    word,
)
from etot_cli.reasoning.language.grammar.syntax import (
    Destination,
    NounPhrase,
    ReorientClause,
    SwapClause,
    Things,
    TowerClause,
)
from etot_cli.reasoning.language.words import manner, places, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import (
    NUMBERS,
    basic_color,
    is_descriptive,
    singular,
)

REORIENT = either(
    sequence(
        phrase(verbs.REORIENT),
        THINGS,
        optional("around, round"),
        optional(
            either(
                phrase(f"{manner.UPRIGHT}, {manner.STANDING}", True), phrase(manner.FITTING, False)
            ),
            False,
        ),
        build=lambda verb, things, upright: ReorientClause(things, upright or verb == "upright"),
    ),
    sequence(
        verbs.TURN,
        THINGS,
        f"back {manner.UPRIGHT}, {manner.UPRIGHT}",
        build=lambda things: ReorientClause(things, upright=True),
    ),
)
_END = one_of({"bottom": manner.AT_BOTTOM, "middle": manner.AT_MIDDLE, "top": manner.AT_TOP})
_ENDS = separated(
    sequence(noun_phrase, optional(verbs.BE), _END, build=lambda np, end: (np, end)), LIST, most=3
)


def _tower(
    things: Things, upward: bool | None, ends: Any, base: tuple[Destination, ...] = ()
) -> TowerClause | None:
    named = {end: np for np, end in ends or ()}
    if ends and len(named) < len(ends):
        return None
    return TowerClause(things, upward, base=base, **named)


def _with_nouns(nps: tuple[NounPhrase, ...]) -> tuple[NounPhrase, ...]:
    """With the noun that the first of them has for those that are a colour or the like alone."""
    bare = [all(map(is_descriptive, np.words)) for np in nps]
    nouns = [np.head for np, out in zip(nps, bare, strict=True) if np.words and not out]
    return tuple(
        replace(np, words=(*np.words, nouns[0])) if out and np.words and nouns else np
        for np, out in zip(nps, bare, strict=True)
    )


_A_TOWER = sequence(
    f"{verbs.BUILD}, {verbs.WANT}",
    "a tower, a stack, a pile",
    optional(
        sequence("of [the]", one_of({n: said for said, n in NUMBERS.items()}), optional(WORDS, ())),
        (0, ()),
    ),
)
"""What is to be built, of how many things (0: not said) and how these are called."""


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
    return _tower(Things(nps), None, full, base)


def _rising(lowest: Any, more: Any) -> tuple[NounPhrase, ...] | None:
    """What is named one after the other from an end on, from the bottom up ("red at the bottom,
    then blue, then green").
    """
    begun = lowest[1]
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


_COLOR = sequence(
    word(lambda given, text: basic_color(text) is not None),
    build=lambda text: NounPhrase(words=(text,), text=text),
)
"""A colour alone ("stack red on blue")."""
_UPWARD = sequence(
    OPTIONAL_COMMA, either(phrase(manner.BOTTOM_UP, True), phrase(manner.TOP_DOWN, False))
)
_SO = either(COMMA, sequence(OPTIONAL_COMMA, "with, so that, such that"))
"""Before what goes where in a tower."""
_LAYER = sequence(
    noun_phrase,
    optional(verbs.BE),
    optional(either(_END, phrase(manner.UPON_THAT, "upon")), ""),
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
_LAYERS = valued(
    either(
        sequence(_LAYER, _MORE_LAYERS, build=_rising),
        sequence(_IN_A_ROW, _UPWARD, build=lambda nps, up: nps if up else nps[::-1]),
        sequence(_UPWARD, COMMA, _IN_A_ROW, build=lambda up, nps: nps if up else nps[::-1]),
    ),
    _with_nouns,
)
"""All of a tower from the bottom up."""
_TOWER_ENDS = optional(
    either(
        sequence(_SO, _ENDS),
        # In "a tower with the blue block at the bottom" "the blue" is no thing of its own.
        sequence(_ENDS, build=lambda ends: ends if ends[0][0].determiner else None),
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
        verbs.STACK,
        optional(sequence(THINGS, COMMA), None),
        _COLOR,
        places.ONTO,
        _COLOR,
        build=lambda whole, top, below: TowerClause(Things((below, top)), upward=True, whole=whole),
    ),
    sequence(
        either(
            sequence(verbs.STACK, THINGS, optional(f"{manner.UPON_EACH_OTHER}, up")),
            sequence(verbs.PUT, THINGS, manner.UPON_EACH_OTHER),
            sequence(verbs.WANT, THINGS, "(stacked|piled) [up]", optional(manner.UPON_EACH_OTHER)),
        ),
        optional(_UPWARD, None),
        optional(DESTINATIONS, ()),
        _TOWER_ENDS,
        build=lambda things, upward, base, ends: _tower(things, upward, ends, base),
    ),
    sequence(
        either(verbs.STACK, verbs.PUT),
        THINGS,
        manner.INSIDE_EACH_OTHER,
        build=lambda things: TowerClause(things, nested=True),
    ),
    sequence(
        verbs.BUILD,
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
    sequence(_A_TOWER, optional(DESTINATIONS, ()), _SO, _ENDS, build=_of_its_ends),
    variants(
        sequence(_A_TOWER, optional(DESTINATIONS, ()), optional(_SO), _LAYERS),
        lambda found: [
            TowerClause(Things(nps), upward=True, base=found[1])
            for nps in [_announced(found[0], found[2])]
            if nps is not None
        ],
    ),
    sequence(
        either(verbs.STACK, sequence(verbs.BUILD, verbs.OUT_OF)),
        optional(sequence(THINGS, _SO), None),
        _LAYERS,
        build=lambda whole, nps: TowerClause(Things(nps), upward=True, whole=whole),
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
    sequence(_ENDS, build=_only_ends),
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
_IN_ITS_PLACE = sequence(
    noun_phrase,
    "[to] where",
    noun_phrase,
    "(is|are|was|were) [now|before]",
    build=lambda one, other: (one, other),
)


def _exchanged(
    there: tuple[NounPhrase, NounPhrase], back: tuple[NounPhrase, NounPhrase]
) -> SwapClause | None:
    """Of two things each goes where the other is; "the green one" takes up the other's noun."""
    alike = all(
        one.words == other.words or (other.head == "one" and one.words[:-1] == other.words[:-1])
        for one, other in zip(there, back[::-1], strict=True)
    )
    return SwapClause(Things(there), back=back) if alike else None


_THE_PLACE = sequence(
    optional("[in|on] there"),
    either(
        sequence("in [the] place of", noun_phrase),
        phrase("in its place", NounPhrase(pronoun="it", text="its")),
        phrase("in (his|her) place", NounPhrase(pronoun="him", text="its")),
    ),
)


def _replacing(new: NounPhrase, there: Any, old: NounPhrase) -> SwapClause:
    where = () if there is None else (there,)
    return SwapClause(Things((old, new)), replaces=True, where=where)


REPLACING = sequence(noun_phrase, optional(either(INTO, ONTO), None), _THE_PLACE, build=_replacing)
"""What goes where something else was."""
SWAP = either(
    sequence(verbs.SET_DOWN, REPLACING),
    sequence(
        noun_phrase,
        verbs.MODAL,
        optional(either(INTO, ONTO), None),
        _THE_PLACE,
        build=_replacing,
    ),
    sequence(verbs.SWAP, THINGS, optional("around, round, over"), build=SwapClause),
    sequence(
        verbs.WANTED,
        "the (positions|places) of",
        THINGS,
        "[to be] (exchanged|swapped|switched)",
        build=SwapClause,
    ),
    sequence(
        optional(f"have, let, make, can, could, may, {verbs.WANT}"),
        THINGS,
        verbs.CHANGE_PLACES,
        build=SwapClause,
    ),
    sequence(
        noun_phrase,
        verbs.CHANGE_PLACES,
        "with",
        noun_phrase,
        build=lambda one, other: SwapClause(Things((one, other))),
    ),
    sequence(verbs.SET_DOWN, _IN_ITS_PLACE, "and", _IN_ITS_PLACE, build=_exchanged),
    sequence(
        verbs.SET_DOWN,
        _IN_ITS_PLACE,
        "and vice versa, and the other way (round|around)",
        build=lambda pair: SwapClause(Things(pair)),
    ),
    sequence(
        one_of({False: "swap[ping], exchang(e|ing), switch[ing]", True: "replac(e|ing)"}),
        noun_phrase,
        "with, for, by",
        noun_phrase,
        build=lambda replaces, one, two: SwapClause(Things((one, two)), replaces),
    ),
)

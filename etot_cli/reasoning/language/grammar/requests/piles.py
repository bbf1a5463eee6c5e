"""Rules for towers told pair by pair, by colours alone ("stack red on blue, green on red")."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    phrase,
    separated,
    sequence,
    silent,
    some,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.common import COLON, COMMA, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.requests.tower_bases import NEXT
from etot_cli.reasoning.language.grammar.syntax.clauses import TowerClause, put_to
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import manner, places, predicates, verbs
from etot_cli.reasoning.language.words.lexicon import (
    SIZES,
    basic_color,
    is_descriptive,
    singular,
)


def _piled(
    whole: Things | None, second: NounPhrase, first: NounPhrase, more: Any
) -> TowerClause | None:
    """Each thing on the one before ("stack red on blue, then green on red"), or each on the next
    ("red on blue and blue on green").
    """
    pairs = ((second, first), *more)
    if more and all(low == up for (_, low), (up, _) in pairwise(pairs)):
        downward = (second, *(lower for _, lower in pairs))
        again = tuple(upper for upper, _ in more)
        return TowerClause(Things(downward), upward=False, whole=whole, again=again)
    nps = (first, second, *(upper for upper, _ in more))
    if any(lower not in (None, under) for under, (_, lower) in zip(nps[1:], more, strict=False)):
        return None
    again = tuple(lower for _, lower in more if lower is not None)
    return TowerClause(Things(nps), upward=True, whole=whole, again=again)


def _standing_on(pairs: Any) -> TowerClause | None:
    """A tower told pair by pair without a verb ("blue on red, yellow on blue")."""
    (second, first), *more = pairs
    said = tuple((upper, None if lower.pronoun else lower) for upper, lower in more)
    return _piled(None, second, first, said)


COLOR = sequence(
    some(word(lambda given, text: text in SIZES), most=1),
    word(lambda given, text: basic_color(text) is not None),
    build=lambda size, color: NounPhrase(words=(*size, color), text=" ".join((*size, color))),
)
"""A colour alone, perhaps with a size ("stack red on big blue")."""
PILED = sequence(
    either(verbs.STACK, verbs.PUT),
    optional(sequence(THINGS, COMMA), None),
    COLOR,
    places.ONTO,
    COLOR,
    some(
        sequence(
            NEXT,
            COLOR,
            either(
                sequence(places.ONTO, COLOR),
                sequence(manner.ATOP, build=lambda: ()),
            ),
            build=lambda upper, lower: (upper, lower or None),
        ),
        most=4,
    ),
    build=_piled,
)
"""Behind a verb."""


def _one_of_two(
    nested: bool, whole: Things, upper: NounPhrase, toward: Toward, lower: NounPhrase
) -> TowerClause | None:
    """Two things that are announced together, one on or in the other; they may leave out the noun
    ("stack the two boxes, small on big").
    """
    (np, *more) = whole.phrases
    noun = (*np.words[:-1], singular(np.head)) if np.words else ()

    def named(one: NounPhrase) -> NounPhrase:
        bare = one.words and all(map(is_descriptive, one.words)) and not one.determiner
        return replace(one, determiner="the", words=(*one.words, *noun)) if bare else one

    within = toward is Toward.INSIDE
    if more or noun == np.words or (nested and not within):
        return None
    things = Things((named(lower), named(upper)))
    return TowerClause(things, upward=True, whole=whole, nested=within)


_BARE = sequence(
    some(word(lambda given, text: is_descriptive(text)), least=1, most=2),
    build=lambda words: NounPhrase(words=words, text=" ".join(words)),
)
ONE_OF_TWO = sequence(
    either(phrase(verbs.STACK, False), phrase(verbs.NEST, True)),
    THINGS,
    either(COMMA, COLON),
    either(_BARE, noun_phrase),
    one_of({Toward.ON: places.ONTO, Toward.INSIDE: places.INTO}),
    either(_BARE, noun_phrase),
    silent(optional(manner.NOT_REVERSED)),
    build=_one_of_two,
)
"""How two things are to stand."""
PUT_ON_COLOR = sequence(
    # "Take green off blue and put it on red"
    either(verbs.STACK, verbs.PUT),
    phrase("it"),
    places.ONTO,
    COLOR,
    build=lambda it, color: put_to(
        Things((NounPhrase(pronoun=it, text=it),)), (Destination(Toward.ON, (color,)),)
    ),
)
PAIR_BY_PAIR = sequence(
    # "Blue on red, yellow on blue"
    separated(
        sequence(
            COLOR,
            silent(optional(predicates.MODAL)),
            f"{places.ONTO}, above, over",
            COLOR,
            build=lambda *pair: pair,
        ),
        NEXT,
        most=5,
    ),
    build=_standing_on,
)
"""Without a verb."""
ON_EACH_OTHER = sequence(
    separated(
        sequence(
            silent(optional("first")),
            noun_phrase,
            silent(optional("right, directly, straight")),
            places.ONTO,
            noun_phrase,
            build=lambda *pair: pair,
        ),
        NEXT,
        most=5,
    ),
    build=_standing_on,
)
"""Behind what announces a tower."""

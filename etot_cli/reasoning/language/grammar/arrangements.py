"""Rules for turning things upright, swapping and replacing them."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.common import (
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    either,
    optional,
    phrase,
    sequence,
)
from etot_cli.reasoning.language.grammar.syntax import (
    Destination,
    NounPhrase,
    PutClause,
    ReorientClause,
    SwapClause,
    Things,
    Toward,
    put_to,
)
from etot_cli.reasoning.language.words import manner, places, verbs


def _stood_up(things: Things) -> ReorientClause:
    return ReorientClause(things, upright=True)


REORIENT = either(
    sequence(
        phrase(verbs.REORIENT),
        THINGS,
        optional("around, round"),
        optional(
            either(
                phrase(f"{manner.UPRIGHT}, {manner.TURNED_UP}", True), phrase(manner.FITTING, False)
            ),
            False,
        ),
        build=lambda verb, things, upright: ReorientClause(things, upright or verb == "upright"),
    ),
    sequence(
        verbs.TURN,
        THINGS,
        f"back {manner.UPRIGHT}, {manner.UPRIGHT}, {manner.TURNED_UP}",
        build=_stood_up,
    ),
    sequence(
        either(
            sequence(ALL_THINGS, verbs.MODAL),
            sequence(verbs.ENSURE, ALL_THINGS, f"{verbs.BE}, {verbs.LIES}"),
            sequence(verbs.WANTED, ALL_THINGS, optional("to (be|stand)")),
        ),
        manner.ERECT,
        build=_stood_up,
    ),
)
STANDS_UP = sequence(
    ALL_THINGS, optional(f"{verbs.BE}, {verbs.LIES}"), manner.ERECT, build=_stood_up
)
"""What stands by then ("once it is upright, …")."""
_IN_ITS_PLACE = sequence(
    noun_phrase,
    "[to] where",
    noun_phrase,
    places.IS_THERE,
    build=lambda one, other: (one, other),
)


def _replaced(old: NounPhrase, new: NounPhrase) -> PutClause:
    return put_to(Things((new,)), (Destination(Toward.STEAD, (old,), "replace"),))


SWAP = either(
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
    sequence(
        verbs.SET_DOWN,
        _IN_ITS_PLACE,
        OPTIONAL_COMMA,
        "and vice versa, and the other way (round|around)",
        build=lambda pair: SwapClause(Things(pair)),
    ),
    sequence(
        "swap[ping], exchang(e|ing), switch[ing]",
        noun_phrase,
        "with, for, by",
        noun_phrase,
        build=lambda one, two: SwapClause(Things((one, two))),
    ),
    sequence("replac(e|ing)", noun_phrase, "with, for, by", noun_phrase, build=_replaced),
)

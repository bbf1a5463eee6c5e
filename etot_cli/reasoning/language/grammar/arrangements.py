"""Rules for turning things upright or on their side, swapping and replacing them."""

from __future__ import annotations

from functools import partial

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
    silent,
)
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    PutClause,
    ReorientClause,
    SwapClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import manner, places, verbs
from etot_cli.world.spatial import Nearby

_stood_up = partial(ReorientClause, stance=Nearby.UPRIGHT)
_laid_down = partial(ReorientClause, stance=Nearby.LYING)
REORIENT = either(
    sequence(
        phrase(verbs.REORIENT),
        THINGS,
        optional("around, round"),
        optional(
            either(
                phrase(f"{manner.UPRIGHT}, {manner.TURNED_UP}", Nearby.UPRIGHT),
                phrase(manner.FITTING, None),
            ),
            None,
        ),
        build=lambda verb, things, stance: ReorientClause(
            things, Nearby.UPRIGHT if verb == "upright" else stance
        ),
    ),
    sequence(
        f"{verbs.TURN}, {verbs.KEEP}",
        THINGS,
        f"back {manner.UPRIGHT}, {manner.UPRIGHT}, {manner.TURNED_UP}",
        build=_stood_up,
    ),
    sequence(
        f"{verbs.LAY}, {verbs.TIP}",
        THINGS,
        optional("down"),
        manner.LYING,
        build=_laid_down,
    ),
    sequence(
        either(
            sequence(ALL_THINGS, f"{verbs.MODAL}, {verbs.STAY}"),
            sequence(verbs.ENSURE, ALL_THINGS, f"{verbs.BE}, {verbs.LIES}"),
            sequence(verbs.WANTED, ALL_THINGS, silent(optional(f"to (be|stand), {verbs.DONE}"))),
        ),
        either(phrase(manner.ERECT, Nearby.UPRIGHT), phrase(manner.LAID, Nearby.LYING)),
        build=ReorientClause,
    ),
    sequence(
        verbs.PUT_DOWN,
        THINGS,
        manner.LYING,
        build=_laid_down,
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

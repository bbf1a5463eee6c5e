"""Rules for turning things upright and swapping their places."""

from __future__ import annotations

from typing import Any

from etot_cli.reasoning.language.grammar.common import noun_phrase
from etot_cli.reasoning.language.grammar.destinations import INTO, ONTO
from etot_cli.reasoning.language.grammar.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    either,
    one_of,
    optional,
    phrase,
    sequence,
)
from etot_cli.reasoning.language.grammar.syntax import (
    NounPhrase,
    ReorientClause,
    SwapClause,
    Things,
)
from etot_cli.reasoning.language.words import manner, verbs

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
        phrase("in their place", NounPhrase(pronoun="them", text="their")),
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

"""Rules for sentences without a verb: what is to be so, goes somewhere or comes out ("lid off")."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.clauses import (
    LEFT_OUT,
    of_the_things,
    plain,
)
from etot_cli.reasoning.language.grammar.common import LIST, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.modifiers import CONTRASTED, noun_phrase
from etot_cli.reasoning.language.grammar.noun_phrases import ALL_THINGS, NP_LIST
from etot_cli.reasoning.language.grammar.parsing import (
    either,
    quiet,
    separated,
    sequence,
)
from etot_cli.reasoning.language.grammar.putting import VERBLESS
from etot_cli.reasoning.language.grammar.spoken import Order
from etot_cli.reasoning.language.grammar.states import OPEN_OR_CLOSED
from etot_cli.reasoning.language.grammar.syntax import (
    Destination,
    EnsureClause,
    NounPhrase,
    PutClause,
    PutGroup,
    RemoveClause,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.grammar.topics import (
    sources,
)
from etot_cli.reasoning.language.words import small_words, verbs
from etot_cli.reasoning.language.words.known import VERB_WORDS
from etot_cli.reasoning.language.words.patterns import words_of


def left_so(nps: tuple[NounPhrase, ...], word: str) -> EnsureClause:
    """Things that are to be open or closed in the end."""
    return EnsureClause((State(nps, word=word),))


_LEFT = sequence(NP_LIST, OPEN_OR_CLOSED, build=left_so)
LEFT_SO = either(
    plain(_LEFT),
    sequence(plain(_LEFT, Order.LAST), small_words.TRAILING_LAST),
    sequence(plain(_LEFT, Order.THEN), small_words.TRAILING_THEN),
)
"""How something is to be in the end, without a verb ("drawer shut")."""


def _taken_out(things: Things) -> RemoveClause | None:
    """What is taken from somewhere, without a verb."""
    all_of_them = len(sources(things)) == len(things.phrases)
    doing = VERB_WORDS | words_of((verbs.CLOSE,))  # "shut off the fridge"
    return RemoveClause(things) if all_of_them and things.phrases[0].head not in doing else None


TAKEN_FROM = sequence(ALL_THINGS, build=_taken_out)
OUT = either(TAKEN_FROM, sequence(ALL_THINGS, "out, off", build=RemoveClause))
"""What is taken from somewhere, or from where it is."""
PLACED = plain(
    either(
        VERBLESS,
        sequence(VERBLESS, OPTIONAL_COMMA, either(CONTRASTED, LEFT_OUT), build=of_the_things),
        OUT,
    )
)
"""What goes somewhere or comes out, as a reading."""
PAIRS = quiet(
    sequence(
        separated(
            sequence(
                noun_phrase,
                noun_phrase,
                build=lambda np, place: PutGroup(
                    Things((np,)), (Destination(Toward.TO, (place,)),)
                ),
            ),
            LIST,
            most=6,
        ),
        build=lambda groups: PutClause(groups) if groups[1:] else None,
    )
)
"""Things and their places, with nothing in between ("sort: bolts left bin, nuts right bin")."""

"""Rules for how things are wished to be, and for what is said to be what goes somewhere."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.language.grammar.common import EMPTY_WORDS, LIST
from etot_cli.reasoning.language.grammar.destinations import DESTINATIONS, FILLED
from etot_cli.reasoning.language.grammar.modifiers import noun_phrase
from etot_cli.reasoning.language.grammar.noun_phrases import ALL_THINGS, NP_LIST
from etot_cli.reasoning.language.grammar.parsing import (
    either,
    optional,
    phrase,
    sequence,
    some,
)
from etot_cli.reasoning.language.grammar.states import PREDICATE, being, state_of
from etot_cli.reasoning.language.grammar.syntax import (
    Clause,
    Destination,
    EnsureClause,
    NounPhrase,
    State,
    Things,
    Toward,
    put_to,
)
from etot_cli.reasoning.language.words import small_words, verbs

WISHED = sequence(
    small_words.WISH_IF,
    EMPTY_WORDS,
    being(verbs.WOULD_BE),
    some(
        sequence(
            LIST,
            optional("if, that"),
            either(
                being(verbs.WOULD_BE),
                # "… and the vase on the plate": the verb is left out.
                sequence(NP_LIST, PREDICATE, build=state_of),
            ),
        ),
        most=5,
    ),
    build=lambda first, more: EnsureClause((first, *more)),
)
"""How it would be nice for things to be."""
_THING = "(thing|things|one|ones|object|objects|item|items)"
_WHAT_GOES = either(
    sequence(
        phrase(f"the only {_THING}", True),
        optional(f"[that|which] ({verbs.MODAL}|i want|we want|i need), that, which"),
    ),
    sequence(
        phrase(f"what, the {_THING} (that|which)", False), f"{verbs.MODAL}, (i|we) (want|need)"
    ),
)
"""What is there, or (True) alone is there."""
_IS = f"{verbs.BE}, should be, must be, has to be, needs to be, shall be"


def _there(things: Things, only: bool, where: tuple[Destination, ...]) -> Clause | None:
    """What is to be there, or (``only``) alone in the end."""
    if not only:
        return put_to(things, where)
    (first, *more) = things.phrases
    alone = (replace(first, determiner="only the"), *more)
    return None if things.either else EnsureClause((State(alone, where),))


def _at(place: NounPhrase, things: Things) -> Clause:
    return put_to(things, (Destination(Toward.TO, (place,), FILLED),))


THOUGHT = sequence(small_words.I_THINK, ALL_THINGS, verbs.OUGHT, DESTINATIONS, build=put_to)
"""What would be good to be somewhere; that something belongs there may be but an opinion."""
TOLD_APART = either(
    # "The cup is the only thing that goes on the tray", "what belongs there is the cup"
    sequence(ALL_THINGS, _IS, _WHAT_GOES, DESTINATIONS, build=_there),
    sequence(
        _WHAT_GOES,
        DESTINATIONS,
        _IS,
        ALL_THINGS,
        build=lambda only, where, things: _there(things, only, where),
    ),
    sequence("it is, it 's", ALL_THINGS, "that, which", verbs.MODAL, DESTINATIONS, build=put_to),
    sequence(
        # "The tray is where the cup goes", "… where I want the cup"
        noun_phrase,
        "is where",
        either(
            sequence(ALL_THINGS, verbs.MODAL),
            sequence(verbs.WANTED, ALL_THINGS, optional("to (be|go|stand|lie)")),
        ),
        build=_at,
    ),
)
"""What goes somewhere, said so that it stands out."""

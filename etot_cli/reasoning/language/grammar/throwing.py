"""Rules for what is thrown into a bin, which is putting it there; what else is thrown flies."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.common import LIST
from etot_cli.reasoning.language.grammar.destinations import INTO
from etot_cli.reasoning.language.grammar.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    either,
    optional,
    phrase,
    quiet,
    separated,
    sequence,
)
from etot_cli.reasoning.language.grammar.syntax import (
    Destination,
    NounPhrase,
    PutClause,
    PutGroup,
    Things,
    Toward,
    put_to,
)
from etot_cli.reasoning.language.words import verbs
from etot_cli.reasoning.language.words.lexicon import BINS, singular


def _into_a_bin(things: Things, where: tuple[Destination, ...]) -> PutGroup | None:
    words = [[part for word in np.words for part in word.split("_")] for np in where[0].targets]
    bins = all(any(singular(word) in BINS for word in said) for said in words)
    return PutGroup(things, where) if bins else None


def _away(text: str, things: Things) -> PutClause:
    trash = NounPhrase("the", ("trash",), text=text)
    return put_to(things, (Destination(Toward.INSIDE, (trash,)),))


THROWN = quiet(
    either(
        sequence(
            verbs.THROW,
            separated(
                sequence(
                    THINGS,
                    optional("away, out"),
                    sequence(INTO, build=lambda place: (place,)),
                    build=_into_a_bin,
                ),
                LIST,
                most=3,
            ),
            build=PutClause,
        ),
        sequence(phrase(verbs.THROW_AWAY), THINGS, build=_away),
        sequence(
            verbs.THROW, THINGS, phrase("away, out"), build=lambda things, text: _away(text, things)
        ),
    )
)

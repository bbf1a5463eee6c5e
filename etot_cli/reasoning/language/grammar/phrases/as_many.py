"""Rules for as many things as there are others ("as many cups as there are plates")."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    quiet,
    sequence,
)
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA, WORDS, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.modifiers import MODIFIERS
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, put_to
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    Things,
)
from etot_cli.reasoning.language.words import predicates, verbs
from etot_cli.reasoning.language.words.lexicon import singular


def _as_many(
    words: tuple[str, ...],
    modifiers: tuple[Modifier, ...],
    where: tuple[Destination, ...],
    counted: NounPhrase,
) -> PutClause | None:
    """Things to a place, as many as there are of what is counted: several, by its noun."""
    if counted.determiner or counted.pronoun or singular(counted.head) == counted.head:
        return None
    text = f"as many {' '.join(words)}"
    np = NounPhrase("", words, modifiers, text=text, as_many_as=counted)
    return put_to(Things((np,)), where)


_SO_MANY = "as many, the same number of, an equal number of"
_AS = sequence(OPTIONAL_COMMA, "as there are", noun_phrase)
AS_MANY = quiet(
    either(
        sequence(verbs.SET_DOWN, _SO_MANY, WORDS, MODIFIERS, DESTINATIONS, _AS, build=_as_many),
        sequence(
            either(
                sequence(verbs.SET_DOWN, _SO_MANY, WORDS, MODIFIERS, _AS),
                sequence(_SO_MANY, WORDS, MODIFIERS, _AS, optional(predicates.MODAL, ())),
            ),
            DESTINATIONS,
            build=lambda said, where: _as_many(said[0], said[1], where, said[2]),
        ),
    )
)

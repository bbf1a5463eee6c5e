"""Rules for vessels that are to stand in each other."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import either, optional, sequence
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS, INTO
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, TowerClause, put_to
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, Things
from etot_cli.reasoning.language.words import manner, predicates, verbs
from etot_cli.reasoning.language.words.lexicon import singular


def _nested(things: Things, base: tuple[Destination, ...] = ()) -> TowerClause | None:
    """Several vessels; of one it is said what it is nested in."""
    single = len(things.phrases) == 1 and singular(things.phrases[0].head) == things.phrases[0].head
    return None if single or things.either else TowerClause(things, base=base, nested=True)


def _nested_in(things: Things, where: Destination) -> PutClause | None:
    """One vessel into another; where several are nested is rather where they stand."""
    (np, *more) = things.phrases
    single = not more and singular(np.head) == np.head
    return put_to(things, (where,)) if single else None


_EACH_OTHER = manner.INSIDE_EACH_OTHER
NESTED = either(
    sequence(
        either(verbs.STACK, verbs.PUT, verbs.NEST),
        THINGS,
        _EACH_OTHER,
        optional(DESTINATIONS, ()),
        build=_nested,
    ),
    sequence(verbs.NEST, THINGS, optional(DESTINATIONS, ()), build=_nested),
    sequence(verbs.NEST, THINGS, INTO, build=_nested_in),
    sequence(
        # "Put the bowls on the plate, stacked in one another"
        either(
            sequence(verbs.PUT, THINGS),
            sequence(THINGS, predicates.MODAL),
            sequence(predicates.WANTED, THINGS, optional(predicates.TO_BE_THERE)),
        ),
        DESTINATIONS,
        OPTIONAL_COMMA,
        manner.NESTED,
        build=_nested,
    ),
    sequence(
        # "The bowls should be nested on the plate"
        either(
            sequence(THINGS, predicates.MODAL),
            sequence(predicates.WANTED, THINGS, optional(predicates.TO_BE_THERE)),
        ),
        manner.NESTED,
        optional(DESTINATIONS, ()),
        build=_nested,
    ),
)

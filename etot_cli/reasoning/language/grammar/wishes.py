"""Rules for what is wanted of things, asked for again, and left out of what was asked for."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.language.grammar.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.parsing import either, sequence
from etot_cli.reasoning.language.grammar.syntax import (
    AgainClause,
    Clause,
    EnsureClause,
    Modifier,
    MoveClause,
    PickClause,
    PutClause,
    RemoveClause,
    Things,
    TowerClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.taking import SOURCE
from etot_cli.reasoning.language.words import small_words, verbs

WANTED = either(
    sequence(verbs.WANT, ALL_THINGS, verbs.DONE, DESTINATIONS, build=put_to),
    sequence(verbs.WANT, ALL_THINGS, verbs.TAKEN, SOURCE, build=RemoveClause),
    sequence(
        sequence(verbs.WANT, ALL_THINGS, verbs.TAKEN, SOURCE, build=Things.taken_from),
        "and",
        verbs.DONE,
        DESTINATIONS,
        build=put_to,
    ),
    sequence(verbs.WANT, ALL_THINGS, "[to be] (picked up|lifted [up])", build=PickClause),
)
AGAIN = either(
    sequence(small_words.SAME_AGAIN, THINGS, build=AgainClause),
    sequence(THINGS, small_words.ALSO, build=lambda things: AgainClause(things, trailing=True)),
)


def excluding(clause: Clause, left_out: Modifier) -> Clause | None:
    """A clause without some of the things that it is about ("…, except the blue one")."""

    def without(things: Things) -> Things:
        (*before, last) = things.phrases
        return replace(things, phrases=(*before, last.told_by(left_out)))

    match clause:
        case PutClause(groups=(group,)):
            return replace(clause, groups=(replace(group, things=without(group.things)),))
        case EnsureClause(states=(state,)):
            return EnsureClause((replace(state, subjects=without(Things(state.subjects)).phrases),))
        case PickClause() | RemoveClause() | MoveClause() | TowerClause():
            return replace(clause, things=without(clause.things))
    return None

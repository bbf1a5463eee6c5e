"""Rules for what must not come to something by a door or drawer that moves meanwhile."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import either, optional, sequence
from etot_cli.reasoning.language.grammar.parsers.common import noun_phrase
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.syntax.clauses import Avoid, AvoidClause
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things
from etot_cli.reasoning.language.words import forbidden


def _met_by(things: Things, by: NounPhrase) -> AvoidClause:
    """What a door must not come against."""
    return AvoidClause(Avoid.HIT, things, by=(by,))


def _met(by: NounPhrase, things: Things) -> AvoidClause | None:
    """The same; "so that it does not touch the vase" is said of what is put somewhere."""
    return None if by.pronoun else _met_by(things, by)


def with_it(clause: AvoidClause, by: NounPhrase | None) -> AvoidClause:
    """What must not be touched ("… with the door")."""
    return clause if by is None else replace(clause, avoid=Avoid.HIT, by=(by,))


WITH_IT = optional(sequence("with, using, by", noun_phrase), None)
"""Behind what must not be touched: by what."""
_BY_IT = sequence(f"({forbidden.MET}) by", noun_phrase)
LET_MEET = sequence(
    "let[ting], hav(e|ing), allow[ing]",
    either(
        sequence(noun_phrase, optional("to"), forbidden.MEETS, THINGS, build=_met),
        sequence(THINGS, "[to] (get|be)", _BY_IT, build=_met_by),
    ),
)
"""Behind what says that it must not be."""
MEETING = either(
    sequence(noun_phrase, forbidden.MEETS, THINGS, build=_met),
    sequence(THINGS, "getting, being", _BY_IT, build=_met_by),
)
"""Behind "without"."""
_NOT = "(does|do|will|can|should|must|may|shall) (not|never)"
NOT_MET = either(
    sequence(noun_phrase, _NOT, forbidden.MEETS, THINGS, build=_met),
    sequence(THINGS, f"{forbidden.NOT_TO_BE}, {_NOT} (be|get)", _BY_IT, build=_met_by),
)
"""What is said to be so, or ensured."""

"""Rules for several things that go to different places, or all to one, before these are told."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.language.grammar.parsers.combinators import either, optional, sequence
from etot_cli.reasoning.language.grammar.parsers.common import COMMA, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS, destination
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    PutClause,
    ReorientClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, Things
from etot_cli.reasoning.language.words import manner, predicates, small_words, verbs

_GO = f"{predicates.MODAL}, {predicates.STAY}"


def _several(things: Things) -> ReorientClause | None:
    return ReorientClause(things, only_named=True) if things.may_be_several else None


PARTED = sequence(
    either(
        sequence(
            f"{verbs.SET_DOWN}, {verbs.KEEP}", ALL_THINGS, optional("away"), manner.PARTED,
            build=_several,
        ),
        sequence(verbs.SEPARATE, ALL_THINGS, optional("up"), build=_several),
        sequence(
            predicates.WANTED, ALL_THINGS, optional(predicates.DONE), manner.PARTED, build=_several
        ),
        sequence(ALL_THINGS, _GO, manner.PARTED, build=_several),
    ),
    optional("~comma so that, so that, with"),
)  # fmt: skip
"""Several things that are said to go to different places, before these are told."""


def _in_one_place(things: Things, where: tuple[Destination, ...]) -> PutClause | None:
    """All of several things in one of some places."""
    choice = sum(len(item.targets) for item in where) > 1
    put = replace(put_to(things, where), grouping=Grouping.TOGETHER)
    return put if choice and things.may_be_several else None


_ALL = "both [of them], all [of them], [both|all] together"
_BOTH_OR_BOTH = sequence(
    optional("either"), _ALL, destination, OPTIONAL_COMMA, small_words.OR, _ALL, destination,
    build=lambda *where: where,
)  # fmt: skip
_IN_ONE = sequence(manner.AS_ONE, COMMA, DESTINATIONS)
_PLACES = either(
    sequence(optional(manner.AS_ONE), OPTIONAL_COMMA, _BOTH_OR_BOTH),
    _IN_ONE,
)
IN_ONE_PLACE = either(
    sequence(
        f"{verbs.SET_DOWN}, {verbs.KEEP}", ALL_THINGS, optional("away"), _PLACES,
        build=_in_one_place,
    ),
    sequence(ALL_THINGS, _GO, _PLACES, build=_in_one_place),
    sequence(
        predicates.WANTED, ALL_THINGS, optional(predicates.DONE), _PLACES, build=_in_one_place
    ),
    sequence(
        ALL_THINGS,
        predicates.TO_BE_DONE,
        predicates.TIDIED, COMMA, DESTINATIONS,
        build=put_to,
    ),
)  # fmt: skip
"""Several things that all go to one of some places ("either both in the box or both on the tray"),
or are to be put away, behind which it is told where.
"""

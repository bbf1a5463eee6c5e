"""Rules for what goes from one place to another, where it is told where from."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    separated,
    sequence,
    spanned,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COLON,
    LIST,
    LIST_COMMA,
    OPTIONAL_COMMA,
    WORDS,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.beside import BESIDE
from etot_cli.reasoning.language.grammar.phrases.coordination import coordinated
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS, DIRECTED
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.requests.additions import EXTRAS, put_of
from etot_cli.reasoning.language.grammar.requests.put_groups import PUT_GROUP
from etot_cli.reasoning.language.grammar.requests.taking import SOURCE
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup, put_to
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    ONWARD,
    Beside,
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import predicates, verbs
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.world.spatial import Nearby


def _changing(
    np: NounPhrase, words: tuple[str, ...], source: NounPhrase, where: tuple[Destination, ...]
) -> PutClause | None:
    """From one place to another, both of which have one noun."""
    noun = (*words[:-1], singular(words[-1]))
    if noun == words:
        return None
    named = tuple(w.going_to(lambda to: to.called(*noun) if to.is_elliptic else to) for w in where)
    at = source.called(*noun) if source.is_elliptic else source
    return put_to(Things((np,)).taken_from(at), named)


def _taken_away(verb: str, things: Things, where: tuple[Beside, ...]) -> PutClause | None:
    """Away from where something stands beside another one; what is in or on that is taken out."""
    if any(item.relation is not Nearby.AWAY for item in where):
        return None
    beside = any(item.text.startswith(_FROM_BESIDE) for item in where)
    put = put_to(things, (Destination(Toward.BESIDE, beside=where),))
    return put if beside else replace(put, far_fetched=1)


def brought(things: Things, source: Any, where: tuple[Destination, ...]) -> PutGroup:
    """Things from one place to another; "from the lower to the upper board" speaks of boards."""
    lent = source and where[0].targets and coordinated(source, where[0].targets[:1])
    if source and all(item.toward is Toward.TO and not item.word for item in where):
        where = tuple(replace(item, word=ONWARD) for item in where)
    return PutGroup(things.taken_from(lent[0] if lent else source), where)


def _rather_there(text: str, clause: PutClause) -> PutClause:
    """In "grab the cup on top of the shelf" the cup may as well be there by now."""
    return replace(clause, far_fetched=clause.far_fetched + ("on top of" in text))


OUT_AND_INTO = sequence(
    SOURCE, either(DIRECTED, sequence(LIST, optional(f"go[es], {predicates.LIES}"), DESTINATIONS))
)
"""From one place to another ("out of the box and on the desk")."""
_FROM_BESIDE = ("from ", "away from the front", "away from in front")
_EXACTLY = optional(sequence(LIST_COMMA, separated(PUT_GROUP, LIST, most=4)), ())
"""Where some of several things go: "get the cup and the pen onto the tray, pen in the cup"."""
CARRIED = either(
    sequence(
        either(
            sequence(ALL_THINGS, f"{predicates.MODAL}, {predicates.COME_AWAY}"),
            sequence(
                predicates.WANTED, ALL_THINGS, optional(f"{predicates.DONE}, to (come|get|go)")
            ),
        ),
        OUT_AND_INTO,
        build=lambda things, moved: PutClause((brought(things, *moved),)),
    ),
    sequence(
        # "The ball should change jars: from the big one into the small one"
        noun_phrase,
        "[should|must|shall|has to|is to|needs to] change[s]",
        WORDS,
        either(COLON, OPTIONAL_COMMA),
        "from",
        noun_phrase,
        DIRECTED,
        build=_changing,
    ),
    sequence(phrase(f"{verbs.TAKE}, {verbs.REMOVE}"), THINGS, BESIDE, build=_taken_away),
    sequence(
        ALL_THINGS,
        predicates.COME_AWAY,
        optional("[back|right] (out|off|down|over)"),
        DIRECTED,
        build=put_to,
    ),
    spanned(
        sequence(
            verbs.BRING,
            separated(
                sequence(
                    THINGS,
                    # "Off the tray and onto the shelf"
                    optional(sequence(SOURCE, optional(LIST)), None),
                    DIRECTED,
                    build=brought,
                ),
                LIST,
                most=5,
            ),
            _EXACTLY,
            EXTRAS,
            build=lambda groups, more, extras: put_of((*groups, *more), extras),
        ),
        _rather_there,
    ),
    sequence(
        # "Clear it all off the tray and onto the shelf"
        f"{verbs.REMOVE}, clear[ing], unload[ing]",
        sequence(THINGS, sequence(SOURCE, optional(LIST)), DIRECTED, build=brought),
        _EXACTLY,
        build=lambda group, more: PutClause((group, *more)),
    ),
)

"""Rules for where things go that are said without a verb."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COLON,
    COMMA,
    LIST,
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.destinations import (
    DESTINATIONS,
    DIRECTED,
    INTO,
    ONTO,
)
from etot_cli.reasoning.language.grammar.phrases.gapping import RESPECTIVE_PLACES, respective
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, NP_LIST
from etot_cli.reasoning.language.grammar.phrases.successions import (
    FIRST_THEN,
    put_in_turn,
)
from etot_cli.reasoning.language.grammar.requests.additions import (
    EXTRAS,
    put_of,
)
from etot_cli.reasoning.language.grammar.requests.carrying import brought
from etot_cli.reasoning.language.grammar.requests.flanking import ON_BOTH_SIDES, flanking
from etot_cli.reasoning.language.grammar.requests.laying import lies_flat
from etot_cli.reasoning.language.grammar.requests.put_groups import PUT_GROUPS
from etot_cli.reasoning.language.grammar.requests.taking import SOURCE
from etot_cli.reasoning.language.grammar.requests.word_order import (
    ANNOUNCED,
)
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    PickClause,
    PutClause,
    PutGroup,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    FILLED,
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import places


def put_down(groups: tuple[PutGroup, ...], extras: Any) -> PutClause | None:
    """Each thing to its place; "cup off the tray, tray in the box" does not send both there."""
    for np in (np for group in groups for np in group.things.phrases[:-1]):
        if {"off", "out"} & {*np.text.split()[1:]}:
            return None
    put = put_of(groups, extras)
    return replace(put, far_fetched=put.far_fetched + 1) if put and lies_flat(groups) else put


def _listed(place: NounPhrase, things: Things) -> PutClause | None:
    """What a table says of a place; "teapot: tray" rather says where the teapot goes, and "mugs on
    the tray: the white ones" which go there.
    """
    which = place.modifiers and any(np.is_elliptic for np in things.phrases)
    put = put_to(things, (Destination(Toward.TO, (place,), FILLED),))
    return None if which else replace(put, far_fetched=1)


_UP = "[back] (up|down|over|off|away)"
VERBLESS = either(
    sequence(noun_phrase, COLON, ALL_THINGS, build=_listed),
    ANNOUNCED,
    sequence(
        # "Into the bin with it"
        silent(optional(_UP)),
        either(INTO, ONTO),
        "with",
        ALL_THINGS,
        build=lambda where, things: put_to(things, (where,)),
    ),
    sequence(
        # "Up with it onto the shelf"
        _UP,
        "with",
        ALL_THINGS,
        either(INTO, ONTO),
        build=lambda things, where: put_to(things, (where,)),
    ),
    sequence(
        ALL_THINGS,
        sequence(SOURCE, LIST, either(DIRECTED, DESTINATIONS)),
        build=lambda things, moved: PutClause((brought(things, *moved),)),
    ),
    sequence(
        # "Apple, from the desk to the bowl"
        ALL_THINGS,
        COMMA,
        SOURCE,
        OPTIONAL_COMMA,
        DIRECTED,
        build=lambda things, *moved: PutClause((brought(things, *moved),)),
    ),
    sequence(
        # "One pen, please, picked up from the tray"
        ALL_THINGS,
        OPTIONAL_COMMA,
        "picked up",
        optional(SOURCE, ""),
        build=lambda things, source: PickClause(things.taken_from(source or None)),
    ),
    sequence(PUT_GROUPS, EXTRAS, build=put_down),
    sequence(
        # "Candles on either side of the vase"
        ALL_THINGS,
        ON_BOTH_SIDES,
        noun_phrase,
        silent(optional(places.ONE_AT_EACH_SIDE)),
        build=flanking,
    ),
    sequence(
        FIRST_THEN,
        silent(optional(either(COMMA, COLON))),
        silent(optional("both, all")),
        DESTINATIONS,
        silent(optional("with (them|both) [of them]")),
        build=put_in_turn,
    ),
    sequence(
        NP_LIST,
        RESPECTIVE_PLACES,
        build=lambda nps, where: None if (g := respective(nps, where)) is None else PutClause(g),
    ),
)
"""Places for things without a word for doing; only whole sentences are so."""

"""Rules for what is told first "with" a request: how things are by then, what the target is."""

from __future__ import annotations

from itertools import chain
from operator import add

from etot_cli.reasoning.language.grammar.conditions.left_alone import UNTOUCHED
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    located,
    one_of,
    optional,
    sequence,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COLON,
    COMMA,
    LIST,
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.phrases.staying import WITH_KEPT_SO
from etot_cli.reasoning.language.grammar.requests.arrangements import STANDS_UP
from etot_cli.reasoning.language.grammar.requests.taking import SOURCE
from etot_cli.reasoning.language.grammar.sentences.before_and_after import once_done
from etot_cli.reasoning.language.grammar.sentences.chains import CHAIN
from etot_cli.reasoning.language.grammar.sentences.headlines import taken_out
from etot_cli.reasoning.language.grammar.sentences.past import SO
from etot_cli.reasoning.language.grammar.sentences.spoken import Reading, Spoken, plain
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    EnsureClause,
    MoveClause,
    RemoveClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    FILLED,
    Destination,
    NounPhrase,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import places, predicates, verbs

_TARGET = either(
    sequence("with, using, taking", noun_phrase, f"as [the|a|its|your] ({places.TARGET})"),
    sequence(f"the ({places.TARGET}) is", noun_phrase),
)
_DONE_BEFORE = optional(sequence(CHAIN, LIST), ())
_SET_DOWN = located(sequence(verbs.SET_DOWN, THINGS), lambda at, things: (at, things))


def _to_the_target(np: NounPhrase, before: Reading, at: int, things: Things) -> Reading:
    """What is put down with no place said goes to the one that is named as the target."""
    return (*before, Spoken(put_to(things, (Destination(Toward.TO, (np,), FILLED),)), at))


def _holding(content: NounPhrase, toward: Toward, rest: Reading) -> Reading | None:
    """What something is to hold that is told next to be somewhere, or is closed then ("with the pen
    in it, the mug should stand on the tray"); of what was spoken of before, "it" rather is that.
    """
    clause = rest[0].clause
    match clause:
        case EnsureClause(states=(State(subjects=(first, *more), destinations=(_, *_)), *_)):
            closed = False
        case (
            MoveClause(things=Things(phrases=(first, *more)), opens=False)
            | EnsureClause(states=(State(subjects=(first, *more), word="closed"),))
        ):
            closed = True
        case _:
            return None
    known = first.words and first.determiner in ("the", "") and not first.modifiers
    if more or not known or content.pronoun:
        return None
    held = EnsureClause((State((content,), (Destination(toward, (first,)),)),))
    if closed:
        return once_done((Spoken(held, rest[0].position, far_fetched=1),), rest)
    return (rest[0], Spoken(held, rest[0].position, far_fetched=1), *rest[1:])


_SO_BY_THEN = plain(
    either(
        SO,
        sequence(ALL_THINGS, build=taken_out),
        sequence(
            ALL_THINGS,
            optional(f"{predicates.BE}, out of the way, staying, safely, {predicates.DONE}"),
            DESTINATIONS,
            build=put_to,
        ),
        sequence(ALL_THINGS, predicates.TAKEN_AWAY, optional(SOURCE, None), build=RemoveClause),
        sequence(
            ALL_THINGS,
            "[safely] [moved|put] (out of the way|aside)",
            build=lambda things: RemoveClause(things, by_then=True, aside=True),
        ),
        STANDS_UP,
        UNTOUCHED,
    )
)
"""How things are by then, behind "with" ("with the drawer open, …")."""
WITH_SO = either(
    sequence(
        # "With the drawer kept shut, …"
        plain(WITH_KEPT_SO),
        COMMA,
        CHAIN,
        build=add,
    ),
    sequence(
        "with",
        _SO_BY_THEN,
        some(sequence(LIST, optional("with"), _SO_BY_THEN), most=3),
        COMMA,
        CHAIN,
        build=lambda first, more, rest: once_done((*first, *chain(*more)), rest),
    ),
    sequence(
        "with",
        noun_phrase,
        one_of(
            {
                Toward.INSIDE: "[already|safely|still] (in|inside) it, [safely|still] inside",
                Toward.ON: "[already|safely|still] on [top of] it, [still] on top",
            }
        ),
        COMMA,
        CHAIN,
        build=_holding,
    ),
    sequence(
        # "With the cup as the target, pick up the ball and place it"
        _TARGET,
        either(COMMA, COLON),
        _DONE_BEFORE,
        _SET_DOWN,
        build=lambda np, before, put: _to_the_target(np, before, *put),
    ),
    sequence(
        _DONE_BEFORE,
        _SET_DOWN,
        OPTIONAL_COMMA,
        _TARGET,
        build=lambda before, put, np: _to_the_target(np, before, *put),
    ),
)

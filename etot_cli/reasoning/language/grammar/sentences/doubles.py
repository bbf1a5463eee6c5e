"""Rules for what asks for two things at once: first open and then closed, these and not those."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.ensuring import ENSURE
from etot_cli.reasoning.language.grammar.conditions.prohibitions import WITHOUT
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    located,
    one_of,
    optional,
    phrase,
    separated,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    LIST,
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.being_so import OPEN_OR_CLOSED
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.requests.emptying import contents_of
from etot_cli.reasoning.language.grammar.requests.putting import PUT
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Reading, Spoken
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Avoid,
    AvoidClause,
    Clause,
    EnsureClause,
    MoveClause,
    PutClause,
    PutGroup,
    RemoveClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, State, Things, Toward
from etot_cli.reasoning.language.words import forbidden, manner, predicates, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.reasoning.language.words.places import Prep


def _its(np: NounPhrase) -> NounPhrase:
    """The lid for "its lid", as there is one."""
    return replace(np, determiner="the") if np.determiner == "its" else np


LEFT_BEHIND = either(
    sequence(
        "[but] without",
        NP_LIST,
        silent(optional("[still] (in|inside|on) (it|there), inside")),
        build=lambda nps: tuple(map(_its, nps)),
    ),
    phrase("[but] without its contents", Prep.OF),
    sequence(
        """
        [but] without (anything|everything|whatever|whatever is|what is|that is) [still|left],
        [but] with nothing [left]
        """,
        one_of({Prep.IN: "in, inside", Prep.ON: "on"}),
        "it",
        build=lambda prep: prep,
    ),
)
"""Behind what goes somewhere, what of that does not; where all that is not is."""


def bared(
    orders: tuple[Order | bool, ...], put: tuple[int, PutClause], out: tuple[NounPhrase, ...] | Prep
) -> Reading | None:
    """Who puts a mug somewhere "without the pen" takes the pen out of it first; what is to be on a
    tray "with nothing in it" is rather empty itself than on a tray that is.
    """
    at, clause = put
    (theme, *more) = clause.groups[0].things.phrases
    if {*orders} - {Order.THEN} or more or clause.groups[1:]:
        return None
    if isinstance(out, Prep):
        held = Things((contents_of(theme, Prep.ON if out is Prep.ON else Prep.FROM),))
        taken = RemoveClause(held, without=True, by_then=True)
        upon = all(item.toward is Toward.ON for item in clause.groups[0].destinations)
        rather = out is Prep.IN and upon
        clause = replace(clause, far_fetched=clause.far_fetched - rather)
    else:
        taken = RemoveClause(Things(out), theme, without=True)
    return (Spoken(taken, at, Order.THEN if orders else Order.SAID), Spoken(clause, at))


def with_others(
    orders: tuple[Order | bool, ...], put: tuple[int, Clause], more: tuple[int, Clause]
) -> Reading | None:
    """What goes somewhere, and then others beside it."""
    at, clause = put
    return None if orders else (Spoken(clause, at), Spoken(more[1], more[0]))


def _only_these(out: Things, where: Any, joint: str, meant: Things) -> tuple[Clause, ...] | None:
    """What is not to go somewhere, and what is ("…, only the green one")."""
    only = all(np.determiner.startswith("only") for np in meant.phrases)
    avoided = AvoidClause(Avoid.PUT, out, where, negated=True)
    return (avoided, put_to(meant, where)) if joint or only else None


NEITHER = sequence(verbs.PUT, "neither", separated(noun_phrase, "nor"), build=Things)
ONLY_THESE = located(
    sequence(
        either(sequence(forbidden.DO_NOT, verbs.PUT, THINGS), NEITHER),
        DESTINATIONS,
        OPTIONAL_COMMA,
        optional(phrase("but, just, but just"), ""),
        THINGS,
        build=_only_these,
    ),
    lambda at, clauses: tuple(Spoken(clause, at) for clause in clauses),
)
_OPENED_OR_CLOSED = one_of({True: verbs.OPEN, False: verbs.CLOSE})


def _both_ways(first: bool, opens: bool, things: Things) -> tuple[Clause, Clause] | None:
    """Of the same things it is first one and then the other ("open, then close the drawer")."""
    known = all(np.determiner in ("the", "both", "") for np in things.phrases)
    ways = (MoveClause(things, first), MoveClause(things, opens))
    return ways if known and not things.either and first != opens else None


BOTH_WAYS = located(
    sequence(
        _OPENED_OR_CLOSED,
        either(sequence(OPTIONAL_COMMA, small_words.THEN_JOINTS, OPTIONAL_COMMA), "and"),
        _OPENED_OR_CLOSED,
        THINGS,
        build=_both_ways,
    ),
    lambda at, ways: (Spoken(ways[0], at), Spoken(ways[1], at, Order.THEN)),
)


_AGAIN = "[back] again, [back] up"


def so_in_turn(subject: Parser) -> Parser:
    """What is to be open, or closed, at first and the opposite afterwards."""
    first, then = (
        either(
            sequence(said, OPEN_OR_CLOSED),
            one_of({"open": f"{need}opening", "closed": f"{need}(closing|shutting)"}),
        )
        for said, need in (
            (predicates.MODAL, "need[s] "),
            (optional(f"{predicates.MODAL}, be"), ""),
        )
    )
    return located(
        sequence(
            subject,
            first,
            either(
                sequence(phrase(small_words.TRAILING_FIRST, Order.FIRST), LIST, optional("then")),
                sequence(OPTIONAL_COMMA, phrase("[and] then", Order.SAID)),
            ),
            then,
            optional(_AGAIN),
            optional(small_words.TRAILING_THEN),
            build=_so_in_turn,
        ),
        lambda at, said: tuple(Spoken(clause, at, order) for clause, order in said),
    )


def _so_in_turn(
    nps: tuple[NounPhrase, ...], first: str, order: Order, then: str
) -> tuple[tuple[Clause, Order], ...] | None:
    ways = ((first, order), (then, Order.THEN))
    so = tuple((EnsureClause((State(nps, word=word),)), when) for word, when in ways)
    return so if first != then else None


IN_TURN = so_in_turn(NP_LIST)


PARENTHETIC = either(
    located(
        sequence(
            # "Move the pen, without touching the book, to the tray"
            either(sequence(verbs.SET_DOWN, THINGS), sequence(ALL_THINGS, predicates.MODAL)),
            WITHOUT,
            COMMA,
            DESTINATIONS,
            build=lambda things, avoided, where: (put_to(things, where), avoided),
        ),
        lambda at, clauses: tuple(Spoken(clause, at) for clause in clauses),
    ),
    located(
        sequence(
            # "Move the mug, without the pen in it, to the tray"
            verbs.SET_DOWN,
            THINGS,
            COMMA,
            LEFT_BEHIND,
            COMMA,
            DESTINATIONS,
            build=lambda things, out, where: (put_to(things, where), out),
        ),
        lambda at, said: bared((), (at, said[0]), said[1]),
    ),
)


def on_one_place(clause: Clause) -> Clause | None:
    """What lies on one place anyway is on nothing else; that is said of what comes last."""
    match clause:
        case PutClause(groups=(*_, PutGroup(things=Things(phrases=nps), destinations=(where,)))):
            pass
        case EnsureClause(states=(State(subjects=nps, destinations=(where,)),)):
            pass
        case _:
            return None
    several = nps[1:] or nps[0].determiner.split()[:1] in (["every"], ["each"], ["all"], ["both"])
    several = several or singular(nps[0].head) != nps[0].head
    below = {singular(np.head) for np in where.targets}
    upon = where.toward is Toward.ON and len(where.targets) == 1 and not where.denied
    upon = upon and not below & {singular(np.head) for np in nps}
    return clause if several and upon else None


SIDE_BY_SIDE = sequence(either(PUT, ENSURE), OPTIONAL_COMMA, manner.NOT_STACKED, build=on_one_place)
"""Several things on one place, none of them on another one."""


def _only_placed(clause: Clause) -> Clause | None:
    """What goes to one place, where it may be already."""
    match clause:
        case PutClause(groups=(PutGroup(destinations=(_,)),), conditions=()):
            return clause
        case EnsureClause(states=(State(destinations=(_,), denied=False, kept=False),)):
            return clause
    return None


UNLESS_THERE = sequence(
    either(PUT, ENSURE), OPTIONAL_COMMA, manner.UNLESS_THERE, build=_only_placed
)
"""What goes somewhere with a condition that its place answers itself."""

"""Rules for clauses: one thing that is asked for, with what stands before and behind it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from etot_cli.reasoning.language.grammar.arrangements import REORIENT, SWAP, TOWER
from etot_cli.reasoning.language.grammar.common import COMMA, EMPTY_WORDS, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.destinations import DESTINATIONS, DIRECTED
from etot_cli.reasoning.language.grammar.modifiers import (
    APPOSED,
    CONTRASTED,
    ONLY_THOSE,
    excepting,
    exceptions,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.moving import MOVE
from etot_cli.reasoning.language.grammar.noun_phrases import ALL_THINGS, NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    Parser,
    Rule,
    either,
    located,
    one_of,
    optional,
    phrase,
    separated,
    sequence,
    some,
    variants,
)
from etot_cli.reasoning.language.grammar.predicates import BOTH_SO
from etot_cli.reasoning.language.grammar.prohibitions import AVOID, KEEP_OUT, KEEP_STILL, WITHOUT
from etot_cli.reasoning.language.grammar.put_groups import PUT_GROUP
from etot_cli.reasoning.language.grammar.putting import PUT
from etot_cli.reasoning.language.grammar.spoken import Order, Spoken
from etot_cli.reasoning.language.grammar.states import ENSURE
from etot_cli.reasoning.language.grammar.syntax import (
    AgainClause,
    Avoid,
    AvoidClause,
    Clause,
    Destination,
    EnsureClause,
    Modifier,
    MoveClause,
    NounPhrase,
    PickClause,
    PutClause,
    PutGroup,
    RemoveClause,
    Things,
    Toward,
    TowerClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.taking import (
    COVER,
    EMPTY,
    FILL,
    HAND_OVER,
    PICK,
    REMOVE,
    SOURCE,
)
from etot_cli.reasoning.language.grammar.wishes import THOUGHT, TOLD_APART, WISHED
from etot_cli.reasoning.language.words import manner, nouns, small_words, verbs


def _wanted_in_hand(things: Things) -> PickClause | None:
    """Who wants something off the tray does not say that it is to be held."""
    away = any({"off", "out", "gone"} & {*np.text.split()} for np in things.phrases)
    return None if away else PickClause(things)


WANTED = either(
    sequence(
        either(sequence(verbs.LET, ALL_THINGS, verbs.LET_BE), sequence("have", ALL_THINGS)),
        DESTINATIONS,
        build=put_to,
    ),
    sequence(
        "have, let",
        ALL_THINGS,
        "join",
        noun_phrase,
        build=lambda things, np: put_to(things, (Destination(Toward.WITH, (np,), "join"),)),
    ),
    sequence(verbs.WANTED, ALL_THINGS, verbs.TAKEN, SOURCE, build=RemoveClause),
    sequence(verbs.WANTED, ALL_THINGS, verbs.GONE, noun_phrase, build=RemoveClause),
    sequence(
        ALL_THINGS,
        f"{verbs.MODAL}, {verbs.COME_AWAY}",
        optional("gone"),
        SOURCE,
        build=RemoveClause,
    ),
    sequence(ALL_THINGS, verbs.COME_AWAY, "out, off, down", build=RemoveClause),
    sequence(ALL_THINGS, verbs.COME_AWAY, "out, off, down, over", DIRECTED, build=put_to),
    sequence(
        verbs.WANT, ALL_THINGS, optional("[to be] (picked up|lifted [up])"), build=_wanted_in_hand
    ),
)
AGAIN = either(
    sequence(small_words.SAME_AGAIN, THINGS, build=AgainClause),
    sequence(THINGS, small_words.ALSO, build=lambda things: AgainClause(things, trailing=True)),
    sequence(
        "add[ing]",
        THINGS,
        optional(small_words.ALSO),
        build=lambda things: AgainClause(things, added=True),
    ),
)


def excluding(clause: Clause, left_out: Modifier, at: int = -1) -> Clause | None:
    """A clause without some of the things that it is about ("…, except the blue one"), of those
    that its last phrase means, or that ``at`` an index.
    """

    def without(things: Things) -> Things:
        phrases = [*things.phrases]
        phrases[at] = phrases[at].told_by(left_out)
        return replace(things, phrases=tuple(phrases))

    match clause:
        case PutClause(groups=(group,)):
            return replace(clause, groups=(replace(group, things=without(group.things)),))
        case EnsureClause(states=(state,)):
            return EnsureClause((replace(state, subjects=without(Things(state.subjects)).phrases),))
        case (
            PickClause(things=things)
            | RemoveClause(things=things)
            | MoveClause(things=things)
            | TowerClause(things=things)
            | AgainClause(things=Things() as things)
        ):
            return replace(clause, things=without(things))
    return None


Reading = tuple[Spoken, ...]


def plain(parser: Parser, order: Order = Order.SAID) -> Parser:
    """A clause with nothing around it, as a reading."""
    return located(parser, lambda at, clause: (Spoken(clause, at, order),))


def _excluding_some(said: tuple[Clause, Modifier]) -> list[Clause]:
    """A clause without some of the things that any of its phrases means."""
    match said[0]:
        case PutClause(groups=(PutGroup(things=things),)) | PickClause(things=things):
            found = [excluding(*said, at) for at in range(len(things.phrases))]
        case _:
            found = [excluding(*said)]
    return [way for way in found if way is not None]


LEFT_OUT = either(
    sequence(
        f"{nouns.EXCEPT}, without, any [one] but",
        exceptions,
        build=excepting,
    ),
    sequence(optional("but"), ONLY_THOSE),
    sequence(
        "[but|and] leav(e|ing) [out], [but|and] keep[ing]",
        exceptions,
        optional(f"{manner.AS_IT_IS}, out"),
        build=excepting,
    ),
)


def of_the_things(clause: Clause, said: Modifier) -> Clause | None:
    """What stands behind a place is said of what goes there only if it cannot be of the place."""
    found = excluding(clause, said)
    return replace(found, far_fetched=1) if isinstance(found, PutClause | EnsureClause) else found


def _but_some(clause: PutClause, group: PutGroup) -> Clause | None:
    """All of them go to one place but for some that go to another."""
    out = excepting(group.things.phrases)
    found = None if out is None or group.things.either else excluding(clause, out)
    return replace(found, groups=(*found.groups, group)) if isinstance(found, PutClause) else None


_ELSEWHERE = sequence(
    nouns.EXCEPT,
    exceptions,
    "~comma which",
    verbs.MODAL,
    DESTINATIONS,
    build=lambda nps, where: PutGroup(Things(nps), where),
)
"""What goes to another place ("…, except the blue one, which goes on the mat")."""
_ASKED = Rule(
    either(
        *(PICK, PUT, REMOVE, EMPTY, MOVE, ENSURE, WANTED, COVER, REORIENT, TOWER, SWAP, AVOID),
        *(KEEP_STILL, KEEP_OUT, AGAIN, FILL, HAND_OVER, WISHED, THOUGHT, TOLD_APART, BOTH_SO),
    )
)
INSTEAD = phrase(small_words.INSTEAD, True)
CLAUSE = located(
    sequence(
        EMPTY_WORDS,
        either(
            _ASKED,
            variants(sequence(_ASKED, OPTIONAL_COMMA, LEFT_OUT), _excluding_some),
            sequence(
                either(PUT, ENSURE, AGAIN, WISHED, TOLD_APART),
                OPTIONAL_COMMA,
                either(CONTRASTED, APPOSED),
                build=of_the_things,
            ),
            sequence(
                PUT, OPTIONAL_COMMA, either(sequence("but", PUT_GROUP), _ELSEWHERE), build=_but_some
            ),
        ),
        EMPTY_WORDS,
        optional(phrase(small_words.TRAILING_FIRST, Order.FIRST), None),
        optional(phrase(small_words.TRAILING_LAST, Order.LAST), None),
        optional(phrase(small_words.TRAILING_THEN, Order.THEN), None),
        EMPTY_WORDS,
        optional(INSTEAD, False),
        some(WITHOUT, most=3),
        build=lambda clause, first, last, then, instead, avoided: (
            None
            if sum(item is not None for item in (first, last, then)) > 1
            else (clause, first or last or then, instead, avoided)
        ),
    ),
    lambda at, found: (at, *found),
)
ORDER_WORDS = one_of(
    {
        Order.FIRST: small_words.LEADING_FIRST,
        Order.BEFORE_THAT: small_words.LEADING_BEFORE,
        Order.LAST: small_words.LEADING_LAST,
        Order.THEN: small_words.LEADING_THEN,
    }
)
LEAD = sequence(
    some(
        either(
            small_words.FRAMES,
            small_words.WITHOUT_MEANING,
            sequence(either(ORDER_WORDS, INSTEAD), OPTIONAL_COMMA),
            COMMA,
        ),
        most=6,
    )
)


def _spoken(leading: tuple[Order | bool, ...], found: Any) -> Reading | None:
    """A clause with what must not be done on the way."""
    at, clause, order, instead, avoided = found
    orders = [item for item in (*leading, order) if isinstance(item, Order)]
    said = list(dict.fromkeys(orders))
    strong = [item for item in said if item is not Order.THEN]
    if len(strong) > 1:
        return None
    when = strong[0] if strong else (said[0] if said else Order.SAID)
    instead = instead or True in leading
    return (Spoken(clause, at, when, instead), *(Spoken(item, at) for item in avoided))


def _bared(
    orders: tuple[Order | bool, ...], put: tuple[int, PutClause], out: tuple[NounPhrase, ...]
) -> Reading | None:
    """Who puts a mug somewhere "without the pen" takes the pen out of it first."""
    at, clause = put
    (theme, *more) = clause.groups[0].things.phrases
    if orders or more or clause.groups[1:]:
        return None
    return (Spoken(RemoveClause(Things(out), theme, without=True), at), Spoken(clause, at))


def _only_these(out: Things, where: Any, joint: str, meant: Things) -> tuple[Clause, ...] | None:
    """What is not to go somewhere, and what is ("…, only the green one")."""
    only = all(np.determiner.startswith("only") for np in meant.phrases)
    avoided = AvoidClause(Avoid.PUT, out, where, negated=True)
    return (avoided, put_to(meant, where)) if joint or only else None


_NEITHER = sequence(verbs.PUT, "neither", separated(noun_phrase, "nor"), build=Things)
_ONLY_THESE = located(
    sequence(
        either(sequence(verbs.DO_NOT, verbs.PUT, THINGS), _NEITHER),
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


_BOTH_WAYS = located(
    sequence(
        _OPENED_OR_CLOSED,
        either(sequence(OPTIONAL_COMMA, small_words.THEN_JOINTS, OPTIONAL_COMMA), "and"),
        _OPENED_OR_CLOSED,
        THINGS,
        build=_both_ways,
    ),
    lambda at, ways: (Spoken(ways[0], at), Spoken(ways[1], at, Order.THEN)),
)
LED_CLAUSE = Rule(
    either(
        sequence(LEAD, _BOTH_WAYS, build=lambda orders, said: None if orders else said),
        sequence(LEAD, CLAUSE, build=_spoken),
        sequence(LEAD, _ONLY_THESE, build=lambda orders, said: None if orders else said),
        plain(
            sequence(
                _NEITHER,
                DESTINATIONS,
                build=lambda out, where: AvoidClause(Avoid.PUT, out, where, negated=True),
            )
        ),
        sequence(
            LEAD,
            located(PUT, lambda at, clause: (at, clause)),
            OPTIONAL_COMMA,
            "without",
            NP_LIST,
            build=_bared,
        ),
    )
)

"""Rules for what comes before or after the rest of a sentence ("once the pen is in the box, …")."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    either,
    optional,
    sequence,
    some,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import COMMA
from etot_cli.reasoning.language.grammar.parsers.trees import nodes
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST
from etot_cli.reasoning.language.grammar.sentences.led_clauses import LED_CLAUSE
from etot_cli.reasoning.language.grammar.sentences.past import HAVING_DONE, SO_BY_THEN
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Reading, Spoken, plain
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Clause,
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    RemoveClause,
    ReorientClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    RECEIVER,
    Beside,
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import forbidden, small_words, verbs
from etot_cli.world.spatial import Nearby


def _by_then(reading: Reading) -> Reading:
    """With what has been taken away by then marked so."""
    clause = reading[0].clause
    if not isinstance(clause, RemoveClause):
        return reading
    return (replace(reading[0], clause=replace(clause, by_then=True)), *reading[1:])


def then_done(clause: Reading) -> Reading:
    """A reading that is to be done after what was said before."""
    first = clause[0]
    if first.order is Order.SAID:
        first = replace(first, order=Order.THEN)
    return (first, *clause[1:])


def out_of_the_way(things: Things, rest: Reading) -> Reading | None:
    """What is in the way of what is opened next goes away from that."""
    match rest[0].clause:
        case MoveClause(things=Things(phrases=(np,)), opens=True):
            away = Beside(Nearby.AWAY, (np,), f"out of the way of {np.text}")
            put = put_to(things, (Destination(Toward.BESIDE, beside=(away,)),))
            return (Spoken(put, -1), *then_done(rest))
    return None


def once_done(earlier: Reading, later: Reading) -> Reading:
    """What has been done by then, and what comes after it; what is out of the way by then is so for
    what is opened after it.
    """
    match [said.clause for said in earlier]:
        case [RemoveClause(things=things, aside=True)] if away := out_of_the_way(things, later):
            return away
    return (*earlier, *then_done(later))


def _done_with(clause: Clause) -> list[tuple[tuple[NounPhrase, ...], tuple[Destination, ...]]]:
    """What something is done with, and where that goes."""
    match clause:
        case PutClause(groups=groups):
            return [(group.things.phrases, group.destinations) for group in groups]
        case EnsureClause(states=states):
            return [(state.subjects, state.destinations) for state in states]
        case (
            MoveClause(things=things)
            | PickClause(things=things)
            | RemoveClause(things=things)
            | ReorientClause(things=things, not_yet=True)
        ):
            return [(things.phrases, ())]
    return []


def ahead_of(later: Reading, done: Reading) -> Reading | None:
    """What is done before anything is done with whatever it may be, which itself asks for nothing
    ("before you put anything in the box, open the drawer"); None where ``later`` asks for more.
    """
    (first, *more), (said, *_) = done, later
    found = _done_with(said.clause)
    if not any(
        np.determiner == "any" or np.words[-1:] in (("anything",), ("something",))
        for nps, _ in found
        for np in nps
    ):
        return None
    if first.order is Order.SAID:
        first = replace(first, order=Order.FIRST)
    places = tuple(np for _, where in found for at in where for np in at.targets if not np.pronoun)
    named = replace(said, clause=ReorientClause(Things(places), only_named=True))
    return (*((named,) if places else ()), first, *more)


def done_later(later: Reading, rest: Reading) -> Reading:
    """What is said ahead to come later, and the rest: after all of it, but for what needs open what
    is opened then ("before opening it, clear the tray, then put the pen in it").
    """
    if done := ahead_of(later, rest):
        return done
    opened = later[0].clause
    if isinstance(opened, MoveClause) and opened.opens:
        named = [{*np.words} for np in opened.things.phrases]
        for count, said in enumerate(rest):
            nps = (np for np in nodes(said) if isinstance(np, NounPhrase) and np.words)
            if count and any({*np.words} <= words for np in nps for words in named):
                return (*rest[:count], *then_done(later), *then_done(rest[count:]))
    return rest + then_done(later)


def same_receiver(first: Reading, rest: Reading) -> Reading:
    """A reading behind "before the box gets the pen": who "gets" more there is the same box."""
    (one, *more) = _receivers(first)
    if more or one is None or one.pronoun:
        return rest
    return tuple(replace(said, clause=_received_by(said.clause, one)) for said in rest)


def _receivers(reading: Reading) -> list[NounPhrase | None]:
    """What gets something by a reading; None where it is about anything else."""
    clause = reading[0].clause
    (where, *more) = clause.groups[-1].destinations if isinstance(clause, PutClause) else (None,)
    received = where is not None and where.word == RECEIVER and not more and not reading[1:]
    return [*where.targets] if where is not None and received else [None]


def _received_by(clause: Clause, one: NounPhrase) -> Clause:
    """A clause with what "it" is that gets something there."""
    if not isinstance(clause, PutClause):
        return clause
    groups = tuple(
        group.going_to(lambda np: one if np.pronoun == "it" else np)
        if all(item.word == RECEIVER for item in group.destinations)
        else group
        for group in clause.groups
    )
    return replace(clause, groups=groups)


def _gapped(nps: tuple[NounPhrase, ...], where: tuple[Destination, ...]) -> PutClause:
    return put_to(Things(nps), where)


DONE_BY_THEN = valued(
    either(
        sequence(optional("you have, having, you"), either(LED_CLAUSE, plain(HAVING_DONE))),
        plain(SO_BY_THEN),
    ),
    _by_then,
)
"""What has been done by then, behind "until" or "before"."""


def _not_touched_yet(nps: tuple[NounPhrase, ...]) -> ReorientClause:
    """What is but named; who is not to touch "any cup" yet touches none of them."""
    every = (replace(np, determiner="every") if np.determiner == "any" else np for np in nps)
    return ReorientClause(Things((*every,)), only_named=True, not_yet=True)


_TOUCHED = sequence(
    f"{forbidden.TOUCH}, do[ing] anything (to|with)", NP_LIST, build=_not_touched_yet
)
"""What is not touched before the rest is done, which asks for nothing of it yet."""
LATER = sequence(small_words.BEFORE, either(LED_CLAUSE, plain(SO_BY_THEN), plain(_TOUCHED)))
"""What comes after the rest of a sentence ("before the drawer is closed")."""
ALL_LATER = sequence(
    LATER,
    some(sequence("and [then], then", LED_CLAUSE), most=2),
    build=lambda first, more: sum(map(then_done, more), first),
)
"""Likewise, where the rest comes behind it ("before you open it and put the pen in, …")."""


_DO = frozenset(verb.split()[0] for verb in verbs.PAST.values()) | {"put", "set", "shut"}
_NO_ORDER = Parser(
    lambda given, at: (
        []
        if at > 1 and given.words[at - 1] == "after" and given.ahead[at] in _DO
        else [(at, NOTHING)]
    )
)
"""Nothing; behind a request "after put the cup there" may be meant for what comes then."""


def _earlier(between: Parser | str) -> Parser:
    return valued(
        either(
            sequence(small_words.AFTER, _NO_ORDER, either(LED_CLAUSE, plain(HAVING_DONE))),
            sequence(
                # "… have taken the pen off it and stood it in the cup"
                small_words.AFTER,
                plain(HAVING_DONE),
                "and [then]",
                plain(HAVING_DONE),
                build=lambda first, next_: first + then_done(next_),
            ),
            sequence("having [first|already|just|previously|beforehand]", plain(HAVING_DONE)),
            sequence(
                small_words.BY_THEN,
                plain(SO_BY_THEN),
                some(
                    sequence(
                        between,
                        # "… has been put on the tray and the pen in the cup"
                        plain(either(SO_BY_THEN, sequence(NP_LIST, DESTINATIONS, build=_gapped))),
                    ),
                    most=3,
                ),
                build=lambda first, more: sum(more, first),
            ),
        ),
        _by_then,
    )


_AND_ONCE = "and [(once|when|after|as soon as)]"
EARLIER = _earlier(sequence(optional(COMMA), _AND_ONCE))
"""What comes before the rest of a sentence."""
EARLIER_ALONE = _earlier(either("and", "[~comma] and (once|when|after|as soon as)"))
"""The same between commas, behind which something else is asked for."""

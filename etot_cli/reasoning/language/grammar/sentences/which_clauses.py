"""Rules for relative clauses that ask for something ("…, which you then close")."""

from __future__ import annotations

from functools import partial
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    located,
    one_of,
    optional,
    phrase,
    sequence,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.parsers.input import Input
from etot_cli.reasoning.language.grammar.phrases.being_so import OPEN_OR_CLOSED
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Reading, Spoken, plain
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Avoid,
    AvoidClause,
    Clause,
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    PutGroup,
    RemoveClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import predicates, small_words, verbs
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.places import Prep

WHICH = NounPhrase(pronoun="it", text="which")
"""What was named last; "open" and "close" are only said of what can be."""
THAT = either(phrase("which", WHICH), phrase("whose (door|doors|flap)", WHICH))
_AFTERWARDS = "then, afterwards, after that, later, in the end, finally, after use"
_WHEN = one_of(
    {
        Order.THEN: f"[and] {_AFTERWARDS}",
        Order.FIRST: "[and] (first|beforehand|before that|for (that|this)|to that end|in advance)",
    }
)
_ANY_TIME = optional(_WHEN, Order.SAID)
_OUGHT = """
    have to, need to, must, should, ought to, can, may, [will] (have|need) to, are to,
    are (asked|supposed|meant|requested) to, will, shall
"""
_OUGHT_TO_BE = """
    (has to|needs to|must|should|ought to|can|may|will [have to|need to]|is to|
    is (supposed|meant) to|shall) be, (has|needs) to get, gets
"""
_MOVING = one_of({True: f"{verbs.OPEN}, pull out", False: f"{verbs.CLOSE}, push (in|to)"})
_MOVED = one_of(
    {
        True: "opened [up], (pulled|slid|swung) open, pulled out",
        False: "closed [up], shut, (pushed|slid|swung) (shut|closed), pushed (in|to)",
    }
)
_TO_BE_MOVED = one_of({True: "opening [up]", False: "closing, shutting"})
_AGAIN = optional("again, back up")


def _moved(np: NounPhrase, *said: Order | bool) -> Spoken | None:
    """What is opened or closed, and when; what has to be opened is so before, which has to be said,
    for otherwise it may be to stay open.
    """
    (opens,) = (item for item in said if isinstance(item, bool))
    when = {item for item in said if isinstance(item, Order)} - {Order.SAID}
    if len(when) > 1 or (opens and not when):
        return None
    order = when.pop() if when else Order.THEN
    return Spoken(MoveClause(Things((np,)), opens), 0, order)


_OPENED_OR_CLOSED = either(
    sequence(
        THAT,
        either(
            sequence("you", _ANY_TIME, optional(_OUGHT)),
            "(i|we) (want|need|would like) you to [please]",
        ),
        _ANY_TIME,
        _MOVING,
        _AGAIN,
        _ANY_TIME,
        build=_moved,
    ),
    sequence(
        THAT,
        either(
            sequence(_OUGHT_TO_BE, _ANY_TIME),
            # "which is then to be closed", "which must first be opened"
            sequence(
                "is, has, needs, must, should, can, will",
                _WHEN,
                "be, to be, to get, have to be, need to be",
            ),
        ),
        _MOVED,
        _AGAIN,
        _ANY_TIME,
        build=_moved,
    ),
    sequence(
        # "which needs opening first"
        THAT,
        either("needs, requires, wants", sequence("will, would", "need, require")),
        _TO_BE_MOVED,
        _AGAIN,
        _ANY_TIME,
        build=_moved,
    ),
    # "which is closed" rather tells which; "which is then closed" asks for it.
    sequence(
        THAT,
        "is",
        either(sequence(_WHEN, _MOVED, _AGAIN), sequence(_MOVED, _AGAIN, _WHEN)),
        build=lambda np, said: _moved(np, *said),
    ),
)
_NEEDLESS = sequence(
    THAT,
    either(
        sequence(
            "you (need not|do not (need|have) to)",
            one_of({Avoid.CLOSE: verbs.CLOSE, Avoid.OPEN: verbs.OPEN}),
        ),
        sequence(
            "(need not|does not (need|have) to) be",
            one_of({Avoid.CLOSE: "closed, shut", Avoid.OPEN: "opened"}),
        ),
        phrase(
            "(can|may|might) (stay|remain|be (left|kept)) open, you (can|may) (leave|keep) open",
            Avoid.CLOSE,
        ),
    ),
    _AGAIN,
    optional(_AFTERWARDS),
    build=lambda np, avoid: AvoidClause(avoid, Things((np,)), negated=True, needless=True),
)
_ENDS_UP_SO = sequence(
    # "which should end up closed": be it so by then or not
    "which",
    "(has to|needs to|must|should|ought to|shall|is to) (end|finish|wind) up [being], ends up",
    OPEN_OR_CLOSED,
    build=lambda word: EnsureClause((State((WHICH,), word=word),)),
)
WHICH_IS_MOVED = either(
    located(
        _OPENED_OR_CLOSED,
        lambda at, spoken: (replace(spoken, position=at),),
    ),
    plain(either(_NEEDLESS, _ENDS_UP_SO)),
)
"""What is opened before, or closed afterwards, or need not be."""
_PUT_THERE = Things((WHICH,))
WHICH_GOES_ON = plain(
    sequence(
        "which",
        either(
            sequence("you (then|afterwards|finally)", verbs.SET_DOWN),
            sequence(
                f"((is|must|should|has) (then|afterwards|finally) [to] be|is (then|afterwards))"
                f" ({predicates.DONE_WITH_IT}), then (goes|has to go|must go)"
            ),
        ),
        DESTINATIONS,
        build=partial(put_to, _PUT_THERE),
    )
)
"""Where what was named last goes then; see ``named_last``."""
_GOES = "(stands|sits|rests|lies|goes|belongs|is)"
_TO_GO = f"(be [({predicates.DONE_WITH_IT})]|stand|sit|rest|lie|go|belong|end up)"
WHICH_IN_TURN_IS = plain(
    sequence(
        "which",
        f"(in turn|itself|then|for its part) {_GOES} [{predicates.DONE_WITH_IT}],"
        f" {_GOES} in turn, goes [itself],"
        f" (in turn|itself) (should|must|shall|has to|needs to|is to|ought to) {_TO_GO},"
        f" (should|must|shall|has to|needs to|is to|ought to) (in turn|itself) {_TO_GO},"
        f" (must|shall|has to|needs to|is to|ought to) {_TO_GO}, should (stand|sit|rest|lie|go)",
        DESTINATIONS,
        build=partial(put_to, _PUT_THERE),
    )
)
"""Where that in or on which something goes is to be itself ("in the cup, which in turn …"); what
"should be" there rather is so by now.
"""

_GOES_THERE = "(goes|go|should go|should be|must go|has to go|is to go|are to go)"
WHERE_MORE_GOES = plain(
    sequence(
        "where",
        either(
            sequence(
                ALL_THINGS,
                f"{_GOES_THERE} {small_words.ALSO}, also {_GOES_THERE}, (should|must) also (go|be)",
            ),
            sequence("(i|we) [would] also (want|need|like)", ALL_THINGS),
        ),
        build=lambda things: put_to(things, (Destination(Toward.HERE, word="there"),)),
    )
)
"""What goes where something else has just been put ("…, where the cup goes as well")."""


def _received(first: Things, more: tuple[Things, ...]) -> tuple[PutClause, ...]:
    inside = (Destination(Toward.INSIDE, (WHICH,)),)
    return tuple(put_to(things, inside) for things in (first, *more))


def _one_after_another(at: int, clauses: tuple[PutClause, ...]) -> Reading:
    return tuple(
        Spoken(clause, at + n, Order.THEN if n else Order.SAID) for n, clause in enumerate(clauses)
    )


_FIRST_GETS = sequence(
    "which",
    either(
        "(must|should|has to|needs to|is to) (first|beforehand) (receive|get|be given)",
        "first (receives|gets)",
    ),
    ALL_THINGS,
    some(sequence(OPTIONAL_COMMA, "and then, then", ALL_THINGS), most=3),
    build=_received,
)


def _gets_all(given: Input, at: int) -> list[tuple[int, Any]]:
    """What comes "and then" goes in as well: it is not done after all the rest."""
    found = list(_FIRST_GETS.find(given, at))
    return [item for item in found if item[0] == max(end for end, _ in found)]


WHICH_FIRST_GETS: Parser = located(Parser(_gets_all, lambda: _FIRST_GETS.first), _one_after_another)
"""What goes into what was named last before anything is done with that."""


def held_by(before: Clause, clause: Clause) -> Clause | None:
    """What goes on, with a name for "which": what something goes into or onto before it."""
    match before:
        case EnsureClause(states=(State(destinations=(where,), denied=False) as state,)):
            if state.alone:
                return None  # "nothing on the tray except the spoon, which …" is about the spoon
            before = put_to(Things(state.subjects), (where,))
        case PutClause(groups=(PutGroup(destinations=(where,)),)):
            pass
        case _:
            return None
    return named_last(before, clause) if where.targets and not where.denied else None


def _is_left_out_behind(things: Things) -> bool:
    """Whether what is left out is named last ("in the box, but not the cup, which …")."""
    return any(
        np.text not in phrase.text
        for phrase in things.phrases
        for item in phrase.modifiers
        if item.prep in (Prep.EXCEPT, Prep.CONTRAST)
        for np in item.phrases
    )


def named_last(before: Clause, clause: Clause) -> Clause | None:
    """What goes on, with a name for "which": what stands last in the clause before it; None where
    that may be several things, or another one of its kind.
    """
    match before:
        case PutClause(groups=(group,)) if len(group.destinations) == 1:
            (where,) = group.destinations
            nps = where.targets or group.things.phrases
            if where.beside or _is_left_out_behind(group.things):
                return None
        case PickClause(things=Things(phrases=nps)) | RemoveClause(things=Things(phrases=nps)):
            if isinstance(before, RemoveClause) and before.source is not None:
                return None
        case _:
            return None
    np = nps[0]
    if len(nps) > 1 or np.pronoun or np.modifiers or np.determiner not in THE_WORDS:
        return None
    match clause:
        case PutClause(groups=(group,)):
            return replace(clause, groups=(replace(group, things=Things((np,))),))
    return None

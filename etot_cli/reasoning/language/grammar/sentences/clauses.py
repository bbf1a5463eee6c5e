"""Rules for clauses: one thing that is asked for, with what stands before and behind it."""

from __future__ import annotations

from itertools import takewhile
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.ensuring import ENSURE
from etot_cli.reasoning.language.grammar.conditions.left_alone import KEEP_STILL
from etot_cli.reasoning.language.grammar.conditions.permitted import ONLY_THESE_MAY
from etot_cli.reasoning.language.grammar.conditions.predicates import BOTH_SO
from etot_cli.reasoning.language.grammar.conditions.prohibitions import AVOID, KEEP_OUT, WITHOUT
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    Rule,
    either,
    located,
    one_of,
    optional,
    phrase,
    sequence,
    some,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    EMPTY_WORDS,
    OPTIONAL_COMMA,
    exceptions,
)
from etot_cli.reasoning.language.grammar.parsers.input import NO_WORD, Input, Result
from etot_cli.reasoning.language.grammar.phrases.contrasts import (
    CONTRASTED,
    LEAVING_OUT,
    LEFT,
    NONE_OF_THEM,
    ONLY_THOSE,
    excepting,
    without_such,
)
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.exclusions import (
    but_some,
    excluding,
    of_the_things,
)
from etot_cli.reasoning.language.grammar.phrases.modifiers import APPOSED
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.requests.arrangements import REORIENT, SWAP
from etot_cli.reasoning.language.grammar.requests.emptying import EMPTY
from etot_cli.reasoning.language.grammar.requests.filling import COVER, FILL
from etot_cli.reasoning.language.grammar.requests.flanking import FLANKED
from etot_cli.reasoning.language.grammar.requests.grasping import GRASP
from etot_cli.reasoning.language.grammar.requests.holding import HOLD
from etot_cli.reasoning.language.grammar.requests.moves import MOVE
from etot_cli.reasoning.language.grammar.requests.put_groups import PUT_GROUP
from etot_cli.reasoning.language.grammar.requests.putting import PUT
from etot_cli.reasoning.language.grammar.requests.reaching import REACHED
from etot_cli.reasoning.language.grammar.requests.taking import (
    HAND_OVER,
    NEEDED,
    PICK,
    REMOVE,
)
from etot_cli.reasoning.language.grammar.requests.towers import TOWER
from etot_cli.reasoning.language.grammar.requests.unstacking import REVERSED, SPREAD
from etot_cli.reasoning.language.grammar.sentences.doubles import (
    BOTH_WAYS,
    IN_TURN,
    NEITHER,
    ONLY_THESE,
    PARENTHETIC,
    SIDE_BY_SIDE,
    UNLESS_THERE,
    bared,
    with_others,
)
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Spoken
from etot_cli.reasoning.language.grammar.sentences.togetherness import IN_ONE_PLACE
from etot_cli.reasoning.language.grammar.sentences.wishes import TOLD_APART, WANTED, WISHED
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AgainClause,
    Avoid,
    AvoidClause,
    Clause,
    EnsureClause,
    PickClause,
    PutClause,
    PutGroup,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import (
    fillers,
    frames,
    manner,
    nouns,
    predicates,
    small_words,
    verbs,
)
from etot_cli.reasoning.language.words.known import LINKS
from etot_cli.reasoning.language.words.patterns import words_of

AGAIN = either(
    sequence(small_words.SAME_AGAIN, THINGS, build=AgainClause),
    sequence(
        THINGS,
        optional("(should|must|shall|can|may|does|do) [go|be]"),
        small_words.ALSO,
        optional(sequence(OPTIONAL_COMMA, phrase(manner.NOT_STACKED, True)), False),
        build=lambda things, apart: AgainClause(things, trailing=True, side_by_side=apart),
    ),
    sequence(
        "add[ing]",
        THINGS,
        optional(small_words.ALSO),
        build=lambda things: AgainClause(things, added=True),
    ),
)


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
    sequence(LEAVING_OUT, exceptions, LEFT, build=without_such),
    sequence("without, any [one] but", exceptions, LEFT, build=excepting),
    sequence(optional("but"), ONLY_THOSE),
    NONE_OF_THEM,
    sequence(
        "[but|and] leav(e|ing) [out], [but|and] keep[ing]",
        exceptions,
        optional("out"),
        build=excepting,
    ),
)


_WHICH_GOES = sequence("~comma which", predicates.MODAL, DESTINATIONS)


_ELSEWHERE = sequence(
    nouns.EXCEPT,
    exceptions,
    _WHICH_GOES,
    build=lambda nps, where: PutGroup(Things(nps), where),
)
"""What goes to another place ("…, except the blue one, which goes on the mat")."""


def _making_room(clause: PutClause, where: tuple[Destination, ...]) -> PutClause | None:
    """What makes room for something else goes to another place ("…, which goes on the mat")."""
    at = [item for item in clause.groups[-1].destinations if item.toward is Toward.STEAD]
    away = (PutGroup(Things(item.targets), where) for item in at)
    return replace(clause, groups=(*clause.groups, *away)) if len(at) == 1 else None


_MEANWHILE = frozenset({"holding", "gripping", "grasping", "clutching", "clasping"})
"""Beside something else ("holding the pen, open the drawer") they say what the hand does then."""
_NOT_MEANWHILE = Parser(
    lambda given, at: (
        []
        if given.ahead[at] in _MEANWHILE
        and (given.words[at - 1] == COMMA if at else COMMA in given.words)
        else [(at, NOTHING)]
    )
)


_ASKED = Rule(
    either(
        *(
            sequence(_NOT_MEANWHILE, PICK),
            PUT,
            REMOVE,
            EMPTY,
            MOVE,
            ENSURE,
            WANTED,
            COVER,
            REORIENT,
            TOWER,
            SWAP,
            AVOID,
        ),
        *(
            KEEP_STILL,
            KEEP_OUT,
            AGAIN,
            FILL,
            HAND_OVER,
            NEEDED,
            sequence(_NOT_MEANWHILE, HOLD),
            WISHED,
            TOLD_APART,
            BOTH_SO,
        ),
        *(SPREAD, REVERSED, ONLY_THESE_MAY, GRASP, REACHED, IN_ONE_PLACE),
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
                PUT, OPTIONAL_COMMA, either(sequence("but", PUT_GROUP), _ELSEWHERE), build=but_some
            ),
            sequence(PUT, _WHICH_GOES, build=_making_room),
            SIDE_BY_SIDE,
            UNLESS_THERE,
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


_AFTER_ONE = ("in", "on", "into", "onto", "to", "goes", "should", "must", "belongs", NO_WORD)


def _not_of_one(given: Input, at: int) -> list[Result]:
    """Nothing, where "one" is the thing that comes first or next ("first one in the box")."""
    one = given.ahead[at] == "one" and given.ahead[at + 1] in _AFTER_ONE
    return [] if one else [(at, NOTHING)]


NOT_OF_ONE = Parser(_not_of_one)
ORDER_WORDS = sequence(
    one_of(
        {
            Order.FIRST: small_words.LEADING_FIRST,
            Order.BEFORE_THAT: small_words.LEADING_BEFORE,
            Order.LAST: small_words.LEADING_LAST,
            Order.THEN: small_words.LEADING_THEN,
        }
    ),
    NOT_OF_ONE,
)


_OUGHT = {"should", "would", "ought", "could", "needs"}


def _is_wish(given: Input, at: int) -> list[Result]:
    said = [*takewhile(lambda word: word != COMMA, given.words[at:])]
    return [(at, NOTHING)] if _OUGHT & {*said} else []


_OPINION = Parser(_is_wish)
"""Before a wish in such words; that something belongs somewhere is but thought."""


_DOING = words_of((verbs.PICK, verbs.PUT, verbs.REMOVE, verbs.TIDY, verbs.FILL)) - LINKS


_BEFORE_A_VERB = Parser(
    lambda given, at: (
        [(at, NOTHING)] if given.ahead[at] in {*_DOING, "open", "close", "shut"} else []
    )
)


LEAD = sequence(
    some(
        either(
            frames.FRAMES,
            sequence("do", _BEFORE_A_VERB),
            sequence(frames.I_THINK, _OPINION),
            fillers.WITHOUT_MEANING,
            sequence(either(ORDER_WORDS, INSTEAD), OPTIONAL_COMMA),
            COMMA,
        ),
        most=6,
    )
)


def _spoken(said: tuple[tuple[Order | bool, ...], Any]) -> list[Reading]:
    """A clause with what must not be done on the way: "… and the lid on the pot first" may be about
    the lid alone.
    """
    leading, (at, clause, order, instead, avoided) = said
    whole = _in_order(leading, at, clause, order, instead=instead, avoided=avoided)
    *before, last = _each(clause)
    if whole is not None and before and isinstance(clause, PutClause) and clause.ordered:
        then = (Spoken(item, at + n, Order.THEN) for n, item in enumerate((*before[1:], last), 1))
        return [(replace(whole[0], clause=before[0]), *then, *whole[1:])]
    if whole is None or not before or order is not Order.FIRST or leading:
        return [] if whole is None else [whole]
    first = Spoken(last, at + 1, order, far_fetched=1)
    return [whole, (*(Spoken(item, at) for item in before), first, *whole[1:])]


def _each(clause: Clause) -> list[Clause]:
    """What a clause says of several things, in a clause for each."""
    match clause:
        case PutClause():
            return [replace(clause, groups=(group,)) for group in clause.groups]
        case EnsureClause():
            return [replace(clause, states=(state,)) for state in clause.states]
    return [clause]


def _is_ruled_out(clause: Clause) -> bool:
    """Whether a clause says what is not to be done, or not to be so."""
    match clause:
        case AvoidClause():
            return not clause.needless
        case EnsureClause(states=states):
            return any(state.denied for state in states)
    return False


def _in_order(
    leading: tuple[Order | bool, ...],
    at: int,
    clause: Clause,
    order: Order | None,
    *,
    instead: bool,
    avoided: tuple[Clause, ...],
) -> Reading | None:
    """A clause by the words for when it is to be done; None where these are at odds."""
    orders = [item for item in (*leading, order) if isinstance(item, Order)]
    said = list(dict.fromkeys(orders))
    strong = [item for item in said if item is not Order.THEN]
    if len(strong) > 1:
        return None
    if _is_ruled_out(clause) and (order is Order.FIRST or Order.BEFORE_THAT in said):
        return None  # "do not open it before that" rules nothing out for later
    when = strong[0] if strong else (said[0] if said else Order.SAID)
    instead = instead or True in leading
    led = bool(strong) and when in leading
    return (Spoken(clause, at, when, instead, led=led), *(Spoken(item, at) for item in avoided))


LED_CLAUSE = Rule(
    either(
        variants(sequence(LEAD, CLAUSE), _spoken),
        sequence(
            LEAD,
            either(BOTH_WAYS, ONLY_THESE, IN_TURN, PARENTHETIC),
            build=lambda orders, said: None if orders else said,
        ),
        plain(
            sequence(
                NEITHER,
                DESTINATIONS,
                build=lambda out, where: AvoidClause(Avoid.PUT, out, where, negated=True),
            )
        ),
        sequence(
            LEAD,
            located(either(PUT, ENSURE), lambda at, clause: (at, clause)),
            OPTIONAL_COMMA,
            located(FLANKED, lambda at, clause: (at, clause)),
            build=with_others,
        ),
        sequence(
            LEAD,
            located(PUT, lambda at, clause: (at, clause)),
            OPTIONAL_COMMA,
            "without",
            NP_LIST,
            build=bared,
        ),
    )
)

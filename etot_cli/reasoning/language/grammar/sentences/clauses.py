"""Rules for clauses: one thing that is asked for, with what is left out or said behind it."""

from __future__ import annotations

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
    noun_phrase,
)
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
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.requests.arrangements import REORIENT, SWAP
from etot_cli.reasoning.language.grammar.requests.emptying import EMPTY, NOT_INTO, is_emptying
from etot_cli.reasoning.language.grammar.requests.filling import COVER, FILL
from etot_cli.reasoning.language.grammar.requests.grasping import GRASP
from etot_cli.reasoning.language.grammar.requests.holding import HOLD
from etot_cli.reasoning.language.grammar.requests.moves import MOVE
from etot_cli.reasoning.language.grammar.requests.put_groups import PUT_GROUP
from etot_cli.reasoning.language.grammar.requests.putting import PUT
from etot_cli.reasoning.language.grammar.requests.reaching import REACHED
from etot_cli.reasoning.language.grammar.requests.taking import HAND_OVER, NEEDED, PICK, REMOVE
from etot_cli.reasoning.language.grammar.requests.towers import TOWER
from etot_cli.reasoning.language.grammar.requests.unstacking import REVERSED, SPREAD
from etot_cli.reasoning.language.grammar.sentences.doubles import SIDE_BY_SIDE, UNLESS_THERE
from etot_cli.reasoning.language.grammar.sentences.spoken import Order
from etot_cli.reasoning.language.grammar.sentences.togetherness import IN_ONE_PLACE
from etot_cli.reasoning.language.grammar.sentences.wishes import TOLD_APART, WANTED, WISHED
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AgainClause,
    Clause,
    PickClause,
    PutClause,
    PutGroup,
    RemoveClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import manner, nouns, predicates, small_words
from etot_cli.reasoning.language.words.lexicon import singular

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


def _excluding_some(said: tuple[Clause, Modifier]) -> list[Clause]:
    """A clause without some of the things that any of its phrases means."""
    match said[0]:
        case PutClause(groups=(PutGroup(things=things),)) | PickClause(things=things):
            found = [excluding(*said, at) for at in range(len(things.phrases))]
        case RemoveClause() as out if is_emptying(out) and _is_one_of_them(out, said[1]):
            found = []  # "empty the bowls, except the red one", which is left as it is
        case _:
            found = [excluding(*said)]
    return [way for way in found if way is not None]


def _is_one_of_them(emptied: RemoveClause, left_out: Modifier) -> bool:
    """Whether what is left out may be one of several things that are to be empty."""
    held = (m for np in emptied.things.phrases for m in np.modifiers)
    several = any(singular(np.head) != np.head for m in held for np in m.phrases)
    return several and all(np.is_elliptic for np in left_out.phrases)


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


def _upon_what_goes_there(clause: PutClause, np: NounPhrase) -> PutClause | None:
    """What goes somewhere "with the mat under it": the mat goes there, and it goes on that."""
    several = clause.groups[0].things.may_be_several
    match clause.groups:
        case (PutGroup(things=Things(phrases=(_,)), destinations=(where,)),) if (
            where.toward is Toward.ON and not (clause.conditions or several)
        ):
            upon = (Destination(Toward.ON, (np,)),)
            groups = (
                PutGroup(Things((np,)), (where,)),
                replace(clause.groups[0], destinations=upon),
            )
            return replace(clause, groups=groups, ordered=True, far_fetched=1)
    return None


_WHICH_GOES = sequence("~comma which", predicates.MODAL, DESTINATIONS)


_ELSEWHERE = sequence(
    nouns.EXCEPT,
    exceptions,
    _WHICH_GOES,
    build=lambda nps, where: PutGroup(Things(nps), where),
)
"""What goes to another place ("…, except the blue one, which goes on the mat")."""


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
            NOT_INTO,
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
                PUT,
                either(
                    sequence(optional(phrase("~comma", True), False), "but", PUT_GROUP),
                    sequence(OPTIONAL_COMMA, _ELSEWHERE, build=lambda group: (True, group)),
                ),
                build=lambda clause, found: but_some(clause, found[1], set_off=found[0]),
            ),
            sequence(
                PUT,
                OPTIONAL_COMMA,
                "with",
                noun_phrase,
                "[placed|lying] (under|underneath|beneath|below) it",
                build=_upon_what_goes_there,
            ),
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

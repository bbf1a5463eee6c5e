"""Rules for what is to be done only when something else has been ("do not open it before …")."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    one_of,
    phrase,
    quiet,
    sequence,
)
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA, not_ahead
from etot_cli.reasoning.language.grammar.parsers.trees import nodes
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS
from etot_cli.reasoning.language.grammar.sentences.before_and_after import (
    DONE_BY_THEN,
    EARLIER,
    once_done,
)
from etot_cli.reasoning.language.grammar.sentences.led_clauses import LED_CLAUSE
from etot_cli.reasoning.language.grammar.sentences.spoken import Reading, plain
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.words import forbidden, predicates

_UNTIL = "[but] [just] (before|until|till|as long as not)"
_LEFT = ("leave", "keep", "let", "forget", "touch", "bother", "hesitate")
"""Behind "do not" they forbid, or forbid nothing."""
_BEFORE_THAT = """
    (before|until|till|prior to) (that|this|then) [(is|has been) done|has happened],
    (before|until) you [have] (do|did|done) (so|that|this|it),
    before (doing|having done) (so|that|this|it)
"""
"""What was asked for before it has been done by then."""
_VAGUE = frozenset({"a", "an", "any", "either", "no", "some"})
"""Of which "do not put any cup there" speaks of all."""


def _definite(reading: Reading) -> bool:
    """Whether only the things that are named are spoken of."""
    return not any(
        {*np.determiner.split()} & _VAGUE or np.words[-1:] == ("anything",)
        for np in nodes(reading)
        if isinstance(np, NounPhrase)
    )


def _only_after(later: Reading, earlier: Reading) -> Reading | None:
    """What is not to be done before something else: that first. What is "not" to be so, or to be
    left, in the meantime asks for nothing.
    """
    (said, *more) = later
    if more or not isinstance(said.clause, PutClause | MoveClause | PickClause):
        return None
    if not _definite(later) or (isinstance(said.clause, PutClause) and said.clause.stays):
        return None
    held = any(isinstance(item.clause, PickClause) for item in earlier)
    wished = any(isinstance(item.clause, EnsureClause) for item in earlier)
    if held or wished:
        return None
    return once_done(earlier, (replace(said, not_before=True),))


def _forbidden(word: str) -> Parser:
    """What may not (or ``word``) be done with things, told of them."""
    be = f"(must|may|should|can|shall|could) {word} be, (is|are) {word} to be"
    go = f"(must|may|should|can|shall|could) {word} (go|come), (is|are) {word} to go"
    opened = one_of({True: "opened, pulled open", False: "closed, shut"})
    return plain(
        either(
            sequence(
                ALL_THINGS,
                either(go, sequence(be, phrase(predicates.DONE_WITH_IT))),
                DESTINATIONS,
                build=lambda things, *said: put_to(things, said[-1]),
            ),
            sequence(ALL_THINGS, be, opened, build=MoveClause),
            sequence(ALL_THINGS, be, "picked up, lifted [up], grasped, taken", build=PickClause),
        )
    )


_NOT_YET = either(
    sequence(forbidden.DO_NOT, not_ahead(*_LEFT), LED_CLAUSE), sequence(_forbidden("not"))
)
NOT_BEFORE = quiet(
    either(
        sequence(
            _NOT_YET,
            OPTIONAL_COMMA,
            _UNTIL,
            DONE_BY_THEN,
            build=_only_after,
        ),
        sequence(
            _UNTIL,
            DONE_BY_THEN,
            OPTIONAL_COMMA,
            forbidden.DO_NOT,
            not_ahead(*_LEFT),
            LED_CLAUSE,
            build=lambda earlier, later: _only_after(later, earlier),
        ),
        sequence(_forbidden("only"), OPTIONAL_COMMA, EARLIER, build=_only_after),
        sequence(
            _NOT_YET, OPTIONAL_COMMA, _BEFORE_THAT, build=lambda later: _only_after(later, ())
        ),
        sequence(
            _BEFORE_THAT,
            OPTIONAL_COMMA,
            _NOT_YET,
            build=lambda later: _only_after(later, ()),
        ),
    )
)
"""What is not to be done "until" something else has been is done after that."""

"""Rules for what is to be done only when something else has been ("do not open it before …")."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.language.grammar.clauses import LED_CLAUSE, Reading, plain
from etot_cli.reasoning.language.grammar.common import OPTIONAL_COMMA, not_ahead
from etot_cli.reasoning.language.grammar.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.noun_phrases import ALL_THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    Parser,
    either,
    one_of,
    phrase,
    quiet,
    sequence,
)
from etot_cli.reasoning.language.grammar.past import DONE_BY_THEN, EARLIER, then_done
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.grammar.trees import nodes
from etot_cli.reasoning.language.words import verbs

_UNTIL = "[but] [just] (before|until|till|as long as not)"
_LEFT = ("leave", "keep", "let", "forget", "touch", "bother", "hesitate")
"""Behind "do not" they forbid, or forbid nothing."""
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
    (said, *_) = then_done(later)
    return (*earlier, replace(said, not_before=True))


def _forbidden(word: str) -> Parser:
    """What may not (or ``word``) be done with things, told of them."""
    be = f"(must|may|should|can|shall|could) {word} be, (is|are) {word} to be"
    go = f"(must|may|should|can|shall|could) {word} (go|come), (is|are) {word} to go"
    opened = one_of({True: "opened, pulled open", False: "closed, shut"})
    return plain(
        either(
            sequence(
                ALL_THINGS,
                either(go, sequence(be, phrase(verbs.DONE_WITH_IT))),
                DESTINATIONS,
                build=lambda things, *said: put_to(things, said[-1]),
            ),
            sequence(ALL_THINGS, be, opened, build=MoveClause),
            sequence(ALL_THINGS, be, "picked up, lifted [up], grasped, taken", build=PickClause),
        )
    )


NOT_BEFORE = quiet(
    either(
        sequence(
            either(
                sequence(verbs.DO_NOT, not_ahead(*_LEFT), LED_CLAUSE),
                sequence(_forbidden("not")),
            ),
            OPTIONAL_COMMA,
            _UNTIL,
            DONE_BY_THEN,
            build=_only_after,
        ),
        sequence(
            _UNTIL,
            DONE_BY_THEN,
            OPTIONAL_COMMA,
            verbs.DO_NOT,
            not_ahead(*_LEFT),
            LED_CLAUSE,
            build=lambda earlier, later: _only_after(later, earlier),
        ),
        sequence(_forbidden("only"), OPTIONAL_COMMA, EARLIER, build=_only_after),
    )
)
"""What is not to be done "until" something else has been is done after that."""

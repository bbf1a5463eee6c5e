"""Rules for what alone may be moved or touched ("only the cup may be moved")."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import either, one_of, sequence
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA, exceptions
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST
from etot_cli.reasoning.language.grammar.syntax.clauses import Avoid, AvoidClause
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase, Things
from etot_cli.reasoning.language.words import forbidden, nouns
from etot_cli.reasoning.language.words.places import Prep


def anything_but(nps: tuple[NounPhrase, ...], places: tuple[NounPhrase, ...] = ()) -> NounPhrase:
    """All things but some; what goes to some ``places`` is not these."""
    text = f"anything but {' and '.join(np.text for np in nps)}"
    return NounPhrase("", ("anything",), (Modifier(Prep.EXCEPT, (*nps, *places)),), text=text)


def _only_these(nps: tuple[NounPhrase, ...], avoid: Avoid) -> AvoidClause:
    """Nothing but some things may be moved or touched."""
    return AvoidClause(avoid, Things((anything_but(nps),)), negated=True)


def _but_these(nps: tuple[NounPhrase, ...], avoid: Avoid) -> AvoidClause:
    """What is left out of all that may be moved or touched must not be."""
    return AvoidClause(avoid, Things(nps), negated=True)


_MOVES = one_of({Avoid.TOUCH: "touch", Avoid.MOVE: "move, lift"})
_SHIFT = one_of({Avoid.TOUCH: "touch", Avoid.MOVE: "move, shift"})
_IS_MOVED = one_of(
    {
        Avoid.TOUCH: f"be ({forbidden.TOUCHED_ONLY})",
        Avoid.MOVE: f"be ({forbidden.MOVED_ONLY}), move",
    }
)
_MAY_BE = sequence(forbidden.MAY, _IS_MOVED)
_PERMITTED = "can, may, could, (is|are) (allowed|permitted) to"
_BUT = sequence(OPTIONAL_COMMA, nouns.EXCEPT, exceptions)
_ALL = "anything, everything"
ONLY_THESE_MAY = either(
    # "Anything but the pen may be moved"
    sequence(_ALL, _BUT, _PERMITTED, _IS_MOVED, build=_but_these),
    sequence(_ALL, _PERMITTED, _IS_MOVED, _BUT, build=lambda avoid, nps: _but_these(nps, avoid)),
    sequence("you (can|may|could)", _MOVES, _ALL, _BUT, build=lambda a, nps: _but_these(nps, a)),
    sequence("only", NP_LIST, _MAY_BE, build=_only_these),
    sequence(
        "nothing",
        _MAY_BE,
        _BUT,
        build=lambda avoid, nps: _only_these(nps, avoid),
    ),
    sequence(
        # "Apart from the pen, nothing is to be moved"
        nouns.EXCEPT,
        exceptions,
        OPTIONAL_COMMA,
        "nothing",
        _MAY_BE,
        build=_only_these,
    ),
    sequence(
        NP_LIST,
        "(is|are) the only (thing|things|object|objects|one|ones|item|items)",
        either(
            sequence("that, which", _MAY_BE),
            sequence(
                f"[that|which] you ({forbidden.MAY})",
                _MOVES,
            ),
        ),
        build=_only_these,
    ),
    sequence(
        # "You may only move the pen", "move only the pen" where that is not all
        either(
            sequence(
                f"you ({forbidden.MAY})",
                either(sequence("only", _MOVES), sequence(_MOVES, "only, just")),
            ),
            sequence("only", _SHIFT),
            sequence(_SHIFT, "only, nothing but"),
        ),
        NP_LIST,
        build=lambda avoid, nps: replace(_only_these(nps, avoid), far_fetched=1),
    ),
)
"""What alone may be moved or touched."""

"""Rules for what alone may be moved or touched ("only the cup may be moved")."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    sequence,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    OPTIONAL_COMMA,
    exceptions,
)
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Avoid,
    AvoidClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Modifier,
    NounPhrase,
    Things,
)
from etot_cli.reasoning.language.words import forbidden, nouns
from etot_cli.reasoning.language.words.places import Prep


def _only_these(nps: tuple[NounPhrase, ...], avoid: Avoid) -> AvoidClause:
    """Nothing but some things may be moved or touched."""
    text = f"anything but {' and '.join(np.text for np in nps)}"
    others = NounPhrase("", ("anything",), (Modifier(Prep.EXCEPT, nps),), text=text)
    return AvoidClause(avoid, Things((others,)), negated=True)


_MAY_BE = sequence(
    forbidden.MAY,
    one_of(
        {
            Avoid.TOUCH: f"be ({forbidden.TOUCHED_ONLY})",
            Avoid.MOVE: f"be ({forbidden.MOVED_ONLY}), move",
        }
    ),
)


ONLY_THESE_MAY = either(
    sequence("only", NP_LIST, _MAY_BE, build=_only_these),
    sequence(
        "nothing",
        _MAY_BE,
        OPTIONAL_COMMA,
        nouns.EXCEPT,
        exceptions,
        build=lambda avoid, nps: _only_these(nps, avoid),
    ),
    sequence(
        NP_LIST,
        "(is|are) the only (thing|things|object|objects|one|ones|item|items)",
        either(
            sequence("that, which", _MAY_BE),
            sequence(
                f"[that|which] you ({forbidden.MAY})",
                one_of({Avoid.TOUCH: "touch", Avoid.MOVE: "move, lift"}),
            ),
        ),
        build=_only_these,
    ),
    sequence(
        # "You may only move the pen"
        f"you ({forbidden.MAY})",
        either(
            sequence("only", _MOVES_ONLY := one_of({Avoid.TOUCH: "touch", Avoid.MOVE: "move"})),
            sequence(_MOVES_ONLY, "only, just"),
        ),
        NP_LIST,
        build=lambda avoid, nps: replace(_only_these(nps, avoid), far_fetched=1),
    ),
)
"""What alone may be moved or touched."""

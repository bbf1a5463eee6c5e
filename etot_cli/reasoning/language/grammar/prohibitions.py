"""Rules for what must not be done."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from etot_cli.reasoning.language.grammar.common import OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.noun_phrases import NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    either,
    one_of,
    optional,
    phrase,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.states import OPEN_OR_CLOSED, not_left
from etot_cli.reasoning.language.grammar.syntax import Avoid, AvoidClause, Things
from etot_cli.reasoning.language.words import manner, small_words, verbs


def _avoid(avoid: Avoid, things: Things, where: Any = ()) -> AvoidClause:
    return AvoidClause(avoid, things, where or ())


_FORBIDDEN = either(
    sequence(
        one_of(
            {
                Avoid.TOUCH: verbs.TOUCH,
                Avoid.MOVE: f"{verbs.DISTURB}, {verbs.PICK}",
                Avoid.OPEN: verbs.OPEN,
                Avoid.CLOSE: verbs.CLOSE,
            }
        ),
        THINGS,
        silent(optional(phrase(small_words.TRAILING_THEN), None)),
        build=_avoid,
    ),
    sequence(phrase(verbs.PUT, Avoid.PUT), THINGS, DESTINATIONS, build=_avoid),
    sequence(
        either(phrase(verbs.TOUCH, Avoid.TOUCH), phrase(verbs.DISTURB, Avoid.MOVE)),
        silent(phrase(verbs.ANYTHING_ELSE)),
        build=lambda avoid: AvoidClause(avoid, None),
    ),
)
AVOID = sequence(
    silent(phrase(verbs.DO_NOT)), _FORBIDDEN, build=lambda clause: replace(clause, negated=True)
)
WITHOUT = either(
    sequence(
        OPTIONAL_COMMA, silent(phrase(verbs.WITHOUT)), _FORBIDDEN, build=lambda clause: clause
    ),
    sequence(
        OPTIONAL_COMMA,
        silent(phrase(verbs.WITHOUT)),
        silent(phrase(verbs.KEEP)),
        NP_LIST,
        OPEN_OR_CLOSED,
        build=not_left,
    ),
    sequence(
        OPTIONAL_COMMA,
        silent(phrase("[while] avoiding")),
        THINGS,
        build=lambda things: AvoidClause(Avoid.TOUCH, things),
    ),
)
KEEP_STILL = either(
    sequence(
        THINGS,
        silent(
            phrase(
                "(should|must|has to|have to|is to|are to|shall) (stay|remain|be left),"
                "stay[s], remain[s]"
            )
        ),
        silent(phrase(f"{manner.AS_IT_IS}, put")),
        build=lambda things: AvoidClause(Avoid.MOVE, things),
    ),
    sequence(
        # After "the cups" rather one of them that is left out.
        either(
            sequence(
                silent(phrase(verbs.KEEP)),
                THINGS,
                silent(phrase(manner.AS_IT_IS)),
                build=lambda things: things,
            ),
            sequence(silent(phrase("leav(e|ing)")), THINGS, build=lambda things: things),
        ),
        build=lambda things: AvoidClause(Avoid.MOVE, things, far_fetched=2),
    ),
    sequence(
        silent(phrase("leav(e|ing), keep[ing]")),
        silent(phrase("everything else, all else, the (rest|others) [of it|of them]")),
        silent(phrase(manner.AS_IT_IS)),
        build=lambda: AvoidClause(Avoid.MOVE, None),
    ),
    sequence(
        silent(phrase("keep[ing], stay[ing]")),
        silent(phrase("[your] (hand|hands|gripper|fingers|arm|), clear")),
        silent(phrase("off, away from, clear of, of")),
        THINGS,
        build=lambda things: AvoidClause(Avoid.TOUCH, things),
    ),
)

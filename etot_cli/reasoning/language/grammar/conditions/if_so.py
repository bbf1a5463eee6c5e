"""Rules for what is asked for if a thing holds something by now, which the scene decides."""

from __future__ import annotations

from functools import partial

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    quiet,
    sequence,
    valued,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import COMMA, EMPTY_WORDS, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS
from etot_cli.reasoning.language.grammar.requests.emptying import emptied, stays_empty
from etot_cli.reasoning.language.grammar.syntax.clauses import Clause
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, Things, Toward
from etot_cli.reasoning.language.words import verbs
from etot_cli.reasoning.language.words.places import Prep

_THEN = either(COMMA, sequence(OPTIONAL_COMMA, "then"))
_SOMETHING = """
    (anything|something) [(at all|still|left|lying|standing|sitting|already)]
    [(still|left|lying|standing|sitting|already)]
"""
_IT = "it [all], that, them, this, whatever (it is|is there|is in it|is on it)"
_WHERE = one_of({Prep.FROM: "in, inside", Prep.ON: "on, on [the] top of"})
_IF_THERE_IS = either(
    sequence(
        f"(if there is|in case there is|should there be) ({_SOMETHING})",
        _WHERE,
        ALL_THINGS,
    ),
    sequence(
        "(if|in case) (anything|something) (is|lies|stands|sits|remains) [still|already]",
        _WHERE,
        ALL_THINGS,
    ),
)
_TAKEN_OUT = either(
    sequence(
        either(
            sequence(f"{verbs.REMOVE}, {verbs.CLEAR}", _IT),
            sequence(verbs.GET_OUT, _IT, "out, off, away, out of (it|there), off (it|there)"),
            sequence("empty, clear, empty out", "it, them"),
        ),
        build=lambda: (),
    ),
    sequence(verbs.SET_DOWN, _IT, DESTINATIONS),
    sequence("empty [out]", "it [out], them [out]", DESTINATIONS),
)


def _emptied(found: tuple[Prep, Things, tuple[Destination, ...]]) -> Clause:
    """What takes all out of things, or off them, which asks for something if anything is there."""
    return _without_contents(found)[0]


def _without_contents(
    found: tuple[Prep, Things, tuple[Destination, ...]],
) -> tuple[Clause, ...]:
    """What takes all out of things, or off them; they stay so where nothing is there."""
    at, things, where = found
    held = Prep.ON if at is Prep.ON else None
    if where:
        return (emptied(things, where, held=held),)
    stays = partial(stays_empty, toward=Toward.ON if held else Toward.INSIDE)
    return emptied(things, held=held), *(stays(np, 1) for np in things.phrases[:1])


_IF_ANYTHING_IS_THERE = sequence(
    _IF_THERE_IS,
    optional("now, already, at the moment, by now"),
    _THEN,
    EMPTY_WORDS,
    _TAKEN_OUT,
    build=lambda found, where: (*found, where),
)
IF_ANYTHING_IS_THERE = quiet(variants(_IF_ANYTHING_IS_THERE, _without_contents))
"""Asked for unless nothing is there, which then stays so."""
AS_SOMETHING_IS_THERE = quiet(valued(_IF_ANYTHING_IS_THERE, _emptied))
"""Asked for as something is there, so that more may follow, whether it hangs on that or not."""

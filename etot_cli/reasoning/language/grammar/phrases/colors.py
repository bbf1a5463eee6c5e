"""Rules for colours alone, as what things are called by ("red in the mug, green on blue")."""

from __future__ import annotations

from itertools import pairwise

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    separated,
    sequence,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.common import COLON, COMMA, LIST
from etot_cli.reasoning.language.grammar.parsers.input import NO_WORD, Input, Result
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.words import verbs
from etot_cli.reasoning.language.words.lexicon import COMMON_NOUNS, basic_color, word_set
from etot_cli.reasoning.language.words.patterns import words_of

_COLOR = word(lambda given, text: basic_color(text) is not None and text not in COMMON_NOUNS)
"""One that is no thing as well."""
ONES_OF_A_COLOR = sequence(
    _COLOR, build=lambda color: (NounPhrase("all", (color, "ones"), text=color),)
)
"""All that are so."""


def _colors_alone(given: Input, at: int) -> list[Result]:
    """Colours alone, where nothing before them and behind them could belong to them, are the ones
    of such a colour ("red and green in the mug, blue stays where it is").
    """
    before = given.words[at - 1] if at else COMMA
    if before not in _BEFORE_COLORS:
        return []
    return [
        (end, tuple(NounPhrase(words=(color, "ones"), text=color) for color in colors))
        for end, colors in _COLORS.find(given, at)
        if (given.ahead[end] in _BEHIND_COLORS and given.words[end + 1 : end + 2] != ("top",))
        or given.words[end : end + 2] in (("left", "of"), ("right", "of"))
    ]


_COLORS = separated(_COLOR, LIST, most=4)
_BEFORE_COLORS = {COMMA, COLON, "and", "but", "then", *words_of((verbs.PLACE, verbs.KEEP))}
_BEHIND_COLORS = word_set(
    "in inside into on onto to at where go goes belong belongs stay stays remain remains "
    "should untouched unmoved behind beside next between"
)
COLORS_ALONE = Parser(_colors_alone, lambda: _COLORS.first)
_GOES_ON = frozenset({COMMA, "and", "then", NO_WORD})
_STACKING = words_of((verbs.STACK,)) - {"up"}
_BEFORE_A_STACK = frozenset({"the", "a", "this", "that"})


def _told_by_color(given: Input, at: int) -> list[Result]:
    """The one of a colour, where something has a noun ("the green block on blue"); of colours alone
    stacks are built.
    """
    others = {said for said in given.words if basic_color(said) is None}
    stacking = any(
        said in _STACKING and before not in _BEFORE_A_STACK
        for before, said in pairwise(("", *given.words))
    )
    named = others & {"the", *given.nouns} and not stacking
    return [
        (end, (NounPhrase("the", (color, "one"), text=color, loose=True),))
        for end, color in (_COLOR.find(given, at) if named else ())
        if given.ahead[end] in _GOES_ON
    ]


ONE_OF_A_COLOR = Parser(_told_by_color, lambda: _COLOR.first)
"""What something goes on."""

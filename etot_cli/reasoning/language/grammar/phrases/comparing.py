"""Rules for one of some things that are named, told by comparing them with each other."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    at_end,
    either,
    optional,
    separated,
    sequence,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    LIST,
    alternatives,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words.lexicon import SIZES
from etot_cli.reasoning.language.words.places import Prep

COMPARED = word(lambda given, text: text in SIZES and text.endswith(("er", "est")))
WHICHEVER_IS = "(whichever|whatever) [one|of them|of these|of the two|of the three] is"


def the_more(compared: str, nps: tuple[NounPhrase, ...]) -> NounPhrase | None:
    """Of some things that are named the one that is bigger, or longer, than the others."""
    if not nps[1:] or any(not np.words for np in nps):
        return None
    text = f"the {compared} of {' and '.join(np.text for np in nps)}"
    return NounPhrase("the", (compared, "object"), (Modifier(Prep.AMONG, nps),), text=text)


ONE_COMPARED = either(
    sequence(
        # "Whichever is shorter, the pen or the pencil"
        WHICHEVER_IS,
        COMPARED,
        COMMA,
        alternatives(noun_phrase, 3),
        either(COMMA, at_end),
        build=the_more,
    ),
    sequence(
        # "The shorter of the pen and the pencil"
        "the",
        COMPARED,
        optional("one"),
        "of",
        separated(noun_phrase, LIST, most=3),
        build=the_more,
    ),
)

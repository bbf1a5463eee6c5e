"""Rules for things that are told by comparing them with others, or by which is the nearest."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    at_end,
    either,
    one_of,
    optional,
    separated,
    sequence,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    LIST,
    OPTIONAL_DETERMINER,
    WORDS,
    alternatives,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.descriptions import COMPARATIVE
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words.lexicon import ORDINALS, SIZES, singular
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


def _nearest_to(
    determiner: str, ordinal: str, prep: Prep, words: tuple[str, ...], mark: tuple[Prep, NounPhrase]
) -> NounPhrase | None:
    """With the landmark of "the closest cup to the plate"; of "the second closest cup to you" the
    robot, from which they are counted anyway.
    """
    side = "closest" if prep is Prep.NEAREST else "farthest"
    if mark[0] is not prep or singular(words[-1]) != words[-1]:
        return None
    if mark[1].words in (("you",), ("robot",)):
        return NounPhrase(determiner, (*filter(None, (ordinal,)), side, *words))
    return None if ordinal else NounPhrase(determiner, words, (Modifier(prep, (mark[1],)),))


MORE_THAN = sequence(
    # "A smaller cup than the red one"
    OPTIONAL_DETERMINER,
    COMPARATIVE,
    WORDS,
    "than",
    noun_phrase,
    build=lambda determiner, how, words, np: NounPhrase(
        determiner, words, (Modifier(Prep.THAN, (np,), (how,)),)
    ),
)
NEAREST_TO = sequence(
    # "The closest cup to the plate"
    OPTIONAL_DETERMINER,
    optional(word(lambda given, text: text in ORDINALS), ""),
    one_of({Prep.NEAREST: "closest, nearest", Prep.FARTHEST: "farthest, furthest"}),
    WORDS,
    either(
        sequence("to", noun_phrase, build=lambda np: (Prep.NEAREST, np)),
        sequence("[away] from", noun_phrase, build=lambda np: (Prep.FARTHEST, np)),
    ),
    build=_nearest_to,
)

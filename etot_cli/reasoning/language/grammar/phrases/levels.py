"""Rules for places on or in a level of furniture: a board, a drawer, or the next one up."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    sequence,
    spanned,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.common import noun_phrase
from etot_cli.reasoning.language.grammar.phrases.naming import LEVEL
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    Toward,
)
from etot_cli.reasoning.language.words import places
from etot_cli.reasoning.language.words.lexicon import BOARD_NOUNS, DESK_NOUNS
from etot_cli.reasoning.language.words.places import Prep

THAT = NounPhrase(pronoun="it", text="where it is")
"""What is to go to another level, which is counted from where it is."""
AT_LEVEL = sequence(
    # "In the safe on the bottom shelf"
    f"{places.INTO}, {places.ONTO}",
    noun_phrase,
    one_of({Toward.ON: "on the", Toward.INSIDE: "in the"}),
    LEVEL,
    build=lambda owner, toward, level: (
        None
        if owner.modifiers or owner.pronoun or owner.head in DESK_NOUNS
        else Destination(toward, (NounPhrase("the", level[0], owner=owner, text=owner.text),))
    ),
)


def _level_by(text: str, said: tuple[str, Prep]) -> Destination:
    """The next level above or below a thing."""
    noun, prep = said
    aside = Modifier(prep, (THAT,), tuple(text.split()))
    return Destination(Toward.TO, (NounPhrase("the", (noun,), (aside,), text=text),))


_LEVEL_NOUN = word(lambda _, text: text in (*BOARD_NOUNS, "drawer"))
NEXT_LEVEL = spanned(
    # "One board up", "to the shelf below"
    either(
        sequence(
            "one, 1, a, [(on|in|to|into|onto)] the next",
            _LEVEL_NOUN,
            one_of(
                {
                    Prep.ABOVE: "[further] up, higher [up]",
                    Prep.UNDER: "[further] down, lower [down]",
                }
            ),
        ),
        sequence(
            one_of({Prep.ABOVE: "up", Prep.UNDER: "down"}),
            "one, a",
            _LEVEL_NOUN,
            build=lambda prep, noun: (noun, prep),
        ),
        sequence(
            "(on|in|to|into|onto) the",
            _LEVEL_NOUN,
            one_of({Prep.ABOVE: "above, higher up", Prep.UNDER: "below, lower down"}),
        ),
    ),
    _level_by,
)


LEVEL_OF_ALL = "level of what all go on"
"""The word of a destination at the top or bottom, where it is said before of what."""
AT_AN_END = spanned(
    # "At the bottom" of what others go on
    sequence("at the", one_of({"top": "[very] top", "bottom": "[very] bottom"})),
    lambda text, level: Destination(
        Toward.ON, (NounPhrase("the", (level, "board"), text=text),), LEVEL_OF_ALL
    ),
)

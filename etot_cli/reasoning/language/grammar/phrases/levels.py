"""Rules for places on or in a level of furniture: a board, a drawer, or the next one up."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    sequence,
    spanned,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA, noun_phrase
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    Toward,
)
from etot_cli.reasoning.language.words import places
from etot_cli.reasoning.language.words.lexicon import (
    BOARD_NOUNS,
    DESK_NOUNS,
    LEVELS,
    ORDINALS,
    STATES,
)
from etot_cli.reasoning.language.words.places import Prep

LEVEL = sequence(
    word(lambda given, text: text in LEVELS),
    word(lambda given, text: text in (*BOARD_NOUNS, "drawer")),
    build=lambda *words: (words, ()),
)
"""Of furniture: "top shelf", and nothing behind it."""
THAT = NounPhrase(pronoun="it", text="where it is")
"""What is to go to another level, which is counted from where it is."""
_LEVEL_NOUNS = (*BOARD_NOUNS, "drawer")


def _level_of(owner: NounPhrase, toward: Toward, level: NounPhrase) -> Destination | None:
    """A level of what is named before it; "on the tray, on the shelf" is on what is there."""
    if owner.modifiers or owner.pronoun or owner.head in DESK_NOUNS or level.owner:
        return None
    return Destination(toward, (replace(level, owner=owner, text=level.text or owner.text),))


def _told_level(np: NounPhrase) -> NounPhrase | None:
    """One that is told by what is on it, how it is or which one it is from an end, not by where it
    is.
    """
    *said, noun = np.words or ("",)
    counted = {*said} <= {*ORDINALS} - {"last"} and {item.prep for item in np.modifiers} <= {
        Prep.SIDE
    }
    if said and noun in _LEVEL_NOUNS and counted:
        return np
    told = all(item.prep in _TELLING for item in np.modifiers) and all(w in STATES for w in said)
    return np if noun in _LEVEL_NOUNS and (np.modifiers or said) and told else None


_TELLING = (Prep.QUALITY, Prep.WITH, Prep.BEARING, Prep.CONTAINING)
AT_LEVEL = sequence(
    f"{places.INTO}, {places.ONTO}",
    noun_phrase,
    either(
        # "In the safe on the bottom shelf"
        sequence(
            one_of({Toward.ON: "on the", Toward.INSIDE: "in the"}),
            sequence(LEVEL, build=lambda level: NounPhrase("the", level[0])),
            build=lambda *said: said,
        ),
        # "On the shelf, on whichever board has nothing on it"
        sequence(
            OPTIONAL_COMMA,
            one_of({Toward.ON: "on[to]", Toward.INSIDE: "in[to]"}),
            sequence(noun_phrase, build=_told_level),
            build=lambda *said: said,
        ),
    ),
    build=lambda owner, level: _level_of(owner, *level),
)


def _level_by(text: str, said: tuple[str, Prep]) -> Destination:
    """The next level above or below a thing."""
    noun, prep = said
    aside = Modifier(prep, (THAT,), tuple(text.split()))
    return Destination(Toward.TO, (NounPhrase("the", (noun,), (aside,), text=text),))


_LEVEL_NOUN = word(lambda _, text: text in _LEVEL_NOUNS)
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

"""Rules for what follows a noun and singles an instance out, be it behind a comma.

Noun phrases and their modifiers contain each other: the two rules of ``noun_phrases`` that
modifiers need stand in ``common``, and are defined there.
"""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    Rule,
    at_end,
    either,
    one_of,
    optional,
    phrase,
    separated,
    sequence,
    silent,
    some,
    spanned,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    LIST_COMMA,
    OPTIONAL_COMMA,
    after,
    ahead,
    exceptions,
    not_ahead,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.contents import CONTENTS, WITH_IN_IT
from etot_cli.reasoning.language.grammar.phrases.contrasts import (
    CONTRASTED,
    LEAVING_OUT,
    LEFT,
    other_than,
    without_such,
)
from etot_cli.reasoning.language.grammar.phrases.descriptions import (
    ANY_QUALITY,
    DESCRIBED,
    PLAIN_MODIFIER,
    QUALITY,
    at_side,
    denied,
    quality_alone,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words import nouns, places, small_words
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.lexicon import (
    BOARD_NOUNS,
    LEVELS,
    THING_NOUNS,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep

_matching = either(
    sequence(
        nouns.MATCHING,
        optional("as (it|them|its own|their own|itself|themselves|theirs|they have|it has)"),
        build=lambda: Modifier(Prep.MATCHING),
    ),
    phrase(nouns.OTHER_COLOR, Modifier(Prep.MATCHING, denied=True)),
)
UNSAID_SO = ("so",)
"""The words of a modifier that leaves out what is so, as it was said of another thing before."""
_SO = sequence(
    "that, which",
    either(
        phrase("(is|are|do|does) not", Modifier(Prep.QUALITY, words=UNSAID_SO, denied=True)),
        phrase("is, are, does, do", Modifier(Prep.QUALITY, words=UNSAID_SO)),
    ),
)
_NO_MORE = ("~comma", "and", "but", "then", "")
_UNSAID = either(
    sequence(
        after("one", "ones"),
        _SO,
        ahead(*_NO_MORE, "into", "onto", "in", "on", "to", "next", "beside"),
    ),
    # Behind a noun of its own a place would rather tell where that is.
    sequence(after("that", "which"), _SO, ahead(*_NO_MORE)),
)
"""In "the block that is in the box on the one that is not", "… on the plate that is not"."""
MODIFIER = Rule()


def _nested(modifiers: tuple[Modifier, ...]) -> tuple[Modifier, ...] | None:
    """In "the top block of the stack of three blocks" the last "of" is about the stack, and in "the
    board below the one with the can" what is said last tells which "one".
    """
    several_of = [item.prep for item in modifiers].count(Prep.OF) > 1
    inner = (np for item in modifiers[:-1] for np in item.phrases if not np.modifiers)
    untold = any((np.determiner, np.words) == ("the", ("one",)) for np in inner)
    return None if several_of or untold else modifiers


MODIFIERS = sequence(some(MODIFIER, most=4), build=_nested)
ONE_SUCH = either(
    sequence(
        "~comma [and|but] (one|any one|one of those) [(that|which) (is|are|stands|lies|sits)]",
        DESCRIBED,
        either(COMMA, at_end),
    ),
    sequence(
        "~comma [and|but] (one|any one)",
        nouns.RELATIVE_NOT,
        either(PLAIN_MODIFIER, QUALITY),
        either(COMMA, at_end),
        build=denied,
    ),
    sequence(
        "~comma [and|but] (one|any one) without",
        word(lambda given, text: is_category(text) or text in given.nouns),
        either(COMMA, at_end),
        build=lambda noun: Modifier(
            Prep.WITH, (NounPhrase("any", (noun,), text=noun),), denied=True
        ),
    ),
)
"""Behind "a cup", what sort of one it is ("…, one with a lid")."""


def _said_again(the: str, np: NounPhrase) -> Modifier | None:
    """What a thing is, said behind it by a noun for much else ("the ball, the only pink thing")."""
    general = matches_any(np.head, THING_NOUNS) or is_category(np.head)
    single = singular(np.head) == np.head and not (np.determiner or np.is_elliptic)
    said = replace(np, determiner=the, text=f"{the} {np.text}")
    return Modifier(Prep.EXCEPT, (said,), denied=True) if general and single else None


_LEVEL = sequence(
    word(lambda given, text: text in LEVELS),
    build=lambda level: Modifier(Prep.QUALITY, words=(level,)),
)
_COMMA_NEXT = Parser(lambda given, at: [(at, NOTHING)] if given.ahead[at] == "~comma" else [])
"""It belongs to what comes next, too ("the ball, that round thing, put it in the box")."""
APPOSED = either(
    sequence(
        COMMA,
        phrase("the, the only, that, this"),
        noun_phrase,
        silent(optional("here")),
        either(COMMA, at_end, _COMMA_NEXT),
        build=_said_again,
    ),
    sequence(
        # "The lamp, the one on the left, …"
        "~comma the (one|ones)",
        optional(f"{nouns.RELATIVE}, already, still, now"),
        DESCRIBED,
        either(COMMA, at_end),
    ),
    sequence(
        "~comma the (one|ones)",
        nouns.RELATIVE_NOT,
        DESCRIBED,
        either(COMMA, at_end),
        build=denied,
    ),
    sequence(LIST_COMMA, "the", either(QUALITY, _LEVEL), "one, ones", either(COMMA, at_end)),
)
_modifier = either(
    PLAIN_MODIFIER,
    CONTENTS,
    _matching,
    _UNSAID,
    sequence(nouns.RELATIVE, DESCRIBED),
    sequence(
        "(that|which) (has|have) (fallen|toppled|tipped) [over|down]",
        build=lambda: Modifier(Prep.QUALITY, words=("toppled",)),
    ),
    sequence(
        # "The cup that is standing there"
        either(nouns.RELATIVE, "already"),
        optional("up, down, over, in, on"),
        "there",
        build=lambda: Modifier(Prep.FROM, (NounPhrase(pronoun="it", text="there"),)),
    ),
    # "The cups there must not be moved"
    sequence(
        "there",
        ahead("must", "should", "may", "can", "stay", "remain", "are"),
        build=lambda: Modifier(Prep.FROM, (NounPhrase(pronoun="it", text="there"),)),
    ),
    sequence(
        # "Open the top drawer and close the one below"
        after("one", "drawer", *BOARD_NOUNS),
        one_of(
            {
                Prep.UNDER: "[right|just] (below|underneath|beneath)",
                Prep.ABOVE: "[right|just] above",
            }
        ),
        not_ahead("the", "a", "an", "it", "them", "that", "this", "my", "your"),
        build=lambda prep: Modifier(prep, (NounPhrase(pronoun="it", text="it"),)),
    ),
    sequence(
        # "The mug to its left"
        one_of({Prep[side.name]: said for side, said in places.ITS_SIDE.items()}),
        build=lambda prep: Modifier(prep, (NounPhrase(pronoun="it", text="its"),)),
    ),
    sequence(
        # "That is red and on the left"
        after("that", "which"),
        "and [(that|which) is|is] [also]",
        either(PLAIN_MODIFIER, quality_alone),
    ),
    sequence(
        after("closest", "nearest", "farthest", "furthest"),
        "and [also] (on|to|at) the",
        phrase("left [side], right [side]"),
        build=lambda said: at_side(f"on the {said}"),
    ),
    sequence(
        "~comma which [is|are|stands|stand|lies|lie|sits|sit] [currently|already]",
        DESCRIBED,
        either(COMMA, at_end),
    ),
    APPOSED,
    sequence(
        # "The bottle farther away"
        phrase("farther, further, farthest, furthest"),
        "away",
        not_ahead("from"),
        build=lambda far: Modifier(Prep.QUALITY, words=(far,)),
    ),
    spanned(
        sequence(
            nouns.RELATIVE_NOT,
            either(DESCRIBED, ANY_QUALITY),
            optional(small_words.ANY_MORE),
            build=denied,
        ),
        lambda said, modifier: replace(modifier, of_several=said.split()[1] in ("are", "do")),
    ),
    sequence(
        nouns.RELATIVE_NOT, separated(noun_phrase, "or, nor, and not", most=3), build=other_than
    ),
    sequence(
        # "That is not in a cup and not red"
        either(
            sequence("[and] not", PLAIN_MODIFIER),
            sequence("and not", QUALITY),
            sequence(
                after("that", "which"),
                "and [(that|which)] (is|are) not",
                either(PLAIN_MODIFIER, QUALITY),
            ),
            sequence(after("not", "neither"), "nor", either(PLAIN_MODIFIER, QUALITY)),
        ),
        build=denied,
    ),
    sequence(OPTIONAL_COMMA, CONTRASTED),
    sequence(COMMA, CONTRASTED, COMMA),
    sequence(OPTIONAL_COMMA, LEAVING_OUT, exceptions, LEFT, build=without_such),
    sequence(COMMA, LEAVING_OUT, exceptions, COMMA, build=without_such),
    sequence(COMMA, WITH_IN_IT, COMMA),
)
MODIFIER.define(_modifier)

"""Rules for where and how a thing is, as it is said behind its noun."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    one_of,
    optional,
    phrase,
    separated,
    sequence,
    spanned,
    valued,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.common import EXACTLY, LIST, noun_phrase
from etot_cli.reasoning.language.grammar.parsers.input import Input, Result
from etot_cli.reasoning.language.grammar.phrases.contents import CONTENTS
from etot_cli.reasoning.language.grammar.phrases.coordination import coordinated
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words import manner, nouns, places, small_words
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    ORDINALS,
    SIDES,
    SIZES,
    is_descriptive,
    singular,
)
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby

_ADJECTIVE = either(
    word(lambda given, text: is_descriptive(text) or text in given.nouns),
    phrase(manner.STATES),
    sequence(phrase("farther, further, farthest, furthest"), "away"),
)
ADJECTIVES = separated(_ADJECTIVE, LIST, most=3)
_SIDE = phrase(places.SIDE)


def _with_prep(prep: Prep, np: NounPhrase) -> Modifier | None:
    """A relation to a thing; "at the top" names a side and no thing, nor does "each other"."""
    side = np.words and all(text in SIDES or text in LEVELS for text in np.words)
    mutual = np.text in ("each other", "one another")
    return None if mutual or (prep is Prep.NEXT_TO and side) else Modifier(prep, (np,))


_DIRECTLY = spellings("right, directly, immediately, straight")


def _rightly(how: str, prep: Prep, np: NounPhrase) -> Modifier | None:
    """A relation to a thing; what is directly on it does not stand on what stands there."""
    found = _with_prep(prep, np)
    direct = prep is Prep.ON and how in _DIRECTLY
    return None if found is None else replace(found, direct=direct)


def _pair(one: NounPhrase, two: NounPhrase | None) -> tuple[NounPhrase, ...] | None:
    """Two things, or what names both; in "the jar and the cup next to it" it is the jar."""
    found = (one,) if two is None else coordinated(one, (two,))
    if two is None or found is None:
        return found
    one, two = found
    if one.words and not one.modifiers and singular(one.head) == one.head:
        told = tuple(
            replace(item, phrases=(one,)) if [np.text for np in item.phrases] in _IT else item
            for item in two.modifiers
        )
        two = replace(two, modifiers=told)
    return one, two


_IT = ["it"], ["its"], ["that"]
BETWEEN = sequence(
    places.BETWEEN, noun_phrase, optional(sequence("and", noun_phrase), None), build=_pair
)


def _between(pair: tuple[NounPhrase, ...]) -> Modifier | None:
    """What is between things; "between the plate" says half of it."""
    alone = len(pair) == 1 and pair[0].determiner in nouns.THE_WORDS and pair[0].words
    half = alone and pair[0].head != "one" and singular(pair[0].head) == pair[0].head
    return None if half else Modifier(Prep.BETWEEN, pair)


COMPARATIVE = word(
    # What is higher may be so by where it stands.
    lambda given, text: (
        SIZES.get(text, ("",))[0] not in ("", "darkness")
        and text.endswith("er")
        and text != "higher"
    )
)
_NEAREST_AREA = sequence(
    "closest to, nearest [to], closer to, nearer to", "the", one_of(places.NEAREST_AREAS)
)


def _in_area(said: str, area: tuple[Nearby, ...]) -> Modifier:
    return Modifier(Prep.AREA, words=tuple(said.split()), area=area)


def at_side(said: str) -> Modifier:
    """At one of its sides ("on the left")."""
    return Modifier(Prep.SIDE, words=tuple(said.split()))


def _colored(np: NounPhrase) -> Modifier:
    """The colour of a thing, or of any of several ("every block of the same colour as a bowl")."""
    any_one = np.determiner in ("a", "an", "any", "one")
    if not any_one:
        return Modifier(Prep.COLORED, (np,))
    return Modifier(Prep.COLORED, (replace(np, determiner="all"),), ANY_SUCH)


ANY_SUCH = ("any",)
"""Of a thing's colour: any of several has it."""
PLAIN_MODIFIER = either(
    sequence(
        optional(phrase(small_words.EXACTLY), ""),
        one_of(places.PREPOSITIONS),
        noun_phrase,
        build=_rightly,
    ),
    sequence(
        EXACTLY,
        one_of(places.ON_SIDE),
        noun_phrase,
        build=lambda prep, np: Modifier(prep, (np,), ("on",)),
    ),
    sequence(
        EXACTLY,
        f"{places.ON_TOP_OF}, (from|off [of]) the top of",
        noun_phrase,
        build=lambda np: Modifier(Prep.ON, (np,), ("top",)),
    ),
    sequence(BETWEEN, build=_between),
    sequence(
        # "No bigger than the cup"
        optional(phrase("no", True), False),
        COMPARATIVE,
        "than",
        noun_phrase,
        build=lambda no, how, np: Modifier(Prep.THAN, (np,), (how,), denied=no),
    ),
    sequence(
        phrase(places.FLANKING),
        noun_phrase,
        build=lambda said, np: Modifier(Prep.FLANKING, (np,), tuple(said.split())),
    ),
    sequence(
        # "Next to the red one on each side"
        places.NEARBY[Nearby.NEXT_TO],
        noun_phrase,
        phrase("(on|at|to) (each|either|both) (side|sides)"),
        build=lambda np, said: Modifier(Prep.FLANKING, (np,), tuple(said.split())),
    ),
    sequence(
        "outside [of]",
        noun_phrase,
        build=lambda np: Modifier(Prep.IN, (np,), ("outside",), denied=True),
    ),
    sequence(nouns.SAME_COLOR, noun_phrase, build=_colored),
    valued(_SIDE, at_side),
    spanned(either(one_of(places.AREAS), _NEAREST_AREA), _in_area),
    sequence(
        word(lambda given, text: text in ORDINALS),
        valued(_SIDE, lambda text: tuple(text.split())),
        build=lambda ordinal, side: Modifier(Prep.SIDE, words=(ordinal, *side)),
    ),
)
QUALITY = valued(ADJECTIVES, lambda words: Modifier(Prep.QUALITY, words=words))
ANY_QUALITY = valued(
    separated(_ADJECTIVE, "or, nor", most=3), lambda words: Modifier(Prep.QUALITY, words=words)
)


def denied(modifier: Modifier) -> Modifier | None:
    """What is not so; "the right not of the cup" is no English, "not without a lid" is with one."""
    return None if modifier.prep is Prep.OF else replace(modifier, denied=not modifier.denied)


def _without_place(given: Input, at: int) -> list[Result]:
    words = given.ahead
    return [
        (end, value)
        for end, value in QUALITY.find(given, at)
        if words[end] not in ("to", "from")
        or (SIDES.get(words[end - 1]) not in ("near", "far") and words[end - 1] != "away")
    ]


quality_alone = Parser(_without_place, lambda: QUALITY.first)
"""Qualities, but no "closest" that says "to" what."""
DESCRIBED = either(PLAIN_MODIFIER, CONTENTS, quality_alone)

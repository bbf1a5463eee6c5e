"""Rules for what follows a noun and singles an instance out: where and how it is, what it is not.

Noun phrases and their modifiers contain each other: the two rules of ``noun_phrases`` that
modifiers need stand in ``common``, and are defined there.
"""

from __future__ import annotations

from functools import partial

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
    quiet,
    separated,
    sequence,
    silent,
    some,
    spanned,
    valued,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    EXACTLY,
    LIST,
    LIST_COMMA,
    OPTIONAL_COMMA,
    after,
    ahead,
    exceptions,
    not_ahead,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.parsers.input import Input, Result
from etot_cli.reasoning.language.grammar.phrases.contents import CONTENTS, WITH_IN_IT
from etot_cli.reasoning.language.grammar.phrases.coordination import coordinated
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words import manner, nouns, places, small_words
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.lexicon import (
    BOARD_NOUNS,
    COMMON_NOUNS,
    LEVELS,
    ORDINALS,
    SIDES,
    THING_NOUNS,
    is_descriptive,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby

LEFT = optional(manner.IS_LEFT)
"""Behind what is left out: that it stays so."""
ADJECTIVE = either(
    word(lambda given, text: is_descriptive(text) or text in given.nouns),
    phrase(manner.STATES),
    sequence(phrase("farther, further, farthest, furthest"), "away"),
)
ADJECTIVES = separated(ADJECTIVE, LIST, most=3)
PREPOSITION = one_of(places.PREPOSITIONS)
SIDE = phrase(places.SIDE)


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


_NEAREST_AREA = sequence(
    "closest to, nearest [to], closer to, nearer to", "the", one_of(places.NEAREST_AREAS)
)


def _in_area(said: str, area: tuple[Nearby, ...]) -> Modifier:
    return Modifier(Prep.AREA, words=tuple(said.split()), area=area)


def _at_side(said: str) -> Modifier:
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
    sequence(optional(phrase(small_words.EXACTLY), ""), PREPOSITION, noun_phrase, build=_rightly),
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
        "outside [of]",
        noun_phrase,
        build=lambda np: Modifier(Prep.IN, (np,), ("outside",), denied=True),
    ),
    sequence(nouns.SAME_COLOR, noun_phrase, build=_colored),
    valued(SIDE, _at_side),
    spanned(either(one_of(places.AREAS), _NEAREST_AREA), _in_area),
    sequence(
        word(lambda given, text: text in ORDINALS),
        valued(SIDE, lambda text: tuple(text.split())),
        build=lambda ordinal, side: Modifier(Prep.SIDE, words=(ordinal, *side)),
    ),
)
_matching = either(
    sequence(
        nouns.MATCHING,
        optional("as (it|them|its own|their own|itself|themselves|theirs|they have|it has)"),
        build=lambda: Modifier(Prep.MATCHING),
    ),
    phrase(nouns.OTHER_COLOR, Modifier(Prep.MATCHING, denied=True)),
)
QUALITY = valued(ADJECTIVES, lambda words: Modifier(Prep.QUALITY, words=words))
_none_of = valued(
    separated(ADJECTIVE, "or, nor", most=3), lambda words: Modifier(Prep.QUALITY, words=words)
)


def denied(modifier: Modifier) -> Modifier | None:
    """What is not so; "the right not of the cup" is no English, "not without a lid" is with one."""
    return None if modifier.prep is Prep.OF else replace(modifier, denied=not modifier.denied)


def _is_adjective(word: str) -> bool:
    """Whether a word is said of a thing and names none ("the orange", "the lime")."""
    return (is_descriptive(word) or word in LEVELS) and word not in COMMON_NOUNS


def _one_of_them(np: NounPhrase) -> NounPhrase:
    """With "one" for the noun that "the biggest" leaves out."""
    bare = np.determiner == "the" and np.words and _is_adjective(np.words[-1])
    return replace(np, words=(*np.words, "one")) if bare else np


_OF_THOSE = frozenset(
    f"{some} of {those}" for some in ("one", "any") for those in ("those", "these", "the")
)


def _such(np: NounPhrase) -> NounPhrase:
    """All of which one is denied: "not one of those on the tray", "but not one with a lid"."""
    one = np.determiner in {"one", "any", *_OF_THOSE} and not np.words
    one |= np.determiner in ("", "any", "any one") and np.words == ("one",)
    return replace(np, determiner="all", words=("ones",)) if one and np.modifiers else np


def _other_than(found: tuple[NounPhrase, ...]) -> Modifier | None:
    """What it is not: "not the big cup", "not the biggest" of them, "neither a cup nor a can"."""
    nps = tuple(map(_one_of_them, found))
    if any(not np.words or _is_adjective(np.words[-1]) for np in nps):
        return None
    return Modifier(Prep.EXCEPT, nps)


def excepting(nps: tuple[NounPhrase, ...], *, only: bool = False) -> Modifier | None:
    """What is left out; or (``only``) in "but only the red one" all else is. All of
    "everything but the cup off the tray" is off the tray.
    """
    said = {nouns.is_only(np.determiner) for np in nps}
    left_out = tuple(map(_one_of_them, nps))
    source = any(item.prep is Prep.FROM for np in nps for item in np.modifiers)
    fits = said == {only} and not (source or any(np.without for np in nps))
    return Modifier(Prep.EXCEPT, left_out, denied=only) if fits else None


LEAVING_OUT = phrase(nouns.EXCEPT)


def without_such(said: str, nps: tuple[NounPhrase, ...]) -> Modifier | None:
    """What is left out; "not one" of some sort is all of it."""
    if "not" not in said.split():
        return excepting(nps)
    such = tuple(map(_such, nps))
    # "Not one", and "not one of those", of what?
    none = any(np.determiner.split()[:1] == ["one"] and not np.words for np in such)
    return None if none else excepting(such)


_only_ahead = Parser(lambda given, at: [(at, NOTHING)] if nouns.is_only(given.ahead[at]) else [])
ONLY_THOSE = sequence(_only_ahead, exceptions, build=partial(excepting, only=True))


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
MODIFIER = Rule()


def _nested(modifiers: tuple[Modifier, ...]) -> tuple[Modifier, ...] | None:
    """In "the top block of the stack of three blocks" the last "of" is about the stack."""
    return None if [item.prep for item in modifiers].count(Prep.OF) > 1 else modifiers


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


def _contrasted(nps: tuple[NounPhrase, ...]) -> Modifier | None:
    """What is not meant, but what a thing is told from."""
    nps = tuple(map(_such, nps))
    told = all(np.words and (np.determiner or not is_descriptive(np.head)) for np in nps)
    return Modifier(Prep.CONTRAST, tuple(map(_one_of_them, nps))) if told else None


def _that_one(the: str, np: NounPhrase) -> Modifier | None:
    """That things are a certain one of their kind ("neither of them may be the red one")."""
    said = replace(np, determiner=the, text=f"{the} {np.text}")
    return None if np.determiner else Modifier(Prep.EXCEPT, (_one_of_them(said),), denied=True)


_MAY_BE = "(may|can|should|must|shall|is to|are to) be"
NONE_OF_THEM = sequence(
    f"[but|and] (neither [one]|none|not one) of (them|which|these|those) [is|are|being|{_MAY_BE}],"
    f" [but|and] neither [one] {_MAY_BE}",
    either(
        PLAIN_MODIFIER,
        CONTENTS,
        QUALITY,
        _none_of,
        sequence(phrase("the"), noun_phrase, build=_that_one),
    ),
    build=denied,
)
"""Behind several things, what is true of none of them."""
OF_ALL = sequence("~comma", NONE_OF_THEM, either(COMMA, at_end))
"""Likewise, set off by commas ("two cups, neither of them red, on the tray")."""
CONTRASTED = quiet(
    sequence(
        either(nouns.CONTRAST, sequence(after("rather", "prefer"), "than")),
        separated(noun_phrase, "or, nor", most=3),
        not_ahead("first", "last"),  # "…, not the cup first" speaks of an order
        build=_contrasted,
    )
)
NOT_BUT = quiet(
    sequence(
        "neither, not",
        sequence(separated(noun_phrase, "or, nor", most=3), build=_contrasted),
        OPTIONAL_COMMA,
        "but [rather]",
        noun_phrase,
        build=lambda out, np: np.told_by(out),
    )
)
"""What is meant behind what is not ("neither the cup nor the can but the jar")."""


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
        build=lambda said: _at_side(f"on the {said}"),
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
    sequence(
        nouns.RELATIVE_NOT,
        either(DESCRIBED, _none_of),
        optional(small_words.ANY_MORE),
        build=denied,
    ),
    sequence(
        nouns.RELATIVE_NOT, separated(noun_phrase, "or, nor, and not", most=3), build=_other_than
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

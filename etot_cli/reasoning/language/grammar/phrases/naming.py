"""Rules for a noun phrase: determiner, adjectives and noun, and what stands in their place."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    at_end,
    either,
    optional,
    phrase,
    quiet,
    sequence,
    some,
    spanned,
    valued,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    DESCRIPTIVE,
    DETERMINER,
    NOUN_WORD,
    OPTIONAL_DETERMINER,
    WORDS,
    ahead,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.comparing import (
    MORE_THAN,
    NEAREST_TO,
    ONE_COMPARED,
)
from etot_cli.reasoning.language.grammar.phrases.contrasts import NOT_BUT, OF_ALL
from etot_cli.reasoning.language.grammar.phrases.descriptions import QUALITY
from etot_cli.reasoning.language.grammar.phrases.free_relatives import (
    FREE_CHOICE,
    FREE_RELATIVE,
    WHICHEVER,
)
from etot_cli.reasoning.language.grammar.phrases.levels import LEVEL
from etot_cli.reasoning.language.grammar.phrases.modifiers import MODIFIERS, ONE_SUCH
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words import nouns, small_words
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    NUMBERS,
    ORDINALS,
    SIDES,
    THING_NOUNS,
    is_descriptive,
    matches_any,
    singular,
    word_set,
)
from etot_cli.reasoning.language.words.places import Prep

_PRONOUN = phrase("it, them, they, this, that, these, those, its, he, him, she, her")
_ROBOT = word(lambda given, text: text in ("me", "you", "us", "robot"))
_NEAREST = word_set("nearest closest farthest furthest")


def _named(determiner: str, words: tuple[str, ...], modifiers: Any) -> NounPhrase | None:
    """A noun; "one" alone is a number, and no noun after another one ("the cups one …")."""
    for before, said in pairwise(words):
        if said in _NEAREST and not (is_descriptive(before) or before in ORDINALS):
            return None  # "cup nearest shelf"
    if words[0] == "one" and len(words) > 1 and determiner == "any":
        return None  # "any one pen" is one of them, "the one pen" the only one
    if determiner in ("whichever", "whatever") and any(m.words == ("left",) for m in modifiers):
        return None  # it is not on the left
    if determiner.startswith("whichever of ") and singular(words[-1]) == words[-1]:
        return None  # "whichever of the cup and the mug": of one alone it is none
    single = determiner in ("the", "a", "an") and singular(words[-1]) == words[-1]
    plain_noun = not (matches_any(words[-1], THING_NOUNS) or is_category(words[-1]))
    if single and plain_noun and any(item.of_several for item in modifiers):
        return None  # "the cups on the tray that are not red" tells which cups
    number = words[-1] == "one" and not (determiner and len(words) == 1)
    plain = number and not (len(words) > 1 and singular(words[-2]) == words[-2])
    return None if plain else NounPhrase(determiner, words, modifiers)


def _joined(
    determiner: str, first: tuple[str, ...], rest: Any, modifiers: Any
) -> NounPhrase | None:
    if len(rest) < 2 or not all(map(is_descriptive, first)) or not is_descriptive(rest[0]):
        return None
    return NounPhrase(determiner, (*first, *rest), modifiers, joined=True)


def _nounless(determiner: str, modifiers: Any) -> NounPhrase | None:
    """A determiner alone; in "the other one" the last word is the noun, and "all" are all of those
    that were spoken of, whatever the last of them is called.
    """
    if determiner in ("all", "each") and not modifiers:
        return NounPhrase(determiner, pronoun="them")
    of_one = (np for m in modifiers if m.prep is Prep.OF for np in m.phrases if np.words)
    if determiner == "whichever" and any(singular(np.head) == np.head for np in of_one):
        return None
    alone = determiner.split()
    return None if len(alone) > 1 and alone[-1] == "one" else NounPhrase(determiner, (), modifiers)


def _negative(determiner: str, without: str, words: Any, modifiers: Any) -> NounPhrase:
    return NounPhrase(determiner, words, modifiers, without=(without,))


def _general(determiner: str, head: str, quality: Any, modifiers: Any) -> NounPhrase:
    modifiers = modifiers if quality is None else (quality, *modifiers)
    return NounPhrase(determiner, (head,), modifiers)


def _where_it_is(words: tuple[str, ...], np: NounPhrase) -> NounPhrase | None:
    """The place that something is in or on ("the same drawer as the pen")."""
    vague = matches_any(words[-1], (*THING_NOUNS, "color", "colour", "place", "way", "side"))
    return None if vague else NounPhrase("the", words, (Modifier(Prep.WITH, (np,), ("same",)),))


def _any_of(determiner: str, first: str, more: Any, rest: Any, modifiers: Any) -> NounPhrase | None:
    """All that are one or the other ("all red or blue cups")."""
    words = (first, *more, *rest)
    several = determiner in ("all", "all the", "the", "") and singular(rest[-1]) != rest[-1]
    return NounPhrase(determiner, words, modifiers, joined=True) if several else None


def _pronoun(pronoun: str, modifiers: Any) -> NounPhrase | None:
    if modifiers and pronoun in ("it", "its", "he", "him", "she", "her"):
        return None
    return NounPhrase(modifiers=modifiers, pronoun=pronoun)


def _each_so(
    determiner: str, words: tuple[str, ...], modifiers: Any, so: Modifier
) -> NounPhrase | None:
    """Several things with what is said of each behind them ("two cups, neither of them red")."""
    several = singular(words[-1]) != words[-1]
    return NounPhrase(determiner, words, (*modifiers, so)) if several else None


def _stack_of(determiner: str, count: str, noun: str, stack: str) -> NounPhrase | None:
    """A stack with what it is of before it ("the three-block tower")."""
    of = NounPhrase(count, (noun,), text=f"{count} {noun}".strip())
    named = is_descriptive(noun) or singular(noun) != noun
    return None if named else NounPhrase(determiner, (stack,), (Modifier(Prep.OF, (of,)),))


def _all_of_them(words: tuple[str, ...], modifiers: Any, said: str) -> NounPhrase:
    """The plural that a quantity follows ("the cans, both of them, …")."""
    return NounPhrase("both" if said == "both" else "all the", words, modifiers)


_OF_THEM = sequence(COMMA, phrase("all, both, each, every one"), "of them", either(COMMA, at_end))
_LEVEL_OF_IT = sequence(LEVEL, either(COMMA, at_end))
"""Behind a comma ("the chest, upper drawer")."""
_INTO = ("open", "close", "shut", "in", "into", "inside")
_LEVEL_ALONE = sequence(
    Parser(lambda given, at: [(at, NOTHING)] if at and given.words[at - 1] in _INTO else []),
    word(lambda given, text: text in LEVELS),
    ahead("~comma", "and", "then", ""),
    build=lambda level: NounPhrase("the", (level,)),
)
"""A drawer or board by its level alone ("open upper, pen into upper")."""
_OR_OTHER = some(sequence(small_words.OR, DESCRIPTIVE), least=1, most=3)
NAMED = spanned(
    either(
        sequence(OPTIONAL_DETERMINER, WORDS, MODIFIERS, build=_named),
        NEAREST_TO,
        MORE_THAN,
        WHICHEVER,
        FREE_CHOICE,
        FREE_RELATIVE,
        sequence(
            # "The top two drawers"
            "the",
            word(lambda given, text: is_descriptive(text) or text in LEVELS),
            word(lambda given, text: NUMBERS.get(text, 1) > 1),
            WORDS,
            MODIFIERS,
            build=lambda first, count, rest, modifiers: NounPhrase(
                f"the {count}", (first, *rest), modifiers
            ),
        ),
        sequence(
            "the",
            phrase("near"),
            WORDS,
            MODIFIERS,
            build=lambda near, words, modifiers: NounPhrase("the", (near, *words), modifiers),
        ),
        sequence(
            "a",
            WORDS,
            "of (its|their) own",
            build=lambda words: NounPhrase("a", ("different", *words)),
        ),
        sequence(
            phrase("the, that, this"),
            some(phrase("little, small"), most=1),
            phrase(nouns.STACK),
            optional(sequence("of", noun_phrase), None),
            build=lambda det, size, noun, of: NounPhrase(
                det,
                (*filter(None, (size,)), noun),
                () if of is None else (Modifier(Prep.OF, (of,)),),
            ),
        ),
        sequence(
            # "The two-block stack"
            phrase("the, that, this"),
            optional(word(lambda given, text: NUMBERS.get(text, 1) > 1), ""),
            NOUN_WORD,
            phrase(nouns.STACK),
            build=_stack_of,
        ),
        quiet(sequence("[the] same", WORDS, "as", noun_phrase, build=_where_it_is)),
        sequence("the, these, those", WORDS, MODIFIERS, _OF_THEM, build=_all_of_them),
        sequence(OPTIONAL_DETERMINER, WORDS, MODIFIERS, OF_ALL, build=_each_so),
        sequence(
            phrase("a, an, another, any, any other, some other"),
            WORDS,
            MODIFIERS,
            ONE_SUCH,
            build=lambda det, words, modifiers, such: NounPhrase(det, words, (*modifiers, such)),
        ),
        sequence(
            optional("the, a, their, its, his, her"),
            nouns.MATCHING_ADJECTIVES,
            WORDS,
            build=lambda words: NounPhrase("the", words, (Modifier(Prep.MATCHING),)),
        ),
        sequence(OPTIONAL_DETERMINER, _ROBOT, build=lambda det, text: NounPhrase(det, (text,))),
        sequence(OPTIONAL_DETERMINER, "non", NOUN_WORD, WORDS, MODIFIERS, build=_negative),
        sequence(DETERMINER, "not", NOUN_WORD, WORDS, MODIFIERS, build=_negative),
        sequence(
            OPTIONAL_DETERMINER,
            some(NOUN_WORD, least=1, most=2),
            "and",
            WORDS,
            MODIFIERS,
            build=_joined,
        ),
        sequence(OPTIONAL_DETERMINER, DESCRIPTIVE, _OR_OTHER, WORDS, MODIFIERS, build=_any_of),
        sequence(
            OPTIONAL_DETERMINER,
            WORDS,
            nouns.RELATIVE,
            DESCRIPTIVE,
            _OR_OTHER,
            build=lambda det, words, first, more: _any_of(det, first, more, words, ()),
        ),
        sequence(
            "everything, anything",
            optional(nouns.RELATIVE),
            DESCRIPTIVE,
            _OR_OTHER,
            MODIFIERS,
            build=lambda first, more, mods: _any_of("all", first, more, ("objects",), mods),
        ),
        sequence(
            OPTIONAL_DETERMINER,
            phrase(nouns.GENERAL_NOUNS),
            optional(QUALITY, None),
            MODIFIERS,
            build=_general,
        ),
        NOT_BUT,
        ONE_COMPARED,
        sequence(
            # "The finished tower"
            phrase("the, this, that"),
            nouns.JUST_BUILT,
            valued(phrase(nouns.STACK), lambda noun: (noun,)),
            MODIFIERS,
            build=NounPhrase,
        ),
        sequence(
            # "The two neighbours of the red cube"
            phrase("the, the two, both, both of the"),
            "neighbours, neighbors, immediate neighbours, immediate neighbors",
            "of",
            noun_phrase,
            build=lambda det, np: NounPhrase(det, ("objects",), (Modifier(Prep.FLANKING, (np,)),)),
        ),
        sequence(
            # "The outer two", "those left three"
            "the, these, those",
            word(lambda _, text: text in SIDES or text in LEVELS),
            word(lambda _, text: NUMBERS.get(text, 1) > 1),
            build=lambda side, count: NounPhrase(f"the {count}", (side, "ones")),
        ),
        sequence(
            # "Only jar 3"
            "only, just",
            WORDS,
            build=lambda words: NounPhrase("only", words) if words[-1].isdigit() else None,
        ),
        sequence(DETERMINER, MODIFIERS, build=_nounless),
        _LEVEL_ALONE,
        sequence(
            OPTIONAL_DETERMINER,
            WORDS,
            either(
                sequence("'s", WORDS, MODIFIERS),
                sequence(COMMA, optional("[in|on|into|onto] the"), _LEVEL_OF_IT),
            ),
            build=lambda det, owner, part: NounPhrase(
                "the", part[0], part[1], owner=NounPhrase(det, owner, text=" ".join(owner))
            ),
        ),
        sequence(_PRONOUN, MODIFIERS, build=_pronoun),
        sequence(
            phrase("them, they, these, those"),
            phrase("all, both"),
            build=lambda pronoun, det: NounPhrase(det, pronoun=pronoun),
        ),
        sequence(
            DETERMINER,
            _PRONOUN,
            build=lambda det, pronoun: (
                None if det in nouns.THE_WORDS else NounPhrase(det, pronoun=pronoun)
            ),
        ),
    ),
    lambda text, np: replace(np, text=text),
)
"""A noun phrase."""

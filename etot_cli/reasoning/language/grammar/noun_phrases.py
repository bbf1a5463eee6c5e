"""Rules for noun phrases: determiner, adjectives and noun, several of them in a row."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

from etot_cli.reasoning.language.grammar.common import (
    COMMA,
    LIST,
    LIST_COMMA,
    NOUN_WORD,
    OPTIONAL_COMMA,
    alternatives,
)
from etot_cli.reasoning.language.grammar.coordination import coordinated
from etot_cli.reasoning.language.grammar.modifiers import (
    MODIFIERS,
    NOT_BUT,
    PLAIN_MODIFIER,
    QUALITY,
    exceptions,
    noun_phrase,
    quality_alone,
)
from etot_cli.reasoning.language.grammar.parsing import (
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
from etot_cli.reasoning.language.grammar.syntax import Modifier, NounPhrase, Things
from etot_cli.reasoning.language.words import nouns, small_words
from etot_cli.reasoning.language.words.lexicon import (
    BOARD_NOUNS,
    COMMON_NOUNS,
    LEVELS,
    NUMBERS,
    ORDINALS,
    THING_NOUNS,
    basic_color,
    is_descriptive,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep

_NUMBER = sequence(
    word(lambda given, text: text.isdigit() and len(text) < 3), optional("of [the|these|those]")
)
DETERMINER = either(
    phrase(nouns.DETERMINERS),
    _NUMBER,
    sequence(
        phrase("the, these, those, all, all the, all of the"),
        _NUMBER,
        build=lambda *words: " ".join(words),
    ),
)
PRONOUN = phrase("it, them, they, this, that, these, those, its")
ROBOT = word(lambda given, text: text in ("me", "you", "us", "robot"))
WORDS = some(NOUN_WORD, least=1, most=6)


def _named(determiner: str, words: tuple[str, ...], modifiers: Any) -> NounPhrase | None:
    """A noun; "one" alone is a number, and no noun after another one ("the cups one …")."""
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
    """A determiner alone; in "the other one" the last word is the noun."""
    alone = determiner.split()
    return None if len(alone) > 1 and alone[-1] == "one" else NounPhrase(determiner, (), modifiers)


def _negative(determiner: str, without: str, words: Any, modifiers: Any) -> NounPhrase:
    return NounPhrase(determiner, words, modifiers, without=(without,))


def _general(determiner: str, head: str, quality: Any, modifiers: Any) -> NounPhrase:
    modifiers = modifiers if quality is None else (quality, *modifiers)
    return NounPhrase(determiner, (head,), modifiers)


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
    if modifiers and pronoun in ("it", "its"):
        return None
    return NounPhrase(modifiers=modifiers, pronoun=pronoun)


def _all_of_them(words: tuple[str, ...], modifiers: Any, said: str) -> NounPhrase:
    """The plural that a quantity follows ("the cans, both of them, …")."""
    return NounPhrase("both" if said == "both" else "all the", words, modifiers)


OPTIONAL_DETERMINER = optional(DETERMINER, "")
_OF_THEM = sequence(COMMA, phrase("all, both, each, every one"), "of them", either(COMMA, at_end))
_ANY_ONE = either("one, of them", silent(NOUN_WORD))
_FREE_CHOICE = phrase("any, whichever, a, an, either")
_DESCRIPTIVE = word(lambda given, text: is_descriptive(text))
LEVEL = sequence(
    word(lambda given, text: text in LEVELS),
    word(lambda given, text: text in (*BOARD_NOUNS, "drawer")),
    build=lambda *words: (words, ()),
)
"""Of furniture: "top shelf", and nothing behind it."""
_PART_OF_IT = sequence(LEVEL, either(COMMA, at_end))
"""Behind a comma ("the chest, upper drawer")."""
_OR_OTHER = some(sequence(small_words.OR, _DESCRIPTIVE), least=1, most=3)
noun_phrase.define(
    spanned(
        either(
            sequence(OPTIONAL_DETERMINER, WORDS, MODIFIERS, build=_named),
            sequence(
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
            ),
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
                "whichever, whatever",
                WORDS,
                "is",
                either(PLAIN_MODIFIER, quality_alone),
                build=lambda words, modifier: NounPhrase("the only", words, (modifier,)),
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
                phrase(nouns.STACK),
                optional(sequence("of", noun_phrase), None),
                build=lambda det, noun, of: NounPhrase(
                    det, (noun,), () if of is None else (Modifier(Prep.OF, (of,)),)
                ),
            ),
            quiet(sequence("[the] same", WORDS, "as", noun_phrase, build=_where_it_is)),
            sequence(_FREE_CHOICE, WORDS, nouns.AS_YOU_LIKE, build=NounPhrase),
            sequence("the, these, those", WORDS, MODIFIERS, _OF_THEM, build=_all_of_them),
            sequence(
                "a, an, one, any",
                WORDS,
                MODIFIERS,
                COMMA,
                "any",
                _ANY_ONE,
                either(COMMA, at_end),
                build=partial(NounPhrase, "any"),
            ),
            sequence(
                optional("the, a, their, its, his"),
                nouns.MATCHING_ADJECTIVES,
                WORDS,
                build=lambda words: NounPhrase("the", words, (Modifier(Prep.MATCHING),)),
            ),
            sequence(
                phrase(nouns.FREE_RELATIVE),
                either(PLAIN_MODIFIER, quality_alone),
                MODIFIERS,
                build=lambda said, first, more: NounPhrase(
                    "all other" if "else" in said else "all", ("objects",), (first, *more)
                ),
            ),
            sequence(OPTIONAL_DETERMINER, ROBOT, build=lambda det, text: NounPhrase(det, (text,))),
            sequence(OPTIONAL_DETERMINER, "non, not", NOUN_WORD, WORDS, MODIFIERS, build=_negative),
            sequence(
                OPTIONAL_DETERMINER,
                some(NOUN_WORD, least=1, most=2),
                "and",
                WORDS,
                MODIFIERS,
                build=_joined,
            ),
            sequence(OPTIONAL_DETERMINER, _DESCRIPTIVE, _OR_OTHER, WORDS, MODIFIERS, build=_any_of),
            sequence(
                OPTIONAL_DETERMINER,
                WORDS,
                nouns.RELATIVE,
                _DESCRIPTIVE,
                _OR_OTHER,
                build=lambda det, words, first, more: _any_of(det, first, more, words, ()),
            ),
            sequence(
                "everything, anything",
                optional(nouns.RELATIVE),
                _DESCRIPTIVE,
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
            sequence(DETERMINER, MODIFIERS, build=_nounless),
            sequence(
                OPTIONAL_DETERMINER,
                WORDS,
                either(
                    sequence("'s", WORDS, MODIFIERS),
                    sequence(COMMA, optional("[in|on|into|onto] the"), _PART_OF_IT),
                ),
                build=lambda det, owner, part: NounPhrase(
                    "the", part[0], part[1], owner=NounPhrase(det, owner, text=" ".join(owner))
                ),
            ),
            sequence(PRONOUN, MODIFIERS, build=_pronoun),
            sequence(
                phrase("them, they, these, those"),
                phrase("all, both"),
                build=lambda pronoun, det: NounPhrase(det, pronoun=pronoun),
            ),
            sequence(
                DETERMINER,
                PRONOUN,
                build=lambda det, pronoun: (
                    None if det in nouns.THE_WORDS else NounPhrase(det, pronoun=pronoun)
                ),
            ),
        ),
        lambda text, np: replace(np, text=text),
    )
)


def _both(both: Any, nps: tuple[NounPhrase, ...] | None) -> tuple[NounPhrase, ...] | None:
    return None if nps is None or (both and len(nps) < 2) else nps


def _listed(first: NounPhrase, more: tuple[Any, ...]) -> tuple[NounPhrase, ...] | None:
    """Several phrases; in "the cup, the left one" no "and" says that there are two."""
    joined = any(said for said, _ in more)
    apposed = any(np.head == "one" for _, np in more)
    renamed = any(
        np.determiner.startswith("any") and np.words in ((), first.words) for _, np in more
    )
    if renamed or (apposed and not joined):
        return None
    return coordinated(first, tuple(np for _, np in more))


def _parts(
    whole: str, words: tuple[str, ...], parts: tuple[tuple[str, ...], ...]
) -> tuple[NounPhrase, ...] | None:
    """Each of several things that the words behind them tell apart ("both cups, red and blue")."""
    if len(parts) < 2 or NUMBERS.get(whole.split()[-1], len(parts)) != len(parts):
        return None
    each = ((*words[:-1], *part, singular(words[-1])) for part in parts)
    return tuple(NounPhrase("the", said, text=f"the {' '.join(said)}") for said in each)


_PART = sequence(optional("the"), some(_DESCRIPTIVE, least=1, most=3), optional("one"))
_PARTS = sequence(
    phrase("the, these, both, both the, the two, the three, all three, all three the, all two"),
    WORDS,
    COMMA,
    separated(_PART, LIST, most=4),
    either(COMMA, at_end),
    build=_parts,
)
_COORDINATION = sequence(
    noun_phrase,
    some(
        either(
            sequence(LIST_COMMA, noun_phrase, build=lambda np: (False, np)),
            sequence(OPTIONAL_COMMA, small_words.AND, noun_phrase, build=lambda np: (True, np)),
        ),
        most=9,
    ),
    build=_listed,
)
_COLORED_ONES = sequence(
    word(lambda given, text: basic_color(text) is not None and text not in COMMON_NOUNS),
    build=lambda color: (NounPhrase("all", (color, "ones"), text=color),),
)
_NEITHER = sequence(alternatives(noun_phrase, 3), build=lambda nps: nps if nps[1:] else None)
exceptions.define(either(_COORDINATION, _COLORED_ONES, _NEITHER))
NP_LIST = Rule(either(_PARTS, sequence(optional(phrase("both"), None), _COORDINATION, build=_both)))


def _one_of(nps: tuple[NounPhrase, ...]) -> Things | None:
    """One of several things; "what is in a cup or a bowl" is no choice between that and a bowl."""
    landmarks = [any(item.phrases for item in np.modifiers) for np in nps]
    if any(landmarks[:-1]) and not landmarks[-1]:
        return None
    whole = coordinated(nps[0], nps[1:]) if len(nps) > 1 else None
    return None if whole is None else Things(whole, either=True)


ALL_THINGS = valued(NP_LIST, Things)
"""Several things, and no choice between them."""
CHOICE = Rule(
    either(
        sequence(alternatives(noun_phrase, 5), build=_one_of),
        sequence(
            alternatives(noun_phrase, 1),
            "~comma [but] not both ~comma",
            build=lambda nps: _one_of(nps) if nps[1:] else None,
        ),
    )
)
"""One of several things."""
THINGS = Rule(either(ALL_THINGS, CHOICE))

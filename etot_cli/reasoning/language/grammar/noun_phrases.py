"""Rules for noun phrases: determiner, adjectives and noun, and what singles an instance out."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from etot_cli.reasoning.language.grammar.common import (
    COMMA,
    EITHER,
    EXACTLY,
    LIST,
    NOUN_WORD,
    OR,
    WITH,
)
from etot_cli.reasoning.language.grammar.parsing import (
    Parser,
    Rule,
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
from etot_cli.reasoning.language.words import manner, nouns, places
from etot_cli.reasoning.language.words.lexicon import (
    COMMON_NOUNS,
    LEVELS,
    ORDINALS,
    SIDES,
    is_descriptive,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep

noun_phrase = Rule()
exceptions = Rule()
_NUMBER = sequence(
    word(lambda given, text: text.isdigit() and len(text) < 3),
    silent(optional(phrase("of [the|these|those]"), None)),
    build=lambda number: number,
)
DETERMINER = either(phrase(", ".join(nouns.DETERMINERS)), _NUMBER)
PRONOUN = phrase("it, them, they, this, that, these, those, its")
RELATIVE = silent(phrase(nouns.RELATIVE))
DENIED = silent(phrase(nouns.RELATIVE_NOT))
ADJECTIVE = either(
    word(lambda given, text: is_descriptive(text) or text in given.nouns),
    phrase(manner.STATES),
)
ADJECTIVES = separated(ADJECTIVE, LIST, most=3)
NON = silent(phrase("non, not"))


PREPOSITION = one_of(places.PREPOSITIONS)
SIDE = phrase(places.SIDE)


def _with_prep(prep: Prep, np: NounPhrase) -> Modifier | None:
    """A relation to a thing; "at the top" names a side and no thing."""
    side = np.words and all(text in SIDES or text in LEVELS for text in np.words)
    return None if prep is Prep.NEAR and side else Modifier(prep, (np,))


_plain_modifier = either(
    sequence(EXACTLY, PREPOSITION, noun_phrase, build=_with_prep),
    sequence(
        silent(phrase("[in] between")),
        noun_phrase,
        silent(phrase("and")),
        noun_phrase,
        build=lambda one, two: (
            None if (pair := coordinated(one, (two,))) is None else Modifier(Prep.BETWEEN, pair)
        ),
    ),
    sequence(
        silent(phrase("[in] between")), noun_phrase, build=lambda np: Modifier(Prep.BETWEEN, (np,))
    ),
    valued(SIDE, lambda text: Modifier(Prep.SIDE, words=tuple(text.split()))),
    sequence(
        word(lambda given, text: text in ORDINALS),
        valued(SIDE, lambda text: tuple(text.split())),
        build=lambda ordinal, side: Modifier(Prep.SIDE, words=(ordinal, *side)),
    ),
)
_INSIDE_IT = silent(either(phrase("inside, in there, in"), phrase("(inside|in) (it|them|which)")))
_UPON_IT = silent(phrase("on [top of] (it|them), on top"))
_WITHOUT = silent(phrase(nouns.LACKING))
_HAVING = silent(either(WITH, phrase(nouns.CONTAINING)))


def _contents_with(having: Parser, denied: bool) -> Parser:
    return either(
        sequence(
            having,
            noun_phrase,
            # "Without" before a bare noun may stand before anything.
            build=lambda np: (
                None if denied and not np.determiner else Modifier(Prep.WITH, (np,), denied=denied)
            ),
        ),
        sequence(
            having,
            noun_phrase,
            _INSIDE_IT,
            build=lambda np: Modifier(Prep.CONTAINING, (np,), denied=denied),
        ),
        sequence(
            having,
            noun_phrase,
            _UPON_IT,
            build=lambda np: Modifier(Prep.BEARING, (np,), denied=denied),
        ),
    )


_contents = either(
    _contents_with(_HAVING, denied=False),
    _contents_with(_WITHOUT, denied=True),
    sequence(
        _HAVING,
        silent(phrase("nothing")),
        _INSIDE_IT,
        build=lambda: Modifier(Prep.QUALITY, words=("empty",)),
    ),
    quiet(
        sequence(
            silent(optional(phrase("that, which"), None)),
            noun_phrase,
            either(
                phrase("(is|are|lies|lie|sits) [currently] in", Prep.CONTAINING),
                phrase("(is|are|stands|stand|lies|lie|sits) [currently] on", Prep.BEARING),
            ),
            build=lambda np, prep: Modifier(prep, (np,)),
        )
    ),
)
_matching = sequence(
    silent(phrase(nouns.MATCHING)),
    silent(optional(phrase("as (it|them|its own|their own)"), None)),
    build=lambda: Modifier(Prep.MATCHING),
)
_quality = valued(ADJECTIVES, lambda words: Modifier(Prep.QUALITY, words=words))
_none_of = sequence(
    ADJECTIVE,
    some(sequence(OR, ADJECTIVE, build=lambda text: text), least=1, most=2),
    build=lambda first, more: Modifier(Prep.QUALITY, words=(first, *more)),
)


def _one_of_them(np: NounPhrase) -> NounPhrase:
    """With "one" for the noun that "the biggest" leaves out."""
    bare = np.determiner == "the" and np.words and is_descriptive(np.words[-1])
    return replace(np, words=(*np.words, "one")) if bare else np


def _other_than(np: NounPhrase) -> Modifier | None:
    """What it is not: "not the big cup", "not the biggest" of them."""
    np = _one_of_them(np)
    if not np.words or is_descriptive(np.words[-1]):
        return None
    return Modifier(Prep.EXCEPT, (np,))


_described = either(_plain_modifier, _contents, _quality)
MODIFIER = Rule()
MODIFIERS = some(MODIFIER, most=4)
_modifier = either(
    _plain_modifier,
    _contents,
    _matching,
    sequence(RELATIVE, _described, build=lambda modifier: modifier),
    sequence(
        silent(phrase("~comma which (is|are)")),
        either(_plain_modifier, _quality),
        COMMA,
        build=lambda modifier: modifier,
    ),
    sequence(
        DENIED,
        either(_described, _none_of),
        build=lambda modifier: replace(modifier, denied=True),
    ),
    sequence(
        DENIED,
        noun_phrase,
        build=_other_than,
    ),
    sequence(
        silent(phrase(nouns.RELATIVE_NEITHER)),
        valued(
            separated(ADJECTIVE, silent(phrase("nor, or")), most=3),
            lambda words: Modifier(Prep.QUALITY, words=words, denied=True),
        ),
        build=lambda modifier: modifier,
    ),
    sequence(
        silent(phrase(nouns.NOT_PLACED)),
        _plain_modifier,
        # "The right not of the cup" is no English.
        build=lambda modifier: None if modifier.prep is Prep.OF else replace(modifier, denied=True),
    ),
    sequence(
        silent(optional(phrase("~comma"), None)),
        silent(phrase(nouns.CONTRAST)),
        noun_phrase,
        build=lambda np: Modifier(Prep.CONTRAST, (np,)) if np.determiner and np.words else None,
    ),
    sequence(
        silent(optional(phrase("~comma"), None)),
        silent(phrase(nouns.EXCEPT)),
        exceptions,
        build=lambda nps: Modifier(Prep.EXCEPT, tuple(map(_one_of_them, nps))),
    ),
)
MODIFIER.define(_modifier)
_MATCHING_ADJECTIVE = silent(phrase(nouns.MATCHING_ADJECTIVES))
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


def _any_of(determiner: str, first: str, more: Any, rest: Any, modifiers: Any) -> NounPhrase | None:
    """All that are one or the other ("all red or blue cups")."""
    words = (first, *more, *rest)
    adjectives = (*words[: len(more) + 1], *rest[:-1])
    several = determiner in ("all", "all the", "the", "") and singular(rest[-1]) != rest[-1]
    if not several or not all(map(is_descriptive, adjectives)):
        return None
    return NounPhrase(determiner, words, modifiers, joined=True)


def _pronoun(pronoun: str, modifiers: Any) -> NounPhrase | None:
    if modifiers and pronoun in ("it", "its"):
        return None
    return NounPhrase(modifiers=modifiers, pronoun=pronoun)


OPTIONAL_DETERMINER = optional(DETERMINER, "")
_FREE_CHOICE = phrase("any, whichever, a, an, either")
_DESCRIPTIVE = word(lambda given, text: is_descriptive(text))
_OR_OTHER = some(sequence(OR, _DESCRIPTIVE, build=lambda text: text), least=1, most=3)
noun_phrase.define(
    spanned(
        either(
            sequence(OPTIONAL_DETERMINER, WORDS, MODIFIERS, build=_named),
            sequence(_FREE_CHOICE, WORDS, silent(phrase(nouns.AS_YOU_LIKE)), build=NounPhrase),
            sequence(
                silent(optional(phrase("the, a, their, its, his"), None)),
                _MATCHING_ADJECTIVE,
                WORDS,
                build=lambda words: NounPhrase("the", words, (Modifier(Prep.MATCHING),)),
            ),
            sequence(
                silent(phrase(nouns.FREE_RELATIVE)),
                _plain_modifier,
                MODIFIERS,
                build=lambda first, more: NounPhrase("all", ("objects",), (first, *more)),
            ),
            sequence(OPTIONAL_DETERMINER, ROBOT, build=lambda det, text: NounPhrase(det, (text,))),
            sequence(OPTIONAL_DETERMINER, NON, NOUN_WORD, WORDS, MODIFIERS, build=_negative),
            sequence(
                OPTIONAL_DETERMINER,
                some(NOUN_WORD, least=1, most=2),
                silent(phrase("and")),
                WORDS,
                MODIFIERS,
                build=_joined,
            ),
            sequence(
                OPTIONAL_DETERMINER,
                _DESCRIPTIVE,
                _OR_OTHER,
                WORDS,
                MODIFIERS,
                build=_any_of,
            ),
            sequence(
                silent(phrase("everything, anything")),
                _DESCRIPTIVE,
                _OR_OTHER,
                MODIFIERS,
                build=lambda first, more, mods: _any_of("all", first, more, ("objects",), mods),
            ),
            sequence(
                OPTIONAL_DETERMINER,
                phrase(nouns.GENERAL_NOUNS),
                optional(_quality, None),
                MODIFIERS,
                build=_general,
            ),
            sequence(DETERMINER, MODIFIERS, build=_nounless),
            sequence(
                OPTIONAL_DETERMINER,
                WORDS,
                silent(phrase("'s")),
                WORDS,
                MODIFIERS,
                build=lambda det, owner, words, mods: NounPhrase(
                    "the", words, mods, owner=NounPhrase(det, owner, text=" ".join(owner))
                ),
            ),
            sequence(PRONOUN, MODIFIERS, build=_pronoun),
            sequence(
                DETERMINER, PRONOUN, build=lambda det, pronoun: NounPhrase(det, pronoun=pronoun)
            ),
        ),
        lambda text, np: replace(np, text=text),
    )
)


def coordinated(first: NounPhrase, more: tuple[NounPhrase, ...]) -> tuple[NounPhrase, ...] | None:
    """Noun phrases of which all but the last may leave the noun to the next: "the red and the blue
    mug". None where the last one leaves it out, too.
    """
    found = [first, *more]
    for index in range(len(found) - 1, -1, -1):
        item = found[index]
        adjectives = bool(item.words) and all(map(is_descriptive, item.words))
        if index and (*item.words, item.determiner)[0].isdigit():
            # "Cubes 1, 2 and 4": the numbers of things, no counts of them.
            before = next((np.words for np in found[index - 1 :: -1] if len(np.words) > 1), ("",))
            if before[-1].isdigit() and len(item.words) < 2 and not item.modifiers:
                number = (*item.words, item.determiner)[0]
                item = replace(item, determiner="", words=(*before[:-1], number))
        if index and not item.determiner and item.words and first.determiner:
            item = replace(item, loose=True)
        following = found[index + 1] if index + 1 < len(found) else None
        named = bool(item.words) and item.words[-1] in COMMON_NOUNS  # "lime", "orange"
        if adjectives and following is None and not item.determiner and not named:
            return None
        if adjectives and following is not None and len(following.words) > 1:
            item = replace(item, words=(*item.words, following.words[-1]))
        found[index] = item
    return tuple(found)


def _both(both: Any, nps: tuple[NounPhrase, ...] | None) -> tuple[NounPhrase, ...] | None:
    return None if nps is None or (both and len(nps) < 2) else nps


_COORDINATION = sequence(
    noun_phrase,
    some(sequence(LIST, noun_phrase, build=lambda np: np), most=9),
    build=coordinated,
)
exceptions.define(_COORDINATION)
NP_LIST = Rule(sequence(optional(phrase("both"), None), _COORDINATION, build=_both))


def _one_of(nps: tuple[NounPhrase, ...]) -> Things | None:
    """One of several things; "what is in a cup or a bowl" is no choice between that and a bowl."""
    landmarks = [any(item.phrases for item in np.modifiers) for np in nps]
    if any(landmarks[:-1]) and not landmarks[-1]:
        return None
    whole = coordinated(nps[0], nps[1:]) if len(nps) > 1 else None
    return None if whole is None else Things(whole, either=True)


THINGS = Rule(
    either(
        valued(NP_LIST, Things),
        sequence(
            optional(EITHER),
            separated(noun_phrase, OR, most=6),
            build=_one_of,
        ),
    )
)

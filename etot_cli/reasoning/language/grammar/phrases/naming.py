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
    one_of,
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
    NOUN_WORD,
    exceptions,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.parsers.input import Input, Result
from etot_cli.reasoning.language.grammar.phrases.comparing import ONE_COMPARED
from etot_cli.reasoning.language.grammar.phrases.contents import HERE_BEFORE, WHERE_THAT_IS
from etot_cli.reasoning.language.grammar.phrases.modifiers import (
    LEAVING_OUT,
    MODIFIERS,
    NOT_BUT,
    OF_ALL,
    ONE_SUCH,
    PLAIN_MODIFIER,
    QUALITY,
    denied,
    quality_alone,
    without_such,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words import nouns, small_words
from etot_cli.reasoning.language.words.known import VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    BOARD_NOUNS,
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
PRONOUN = phrase("it, them, they, this, that, these, those, its, he, him, she, her")
ROBOT = word(lambda given, text: text in ("me", "you", "us", "robot"))
_ANY_WORDS = some(NOUN_WORD, least=1, most=6)


def _before_a_place(given: Input, at: int) -> list[Result]:
    """Words of a name; of a "close-up photo", too, "the photo close to the tray" says where."""
    return [
        (end, value)
        for end, value in _ANY_WORDS.find(given, at)
        if end == at + 1 or f"{given.words[end - 1]} {given.ahead[end]}" not in _BEGIN_A_PLACE
    ]


_BEGIN_A_PLACE = ("close to", "near to", "next to")
WORDS = Parser(_before_a_place, lambda: _ANY_WORDS.first)


def _any_again(
    words: tuple[str, ...], modifiers: tuple[Modifier, ...], again: tuple[str, ...]
) -> NounPhrase | None:
    """One of some things, which is said again ("a cup, any cup, …"); of "a red cup, any cup" it is
    open whether it has to be red.
    """
    return NounPhrase("any", words, modifiers) if again in ((), words) else None


def _any_but(
    words: tuple[str, ...],
    modifiers: tuple[Modifier, ...],
    again: tuple[str, ...],
    said: str,
    left_out: tuple[NounPhrase, ...],
) -> NounPhrase | None:
    """Any of some things but for those that are left out."""
    but = without_such(said, left_out) if again in (words, (), ("one",), words[-1:]) else None
    return None if but is None else NounPhrase("any", words, (*modifiers, but))


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


def _one_of_such(words: tuple[str, ...]) -> tuple[str, ...] | None:
    """The noun for one of several things."""
    one = singular(words[-1])
    return None if one == words[-1] else (*words[:-1], one)


def _whichever(
    words: tuple[str, ...] | NounPhrase, modifier: Modifier, more: Any
) -> NounPhrase | None:
    """The one that is so; whichever "is left" is the one that nothing else was done with."""
    if isinstance(words, NounPhrase):
        of_them = Modifier(Prep.OF, (words,))
        if modifier.prep is Prep.NEAREST:
            one = ("one",) if words.pronoun else _one_of_such(words.words)
            return NounPhrase("the", one, (of_them, modifier, *more)) if one else None
        if modifier.prep is not Prep.QUALITY or modifier.denied or words.pronoun:
            return None  # told by counting all of them, as in "the taller of the two cups"
        return NounPhrase("the", modifier.words, (of_them, *more))
    if modifier.words == ("left",) and not modifier.denied:
        return NounPhrase("the other", words, more)
    return NounPhrase("the only", words, (modifier, *more))


def _where_it_is(words: tuple[str, ...], np: NounPhrase) -> NounPhrase | None:
    """The place that something is in or on ("the same drawer as the pen")."""
    vague = matches_any(words[-1], (*THING_NOUNS, "color", "colour", "place", "way", "side"))
    return None if vague else NounPhrase("the", words, (Modifier(Prep.WITH, (np,), ("same",)),))


def _any_of(determiner: str, first: str, more: Any, rest: Any, modifiers: Any) -> NounPhrase | None:
    """All that are one or the other ("all red or blue cups")."""
    words = (first, *more, *rest)
    several = determiner in ("all", "all the", "the", "") and singular(rest[-1]) != rest[-1]
    return NounPhrase(determiner, words, modifiers, joined=True) if several else None


def _what_is(said: str, where: Modifier, more: tuple[Modifier, ...]) -> NounPhrase | None:
    """Everything somewhere; "what was on it" was so before."""
    if "was" in said.split() and where.phrases[:1] and where.phrases[0].pronoun == "it":
        return None
    return NounPhrase("all other" if "else" in said else "all", ("objects",), (where, *more))


def _what_was(where: Modifier, before: str) -> NounPhrase | None:
    """What was somewhere before something else was put there; "what was on the tray" is so now."""
    if not (before or (where.phrases[:1] and where.phrases[0].pronoun)):
        return None
    return NounPhrase("all", ("objects",), (replace(where, words=(HERE_BEFORE,)),))


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


_INSIDE = Modifier(Prep.IN, (NounPhrase(pronoun="it", text="inside"),))
THEREIN = sequence(
    one_of({Prep.IN: "in there, inside", Prep.ON: "on there, on top"}),
    build=lambda prep: Modifier(prep, (NounPhrase(pronoun="it", text="there"),)),
)
ALREADY_THERE = either(
    THEREIN,
    *(
        sequence(
            "there, in place",
            build=lambda prep=prep: Modifier(prep, (NounPhrase(pronoun="it", text="there"),)),
        )
        for prep in (Prep.IN, Prep.ON)
    ),
)
"""In or on what was spoken of."""
OPTIONAL_DETERMINER = optional(DETERMINER, "")
_OF_THEM = sequence(COMMA, phrase("all, both, each, every one"), "of them", either(COMMA, at_end))
_ANY_ONE = either(phrase("one, of them", ()), WORDS)
_BEHIND_A_VERB = Parser(
    lambda given, at: [(at, NOTHING)] if {*given.words[at - 1 : at]} & {*VERB_WORDS, "up"} else []
)
_FREE_CHOICE = phrase("any, whichever, a, an, either")
DESCRIPTIVE = word(lambda given, text: is_descriptive(text))
LEVEL = sequence(
    word(lambda given, text: text in LEVELS),
    word(lambda given, text: text in (*BOARD_NOUNS, "drawer")),
    build=lambda *words: (words, ()),
)
"""Of furniture: "top shelf", and nothing behind it."""
_PART_OF_IT = sequence(LEVEL, either(COMMA, at_end))
"""Behind a comma ("the chest, upper drawer")."""
_OR_OTHER = some(sequence(small_words.OR, DESCRIPTIVE), least=1, most=3)
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
                either(
                    WORDS,
                    sequence("of (the|these|those|my|our)", WORDS, build=_one_of_such),
                    sequence("of", noun_phrase),
                ),
                "[that] is [the]",
                either(
                    PLAIN_MODIFIER,
                    quality_alone,
                    sequence("not", either(PLAIN_MODIFIER, quality_alone), build=denied),
                ),
                MODIFIERS,
                build=_whichever,
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
            sequence(_FREE_CHOICE, WORDS, nouns.AS_YOU_LIKE, build=NounPhrase),
            sequence(
                # "One of the drawers, either will do, …"
                phrase("one of the, one of these, one of those, one of my, one of our"),
                WORDS,
                "~comma",
                f"[(either|any) [one|of them]] ({small_words.ANY_WILL_DO})",
                either(COMMA, at_end),
                build=NounPhrase,
            ),
            sequence(
                # "Of the two, take whichever is easier to reach"
                _BEHIND_A_VERB,
                "whichever, whatever",
                nouns.AS_YOU_LIKE,
                build=lambda: NounPhrase("whichever", ("one",)),
            ),
            sequence("the, these, those", WORDS, MODIFIERS, _OF_THEM, build=_all_of_them),
            sequence(OPTIONAL_DETERMINER, WORDS, MODIFIERS, OF_ALL, build=_each_so),
            sequence(
                phrase("a, an, another, any, any other, some other"),
                WORDS,
                MODIFIERS,
                ONE_SUCH,
                build=lambda det, words, modifiers, such: NounPhrase(
                    det, words, (*modifiers, such)
                ),
            ),
            sequence(
                "a, an, one, any",
                WORDS,
                MODIFIERS,
                COMMA,
                "any",
                _ANY_ONE,
                either(COMMA, at_end),
                build=_any_again,
            ),
            sequence(
                # "A cup, any cup but the red one"
                "a, an, one, any",
                WORDS,
                MODIFIERS,
                COMMA,
                "any",
                optional(WORDS, ()),
                LEAVING_OUT,
                exceptions,
                build=_any_but,
            ),
            sequence(
                optional("the, a, their, its, his, her"),
                nouns.MATCHING_ADJECTIVES,
                WORDS,
                build=lambda words: NounPhrase("the", words, (Modifier(Prep.MATCHING),)),
            ),
            sequence(
                phrase(nouns.FREE_RELATIVE),
                either(PLAIN_MODIFIER, quality_alone, sequence("inside", build=lambda: _INSIDE)),
                MODIFIERS,
                build=_what_is,
            ),
            sequence(
                # "What the cup stands on"
                "what, whatever",
                WHERE_THAT_IS,
                build=lambda where: NounPhrase("the", ("thing",), (where,)),
            ),
            sequence(
                "(what|whatever|everything [that]) (was|were) [already]",
                either(PLAIN_MODIFIER, THEREIN),
                optional(phrase(nouns.BEFOREHAND), ""),
                build=_what_was,
            ),
            sequence(OPTIONAL_DETERMINER, ROBOT, build=lambda det, text: NounPhrase(det, (text,))),
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
                # "The outer two", "those left three"
                "the, these, those",
                word(lambda _, text: text in SIDES or text in LEVELS),
                word(lambda _, text: NUMBERS.get(text, 1) > 1),
                build=lambda side, count: NounPhrase(f"the {count}", (side, "ones")),
            ),
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

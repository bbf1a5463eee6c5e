"""Rules for things that are left open, or told by what is so: "whichever", "any", "what"."""

from __future__ import annotations

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
    separated,
    sequence,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    LIST,
    WORDS,
    ahead,
    exceptions,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.contents import (
    CONTENTS,
    HERE_BEFORE,
    WHERE_THAT_IS,
)
from etot_cli.reasoning.language.grammar.phrases.contrasts import LEAVING_OUT, without_such
from etot_cli.reasoning.language.grammar.phrases.descriptions import (
    PLAIN_MODIFIER,
    denied,
    quality_alone,
)
from etot_cli.reasoning.language.grammar.phrases.modifiers import MODIFIERS
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words import nouns
from etot_cli.reasoning.language.words.known import VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.reasoning.language.words.places import Prep


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


def _one_of_such(words: tuple[str, ...]) -> tuple[str, ...] | None:
    """The noun for one of several things."""
    one = singular(words[-1])
    return None if one == words[-1] else (*words[:-1], one)


def _whichever(
    words: tuple[str, ...] | NounPhrase | Modifier, modifier: Modifier, more: Any
) -> NounPhrase | None:
    """The one that is so; whichever "is left" is the one that nothing else was done with."""
    if isinstance(words, Modifier):
        (noun, *others) = {np.head for np in words.phrases}
        return NounPhrase("the only", ("object" if others else noun,), (words, modifier, *more))
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


def _one_of(nps: tuple[NounPhrase, ...]) -> Modifier | None:
    """One of some things that are named one by one."""
    return Modifier(Prep.AMONG, nps) if nps[1:] and all(np.words for np in nps) else None


_ONE_OF = sequence("of", separated(noun_phrase, either(LIST, "or"), most=3), build=_one_of)
_IS_SO = either(
    sequence(
        "[that] is [the]",
        either(
            PLAIN_MODIFIER,
            quality_alone,
            sequence("not [already|yet]", either(PLAIN_MODIFIER, quality_alone), build=denied),
        ),
    ),
    CONTENTS,
)
WHICHEVER = sequence(
    either(
        sequence(
            "whichever, whatever",
            either(
                WORDS,
                sequence("of (the|these|those|my|our)", WORDS, build=_one_of_such),
                sequence("of", noun_phrase),
                _ONE_OF,
            ),
        ),
        # "The one of the pen and the pencil that is on the desk"
        sequence("the one", _ONE_OF, ahead("that", "which")),
    ),
    _IS_SO,
    MODIFIERS,
    build=_whichever,
)
"""The one that is so ("whichever cup is empty")."""
_ANY_ONE = either(phrase("one, of them", ()), WORDS)
_BEHIND_A_VERB = Parser(
    lambda given, at: [(at, NOTHING)] if {*given.words[at - 1 : at]} & {*VERB_WORDS, "up"} else []
)
FREE_CHOICE = either(
    sequence(phrase("any, whichever, a, an, either"), WORDS, nouns.AS_YOU_LIKE, build=NounPhrase),
    sequence(
        # "Of the two, take whichever is easier to reach"
        _BEHIND_A_VERB,
        "whichever, whatever",
        nouns.AS_YOU_LIKE,
        build=lambda: NounPhrase("whichever", ("one",)),
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
)
"""One of several, and it is said that any will do."""


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
FREE_RELATIVE = either(
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
)
"""All that is, or was, somewhere ("what is on the tray")."""

"""Noun phrases with "of", put in a form without it."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.words.categories import MASS_NOUNS
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    ORDINALS,
    PACKS,
    PAIRED,
    SIDES,
    SIZES,
    is_descriptive,
    singular,
)
from etot_cli.reasoning.language.words.nouns import STACK
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep

_CONTENTS = "contents"
_ITS_OWNER = NounPhrase(pronoun="it", text="the contents")
"""Of "the contents" of what was spoken of."""


def packed(phrase: NounPhrase) -> NounPhrase | None:
    """The rice packet for "the packet of rice", the red socks for "the pair of red socks"."""
    of = _of(phrase)
    if of is None or not (phrase.words and of.phrases[0].words):
        return None
    (inner, *_) = of.phrases
    pack, plain = singular(phrase.head), phrase.without_modifier(of)
    if pack in PACKS and not (
        inner.determiner or inner.modifiers or is_descriptive(inner.words[0])
    ):
        return plain.called(*inner.words, phrase.head)
    # Of glasses to drink from nobody speaks of "pairs"; "a pair" may be two of them.
    glasses = phrase.head == "pairs" and inner.words[-1] == "glasses"
    if pack == "pair" and (glasses or inner.words[-1] in PAIRED) and not inner.determiner:
        pair = plain.called(*inner.words)
        return replace(pair, modifiers=(*inner.modifiers, *pair.modifiers))
    return None


def without_of(phrase: NounPhrase) -> NounPhrase:
    """All objects in the box for "its contents", the bigger mug for "the bigger of the mugs".

    Raises:
        ReferenceProblem: one thing is compared ("the bigger of the mug").
    """
    of = _of(phrase)
    if phrase.head == _CONTENTS and not phrase.modifiers:
        of = Modifier(Prep.OF, (phrase.owner or _ITS_OWNER,))
        phrase = replace(phrase, owner=None, modifiers=(of,))
    if of is None:
        return phrase
    whole = of.phrases[0]
    bare = not (whole.words or whole.pronoun) and whole.determiner.startswith("the ")
    if bare and phrase.words and not phrase.is_elliptic:
        among = quantity_of(whole.determiner).count or 0  # "the middle cup of the three"
        return replace(phrase.without_modifier(of), among=among)
    if phrase.head == _CONTENTS:
        inside = Modifier(Prep.IN, (whole,))
        words = (*phrase.words[:-1], "objects")
        rest = phrase.without_modifier(of).modifiers
        return replace(phrase, determiner="all", words=words, modifiers=(inside, *rest))
    told = phrase.words[:-1] if phrase.is_elliptic and phrase.words[1:] else phrase.words
    if whole.words and any(told[-1] in table for table in (SIZES, SIDES, ORDINALS, LEVELS)):
        return _compared(phrase, of, told)
    if told != phrase.words and is_descriptive(told[-1]) and singular(whole.head) != whole.head:
        # "The blue one of the pill boxes", after which "the white one" is one of these, too
        last = whole.head if phrase.head == "ones" else singular(whole.head)
        words = (*told, *whole.words[:-1], last)
        return replace(phrase, words=words, without=(*phrase.without, *whole.without))
    return phrase


def _compared(phrase: NounPhrase, of: Modifier, told: tuple[str, ...]) -> NounPhrase:
    """One of some things that is ``told`` by its size, side, place in a row or height."""
    (whole, *_) = of.phrases
    if whole.head in spellings(STACK):
        return replace(phrase, words=(*told, "object"))
    if singular(whole.head) == whole.head:
        raise ReferenceProblem(phrase.text, f"{phrase.head!r} of one thing is no thing", 1)
    noun = (*whole.words[:-1], singular(whole.head))
    modifiers = (*whole.modifiers, *phrase.without_modifier(of).modifiers)
    if told[-1] in LEVELS:
        # Of two open drawers the lower one may be the middle one of three.
        side = Modifier(Prep.SIDE, words=(LEVELS[told[-1]],))
        told, modifiers = told[:-1], (side, *modifiers)
    mass = noun[-1] in MASS_NOUNS and phrase.determiner == "the"
    return replace(
        phrase,
        determiner="the 1" if mass else phrase.determiner,  # "the smaller of the two fruits"
        words=(*told, *noun),
        modifiers=modifiers,
        among=quantity_of(whole.determiner).count or 0,
        without=(*phrase.without, *whole.without),
    )


def _of(phrase: NounPhrase) -> Modifier | None:
    return next((item for item in phrase.modifiers if item.prep is Prep.OF), None)

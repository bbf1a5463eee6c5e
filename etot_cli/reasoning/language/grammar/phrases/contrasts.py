"""Rules for what a thing is not: what is left out, what it is told from, what none are."""

from __future__ import annotations

from functools import partial

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    at_end,
    either,
    optional,
    phrase,
    quiet,
    separated,
    sequence,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    OPTIONAL_COMMA,
    after,
    exceptions,
    not_ahead,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.contents import CONTENTS
from etot_cli.reasoning.language.grammar.phrases.descriptions import (
    ANY_QUALITY,
    PLAIN_MODIFIER,
    QUALITY,
    denied,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words import manner, nouns
from etot_cli.reasoning.language.words.lexicon import COMMON_NOUNS, LEVELS, is_descriptive, singular
from etot_cli.reasoning.language.words.places import Prep

LEFT = optional(manner.IS_LEFT)
"""Behind what is left out: that it stays so."""


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


def other_than(found: tuple[NounPhrase, ...]) -> Modifier | None:
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


def _contrasted(nps: tuple[NounPhrase, ...], word: str = "") -> Modifier | None:
    """What is not meant, but what a thing is told from."""
    nps = tuple(map(_such, nps))
    told = all(np.words and (np.determiner or not is_descriptive(np.head)) for np in nps)
    return Modifier(Prep.CONTRAST, tuple(map(_one_of_them, nps)), (word,)) if told else None


def _that_one(the: str, np: NounPhrase) -> Modifier | None:
    """That things are a certain one of their kind ("neither of them may be the red one")."""
    said = replace(np, determiner=the, text=f"{the} {np.text}")
    return None if np.determiner else Modifier(Prep.EXCEPT, (_one_of_them(said),), denied=True)


def meant_instead(np: NounPhrase, out: Modifier) -> NounPhrase:
    """What is meant behind what is not; "not the red pen but the blue one" is about pens."""
    (not_this, *more) = out.phrases
    told = not_this.words[1:] or not_this.modifiers
    if np.is_elliptic and told and not (more or not_this.is_elliptic):
        *_, noun = not_this.head.split("_")  # labels of several words are joined
        one = singular(noun)
        np = np.called(one if np.head == "one" else noun if noun != one else f"{noun}s")
    return np.told_by(out)


_MAY_BE = "(may|can|should|must|shall|is to|are to) be"
NONE_OF_THEM = sequence(
    f"[but|and] (neither [one]|none|not one) of (them|which|these|those) [is|are|being|{_MAY_BE}],"
    f" [but|and] neither [one] {_MAY_BE}",
    either(
        PLAIN_MODIFIER,
        CONTENTS,
        QUALITY,
        ANY_QUALITY,
        sequence(phrase("the"), noun_phrase, build=_that_one),
    ),
    build=denied,
)
"""Behind several things, what is true of none of them."""
OF_ALL = sequence("~comma", NONE_OF_THEM, either(COMMA, at_end))
"""Likewise, set off by commas ("two cups, neither of them red, on the tray")."""
CONTRASTED = quiet(
    sequence(
        either(phrase(nouns.CONTRAST), sequence(after("rather", "prefer"), phrase("than"))),
        separated(noun_phrase, "or, nor", most=3),
        not_ahead("first", "last"),  # "…, not the cup first" speaks of an order
        build=lambda word, nps: _contrasted(nps, word),
    )
)


def is_left_open(np: NounPhrase) -> bool:
    """Whether it is not said of which sort a thing is: "not the pen but the blue one" tells no pens
    from each other.
    """
    return np.is_elliptic and any(item.prep is Prep.CONTRAST for item in np.modifiers)


def _but_this(out: Modifier, np: NounPhrase) -> NounPhrase | None:
    meant = meant_instead(np, out)
    return None if is_left_open(meant) else meant


NOT_BUT = quiet(
    sequence(
        "neither, not",
        sequence(separated(noun_phrase, "or, nor", most=3), build=_contrasted),
        OPTIONAL_COMMA,
        "but [rather]",
        noun_phrase,
        build=_but_this,
    )
)
"""What is meant behind what is not ("neither the cup nor the can but the jar")."""

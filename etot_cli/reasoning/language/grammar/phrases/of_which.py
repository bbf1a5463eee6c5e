"""Rules for how many of several things are of some sort ("three cubes, two of them red")."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    sequence,
    some,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.common import LIST
from etot_cli.reasoning.language.grammar.phrases.descriptions import quality_alone
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words.lexicon import NUMBERS, basic_color, singular

_NUMBER = word(lambda given, text: text in NUMBERS)
_THAT_ONE = sequence("the", quality_alone, "one", build=lambda said: ("the one", said))
_SO_MANY = either(
    sequence(
        _NUMBER,
        "of (them|which)",
        optional("being, is, are"),
        quality_alone,
        build=lambda *said: said,
    ),
    sequence("one of (them|which) [being|is], including, among them", _THAT_ONE),
)
_MORE = sequence(
    LIST,
    _NUMBER,
    optional("of (them|which)"),
    optional("being, is, are"),
    quality_alone,
    build=lambda *said: said,
)
OF_WHICH = sequence(_SO_MANY, some(_MORE, most=3), build=lambda first, more: (first, *more))
"""Behind several things that are counted."""


def told_apart(
    np: NounPhrase, parts: tuple[tuple[str, Modifier], ...]
) -> tuple[NounPhrase, ...] | None:
    """So many of such a sort, or the one that is such, and the rest of another one; None where it
    is not of so many of any that it is said, or one thing could be of two of the sorts.
    """
    so_many, _, of = f"{np.determiner} ".partition(" of the ")
    among = NUMBERS.get(of.strip(), 0)
    np = replace(np, determiner=so_many.strip())
    rest = NUMBERS.get(np.determiner, 0) - sum(NUMBERS.get(number, 1) for number, _ in parts)
    apart = all(len(said.words) == 1 for _, said in parts)
    apart &= len(parts) == 1 or all(basic_color(said.words[0]) is not None for _, said in parts)
    if rest < 0 or not (apart and np.words) or (among and np.words[1:]):
        return None
    found = [_so_many(np, number, (said,)) for number, said in parts]
    if among:  # of how many, which a word before the noun says nothing of
        found = [
            replace(told, among=among, words=(*said.words, *told.words), modifiers=np.modifiers)
            for told, (_, said) in zip(found, parts, strict=True)
        ]
    if rest:
        number = next(name for name, count in NUMBERS.items() if count == rest)
        found.append(_so_many(np, number, tuple(replace(s, denied=True) for _, s in parts)))
    return tuple(found)


def _so_many(np: NounPhrase, number: str, said: tuple[Modifier, ...]) -> NounPhrase:
    """So many of what some words name."""
    noun = singular(np.head) if NUMBERS.get(number, 1) == 1 else np.head
    told = replace(np, determiner=number, words=(*np.words[:-1], noun))
    for modifier in said:
        told = told.told_by(modifier)
    return told

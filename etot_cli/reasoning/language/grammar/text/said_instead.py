"""What is said in the place of words that are taken back, with what it takes over of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import takewhile

from etot_cli.reasoning.language.words import places, verbs
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    NUMBERS,
    SIDES,
    SIZES,
    basic_color,
    is_descriptive,
    word_set,
)
from etot_cli.reasoning.language.words.patterns import openings_of, words_of

BEFORE_THINGS = word_set(
    "the a an my your its their our this that these those both all every each another"
).union(NUMBERS)
BEFORE_PLACES = openings_of(
    (places.INTO, places.ONTO, places.TO, places.SOURCE, "between", *places.NEARBY.values())
) - {"left", "right"}
SETTING = words_of((verbs.SET_DOWN,))
JOINTS = word_set("and or then ,")
_TAKING = word_set("take use choose")
"""With "instead" behind what was to be put somewhere this asks for the same of another thing."""
_IN_OR_ON = word_set("in on into onto inside")


def noun_of(phrase: Sequence[str]) -> str:
    """What a thing is called: "board" of "the upper board of the shelf"."""
    end = phrase.index("of") if "of" in phrase[1:] else len(phrase)
    return phrase[end - 1] if phrase else ""


def object_of(clause: Sequence[str]) -> tuple[str, ...]:
    """What something is done with."""
    begin = next((at for at, word in enumerate(clause) if word in BEFORE_THINGS), len(clause))
    ends = (at for at, word in enumerate(clause) if at > begin and word in BEFORE_PLACES | JOINTS)
    return tuple(clause[begin : next(ends, len(clause))])


def called(taken: Sequence[str], said: Sequence[str]) -> tuple[str, ...]:
    """What "the white one" takes over of "the blue pill box": all that it is called; "the steel
    one" may be no pill box.
    """
    end = taken.index("of") if "of" in taken[1:] else len(taken)
    begin = end - 1
    while begin > 0 and not (_tells(taken[begin - 1]) or taken[begin - 1] in BEFORE_THINGS):
        begin -= 1
    whole = begin > 0 and all(map(_tells, (word for word in said[:-1] if word != said[0])))
    return (*taken[begin:end],) if whole and said[1:-1] else (noun_of(taken),)


def _tells(word: str) -> bool:
    """Whether a word tells things of one sort apart, whatever they are."""
    return is_descriptive(word) or any(word in sort for sort in (SIZES, SIDES, LEVELS))


def other_than(taken: Sequence[str], said: Sequence[str]) -> tuple[str, ...]:
    """What is said instead, "the other board" as one that is not the board that is taken back."""
    if tuple(said[-3:-1]) != ("the", "other") or said[-1] != noun_of(taken):
        return (*said,)
    return (*said[:-2], said[-1], "other", "than", *taken)


def in_its_stead(taken: Sequence[str], said: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """What is said instead, "take the green one" as put where the other one was to go, or as where
    that goes.
    """
    at = max((at for at, word in enumerate(said) if word in _TAKING), default=len(said))
    thing, other = object_of(taken), said[at + 1 :]
    begin = next((at for at, word in enumerate(taken) if word in BEFORE_THINGS), 0)
    behind = taken[begin + len(thing) :]
    alone = not {*other} & (BEFORE_PLACES | JOINTS) and (at == 0 or said[at - 1] in JOINTS)
    if not (thing and other and behind and alone and taken[0] in SETTING):
        # "Close the top drawer, no, open the bottom one instead" names one thing only
        yield (*said,) if behind else _named_as(thing, said)
        return
    yield (*said[:at], *taken[:begin], *_named_as(thing, other), *behind)
    prep = (*takewhile(lambda word: word not in BEFORE_THINGS, behind),)
    for preposition in (("into",), ("onto",)) if {*prep} <= _IN_OR_ON else (prep,):
        there = _named_as(behind[len(prep) :], other)
        yield (*said[:at], *taken[:begin], *thing, *preposition, *there)


def _named_as(taken: Sequence[str], said: Sequence[str]) -> tuple[str, ...]:
    """A phrase with what "one" stands for."""
    one = said[-1] in ("one", "ones") and said[1:-1] and taken
    return (*said[:-1], *called(taken, said)) if one else (*said,)


def also_told(taken: Sequence[str], said: Sequence[str]) -> tuple[str, ...]:
    """What told the thing besides, behind "the red cube, I mean the little one": of another sort
    than what is said instead.
    """
    sorts = (SIZES.__contains__, SIDES.__contains__, LEVELS.__contains__, basic_color)
    new = [sort for sort in sorts if any(map(sort, said))]
    told = [word for word in taken[:-1] if any(sort(word) for sort in sorts)]
    return tuple(word for word in told if new and not any(sort(word) for sort in new))

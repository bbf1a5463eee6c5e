"""What a noun phrase's words fit, with those that stand behind the noun or name two colours."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.choosing.instances import usable_ones
from etot_cli.reasoning.language.reference.choosing.selection import select
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.matching import Match, match_words
from etot_cli.reasoning.language.reference.naming.states import in_state
from etot_cli.reasoning.language.reference.naming.vocabulary import Vocabulary, is_of_parts
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    SIDES,
    SIZES,
    STATES,
    basic_color,
    is_descriptive,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import SceneState

_OF_PARTS = (Prep.OF, Prep.CONTAINING, Prep.WITH, Prep.BEARING, Prep.UNDER, Prep.ABOVE)


def _tells_parts(modifier: Modifier) -> bool:
    """Whether a modifier is about one drawer rather than about the whole chest."""
    state = modifier.prep is Prep.QUALITY and any(word in STATES for word in modifier.words)
    side = modifier.prep is Prep.SIDE and any(word in LEVELS for word in modifier.words)
    named = any(word in LEVELS for item in modifier.phrases for word in item.words)
    by_part = named and modifier.prep is Prep.EXCEPT
    return state or side or by_part or modifier.prep in _OF_PARTS


def names_part(modifier: Modifier, vocabulary: Vocabulary) -> list[str]:
    """The side that drawers are called by ("the drawer on the left" is "the left drawer"), but none
    that is counted from.
    """
    if modifier.prep is not Prep.SIDE or modifier.words[0] == "from":
        return []
    at = [word for word in modifier.words if word in SIDES and word not in LEVELS]
    return [word for word in at if any(part.has_word(word) for part in vocabulary.parts)]


def matched(
    phrase: NounPhrase,
    words: tuple[str, ...],
    noun: str | None,
    vocabulary: Vocabulary,
    *,
    parts_first: bool = False,
    upon: bool = False,
    place: bool = False,
) -> Match:
    """What a phrase's words fit, with the qualities that stand behind the noun.

    Args:
        phrase: with a noun.
        words: its adjectives and noun.
        noun: what "one" stands for.
        vocabulary: the scene's.
        parts_first: drawers come before their chest, as for :func:`match_words`.
        upon: something is to go on it.
        place: something is to go into it.

    Raises:
        ReferenceProblem: nothing fits, or a word is not understood.
    """
    extra = [
        word
        for modifier in phrase.modifiers
        if modifier.prep is Prep.QUALITY and not modifier.denied
        for word in modifier.words
    ]
    sides = [word for item in phrase.modifiers for word in names_part(item, vocabulary)]
    words = (*words[:-1], *extra, *sides, words[-1])
    if not phrase.joined:
        quantity = quantity_of(phrase.determiner)
        plain = not (phrase.modifiers or phrase.without or quantity.every or words[1:])
        match = match_words(
            words,
            vocabulary,
            phrase.text,
            noun,
            by_name=plain and quantity.definite and not quantity.other,
            parts_first=parts_first or any(map(_tells_parts, phrase.modifiers)) or bool(sides),
            upon=upon or any(item.prep is Prep.BEARING for item in phrase.modifiers),
            place=place,
            counted=any(
                item.prep is Prep.SIDE and item.words[0] == "from" for item in phrase.modifiers
            ),
        )
        if phrase.determiner == "a pair of" and any(entry.is_pair() for entry in match.entries):
            raise ReferenceProblem(phrase.text, "say whether that is one thing or two", 2)
        return match
    adjectives, head = words[:-1], words[-1]
    own = phrase.words[:-1]
    ways = [word for word in own if basic_color(word)]
    if len(ways) < 2:
        ways = [word for word in own if is_descriptive(word) or word in LEVELS] or [*own]
    shared = tuple(word for word in adjectives if word not in ways)
    every = match_words((*shared, head), vocabulary, phrase.text, noun)
    if every.plural:
        # "The red and blue paint cans": some are red, some are blue, and all are paint cans.
        each = [(word, *shared, head) for word in ways]
        parts = [match_words(words, vocabulary, phrase.text, noun) for words in each]
        found = {entry.thing: entry for part in parts for entry in part.entries}
        notes = tuple(note for part in parts for note in part.notes)
        entries = tuple(entry for entry in every.entries if entry.thing in found)
        return replace(every, entries=entries, notes=notes)
    both = tuple(e for e in every.entries if all(e.has_word(word) for word in adjectives))
    if not both:
        raise ReferenceProblem(phrase.text, f"no {head} is called both {' and '.join(adjectives)}")
    return Match(both)


def parts_of(
    match: Match, words: tuple[str, ...], phrase: NounPhrase, vocabulary: Vocabulary
) -> Match:
    """Of "every drawer" of the only chest the drawers, not the chest, be it called "drawers"."""
    (whole, *more), noun = match.entries, words[-1]
    if more or not is_of_parts(whole, noun, vocabulary):
        return match
    found = match_words(words, vocabulary, phrase.text, by_name=False, parts_first=True)
    if found.entries != match.entries:
        return found
    everything = (*vocabulary.parts, *vocabulary.boards)
    own = [item for item in everything if item.thing.name == whole.thing.name]
    return replace(match, entries=tuple(e for e in own if e.grade(noun) is not None), plural=True)


def with_quality(
    things: Sequence[Thing],
    word: str,
    phrase: NounPhrase,
    vocabulary: Vocabulary,
    scene: SceneState,
) -> set[Thing]:
    """The things that an adjective is true of.

    Raises:
        ReferenceProblem: the word is no adjective that is known.
    """
    if word in STATES:
        plural = singular(phrase.head) != phrase.head
        return {*in_state(word, things, scene, every=plural, left_out=True)}
    color = basic_color(word)
    entries = vocabulary.entries()
    if color is not None:
        found = {thing for thing in things if entries[thing].has_color(color)}
        plain = {thing for thing in found if entries[thing].is_plainly(color)}
        if plain and plain != found:
            doubtful = [thing.name for thing in things if thing in found - plain]
            why = f"say whether {word!r} is said of"
            raise AmbiguousReference(phrase.text, doubtful, why)
        return found
    if any(entry.has_word(word) for entry in entries.values()):
        return {thing for thing in things if entries[thing].has_word(word)}
    if word in SIDES or word in SIZES:
        return set(select((word,), (), list(things), 1, scene, phrase.text))
    raise ReferenceProblem(phrase.text, f"{word!r} is not understood", 3, word=word)


def all_among(
    things: list[Thing],
    match: Match,
    phrase: NounPhrase,
    role: Role,
    vocabulary: Vocabulary,
    scene: SceneState,
) -> list[Thing]:
    """All that "the small one of the two open drawers" tells one of: what is open; the small one
    may be called so.
    """
    for word in match.selectors:
        if word in STATES:
            things = in_state(word, things, scene, every=True)
    among = phrase.among or quantity_of(phrase.determiner).among
    if among == len(things) or len(phrase.words) < 2:
        return things
    alone = replace(phrase, words=phrase.words[-1:], modifiers=())
    found = matched(alone, alone.words, None, vocabulary)
    every = usable_ones([entry.thing for entry in found.entries], role, alone, scene)
    return every if {*things} <= {*every} else things

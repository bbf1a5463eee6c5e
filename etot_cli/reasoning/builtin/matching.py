"""Which things a noun with its adjectives may mean, before it is said where they are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from etot_cli.reasoning.builtin.lexicon import (
    LEVELS,
    ORDINALS,
    SIDES,
    SIZES,
    STATES,
    THING_NOUNS,
    basic_color,
    matches_any,
    singular,
)
from etot_cli.reasoning.builtin.vocabulary import (
    GENERIC,
    REST_OF_NAME,
    Entry,
    Vocabulary,
    is_general_noun,
)


class ReferenceProblem(Exception):
    """A phrase that cannot be resolved.

    Args:
        phrase: the phrase as written.
        why: what is wrong with it.
        weight: how much of the phrase was understood; of several readings' problems the one with
            the largest weight is shown.
    """

    def __init__(self, phrase: str, why: str, weight: int = 0) -> None:
        self.phrase = phrase
        self.why = why
        self.weight = weight
        super().__init__(f"{phrase!r}: {why}")


@dataclass(frozen=True, slots=True)
class Match:
    """Things that a noun and its adjectives fit.

    Args:
        entries: in scene order.
        selectors: words that single out instances by place, size, order or state.
        unknown: words that nothing in the scene explains.
        plural: the noun stands in the plural.
    """

    entries: tuple[Entry, ...]
    selectors: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()
    plural: bool = False


def match_words(
    words: Sequence[str], vocabulary: Vocabulary, phrase: str, noun: str | None = None
) -> Match:
    """Finds what a noun phrase's words fit.

    Args:
        words: adjectives and the noun; it may be followed by a number.
        vocabulary: the scene's.
        phrase: the whole phrase, for messages.
        noun: what "one" stands for, the noun of an earlier phrase.

    Raises:
        ReferenceProblem: nothing fits.
    """
    everything = (*vocabulary.objects, *vocabulary.parts, *vocabulary.boards, vocabulary.desk)
    for entry in everything:
        if len(words) == 1 and words[0] in entry.exact:
            return Match((entry,))
    number = words[-1] if words[-1].isdigit() and len(words) > 1 else None
    if number is not None:
        words = words[:-1]
    adjectives, head = tuple(words[:-1]), words[-1]
    if matches_any(head, ("one",)) and noun is not None:
        head = noun
    if basic_color(head) and not any(entry.has_word(head) for entry in everything):
        adjectives, head = (*adjectives, head), "object"
    for pool in _pools(vocabulary, head, adjectives):
        found = _match_in(pool, adjectives, head, number, vocabulary)
        if found is not None and found.plural and len(found.entries) == 1:
            # "The drawers" of the only chest.
            found = _match_in(vocabulary.parts, adjectives, head, number, vocabulary) or found
        if found is not None:
            return found
    raise _nothing(head, adjectives, number, vocabulary, phrase)


def _pools(vocabulary: Vocabulary, head: str, adjectives: Sequence[str]) -> list[list[Entry]]:
    """Where to look, in this order: parts come first where a level or their own name is said."""
    fitting = [entry for entry in vocabulary.objects if entry.grade(head) is not None]
    one_of_many = len(fitting) == 1 and _is_stacked(fitting[0])
    level = any(
        word in LEVELS or (one_of_many and (word in ORDINALS or word in STATES))
        for word in adjectives
    )
    objects, parts, boards = vocabulary.objects, vocabulary.parts, vocabulary.boards
    named = [
        part
        for part in parts
        if any(part.has_word(word) for word in adjectives) and part.grade(head) is not None
    ]
    pools = [objects, parts, boards, [vocabulary.desk]]
    if named:
        return [named, *pools]
    if level and not any(
        entry.grade(head) is not None and any(entry.has_word(word) for word in adjectives)
        for entry in objects
    ):
        return [parts, boards, objects, [vocabulary.desk]]
    return pools


def _match_in(
    pool: list[Entry],
    adjectives: tuple[str, ...],
    head: str,
    number: str | None,
    vocabulary: Vocabulary,
) -> Match | None:
    """What fits among some entries, None when nothing does."""
    graded = _graded(pool, head, adjectives)
    if number is not None:
        graded = [(entry, grade) for entry, grade in graded if number in entry.numbers]
    selectors: list[str] = []
    unknown: list[str] = []
    for word in adjectives:
        fitting = [item for item in graded if item[0].has_word(word)]
        color = basic_color(word)
        if word.isdigit():
            graded = []  # a number before the noun that is no count
        elif word in LEVELS and any(_has_levels(entry) for entry, _ in graded):
            graded = _at_level(graded, LEVELS[word])
        elif color is not None:
            colored = [item for item in graded if item[0].has_color(color)]
            # A thing of unknown colour may have any.
            graded = colored or [item for item in graded if not item[0].is_colored()]
        elif fitting:
            graded = fitting
        elif word in LEVELS and any(_is_stacked(entry) for entry, _ in graded):
            # What has parts on several levels has none on this one.
            graded = [item for item in graded if not _is_stacked(item[0])]
        elif word in SIDES or word in SIZES or word in ORDINALS or word in STATES:
            selectors.append(word)
        elif not _explained(word, graded, vocabulary):
            unknown.append(word)
    if not graded:
        return None
    best = min(grade for _, grade in graded)
    entries = tuple(entry for entry, grade in graded if grade == best)
    if matches_any(head, THING_NOUNS):
        plural = head == "everything" or singular(head) != head
    else:
        plural = any(entry.is_plural(head) for entry in entries)
    return Match(entries, tuple(selectors), tuple(unknown), plural)


def _graded(pool: list[Entry], head: str, adjectives: tuple[str, ...]) -> list[tuple[Entry, int]]:
    """Entries that a noun fits, with how well."""
    if matches_any(head, THING_NOUNS):
        return [(e, GENERIC) for e in pool if e.info is not None and e.thing.part is None]
    graded = [(entry, grade) for entry in pool if (grade := entry.grade(head)) is not None]
    if graded or is_general_noun(head):
        return graded
    # "the kettle thingamy": a noun that nobody knows after words that fit an object's own name.
    plain = [word for word in adjectives if not _is_descriptive(word)]
    return [
        (entry, REST_OF_NAME)
        for entry in pool
        if plain and all(entry.has_word(word) for word in plain) and entry.thing.part is None
    ]


def _is_descriptive(word: str) -> bool:
    return (
        basic_color(word) is not None
        or word in SIDES
        or word in SIZES
        or word in ORDINALS
        or word in STATES
        or word in LEVELS
    )


def _has_levels(entry: Entry) -> bool:
    return entry.thing.part is not None or entry.thing.board is not None


def _is_stacked(entry: Entry) -> bool:
    return (
        entry.info is not None
        and entry.thing.part is None
        and bool(entry.info.parts or entry.info.boards)
    )


def _at_level(graded: list[tuple[Entry, int]], level: str) -> list[tuple[Entry, int]]:
    """Of each piece of furniture the part at a level: by the parts' names, else by their order."""
    found: list[tuple[Entry, int]] = []
    owners = dict.fromkeys(entry.thing.name for entry, _ in graded)
    for owner in owners:
        stacked = [item for item in graded if item[0].thing.name == owner]
        levels = [{LEVELS.get(word) for word in item[0].own} - {None} for item in stacked]
        named = [item for item, said in zip(stacked, levels, strict=True) if level in said]
        if named or all(levels):
            found += named
            continue
        # Parts are listed from top to bottom, boards from bottom to top.
        if stacked[0][0].thing.board is not None:
            stacked = stacked[::-1]
        index = {"top": 0, "bottom": -1, "middle": len(stacked) // 2}[level]
        if level != "middle" or len(stacked) % 2:
            found.append(stacked[index])
    return found


def _explained(word: str, graded: list[tuple[Entry, int]], vocabulary: Vocabulary) -> bool:
    """Whether a word before the noun says what it is for or belongs to, so that it may be dropped.

    In "a pencil cup" the noun tells what is meant, and the scene knows pencils.
    """
    return any(matches_any(word, entry.context) for entry, _ in graded) or vocabulary.is_known(word)


def _nothing(
    head: str,
    adjectives: Sequence[str],
    number: str | None,
    vocabulary: Vocabulary,
    phrase: str,
) -> ReferenceProblem:
    everything = (*vocabulary.objects, *vocabulary.parts, *vocabulary.boards)
    alike = [entry for entry in everything if entry.grade(head) is not None]
    if alike:
        names = ", ".join(dict.fromkeys(entry.exact[0] for entry in alike))
        what = " ".join((*adjectives, head, *((number,) if number else ())))
        return ReferenceProblem(phrase, f"there is no {what!r}; what fits {head!r}: {names}", 1)
    return ReferenceProblem(
        phrase, f"nothing in the scene is called so; it has {vocabulary.names()} and the desk"
    )

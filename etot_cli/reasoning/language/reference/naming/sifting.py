"""Which things an adjective leaves of those that a noun fits, or why the words fit nothing."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.reference.naming.entries import (
    CONTENT,
    EXACT,
    GENERIC,
    HEAD,
    Entry,
)
from etot_cli.reasoning.language.reference.naming.vocabulary import Vocabulary
from etot_cli.reasoning.language.words.categories import members_of
from etot_cli.reasoning.language.words.known import REASONS
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    MADE_OF,
    MATERIALS,
    ORDINALS,
    PURPOSES,
    SIDES,
    SIZES,
    STATES,
    THING_NOUNS,
    basic_color,
    is_general_noun,
    matches_any,
)
from etot_cli.world.colors import NAMED_COLORS

TAKEN_FOR = "took "
"""How notes begin on an adjective that is not plainly true of what it is said of."""


def names_of(entries: Iterable[Entry]) -> str:
    """What entries are called, as alternatives."""
    return " or ".join(dict.fromkeys(entry.exact[0] for entry in entries))


def not_understood(word: str, entries: Sequence[Entry], phrase: str) -> ReferenceProblem:
    """An adjective that says nothing of what its noun may mean."""
    names = names_of(entries)
    if word in MATERIALS:
        why = f"the scene does not say what {names} is made of"
    else:
        why = f"no word of {names}, and no word for a place, size or state"
    return ReferenceProblem(phrase, f"{word!r} is not understood: {why}", 3, word=word)


def nothing_fits(
    head: str,
    adjectives: Sequence[str],
    number: str | None,
    vocabulary: Vocabulary,
    phrase: str,
) -> ReferenceProblem:
    """A noun that nothing is called by, or by which nothing is with these adjectives."""
    everything = (*vocabulary.objects, *vocabulary.parts, *vocabulary.boards)
    alike = [entry for entry in everything if entry.grade(head) is not None]
    alike = [entry for entry in alike if entry.grade(head) in (EXACT, HEAD)] or alike
    what = " ".join((*adjectives, head, *((number,) if number else ())))
    if alike:
        names = ", ".join(dict.fromkeys(entry.exact[0] for entry in alike))
        return ReferenceProblem(
            phrase, f"there is no {what!r}; what fits {head!r}: {names}", 1, word=what,
            candidates=tuple(dict.fromkeys(entry.exact[0] for entry in alike)),
        )  # fmt: skip
    known = REASONS.get(head)
    if known:
        return ReferenceProblem(phrase, f"{head!r}: {known}", 3)
    near = vocabulary.nearest(head)
    return ReferenceProblem(
        phrase,
        f"nothing in the scene is called {head!r}; "
        + (f"nearest: {', '.join(near)}" if near else f"it has {vocabulary.names()} and the desk"),
        word=head,
        candidates=tuple(near),
    )


@dataclass
class Sifted:
    """Entries that are left, and what the words so far were taken for."""

    graded: list[tuple[Entry, int]]
    noun: str
    selectors: list[str] = field(default_factory=list)
    unknown: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    dropped: list[str] = field(default_factory=list)
    named: list[tuple[str, tuple[Entry, ...]]] = field(default_factory=list)


def is_selecting(word: str) -> bool:
    """Whether a word tells things apart by how or where they are, unless it is part of a name."""
    return any(word in table for table in (SIDES, SIZES, ORDINALS, STATES, LEVELS))


def sift(sifted: Sifted, word: str, vocabulary: Vocabulary) -> None:
    """Keeps the entries that an adjective fits, or notes what it is."""
    graded = sifted.graded
    fitting = [item for item in graded if item[0].has_word(word)]
    color = basic_color(word)
    if word.isdigit():
        sifted.graded = []  # a number before the noun that is no count
    elif word == "one":
        return  # "the one drawer that is open" is the only one
    elif word in LEVELS and any(_has_levels(entry) for entry, _ in graded):
        sifted.graded = _at_level(graded, LEVELS[word])
    elif color is not None:
        sifted.graded = _of_color(sifted, word, color)
    elif fitting:
        if is_selecting(word) and len(fitting) < len(graded):
            best = min(grade for _, grade in fitting)
            sifted.named.append((word, tuple(e for e, grade in graded if grade <= best)))
        sifted.graded = fitting
    elif word in LEVELS and any(is_stacked(entry) for entry, _ in graded):
        # What has parts on several levels has none on this one.
        sifted.graded = [item for item in graded if not is_stacked(item[0])]
    elif is_selecting(word):
        sifted.selectors.append(word)
    elif word == "round" and (balls := _balls(graded)):
        sifted.graded = balls
    elif counted := [item for item in graded if item[0].counts_among(members_of(word))]:
        sifted.graded = counted  # "a soda can"
        names = names_of([entry for entry, _ in counted])
        sifted.notes.append(f"{TAKEN_FOR}{names} for {word!r}")
    elif made := [item for item in graded if MADE_OF.get(word, frozenset()) & {*item[0].own}]:
        sifted.graded = made
        sifted.notes.append(f"{TAKEN_FOR}{names_of([e for e, _ in made])} for {word!r}")
    elif owned := _of_owner(word, graded):
        sifted.graded = owned
    elif word in PURPOSES or vocabulary.is_known(word) or is_general_noun(word):
        # What is called a thing for something else is not for this; nor are eggs for milk, where
        # there is milk ("the milk eggs").
        named = any(entry.grade(word) in (EXACT, HEAD, CONTENT) for entry in vocabulary.objects)
        # A basket may be for fruit, though others are for basket balls.
        noun = sifted.noun if word in PURPOSES else ""
        used = named or (word not in PURPOSES and vocabulary.is_known(word))
        apt = [
            item
            for item in graded
            if not any(own in PURPOSES and not matches_any(own, [noun]) for own in item[0].own)
            and (not used or (item[0].holds() and not matches_any(sifted.noun, item[0].content)))
        ]
        lettered = re.fullmatch(r"\w_?", sifted.noun)  # "jar B" is no tube B
        if not apt or lettered:
            sifted.unknown.append(word)
            return
        sifted.graded = apt
        names = names_of([entry for entry, _ in apt])
        sifted.notes.append(f"{TAKEN_FOR}{word!r} for what {names} is for")
        sifted.dropped.append(word)
    elif word in MATERIALS and len(graded) == 1 and not MATERIALS & {*graded[0][0].own}:
        sifted.notes.append(f"{word!r} or not, only {names_of([graded[0][0]])} is called so")
        sifted.dropped.append(word)
    else:
        sifted.unknown.append(word)


def _balls(graded: list[tuple[Entry, int]]) -> list[tuple[Entry, int]]:
    """Entries that are round as balls are; none where others are round in a way as well."""
    kinds = [item[0].info.kind if item[0].info else "" for item in graded]
    if {"cylinder", "cup", "bowl"} & {*kinds}:
        return []
    return [item for item, kind in zip(graded, kinds, strict=True) if kind == "sphere"]


def _of_owner(word: str, graded: list[tuple[Entry, int]]) -> list[tuple[Entry, int]]:
    """Parts of what a word names ("the microwave door"): by its own words before those by kind."""
    own = [item for item in graded if matches_any(word, item[0].owner)]
    return own or [item for item in graded if matches_any(word, item[0].context)]


_BRITISH = {"gray": "grey"}


def _of_color(sifted: Sifted, word: str, color: str) -> list[tuple[Entry, int]]:
    """Entries of a colour. A name beats a look, and a look beats a neighbouring colour."""
    graded = sifted.graded
    if word in (color, _BRITISH.get(color)):
        plain = [item for item in graded if item[0].is_plainly(color)]
    else:
        plain = [item for item in graded if item[0].has_word(word)]
    if plain:
        # A carton of orange juice is no orange thing where another thing is orange.
        looks = [item for item in plain if item[1] != GENERIC or item[0].color in (None, color)]
        return looks or plain
    near = [item for item in graded if item[0].has_color(color)]
    if word in NAMED_COLORS and word not in (color, _BRITISH.get(color)):
        # What is only near a basic colour may be of this very one; what has that colour is not.
        near = [item for item in near if not item[0].is_plainly(color)] or near
    # A thing of unknown colour that is called so may have any.
    found = near or [item for item in graded if not item[0].is_colored() and item[1] != GENERIC]
    if found:
        names = names_of([entry for entry, _ in found])
        sifted.notes.append(f"{TAKEN_FOR}{names} for {word!r}")
    return found


def graded_by(pool: list[Entry], head: str) -> list[tuple[Entry, int]]:
    """Entries that a noun fits, with how well."""
    if matches_any(head, THING_NOUNS):
        return [(e, GENERIC) for e in pool if e.info is not None and e.thing.part is None]
    return [(entry, grade) for entry in pool if (grade := entry.grade(head)) is not None]


def _has_levels(entry: Entry) -> bool:
    return entry.thing.part is not None or entry.thing.board is not None


def is_stacked(entry: Entry) -> bool:
    """Whether an object has drawers, doors or boards."""
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

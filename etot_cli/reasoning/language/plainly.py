"""The plain reading of an instruction: all its words, as they stand, ask for something."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Goal, Open, Pick, Put
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.builtin.wording import formal
from etot_cli.reasoning.language.goals.interpretation import interpret
from etot_cli.reasoning.language.grammar.sentences.reader import UnreadableError, normalized, read
from etot_cli.reasoning.language.grammar.text.corrections import mark_in, taken_back
from etot_cli.reasoning.language.reference.naming.vocabulary import Vocabulary
from etot_cli.reasoning.language.words import manner, verbs
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.lexicon import (
    DESK_NOUNS,
    singular,
)
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.world.state import OPEN_AT, SceneState


def read_plainly(
    text: str, scene: SceneState, vocabulary: Vocabulary, *, common: bool = False
) -> Goal:
    """The goal of normalized text; slips of the pen in words that stand in no scene are put right
    where ``common``.
    """
    if mark := mark_in(text):
        return without_corrections(text, mark, lambda text: read_plainly(text, scene, vocabulary))
    found = read(vocabulary.joined(text), vocabulary.words(), common=common)
    goal = interpret(found.sentences, scene, vocabulary)
    slips = tuple(f"read {correction}" for correction in found.corrections)
    return replace(goal, notes=(*slips, *goal.notes, *_said_with_more(text, goal)))


def without_corrections(
    text: str, mark: re.Match[str], goal_in: Callable[[str], Goal | None]
) -> Goal:
    """The goal of a text with words that take something back, which is noted.

    Raises:
        UnreadableError: nothing or several things may be taken back.
    """
    found: dict[str, Goal] = {}
    unread: list[bool] = []
    alike = False
    for way in taken_back(text, mark):
        unread.append(way.alike)
        with suppress(UnreadableError, ReferenceProblem):
            if (goal := goal_in(way.text)) is None:
                continue
            note = f"{way.words!r} is taken back: {way.instead!r} is said instead"
            found.setdefault(formal(goal), replace(goal, notes=(note, *goal.notes)))
            unread.pop()
            alike |= way.alike
    if any(unread) and not alike:
        found.clear()  # "the red block by the tray. No, the blue block" does not mean the tray
    if len(found) != 1:
        told = [goal.notes[0].partition(" is taken back: ") for goal in found.values()]
        ways = " or ".join(words for words, *_ in told)
        why = f"it may take back {ways}" if ways else "it is unclear what that takes back"
        if told[1:] and len({words for words, *_ in told}) == 1:
            ways = " or ".join(instead.removesuffix(" is said instead") for *_, instead in told)
            why = f"it may mean {ways}"
        raise UnreadableError(mark[0].strip(" ,.!?;\n"), "", f"{why}; say it anew")
    return next(iter(found.values()))


def _said_with_more(text: str, goal: Goal) -> Iterator[str]:
    """What words that ask for more than any skill does were taken for."""
    words = " ".join(["", *re.findall(r"\w+", text), ""])
    for patterns, step, why in (
        (manner.ALL_THE_WAY, Open, f"what is open is so to {OPEN_AT:.0%} of its travel or more"),
        (verbs.TO_SOMEBODY, Pick, verbs.HELD_UP),
        ("as possible", Put, "how near or far is not measured"),
    ):
        said = [text for text in spellings(patterns) if f" {text} " in words]
        if said and any(isinstance(item, step) for item in goal.steps):
            yield f"{said[0]!r}: {why}"


def is_name(word: str, vocabulary: Vocabulary) -> bool:
    """Whether something in the scene is called by a word."""
    called = (*DESK_NOUNS, *map(singular, vocabulary.words()))
    kind = is_category(word) and bool(vocabulary.of_category(word))
    return kind or singular(word) in called


def reads(instruction: str, scene: SceneState, vocabulary: Vocabulary) -> bool:
    """Whether an instruction is read as it stands."""
    try:
        read_plainly(normalized(instruction), scene, vocabulary)
    except (UnreadableError, ReferenceProblem):
        return False
    return True

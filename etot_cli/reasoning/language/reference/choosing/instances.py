"""Which of the things that fit a phrase are meant, and in how many ways they can be chosen."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from itertools import combinations, islice

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.reference.choosing.selection import select, too_few
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.naming.determiners import Quantity, quantity_of
from etot_cli.reasoning.language.reference.naming.matching import Match
from etot_cli.reasoning.language.words.lexicon import (
    JOINT_NOUNS,
    OPEN_SURFACES,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import DESK, SceneState

MAX_OPTIONS = 256
"""Ways of choosing instances for one phrase that are looked at."""


def usable_ones(
    things: list[Thing], role: Role, phrase: NounPhrase, scene: SceneState
) -> list[Thing]:
    """Things that can be used as asked for; lost ones only when there are no others."""
    usable = [thing for thing in things if can_be(thing, role, scene)]
    if not usable and role is Role.CONTAINER:
        # "In the tray" is said of what lies on it.
        flat = [thing for thing in things if can_be(thing, Role.SURFACE, scene)]
        named = phrase.words and matches_any(phrase.words[-1].split("_")[-1], OPEN_SURFACES)
        kinds = {name: info.kind for name, info in scene.infos.items()}  # the desk has none
        usable = [thing for thing in flat if named or thing.board
                  or matches_any(kinds.get(thing.name, ""), OPEN_SURFACES)]  # fmt: skip
    if not usable and role is Role.SURFACE:
        # "On the bowl" is said of what goes into it; on a drawer is not in it.
        vessels = [thing for thing in things if thing.part is None]
        usable = [thing for thing in vessels if can_be(thing, Role.CONTAINER, scene)]
        usable = usable or with_their_whole(phrase, things, scene)[len(things) :]
        if not usable:
            check_not_part(phrase.text, things)
    if not usable:
        noun = phrase.head
        if role is Role.THEME and matches_any(noun, JOINT_NOUNS["hinge"]):
            why = f"nothing is called {noun!r} that could be picked up"
            raise ReferenceProblem(phrase.text, why, 2, word=noun)
        names = ", ".join(dict.fromkeys(thing.name for thing in things))
        raise ReferenceProblem(phrase.text, f"{names} cannot be {role.value}", 2)
    at_hand = [thing for thing in usable if thing.name == DESK or not scene.states[thing.name].lost]
    return at_hand or usable


def with_their_whole(phrase: NounPhrase, things: list[Thing], scene: SceneState) -> list[Thing]:
    """Drawers, with what they are all the drawers of behind them: what is on "the drawers" is on
    that.
    """
    (name, *more) = {thing.name for thing in things if thing.part} or {DESK}
    own = () if name == DESK else scene.infos[name].parts
    alone = phrase.determiner in THE_WORDS and len(phrase.words) == 1
    return [*things, Thing(name)] if alone and len(own) == len(things) > 1 and not more else things


def check_not_part(text: str, below: Sequence[Thing]) -> None:
    """Whether something is to stand on what moves.

    Raises:
        ReferenceProblem: it is, for "on the drawer" is neither in it nor surely on its chest.
    """
    for thing in below:
        if thing.part is not None:
            why = f"nothing can stand on a drawer or door; say 'into' it, or 'on {thing.name}'"
            raise ReferenceProblem(text, why, 3)


def called_exactly(
    things: list[Thing],
    match: Match,
    phrase: NounPhrase,
    words: tuple[str, ...],
    quantity: Quantity,
    scene: SceneState,
    notes: list[str],
) -> list[Thing]:
    """Of several things that "the cup" may mean the one that is called just that. ``notes`` grows.

    Raises:
        AmbiguousReference: a word of its name is true of another one.
    """
    _check_named(match, things, phrase, scene, notes)
    many = quantity.every or (quantity.count or (2 if match.plural else 1)) > 1
    if not quantity.definite or many or len(things) < 2:
        return things
    exact = [
        entry.thing for entry in match.entries if entry.thing in things and entry.is_called(words)
    ]
    alike = any(words[-1] in e.numbered() for e in match.entries if e.thing not in exact)
    return exact if len(exact) == 1 and not alike else things


def _check_named(
    match: Match, things: list[Thing], phrase: NounPhrase, scene: SceneState, notes: list[str]
) -> None:
    """Whether a word for size or side that is part of a name is also true of what has the name.

    Raises:
        AmbiguousReference: it is true of another thing of the kind, and may mean that one; said of
            a whole name, that is but noted.
    """
    named = () if things[0].part or things[0].board else match.named
    for word, rivals in named:
        others = [entry.thing for entry in rivals]
        fitting: list[Thing] = []
        with suppress(ReferenceProblem):
            fitting = select((word,), (), others, len(things), scene, phrase.text)
        if fitting and not set(fitting) & set(things):
            if match.whole:
                notes.append(f"read {word!r} as part of the name of {things[0].name}")
                continue
            why = f"{word!r} may be part of a name or say how it is:"
            raise AmbiguousReference(phrase.text, [t.name for t in (*things, *fitting)], why)


def is_of_each(phrase: NounPhrase) -> bool:
    """Whether there is one for each of several owners ("the top drawer of each chest")."""
    owners = [item.phrases[0] for item in phrase.modifiers if item.prep is Prep.OF]
    return any(quantity_of(owner.determiner).every for owner in owners)


def options_of(
    things: list[Thing], count: int | None, quantity: Quantity, phrase: NounPhrase
) -> tuple[tuple[Thing, ...], ...]:
    """Alternative sets of things, given how many are meant."""
    names = ", ".join(thing.name for thing in things)
    if count == 1 and is_of_each(phrase):
        if len({thing.name for thing in things}) < len(things):
            raise ReferenceProblem(phrase.text, "say which one of each", 2)
        return (tuple(things),)
    # "Both the mug and the butter" speaks of two things rather than of both the mug.
    alone = phrase.determiner == "both the" and singular(phrase.head) == phrase.head
    if quantity.every and quantity.count is not None and (alone or len(things) != quantity.count):
        why = f"there should be {quantity.count}, but what fits is {names}"
        raise ReferenceProblem(phrase.text, why, int(not alone))
    if quantity.definite and count is not None and 1 < count < len(things):
        raise ReferenceProblem(phrase.text, f"there are more than {count}: {names}", 1)
    if count is None or quantity.every:
        return (tuple(things),)
    if count > len(things):
        raise too_few(things, phrase.text)
    return tuple(islice(combinations(things, count), MAX_OPTIONS))

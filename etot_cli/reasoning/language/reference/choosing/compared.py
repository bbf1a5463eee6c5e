"""Which things are bigger, taller, … than another one, and which stand on either side of it."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.choosing.landmarks import (
    AS_NEAR,
    means_the_others,
)
from etot_cli.reasoning.language.reference.choosing.selection import ALIKE, ELONGATED
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.geometry.rows import ROW
from etot_cli.reasoning.language.reference.memory.antecedents import UnclearLandmark
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.words.lexicon import SIZES, singular
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import ObjectInfo, SceneState

_SAME = 1.001
"""Sizes that differ by less are written alike."""
_SIDES = (Prep.LEFT, Prep.RIGHT), (Prep.FRONT, Prep.BEHIND)


def more_so(
    things: Sequence[Thing],
    modifier: Modifier,
    ways: Sequence[Sequence[Sequence[Thing]]],
    phrase: NounPhrase,
    scene: SceneState,
) -> list[Thing]:
    """Those of the things that are "smaller than the red cup", or "than the others".

    Args:
        things: to choose from.
        modifier: how they are compared, and with what.
        ways: all ways to understand that; none where it is the others of these things.
        phrase: all that is said of them.
        scene: where they are.

    Raises:
        UnclearLandmark: some are so than one of the things that may be meant, but not than another.
        ReferenceProblem: who looks at them would not tell.
    """
    (how,) = modifier.words
    if means_the_others(modifier):
        if len(things) < 2:
            raise ReferenceProblem(phrase.text, "there is no other one", 2)
        if _is_the_other(modifier.phrases[0]) and len(things) > 2:
            raise UnclearLandmark(phrase.text, sorted(thing.name for thing in things))
        return [
            thing
            for thing in things
            if all(_is_more(how, thing, other, phrase, scene) for other in things if other != thing)
            != modifier.denied
        ]
    marks = {mark for way in ways for several in way for mark in several}
    each = {
        mark: [t for t in things if t != mark and _is_more(how, t, mark, phrase, scene)]
        for mark in marks
    }
    found = next(iter(each.values()), [])
    if quantity_of(modifier.phrases[0].determiner).every:
        found = [thing for thing in found if all(thing in several for several in each.values())]
    elif any(several != found for several in each.values()):
        raise UnclearLandmark(phrase.text, sorted(mark.name for mark in marks))
    if modifier.denied:
        return [thing for thing in things if thing not in found and thing not in marks]
    return found


def _is_the_other(phrase: NounPhrase) -> bool:
    """Whether it is the other one of two."""
    several = bool(phrase.words) and singular(phrase.head) != phrase.head
    return (
        phrase.determiner.split()[1:] == ["other"]
        and not several
        and (phrase.determiner.split()[0] in THE_WORDS)
    )


def _is_more(how: str, thing: Thing, mark: Thing, phrase: NounPhrase, scene: SceneState) -> bool:
    """Whether one thing is plainly "taller" than another; things of one size are not."""
    if any(item.part or item.board or item.name not in scene.infos for item in (thing, mark)):
        raise ReferenceProblem(phrase.text, f"{how!r} is said of whole things", 2, word=how)
    infos = scene.infos[thing.name], scene.infos[mark.name]
    signs = set()
    for one, other in _values(how, *infos):
        apart = max(one, other) / max(min(one, other), 1e-9)
        if _SAME < apart < ALIKE:
            signs |= {True, False}
        elif apart >= ALIKE:
            signs.add((one > other) == (SIZES[how][1] > 0))
    if len(signs) > 1:
        why = f"{thing.name} and {mark.name} cannot be told so"
        raise ReferenceProblem(phrase.text, why, 2, word=how)
    return signs == {True}


def _values(how: str, one: ObjectInfo, other: ObjectInfo) -> list[tuple[float, float]]:
    """What two things are compared by: all of it is to say the same. A plate that is wider than a
    cup, and holds less, is neither bigger nor smaller; of pens the longer one is also the taller.
    """
    quantity = SIZES[how][0]
    pair = one, other
    if quantity == "mass":
        return [(one.mass, other.mass)]
    if quantity == "girth":
        return [(min(one.size), min(other.size))]
    longest = max(one.size), max(other.size)
    if quantity == "volume":
        edge = [(info.size[0] * info.size[1] * info.size[2]) ** (1 / 3) for info in pair]
        return [(edge[0], edge[1]), longest]
    slim = [_is_slim(info) for info in pair]
    if all(slim) and (quantity == "height" or how == "longer"):
        return [longest]
    aside = max(one.size[:2]), max(other.size[:2])
    if quantity == "width":
        return [longest if how == "longer" and any(slim) else aside]
    upright = (one.size[2], other.size[2])
    return [upright, longest] if any(slim) else [upright]


def _is_slim(info: ObjectInfo) -> bool:
    """Whether a thing is far longer than wide, whichever way it lies."""
    sides = sorted(info.size)
    return sides[2] >= ELONGATED * sides[1]


def on_either_side(
    things: Sequence[Thing],
    modifier: Modifier,
    marks: Sequence[Thing],
    count: int | None,
    phrase: NounPhrase,
    scene: SceneState,
    *,
    every: bool = False,
) -> list[Thing]:
    """Of several things the two between which another one stands: in a row of such things the
    nearest to it on each side, else, and where ``every`` one is meant, the only ones.

    Raises:
        ReferenceProblem: it is open which they are.
    """
    if count not in (None, 2) or len(marks) != 1 or modifier.denied:
        raise ReferenceProblem(phrase.text, "say to which side of what", 2, word="side")
    (mark,) = marks
    alike = mark in things and not every
    for sides in _SIDES:
        around = [_at(side, things, mark, scene) for side in sides]
        if any(around):
            break
    if not all(around):
        raise ReferenceProblem(phrase.text, "none is on one of the sides", 1, word="side")
    for side, beside in zip(sides, around, strict=True):
        gaps = [space.gap(thing, mark, scene) for thing in beside[:2]]
        several = gaps[1:] and (not alike or gaps[1] - gaps[0] < AS_NEAR)
        if several or _askew(side, beside[0], mark, scene) > ROW:
            names = ", ".join(thing.name for thing in beside)
            raise ReferenceProblem(phrase.text, f"say which of {names}", 2, word="side")
    nearest = [beside[0] for beside in around]
    return [thing for thing in things if thing in nearest]


def _at(side: Prep, things: Sequence[Thing], mark: Thing, scene: SceneState) -> list[Thing]:
    """Things at a side of another one, which stand on the same, the nearest first."""
    if mark.name not in scene.states:
        return []
    there = [
        thing
        for thing in things
        if thing.name in scene.states
        and space.holds_at(side, thing, [mark], scene)
        and space.below(thing, scene) == space.below(mark, scene)
    ]
    return sorted(there, key=lambda thing: space.gap(thing, mark, scene))


def _askew(side: Prep, thing: Thing, mark: Thing, scene: SceneState) -> float:
    """How far a thing is off the straight line to a side, as a share of how far it is aside."""
    left, back = (
        abs(of(thing, scene) - of(mark, scene)) for of in (space.to_the_left, space.to_the_back)
    )
    aside, off = (left, back) if side in _SIDES[0] else (back, left)
    return off / max(aside, 1e-9)

"""Which things stand to others as a modifier says: "next to the cup", "nearest to the bowl"."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.geometry.blocking import before_fronts
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.naming.determiners import Quantity, quantity_of
from etot_cli.reasoning.language.reference.naming.usual_form import GENERAL
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.reasoning.language.words.places import ON_SIDE, Prep
from etot_cli.world.state import SceneState

RANKED = frozenset(
    {
        Prep.NEAR, Prep.NEXT_TO, Prep.NEAREST, Prep.FARTHEST, Prep.BETWEEN, Prep.LEFT, Prep.RIGHT,
        Prep.BEHIND, Prep.FRONT,
    }
)  # fmt: skip
"""Relations that are true of some things more than of others."""
HOLDING = frozenset({Prep.WITH, Prep.CONTAINING, Prep.BEARING})
"""What tells a thing by what is in or on it."""
_DISTANCES = frozenset({Prep.NEAREST, Prep.FARTHEST})
ROUGHLY = ", though only roughly"
"""How a note ends about what stands to a landmark as is said, but not by the definition."""
EQUAL = 1e-6
"""Distances that differ by no more, which is rounding, leave the choice open [m]."""

AS_NEAR = 0.01
"""What is farther by less is as near to the eye, and to a camera that measures to 5-10 mm [m]."""


def related(
    modifier: Modifier,
    things: list[Thing],
    landmarks: list[list[Thing]],
    quantity: Quantity,
    count: int | None,
    scene: SceneState,
    notes: list[str],
    text: str,
) -> tuple[list[Thing], list[Thing]]:
    """Those of the things that a modifier is true of, or that fit it best, and besides the best
    fitting the others that it is true of as well.

    ``notes`` gets what was chosen where several would do, or none by the relation's definition;
    ``text`` is the whole phrase, for messages.
    """
    prep = modifier.prep
    if prep is Prep.OF and all(map(is_one, modifier.phrases)):
        things = [thing for thing in things if _has_owner(thing, scene)]
    bare = modifier.denied and prep is Prep.WITH  # a cup without a saucer is on none either
    by_robot = any(space.ROBOT in several for several in landmarks)
    if by_robot and not (prep is Prep.NEAR and len(things) > 1) and prep not in _DISTANCES:
        raise ReferenceProblem(modifier.phrases[0].text, "say beside which object", 2)
    fitting = [
        thing
        for thing in things
        if any(
            (thing not in marks and space.holds_at(prep, thing, marks, scene) is not False)
            or (prep is Prep.OF and space.holds_at(prep, thing, marks, scene))
            or (bare and space.touches(thing, marks[0], scene))
            for marks in _tuples(landmarks)
        )
    ]
    plainly = [
        thing
        for thing in fitting
        if prep in space.RELATIONS
        and any(
            space.is_plainly(prep, thing, marks, scene)
            and not any(space.carries(thing, mark, scene) for mark in marks)
            for marks in _tuples(landmarks)
        )
    ]
    if not plainly and len(things) == 1 and _is_fixed_beside(prep, things[0], scene):
        return (
            (things, []) if modifier.denied else ([], [])
        )  # it says where something goes, not which fridge
    landmark_things = [mark for several in landmarks for mark in several]
    if prep is Prep.FRONT and not plainly:
        before = before_fronts(things, landmark_things, scene)
        if before and {*before} != {*fitting} and (fitting or modifier.denied):
            raise AmbiguousReference(text, [thing.name for thing in (*fitting, *before)])
        if len(before) == 1 and not modifier.denied:
            mark = " and ".join(mark.name for mark in landmark_things)
            notes.append(f"in front of {mark}: {before[0].name}, before the front of its own")
            return before, []
    upon = [
        thing
        for thing in fitting
        if prep in ON_SIDE and modifier.words == ("on",)
        if any(space.rests_on(thing, mark, scene) for mark in landmark_things)
    ]
    if upon and plainly:  # "the pot on the left side of the bench"
        raise AmbiguousReference(text, [thing.name for thing in (*upon, *plainly)])
    if upon:
        return [thing for thing in things if (thing in upon) != modifier.denied], []
    supports = [thing for thing in things if space.is_support(thing, scene)]
    borne = any(space.rests_on(m, thing, scene) for m in landmark_things for thing in supports)
    if prep in space.RELATIONS and borne and not (plainly or modifier.denied):
        return [], []  # "the table next to the phone" on a table says where on that
    if prep is Prep.NEXT_TO and count == len(plainly) == 1 and quantity.definite:
        _check_nearer(plainly[0], fitting, landmark_things[0], scene, text)
    fitting = plainly or fitting
    if modifier.denied:
        # "What is not on the tray" is no tray, either, nor in a bowl that is on it.
        whole = {m.name for m in landmark_things if m == Thing(m.name)}
        below = whole if prep in (Prep.ON, Prep.IN, Prep.FROM) else set()
        left = [t for t in things if t not in fitting and not below & space.below(t, scene)]
        return [thing for thing in left if thing not in landmark_things] or left, []
    if prep in (Prep.UNDER, Prep.ABOVE) and count == 1:
        # "The block under the blue one" of a tower is the one that bears it.
        touching = [
            thing
            for thing in fitting
            for mark in landmark_things
            if space.touches(*((mark, thing) if prep is Prep.UNDER else (thing, mark)), scene)
        ]
        return touching or fitting, []
    if prep not in RANKED:
        return fitting, []
    best: dict[Thing, float] = {}
    for marks in _tuples(landmarks):
        others = [
            thing
            for thing in fitting
            if thing not in marks
            and space.holds_at(prep, thing, marks, scene) is not False
            and not any(space.carries(thing, mark, scene) for mark in marks)
        ]
        for cost, thing in space.ranked(prep, others, marks, scene):
            best[thing] = min(cost, best.get(thing, cost))
    order = sorted(best, key=lambda thing: best[thing])
    if quantity.definite and count is not None and not quantity.every:
        worst = best[order[count - 1]] if len(order) >= count else 0.0
        chosen = [t for i, t in enumerate(order) if i < count or best[t] - worst < EQUAL]
    elif prep not in space.RELATIONS:
        return [thing for thing in things if thing in order[: count or 1]], []
    else:
        chosen = order if plainly or prep not in (Prep.NEAR, Prep.NEXT_TO) else order[:1]
        straight = [t for t in chosen if space.is_straight(prep, t, landmark_things, scene)]
        chosen = straight if straight[1:] or (straight and quantity.every) else chosen
        chosen = [thing for thing in things if thing in chosen]
    others = [thing for thing in order if thing not in chosen]
    if chosen and prep in space.RELATIONS and (others or not plainly):
        beside = " and ".join(mark.name for mark in landmark_things)
        names = " and ".join(thing.name for thing in chosen)
        names += f" rather than {' or '.join(thing.name for thing in others)}" if others else ""
        roughly = "" if plainly else ROUGHLY
        notes.append(f"{space.RELATIONS[prep].value} {beside}: {names}{roughly}")
    return chosen, others if plainly else []


def _check_nearer(
    nearest: Thing, fitting: Sequence[Thing], mark: Thing, scene: SceneState, text: str
) -> None:
    """Whether what by its definition is next to a landmark is nearer to that than all others.

    Raises:
        AmbiguousReference: by so little that nobody would tell them apart so.
    """
    near = space.gap(nearest, mark, scene) + AS_NEAR
    aside = [thing for thing in fitting if not space.carries(thing, mark, scene)]
    also = [thing for thing in aside if space.gap(thing, mark, scene) < near]
    if also[1:]:
        raise AmbiguousReference(text, [thing.name for thing in also])


def _has_owner(thing: Thing, scene: SceneState) -> bool:
    """Whether a thing may be said to be of another one; no cup is one "of the red cup"."""
    info = scene.infos.get(thing.name)
    return info is None or bool(info.parts or info.boards)


def _is_fixed_beside(prep: Prep, thing: Thing, scene: SceneState) -> bool:
    info = scene.infos.get(thing.name)
    return prep in space.RELATIONS and info is not None and not info.movable


def _tuples(landmarks: list[list[Thing]]) -> list[tuple[Thing, ...]]:
    if len(landmarks) == 1:
        return [(mark,) for mark in landmarks[0]]
    return [(one, two) for one in landmarks[0] for two in landmarks[1] if one != two]


def means_the_others(modifier: Modifier) -> bool:
    """Whether "between the other two" is said of one of three."""
    (first, *more) = modifier.phrases
    return not more and not first.pronoun and quantity_of(first.determiner).other


def between_the_others(things: list[Thing], phrase: NounPhrase, scene: SceneState) -> list[Thing]:
    """Of three things the one in the middle.

    Raises:
        ReferenceProblem: none is, or several are.
    """
    found = [
        thing
        for thing in things
        if len(others := [item for item in things if item != thing]) == 2
        and space.holds_at(Prep.BETWEEN, thing, others, scene)
    ]
    if len(found) != 1:
        names = ", ".join(thing.name for thing in things)
        raise ReferenceProblem(phrase.text, f"one of {names} should be between two others", 2)
    return found


def is_one(phrase: NounPhrase) -> bool:
    """Whether a phrase speaks of one thing that is known ("the cup")."""
    if phrase.words[-1:] and phrase.words[-1] in GENERAL:
        return False
    quantity = quantity_of(phrase.determiner)
    plural = not phrase.words or singular(phrase.words[-1]) != phrase.words[-1]
    return quantity.definite and not quantity.every and quantity.count in (None, 1) and not plural

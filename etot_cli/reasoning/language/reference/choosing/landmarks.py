"""Which things stand to others as a modifier says: "next to the cup", "nearest to the bowl"."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.geometry.blocking import before_fronts
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.naming.determiners import Quantity, quantity_of
from etot_cli.reasoning.language.reference.naming.usual_form import GENERAL, usual_form
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
_ASIDE = (Prep.LEFT, Prep.RIGHT, Prep.FRONT, Prep.BEHIND)
"""Sides of a landmark on which there may be several things abreast."""
_PLAINLY_NEARER = 0.5
"""What is on the same side of a landmark and not beyond the nearest there is out of the question
only where it is farther than that in this ratio.
"""
ROUGHLY = ", though only roughly"
"""How a note ends about what stands to a landmark as is said, but not by the definition."""
EQUAL = 1e-6
"""Distances that differ by no more, which is rounding, leave the choice open [m]."""

AS_NEAR = 0.01
"""What is farther by less is as near to the eye, and to a camera that measures to 5-10 mm [m]."""


class Told(Struct, frozen=True):
    """What a modifier says of some things, and of how many of them."""

    modifier: Modifier
    landmarks: list[list[Thing]]
    """For each of its phrases what that may mean."""
    quantity: Quantity
    count: int | None
    scene: SceneState
    text: str
    """The whole phrase, for messages."""

    @property
    def prep(self) -> Prep:
        """Its preposition."""
        return self.modifier.prep

    @property
    def marks(self) -> list[Thing]:
        """All that its phrases may mean."""
        return [mark for several in self.landmarks for mark in several]

    def ways(self) -> list[tuple[Thing, ...]]:
        """What its phrases may mean together."""
        if len(self.landmarks) == 1:
            return [(mark,) for mark in self.landmarks[0]]
        return [(one, two) for one in self.landmarks[0] for two in self.landmarks[1] if one != two]

    def may_hold(self, thing: Thing) -> bool:
        """Whether the modifier may be true of a thing."""
        prep, scene = self.prep, self.scene
        # A cup without a saucer is on none, either.
        bare = self.modifier.denied and prep is Prep.WITH
        return any(
            (thing not in marks and space.holds_at(prep, thing, marks, scene) is not False)
            or (prep is Prep.OF and space.holds_at(prep, thing, marks, scene))
            or (bare and space.touches(thing, marks[0], scene))
            for marks in self.ways()
        )

    def holds_plainly(self, thing: Thing) -> bool:
        """Whether a relation is true of a thing by its definition, and it bears no landmark."""
        prep, scene = self.prep, self.scene
        return prep in space.RELATIONS and any(
            space.is_plainly(prep, thing, marks, scene)
            and not any(space.carries(thing, mark, scene) for mark in marks)
            for marks in self.ways()
        )

    def note(self, chosen: Sequence[Thing], others: Sequence[Thing], *, plain: bool) -> str:
        """Which things were chosen rather than others."""
        beside = " and ".join(mark.name for mark in self.marks)
        names = " and ".join(thing.name for thing in chosen)
        names += f" rather than {' or '.join(thing.name for thing in others)}" if others else ""
        return f"{space.RELATIONS[self.prep].value} {beside}: {names}{'' if plain else ROUGHLY}"


_Found = tuple[list[Thing], list[Thing]]
"""What a modifier tells, and besides the best fitting the others that it is true of as well."""


def related(told: Told, things: list[Thing], notes: list[str]) -> _Found:
    """Those of the things that a modifier is true of, or that fit it best, and besides the best
    fitting the others that it is true of as well.

    ``notes`` gets what was chosen where several would do, or none by the relation's definition.

    Raises:
        AmbiguousReference: the modifier can be understood in two ways.
        ReferenceProblem: it says where something is by the robot.
    """
    prep, denied, scene = told.prep, told.modifier.denied, told.scene
    if prep is Prep.OF and all(map(is_one, told.modifier.phrases)):
        things = [thing for thing in things if _has_owner(thing, scene)]
    by_robot = any(space.ROBOT in several for several in told.landmarks)
    if by_robot and not (prep is Prep.NEAR and len(things) > 1) and prep not in _DISTANCES:
        raise ReferenceProblem(told.modifier.phrases[0].text, "say beside which object", 2)
    fitting = [thing for thing in things if told.may_hold(thing)]
    plainly = [thing for thing in fitting if told.holds_plainly(thing)]
    if not plainly and len(things) == 1 and _is_fixed_beside(prep, things[0], scene):
        # It says where something goes, not which fridge.
        return (things if denied else [], [])
    at_a_front = [] if plainly else _before_a_front(told, things, fitting, notes)
    if at_a_front:
        return at_a_front, []
    upon = _upon_a_side(told, fitting)
    if upon and plainly:  # "the pot on the left side of the bench"
        raise AmbiguousReference(told.text, [thing.name for thing in (*upon, *plainly)])
    if upon:
        return [thing for thing in things if (thing in upon) != denied], []
    supports = [thing for thing in things if space.is_support(thing, scene)]
    borne = any(space.rests_on(m, thing, scene) for m in told.marks for thing in supports)
    if prep in space.RELATIONS and borne and not (plainly or denied):
        return [], []  # "the table next to the phone" on a table says where on that
    if prep is Prep.NEXT_TO and told.count == len(plainly) == 1 and told.quantity.definite:
        _check_nearer(plainly[0], fitting, told.marks[0], scene, told.text)
    if denied:
        return _none_of_those(told, things, plainly or fitting), []
    if prep in (Prep.UNDER, Prep.ABOVE) and told.count == 1:
        return _touching(told, plainly or fitting), []
    if prep not in RANKED:
        return plainly or fitting, []
    roughly = [thing for thing in fitting if thing not in plainly]
    if prep in _ASIDE and len(plainly) == told.count == 1 and roughly and told.quantity.definite:
        notes.append(told.note(plainly, roughly, plain=True))
    return _best(told, things, plainly or fitting, notes, plain=bool(plainly))


def _before_a_front(
    told: Told, things: list[Thing], fitting: list[Thing], notes: list[str]
) -> list[Thing]:
    """What stands before the front that a landmark has of its own, be it turned away.

    Raises:
        AmbiguousReference: other things stand in front of it as the robot sees it.
    """
    denied = told.modifier.denied
    before = before_fronts(things, told.marks, told.scene) if told.prep is Prep.FRONT else []
    if before and {*before} != {*fitting} and (fitting or denied):
        raise AmbiguousReference(told.text, [thing.name for thing in (*fitting, *before)])
    if len(before) != 1 or denied:
        return []
    mark = " and ".join(mark.name for mark in told.marks)
    notes.append(f"in front of {mark}: {before[0].name}, before the front of its own")
    return before


def _upon_a_side(told: Told, fitting: list[Thing]) -> list[Thing]:
    """What is "on the left side of" a thing by standing on it."""
    if told.prep not in ON_SIDE or told.modifier.words != ("on",):
        return []
    return [t for t in fitting if any(space.rests_on(t, mark, told.scene) for mark in told.marks)]


def _none_of_those(told: Told, things: list[Thing], fitting: list[Thing]) -> list[Thing]:
    """What a modifier is denied of: what is "not on the tray" is no tray, either, nor in a bowl
    that is on it.
    """
    whole = {mark.name for mark in told.marks if mark == Thing(mark.name)}
    below = whole if told.prep in (Prep.ON, Prep.IN, Prep.FROM) else set()
    left = [t for t in things if t not in fitting and not below & space.below(t, told.scene)]
    return [thing for thing in left if thing not in told.marks] or left


def _touching(told: Told, fitting: list[Thing]) -> list[Thing]:
    """As "the block under the blue one" of a tower, which is the one that bears it."""
    under = told.prep is Prep.UNDER
    return [
        thing
        for thing in fitting
        for mark in told.marks
        if space.touches(*((mark, thing) if under else (thing, mark)), told.scene)
    ] or fitting


def _best(
    told: Told, things: list[Thing], fitting: list[Thing], notes: list[str], *, plain: bool
) -> _Found:
    """What fits a ranked relation best, which is ``plain``-ly true of all that fit, or of none."""
    prep, quantity, count, scene = told.prep, told.quantity, told.count, told.scene
    best: dict[Thing, float] = {}
    for marks in told.ways():
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
        chosen = order if plain or prep not in (Prep.NEAR, Prep.NEXT_TO) else order[:1]
        straight = [t for t in chosen if space.is_straight(prep, t, told.marks, scene)]
        chosen = straight if straight[1:] or (straight and quantity.every) else chosen
        chosen = [thing for thing in things if thing in chosen]
    others = [thing for thing in order if thing not in chosen]
    if plain and prep in _ASIDE and chosen == order[:1] and quantity.definite:
        beside = [t for t in others if not space.is_plainly(prep, t, chosen, scene)]
        rivals = [t for t in beside if worst > _PLAINLY_NEARER * best[t]]
        if rivals:
            raise AmbiguousReference(told.text, [thing.name for thing in (*chosen, *rivals)])
    if chosen and prep in space.RELATIONS and (others or not plain):
        notes.append(told.note(chosen, others, plain=plain))
    return chosen, others if plain else []


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


def means_the_others(modifier: Modifier) -> bool:
    """Whether "between the other two", or "bigger than the others", is said of one of these."""
    (first, *more) = modifier.phrases
    return (
        not (more or first.pronoun)
        and not first.modifiers
        and quantity_of(usual_form(first).determiner).other
    )


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

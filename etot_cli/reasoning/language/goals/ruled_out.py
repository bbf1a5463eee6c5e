"""Where things must not be put."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

from etot_cli.reasoning.builtin.goal import (
    Constraint,
    Grouping,
    Keep,
    Place,
    Put,
    Relation,
    Thing,
    things_in,
)
from etot_cli.reasoning.builtin.relations import bearers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.placing import add_put
from etot_cli.reasoning.language.goals.unchosen import is_not_chosen
from etot_cli.reasoning.language.grammar.syntax.clauses import AvoidClause
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, Toward
from etot_cli.reasoning.language.reference.geometry.space import (
    addresses,
    is_drawer,
    lies_in,
    rests_on,
    touches,
)
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.world.state import DESK, SceneState


def rule_out_things(context: Context, clause: AvoidClause) -> None:
    """Says where things must not be put; "it" is what was put somewhere, not where that is."""
    assert clause.things is not None
    before = [place.where for place in context.discourse.last_places if place.where is not None]
    indices = _whatever(context, clause) or context.phrases.things(
        clause.things, Role.THEME, before
    )
    below = context.discourse.last_places
    places = rule_out(context, indices, clause.destinations, left=clause.not_left)
    _rule_out_below(context, clause.destinations, places, below)
    context.discourse.last_places = places
    where = context.discourse.things(*(p.where for p in places if p.where is not None))
    marks = [
        (place.relation, thing)
        for place in places
        if place.where is not None
        for thing in context.discourse.things(place.where)
        if thing.name != DESK
    ]
    puts = (step for step in context.steps if isinstance(step, Put) and not step.removal)
    gone = {t for step in puts for t in context.discourse.things(*step.what)}
    gone |= {*context.discourse.placed}  # "in the blue bowl, not in the red one"
    for at in indices if clause.not_left else ():
        things = [thing for thing in context.discourse.things(at) if thing not in gone]
        there = [t for t in things if any(_is_there(t, *m, context.scene) for m in marks)]
        if there and clause.as_it_is:
            why = f"{there[0].name} is there; say where that is to go"
            raise ReferenceProblem(clause.destinations[0].targets[0].text, why, 4)
        known = len(context.discourse.referents[at].options) == 1
        whole = known and [*context.discourse.things(at)] == there
        taken = (at,) if whole else tuple(context.single(thing, thing.name) for thing in there)
        for index in taken:
            add_put(context, (index,), (context.places.on_the_desk(),), Grouping.ANY, removal=True)
        spared = context.discourse.left_out.get(at)  # what "it" means then
        if known and not (whole or spared) and at not in context.discourse.put:
            _speak_of_those_there(context, at, taken, where)


def _is_there(thing: Thing, relation: Relation, mark: Thing, scene: SceneState) -> bool:
    """Whether a thing is in or on something; what lies in a chest's drawer is not on the chest, nor
    is in a drawer what stands on its chest.
    """
    inside = scene.states[thing.name].inside if thing.name in scene.states else None
    stowed = inside is not None and scene.part(inside) is not None
    if relation is Relation.INSIDE and is_drawer(mark, scene):
        return lies_in(thing, mark, scene)
    return (rests_on if relation is Relation.ON and stowed else touches)(thing, mark, scene)


def _rule_out_below(
    context: Context,
    destinations: Sequence[Destination],
    found: Sequence[Place],
    below: Sequence[Place],
) -> None:
    """After "put the cup on the tray" what must stay "off it" goes neither on the cup, if "it" is
    that, nor on the tray.
    """
    it = all(np.pronoun == "it" for item in destinations for np in item.targets)
    upon = [item.relation is Relation.ON and item.where in context.discourse.put for item in found]
    marks = (p.where for p in below if p.relation is Relation.ON and p.where is not None)
    things = [thing for thing in context.discourse.things(*marks) if thing.name != DESK]
    if not (it and found and all(upon) and things and context.constraints):
        return
    last = context.constraints[-1]
    also = tuple((Relation.ON, thing.address) for thing in things)
    context.constraints[-1] = replace(last, places=(*last.places, *also))
    context.discourse.notes.append(
        f"'it': {' or '.join(address for _, address in context.constraints[-1].places)}"
    )


def _speak_of_those_there(
    context: Context, index: int, taken: Sequence[int], where: Sequence[Thing]
) -> None:
    """In "there should be no blocks on the tray; put them in the box" they are those on the tray,
    where any are.
    """
    discourse, scene = context.discourse, context.scene
    things = discourse.things(index)
    below = {t.name for t in things if any(touches(t, at, scene) for at in where)}
    below |= {at.name for at in where} - {DESK}  # on the desk is not in what stands there
    there = tuple(t for t in things if {t.name, *bearers(scene, t.name)} & below)
    if not there:
        return
    each = {*there} == {*discourse.things(*taken)}
    if not each:
        discourse.referents[index] = replace(discourse.referents[index], options=(there,))
    unsaid = (index,) if each else taken
    discourse.mentions = [m for m in discourse.mentions if m.referent not in unsaid]


def _whatever(context: Context, clause: AvoidClause) -> list[int]:
    """In "put nothing into the box" everything that could be put there; none where it is not said
    of anything.
    """
    phrases = clause.things.phrases if clause.things else ()
    if [np.words for np in phrases] != [("anything",)] or phrases[0].modifiers:
        return []
    targets = [np for where in clause.destinations for np in where.targets]
    options = [context.phrases.meaning(np, Role.PLACE).options for np in targets]
    around = {thing.name for found in options for thing in things_in(found)}
    states = context.scene.states
    things = tuple(
        Thing(name)
        for name, info in context.scene.infos.items()
        if info.movable and name in states and name not in around
        if clause.not_left or not bearers(context.scene, name) & around
    )
    every = Resolved((things,), noun="object", every=True)
    return [context.discourse.add(every, "anything", Role.THEME, several=True)]


def rule_out(
    context: Context,
    themes: Sequence[int],
    destinations: Sequence[Destination],
    *,
    left: bool = False,
    besides: Sequence[int] = (),
) -> tuple[Place, ...]:
    """Says where things must not be put, or (``left``) be left; returns these places.

    ``besides``: where they go, which "it" in "instead of on it" is not, if it can be another.
    """
    unchosen = [index for index in themes if is_not_chosen(context, index)]
    said = [index for index in themes if index not in unchosen]
    names = dict.fromkeys(thing.name for thing in context.discourse.things(*said))
    text = " and ".join(context.discourse.referents[index].text for index in themes)
    places: list[tuple[Relation, str]] = []
    beside = [item.text for where in destinations for item in where.beside]
    if all(where.toward is Toward.TO for where in destinations):
        themes = ()  # what is not to be used takes nothing, whether that goes in or on it
    discourse = context.discourse
    try:
        before, discourse.replaced = discourse.replaced, discourse.replaced | {*besides}
        found = context.places.of(destinations, themes, stays=left)
    except AmbiguousReference:
        raise
    except ReferenceProblem:
        discourse.replaced = before
        found = context.places.of(destinations, themes, stays=left)
    finally:
        discourse.replaced = before
    for place in found:
        if place.beside or place.where is None:
            text = next(iter(beside), text)
            raise ReferenceProblem(text, "only containers and surfaces can be ruled out", 2)
        if is_not_chosen(context, place.where, which=_holds_any(context, place.where)):
            continue  # no step puts anything there
        for thing in context.discourse.things(place.where):
            on = place.relation is Relation.ON
            meant = (thing.address,) if on else addresses(thing, context.scene)
            places += [(place.relation, item) for item in meant]
    alone = len(names) == 1  # of all that must not be on the tray, the tray itself is not anyway
    if alone and any(address.partition(".")[0] in names for _, address in places):
        raise ReferenceProblem(text, "nothing is in or on itself; say of what", 3)
    if places and names:
        context.constraints.append(Constraint(Keep.AWAY, tuple(names), tuple(places)))
    for index in unchosen if places else ():
        of_which = [(t, place) for t in context.discourse.things(index) for place in found]
        for thing, place in of_which:
            at = () if place.where is None else context.discourse.things(place.where)
            if any(_is_there(thing, place.relation, mark, context.scene) for mark in at):
                raise ReferenceProblem(text, f"{thing.name} is there; say which ones", 3)
        context.constraints.append(Constraint(Keep.AWAY, (), tuple(places), referent=index))
    return found


def _holds_any(context: Context, index: int) -> bool:
    """Whether something is in or on any of the things that a referent may be."""
    infos, scene = context.scene.infos, context.scene
    return any(
        touches(Thing(name), at, scene)
        for at in context.discourse.things(index)
        for name in infos
        if infos[name].movable
    )


def not_beside(
    context: Context,
    places: tuple[Place, ...],
    ruled_out: Sequence[Destination],
    themes: Sequence[int],
) -> tuple[Place, ...]:
    """Places on surfaces, where things are not to stand beside what is said, whichever is meant;
    what is in a vessel stands beside nothing.
    """
    out = [item for item in ruled_out if item.toward is Toward.BESIDE]
    if not out or any(place.relation is not Relation.ON for place in places):
        return places
    denied = tuple(
        replace(near, landmarks=marks, denied=True)
        for place in context.places.of(out, themes)
        for near in place.beside
        for marks in product(*map(context.discourse.each, near.landmarks))
    )
    return tuple(replace(place, beside=(*place.beside, *denied)) for place in places)

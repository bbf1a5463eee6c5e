"""How a revision ends: with what the goal wants, and with nothing that nobody asked for.

A branch has no steps for what already holds at its start. When a revision relocates such an object,
its goal has to be restored at the end of the branch, and so has the place of what was brought out
of somewhere only to be filled; what was in the hand is taken up again after that. What a revision
left behind of an opening whose use has come earlier is dropped.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product

from etot_cli.reasoning.builtin.choices import address_of
from etot_cli.reasoning.builtin.goal import Goal, Near, Open, Put, Relation, Thing, things_in
from etot_cli.reasoning.builtin.openings import TURNS, closed_by_others
from etot_cli.reasoning.builtin.relations import container_address, is_open, parts_of
from etot_cli.reasoning.builtin.revision import Actions, purpose, taken_at_once
from etot_cli.reasoning.builtin.rules import check_plan, in_hand, left_open
from etot_cli.reasoning.builtin.sketch import Sketch
from etot_cli.reasoning.builtin.turning import turned
from etot_cli.reasoning.protocol import Branch, FailedStep
from etot_cli.skills.action import PUTS, Action, Verb
from etot_cli.world.spatial import Nearby, Whereabouts
from etot_cli.world.state import DESK, STAYS_OPEN_AT, SceneState, owner_of

_Home = tuple[Relation, str, tuple[Whereabouts, ...]]
"""In or on what an object is, and where there."""


def completed(revised: Branch, failed: FailedStep, goals: Sequence[Goal]) -> Iterator[Branch]:
    """The revision without last openings that nobody asked for, and with steps that restore what
    held at the start and was asked for.

    What would come back as soon as it was set down is rather put back from the hand, where it may
    well come to stand or lie otherwise than it did.

    Args:
        revised: a well-formed revision.
        failed: what it was revised from.
        goals: what the branches were proposed for; without them the revision stays as it is.
    """
    if not goals:
        yield revised
        return
    start = failed.start
    kept = _without_last_openings(revised.actions, goals, start)
    away = _taken_away(kept)
    wanted = {name: _wanted_from_start(name, goals, start) for name in away}
    for name, put in away.items():
        kept = _as_wanted(kept, put, wanted[name])
        kept = _located(kept, put, _apart_from(name, goals))
    revised = replace(revised, actions=kept)
    homes = {name: wanted[name] or _filled_elsewhere(name, kept, start) for name in away}
    sketch = Sketch(start)
    for index, action in enumerate(kept):
        if _closes_for_good(kept, index):
            set_down = [name for name, put in away.items() if put < index]
            _bring_back_before(sketch, kept[index:], {name: homes[name] for name in set_down})
        below = _comes_onto(kept, index)
        if below is not None and away.get(below, index) < index:
            # Afterwards it could not be lifted any more.
            home = _left_home(sketch, below, homes[below])
            if home is not None:
                sketch.put(below, *home[:2], where=home[2])
        sketch.do(action)
    stays_open = _stays_open(sketch, goals)
    for name in away:
        home = _left_home(sketch, name, homes[name])
        if home is not None:
            sketch.put(name, *home[:2], where=home[2], left_open=stays_open)
    held = purpose(revised.actions, start).held
    if held is not None:
        sketch.pick_up(held)  # it was put down for what had to go back
    actions = tuple(sketch.actions)
    opened = (
        *left_open(failed.branch.actions, start), *closed_by_others(actions, start), *stays_open
    )  # fmt: skip
    plans = (*taken_at_once(actions, revised.actions), actions)
    sound = [plan for plan in plans if not check_plan(plan, start, opened)]
    yield from (replace(revised, actions=plan) for plan in sound or [revised.actions])


def _closes_for_good(actions: Actions, index: int) -> bool:
    """Whether a branch closes a part and turns it no more after that."""
    later = {action.target for action in actions[index + 1 :] if action.verb in TURNS}
    return actions[index].verb is Verb.CLOSE and actions[index].target not in later


def _comes_onto(actions: Actions, index: int) -> str | None:
    """What the thing that an action picks up is put on next, to stay there."""
    following = actions[index + 1 : index + 2]
    if actions[index].verb is not Verb.PICK_UP or not following:
        return None
    put = following[0]
    return owner_of(put.target) if put.verb is Verb.PUT_ON and not put.safe else None


def _bring_back_before(sketch: Sketch, rest: Actions, homes: Mapping[str, Sequence[_Home]]) -> None:
    """Brings back what belongs in or behind the part that the rest of a branch begins by closing,
    unless the rest has a use for it where it is by now.
    """
    closed = rest[0].target
    for name, places in homes.items():
        home = _left_home(sketch, name, places)
        if home is None or closed not in sketch.around(home[1]):
            continue
        back = Sketch(sketch.scene, sketch.actions)
        back.put(name, *home[:2], where=home[2], left_open=(closed,))
        if back.follows(rest):
            sketch.put(name, *home[:2], where=home[2], left_open=(closed,))


def _left_home(sketch: Sketch, name: str, homes: Iterable[_Home]) -> _Home | None:
    """The first of an object's places that it has left."""
    return next((home for home in homes if not sketch.holds(name, *home)), None)


def _without_last_openings(actions: Actions, goals: Iterable[Goal], start: SceneState) -> Actions:
    """The branch without what it opens at its end, unless that stood open at the start or a goal
    speaks of opening.
    """
    if any(isinstance(step, Open) for goal in goals for step in goal.steps):
        return actions
    while actions[-1].verb is Verb.OPEN:
        part = start.part(actions[-1].target)
        if part is None or is_open(start, part):
            break
        actions = actions[:-1]
    return actions


def _stays_open(sketch: Sketch, goals: Iterable[Goal]) -> tuple[str, ...]:
    """Parts that a branch leaves open and that what comes back into them has no reason to close:
    they stood open at the start, or a goal speaks of opening them.
    """
    scene = sketch.scene
    asked = {
        part.address
        for goal in goals
        for step in goal.steps
        if isinstance(step, Open)
        for thing in things_in(goal.referents[step.what].options)
        for part in parts_of(scene, thing)
    }
    parts = [part for info in scene.infos.values() for part in info.parts]
    asked |= {part.address for part in parts if scene.openness(part) >= STAYS_OPEN_AT}
    return tuple(
        part.address
        for part in parts
        if part.address in asked and sketch.is_accessible(part.address)
    )


def _taken_away(actions: Sequence[Action]) -> dict[str, int]:
    """Objects whose last put in a branch is to a safe place, and where in the branch that is."""
    walk = enumerate(in_hand(actions, None))
    puts = {held: index for index, (held, action, _) in walk if action.verb in PUTS}
    return {name: put for name, put in puts.items() if name is not None and actions[put].safe}


def _as_wanted(actions: Actions, put: int, homes: Iterable[_Home]) -> Actions:
    """The branch with an object stood or laid at the safe place of a put as a goal asks for, where
    that wants it on the same floor anywhere, or it only makes room there for what comes beside it:
    nothing has to come back from there.
    """
    action = actions[put]
    coming = {one.name for one in action.coming}
    for relation, target, where in homes:
        anywhere = action.coming or all(one.relation.is_stance for one in where)
        if (relation, target) == (Relation.ON, action.target) and anywhere:
            kept = tuple(one for one in where if coming.isdisjoint(one.landmarks))
            return _located(actions, put, kept)
    return actions


def _located(actions: Actions, put: int, where: Iterable[Whereabouts]) -> Actions:
    """The branch with more said of where something is put."""
    action = actions[put]
    said = tuple(dict.fromkeys((*action.where, *where)))
    return (*actions[:put], replace(action, where=said), *actions[put + 1 :])


def _apart_from(name: str, goals: Iterable[Goal]) -> Iterator[Whereabouts]:
    """What an object is to be away from, where a goal says that others are to be away from it."""
    for goal in goals:
        for step in (step for step in goal.steps if isinstance(step, Put)):
            beside = (_whereabouts(near, goal) for place in step.places for near in place.beside)
            apart = [one for one in beside if one.relation is Nearby.AWAY and not one.denied]
            for index, where in product(step.what, apart):
                options = goal.referents[index].options
                for thing in options[0] if len(options) == 1 else ():
                    yield from (there for mark, there in turned(thing.name, where) if mark == name)


def _filled_elsewhere(name: str, actions: Sequence[Action], start: SceneState) -> list[_Home]:
    """Where a vessel was at the start that a branch brings elsewhere to put something into it; none
    where it stood on the desk.
    """
    filling = [
        held
        for held, action, _ in in_hand(actions, start.holding)
        if action.verb is Verb.PUT_INTO and owner_of(action.target) == name
    ]
    state = start.states[name]
    if not filling or {*filling} & {*map(owner_of, state.on)}:
        return []  # what is put into it is what it stood on
    if state.inside is not None:
        return [(Relation.INSIDE, container_address(start, state.inside) or state.inside, ())]
    return [
        (Relation.ON, address, ())
        for address in state.on[:1]
        # What bore it and is elsewhere now takes its place along.
        if address != DESK and not Sketch(start, actions).is_moved(owner_of(address))
    ]


def _wanted_from_start(name: str, goals: Iterable[Goal], start: SceneState) -> list[_Home]:
    """Places of an object that hold at the start and that a goal asks for."""
    found: dict[_Home, None] = {}
    for goal in goals:
        for step in (step for step in goal.steps if isinstance(step, Put)):
            if all(Thing(name) not in things_in(goal.referents[i].options) for i in step.what):
                continue
            for place in step.places:
                where = tuple(_whereabouts(near, goal) for near in place.beside)
                at = place.where
                things = () if at is None else things_in(goal.referents[at].options)
                addresses = [a for t in things for a in address_of(t, place.relation, start)]
                if at is None:  # beside something, on what that stands on
                    addresses = [*(start.states[name].on[:1] or (DESK,))]
                found |= {(place.relation, address, where): None for address in addresses}
    sketch = Sketch(start)
    return [home for home in found if sketch.holds(name, *home)]


def _whereabouts(near: Near, goal: Goal) -> Whereabouts:
    marks = tuple(goal.referents[index].options[0][0].name for index in near.landmarks)
    return Whereabouts(near.relation, marks, near.point, near.denied)

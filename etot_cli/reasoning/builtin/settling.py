"""Puts a goal's steps together: a pick that leads to a put is one step, and the hand holds one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from etot_cli.reasoning.builtin.goal import (
    Goal,
    Open,
    Pick,
    Place,
    Put,
    Referent,
    Relation,
    Step,
    Thing,
    referents_of,
    things_in,
)
from etot_cli.reasoning.builtin.relations import bearers, is_on
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.world.state import DESK, ObjectInfo, SceneState

_ON_THE_DESK = Referent(((Thing(DESK),),), text=DESK)


LONG = 2.5
"""What is so many times longer than wide, and no vessel, is turned to go through a mouth: bottles
and pens are."""


def settled(goal: Goal, scene: SceneState, turned: Sequence[int] = ()) -> Goal:
    """A goal whose steps can be carried out one after the other.

    "Pick up the pear, … put it into the bowl" becomes one step, with the grasp that was asked for;
    so does taking something out and putting it elsewhere.

    Args:
        goal: steps as the clauses gave them.
        scene: what they are about.
        turned: referents that were to be reoriented.

    Raises:
        ReferenceProblem: two objects would have to stay in the hand, or something is only to be
            turned, for which there is no skill.
    """
    steps: list[Step] = []
    for index, step in enumerate(goal.steps):
        later = goal.steps[index + 1 :]
        if isinstance(step, Pick) and _is_moved(goal, step.what, later):
            if _must_be_out(goal, step.what, later, scene):
                desk = len(goal.referents)
                note = f"{goal.referents[step.what].text}: onto the desk until the hand is free"
                referents, notes = (*goal.referents, _ON_THE_DESK), (*goal.notes, note)
                goal = replace(goal, referents=referents, notes=notes)
                place = Place(Relation.ON, desk)
                steps.append(Put((step.what,), (place,), poses=step.poses, removal=True))
            continue
        if isinstance(step, Put) and step.removal:
            held = {s.what for s in later if isinstance(s, Pick)}
            last = [i for i in step.what if not (i in held or _is_moved(goal, i, later))]
            before = goal.steps[:index]
            there = [i for i in last if not _is_moved(goal, i, before)]
            _check_removal(goal, there, scene)
            back = [i for i in step.what if i not in last and _goes_back(goal, i, index, scene)]
            kept = tuple(
                i
                for i in step.what
                if i in last or i in back or _must_be_out(goal, i, later, scene)
            )
            if kept:
                steps.append(replace(step, what=kept))
            continue
        if isinstance(step, Pick) and step.what in (o.what for o in later if isinstance(o, Pick)):
            continue  # "pick up the cup and grip it from above" is one pick
        if isinstance(step, Put | Pick):
            step = _with_poses(step, goal.steps[:index])
        steps.append(step)
    _check_hand(goal, steps)
    for index in turned:
        _check_turned(goal, steps, index, scene)
    return replace(goal, steps=tuple(steps))


def _check_turned(goal: Goal, steps: Sequence[Step], referent: int, scene: SceneState) -> None:
    """Raises a ReferenceProblem where something is turned for its own sake: what is long is turned
    by being put into something, and nothing else is turned at all.
    """
    text = goal.referents[referent].text
    said = [step for step in steps if referent in referents_of(step)]
    if not said:
        why = "turning something is no skill of its own; say where it is to go"
        raise ReferenceProblem(text, why, 2)
    inserted = any(
        place.relation is Relation.INSIDE
        for step in said
        for place in (step.places if isinstance(step, Put) else ())
    )
    infos = [scene.infos[t.name] for t in things_in(goal.referents[referent].options)]
    if not (inserted and all(map(_is_turned_to_fit, infos))):
        raise ReferenceProblem(text, "how it is to be turned cannot be asked for", 3)


def _is_turned_to_fit(info: ObjectInfo) -> bool:
    _, wide, longest = sorted(info.size)
    return not info.container and longest >= LONG * wide


def _must_be_out(goal: Goal, referent: int, later: Sequence[Step], scene: SceneState) -> bool:
    """Whether what it lies in or on is moved, closed or filled before it goes elsewhere itself."""
    names = _named(goal, (referent,))
    around = set[str]().union(*(bearers(scene, name) for name in names if name in scene.states))
    for step in later:
        if isinstance(step, Put | Pick) and names & _named(goal, _held_in(step)):
            return False
        if not isinstance(step, Open) and around & _named(goal, referents_of(step)):
            return True
    return False


def _goes_back(goal: Goal, referent: int, at: int, scene: SceneState) -> bool:
    """Whether step ``at``, the first that moves it, takes something from where the next one puts
    it: what is taken out and put back has been out.
    """
    names = _named(goal, (referent,))
    moves = [
        step for step in goal.steps if isinstance(step, Put) and names & _named(goal, step.what)
    ]
    if moves[0] is not goal.steps[at] or not moves[1:]:
        return False
    states = [scene.states[name] for name in names if name in scene.states]
    # What is inside something is on its floor, too.
    around = {(Relation.INSIDE, state.inside) for state in states if state.inside is not None}
    around |= {(Relation.ON, at) for state in states if state.inside is None for at in state.on}
    return all(
        place.where is not None
        and not place.beside
        and any(
            (place.relation, thing.address) in around
            for thing in things_in(goal.referents[place.where].options)
        )
        for place in moves[1].places
    )


def _named(goal: Goal, referents: Iterable[int]) -> set[str]:
    return {t.name for i in referents for t in things_in(goal.referents[i].options)}


def _is_moved(goal: Goal, referent: int, later: Sequence[Step]) -> bool:
    """Whether later steps put a referent somewhere, as it is or each of its things."""
    if any(_moves(step, referent) for step in later):
        return True
    options = goal.referents[referent].options
    moved = {
        thing
        for step in later
        if isinstance(step, Put)
        for index in step.what
        if len(goal.referents[index].options) == 1
        for thing in goal.referents[index].options[0]
    }
    return len(options) == 1 and set(options[0]) <= moved


def _moves(step: Step, referent: int) -> bool:
    return isinstance(step, Put) and referent in step.what


def _held_in(step: Put | Pick) -> tuple[int, ...]:
    """Referents that a step takes into the hand."""
    return step.what if isinstance(step, Put) else (step.what,)


def _check_removal(goal: Goal, removed: Sequence[int], scene: SceneState) -> None:
    for index in removed:
        things = things_in(goal.referents[index].options)
        names = {DESK, *(thing.name for thing in things)}
        if things and all(any(is_on(scene, t.name, below) for below in names) for t in things):
            text = goal.referents[index].text
            raise ReferenceProblem(text, "it stands on the desk; say where it is to go", 2)


def _with_poses(step: Put | Pick, earlier: Sequence[Step]) -> Put | Pick:
    """The step with the grasp poses that an earlier pick of the same things asked for."""
    what = _held_in(step)
    for other in reversed(earlier if step.poses == (None,) else ()):
        if isinstance(other, Pick) and other.what in what and other.poses != (None,):
            return replace(step, poses=other.poses)
    return step


def _check_hand(goal: Goal, steps: Sequence[Step]) -> None:
    picks = list(dict.fromkeys(step.what for step in steps if isinstance(step, Pick)))
    sets = [goal.referents[index] for index in picks]
    if len(picks) > 1 or any(len(option) > 1 for referent in sets for option in referent.options):
        raise ReferenceProblem(
            " and ".join(referent.text for referent in sets),
            "the hand holds one object at a time; say where each of them is to go",
            3,
        )

"""Relations turned round: the same arrangement, said of another of the things that it is about."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import islice, pairwise, product

from etot_cli.reasoning.builtin.goal import Goal, Put, Relation, Thing, things_in
from etot_cli.reasoning.builtin.relations import bearers, is_at
from etot_cli.reasoning.builtin.revision import Actions, cycle_of
from etot_cli.reasoning.builtin.rules import check_plan
from etot_cli.reasoning.protocol import Branch, FailedStep
from etot_cli.skills.action import Action, Verb
from etot_cli.world import spatial
from etot_cli.world.spatial import Nearby, Whereabouts
from etot_cli.world.state import CauseKind, owner_of

CONVERSE = {
    Nearby.LEFT: Nearby.RIGHT,
    Nearby.RIGHT: Nearby.LEFT,
    Nearby.FRONT: Nearby.BEHIND,
    Nearby.BEHIND: Nearby.FRONT,
    Nearby.NEXT_TO: Nearby.NEXT_TO,
    Nearby.NEAR: Nearby.NEAR,
    Nearby.AWAY: Nearby.AWAY,
}
"""What holds of a landmark and a thing where the key holds of the thing and the landmark."""

MAX_WAYS = 4
"""Ways of moving landmarks in a thing's stead that are followed: two things between which it is to
be, of two relations."""


def turned(name: str, where: Whereabouts) -> Iterator[tuple[str, Whereabouts]]:
    """What it means for each of its landmarks that a thing is somewhere, while that stays.

    Args:
        name: the thing.
        where: where it is, or is not.

    Yields:
        A landmark, and where that is with respect to the thing and the other landmark.
    """
    if where.relation in CONVERSE:
        turned_round = replace(where, relation=CONVERSE[where.relation], landmarks=(name,))
        yield where.landmarks[0], turned_round
    elif where.relation is Nearby.BETWEEN:
        for one, other in (where.landmarks, where.landmarks[::-1]):
            yield one, replace(where, relation=Nearby.BEYOND, landmarks=(name, other))


def turned_round(failed: FailedStep, goals: Iterable[Goal]) -> Iterator[Branch]:
    """The branch with landmarks moved instead of a thing that cannot be, or has no room beside
    them, where only the relations were asked for.

    Args:
        failed: the failed step.
        goals: what the branches were proposed for.
    """
    actions, start = failed.branch.actions, failed.start
    cause = failed.verdict.cause or failed.record.cause
    own = cycle_of(actions, failed.index)
    pick, put = actions[own.start], actions[own.end - 1]
    alone = (pick.verb, put.verb) == (Verb.PICK_UP, Verb.PUT_ON) and own.end == own.start + 2
    # What has been taken out of the thing's way would have been so for nothing.
    if cause is None or not alone or any(action.safe for action in actions):
        return
    name, rest = pick.target, (*actions[: own.start], *actions[own.end :])
    if not _is_free(name, goals):
        return
    gone = {action.target for action in rest if action.verb is Verb.PICK_UP}
    if name in gone or gone & bearers(start, name):
        return
    if not is_at(start, name, Relation.ON, put.target):
        return
    unmet = [
        where
        for where in put.where
        if gone & {*where.landmarks} or not spatial.holds(where, name, start)
    ]
    for ways in islice(product(*(list(turned(name, where)) for where in unmet)), MAX_WAYS):
        changed: Actions | None = rest
        for mover, where in ways:
            if changed is not None:
                changed = _brought(changed, own.start, mover, put.target, where)
        if changed and not check_plan(changed, start):
            movers = " and ".join(dict.fromkeys(mover for mover, _ in ways))
            yield Branch(changed, f"{movers} instead of {name}, because {cause.text}")


def is_hopeless(failed: FailedStep) -> bool:
    """Whether nothing but a thing itself, or what it is to be beside, keeps it from its place."""
    cause = failed.verdict.cause or failed.record.cause
    action, scene = failed.branch.actions[failed.index], failed.record.before
    if cause is None or cause.kind not in (CauseKind.NO_GRASP, CauseKind.NO_ROOM):
        return False
    own = {scene.holding, owner_of(action.target)}
    own |= {mark for where in action.where for mark in where.landmarks}
    return {*map(owner_of, cause.objects)} <= own


def _is_free(name: str, goals: Iterable[Goal]) -> bool:
    """Whether only relations of an object are asked for, and not that it is moved."""
    return any(
        Thing(name) in things_in(goal.referents[index].options)
        and all(place.if_needed for place in step.places)
        for goal in goals
        for step in goal.steps
        if isinstance(step, Put)
        for index in step.what
    )


def _brought(
    actions: Actions, at: int, name: str, target: str, where: Whereabouts
) -> Actions | None:
    """A branch in which an object also gets to a place; None where it goes elsewhere."""
    for index, (pick, put) in enumerate(pairwise(actions)):
        if pick.verb is Verb.PICK_UP and pick.target == name:
            if (put.verb, put.target) != (Verb.PUT_ON, target):
                return None
            there = replace(put, where=(*put.where, where))
            return (*actions[: index + 1], there, *actions[index + 2 :])
    bring = Action(Verb.PICK_UP, name), Action(Verb.PUT_ON, target, where=(where,))
    return (*actions[:at], *bring, *actions[at:])

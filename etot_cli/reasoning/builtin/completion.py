"""How a revision ends: with what the goal wants, and with nothing that nobody asked for.

A branch has no steps for what already holds at its start. When a revision relocates such an object,
its goal has to be restored at the end of the branch. What a revision left behind of an opening
whose use has come earlier is dropped.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from etot_cli.reasoning.builtin.choices import address_of
from etot_cli.reasoning.builtin.goal import Goal, Open, Put, Relation, Thing, things_in
from etot_cli.reasoning.builtin.relations import is_at, is_open
from etot_cli.reasoning.builtin.revision import Actions
from etot_cli.reasoning.builtin.rules import check_plan, in_hand, left_open
from etot_cli.reasoning.builtin.sketch import Sketch
from etot_cli.reasoning.protocol import Branch, FailedStep
from etot_cli.skills.action import PUTS, Action, Verb
from etot_cli.world.state import SceneState


def completed(revised: Branch, failed: FailedStep, goals: Sequence[Goal]) -> Branch:
    """The revision without last openings that nobody asked for, and with steps that restore what
    held at the start and was asked for.

    Args:
        revised: a well-formed revision.
        failed: what it was revised from.
        goals: what the branches were proposed for; without them the revision stays as it is.
    """
    if not goals:
        return revised
    start = failed.start
    revised = replace(revised, actions=_without_last_openings(revised.actions, goals, start))
    sketch = Sketch(start, revised.actions)
    for name in _taken_away(revised.actions):
        for relation, target in _wanted_from_start(name, goals, start):
            if not sketch.holds(name, relation, target):
                sketch.put(name, relation, target)
                break
    actions = tuple(sketch.actions)
    opened = left_open(failed.branch.actions, start)
    if actions == revised.actions or check_plan(actions, start, opened):
        return revised
    return replace(revised, actions=actions)


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


def _taken_away(actions: Sequence[Action]) -> list[str]:
    """Objects whose last put in a branch is to a safe place."""
    puts = {held: action for held, action, _ in in_hand(actions, None) if action.verb in PUTS}
    return [name for name, put in puts.items() if name is not None and put.safe]


def _wanted_from_start(
    name: str, goals: Iterable[Goal], start: SceneState
) -> list[tuple[Relation, str]]:
    """Places of an object that hold at the start and that a goal asks for."""
    thing = Thing(name)
    found: dict[tuple[Relation, str], None] = {}
    for goal in goals:
        for step in goal.steps:
            if not isinstance(step, Put):
                continue
            if all(thing not in things_in(goal.referents[index].options) for index in step.what):
                continue
            for place in step.places:
                if place.where is None or place.beside:
                    continue
                for target in things_in(goal.referents[place.where].options):
                    for address in address_of(target, place.relation, start):
                        found[place.relation, address] = None
    return [item for item in found if is_at(start, name, *item)]

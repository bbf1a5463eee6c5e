"""What a goal demands of the final scene, as conditions of a task file."""

from __future__ import annotations

from typing import Any

from etot_cli.reasoning.builtin.goal import Close, Goal, Open, Pick, Put, Step, Thing, things_in

Demand = dict[str, Any]
"""A condition as a task file has it, e.g. ``{"inside": ["pen", "cup"]}``."""


def demands(goal: Goal) -> list[Demand]:
    """Conditions that hold once the goal is reached, one per thing or part that it is about.

    Weaker than the goal: places beside something, poses, and that several steps mean the same of
    several things are left out. Of steps about the same thing the last one counts.
    """
    found: dict[object, Demand] = {}
    for step in goal.steps:
        about = step.what if isinstance(step, Put) else (step.what,)
        for index in about:
            ways = (
                _joined("all", [_one(step, thing, goal) for thing in option])
                for option in goal.referents[index].options
            )
            demand = _joined("any", [*ways])
            if demand is None:
                found.pop(goal.referents[index].options, None)
            else:
                found[goal.referents[index].options] = demand
    return list(found.values())


def _one(step: Step, thing: Thing, goal: Goal) -> Demand | None:
    name = thing.address
    if isinstance(step, Pick):
        return {"in_hand": name}
    if isinstance(step, Open | Close):
        return {"open" if isinstance(step, Open) else "closed": name}
    if step.aside or step.removal or any(place.where is None for place in step.places):
        return None
    ends = [
        {place.relation.value: [name, end.address]}
        for place in step.places
        if place.where is not None
        for end in things_in(goal.referents[place.where].options)
    ]
    return _joined("any", [*ends])


def _joined(key: str, given: list[Demand | None]) -> Demand | None:
    """One condition of several; None where one of them cannot be said."""
    said = [item for item in given if item is not None]
    if len(said) < len(given) or not said:
        return None
    distinct = [item for number, item in enumerate(said) if item not in said[:number]]
    return distinct[0] if len(distinct) == 1 else {key: distinct}

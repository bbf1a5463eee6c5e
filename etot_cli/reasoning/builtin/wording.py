"""A goal in formal terms, on one line: what the reader says it understood."""

from __future__ import annotations

from etot_cli.reasoning.builtin.goal import (
    Close,
    Goal,
    Grouping,
    Keep,
    Near,
    Open,
    Pick,
    Place,
    Put,
    Relation,
    Step,
)


def formal(goal: Goal) -> str:
    """The goal's steps in their order and its constraints: ``inside: [pen, cup or mug]; …``."""
    told: set[int] = set()
    steps = [_step(step, goal, told) for step in goal.steps]
    kept = []
    for item in goal.constraints:
        names = ", ".join(item.names)
        if item.referent is not None:
            names = _choice(item.referent, goal, told)
        if item.keep is Keep.AWAY:
            places = (f"{relation.value} {place}" for relation, place in item.places)
            where = " or ".join(dict.fromkeys(places))
            kept.append(f"never {where}: {names}")
        else:
            turned = item.keep in (Keep.OPEN, Keep.CLOSED)
            kept.append(f"{'stays ' * turned}{item.keep.value}: {names}")
    said = dict.fromkeys(item for item in (*steps, *kept) if item)
    return "; ".join(said) or "nothing to do"


def _step(step: Step, goal: Goal, told: set[int]) -> str:
    if isinstance(step, Put):
        if step.aside:
            return ""
        what = " and ".join(_choice(index, goal, told) for index in step.what)
        things = sum(len(goal.referents[index].options[0]) for index in step.what)
        said = "" if step.grouping is Grouping.ANY or things < 2 else f" {step.grouping.value}"
        first = f"in_hand: {what}; " if step.lifted else ""
        keys = dict.fromkeys(_key(place) for place in step.places)
        if len(keys) == 1:
            where = " or ".join(dict.fromkeys(_place(place, goal, told) for place in step.places))
            return f"{first}{next(iter(keys))}: [{what}, {where}]{_poses(step)}{said}"
        ways = (f"{_key(place)} {_place(place, goal, told)}" for place in step.places)
        return f"{first}[{what}] {' or '.join(dict.fromkeys(ways))}{_poses(step)}{said}"
    if isinstance(step, Pick):
        return f"in_hand: {_choice(step.what, goal, told)}{_poses(step)}"
    assert isinstance(step, Open | Close)  # there is no other step
    key = "open" if isinstance(step, Open) else "closed"
    return f"{key}: {_choice(step.what, goal, told)}"


def _poses(step: Put | Pick) -> str:
    poses = [pose.value for pose in step.poses if pose is not None]
    return f" ({' or '.join(poses)})" if poses else ""


def _key(place: Place) -> str:
    return "inside" if place.relation is Relation.INSIDE else "on"


def _place(place: Place, goal: Goal, told: set[int]) -> str:
    surface = "" if place.where is None else _choice(place.where, goal, told, " or ")
    near = ", ".join(_near(item, goal, told) for item in place.beside)
    if not near:
        return surface
    if not surface:
        surface = "any surface" if place.if_needed else "the same surface"
    return f"{surface} ({near})"


def _near(near: Near, goal: Goal, told: set[int]) -> str:
    no = "not " if near.denied else ""
    if near.point is not None:
        return f"{no}at {near.point[0]:.3f} {near.point[1]:.3f}"
    marks = " and ".join(_choice(index, goal, told) for index in near.landmarks)
    return f"{no}{near.relation.value} {marks}".strip()


def _choice(index: int, goal: Goal, told: set[int], joint: str = " and ") -> str:
    """What a phrase may mean; ``told`` are those that were mentioned before."""
    referent = goal.referents[index]
    options = dict.fromkeys(joint.join(t.address for t in item) for item in referent.options)
    before = (goal.referents[other] for other in referent.distinct_from if other < index)
    things = {thing for item in referent.options for thing in item}
    shared = any(things & {thing for item in other.options for thing in item} for other in before)
    which = " (another)" if shared else " (the same)" if index in told else ""
    told.add(index)
    return " or ".join(options) + (which if len(options) > 1 else "")

"""What must not happen on the way: checked on plans beforehand and on what happened afterwards."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from etot_cli.reasoning.builtin.goal import Constraint, Goal, Keep, Relation
from etot_cli.reasoning.builtin.harm import CHANGED, displacement
from etot_cli.reasoning.builtin.relations import is_at, is_closed, is_open
from etot_cli.reasoning.builtin.rules import in_hand
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import Cause, CauseKind, RolloutRecord, SceneState, owner_of

ROBOT = ("robot", "gripper")
"""The robot's names in contacts."""


def broken_constraint(
    actions: Sequence[Action], constraints: Iterable[Constraint], scene: SceneState
) -> str | None:
    """What a plan would do that it must not, as a sentence; None for nothing."""
    for constraint in constraints:
        for index, (held, action, _) in enumerate(in_hand(actions, scene.holding), 1):
            if _does(action, held, constraint, scene):
                return f"step {index}, {action}: {_wish(constraint)}"
    return None


def spares_none(actions: Sequence[Action], goal: Goal, scene: SceneState) -> bool:
    """Whether a plan does what it must not with each of the things that a choice leaves one of."""
    left = [item for item in goal.constraints if item.referent is not None]
    return any(
        all(
            broken_constraint(actions, (item.about(option),), scene)
            for option in goal.referents[item.referent or 0].options
        )
        for item in left
    )


def cause_of_breach(
    record: RolloutRecord, constraints: Iterable[Constraint], blur: float = 0.0
) -> Cause | None:
    """What an action did that it must not have done; None for nothing.

    Args:
        record: what happened.
        constraints: what must not.
        blur: by how much two looks at something that stands still may differ [m].
    """
    for constraint in constraints:
        for name in constraint.names:
            text = _breach(name, constraint, record, CHANGED + blur)
            if text is not None:
                return Cause(CauseKind.COLLISION, (owner_of(name),), text)
    return None


def _does(action: Action, held: str | None, constraint: Constraint, scene: SceneState) -> bool:
    names = constraint.names
    match constraint.keep:
        case Keep.UNTOUCHED | Keep.UNMOVED:
            meant = owner_of(action.target) in names or action.target in names
            return meant and action.verb in (Verb.PICK_UP, Verb.OPEN, Verb.CLOSE)
        case Keep.CLOSED | Keep.OPEN:
            verb = Verb.OPEN if constraint.keep is Keep.CLOSED else Verb.CLOSE
            part = scene.part(action.target)
            own = () if part is None else (part.owner, f"{part.owner}.{part.name}")
            return action.verb is verb and any(name in names for name in own)
        case Keep.UNHIT:
            return False  # only what happens tells
        case Keep.AWAY:
            verbs = {Verb.PUT_ON: Relation.ON, Verb.PUT_INTO: Relation.INSIDE}
            return (
                held in names
                and not action.safe
                and (verbs.get(action.verb), action.target) in constraint.places
            )


def _breach(name: str, constraint: Constraint, record: RolloutRecord, far: float) -> str | None:
    before, after = record.before, record.after
    owner = owner_of(name)
    if owner not in before.states:
        return None
    match constraint.keep:
        case Keep.UNTOUCHED:
            if _is_touched(name, record):
                return f"{name} was touched, which it must not be"
            if name == owner and displacement(owner, record) > far:
                return f"{owner} was moved, and it must stay untouched"
        case Keep.UNMOVED:
            if displacement(owner, record) > far:
                return f"{owner} was moved, which it must not be"
        case Keep.UNHIT:
            if owner not in (before.holding, after.holding) and displacement(owner, record) > far:
                return f"{owner} was pushed, which it must not be"
        case Keep.AWAY:
            for relation, place in constraint.places:
                if is_at(after, owner, relation, place) and not is_at(
                    before, owner, relation, place
                ):
                    return f"{owner} came to be {relation.value} {place}, where it must not be"
        case Keep.CLOSED | Keep.OPEN:
            kept = is_closed if constraint.keep is Keep.CLOSED else is_open
            for part in before.infos[owner].parts:
                meant = name in (owner, part.address)
                if meant and kept(before, part) and not kept(after, part):
                    return f"{part.address} did not stay {constraint.keep.value}"
    return None


def _is_touched(name: str, record: RolloutRecord) -> bool:
    """Whether the hand, or what it holds, came against an object or a part. What is put into a
    part, or taken out of it, may: it is not to be touched any more than that needs.
    """
    touching = {*ROBOT}
    for held in (record.before.holding, record.after.holding):
        if held is None:
            continue
        around = (scene.states[held] for scene in (record.before, record.after))
        there = any(name == state.inside or name in state.on for state in around)
        touching |= set() if "." in name and there else {held}
    for contact in record.contacts:
        for one, other in ((contact.first, contact.second), (contact.second, contact.first)):
            if name in (one, owner_of(one)) and owner_of(other) in touching:
                return True
    return False


def _wish(constraint: Constraint) -> str:
    names = ", ".join(constraint.names)
    if constraint.keep is Keep.AWAY:
        return f"{names} must not be put there"
    return f"{names} must stay {constraint.keep.value}"

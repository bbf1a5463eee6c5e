"""Another grasp, after a failure: at once, or after what is held has been set down."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from etot_cli.reasoning.builtin.relations import ROLLING_KINDS, carriers, has_front
from etot_cli.reasoning.builtin.relocation import Correction, set_aside
from etot_cli.reasoning.builtin.revision import Actions, inserted, relocations
from etot_cli.reasoning.protocol import FailedStep
from etot_cli.skills.action import PUTS, Action, GraspPose, Verb
from etot_cli.specs.footprint import rotated
from etot_cli.world.spatial import Nearby, Whereabouts
from etot_cli.world.stance import can_lie, has_top
from etot_cli.world.state import Cause, CauseKind, owner_of

_NO_ROOM_ABOVE = frozenset(
    {CauseKind.NO_ROOM, CauseKind.NO_GRASP, CauseKind.UNREACHABLE,
     CauseKind.BLOCKED, CauseKind.COLLISION}
)  # fmt: skip
"""Causes that a roof above the place may be behind: no room for the hand, or hardly any."""
_AS_HELD = frozenset({CauseKind.NO_ROOM, CauseKind.UNREACHABLE})
"""Causes of a failed put that lie in how the object is held, where no other object is to blame."""
_STANDS = 0.5
"""A rod stands in the hand rather than lies while it rises by more than this (sine; 30°)."""


def regrasped(failed: FailedStep, pick: int, cause: CauseKind) -> Iterator[Correction]:
    """The branch with the object grasped in other ways where it is.

    Args:
        failed: the failed step.
        pick: place in the branch of the action that grasps the object.
        cause: of the failure.
    """
    actions = failed.branch.actions
    action = actions[pick]
    for pose, how in _other_poses(failed, action, cause):
        posed = (*actions[:pick], replace(action, pose=pose), *actions[pick + 1 :])
        yield Correction(posed, f"{action.target} is grasped {how}")


def grasped_anew(failed: FailedStep, pick: int | None, cause: CauseKind) -> Iterator[Correction]:
    """What is held is set down and grasped where the hand has room all round: in the other way,
    which it may have had no room for where the object was; what does not stand, or lie, as it was
    held, in any; and from above, what has no room beside a level hand.

    Args:
        failed: the failed put.
        pick: place in the branch of the action that grasped the object; None where it was in the
            hand from the start.
        cause: of the failure.
    """
    actions, name = failed.branch.actions, failed.record.before.holding
    action = actions[failed.index]
    if name is None or action.safe or relocations(actions, name):
        return
    taken = 0 if pick is None else pick + 1
    grasp = Action(Verb.PICK_UP, name) if pick is None else actions[pick]
    ways: list[tuple[GraspPose | None, str]] = []
    if any(where.relation.is_stance for where in action.where):
        ways.append((None, "anew"))
    if grasp.pose is GraspPose.HORIZONTAL and cause is CauseKind.NO_ROOM:
        ways.append((GraspPose.VERTICAL, "from above"))
    ways += _other_poses(failed, grasp, cause)
    _, down = set_aside(failed, name)
    for pose, how in ways:
        anew = inserted(actions, taken, (replace(down, pose=pose), replace(grasp, pose=pose)))
        yield Correction(anew, f"{name} is set down and grasped {how}", anew=True)
    level = grasp.pose is GraspPose.HORIZONTAL
    if level and _is_roofed(failed) and _may_lie(failed, name):
        # The hand that lays it down is above it; the one that takes it as it lies goes in level.
        laid = replace(down, where=(Whereabouts(Nearby.LYING),))
        anew = inserted(actions, taken, (laid, grasp))
        yield Correction(anew, f"{name} is laid down and grasped as it lies", anew=True)


def grasped_for(failed: FailedStep, pick: int | None, cause: Cause) -> Iterator[Correction]:
    """What does not go to its place as it is held is grasped so that it does, where it was.

    Args:
        failed: the failed put.
        pick: place in the branch of the action that grasped the object; None where it was in the
            hand from the start, so that it is set down first.
        cause: of the failure.
    """
    actions, name = failed.branch.actions, failed.record.before.holding
    put = actions[failed.index]
    misfit = cause.kind is CauseKind.NO_ROOM and cause.objects[:1] == (name,)
    if name is None or put.safe or misfit or cause.kind not in _AS_HELD:
        return
    if pick is None:
        yield from _set_down_for(failed, 0, Action(Verb.PICK_UP, name, onward=put))
    elif actions[pick].onward is None and actions[pick].pose is None:
        # Of any pose; what a given pose does not do, the branch without it does.
        suited = replace(actions[pick], onward=put)
        posed = (*actions[:pick], suited, *actions[pick + 1 :])
        yield Correction(posed, f"{name} is grasped so that it goes to {put.target}")


def laid_down(failed: FailedStep, pick: int | None, cause: Cause) -> Iterator[Correction]:
    """What is held from above and does not stand under a roof, or on top of what is loose, as it is
    held lies there: for what no level hand takes, or gets there with.

    Args:
        failed: the failed put.
        pick: place in the branch of the action that grasped the object; None where it was in the
            hand from the start.
        cause: of the failure.
    """
    actions, name = failed.branch.actions, failed.record.before.holding
    put = actions[failed.index]
    level = pick is not None and actions[pick].pose is GraspPose.HORIZONTAL
    misfit = cause.kind is CauseKind.NO_ROOM and cause.objects[:1] == (name,)
    if name is None or level or misfit or cause.kind not in _AS_HELD:
        return
    if not (_is_roofed(failed) or _is_on_loose_top(failed)):
        return
    info, stance = failed.record.before.infos[name], any(w.relation.is_stance for w in put.where)
    if stance or info.container or info.kind in ROLLING_KINDS or not can_lie(info):
        return
    if min(info.size[:2]) >= info.size[2]:
        return  # it is no lower on its side
    lying = replace(put, where=(*put.where, Whereabouts(Nearby.LYING)))
    laid = (*actions[: failed.index], lying, *actions[failed.index + 1 :])
    yield Correction(laid, f"{name} is laid down")


def set_down_for(failed: FailedStep) -> Iterator[Correction]:
    """What is nowhere held so that it goes to its place, where it is, is set down first."""
    actions, index = failed.branch.actions, failed.index
    pick = actions[index]
    first = (*actions[:index], replace(pick, onward=None), *actions[index:])
    yield from _set_down_for(failed, index + 1, pick, first)


def _set_down_for(
    failed: FailedStep, at: int, suited: Action, actions: Actions | None = None
) -> Iterator[Correction]:
    name = suited.target
    if relocations(failed.branch.actions, name) or suited.onward is None:
        return
    # From above it would be held as it was; a level hand may have had no room there.
    down = replace(set_aside(failed, name)[1], pose=GraspPose.HORIZONTAL)
    extra = (down, suited) if actions is None else (down,)
    anew = inserted(actions or failed.branch.actions, at, extra)
    change = f"{name} is set down and grasped so that it goes to {suited.onward.target}"
    yield Correction(anew, change, anew=True)


def _may_lie(failed: FailedStep, name: str) -> bool:
    """Whether something that stands may be laid down where it goes: where that is asked for, or
    nothing else is and it is no vessel.
    """
    info, where = failed.record.before.infos[name], failed.branch.actions[failed.index].where
    stances = {one.relation for one in where if one.relation.is_stance}
    if not (has_top(info) and can_lie(info)) or Nearby.UPRIGHT in stances:
        return False
    return Nearby.LYING in stances or not info.container


def _other_poses(
    failed: FailedStep, grasp: Action, cause: CauseKind
) -> list[tuple[GraspPose, str]]:
    """The poses to try where none was asked for, and their names: from above where the object
    slipped; from the side where the hand has no room above it, does not reach that far or that high
    from above, or is stopped on its way, or where a rod stands in the hand, which lays it down
    from there, as it does all that is to lie.

    What is pressed out of the fingers at a front has slipped in a hand that came from above as
    likely as in a level one, so that both are tried; the level one gets in.
    """
    if grasp.pose is not None or grasp.onward is not None:
        return []  # who looked ahead has looked at all poses
    above, level = (GraspPose.VERTICAL, "from above"), (GraspPose.HORIZONTAL, "from the side")
    if cause is CauseKind.SLIP:
        is_put = failed.branch.actions[failed.index].verb in PUTS
        return [level, above] if is_put and _is_roofed(failed) else [above]
    if (
        (cause in _NO_ROOM_ABOVE and _is_roofed(failed))
        or _is_out_of_reach(failed, cause)
        or _is_barred(failed, cause)
        or _stands_in_hand(failed)
        or _is_to_lie(failed)
    ):
        return [level]
    return []


def _is_out_of_reach(failed: FailedStep, cause: CauseKind) -> bool:
    """Whether the hand does not get from above to what is taken, or to where it is put down, or
    lets it fall there: a hand that points down reaches less far, and less high, than one that lies
    level.
    """
    verb = failed.branch.actions[failed.index].verb
    return cause is CauseKind.UNREACHABLE or (cause is CauseKind.REBOUND and verb is Verb.PUT_ON)


def _is_barred(failed: FailedStep, cause: CauseKind) -> bool:
    """Whether the arm that was to take something was stopped, and by nothing that could make way: a
    hand that comes from the side gets to it another way.
    """
    scene, action = failed.record.before, failed.branch.actions[failed.index]
    told = failed.verdict.cause or failed.record.cause
    if told is None or cause is not CauseKind.BLOCKED or action.verb is not Verb.PICK_UP:
        return False
    others = {owner_of(name) for name in told.objects} - {owner_of(action.target)}
    return not any(scene.infos[name].movable for name in others if name in scene.infos)


def _is_roofed(failed: FailedStep) -> bool:
    """Whether the place that the action puts to or takes from is got at through a front, its own or
    that of what bears it, or nothing is in the way of object and hand but what is neither moved nor
    opened.
    """
    scene, target = failed.record.before, failed.branch.actions[failed.index].target
    cause = failed.verdict.cause or failed.record.cause
    if cause is not None and cause.kind in (CauseKind.NO_GRASP, CauseKind.NO_ROOM):
        above = {owner_of(name) for name in cause.objects} - {owner_of(target), scene.holding}
        infos = [scene.infos[name] for name in above if name in scene.infos]
        if infos and not any(info.movable or info.parts for info in infos):
            return True
    places = {target}
    if owner_of(target) in scene.states:
        for name in (owner_of(target), *carriers(scene, owner_of(target))):
            places |= {*scene.states[name].on, scene.states[name].inside or name}
    return any(has_front(scene, place) for place in places)


def _is_on_loose_top(failed: FailedStep) -> bool:
    """Whether something was to be put on top of what is loose itself."""
    action = failed.branch.actions[failed.index]
    info = failed.record.before.infos.get(action.target)
    return action.verb is Verb.PUT_ON and info is not None and info.movable


def _is_to_lie(failed: FailedStep) -> bool:
    """Whether something was to be laid down: a level hand points down once it has done so, the
    hand that came from above is level then, and low.
    """
    action = failed.branch.actions[failed.index]
    return any(where.relation is Nearby.LYING for where in action.where)


def _stands_in_hand(failed: FailedStep) -> bool:
    """Whether a rod was to be put down that stands in the hand."""
    scene, action = failed.record.before, failed.branch.actions[failed.index]
    if action.verb not in PUTS or scene.holding is None:
        return False
    length = scene.infos[scene.holding].size[0]
    along = rotated(scene.states[scene.holding].quaternion, (length, 0.0, 0.0))
    return scene.infos[scene.holding].elongated and abs(along[2]) > _STANDS * length

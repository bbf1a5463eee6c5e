"""Another grasp, after a failure, where the instruction asked for none."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from etot_cli.reasoning.builtin.relations import carriers, has_front
from etot_cli.reasoning.builtin.relocation import Correction
from etot_cli.reasoning.protocol import FailedStep
from etot_cli.skills.action import PUTS, GraspPose, Verb
from etot_cli.specs.footprint import rotated
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import CauseKind, owner_of

_NO_ROOM_ABOVE = frozenset(
    {CauseKind.NO_ROOM, CauseKind.NO_GRASP, CauseKind.UNREACHABLE,
     CauseKind.BLOCKED, CauseKind.COLLISION}
)  # fmt: skip
"""Causes that a roof above the place may be behind: no room for the hand, or hardly any."""
_STANDS = 0.5
"""A rod stands in the hand rather than lies while it rises by more than this (sine; 30°)."""


def regrasped(failed: FailedStep, pick: int, cause: CauseKind) -> Iterator[Correction]:
    """The branch with the object grasped from above where it slipped; from the side where the hand
    has no room above it, does not reach that far or that high from above, or where a rod stands in
    the hand, which lays it down from there, as it does all that is to lie.

    Args:
        failed: the failed step.
        pick: place in the branch of the action that grasps the object.
        cause: of the failure.
    """
    actions = failed.branch.actions
    action = actions[pick]
    if action.pose is not None:
        return
    if cause is CauseKind.SLIP:
        pose, how = GraspPose.VERTICAL, "from above"
    elif (
        (cause in _NO_ROOM_ABOVE and _is_roofed(failed))
        or _is_out_of_reach(failed, cause)
        or _stands_in_hand(failed)
        or _is_to_lie(failed)
    ):
        pose, how = GraspPose.HORIZONTAL, "from the side"
    else:
        return
    posed = (*actions[:pick], replace(action, pose=pose), *actions[pick + 1 :])
    yield Correction(posed, f"{action.target} is grasped {how}")


def _is_out_of_reach(failed: FailedStep, cause: CauseKind) -> bool:
    """Whether what is put down does not get there from above, or is let fall there: a hand that
    points down reaches less far, and less high, than one that lies level.
    """
    verb = failed.branch.actions[failed.index].verb
    return (cause is CauseKind.UNREACHABLE and verb in PUTS) or (
        cause is CauseKind.REBOUND and verb is Verb.PUT_ON
    )


def _is_roofed(failed: FailedStep) -> bool:
    """Whether the place that the action puts to or takes from is got at through a front, its own or
    that of what bears it, or a grasp is obstructed by nothing but what is neither moved nor opened.
    """
    scene, target = failed.record.before, failed.branch.actions[failed.index].target
    if (cause := failed.verdict.cause or failed.record.cause) and cause.kind is CauseKind.NO_GRASP:
        above = {owner_of(name) for name in cause.objects} - {owner_of(target)}
        infos = [scene.infos[name] for name in above if name in scene.infos]
        if infos and not any(info.movable or info.parts for info in infos):
            return True
    places = {target}
    if owner_of(target) in scene.states:
        for name in (owner_of(target), *carriers(scene, owner_of(target))):
            places |= {*scene.states[name].on, scene.states[name].inside or name}
    return any(has_front(scene, place) for place in places)


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

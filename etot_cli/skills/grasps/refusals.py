"""Why an object is not grasped."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.skills.action import Action, GraspPose, Verb
from etot_cli.skills.belief import Belief
from etot_cli.skills.grasps.approach import NARROW_ROOMS, PreparedGrasp, prepare_grasp
from etot_cli.skills.grasps.ranking import GraspSet
from etot_cli.skills.grasps.variants import variants
from etot_cli.skills.motion.collision import HandPart
from etot_cli.skills.outcome import Blockers, SkillOutcome, failed
from etot_cli.world.placing import object_bounds
from etot_cli.world.state import ROUND_KINDS, CauseKind, owner_of

LEVEL_TOP = 0.99
"""What rises by this along its own z axis stands (cosine; 8°)."""
MAX_SUSPECTS = 4
"""Objects that are taken away, one at a time and together, to see whether that helps."""


def explain(
    belief: Belief,
    action: Action,
    found: GraspSet,
    blockers: Blockers,
    unreachable: int,
) -> SkillOutcome:
    """Why no grasp goes: whoever is in the way is found by looking again without them."""
    name, pose = action.target, action.pose
    opening = belief.world.robot.spec.gripper.opening
    # Lines that cut off a corner are short enough, but the fingers do not pass the object itself.
    suspects = blockers.most(excluding=[name])[:MAX_SUSPECTS]
    if not found.grasps and not found.too_wide:
        return failed(
            CauseKind.NO_GRASP,
            [name],
            f"no two opposed upright sides of {name} fit the gripper, which opens "
            f"{opening * 1000:.0f} mm",
            lasting=lasts(belief, name, pose),
        )
    if not found.grasps and found.narrowest > opening and lasts(belief, name, pose):
        # Who is in the way of fingers that could not close anyhow is no matter.
        return too_wide(name, found.narrowest, opening, lasting=True)
    guilty = _guilty(belief, name, found, suspects)
    if guilty:
        return failed(
            CauseKind.NO_GRASP,
            [*guilty, name],
            f"every grasp of {name} is obstructed by {', '.join(guilty)}"
            + _how_deep(belief, name, found, guilty),
        )
    if not found.grasps:
        return too_wide(name, found.narrowest, opening)
    if unreachable:
        return failed(
            CauseKind.UNREACHABLE,
            [name],
            f"the arm reaches none of the {unreachable} grasps of {name} that it has room for",
        )
    text = f"the hand has no room at any grasp of {name}"
    if blockers.always(name):  # as of what is round and broader than the line that would fit
        text = f"the fingers meet {name} itself at every grasp that is narrow enough for them"
    # Those whose absence has been seen not to help are not to blame.
    unseen = suspects if len(blockers.most(excluding=[name])) > len(suspects) else ()
    return failed(
        CauseKind.NO_GRASP,
        [*unseen, name],
        f"{text} (opening {opening * 1000:.0f} mm)",
        lasting=blockers.always(name) and lasts(belief, name, pose),
    )


def _how_deep(belief: Belief, name: str, found: GraspSet, guilty: Sequence[str]) -> str:
    """That it is the depth of the vessel that an object is in, where its fingers have room in there
    and the hand behind them has none.
    """
    vessel = belief.scene.states[name].inside
    if vessel is None or [vessel] != list(guilty) or not belief.world.entries[vessel].free:
        return ""
    checker, gripper = belief.checker, belief.world.robot.spec.gripper
    belief.checker.freeze(belief.data)
    for grasp in found.grasps:
        checker.set_fingers(min(grasp.width + 2 * max(NARROW_ROOMS), gripper.opening))
        fingers, hand = (
            {*map(owner_of, checker.hand_hits(grasp.tool, clearance=0.0, part=part))}
            for part in (HandPart.FINGERS, HandPart.ALL)
        )
        if vessel in hand - fingers:
            rim = object_bounds(belief.world, belief.data, vessel)[1][2]
            below = rim - object_bounds(belief.world, belief.data, name)[1][2]
            if below > 0.0:
                return (
                    f", in which it lies {below * 1000:.0f} mm below the rim: the fingers have "
                    "room there, the hand behind them has none"
                )
    return ""


def goes_nowhere(name: str, put: Action, count: int) -> SkillOutcome:
    """Why no grasp does that is to serve for a PUT, of ``count`` that were looked at."""
    how = "on" if put.verb is Verb.PUT_ON else "into"
    return failed(
        CauseKind.NO_ROOM,
        [name],
        f"by none of {count} grasps is {name} held so that it goes {how} {put.target}",
    )


def _guilty(belief: Belief, name: str, found: GraspSet, suspects: Sequence[str]) -> Sequence[str]:
    """Whose absence lets some grasp go, what can be moved first: each one's that does alone; where
    nothing that can be moved does, all those together that turn up one behind the other, as in a
    pile or before something at the back of a cupboard.
    """
    blockers, entries = Blockers(belief.world), belief.world.entries
    guilty = [one for one in suspects if _goes_without(belief, name, found, [one], blockers)]
    if any(entries[one].info.movable for one in guilty):
        return sorted(guilty, key=lambda one: not entries[one].info.movable)
    absent: list[str] = []
    behind = suspects
    while more := [one for one in behind if entries[one].info.movable or not guilty]:
        absent += more[: MAX_SUSPECTS - len(absent)]
        if len(absent) > 1 and _goes_without(belief, name, found, absent, blockers):
            return [*absent, *guilty]
        if len(absent) == MAX_SUSPECTS:
            break
        behind = blockers.most(excluding=[name, *absent])
    return guilty


def lasts(belief: Belief, name: str, pose: GraspPose | None) -> bool:
    """Whether an object that stands and has no grasp has none wherever it stands: which of its
    sides are seen depends on the place, unless they are all alike or all too far apart.
    """
    info = belief.world.entries[name].info
    if belief.data.body(name).xmat[8] < LEVEL_TOP:
        return False
    too_far = min(info.size[:2]) > belief.world.robot.spec.gripper.opening
    walled = info.container and pose is not GraspPose.HORIZONTAL
    return info.kind in ROUND_KINDS or (too_far and not walled)


def too_wide(
    name: str, width: float, opening: float, time_s: float | None = None, *, lasting: bool = False
) -> SkillOutcome:
    """``width`` and ``opening`` in metres."""
    return failed(
        CauseKind.NO_GRASP,
        [name],
        f"{name} is {width * 1000:.0f} mm wide where the fingers would close, the gripper opens "
        f"{opening * 1000:.0f} mm and needs a little to spare",
        time_s,
        lasting=lasting,
    )


def _goes_without(
    belief: Belief, name: str, found: GraspSet, absent: Sequence[str], blockers: Blockers
) -> bool:
    """Whether some grasp goes once these objects are taken away; notes who is in the way then."""
    with belief.checker.without(absent):
        for candidate in variants(found, belief.object_pose(name)):
            belief.checker.freeze(belief.data)
            result = prepare_grasp(belief, name, candidate, blockers)
            if isinstance(result, PreparedGrasp):
                return True
    return False

"""From an action and a belief to motions; from what became of a motion to the skill's account."""

from __future__ import annotations

from collections.abc import Iterator

from etot_cli.skills.action import PUTS, Action, Verb
from etot_cli.skills.articulation.articulate import articulation_motions, articulation_outcome
from etot_cli.skills.belief import Belief
from etot_cli.skills.grasps.pick import pick_motions, pick_outcome, pick_precondition
from etot_cli.skills.motion.motion import Motion, Trace
from etot_cli.skills.outcome import SkillOutcome, failed
from etot_cli.skills.placements.motion import put_motions, put_outcome
from etot_cli.world.state import CauseKind, SceneState


def plan_motions(
    belief: Belief, action: Action, rehearsed: Motion | None = None
) -> Iterator[Motion | SkillOutcome]:
    """Motions that carry an action out, best first, worked out one at a time as they are asked for.

    Args:
        belief: the twin in the state from which the action starts.
        action: what is to be done.
        rehearsed: a motion for the same action in a state much like this one. Its grasp, its place
            or its hold on a part comes first, retargeted to where object, target or part is
            believed to be.

    Yields:
        Motions; where there is none, the reason as the only item.
    """
    if action.verb is Verb.PICK_UP:
        problem = pick_precondition(belief, action)
        return iter([problem]) if problem else pick_motions(belief, action, rehearsed)
    if action.verb in PUTS:
        return put_motions(belief, action, rehearsed)
    holding = belief.held()
    if holding is not None:
        text = f"the hand still holds {holding}"
        return iter([failed(CauseKind.PRECONDITION, [holding], text)])
    return articulation_motions(belief, action, rehearsed)


def outcome_of(
    belief: Belief, action: Action, motion: Motion, trace: Trace, after: SceneState
) -> SkillOutcome:
    """Whether a motion had its effect, by the robot's own account and a look at the scene.

    Args:
        belief: from which the motion was worked out.
        action: what was to be done.
        motion: what the robot was told.
        trace: what the robot says became of it.
        after: the scene afterwards.
    """
    if action.verb is Verb.PICK_UP:
        return pick_outcome(belief, action, motion, trace, after)
    if action.verb in PUTS:
        return put_outcome(belief, action, trace, after)
    return articulation_outcome(belief, action, trace, after)

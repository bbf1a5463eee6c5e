"""Plans as stages with constraints between keypoints, and these as the five actions.

A stage says what is grasped, and where that is to be let go with respect to another keypoint, or
along which joint it is to be moved. Which of several possible plans is taken is decided as by a
path optimiser: the one with the shortest way of the hand from keypoint to keypoint. Nothing is
said of what happens on the way.

After: W. Huang et al., "ReKep: Spatio-Temporal Reasoning of Relational Keypoint Constraints for
Robotic Manipulation" (2024).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise

from etot_cli.reasoning.builtin.relations import owner_of
from etot_cli.reasoning.protocol import Branch
from etot_cli.skills.action import Action, GraspPose, Verb
from etot_cli.world.spatial import Whereabouts
from etot_cli.world.state import DESK, SceneState


class Feature(StrEnum):
    """What of an object a keypoint marks."""

    CENTRE = "centre"
    MOUTH = "mouth"
    TOP = "top"
    HANDLE = "handle"


class Relates(StrEnum):
    """What a stage asks of its keypoints."""

    GRASPED = "grasped"
    """The moved keypoint is at the tool point, and stays there."""
    WITHIN = "within"
    """It ends below the other keypoint, inside the opening that this one marks."""
    ABOVE = "above"
    """It ends upright above the other one, in contact."""
    PULLED = "pulled"
    """It moves along its joint to the end that opens."""
    PUSHED = "pushed"
    """It moves along its joint to the end that closes."""


@dataclass(frozen=True, slots=True)
class Keypoint:
    """A point on an object: ``position`` in the base frame [m]."""

    address: str
    position: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Stage:
    """One stage of a plan: a relation of a keypoint, to another one where there are two."""

    moved: Keypoint
    relates: Relates
    to: Keypoint | None = None
    approach: GraspPose | None = None
    """Direction that the hand comes from, where the task says so."""
    where: tuple[Whereabouts, ...] = ()
    """Where on a surface, where the task says so."""
    apart: Action | None = None
    """The action of a stage that only clears the way, with what it keeps clear of."""


def keypoint(scene: SceneState, address: str, feature: Feature) -> Keypoint:
    """The keypoint of an object, a part or the desk, in the scene as it is."""
    owner = owner_of(address)
    if owner not in scene.states:  # the desk
        x0, x1, y0, y1 = scene.desk_bounds
        return Keypoint(address, ((x0 + x1) / 2, (y0 + y1) / 2, scene.desk_top))
    x, y, z = scene.states[owner].position
    if feature in (Feature.MOUTH, Feature.TOP):
        z += scene.infos[owner].size[2] / 2
    return Keypoint(address, (x, y, z))


def stages(actions: Iterable[Action], scene: SceneState) -> tuple[Stage, ...]:
    """A plan's stages, keypoints where they are in the scene at its start."""
    found: list[Stage] = []
    held: Keypoint | None = None
    if scene.holding is not None:
        held = keypoint(scene, scene.holding, Feature.CENTRE)
    for action in actions:
        match action.verb:
            case Verb.PICK_UP:
                held = keypoint(scene, action.target, Feature.CENTRE)
                found.append(Stage(held, Relates.GRASPED, approach=action.pose))
            case Verb.PUT_ON | Verb.PUT_INTO:
                on = action.verb is Verb.PUT_ON
                to = keypoint(scene, action.target, Feature.TOP if on else Feature.MOUTH)
                relates = Relates.ABOVE if on else Relates.WITHIN
                apart = action if action.safe else None
                found.append(Stage(held or to, relates, to, where=action.where, apart=apart))
                held = None
            case Verb.OPEN | Verb.CLOSE:
                handle = keypoint(scene, action.target, Feature.HANDLE)
                pulled = action.verb is Verb.OPEN
                found.append(Stage(handle, Relates.PULLED if pulled else Relates.PUSHED))
    return tuple(found)


def actions_of(plan: Sequence[Stage]) -> tuple[Action, ...]:
    """The stages as actions: the inverse of :func:`stages`."""
    return tuple(_action(stage) for stage in plan)


def _action(stage: Stage) -> Action:
    if stage.apart is not None:
        return stage.apart
    target = DESK if stage.to is None else stage.to.address
    match stage.relates:
        case Relates.GRASPED:
            return Action(Verb.PICK_UP, stage.moved.address, stage.approach)
        case Relates.WITHIN:
            return Action(Verb.PUT_INTO, target, where=stage.where)
        case Relates.ABOVE:
            return Action(Verb.PUT_ON, target, where=stage.where)
        case Relates.PULLED:
            return Action(Verb.OPEN, stage.moved.address)
        case Relates.PUSHED:
            return Action(Verb.CLOSE, stage.moved.address)


def way_of_the_hand(plan: Sequence[Stage]) -> float:
    """Length of the way from keypoint to keypoint [m]."""
    points = [stage.moved.position if stage.to is None else stage.to.position for stage in plan]
    return sum(math.dist(one, two) for one, two in pairwise(points))


def shortest(branches: Iterable[Branch], scene: SceneState) -> Branch | None:
    """The branch with the shortest way of the hand, mapped to keypoints and back; the first of
    equals; None when there is none.
    """
    found = [(branch, stages(branch.actions, scene)) for branch in branches]
    if not found:
        return None
    branch, plan = min(found, key=lambda item: way_of_the_hand(item[1]))
    return Branch(actions_of(plan), branch.reason)

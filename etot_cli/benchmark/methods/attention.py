"""What in a scene as it stands asks for attention, action by action: geometry, no simulation.

Four kinds of points: what a door or a drawer passes through on its way, what is taller than the
compartment that it goes into, what fills an opening already, and what the gripper is too narrow
for. They are told as predicted failures with a cause, so that the reasoner corrects a plan by them
as it would by a failure that it has seen. Only the first scene is looked at: what a plan itself
brings about on its way is not foreseen.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice

import mujoco
import numpy as np

from etot_cli.reasoning.builtin.relations import contents, is_on, rides_on_part
from etot_cli.reasoning.protocol import (
    Branch,
    FailedStep,
    Outcome,
    Reasoner,
    Verdict,
)
from etot_cli.skills.action import Action, GraspPose, Verb
from etot_cli.world.index import Part
from etot_cli.world.model import World
from etot_cli.world.placing import geom_bounds
from etot_cli.world.snapshot import Snapshot, restore
from etot_cli.world.state import Cause, CauseKind, RolloutRecord, SceneState, Swept, owner_of

SWEEP_STEPS = 24
"""Poses of a part on its way that are looked at: a door of 0.4 m moves 3 cm from one to the next,
half a ball."""
NEAR_MAXIMUM = 0.95
"""What takes more than this share of the gripper's opening is hardly grasped across."""
CORRECTIONS = 8
"""Corrections in a row for one plan."""
MAX_BRANCHES = 64
"""Plans that are thought through."""


@dataclass(frozen=True, slots=True)
class AttentionPoint:
    """Why an action would fail, and the discs that are passed over by then."""

    cause: Cause
    swept: tuple[Swept, ...] = ()


class StaticScene:
    """The twin in one state, of which only the geometry is read.

    Args:
        world: the twin.
        start: its state.
        scene: the same state as relations see it.
    """

    def __init__(self, world: World, start: Snapshot, scene: SceneState) -> None:
        self._world, self._scene = world, scene
        self._data = mujoco.MjData(world.model)
        restore(world, self._data, start)

    def point(self, actions: tuple[Action, ...], index: int) -> AttentionPoint | None:
        """What asks for attention when an action of a plan is due; None when nothing does."""
        action = actions[index]
        moved = _moved_away(actions[:index])
        match action.verb:
            case Verb.PICK_UP:
                return self._width(action)
            case Verb.PUT_INTO:
                held = _held(actions[:index], self._scene)
                return None if held is None else self._opening(held, action, actions, index, moved)
            case Verb.OPEN | Verb.CLOSE:
                return self._sweep(action, moved)
        return None

    def _width(self, action: Action) -> AttentionPoint | None:
        """Whether the gripper is too narrow for a thing, taken the way that the plan says."""
        info = self._scene.infos.get(action.target)
        if info is None:
            return None
        opening = self._world.robot.spec.gripper.opening
        across = min(info.size[:2])
        by_the_rim = info.container and action.pose is not GraspPose.HORIZONTAL
        if by_the_rim or across <= NEAR_MAXIMUM * opening:
            return None
        wide = f"{1000 * across:.0f} mm wide"
        text = f"{info.name} is {wide}, and the gripper opens {1000 * opening:.0f} mm"
        return AttentionPoint(Cause(CauseKind.SLIP, (info.name,), text))

    def _opening(
        self, held: str, action: Action, actions: tuple[Action, ...], index: int, moved: set[str]
    ) -> AttentionPoint | None:
        """Whether a compartment is too low for a thing, or an opening taken by another one."""
        region = self._world.regions.get(action.target)
        if region is None or held not in self._scene.infos:
            return None
        part = self._scene.part(action.target)
        size = self._scene.infos[held].size
        clear = 2 * region.half[2]
        closed_later = any(
            item.verb is Verb.CLOSE and item.target == action.target for item in actions[index:]
        )
        if part is not None and closed_later and min(size) > clear:
            text = (
                f"{held} is {1000 * min(size):.0f} mm high, {action.target} {1000 * clear:.0f} mm"
            )
            return AttentionPoint(Cause(CauseKind.NO_ROOM, (held,), text))
        for name in self._occupants(action.target):
            if name in moved or name == held:
                continue
            taken = min(self._scene.infos[name].size[:2])
            left = 2 * min(region.half[:2]) - taken
            if left < min(size[:2]):
                text = f"{name} takes up the opening of {action.target}"
                return AttentionPoint(Cause(CauseKind.NO_ROOM, (name,), text))
        return None

    def _occupants(self, address: str) -> tuple[str, ...]:
        """What lies in a container, or across its mouth."""
        within = contents(self._scene, address)
        vessel = self._scene.infos.get(address)
        if vessel is None or not vessel.container:
            return within
        across = (name for name in self._scene.states if is_on(self._scene, name, address))
        return tuple(dict.fromkeys((*within, *across)))

    def _sweep(self, action: Action, moved: set[str]) -> AttentionPoint | None:
        """What a part, and what rides on it, passes through on its way to its other end."""
        part = self._world.parts.get(action.target)
        if part is None:
            return None
        hit: dict[str, CauseKind] = {}
        swept: list[Swept] = []
        info = self._scene.part(action.target)
        riders = set() if info is None else set(rides_on_part(self._scene, info)) - moved
        pairs = self._passed(part, action.verb is Verb.OPEN, riders, swept)
        for name, kind in pairs:
            if name not in moved:
                hit.setdefault(name, kind)
        if not hit:
            return None
        names = tuple(hit)
        verb = "is" if len(names) == 1 else "are"
        text = f"{' and '.join(names)} {verb} in the way of {action.target}"
        return AttentionPoint(Cause(hit[names[0]], names, text), tuple(swept))

    def _passed(
        self, part: Part, opens: bool, riders: set[str], swept: list[Swept]
    ) -> Iterator[tuple[str, CauseKind]]:
        """Movable things that overlap with the part's way, and riders that do not get through."""
        world, data = self._world, self._data
        joint = data.joint(part.joint)
        begin = float(joint.qpos[0])
        goal = part.upper if opens else part.lower
        kept = data.qpos.copy()
        body = data.body(part.body)
        origin, turn = body.xpos.copy(), body.xmat.reshape(3, 3).copy()
        poses = {name: data.joint(name).qpos.copy() for name in riders if world.entries[name].free}
        own = f"{part.info.owner}.{part.info.name}"
        moving = [g for g, label in enumerate(world.geom_address)
                  if label == own and world.model.geom_contype[g]]  # fmt: skip
        try:
            for step in range(1, SWEEP_STEPS + 1):
                joint.qpos[0] = begin + (goal - begin) * step / SWEEP_STEPS
                mujoco.mj_kinematics(world.model, data)
                shift = body.xmat.reshape(3, 3) @ turn.T
                for name, pose in poses.items():
                    place = data.joint(name).qpos
                    place[:3] = body.xpos + shift @ (pose[:3] - origin)
                mujoco.mj_kinematics(world.model, data)
                mujoco.mj_collision(world.model, data)
                swept.extend(self._discs(moving, own))
                yield from self._overlaps(own, riders)
        finally:
            data.qpos[:] = kept
            mujoco.mj_forward(world.model, data)

    def _overlaps(self, own: str, riders: set[str]) -> Iterator[tuple[str, CauseKind]]:
        world, contact = self._world, self._data.contact
        owner = owner_of(own)
        for (one, two), distance in zip(contact.geom, contact.dist, strict=True):
            if distance > -TOUCH:
                continue
            for first, second in ((int(one), int(two)), (int(two), int(one))):
                label, other = world.geom_address[first], world.geom_object[second]
                known = other in world.entries
                if label == own and known and other != owner and other not in riders:
                    yield other, CauseKind.COLLISION
                rider = world.geom_object[first]
                blocked = world.geom_object[second] == owner
                if rider in riders and blocked and world.geom_address[second] != own:
                    yield rider, CauseKind.BLOCKED

    def _discs(self, geoms: Iterable[int], name: str) -> Iterator[Swept]:
        """Discs of the desk plane that cover the boxes around geoms."""
        for geom in geoms:
            low, high = geom_bounds(self._world.model, self._data, geom)
            x, y = (low[:2] + high[:2]) / 2
            half = float(np.hypot(*(high[:2] - low[:2]))) / 2
            yield Swept(name, round(float(x), 3), round(float(y), 3), round(half, 3))


TOUCH = 0.002
"""Overlaps below this are contacts at rest [m]."""


@dataclass(frozen=True, slots=True)
class Considered:
    """A plan after thinking: ``open_points`` are those that no correction takes away."""

    branch: Branch
    open_points: int


def considered(
    branches: Iterable[Branch], static: StaticScene, scene: SceneState, reasoner: Reasoner
) -> list[Considered]:
    """Thinks every plan through and corrects it by what asks for attention.

    Args:
        branches: plans, the preferred one first.
        static: the geometry of the scene at its start.
        scene: that scene as relations see it.
        reasoner: finds corrections.
    """
    return [
        _corrected(branch, static, scene, reasoner) for branch in islice(branches, MAX_BRANCHES)
    ]


def _corrected(
    branch: Branch, static: StaticScene, scene: SceneState, reasoner: Reasoner
) -> Considered:
    left: set[int] = set()
    for _ in range(CORRECTIONS):
        found = _first_point(branch, static, left)
        if found is None:
            break
        index, point = found
        record = RolloutRecord(scene, scene, False, point.cause, swept=point.swept)
        verdict = Verdict(Outcome.FAILURE, point.cause)
        failed = FailedStep(branch, index, record, verdict, scene)
        better = next(iter(reasoner.reflect(failed)), None)
        if better is None:
            left.add(index)
        else:
            branch, left = better, set()
    remaining = sum(
        static.point(branch.actions, index) is not None for index in range(len(branch.actions))
    )
    return Considered(branch, remaining)


def _first_point(
    branch: Branch, static: StaticScene, left: set[int]
) -> tuple[int, AttentionPoint] | None:
    for index in range(len(branch.actions)):
        if index not in left:
            point = static.point(branch.actions, index)
            if point is not None:
                return index, point
    return None


def _moved_away(before: Iterable[Action]) -> set[str]:
    """Objects that a plan has taken from where they stand by then."""
    return {action.target for action in before if action.verb is Verb.PICK_UP}


def _held(before: tuple[Action, ...], scene: SceneState) -> str | None:
    """What is in the hand when an action is due."""
    held = scene.holding
    for action in before:
        if action.verb is Verb.PICK_UP:
            held = action.target
        elif action.verb in (Verb.PUT_ON, Verb.PUT_INTO):
            held = None
    return held

"""PUT ON and PUT INTO: where what is in the hand can go, and how it gets there."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.action import Action
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.collision import Attached
from etot_cli.skills.motion.kinematics import Pose
from etot_cli.skills.outcome import Blockers, Evidence, SkillOutcome, failed
from etot_cli.skills.placements.container_spots import container_targets, front_targets
from etot_cli.skills.placements.orientation import resting_rotation, turned_rotations
from etot_cli.skills.placements.placement import (
    LOWER_STEP,
    Placement,
    lower_into,
    lower_onto,
    slide_in,
)
from etot_cli.skills.placements.surface_spots import surface_spots
from etot_cli.skills.placements.wanted import wanted_spots
from etot_cli.world.index import Region
from etot_cli.world.state import DESK, CauseKind

Vector = NDArray[np.float64]

SURFACE_GAP = 0.002
"""The object is let go this far above a surface [m]."""
LEVEL_OPENING = 0.5
"""Containers whose opening rises less than this (sine) are filled from the front."""
MAX_SPOTS = 24
MOUTH_CLEARANCE = 0.02
"""How far above a container's rim the lowest part starts going in [m]."""


Placements = Iterator[Placement | SkillOutcome]
"""Best first; the reason as the only item where there is none."""


def placements_on(belief: Belief, action: Action, name: str) -> Placements:
    """Ways to put the held object ``name`` on a surface, each at another spot."""
    world = belief.world
    if action.target != DESK and action.target not in world.surfaces:
        text = f"{action.target} has no flat top to put something on"
        yield failed(CauseKind.PRECONDITION, [action.target], text)
        return
    attached = belief.attach(name)
    space = None if action.target == DESK else world.surfaces[action.target].space
    if space is not None:
        explain = partial(_no_spot, name, f"{action.target}, held as it is")
        yield from _through_front(belief, attached, space, explain)
        return
    base = resting_rotation(belief, attached)
    low, high = belief.checker.extent(name, base)
    spots = surface_spots(
        world,
        belief.data,
        action.target,
        float(np.abs(np.concatenate([low[:2], high[:2]])).max()),
        action.keepout,
        ignore={name},
        prefer=belief.object_pose(name).position[:2],
        wanted=wanted_spots(world, belief.data, action, name),
        at=[where.point for where in action.where if where.point is not None],
    )
    yield from _onto(belief, action.target, attached, base, spots[:MAX_SPOTS])


def _onto(
    belief: Belief,
    surface: str,
    attached: Attached,
    base: Vector,
    spots: Sequence[tuple[Vector, float]],
) -> Placements:
    name = attached.name
    blockers = Blockers(belief.world)
    touching = {surface, surface.split(".")[0]}
    found = False
    for spot, height in spots:
        targets = []
        for rotation in turned_rotations(belief, attached, base, spot)[:4]:
            low, _ = belief.checker.extent(name, rotation)
            position = np.array([spot[0], spot[1], height + SURFACE_GAP - low[2]])
            targets.append(Pose(position, rotation))
        belief.checker.freeze(belief.data)
        for target in targets:
            placement = lower_onto(belief, attached, target, touching, blockers)
            if placement is not None:
                found = True
                yield placement
                break
    if not found:
        yield _no_spot(name, surface, blockers.evidence())


def _no_spot(name: str, surface: str, evidence: Evidence) -> SkillOutcome:
    return failed(
        CauseKind.NO_ROOM,
        [*evidence.most(excluding=[name]), name],
        f"no free, reachable spot for {name} on {surface}",
    )


def placements_into(belief: Belief, action: Action, name: str) -> Placements:
    """Ways to put the held object ``name`` into a container; a rod stands where it must."""
    part = belief.world.parts.get(action.target)
    region = belief.world.regions.get(part.info.address if part else action.target)
    if region is None:
        yield failed(CauseKind.PRECONDITION, [action.target], f"{action.target} is no container")
        return
    attached = belief.attach(name)
    out = belief.data.body(region.body).xmat.reshape(3, 3) @ np.array(region.opening)
    if abs(out[2]) < LEVEL_OPENING:
        # The hand, not the object, is what most often has no room there.
        explain = partial(_no_way_in, name, f"{action.target} from the front, held as it is")
        yield from _through_front(belief, attached, region, explain)
        return
    explain = partial(_no_way_in, name, action.target)
    yield from _into(belief, attached, region, explain)


def _into(
    belief: Belief,
    attached: Attached,
    region: Region,
    explain: Callable[[Evidence], SkillOutcome],
) -> Placements:
    """One way down to the bottom, and those that end higher, the deepest first."""
    blockers = Blockers(belief.world)
    shallow: list[Placement] = []
    found = False
    hover = 2 * region.half[2] + MOUTH_CLEARANCE
    for target in container_targets(belief, attached, region):
        belief.checker.freeze(belief.data)
        placement = lower_into(belief, attached, target, hover, blockers)
        if placement is None:
            continue
        found = True
        if placement.drop >= LOWER_STEP:
            shallow.append(placement)
            continue
        yield placement
        break
    if not found:
        yield explain(blockers.evidence())
    for placement in sorted(shallow, key=lambda item: round(item.drop / LOWER_STEP)):
        yield placement


def _through_front(
    belief: Belief,
    attached: Attached,
    region: Region,
    explain: Callable[[Evidence], SkillOutcome],
) -> Placements:
    """Level through the open side, to places on the floor."""
    blockers = Blockers(belief.world)
    found = False
    for target, way_in in front_targets(belief, attached, region):
        belief.checker.freeze(belief.data)
        placement = slide_in(belief, attached, target, way_in, blockers)
        if placement is not None:
            found = True
            yield placement
    if not found:
        yield explain(blockers.evidence())


def _no_way_in(name: str, container: str, evidence: Evidence) -> SkillOutcome:
    blocking = evidence.most(excluding=[name])
    return failed(
        CauseKind.NO_ROOM,
        [*blocking, name],
        f"{name} cannot be brought into {container}"
        + (f": {', '.join(blocking)} in the way" if blocking else ": out of the arm's reach"),
    )

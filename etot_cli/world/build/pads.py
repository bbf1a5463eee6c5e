"""What holds a thing between the pads: friction of each pair of pad and thing.

MuJoCo takes the larger friction of two geoms, and the pads' would always win. So pads and things
whose product says otherwise are told their friction pair by pair.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

STANDARD = 0.6
"""Friction of the surface against which a pad's own friction is stated: that of things by default.
A thing of another friction is held by pad × thing / STANDARD."""
ENOUGH = 1e-9
"""Frictions closer than this are the same."""


def add_pad_pairs(mj: mujoco.MjSpec, pads: list[str], objects: list[str], factor: float) -> None:
    """Adds a contact pair for every pad and geom whose friction is not the larger of the two.

    Args:
        mj: the model, with robot and objects.
        pads: names of the pads.
        objects: names of the objects' bodies.
        factor: of the pads' friction.
    """
    count = 0
    for name in objects:
        for thing in list(_moving_geoms(mj.body(name), moves=False)):
            for pad in (mj.geom(item) for item in pads):
                friction = factor * float(pad.friction[0]) * float(thing.friction[0]) / STANDARD
                larger = max(float(pad.friction[0]), float(thing.friction[0]))
                if thing.priority != pad.priority or abs(friction - larger) < ENOUGH:
                    continue
                if not thing.name:
                    thing.name, count = f"{name}/geom{count}", count + 1
                _, torsion, rolling = (
                    max(float(one), float(two))
                    for one, two in zip(pad.friction, thing.friction, strict=True)
                )
                mj.add_pair(
                    geomname1=pad.name,
                    geomname2=thing.name,
                    condim=max(int(pad.condim), int(thing.condim)),
                    friction=[friction, friction, torsion, rolling, rolling],
                    solref=list(thing.solref),
                    solimp=list(thing.solimp),
                )


def grip_friction(model: mujoco.MjModel, pad: int, geoms: NDArray[np.int64]) -> float:
    """Smallest friction between a pad and some geoms of a compiled model, pads as described."""
    own, priority = float(model.geom_friction[pad][0]), int(model.geom_priority[pad])
    found = []
    for geom in geoms:
        friction, other = float(model.geom_friction[geom][0]), int(model.geom_priority[geom])
        if other == priority:
            found.append(own * friction / STANDARD)
        else:
            found.append(friction if other > priority else own)
    return min(found, default=own)


def _moving_geoms(body: Any, *, moves: bool) -> Iterator[Any]:
    """Colliding geoms of a body and what hangs on it that can be gripped and moved."""
    moves = moves or len(body.joints) > 0
    if moves:
        yield from (geom for geom in body.geoms if geom.contype)
    for child in body.bodies:
        yield from _moving_geoms(child, moves=moves)

"""Fifth stage: a second frame with another joint state shows what moves, and how.

Furniture is fitted in both frames. The frame in which it is open tells the part, the kind of joint
and its axis; with the body held as found there, the other frame tells the other joint value.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from etot_cli.reconstruction.capture.view import Array
from etot_cli.reconstruction.fit.pose import fit_shape, judge
from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.shapes.base import rotate
from etot_cli.reconstruction.shapes.furniture import OpenCabinet, OpenUnit

SAME_PLACE = 0.12
"""The centres of one piece of furniture in both frames lie this near [m]."""
MOVED = {"slide": 0.01, "hinge": 0.05}
"""Joint values that differ by less are the same state [m or rad]."""
EXTRA_TRAVEL = 0.0005
"""A drawer seen open that far can be there: the limit lies this far beyond it [m]."""


@dataclass(frozen=True)
class Joint:
    """A joint that was seen in two states.

    ``type``: ``slide`` or ``hinge``; ``axis`` (3,) unit vector and ``anchor`` (3,) a point on it,
    base frame [m]; ``values``: in the first and the second frame [m or rad].
    """

    owner: str
    type: str
    axis: Array
    anchor: Array
    values: tuple[float, float]


def articulate(first: list[Solid], second: list[Solid]) -> tuple[list[Solid], list[Joint]]:
    """The solids of the first frame with joints as far as the second frame shows them."""
    found: list[Solid] = []
    joints: list[Joint] = []
    for solid in first:
        partner = _partner(solid, second)
        result = None if partner is None else _two_states(solid, partner)
        if result is None:
            found.append(solid)
            continue
        found.append(result[0])
        joints.append(result[1])
    return found, joints


def _partner(solid: Solid, others: list[Solid]) -> Solid | None:
    named = [other for other in others if other.segment.named and other.name == solid.name]
    if named:
        return named[0]
    near = [o for o in others if np.linalg.norm((o.center - solid.center)[:2]) < SAME_PLACE]
    return min(near, key=lambda o: float(np.linalg.norm(o.center - solid.center)), default=None)


def _two_states(solid: Solid, partner: Solid) -> tuple[Solid, Joint] | None:
    """The solid with its joint; None where neither frame shows it open."""
    opened = [s for s in (solid, partner) if isinstance(s.fit.family, OpenUnit | OpenCabinet)]
    if not opened:
        return None
    model = max(opened, key=lambda s: float(s.fit.params[7]))
    other = partner if model is solid else solid
    family, params = model.fit.family, model.fit.params
    held = tuple(name for name in family.names if name not in ("open", "angle"))
    options = []
    for share in (0.0, 0.15, 0.4, 0.7, 1.0):
        start = params.copy()
        start[7] = share * params[7]
        options.append(
            judge(family, other.observation,
                  fit_shape(family, other.observation, start, fixed=held))
        )  # fmt: skip
    closed = min(options, key=lambda fit: fit.score)
    kind = "slide" if isinstance(family, OpenUnit) else "hinge"
    values = (float(params[7]), float(closed.params[7]))
    if model is partner:
        values = (values[1], values[0])
    if abs(values[0] - values[1]) < MOVED[kind]:
        return None
    here = params.copy()
    here[7] = values[0]
    axis, anchor = joint_axis(model)
    fit = judge(family, solid.observation, here)
    extra = _spec(family.spec(here), kind, max(values))
    joint = Joint(solid.name, kind, axis, anchor, values)
    return replace(solid, fit=fit, extra=extra), joint


def joint_axis(solid: Solid) -> tuple[Array, Array]:
    """Axis and a point on it of an open part, base frame."""
    family, params = solid.fit.family, solid.fit.params
    if isinstance(family, OpenCabinet):
        local = np.array([params[4] / 2 - 0.019, family.side * params[5] / 2])
        spot = params[:2] + rotate(local[None], params[3])[0]
        return np.array([0.0, 0.0, family.side]), np.array([*spot, params[2]])
    return np.array([np.cos(params[3]), np.sin(params[3]), 0.0]), solid.center


def _spec(spec: dict[str, Any], kind: str, most: float) -> dict[str, Any]:
    """The scene keys with the limit that was seen."""
    if kind == "hinge":
        spec["door"]["range_deg"] = max(float(np.degrees(most)), spec["door"]["open_deg"], 2.0)
        return spec
    for drawer in spec["drawers"]:
        if drawer["travel"] > 0:
            drawer["travel"] = max(most, drawer["open"]) + EXTRA_TRAVEL
    return spec

"""Things that rest in the mouth of a cup: vessel and content are fitted together.

A ball that is wider than the opening touches the rim all around, so its centre lies on the cup's
axis at a height that follows from both sizes. Each one's silhouette then helps the other.
"""

from __future__ import annotations

from collections.abc import Set
from dataclasses import replace

import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Array, Mask
from etot_cli.reconstruction.fit.lip import rim_height
from etot_cli.reconstruction.fit.observation import SEAM, Observation
from etot_cli.reconstruction.fit.pose import (
    fit_shape,
    judge,
    residuals_beside,
    residuals_of,
)
from etot_cli.reconstruction.fit.solver import minimize
from etot_cli.reconstruction.masks.labels import grown
from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.shapes.ball import Ball
from etot_cli.reconstruction.shapes.upright import TYPICAL_FLOOR, TYPICAL_WALL, Cup, Cylinder

WALL_PRIOR = (TYPICAL_WALL, 0.001)
"""Mean and standard deviation of a wall that is not seen [m]."""
WALLS = (0.001, 0.009)
"""Walls from which the fit of a covered cup starts [m]."""
SUNK = 0.25
"""What reaches less deep than to this share of a cup's height hangs in its mouth."""
UNROUND = 0.004
"""How far a thing that is no perfect ball may rest from where one would [m]."""
ON_FLOOR = 0.0007
"""How far from the floor what stands on it may be found [m]."""
ABOUT = 0.015
"""A ball is seen to rest somewhere to this [m]."""
LIP_SIGMA = 0.0007
"""How exactly the rim's edge shows in colour [m]."""
TOO_SMALL = 0.0005
"""A ball in the mouth is at most this much smaller than the opening [m]."""


def resting_height(cup: Array, diameter: float, *, rim: bool) -> float:
    """Height of the lowest point of a ball in a cup [m]: in its mouth, or on its floor."""
    opening, radius = cup[3] / 2 - cup[5], diameter / 2
    if not rim:
        return float(cup[2] + cup[6])
    return float(cup[2] + cup[4] + np.sqrt(max(radius**2 - opening**2, 0.0)) - radius)


def disagreement(solids: list[Solid], sigmas: dict[str, float] | None = None) -> float:
    """How badly solids explain what is seen of them: sum of squares in standard deviations.

    What is usual where nothing is seen does not count; how far a ball in a mouth is from where it
    would rest does.

    Args:
        solids: among them what they rest on.
        sigmas: how far depth is trusted, by name [m]; as in each solid's fit when None.
    """
    found = {solid.name: solid for solid in solids}
    total = 0.0
    for solid in solids:
        family, params, seen = solid.fit.family, solid.fit.params, solid.observation
        if sigmas is not None:
            seen = replace(seen, depth_sigma=sigmas[solid.name])
        residuals, unseen = residuals_of(family, seen, params), family.prior(params)
        total += float(residuals @ residuals - unseen @ unseen)
        vessel = found.get(solid.support)
        if vessel is None or vessel.kind != "cup" or not isinstance(family, Ball):
            continue
        rim = solid.relation == "rim"
        height = resting_height(vessel.fit.params, float(params[3]), rim=rim)
        total += float((params[2] - height) / (UNROUND if rim else ON_FLOOR)) ** 2
    return total


def settle_on_rim(
    seen: Calibrated, solids: list[Solid], settled: Set[str] = frozenset()
) -> list[Solid]:
    """Fits every ball that was found in or on a cup together with its cup.

    A cylinder whose top a ball covers may be a cup: it stays a cylinder where the ball on top of
    it agrees better with the picture than one in a mouth. Pairs of those that are named in
    ``settled`` stay as they are.
    """
    found = {solid.name: solid for solid in solids}
    for solid in solids:
        vessel = found.get(solid.support)
        if vessel is None or not isinstance(vessel.fit.family, Cylinder):
            continue
        if not isinstance(solid.fit.family, Ball) or {solid.name, vessel.name} <= settled:
            continue
        pair = _in_the_mouth(seen, as_cup(vessel), solid)
        if vessel.kind == "cylinder" and disagreement([vessel, solid]) <= disagreement([*pair]):
            continue
        found[vessel.name], found[solid.name] = pair
    return [found[solid.name] for solid in solids]


def _in_the_mouth(seen: Calibrated, vessel: Solid, solid: Solid) -> tuple[Solid, Solid]:
    """A cup and the ball that rests on its rim or its floor, whichever agrees better."""
    solid = replace(solid, observation=_clear_of(solid.observation, vessel.segment.mask))
    # As high as it is seen, whatever it rests on: the rule for that needs a start near the truth.
    ball = fit_shape(solid.fit.family, solid.observation, solid.fit.params, free_z=True)
    solid = replace(solid, fit=replace(solid.fit, params=ball))
    cup, before = _opened_for(vessel.fit.params, ball), None
    places = [rim for rim in (True, False) if _may_rest(cup, ball, rim=rim)] or [True, False]
    for _ in range(2):  # the rim is looked for with the width that the fit with it finds
        vessel = replace(vessel, fit=replace(vessel.fit, params=cup))
        tall = rim_height(seen, vessel.segment.mask, cup)
        if before is not None and tall is not None and abs(tall - before) < LIP_SIGMA:
            break
        options = [_together(vessel, solid, tall, rim=rim) for rim in places]
        _, cup, ball = min(options, key=lambda option: option[0])
        before = tall
    rim = bool(ball[2] - cup[2] > cup[6] + SUNK * cup[4])
    settled = replace(vessel, fit=judge(vessel.fit.family, vessel.observation, cup))
    return (
        settled.warned("its mouth is covered: wall and floor are from rule, not from data"),
        replace(
            solid,
            fit=judge(solid.fit.family, solid.observation, ball),
            relation="rim" if rim else "inside",
        ),
    )


def _opened_for(cup: Array, ball: Array) -> Array:
    """The cup's parameters with a wall of the thickness at which the ball would rest as seen."""
    radius = float(ball[3]) / 2
    above = float(ball[2]) + radius - float(cup[2] + cup[4])
    opened = cup.copy()
    if 0.0 < above < radius:
        wall = float(cup[3]) / 2 - float(np.sqrt(radius**2 - above**2))
        opened[5] = np.clip(wall, *WALLS)
    return opened


def _may_rest(cup: Array, ball: Array, *, rim: bool) -> bool:
    """Whether a ball is seen about where it would rest in a cup."""
    return abs(float(ball[2]) - resting_height(cup, float(ball[3]), rim=rim)) < ABOUT


def _clear_of(seen: Observation, mask: Mask) -> Observation:
    """Without the edge along a vessel: there the near rim may hide a part of what lies in it."""
    if not len(seen.edges):
        return seen
    near = grown(mask, SEAM)
    u, v = (np.round(seen.edges[:, index]).astype(int) for index in (0, 1))
    return replace(seen, edges=seen.edges[~near[v, u]])


def as_cup(vessel: Solid) -> Solid:
    """A vessel as a cup; a cylinder becomes one of the usual wall and floor."""
    if isinstance(vessel.fit.family, Cup):
        return vessel
    assert isinstance(vessel.fit.family, Cylinder)  # only round things have rims
    params = np.array([*vessel.fit.params[:5], TYPICAL_WALL, TYPICAL_FLOOR])
    return replace(vessel, fit=replace(vessel.fit, family=Cup(), params=params))


def _together(
    vessel: Solid, ball: Solid, tall: float | None, *, rim: bool
) -> tuple[float, Array, Array]:
    """Cost and parameters of cup and ball under the rule where the ball rests.

    ``tall`` is the cup's height as far as it is seen otherwise [m].
    """
    cup_start, ball_start = vessel.fit.params, ball.fit.params

    def split(values: Array) -> tuple[Array, Array]:
        cup = cup_start.copy()
        cup[[0, 1, 3, 4, 5]] = values[[0, 1, 2, 3, 5]]
        place = values[:2] if rim else values[7:9]
        return cup, np.array(
            [*place, resting_height(cup, values[4], rim=rim) + values[6], values[4]]
        )

    def rules(values: Array, cup: Array, content: Array) -> list[float]:
        room = cup[3] / 2 - cup[5] - content[3] / 2
        off_axis = float(np.hypot(*(content[:2] - cup[:2])))
        broken = max(room, 0.0) if rim else max(off_axis - room, 0.0)
        broken_by = [
            (values[5] - WALL_PRIOR[0]) / WALL_PRIOR[1],
            30 * broken / TOO_SMALL,
            values[6] / (UNROUND if rim else ON_FLOOR),
        ]
        if tall is not None:
            broken_by.append((values[3] - tall) / LIP_SIGMA)
        return broken_by

    def residuals(values: Array) -> Array:
        cup, content = split(values)
        return np.concatenate(
            [
                residuals_of(vessel.fit.family, vessel.observation, cup),
                residuals_of(ball.fit.family, ball.observation, content),
                rules(values, cup, content),
            ]
        )

    def beside(values: Array, others: Array) -> Array:
        cup, content = split(values)
        cups, contents = zip(*(split(other) for other in others), strict=True)
        return np.concatenate(
            [
                residuals_beside(vessel.fit.family, vessel.observation, cup, cups),
                residuals_beside(ball.fit.family, ball.observation, content, contents),
                list(map(rules, others, cups, contents)),
            ],
            axis=1,
        )

    if tall is not None:
        cup_start = cup_start.copy()
        cup_start[4] = tall
    start = [*cup_start[:2], cup_start[3], cup_start[4], ball_start[3], cup_start[5], 0.0]
    if not rim:
        start += list(ball_start[:2])
    begin = np.array(start)
    solution = minimize(residuals, begin, scale=np.full(len(begin), 0.02), steps=60, beside=beside)
    return solution.cost, *split(solution.x)

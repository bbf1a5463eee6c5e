"""Known things that one of the scene's kinds describes: of fixed size, at a fitted pose."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations
from typing import Any

import numpy as np

from etot_cli.reconstruction.capture.view import Array
from etot_cli.reconstruction.fit.pose import COARSE, Fit, fit_shape, judge
from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.shapes.ball import Ball
from etot_cli.reconstruction.shapes.base import Family
from etot_cli.reconstruction.shapes.block import Block
from etot_cli.reconstruction.shapes.furniture import OpenCabinet, OpenUnit
from etot_cli.reconstruction.shapes.rod import Capsule, Pen
from etot_cli.reconstruction.shapes.upright import ConicalCup, Cup, Cylinder
from etot_cli.specs import objects as specs

HEADINGS = 8
"""Turns that are tried, 45° apart; a fit finds the rest."""
STEPS = 25
"""Of the fit that only tells headings apart."""
ALIKE = 0.1
"""Scores that differ by less are alike."""
SCALED_BY_FILE = ("file", "scale")
"""Keys of a library's mesh that the mesh written for the twin replaces."""
NOT_SHAPE = ("kind", "at", "on", "inside", "yaw_deg", "quaternion")
"""Keys of a scene object that a library does not hand on."""
BARELY = 0.01
"""A drawer that is open by less counts as closed [m]; a door, by as many radians."""


def extra_keys(spec: specs.SceneObject) -> dict[str, Any]:
    """What a library says about a thing besides shape and pose: mass, friction, colour, …"""
    data = spec.model_dump(mode="json", exclude_unset=True)
    shape = {*NOT_SHAPE, "size", "diameter", "height", "length", "drawers", "door"}
    return {key: value for key, value in data.items() if key not in shape}


def fit_known_kind(solid: Solid, spec: specs.SceneObject) -> Solid:
    """The solid as a thing of known size.

    Args:
        solid: what was found.
        spec: the known thing, any kind but meshes, shelves and MJCF models.
    """
    coarse = solid.observation.thinned(*COARSE, 0)
    fits: list[tuple[Fit, tuple[str, ...]]] = []
    for family, sizes in _shapes(spec):
        held = tuple(name for name in sizes if name not in ("open", "angle"))
        for start in _starts(family, sizes, solid):
            params = fit_shape(family, coarse, start, fixed=held, steps=STEPS)
            fits.append((judge(family, coarse, params), held))
    # Of headings that fit alike, the one nearest to what was found: a front is seen to some extent.
    best, held = min(fits, key=lambda item: round(item[0].score / ALIKE))
    params = fit_shape(best.family, solid.observation, best.params, fixed=held)
    fit = judge(best.family, solid.observation, params)
    known = replace(solid, fit=fit, extra=_scene_keys(spec, fit), warnings=())
    if isinstance(best.family, Block) and not isinstance(spec, specs.Box):
        return known.warned("it is closed: which side is its front is a guess")
    return known


def _shapes(spec: specs.SceneObject) -> list[tuple[Family, dict[str, float]]]:
    """Families that a known thing may look like, with the sizes by parameter name."""
    found: list[tuple[Family, dict[str, float]]] = []
    if isinstance(spec, specs.Sphere):
        found = [(Ball(), {"diameter": spec.diameter})]
    elif isinstance(spec, specs.Cylinder):
        found = [(Cylinder(), {"diameter": spec.diameter, "height": spec.height})]
    elif isinstance(spec, specs.Pen):
        sizes = {"length": spec.length, "diameter": spec.diameter, "tip": spec.tip_length}
        found = [(Pen(), sizes)]
    elif isinstance(spec, specs.Capsule):
        found = [(Capsule(), {"length": spec.length, "diameter": spec.diameter})]
    elif isinstance(spec, specs.Cup):
        sizes = {"diameter": spec.diameter, "height": spec.height, "wall": spec.wall,
                 "floor": spec.floor}  # fmt: skip
        conical = spec.foot_diameter is not None
        found = [(ConicalCup(), {**sizes, "foot": spec.foot_diameter or 0.0})]
        found = found if conical else [(Cup(), sizes)]
    elif isinstance(spec, specs.Box):
        # A box may lie on any of its sides.
        found = [(Block(), _sides(size)) for size in permutations(spec.size)]
    elif isinstance(spec, specs.DrawerUnit):
        found = [(Block(), _sides(spec.size))]
        found += [
            (OpenUnit(len(spec.drawers), index), {**_sides(spec.size), "open": drawer.travel / 2})
            for index, drawer in enumerate(spec.drawers) if drawer.travel > 0
        ]  # fmt: skip
    elif isinstance(spec, specs.Cabinet):
        found = [(Block(), _sides(spec.size)),
                 (OpenCabinet(spec.door.hinge), {**_sides(spec.size), "angle": 0.6})]  # fmt: skip
    return found


def _sides(size: tuple[float, ...]) -> dict[str, float]:
    return dict(zip(("length", "width", "height"), size, strict=True))


def _starts(family: Family, sizes: dict[str, float], solid: Solid) -> list[Array]:
    place = {"x": solid.center[0], "y": solid.center[1], "z": solid.observation.base, **sizes}
    turns = HEADINGS if "yaw" in family.names else 1
    return [
        np.array([
            solid.yaw + 2 * np.pi * turn / turns if name == "yaw" else float(place[name])
            for name in family.names
        ])
        for turn in range(turns)
    ]  # fmt: skip


def _scene_keys(spec: specs.SceneObject, fit: Fit) -> dict[str, Any]:
    """The scene keys that the library's kind has beyond those of the fitted family."""
    extra: dict[str, Any] = {"kind": spec.kind}
    family, params = fit.family, fit.params
    if isinstance(spec, specs.DrawerUnit):
        drawers = [drawer.model_dump(exclude_unset=True) for drawer in spec.drawers]
        for index, drawer in enumerate(drawers):
            moving = isinstance(family, OpenUnit) and family.moving == index
            opened = float(params[7]) if moving else 0.0
            travel = spec.drawers[index].travel
            drawer["open"] = min(max(opened, 0.0), travel) if opened > BARELY else 0.0
        extra.update(size=list(spec.size), drawers=drawers)
    elif isinstance(spec, specs.Cabinet):
        door = spec.door.model_dump(exclude_unset=True)
        angle = float(params[7]) if isinstance(family, OpenCabinet) else 0.0
        opened = float(np.degrees(angle)) if angle > BARELY else 0.0
        door["open_deg"] = min(max(opened, 0.0), spec.door.range_deg)
        extra.update(size=list(spec.size), door=door)
    elif isinstance(spec, specs.Box):
        extra["size"] = [float(params[4]), float(params[5]), float(params[6])]
    return extra

"""Cups and bowls: a floor disc, a ring of convex wall staves, and a smooth shell to look at."""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np

from etot_cli.specs import objects as specs
from etot_cli.world.build.material import Look, add_geom, add_visual
from etot_cli.world.index import Region
from etot_cli.world.surface import SEEN_GROUPS

STAVES = 24
"""Wall pieces around; enough that a ball on the rim sees a round mouth."""
FOOT_LIFT = 0.0006
"""The staves end this far above the foot's face [m], so that only the disc touches the desk:
staves on the desk cost four times the stepping time and change how a cup tips."""
_VISUAL_SIDES = 2 * STAVES
"""Of what is drawn, which costs no stepping."""


def add_cup(mj: mujoco.MjSpec, body: Any, spec: specs.Cup, look: Look, name: str) -> None:
    """A hollow cup whose frame is at mid height, the opening towards +z."""
    rim = spec.diameter / 2
    foot = (spec.foot_diameter or spec.diameter) / 2
    half = spec.height / 2
    floor_volume = math.pi * foot**2 * spec.floor
    wall_volume = math.pi * (rim + foot) * spec.wall * (spec.height - FOOT_LIFT)
    share = floor_volume / (floor_volume + wall_volume)
    floor_mass = None if spec.mass is None else spec.mass * share
    stave_mass = None if spec.mass is None else spec.mass * (1 - share) / STAVES
    add_geom(
        body,
        look.with_mass(floor_mass),
        mujoco.mjtGeom.mjGEOM_CYLINDER,
        [foot - 0.0005, spec.floor / 2, 0],
        pos=[0, 0, -half + spec.floor / 2],
    )
    for index in range(STAVES):
        vertices = _stave(index, rim, foot, spec.wall, -half + FOOT_LIFT, half)
        mesh = mj.add_mesh(name=f"{name}/stave{index}")
        mesh.uservert = vertices.ravel().tolist()
        geom = add_geom(
            body, look.with_mass(stave_mass), mujoco.mjtGeom.mjGEOM_MESH, [0, 0, 0],
            mesh=f"{name}/stave{index}",
        )  # fmt: skip
        geom.group = SEEN_GROUPS
    _add_shell(mj, body, spec, look, name, rim, foot)


def _stave(
    index: int, rim: float, foot: float, wall: float, bottom: float, top: float
) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Corners (8, 3) of one wall piece; the outer faces' mid lines lie on the true radius."""
    half_angle = math.pi / STAVES
    middle = 2 * math.pi * index / STAVES
    # Between circumscribed and inscribed, so that mean radius and opening stay true.
    outer_scale = 2 / (1 + math.cos(half_angle))
    corners = []
    for radius, height in ((foot, bottom), (rim, top)):
        for depth in (0.0, wall):
            for side in (-1, 1):
                angle = middle + side * half_angle
                r = (radius - depth) * outer_scale
                corners.append([r * math.cos(angle), r * math.sin(angle), height])
    return np.array(corners)


def _add_shell(
    mj: mujoco.MjSpec, body: Any, spec: specs.Cup, look: Look, name: str, rim: float, foot: float
) -> None:
    """A smooth lathe surface for pictures."""
    half, wall, floor = spec.height / 2, spec.wall, spec.floor
    inner_foot = foot - wall
    profile = [
        (0.0, -half), (foot, -half), (rim, half), (rim - wall, half),
        (inner_foot + (rim - foot) * floor / spec.height, -half + floor), (0.0, -half + floor),
    ]  # fmt: skip
    angles = np.linspace(0, 2 * math.pi, _VISUAL_SIDES, endpoint=False)
    vertices: list[float] = []
    for radius, height in profile:
        for angle in angles:
            vertices += [radius * math.cos(angle), radius * math.sin(angle), height]
    faces: list[int] = []
    sides, last = _VISUAL_SIDES, len(profile) - 2
    for ring in range(len(profile) - 1):
        for i in range(sides):
            a, b = ring * sides + i, ring * sides + (i + 1) % sides
            if ring > 0:
                faces += [a, b, (b + sides) if ring < last else (a + sides)]
            if ring < last:
                faces += [a, b + sides, a + sides]
    mesh = mj.add_mesh(name=f"{name}/shell")
    mesh.uservert = vertices
    mesh.userface = faces
    mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
    mesh.smoothnormal = 0
    add_visual(body, look.rgba, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=f"{name}/shell")


def cup_region(spec: specs.Cup, name: str) -> Region:
    """The inside of a cup, in the cup's frame."""
    foot = (spec.foot_diameter or spec.diameter) / 2
    radius = (spec.diameter / 2 + foot) / 2 - spec.wall
    depth = spec.height - spec.floor
    return Region(name, name, (0.0, 0.0, spec.floor / 2), (radius, radius, depth / 2), round=True)


def hollow_region(size: tuple[float, ...], name: str) -> Region:
    """The inside of a hollow mesh, taken as most of its bounding box."""
    half = (size[0] * 0.4, size[1] * 0.4, size[2] * 0.42)
    return Region(name, name, (0.0, 0.0, size[2] * 0.08), half)

"""Simple solid objects: sphere, box, cylinder, capsule and pointed rod."""

from __future__ import annotations

import math
from typing import Any

import mujoco

from etot_cli.specs import objects as specs
from etot_cli.world.build.material import Look, add_geom

DENSITY = 400.0
"""Mean density of small household things [kg/m³], used where a scene gives no mass."""


def add_sphere(body: Any, spec: specs.Sphere, look: Look) -> None:
    """A ball, with rolling friction (condim 6)."""
    add_geom(body, look, mujoco.mjtGeom.mjGEOM_SPHERE, [spec.diameter / 2, 0, 0], rolling=True)


def add_box(body: Any, spec: specs.Box, look: Look) -> None:
    """A solid box."""
    add_geom(body, look, mujoco.mjtGeom.mjGEOM_BOX, [side / 2 for side in spec.size])


def add_cylinder(body: Any, spec: specs.Cylinder, look: Look) -> None:
    """A solid upright cylinder."""
    size = [spec.diameter / 2, spec.height / 2, 0]
    add_geom(body, look, mujoco.mjtGeom.mjGEOM_CYLINDER, size, rolling=True)


def add_capsule(body: Any, spec: specs.Capsule, look: Look) -> None:
    """A capsule along x."""
    half = max((spec.length - spec.diameter) / 2, 1e-3)
    add_geom(
        body,
        look,
        mujoco.mjtGeom.mjGEOM_CAPSULE,
        [spec.diameter / 2, half, 0],
        quat=_Z_TO_X,
        rolling=True,
    )


def add_pen(mj: mujoco.MjSpec, body: Any, spec: specs.Pen, look: Look, name: str) -> None:
    """A rod along x whose point is at +x: a cylinder and a cone (convex mesh)."""
    radius, tip = spec.diameter / 2, spec.tip_length
    barrel = spec.length - tip
    volume = math.pi * radius**2 * (barrel + tip / 3)
    mass = spec.mass if spec.mass is not None else DENSITY * volume
    cone_mass = mass * (tip / 3) / (barrel + tip / 3)
    add_geom(
        body,
        look.with_mass(mass - cone_mass),
        mujoco.mjtGeom.mjGEOM_CYLINDER,
        [radius, barrel / 2, 0],
        pos=[-tip / 2, 0, 0],
        quat=_Z_TO_X,
        rolling=True,
    )
    ring = [
        [0.0, radius * math.cos(a), radius * math.sin(a)]
        for a in (2 * math.pi * i / _CONE_SIDES for i in range(_CONE_SIDES))
    ]
    blunt = [[tip, 0.001 * y / radius, 0.001 * z / radius] for _, y, z in ring]
    mesh = mj.add_mesh(name=f"{name}/tip")
    mesh.uservert = [value for vertex in ring + blunt for value in vertex]
    add_geom(
        body,
        look.with_mass(max(cone_mass, 1e-5)).darker(),
        mujoco.mjtGeom.mjGEOM_MESH,
        [0, 0, 0],
        pos=[barrel - spec.length / 2, 0, 0],
        mesh=f"{name}/tip",
    )


_CONE_SIDES = 12
"""Of a pen's point: round enough to slide off a rim."""
_Z_TO_X = [math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0]

"""Any object of a scene becomes a body: dispatch by kind, pose, and what is known of it."""

from __future__ import annotations

import math
from typing import Any

import mujoco

from etot_cli.errors import WorldError
from etot_cli.specs import objects as specs
from etot_cli.specs.objects import ROLLING_DEFAULT, is_fastened
from etot_cli.specs.placement import inner_diameter, size_of
from etot_cli.specs.scene import Scene
from etot_cli.world.build import furniture, meshes, mjcf, shapes, vessels
from etot_cli.world.build.material import Look
from etot_cli.world.colors import is_basic, nearest_basic, rgb
from etot_cli.world.index import ObjectEntry, Part, Region, Surface
from etot_cli.world.state import DESK, ObjectInfo

DEFAULT_COLOR = (0.62, 0.64, 0.66)
"""Where a scene gives no colour: a light grey, seen against wood and against shadow."""


def add_object(mj: mujoco.MjSpec, scene: Scene, name: str, spec: Any) -> ObjectEntry:
    """Adds an object to the model to be; returns what is known of it."""
    body = mj.worldbody.add_body(name=name)
    fixed = is_fastened(spec)
    if not fixed:
        body.add_freejoint(name=name)
    look = _look(spec)
    parts: tuple[Part, ...] = ()
    regions: tuple[Region, ...] = ()
    surfaces: tuple[Surface, ...] = ()
    axis = None
    # An attached file's is not known before it is compiled.
    size: tuple[float, ...] = size_of(spec) or (0.1, 0.1, 0.1)
    if isinstance(spec, specs.Sphere):
        shapes.add_sphere(body, spec, look)
    elif isinstance(spec, specs.Box):
        shapes.add_box(body, spec, look)
        length, width, height = spec.size
        surfaces = (Surface(name, name, (0, 0, height / 2), (length / 2, width / 2)),)
    elif isinstance(spec, specs.Cylinder):
        shapes.add_cylinder(body, spec, look)
        radius = spec.diameter / 2
        surfaces = (Surface(name, name, (0, 0, spec.height / 2), (radius, radius), round=True),)
    elif isinstance(spec, specs.Capsule):
        shapes.add_capsule(body, spec, look)
        axis = (1.0, 0.0, 0.0)
    elif isinstance(spec, specs.Pen):
        shapes.add_pen(mj, body, spec, look, name)
        axis = (1.0, 0.0, 0.0)
    elif isinstance(spec, specs.Cup):
        vessels.add_cup(mj, body, spec, look, name)
        regions = (vessels.cup_region(spec, name),)
    elif isinstance(spec, specs.DrawerUnit):
        parts, regions, surfaces = furniture.add_drawer_unit(body, spec, look, name)
    elif isinstance(spec, specs.Cabinet):
        parts, regions, surfaces = furniture.add_cabinet(body, spec, look, name)
    elif isinstance(spec, specs.Shelf):
        parts, regions, surfaces = furniture.add_shelf(body, spec, look, name)
    elif isinstance(spec, specs.Mesh):
        size = (*meshes.add_mesh(mj, body, spec, look, name, scene.directory),)
        if spec.hollow:
            regions = (vessels.hollow_region(size, name),)
    else:
        mjcf.attach_mjcf(mj, body, spec, name, scene.directory)
    if fixed:
        body.pos = _fixed_position(scene, name, spec, size)
        body.quat = list(resting_quaternion(spec))
    return entry_of(name, spec, parts, regions, surfaces, size, axis)


def _look(spec: Any) -> Look:
    rolling = ROLLING_DEFAULT if spec.rolling_friction is None else spec.rolling_friction
    color = rgb(spec.color) if spec.color is not None else DEFAULT_COLOR
    mass = (
        spec.mass
        if isinstance(spec, specs.Sphere | specs.Box | specs.Cylinder | specs.Capsule)
        else None
    )
    return Look((*color, 1.0), spec.friction, rolling, spec.slippery, mass, shapes.DENSITY)


def resting_quaternion(spec: Any) -> tuple[float, float, float, float]:
    """Orientation w x y z as the scene gives it."""
    if spec.quaternion is not None:
        norm = math.sqrt(sum(value * value for value in spec.quaternion))
        w, x, y, z = (value / norm for value in spec.quaternion)
        return w, x, y, z
    half = math.radians(spec.yaw_deg) / 2
    return math.cos(half), 0.0, 0.0, math.sin(half)


def _fixed_position(scene: Scene, name: str, spec: Any, size: tuple[float, ...]) -> list[float]:
    if spec.at is not None and len(spec.at) == 3:
        return list(spec.at)
    if spec.inside is not None or (spec.on is not None and spec.on != DESK):
        raise WorldError(
            f"{name} is fastened and stands on another object: give its centre as at: [x, y, z]"
        )
    base = scene.desk.top if isinstance(spec, specs.Mjcf) else scene.desk.top + size[2] / 2
    return [*spec.at, base]


def entry_of(
    name: str,
    spec: Any,
    parts: tuple[Part, ...],
    regions: tuple[Region, ...],
    surfaces: tuple[Surface, ...],
    size: tuple[float, ...],
    axis: tuple[float, float, float] | None = None,
) -> ObjectEntry:
    """What is known of an object, its mass excepted, which the compiled model tells."""
    fixed = is_fastened(spec)
    behind_parts = {part.info.address for part in parts if part.info.container}
    open_tops = [r.half[:2] for r in regions if r.address in {name} - behind_parts]
    boards = [surface.address.partition(".")[2] for surface in surfaces]
    info = ObjectInfo(
        name=name,
        kind=spec.kind,
        label=(spec.label or name.replace("_", " ")).lower(),
        color=nearest_basic(spec.color) if spec.color is not None else None,
        size=(float(size[0]), float(size[1]), float(size[2])),
        mass=0.0,
        movable=not fixed and not isinstance(spec, specs.FURNITURE),
        container=bool(open_tops),
        surface=bool(surfaces),
        elongated=axis is not None and size[0] > 3 * size[1],
        parts=tuple(part.info for part in parts),
        boards=tuple(board for board in boards if board),
        mouth=(
            inner_diameter(spec)
            if isinstance(spec, specs.Cup)  # a conical one is wider above than inside
            else min((2 * min(half) for half in open_tops), default=0.0)
        ),
        foot=(spec.foot_diameter or 0.0) if isinstance(spec, specs.Cup) else 0.0,
        plain_color=spec.color is None or is_basic(spec.color),
    )
    upright = not isinstance(spec, specs.Sphere | specs.Pen | specs.Capsule)
    return ObjectEntry(info, name, not fixed, parts, regions, surfaces, upright, axis)

"""Parts, containers and surfaces of objects that are given as MJCF files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np

from etot_cli.errors import WorldError
from etot_cli.specs import objects as specs
from etot_cli.world.arrays import Vector
from etot_cli.world.index import Face, Graspable, Part, Region, Surface
from etot_cli.world.state import PartInfo, triple

BOX: Mapping[mujoco.mjtGeom, str] = {mujoco.mjtGeom.mjGEOM_BOX: "box"}
HOLLOWS: Mapping[mujoco.mjtGeom, str] = {**BOX, mujoco.mjtGeom.mjGEOM_CYLINDER: "cylinder"}
UPRIGHT_HINGE = 0.7
"""Hinges that stand at least this upright (cosine) are those of doors."""


def mjcf_parts(
    model: mujoco.MjModel, spec: specs.Mjcf, name: str
) -> tuple[tuple[Part, ...], tuple[Region, ...], tuple[Surface, ...]]:
    """Reads parts, containers and surfaces of an attached MJCF object from the compiled model."""
    parts: list[Part] = []
    regions: list[Region] = []
    surfaces: list[Surface] = []
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    for part_name, part in spec.parts.items():
        joint = model.joint(f"{name}/{part.joint}")
        _check_part(model, name, part_name, part)
        body = model.body(int(joint.bodyid[0])).name
        kind = "slide" if joint.type[0] == mujoco.mjtJoint.mjJNT_SLIDE else "hinge"
        lower, upper = (float(value) for value in joint.range)
        # The opening direction is away from whichever limit is nearer to zero.
        closed, opened = (lower, upper) if abs(lower) <= abs(upper) else (upper, lower)
        address = name if len(spec.parts) == 1 else f"{name}.{part_name}"
        outer, inner, back = _faces(model, name, part, joint, body)
        opening = _side_opening(data, name, part, joint, body, outer)
        info = PartInfo(
            name, part_name, address, kind, abs(opened - closed),
            part.container_site is not None, front=opening is not None,
        )  # fmt: skip
        grasps = _grasps(model, f"{name}/{part.front_site}", outer) if part.front_site else ()
        joint_name = f"{name}/{part.joint}"
        parts.append(Part(info, body, joint_name, closed, opened, outer, inner, grasps, back))
        if part.container_site:
            region = _region(model, f"{name}/{part.container_site}", address)
            regions.append(region if opening is None else replace(region, opening=opening))
    if spec.container_site:
        _check_site(model, name, "container_site", spec.container_site, HOLLOWS)
        regions.append(_region(model, f"{name}/{spec.container_site}", name))
    if spec.surface_site:
        _check_site(model, name, "surface_site", spec.surface_site, BOX)
        site = model.site(f"{name}/{spec.surface_site}")
        center = tuple(site.pos + np.array([0, 0, site.size[2]]))
        surfaces.append(
            Surface(name, model.body(int(site.bodyid[0])).name, center,
                    (float(site.size[0]), float(site.size[1])))
        )  # fmt: skip
    return tuple(parts), tuple(regions), tuple(surfaces)


def _check_part(model: mujoco.MjModel, name: str, part_name: str, part: specs.MjcfPart) -> None:
    """Sees to it that a part is something that opens, and its sites are where they have to be.

    Raises:
        WorldError: it is not.
    """
    where = f"{name}.parts.{part_name}"
    joint = model.joint(f"{name}/{part.joint}")
    kind = mujoco.mjtJoint(int(joint.type[0]))
    if kind not in (mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE):
        raise WorldError(
            f"{where}.joint: {part.joint!r} is a {kind.name.removeprefix('mjJNT_').lower()} joint; "
            "expected a slide or a hinge"
        )
    lower, upper = joint.range
    if not model.jnt_limited[joint.id] or not lower < upper:
        raise WorldError(
            f"{where}.joint: {part.joint!r} has no range, so how far it opens is not known; "
            'expected one in the file, as in range="0 1.6"'
        )
    if part.container_site:
        _check_site(model, where, "container_site", part.container_site, BOX, name)
    if part.front_site:
        _check_site(model, where, "front_site", part.front_site, BOX, name)
        site = model.site(f"{name}/{part.front_site}")
        if int(site.bodyid[0]) != int(joint.bodyid[0]):
            found, expected = (
                model.body(int(item.bodyid[0])).name.partition("/")[2] for item in (site, joint)
            )
            raise WorldError(
                f"{where}.front_site: {part.front_site!r} is on the body {found!r}; expected it on "
                f"{expected!r}, which {part.joint!r} moves"
            )


def _check_site(
    model: mujoco.MjModel,
    where: str,
    key: str,
    site: str,
    expected: Mapping[mujoco.mjtGeom, str],
    owner: str | None = None,
) -> None:
    """Sees to it that a site has a shape that can be read."""
    found = mujoco.mjtGeom(int(model.site(f"{owner or where}/{site}").type[0]))
    if found not in expected:
        raise WorldError(
            f"{where}.{key}: {site!r} is a {found.name.removeprefix('mjGEOM_').lower()}; expected "
            f"a {' or a '.join(expected.values())}"
        )


def _side_opening(
    data: mujoco.MjData, name: str, part: specs.MjcfPart, joint: Any, body: str, outer: Face
) -> tuple[float, float, float] | None:
    """Where a container behind a door is open to, in its own frame; None where it is from above.

    A door on an upright hinge closes a side, one on a level hinge is a lid. Poses are those of the
    model's own, closed state.
    """
    if part.container_site is None or int(joint.type[0]) != mujoco.mjtJoint.mjJNT_HINGE:
        return None
    door = data.body(body).xmat.reshape(3, 3)
    if abs(float((door @ np.array(joint.axis))[2])) < UPRIGHT_HINGE:
        return None
    site = data.model.site(f"{name}/{part.container_site}")
    holder = data.body(int(site.bodyid[0])).xmat.reshape(3, 3)
    return triple(np.round(holder.T @ door @ np.array(outer.normal), 9))


def _region(model: mujoco.MjModel, site_name: str, address: str) -> Region:
    site = model.site(site_name)
    is_round = int(site.type[0]) == mujoco.mjtGeom.mjGEOM_CYLINDER
    x, y, z = (float(value) for value in site.size)
    half = (x, x, y) if is_round else (x, y, z)
    body = model.body(int(site.bodyid[0])).name
    return Region(address, body, tuple(site.pos), half, is_round)


BAR_FLATNESS = 2.0
"""What is broader than so many times its thickness is a panel, not a bar that the hand may come to
from all round."""


def _grasps(model: mujoco.MjModel, site_name: str, outer: Face) -> tuple[Graspable, ...]:
    """Ways to close the gripper on a part's ``front_site``, the thinnest side first.

    Along the face the hand comes from the front; across it, from any side. Whether the fingers
    find room behind it is for the collision checks to say.
    """
    site = model.site(site_name)
    center, half = np.array(site.pos), np.array(site.size)
    normal = np.array(outer.normal)
    slim, broad, _ = np.sort(half)
    grasps = []
    for index in np.argsort(half, kind="stable"):
        closing = np.eye(3)[index]
        if abs(closing @ normal) > 0.5:
            others = [i for i in range(3) if i != index]
            approaches = [-sign * np.eye(3)[i] for i in reversed(others) for sign in (1.0, -1.0)]
        else:
            approaches = [-normal]
        along = np.cross(closing, approaches[0])
        grasps.append(
            Graspable(
                triple(center), triple(closing), triple(along),
                float(np.abs(along) @ half), float(2 * half[index]),
                tuple(triple(item) for item in approaches),
                bar=bool(broad < BAR_FLATNESS * slim),
            )
        )  # fmt: skip
    return tuple(grasps)


def _faces(
    model: mujoco.MjModel, name: str, part: specs.MjcfPart, joint: Any, body: str
) -> tuple[Face, Face, Face | None]:
    """Front and back faces of a part: of its ``front_site``, else of its outermost box of geoms;
    and the whole back of a door or lid with a ``front_site``.
    """
    axis = np.array(joint.axis)
    slide = int(joint.type[0]) == mujoco.mjtJoint.mjJNT_SLIDE
    panel = _bounds(model, body)
    front = panel
    if part.front_site:
        site = model.site(f"{name}/{part.front_site}")
        front = (np.array(site.pos), np.array(site.size))
    if slide:
        normal = axis * np.sign(joint.range[1] + joint.range[0] or 1.0)
    else:
        lever = front[0] - np.array(joint.pos)
        normal = np.cross(axis, lever - axis * (axis @ lever))
        if np.linalg.norm(normal) < 1e-6:
            raise WorldError(
                f"{name}: the hinge {part.joint!r} passes through the middle of what it moves, so "
                "which way that opens is not known; give the part a 'front_site' beside the hinge"
            )
        normal *= np.sign(joint.range[1] + joint.range[0] or 1.0) / np.linalg.norm(normal)
    k = int(np.argmax(np.abs(normal)))
    direction = np.eye(3)[k] * np.sign(normal[k])
    outer = _face(*front, k, direction)
    inner = _face(*front, k, -direction)
    return outer, inner, None if slide or not part.front_site else _face(*panel, k, -direction)


def _bounds(model: mujoco.MjModel, body: str) -> tuple[Vector, Vector]:
    """Middle and half extents (3,) of the box around a body's geoms, in its frame [m]."""
    boxes = [
        (np.array(model.geom(i).pos), model.geom_aabb[i])
        for i in range(model.ngeom)
        if model.body(int(model.geom_bodyid[i])).name == body
    ]
    low = np.min([pos + box[:3] - box[3:] for pos, box in boxes], axis=0)
    high = np.max([pos + box[:3] + box[3:] for pos, box in boxes], axis=0)
    return (low + high) / 2, (high - low) / 2


def _face(center: Vector, half: Vector, k: int, direction: Vector) -> Face:
    """The side of a box that looks along its axis ``k``, in a direction."""
    u, v = (np.eye(3)[i] * half[i] for i in range(3) if i != k)
    middle = center + direction * half[k]
    return Face(triple(middle), triple(direction), triple(u), triple(v))

"""Files of a twin besides its scene: meshes with colours, and MJCF for MuJoCo's viewer."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.shapes.free import FreeForm
from etot_cli.specs.scene import Scene
from etot_cli.world.model import World
from etot_cli.world.placing import world_at_start
from etot_cli.world.surface import SEEN_GROUPS, mesh_of, triangles

GEOM_NAMES = {
    mujoco.mjtGeom.mjGEOM_SPHERE: "sphere",
    mujoco.mjtGeom.mjGEOM_CAPSULE: "capsule",
    mujoco.mjtGeom.mjGEOM_CYLINDER: "cylinder",
    mujoco.mjtGeom.mjGEOM_BOX: "box",
    mujoco.mjtGeom.mjGEOM_MESH: "mesh",
}


def free_form_mesh(solid: Solid, color: tuple[float, float, float]) -> Any:
    """A free-form object's mesh in metres, own frame, with vertex colours (trimesh)."""
    import trimesh

    family = solid.fit.family
    assert isinstance(family, FreeForm)  # asked by the caller
    mesh = trimesh.Trimesh(family.placed(solid.fit.params), family.faces, process=False)
    return _painted(mesh, color)


def object_mesh(world: World, data: mujoco.MjData, name: str, color: Any) -> Any:
    """The visible surface of an object in its own frame, with vertex colours (trimesh)."""
    import trimesh

    model, root = world.model, data.body(world.entries[name].body)
    parts = []
    shell = any(
        owner == name and model.geom_group[i] == 2 for i, owner in enumerate(world.geom_object)
    )
    for geom, owner in enumerate(world.geom_object):
        if owner != name or (shell and model.geom_group[geom] == SEEN_GROUPS):
            continue
        surface = triangles(model, geom)
        if surface is None:
            continue
        mesh: Any = trimesh.Trimesh(*surface, process=False)
        pose = np.eye(4)
        rotation = root.xmat.reshape(3, 3)
        pose[:3, :3] = rotation.T @ data.geom_xmat[geom].reshape(3, 3)
        pose[:3, 3] = rotation.T @ (data.geom_xpos[geom] - root.xpos)
        mesh.apply_transform(pose)
        parts.append(mesh)
    return _painted(trimesh.util.concatenate(parts), color)


def placed_triangles(scene: Scene) -> dict[str, NDArray[np.float64]]:
    """By object, the corners (3 t, 3) of its visible surface's t triangles, base frame [m].

    Raises:
        WorldError: the scene cannot be built.
    """
    world, data = world_at_start(scene)
    mujoco.mj_kinematics(world.model, data)
    found = {}
    for name, entry in world.entries.items():
        mesh, root = object_mesh(world, data, name, (0.0, 0.0, 0.0)), data.body(entry.body)
        placed = np.asarray(mesh.vertices) @ root.xmat.reshape(3, 3).T + root.xpos
        found[name] = placed[np.asarray(mesh.faces)].reshape(-1, 3)
    return found


def _painted(mesh: Any, color: tuple[float, float, float]) -> Any:
    paint = [*(round(255 * channel) for channel in color), 255]
    mesh.visual.vertex_colors = np.tile(np.array(paint, np.uint8), (len(mesh.vertices), 1))
    return mesh


def export_twin(
    scene: Scene, colors: dict[str, tuple[float, float, float]], meshes: Path, mjcf: Path
) -> None:
    """Writes a GLB for every object named in ``colors``, and the MJCF of the whole.

    Raises:
        WorldError: the scene cannot be built.
    """
    world, data = world_at_start(scene)
    for name, color in colors.items():
        object_mesh(world, data, name, color).export(meshes / f"{name}.glb")
    write_mjcf(world, data, mjcf)


def write_mjcf(world: World, data: mujoco.MjData, path: Path) -> None:
    """Desk and objects as one MJCF file that stands alone (meshes are inside it)."""
    model = world.model
    kept = [g for g, owner in enumerate(world.geom_object)
            if owner in world.entries or owner == "desk"]  # fmt: skip
    meshes = sorted({int(model.geom_dataid[g]) for g in kept
                     if model.geom_type[g] == mujoco.mjtGeom.mjGEOM_MESH})  # fmt: skip
    lines = [
        "<mujoco>",
        f'  <option timestep="{model.opt.timestep}" integrator="implicitfast" cone="elliptic" '
        f'impratio="{model.opt.impratio:g}"/>',
        "  <asset>",
    ]
    for mesh in meshes:
        vertices, faces = mesh_of(model, mesh)
        lines.append(
            f'    <mesh name="mesh{mesh}" inertia="shell" vertex="{_text(vertices)}" '
            f'face="{_text(faces)}"/>'
        )
    lines += ["  </asset>", "  <worldbody>", '    <light pos="0.5 -0.5 2" dir="0 0.2 -1"/>']
    lines += [_geom(model, geom, "    ") for geom in kept if model.geom_bodyid[geom] == 0]
    for name, entry in world.entries.items():
        lines += _body(model, data, model.body(entry.body).id, set(kept), "    ", free=entry.free,
                       title=name)  # fmt: skip
    lines += ["  </worldbody>", "</mujoco>"]
    path.write_text("\n".join(lines) + "\n")


def _text(values: Any) -> str:
    return " ".join(f"{value:.6g}" for value in np.asarray(values).ravel())


def _body(
    model: mujoco.MjModel, data: mujoco.MjData, body: int, kept: set[int], indent: str, *,
    free: bool, title: str | None = None,
) -> list[str]:  # fmt: skip
    name = title or model.body(body).name
    position = data.xpos[body] if title else model.body_pos[body]
    quaternion = data.xquat[body] if title else model.body_quat[body]
    lines = [
        f'{indent}<body name={quoteattr(name)} pos="{_text(position)}" quat="{_text(quaternion)}">'
    ]
    inner = indent + "  "
    if free:
        lines.append(f"{inner}<freejoint/>")
    for joint in range(model.njnt):
        if model.jnt_bodyid[joint] != body or model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE:
            continue
        kind = "slide" if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_SLIDE else "hinge"
        low, high = model.jnt_range[joint]
        if kind == "hinge":
            low, high = np.degrees([low, high])
        dof = int(model.jnt_dofadr[joint])
        lines.append(
            f'{inner}<joint name={quoteattr(model.joint(joint).name)} type="{kind}" '
            f'axis="{_text(model.jnt_axis[joint])}" pos="{_text(model.jnt_pos[joint])}" '
            f'limited="true" range="{low:.6g} {high:.6g}" '
            f'frictionloss="{model.dof_frictionloss[dof]:.6g}" '
            f'damping="{model.dof_damping[dof].flat[0]:.6g}"/>'
        )
    lines.append(
        f'{inner}<inertial pos="{_text(model.body_ipos[body])}" '
        f'quat="{_text(model.body_iquat[body])}" mass="{max(model.body_mass[body], 1e-4):.6g}" '
        f'diaginertia="{_text(np.maximum(model.body_inertia[body], 1e-8))}"/>'
    )
    lines += [_geom(model, g, inner) for g in sorted(kept) if model.geom_bodyid[g] == body]
    for child in range(1, model.nbody):
        if model.body_parentid[child] == body:
            lines += _body(model, data, child, kept, inner, free=False)
    return [*lines, f"{indent}</body>"]


def _geom(model: mujoco.MjModel, geom: int, indent: str) -> str:
    kind = GEOM_NAMES[mujoco.mjtGeom(int(model.geom_type[geom]))]
    shape = f'size="{_text(model.geom_size[geom])}"'
    if kind == "mesh":
        shape = f'mesh="mesh{int(model.geom_dataid[geom])}"'
    return (
        f'{indent}<geom type="{kind}" {shape} pos="{_text(model.geom_pos[geom])}" '
        f'quat="{_text(model.geom_quat[geom])}" rgba="{_text(model.geom_rgba[geom])}" '
        f'friction="{_text(model.geom_friction[geom])}" condim="{int(model.geom_condim[geom])}" '
        f'contype="{int(model.geom_contype[geom])}" '
        f'conaffinity="{int(model.geom_conaffinity[geom])}" group="{int(model.geom_group[geom])}"/>'
    )

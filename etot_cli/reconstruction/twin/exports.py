"""Files of a twin besides its scene: meshes with colours, and MJCF for MuJoCo's viewer."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.shapes.free import FreeForm
from etot_cli.specs.scene import Scene
from etot_cli.world.export import scene_mjcf
from etot_cli.world.model import World
from etot_cli.world.placing import world_at_start
from etot_cli.world.surface import SEEN_GROUPS, triangles


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
    mjcf.write_text(scene_mjcf(scene), encoding="utf-8")

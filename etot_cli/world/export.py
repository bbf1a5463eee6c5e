"""A scene as other programs of MuJoCo read it: MJCF, alone or with its meshes in a zip file."""

from __future__ import annotations

import io

import mujoco

from etot_cli.specs.scene import Scene
from etot_cli.world.model import scene_spec
from etot_cli.world.placing import world_at_start


def scene_archive(scene: Scene) -> bytes:
    """The world of a scene with robot, desk and objects at their start (keyframe ``start``).

    Raises:
        WorldError: the scene cannot be built.
        SpecError: the robot description is unusable.
    """
    content = io.BytesIO()
    _at_start(scene, robot=True).to_zip(content)
    return content.getvalue()


def scene_mjcf(scene: Scene) -> str:
    """Desk and objects of a scene at their start as one MJCF file; meshes that were made here, not
    read from MJCF files, are in it.

    Raises:
        WorldError: the scene cannot be built.
    """
    return str(_at_start(scene, robot=False).to_xml())


def _at_start(scene: Scene, *, robot: bool) -> mujoco.MjSpec:
    """A compiled description with the masses of the scene and its start as a keyframe."""
    world, data = world_at_start(scene)
    spec = scene_spec(scene, robot=robot)
    spec.modelname = "scene"
    for name, entry in world.entries.items():
        if entry.free:
            spec.body(name).pos, spec.body(name).quat = data.body(name).xpos, data.body(name).xquat
    compiled = spec.compile()
    # Of all joints the robot's come first.
    spec.add_key(name="start", qpos=data.qpos[data.qpos.size - compiled.nq :].tolist())
    # The scene's masses are set on the compiled model; here they have to be in the file.
    for body in spec.bodies:
        if not body.name or compiled.body(body.name).id == 0:
            continue
        mass = float(world.model.body(body.name).mass[0])
        ratio = mass / max(float(compiled.body(body.name).mass[0]), 1e-12)
        if abs(ratio - 1.0) < 1e-9:
            continue
        for geom in body.geoms:
            geom.density *= ratio
            geom.mass *= ratio  # stays "not given" where it was
    spec.compile()
    return spec

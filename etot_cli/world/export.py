"""A scene as other programs of MuJoCo read it: MJCF and meshes in one zip file."""

from __future__ import annotations

import io

from etot_cli.specs.scene import Scene
from etot_cli.world.model import scene_spec
from etot_cli.world.placing import world_at_start


def scene_archive(scene: Scene) -> bytes:
    """The world of a scene with robot, desk and objects at their start (keyframe ``start``).

    Raises:
        WorldError: the scene cannot be built.
        SpecError: the robot description is unusable.
    """
    world, data = world_at_start(scene)
    spec = scene_spec(scene)
    spec.modelname = "scene"
    spec.add_key(name="start", qpos=data.qpos.tolist())
    compiled = spec.compile()
    # The scene's masses are set on the compiled model; here they have to be in the file.
    for body in spec.bodies:
        index = compiled.body(body.name).id if body.name else 0
        ratio = world.model.body_mass[index] / max(float(compiled.body_mass[index]), 1e-12)
        if index == 0 or abs(ratio - 1.0) < 1e-9:
            continue
        for geom in body.geoms:
            geom.density *= ratio
            geom.mass *= ratio  # stays "not given" where it was
    spec.compile()
    content = io.BytesIO()
    spec.to_zip(content)
    return content.getvalue()

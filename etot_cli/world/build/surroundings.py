"""What is around the objects: physics options, desk, floor, light, cameras."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.specs import scene as specs
from etot_cli.specs.objects import ROLLING_DEFAULT
from etot_cli.world.build.material import SOLIMP, SOLREF
from etot_cli.world.colors import rgb
from etot_cli.world.pose import quaternion_of
from etot_cli.world.state import DESK

TIMESTEP = 0.002
"""Physics step [s]; 5 ms loses grasps (docs/physics.md)."""
FLOOR_DEPTH = 0.7
"""The floor lies this far below the desk top [m]; what falls there is lost."""


def set_options(mj: mujoco.MjSpec) -> None:
    """Physics and rendering options, as measured (docs/physics.md)."""
    mj.compiler.degree = False
    mj.option.timestep = TIMESTEP
    mj.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    mj.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    mj.option.impratio = 10.0
    mj.option.iterations = 50
    mj.option.solver = mujoco.mjtSolver.mjSOL_NEWTON
    # A state that is no number stays so and is seen; else it becomes the model's first one.
    mj.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    mj.visual.global_.offwidth = 1920
    mj.visual.global_.offheight = 1440
    mj.visual.quality.shadowsize = 2048
    # All lights together stay below white on a bright level surface: colours keep their hue.
    mj.visual.headlight.ambient = [0.34, 0.34, 0.34]
    mj.visual.headlight.diffuse = [0.20, 0.20, 0.20]
    mj.visual.headlight.specular = [0.03, 0.03, 0.03]
    mj.visual.map.shadowclip = 2.0
    mj.visual.map.znear = 0.01
    mj.visual.map.zfar = 20.0


def add_surroundings(mj: mujoco.MjSpec, scene: specs.Scene) -> None:
    """Desk, floor, stand, sky, lights and the cameras of the scene."""
    desk, world = scene.desk, mj.worldbody
    mj.add_texture(
        name="sky",
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.82, 0.87, 0.92],
        rgb2=[0.45, 0.52, 0.60],
        width=256,
        height=1536,
    )
    thickness = 0.03
    top = world.add_geom(
        name=DESK,
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=[desk.size[0] / 2, desk.size[1] / 2, thickness / 2],
        pos=[*desk.center, desk.top - thickness / 2],
    )
    top.rgba = [*rgb(desk.color), 1.0]
    top.friction = [desk.friction, 0.005, ROLLING_DEFAULT]
    top.solref = SOLREF
    top.solimp = SOLIMP
    floor = world.add_geom(
        name="floor",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[4, 4, 0.1],
        pos=[0, 0, desk.top - FLOOR_DEPTH],
    )
    floor.rgba = [0.55, 0.57, 0.6, 1.0]
    # A stand under the robot, so that it does not float beside a small desk.
    stand = world.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=[0.09, 0.09, FLOOR_DEPTH / 2],
        pos=[0, 0, -FLOOR_DEPTH / 2 - 0.001],
    )
    stand.rgba = [0.35, 0.37, 0.4, 1.0]
    stand.contype = 0
    stand.conaffinity = 0
    for position, strength in (((0.6, -1.2, 2.4), 0.42), ((0.8, 1.4, 2.2), 0.20)):
        light = world.add_light(pos=list(position), dir=[-v for v in position])
        light.type = mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
        light.diffuse = [strength] * 3
        light.specular = [0.1] * 3
        light.castshadow = strength > 0.3
    for name, camera in scene.cameras.items():
        _add_camera(world, name, camera)


def _add_camera(world: Any, name: str, camera: specs.Camera) -> None:
    rotation = camera_rotation(camera)
    # MuJoCo cameras look along -z with y up; the optical frame looks along +z with y down.
    flipped = rotation @ np.diag([1.0, -1.0, -1.0])
    world.add_camera(
        name=name,
        pos=list(camera.position),
        quat=quaternion_of(flipped).tolist(),
        resolution=[camera.width, camera.height],
        sensor_size=[camera.width * 1e-5, camera.height * 1e-5],
        focal_pixel=[camera.fx, camera.fy],
        principal_pixel=[camera.width / 2 - camera.cx - 0.5, camera.height / 2 - camera.cy - 0.5],
    )


def camera_rotation(camera: specs.Camera) -> NDArray[np.float64]:
    """Rotation (3, 3) from the OpenCV optical frame to the base frame."""
    if camera.quaternion is not None:
        matrix = np.zeros(9)
        mujoco.mju_quat2Mat(matrix, np.array(camera.quaternion) / np.linalg.norm(camera.quaternion))
        return matrix.reshape(3, 3)
    target = np.array(camera.look_at if camera.look_at is not None else (0.4, 0.0, 0.13))
    forward = target - np.array(camera.position)
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    if np.linalg.norm(right) < 1e-6:
        right = np.array([0.0, -1.0, 0.0])
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(forward, right), forward], axis=1)

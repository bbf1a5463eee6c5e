"""Where the camera stands for pictures for people: near enough to see a pen, with the whole arm."""

from __future__ import annotations

from collections.abc import Iterable
from math import cos, radians, sin, tan

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.specs import objects as specs
from etot_cli.specs.scene import Scene
from etot_cli.world.model import World
from etot_cli.world.surface import SEEN_GROUPS

FOV_DEG = 36.0
"""Vertical opening: as a photographer at a table would take, little distorted."""
ELEVATION_DEG = -27.0
"""As somebody standing before the desk looks down at it."""
ASIDE_DEG = 27.0
"""The camera stands this far beside the line through the robot, so that the arm is seen bent."""
FILLED = 0.95
"""Share of the picture's half width and height that what matters may fill."""
REACH_ABOVE_M = 0.24
"""Over everything that can be grasped there is room for the hand that does it [m]."""
AROUND_M = 0.07
"""Around every object there is room for where it may be moved [m]."""
ROUNDS = 12
"""Centring and distance settle within a few."""


def workspace_camera(
    world: World, qpos: NDArray[np.floating], width: int, height: int
) -> mujoco.MjvCamera:
    """A camera that sees robot and objects, from the side on which the furniture opens.

    Args:
        world: what is seen.
        qpos: (nq,) configuration to frame, usually the start of a run.
        width: of the picture [px].
        height: of the picture [px].
    """
    data = mujoco.MjData(world.model)
    data.qpos[:] = qpos
    mujoco.mj_kinematics(world.model, data)
    world.model.vis.global_.fovy = FOV_DEG
    camera = mujoco.MjvCamera()
    camera.type = mujoco.mjtCamera.mjCAMERA_FREE
    camera.azimuth = 180.0 + _better_side(world.scene) * ASIDE_DEG
    camera.elevation = ELEVATION_DEG
    points = _points(world, data)
    forward, right, up = _axes(camera.azimuth, camera.elevation)
    vertical = FILLED * tan(radians(FOV_DEG / 2))
    horizontal = vertical * width / height
    target = points.mean(axis=0)
    distance = 1.0
    for _ in range(ROUNDS):
        across, along, depth = ((points - target) @ axis for axis in (right, up, forward))
        distance = float(
            max(
                (np.abs(across) / horizontal - depth).max(),
                (np.abs(along) / vertical - depth).max(),
            )
        )
        # The middle of what is seen, not of what is there, belongs into the picture's middle.
        seen = depth + distance
        for axis, offset in ((right, across), (up, along)):
            target = (
                target + axis * float((offset / seen).max() + (offset / seen).min()) / 2 * distance
            )
    camera.lookat[:] = target
    camera.distance = distance
    return camera


def _better_side(scene: Scene) -> float:
    """+1 or −1: the side from which more fronts of furniture are seen."""
    score = 0.0
    for spec in scene.objects.values():
        if isinstance(spec, specs.FURNITURE):
            # A front looks along the object's own +x; the camera at azimuth a stands at −a.
            score -= sin(radians(spec.yaw_deg))
    return -1.0 if score >= 0 else 1.0


def _points(world: World, data: mujoco.MjData) -> NDArray[np.float64]:
    """Corners of what must be seen, base frame (k, 3) [m]."""
    model = world.model
    desk = world.scene.desk
    low, high = [], []
    for geom, owner in enumerate(world.geom_object):
        if model.geom_group[geom] >= SEEN_GROUPS or owner in ("desk", "floor", "stand", ""):
            continue
        if owner not in world.entries and int(model.geom_bodyid[geom]) == 0:
            continue
        radius = _half_extents(model, data, geom)
        around = AROUND_M if owner in world.entries and world.entries[owner].info.movable else 0.02
        center = data.geom_xpos[geom]
        if owner in world.entries and center[2] + radius[2] < desk.top:
            continue  # what has fallen off does not move the camera
        low.append(center - radius - [around, around, 0.0])
        high.append(center + radius + [around, around, 0.0])
        if around == AROUND_M:
            high.append(center + np.array([0.0, 0.0, REACH_ABOVE_M]))
    bounds = [*low, *high] or [np.array([*desk.center, desk.top])]
    minimum, maximum = np.min(bounds, axis=0), np.max(bounds, axis=0)
    minimum[2] = min(minimum[2], desk.top)
    # Corners near the desk, and the upper ones pulled in: nothing stands tall at the very edge.
    x0, y0, z0 = minimum
    x1, y1, z1 = maximum
    middle_y = (y0 + y1) / 2
    corners = [(x, y, z0) for x in (x0, x1) for y in (y0, y1)]
    corners += [(x, middle_y + 0.6 * (y - middle_y), z1) for x in (x0, 0.6 * x1) for y in (y0, y1)]
    return np.array(corners, dtype=np.float64)


def _half_extents(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> NDArray[np.float64]:
    half = np.abs(model.geom_aabb[geom][:3]) + model.geom_aabb[geom][3:]
    return np.asarray(np.abs(data.geom_xmat[geom].reshape(3, 3)) @ half, dtype=np.float64)


def _axes(azimuth_deg: float, elevation_deg: float) -> Iterable[NDArray[np.float64]]:
    """Forward, right and up of MuJoCo's free camera."""
    a, e = radians(azimuth_deg), radians(elevation_deg)
    forward = np.array([cos(e) * cos(a), cos(e) * sin(a), sin(e)])
    right = np.array([sin(a), -cos(a), 0.0])
    return forward, right, np.cross(right, forward)

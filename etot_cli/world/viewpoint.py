"""Whose left and right are meant: the robot's, or those of one who looks through a camera."""

from __future__ import annotations

import math

from etot_cli.specs.scene import ROBOT_VIEWPOINT, Scene
from etot_cli.world.build.surroundings import camera_rotation

STEEP = 0.2
"""A camera whose axis has a smaller horizontal share looks straight down [sine]: ahead is then
where the picture's upper edge points."""


def forward_of(scene: Scene) -> tuple[float, float]:
    """Unit direction, seen from above and in the base frame, in which the scene's viewer looks."""
    if scene.viewpoint == ROBOT_VIEWPOINT:
        return (1.0, 0.0)
    rotation = camera_rotation(scene.cameras[scene.viewpoint])
    axis = rotation[:, 2]
    if math.hypot(axis[0], axis[1]) < STEEP:
        axis = -rotation[:, 1]
    length = math.hypot(axis[0], axis[1])
    return (float(axis[0] / length), float(axis[1] / length))

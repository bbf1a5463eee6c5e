"""A pinhole camera in the base frame: points to pixels and pixels to rays.

Lengths in metres, base frame (z up) unless a name says ``camera``; pixels (u right, v down) with
whole numbers at pixel centres; the camera frame is OpenCV's optical frame.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
NEAREST = 0.02
"""Nothing is projected from closer than this to the camera [m]."""


@dataclass(frozen=True)
class View:
    """Intrinsics in pixels and the pose ``camera_to_base`` (4, 4): p_base = T · p_camera."""

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    camera_to_base: Array

    @property
    def position(self) -> Array:
        """The camera's centre (3,), base frame."""
        return self.camera_to_base[:3, 3]

    @property
    def rotation(self) -> Array:
        """Rotation (3, 3) from camera to base."""
        return self.camera_to_base[:3, :3]

    def moved(self, camera_to_base: Array) -> View:
        """The same camera elsewhere."""
        return replace(self, camera_to_base=camera_to_base)

    def project(self, points: Array) -> Array:
        """Pixels (n, 2) of points (n, 3)."""
        local = (points - self.position) @ self.rotation
        depth = np.maximum(local[:, 2:], NEAREST)
        return np.asarray(local[:, :2] * (self.fx, self.fy) / depth + (self.cx, self.cy))

    def depth_of(self, points: Array) -> Array:
        """Distances (n,) of points (n, 3) along the optical axis."""
        return np.asarray((points - self.position) @ self.rotation[:, 2])

    def rays(self, pixels: Array) -> Array:
        """Directions (n, 3) in the base frame with unit z depth, of pixels (n, 2)."""
        local = np.column_stack(
            [
                (pixels[:, 0] - self.cx) / self.fx,
                (pixels[:, 1] - self.cy) / self.fy,
                np.ones(len(pixels)),
            ]
        )
        return np.asarray(local @ self.rotation.T)

    def lift(self, pixels: Array, depth: Array) -> Array:
        """Points (n, 3) of pixels (n, 2) at z depths (n,)."""
        return np.asarray(self.position + self.rays(pixels) * depth[:, None])

    def on_plane(self, pixels: Array, z: float) -> Array:
        """Where the rays of pixels (n, 2) meet the level ``z``: (n, 3); NaN where they do not."""
        rays = self.rays(pixels)
        with np.errstate(divide="ignore", invalid="ignore"):
            reach = (z - self.position[2]) / rays[:, 2]
        reach[reach <= 0] = np.nan
        return np.asarray(self.position + rays * reach[:, None])

    def cloud(self, depth: Array, every: int = 1) -> Array:
        """Points (h, w, 3) of a depth picture (h, w) [m], or of every so manieth of its rows and
        columns alone; NaN where there is no reading.
        """
        x = (np.arange(0, self.width, every) - self.cx) / self.fx
        y = (np.arange(0, self.height, every) - self.cy) / self.fy
        depth = depth[::every, ::every]
        z = np.where(depth > 0, depth, np.nan)
        points = np.empty((*z.shape, 3))
        for axis, (right, down, forward) in enumerate(self.rotation):
            points[..., axis] = (right * x + (down * y + forward)[:, None]) * z
        points += self.position
        return points

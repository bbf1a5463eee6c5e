"""Plain pictures of a world: what its cameras see, as a model or a reconstruction gets them.

Needs OpenGL, which nothing else in this package does; import it only where pictures are wanted.
Pictures are made afterwards, from stored configurations; nothing here steps physics.
"""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.specs.scene import Scene
from etot_cli.world.model import World
from etot_cli.world.offscreen import Image, OffscreenRenderer, Vector

DEFAULT_FOV_DEG = 45.0
"""MuJoCo's own default."""
DEFAULT_AZIMUTH_DEG, DEFAULT_ELEVATION_DEG = 180.0, -38.0
"""A scene without cameras is seen from the front, obliquely, towards the robot."""
MIN_SIDE = 16
"""Smallest picture side [px]."""


def fit_size(scene: Scene, camera: str | None, width: int, height: int) -> tuple[int, int]:
    """The largest even (width, height) with the camera's proportions within the given one."""
    if camera is None:
        ratio = width / height
    else:
        ratio = scene.cameras[camera].width / scene.cameras[camera].height
    wide = min(float(width), height * ratio)
    return max(MIN_SIDE, int(wide) // 2 * 2), max(MIN_SIDE, round(wide / ratio) // 2 * 2)


class WorldRenderer:
    """Renders configurations of one world from its scene's first camera, or of the whole desk
    where it has none. A context manager.

    Args:
        world: the compiled scene.
        width: largest width [px]; pictures keep the camera's proportions.
        height: largest height [px].

    Raises:
        ServiceError: there is no OpenGL.
    """

    def __init__(self, world: World, width: int, height: int) -> None:
        self.world = world
        camera = next(iter(world.scene.cameras), None)
        self.width, self.height = fit_size(world.scene, camera, width, height)
        self._model = world.model
        self._data = mujoco.MjData(self._model)
        self._camera = camera or self._whole_desk()
        self._renderer = OffscreenRenderer(self._model, self.width, self.height)

    def __enter__(self) -> WorldRenderer:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def frame(self, qpos: NDArray[Any]) -> Image:
        """A picture (height, width, 3) of the configuration ``qpos`` (nq,)."""
        self._place(qpos)
        return self._renderer.color()

    def geoms(self, qpos: NDArray[Any]) -> NDArray[np.int32]:
        """For every pixel (height, width) the id of the geom seen there; -1 where there is none."""
        self._place(qpos)
        return self._renderer.depth_and_geoms()[1]

    def eye(self, qpos: NDArray[Any]) -> tuple[Vector, Vector, Vector, Vector]:
        """Position [m] and the unit vectors to the right, up and ahead of the camera, base frame.

        ``qpos`` (nq,) matters where something carries the camera.
        """
        self._place(qpos)
        return self._renderer.eye()

    def visible_pixels(self, qpos: NDArray[Any]) -> dict[str, NDArray[np.bool_]]:
        """For every object that is seen, the mask (height, width) of its pixels."""
        owners = np.array(self.world.geom_object)
        geoms = self.geoms(qpos)
        masks = {
            name: np.isin(geoms, np.flatnonzero(owners == name)) for name in self.world.entries
        }
        return {name: mask for name, mask in masks.items() if mask.any()}

    def close(self) -> None:
        """Frees what the graphics driver holds; idempotent."""
        self._renderer.close()

    def _place(self, qpos: NDArray[Any]) -> None:
        self._data.qpos[:] = qpos
        self._renderer.look(self._data, self._camera)

    def _whole_desk(self) -> mujoco.MjvCamera:
        view = mujoco.MjvCamera()
        desk = self.world.scene.desk
        view.type = mujoco.mjtCamera.mjCAMERA_FREE
        view.lookat[:] = [*desk.center, desk.top + 0.08]
        view.azimuth, view.elevation = DEFAULT_AZIMUTH_DEG, DEFAULT_ELEVATION_DEG
        self._model.vis.global_.fovy = DEFAULT_FOV_DEG
        # Far enough that the desk's far and near sides fit into the narrower angle.
        vertical = math.tan(math.radians(DEFAULT_FOV_DEG / 2))
        narrower = min(vertical, vertical * self.width / self.height)
        view.distance = max(desk.size[1] / 2 / (vertical * self.width / self.height),
                            desk.size[0] / 2 / narrower) + desk.size[0] / 2  # fmt: skip
        return view

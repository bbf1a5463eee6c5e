"""The one way in which pixels come into being: a model drawn into memory, without a window."""

from __future__ import annotations

from typing import Self

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import ServiceError, WorldError
from etot_cli.world.opengl import NO_OPENGL, open_context

Image = NDArray[np.uint8]
"""RGB, (height, width, 3)."""
Vector = tuple[float, float, float]

MAX_GEOMS = 10_000
"""Things drawn at once; MuJoCo's own renderer has room for as many."""


PLASTIC_X, PLASTIC_Y = 0.7548776662466927, 0.5698402909980532
"""Steps of the sequence that fills a square most evenly, whatever number of points is taken."""
GOLDEN_ANGLE = 2.399963229728653
"""Turn between points that fills a disc evenly [rad]."""
LAMP_RADIUS = 0.06
"""Tangent of half the angle under which a lamp is seen; a lampshade at two metres."""


class OffscreenRenderer:
    """Draws configurations of one model as colours, depths and geom ids. A context manager.

    Args:
        model: what is drawn; its off-screen buffer grows to the picture's size if need be.
        width: of the pictures [px].
        height: of the pictures [px].

    Raises:
        ServiceError: there is no OpenGL.
    """

    def __init__(self, model: mujoco.MjModel, width: int, height: int) -> None:
        self.width, self.height = width, height
        self._model = model
        limits = model.vis.global_
        limits.offwidth = max(limits.offwidth, width)
        limits.offheight = max(limits.offheight, height)
        self._scene = mujoco.MjvScene(model, MAX_GEOMS)
        self._option = mujoco.MjvOption()
        self._rectangle = mujoco.MjrRect(0, 0, width, height)
        self._context = open_context(width, height)
        try:
            self._buffers = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_150.value)
        except mujoco.FatalError as error:  # a context, but not the OpenGL that MuJoCo needs
            self._context.free()
            raise ServiceError(NO_OPENGL.format(reason=error)) from error
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, self._buffers)
        self._buffers.readDepthMap = mujoco.mjtDepthMap.mjDEPTH_ZEROFAR

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Frees what the graphics driver holds; idempotent."""
        if self._context is not None:
            self._context.make_current()
            self._buffers.free()
            self._context.free()
            self._context = None

    def look(self, data: mujoco.MjData, camera: mujoco.MjvCamera | str) -> None:
        """Takes over what is to be drawn: the configuration of ``data``, seen by ``camera``, one of
        the model's by its name.
        """
        mujoco.mj_kinematics(self._model, data)
        mujoco.mj_comPos(self._model, data)  # lights and cameras may follow a body's mass
        mujoco.mj_camlight(self._model, data)
        if isinstance(camera, str):
            index, camera = self._model.camera(camera).id, mujoco.MjvCamera()
            camera.type, camera.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, index
        mujoco.mjv_updateScene(
            self._model, data, self._option, None, camera, mujoco.mjtCatBit.mjCAT_ALL.value,
            self._scene,
        )  # fmt: skip

    def eye(self) -> tuple[Vector, Vector, Vector, Vector]:
        """Position [m] and the unit vectors to the right, up and ahead of the camera."""
        left, right = self._scene.camera  # for glasses; what is drawn is their mean
        position = (np.array(left.pos) + np.array(right.pos)) / 2
        up, ahead = np.array(left.up, dtype=float), np.array(left.forward, dtype=float)
        return _vector(position), _vector(np.cross(ahead, up)), _vector(up), _vector(ahead)

    def color(self) -> Image:
        """The picture (height, width, 3)."""
        return self._draw()[0]

    def soft_color(self, samples: int) -> Image:
        """The picture (height, width, 3) as the mean of several, each from a slightly other eye.

        The eye moves within a pixel, which smooths edges, and the lamps that cast shadows within
        a disc, which gives shadows a soft rim. The same positions every time.
        """
        eyes = [(eye, eye.frustum_center, eye.frustum_bottom, eye.frustum_top)
                for eye in self._scene.camera]  # fmt: skip
        lamps = [(lamp, np.array(lamp.dir)) for lamp in self._scene.lights[: self._scene.nlight]
                 if lamp.castshadow]  # fmt: skip
        total = np.zeros((self.height, self.width, 3), dtype=np.uint32)
        for number in range(samples):
            across, along = (number * PLASTIC_X) % 1 - 0.5, (number * PLASTIC_Y) % 1 - 0.5
            for eye, center, bottom, top in eyes:
                pixel = (top - bottom) / self.height
                eye.frustum_center = center + across * pixel
                eye.frustum_bottom, eye.frustum_top = bottom + along * pixel, top + along * pixel
            for lamp, direction in lamps:
                lamp.dir[:] = _within_disc(direction, number, samples)
            total += self._draw()[0]
        for eye, center, bottom, top in eyes:
            eye.frustum_center, eye.frustum_bottom, eye.frustum_top = center, bottom, top
        for lamp, direction in lamps:
            lamp.dir[:] = direction
        return np.asarray((total + samples // 2) // samples, dtype=np.uint8)

    def depth_and_geoms(self) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        """Depth along the view axis [m] and id of the geom seen, both (height, width).

        Where no geom is seen, in the sky, the id is -1 and the depth 0.
        """
        flags = self._scene.flags
        kept = flags.copy()
        # One colour for each geom, without light and sky.
        flags[mujoco.mjtRndFlag.mjRND_SEGMENT] = True
        flags[mujoco.mjtRndFlag.mjRND_IDCOLOR] = True
        try:
            coded, buffer = self._draw()
        finally:
            np.copyto(flags, kept)
        segments = coded.astype(np.int32) @ (1, 1 << 8, 1 << 16)
        # Segment numbers count the drawn things from 1; 0 is the background.
        ids = np.full(self._scene.ngeom + 1, -1, dtype=np.int32)
        for item in self._scene.geoms[: self._scene.ngeom]:
            if item.segid >= 0 and item.objtype == mujoco.mjtObj.mjOBJ_GEOM:
                ids[item.segid + 1] = item.objid
        geoms = ids[np.clip(segments, 0, self._scene.ngeom)]
        # The buffer holds 1 at the near plane and 0 at the far one, linear in 1 / depth.
        planes, extent = self._model.vis.map, self._model.stat.extent
        near, far = planes.znear * extent, planes.zfar * extent
        depth = near * far / (near + buffer.astype(np.float64) * (far - near))
        depth[geoms < 0] = 0.0
        return depth, geoms

    def _draw(self) -> tuple[Image, NDArray[np.float32]]:
        """Colours and the depth buffer, first row on top."""
        if self._context is None:
            raise WorldError("the renderer has been closed")
        self._context.make_current()
        image = np.empty((self.height, self.width, 3), dtype=np.uint8)
        depth = np.empty((self.height, self.width), dtype=np.float32)
        mujoco.mjr_render(self._rectangle, self._scene, self._buffers)
        mujoco.mjr_readPixels(image, depth, self._rectangle, self._buffers)
        return np.ascontiguousarray(image[::-1]), depth[::-1]  # OpenGL counts from the bottom


def _vector(values: NDArray[np.floating]) -> Vector:
    x, y, z = (round(float(value), 6) for value in values)
    return x, y, z


def _within_disc(direction: NDArray[np.float64], number: int, samples: int) -> NDArray[np.float64]:
    """A lamp's direction (3,) turned to one of ``samples`` points of its disc."""
    ahead = direction / np.linalg.norm(direction)
    aside = np.cross(ahead, [0.0, 0.0, 1.0] if abs(ahead[2]) < 0.99 else [1.0, 0.0, 0.0])
    aside /= np.linalg.norm(aside)
    radius = LAMP_RADIUS * np.sqrt((number + 0.5) / samples) if samples > 1 else 0.0
    turned = ahead + radius * (
        np.cos(GOLDEN_ANGLE * number) * aside
        + np.sin(GOLDEN_ANGLE * number) * np.cross(ahead, aside)
    )
    return np.asarray(turned / np.linalg.norm(turned), dtype=np.float64)

"""A camera in a simulated world, with the errors of a time-of-flight camera of the Kinect kind."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import mujoco
import numpy as np

from etot_cli.execution.protocols import Frame
from etot_cli.specs.scene import Camera, Scene
from etot_cli.world.capture import (
    CAMERA_NAME,
    DEFAULT_CAMERA,
    Noise,
    Picture,
    add_noise,
    aim,
    camera_to_base,
)
from etot_cli.world.model import build_world
from etot_cli.world.offscreen import OffscreenRenderer

EXPOSURE_S = 1.0 / 30.0
"""A picture takes so long on the camera's clock [s], during which the world stands still."""
LARGEST = (640, 480)
"""Pictures are made no larger: perception has two seconds for one."""


def camera_of(scene: Scene) -> Camera:
    """The scene's first camera, or the default one, its picture made small enough."""
    found = next(iter(scene.cameras.values()), DEFAULT_CAMERA)
    factor = min(1.0, LARGEST[0] / found.width, LARGEST[1] / found.height)
    if factor == 1.0:
        return found
    # Pixel centres have whole coordinates, so the corner of the picture lies at −½.
    return found.model_copy(
        update={
            "width": int(found.width * factor),
            "height": int(found.height * factor),
            "fx": found.fx * factor,
            "fy": found.fy * factor,
            "cx": (found.cx + 0.5) * factor - 0.5,
            "cy": (found.cy + 0.5) * factor - 0.5,
        }
    )


class RenderedCamera:
    """Implements :class:`etot_cli.execution.protocols.Camera`.

    Args:
        scene: as it was built for the world that is looked at.
        state: that world's data at the time of the picture; only read.
        rng: draws the noise.
        noise: errors of depth and colour; None for a perfect camera.
    """

    def __init__(
        self,
        scene: Scene,
        state: Callable[[], mujoco.MjData],
        rng: np.random.Generator,
        noise: Noise | None = Noise(),  # noqa: B008 - frozen
    ) -> None:
        self._camera = camera_of(scene)
        self._state, self._rng, self._noise = state, rng, noise
        self._world = build_world(scene.model_copy(update={"cameras": {CAMERA_NAME: self._camera}}))
        self._data = mujoco.MjData(self._world.model)
        self._renderer: OffscreenRenderer | None = None
        self._taken = 0

    def connect(self) -> str:
        """Opens OpenGL.

        Raises:
            ServiceError: there is none.
        """
        if self._renderer is None:
            model = self._world.model
            # A depth camera has one ray a pixel; without a graphics card it halves the time.
            model.vis.quality.offsamples, model.vis.quality.shadowsize = 0, 1024
            aim(model, CAMERA_NAME, self._camera)
            self._renderer = OffscreenRenderer(model, self._camera.width, self._camera.height)
        seen = f"{self._camera.width} × {self._camera.height}"
        return f"rendered camera, {seen}" + (", with noise" if self._noise else "")

    def frame(self) -> Frame:
        """A picture of the world as it is now."""
        self.connect()
        assert self._renderer is not None
        state, model = self._state(), self._world.model
        self._taken += 1
        # Cameras have no joints, so this model's configuration is that of the world's own.
        self._data.qpos[:] = state.qpos
        if model.nmocap:
            self._data.mocap_pos[:], self._data.mocap_quat[:] = state.mocap_pos, state.mocap_quat
        self._renderer.look(self._data, CAMERA_NAME)
        color = self._renderer.color()
        depth, _ = self._renderer.depth_and_geoms()
        picture = Picture(self._camera, color, depth, {})
        if self._noise is not None:
            picture = add_noise(picture, self._noise, self._rng)
            units = np.round(picture.depth / self._noise.scale)
            picture = replace(picture, depth=units * self._noise.scale)
        camera = self._camera
        matrix = np.array(
            [[camera.fx, 0.0, camera.cx], [0.0, camera.fy, camera.cy], [0.0, 0.0, 1.0]]
        )
        return Frame(
            picture.color,
            picture.depth,
            matrix,
            camera_to_base(camera),
            float(state.time) + self._taken * EXPOSURE_S,
        )  # fmt: skip

    def close(self) -> None:
        """Frees what the graphics driver holds."""
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None

"""A viewer in the browser, by viser: for machines without a display, also far away ones."""

from __future__ import annotations

import time
from contextlib import redirect_stdout
from io import StringIO
from typing import Any

import mujoco
import numpy as np

from etot_cli.errors import ServiceError
from etot_cli.world.model import World
from etot_cli.world.viewing.reel import RATE_HZ, Reel
from etot_cli.world.viewing.shapes import shapes_of

HERE = "127.0.0.1"
"""Only this machine may look; from elsewhere by an SSH tunnel."""
PORT = 8080
"""What viser itself begins with; where this one is taken, the next free one is used."""
EYE = (1.15, -0.4, 0.75)
"""Of whoever begins to look: before the desk, a little aside, to see the arm bent [m]."""


class BrowserReplay:
    """A page with the scene, a slider over time, and a button that plays. A context manager.

    Args:
        world: the scene.
        reel: what happened.
        port: first one to try.

    Raises:
        ServiceError: viser is missing, or no port can be had.
    """

    def __init__(self, world: World, reel: Reel, port: int = PORT) -> None:
        try:
            import viser

            # It greets on standard output whatever it is told, where a report may be asked for.
            with redirect_stdout(StringIO()):
                self._server = viser.ViserServer(host=HERE, port=port, label="etot", verbose=False)
        except Exception as error:  # a library that is missing, a port that cannot be had
            raise ServiceError(f"the viewer in the browser cannot start: {error}") from None
        self._model, self._data, self._reel = world.model, mujoco.MjData(world.model), reel
        self._bodies: dict[int, Any] = {}
        self._build(world)
        gui = self._server.gui
        self._caption = gui.add_markdown("")
        self.slider: Any = gui.add_slider("moment", 0, max(1, len(reel) - 1), 1, 0)
        self.playing: Any = gui.add_checkbox("play", True)
        self.slider.on_update(lambda _: self.show(int(self.slider.value)))
        self.show(0)

    def __enter__(self) -> BrowserReplay:
        return self

    def __exit__(self, *_: object) -> None:
        with redirect_stdout(StringIO()):
            self._server.stop()

    @property
    def url(self) -> str:
        """Where a browser finds it."""
        return f"http://{HERE}:{self._server.get_port()}"

    def pose(self, body: str) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Position [m] and quaternion (w, x, y, z) at which a body is shown."""
        frame = self._bodies[self._model.body(body).id]
        return tuple(map(float, frame.position)), tuple(map(float, frame.wxyz))

    def show(self, moment: int) -> None:
        """Shows one moment, counted from 0; what lies beyond the end is the end."""
        moment = min(max(moment, 0), len(self._reel) - 1)
        self._data.qpos[:] = self._reel.qpos[moment]
        mujoco.mj_kinematics(self._model, self._data)
        with self._server.atomic():
            for body, frame in self._bodies.items():
                frame.position = np.array(self._data.xpos[body])
                frame.wxyz = np.array(self._data.xquat[body])
        self._caption.content = self._reel.caption(moment)

    def play(self) -> None:
        """Plays over and over while the box is ticked, until interrupted."""
        while True:
            time.sleep(1.0 / RATE_HZ)
            if self.playing.value and self._server.get_clients():
                self.slider.value = (int(self.slider.value) + 1) % len(self._reel)

    def _build(self, world: World) -> None:
        scene = self._server.scene
        scene.set_up_direction("+z")
        desk = world.scene.desk
        self._server.initial_camera.position = EYE
        self._server.initial_camera.look_at = (*desk.center, desk.top)
        for number, shape in enumerate(shapes_of(self._model)):
            if shape.body not in self._bodies:
                # The world's own body has no name of its own in every model.
                name = self._model.body(shape.body).name or f"body{shape.body}"
                frame = scene.add_frame(f"/{shape.body}_{name}", show_axes=False)
                self._bodies[shape.body] = frame
            scene.add_mesh_simple(
                f"{self._bodies[shape.body].name}/{number}",
                shape.vertices,
                shape.faces,
                color=shape.color,
                opacity=None if shape.opacity >= 1.0 else shape.opacity,
                flat_shading=True,
            )

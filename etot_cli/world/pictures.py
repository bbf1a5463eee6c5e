"""Pictures for people: the dressed world, framed on the work, with outlines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import cv2
import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.specs.scene import Scene
from etot_cli.world.captions import FACE, PAPER, text_size
from etot_cli.world.framing import workspace_camera
from etot_cli.world.model import build_world
from etot_cli.world.offscreen import Image, OffscreenRenderer

CULPRIT = (235, 40, 25)
"""Red, of outlines and tags, RGB."""
SMALLEST_SEEN = 12
"""Objects of which fewer pixels are seen get no outline."""


class PictureRenderer:
    """Takes pictures of one scene, all from the same place. A context manager.

    Args:
        scene: what is seen.
        qpos: (nq,) the configuration that the camera is framed on.
        width: of the pictures [px].
        height: of the pictures [px].
        samples: renders per picture; more make edges and shadows softer.

    Raises:
        ServiceError: there is no OpenGL.
        WorldError: the scene cannot be built.
    """

    def __init__(
        self, scene: Scene, qpos: NDArray[Any], width: int, height: int, samples: int
    ) -> None:
        self._world = build_world(scene, dressed=True)
        self._data = mujoco.MjData(self._world.model)
        self._samples = samples
        self._camera = workspace_camera(self._world, qpos, width, height)
        self._renderer = OffscreenRenderer(self._world.model, width, height)

    def __enter__(self) -> PictureRenderer:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Frees what the graphics driver holds; idempotent."""
        self._renderer.close()

    def take(self, qpos: NDArray[Any], outlined: Sequence[str] = ()) -> Image:
        """A picture (height, width, 3) of a configuration (nq,).

        Args:
            qpos: the configuration.
            outlined: objects to outline and name.
        """
        self._data.qpos[:] = qpos
        self._renderer.look(self._data, self._camera)
        image = self._renderer.soft_color(self._samples)
        if outlined:
            _, geoms = self._renderer.depth_and_geoms()
            owners = np.array(self._world.geom_object)
            seen = {name: np.isin(geoms, np.flatnonzero(owners == name)) for name in outlined}
            # Small things last: a large one's line does not cross their names.
            for name in sorted(seen, key=lambda name: -int(seen[name].sum())):
                image = outline(image, seen[name], name)
        return image


def outline(image: Image, mask: NDArray[np.bool_], name: str) -> Image:
    """A picture (height, width, 3) with a red line around a mask (height, width) and its name."""
    if int(mask.sum()) < SMALLEST_SEEN:
        return image
    drawn = np.ascontiguousarray(image)
    scale = max(1.0, image.shape[1] / 480)
    lines, _ = cv2.findContours(
        cv2.dilate(mask.astype(np.uint8), np.ones((3, 3), np.uint8)),
        cv2.RETR_EXTERNAL,
        cv2.CHAIN_APPROX_NONE,
    )
    for color, thickness in ((PAPER, round(2.6 * scale)), (CULPRIT, round(1.3 * scale))):
        cv2.drawContours(drawn, lines, -1, color, max(1, thickness), cv2.LINE_AA)
    rows, columns = np.nonzero(mask)
    return _tag(drawn, name, int(columns.mean()), int(rows.min()), scale)


def _tag(image: Image, text: str, x: int, y: int, scale: float) -> Image:
    """A name on a red tag above a point."""
    face, size = cv2.FontFace(FACE), round(8 * scale)
    width, height = text_size(text, image.shape[1], size)
    pad = round(4 * scale)
    left = int(np.clip(x - width // 2 - pad, 2, max(2, image.shape[1] - width - 2 * pad - 2)))
    top = max(2, y - height - 2 * pad - round(5 * scale))
    cv2.rectangle(
        image, (left, top), (left + width + 2 * pad, top + height + 2 * pad), CULPRIT, -1,
        cv2.LINE_AA,
    )  # fmt: skip
    cv2.putText(
        image, text, (left + pad, top + pad + height - round(1 * scale)), PAPER, face, size, 600
    )
    return image

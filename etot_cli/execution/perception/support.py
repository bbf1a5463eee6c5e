"""What a depth picture says of a known surface at a pose."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from etot_cli.execution.perception.surfaces import Surface
from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.world.pose import Pose

TOLERANCE = 0.007
"""Depth that is off by less, along the surface's normal, bears a pose out [m]: four standard
deviations of the camera a metre away."""
CELL = 3
"""Pixels of a cell in which the nearest point of a surface hides those behind it."""
SELF = 0.012
"""Points this far behind the nearest one of their cell are hidden by it [m]."""
GRAZING = 0.15
"""Surfaces seen at a flatter angle (cosine) say nothing."""


@dataclass(frozen=True)
class Support:
    """How many points of a surface that face the camera agree with the picture, are hidden behind
    something nearer or outside of the picture, are contradicted (what is seen lies farther away),
    or fall where depth was lost.
    """

    agree: int
    hidden: int
    through: int
    unread: int

    @property
    def visible(self) -> int:
        """Points about which the picture says something."""
        return self.agree + self.through

    @property
    def share(self) -> float:
        """Share of them that agree; 0 when there are none."""
        return self.agree / self.visible if self.visible else 0.0

    @property
    def outlined(self) -> float:
        """As ``share``, with depth that was lost taken as the edge of something thin."""
        total = self.visible + self.unread
        return (self.agree + self.unread) / total if total else 0.0

    @property
    def worth(self) -> float:
        """What an outline is moved by: depth is lost at the edges of things, so that where it was
        lost speaks for a thin one, half as much as a reading does.
        """
        return self.agree + 0.5 * self.unread - 2.0 * self.through

    @property
    def covered(self) -> float:
        """Share of all points that something nearer hides."""
        return self.hidden / max(self.agree + self.hidden + self.through + self.unread, 1)


@dataclass(frozen=True)
class Shown:
    """The visible points of a surface that a picture has, and what is read there.

    ``chosen`` (k,): their indices; ``points`` (k, 3) and ``normals`` (k, 3), base frame [m];
    ``pixels`` (k, 2); ``ahead`` (k,): how far before the surface the reading lies, along the
    normal [m], NaN where depth was lost; ``beside``: how many points the picture does not have.
    """

    chosen: NDArray[np.intp]
    points: Array
    normals: Array
    pixels: NDArray[np.int64]
    ahead: Array
    beside: int

    @property
    def agree(self) -> NDArray[np.bool_]:
        """Points (k,) where the reading lies on the surface."""
        return np.asarray(np.abs(self.ahead) < TOLERANCE)

    @property
    def hidden(self) -> NDArray[np.bool_]:
        """Points (k,) where something is read before the surface."""
        return np.asarray(self.ahead >= TOLERANCE)


def visible_points(surface: Surface, pose: Pose, view: View) -> NDArray[np.intp]:
    """Indices of the points that face the camera and are not hidden by the thing itself."""
    points = pose.place(surface.points)
    towards = view.position - points
    towards /= np.linalg.norm(towards, axis=1, keepdims=True)
    facing = np.flatnonzero(((surface.normals @ pose.rotation.T) * towards).sum(axis=1) > GRAZING)
    pixels = view.project(points[facing])
    cells = np.floor(pixels / CELL).astype(np.int64)
    cells -= cells.min(axis=0, initial=0)
    key = cells[:, 0] * (int(cells[:, 1].max(initial=0)) + 1) + cells[:, 1]
    depth = view.depth_of(points[facing])
    nearest = np.full(int(key.max(initial=0)) + 1, np.inf)
    np.minimum.at(nearest, key, depth)
    return np.asarray(facing[depth < nearest[key] + SELF])


def shown(surface: Surface, pose: Pose, view: View, depth: Array) -> Shown:
    """The points of a surface at a pose that a depth picture (h, w) [m] tells something about."""
    chosen = visible_points(surface, pose, view)
    points = pose.place(surface.points[chosen])
    pixels = np.round(view.project(points)).astype(np.int64)
    inside = ((pixels >= 0) & (pixels < [view.width, view.height])).all(axis=1)
    chosen, points, pixels = chosen[inside], points[inside], pixels[inside]
    normals = surface.normals[chosen] @ pose.rotation.T
    towards = view.position - points
    towards /= np.linalg.norm(towards, axis=1, keepdims=True)
    read = depth[pixels[:, 1], pixels[:, 0]]
    nearer = np.where(read > 0, view.depth_of(points) - read, np.nan)
    ahead = nearer * (normals * towards).sum(axis=1)
    return Shown(chosen, points, normals, pixels, ahead, int((~inside).sum()))


def support(surface: Surface, pose: Pose, view: View, depth: Array) -> Support:
    """How far a depth picture (h, w) [m] bears a pose out."""
    seen = shown(surface, pose, view, depth)
    return Support(
        int(seen.agree.sum()),
        int(seen.hidden.sum()) + seen.beside,
        int((seen.ahead <= -TOLERANCE).sum()),
        int(np.isnan(seen.ahead).sum()),
    )


def loose(surface: Surface, pose: Pose, view: View, depth: Array, holding: float) -> Array | None:
    """The level direction (3,) in which what is read of a surface says least about its pose; None
    where it says enough.

    Args:
        surface: the thing.
        pose: where it was found.
        view: the camera.
        depth: its picture (h, w) [m].
        holding: how many readings of faces across a direction are enough.
    """
    seen = shown(surface, pose, view, depth)
    across = seen.normals[seen.agree, :2]
    held, axes = np.linalg.eigh(across.T @ across)
    return np.append(axes[:, 0], 0.0) if held[0] < holding else None

"""Where things are inside a compiled model: objects, parts, containers and surfaces by name."""

from __future__ import annotations

from dataclasses import dataclass

from etot_cli.world.state import ObjectInfo, PartInfo


@dataclass(frozen=True)
class Region:
    """Free space that things can be put into, through its side facing ``opening``.

    ``address``: object or part address; ``body``: body name whose frame holds it; ``center`` (3,)
    and ``half`` (3,) in that frame [m]; ``round``: a cylinder of radius ``half[0]``; ``opening``:
    unit vector (3,) in that frame, out of the container; ``rim``: z relative to the centre at which
    its walls end, where they are lower than it is [m].
    """

    address: str
    body: str
    center: tuple[float, float, float]
    half: tuple[float, float, float]
    round: bool = False
    opening: tuple[float, float, float] = (0.0, 0.0, 1.0)
    rim: float | None = None


@dataclass(frozen=True)
class Surface:
    """A flat top: ``center`` (3,) on the face, ``half`` extents x y [m], body frame.

    ``space``: the room above it where something covers it, open to the side only.
    """

    address: str
    body: str
    center: tuple[float, float, float]
    half: tuple[float, float]
    round: bool = False
    space: Region | None = None


@dataclass(frozen=True)
class Face:
    """A rectangle of a movable part that a finger can push: centre, outward normal and the two
    half-extent vectors along its sides, part body frame, at joint value 0 [m].
    """

    center: tuple[float, float, float]
    normal: tuple[float, float, float]
    half_u: tuple[float, float, float]
    half_v: tuple[float, float, float]


@dataclass(frozen=True)
class Graspable:
    """A bar or panel of a part that the gripper can close on: half extents in the part frame.

    ``closing`` is the direction across it, ``along`` its long direction, ``approach`` the possible
    approach directions (unit vectors, part body frame).
    """

    center: tuple[float, float, float]
    closing: tuple[float, float, float]
    along: tuple[float, float, float]
    half_along: float
    thickness: float
    approaches: tuple[tuple[float, float, float], ...]
    behind: float = 1.0
    """Free space behind it for a finger when the part is closed [m]; opening adds to it."""
    bar: bool = False
    """A free bar, which the hand may come to from all round; else the edge of a panel."""


@dataclass(frozen=True)
class Part:
    """A movable part in the model."""

    info: PartInfo
    body: str
    joint: str
    lower: float
    """Joint value when closed."""
    upper: float
    """Joint value when fully open."""
    outer: Face | None = None
    """The face that closing pushes on."""
    inner: Face | None = None
    """The face behind it, that opening pushes on once it is ajar."""
    grasps: tuple[Graspable, ...] = ()
    back: Face | None = None
    """All of its back, where ``inner`` is only what is behind its handle."""


@dataclass(frozen=True)
class ObjectEntry:
    """An object in the model: ``body`` is its root body, ``free`` whether it can move freely."""

    info: ObjectInfo
    body: str
    free: bool
    parts: tuple[Part, ...] = ()
    regions: tuple[Region, ...] = ()
    surfaces: tuple[Surface, ...] = ()
    upright_matters: bool = True
    """Falling over changes what it is good for (not so for balls and lying rods)."""
    axis: tuple[float, float, float] | None = None
    """Long axis of a rod pointing at its point, body frame."""

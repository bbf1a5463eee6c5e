"""What a scene is: desk, robot, cameras and objects, as validated data.

The object kinds live in :mod:`etot_cli.specs.objects`.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from etot_cli.specs.base import Color, Name, Point, Quaternion, Spec, Title
from etot_cli.specs.objects import SceneObject
from etot_cli.specs.quantity import (
    Coordinate,
    Delay,
    Finite,
    FocalLength,
    Friction,
    Height,
    Length,
    OpeningDegrees,
    Pixel,
    PixelCount,
    Share,
    Spread,
)

MAX_OBJECTS = 64
"""Objects in one scene; more is a mistake or an attack, and the planner could not branch on it."""

RESERVED_NAMES = ("desk", "robot", "gripper", "chosen")
"""Words with a meaning of their own in plans and reports; no object may be called so."""


ROBOT_VIEWPOINT = "robot"
"""The viewpoint of one who stands where the robot stands and looks along its x axis."""


class Desk(Spec):
    """The table top."""

    size: tuple[Length, Length] = (0.8, 1.2)
    """Extents along x and y."""
    center: tuple[Coordinate, Coordinate] = (0.42, 0.0)
    """x y of its centre."""
    top: Height = 0.13
    """Height of its surface."""
    friction: Friction = 0.6
    color: Color = "wheat"


class Camera(Spec):
    """A pinhole camera."""

    position: Point
    look_at: Point | None = None
    """The point that it looks at; this or ``quaternion``."""
    quaternion: Quaternion | None = None
    """OpenCV optical frame: x right, y down, z forward."""
    width: PixelCount = 1280
    height: PixelCount = 720
    fx: FocalLength = 608.0
    """Focal lengths [px]."""
    fy: FocalLength = 608.0
    cx: Pixel = 642.0
    """Principal point [px], inside the picture."""
    cy: Pixel = 363.6

    @model_validator(mode="after")
    def _one_direction(self) -> Camera:
        if (self.look_at is None) == (self.quaternion is None):
            raise ValueError("needs either 'look_at: [x, y, z]' or 'quaternion', not both")
        if self.look_at is not None and self.look_at == self.position:
            raise ValueError("'look_at' is the camera's own position")
        return self


class Variation(Spec):
    """How far ``--vary`` moves things: uniform in ± these bounds."""

    position_m: Spread = 0.010
    """Along x and along y."""
    yaw_deg: OpeningDegrees = 10.0
    """About z."""
    friction: Share = 0.20
    """Relative."""
    mass: Share = 0.20
    """Relative."""
    size: Share | None = None
    """Relative, of movable things; as far as sizes are perceived wrongly when None."""
    rolling_friction: Share = 0.30
    """Relative, of round things; like what follows not in the planner's twin."""
    pad_friction: Share = 0.10
    """Relative, of the gripper's pads against everything."""
    servo: Share = 0.10
    """Relative, of the gains of the arm's servos, each joint its own."""
    gripper_force: Share = 0.15
    """Relative."""
    delay_s: Delay = 0.02
    """How much later than sent a command takes effect, at most; uniform from 0."""
    keep: tuple[str, ...] = ()
    """Objects that get no pose of their own drawn; they still move with what carries them."""


class Actuation(Spec):
    """How a robot differs from its description: factors, and how late its commands take effect.

    A scene in a file describes the robot as it is believed to be, and has none of this.
    """

    pad_friction: Finite = 1.0
    gripper_force: Finite = 1.0
    servo: tuple[Finite, ...] = ()
    """Of each joint's gains, from the base; joints without one have their own."""
    delay_s: Delay = 0.0


class Perception(Spec):
    """How far what a robot sees is off: uniform in ± these bounds."""

    position_m: Spread = 0.005
    """Along x and along y."""
    yaw_deg: OpeningDegrees = 3.0
    """About z."""
    size: Share = 0.02
    """Relative: how far true sizes are from the believed ones."""


class Scene(Spec):
    """A whole scene."""

    name: Title = "scene"
    description: Annotated[str, Field(max_length=2000)] = ""
    """For people."""
    desk: Desk = Desk()
    robot: str = "xarm6"
    """A built-in robot, or a robot's YAML file (its name contains ``/`` or ends in ``.yaml``)."""
    cameras: dict[Name, Camera] = Field(default_factory=dict)
    objects: Annotated[dict[Name, SceneObject], Field(max_length=MAX_OBJECTS)] = Field(
        default_factory=dict
    )
    variation: Variation = Variation()
    """How far ``--vary`` and ``execute`` move things."""
    perception: Perception = Perception()
    """How far what a robot sees is off."""
    viewpoint: Name = ROBOT_VIEWPOINT
    """Whose left, right, front and back are meant: the robot's, or those of one of ``cameras``."""
    actuation: Actuation = Actuation()
    """Drawn for worlds that are not the planner's twin; refused in YAML."""
    directory: str = "."
    """Folder (absolute) against which mesh, MJCF and robot files are resolved; set by the loader,
    refused in YAML. The loader has checked those files; when one comes from an included document
    of another folder, its relative path starts with ``..``."""

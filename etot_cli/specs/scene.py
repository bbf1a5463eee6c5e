"""What a scene is: desk, robot, cameras and objects, as validated data.

Lengths in metres, masses in kilograms, angles in degrees (fields say ``_deg``), robot-base frame
(x forward, y left, z up), quaternions w x y z. The models only check what one value can show;
checks between objects need geometry and live in :mod:`etot_cli.specs.checks`.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

MAX_OBJECTS = 64
"""Objects in one scene; more is a mistake or an attack, and the planner could not branch on it."""

Name = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,47}$")]
Length = Annotated[float, Field(gt=0.0005, le=2.0, allow_inf_nan=False)]
SmallLength = Annotated[float, Field(gt=0.0005, le=0.6, allow_inf_nan=False)]
Coordinate = Annotated[float, Field(ge=-3.0, le=3.0, allow_inf_nan=False)]
Mass = Annotated[float, Field(gt=0.0001, le=100.0, allow_inf_nan=False)]
Friction = Annotated[float, Field(ge=0.01, le=3.0, allow_inf_nan=False)]
Degrees = Annotated[float, Field(ge=-360.0, le=360.0, allow_inf_nan=False)]
Finite = Annotated[float, Field(allow_inf_nan=False)]
Channel = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]
Color = str | tuple[Channel, Channel, Channel]
"""A colour name (``white``), ``#rrggbb`` or three channels in 0…1."""


class Spec(BaseModel):
    """Base of everything read from YAML: frozen, unknown keys refused."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class ObjectBase(Spec):
    """What every object has, whatever its kind.

    The pose: ``at`` gives the centre's x y (z follows from the support) or x y z; ``on`` names the
    object it stands on (the desk by default), ``inside`` the container (``drawer`` or
    ``drawer.top``). Without ``at``, ``on`` / ``inside`` means the centre of that support.
    """

    at: tuple[Coordinate, Coordinate] | tuple[Coordinate, Coordinate, Coordinate] | None = None
    on: str | None = None
    inside: str | None = None
    yaw_deg: Degrees = 0.0
    quaternion: tuple[Finite, Finite, Finite, Finite] | None = None
    mass: Mass | None = None
    friction: Friction = 0.6
    slippery: bool = False
    """Its friction holds against the gripper pads too (MuJoCo takes the larger of a pair)."""
    rolling_friction: Annotated[float, Field(ge=0.0, le=0.1, allow_inf_nan=False)] | None = None
    color: Color | None = None
    label: str | None = Field(default=None, max_length=60)
    """What people call it ("tennis ball"), for the instruction; default: the name's words."""
    fixed: bool | None = None
    """Fastened to the desk. Default: furniture is, everything else is not."""

    @model_validator(mode="after")
    def _one_support(self) -> ObjectBase:
        if self.on is not None and self.inside is not None:
            raise ValueError("give either 'on' or 'inside', not both")
        if self.at is None and self.on is None and self.inside is None:
            raise ValueError("needs a pose: 'at: [x, y]', 'on: <object>' or 'inside: <container>'")
        return self


class Sphere(ObjectBase):
    kind: Literal["sphere"]
    diameter: SmallLength


class Box(ObjectBase):
    kind: Literal["box"]
    size: tuple[Length, Length, Length]
    """x y z extents."""


class Cylinder(ObjectBase):
    """An upright cylinder."""

    kind: Literal["cylinder"]
    diameter: SmallLength
    height: SmallLength


class Capsule(ObjectBase):
    """A lying capsule, its axis along x turned by ``yaw_deg``; ``length`` is tip to tip."""

    kind: Literal["capsule"]
    diameter: SmallLength
    length: SmallLength


class Pen(ObjectBase):
    """A pointed rod (pen, pencil, marker, stick): it lies along x turned by ``yaw_deg``.

    The point is at +x of its own frame; ``tip_length`` is the length of the cone.
    """

    kind: Literal["pen"]
    diameter: SmallLength
    length: SmallLength
    tip_length: SmallLength = 0.02


class Cup(ObjectBase):
    """A hollow round vessel open at the top; a bowl is a wide low one. Outer sizes."""

    kind: Literal["cup", "bowl"]
    diameter: SmallLength
    """Outer diameter of the rim."""
    height: SmallLength
    wall: SmallLength = 0.003
    floor: SmallLength = 0.004
    foot_diameter: SmallLength | None = None
    """Outer diameter of the foot; narrower than the rim for a conical cup."""


class Handle(Spec):
    """A bar to grip, parallel to the front; width along the bar, depth away from the front."""

    width: SmallLength = 0.08
    depth: SmallLength = 0.035
    thickness: SmallLength = 0.010
    vertical: bool = False


class Drawer(Spec):
    """One drawer of a unit; listed from top to bottom. ``travel`` 0 is a fixed front."""

    name: Name
    travel: Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)] = 0.14
    open: Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)] = 0.0
    """Initial opening in metres."""
    friction_loss: Annotated[float, Field(ge=0.0, le=50.0, allow_inf_nan=False)] = 1.0
    """Sliding friction of the runners in newtons."""
    handle: Handle | None = None

    @model_validator(mode="after")
    def _opening_within_travel(self) -> Drawer:
        if self.open > self.travel:
            raise ValueError(f"open is {self.open} m, but the drawer travels only {self.travel} m")
        return self


class DrawerUnit(ObjectBase):
    """A chest of stacked drawers sliding along its own +x (its front), turned by ``yaw_deg``."""

    kind: Literal["drawer_unit"]
    size: tuple[Length, Length, Length]
    """Depth along the slide, width, height, drawers closed."""
    drawers: Annotated[tuple[Drawer, ...], Field(min_length=1, max_length=6)]
    wall: SmallLength = 0.006
    material: str | None = None

    @model_validator(mode="after")
    def _distinct_names(self) -> DrawerUnit:
        names = [drawer.name for drawer in self.drawers]
        if len(set(names)) != len(names):
            raise ValueError("two drawers of one unit have the same name")
        return self


class Door(Spec):
    """A hinged door in the cabinet's front (+x); ``hinge`` as seen when facing the front."""

    name: Name = "door"
    hinge: Literal["left", "right"] = "left"
    range_deg: Annotated[float, Field(gt=1.0, le=180.0, allow_inf_nan=False)] = 110.0
    open_deg: Annotated[float, Field(ge=0.0, le=180.0, allow_inf_nan=False)] = 0.0
    thickness: SmallLength = 0.02
    friction_loss: Annotated[float, Field(ge=0.0, le=20.0, allow_inf_nan=False)] = 0.2
    """Hinge friction in N m."""
    handle: Handle | None = None

    @model_validator(mode="after")
    def _opening_within_range(self) -> Door:
        if self.open_deg > self.range_deg:
            raise ValueError(
                f"open_deg is {self.open_deg}, but the door opens only {self.range_deg}°"
            )
        return self


class Cabinet(ObjectBase):
    """A box with one hinged door in its front (+x turned by ``yaw_deg``), e.g. a microwave."""

    kind: Literal["cabinet"]
    size: tuple[Length, Length, Length]
    """Depth (front to back), width, height, the door closed."""
    door: Door = Door()
    wall: SmallLength = 0.012


class Shelf(ObjectBase):
    """Open boards between two side walls; boards are named surfaces from bottom to top."""

    kind: Literal["shelf"]
    size: tuple[Length, Length, Length]
    boards: Annotated[tuple[Name, ...], Field(min_length=1, max_length=6)] = ("bottom", "top")
    wall: SmallLength = 0.008


class Mesh(ObjectBase):
    """A free-form object from an OBJ, STL or GLB file, decomposed into convex pieces (CoACD)."""

    kind: Literal["mesh"]
    file: str
    scale: Annotated[float, Field(gt=1e-5, le=1000.0, allow_inf_nan=False)] = 1.0
    hollow: bool = False
    """Open at the top, so things can be put into it."""


class MjcfPart(Spec):
    """A movable part of an object given as MJCF."""

    joint: str
    container_site: str | None = None
    """Box site spanning the free space inside the part."""
    front_site: str | None = None
    """Box site around what a gripper may push, hook or grasp; default: the part's geoms."""


class Mjcf(ObjectBase):
    """An object given as an MJCF file: one body tree, without its own free joint."""

    kind: Literal["mjcf"]
    file: str
    parts: dict[Name, MjcfPart] = Field(default_factory=dict)
    container_site: str | None = None
    surface_site: str | None = None


SceneObject = Annotated[
    Sphere
    | Box
    | Cylinder
    | Capsule
    | Pen
    | Cup
    | DrawerUnit
    | Cabinet
    | Shelf
    | Mesh
    | Mjcf,
    Field(discriminator="kind"),
]

FURNITURE = (DrawerUnit, Cabinet, Shelf)


class Desk(Spec):
    """The table top; ``center`` x y and ``size`` along x and y, ``top`` the height of its surface."""

    size: tuple[Length, Length] = (0.8, 1.2)
    center: tuple[Coordinate, Coordinate] = (0.42, 0.0)
    top: Annotated[float, Field(ge=-0.5, le=1.5, allow_inf_nan=False)] = 0.13
    friction: Friction = 0.6
    color: Color = "wheat"


class Camera(Spec):
    """A pinhole camera: ``position`` and the point it looks at, or ``quaternion`` (OpenCV optical
    frame: x right, y down, z forward) instead of ``look_at``."""

    position: tuple[Coordinate, Coordinate, Coordinate]
    look_at: tuple[Coordinate, Coordinate, Coordinate] | None = None
    quaternion: tuple[Finite, Finite, Finite, Finite] | None = None
    width: Annotated[int, Field(ge=16, le=4096)] = 1280
    height: Annotated[int, Field(ge=16, le=4096)] = 720
    fx: Annotated[float, Field(gt=1, le=20000, allow_inf_nan=False)] = 608.0
    fy: Annotated[float, Field(gt=1, le=20000, allow_inf_nan=False)] = 608.0
    cx: Annotated[float, Field(ge=0, le=8192, allow_inf_nan=False)] = 642.0
    cy: Annotated[float, Field(ge=0, le=8192, allow_inf_nan=False)] = 363.6


class Variation(Spec):
    """How far ``--vary`` moves things: uniform in ± these bounds."""

    position_m: Annotated[float, Field(ge=0.0, le=0.1, allow_inf_nan=False)] = 0.010
    yaw_deg: Annotated[float, Field(ge=0.0, le=180.0, allow_inf_nan=False)] = 10.0
    friction: Annotated[float, Field(ge=0.0, le=0.9, allow_inf_nan=False)] = 0.20
    """Relative."""
    mass: Annotated[float, Field(ge=0.0, le=0.9, allow_inf_nan=False)] = 0.20
    """Relative."""
    keep: tuple[str, ...] = ()
    """Objects whose pose is never varied."""


class Scene(Spec):
    """A whole scene. ``robot`` names a built-in robot or a robot YAML file beside the scene."""

    name: str = "scene"
    description: str = ""
    desk: Desk = Desk()
    robot: str = "xarm6"
    cameras: dict[Name, Camera] = Field(default_factory=dict)
    objects: Annotated[dict[Name, SceneObject], Field(max_length=MAX_OBJECTS)] = Field(
        default_factory=dict
    )
    variation: Variation = Variation()
    directory: str = "."
    """Folder of the scene file, against which mesh, MJCF and robot files are resolved; set by the
    loader, refused in YAML."""

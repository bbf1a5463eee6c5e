"""The kinds of objects that a scene may hold, as validated data.

Lengths in metres, masses in kilograms, angles in degrees (fields say ``_deg``), robot-base frame
(x forward, y left, z up), quaternions w x y z. The models only check what one value can show;
checks that need geometry live in :mod:`etot_cli.specs.checks`.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from etot_cli.specs.base import Color, Name, Position, Quaternion, Spec
from etot_cli.specs.quantity import (
    Degrees,
    Friction,
    Length,
    Mass,
    NewtonMetres,
    Newtons,
    OpeningDegrees,
    RangeDegrees,
    RollingFriction,
    Scale,
    SmallLength,
    Travel,
)


class ObjectBase(Spec):
    """What every object has, whatever its kind.

    One of ``at``, ``on`` and ``inside`` is required. Without ``at``, an object is in the middle of
    what it is on or inside of.
    """

    at: Position | None = None
    """Its centre: x y, where z follows from the support, or x y z."""
    on: str | None = None
    """An object with a flat top, a vessel (in its mouth), or ``shelf.board``; default: the desk."""
    inside: str | None = None
    """A vessel, a cabinet, ``unit.drawer``, or the unit where one drawer moves."""
    yaw_deg: Degrees = 0.0
    quaternion: Quaternion | None = None
    """Full orientation w x y z instead of ``yaw_deg``."""
    mass: Mass | None = None
    """Default: what follows from the material [kg]."""
    friction: Friction = 0.6
    """Coefficient; between two objects the larger one counts."""
    slippery: bool = False
    """Its friction holds as it is against everything, the gripper pads too."""
    rolling_friction: RollingFriction | None = None
    """Coefficient [m], of round things."""
    color: Color | None = None
    """A name, ``'#rrggbb'`` or ``[red, green, blue]`` from 0 to 1."""
    label: str | None = Field(default=None, max_length=60)
    """What people call it ("coffee mug"), for the instruction; default: the name's words."""
    fixed: bool | None = None
    """Fastened to the desk. Default: furniture is, everything else is not."""

    @model_validator(mode="after")
    def _one_support(self) -> ObjectBase:
        if self.on is not None and self.inside is not None:
            raise ValueError("give either 'on' or 'inside', not both")
        if self.at is None and self.on is None and self.inside is None:
            raise ValueError("needs a pose: 'at: [x, y]', 'on: <object>' or 'inside: <container>'")
        if self.quaternion is not None and self.yaw_deg != 0.0:
            raise ValueError("give either 'yaw_deg' or 'quaternion', not both")
        return self


class Sphere(ObjectBase):
    """A ball."""

    kind: Literal["sphere"]
    diameter: SmallLength


class Box(ObjectBase):
    """A solid block."""

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
    """A pointed rod (pen, pencil, marker, stick): it lies along x turned by ``yaw_deg``."""

    kind: Literal["pen"]
    diameter: SmallLength
    length: SmallLength
    tip_length: SmallLength = 0.02
    """Of the cone, whose point is at +x of its own frame."""


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
    """One drawer of a unit; listed from top to bottom."""

    name: Name
    """The drawer is called ``unit.name``."""
    height: SmallLength | None = None
    """Height of its compartment; default: an equal share of what the unit has left."""
    travel: Travel = 0.14
    """Full opening; 0 is a fixed front."""
    open: Travel = 0.0
    """Initial opening in metres."""
    friction_loss: Newtons = 1.0
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

    def compartment_heights(self) -> tuple[float, ...]:
        """Clear height of each drawer's compartment [m], from top to bottom.

        The unit is a case with a roof, a floor and a shelf between drawers, each ``wall`` thick;
        drawers without a ``height`` share what is left equally. Room above a drawer's own floor
        (``wall`` thick too) is therefore ``wall`` less. May be zero or negative when the numbers
        do not fit; the checks of a loaded scene refuse that.
        """
        clear = self.size[2] - self.wall * (len(self.drawers) + 1)
        given = sum(drawer.height for drawer in self.drawers if drawer.height is not None)
        sharing = sum(drawer.height is None for drawer in self.drawers)
        share = (clear - given) / sharing if sharing else 0.0
        return tuple(share if item.height is None else item.height for item in self.drawers)


class Door(Spec):
    """A hinged door in the cabinet's front (+x)."""

    name: Name = "door"
    """The door is called ``cabinet.name``."""
    hinge: Literal["left", "right"] = "left"
    """As seen when facing the front."""
    range_deg: RangeDegrees = 110.0
    """Full opening."""
    open_deg: OpeningDegrees = 0.0
    """Opening at the start."""
    thickness: SmallLength = 0.02
    friction_loss: NewtonMetres = 0.2
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
    """A box with one hinged door in its front (+x turned by ``yaw_deg``), e.g. an oven."""

    kind: Literal["cabinet"]
    size: tuple[Length, Length, Length]
    """Depth (front to back), width, height, the door closed."""
    door: Door = Door()
    wall: SmallLength = 0.012


class Shelf(ObjectBase):
    """Open boards between two side walls."""

    kind: Literal["shelf"]
    size: tuple[Length, Length, Length]
    boards: Annotated[tuple[Name, ...], Field(min_length=1, max_length=6)] = ("bottom", "top")
    """From bottom to top; a board is called ``shelf.name``."""
    wall: SmallLength = 0.008

    @model_validator(mode="after")
    def _distinct_names(self) -> Shelf:
        if len(set(self.boards)) != len(self.boards):
            raise ValueError("two boards of one shelf have the same name")
        return self

    def board_heights(self) -> tuple[float, ...]:
        """Height of each board's upper surface above the shelf's base [m], from bottom to top.

        The lowest board lies on the base, the highest is the shelf's top, the others are evenly
        spaced between; a single board is the top.
        """
        count = len(self.boards)
        if count == 1:
            return (self.size[2],)
        step = (self.size[2] - self.wall) / (count - 1)
        return tuple(self.wall + step * index for index in range(count))


class Mesh(ObjectBase):
    """A free-form object from an OBJ, STL or GLB file, decomposed into convex pieces (CoACD)."""

    kind: Literal["mesh"]
    file: str
    """OBJ, STL or GLB."""
    scale: Scale = 1.0
    """Metres per unit of the file, 0.001 for millimetres."""
    hollow: bool = False
    """Open at the top, so things can be put into it."""


class MjcfPart(Spec):
    """A movable part of an object given as MJCF."""

    joint: str
    """The joint's name in the model."""
    container_site: str | None = None
    """Box site spanning the free space inside the part."""
    front_site: str | None = None
    """Box site around what a gripper may push, hook or grasp; default: the part's geoms."""
    open: Annotated[float, Field(ge=0.0, le=2.0)] | None = None
    """How far a slide is open at the start [m]; default: closed."""
    open_deg: Annotated[float, Field(ge=0.0, le=360.0)] | None = None
    """How far a hinge is open at the start."""


class Mjcf(ObjectBase):
    """An object given as an MJCF file: one body tree, without its own free joint."""

    kind: Literal["mjcf"]
    file: str
    """``.xml`` or ``.mjcf``."""
    parts: dict[Name, MjcfPart] = Field(default_factory=dict)
    container_site: str | None = None
    """Box or cylinder site: the hollow of a vessel without parts."""
    surface_site: str | None = None
    """Box site on whose upper face things can stand."""


SceneObject = Annotated[
    Sphere | Box | Cylinder | Capsule | Pen | Cup | DrawerUnit | Cabinet | Shelf | Mesh | Mjcf,
    Field(discriminator="kind"),
]

ROLLING_DEFAULT = 0.0005
"""Rolling friction of balls on a hard desk [m]: one of 7 cm that rolls at 0.2 m/s stops after
20 cm."""
FURNITURE = (DrawerUnit, Cabinet, Shelf)
"""Kinds that are fastened to the desk unless ``fixed: false``."""


def is_fastened(item: ObjectBase) -> bool:
    """Whether an object does not move: said so, or furniture."""
    return isinstance(item, FURNITURE) if item.fixed is None else item.fixed

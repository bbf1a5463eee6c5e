"""What is known about a world at one moment, free of MuJoCo: data for reasoners and reports."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum

DESK = "desk"
"""Name of the table top as a surface."""
OPEN_AT = 0.75
"""A part counts as open from this share of its travel."""
STAYS_OPEN_AT = 0.65
"""An open part is still open, and things can be put in, down to this share: putting something in
may push it back a little (hysteresis)."""
CLOSED_AT = 0.06
"""A part counts as closed up to this share of its travel."""
ROUND_KINDS = frozenset({"sphere", "cylinder", "cup", "bowl"})
"""Kinds that are the same from all sides as long as they stand."""


def triple(values: Iterable[float]) -> tuple[float, float, float]:
    """Three numbers of an array, as data that anything can store."""
    x, y, z = (float(value) for value in values)
    return x, y, z


def owner_of(address: str) -> str:
    """The object's name in ``object`` or ``object.part``."""
    return address.partition(".")[0]


@dataclass(frozen=True, slots=True)
class PartInfo:
    """A movable part: ``address`` is what actions call it.

    The address is the object's name when it has one movable part, else ``object.part``.
    """

    owner: str
    name: str
    address: str
    joint_type: str
    """``slide`` or ``hinge``."""
    travel: float
    """Full opening [m or rad]."""
    container: bool
    """Things can be put into it (a drawer), through the opening that this part frees."""
    front: bool = False
    """That opening faces sideways, so the hand has to come in level (a cabinet)."""


@dataclass(frozen=True, slots=True)
class ObjectInfo:
    """What does not change about an object."""

    name: str
    kind: str
    label: str
    """Words people use for it, lower case ("white holder")."""
    color: str | None
    """Nearest basic colour word, when it has one."""
    size: tuple[float, float, float]
    """Extents along its own axes in its resting orientation [m]."""
    mass: float
    movable: bool
    """Can be picked up in principle (not furniture, not fastened)."""
    container: bool
    """Has an opening that things go into without opening a part first."""
    surface: bool
    """Has a flat top that things can stand on."""
    elongated: bool
    """A rod that must stand to fit into vessels."""
    parts: tuple[PartInfo, ...] = ()
    boards: tuple[str, ...] = ()
    """Names of further surfaces below its top (a shelf's boards), from bottom to top; an action
    calls one ``object.board``."""
    mouth: float = 0.0
    """Clear width of that opening [m]; 0 where there is none."""
    plain_color: bool = True
    """``color`` is its colour itself, not that of a neighbour (cyan, which has no word here)."""
    foot: float = 0.0
    """Width of a vessel's foot, where that is narrower than its rim [m]; else 0."""
    on: str | None = None
    """What a fastened thing stands on, as its scene has it: no contact tells of that."""
    inside: str | None = None
    """The container that a fastened thing is in, as its scene has it."""

    @property
    def bears(self) -> bool:
        """Things can be put on it: on its top, or across its open mouth as a lid is."""
        return self.surface or self.container


@dataclass(frozen=True, slots=True)
class ObjectState:
    """One object at one moment; base frame."""

    position: tuple[float, float, float]
    quaternion: tuple[float, float, float, float]
    on: tuple[str, ...] = ()
    """What it rests on: objects (``drawer``), parts (``drawer.top``) or ``desk``."""
    inside: str | None = None
    """The container it lies in: an object's name or a part's address."""
    in_hand: bool = False
    toppled: bool = False
    """Leans more than its upright tolerance: from its own z axis where it has a top, else from how
    it stood at the start of the episode."""
    tilt_deg: float = 0.0
    """How far it leans [deg]: 90 where it lies on its side, 180 where it stands on its head."""
    lost: bool = False
    """Off the desk."""
    reachable: bool = True
    """Within the arm's workspace."""
    openness: Mapping[str, float] = field(default_factory=dict)
    """Opening of each part by part name, 0 closed … 1 fully open."""
    opened: Mapping[str, bool] = field(default_factory=dict)
    """Open or closed with hysteresis, by part name."""


@dataclass(frozen=True, slots=True)
class SceneState:
    """All objects at one moment. ``infos`` and ``states`` have the same keys, in scene order."""

    infos: Mapping[str, ObjectInfo]
    states: Mapping[str, ObjectState]
    desk_top: float = 0.0
    desk_bounds: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    """x min, x max, y min, y max [m]."""
    holding: str | None = None
    forward: tuple[float, float] = (1.0, 0.0)
    """Unit direction, seen from above, in which the one looks whose left and right are meant: the
    robot's +x, or a camera's when the scene names it as the viewpoint."""

    def part(self, address: str) -> PartInfo | None:
        """The movable part that an action's target means, by address or ``object.part``."""
        for info in self.infos.values():
            for part in info.parts:
                if address in (part.address, f"{part.owner}.{part.name}"):
                    return part
        return None

    def supports(self, name: str) -> tuple[str, ...]:
        """What an object rests on, or stands on for good where it is fastened."""
        state, info = self.states[name], self.infos[name]
        return state.on if state.on or info.on is None else (info.on,)

    def container(self, name: str) -> str | None:
        """The container that an object lies in, or is in for good where it is fastened."""
        return self.states[name].inside or self.infos[name].inside

    def openness(self, part: PartInfo) -> float:
        """How far a part is open, 0…1."""
        return self.states[part.owner].openness[part.name]


class CauseKind(StrEnum):
    """Physical causes of failure."""

    NO_GRASP = "no_grasp"
    """No grasp exists for this gripper (too wide, covered, no free approach)."""
    UNREACHABLE = "unreachable"
    """The arm cannot get there."""
    NO_ROOM = "no_room"
    """No free, stable, reachable spot, or no room inside the container."""
    COLLISION = "collision"
    """The robot or what it moved struck an object and displaced it."""
    BLOCKED = "blocked"
    """A joint or the hand could not go on because objects were in the way."""
    SLIP = "slip"
    """The object slipped out of the fingers."""
    TOPPLED = "toppled"
    """An object fell over."""
    LOST = "lost"
    """An object left the desk."""
    STRANDED = "stranded"
    """An object came to rest out of the arm's reach."""
    REBOUND = "rebound"
    """The object did not stay where it was released."""
    NO_EFFECT = "no_effect"
    """The motion ran but its effect does not hold."""
    PRECONDITION = "precondition"
    """The action makes no sense here (hand full, not articulated, …)."""
    ABANDONED = "abandoned"
    """No physical cause: the simulation came to no end (its process was killed, no memory)."""


@dataclass(frozen=True, slots=True)
class Cause:
    """Why an action failed: the record that reflection, report and person read.

    ``objects``: the objects to blame, most important first (what blocks, what toppled, what was
    struck); never the robot.
    """

    kind: CauseKind
    objects: tuple[str, ...]
    text: str
    time_s: float | None = None
    """Simulated time within the action, when there was one."""
    lasting: bool = False
    """It lies in the object: elsewhere, at another time, or held otherwise, it is the same."""


@dataclass(frozen=True, slots=True)
class ContactEvent:
    """A contact that matters: two bodies that did not touch before the action, or a blocking one.

    ``first`` / ``second`` are object names, ``object.part``, ``robot``, ``gripper`` or ``desk``.
    """

    time_s: float
    first: str
    second: str
    peak_force: float
    """Largest normal force seen [N]."""
    impulse: float
    """Integral of the normal force over the action [N s]."""


@dataclass(frozen=True, slots=True)
class Swept:
    """The disc of the desk plane that something moved through: centre x, y and radius [m]."""

    name: str
    x: float
    y: float
    radius: float


@dataclass(frozen=True, slots=True)
class RolloutRecord:
    """What happened during one action, ready for reasoners and reports."""

    before: SceneState
    after: SceneState
    effect: bool
    """The motion ran to its end and the skill saw its own effect (object held, part moved, …)."""
    cause: Cause | None
    """The skill's own account of why it stopped short, when it did."""
    contacts: tuple[ContactEvent, ...] = ()
    displacement: Mapping[str, float] = field(default_factory=dict)
    """Largest displacement of each object during the action [m]."""
    swept: tuple[Swept, ...] = ()
    """Discs through which parts and displaced objects moved."""
    simulated_s: float = 0.0
    steps: int = 0
    watched: bool = True
    """Whether contacts and ways were recorded all along; a look before and one after tell of none,
    so that no account of how things came about can be given."""

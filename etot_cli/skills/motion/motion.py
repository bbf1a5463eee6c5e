"""A motion: what a robot is told to do for one action, as plain data.

Whoever plans a motion does not run it. A motion is a list of phases between guards; the guards look
at what a robot can sense (its joints, the effort it takes, the opening of its gripper), never at
the pose of an object. Source: paper, section "Action Skills Set".
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from etot_cli.world.arrays import Vector
from etot_cli.world.pose import Pose
from etot_cli.world.state import owner_of


class PhaseEnd(StrEnum):
    """How a phase ended."""

    DONE = "done"
    BLOCKED = "blocked"
    """The joints no longer followed: something was in the way."""
    MISSED = "missed"
    """The fingers closed and met nothing of the width they were meant for."""
    SLIPPED = "slipped"
    """The fingers closed further while they held something: it is gone."""
    OUT_OF_TIME = "out_of_time"
    """The action has used up its time."""


@dataclass(frozen=True)
class Move:
    """The arm along a joint path.

    Args:
        name: what the move is for (``transit``, ``approach``, ``lift``, …).
        path: (k, n) joint values [rad], the robot's present ones left out.
        length: of the tool's way [m], or (k,) of its part up to each waypoint, where each has to
            keep to the speed; None for a free path in joint space.
        tool_speed: along that way [m/s]; None with a free path, which has the robot's own speed.
        opening: set between the pads as the move begins [m]; None leaves the gripper as it is.
        holding: ends as slipped when the opening falls below this [m]; None with an empty hand.
        may_block: being stopped is no failure: the motion goes on with what follows.
        exits: for each waypoint the way (m, n) out of there, should the move be stopped; the next
            move takes it.
        dwell: time to hold still at the end [s].
    """

    name: str
    path: Vector
    length: float | Vector | None = None
    tool_speed: float | None = None
    opening: float | None = None
    holding: float | None = None
    may_block: bool = False
    exits: tuple[Vector, ...] = ()
    dwell: float = 0.0


GRIP_TIME, RELEASE_TIME = 0.45, 0.35
"""Times for the fingers to close and a grasp to settle, and for them to open [s]."""


@dataclass(frozen=True)
class Hand:
    """The gripper moves while the arm holds still.

    Args:
        name: ``grip`` or ``release``.
        opening: distance between the pads that it is sent to [m].
        seconds: time that it takes [s].
        holding: ends as missed when the opening is below this afterwards [m]; None for any.
    """

    name: str
    opening: float
    seconds: float
    holding: float | None = None


@dataclass(frozen=True)
class Wait:
    """Nothing is commanded.

    Args:
        name: ``hold`` or ``rest``.
        seconds: at most so long [s].
        until_rest: a robot that sees its surroundings at rest may go on earlier.
        holding: ends as slipped when the opening falls below this [m].
    """

    name: str
    seconds: float
    until_rest: bool = False
    holding: float | None = None


Phase = Move | Hand | Wait

SETTLE = "settle"
"""Name of the wait after a phase that failed."""


@dataclass(frozen=True)
class FramedPose:
    """A pose in the frame of something: ``frame`` is an object, a part or ``base``.

    ``position`` (x, y, z) [m], ``quaternion`` (w, x, y, z).
    """

    frame: str
    position: tuple[float, float, float]
    quaternion: tuple[float, float, float, float]

    @property
    def pose(self) -> Pose:
        """The same in the frame's own coordinates."""
        return Pose.of(self.position, self.quaternion)


def framed(frame: str, origin: Pose, pose: Pose) -> FramedPose:
    """A base-frame pose in the frame called so, which now is at ``origin``."""
    local = origin.inverse() @ pose
    x, y, z = (round(float(value), 6) for value in local.position)
    w, i, j, k = (round(float(value), 6) for value in local.quaternion)
    return FramedPose(frame, (x, y, z), (w, i, j, k))


@dataclass(frozen=True)
class Motion:
    """Everything a robot needs for one action.

    Args:
        action: as written in a plan.
        phases: in order.
        tool_at: the tool pose that the motion is about (at the grasp, at the release, at the first
            contact with a part), in the frame of the object or part concerned: what stays right
            when that object stands a little elsewhere.
        object_at: where the held object is let go, in the frame of what it is put on or into.
        details: figures for the report (width, friction needed, …) in SI units.
    """

    action: str
    phases: tuple[Phase, ...]
    tool_at: FramedPose | None = None
    object_at: FramedPose | None = None
    details: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Press:
    """A contact at the moment when a phase was stopped: two addresses, and the part of the normal
    force that acts sideways rather than up or down [N].
    """

    first: str
    second: str
    sideways: float


@dataclass(frozen=True)
class PhaseTrace:
    """What became of a phase.

    ``start_s`` and ``end_s``: time within the action [s]; ``opening``: sensed at its end [m];
    ``joints``: sensed at its end (n,) [rad]; ``command``: opening that the gripper was sent to as
    the phase began [m], None for none; ``targets``: the joint targets sent, (m, n) at the control
    period, None without any; ``waited_s``: time held still after them [s]; ``holding``: the phase's
    guard, an opening below which what was held is gone [m], None for none.

    ``touching`` and ``presses`` say who was in contact when a phase was stopped or a move that may
    be stopped came to its end; only a simulated robot knows. They serve the account of a failure;
    no guard looks at them.
    """

    name: str
    end: PhaseEnd
    start_s: float
    end_s: float
    opening: float
    joints: tuple[float, ...]
    command: float | None = None
    targets: Vector | None = None
    waited_s: float = 0.0
    holding: float | None = None
    touching: tuple[str, ...] = ()
    presses: tuple[Press, ...] = ()


@dataclass(frozen=True)
class Trace:
    """What became of a motion."""

    phases: tuple[PhaseTrace, ...]

    @property
    def seconds(self) -> float:
        """Time that the motion took, without what came to rest after a failure [s]."""
        return max((item.end_s for item in self.phases if item.name != SETTLE), default=0.0)

    def phase(self, name: str) -> PhaseTrace | None:
        """The last phase of that name; None where it was not reached."""
        return next((item for item in reversed(self.phases) if item.name == name), None)

    @property
    def stopped(self) -> PhaseTrace | None:
        """The first phase that did not run to its end."""
        return next((item for item in self.phases if item.end is not PhaseEnd.DONE), None)

    def against(self, held: str | None = None) -> tuple[str, ...]:
        """Addresses of what the robot, or what it holds, was pressed on by when that phase was
        stopped: what touches the robot first, then the hardest pressed first.
        """
        phase = self.stopped
        if phase is None:
            return ()
        own = {"robot", "gripper", held}
        force: dict[str, float] = dict.fromkeys(phase.touching, math.inf)
        for press in phase.presses:
            for one, other in ((press.first, press.second), (press.second, press.first)):
                if owner_of(one) in own:
                    force[other] = force.get(other, 0.0) + press.sideways
        ranked = sorted(force, key=lambda address: -force[address])
        return tuple(address for address in ranked if owner_of(address) not in own)

    @property
    def touching(self) -> tuple[str, ...]:
        """Objects at the robot when that phase was stopped."""
        return () if self.stopped is None else self.stopped.touching

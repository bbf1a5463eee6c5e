"""What the search needs of a physics world: start states, and actions tried from stored states.

Plain data and one protocol, free of MuJoCo: planning sees the world only through it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Protocol

from etot_cli.skills.action import Action
from etot_cli.skills.deadline import NEVER
from etot_cli.world.state import RolloutRecord, SceneState

StateToken = bytes
"""An opaque stored end state of the world(s); bit-exact, picklable."""


@dataclass(frozen=True, slots=True)
class WorldOutcome:
    """One world's account of an action.

    ``trajectory``: opaque decimated trajectory for later rendering (picklable), or None.
    ``motion`` and ``trace``: what the robot was told and what became of it, opaque here; None where
    nothing was tried. ``model_digest`` and ``end_digest``: SHA-256 of the world's model and of its
    physics state afterwards.
    """

    record: RolloutRecord
    trajectory: object | None = None
    motion: object | None = None
    trace: object | None = None
    model_digest: str = ""
    end_digest: str = ""


@dataclass(frozen=True, slots=True)
class Simulated:
    """An action stepped from a stored state, in one world or several varied ones.

    ``outcomes[0]`` is the nominal world (the task's own parameters); ``end`` restores all worlds.
    """

    outcomes: Sequence[WorldOutcome]
    end: StateToken
    wall_s: float
    physics_s: float = 0.0
    """Of the processes' time, all worlds together: stepping [s]."""
    kinematics_s: float = 0.0
    """The same: looking for grasps, places and ways [s]."""


@dataclass(frozen=True, slots=True)
class Step:
    """An action, and the motion that brought it about in the twin, opaque here."""

    action: Action
    motion: object | None


@dataclass(frozen=True, slots=True)
class Course:
    """What became of a plan in one world, up to the first action without its effect.

    ``start``: the scene before; None where the world was lost with its process.
    """

    start: SceneState | None
    records: tuple[RolloutRecord, ...]

    @property
    def final(self) -> SceneState | None:
        """The scene in the end."""
        return self.records[-1].after if self.records else self.start


class Trials(Protocol):
    """Varied worlds in which whole plans are carried out."""

    def carry_out(self, plan: Sequence[Step], until_s: float = NEVER) -> Iterator[Course]:
        """Carries a plan out in every world; what became of it there, world by world.

        Raises:
            OutOfTimeError: not done at ``until_s``, a reading of ``time.monotonic`` [s].
        """
        ...

    def close(self) -> None:
        """Ends workers; idempotent."""
        ...


class Simulator(Protocol):
    """Runs actions from stored states; results depend on nothing but their arguments."""

    @property
    def jobs(self) -> int:
        """How many submissions run at the same time."""
        ...

    @property
    def world_count(self) -> int:
        """Number of varied worlds in each state (``--worlds``)."""
        ...

    def start(self, until_s: float = NEVER) -> tuple[StateToken, SceneState]:
        """The settled initial state and the nominal world's view of it.

        Raises:
            OutOfTimeError: not ready at ``until_s``, a reading of ``time.monotonic`` [s].
        """
        ...

    def submit(
        self, state: StateToken, action: Action, until_s: float = NEVER
    ) -> Future[Simulated]:
        """Tries ``action`` from ``state``; never raises for a physical failure.

        What is not done at ``until_s``, a reading of ``time.monotonic`` [s], is abandoned: the
        future then raises OutOfTimeError.
        """
        ...

    def close(self) -> None:
        """Ends workers; idempotent."""
        ...

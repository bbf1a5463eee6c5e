"""Watches a world while it is stepped: contacts, displacements, and a decimated trajectory."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.world.model import World
from etot_cli.world.state import ContactEvent, Swept, owner_of

FRAME_PERIOD = 0.04
"""Time between stored configurations [s]."""
MOVED = 0.01
"""Objects displaced further than this count as having moved [m]."""
TRAIL_STEP = 0.05
"""Spacing of the points that an object's way is remembered by [m]."""
MAX_TRAIL = 24
"""Points of a way that are told: more than a metre of it."""
PRESSED = 2.0
"""A contact that existed before the action matters only when it is pressed harder than this [N]."""
FORCE_THRESHOLD = 0.05
"""Normal forces below this do not matter [N]: the weight of 5 g."""


@dataclass(frozen=True)
class Trajectory:
    """Configurations for later rendering: ``times`` (k,) [s] and ``qpos`` (k, nq), float32."""

    times: NDArray[np.float32]
    qpos: NDArray[np.float32]
    key_times: tuple[float, ...] = ()
    """Moments worth a picture, in seconds."""

    @property
    def elapsed(self) -> NDArray[np.float32]:
        """Times (k,) since the first of them [s]."""
        return np.asarray(self.times - self.times[0])

    @property
    def seconds(self) -> float:
        """From the first configuration to the last [s]."""
        return float(self.elapsed[-1])

    def row_at(self, time_s: float) -> int:
        """The row next to a moment since the first of them [s]."""
        return int(np.argmin(np.abs(self.elapsed - time_s)))

    def followed_by(self, other: Trajectory, after_s: float) -> Trajectory:
        """This one and another that began ``after_s`` [s] later."""
        return Trajectory(
            np.concatenate([self.times, other.times]),
            np.concatenate([self.qpos, other.qpos]),
            (*self.key_times, *(moment + after_s for moment in other.key_times)),
        )


class _Contacts(NamedTuple):
    """Contacts (k,) at one observation: geoms (k, 2), rows of constraints, normal forces [N]; rows
    are negative where a contact bears nothing.
    """

    observation: int
    geoms: NDArray[np.int64]
    rows: NDArray[np.int64]
    forces: NDArray[np.float64]


class Recorder:
    """Collects what happens during one action. Call :meth:`observe` at a fixed period.

    While it is stepped only notes are taken; what they say is worked out when it is asked for.
    """

    def __init__(self, world: World, data: mujoco.MjData, *, keep_frames: bool = True) -> None:
        self._world = world
        self._names = list(world.entries)
        self._free = np.array([world.entries[name].free for name in self._names])
        self._bodies = np.array(
            [world.model.body(world.entries[name].body).id for name in self._names], dtype=np.int64
        )
        self._labels = sorted(set(world.geom_address))
        number = {label: index for index, label in enumerate(self._labels)}
        self._geom_label = np.array([number[label] for label in world.geom_address])
        self.start_time = float(data.time)
        self._moments = [self.start_time]
        self._positions = [data.xpos[self._bodies]]
        self._contacts: list[_Contacts] = []
        self._keep_frames = keep_frames
        self._times: list[float] = []
        self._frames: list[NDArray[np.float32]] = []
        self._baseline = set(self._pairs(data.contact.geom).tolist()) if data.ncon else set()
        self._frame(data)

    def _pairs(self, geoms: NDArray[np.int64]) -> NDArray[np.int64]:
        """One number (k,) for the two labels of each contact of geoms (k, 2)."""
        labels = self._geom_label[geoms]
        return np.asarray(labels.min(axis=1) * len(self._labels) + labels.max(axis=1))

    def observe(self, data: mujoco.MjData) -> None:
        """Takes note of the current contacts and positions."""
        now = float(data.time)
        if data.ncon and data.nefc:
            contact = data.contact
            rows = contact.efc_address.copy()
            self._contacts.append(
                _Contacts(len(self._moments), contact.geom.copy(), rows, data.efc_force.take(rows))
            )
        self._moments.append(now)
        self._positions.append(data.xpos.take(self._bodies, axis=0))
        if self._keep_frames and now - self._times[-1] >= FRAME_PERIOD - 1e-6:
            self._frame(data)

    def _frame(self, data: mujoco.MjData) -> None:
        self._times.append(float(data.time))
        self._frames.append(data.qpos.astype(np.float32))

    def contacts(self) -> tuple[ContactEvent, ...]:
        """Contacts that began during the action or pressed notably, in order of time."""
        if not self._contacts:
            return ()
        seen = np.repeat(
            [item.observation for item in self._contacts],
            [len(item.rows) for item in self._contacts],
        )
        pairs = self._pairs(np.concatenate([item.geoms for item in self._contacts]))
        rows = np.concatenate([item.rows for item in self._contacts])
        forces = np.concatenate([item.forces for item in self._contacts])
        # What belongs to one pair at one moment is one contact.
        count = len(self._labels) ** 2
        keys, index = np.unique(seen * count + pairs, return_inverse=True)
        total = np.bincount(index, weights=np.where(rows < 0, 0.0, forces))
        pressed = total >= FORCE_THRESHOLD
        total, (when, pairs) = total[pressed], np.divmod(keys[pressed], count)
        elapsed = np.diff(self._moments)[when - 1]
        events = []
        for pair in np.unique(pairs):
            first, second = (self._labels[label] for label in divmod(int(pair), len(self._labels)))
            own = pairs == pair
            peak = float(total[own].max())
            if owner_of(first) == owner_of(second) or (pair in self._baseline and peak < PRESSED):
                continue
            began = self._moments[when[own][0]] - self.start_time
            impulse = float((total[own] * elapsed[own]).sum())
            events.append(
                ContactEvent(round(began, 3), first, second, round(peak, 3), round(impulse, 4))
            )
        return tuple(sorted(events, key=lambda event: (event.time_s, event.first, event.second)))

    def _farthest(self) -> NDArray[np.float64]:
        """Largest distance of each object from where it was (n,) [m]."""
        offset = np.array(self._positions) - self._positions[0]
        return np.asarray(np.sqrt(np.vecdot(offset, offset).max(axis=0)))

    def displacement(self) -> dict[str, float]:
        """Largest distance of each free object from where it was [m]."""
        farthest = self._farthest()
        return {
            name: round(float(farthest[i]), 5)
            for i, name in enumerate(self._names)
            if self._free[i]
        }

    def swept(self, held: str | None = None) -> tuple[Swept, ...]:
        """Discs along the ways of displaced objects over the desk, ``held`` excepted."""
        discs = []
        for index, (name, farthest) in enumerate(zip(self._names, self._farthest(), strict=True)):
            if not self._free[index] or name == held or farthest < MOVED:
                continue
            own = max(self._world.entries[name].info.size[:2]) / 2
            for x, y in self._trail(index):
                discs.append(Swept(name, round(x, 4), round(y, 4), round(own, 4)))
        return tuple(discs)

    def _trail(self, index: int) -> list[tuple[float, float]]:
        """Points of an object's way over the desk, from its start."""
        way = np.array([positions[index] for positions in self._positions])
        trail, here = [(float(way[0][0]), float(way[0][1]))], 0
        while len(trail) < MAX_TRAIL:
            offset = way[here:] - way[here]
            strayed = np.flatnonzero(np.vecdot(offset, offset) > TRAIL_STEP**2)
            if not len(strayed):
                break
            here += int(strayed[0])
            if way[here][2] > self._world.scene.desk.top:
                trail.append((float(way[here][0]), float(way[here][1])))
        return trail

    def trajectory(self, key_times: Iterable[float] = ()) -> Trajectory | None:
        """The stored configurations, or None when none were kept.

        ``key_times``: moments worth a picture, since the start [s].
        """
        if not self._keep_frames:
            return None
        return Trajectory(
            np.array(self._times, dtype=np.float32),
            np.array(self._frames, dtype=np.float32),
            tuple(key_times),
        )

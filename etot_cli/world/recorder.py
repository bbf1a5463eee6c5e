"""Watches a world while it is stepped: contacts, displacements, and a decimated trajectory."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

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
"""Normal forces below this do not matter [N]."""


@dataclass(frozen=True)
class Trajectory:
    """Configurations for later rendering: ``times`` (k,) [s] and ``qpos`` (k, nq), float32."""

    times: NDArray[np.float32]
    qpos: NDArray[np.float32]
    key_times: tuple[float, ...] = ()
    """Moments worth a picture, in seconds."""

    def followed_by(self, other: Trajectory, after_s: float) -> Trajectory:
        """This one and another that began ``after_s`` [s] later."""
        return Trajectory(
            np.concatenate([self.times, other.times]),
            np.concatenate([self.qpos, other.qpos]),
            (*self.key_times, *(moment + after_s for moment in other.key_times)),
        )


class Recorder:
    """Collects what happens during one action. Call :meth:`observe` at a fixed period."""

    def __init__(self, world: World, data: mujoco.MjData, *, keep_frames: bool = True) -> None:
        self._world = world
        self._names = list(world.entries)
        self._free = np.array([world.entries[name].free for name in self._names])
        self._bodies = np.array(
            [world.model.body(world.entries[name].body).id for name in self._names], dtype=np.int64
        )
        owners = sorted(set(world.geom_address))
        self._labels = owners
        self._geom_label = np.array([owners.index(label) for label in world.geom_address])
        object_of = {label: owner_of(label) for label in owners}
        names = sorted(set(object_of.values()))
        self._label_object = np.array([names.index(object_of[label]) for label in owners])
        self.start_time = float(data.time)
        self._last_time = self.start_time
        self._origin = data.xpos[self._bodies].copy()
        self._farthest_squared = np.zeros(len(self._names))
        self._trail_end = self._origin.copy()
        self._trails = [[(float(x), float(y))] for x, y, _ in self._origin]
        self._peak = np.zeros(len(owners) ** 2)
        self._impulse = np.zeros(len(owners) ** 2)
        self._first_time = np.zeros(len(owners) ** 2)
        self._keep_frames = keep_frames
        self._times: list[float] = []
        self._frames: list[NDArray[np.float32]] = []
        self._baseline = self._touching(data)
        self._frame(data)

    def _touching(self, data: mujoco.MjData) -> set[int]:
        if data.ncon == 0:
            return set()
        pairs = self._pairs(data)
        return {int(pair) for pair in pairs}

    def _pairs(self, data: mujoco.MjData) -> NDArray[np.int64]:
        labels = self._geom_label[data.contact.geom]
        labels.sort(axis=1)
        return np.asarray(labels[:, 0] * len(self._labels) + labels[:, 1])

    def observe(self, data: mujoco.MjData) -> None:
        """Takes note of the current contacts and positions."""
        now = float(data.time)
        elapsed, self._last_time = now - self._last_time, now
        if data.ncon and data.nefc:
            self._observe_contacts(data, now, elapsed)
        positions = data.xpos[self._bodies]
        offset = positions - self._origin
        np.maximum(self._farthest_squared, np.vecdot(offset, offset), out=self._farthest_squared)
        offset = positions - self._trail_end
        strayed = np.vecdot(offset, offset) > TRAIL_STEP**2
        if strayed.any():
            self._extend_trails(positions, strayed)
        if self._keep_frames and (not self._times or now - self._times[-1] >= FRAME_PERIOD - 1e-6):
            self._frame(data)

    def _extend_trails(self, positions: NDArray[np.float64], strayed: NDArray[np.bool_]) -> None:
        desk_top = self._world.scene.desk.top
        for index in np.nonzero(strayed)[0]:
            self._trail_end[index] = positions[index]
            if positions[index][2] > desk_top:
                self._trails[index].append((float(positions[index][0]), float(positions[index][1])))

    def _observe_contacts(self, data: mujoco.MjData, now: float, elapsed: float) -> None:
        contact = data.contact
        address = contact.efc_address
        force = data.efc_force[address]
        force[address < 0] = 0.0
        labels = self._geom_label[contact.geom]
        first, second = labels[:, 0], labels[:, 1]
        pairs = np.minimum(first, second) * len(self._labels) + np.maximum(first, second)
        total = np.bincount(pairs, weights=force, minlength=self._peak.size)
        # Few of all pairs touch at a time.
        pressed = np.flatnonzero(total >= FORCE_THRESHOLD)
        total, peak = total[pressed], self._peak[pressed]
        self._first_time[pressed[peak == 0.0]] = now - self.start_time
        self._peak[pressed] = np.maximum(peak, total)
        self._impulse[pressed] += total * elapsed

    def _frame(self, data: mujoco.MjData) -> None:
        self._times.append(float(data.time))
        self._frames.append(data.qpos.astype(np.float32))

    def contacts(self) -> tuple[ContactEvent, ...]:
        """Contacts that began during the action or pressed notably, in order of time."""
        events = []
        for pair in np.nonzero(self._peak)[0]:
            first, second = divmod(int(pair), len(self._labels))
            if self._label_object[first] == self._label_object[second]:
                continue
            peak = float(self._peak[pair])
            if int(pair) in self._baseline and peak < PRESSED:
                continue
            events.append(
                ContactEvent(
                    round(float(self._first_time[pair]), 3),
                    self._labels[first],
                    self._labels[second],
                    round(peak, 3),
                    round(float(self._impulse[pair]), 4),
                )
            )
        return tuple(sorted(events, key=lambda event: (event.time_s, event.first, event.second)))

    @property
    def _farthest(self) -> NDArray[np.float64]:
        return np.sqrt(self._farthest_squared)

    def displacement(self) -> dict[str, float]:
        """Largest distance of each free object from where it was [m]."""
        return {
            name: round(float(self._farthest[i]), 5)
            for i, name in enumerate(self._names)
            if self._free[i]
        }

    def swept(self, held: str | None = None) -> tuple[Swept, ...]:
        """Discs along the ways of displaced objects over the desk, ``held`` excepted."""
        discs = []
        for index, name in enumerate(self._names):
            if not self._free[index] or name == held or self._farthest[index] < MOVED:
                continue
            own = max(self._world.entries[name].info.size[:2]) / 2
            for x, y in self._trails[index][:MAX_TRAIL]:
                discs.append(Swept(name, round(x, 4), round(y, 4), round(own, 4)))
        return tuple(discs)

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

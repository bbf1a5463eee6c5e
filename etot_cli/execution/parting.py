"""Where the world went another way than its twin did with the same motion."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from etot_cli.execution.differences import MOVED, PART_MOVED
from etot_cli.execution.records import Parted
from etot_cli.world.model import World
from etot_cli.world.recorder import Trajectory


def parting(
    world: World, happened: Trajectory, twin: World, foreseen: Trajectory, begun_s: float
) -> Parted | None:
    """The first object that parted for good from what was foreseen; None where all stayed together.

    What was apart for a while, as a hand is that follows a little later, has not parted. Ways count
    from the motion's start, so that where an object was wrongly seen does not.

    Args:
        world: what ``happened`` was recorded in.
        happened: the motion there.
        twin: what ``foreseen`` was recorded in.
        foreseen: the same motion there.
        begun_s: the robot's time at the motion's start [s].
    """
    mine, theirs = happened.elapsed, foreseen.elapsed
    times = np.union1d(mine, theirs)
    found: list[Parted] = []

    def compare(name: str, joint: str, limit: float, told: str, unit: float) -> None:
        apart = np.linalg.norm(
            _way(world, happened, mine, joint, times) - _way(twin, foreseen, theirs, joint, times),
            axis=1,
        )
        if apart[-1] > limit:
            # The first moment after which they never were together again.
            together = np.flatnonzero(apart <= limit)
            moment = times[together[-1] + 1 if len(together) else 0]
            text = told.format(apart[-1] * unit)
            found.append(Parted(name, text, round(begun_s + float(moment), 4)))

    for name, entry in twin.entries.items():
        if name not in world.entries:
            continue
        if entry.free:
            compare(name, name, MOVED, "ends {:.0f} cm from where the twin had it", 100.0)
        for part in entry.parts:
            travel = abs(part.upper - part.lower)
            told = f"ends with its {part.info.name} {{:.0f}} % of its travel from the twin's"
            compare(name, part.joint, PART_MOVED * travel, told, 100.0 / travel)
    return min(found, key=lambda item: item.time_s, default=None)


def _way(
    world: World, trajectory: Trajectory, times: NDArray[np.float32], joint: str,
    wanted: NDArray[np.float32],
) -> NDArray[np.float64]:  # fmt: skip
    """How far a joint has come since the start, at every wanted time; it stays where it ended.

    Of a free joint the place (n, 3) [m], else its value (n, 1).
    """
    found = world.model.joint(joint)
    start = int(found.qposadr[0])
    columns = slice(start, start + (3 if len(found.qpos0) == 7 else 1))
    rows = np.clip(np.searchsorted(times, wanted, side="right") - 1, 0, len(times) - 1)
    values = trajectory.qpos[:, columns].astype(np.float64)
    return np.asarray(values[rows] - values[0])

"""What is looked at: the configurations of several actions as one row of moments."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from etot_cli.world.recorder import Trajectory

RATE_HZ = 25.0
"""Moments per second, as often as trajectories are recorded."""


@dataclass(frozen=True, slots=True)
class Reel:
    """Moments at :data:`RATE_HZ`: ``qpos`` (n, nq), and for each the number of its action (n,).

    ``captions``: one per action.
    """

    qpos: NDArray[np.float64]
    action: NDArray[np.int64]
    captions: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.qpos)

    def caption(self, moment: int) -> str:
        """Of the action that a moment belongs to."""
        return self.captions[int(self.action[moment])]


def reel_of(actions: Sequence[tuple[str, Trajectory]]) -> Reel:
    """All actions, one after the other, at even distances in time.

    Args:
        actions: caption and trajectory, none of them empty.
    """
    rows, numbers = [], []
    for number, (_, trajectory) in enumerate(actions):
        times = np.asarray(trajectory.times, dtype=np.float64) - float(trajectory.times[0])
        wanted = np.append(np.arange(0.0, times[-1], 1.0 / RATE_HZ), times[-1])  # the end counts
        nearest = np.clip(np.searchsorted(times, wanted - 0.5 / RATE_HZ), 0, len(times) - 1)
        rows.append(np.asarray(trajectory.qpos, dtype=np.float64)[nearest])
        numbers.append(np.full(len(nearest), number))
    return Reel(
        np.concatenate(rows), np.concatenate(numbers), tuple(caption for caption, _ in actions)
    )

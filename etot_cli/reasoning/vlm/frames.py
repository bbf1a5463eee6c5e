"""Which moments a model gets to see, and the marks on its pictures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reasoning.vlm.chat import Picture
from etot_cli.world.state import RolloutRecord, SceneState, owner_of

APART_S = 0.25
"""Moments nearer to each other show the same thing [s]."""
AFTERMATH_S = 0.2
"""A contact is best seen when its effect begins to show [s]."""
SMALLEST_MARKED = 12
"""Objects of which less is visible get no mark [px]."""


@dataclass(frozen=True, slots=True)
class Eye:
    """A camera: ``position`` [m] and unit vectors to the right, up and ahead of it; base frame."""

    position: tuple[float, float, float]
    right: tuple[float, float, float]
    up: tuple[float, float, float]
    ahead: tuple[float, float, float]


class FrameSource(Protocol):
    """Where pictures come from: a renderer, or the camera of a robot."""

    def view(self, scene: SceneState, *, marks: bool = False) -> Sequence[Picture]:
        """The desk as it is; empty when no picture can be had."""
        ...

    def rollout(
        self, record: RolloutRecord, count: int, *, marks: bool = False, hints: bool = True
    ) -> Sequence[Picture]:
        """Before an action, its key moments, and after it: ``count`` pictures at most.

        Of an action that never began there is only the picture before. Empty for a record of
        which no pictures exist. Without ``hints`` neither the choice of moments nor their captions
        tell what the record knows of contacts and causes.
        """
        ...

    def marks(self, scene: SceneState) -> Mapping[int, str]:
        """Numbers drawn on pictures with marks, and what they stand for.

        A thing has the same number in every scene of a run.
        """
        ...

    def eye(self, scene: SceneState) -> Eye | None:
        """Where the pictures are taken from; None where that is not known."""
        ...


def moments(
    record: RolloutRecord,
    key_times: Sequence[float],
    duration: float,
    count: int,
    *,
    hints: bool = True,
) -> list[tuple[float, str]]:
    """Moments between start and end of an action that tell most, as (time [s], what happens).

    The failure itself comes first, then contacts with the objects to blame or displaced, the
    hardest first, then the skill's own phases. In order of time. Without ``hints`` the skill's
    phases alone, and where these are too few, even distances.
    """
    wanted: list[tuple[float, str]] = []
    if not hints:
        record = replace(record, cause=None, contacts=())
    cause = record.cause
    blamed = set(cause.objects) if cause is not None else set()
    blamed |= {name for name, way in record.displacement.items() if way > 0.03}
    if cause is not None and cause.time_s is not None:
        wanted.append((cause.time_s, cause.kind.value.replace("_", " ")))
    touching = [
        event
        for event in record.contacts
        if {owner_of(event.first), owner_of(event.second)} & blamed
    ]
    touching.sort(key=lambda event: (-event.impulse, event.time_s))
    wanted += [
        (event.time_s + AFTERMATH_S, f"{event.first} touches {event.second}") for event in touching
    ]
    wanted += [(time, "the gripper acts") for time in key_times]
    if not hints:
        wanted += [(duration * part / (count + 1), "on the way") for part in range(1, count + 1)]
    chosen: list[tuple[float, str]] = []
    for time, what in wanted:
        if len(chosen) >= count:
            break
        inside = APART_S <= time <= duration - APART_S
        if inside and all(abs(time - other) >= APART_S for other, _ in chosen):
            chosen.append((time, what))
    return sorted(chosen)


def draw_marks(
    pixels: NDArray[np.uint8], masks: Mapping[str, NDArray[np.bool_]], numbers: Mapping[str, int]
) -> NDArray[np.uint8]:
    """A picture (height, width, 3) with a numbered disc on every object.

    Args:
        pixels: RGB.
        masks: visible pixels (height, width) by object.
        numbers: by object; those without one get no mark.
    """
    image = pixels.copy()
    radius = max(9, round(image.shape[0] / 45))
    for name, mask in masks.items():
        if name not in numbers or int(mask.sum()) < SMALLEST_MARKED:
            continue
        center = _inner_point(mask)
        cv2.circle(image, center, radius, (255, 255, 255), -1, cv2.LINE_AA)
        cv2.circle(image, center, radius, (20, 20, 20), 2, cv2.LINE_AA)
        text, scale = str(numbers[name]), radius / 16
        (width, height), _ = cv2.getTextSize(text, cv2.FONT_HERSHEY_SIMPLEX, scale, 2)
        corner = center[0] - width // 2, center[1] + height // 2
        cv2.putText(image, text, corner, cv2.FONT_HERSHEY_SIMPLEX, scale, (20, 20, 20), 2,
                    cv2.LINE_AA)  # fmt: skip
    return image


def _inner_point(mask: NDArray[np.bool_]) -> tuple[int, int]:
    """The pixel (x, y) of a mask that is farthest from its edge: on the object, not between."""
    padded = np.pad(mask.astype(np.uint8), 1)
    distance = cv2.distanceTransform(padded, cv2.DIST_L2, 3)[1:-1, 1:-1]
    row, column = np.unravel_index(int(distance.argmax()), distance.shape)
    return int(column), int(row)

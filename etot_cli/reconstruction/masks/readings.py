"""Edges of masks by depth, where an object has the colours of the desk.

A sensor loses its readings at an edge about as far on one side as on the other, so that the edge
itself lies in the middle of what is lost. How far depth is still displaced against colour shows at
the objects whose edges colour draws well.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Mask
from etot_cli.reconstruction.masks.labels import grown, opened

FLAT = 0.003
"""Heights up to this are the desk's [m]."""
DISPLACED = 3
"""What depth says of a pixel may be true of one this far away [px]."""
THINNEST = 3
"""Single readings are lost everywhere; at an edge, strips at least this wide [px]."""
WIDEST = 14.0
"""Wider holes than this are lost for other reasons than an edge [px]."""
AGREED = 1
"""Edges by colour and by depth that lie this near to each other are one [px]."""
ALIKE = 0.25
"""With this share of its pixels in the desk's colours, lit or shaded, a thing has no colour edge
of its own everywhere."""
LEAST_EDGE = 150
"""With fewer lost pixels at edges that colour draws nothing is said about a displacement."""
LEAST_GAIN = 0.02
"""A displacement must explain so much more of them to be believed."""


@dataclass(frozen=True)
class Readings:
    """Pixels (h, w) that are surely ``raised`` above the desk, those that are surely ``flat``,
    and patches that are ``lost``.
    """

    raised: Mask
    flat: Mask
    lost: Mask

    def moved(self, right: int, down: int) -> Readings:
        """As they are when depth is moved [px]."""
        move = partial(np.roll, shift=(down, right), axis=(0, 1))
        return Readings(move(self.raised), move(self.flat), move(self.lost))


def sure_readings(seen: Calibrated) -> Readings:
    """What heights say for sure: nothing where raised and flat readings lie side by side, as at a
    thing's foot.
    """
    with np.errstate(invalid="ignore"):
        raised = seen.height > FLAT
        # A cup's floor is as low as the desk, but not part of it.
        flat = (seen.desk & ~raised) | (seen.height < -FLAT)
    # One reading alone is noise.
    raised = opened(raised, 2)
    by_raised, by_desk = grown(raised, DISPLACED), grown(flat, DISPLACED)
    lost = opened(~np.isfinite(seen.height), THINNEST)
    return Readings(raised & ~by_desk, flat & ~by_raised, lost)


def settled_by_depth(
    found: list[Mask], own: list[Mask], shade: Mask, readings: Readings
) -> list[Mask]:
    """Masks drawn by colour, put right where colour cannot tell an object from the desk.

    Args:
        found: disjoint masks (h, w) by colour.
        own: the objects' pixels (h, w) by depth.
        shade: pixels (h, w) of the desk's colour in light or in shadow.
        readings: what depth says.
    """
    result = list(found)
    alike = [_alike(mask, shade, readings) for mask in own]
    clear = [index for index, doubtful in enumerate(alike) if not doubtful]
    displaced = _displacement([(found[index], own[index]) for index in clear], found, readings)
    readings = readings.moved(*displaced)
    for index, doubtful in enumerate(alike):
        if doubtful:
            raised = np.roll(own[index], displaced[::-1], axis=(0, 1)) & readings.raised
            foreign = _united(result[:index] + result[index + 1 :], shade)
            result[index] = _settled(result[index], raised, foreign, shade, readings)
    return result


def _alike(own: Mask, shade: Mask, readings: Readings) -> bool:
    sure = own & readings.raised
    return bool((sure & shade).sum() > ALIKE * sure.sum())


def _united(masks: list[Mask], like: Mask) -> Mask:
    return np.asarray(np.any(masks, axis=0)) if masks else np.zeros_like(like)


@dataclass(frozen=True)
class _Edge:
    """Lost pixels (h, w) at an object's edge against the desk; its side of the middle."""

    lost: Mask
    inner: Mask


def _edge(raised: Mask, foreign: Mask, readings: Readings) -> _Edge:
    to_own, to_desk, to_others = (_distance(known) for known in (raised, readings.flat, foreign))
    lost = readings.lost & ~foreign & (to_own + to_desk < WIDEST) & (to_own < to_others)
    return _Edge(lost, to_own <= to_desk)


def _settled(found: Mask, raised: Mask, foreign: Mask, shade: Mask, readings: Readings) -> Mask:
    edge = _edge(raised, foreign, readings)
    # Where both agree but for a pixel, colour is exacter: depth may be displaced by as much.
    differ = edge.lost & shade & (found != edge.inner)
    core = opened(differ, AGREED + 1).astype(np.uint8)
    differ &= cv2.dilate(core, np.ones((3, 3), np.uint8)) > 0
    # What rises above the desk is not desk, whatever its colour.
    result = ((found ^ differ) | (raised & shade & ~foreign)) & ~readings.flat
    closed = cv2.morphologyEx(result.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8))
    return np.asarray(result | ((closed > 0) & ~foreign & ~readings.flat))


def _displacement(
    clear: list[tuple[Mask, Mask]], found: list[Mask], readings: Readings
) -> tuple[int, int]:
    """How far (right, down) depth has to be moved so that its edges meet those by colour [px].

    Args:
        clear: masks by colour and by depth, of objects whose edges colour draws well.
        found: all masks by colour.
        readings: what depth says.
    """
    steps = [(right, down) for right in range(-DISPLACED, DISPLACED + 1)
             for down in range(-DISPLACED, DISPLACED + 1)]  # fmt: skip
    agreed, count = np.zeros(len(steps)), 0
    height, width = readings.lost.shape
    for mask, own in clear:
        foreign = _united([other for other in found if other is not mask], mask)
        edge = _edge(own & readings.raised, foreign, readings)
        v, u = np.nonzero(edge.lost)
        inner = edge.inner[v, u]
        count += len(v)
        for index, (right, down) in enumerate(steps):
            drawn = mask[np.clip(v + down, 0, height - 1), np.clip(u + right, 0, width - 1)]
            agreed[index] += (drawn == inner).sum()
    best = int(np.argmax(agreed))
    still = agreed[steps.index((0, 0))]
    if count < LEAST_EDGE or agreed[best] - still < LEAST_GAIN * count:
        return 0, 0
    return steps[best]


def _distance(known: Mask) -> NDArray[np.float32]:
    """Distance (h, w) from the nearest known pixel [px]; far where there is none."""
    if not known.any():
        return np.full(known.shape, 1e6, np.float32)
    return np.asarray(cv2.distanceTransform((~known).astype(np.uint8), cv2.DIST_L2, 5))

"""What frames of real sensors show that rendered ones do not: handles, crumbs, fragments, smears.

Each rule is tried on things that it is for and on things that it must leave alone.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from etot_cli.reconstruction.fit.protrusions import without_protrusions
from etot_cli.reconstruction.masks.boundaries import like_desk
from etot_cli.reconstruction.masks.fragments import INSIDE, without_crumbs
from etot_cli.reconstruction.twin.assembly import what_a_scene_may_have

Pixels = NDArray[np.bool_]
TURNS = (0, 20, 45, 70)


def body(width: int = 60) -> NDArray[np.uint8]:
    """An upright body 80 px high."""
    picture = np.zeros((240, 240), np.uint8)
    cv2.rectangle(picture, (120 - width // 2, 80), (120 + width // 2, 160), 1, -1)
    return picture


def turned(picture: NDArray[np.uint8], degrees: float) -> Pixels:
    """A picture turned about its middle."""
    turn = cv2.getRotationMatrix2D((120, 120), degrees, 1.0)
    return cv2.warpAffine(picture, turn, (240, 240), flags=cv2.INTER_NEAREST) > 0


@pytest.mark.parametrize("degrees", TURNS)
@pytest.mark.parametrize("thick", [5, 8, 14])
def test_a_handle_stands_out_however_it_is_turned(degrees: float, thick: int) -> None:
    mug = body()
    cv2.ellipse(mug, (150, 120), (30, 25), 0, -90, 90, 1, thick)
    found = without_protrusions(turned(mug, degrees))
    plain = turned(body(), degrees)
    assert found is not None
    assert (found & plain).sum() / (found | plain).sum() > 0.95


@pytest.mark.parametrize("degrees", TURNS)
def test_corners_necks_and_slim_things_do_not_stand_out(degrees: float) -> None:
    bottle = body()
    cv2.rectangle(bottle, (104, 50), (136, 80), 1, -1)  # a neck about half as wide
    cone = np.zeros_like(bottle)
    cv2.fillPoly(cone, [np.array([[85, 80], [155, 80], [140, 160], [100, 160]])], 1)
    for thing in (body(), bottle, cone, body(12)):
        assert without_protrusions(turned(thing, degrees)) is None


def test_crumbs_go_to_what_they_lie_in_and_others_go() -> None:
    thing, inside, beside, away = (np.zeros((120, 200), bool) for _ in range(4))
    thing[20:80, 20:80] = True
    inside[40:50, 40:50] = True
    thing &= ~inside
    beside[30:40, 82:92] = True
    away[90:100, 160:170] = True
    kept = without_crumbs([away, inside, thing, beside], 400)
    assert [int(part.sum()) for part in kept] == [3600, 100]
    assert (kept[1] == away).all()


def test_what_is_large_enough_is_no_crumb_though_it_touches() -> None:
    thing, second = np.zeros((120, 200), bool), np.zeros((120, 200), bool)
    thing[20:80, 20:80] = True
    second[40:70, 80:100] = True
    assert len(without_crumbs([thing, second], 400)) == 2
    # What leans on a thing from outside lies by less than INSIDE in its outline.
    leaning = np.zeros((120, 200), bool)
    leaning[30:40, 75:90] = True
    assert (leaning & thing).sum() < INSIDE * leaning.sum()
    (kept,) = without_crumbs([thing, leaning & ~thing], 400)
    assert (kept == thing).all()


def test_the_desks_colours_are_the_desks_and_no_others() -> None:
    """Where depth smears things over a two-coloured desk beside them, colour tells them apart."""
    color = np.zeros((60, 90, 3), np.float32)
    color[:, :30], color[:, 30:60], color[:, 60:] = (60, 10, 30), (75, 5, 20), (40, -40, 10)
    color += np.random.default_rng(0).normal(0, 2, color.shape).astype(np.float32)
    desk = np.zeros(color.shape[:2], bool)
    desk[:20, :60] = True
    found = like_desk(SimpleNamespace(desk=desk), color)  # type: ignore[arg-type]
    assert found[:, :60].mean() > 0.99
    assert found[:, 60:].mean() < 0.01


def placed(**objects: tuple[float, int]) -> tuple[list[Any], dict[str, Any]]:
    """Boxes of 6 cm on a desk: by name, x [m] and the number of pixels that are seen."""
    solids, items = [], {}
    for name, (x, pixels) in objects.items():
        mask = np.zeros((100, 100), bool)
        mask.ravel()[:pixels] = True
        solids.append(
            SimpleNamespace(name=name, size=(0.06, 0.06, 0.06), segment=SimpleNamespace(mask=mask))
        )
        items[name] = {"kind": "box", "size": [0.06, 0.06, 0.06], "at": [x, 0.0]}
    return solids, {"name": "toy", "objects": items}


def test_a_fragment_in_a_thing_does_not_cost_the_thing() -> None:
    for order in (("thing", "fragment"), ("fragment", "thing")):
        seen = {"thing": (0.40, 4000), "fragment": (0.41, 90)}
        solids, document = placed(**{name: seen[name] for name in order}, other=(0.55, 50))
        kept, left, notes = what_a_scene_may_have(solids, document)
        assert {solid.name for solid in kept} == {"thing", "other"} == set(left["objects"])
        assert len(notes) == 1 and notes[0].startswith("fragment: left out")


def test_what_merely_touches_stays() -> None:
    solids, document = placed(large=(0.40, 4000), small=(0.4605, 90))
    kept, _, notes = what_a_scene_may_have(solids, document)
    assert len(kept) == 2 and notes == []

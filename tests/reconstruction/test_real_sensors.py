"""What frames of real sensors show that rendered ones do not: handles, crumbs, fragments."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.fit.protrusions import without_protrusions
from etot_cli.reconstruction.masks.fragments import without_crumbs


def drawn(*, handle: bool) -> NDArray[np.uint8]:
    """An upright body 60 px wide, with or without a handle 8 px thick at its side."""
    picture = np.zeros((160, 200), np.uint8)
    cv2.rectangle(picture, (60, 40), (120, 120), 1, -1)
    if handle:
        cv2.ellipse(picture, (120, 80), (30, 25), 0, -90, 90, 1, 8)
    return picture


def test_a_handle_stands_out_and_corners_do_not() -> None:
    body = without_protrusions(drawn(handle=True) > 0)
    assert body is not None
    plain = drawn(handle=False) > 0
    assert (body & plain).sum() / (body | plain).sum() > 0.97
    assert without_protrusions(plain) is None


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

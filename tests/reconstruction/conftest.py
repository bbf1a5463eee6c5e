"""Rendered captures that several tests share."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest

from etot_cli.reconstruction import pipeline
from etot_cli.specs.scene import Scene
from etot_cli.world.capture import Picture, capture
from tests.opengl import need_opengl
from tests.reconstruction.scenes import BALL, CUP, PEN, scene

PICTURES = 4
"""Renderings that are kept: tests add the noise of several sensors to one after the other."""


def render(what: Scene, *, joints: Mapping[str, float] | None = None, **options: Any) -> Picture:
    """A capture of a scene; the test is skipped where there is no OpenGL.

    Its arrays belong to other tests, too, and cannot be written to.
    """
    need_opengl()
    return _rendered(what.model_dump_json(), tuple((joints or {}).items()), **options)


@lru_cache(maxsize=PICTURES)
def _rendered(what: str, joints: tuple[tuple[str, float], ...], **options: Any) -> Picture:
    picture = capture(Scene.model_validate_json(what), joints=dict(joints), **options)
    for array in (picture.color, picture.depth, *picture.masks.values()):
        array.flags.writeable = False
    return picture


@pytest.fixture(scope="session")
def table() -> Scene:
    """A few things on a small picture."""
    return scene(
        {
            "mug": {**CUP, "color": "yellow", "at": [0.45, 0.20]},
            "crate": {"kind": "box", "size": [0.14, 0.10, 0.06], "color": "purple",
                      "at": [0.45, -0.12], "yaw_deg": 20},
            "marker": {**PEN, "length": 0.12, "color": "white", "on": "crate",
                       "at": [0.45, -0.12], "yaw_deg": 45},
            "ball": {**BALL, "color": "red", "at": [0.60, 0.05]},
        },
        {"position": [0.98, 0.05, 0.62], "look_at": [0.44, 0.0, 0.14], "width": 640,
         "height": 480, "fx": 480, "fy": 480, "cx": 322.5, "cy": 236.0},
    )  # fmt: skip


@pytest.fixture(scope="session")
def picture(table: Scene) -> Picture:
    """The table, rendered."""
    return render(table)


@pytest.fixture
def folder(picture: Picture, tmp_path: Path) -> Path:
    """The table as a clean capture folder with masks."""
    from etot_cli.world.capture import write_capture

    write_capture(picture, tmp_path / "table")
    return tmp_path / "table"


@pytest.fixture(scope="session")
def fitted() -> dict[Any, Any]:
    """Shapes by all that they were fitted to."""
    return {}


@pytest.fixture
def fitted_once(monkeypatch: pytest.MonkeyPatch, fitted: dict[Any, Any]) -> None:
    """Fits the shapes of a capture once for all tests of what is made of them afterwards."""
    fit = pipeline._shapes

    def shapes(seen: Any, segments: Any, options: Any) -> Any:
        pictures = [seen.depth, seen.capture.color, seen.view.camera_to_base, *seen.aside]
        pictures += [segment.mask for segment in segments]
        names = [(segment.name, segment.named) for segment in segments]
        key = (options.seed, str(names), *(sha256(it.tobytes()).digest() for it in pictures))
        if key not in fitted:
            fitted[key] = fit(seen, segments, options)
        return fitted[key]

    monkeypatch.setattr(pipeline, "_shapes", shapes)

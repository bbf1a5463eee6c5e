"""Scenes to render that nothing was tuned on."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from etot_cli.specs.scene import Camera, Scene
from tests.reconstruction import meshes

FRONT = {"position": [0.98, 0.05, 0.72], "look_at": [0.44, 0.0, 0.14]}

CUP = {"kind": "cup", "diameter": 0.092, "height": 0.079, "color": "white", "mass": 0.15}
PEN = {"kind": "pen", "length": 0.195, "diameter": 0.018, "color": "white", "mass": 0.03}
BALL = {"kind": "sphere", "diameter": 0.076, "color": "lime", "mass": 0.058}
UNIT = {
    "kind": "drawer_unit",
    "size": [0.237, 0.181, 0.152],
    "color": "orange",
    "drawers": [{"name": "top", "travel": 0.14}, {"name": "bottom", "travel": 0.0}],
}


def scene(objects: dict[str, Any], camera: dict[str, Any] | None = None, **other: Any) -> Scene:
    """A scene from plain data."""
    cameras = {"front": Camera.model_validate(camera or FRONT)}
    return Scene.model_validate({"objects": objects, "cameras": cameras, **other})


def unit(size: list[float], opened: float = 0.0, **other: Any) -> dict[str, Any]:
    """The drawer unit of another size, its upper drawer open."""
    drawers = [
        {"name": "top", "travel": 0.14, "open": opened},
        {"name": "bottom", "travel": 0.0},
    ]
    return {**UNIT, "size": size, "drawers": drawers, **other}


def others() -> dict[str, Scene]:
    """Scenes with other objects, colours, desks and cameras than the shipped ones."""
    low = {"position": [1.0, -0.25, 0.62], "look_at": [0.45, 0.05, 0.05], "fx": 700, "fy": 700,
           "cx": 610, "cy": 380}  # fmt: skip
    side = {"position": [0.75, 0.55, 0.75], "look_at": [0.42, -0.03, 0.22], "width": 960,
            "height": 720, "fx": 640, "fy": 640, "cx": 480, "cy": 350}  # fmt: skip
    return {
        "green_desk": scene(
            {
                "mug": {**CUP, "diameter": 0.081, "height": 0.095, "color": "yellow",
                        "at": [0.45, 0.22]},
                "block": {"kind": "box", "size": [0.11, 0.06, 0.05], "color": "purple",
                          "at": [0.40, -0.15], "yaw_deg": 25},
                "can": {"kind": "cylinder", "diameter": 0.066, "height": 0.115, "color": "red",
                        "at": [0.55, 0.02]},
                "marker": {**PEN, "length": 0.14, "diameter": 0.016, "color": "blue",
                           "at": [0.58, -0.22], "yaw_deg": 70},
            },
            low,
            desk={"top": 0.05, "color": "#1a7a7a", "size": [0.9, 1.3]},
        ),
        "stack": scene(
            {
                "crate": {"kind": "box", "size": [0.20, 0.16, 0.09], "color": "brown",
                          "at": [0.46, 0.05], "yaw_deg": 15},
                "bowl": {"kind": "bowl", "diameter": 0.12, "height": 0.05, "color": "cyan",
                         "on": "crate", "at": [0.46, 0.05]},
                "ball": {**BALL, "diameter": 0.05, "color": "#cc2699", "at": [0.34, -0.16]},
            },
            side,
            desk={"top": 0.20, "color": "gray", "size": [0.8, 1.0]},
        ),
        "chest": scene(
            {
                "chest": {**unit([0.22, 0.20, 0.17], 0.06, color="green"), "at": [0.45, 0.10],
                          "yaw_deg": -60},
                "stick": {"kind": "capsule", "length": 0.16, "diameter": 0.025, "color": "pink",
                          "at": [0.36, -0.22], "yaw_deg": 130},
            },
            desk={"top": 0.10, "color": "#24346b"},
        ),
    }  # fmt: skip


def articulated() -> dict[str, tuple[Scene, str, tuple[float, float]]]:
    """Furniture with a moving part: scene, the part's address, joint values of two frames."""
    drawer = scene({"chest": {**unit([0.24, 0.18, 0.16], 0.0), "at": [0.50, 0.05],
                              "yaw_deg": -35}})  # fmt: skip
    door = scene(
        {
            "locker": {
                "kind": "cabinet", "size": [0.26, 0.36, 0.26], "at": [0.42, 0.20], "yaw_deg": -50,
                "color": "silver", "door": {"hinge": "right", "open_deg": 0},
            },
        },
        {"position": [1.10, -0.20, 0.90], "look_at": [0.45, 0.10, 0.15]},
    )  # fmt: skip
    return {
        "drawer": (drawer, "chest.top", (0.0, 0.12)),
        "door": (door, "locker.door", (np.radians(10), np.radians(60))),
    }


def free_forms(folder: Path) -> Scene:
    """Two things that no simple kind describes; their meshes are written into the folder."""
    places = {"angle_block": ([0.40, -0.22], 20), "toy": ([0.45, 0.20], 250)}
    objects = {}
    for name, (place, yaw) in places.items():
        meshes.ALL[name]().export(folder / f"{name}.obj")
        objects[name] = {"kind": "mesh", "file": f"{name}.obj", "at": place, "yaw_deg": yaw,
                         "mass": 0.15, "color": "orange"}  # fmt: skip
    return scene(objects).model_copy(update={"directory": str(folder)})

"""Scenes that ``make bench`` measures besides the tasks."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import yaml

from etot_cli.benchmark.problems.things import bowl, solid
from tests.problems.infeasible import REASONS, any_problem

VASE = {"kind": "cylinder", "diameter": 0.05, "height": 0.20, "mass": 0.2}


def hopeless_files(folder: Path) -> list[Path]:
    """Tasks whose actions fail: without a plan for ten reasons, and two vases before a door."""
    doors = []
    for hinge in ("left", "right"):
        oven = {"kind": "cabinet", "size": [0.20, 0.26, 0.24], "mass": 5.0, "at": [0.45, 0.25],
                "yaw_deg": -90, "door": {"hinge": hinge, "handle": {}}}  # fmt: skip
        vases = {"urn": {**VASE, "at": [0.39, 0.05]}, "vase": {**VASE, "at": [0.51, 0.05]}}
        goal = [{"open": "oven"}]
        doors.append(
            _file(folder, f"door_{hinge}", "Open the oven.", goal, {"oven": oven, **vases})
        )
    return [
        *doors,
        *(any_problem("infeasible", seed).write(folder) for seed in range(len(REASONS))),
    ]


def crowd_file(folder: Path, count: int) -> Path:
    """A task: one of ``count`` blocks, which stand in rows with a hand's room between, to the edge
    of the desk; the first one goes into a bowl.
    """
    spots = [(0.26 + 0.1 * row, -0.45 + 0.1 * column) for row in range(4) for column in range(10)]
    free = [spot for spot in spots if math.hypot(spot[0] - 0.4, spot[1]) > 0.16]
    first = min(free, key=lambda spot: math.hypot(spot[0] - 0.35, spot[1] - 0.25))
    others = [spot for spot in free if spot != first]
    objects: dict[str, Any] = {"bowl": {**bowl(0.14), "at": [0.4, 0.0]}}
    for number, spot in enumerate([first, *others][: count - 1]):
        objects[f"block_{number}"] = {**solid([0.04, 0.04, 0.04]), "at": [*spot]}
    goal = [{"inside": ["block_0", "bowl"]}]
    return _file(folder, f"crowd_{count}", "Put block_0 into the bowl.", goal, objects)


def _file(
    folder: Path, name: str, instruction: str, goal: list[dict[str, Any]], objects: dict[str, Any]
) -> Path:
    task = {
        "name": name,
        "instruction": instruction,
        "goal": goal,
        "success": goal,
        "scene": {
            "desk": {"size": [0.8, 1.2], "center": [0.42, 0.0], "top": 0.13},
            "objects": objects,
        },
    }
    path = folder / f"{name}.yaml"
    path.write_text(yaml.safe_dump(task), encoding="utf-8")
    return path

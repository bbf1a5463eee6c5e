"""Variants of a task that must not change what comes of it: renamed, mirrored.

A task is taken as a plain document: its scene is loaded, includes and all, and written out in
place.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

from etot_cli.specs.load import load_task
from etot_cli.world.colors import BASIC_COLORS

Document = dict[str, Any]
ONSETS, VOWELS, ENDINGS = (
    ["b", "d", "f", "g", "k", "l", "m", "n", "p", "t", "v", "z", "fl", "gr", "pl", "tr"],
    "aeiou",
    ["b", "d", "g", "k", "m", "p", "t"],
)
SIDES = {"left": "right", "right": "left"}


def document(task_file: Path) -> Document:
    """A task with its scene in place, as plain data."""
    task = load_task(task_file)
    found: Document = task.model_dump(mode="json", exclude_defaults=True, by_alias=True)
    found.pop("file", None)
    found["scene"].pop("directory", None)
    return found


def write(task: Document, folder: Path) -> Path:
    """Writes a task; its file has the task's own name."""
    file = folder / f"{task['name']}.yaml"
    file.write_text(yaml.safe_dump(task, sort_keys=False), encoding="utf-8")
    return file


# -- other names -----------------------------------------------------------------------------------


def new_words(task: Document, seed: int) -> dict[str, str]:
    """A made-up word for each word of the objects' names and labels; colours stay what they are."""
    rng = random.Random(seed)
    words: dict[str, str] = {}
    for name, item in task["scene"]["objects"].items():
        for word in re.findall(r"[a-z]+", f"{name} {item.get('label', '')}".lower()):
            if word not in BASIC_COLORS and word not in words:
                words[word] = _made_up(rng, {*words.values()})
    return words


def _made_up(rng: random.Random, taken: set[str]) -> str:
    while True:
        syllables = (rng.choice(ONSETS) + rng.choice(VOWELS) for _ in range(2))
        word = "".join(syllables) + rng.choice(ENDINGS)
        if word not in taken:
            return word


def reworded(text: str, words: dict[str, str]) -> str:
    """A text with words exchanged, plurals in s among them."""
    pattern = rf"(?<![A-Za-z])({'|'.join(sorted(words, key=len, reverse=True))})(s?)(?![A-Za-z])"
    return re.sub(pattern, lambda match: words[match[1]] + match[2], text)


def renamed(task: Document, words: dict[str, str]) -> Document:
    """The task with other words for everything in it: names, labels, instruction, conditions."""
    scene = task["scene"]
    names = {name: reworded(name, words) for name in scene["objects"]}
    objects = {}
    for name, item in scene["objects"].items():
        other = {**item, **{key: _address(item[key], names) for key in _places(item)}}
        if "label" in item:
            other["label"] = reworded(item["label"], words)
        objects[names[name]] = other
    # By another name a microwave oven is no oven to anybody.
    said = task["instruction"].replace("microwave oven", "microwave")
    changed = {
        **task,
        "instruction": reworded(said, words),
        "scene": {**scene, "objects": objects},
        "success": _with_names(task["success"], names),
    }
    if "disturbance" in task:
        changed["disturbance"] = _with_names(task["disturbance"], names)
    return changed


def _places(item: Document) -> Iterator[str]:
    return (key for key in ("on", "inside") if item.get(key))


def _address(address: str, names: dict[str, str]) -> str:
    owner, dot, part = address.partition(".")
    return names.get(owner, owner) + dot + part


def _with_names(data: Any, names: dict[str, str]) -> Any:
    if isinstance(data, dict):
        return {key: _with_names(value, names) for key, value in data.items()}
    if isinstance(data, list):
        return [_with_names(value, names) for value in data]
    return _address(data, names) if isinstance(data, str) else data


# -- the other side --------------------------------------------------------------------------------


def mirrored(task: Document) -> Document:
    """The task with left and right exchanged: everything reflected in the plane y = 0."""
    scene = {key: value for key, value in task["scene"].items() if key != "cameras"}
    if "desk" in scene and "center" in scene["desk"]:
        scene["desk"] = {**scene["desk"], "center": _reflected(scene["desk"]["center"])}
    scene["objects"] = {name: _object(item) for name, item in scene["objects"].items()}
    return {**task, "scene": scene, "instruction": reworded(task["instruction"], SIDES)}


def _reflected(point: list[float]) -> list[float]:
    return [point[0], -point[1], *point[2:]]


def _object(item: Document) -> Document:
    other = dict(item)
    if item.get("at"):
        other["at"] = _reflected(item["at"])
    if "yaw_deg" in item:
        other["yaw_deg"] = -item["yaw_deg"]
    if item.get("quaternion"):
        w, x, y, z = item["quaternion"]
        other["quaternion"] = [w, -x, y, -z]
    if item["kind"] == "cabinet":
        # The default, a hinge on the left, is left out of the document.
        door = item.get("door", {})
        other["door"] = {**door, "hinge": SIDES[door.get("hinge", "left")]}
    return other

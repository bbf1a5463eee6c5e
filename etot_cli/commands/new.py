"""``etot new``: a task of one's own from a starting scene, objects and an instruction.

The file is written, read back with all checks, put into the physics world, and drawn from above.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from etot_cli.commands.ideas import ideas
from etot_cli.errors import EtotError, SpecError
from etot_cli.reasoning.builtin.demands import demands
from etot_cli.reasoning.language.instructions import goal_of
from etot_cli.reporting.files import write_atomically
from etot_cli.reporting.page.topview import top_view
from etot_cli.specs.document import read_document
from etot_cli.specs.load import load_scene, load_task
from etot_cli.specs.objects import Mesh, Mjcf
from etot_cli.specs.reading import MAX_BYTES, read_utf8
from etot_cli.specs.scene import Scene
from etot_cli.specs.shipped import find_shipped, shipped_files
from etot_cli.world.state import SceneState

TEMPLATES: dict[str, dict[str, Any]] = {
    "sphere": {"diameter": 0.07, "mass": 0.06},
    "box": {"size": [0.06, 0.06, 0.06], "mass": 0.10},
    "cylinder": {"diameter": 0.06, "height": 0.10, "mass": 0.20},
    "capsule": {"diameter": 0.05, "length": 0.14, "mass": 0.10},
    "pen": {"length": 0.18, "diameter": 0.016, "mass": 0.02},
    "cup": {"diameter": 0.09, "height": 0.08, "mass": 0.15},
    "bowl": {"diameter": 0.16, "height": 0.06, "mass": 0.20},
    "drawer_unit": {
        "yaw_deg": -90, "size": [0.237, 0.181, 0.152], "mass": 1.2, "color": "beech",
        "drawers": [{"name": "top"}, {"name": "bottom", "travel": 0.0}],
    },
    "cabinet": {"yaw_deg": -90, "size": [0.26, 0.34, 0.24], "mass": 5.0},
    "shelf": {"yaw_deg": -90, "size": [0.18, 0.30, 0.24], "mass": 2.0, "color": "beech"},
}  # fmt: skip
"""Everyday sizes of each kind that needs no file [m, kg]; the file is there to be edited."""
_NUMBER = r"[-+]?\d*\.?\d+"
_OBJECT = re.compile(
    rf"(?P<name>[A-Za-z]\w*)=(?P<kind>\w+)@(?:(?P<x>{_NUMBER}),(?P<y>{_NUMBER})"
    r"|(?P<how>on|in)\s+(?P<other>[\w.]+))(?:,(?P<color>[#\w]+))?"
)
_MOVE = re.compile(rf"(?P<name>\w+)@(?P<x>{_NUMBER}),(?P<y>{_NUMBER})")


@dataclass(frozen=True, slots=True, kw_only=True)
class NewOptions:
    """What the task is to be. ``scene``: a shipped scene or task by name, or a file of either."""

    file: Path
    instruction: str
    scene: str = "desk"
    objects: Sequence[str] = ()
    """``NAME=KIND@X,Y[,COLOR]``, ``NAME=KIND@on OTHER`` or ``NAME=KIND@in OTHER``."""
    moves: Sequence[str] = ()
    """``NAME@X,Y`` for objects of the starting scene."""
    removals: Sequence[str] = ()
    force: bool = False


@dataclass(frozen=True, slots=True)
class NewTask:
    """What was written, and what the built-in reasoner makes of it."""

    file: Path
    drawing: Path
    state: SceneState
    plans: tuple[str, ...]
    """The branches that the instruction is understood as; empty when it holds already."""
    problem: str
    """Why the instruction is not understood; empty when it is."""


def write_task(options: NewOptions) -> NewTask:
    """Writes a task file and a drawing of its scene beside it.

    Raises:
        EtotError: an option cannot be used, the file exists, or the scene cannot be as asked for;
            nothing is written then.
    """
    if options.file.exists() and not options.force:
        raise EtotError(f"{options.file} exists already; --force replaces it")
    source, scene = _start(options.scene)
    if any(isinstance(item, Mesh | Mjcf) for item in scene.objects.values()):
        raise EtotError(f"{source} has objects from files; copy it with them and edit the copy")
    document = scene.model_dump(
        mode="json",
        exclude_defaults=True,
        by_alias=True,
        exclude={"actuation", "directory", "name"},
    )
    document.pop("description", None)
    objects: dict[str, Any] = document.setdefault("objects", {})
    for name in options.removals:
        _known(objects, name, source)
        del objects[name]
    moved = set[str]()
    for written in options.moves:
        match = _match(_MOVE, written, "--move", "NAME@X,Y")
        _known(objects, match["name"], source)
        if match["name"] in moved:
            raise EtotError(f"--move {written!r}: {match['name']} is moved already")
        moved.add(match["name"])
        entry = objects[match["name"]]
        entry["at"] = [float(match["x"]), float(match["y"])]
        entry.pop("on", None)
        entry.pop("inside", None)
    for written in options.objects:
        name, entry = _object(written)
        if name in objects:
            raise EtotError(
                f"--object {written!r}: there is {name!r} already; expected another name, or "
                f"--remove {name} for one of the starting scene"
            )
        objects[name] = entry
    if not objects:
        raise EtotError(
            "the scene would be empty; add an object, e.g. --object ball=sphere@0.4,0.2"
        )
    kept = options.file.exists()
    before = read_utf8(options.file, MAX_BYTES, "a task") if kept else None
    write_atomically(options.file, _text(options.instruction, document, []))
    try:
        made = _look(options.file)
        demanded = [] if made.problem else demands(goal_of(options.instruction, made.state))
        if demanded:
            write_atomically(options.file, _text(options.instruction, document, demanded))
            load_task(options.file)
        return made
    except EtotError as error:
        # Whoever mends an option and tries again must not find a file in the way.
        if before is None:
            options.file.unlink(missing_ok=True)
        else:
            write_atomically(options.file, before)
        if isinstance(error, SpecError):
            raise SpecError(error.message, path=error.path) from None
        raise


def _start(name: str) -> tuple[Path, Scene]:
    """The scene to start from, and the file that has it."""
    tasks = shipped_files("tasks")
    if name in tasks:
        return tasks[name], load_task(tasks[name]).scene
    source = find_shipped("scenes", name)
    document = read_document(source).value
    if isinstance(document, dict) and "scene" in document:
        return source, load_task(source).scene
    return source, load_scene(source)


def _object(written: str) -> tuple[str, dict[str, Any]]:
    match = _match(
        _OBJECT, written, "--object", "NAME=KIND@X,Y[,COLOR], NAME=KIND@on OTHER or @in OTHER"
    )
    kind = match["kind"]
    if kind not in TEMPLATES:
        raise EtotError(f"--object {written!r}: no kind {kind!r}; expected {', '.join(TEMPLATES)}")
    entry: dict[str, Any] = {"kind": kind}
    if match["x"] is not None:
        entry["at"] = [float(match["x"]), float(match["y"])]
    else:
        entry["on" if match["how"] == "on" else "inside"] = match["other"]
    entry |= TEMPLATES[kind]
    if match["color"]:
        entry["color"] = match["color"]
    return match["name"], entry


def _match(pattern: re.Pattern[str], written: str, flag: str, form: str) -> re.Match[str]:
    match = pattern.fullmatch(written.strip())
    if match is None:
        raise EtotError(f"{flag} {written!r}: expected {form}")
    return match


def _known(objects: dict[str, Any], name: str, source: Path) -> None:
    if name not in objects:
        raise EtotError(f"{source} has no object {name!r}; it has {', '.join(objects) or 'none'}")


def _text(instruction: str, scene: dict[str, Any], success: Sequence[dict[str, Any]]) -> str:
    head = (
        "# A task of your own. Metres, kilograms, degrees; x ahead of the robot, y to its left.\n"
        "# 'success' is what the result is checked against; the planner never sees it. In it is\n"
        "# what the instruction demands as it was understood: check that, and add to it.\n"
    )
    document: dict[str, Any] = {"instruction": instruction, "scene": scene}
    if success:
        document["success"] = [*success]
    text = yaml.safe_dump(
        document, sort_keys=False, allow_unicode=True, default_flow_style=None, width=100
    )
    return head + text


def _look(file: Path) -> NewTask:
    """Reads the file back, settles its scene, draws it, and asks how it is understood."""
    found = ideas(load_task(file))
    drawing = file.with_suffix(".svg")
    write_atomically(drawing, top_view(found.state).decode())
    return NewTask(file, drawing, found.state, found.plans, found.problem)

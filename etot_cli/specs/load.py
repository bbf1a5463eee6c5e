"""Loads task and scene files: the way from YAML to checked models."""

from __future__ import annotations

import re
from pathlib import Path

from etot_cli.errors import InstructionError, SpecError
from etot_cli.specs.checks import check_scene
from etot_cli.specs.document import Node, Place, read_document
from etot_cli.specs.files import resolve_added, resolve_files
from etot_cli.specs.include import as_include, expand, merge, project_root
from etot_cli.specs.inputs import input_digests
from etot_cli.specs.problems import first_error, validate
from etot_cli.specs.references import task_problems
from etot_cli.specs.scene import Scene
from etot_cli.specs.task import Task
from etot_cli.specs.wording import describe


def load_scene(path: str | Path) -> Scene:
    """Loads a scene file, includes resolved, everything checked.

    Args:
        path: the YAML file.

    Raises:
        SpecError: the file is unusable; the message says where, what was found and what is
            expected.
    """
    file = Path(path)
    node = expand(_named(read_document(file), file), file, project_root(file))
    scene = resolve_files(validate(Scene, node), node, file.parent)
    check_scene(scene, node)
    return scene


def load_task(path: str | Path) -> Task:
    """Loads a task file and its scene, everything checked.

    Args:
        path: the YAML file.

    Raises:
        SpecError: the task or its scene is unusable; the message says where, what was found and
            what is expected.
    """
    file = Path(path)
    root = _named(read_document(file), file)
    keys = dict(root.value) if isinstance(root.value, dict) else {}
    variation = keys.pop("variation", None)
    scene_file = file
    if "scene" in keys:
        scene_node, scene_file = as_include(keys["scene"], file, project_root(file))
        if variation is not None:
            over = Node({"variation": variation}, scene_node.place)
            scene_node = merge(scene_node, over)
        keys["scene"] = _named(scene_node, scene_file)
    told = "instruction" in keys or "goal" not in keys
    node = Node(keys if told else {**keys, "instruction": Node("goal", root.place)}, root.place)
    task = validate(Task, node)
    if not told:
        words = ", ".join(map(describe, task.goal or ()))
        task = task.model_copy(update={"instruction": words})
    scene_node = keys["scene"]
    scene = resolve_files(task.scene, scene_node, scene_file.parent)
    added = resolve_added(task.disturbance, node, scene_file.parent)
    task = task.model_copy(update={"scene": scene, "file": str(path), "disturbance": added})
    inputs = input_digests(node, scene, file, task.added_objects)
    task = task.model_copy(update={"inputs": inputs})
    check_scene(scene, scene_node)
    problems = task_problems(task)
    if problems:
        raise first_error(node, problems)
    return task


def misread(task: Task, error: InstructionError) -> SpecError:
    """What could not be understood of a task, at its place in the file."""
    asked = "instruction" if task.goal is None else "goal"
    return placed(task, asked, str(error).removeprefix("goal: "))


def placed(task: Task, path: str, message: str) -> SpecError:
    """An error that was only found in use, at its place in the task's file.

    Args:
        task: as it was loaded.
        path: keys of the task with dots between, such as ``scene.robot``.
        message: what was found, and what is expected.
    """
    try:
        return read_document(Path(task.file)).error(tuple(path.split(".")), message)
    except SpecError:  # the file is gone meanwhile
        return SpecError(message, file=task.file, path=path)


def _named(node: Node, file: Path) -> Node:
    """The mapping with a ``name``: the file's own where the document gives none."""
    if not isinstance(node.value, dict) or "name" in node.value:
        return node
    stem = re.sub(r"[^A-Za-z0-9_.-]", "_", file.stem)[:64]
    name = stem if stem[:1].isalnum() else f"x{stem}"[:64]
    place = Place(node.place.file, node.place.line, (*node.place.path, "name"))
    return Node({**node.value, "name": Node(name, place)}, node.place)

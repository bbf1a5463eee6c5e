"""Files that a scene refers to: meshes, MJCF models and robots, found safely.

A scene may come from somebody else, so the files it names must lie in the folder tree of the
document that names them, symbolic links followed.
"""

from __future__ import annotations

import os.path
import re
from pathlib import Path

from etot_cli.specs.disturbance import Disturbance
from etot_cli.specs.document import DataPath, Node
from etot_cli.specs.objects import Mesh, Mjcf, SceneObject
from etot_cli.specs.scene import Scene

MAX_FILE_BYTES = 50 * 1024 * 1024
"""Largest mesh, MJCF or robot file [bytes]: what the largest mesh takes as text."""
MESH_SUFFIXES = (".obj", ".stl", ".glb")
MJCF_SUFFIXES = (".xml", ".mjcf")
ROBOT_SUFFIXES = (".yaml", ".yml")
Disturbances = Disturbance | tuple[Disturbance, ...] | None
_BUILT_IN = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,47}")


def resolve_files(scene: Scene, node: Node, directory: Path) -> Scene:
    """Checks all files of a scene and makes their paths relative to its directory.

    Args:
        scene: the validated scene.
        node: its document; the place of each file name says which folder it is relative to.
        directory: the scene's own folder.

    Returns:
        The scene with ``directory`` set (absolute). The file of an object that was included from
        another folder becomes a path from ``directory`` to it.

    Raises:
        SpecError: a file outside its folder tree, missing, too large or of another format.
    """
    home = directory.resolve()
    objects = {
        name: _resolve_object(item, node, ("objects", name), home)
        for name, item in scene.objects.items()
    }
    update: dict[str, object] = {"objects": objects, "directory": str(home)}
    if is_robot_file(scene.robot):
        found = _resolve(node, ("robot",), scene.robot, ROBOT_SUFFIXES)
        update["robot"] = Path(os.path.relpath(found, home)).as_posix()
    elif not _BUILT_IN.fullmatch(scene.robot):
        raise node.error(
            ("robot",),
            f"found {scene.robot!r}, expected a built-in robot's name or a robot's YAML file",
        )
    return scene.model_copy(update=update)


def resolve_added(given: Disturbances, node: Node, directory: Path) -> Disturbances:
    """The same for objects that disturbances bring onto the scene.

    Args:
        given: a task's disturbances: one, several or none.
        node: the task's document.
        directory: the scene's own folder.

    Raises:
        SpecError: as for those of the scene.
    """
    home = directory.resolve()

    def resolved(item: Disturbance, path: DataPath) -> Disturbance:
        if item.object is None:
            return item
        found = _resolve_object(item.object, node, (*path, "object"), home)
        return item.model_copy(update={"object": found})

    if isinstance(given, Disturbance):
        return resolved(given, ("disturbance",))
    if given is None:
        return None
    return tuple(resolved(item, ("disturbance", rank)) for rank, item in enumerate(given))


def _resolve_object(item: SceneObject, node: Node, path: DataPath, home: Path) -> SceneObject:
    if not isinstance(item, Mesh | Mjcf):
        return item
    suffixes = MESH_SUFFIXES if isinstance(item, Mesh) else MJCF_SUFFIXES
    found = _resolve(node, (*path, "file"), item.file, suffixes)
    return item.model_copy(update={"file": Path(os.path.relpath(found, home)).as_posix()})


def is_robot_file(robot: str) -> bool:
    """Whether a scene's ``robot`` names a YAML file rather than a built-in robot."""
    return "/" in robot or robot.lower().endswith(ROBOT_SUFFIXES)


def _resolve(node: Node, path: DataPath, text: str, suffixes: tuple[str, ...]) -> Path:
    """The file that a document names, checked."""
    document = Path(node.locate(path).file)
    folder = document.parent.resolve()
    if "\0" in text or "\\" in text or Path(text).is_absolute():
        raise node.error(path, f"found {text!r}, expected a relative path with forward slashes")
    if not text.lower().endswith(suffixes):
        raise node.error(path, f"found {text!r}, expected a file ending in {' or '.join(suffixes)}")
    try:
        target = (folder / text).resolve()
    except (OSError, RuntimeError):
        raise node.error(path, f"found {text!r}, which cannot be followed") from None
    if target.suffix.lower() not in suffixes:
        raise node.error(path, f"{text!r} is a link to a file of another format")
    if ".." in Path(text).parts or not target.is_relative_to(folder):
        raise node.error(path, f"{text!r} leaves the folder of the file that names it")
    try:
        size = target.stat().st_size if target.is_file() else None
    except OSError:
        size = None
    if size is None:
        raise node.error(path, f"there is no file {text!r} beside {document.name}")
    if size > MAX_FILE_BYTES:
        megabytes = MAX_FILE_BYTES // (1024 * 1024)
        raise node.error(path, f"{text!r} is larger than {megabytes} MiB")
    return target

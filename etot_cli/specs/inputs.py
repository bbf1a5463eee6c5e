"""The files that a task was read from, told by their content."""

from __future__ import annotations

import hashlib
import os.path
from collections.abc import Iterable, Iterator
from pathlib import Path

from etot_cli.specs.document import Node
from etot_cli.specs.files import is_robot_file
from etot_cli.specs.objects import Mesh, Mjcf, SceneObject
from etot_cli.specs.scene import Scene


def input_digests(
    node: Node, scene: Scene, file: Path, added: Iterable[SceneObject] = ()
) -> dict[str, str]:
    """Hashes everything that a task or scene came from.

    Args:
        node: the document, includes resolved.
        scene: its scene, files resolved.
        file: the file that was named by the user.
        added: objects that may come onto the scene, files resolved.

    Returns:
        SHA-256 (hexadecimal) of each file by its path relative to the folder of ``file``: the
        documents that at least one value is from, meshes, MJCF models and a robot's YAML.
    """
    home = file.parent.resolve()
    found = {Path(name).resolve() for name in {str(file), *_documents(node)}}
    found |= referenced_files(scene, added)
    digests = {Path(os.path.relpath(path, home)).as_posix(): file_digest(path) for path in found}
    return dict(sorted(digests.items()))


def referenced_files(scene: Scene, added: Iterable[SceneObject] = ()) -> set[Path]:
    """Meshes, MJCF models and a robot's YAML: what a scene is made of besides what it says.

    Args:
        scene: files resolved.
        added: objects that may come onto it, files resolved.
    """
    objects = (*scene.objects.values(), *added)
    named = [item.file for item in objects if isinstance(item, Mesh | Mjcf)]
    if is_robot_file(scene.robot):
        named.append(scene.robot)
    return {(Path(scene.directory) / name).resolve() for name in named}


def file_digest(path: Path) -> str:
    """SHA-256 of what is in a file, hexadecimal."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _documents(node: Node) -> Iterator[str]:
    """The file of every value."""
    yield node.place.file
    if isinstance(node.value, dict):
        children = list(node.value.values())
    else:
        children = node.value if isinstance(node.value, list) else []
    for child in children:
        yield from _documents(child)

"""The files that a task was read from, told by their content."""

from __future__ import annotations

import hashlib
import os.path
from collections.abc import Iterator
from pathlib import Path

from etot_cli.specs.document import Node
from etot_cli.specs.files import is_robot_file
from etot_cli.specs.objects import Mesh, Mjcf
from etot_cli.specs.scene import Scene


def input_digests(node: Node, scene: Scene, file: Path) -> dict[str, str]:
    """Hashes everything that a task or scene came from.

    Args:
        node: the document, includes resolved.
        scene: its scene, files resolved.
        file: the file that was named by the user.

    Returns:
        SHA-256 (hexadecimal) of each file by its path relative to the folder of ``file``: the
        documents that at least one value is from, meshes, MJCF models and a robot's YAML.
    """
    home = file.parent.resolve()
    found = {file.resolve()} | {Path(name).resolve() for name in _documents(node)}
    named = [item.file for item in scene.objects.values() if isinstance(item, Mesh | Mjcf)]
    if is_robot_file(scene.robot):
        named.append(scene.robot)
    found |= {(Path(scene.directory) / name).resolve() for name in named}
    digests = {
        Path(os.path.relpath(path, home)).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in found
    }
    return dict(sorted(digests.items()))


def _documents(node: Node) -> Iterator[str]:
    """The file of every value."""
    yield node.place.file
    if isinstance(node.value, dict):
        children = list(node.value.values())
    else:
        children = node.value if isinstance(node.value, list) else []
    for child in children:
        yield from _documents(child)

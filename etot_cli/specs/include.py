"""Includes: a scene that starts from another scene's document and overrides parts of it.

``include: other.yaml`` is relative to the file it stands in. Mappings are merged key by key; lists
and plain values replace what was inherited; ``null`` removes it. A changed ``kind`` replaces the
object as a whole. Every value keeps its own place, so an error names the file it was written in.
"""

from __future__ import annotations

import os.path
from pathlib import Path

from etot_cli.specs.document import Node, read_document

MAX_INCLUDES = 8
"""Longest chain of documents that include each other."""
SUFFIXES = (".yaml", ".yml")

REPLACES = {
    "on": ("inside", "at"),
    "inside": ("on", "at"),
    "look_at": ("quaternion",),
    "quaternion": ("look_at", "yaw_deg"),
    "yaw_deg": ("quaternion",),
}
"""Keys that take the place of others: an object moved to another support does not keep its old
place, and a pose has one orientation."""


def project_root(file: Path) -> Path:
    """The folder tree that includes of a document may not leave: the folder above its own, so that
    ``tasks/`` and ``scenes/`` can stand side by side.
    """
    return file.parent.resolve().parent


def expand(node: Node, file: Path, root: Path, chain: tuple[Path, ...] = ()) -> Node:
    """Replaces the ``include`` of a scene's mapping by what it includes, merged.

    Args:
        node: the scene's mapping.
        file: the file it was read from.
        root: folder that included files must lie in; see :func:`project_root`.
        chain: the files that led here, resolved, outermost first.

    Raises:
        SpecError: a missing or forbidden file, a cycle, or a chain that is too long.
    """
    if not isinstance(node.value, dict) or "include" not in node.value:
        return node
    include = node.value["include"]
    own = Node({key: item for key, item in node.value.items() if key != "include"}, node.place)
    return merge(include_file(include, file, root, (*chain, file.resolve())), own)


def include_file(include: Node, file: Path, root: Path, chain: tuple[Path, ...]) -> Node:
    """Reads the document that ``include`` names, its own includes expanded.

    Args:
        include: the node that holds the file's name.
        file: the file that ``include`` stands in.
        root: folder that included files must lie in.
        chain: the files that led here, resolved, ``file`` last.
    """
    target = _target(include, file, root)
    resolved = target.resolve()
    if resolved in chain:
        names = " → ".join(item.name for item in (*chain[chain.index(resolved) :], resolved))
        raise include.error((), f"the files include each other: {names}")
    if len(chain) > MAX_INCLUDES:
        raise include.error((), f"more than {MAX_INCLUDES} files include each other in a chain")
    if not os.path.exists(target):  # noqa: PTH110 - never raises, unlike Path.exists
        raise include.error((), f"found {include.value!r}, but there is no file {target}")
    return expand(read_document(target), target, root, chain)


def included_path(include: Node, file: Path) -> Path:
    """The file that an ``include`` means, as the user would name it; not checked."""
    joined = file.parent / str(include.value)
    tidy = Path(os.path.normpath(joined))
    # ``a/../b`` is ``b`` only where ``a`` is no symbolic link.
    return tidy if tidy.resolve() == joined.resolve() else joined


def _target(include: Node, file: Path, root: Path) -> Path:
    text = include.value
    if not isinstance(text, str) or not text.strip():
        raise include.error((), "expected the name of a YAML file, such as ../scenes/desk.yaml")
    if "\0" in text or Path(text).is_absolute():
        raise include.error((), f"found {text!r}, expected a path relative to this file")
    if Path(text).suffix.lower() not in SUFFIXES:
        raise include.error((), f"found {text!r}, expected a file ending in .yaml or .yml")
    try:
        target = included_path(include, file)
        inside = target.resolve().is_relative_to(root)
    except (OSError, RuntimeError, ValueError):
        # A loop of symbolic links, or a name that no file can have.
        raise include.error((), f"found {text!r}, which cannot be followed") from None
    if not inside:
        raise include.error((), f"{text!r} lies outside the project's folder {root.name}/")
    return target


def merge(base: Node, over: Node) -> Node:
    """Lays ``over`` onto ``base``; neither is changed. The rules are at the top of this module."""
    if not isinstance(base.value, dict) or not isinstance(over.value, dict):
        return over
    kind = over.value.get("kind")
    inherited = base.value.get("kind")
    if kind is not None and inherited is not None and kind.value != inherited.value:
        return over
    result = dict(base.value)
    for key, item in over.value.items():
        if item.value is not None:
            for other in REPLACES.get(key, ()):
                if other not in over.value:
                    result.pop(other, None)
    for key, item in over.value.items():
        if item.value is None and key in result:
            del result[key]
        elif key in result:
            result[key] = merge(result[key], item)
        else:
            result[key] = item
    return Node(result, over.place)


def as_include(node: Node, file: Path, root: Path) -> tuple[Node, Path]:
    """Reads a scene given by file name or as a mapping, includes expanded.

    Args:
        node: the value of a task's ``scene``.
        file: the task's file.
        root: folder that included files must lie in.

    Returns:
        The scene's mapping and the file that counts as its own.
    """
    if isinstance(node.value, str):
        target = include_file(node, file, root, (file.resolve(),))
        return target, included_path(node, file)
    if not isinstance(node.value, dict):
        raise node.error((), "expected a scene: the name of a scene file, or a mapping")
    return expand(node, file, root), file

"""What an MJCF file may consist of and ask for, checked before MuJoCo reads it.

A model file may come from somebody else. The files it names, through includes too, have to lie
below its own folder; it loads no code; and what a few words in it can multiply to (copies, height
fields, textures) is added up first.
"""

from __future__ import annotations

import struct
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from etot_cli.errors import SpecError, WorldError
from etot_cli.specs.bounds import MAX_PICTURE_SIDE
from etot_cli.specs.reading import read_bytes
from etot_cli.world.build.mesh_files import MAX_BYTES, check_size

MAX_XML_BYTES = 4 * 1024 * 1024
"""A robot with all its parts has some 50 kB."""
MAX_INCLUDES = 32
"""Files that a model may consist of."""
MAX_DEPTH = 64
"""Elements in elements; an arm of seven joints has some ten."""
MAX_ELEMENTS = 20_000
"""Elements of a model, the copies of ``replicate`` counted."""
MAX_GRID = 1024 * 1024
"""Cells of a height field."""
MAX_PIXELS = MAX_PICTURE_SIDE**2
"""Of a texture, its six sides together."""
MAX_BUILTIN = 200
"""Edges or levels of a mesh that MuJoCo makes itself."""
MAX_SIZE = 100_000
"""Entries that ``size`` may set aside."""
FOLDERS = ("meshdir", "texturedir", "assetdir")
MESHES = (".obj", ".stl")
REFUSED = {
    "plugin": "plugins are not accepted, they are code",
    "extension": "plugins are not accepted, they are code",
    "model": "models in models are not accepted; use <include>",
    "attach": "models in models are not accepted; use <include>",
    "flexcomp": "soft bodies are not simulated here",
    "flex": "soft bodies are not simulated here",
    "composite": "composites are not accepted; write their bodies out",
    "skin": "skins are not shown here",
}


def check_mjcf(path: Path) -> None:
    """Checks a model and everything that it includes and names.

    Raises:
        WorldError: it escapes its folder, asks for too much, or is no XML.
    """
    base = path.parent.resolve()
    trees: dict[Path, Element] = {}
    waiting = [path]
    while waiting:
        current = waiting.pop()
        resolved = current.resolve()
        if resolved in trees:
            continue
        if len(trees) == MAX_INCLUDES:
            raise WorldError(f"{path.name}: consists of more than {MAX_INCLUDES} files")
        trees[resolved] = root = _read(current)
        waiting += [
            _inside(base, "", element.get("file", ""), current, "include")
            for element in root.iter("include")
        ]
    # A folder that is set in one file counts in all of them.
    folders = {"", *(item.get(key, "") for tree in trees.values() for item in tree.iter()
                     for key in FOLDERS)}  # fmt: skip
    total = 0.0
    for file, tree in trees.items():
        total += _expanded(tree, file)
        for element in tree.iter():
            _check_element(element, base, folders, file)
    if total > MAX_ELEMENTS:
        raise WorldError(
            f"{path.name}: comes to {total:.3g} elements with its copies; expected at most "
            f"{MAX_ELEMENTS}"
        )


class _Builder(ElementTree.TreeBuilder):
    """Builds a tree as long as that is neither deep nor large."""

    def __init__(self) -> None:
        super().__init__()
        self._depth = self._count = 0

    def start(self, tag: str, attrs: dict[str, str], /) -> Element:
        self._depth += 1
        self._count += 1
        if self._depth > MAX_DEPTH or self._count > MAX_ELEMENTS:
            raise WorldError(
                f"expected at most {MAX_ELEMENTS} elements, nested at most {MAX_DEPTH} deep"
            )
        return super().start(tag, attrs)

    def end(self, tag: str, /) -> Element:
        self._depth -= 1
        return super().end(tag)

    def doctype(self, name: str, pubid: str | None, system: str | None, /) -> None:
        raise WorldError("a document type is not accepted")


def _read(path: Path) -> Element:
    try:
        data = read_bytes(path, MAX_XML_BYTES, "an MJCF model")
        if b"<!ENTITY" in data:
            raise WorldError("entities are not accepted")
        parser = ElementTree.XMLParser(target=_Builder())
        parser.feed(data)
        return parser.close()
    except SpecError as error:
        raise WorldError(f"{path.name}: {error.message}") from None
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise WorldError(f"{path.name}: not readable as XML ({error})") from None
    except WorldError as error:
        raise WorldError(f"{path.name}: {error}") from None


def _check_element(element: Element, base: Path, folders: set[str], file: Path) -> None:
    tag = element.tag
    if tag in REFUSED:
        raise WorldError(f"{file.name}: <{tag}>: {REFUSED[tag]}")
    for key, value in element.attrib.items():
        if key.startswith("file") and tag != "include":
            for folder in folders:
                _check_file(_inside(base, folder, value, file, tag), tag, file)
    if tag == "hfield":
        cells = _number(element, "nrow", file) * _number(element, "ncol", file)
        _at_most(cells, MAX_GRID, "cells in a height field", file)
    elif tag == "texture":
        width, height = _number(element, "width", file), _number(element, "height", file)
        _at_most(max(width, 1.0) * max(height, 1.0, 6 * width * (element.get("type") != "2d")),
                 6 * MAX_PIXELS, "pixels in a texture", file)  # fmt: skip
    elif tag == "mesh" and element.get("builtin"):
        for word in element.get("params", "").split():
            _at_most(_value(word, "params", file), MAX_BUILTIN, "steps in a builtin mesh", file)
    elif tag == "size":
        if element.get("memory"):
            raise WorldError(f"{file.name}: <size memory>: an object sets no memory aside")
        for key in element.attrib:
            _at_most(_number(element, key, file), MAX_SIZE, f"for size {key}", file)


def _expanded(element: Element, file: Path) -> float:
    """How many elements MuJoCo makes of one; the depth is bounded already."""
    count = max(_number(element, "count", file), 0.0) if element.tag == "replicate" else 1.0
    return 1.0 + count * sum(_expanded(child, file) for child in element)


def _inside(base: Path, folder: str, value: str, file: Path, tag: str) -> Path:
    """The file that an element names, which has to lie below the model's own folder."""
    outside = "\0" in value or "\\" in value or "\\" in folder
    try:
        target = base / folder / value
        outside = outside or not target.resolve().is_relative_to(base)
    except (OSError, RuntimeError, ValueError):
        outside = True
    if outside:
        raise WorldError(
            f"{file.name}: <{tag}> names {value[:80]!r}, which lies outside the file's own folder"
        )
    return target


def _check_file(target: Path, tag: str, file: Path) -> None:
    """Bounds what a file that is there unpacks to; what is missing, MuJoCo says."""
    if not target.exists():
        return
    try:
        if tag == "mesh":
            if target.suffix.lower() not in MESHES:
                raise SpecError(f"expected a mesh file ending in {' or '.join(MESHES)}")
            check_size(read_bytes(target, MAX_BYTES, "a mesh"), target.suffix[1:].lower(),
                       target.name)  # fmt: skip
        else:
            _check_picture(read_bytes(target, MAX_BYTES, "a PNG picture"), target)
    except SpecError as error:
        raise WorldError(f"{file.name}: {error}") from None


def _check_picture(data: bytes, target: Path) -> None:
    if not data.startswith(b"\x89PNG") or len(data) < 24:
        raise SpecError("expected a PNG picture", file=target.name)
    width, height = struct.unpack(">II", data[16:24])
    if width * height > MAX_PIXELS:
        raise SpecError(
            f"is {width} × {height} pixels; expected at most {MAX_PIXELS}", file=target.name
        )


def _number(element: Element, key: str, file: Path) -> float:
    return _value(element.get(key, "0").strip() or "0", key, file)


def _value(text: str, key: str, file: Path) -> float:
    try:
        return float(text)
    except ValueError:
        raise WorldError(f"{file.name}: {key}={text[:40]!r} is no number") from None


def _at_most(value: float, limit: float, what: str, file: Path) -> None:
    if not value <= limit:
        raise WorldError(f"{file.name}: {value:.3g} {what}; expected at most {limit:g}")

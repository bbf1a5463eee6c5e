"""Reads one YAML file safely into nodes that remember file, line and path.

What the documents need of YAML is small: mappings with text keys, lists, text, numbers, true,
false and null. Everything else (tags, merge keys, several documents, repeated keys) is refused, and
so is whatever could make a small file expensive. Scalars follow YAML 1.2: ``on``, ``off``, ``yes``
and ``no`` are text, which matters because ``on`` is a key of ours, and ``1e-3`` is a number.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from etot_cli.errors import SpecError
from etot_cli.specs.reading import read_text

MAX_DEPTH = 32
"""Deepest nesting of mappings and lists; aliases count at the place where they are used."""
_TOO_DEEP = f"nested deeper than {MAX_DEPTH} levels"
MAX_NODES = 20_000
"""Values in one document, aliases expanded. A scene of 64 objects has about a thousand."""
MAX_DIGITS = 40
"""Longer numbers are refused; no quantity of ours needs them."""

Step = str | int
"""One step of a path: a mapping's key or a list's index, from 0."""
DataPath = tuple[Step, ...]


@dataclass(frozen=True, slots=True)
class Place:
    """Where a value stands.

    Args:
        file: the document, as the user named it.
        line: 1-based; for a mapping's value it is the line of its key.
        path: path inside that document.
    """

    file: str
    line: int
    path: DataPath = ()


@dataclass(frozen=True, slots=True)
class Node:
    """A value and its place. The children of an alias keep the places of the anchored original."""

    value: dict[str, Node] | list[Node] | str | int | float | bool | None
    place: Place

    def plain(self) -> Any:
        """The value as plain data."""
        if isinstance(self.value, dict):
            return {key: child.plain() for key, child in self.value.items()}
        if isinstance(self.value, list):
            return [child.plain() for child in self.value]
        return self.value

    def child(self, step: Step) -> Node | None:
        """One step down, or None."""
        if isinstance(self.value, dict) and isinstance(step, str):
            return self.value.get(step)
        if isinstance(self.value, list) and isinstance(step, int) and step < len(self.value):
            return self.value[step]
        return None

    def locate(self, path: DataPath) -> Place:
        """The place of a value below this node; what is not written is placed at its parent's
        line, with the full path.
        """
        node = self
        for index, step in enumerate(path):
            child = node.child(step)
            if child is None:
                place = node.place
                return Place(place.file, place.line, place.path + path[index:])
            node = child
        return node.place

    def error(self, path: DataPath, message: str) -> SpecError:
        """The error to raise about a value below this node."""
        place = self.locate(path)
        return SpecError(message, file=place.file, line=place.line, path=path_text(place.path))


def path_text(path: DataPath) -> str:
    """Writes ``("success", 0, "on")`` as ``success[0].on``."""
    text = ""
    for step in path:
        if isinstance(step, int):
            text += f"[{step}]"
        else:
            shown = step if step.isprintable() and len(step) <= 60 else repr(step[:60])
            text += f".{shown}" if text else shown
    return text


def read_document(path: Path) -> Node:
    """Reads a YAML file.

    Args:
        path: the file, which messages call as it is given.

    Raises:
        SpecError: unreadable, not YAML, or beyond what documents may contain.
    """
    return parse_document(read_text(path, str(path)), str(path))


def parse_document(text: str, file: str) -> Node:
    """Parses the text of a YAML document; see :func:`read_document`."""
    try:
        return _Builder(text, file).build()
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = None if mark is None else mark.line + 1
        problem = " ".join(part for part in (error.context, error.problem) if part)
        if "maximum nesting depth" in problem:  # libyaml of PyYAML 6.0.4 stops there on its own
            raise SpecError(_TOO_DEEP, file=file, line=line) from None
        if line is not None and _indented_with_tab(text, line):
            problem += "; indent with spaces, not tabs"
        raise SpecError(f"not valid YAML: {problem}", file=file, line=line) from None
    except yaml.YAMLError as error:
        raise SpecError(f"not valid YAML: {' '.join(str(error).split())}", file=file) from None


def _indented_with_tab(text: str, line: int) -> bool:
    lines = text.splitlines()
    row = lines[line - 1] if line <= len(lines) else ""
    return "\t" in row[: len(row) - len(row.lstrip())]


# libyaml is several times faster; both give the same events.
_LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


class _Builder:
    """Builds nodes from parser events, counting as it goes so that nothing explodes first."""

    def __init__(self, text: str, file: str) -> None:
        self._file = file
        self._events: Iterator[Any] = yaml.parse(text, Loader=_LOADER)
        self._nodes = 0
        self._anchors: dict[str, tuple[Node, int, int]] = {}

    def build(self) -> Node:
        next(self._events)  # stream start
        if isinstance(next(self._events), yaml.StreamEndEvent):
            raise SpecError("the file is empty; expected keys and values", file=self._file)
        root = self._node(next(self._events), ())
        next(self._events)  # document end
        following = next(self._events)
        if not isinstance(following, yaml.StreamEndEvent):
            line = following.start_mark.line + 1
            raise self._error("a second document starts here; expected only one", line, ())
        if root.value is None:
            raise SpecError("the file is empty; expected keys and values", file=self._file)
        if not isinstance(root.value, dict):
            raise self._error("expected keys and values at the top", root.place.line, ())
        return root

    def _node(self, event: Any, path: DataPath, line: int | None = None) -> Node:
        """Reads the value that starts with ``event``; ``line`` is its key's line."""
        line = event.start_mark.line + 1 if line is None else line
        place = Place(self._file, line, path)
        if isinstance(event, yaml.AliasEvent):
            return self._alias(event, place)
        self._count(1, place)
        self._check_depth(len(path), place)
        if event.tag is not None:
            raise self._error(f"the tag {event.tag!r} is not supported", line, path)
        before = self._nodes
        if isinstance(event, yaml.MappingStartEvent):
            node = Node(self._mapping(path), place)
        elif isinstance(event, yaml.SequenceStartEvent):
            node = Node(self._sequence(path), place)
        else:
            plain = event.implicit[0]
            node = Node(self._scalar(event.value, place) if plain else event.value, place)
        if event.anchor is not None:
            # Kept only now, so an alias inside its own anchor is unknown rather than endless.
            self._anchors[event.anchor] = (node, self._nodes - before + 1, _height(node))
        return node

    def _mapping(self, path: DataPath) -> dict[str, Node]:
        result: dict[str, Node] = {}
        while not isinstance(key := next(self._events), yaml.MappingEndEvent):
            line = key.start_mark.line + 1
            if not isinstance(key, yaml.ScalarEvent):
                raise self._error("a key must be a word, not a list or mapping", line, path)
            name = str(key.value)
            if key.tag is not None:
                raise self._error(f"the tag {key.tag!r} is not supported", line, (*path, name))
            if name == "<<":
                raise self._error("merge keys are not supported; use 'include'", line, path)
            if name in result:
                first = result[name].place.line
                raise self._error(f"key given twice, first in line {first}", line, (*path, name))
            result[name] = self._node(next(self._events), (*path, name), line)
        return result

    def _sequence(self, path: DataPath) -> list[Node]:
        result: list[Node] = []
        while not isinstance(event := next(self._events), yaml.SequenceEndEvent):
            result.append(self._node(event, (*path, len(result))))
        return result

    def _alias(self, event: Any, place: Place) -> Node:
        found = self._anchors.get(event.anchor)
        if found is None:
            raise self._error(
                f"alias *{event.anchor} refers to nothing defined before it", place.line, place.path
            )
        node, weight, height = found
        self._count(weight, place)
        self._check_depth(len(place.path) + height, place)
        return Node(node.value, place)

    def _scalar(self, text: str, place: Place) -> str | int | float | bool | None:
        if text in ("", "~", "null", "Null", "NULL"):
            return None
        if text in ("true", "True", "TRUE", "false", "False", "FALSE"):
            return text.lower() == "true"
        if _NOT_FINITE.fullmatch(text):
            raise self._error(f"found {text}, expected a finite number", place.line, place.path)
        integer = _INTEGER.fullmatch(text) is not None
        if not integer and not _FLOAT.fullmatch(text):
            return text
        if len(text) > MAX_DIGITS:
            raise self._error(
                f"a number of {len(text)} characters; expected at most {MAX_DIGITS}",
                place.line,
                place.path,
            )
        if integer:
            return int(text)
        number = float(text)
        if not math.isfinite(number):
            raise self._error(f"found {text}, expected a finite number", place.line, place.path)
        return number

    def _count(self, number: int, place: Place) -> None:
        self._nodes += number
        if self._nodes > MAX_NODES:
            raise self._error(
                f"more than {MAX_NODES} values (aliases expanded)", place.line, place.path[:1]
            )

    def _check_depth(self, depth: int, place: Place) -> None:
        if depth > MAX_DEPTH:
            raise self._error(_TOO_DEEP, place.line, place.path[:1])

    def _error(self, message: str, line: int, path: DataPath) -> SpecError:
        return SpecError(message, file=self._file, line=line, path=path_text(path))


def _height(node: Node) -> int:
    """Levels below a node."""
    if isinstance(node.value, dict):
        return 1 + max(map(_height, node.value.values()), default=0)
    if isinstance(node.value, list):
        return 1 + max(map(_height, node.value), default=0)
    return 0


_INTEGER = re.compile(r"[-+]?[0-9]+")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_NOT_FINITE = re.compile(r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)")

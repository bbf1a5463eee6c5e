"""Object libraries: known things with their true sizes, by the names that people use for them.

A library is a YAML file whose ``objects`` are written as in a scene, poses left out (or ignored, so
that any scene file will do). ``names`` lists what else a thing is called.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from etot_cli.errors import SpecError
from etot_cli.specs.document import Node, Place, read_document
from etot_cli.specs.files import resolve_files
from etot_cli.specs.include import expand, project_root
from etot_cli.specs.objects import Mesh, SceneObject
from etot_cli.specs.problems import show, validate
from etot_cli.specs.scene import Scene
from etot_cli.world.build.mesh_files import MeshFile, parse_mesh

MOST_NAMES = 16
"""That one entry goes by."""
LONGEST_NAME = 60
"""As long as the label of an object in a scene may be [characters]."""
POSE_KEYS = ("at", "on", "inside", "yaw_deg", "quaternion")
UNUSABLE = ("shelf", "mjcf")
"""Kinds that cannot be found in a picture."""
Words = tuple[str, ...]


@dataclass(frozen=True)
class Entry:
    """A known thing: its name, all names as lists of words, its scene keys, a mesh's file."""

    name: str
    names: tuple[Words, ...]
    spec: SceneObject
    mesh: MeshFile | None = None


@dataclass(frozen=True)
class Library:
    """Known things."""

    entries: tuple[Entry, ...]

    def named(self, name: str) -> Entry | None:
        """The thing that an object's name ends with: ``red_mug_2`` may be a ``mug``.

        Of several the one with the longest name.
        """
        words = words_of(name)
        fitting = [
            (len(known), entry) for entry in self.entries for known in entry.names
            if words[-len(known) :] == known
        ]  # fmt: skip
        return max(fitting, key=lambda item: item[0])[1] if fitting else None

    def mentioned(self, text: str | None) -> list[tuple[Entry, Words]]:
        """The things that an instruction names, each with the words that it uses."""
        words = words_of(text or "")
        found = []
        for entry in self.entries:
            used = [known for known in entry.names if _stands_in(known, words)]
            if used:
                found.append((entry, max(used, key=len)))
        return found


def words_of(text: str) -> Words:
    """Lower-case words without numbers and without the s of the plural."""
    found = re.findall(r"[^\W\d_]+", text.lower())
    return tuple(word[:-1] if len(word) > 3 and word.endswith("s") else word for word in found)


def _stands_in(words: Words, text: Words) -> bool:
    return any(text[i : i + len(words)] == words for i in range(len(text) - len(words) + 1))


def without(text: str | None, names: Iterable[Words]) -> str | None:
    """A text without the mentions of some names."""
    if text is None:
        return None
    for words in names:
        pattern = r"\W+".join(f"{re.escape(word)}s?" for word in words)
        text = re.sub(rf"\b{pattern}\b", " ", text, flags=re.IGNORECASE)
    return text


def read_library(path: Path) -> Library:
    """Reads a library file.

    Raises:
        SpecError: it is unusable; the message says where, what was found and what is expected.
    """
    node = expand(read_document(path), path, project_root(path))
    if not isinstance(node.value, dict) or "objects" not in node.value:
        raise node.error((), "missing key 'objects', known things by name, written as in a scene")
    objects = node.value["objects"]
    if not isinstance(objects.value, dict) or not objects.value:
        raise node.error(
            ("objects",), f"found {show(objects.plain())}, expected known things by name"
        )
    names = {name: _names(name, item) for name, item in objects.value.items()}
    posed = Node({name: _posed(item) for name, item in objects.value.items()}, objects.place)
    document = Node({**node.value, "objects": posed}, node.place)
    scene = resolve_files(validate(Scene, document), document, path.parent)
    entries = []
    for name, spec in scene.objects.items():
        if spec.kind in UNUSABLE:
            raise document.error(
                ("objects", name, "kind"), f"a {spec.kind} cannot be looked for in a picture"
            )
        mesh = None
        if isinstance(spec, Mesh):
            file = Path(scene.directory) / spec.file
            try:
                mesh = parse_mesh(file.read_bytes(), file.suffix[1:].lower(), spec.file)
            except SpecError as error:
                raise document.error(("objects", name, "file"), str(error)) from None
        entries.append(Entry(name, names[name], spec, mesh))
    _refuse_shared_names(document, entries)
    return Library(tuple(entries))


def _names(name: str, item: Node) -> tuple[Words, ...]:
    """The words of an entry's name, of its ``names`` and of its label."""
    listed = item.child("names")
    texts = [name]
    if listed is not None:
        if not isinstance(listed.value, list) or not 1 <= len(listed.value) <= MOST_NAMES:
            raise item.error(
                ("names",), f"found {show(listed.plain())}, expected a list of 1 to {MOST_NAMES} "
                "names",
            )  # fmt: skip
        for index, entry in enumerate(listed.value):
            if not isinstance(entry.value, str) or len(entry.value) > LONGEST_NAME:
                raise item.error(
                    ("names", index), f"found {show(entry.plain())}, expected a name of at most "
                    f"{LONGEST_NAME} characters",
                )  # fmt: skip
            if not words_of(entry.value):
                raise item.error(("names", index), f"found {show(entry.value)}, which has no word")
            texts.append(entry.value)
    label = item.child("label")
    if label is not None and isinstance(label.value, str):
        texts.append(label.value)
    return tuple(dict.fromkeys(words for text in texts if (words := words_of(text))))


def _posed(item: Node) -> Node:
    """An entry as a scene's object: without names, at a pose that is not looked at."""
    if not isinstance(item.value, dict):
        return item
    kept = {k: v for k, v in item.value.items() if k != "names" and k not in POSE_KEYS}
    place = Place(item.place.file, item.place.line, (*item.place.path, "at"))
    kept["at"] = Node([Node(0.4, place), Node(0.0, place)], place)
    return Node(kept, item.place)


def _refuse_shared_names(node: Node, entries: list[Entry]) -> None:
    owners: dict[Words, str] = {}
    for entry in entries:
        for words in entry.names:
            if words in owners:
                raise node.error(
                    ("objects", entry.name),
                    f"is called {' '.join(words)!r}, which {owners[words]!r} is called too",
                )
            owners[words] = entry.name

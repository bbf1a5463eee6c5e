"""Mesh files from anywhere: what is read, and what is refused before it costs anything."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import trimesh

from etot_cli.errors import SpecError
from etot_cli.world.build.mesh_files import MAX_FACES, parse_mesh
from tests.reconstruction.meshes import mug, toy


@pytest.mark.parametrize("kind", ["glb", "obj", "stl"])
def test_formats(kind: str) -> None:
    """All come back with z up; only GLB says in its standard that y is."""
    mesh = toy()
    if kind == "glb":
        mesh = trimesh.Trimesh(np.asarray(mesh.vertices)[:, [0, 2, 1]] * [1, 1, -1], mesh.faces)
    data = mesh.export(file_type=kind)
    found = parse_mesh(data.encode() if isinstance(data, str) else data, kind, "toy")
    assert np.ptp(found.vertices, axis=0) == pytest.approx([0.102, 0.053, 0.077], abs=0.001)
    turn = found.upright
    assert turn @ turn.T == pytest.approx(np.eye(3)) and np.linalg.det(turn) == pytest.approx(1)


def test_vertices_that_no_face_uses_are_dropped() -> None:
    data = trimesh.creation.box([1, 1, 1]).export(file_type="obj") + "\nv 90 90 90\n"
    found = parse_mesh(data.encode(), "obj", "box")
    assert np.ptp(found.vertices, axis=0) == pytest.approx([1, 1, 1])


def glb(change: Callable[[dict[str, Any]], object]) -> bytes:
    """A mug as GLB with its JSON changed."""
    data = bytes(mug().export(file_type="glb"))
    length = int.from_bytes(data[12:16], "little")
    document = json.loads(data[20 : 20 + length])
    change(document)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length :]
    total = 20 + len(text) + len(rest)
    return (b"glTF" + (2).to_bytes(4, "little") + total.to_bytes(4, "little")
            + len(text).to_bytes(4, "little") + b"JSON" + text + rest)  # fmt: skip


def doubled(document: dict[str, Any]) -> None:
    """Thirty nodes, each of which holds the next one twice: a thousand million mugs."""
    count = len(document["nodes"])
    document["nodes"] += [{"children": [count + i + 1] * 2} for i in range(30)]
    document["nodes"].append({"mesh": 0})
    document["scenes"][0]["nodes"] = [count]


def repeated(document: dict[str, Any]) -> None:
    """The mug five hundred times."""
    document["nodes"] += [{"mesh": 0} for _ in range(500)]


def obj(faces: int) -> bytes:
    return b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + b"f 1 2 3\nf 2 3 4\n" * (faces // 2)


BAD: dict[str, tuple[bytes, str, str]] = {
    "empty": (b"", "obj", "not a readable mesh|faces"),
    "text": (b"hello", "stl", "not a readable mesh|faces"),
    "no glb": (b"hello", "glb", "no GLB file"),
    "cut off": (glb(lambda d: None)[:60], "glb", "JSON part is damaged"),
    "cut later": (glb(lambda d: None)[:-900], "glb", "not a readable mesh"),
    "counts": (glb(lambda d: d["accessors"][0].update(count=10**9)), "glb", "an accessor has no"),
    "no count": (glb(lambda d: d["accessors"][0].update(count="9")), "glb", "an accessor has no"),
    "doubled": (glb(doubled), "glb", "a node has several parents"),
    "repeated": (glb(repeated), "glb", "about .* faces; expected at most"),
    "nodes": (glb(lambda d: d["nodes"].extend([{}] * 600)), "glb", "600 accessors|nodes; expected"),
    "many faces": (obj(MAX_FACES + 10), "obj", f"expected 4 to {MAX_FACES}"),
    "flat": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n" + b"f 1 2 3\nf 2 3 4\n" * 2, "obj", "is flat"),
    "not finite": (obj(6).replace(b"v 1 0 0", b"v nan 0 0"), "obj", "finite vertices"),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_refused(case: str) -> None:
    data, kind, message = BAD[case]
    with pytest.raises(SpecError, match=message) as caught:
        parse_mesh(data, kind, "thing")
    assert str(caught.value).startswith("thing: ")

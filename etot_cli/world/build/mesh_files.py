"""Reads mesh files from users and servers: GLB, OBJ and STL, checked before they cost anything.

A GLB file is JSON that says how much there is, so a few bytes can ask for gigabytes, or for one
mesh a million times. What it says is added up first.
"""

from __future__ import annotations

import io
import json
import struct
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import SpecError
from etot_cli.specs.files import MAX_FILE_BYTES

Array = NDArray[np.float64]

MAX_FACES = 200_000
"""A scan of a hand-sized thing has fewer; the collision pieces are made from all of them."""
MAX_BYTES = MAX_FILE_BYTES
"""So many faces take 10 MB as binary STL, and some five times that as text."""
SUFFIXES = {".glb": "glb", ".obj": "obj", ".stl": "stl"}
MAX_VALUES = 6 * MAX_FACES
"""Entries in one accessor of a GLB file; a mesh has three indices for each face."""
MAX_ACCESSORS = 512
MAX_NODES = 512
"""Parts of a GLB file; a household thing has a handful."""
_GLB_MAGIC, _JSON_CHUNK = 0x46546C67, 0x4E4F534A
"""The letters ``glTF`` and ``JSON`` as little-endian numbers, as the format demands."""


@dataclass(frozen=True)
class MeshFile:
    """A mesh as its file gives it.

    ``data`` and ``kind`` (glb, obj or stl): the file; ``vertices`` (n, 3) in the file's units, z up
    (GLB is y up and is turned); ``faces`` (m, 3); ``shown``: its name in messages.
    """

    data: bytes
    kind: str
    vertices: Array
    faces: NDArray[np.int64]
    shown: str

    @property
    def upright(self) -> Array:
        """Rotation (3, 3) from the file's axes to those of ``vertices``."""
        if self.kind != "glb":
            return np.eye(3)
        return np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])


def parse_mesh(data: bytes, kind: str, shown: str) -> MeshFile:
    """Reads a mesh.

    Args:
        data: the file's bytes.
        kind: ``glb``, ``obj`` or ``stl``.
        shown: what messages call it.

    Raises:
        SpecError: it is no usable mesh.
    """
    import trimesh

    check_size(data, kind, shown)
    try:
        mesh: Any = trimesh.load(
            io.BytesIO(data), file_type=kind, force="mesh", skip_materials=True
        )
        vertices = np.asarray(mesh.vertices, dtype=np.float64)
        faces = np.asarray(mesh.faces, dtype=np.int64)
        if faces.size and not 0 <= faces.min() <= faces.max() < len(vertices):
            raise IndexError
    except Exception as error:  # readers raise whatever they like
        raise SpecError(f"not a readable mesh ({type(error).__name__})", file=shown) from None
    if not 4 <= len(faces) <= MAX_FACES or not np.isfinite(vertices).all():
        raise SpecError(
            f"found {len(faces)} faces; expected 4 to {MAX_FACES} with finite vertices", file=shown
        )
    vertices, faces = _used(vertices, faces)
    extents = np.ptp(vertices, axis=0)
    if extents.min() <= 1e-6 * extents.max():
        raise SpecError("the mesh is flat: it encloses no volume", file=shown)
    found = MeshFile(data, kind, vertices, faces, shown)
    return replace(found, vertices=vertices @ found.upright.T)


def check_size(data: bytes, kind: str, shown: str) -> None:
    """Refuses a mesh file that unpacks to more than a mesh needs, before anything unpacks it.

    Raises:
        SpecError: it does.
    """
    if len(data) > MAX_BYTES:
        raise SpecError(f"larger than {MAX_BYTES // 2**20} MiB", file=shown)
    if kind == "glb":
        _check_glb(data, shown)
        return
    if kind == "obj":
        # A polygon of n corners becomes n - 2 triangles.
        faces = sum(max(len(line.split()) - 3, 1) for line in data.splitlines()
                    if line.lstrip()[:1] == b"f")  # fmt: skip
    else:
        # Binary files say how many; some begin with the word that text begins with.
        faces = (len(data) - 84) // 50
        if len(data) < 84 or struct.unpack_from("<I", data, 80)[0] != faces:
            faces = data.count(b"endfacet")
    if faces > MAX_FACES:
        raise SpecError(f"found {faces} faces; expected 4 to {MAX_FACES}", file=shown)


def _used(vertices: Array, faces: NDArray[np.int64]) -> tuple[Array, NDArray[np.int64]]:
    """Only the vertices that faces use: a stray one would stretch the mesh."""
    kept, places = np.unique(faces, return_inverse=True)
    return vertices[kept], places.reshape(faces.shape).astype(np.int64)


def _check_glb(data: bytes, shown: str) -> None:
    """Refuses a GLB file that asks for more than a mesh needs.

    Raises:
        SpecError: it does, or it is no GLB file.
    """
    document = _glb_document(data, shown)
    accessors, nodes = document.get("accessors", []), document.get("nodes", [])
    if not isinstance(accessors, list) or not isinstance(nodes, list):
        raise SpecError("not a readable GLB file: 'accessors' or 'nodes' is no list", file=shown)
    counts = [item.get("count") if isinstance(item, dict) else None for item in accessors]
    if any(not isinstance(count, int) or not 0 <= count <= MAX_VALUES for count in counts):
        raise SpecError(
            f"an accessor has no count, or one beyond {MAX_VALUES}: not a usable GLB file",
            file=shown,
        )
    if len(accessors) > MAX_ACCESSORS or len(nodes) > MAX_NODES:
        raise SpecError(
            f"found {len(accessors)} accessors and {len(nodes)} nodes; expected at most "
            f"{MAX_ACCESSORS} and {MAX_NODES}", file=shown,
        )  # fmt: skip
    children: list[Any] = []
    for node in nodes:
        listed = node.get("children", []) if isinstance(node, dict) else []
        children += listed if isinstance(listed, list) else []
    if len({str(child) for child in children}) != len(children):
        raise SpecError("a node has several parents: not a usable GLB file", file=shown)
    total = sum(_faces_of(node, document, counts) for node in nodes)
    if total > MAX_FACES:
        raise SpecError(f"found about {total} faces; expected at most {MAX_FACES}", file=shown)


def _glb_document(data: bytes, shown: str) -> dict[str, Any]:
    """The JSON part of a GLB file."""
    if len(data) < 20 or struct.unpack_from("<I", data)[0] != _GLB_MAGIC:
        raise SpecError("no GLB file: it does not start with 'glTF'", file=shown)
    length, kind = struct.unpack_from("<II", data, 12)
    try:
        if kind != _JSON_CHUNK or length > len(data) - 20:
            raise ValueError
        document = json.loads(data[20 : 20 + length])
        if not isinstance(document, dict):
            raise ValueError
    except (ValueError, RecursionError):
        raise SpecError("not a readable GLB file: its JSON part is damaged", file=shown) from None
    return document


def _faces_of(node: Any, document: dict[str, Any], counts: list[Any]) -> int:
    """Faces that one node of a GLB file puts into the scene."""
    meshes = document.get("meshes", [])
    index = node.get("mesh") if isinstance(node, dict) else None
    if not isinstance(index, int) or not isinstance(meshes, list) or not 0 <= index < len(meshes):
        return 0
    mesh = meshes[index]
    primitives = mesh.get("primitives", []) if isinstance(mesh, dict) else []
    total = 0
    for primitive in primitives if isinstance(primitives, list) else []:
        if not isinstance(primitive, dict):
            continue
        accessor = primitive.get("indices")
        if accessor is None:  # then every three vertices in a row are a face
            attributes = primitive.get("attributes")
            accessor = attributes.get("POSITION") if isinstance(attributes, dict) else None
        if isinstance(accessor, int) and 0 <= accessor < len(counts):
            total += int(counts[accessor]) // 3
    return total

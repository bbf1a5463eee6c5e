"""Objects from files: free-form meshes (convex pieces by CoACD, cached) and MJCF models."""

from __future__ import annotations

import hashlib
import os
import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import WorldError
from etot_cli.specs import scene as specs
from etot_cli.world.build.material import Look, add_geom, add_visual
from etot_cli.world.index import Face, Graspable, Part, Region, Surface
from etot_cli.world.state import PartInfo

COACD_THRESHOLD = 0.08
"""Concavity at which CoACD stops splitting; finer pieces cost stepping time."""
MAX_PIECES = 48
COACD_SEARCH = {"mcts_iterations": 60, "mcts_nodes": 10, "preprocess_resolution": 40}
"""How long CoACD looks for cuts: as many pieces as with its own defaults, in a third of the time.
A mug of 116 mm takes 20 s of processor time."""
_MAX_FACES = 200_000
MAX_INCLUDES = 32
"""Files that an MJCF object may consist of."""
CONVEX_ENOUGH = 0.97
"""Volume over hull volume from which a mesh is taken as convex."""


def add_mesh(mj: mujoco.MjSpec, body: Any, spec: specs.Mesh, look: Look, name: str,
             directory: str) -> NDArray[np.float64]:  # fmt: skip
    """A mesh with convex collision pieces; returns its extents (3,) [m], centred on its box.

    Raises:
        WorldError: the file is no usable mesh.
    """
    path = Path(directory) / spec.file
    vertices, faces = _load(path, spec.scale)
    center = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    vertices = vertices - center
    seen = mj.add_mesh(name=f"{name}/seen")
    seen.uservert = vertices.ravel().tolist()
    seen.userface = faces.ravel().tolist()
    seen.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
    add_visual(body, look.rgba, mujoco.mjtGeom.mjGEOM_MESH, [0, 0, 0], mesh=f"{name}/seen")
    try:
        pieces = convex_pieces(vertices, faces)
    except WorldError as error:
        raise WorldError(f"{path.name}: {error}") from error
    volumes = np.array([_hull_volume(piece) for piece in pieces])
    for index, piece in enumerate(pieces):
        mesh = mj.add_mesh(name=f"{name}/piece{index}")
        mesh.uservert = piece.ravel().tolist()
        part = look
        if spec.mass is not None:
            part = look.with_mass(max(spec.mass * volumes[index] / volumes.sum(), 1e-6))
        geom = add_geom(
            body, part, mujoco.mjtGeom.mjGEOM_MESH, [0, 0, 0], mesh=f"{name}/piece{index}"
        )
        geom.group = 3
    extents: NDArray[np.float64] = vertices.max(axis=0) - vertices.min(axis=0)
    return extents


def _load(path: Path, scale: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    import trimesh

    try:
        mesh = trimesh.load(path, force="mesh")
    except Exception as error:  # trimesh raises whatever its readers raise
        raise WorldError(f"{path.name}: not a readable mesh ({error})") from error
    vertices = np.asarray(getattr(mesh, "vertices", []), dtype=np.float64) * scale
    faces = np.asarray(getattr(mesh, "faces", []), dtype=np.int64)
    if len(vertices) < 4 or len(faces) < 4 or not np.isfinite(vertices).all():
        raise WorldError(f"{path.name}: expected a mesh with at least 4 finite vertices and faces")
    if len(faces) > _MAX_FACES:
        raise WorldError(f"{path.name}: {len(faces)} faces; expected at most {_MAX_FACES}")
    extents = vertices.max(axis=0) - vertices.min(axis=0)
    if extents.max() > 2.0 or extents.max() < 0.002:
        raise WorldError(
            f"{path.name}: its largest side is {extents.max():.4g} m; expected 0.002 to 2 m "
            "(set 'scale', e.g. 0.001 for a file in millimetres)"
        )
    return vertices, faces


def convex_pieces(
    vertices: NDArray[np.float64], faces: NDArray[np.int64]
) -> list[NDArray[np.float64]]:
    """Convex pieces, as vertex arrays (k, 3), of a mesh; cached by content.

    The cache is ``$ETOT_CACHE`` or ``~/.cache/etot``; an unwritable cache only costs time.
    """
    key = hashlib.sha256(
        vertices.astype("<f4").tobytes() + faces.astype("<i4").tobytes()
        + f"{COACD_THRESHOLD}/{MAX_PIECES}/{sorted(COACD_SEARCH.items())}".encode()
    ).hexdigest()[:32]  # fmt: skip
    folder = Path(os.environ.get("ETOT_CACHE") or Path.home() / ".cache" / "etot")
    cached = folder / f"{key}.npz"
    if cached.is_file():
        try:
            with np.load(cached) as stored:
                return [stored[name] for name in stored.files]
        except (OSError, ValueError, EOFError, zipfile.BadZipFile):
            pass  # a damaged entry is made again
    pieces = _decompose(vertices, faces)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        partial = folder / f"{key}.{os.getpid()}.tmp.npz"
        np.savez_compressed(partial, *pieces)
        partial.replace(cached)
    except OSError:
        pass
    return pieces


def _decompose(
    vertices: NDArray[np.float64], faces: NDArray[np.int64]
) -> list[NDArray[np.float64]]:
    import trimesh
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(vertices)
    except QhullError as error:
        raise WorldError("the mesh has no volume: all its points lie in one plane") from error
    mesh = trimesh.Trimesh(vertices, faces)
    if mesh.is_watertight and mesh.volume >= CONVEX_ENOUGH * hull.volume:
        return [vertices[hull.vertices]]
    import coacd

    coacd.set_log_level("error")
    parts = coacd.run_coacd(
        coacd.Mesh(vertices, faces),
        threshold=COACD_THRESHOLD,
        max_convex_hull=MAX_PIECES,
        seed=1,
        **COACD_SEARCH,
    )
    return [np.asarray(part[0], dtype=np.float64) for part in parts]


def _hull_volume(vertices: NDArray[np.float64]) -> float:
    from scipy.spatial import ConvexHull

    return float(ConvexHull(vertices).volume)


def attach_mjcf(
    mj: mujoco.MjSpec, body: Any, spec: specs.Mjcf, name: str, directory: str
) -> mujoco.MjSpec:
    """Attaches the file's bodies under ``body``, all names prefixed ``name/``; returns the child.

    Raises:
        WorldError: the file is no valid MJCF, or names a joint or site that it lacks.
    """
    path = Path(directory) / spec.file
    _refuse_outside_files(path)
    try:
        child = mujoco.MjSpec.from_file(str(path))
    except ValueError as error:
        raise WorldError(f"{path.name}: not a valid MJCF model ({error})") from error
    free = [joint for joint in child.joints if joint.type == mujoco.mjtJoint.mjJNT_FREE]
    for joint in free:
        child.delete(joint)
    joints = {joint.name for joint in child.joints}
    sites = {site.name for site in child.sites}
    for part_name, part in spec.parts.items():
        if part.joint not in joints:
            raise WorldError(
                f"{name}.parts.{part_name}: {path.name} has no joint {part.joint!r}; "
                f"it has {', '.join(sorted(joints)) or 'none'}"
            )
    wanted = [spec.container_site, spec.surface_site]
    for part in spec.parts.values():
        wanted += [part.container_site, part.front_site]
    for site in wanted:
        if site is not None and site not in sites:
            raise WorldError(
                f"{name}: {path.name} has no site {site!r}; it has "
                f"{', '.join(sorted(sites)) or 'none'}"
            )
    mj.attach(child, prefix=f"{name}/", frame=body.add_frame())
    return child


def _refuse_outside_files(path: Path) -> None:
    """Files that an MJCF file names, also through includes, must lie below its own folder.

    Raises:
        WorldError: naming the file that does not, or XML that cannot be read.
    """
    base = path.parent.resolve()
    waiting, seen = [path], set[Path]()
    while waiting:
        current = waiting.pop()
        if current.resolve() in seen:
            continue
        seen.add(current.resolve())
        if len(seen) > MAX_INCLUDES:
            raise WorldError(f"{path.name}: includes more than {MAX_INCLUDES} files")
        waiting += _named_files(current, base)


def _named_files(path: Path, base: Path) -> list[Path]:
    """Checks what one file names; returns the files it includes."""
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, OSError) as error:
        raise WorldError(f"{path.name}: not readable as XML ({error})") from error
    folders = {""}
    for element in root.iter():
        for key in ("meshdir", "texturedir", "assetdir"):
            folders.add(element.get(key, ""))
    included = []
    for element in root.iter():
        if element.tag in ("plugin", "extension"):
            raise WorldError(f"{path.name}: plugins are not accepted in object files")
        for key, value in element.attrib.items():
            if not key.startswith("file"):
                continue
            for folder in folders:
                if not (base / folder / value).resolve().is_relative_to(base):
                    raise WorldError(
                        f"{path.name}: <{element.tag}> names {value!r}, which lies outside "
                        "the file's own folder"
                    )
            if element.tag == "include":
                included.append(base / value)
    return included


def mjcf_parts(
    model: mujoco.MjModel, spec: specs.Mjcf, name: str
) -> tuple[tuple[Part, ...], tuple[Region, ...], tuple[Surface, ...]]:
    """Reads parts, containers and surfaces of an attached MJCF object from the compiled model."""
    parts: list[Part] = []
    regions: list[Region] = []
    surfaces: list[Surface] = []
    for part_name, part in spec.parts.items():
        joint = model.joint(f"{name}/{part.joint}")
        body = model.body(int(joint.bodyid[0])).name
        kind = "slide" if joint.type[0] == mujoco.mjtJoint.mjJNT_SLIDE else "hinge"
        lower, upper = (float(value) for value in joint.range)
        # The opening direction is away from whichever limit is nearer to zero.
        closed, opened = (lower, upper) if abs(lower) <= abs(upper) else (upper, lower)
        address = name if len(spec.parts) == 1 else f"{name}.{part_name}"
        info = PartInfo(
            name, part_name, address, kind, abs(opened - closed), part.container_site is not None
        )
        outer, inner = _faces(model, name, part, joint, body)
        grasps = _grasps(model, f"{name}/{part.front_site}", outer) if part.front_site else ()
        parts.append(Part(info, body, f"{name}/{part.joint}", closed, opened, outer, inner, grasps))
        if part.container_site:
            regions.append(_region(model, f"{name}/{part.container_site}", address))
    if spec.container_site:
        regions.append(_region(model, f"{name}/{spec.container_site}", name))
    if spec.surface_site:
        site = model.site(f"{name}/{spec.surface_site}")
        center = tuple(site.pos + np.array([0, 0, site.size[2]]))
        surfaces.append(
            Surface(name, model.body(int(site.bodyid[0])).name, center,
                    (float(site.size[0]), float(site.size[1])))
        )  # fmt: skip
    return tuple(parts), tuple(regions), tuple(surfaces)


def _region(model: mujoco.MjModel, site_name: str, address: str) -> Region:
    site = model.site(site_name)
    is_round = int(site.type[0]) == mujoco.mjtGeom.mjGEOM_CYLINDER
    x, y, z = (float(value) for value in site.size)
    half = (x, x, y) if is_round else (x, y, z)
    body = model.body(int(site.bodyid[0])).name
    return Region(address, body, tuple(site.pos), half, is_round)


def _grasps(model: mujoco.MjModel, site_name: str, outer: Face) -> tuple[Graspable, ...]:
    """Ways to close the gripper on a part's ``front_site``, the thinnest side first.

    Along the face the hand comes from the front; across it, from any side. Whether the fingers
    find room behind it is for the collision checks to say.
    """
    site = model.site(site_name)
    center, half = np.array(site.pos), np.array(site.size)
    normal = np.array(outer.normal)
    grasps = []
    for index in np.argsort(half, kind="stable"):
        closing = np.eye(3)[index]
        if abs(closing @ normal) > 0.5:
            others = [i for i in range(3) if i != index]
            approaches = [-sign * np.eye(3)[i] for i in reversed(others) for sign in (1.0, -1.0)]
        else:
            approaches = [-normal]
        along = np.cross(closing, approaches[0])
        grasps.append(
            Graspable(
                _triple(center), _triple(closing), _triple(along),
                float(np.abs(along) @ half), float(2 * half[index]),
                tuple(_triple(item) for item in approaches),
            )
        )  # fmt: skip
    return tuple(grasps)


def _triple(values: NDArray[np.float64]) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in values)
    return x, y, z


def _faces(
    model: mujoco.MjModel, name: str, part: specs.MjcfPart, joint: Any, body: str
) -> tuple[Face, Face]:
    """Front and back faces of a part: of its ``front_site``, else of its outermost box of geoms."""
    axis = np.array(joint.axis)
    if part.front_site:
        site = model.site(f"{name}/{part.front_site}")
        center, half = np.array(site.pos), np.array(site.size)
    else:
        boxes = [
            (np.array(model.geom(i).pos), model.geom_aabb[i])
            for i in range(model.ngeom)
            if model.body(int(model.geom_bodyid[i])).name == body
        ]
        low = np.min([pos + box[:3] - box[3:] for pos, box in boxes], axis=0)
        high = np.max([pos + box[:3] + box[3:] for pos, box in boxes], axis=0)
        center, half = (low + high) / 2, (high - low) / 2
    if int(joint.type[0]) == mujoco.mjtJoint.mjJNT_SLIDE:
        normal = axis * np.sign(joint.range[1] + joint.range[0] or 1.0)
    else:
        lever = center - np.array(joint.pos)
        normal = np.cross(axis, lever - axis * (axis @ lever))
        normal *= np.sign(joint.range[1] + joint.range[0] or 1.0) / np.linalg.norm(normal)
    k = int(np.argmax(np.abs(normal)))
    u, v = (np.eye(3)[i] * half[i] for i in range(3) if i != k)
    direction = np.eye(3)[k] * np.sign(normal[k])
    outer = center + direction * half[k]
    if not part.front_site and int(joint.type[0]) == mujoco.mjtJoint.mjJNT_SLIDE:
        # Without a marked front only pushing from outside is known.
        inner = outer - direction * 2 * half[k]
    else:
        inner = center - direction * half[k]
    return (
        Face(tuple(outer), tuple(direction), tuple(u), tuple(v)),
        Face(tuple(inner), tuple(-direction), tuple(u), tuple(v)),
    )

"""Shapes and poses that come from outside: mesh files, an object library, mesh and pose servers."""

from __future__ import annotations

import base64
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from etot_cli.errors import SpecError
from etot_cli.reconstruction import services
from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.folder import safe_name, unique_name
from etot_cli.reconstruction.capture.view import Array, Mask
from etot_cli.reconstruction.known.kinds import SCALED_BY_FILE, extra_keys, fit_known_kind
from etot_cli.reconstruction.known.library import Entry, Library, read_library
from etot_cli.reconstruction.objects import DESK, KnownModel, Solid
from etot_cli.reconstruction.options import Options
from etot_cli.reconstruction.registration.evidence import target_of
from etot_cli.reconstruction.registration.model import Model, models_of
from etot_cli.reconstruction.registration.register import POOR, Registered, register
from etot_cli.specs.objects import Mesh
from etot_cli.world.build.mesh_files import MAX_BYTES, SUFFIXES, MeshFile, parse_mesh

SIZE_RANGE = (0.5, 2.0)
"""A known thing may be what was found when their longest sides differ by no more than this."""
OTHER_SIZE = 0.12
"""A fitted size that differs by more than this share from the known one is worth a warning."""


@dataclass(frozen=True)
class Given:
    """What the options' files say of shapes: a library, and meshes by the object's name."""

    library: Library
    meshes: dict[str, MeshFile]


def read_given(options: Options) -> Given:
    """Reads the files that say how things are shaped.

    Raises:
        SpecError: a mesh or library file is unusable.
    """
    library = Library(()) if options.library is None else read_library(options.library)
    return Given(library, {name: _read(path) for name, path in options.meshes.items()})


def given_shapes(
    seen: Calibrated, solids: list[Solid], options: Options, given: Given
) -> list[Solid]:
    """Solids with shapes that the user, a library or a server gives, registered with the picture.

    Raises:
        SpecError: a mesh is for an object that is not there.
        ServiceError: a server gives no usable answer.
    """
    unknown = set(options.meshes) - {solid.name for solid in solids}
    if unknown:
        raise SpecError(
            f"a mesh is given for {sorted(unknown)[0]!r}, which is not found; objects are "
            f"{', '.join(solid.name for solid in solids)}"
        )
    library, found = given.library, []
    for solid in solids:
        others = [*(o.segment.mask for o in solids if o is not solid), *seen.aside]
        entry = library.named(solid.name) if solid.segment.named else None
        if solid.name in options.meshes:
            mesh, source = given.meshes[solid.name], str(options.meshes[solid.name])
            found.append(_with_mesh(seen, solid, others, mesh, source, options))
        elif entry is not None:
            found.append(_from_library(seen, solid, others, entry, options))
        elif options.mesh_url is not None:
            mesh = _asked_mesh(seen, solid, options)
            found.append(_with_mesh(seen, solid, others, mesh, "mesh server", options))
        else:
            found.append(solid)
    return _recognized(seen, found, library, options)


def _read(path: Path) -> MeshFile:
    kind = SUFFIXES.get(path.suffix.lower())
    if kind is None or not path.is_file():
        raise SpecError("expected an existing .glb, .obj or .stl file", file=str(path))
    if path.stat().st_size > MAX_BYTES:
        raise SpecError(f"larger than {MAX_BYTES // 2**20} MiB", file=str(path))
    return parse_mesh(path.read_bytes(), kind, str(path))


def _asked_mesh(seen: Calibrated, solid: Solid, options: Options) -> MeshFile:
    """The mesh that a mesh server gives for an object."""
    assert options.mesh_url is not None  # asked by the caller
    data, kind = services.ask_mesh(
        options.mesh_url, solid.name, seen.capture.color, solid.segment.mask, options.deadline
    )
    try:
        return parse_mesh(data, kind, "mesh")
    except SpecError as error:
        raise services.Server(options.mesh_url, "mesh").error(str(error)) from None


def _with_mesh(
    seen: Calibrated,
    solid: Solid,
    others: list[Mask],
    mesh: MeshFile,
    source: str,
    options: Options,
) -> Solid:
    """The solid as a mesh of unknown scale, whether it fits or not: it was asked for."""
    models = models_of(mesh.vertices, mesh.faces)
    got, placed = _registered(seen, solid, others, mesh, models, None, options)
    made = replace(
        placed, fit=got.fit, extra={}, model=_known(got, source, mesh),
        warnings=(*placed.warnings, "the mesh is given; its scale is from depth and silhouette"),
    )  # fmt: skip
    return made if got.believable else made.warned(_misfit(f"the mesh of {source}", got))


def _misfit(what: str, got: Registered) -> str:
    return (
        f"{what} does not fit what is seen ({100 * got.fit.explained:.0f} % explained, "
        f"{100 * got.mismatch:.0f} % of the picture disagrees): it may be another object's"
    )


def _known(got: Registered, source: str, mesh: MeshFile) -> KnownModel:
    pose = got.pose.copy()
    pose[:3, :3] = pose[:3, :3] @ mesh.upright
    return KnownModel(source, pose, got.metres_per_unit, got.mismatch)


def _registered(
    seen: Calibrated,
    solid: Solid,
    others: list[Mask],
    mesh: MeshFile,
    models: list[Model],
    metres_per_unit: float | None,
    options: Options,
) -> tuple[Registered, Solid]:
    """A mesh registered on the support that agrees best, and the solid on that support."""
    start = None
    if options.pose_url is not None:
        start = _asked_pose(seen, solid, mesh, metres_per_unit, options)
    solid = replace(solid, warnings=())  # doubts about its first shape do not apply
    # That shape may have misled about what it stands on.
    bases = [] if solid.support == DESK else [seen.desk_top]
    target = target_of(seen, solid.segment.mask, others, solid.observation.base, options.seed)
    got = register(target, models, metres_per_unit=metres_per_unit, start=start, bases=bases)
    if start is not None and not got.believable:
        free = register(target, models, metres_per_unit=metres_per_unit, bases=bases)
        if free.mismatch < got.mismatch:
            got = free
            solid = solid.warned("the pose server's pose does not agree with the picture; another "
                                 "one was looked for")  # fmt: skip
    if bases and got.fit.params[2] == seen.desk_top != solid.observation.base:
        low = replace(solid.observation, base=seen.desk_top)
        solid = replace(solid, support=DESK, relation="on", observation=low)
    return got, solid


def _asked_pose(
    seen: Calibrated,
    solid: Solid,
    mesh: MeshFile,
    metres_per_unit: float | None,
    options: Options,
) -> Array:
    """Pose (4, 4) in the base frame, of the mesh with z up, as a pose server says it."""
    assert options.pose_url is not None  # asked by the caller
    pose = services.ask_pose(
        options.pose_url,
        {
            "name": solid.name, "mesh": base64.b64encode(mesh.data).decode(), "format": mesh.kind,
            "metres_per_unit": metres_per_unit,
            **services.what_is_seen(
                seen.capture.color, seen.depth, solid.segment.mask, seen.view
            ),
        },
        options.deadline,
    )  # fmt: skip
    base = seen.view.camera_to_base @ pose
    base[:3, :3] = base[:3, :3] @ mesh.upright.T
    return np.asarray(base)


def _from_library(
    seen: Calibrated, solid: Solid, others: list[Mask], entry: Entry, options: Options
) -> Solid:
    """The solid as a known thing of known size; as it was, with a warning, where that misfits."""
    if entry.mesh is None:
        known = fit_known_kind(solid, entry.spec)
        if known.fit.explained > POOR:
            return _with_keys(_compared(known, solid), entry)
        return solid.warned(
            f"{entry.name} of the library does not fit what is seen "
            f"({100 * known.fit.explained:.0f} % explained): its shape is fitted instead"
        )
    got, placed = _registered_entry(seen, solid, others, entry, options)
    if not got.believable:
        return solid.warned(
            _misfit(f"{entry.name} of the library", got) + "; its shape is fitted instead"
        )
    return _as_entry(placed, got, entry)


def _compared(known: Solid, seen: Solid) -> Solid:
    """The known thing, with a warning where the picture alone gives quite another size."""
    if known.kind != seen.kind:
        return known
    theirs, ours = (np.array([*sorted(item.size[:2]), item.size[2]]) for item in (known, seen))
    if np.abs(ours / theirs - 1).max() < OTHER_SIZE:
        return known
    millimetres = " × ".join(f"{1000 * side:.0f}" for side in seen.size)
    return known.warned(
        f"the picture alone says {millimetres} mm: is the library's size the right one?"
    )


def _with_keys(known: Solid, entry: Entry) -> Solid:
    """A known thing with what the library says besides its shape."""
    return replace(known, extra={**known.extra, **extra_keys(entry.spec)})


def _registered_entry(
    seen: Calibrated, solid: Solid, others: list[Mask], entry: Entry, options: Options
) -> tuple[Registered, Solid]:
    assert entry.mesh is not None and isinstance(entry.spec, Mesh)  # asked by the caller
    models = models_of(entry.mesh.vertices, entry.mesh.faces)
    return _registered(seen, solid, others, entry.mesh, models, entry.spec.scale, options)


def _as_entry(solid: Solid, got: Registered, entry: Entry) -> Solid:
    assert entry.mesh is not None  # asked by the caller
    keys = {k: v for k, v in extra_keys(entry.spec).items() if k not in SCALED_BY_FILE}
    return replace(
        solid, fit=got.fit, extra={"kind": "mesh", **keys},
        model=_known(got, entry.name, entry.mesh),
    )  # fmt: skip


def _recognized(
    seen: Calibrated, solids: list[Solid], library: Library, options: Options
) -> list[Solid]:
    """Found objects without a name as things of the library that the instruction names."""
    done = list(solids)
    taken = {solid.name for solid in solids if solid.segment.named}
    for entry, words in library.mentioned(options.instruction):
        for index, solid in enumerate(done):
            if solid.segment.named or not _size_fits(solid, entry):
                continue
            others = [*(o.segment.mask for o in done if o is not solid), *seen.aside]
            known = _matching(seen, solid, others, entry, options)
            if known is None:
                continue
            name = unique_name(safe_name("_".join(words)), taken)
            taken.add(name)
            segment = replace(known.segment, name=name, named=True, label=" ".join(words))
            done[index] = replace(known, segment=segment)
            done = [_moved_support(other, solid.name, name) for other in done]
    return done


def _moved_support(solid: Solid, before: str, after: str) -> Solid:
    return replace(solid, support=after) if solid.support == before else solid


def _matching(
    seen: Calibrated, solid: Solid, others: list[Mask], entry: Entry, options: Options
) -> Solid | None:
    """The solid as a known thing, if it fits about as well as the shape that was found."""
    if entry.mesh is None:
        known = fit_known_kind(solid, entry.spec)
        if known.fit.explained < max(POOR, 0.9 * solid.fit.explained):
            return None
        return _with_keys(known, entry)
    got, placed = _registered_entry(seen, solid, others, entry, options)
    if not got.believable or got.fit.explained < 0.9 * solid.fit.explained:
        return None
    return _as_entry(placed, got, entry)


def _size_fits(solid: Solid, entry: Entry) -> bool:
    """Whether a known thing is about as large as what was found; spares costly comparisons."""
    if entry.mesh is not None and isinstance(entry.spec, Mesh):
        longest = float(np.ptp(entry.mesh.vertices, axis=0).max()) * entry.spec.scale
    else:
        data = entry.spec.model_dump()
        sides = [data.get(key) for key in ("diameter", "height", "length")]
        longest = max(data.get("size") or [side for side in sides if side is not None])
    ratio = max(solid.size) / longest
    return SIZE_RANGE[0] < ratio < SIZE_RANGE[1]

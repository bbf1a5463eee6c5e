"""``etot reconstruct``: a capture becomes a scene, a task, meshes, MJCF, an overlay, a report."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import yaml

from etot_cli.errors import EtotError, SpecError, WorldError
from etot_cli.reconstruction.capture.standpoint import CameraAt
from etot_cli.reconstruction.capture.workspace import Workspace
from etot_cli.reconstruction.masks.naming import color_of
from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.options import Options
from etot_cli.reconstruction.pipeline import Twin, reconstruct, settle_twin
from etot_cli.reconstruction.twin import assembly
from etot_cli.reconstruction.twin.exports import export_twin, free_form_mesh
from etot_cli.reconstruction.twin.overlay import draw_overlay
from etot_cli.reconstruction.twin.physics import WORLDS
from etot_cli.reporting.files import write_atomically
from etot_cli.reporting.provenance import Stopwatch, versions
from etot_cli.reporting.reconstruct_report import (
    CameraModel,
    FitModel,
    JointModel,
    KnownModelModel,
    PiecesModel,
    ReconstructedObjectModel,
    ReconstructReport,
)
from etot_cli.specs.load import load_scene
from etot_cli.specs.reading import printable
from etot_cli.world.build.pieces import convex_pieces
from etot_cli.world.state import triple

__all__ = ["CameraAt", "Options", "Workspace", "reconstruct_capture"]
SCENE, TASK, OVERLAY, MJCF, MESHES = "scene.yaml", "task.yaml", "overlay.png", "scene.xml", "meshes"


@dataclass(frozen=True, slots=True)
class Reconstruction:
    """A report, and what its page needs besides it; ``twin`` is None when interrupted early."""

    report: ReconstructReport
    twin: Twin | None


def reconstruct_capture(options: Options, folder: Path) -> Reconstruction:
    """Reconstructs a capture and writes everything but the report into ``folder``.

    Ctrl-C (KeyboardInterrupt) does not escape: the report says ``interrupted``.

    Raises:
        EtotError: the capture is unusable, a server is missing, or the folder cannot be written.
    """
    watch = Stopwatch()
    twin: Twin | None = None
    files: dict[str, str] = {}
    pieces: list[PiecesModel] = []
    interrupted = False
    try:
        with watch.phase("reconstruct"):
            twin = reconstruct(options)
        with watch.phase("write"):
            try:
                folder.mkdir(parents=True, exist_ok=True)
                files, pieces = _write(twin, options, folder)
            except OSError as error:
                raise EtotError(f"cannot write to {folder}: {error.strerror or error}") from error
    except KeyboardInterrupt:
        interrupted = True
    report = _report(options, twin, files, pieces, watch, interrupted=interrupted)
    return Reconstruction(report, twin)


def _report(
    options: Options,
    twin: Twin | None,
    files: dict[str, str],
    pieces: list[PiecesModel],
    watch: Stopwatch,
    *,
    interrupted: bool,
) -> ReconstructReport:
    """The report of what there is; ``twin`` is None when that was interrupted."""
    usable = SCENE if "scene" in files else None
    status = "interrupted" if interrupted else "partial"
    if twin is not None and not interrupted and usable and twin.settled:
        still = all(
            rest.moved * 1000 <= assembly.SETTLE_MM and rest.turned <= assembly.SETTLE_DEG
            for rest in twin.settled.values()
        )
        status = "success" if still and twin.whole else "partial"
    found: dict[str, Any] = {
        "desk_top": None, "tilt_deg": 0.0, "depth_shift_px": (0, 0),
        "camera": None, "objects": [], "joints": [],
        "ignored": [], "outside_workspace": 0, "warnings": [], "stages": {},
    }  # fmt: skip
    if twin is not None:
        found = {
            "desk_top": twin.seen.desk_top,
            "tilt_deg": twin.seen.tilt_deg,
            "depth_shift_px": twin.seen.shift,
            "camera": CameraModel(
                source="file" if options.camera_at is None else "standpoint",
                camera_to_base=twin.seen.view.camera_to_base.tolist(),
            ),
            "objects": [_object(twin, solid) for solid in twin.solids],
            "joints": [
                JointModel(
                    object=joint.owner, type="slide" if joint.type == "slide" else "hinge",
                    axis=triple(joint.axis), anchor=triple(joint.anchor), values=joint.values,
                )
                for joint in twin.joints
            ],
            "ignored": twin.ignored,
            "outside_workspace": twin.outside,
            "warnings": twin.warnings,
            "stages": {name: round(max(value, 0.0), 4) for name, value in twin.timing.items()},
        }  # fmt: skip
    return ReconstructReport.model_validate(
        {
            "status": status,
            "seed": options.seed,
            "interrupted": interrupted,
            "versions": versions(),
            "timing": watch.timing(),
            "capture": printable(options.capture),
            "instruction": options.instruction,
            "pieces": pieces,
            "scene": usable,
            "task": files.get("task"),
            "files": files,
            **found,
        }
    )


def _object(twin: Twin, solid: Solid) -> ReconstructedObjectModel:
    half = solid.yaw / 2 if solid.kind not in assembly.ROUND else 0.0
    rest = twin.settled.get(solid.name)
    return ReconstructedObjectModel.of(
        solid,
        position=triple(solid.center),
        quaternion=(float(np.cos(half)), 0.0, 0.0, float(np.sin(half))),
        fit=FitModel(
            residual_m=solid.fit.depth_rms,
            silhouette_px=solid.fit.edge_rms,
            explained=solid.fit.explained,
        ),
        settle_m=None if rest is None else rest.moved,
        settle_deg=None if rest is None else rest.turned,
        model=None
        if solid.model is None
        else KnownModelModel.of(solid.model, pose=solid.model.pose.tolist()),
    )


def _write(twin: Twin, options: Options, folder: Path) -> tuple[dict[str, str], list[PiecesModel]]:
    """Writes the files; returns them by purpose, and the collision pieces of free forms."""
    files: dict[str, str] = {}
    meshes = folder / MESHES
    meshes.mkdir(exist_ok=True)
    pieces = []
    color = twin.seen.capture.color
    for solid in twin.solids:
        if solid.kind != "mesh":
            continue
        file = meshes / f"{solid.name}.obj"
        free_form_mesh(solid, color_of(color, solid.segment.mask)).export(file)
        twin.document["objects"][solid.name].update(file=f"{MESHES}/{file.name}", scale=1.0)
        try:
            pieces.append(_pieces(solid.name, file))
        except WorldError as error:
            _hull_instead(file)
            twin.warnings.append(f"{solid.name}: {error}; its convex hull stands in for it")
            pieces.append(_pieces(solid.name, file))
    notes = twin.warnings + [f"{s.name}: {text}" for s in twin.solids for text in s.warnings]
    write_atomically(folder / SCENE, assembly.scene_text(twin.document, notes))
    files["scene"] = SCENE
    try:
        load_scene(folder / SCENE)
    except SpecError as error:
        twin.whole = False
        twin.warnings.append(f"etot plan will not take this scene as it is: {error}")
    if options.settle and not twin.settled:
        settle_twin(twin, folder)
    if options.instruction:
        write_atomically(folder / TASK, _task_text(twin, options.instruction))
        files["task"] = TASK
    if not cv2.imwrite(str(folder / OVERLAY), draw_overlay(color, twin.solids, twin.seen.view)):
        raise EtotError(f"cannot write {folder / OVERLAY}")
    files["overlay"] = OVERLAY
    if twin.scene is not None:
        scene = twin.scene.model_copy(update={"directory": str(folder.resolve())})
        colors = {s.name: color_of(color, s.segment.mask) for s in twin.solids}
        export_twin(scene, colors, meshes, folder / MJCF)
        files["mjcf"], files["meshes"] = MJCF, MESHES
    return files, pieces


def _pieces(name: str, file: Path) -> PiecesModel:
    """How the world will take a mesh apart.

    Raises:
        WorldError: it cannot be taken apart.
    """
    import trimesh

    # As the world will read it: the digits that are written decide what the cache knows.
    mesh: Any = trimesh.load(file, force="mesh")
    vertices = np.asarray(mesh.vertices, dtype=np.float64)
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    parts = convex_pieces(vertices - middle, np.asarray(mesh.faces, dtype=np.int64))
    volume = sum(trimesh.convex.convex_hull(part).volume for part in parts)
    error = volume / max(float(mesh.volume), 1e-12) - 1
    return PiecesModel(object=name, count=len(parts), volume_error=error)


def _hull_instead(file: Path) -> None:
    """Puts a mesh's convex hull in its place: one ragged thing must not make the desk unusable."""
    import trimesh

    mesh: Any = trimesh.load(file, force="mesh")
    hull = mesh.convex_hull
    hull.visual.vertex_colors = np.tile(mesh.visual.vertex_colors[0], (len(hull.vertices), 1))
    hull.export(file)


def _task_text(twin: Twin, instruction: str) -> str:
    """A task file: the instruction and the scene. Success is not known; nothing may be lost."""
    document = {
        "instruction": instruction,
        "scene": SCENE,
        "worlds": WORLDS,
        "success": [
            {"present": name} for name, entry in twin.document["objects"].items()
            if entry["kind"] not in assembly.FURNITURE
        ] or [{"present": next(iter(twin.document["objects"]))}],
    }  # fmt: skip
    head = (
        "# Made by etot reconstruct. 'success' only says that nothing may be lost: add yours.\n"
        f"# Masses and friction are guesses: plans are tried in {WORLDS} worlds that vary them.\n"
    )
    return head + yaml.safe_dump(document, sort_keys=False, allow_unicode=True)

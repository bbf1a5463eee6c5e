"""``etot reconstruct``: a capture becomes a scene, a task, meshes, MJCF, an overlay, a report."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import cv2
import numpy as np
import yaml

from etot_cli.commands.ideas import ideas
from etot_cli.errors import EtotError, SpecError, WorldError
from etot_cli.reconstruction.capture.board import Board, find_camera, read_board
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
from etot_cli.specs.load import load_scene, load_task
from etot_cli.specs.reading import printable
from etot_cli.world.build.pieces import convex_pieces
from etot_cli.world.state import ROUND_KINDS, triple

__all__ = ["CameraAt", "Options", "Workspace", "read_board", "reconstruct_capture"]
CAMERA, CALIBRATION = "camera.json", "calibration.json"
SCENE, TASK, OVERLAY, MJCF, MESHES = "scene.yaml", "task.yaml", "overlay.png", "scene.xml", "meshes"


@dataclass(frozen=True, slots=True)
class Reconstruction:
    """A report, and what its page needs besides it; ``twin`` is None when interrupted early.

    ``problem``: why the instruction of the task is not understood; empty when it is.
    """

    report: ReconstructReport
    twin: Twin | None
    problem: str = ""


def reconstruct_capture(
    options: Options, folder: Path, board: Board | None = None
) -> Reconstruction:
    """Reconstructs a capture and writes everything but the report into ``folder``.

    With a board in the picture the camera that it gives is written first, and used.

    Ctrl-C (KeyboardInterrupt) does not escape: the report says ``interrupted``.

    Raises:
        EtotError: the capture is unusable, a server is missing, or the folder cannot be written.
    """
    watch = Stopwatch()
    twin: Twin | None = None
    files: dict[str, str] = {}
    pieces: list[PiecesModel] = []
    interrupted = False
    problem = ""
    try:
        if board is not None:
            with watch.phase("calibrate"):
                options, files = _with_board(options, board, folder)
        with watch.phase("reconstruct"):
            twin = _reconstruct(options, folder)
        with watch.phase("write"):
            try:
                folder.mkdir(parents=True, exist_ok=True)
                written, pieces = _write(twin, options, folder)
                files |= written
                if "task" in files and twin.settled:
                    problem = ideas(load_task(folder / TASK)).problem
            except OSError as error:
                raise EtotError(f"cannot write to {folder}: {error.strerror or error}") from error
        if problem and twin is not None:
            twin.warnings.append(f"the instruction is not understood: {problem}")
            twin.whole = False
    except KeyboardInterrupt:
        interrupted = True
    report = _report(options, twin, files, pieces, watch, interrupted=interrupted)
    return Reconstruction(report, twin, problem)


def _with_board(options: Options, board: Board, folder: Path) -> tuple[Options, dict[str, str]]:
    """The options with the camera that the board gives, and the files that keep it."""
    found = find_camera(options.capture, board)
    if folder.exists() and folder.samefile(options.capture):
        raise SpecError("is the capture's own folder, whose camera.json stays as it is; expected "
                        "another --out", file=str(folder))  # fmt: skip
    intrinsics = ("width", "height", "fx", "fy", "cx", "cy")
    calibration = {
        "schema": "etot.calibration/1",
        "camera_to_base": found.entries["camera_to_base"],
        "intrinsics": {key: found.document[key] for key in intrinsics},
        "reprojection_px": found.reprojection_px,
    }
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise EtotError(f"cannot write to {folder}: {error.strerror or error}") from error
    write_atomically(folder / CAMERA, json.dumps(found.document, indent=1) + "\n")
    write_atomically(folder / CALIBRATION, json.dumps(calibration, indent=1) + "\n")
    return replace(options, camera=found), {"camera": CAMERA, "calibration": CALIBRATION}


def _reconstruct(options: Options, folder: Path) -> Twin:
    """The twin; where there is none, the error says where the camera is kept."""
    try:
        return reconstruct(options)
    except SpecError as error:
        if options.camera is None:
            raise
        raise SpecError(
            f"{error.message}; the camera that the board gives is in {folder / CAMERA}",
            file=error.file, line=error.line, path=error.path,
        ) from None  # fmt: skip


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
                source=_source(options),
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


def _source(options: Options) -> Literal["file", "standpoint", "board"]:
    if options.camera is not None:
        return "board"
    return "file" if options.camera_at is None else "standpoint"


def _object(twin: Twin, solid: Solid) -> ReconstructedObjectModel:
    half = solid.yaw / 2 if solid.kind not in ROUND_KINDS else 0.0
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
        write_atomically(folder / TASK, _task_text(options.instruction))
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


def _task_text(instruction: str) -> str:
    """A task file: the instruction and the scene. What success is, is not known."""
    document = {"instruction": instruction, "scene": SCENE, "worlds": WORLDS}
    head = (
        "# Made by etot reconstruct. What the end is checked against can be added as 'success'.\n"
        f"# Masses and friction are guesses: plans are tried in {WORLDS} worlds that vary them.\n"
    )
    return head + yaml.safe_dump(document, sort_keys=False, allow_unicode=True)

"""From a capture to a twin: the stages in their order."""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from etot_cli.errors import EtotError, SpecError
from etot_cli.reconstruction import services
from etot_cli.reconstruction.articulation.furnish import furnish
from etot_cli.reconstruction.articulation.server import asked_joints
from etot_cli.reconstruction.articulation.two_frames import Joint, articulate
from etot_cli.reconstruction.capture.calibration import Calibrated, calibrate
from etot_cli.reconstruction.capture.folder import disjoint, read_capture, safe_name, unique_name
from etot_cli.reconstruction.capture.standpoint import stand
from etot_cli.reconstruction.fit.second_look import look_again
from etot_cli.reconstruction.fit.supports import fit_all
from etot_cli.reconstruction.free_form.completion import complete
from etot_cli.reconstruction.known.given import given_shapes, read_given
from etot_cli.reconstruction.known.library import without, words_of
from etot_cli.reconstruction.leaving_out import (
    checked_names,
    outside,
    set_aside,
    without_board,
    without_ignored,
)
from etot_cli.reconstruction.masks.automatic import find_segments
from etot_cli.reconstruction.masks.checks import unmasked, usable_segments
from etot_cli.reconstruction.masks.naming import assign_names, color_of, hint_of, mentions
from etot_cli.reconstruction.objects import DESK, Segment, Solid
from etot_cli.reconstruction.options import Options
from etot_cli.reconstruction.twin import assembly
from etot_cli.specs.checks import BASE_RADIUS, DEFAULT_REACH, FURNITURE_BEYOND
from etot_cli.specs.scene import Scene


@dataclass
class Twin:
    """What a reconstruction has found."""

    seen: Calibrated
    solids: list[Solid]
    document: dict[str, Any]
    warnings: list[str]
    timing: dict[str, float]
    joints: list[Joint] = field(default_factory=list)
    scene: Scene | None = None
    settled: dict[str, assembly.Settled] = field(default_factory=dict)
    whole: bool = True
    """Whether all that was found in reach is in the scene, and ``etot plan`` takes that."""
    ignored: list[str] = field(default_factory=list)
    outside: int = 0
    """How many things stand outside the workspace."""


def reconstruct(options: Options) -> Twin:
    """Reconstructs the scene that a capture shows.

    Raises:
        SpecError: the capture is unusable, or nothing is found in it.
        ServiceError: a server that was asked for is not there.
    """
    timing: dict[str, float] = {}
    clock = _Clock(timing)
    given = read_given(options)
    seen = _calibrated(options.capture, options)
    clock.lap("calibration")
    warnings = list(seen.warnings)
    seen, segments, left, doubts = _segments(seen, options)
    warnings += doubts
    if not segments:
        raise SpecError(
            "; ".join(["no object is seen on the desk", *doubts]), file=str(options.capture)
        )
    clock.lap("masks")
    solids, lost = _shapes(seen, segments, options)
    warnings += [f"{name}: too little of it is seen; left out" for name in lost]
    clock.lap("shapes")
    solids = given_shapes(seen, solids, options, given)
    clock.lap("meshes and poses")
    solids, joints = _joints(seen, solids, options)
    solids, beyond = _within_reach(solids)
    warnings += beyond
    if not solids:
        raise SpecError("; ".join(["nothing is in reach", *beyond]), file=str(options.capture))
    before = [solid.name for solid in solids]
    solids = _named(seen, solids, options.instruction)
    called = dict(zip(before, (solid.name for solid in solids), strict=True))
    names = {solid.name for solid in solids}
    # What is seen too little of, out of reach or ignored has a name, too.
    there = {*names, *(segment.name for segment in segments), *map(safe_name, options.ignore)}
    checked_names(options.materials, there, str(options.capture), "--material")
    if not segments[0].named:
        solids, notes = without_ignored(
            solids, checked_names(options.ignore, names, str(options.capture))
        )
        warnings += notes
        if not solids:
            raise SpecError("all that is found is ignored", file=str(options.capture))
    clock.lap("articulation")
    title = safe_title(options.capture)
    materials = {safe_name(name): what for name, what in options.materials.items()}
    document = assembly.scene_document(title, seen, solids, materials)
    solids, document, impossible = assembly.what_a_scene_may_have(solids, document)
    warnings += impossible
    joints = [
        replace(joint, owner=called[joint.owner])
        for joint in joints if called.get(joint.owner) in document["objects"]
    ]  # fmt: skip
    twin = Twin(
        seen, solids, document, warnings, timing, joints, whole=not impossible,
        ignored=sorted(map(safe_name, options.ignore)), outside=left,
    )  # fmt: skip
    if options.settle and not any(solid.kind == "mesh" for solid in solids):
        settle_twin(twin, options.capture)
    clock.lap("assembly")
    return twin


def _calibrated(folder: Path, options: Options) -> Calibrated:
    """A capture in its levelled frame, its camera where the options say, ignored masks aside."""
    at, found = options.camera_at, options.camera
    camera = None if at is None else {"camera_to_base": np.eye(4).tolist()}
    if found is not None:
        camera = found.entries
    capture = read_capture(folder, use_masks=not options.auto, camera=camera)
    if found is not None:
        capture = replace(capture, warnings=(*capture.warnings, *found.notes))
    ignored = {safe_name(name) for name in options.ignore}
    aside = [mask for name, mask in capture.masks.items() if name in ignored]
    asked: Any = {"seed": options.seed, "workspace": options.workspace, "aside": aside}
    if at is not None:
        capture = stand(capture, at, **asked)
    return calibrate(capture, **asked)


def _segments(
    seen: Calibrated, options: Options
) -> tuple[Calibrated, list[Segment], int, list[str]]:
    """Pixels of the objects: from a server, from the capture's masks, or found.

    Returns:
        the capture with what is left out set aside, the segments, how many stand outside the
        workspace, and what is to be said.
    """
    if options.masks_url is not None:
        prompts = [" ".join(filter(None, (m.color, m.noun))) for m in mentions(options.instruction)]
        masks = services.ask_masks(options.masks_url, seen.capture.color, prompts, options.deadline)
        masks = disjoint(masks, [])
    else:
        masks = seen.capture.masks
    notes: list[str] = []
    if masks:
        # A mask that shows nothing has been left out already.
        files = {safe_name(path.stem) for path in (options.capture / "masks").glob("*.png")}
        ignored = checked_names(options.ignore, {*masks, *files}, str(options.capture))
        if options.masks_url is not None:
            seen = set_aside(seen, (masks[name] for name in ignored & set(masks)))
        segments = [
            Segment(name, mask, label=name.replace("_", " "))
            for name, mask in masks.items() if name not in ignored
        ]  # fmt: skip
    else:
        segments = find_segments(seen)
        if options.camera is not None:
            segments = without_board(seen, segments, options.camera.outline)
    left: list[Segment] = []
    if options.workspace is not None:
        seen, segments, left = outside(seen, segments, options.workspace)
        if left:
            notes.append(
                f"{len(left)} thing(s) outside the workspace ({options.workspace}): left out"
            )
    if masks:
        segments, doubts = usable_segments(seen, segments)
        notes += doubts + (unmasked(seen, segments) if segments else [])
    return seen, segments, len(left), notes


def _shapes(
    seen: Calibrated, segments: list[Segment], options: Options
) -> tuple[list[Solid], list[str]]:
    """Solids, and the names of segments that show too little."""
    hints = {s.name: hint for s in segments if s.named and (hint := hint_of(s.name))}
    solids = fit_all(seen, segments, seed=options.seed, hints=hints)
    lost = {segment.name for segment in segments} - {solid.name for solid in solids}
    whole, solids = solids, look_again(seen, segments, solids, hints, seed=options.seed)
    if solids is not whole:
        segments = [segment for segment in segments if segment.name in lost]
        segments += [solid.segment for solid in solids]
    solids = [
        complete(seen, solid, [*(o.mask for o in segments if o.name != solid.name), *seen.aside])
        for solid in solids
    ]
    return [furnish(seen, solid, hints.get(solid.name)) for solid in solids], sorted(lost)


def _joints(
    seen: Calibrated, solids: list[Solid], options: Options
) -> tuple[list[Solid], list[Joint]]:
    """The solids with joints from a second frame or a server."""
    folder = options.second
    if folder is None and (options.capture / "second").is_dir():
        folder = options.capture / "second"
    joints: list[Joint] = []
    if folder is not None:
        later = _calibrated(folder, options)
        masks = later.capture.masks
        ignored = {safe_name(name) for name in options.ignore}
        segments = [Segment(name, mask) for name, mask in masks.items() if name not in ignored]
        segments = segments if masks else find_segments(later)
        if options.workspace is not None:
            later, segments, _ = outside(later, segments, options.workspace)
        others, _ = _shapes(later, segments, options)
        solids, joints = articulate(solids, others)
    if options.articulation_url is not None:
        solids, asked = asked_joints(seen, solids, options)
        joints += asked
    return solids, joints


def safe_title(folder: Path) -> str:
    """A scene name from a folder's."""
    kept = "".join(c if c.isalnum() or c in "_.-" else "_" for c in folder.resolve().name)[:60]
    return kept if kept and kept[0].isalnum() else f"scene{kept}"


def _named(seen: Calibrated, solids: list[Solid], instruction: str | None) -> list[Solid]:
    """Gives found objects their names; what the user named keeps its name."""
    found = [solid for solid in solids if not solid.segment.named]
    if not found:
        return solids
    colors = {s.name: color_of(seen.capture.color, s.segment.mask) for s in found}
    # What a library has recognized took its words out of the instruction.
    known = [solid.segment for solid in solids if solid.segment.named]
    instruction = without(instruction, [words_of(item.label or item.name) for item in known])
    names = assign_names({s.name: s.kind for s in found}, colors, instruction)
    taken = {item.name for item in known}
    names = {before: unique_name(after, taken) for before, after in names.items()}
    renamed = []
    for solid in solids:
        name = names.get(solid.name, solid.name)
        segment = replace(solid.segment, name=name, label=name.replace("_", " "))
        support = names.get(solid.support, solid.support)
        renamed.append(replace(solid, segment=segment, support=support))
    return renamed


def _within_reach(solids: list[Solid]) -> tuple[list[Solid], list[str]]:
    """The solids without those that no arm gets at, which no scene may have, and what they bear;
    and what is to be said about them.
    """
    kept = list(solids)
    notes: list[str] = []
    while beyond := [solid for solid in kept if not _is_within_reach(solid, kept)]:
        names = {solid.name for solid in beyond}
        kept = [solid for solid in kept if solid.name not in names]
        for solid in beyond:
            distance = float(np.hypot(*solid.center[:2]))
            x, y, z = (1000 * side for side in solid.size)
            what = solid.name if solid.segment.named else f"a {solid.kind}"
            notes.append(
                f"{what}, {x:.0f} × {y:.0f} × {z:.0f} mm, {distance:.2f} m from the robot's axis: "
                "no arm gets there, or at what bears it; left out"
            )
    return kept, notes


def _is_within_reach(solid: Solid, others: list[Solid]) -> bool:
    limit = DEFAULT_REACH
    if solid.kind in assembly.FURNITURE:
        limit += FURNITURE_BEYOND
    borne = solid.support == DESK or any(other.name == solid.support for other in others)
    return borne and BASE_RADIUS <= float(np.hypot(*solid.center[:2])) <= limit


def settle_twin(twin: Twin, folder: Path) -> None:
    """Builds the twin and lets it rest; trouble becomes warnings, never silence."""
    try:
        twin.scene = assembly.load(twin.document, folder)
        twin.settled = assembly.settle(twin.scene)
    except EtotError as error:
        twin.warnings.append(f"the twin cannot be built: {error}")
        return
    for name, rest in twin.settled.items():
        if rest.moved * 1000 > assembly.SETTLE_MM or rest.turned > assembly.SETTLE_DEG:
            twin.warnings.append(
                f"{name} does not lie still: it moves {rest.moved * 1000:.1f} mm and turns "
                f"{rest.turned:.1f}° until it rests"
            )


class _Clock:
    """Writes the wall time since the last lap into a mapping."""

    def __init__(self, timing: dict[str, float]) -> None:
        self._timing = timing
        self._last = time.perf_counter()

    def lap(self, name: str) -> None:
        now = time.perf_counter()
        self._timing[name] = now - self._last
        self._last = now

"""Puts the scene together: a YAML document that ``etot plan`` reads, and the test that it rests."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import yaml

from etot_cli.errors import EtotError, SpecError
from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.masks.naming import color_of
from etot_cli.reconstruction.objects import DESK, Solid
from etot_cli.reconstruction.twin.physics import FRICTION_DOUBT, MASS_DOUBT, guess
from etot_cli.specs.checks import check_scene
from etot_cli.specs.scene import Scene
from etot_cli.world.placing import world_at_start
from etot_cli.world.pose import quaternion_of
from etot_cli.world.rest import settle_objects
from etot_cli.world.state import ROUND_KINDS, owner_of

SETTLE_SECONDS = 1.0
"""Time that a twin is stepped to see whether it lies still [s]."""
SETTLE_MM = 2.0
"""An object of a twin at rest moves no more than this."""
SETTLE_DEG = 1.0
"""... and turns no more than this."""
EDGE = 0.03
"""The desk reaches at least this far beyond every object's centre [m]."""
DESK_LIMIT = 1.9
"""A scene's lengths end at 2 m; the desk keeps clear of that [m]."""
FURNITURE = ("drawer_unit", "cabinet")
RIM_OVERLAP = 0.0006
"""Play of what stands inside a cup [m]."""
FILLED = 0.5
"""Share of a free form's extents within which nothing else can be."""
LEAST_REST = 0.3
"""A ball in a mouth rests with its centre at least this share of its radius above the rim."""


@dataclass(frozen=True)
class Settled:
    """How far an object moved until it lay still [m], and how far it turned [deg]."""

    moved: float
    turned: float


def scene_document(
    name: str,
    seen: Calibrated,
    solids: list[Solid],
    materials: dict[str, str],
) -> dict[str, Any]:
    """The scene as plain data, in the words of the scene file.

    Raises:
        SpecError: a material is not known.
    """
    view = seen.view
    camera = {
        "position": _rounded(view.position),
        "quaternion": _rounded(quaternion_of(view.rotation), 6),
        "width": view.width, "height": view.height,
        "fx": view.fx, "fy": view.fy, "cx": view.cx, "cy": view.cy,
    }  # fmt: skip
    by_name = {solid.name: solid for solid in solids}
    return {
        "name": name,
        "description": "Reconstructed from one RGB-D frame; masses and frictions are guesses.",
        "desk": _desk(seen, solids),
        "cameras": {"capture": camera},
        "variation": {"mass": MASS_DOUBT, "friction": FRICTION_DOUBT},
        "objects": {
            solid.name: _object(seen, solid, by_name, materials.get(solid.name)) for solid in solids
        },
    }


def what_a_scene_may_have(
    solids: list[Solid], document: dict[str, Any]
) -> tuple[list[Solid], dict[str, Any], list[str]]:
    """The solids and the document without what no scene may have, such as a thing deep in another,
    and without what that bears: one impossible thing must not make the whole desk unusable.

    Returns:
        Solids, document, and what is to be said about those left out.
    """
    objects, notes = dict(document["objects"]), []
    while len(objects) > 1 and (found := _impossible(objects, document, solids)) is not None:
        named, why = found
        worst = _least_seen(named, objects, document, solids)
        gone = [worst]
        while borne := [name for name, item in objects.items()
                        if name not in gone and _support(item) in gone]:  # fmt: skip
            gone += borne
        objects = {name: item for name, item in objects.items() if name not in gone}
        notes.append(f"{', '.join(gone)}: left out, for {why}")
    kept = [solid for solid in solids if solid.name in objects]
    return kept, {**document, "objects": objects}, notes


def _least_seen(
    named: str, objects: dict[str, Any], document: dict[str, Any], solids: list[Solid]
) -> str:
    """Of the objects each of which could go to make ``named`` possible, the one that shows least:
    a fragment that lies in a thing must not cost the thing.
    """
    pixels = {solid.name: int(solid.segment.mask.sum()) for solid in solids}
    for name in sorted(objects, key=lambda name: pixels.get(name, 0)):
        if name == named or pixels.get(name, 0) >= pixels.get(named, 0):
            break
        if _support(objects[named]) == name:
            continue
        rest = {key: item for key, item in objects.items() if key != name}
        if any(_support(item) == name for item in rest.values()):
            continue
        left = _impossible(rest, document, solids)
        if left is None or left[0] != named:
            return name
    return named


def _support(item: dict[str, Any]) -> str:
    return owner_of(str(item.get("on") or item.get("inside") or DESK))


def _impossible(
    objects: dict[str, Any], document: dict[str, Any], solids: list[Solid]
) -> tuple[str, str] | None:
    """The object that a scene is refused for, and why; None where it is not. Boxes stand in for
    free forms, whose files are not there yet and which need not fill their own.
    """
    sizes = {solid.name: _rounded(FILLED * np.array(solid.size)) for solid in solids}
    tried = {
        name: {"kind": "box", "size": sizes[name]}
        | {key: item[key] for key in ("at", "on", "inside", "yaw_deg") if key in item}
        if item["kind"] == "mesh" else item
        for name, item in objects.items()
    }  # fmt: skip
    try:
        scene = load({**document, "objects": tried}, Path())
        check_scene(scene)
    except SpecError as error:
        root, name, *_ = [*error.path.split("."), ""]
        return (name, error.message) if root == "objects" and name in objects else None
    except EtotError:
        return None  # said when the scene is written
    return None


def _rounded(values: Any, digits: int = 4) -> list[float]:
    return [round(float(value), digits) for value in values]


def _desk(seen: Calibrated, solids: list[Solid]) -> dict[str, Any]:
    low, high = seen.outline.min(axis=0), seen.outline.max(axis=0)
    for solid in solids:
        low = np.minimum(low, solid.center[:2] - EDGE)
        high = np.maximum(high, solid.center[:2] + EDGE)
    size = np.clip(high - low, 0.2, DESK_LIMIT)
    color = color_of(seen.capture.color, seen.desk)
    return {
        "size": _rounded(size), "center": _rounded((low + high) / 2),
        "top": round(seen.desk_top, 4), "color": _rounded(color, 2),
    }  # fmt: skip


def _object(
    seen: Calibrated, solid: Solid, others: dict[str, Solid], material: str | None
) -> dict[str, Any]:
    fields = {**solid.fit.family.spec(solid.fit.params), **solid.extra}
    data: dict[str, Any] = {"kind": fields.pop("kind")}
    data.update(_plain(fields))
    if solid.kind == "cup":
        _open_for_contents(data, solid, others)
    x, y = _rounded(solid.center[:2])
    if solid.relation == "rim":
        data["on"] = solid.support  # it settles on the axis of the mouth
    else:
        data["at"] = [x, y]
        if solid.support != DESK:
            data[solid.relation] = solid.support
    yaw = float(np.degrees(solid.yaw))
    if solid.kind not in ROUND_KINDS and abs(yaw) > 0.01:
        data["yaw_deg"] = round((yaw + 180.0) % 360.0 - 180.0, 2)
    mass, friction, guessed = guess(solid, material, data.get("wall"))
    guesses: dict[str, Any] = {"friction": friction}
    if solid.kind not in FURNITURE:
        guesses["mass"] = round(mass, 4)
    if solid.kind == "drawer_unit":
        guesses["material"] = guessed
    guesses["color"] = _rounded(color_of(seen.capture.color, solid.segment.mask), 2)
    guesses["label"] = solid.segment.label or solid.name.replace("_", " ")
    # What a library knows about a thing is no guess, unless the user says what it is made of.
    known = {key: data.pop(key) for key in guesses if key in data}
    if material is not None:
        known.pop("mass", None)
    return {**data, **guesses, **known}


def _open_for_contents(data: dict[str, Any], cup: Solid, others: dict[str, Solid]) -> None:
    """Makes the wall such that what hangs in the mouth cannot fall through, and the reverse."""
    for other in others.values():
        if other.support != cup.name or other.kind != "sphere":
            continue
        room = data["diameter"] - other.size[0]
        wall = data["wall"]
        if other.relation == "rim":
            radius = other.size[0] / 2
            above = float(other.center[2]) - cup.top
            # Near its widest circle a ball would wedge itself in instead of resting.
            above = float(np.clip(above, LEAST_REST * radius, 0.9 * radius))
            wall = data["diameter"] / 2 - float(np.sqrt(radius**2 - above**2))
        elif other.relation == "inside":
            wall = min(wall, (room - RIM_OVERLAP) / 2)
        data["wall"] = round(float(np.clip(wall, 0.001, 0.2 * data["diameter"])), 5)


def _plain(value: Any) -> Any:
    """Numbers rounded to a tenth of a millimetre, for a file that people read."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return round(value, 4) if isinstance(value, float) else value


def scene_text(document: dict[str, Any], warnings: list[str]) -> str:
    """The document as YAML, what is doubtful on top as comments."""
    head = ["# Made by etot reconstruct. Sizes in metres, angles in degrees, base frame."]
    head += [f"# note: {warning}" for warning in warnings]
    body = yaml.safe_dump(document, sort_keys=False, default_flow_style=None, width=100,
                          allow_unicode=True)  # fmt: skip
    return "\n".join(head) + "\n" + body


def load(document: dict[str, Any], directory: Path) -> Scene:
    """The document as a scene.

    Raises:
        EtotError: it is no valid scene.
    """
    from pydantic import ValidationError

    try:
        scene = Scene.model_validate(document)
    except ValidationError as error:
        raise EtotError(f"the reconstructed scene is not valid: {error}") from error
    return scene.model_copy(update={"directory": str(directory)})


def settle(scene: Scene) -> dict[str, Settled]:
    """Lets a twin come to rest and says how far each loose object moved.

    Raises:
        WorldError: it cannot be built.
    """
    world, data = world_at_start(scene)
    mujoco.mj_forward(world.model, data)
    start = {name: _pose(data, entry.body) for name, entry in world.entries.items()}
    settle_objects(world, data, SETTLE_SECONDS)
    found = {}
    for name, entry in world.entries.items():
        position, quaternion = _pose(data, entry.body)
        moved = float(np.linalg.norm(position - start[name][0]))
        overlap = min(1.0, abs(float(quaternion @ start[name][1])))
        found[name] = Settled(moved, float(np.degrees(2 * np.arccos(overlap))))
    return found


def _pose(data: mujoco.MjData, body: str) -> tuple[Any, Any]:
    return data.body(body).xpos.copy(), data.body(body).xquat.copy()

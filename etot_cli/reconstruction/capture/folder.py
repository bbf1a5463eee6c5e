"""Reads and checks a capture folder; docs/capture_format.md describes it."""

from __future__ import annotations

import json
import math
import re
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import SpecError
from etot_cli.reconstruction.capture.pictures import read_png
from etot_cli.reconstruction.capture.view import Array, Mask, View
from etot_cli.specs.calibration import FARTHEST as FARTHEST_CAMERA
from etot_cli.specs.reading import read_utf8
from etot_cli.specs.scene import MAX_OBJECTS, RESERVED_NAMES
from etot_cli.world.pose import is_rigid

NEAREST, FARTHEST = 0.1, 5.0
"""The median depth of a desk scene lies between these [m]; else the unit is wrong."""
LEAST_READINGS = 0.02
"""With a smaller share of valid pixels a depth picture is empty."""
SCALES = (0.001, 0.0001, 0.00025, 0.01, 1.0)
"""Metres per unit that depth pictures are written with."""
MAX_MASKS = MAX_OBJECTS
LEAST_MASK = 60
"""A smaller mask shows too little of an object [px]."""
OVERLAP = 0.1
"""Masks that share more of the smaller one than this are reported."""
OTHER_PICTURES = (".jpg", ".jpeg", ".PNG", ".bmp", ".tif", ".tiff", ".webp", ".npy")
"""Files that may be meant as masks but are not read."""
MAX_JSON_BYTES = 1024 * 1024
"""Calibrations have a few hundred bytes."""


@dataclass(frozen=True)
class Capture:
    """One RGB-D frame. ``color`` (h, w, 3) uint8 RGB; ``depth`` (h, w) z depth [m], 0 = none;
    ``stated``: the pose of ``camera.json`` where another one is used.
    """

    folder: Path
    view: View
    color: NDArray[np.uint8]
    depth: Array
    masks: dict[str, Mask] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    stated: Array | None = None


def read_capture(
    folder: Path, *, use_masks: bool = True, camera: dict[str, Any] | None = None
) -> Capture:
    """Reads a capture folder.

    Args:
        folder: holds ``color.png``, ``depth.png``, ``camera.json`` and perhaps ``masks``.
        use_masks: read the masks too.
        camera: entries that count instead of those of ``camera.json``.

    Raises:
        SpecError: something is missing, contradicts itself or cannot be meant.
    """
    if not folder.is_dir():
        raise SpecError("no such folder; expected a capture", file=str(folder))
    info = read_camera(folder / "camera.json")
    stated = None
    if camera is not None and "camera_to_base" in camera:
        with suppress(SpecError):
            stated = _pose(info, folder / "camera.json")
    info |= camera or {}
    color = read_png(folder / "color.png")
    depth = read_png(folder / "depth.png")
    if color.ndim != 3 or color.dtype != np.uint8:
        channels = 1 if color.ndim == 2 else color.shape[2]
        raise SpecError(
            f"is {color.dtype} with {channels} channel(s); expected 8-bit colour",
            file=str(folder / "color.png"),
        )
    view = _view(info, color.shape[:2], folder)
    metres = _metres(depth, view, info, folder)
    masks: dict[str, Mask] = {}
    warnings: list[str] = []
    if use_masks and (folder / "masks").exists():
        masks, warnings = read_masks(folder / "masks", color.shape[:2])
    rgb = np.ascontiguousarray(color[:, :, 2::-1])
    return Capture(folder, view, rgb, metres, masks, tuple(warnings), stated)


def read_camera(path: Path) -> dict[str, Any]:
    """What ``camera.json`` says, unchecked.

    Raises:
        SpecError: there is none, or it is no JSON object.
    """
    if not path.exists():
        raise SpecError(
            "no such file; expected width, height, fx, fy, cx, cy, depth_scale, depth_kind and "
            "camera_to_base",
            file=str(path),
        )
    text = read_utf8(path, MAX_JSON_BYTES, "camera data as JSON")
    try:
        # Absurdly long numbers become infinite, and are refused as such.
        info = json.loads(text, parse_int=lambda digits: int(digits) if len(digits) < 20
                          else float(digits))  # fmt: skip
    except (ValueError, RecursionError) as error:
        line = error.lineno if isinstance(error, json.JSONDecodeError) else None
        raise SpecError(f"is not readable JSON ({error})", file=str(path), line=line) from None
    if not isinstance(info, dict):
        raise SpecError("expected an object with fx, fy, cx, cy, …", file=str(path))
    return info


def _number(info: dict[str, Any], key: str, path: Path, low: float, high: float) -> float:
    value = info.get(key)
    if value is None:
        raise SpecError(f"lacks {key!r}, a number", file=str(path), path=key)
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise SpecError(f"found {value!r}, expected a number", file=str(path), path=key)
    if not low <= value <= high:
        raise SpecError(f"found {value:g}, expected {low:g} to {high:g}", file=str(path), path=key)
    return float(value)


def _view(info: dict[str, Any], shape: tuple[int, ...], folder: Path) -> View:
    path, (height, width) = folder / "camera.json", shape
    for key, actual in (("width", width), ("height", height)):
        stated = _number(info, key, path, 1, 1e5)
        if stated != actual:
            raise SpecError(
                f"found {stated:g}, but color.png is {width} × {height}", file=str(path), path=key
            )
    longest = max(width, height)
    focal = [_number(info, key, path, 0.2 * longest, 20 * longest) for key in ("fx", "fy")]
    if max(focal) > 1.25 * min(focal):
        raise SpecError(
            f"fx {focal[0]:g} and fy {focal[1]:g} differ by more than 25 %; no lens does that",
            file=str(path),
        )
    cx = _number(info, "cx", path, 0.0, width)
    cy = _number(info, "cy", path, 0.0, height)
    return View(width, height, focal[0], focal[1], cx, cy, _pose(info, path))


def _pose(info: dict[str, Any], path: Path) -> Array:
    rows = info.get("camera_to_base")
    if rows is None:
        raise SpecError(
            "lacks 'camera_to_base', the camera's pose (4 × 4); see --camera-at and --calibrate",
            file=str(path),
        )
    try:
        pose = np.array(rows, dtype=np.float64)
    except (TypeError, ValueError):
        pose = np.zeros(0)
    where = "camera_to_base"
    if pose.shape != (4, 4) or not np.isfinite(pose).all():
        raise SpecError("expected 4 rows of 4 numbers", file=str(path), path=where)
    if not is_rigid(pose):
        raise SpecError(
            "is no rigid pose (a rotation, a position in metres and the row 0 0 0 1)",
            file=str(path), path=where,
        )  # fmt: skip
    if np.abs(pose[:3, 3]).max() > FARTHEST_CAMERA:
        raise SpecError(
            f"puts the camera {np.linalg.norm(pose[:3, 3]):.4g} m from the base; expected metres",
            file=str(path), path=where,
        )  # fmt: skip
    left, _, right = np.linalg.svd(pose[:3, :3])
    pose[:3, :3] = left @ right  # rounding of written numbers
    return pose


def _metres(raw: NDArray[Any], view: View, info: dict[str, Any], folder: Path) -> Array:
    path = folder / "depth.png"
    if raw.ndim != 2 or raw.dtype != np.uint16:
        raise SpecError(
            f"is {raw.dtype} with {1 if raw.ndim == 2 else raw.shape[2]} channel(s); expected one "
            "channel of 16 bits",
            file=str(path),
        )
    if raw.shape != (view.height, view.width):
        raise SpecError(
            f"is {raw.shape[1]} × {raw.shape[0]}, color.png is {view.width} × {view.height}; "
            "expected depth registered to the colour picture",
            file=str(path),
        )
    scale = _number(info, "depth_scale", folder / "camera.json", 1e-6, 10.0)
    kind = info.get("depth_kind", "z")
    if kind not in ("z", "ray"):
        raise SpecError(
            f"found {kind!r}, expected z or ray",
            file=str(folder / "camera.json"), path="depth_kind",
        )  # fmt: skip
    depth = raw.astype(np.float64) * scale
    trouble = depth_trouble(depth)
    if trouble is not None:
        hint = next((s for s in SCALES if depth_trouble(depth / scale * s) is None), None)
        told = ""
        if hint is not None:
            meant = np.median(depth[depth > 0]) / scale * hint
            told = f": depth_scale {scale:g} is wrong (with {hint:g} it would be {meant:.3g} m)"
        raise SpecError(trouble + told, file=str(path))
    if kind == "ray":
        v, u = np.mgrid[0 : view.height, 0 : view.width]
        depth /= np.sqrt(1 + ((u - view.cx) / view.fx) ** 2 + ((v - view.cy) / view.fy) ** 2)
    return depth


def depth_trouble(depth: Array) -> str | None:
    """Why a depth picture (h, w) [m] cannot show a desk, in words; None where it may."""
    read = np.isfinite(depth) & (depth > 0)
    if read.mean() < LEAST_READINGS:
        return f"depth is empty: {100 * read.mean():.1f} % of its pixels have a reading"
    middle = float(np.median(depth[read]))
    if not NEAREST <= middle <= FARTHEST:
        return f"the median depth is {middle:.4g} m, which is no desk in front of a camera"
    return None


def read_masks(folder: Path, shape: tuple[int, ...]) -> tuple[dict[str, Mask], list[str]]:
    """Masks by object name, made disjoint, and warnings.

    Raises:
        SpecError: a mask of another size, too many, or no folder of masks.
    """
    if not folder.is_dir():
        raise SpecError("is no folder; expected masks/*.png", file=str(folder))
    paths = sorted(folder.glob("*.png"))
    if len(paths) > MAX_MASKS:
        raise SpecError(f"{len(paths)} masks; expected at most {MAX_MASKS}", file=str(folder))
    masks: dict[str, Mask] = {}
    warnings = [
        f"masks/{path.name} is no .png file and is left out"
        for path in sorted(folder.iterdir())[:MAX_MASKS] if path.suffix in OTHER_PICTURES
    ]  # fmt: skip
    for path in paths:
        image = read_png(path)
        if image.shape[:2] != shape[:2]:
            raise SpecError(
                f"is {image.shape[1]} × {image.shape[0]}, color.png is {shape[1]} × {shape[0]}",
                file=str(path),
            )
        mask = mask_of(image)
        if mask.sum() < LEAST_MASK:
            warnings.append(f"mask {path.name} shows nothing and is left out")
        elif mask.mean() > 0.8:
            warnings.append(f"mask {path.name} covers nearly the whole picture and is left out")
        else:
            masks[unique_name(safe_name(path.stem), masks)] = mask
    return disjoint(masks, warnings), warnings


def mask_of(image: NDArray[Any]) -> Mask:
    """A mask from a picture: its alpha channel where it has one that varies, else its brightness.

    Bright is the object; a picture whose border is bright all around is taken as inverted.
    """
    if image.ndim == 3 and image.shape[2] in (2, 4) and np.ptp(image[..., -1]) > 0:
        channel = image[..., -1]
    else:
        channel = image if image.ndim == 2 else image[..., :3].max(axis=2)
    top = np.iinfo(channel.dtype).max if channel.max() > 1 else 1
    return np.asarray(channel >= top / 2)


def disjoint(masks: dict[str, Mask], warnings: list[str]) -> dict[str, Mask]:
    """Gives pixels that several masks claim to the smallest, which lies on or in the others."""
    order = sorted(masks, key=lambda name: int(masks[name].sum()))
    if not masks:
        return {}
    taken = np.zeros(next(iter(masks.values())).shape, dtype=bool)
    found: dict[str, Mask] = {}
    for name in order:
        mask = masks[name]
        shared = int((mask & taken).sum())
        if shared > OVERLAP * mask.sum():
            warnings.append(
                f"mask {name!r} overlaps others by {100 * shared / mask.sum():.0f} %; the smaller "
                "ones keep the pixels"
            )
        rest = mask & ~taken
        if rest.sum() >= LEAST_MASK:
            found[name] = rest
            taken = taken | mask
        else:
            warnings.append(f"mask {name!r} has no pixels of its own and is left out")
    return {name: found[name] for name in masks if name in found}


def safe_name(text: str) -> str:
    """A valid object name from any text."""
    name = re.sub(r"[^A-Za-z0-9]+", "_", text).strip("_")[:40] or "object"
    return name if name[0].isalpha() else f"object_{name}"


def unique_name(name: str, taken: Any) -> str:
    """The name, with a number when it is taken or reserved."""
    if name not in taken and name not in RESERVED_NAMES:
        return name
    number = 2
    while f"{name}_{number}" in taken:
        number += 1
    return f"{name}_{number}"

"""Synthetic RGB-D captures of a scene: what a camera would deliver, and the truth beside it.

A capture folder holds ``color.png``, ``depth.png`` (uint16), ``camera.json``, ``masks/*.png`` and
``ground_truth.json``. Poses are in the robot base frame [m]; the camera frame is OpenCV's optical
frame (x right, y down, z forward). Pixel (u, v) has its centre at image coordinates (u, v).
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import cv2
import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import SpecError
from etot_cli.specs.bounds import DEPTH_UNIT
from etot_cli.specs.scene import Camera, Scene
from etot_cli.world.build.surroundings import camera_rotation
from etot_cli.world.model import World
from etot_cli.world.offscreen import OffscreenRenderer
from etot_cli.world.placing import object_bounds, world_at_start
from etot_cli.world.rest import settle_objects

DEFAULT_CAMERA = Camera(position=(1.05, 0.0, 0.80), look_at=(0.42, 0.0, 0.15))
"""The camera of scenes that name none: in front of the desk, looking obliquely at it."""
CAMERA_NAME = "capture"
SETTLE_SECONDS = 1.5
"""Simulated time for everything to come to rest before the picture is taken [s]."""
TRUTH = "ground_truth.json"
MAX_PICTURE = (1920, 1440)
"""Largest picture that the off-screen buffer holds, width and height."""


@dataclass(frozen=True)
class Noise:
    """Errors of a time-of-flight depth camera of the Kinect kind.

    Args:
        sigma: standard deviation at 1 m, growing with the square of the distance [m].
        shift: displacement (right, down) of depth against colour [px].
        erosion: readings that are lost at depth edges, as a radius [px].
        edge: depth step from which an edge loses readings [m].
        dropout: share of readings lost at random.
        color: standard deviation of the colour channels, of 255.
        scale: metres per unit of the stored picture.
    """

    sigma: float = 0.0015
    shift: tuple[float, float] = (0.0, 0.0)
    erosion: int = 2
    edge: float = 0.02
    dropout: float = 0.01
    color: float = 2.0
    scale: float = 0.001


KINECT = Noise(shift=(3.2, 2.4))
"""Kinect-like noise with a colour–depth shift of 4 px."""


@dataclass(frozen=True)
class Picture:
    """A rendered capture. ``color`` (h, w, 3) uint8 RGB, ``depth`` (h, w) z depth [m], 0 = none."""

    camera: Camera
    color: NDArray[np.uint8]
    depth: NDArray[np.float64]
    masks: dict[str, NDArray[np.bool_]]
    truth: dict[str, Any] = field(default_factory=dict)


def camera_to_base(camera: Camera) -> NDArray[np.float64]:
    """Pose (4, 4) of the camera: p_base = T · p_camera."""
    matrix = np.eye(4)
    matrix[:3, :3] = camera_rotation(camera)
    matrix[:3, 3] = camera.position
    return matrix


def capture(
    scene: Scene,
    *,
    joints: dict[str, float] | None = None,
    settle: bool = True,
    samples: int = 1,
) -> Picture:
    """Renders a scene at rest from its first camera, or :data:`DEFAULT_CAMERA`.

    Args:
        scene: what is seen.
        joints: joint values by ``object.part`` [m or rad] instead of the scene's.
        settle: let the objects come to rest first.
        samples: renders of the colours; several make shadows soft, and take less memory than the
            one whose edges the graphics driver smooths (by 0.1 GB for 1280 × 720).

    Raises:
        SpecError: the camera's picture is too large.
        ServiceError: OpenGL is not available.
        WorldError: the scene cannot be built.
    """
    name, seen = _first_camera(scene)
    world, data = world_at_start(scene.model_copy(update={"cameras": {name: seen}}))
    for address, value in (joints or {}).items():
        if address not in world.parts:
            raise SpecError(
                f"no movable part {address!r}; expected one of {', '.join(sorted(world.parts))}"
            )
        data.joint(world.parts[address].joint).qpos[0] = value
    mujoco.mj_forward(world.model, data)
    if settle:
        settle_objects(world, data, SETTLE_SECONDS)
    color, depth, ids = _render(world, data, name, seen, samples)
    owners = np.array(world.geom_object)
    masks = {item: np.isin(ids, np.flatnonzero(owners == item)) for item in scene.objects}
    return Picture(seen, color, depth, masks, ground_truth(world, data))


def _first_camera(scene: Scene) -> tuple[str, Camera]:
    found = next(iter(scene.cameras.items()), (CAMERA_NAME, DEFAULT_CAMERA))
    if found[1].width > MAX_PICTURE[0] or found[1].height > MAX_PICTURE[1]:
        raise SpecError(
            f"camera {found[0]!r} takes pictures of {found[1].width} × {found[1].height}; expected "
            f"at most {MAX_PICTURE[0]} × {MAX_PICTURE[1]}"
        )
    return found


def _render(
    world: World, data: mujoco.MjData, name: str, camera: Camera, samples: int
) -> tuple[NDArray[np.uint8], NDArray[np.float64], NDArray[np.int32]]:
    """Colour, depth and geom ids (−1 for none), each (h, w), without the robot."""
    model = world.model
    if samples > 1:
        model.vis.quality.offsamples = 0
    for geom, owner in enumerate(world.geom_object):
        if owner in ("robot", "gripper"):
            model.geom_rgba[geom, 3] = 0.0
            model.geom_group[geom] = 5
    aim(model, name, camera)
    with OffscreenRenderer(model, camera.width, camera.height) as renderer:
        renderer.look(data, name)
        color = renderer.soft_color(samples) if samples > 1 else renderer.color()
        return color, *renderer.depth_and_geoms()


def aim(model: mujoco.MjModel, name: str, camera: Camera) -> None:
    """Sets the camera's intrinsics so that pixel centres lie at whole image coordinates, and shows
    it rounder balls than the viewer: what is looked at is a ball, not its tessellation.
    """
    model.vis.quality.numslices, model.vis.quality.numstacks = 96, 48
    index = model.camera(name).id
    pixel = model.cam_sensorsize[index] / (camera.width, camera.height)
    # MuJoCo counts the principal point from the image's centre, which lies half a pixel before
    # the whole coordinate; see tests/reconstruction/test_capture.py.
    offset = (camera.width / 2 - camera.cx - 0.5, camera.height / 2 - camera.cy - 0.5)
    model.cam_intrinsic[index] = (
        camera.fx * pixel[0],
        camera.fy * pixel[1],
        offset[0] * pixel[0],
        offset[1] * pixel[1],
    )


def ground_truth(world: World, data: mujoco.MjData) -> dict[str, Any]:
    """Poses, sizes and joint values of all objects at this moment, base frame [m]."""
    objects: dict[str, Any] = {}
    for name, entry in world.entries.items():
        body = data.body(entry.body)
        low, high = object_bounds(world, data, name)
        objects[name] = {
            "kind": entry.info.kind,
            "position": body.xpos.tolist(),
            "quaternion": body.xquat.tolist(),
            "size": list(entry.info.size),
            "bounds": [low.tolist(), high.tolist()],
            "joints": {
                part.info.name: {
                    "type": part.info.joint_type,
                    "value": float(data.joint(part.joint).qpos[0]),
                    "axis": data.joint(part.joint).xaxis.tolist(),
                    "anchor": data.joint(part.joint).xanchor.tolist(),
                }
                for part in entry.parts
            },
        }
    return {"desk_top": world.scene.desk.top, "objects": objects}


def add_noise(picture: Picture, noise: Noise, rng: np.random.Generator) -> Picture:
    """The same picture as a real depth camera would deliver it; masks and truth stay."""
    depth = picture.depth.copy()
    kernel = np.ones((3, 3), np.uint8)
    known = np.where(depth > 0, depth, depth.max()).astype(np.float32)
    step = cv2.dilate(known, kernel) - cv2.erode(known, kernel)
    edges = (step > noise.edge).astype(np.uint8)
    if noise.erosion > 0:
        size = 2 * noise.erosion + 1
        lost = cv2.dilate(edges, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size)))
        depth[lost > 0] = 0.0
    depth[depth > 0] += (rng.normal(0.0, noise.sigma, depth.shape) * depth**2)[depth > 0]
    depth[rng.random(depth.shape) < noise.dropout] = 0.0
    right, down = noise.shift
    matrix = np.array([[1.0, 0.0, right], [0.0, 1.0, down]])
    height, width = depth.shape
    # Nearest: blending a reading with "none" would invent depths.
    depth = np.asarray(cv2.warpAffine(depth, matrix, (width, height), flags=cv2.INTER_NEAREST))
    color = picture.color.astype(np.float64) + rng.normal(0.0, noise.color, picture.color.shape)
    return Picture(
        picture.camera,
        np.clip(np.round(color), 0, 255).astype(np.uint8),
        depth,
        picture.masks,
        picture.truth,
    )


def capture_in(folder: Path) -> list[Path]:
    """The files of a capture that a folder holds already."""
    found = [folder / name for name in ("color.png", "depth.png", "camera.json", TRUTH)]
    return [*(path for path in found if path.is_file()), *sorted(folder.glob("masks/*.png"))]


def write_capture(
    picture: Picture, folder: Path, *, scale: float = DEPTH_UNIT, masks: bool = True
) -> None:
    """Writes a capture folder.

    Args:
        picture: what was rendered.
        folder: created if need be.
        scale: metres per unit of the depth picture.
        masks: write ``masks/*.png`` too; objects that are not seen get none.

    Raises:
        SpecError: the folder cannot be written.
    """
    camera = picture.camera
    units = np.round(picture.depth / scale)
    units[units > np.iinfo(np.uint16).max] = 0  # too far for the format: no reading
    info = {
        "width": camera.width,
        "height": camera.height,
        "fx": camera.fx,
        "fy": camera.fy,
        "cx": camera.cx,
        "cy": camera.cy,
        "depth_scale": scale,
        "depth_kind": "z",
        "camera_to_base": camera_to_base(camera).tolist(),
    }
    try:
        folder.mkdir(parents=True, exist_ok=True)
        _write_png(folder / "color.png", cv2.cvtColor(picture.color, cv2.COLOR_RGB2BGR))
        _write_png(folder / "depth.png", units.astype(np.uint16))
        (folder / "camera.json").write_text(json.dumps(info, indent=1) + "\n")
        (folder / TRUTH).write_text(json.dumps(picture.truth, indent=1) + "\n")
        if masks:
            (folder / "masks").mkdir(exist_ok=True)
            for name, mask in picture.masks.items():
                if mask.any():
                    _write_png(folder / "masks" / f"{name}.png", mask.astype(np.uint8) * 255)
    except OSError as error:
        raise SpecError(f"cannot write a capture to {folder}: {error.strerror or error}") from error


def _write_png(path: Path, image: NDArray[Any]) -> None:
    if not cv2.imwrite(str(path), image):
        raise OSError(f"cannot write {path.name}")

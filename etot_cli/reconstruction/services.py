"""Servers that take a stage over: JSON in and out.

The formats are described in docs/reconstruct_servers.md. Whatever a server does, the caller gets a
checked value or one :class:`ServiceError` that says which server and why.
"""

from __future__ import annotations

import base64
import binascii
import json
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import EtotError, ServiceError
from etot_cli.reconstruction.capture.folder import LEAST_MASK, mask_of, safe_name, unique_name
from etot_cli.reconstruction.capture.pictures import (
    decode_png_text,
    depth_text,
    png_text,
)
from etot_cli.reconstruction.capture.view import Array, Mask, View
from etot_cli.services.endpoint import SHOWN, Endpoint
from etot_cli.specs.bounds import DEPTH_UNIT
from etot_cli.specs.scene import MAX_OBJECTS
from etot_cli.world.pose import is_rigid

DEADLINE = 120.0
"""A whole stage, retries included, takes no longer [s]."""
MAX_REPLY = 64 * 1024 * 1024
"""Largest reply [bytes]: a MiB for each mask, of as many objects as a scene may have."""
MAX_MESH = MAX_REPLY // 2
"""Largest mesh [bytes]: as base64 it takes two thirds of a reply."""


@dataclass(frozen=True)
class Server:
    """A stage server at a URL."""

    url: str
    stage: str
    deadline: float = DEADLINE

    def ask(self, request: dict[str, Any]) -> dict[str, Any]:
        """Posts a request and returns the reply's object.

        Raises:
            ServiceError: no usable reply within the deadline.
        """
        body = self._endpoint.post(request, "application/json")
        try:
            reply = json.loads(body)
        except (ValueError, RecursionError):
            raise self.error("the answer is no valid JSON") from None
        if not isinstance(reply, dict):
            raise self.error("the answer is no JSON object")
        if reply.get("error"):
            raise self.error(f"says: {str(reply['error'])[:SHOWN]}")
        return reply

    def error(self, reason: str) -> ServiceError:
        """An error that names this server; what may be secret in its URL is left out."""
        return self._endpoint.error(reason)

    def numbers(self, value: Any, shape: tuple[int, ...], what: str) -> Array:
        """An array of finite numbers of a reply; ``what`` is what messages call it.

        Raises:
            ServiceError: it is none of that shape.
        """
        try:
            array = np.array(value, dtype=np.float64)
        except (TypeError, ValueError):
            array = np.zeros(0)
        if array.shape != shape or not np.isfinite(array).all():
            raise self.error(f"{what!r} is not {'×'.join(map(str, shape)) or 'a'} number(s)")
        return array

    def pose(self, value: Any, what: str) -> Array:
        """A rigid pose (4, 4) of a reply.

        Raises:
            ServiceError: it is none.
        """
        pose = self.numbers(value, (4, 4), what)
        if not is_rigid(pose):
            raise self.error(f"{what!r} is no rigid pose")
        return pose

    @property
    def _endpoint(self) -> Endpoint:
        return Endpoint(self.url, f"{self.stage} server", self.deadline, MAX_REPLY)


def picture(color: NDArray[np.uint8]) -> str:
    """An RGB picture (h, w, 3) as base64 PNG."""
    return png_text(color[..., ::-1])


def mask_picture(mask: Mask) -> str:
    """A mask (h, w) as base64 PNG, 255 = object."""
    return png_text(mask.astype(np.uint8) * 255)


def what_is_seen(color: NDArray[np.uint8], depth: Array, mask: Mask, view: View) -> dict[str, Any]:
    """An object in an RGB-D picture as it stands in requests; intrinsics in pixels."""
    return {
        "color": picture(color),
        "depth": {"png": depth_text(depth), "scale": DEPTH_UNIT},
        "mask": mask_picture(mask),
        "intrinsics": {"fx": view.fx, "fy": view.fy, "cx": view.cx, "cy": view.cy},
    }


def ask_masks(
    url: str, color: NDArray[np.uint8], prompts: list[str], deadline: float = DEADLINE
) -> dict[str, Mask]:
    """Masks by object name from a mask server.

    Raises:
        ServiceError: no usable reply.
    """
    server = Server(url, "mask", deadline)
    reply = server.ask({"color": picture(color), "prompts": prompts})
    entries = reply.get("masks")
    if not isinstance(entries, list) or len(entries) > MAX_OBJECTS:
        raise server.error(f"the answer has no list 'masks' of at most {MAX_OBJECTS}")
    found: dict[str, Mask] = {}
    for index, entry in enumerate(entries):
        if not isinstance(entry, dict) or not isinstance(entry.get("png"), str):
            raise server.error(f"masks[{index}] has no 'png'")
        try:
            image = decode_png_text(entry["png"], f"masks[{index}].png")
        except EtotError as error:
            raise server.error(str(error)) from None
        if image.shape[:2] != color.shape[:2]:
            raise server.error(
                f"masks[{index}] is {image.shape[1]} × {image.shape[0]}; expected "
                f"{color.shape[1]} × {color.shape[0]}"
            )
        mask = mask_of(image)
        if mask.sum() >= LEAST_MASK:
            name = safe_name(str(entry.get("name") or "object"))
            found[unique_name(name, found)] = mask
    if not found:
        raise server.error("found no object")
    return found


def ask_mesh(
    url: str, name: str, color: NDArray[np.uint8], mask: Mask, deadline: float = DEADLINE
) -> tuple[bytes, str]:
    """A mesh file of unknown scale, and its format (glb, obj or stl), from a mesh server.

    Raises:
        ServiceError: no usable reply.
    """
    server = Server(url, "mesh", deadline)
    reply = server.ask({"name": name, "color": picture(color), "mask": mask_picture(mask)})
    kind = str(reply.get("format", "glb")).lower()
    if kind not in ("glb", "obj", "stl"):
        raise server.error(f"format {kind[:20]!r}; expected glb, obj or stl")
    if not isinstance(reply.get("mesh"), str):
        raise server.error("the answer has no 'mesh'")
    try:
        data = base64.b64decode(reply["mesh"], validate=True)
    except (binascii.Error, ValueError):
        raise server.error("mesh is no base64") from None
    if len(data) > MAX_MESH:
        raise server.error(f"the mesh is larger than {MAX_MESH // 2**20} MiB")
    return data, kind


def ask_pose(url: str, request: dict[str, Any], deadline: float = DEADLINE) -> Array:
    """A pose (4, 4) of a mesh in the camera frame from a pose server.

    Raises:
        ServiceError: no usable reply.
    """
    server = Server(url, "pose", deadline)
    return server.pose(server.ask(request).get("pose"), "pose")


@dataclass(frozen=True)
class AskedJoint:
    """A joint as a server says it: camera frame, ``limits`` in m or rad, ``value`` now."""

    type: str
    axis: Array
    origin: Array
    limits: tuple[float, float]
    value: float


def ask_articulation(
    url: str, request: dict[str, Any], deadline: float = DEADLINE
) -> AskedJoint | None:
    """The joint of an object; None where the server finds none.

    Raises:
        ServiceError: no usable reply.
    """
    server = Server(url, "articulation", deadline)
    reply = server.ask(request)
    kind = reply.get("type")
    if kind in (None, "none"):
        return None
    if kind not in ("prismatic", "revolute"):
        raise server.error(f"type {str(kind)[:20]!r}; expected prismatic, revolute or none")
    axis = server.numbers(reply.get("axis"), (3,), "axis")
    length = float(np.linalg.norm(axis))
    if length < 1e-6:
        raise server.error("'axis' has no length")
    origin = server.numbers(reply.get("origin", [0, 0, 0]), (3,), "origin")
    limits = server.numbers(reply.get("limits"), (2,), "limits")
    value = float(server.numbers(reply.get("value", 0.0), (), "value"))
    bound = 1.0 if kind == "prismatic" else np.pi
    if not -bound <= limits[0] < limits[1] <= bound:
        raise server.error(f"'limits' are {limits.tolist()}; expected low < high in ±{bound:.2f}")
    return AskedJoint(kind, axis / length, origin, (float(limits[0]), float(limits[1])), value)

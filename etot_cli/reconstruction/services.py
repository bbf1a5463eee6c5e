"""Servers that take a stage over: JSON over HTTP with a deadline, bounded sizes and retries.

The formats are described in docs/reconstruct_servers.md. Whatever a server does, the caller gets a
checked value or one :class:`ServiceError` that says which server and why.
"""

from __future__ import annotations

import base64
import binascii
import json
import random
import time
from dataclasses import dataclass
from typing import Any

import httpx
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import EtotError, ServiceError
from etot_cli.reconstruction.capture.folder import LEAST_MASK, mask_of, safe_name, unique_name
from etot_cli.reconstruction.capture.pictures import decode_png, encode_png
from etot_cli.reconstruction.capture.view import Array, Mask, View

DEADLINE = 120.0
"""A whole stage, retries included, takes no longer [s]."""
ATTEMPTS = 4
FIRST_PAUSE = 0.5
LONGEST_PAUSE = 8.0
MAX_REPLY = 64 * 1024 * 1024
"""Largest reply in bytes."""
MAX_MESH = 32 * 1024 * 1024
TRANSIENT = frozenset({408, 409, 425, 429, 500, 502, 503, 504})
SHOWN = 200
PLAIN = {"Accept-Encoding": "identity"}


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
        until = time.monotonic() + self.deadline
        reason = "no answer"
        for attempt in range(ATTEMPTS):
            if attempt:
                pause = min(FIRST_PAUSE * 2 ** (attempt - 1), LONGEST_PAUSE)
                pause *= 0.5 + random.random()  # so that several clients do not come at once
                if time.monotonic() + pause >= until:
                    break
                time.sleep(pause)
            try:
                return self._once(request, until)
            except _TryAgainError as error:
                reason = str(error)
        raise self.error(f"{reason} (after {attempt + 1} attempts)")

    def error(self, reason: str) -> ServiceError:
        """An error that names this server; what may be secret in its URL is left out."""
        url = httpx.URL(self.url)
        shown = f"{url.scheme}://{url.host}" + (f":{url.port}" if url.port else "") + url.path
        return ServiceError(f"{self.stage} server {shown}: {reason}")

    def _once(self, request: dict[str, Any], until: float) -> dict[str, Any]:
        left = max(until - time.monotonic(), 0.1)
        try:
            with (
                httpx.Client(timeout=left, follow_redirects=False, trust_env=False) as client,
                client.stream("POST", self.url, json=request, headers=PLAIN) as response,
            ):
                if response.status_code in TRANSIENT:
                    raise _TryAgainError(f"answers {response.status_code}")
                body = self._body(response, until)
        except httpx.InvalidURL as error:
            raise ServiceError(f"{self.stage} server: {self.url!r} is no URL ({error})") from None
        except httpx.UnsupportedProtocol:
            raise ServiceError(
                f"{self.stage} server: {self.url!r} is no http or https address"
            ) from None
        except httpx.TimeoutException:
            raise self.error(f"no complete answer within {self.deadline:g} s") from None
        except httpx.TransportError as error:
            raise _TryAgainError(
                f"cannot be reached: {str(error) or type(error).__name__}"
            ) from None
        return self._checked(response, body)

    def _body(self, response: httpx.Response, until: float) -> bytes:
        encoding = response.headers.get("content-encoding", "identity")
        if encoding.strip().lower() != "identity":
            # Kilobytes may unpack to gigabytes, and the library unpacks before anybody counts.
            raise self.error(f"the answer is compressed as {encoding[:40]!r}, unasked")
        parts: list[bytes] = []
        size = 0
        for part in response.iter_raw():
            size += len(part)
            if size > MAX_REPLY:
                raise self.error(f"the answer is larger than {MAX_REPLY // 2**20} MiB")
            # Bytes that drip in keep every single read in time, but not the whole.
            if time.monotonic() > until:
                raise self.error(f"no complete answer within {self.deadline:g} s")
            parts.append(part)
        return b"".join(parts)

    def _checked(self, response: httpx.Response, body: bytes) -> dict[str, Any]:
        kind = response.headers.get("content-type", "").split(";")[0].strip().lower()
        if response.status_code != 200:
            text = body[:SHOWN].decode("utf-8", "replace").strip()
            raise self.error(f"answers {response.status_code}: {text or 'no text'}")
        if kind != "application/json":
            raise self.error(f"answers {kind or 'without a content type'}; expected JSON")
        try:
            reply = json.loads(body)
        except (ValueError, RecursionError):
            raise self.error("the answer is no valid JSON") from None
        if not isinstance(reply, dict):
            raise self.error("the answer is no JSON object")
        if reply.get("error"):
            raise self.error(f"says: {str(reply['error'])[:SHOWN]}")
        return reply


class _TryAgainError(Exception):
    """A failure that may pass."""


def picture(color: NDArray[np.uint8]) -> str:
    """An RGB picture (h, w, 3) as base64 PNG."""
    return base64.b64encode(encode_png(color[..., ::-1])).decode()


def depth_picture(depth: Array) -> dict[str, Any]:
    """Depth (h, w) [m] as base64 16-bit PNG in tenths of a millimetre."""
    units = np.where(depth < 6.5, np.round(depth * 10_000), 0).astype(np.uint16)
    return {"png": base64.b64encode(encode_png(units)).decode(), "scale": 0.0001}


def mask_picture(mask: Mask) -> str:
    """A mask (h, w) as base64 PNG, 255 = object."""
    return base64.b64encode(encode_png(mask.astype(np.uint8) * 255)).decode()


def intrinsics(view: View) -> dict[str, float]:
    """Intrinsics as they stand in requests [px]."""
    return {"fx": view.fx, "fy": view.fy, "cx": view.cx, "cy": view.cy}


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
    if not isinstance(entries, list) or len(entries) > 64:
        raise server.error("the answer has no list 'masks' of at most 64")
    found: dict[str, Mask] = {}
    for index, entry in enumerate(entries):
        if not isinstance(entry, dict) or not isinstance(entry.get("png"), str):
            raise server.error(f"masks[{index}] has no 'png'")
        data = _decoded(server, entry["png"], f"masks[{index}].png")
        try:
            image = decode_png(data, f"masks[{index}].png")
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
    data = _decoded(server, reply["mesh"], "mesh")
    if len(data) > MAX_MESH:
        raise server.error(f"the mesh is larger than {MAX_MESH // 2**20} MiB")
    return data, kind


def ask_pose(url: str, request: dict[str, Any], deadline: float = DEADLINE) -> Array:
    """A pose (4, 4) of a mesh in the camera frame from a pose server.

    Raises:
        ServiceError: no usable reply.
    """
    server = Server(url, "pose", deadline)
    reply = server.ask(request)
    pose = _numbers(server, reply.get("pose"), (4, 4), "pose")
    rotation = pose[:3, :3]
    if np.abs(rotation @ rotation.T - np.eye(3)).max() > 0.02 or np.linalg.det(rotation) < 0:
        raise server.error("'pose' is no rigid pose")
    return pose


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
    axis = _numbers(server, reply.get("axis"), (3,), "axis")
    length = float(np.linalg.norm(axis))
    if length < 1e-6:
        raise server.error("'axis' has no length")
    origin = _numbers(server, reply.get("origin", [0, 0, 0]), (3,), "origin")
    limits = _numbers(server, reply.get("limits"), (2,), "limits")
    value = float(_numbers(server, reply.get("value", 0.0), (), "value"))
    bound = 1.0 if kind == "prismatic" else np.pi
    if not -bound <= limits[0] < limits[1] <= bound:
        raise server.error(f"'limits' are {limits.tolist()}; expected low < high in ±{bound:.2f}")
    return AskedJoint(kind, axis / length, origin, (float(limits[0]), float(limits[1])), value)


def _decoded(server: Server, text: str, what: str) -> bytes:
    try:
        return base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        raise server.error(f"{what} is no base64") from None


def _numbers(server: Server, value: Any, shape: tuple[int, ...], what: str) -> Array:
    try:
        array = np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        array = np.zeros(0)
    if array.shape != shape or not np.isfinite(array).all():
        raise server.error(f"{what!r} is not {'×'.join(map(str, shape)) or 'a'} number(s)")
    return array

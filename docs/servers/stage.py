"""What the reference servers share: HTTP with JSON, and pictures in base64.

It needs OpenCV and NumPy only. A server is a function from a request to a reply, both plain data:
``ValueError`` says that the request cannot be answered and ends the client's command with its text;
any other exception is taken for a failure that may pass, and the client tries again.
"""

from __future__ import annotations

import argparse
import base64
import binascii
import json
import sys
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import cv2
import numpy as np

MAX_REQUEST = 128 * 1024 * 1024
"""Largest request in bytes: two pictures and a mesh."""
MAX_SIDE = 4096
"""Largest side of a picture [px]."""
Answer = Callable[[dict[str, Any]], dict[str, Any]]


def read_color(request: dict[str, Any]) -> np.ndarray:
    """The RGB picture (h, w, 3) of a request."""
    return _picture(request.get("color"), "color", cv2.IMREAD_COLOR)[..., ::-1].copy()


def read_mask(request: dict[str, Any]) -> np.ndarray:
    """The object's pixels (h, w), bool."""
    return _picture(request.get("mask"), "mask", cv2.IMREAD_GRAYSCALE) > 127


def read_depth(request: dict[str, Any]) -> np.ndarray:
    """Depth (h, w) along the optical axis [m], 0 = no reading."""
    depth = request.get("depth")
    if not isinstance(depth, dict):
        raise ValueError("'depth' is missing")
    return _picture(depth.get("png"), "depth", cv2.IMREAD_UNCHANGED) * float(depth["scale"])


def read_intrinsics(request: dict[str, Any]) -> tuple[float, float, float, float]:
    """fx, fy, cx, cy [px]; whole numbers are pixel centres."""
    values = request.get("intrinsics")
    if not isinstance(values, dict):
        raise ValueError("'intrinsics' is missing")
    fx, fy, cx, cy = (float(values[key]) for key in ("fx", "fy", "cx", "cy"))
    return fx, fy, cx, cy


def read_file(request: dict[str, Any], key: str) -> bytes:
    """A file in base64."""
    text = request.get(key)
    if not isinstance(text, str):
        raise ValueError(f"{key!r} is missing")
    try:
        return base64.b64decode(text, validate=True)
    except binascii.Error:
        raise ValueError(f"{key!r} is no base64") from None


def write_mask(mask: np.ndarray) -> str:
    """A mask (h, w) as PNG in base64, 255 = object."""
    done, data = cv2.imencode(".png", mask.astype(np.uint8) * 255)
    if not done:
        raise ValueError("a mask cannot be written as PNG")
    return base64.b64encode(data).decode()


def write_file(data: bytes) -> str:
    """A file in base64."""
    return base64.b64encode(data).decode()


def _picture(text: Any, key: str, flags: int) -> np.ndarray:
    if not isinstance(text, str):
        raise ValueError(f"{key!r} is missing")
    data = read_file({key: text}, key)
    # A PNG says its size in its first bytes; nothing is decoded that is too large.
    header = data[:24]
    if header[:8] != b"\x89PNG\r\n\x1a\n" or len(header) < 24:
        raise ValueError(f"{key!r} is no PNG")
    sides = int.from_bytes(header[16:20], "big"), int.from_bytes(header[20:24], "big")
    if not 0 < max(sides) <= MAX_SIDE:
        raise ValueError(f"{key!r} is {sides[0]} × {sides[1]}; expected at most {MAX_SIDE}")
    picture = cv2.imdecode(np.frombuffer(data, np.uint8), flags)
    if picture is None:
        raise ValueError(f"{key!r} is a damaged PNG")
    return picture


def make_server(answer: Answer, port: int, host: str = "127.0.0.1") -> ThreadingHTTPServer:
    """A server that answers POST requests; port 0 takes a free one."""

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            try:
                size = int(self.headers.get("content-length", 0))
                if not 0 < size <= MAX_REQUEST:
                    raise ValueError("the request is empty or too large")
                request = json.loads(self.rfile.read(size))
                if not isinstance(request, dict):
                    raise ValueError("the request is no JSON object")
                self._send(200, answer(request))
            except (ValueError, KeyError) as error:
                self._send(200, {"error": str(error) or type(error).__name__})
            except Exception as error:  # a model may fail in any way, and the next try may work
                print(f"{type(error).__name__}: {error}", file=sys.stderr)
                self._send(500, {"error": type(error).__name__})

        def _send(self, status: int, reply: dict[str, Any]) -> None:
            body = json.dumps(reply).encode()
            self.send_response(status)
            self.send_header("content-type", "application/json")
            self.send_header("content-length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

    return ThreadingHTTPServer((host, port), Handler)


def run(answer: Answer, description: str | None, port: int) -> None:
    """Serves until interrupted; the program's options choose host and port."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--host", default="127.0.0.1", help="0.0.0.0 lets other machines in")
    parser.add_argument("--port", type=int, default=port)
    options = parser.parse_args()
    server = make_server(answer, options.port, options.host)
    print(f"http://{options.host}:{server.server_port}/", flush=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        server.server_close()

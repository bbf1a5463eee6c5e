"""A reference mask server: replace :func:`segment` by a promptable segmentation model.

It needs OpenCV and NumPy only. As it stands it returns what differs in colour from the picture's
most common colour, one mask per connected region: enough to try the connection.
"""

from __future__ import annotations

import argparse
import base64
import json
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import cv2
import numpy as np

MAX_REQUEST = 64 * 1024 * 1024


def segment(color: np.ndarray, prompts: list[str]) -> list[tuple[str, np.ndarray]]:
    """Names and masks (h, w) bool of the objects in an RGB picture (h, w, 3).

    A model goes here: load it once at the start of the program, call it with the prompts (or for
    everything, when there are none) and return its masks.
    """
    lab = cv2.cvtColor(color, cv2.COLOR_RGB2LAB).astype(np.float32)
    common = np.median(lab.reshape(-1, 3), axis=0)
    differs = (np.linalg.norm(lab - common, axis=2) > 30).astype(np.uint8)
    differs = cv2.morphologyEx(differs, cv2.MORPH_OPEN, np.ones((5, 5), np.uint8))
    _, labels, stats, _ = cv2.connectedComponentsWithStats(differs)
    order = [i for i in range(1, len(stats)) if stats[i, cv2.CC_STAT_AREA] > 400]
    names = [*prompts, *(f"object_{i}" for i in order)]
    return [(name, labels == i) for name, i in zip(names, order, strict=False)]


class Handler(BaseHTTPRequestHandler):
    """Answers one request at a time per connection."""

    def do_POST(self) -> None:
        """Reads a picture and prompts, writes masks."""
        try:
            size = int(self.headers.get("content-length", 0))
            if not 0 < size <= MAX_REQUEST:
                raise ValueError("the request is empty or too large")
            request = json.loads(self.rfile.read(size))
            data = np.frombuffer(base64.b64decode(request["color"]), np.uint8)
            picture = cv2.imdecode(data, cv2.IMREAD_COLOR)
            if picture is None:
                raise ValueError("'color' is no PNG")
            found = segment(picture[..., ::-1].copy(), list(request.get("prompts", [])))
            reply: dict[str, Any] = {
                "masks": [{"name": name, "png": _png(mask)} for name, mask in found]
            }
        except (ValueError, KeyError, TypeError) as error:
            reply = {"error": str(error)}
        body = json.dumps(reply).encode()
        self.send_response(200)
        self.send_header("content-type", "application/json")
        self.send_header("content-length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)


def _png(mask: np.ndarray) -> str:
    return base64.b64encode(cv2.imencode(".png", mask.astype(np.uint8) * 255)[1]).decode()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--port", type=int, default=8765)
    server = ThreadingHTTPServer(("127.0.0.1", parser.parse_args().port), Handler)
    print(f"http://127.0.0.1:{server.server_port}/")
    server.serve_forever()

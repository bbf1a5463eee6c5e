"""A video-generation server on a real socket, which always sends a film of its own."""

from __future__ import annotations

import io
import json
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import av
import numpy as np

FRAMES = 12


def film(frames: int = FRAMES, width: int = 64) -> bytes:
    """An mp4 that grows brighter from frame to frame."""
    stream = io.BytesIO()
    with av.open(stream, mode="w", format="mp4") as container:
        track = container.add_stream("mpeg4", rate=10)
        track.width, track.height, track.pix_fmt = width, 48, "yuv420p"
        for number in range(frames):
            pixels = np.full((48, width, 3), 20 + 200 * number // frames, dtype=np.uint8)
            for packet in track.encode(av.VideoFrame.from_ndarray(pixels, format="rgb24")):
                container.mux(packet)
        for packet in track.encode():
            container.mux(packet)
    return stream.getvalue()


class Server:
    """Answers every POST with the next of its replies, the last one for ever."""

    def __init__(self) -> None:
        self.replies: list[tuple[int, str, bytes]] = [(200, "video/mp4", film())]
        self.requests: list[dict[str, Any]] = []
        self.headers: list[dict[str, str]] = []
        outer = self

        class Handler(BaseHTTPRequestHandler):
            def do_POST(self) -> None:
                body = self.rfile.read(int(self.headers["Content-Length"]))
                outer.requests.append(json.loads(body))
                outer.headers.append(dict(self.headers))
                number = min(len(outer.requests), len(outer.replies)) - 1
                status, kind, content = outer.replies[number]
                self.send_response(status)
                self.send_header("Content-Type", kind)
                self.send_header("Content-Length", str(len(content)))
                self.end_headers()
                self.wfile.write(content)

            def log_message(self, format: str, *args: Any) -> None:  # noqa: A002
                pass

        self.http = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        threading.Thread(target=self.http.serve_forever, args=(0.05,), daemon=True).start()
        self.url = f"http://127.0.0.1:{self.http.server_address[1]}/generate"

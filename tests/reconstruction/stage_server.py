"""A small server for tests that stands for a model server: real sockets, replies as asked for."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

Reply = Callable[[BaseHTTPRequestHandler, dict[str, Any]], None]


@contextmanager
def serving(*replies: Reply) -> Iterator[tuple[str, list[dict[str, Any]]]]:
    """A server that gives these replies in turn, the last one for ever; its URL and requests."""
    requests: list[dict[str, Any]] = []

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["content-length"]))
            requests.append(json.loads(body))
            reply = replies[min(len(requests), len(replies)) - 1]
            with suppress(BrokenPipeError, ConnectionResetError):
                reply(self, requests[-1])

        def log_message(self, *_: object) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.daemon_threads = True
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/stage?key=secret", requests
    finally:
        server.shutdown()
        server.server_close()


def sending(body: bytes, status: int = 200, kind: str = "application/json") -> Reply:
    """A reply with this body."""

    def reply(handler: BaseHTTPRequestHandler, _: dict[str, Any]) -> None:
        handler.send_response(status)
        handler.send_header("content-type", kind)
        handler.send_header("content-length", str(len(body)))
        handler.end_headers()
        handler.wfile.write(body)

    return reply


def saying(value: Any, status: int = 200) -> Reply:
    """A reply in JSON."""
    return sending(json.dumps(value).encode(), status)


def answering(answer: Callable[[dict[str, Any]], Any]) -> Reply:
    """A reply in JSON that depends on the request."""

    def reply(handler: BaseHTTPRequestHandler, request: dict[str, Any]) -> None:
        saying(answer(request))(handler, request)

    return reply

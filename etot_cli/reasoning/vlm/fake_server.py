"""A chat-completions server that needs no model: it plays a cassette or a script.

``python -m etot_cli.reasoning.vlm.fake_server FOLDER [--port N]`` serves a folder with recorded
exchanges (``<role>-<key>.json``), a ``script.json``, or both; see
:mod:`etot_cli.reasoning.vlm.player`.
"""

from __future__ import annotations

import argparse
import base64
import json
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

from etot_cli.errors import EtotError
from etot_cli.reasoning.vlm.player import Received, Reply, error_reply, load_player

REQUEST_ID = "X-Client-Request-Id"
MAX_REQUEST = 64 * 1024 * 1024
"""A request holds a few pictures of some hundred kilobytes; the rest is margin [bytes]."""


Script = Callable[[Received], Reply]


class FakeServer:
    """Serves a script on 127.0.0.1. A context manager.

    Args:
        script: answers each request; called from several threads.
        port: 0 for any free one.
    """

    def __init__(self, script: Script, port: int = 0) -> None:
        self.requests: list[Received] = []
        self._lock = threading.Lock()
        self._script = script
        outer = self

        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"
            wbufsize = -1
            """Head and body leave together; apart, each answer would wait for a delayed ACK."""

            def do_POST(self) -> None:
                outer._answer(self)

            def do_GET(self) -> None:
                _send(self, Reply(raw=b'{"object": "list", "data": []}'), "fake")

            def log_message(self, format: str, *args: Any) -> None:  # noqa: A002
                """Says nothing."""

        self._http = _Server(("127.0.0.1", port), Handler)
        self._thread = threading.Thread(target=self._http.serve_forever, args=(0.05,), daemon=True)

    @property
    def url(self) -> str:
        """The API base."""
        return f"http://127.0.0.1:{self._http.server_address[1]}/v1"

    def __enter__(self) -> FakeServer:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._http.shutdown()
        self._http.server_close()

    def serve(self) -> None:
        """Serves until it is interrupted."""
        self._http.serve_forever()

    def _answer(self, handler: BaseHTTPRequestHandler) -> None:
        length = handler.headers.get("Content-Length", "")
        if not length.isdigit() or int(length) > MAX_REQUEST:
            _send(handler, error_reply(400, "Content-Length is missing or too large"), "fake")
            return
        try:
            received = read_request(handler.rfile.read(int(length)), dict(handler.headers))
        except (ValueError, KeyError, TypeError, AttributeError):
            _send(handler, error_reply(400, "this is no chat-completions request"), "fake")
            return
        with self._lock:
            self.requests.append(received)
        if not handler.path.split("?")[0].endswith("/chat/completions"):
            _send(handler, error_reply(404, f"no such address: {handler.path}"), "fake")
            return
        _send(handler, self._script(received), str(received.body.get("model")))


class _Server(ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Clients that hang up are what this server is for."""


def _send(handler: BaseHTTPRequestHandler, reply: Reply, model: str) -> None:
    if reply.stall_s:
        time.sleep(reply.stall_s)
    if reply.reset:
        handler.close_connection = True
        return
    body = reply.body(model)
    handler.send_response(reply.status)
    headers = {"Content-Type": reply.content_type, "Content-Length": str(len(body)),
               **reply.headers}  # fmt: skip
    for name, value in headers.items():
        if value:
            handler.send_header(name, value)
    handler.end_headers()
    sent = body if reply.cut is None else body[: reply.cut]
    if reply.drip_s:
        for index in range(len(sent)):
            handler.wfile.write(sent[index : index + 1])
            handler.wfile.flush()
            time.sleep(reply.drip_s)
    else:
        handler.wfile.write(sent)
    handler.wfile.flush()
    if reply.cut is not None:
        handler.close_connection = True


def read_request(body: bytes, headers: Mapping[str, str]) -> Received:
    """Takes a request apart.

    Raises:
        ValueError, KeyError, TypeError: it is none.
    """
    data = json.loads(body)
    request_id = next((v for k, v in headers.items() if k.lower() == REQUEST_ID.lower()), "")
    role, _, key = request_id.rpartition("-")
    users = [message for message in data["messages"] if message["role"] == "user"]
    text, images = _parts(users[0]["content"])
    return Received(data, headers, role, key, text, len(users) - 1, tuple(images))


def _parts(content: Any) -> tuple[str, list[bytes]]:
    if isinstance(content, str):
        return content, []
    texts = [part["text"] for part in content if part["type"] == "text"]
    urls = [part["image_url"]["url"] for part in content if part["type"] == "image_url"]
    return "\n".join(texts), [base64.b64decode(url.partition(",")[2]) for url in urls]


def main(arguments: Sequence[str] | None = None) -> int:
    """Serves a folder until Ctrl-C."""
    parser = argparse.ArgumentParser(description="A chat-completions server without a model.")
    parser.add_argument("folder", type=Path, help="recorded exchanges, a script.json, or both")
    parser.add_argument("--port", type=int, default=0, help="0: any free one")
    options = parser.parse_args(arguments)
    try:
        server = FakeServer(load_player(options.folder), options.port)
    except (EtotError, OSError, OverflowError) as error:
        parser.exit(2, f"error: {error}\n")
    print(f"serving {options.folder} as --vlm-url {server.url}", flush=True)
    try:
        server.serve()
    except KeyboardInterrupt:
        return 130
    return 0


if __name__ == "__main__":
    raise SystemExit(main())

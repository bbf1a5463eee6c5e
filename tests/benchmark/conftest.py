"""Shared by the benchmark's tests: a video server."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.benchmark.video_server import Server


@pytest.fixture
def server() -> Iterator[Server]:
    started = Server()
    yield started
    started.http.shutdown()
    started.http.server_close()

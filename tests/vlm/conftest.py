"""Settings without the machine's environment, and servers on real sockets."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from etot_cli.reasoning.vlm.settings import VlmSettings

KEY = "sk-test-3f9aQ7/+=secret"

Make = Callable[..., VlmSettings]


@pytest.fixture(autouse=True)
def _own_environment(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    """No keys, endpoints, proxies or caches of the machine."""
    for name in list(os.environ):
        ours = name.startswith(("ETOT_", "OPENAI_")) and name != "ETOT_HTML"
        if ours or name.lower().endswith("_proxy"):
            monkeypatch.delenv(name)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    yield


@pytest.fixture
def make_settings() -> Make:
    """Quick settings for one server."""

    def make(url: str, **more: Any) -> VlmSettings:
        given: dict[str, Any] = {
            "url": url, "key": KEY, "cache": "off", "probe": False, "images": 0, "backoff_s": 0.001,
            "retries": 2, "connect_timeout_s": 2.0, "read_timeout_s": 2.0, "deadline_s": 5.0,
            "patience_s": 10.0,
        }  # fmt: skip
        return VlmSettings.load(**{**given, **more})

    return make

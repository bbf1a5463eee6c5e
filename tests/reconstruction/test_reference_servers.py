"""The reference servers of the documentation: as shipped, with a model in place, and misused."""

from __future__ import annotations

import base64
import importlib
import json
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

import httpx
import numpy as np
import pytest
import trimesh

from etot_cli.reconstruction import services
from etot_cli.reconstruction.options import Options
from etot_cli.reconstruction.pipeline import Twin, reconstruct
from etot_cli.services import endpoint
from etot_cli.world.capture import Picture, camera_to_base

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("fitted_once")]


SERVERS = Path(__file__).parents[2] / "docs" / "servers"
NAMES = ("masks_server", "mesh_server", "pose_server", "articulation_server")


@pytest.fixture
def load(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Imports a reference server as a module of its own."""
    monkeypatch.syspath_prepend(str(SERVERS))
    monkeypatch.setattr(endpoint, "FIRST_PAUSE", 0.01)

    def chosen(name: str) -> ModuleType:
        for module in ("stage", name):
            sys.modules.pop(module, None)
        return importlib.import_module(name)

    return chosen


@contextmanager
def running(module: ModuleType) -> Iterator[str]:
    """The server of a module on a free port; its URL."""
    server = importlib.import_module("stage").make_server(module.answer, 0)
    server.RequestHandlerClass.log_message = lambda *_: None
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/"
    finally:
        server.shutdown()
        server.server_close()


def only(folder: Path, *names: str) -> Path:
    for file in (folder / "masks").glob("*.png"):
        if file.stem not in names:
            file.unlink()
    return folder


def twin_of(folder: Path, **options: Any) -> Twin:
    return reconstruct(Options(capture=folder, settle=False, deadline=30, **options))


def test_masks(load: Any, folder: Path, picture: Picture, monkeypatch: Any) -> None:
    """As shipped, with colour alone; and with a model in place of ``segment``."""
    module = load("masks_server")
    with running(module) as url:
        twin = twin_of(folder, masks_url=url)
        assert len(twin.solids) >= 3
        monkeypatch.setattr(
            module, "segment", lambda color, prompts: [(prompts[0], picture.masks["mug"])]
        )
        twin = twin_of(folder, masks_url=url, instruction="Pick up the mug.")
    assert [(solid.name, solid.kind) for solid in twin.solids] == [("mug", "cup")]


def test_mesh(load: Any, folder: Path, picture: Picture, monkeypatch: Any) -> None:
    module = load("mesh_server")
    true = picture.truth["objects"]["ball"]

    def model_object(name: str, color: np.ndarray, mask: np.ndarray) -> tuple[bytes, str]:
        assert name == "ball" and color.shape == (*mask.shape, 3)
        assert (mask == picture.masks["ball"]).all()
        return trimesh.creation.icosphere(subdivisions=3).export(file_type="glb"), "glb"

    with running(module) as url:
        shipped = twin_of(only(folder, "ball"), mesh_url=url).solids[0]
        monkeypatch.setattr(module, "model_object", model_object)
        modelled = twin_of(folder, mesh_url=url).solids[0]
    # A ball turned about its upright middle is about a ball.
    assert shipped.kind == modelled.kind == "mesh"
    assert shipped.size == pytest.approx(true["size"], rel=0.15)
    assert modelled.size == pytest.approx(true["size"], rel=0.02)


def test_pose(load: Any, folder: Path, picture: Picture, tmp_path: Path, monkeypatch: Any) -> None:
    module = load("pose_server")
    mesh = trimesh.creation.box([140.0, 100.0, 60.0])
    mesh.export(tmp_path / "crate.obj")
    true = np.array(picture.truth["objects"]["crate"]["position"])
    camera = camera_to_base(picture.camera)
    asked = []

    def estimate_pose(scene: Any) -> np.ndarray:
        asked.append(scene)
        assert trimesh.load(trimesh.util.wrap_as_stream(scene.mesh), file_type=scene.kind)
        assert np.abs(scene.depth - picture.depth).max() < 0.001
        assert scene.camera[0, 0] == 480 and scene.metres_per_unit is None
        pose = np.eye(4)
        c, s = np.cos(np.radians(20)), np.sin(np.radians(20))
        pose[:2, :2], pose[:3, 3] = [[c, -s], [s, c]], true
        return np.asarray(np.linalg.inv(camera) @ pose)

    options = {"meshes": {"crate": tmp_path / "crate.obj"}}
    only(folder, "crate", "marker")
    with running(module) as url:
        shipped = twin_of(folder, pose_url=url, **options)
        monkeypatch.setattr(module, "estimate_pose", estimate_pose)
        modelled = twin_of(folder, pose_url=url, **options)
    assert len(asked) == 1
    for twin in (shipped, modelled):
        crate = next(solid for solid in twin.solids if solid.name == "crate")
        assert np.linalg.norm(crate.center - true) < 0.003
        assert crate.size == pytest.approx((0.14, 0.10, 0.06), rel=0.03)


def test_articulation(load: Any, folder: Path, picture: Picture, monkeypatch: Any) -> None:
    module = load("articulation_server")
    only(folder, "crate", "marker")
    down = (camera_to_base(picture.camera)[:3, :3].T @ [0.0, 0.0, 1.0]).tolist()
    joint = module.Joint("revolute", tuple(down), (0.0, 0.0, 0.6), (0.0, 1.2), 0.3)
    with running(module) as url:
        assert twin_of(folder, articulation_url=url).joints == []
        monkeypatch.setattr(module, "find_joint", lambda scene: joint)
        twin = twin_of(folder, articulation_url=url)
    (found,) = twin.joints
    assert (found.owner, found.type) == ("crate", "hinge")
    assert twin.document["objects"]["crate"]["door"]["open_deg"] == pytest.approx(17.2, abs=0.1)


def test_a_model_that_fails(load: Any, folder: Path, monkeypatch: Any) -> None:
    """What may pass is tried again; what a model refuses is said."""
    module = load("mesh_server")
    tries = []

    def out_of_memory(*_: object) -> tuple[bytes, str]:
        tries.append(1)
        raise MemoryError

    def refuses(*_: object) -> tuple[bytes, str]:
        raise ValueError("the picture is too dark")

    only(folder, "ball")
    with running(module) as url:
        monkeypatch.setattr(module, "model_object", out_of_memory)
        with pytest.raises(services.ServiceError, match=r"answers 500 \(after 4 attempts\)"):
            twin_of(folder, mesh_url=url)
        assert len(tries) == 4
        monkeypatch.setattr(module, "model_object", refuses)
        with pytest.raises(services.ServiceError, match="says: the picture is too dark"):
            twin_of(folder, mesh_url=url)


HUGE = b"\x89PNG\r\n\x1a\n" + b"\0\0\0\rIHDR" + (100_000).to_bytes(4, "big") * 2 + bytes(20)
REQUESTS: dict[str, tuple[bytes, str]] = {
    "no json": (b"{", "Expecting"),
    "a list": (b"[]", "no JSON object"),
    "no picture": (b"{}", "is missing"),
    "no base64": (json.dumps({"color": "???"}).encode(), "no base64"),
    "no png": (json.dumps({"color": "aGVsbG8="}).encode(), "no PNG"),
    "a huge picture": (
        json.dumps({"color": base64.b64encode(HUGE).decode()}).encode(), "expected at most 4096"
    ),
    "damaged": (
        json.dumps({"color": base64.b64encode(HUGE[:16] + b"\0\0\0\x08" * 2).decode()}).encode(),
        "damaged",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", REQUESTS)
def test_a_bad_request_is_refused(load: Any, case: str) -> None:
    body, message = REQUESTS[case]
    with running(load("masks_server")) as url:
        reply = httpx.post(url, content=body, timeout=10).json()
    assert message in reply["error"]


@pytest.mark.parametrize("name", NAMES)
def test_it_runs_as_a_program(name: str) -> None:
    """``python docs/servers/…`` prints its address and answers there."""
    process = subprocess.Popen(
        [sys.executable, str(SERVERS / f"{name}.py"), "--port", "0"], stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL, text=True, env={**os.environ},
    )  # fmt: skip
    try:
        assert process.stdout is not None
        url = process.stdout.readline().strip()
        reply = httpx.post(url, json={}, timeout=20).json()
        assert "missing" in reply["error"]
    finally:
        process.terminate()
        process.wait(timeout=10)

"""``etot reconstruct`` with stages on servers, as a user runs it: what works, what goes wrong."""

from __future__ import annotations

import base64
import json
import re
import time
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
import trimesh

from etot_cli.cli.app import run
from etot_cli.reconstruction import services
from etot_cli.reconstruction.capture.pictures import decode_png
from etot_cli.reporting.reconstruct_report import ReconstructReport
from etot_cli.services import endpoint
from etot_cli.specs.load import load_scene
from etot_cli.world.capture import Picture, camera_to_base, write_capture
from tests.reconstruction.conftest import render
from tests.reconstruction.meshes import angle_block
from tests.reconstruction.scenes import scene
from tests.reconstruction.stage_server import Reply, answering, saying, sending, serving

Run = Callable[..., tuple[int, dict[str, Any], str]]


@pytest.fixture
def etot(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs ``etot reconstruct``: exit code, report and what it complains about."""

    def call(*words: object) -> tuple[int, dict[str, Any], str]:
        out = tmp_path / "out"
        code = run(["reconstruct", *map(str, words), "--out", str(out), "-q"])
        report = out / "report.json"
        found = json.loads(report.read_text()) if report.exists() else {}
        if found:
            ReconstructReport.model_validate(found)
        return code, found, capsys.readouterr().err

    return call


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(endpoint, "FIRST_PAUSE", 0.01)
    monkeypatch.setenv("ETOT_CACHE", str(tmp_path / "cache"))


def only(folder: Path, *names: str) -> Path:
    """The capture with these masks alone."""
    for file in (folder / "masks").glob("*.png"):
        if file.stem not in names:
            file.unlink()
    return folder


def ball_mesh() -> bytes:
    data = trimesh.creation.icosphere(subdivisions=3, radius=17.0).export(file_type="obj")
    return str(data).encode()


def mesh_reply(data: bytes, kind: str = "obj") -> dict[str, str]:
    return {"mesh": base64.b64encode(data).decode(), "format": kind}


@pytest.mark.slow
def test_masks(etot: Run, folder: Path, picture: Picture, tmp_path: Path) -> None:
    def answer(request: dict[str, Any]) -> Any:
        shown = decode_png(base64.b64decode(request["color"]), "color")
        assert shown.shape[:2] == picture.masks["ball"].shape
        assert request["prompts"] == ["red ball", "mug"]
        named = zip(request["prompts"], ("ball", "mug"), strict=True)
        return {"masks": [
            {"name": prompt, "png": services.mask_picture(picture.masks[true])}
            for prompt, true in named
        ]}  # fmt: skip

    with serving(answering(answer)) as (url, requests):
        code, report, _ = etot(
            folder, "--masks-url", url, "--instruction", "Put the red ball into the mug."
        )
    assert (code, len(requests)) == (0, 1)
    assert {item["name"]: item["kind"] for item in report["objects"]} == {
        "red_ball": "sphere", "mug": "cup"
    }  # fmt: skip
    assert set(load_scene(tmp_path / "out" / "scene.yaml").objects) == {"red_ball", "mug"}


@pytest.mark.slow
def test_a_mesh_of_unknown_scale(etot: Run, folder: Path, picture: Picture, tmp_path: Path) -> None:
    """The first answer is that the server is busy."""
    with serving(saying({}, 503), saying(mesh_reply(ball_mesh()))) as (url, requests):
        code, report, _ = etot(only(folder, "ball"), "--mesh-url", url)
    assert (code, len(requests)) == (0, 2)
    assert requests[0]["name"] == "ball"
    (item,) = report["objects"]
    true = picture.truth["objects"]["ball"]
    assert item["size"] == pytest.approx(true["size"], rel=0.02)
    assert item["position"] == pytest.approx(true["position"], abs=0.002)
    assert item["model"]["source"] == "mesh server"
    assert item["model"]["metres_per_unit"] == pytest.approx(0.038 / 17, rel=0.02)
    assert load_scene(tmp_path / "out" / "scene.yaml").objects["ball"].kind == "mesh"
    assert mujoco.MjModel.from_xml_path(str(tmp_path / "out" / "scene.xml")).nbody == 2


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Picture]:
    """A capture of a block of which the mesh lies beside it."""
    folder = tmp_path_factory.mktemp("block")
    angle_block().export(folder / "block.obj")
    what = scene({"block": {"kind": "mesh", "file": "block.obj", "at": [0.45, 0.05],
                            "yaw_deg": 100, "mass": 0.2, "color": "purple"}})  # fmt: skip
    picture = render(what.model_copy(update={"directory": str(folder)}))
    write_capture(picture, folder / "capture")
    return folder, picture


def true_pose(picture: Picture) -> np.ndarray:
    """Pose of the block's file in the camera frame."""
    true = picture.truth["objects"]["block"]
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, np.array(true["quaternion"]))
    vertices = np.asarray(angle_block().vertices)
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    pose = np.eye(4)
    pose[:3, :3] = turn.reshape(3, 3)
    pose[:3, 3] = true["position"] - pose[:3, :3] @ middle
    return np.asarray(np.linalg.inv(camera_to_base(picture.camera)) @ pose)


@pytest.mark.slow
@pytest.mark.usefixtures("fitted_once")
@pytest.mark.parametrize("turned", [0.0, 120.0])
def test_a_pose(etot: Run, block: tuple[Path, Picture], turned: float) -> None:
    """A right pose is taken; a wrong one is noticed and put right."""
    folder, picture = block
    pose = true_pose(picture)
    c, s = np.cos(np.radians(turned)), np.sin(np.radians(turned))
    said = pose @ np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    with serving(saying({"pose": said.tolist()})) as (url, requests):
        code, report, _ = etot(
            folder / "capture", "--pose-url", url, "--mesh", f"block={folder / 'block.obj'}"
        )
    assert code == 0
    (request,) = requests
    assert base64.b64decode(request["mesh"]) == (folder / "block.obj").read_bytes()
    assert request["format"] == "obj" and request["metres_per_unit"] is None
    depth = decode_png(base64.b64decode(request["depth"]["png"]), "depth")
    assert np.abs(depth * request["depth"]["scale"] - picture.depth).max() < 0.001
    (item,) = report["objects"]
    base = camera_to_base(picture.camera) @ pose
    assert np.array(item["model"]["pose"])[:3] == pytest.approx(base[:3], abs=0.02)
    noticed = any("pose server" in text for text in item["warnings"])
    assert noticed == (turned != 0.0)


JOINTS = {
    "prismatic": ({"type": "prismatic", "limits": [0, 0.05], "value": 0.0}, "drawer_unit", "slide"),
    "revolute": ({"type": "revolute", "limits": [0, 1.5], "value": 0.0}, "cabinet", "hinge"),
}


@pytest.mark.slow
@pytest.mark.usefixtures("fitted_once")
@pytest.mark.parametrize("case", JOINTS)
def test_a_joint(etot: Run, folder: Path, picture: Picture, case: str) -> None:
    said, kind, joint = JOINTS[case]
    camera = camera_to_base(picture.camera)
    yaw = np.radians(20)
    front = np.array([np.cos(yaw), np.sin(yaw), 0.0])
    axis = front if case == "prismatic" else np.array([0.0, 0.0, 1.0])
    origin = np.array([*picture.truth["objects"]["crate"]["position"][:2], 0.16]) + 0.07 * front
    answer = {
        **said, "axis": (camera[:3, :3].T @ axis).tolist(),
        "origin": (camera[:3, :3].T @ (origin - camera[:3, 3])).tolist(),
    }  # fmt: skip
    with serving(saying(answer)) as (url, requests):
        code, report, _ = etot(only(folder, "crate", "marker"), "--articulation-url", url)
    assert (code, len(requests)) == (0, 1)
    item = next(item for item in report["objects"] if item["name"] == "crate")
    assert item["kind"] == kind
    assert item["size"] == pytest.approx([0.14, 0.10, 0.06], rel=0.03)
    (found,) = report["joints"]
    assert (found["object"], found["type"]) == ("crate", joint)
    assert found["axis"] == pytest.approx(axis, abs=1e-3)


@pytest.mark.slow
@pytest.mark.usefixtures("fitted_once")
def test_nothing_to_move(etot: Run, folder: Path) -> None:
    with serving(saying({"type": "none"})) as (url, _):
        code, report, _ = etot(only(folder, "crate", "marker"), "--articulation-url", url)
    assert (code, report["joints"]) == (0, [])
    assert {item["kind"] for item in report["objects"]} == {"box", "pen"}


def sleepy(handler: BaseHTTPRequestHandler, _: dict[str, Any]) -> None:
    time.sleep(3)
    handler.close_connection = True


def hanging_up(handler: BaseHTTPRequestHandler, _: dict[str, Any]) -> None:
    handler.connection.close()


def glb_bomb() -> bytes:
    """A few bytes that ask for gigabytes."""
    document = {"asset": {"version": "2.0"}, "accessors": [
        {"componentType": 5126, "type": "VEC3", "count": 2_000_000_000}]}  # fmt: skip
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    head = len(text).to_bytes(4, "little") + (0x4E4F534A).to_bytes(4, "little")
    return (
        b"glTF" + (2).to_bytes(4, "little") + (20 + len(text)).to_bytes(4, "little") + head + text
    )


STAGES = ("masks", "mesh", "pose", "articulation")
EVERYWHERE: dict[str, tuple[Reply, str]] = {
    "bad json": (sending(b'{"masks": ['), "no valid JSON"),
    "always busy": (saying({}, 500), r"answers 500 \(after 4 attempts\)"),
    "forbidden": (sending(b"no", 403, "text/plain"), "answers 403: no"),
    "too slow": (sleepy, "no complete answer within 0.5 s"),
    "too much": (sending(b" " * 3_000_000), "larger than 2 MiB"),
    "hangs up": (hanging_up, "connection broke"),
    "an error": (saying({"error": "out of memory"}), "says: out of memory"),
}
WRONG: dict[str, tuple[str, Any, str]] = {
    "no masks": ("masks", {"masks": []}, "found no object"),
    "a mask of another size": (
        "masks", {"masks": [{"png": services.mask_picture(np.ones((8, 8), bool))}]}, "is 8 × 8"
    ),
    "no mesh": ("mesh", {"format": "obj"}, "has no 'mesh'"),
    "another format": ("mesh", mesh_reply(b"x", "fbx"), "expected glb, obj or stl"),
    "a broken mesh": ("mesh", mesh_reply(b"v 0 0 zero"), "not a readable mesh|faces"),
    "an archive": ("mesh", mesh_reply(b"PK\3\4" + bytes(400), "glb"), "no GLB file"),
    "a bomb": ("mesh", mesh_reply(glb_bomb(), "glb"), "an accessor has no count, or one beyond"),
    "a flat mesh": (
        "mesh", mesh_reply(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n" + b"f 1 2 3\nf 2 3 4\n" * 2),
        "the mesh is flat",
    ),
    "no pose": ("pose", {}, "'pose' is not 4×4 number"),
    "a short pose": ("pose", {"pose": [[1, 0, 0]]}, "'pose' is not 4×4 number"),
    "a pose in millimetres": ("pose", {"pose": (1000 * np.eye(4)).tolist()}, "no rigid pose"),
    "another joint": ("articulation", {"type": "screw"}, "expected prismatic, revolute or none"),
    "no axis": ("articulation", {"type": "prismatic", "limits": [0, 1]}, "'axis' is not 3 number"),
    "no limits": (
        "articulation", {"type": "prismatic", "axis": [1, 0, 0]}, "'limits' is not 2 number"
    ),
}  # fmt: skip


def words_for(stage: str, url: str, folder: Path, tmp_path: Path) -> list[object]:
    """The command line that makes a stage ask its server for the crate."""
    words: list[object] = [only(folder, "crate", "marker"), f"--{stage}-url", url]
    if stage == "pose":
        (tmp_path / "it.obj").write_bytes(ball_mesh())
        words += ["--mesh", f"crate={tmp_path / 'it.obj'}"]
    return words


@pytest.mark.usefixtures("fitted_once")
@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize("case", EVERYWHERE)
def test_every_stage_fails_with_one_sentence(
    etot: Run, folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, stage: str, case: str
) -> None:
    monkeypatch.setattr(services, "MAX_REPLY", 2 * 1024 * 1024)
    reply, message = EVERYWHERE[case]
    name = "mask" if stage == "masks" else stage
    with serving(reply) as (url, requests):
        words = words_for(stage, url, folder, tmp_path)
        patience = 0.5 if case == "too slow" else 20
        code, report, said = etot(*words, "--server-timeout", patience)
    assert (code, report) == (3, {})
    (line,) = said.strip().splitlines()
    assert line.startswith(f"error: {name} server http://127.0.0.1:")
    assert re.search(message, line), line
    assert "secret" not in line
    assert len(requests) <= endpoint.ATTEMPTS


@pytest.mark.usefixtures("fitted_once")
@pytest.mark.parametrize("case", WRONG)
def test_wrong_contents(etot: Run, folder: Path, tmp_path: Path, case: str) -> None:
    stage, answer, message = WRONG[case]
    with serving(saying(answer)) as (url, requests):
        code, report, said = etot(*words_for(stage, url, folder, tmp_path))
    assert (code, report, len(requests)) == (3, {}, 1)
    assert re.search(message, said), said
    assert len(said.strip().splitlines()) == 1

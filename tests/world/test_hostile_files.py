"""Files that came with somebody else's scene: they read nothing else, and unpack to nothing big."""

from __future__ import annotations

import json
import os
import struct
import time
import tracemalloc
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import trimesh

from etot_cli.errors import EtotError, SpecError, WorldError
from etot_cli.reconstruction.capture.folder import read_capture
from etot_cli.reporting.replay import plan_from_report
from etot_cli.skills.action import MAX_PLAN_TEXT, parse_plan
from etot_cli.specs.load import load_scene
from etot_cli.world.build import pieces
from etot_cli.world.build.mjcf_check import check_mjcf
from etot_cli.world.model import World, build_world

BODY = '<body><geom size=".02" mass=".1"/></body>'
QUICK_S = 5.0
SMALL_BYTES = 150_000_000


def mjcf(folder: Path, inside: str, body: str = BODY) -> Path:
    path = folder / "thing.xml"
    path.write_text(f"<mujoco>{inside}<worldbody>{body}</worldbody></mujoco>")
    return path


def scene(folder: Path, **thing: Any) -> World:
    (folder / "scene.json.yaml").write_text(json.dumps({"objects": {"thing": thing}}))
    return build_world(load_scene(folder / "scene.json.yaml"))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A scene's folder beside something that it must not read."""
    (tmp_path / "secret.stl").write_bytes(trimesh.creation.box([1, 1, 1]).export(file_type="stl"))
    (tmp_path / "secret.xml").write_text(f"<mujoco><worldbody>{BODY}</worldbody></mujoco>")
    inner = tmp_path / "scene"
    inner.mkdir()
    (inner / "fine.stl").write_bytes((tmp_path / "secret.stl").read_bytes())
    return inner


MESH = '<asset><mesh name="m" file="{}"/></asset>'


@pytest.mark.parametrize(
    ("inside", "said"),
    [
        (MESH.format("../secret.stl"), "outside"),
        (MESH.format("/etc/hostname"), "outside"),
        ('<compiler meshdir="../"/>' + MESH.format("secret.stl"), "outside"),
        ('<compiler meshdir="/etc"/>' + MESH.format("hostname"), "outside"),
        ('<include file="up.xml"/>' + MESH.format("secret.stl"), "outside"),
        ('<include file="../secret.xml"/>', "outside"),
        ('<asset><model name="a" file="fine.xml"/></asset>', "models in models"),
        ('<asset><model name="a" file="../secret.xml"/></asset>', "models in models"),
        ('<extension><plugin plugin="mujoco.pid"/></extension>', "plugins are not accepted"),
        (MESH.format("link.stl"), "outside"),
    ],
)
def test_nothing_outside_the_folder_is_read(folder: Path, inside: str, said: str) -> None:
    (folder / "up.xml").write_text('<mujoco><compiler meshdir="../"/></mujoco>')
    (folder / "fine.xml").write_text(f"<mujoco><worldbody>{BODY}</worldbody></mujoco>")
    (folder / "link.stl").symlink_to(folder.parent / "secret.stl")
    with pytest.raises(WorldError, match=said):
        check_mjcf(mjcf(folder, inside))


def test_what_lies_in_the_folder_is_read(folder: Path) -> None:
    (folder / "part.xml").write_text('<mujoco><compiler meshdir="."/></mujoco>')
    mjcf(folder, '<include file="part.xml"/>' + MESH.format("fine.stl"))
    assert "thing" in scene(folder, kind="mjcf", file="thing.xml", at=[0.4, 0.0]).entries


@pytest.mark.parametrize(
    ("inside", "body", "said"),
    [
        ("", f'<replicate count="100000000" offset="1 0 0">{BODY}</replicate>', "elements"),
        ("", '<replicate count="5000"><replicate count="5000">'
             f"{BODY}</replicate></replicate>", "elements"),
        ("", '<flexcomp name="f" type="grid" count="1000 1000 1000"/>', "soft bodies"),
        ("", '<composite type="cable" count="1000000 1 1"/>', "composites"),
        ('<asset><hfield name="h" nrow="60000" ncol="60000" size="1 1 1 1"/></asset>', BODY,
         "height field"),
        ('<asset><texture name="t" type="2d" builtin="flat" width="20000" height="20000"/></asset>',
         BODY, "texture"),
        ('<asset><texture name="t" type="2d" file="bomb.png"/></asset>', BODY, "pixels"),
        ('<asset><mesh name="m" builtin="sphere" params="900"/></asset>', BODY, "builtin"),
        ('<size memory="200G"/>', BODY, "memory"),
        ('<size nuserdata="999999999"/>', BODY, "nuserdata"),
        ("", "<body>" * 5000 + "</body>" * 5000, "deep"),
    ],
)  # fmt: skip
def test_a_few_words_do_not_multiply(folder: Path, inside: str, body: str, said: str) -> None:
    (folder / "bomb.png").write_bytes(
        b"\x89PNG\r\n\x1a\n" + b"\x00\x00\x00\x0dIHDR" + struct.pack(">II", 60_000, 60_000)
        + b"\x08\x02\x00\x00\x00" + zlib.compress(bytes(1000))
    )  # fmt: skip
    begun = time.monotonic()
    with pytest.raises(WorldError, match=said):
        check_mjcf(mjcf(folder, inside, body))
    assert time.monotonic() - begun < QUICK_S


def test_a_model_with_a_free_joint_and_a_stored_pose(folder: Path) -> None:
    """Valid MJCF; the pose has the length of the joints."""
    mjcf(
        folder, '<keyframe><key name="home" qpos="0 0 1 1 0 0 0"/></keyframe>',
        '<body name="b"><freejoint/><geom size=".02" mass=".1"/></body>',
    )  # fmt: skip
    assert "thing" in scene(folder, kind="mjcf", file="thing.xml", at=[0.4, 0.0]).entries


def glb(document: dict[str, Any]) -> bytes:
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    return (b"glTF" + struct.pack("<II", 2, 20 + len(text))
            + struct.pack("<I", len(text)) + b"JSON" + text)  # fmt: skip


def one_mesh(count: int, **primitive: Any) -> dict[str, Any]:
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, **primitive}]}],
        "accessors": [{"componentType": 5126, "count": count, "type": "VEC3"}],
    }  # fmt: skip


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("bomb.glb", glb(one_mesh(9_000_000))),
        ("many.glb", glb({**one_mesh(900_000), "nodes": [{"mesh": 0}] * 500})),
        ("range.glb", glb(one_mesh(9, indices=77))),
        ("polygon.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf" + b" 1 2 3" * 200_000),
        ("index.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + b"f 1 2 99\n" * 4),
        ("huge.stl", bytes(80) + struct.pack("<I", 900_000) + bytes(900_000 * 50)),
    ],
)
def test_a_mesh_that_unpacks_is_refused(folder: Path, name: str, content: bytes) -> None:
    (folder / name).write_bytes(content)
    tracemalloc.start()
    begun = time.monotonic()
    try:
        with pytest.raises(EtotError, match=name):
            scene(folder, kind="mesh", file=name, at=[0.4, 0.0])
        assert tracemalloc.get_traced_memory()[1] < SMALL_BYTES
    finally:
        tracemalloc.stop()
    assert time.monotonic() - begun < 2 * QUICK_S


@pytest.mark.slow
def test_decomposition_ends(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A spiky ball keeps CoACD busy far longer than anybody waits."""
    monkeypatch.setenv("ETOT_CACHE", str(folder / "cache"))
    monkeypatch.setenv("ETOT_MESH_SECONDS", "1")
    ball = trimesh.creation.icosphere(subdivisions=4, radius=0.05)
    rng = np.random.default_rng(1)
    spikes = ball.vertices * rng.uniform(0.3, 1.0, (len(ball.vertices), 1))
    begun = time.monotonic()
    with pytest.raises(WorldError, match="within 1 s"):
        pieces.convex_pieces(np.asarray(spikes), np.asarray(ball.faces, dtype=np.int64))
    assert time.monotonic() - begun < 2 * QUICK_S


def _doubled() -> bytes:
    """A ball of 20,000 faces, each of them many times over."""
    ball = trimesh.creation.icosphere(subdivisions=2, radius=0.05)
    faces = np.tile(ball.faces, (20_000 // len(ball.faces) + 1, 1))
    return bytes(trimesh.Trimesh(ball.vertices, faces, process=False).export(file_type="stl"))


def _round() -> bytes:
    """A disc on a point, its rim one polygon of 50,000 corners."""
    turns = np.linspace(0.0, 2 * np.pi, 50_000, endpoint=False)
    lines = [f"v {0.05 * np.cos(turn):.6f} {0.05 * np.sin(turn):.6f} 0" for turn in turns]
    rim = " ".join(str(number) for number in range(1, len(turns) + 1))
    return "\n".join([*lines, "v 0 0 0.05", f"f {rim}", "f 1 20000 50001"]).encode()


@pytest.mark.parametrize(("name", "content"), [("doubled.stl", _doubled), ("round.obj", _round)])
@pytest.mark.slow
def test_meshes_that_keep_decomposition_busy(
    folder: Path, monkeypatch: pytest.MonkeyPatch, name: str, content: Callable[[], bytes]
) -> None:
    """Whether they can be used or not: that is known within the bound."""
    monkeypatch.setenv("ETOT_CACHE", str(folder / "cache"))
    monkeypatch.setenv("ETOT_MESH_SECONDS", "2")
    (folder / name).write_bytes(content())
    begun = time.monotonic()
    try:
        scene(folder, kind="mesh", file=name, at=[0.4, 0.0])
    except EtotError as error:
        assert name in str(error)
    assert time.monotonic() - begun < 2 * QUICK_S


@pytest.mark.parametrize("damage", ["noise", "cut", "empty", "objects", "flat"])
def test_a_damaged_cache_is_made_again(
    folder: Path, monkeypatch: pytest.MonkeyPatch, damage: str
) -> None:
    monkeypatch.setenv("ETOT_CACHE", str(folder / "cache"))
    box = trimesh.creation.box([0.1, 0.1, 0.1])
    given = np.asarray(box.vertices), np.asarray(box.faces, dtype=np.int64)
    whole = pieces.convex_pieces(*given)
    (entry,) = (folder / "cache").iterdir()
    data = entry.read_bytes()
    if damage == "noise":
        entry.write_bytes(data[:60] + os.urandom(200) + data[260:])
    elif damage == "cut":
        entry.write_bytes(data[: len(data) // 2])
    elif damage == "empty":
        with zipfile.ZipFile(entry, "w"):
            pass
    elif damage == "objects":
        with entry.open("wb") as stream:
            np.savez(stream, np.array([{}], dtype=object))
    else:
        with entry.open("wb") as stream:
            np.savez(stream, np.zeros(7))
    again = pieces.convex_pieces(*given)
    assert all(np.array_equal(one, two) for one, two in zip(whole, again, strict=True))
    assert entry.read_bytes() == data


ROBOT = "name: r\nmodel: {}\n"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (ROBOT.format("../secret.xml"), "robot's own folder"),
        (ROBOT.format("/etc/hostname"), "robot's own folder"),
        ("name: " + "[" * 50_000, "nested deeper|YAML"),
    ],
)
def test_a_robot_stays_in_its_folder(folder: Path, text: str, said: str) -> None:
    from etot_cli.world.robot import BUILTIN_ROBOTS

    whole = (BUILTIN_ROBOTS / "xarm6" / "robot.yaml").read_text()
    if "model:" in text:
        whole = "\n".join(
            text.splitlines()[1] if line.startswith("model:") else line
            for line in whole.splitlines()
        )
        text = whole
    (folder / "robot.yaml").write_text(text)
    (folder / "scene.yaml").write_text("robot: robot.yaml\n")
    with pytest.raises(SpecError, match=said):
        build_world(load_scene(folder / "scene.yaml"))


@pytest.mark.parametrize("what", ["camera.json", "report"])
def test_a_pipe_is_no_file(folder: Path, what: str) -> None:
    os.mkfifo(folder / "camera.json")
    with pytest.raises(EtotError, match="no regular file"):
        if what == "report":
            plan_from_report(folder / "camera.json")
        else:
            read_capture(folder)


@pytest.mark.parametrize("number", ["1" + "0" * 400, "1" + "0" * 5000, "1e400"])
def test_numbers_beyond_all_bounds(folder: Path, number: str) -> None:
    (folder / "camera.json").write_text(f'{{"fx": {number}}}')
    for name in ("color.png", "depth.png"):
        shape = (8, 8, 3) if name == "color.png" else (8, 8)
        kind = np.uint8 if name == "color.png" else np.uint16
        cv2.imwrite(str(folder / name), np.zeros(shape, kind))
    with pytest.raises(EtotError):
        read_capture(folder)


@pytest.mark.parametrize(
    "text",
    [
        "[PUT ON, desk] (" + " " * 15_000 + "x",
        "[PUT ON" + " " * 15_000,
        "[PUT ON, desk] (" + "a " * 7_000 + ")",
        "9" * 15_000,
    ],
)
def test_reading_a_plan_takes_no_time(text: str) -> None:
    begun = time.monotonic()
    with pytest.raises(EtotError):
        parse_plan(text)
    assert time.monotonic() - begun < 0.5
    with pytest.raises(EtotError, match="characters"):
        parse_plan("x" * (MAX_PLAN_TEXT + 1))


def test_a_report_holds_no_longer_plan_than_a_text(folder: Path) -> None:
    path = folder / "report.json"
    plan = ["[PICK UP, cup]", "[PUT ON, desk]"] * 40
    path.write_text(json.dumps({"schema": "etot.plan/1", "status": "feasible", "plan": plan}))
    with pytest.raises(EtotError, match="at most 64"):
        plan_from_report(path)

"""Stage servers over real sockets, their failures included."""

from __future__ import annotations

import base64
import socket
import time
from http.server import BaseHTTPRequestHandler
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from etot_cli.errors import ServiceError
from etot_cli.reconstruction import services
from etot_cli.reconstruction.capture.pictures import encode_png
from etot_cli.services import endpoint
from tests.reconstruction.stage_server import Reply, saying, sending, serving

COLOR = np.full((48, 64, 3), 120, np.uint8)


def a_mask(shape: tuple[int, int] = (48, 64)) -> str:
    mask = np.zeros(shape, np.uint8)
    mask[10:30, 10:40] = 255
    return base64.b64encode(encode_png(mask)).decode()


@pytest.fixture(autouse=True)
def hurry(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(endpoint, "FIRST_PAUSE", 0.01)


def test_masks_by_name() -> None:
    with serving(saying({"masks": [{"name": "red ball", "png": a_mask()}]})) as (url, requests):
        masks = services.ask_masks(url, COLOR, ["red ball"])
    assert masks["red_ball"].sum() == 600
    assert requests[0]["prompts"] == ["red ball"]


@pytest.mark.parametrize("status", [429, 500, 503])
def test_passing_failures_are_tried_again(status: int) -> None:
    good = saying({"masks": [{"name": "x", "png": a_mask()}]})
    with serving(saying({}, status), good) as (url, requests):
        assert services.ask_masks(url, COLOR, [])
    assert len(requests) == 2


BAD: dict[str, tuple[Reply, str]] = {
    "always busy": (saying({}, 503), r"answers 503 \(after 4 attempts\)"),
    "forbidden": (sending(b"who are you?", 403, "text/plain"), "answers 403: who are you?"),
    "redirect": (saying({}, 302), "answers 302"),
    "web page": (sending(b"<html>", kind="text/html"), "text/html; expected application/json"),
    "no json": (sending(b"{"), "no valid JSON"),
    "list": (saying([]), "no JSON object"),
    "error": (saying({"error": "out of memory"}), "says: out of memory"),
    "no masks": (saying({"masks": None}), "no list 'masks'"),
    "nothing": (saying({"masks": []}), "found no object"),
    "no png": (saying({"masks": [{"name": "x"}]}), r"masks\[0\] has no 'png'"),
    "no base64": (saying({"masks": [{"png": "???"}]}), "no base64"),
    "no picture": (saying({"masks": [{"png": "aGVsbG8="}]}), "no PNG"),
    "other size": (saying({"masks": [{"png": a_mask((40, 40))}]}), "is 40 × 40; expected 64 × 48"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_answers_are_one_clear_error(case: str) -> None:
    reply, message = BAD[case]
    with serving(reply) as (url, _), pytest.raises(ServiceError, match=message) as caught:
        services.ask_masks(url, COLOR, [])
    assert "secret" not in str(caught.value)
    assert caught.value.exit_code == 3


def test_nobody_there() -> None:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with pytest.raises(ServiceError, match="cannot be reached"):
        services.ask_masks(f"http://127.0.0.1:{port}/", COLOR, [])


@pytest.mark.parametrize("url", ["ftp://host/x", "nonsense", "http://"])
def test_no_address(url: str) -> None:
    with pytest.raises(ServiceError, match="server"):
        services.ask_masks(url, COLOR, [], deadline=2.0)


@pytest.mark.parametrize("drop", [b"X-More: and more\r\n", b" "])
def test_a_drip_of_bytes_ends_at_the_deadline(drop: bytes) -> None:
    def drip(handler: BaseHTTPRequestHandler, _: dict[str, Any]) -> None:
        handler.send_response(200)
        handler.send_header("content-type", "application/json")
        if drop == b" ":
            handler.end_headers()
        handler.flush_headers()
        for _i in range(60):
            handler.wfile.write(drop)
            handler.wfile.flush()
            time.sleep(0.1)

    start = time.monotonic()
    with serving(drip) as (url, _), pytest.raises(ServiceError, match=r"within 0\.6 s"):
        services.ask_masks(url, COLOR, [], deadline=0.6)
    assert time.monotonic() - start < 3


def test_too_large_an_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(services, "MAX_REPLY", 1000)
    with serving(sending(b" " * 5000)) as (url, _), pytest.raises(ServiceError, match="larger"):
        services.ask_masks(url, COLOR, [])


def test_a_joint_is_checked() -> None:
    good = {"type": "revolute", "axis": [0, 0, 2], "origin": [0, 0, 1], "limits": [0, 1.5],
            "value": 0.2}  # fmt: skip
    with serving(saying(good)) as (url, _):
        joint = services.ask_articulation(url, {})
    assert joint is not None
    assert joint.axis.tolist() == [0, 0, 1]
    for wrong, message in (
        ({**good, "axis": [0, 0, 0]}, "no length"),
        ({**good, "limits": [0, 9]}, "limits"),
        ({**good, "type": "screw"}, "screw"),
        ({**good, "axis": [0, "x", 1]}, "'axis' is not 3"),
    ):
        with serving(saying(wrong)) as (url, _), pytest.raises(ServiceError, match=message):
            services.ask_articulation(url, {})


def test_a_pose_is_checked() -> None:
    with serving(saying({"pose": np.eye(4).tolist()})) as (url, _):
        assert np.array_equal(services.ask_pose(url, {}), np.eye(4))
    skew = (2 * np.eye(4)).tolist()
    with serving(saying({"pose": skew})) as (url, _), pytest.raises(ServiceError, match="rigid"):
        services.ask_pose(url, {})


@pytest.mark.slow
def test_stages_are_taken_over(picture, folder: Path) -> None:
    """Masks and a mesh of unknown scale from servers, all the way through."""
    import trimesh

    from etot_cli.reconstruction.options import Options
    from etot_cli.reconstruction.pipeline import reconstruct

    mask = picture.masks["ball"]
    entry = {"name": "ball", "png": services.mask_picture(mask)}
    mesh = trimesh.creation.icosphere(subdivisions=3, radius=17.0)
    data = mesh.export(file_type="obj").encode()
    answer = {"mesh": base64.b64encode(data).decode(), "format": "obj"}
    with (
        serving(saying({"masks": [entry]})) as (masks_url, _),
        serving(saying(answer)) as (mesh_url, requests),
    ):
        twin = reconstruct(
            Options(capture=folder, masks_url=masks_url, mesh_url=mesh_url, settle=False)
        )
    assert [solid.kind for solid in twin.solids] == ["mesh"]
    assert requests[0]["name"] == "ball"
    true = picture.truth["objects"]["ball"]
    assert np.allclose(twin.solids[0].size, true["size"], rtol=0.03)
    assert np.linalg.norm(twin.solids[0].center - true["position"]) < 0.003


@pytest.mark.slow
def test_a_mesh_server_that_sends_no_mesh(folder: Path) -> None:
    from etot_cli.reconstruction.options import Options
    from etot_cli.reconstruction.pipeline import reconstruct

    answer = {"mesh": "aGVsbG8=", "format": "glb"}
    with serving(saying(answer)) as (url, _), pytest.raises(ServiceError, match="mesh server"):
        reconstruct(Options(capture=folder, mesh_url=url, settle=False))

"""Whole tasks in the real simulator, reasoned by a scripted model behind a real socket."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from etot_cli.cli.app import run
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.reasoning.vlm.fake_server import FakeServer
from etot_cli.reasoning.vlm.player import Player, Received
from etot_cli.specs.load import load_task
from etot_cli.world.render import WorldRenderer
from tests.vlm.scripts import TASKS, Rules, rule, with_common

ROOT = Path(__file__).parents[2]
TASK_FILES = {number: ROOT / "tasks" / f"task{number}.yaml" for number in TASKS}
SIDE = 768


pytestmark = [pytest.mark.render, pytest.mark.slow]

PLANS = {
    1: "[PICK UP, tennis_ball] [PUT ON, desk] [OPEN, microwave]",
    2: "[PICK UP, pen] [PUT INTO, white_holder]",
    4: "[PICK UP, toy] [PUT ON, desk] [CLOSE, drawer]",
    5: "[PICK UP, apple] [PUT ON, desk] [PICK UP, pen] [PUT INTO, white_holder]",
    6: "[PICK UP, holder] [PUT ON, drawer] [PICK UP, apple] [PUT INTO, holder]",
    7: "[PICK UP, apple] [PUT INTO, holder] [PICK UP, tennis_ball] [PUT ON, drawer] [OPEN, drawer] "
    "[PICK UP, tennis_ball] [PUT INTO, drawer] [CLOSE, drawer]",
}
NOTES = {
    1: {"questioned", "diagnosis"},
    2: {"no_revision"},
    4: {"repair", "diagnosis"},
    5: {"no_revision", "repair"},
    6: {"repair"},
    7: {"repair", "diagnosis"},
}


def plan(
    number: int, *arguments: str, rules: Rules | None = None
) -> tuple[int, Any, list[Received]]:
    """Exit code, report and requests of a run."""
    with FakeServer(Player(with_common(TASKS[number] if rules is None else rules))) as server:
        code = run(
            [
                "plan",
                str(TASK_FILES[number]),
                "--reasoner",
                "vlm",
                "--vlm-url",
                server.url,
                "--out",
                "out",
                "--force",
                "--jobs",
                "1",
                "-q",
                *arguments,
            ]
        )
    return code, json.loads(Path("out/report.json").read_text(encoding="utf-8")), server.requests


@pytest.fixture
def small_frames(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures that nobody looks at; drawing costs time."""
    monkeypatch.setenv("ETOT_VLM_IMAGE_WIDTH", "160")


def decode(image: bytes) -> NDArray[np.uint8]:
    pixels = cv2.imdecode(np.frombuffer(image, np.uint8), cv2.IMREAD_COLOR)
    assert pixels is not None
    return np.asarray(pixels[..., ::-1], dtype=np.uint8)


@pytest.mark.parametrize("number", sorted(TASKS))
def test_the_right_plan_in_spite_of_wrong_answers(
    number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One sees frames of the usual size, the others of half of it, which takes less drawing."""
    side = SIDE if number == min(TASKS) else SIDE // 2
    if side != SIDE:
        monkeypatch.setenv("ETOT_VLM_IMAGE_WIDTH", str(side))
    code, report, requests = plan(number)
    assert code == 0 and " ".join(report["plan"]) == PLANS[number]
    notes = {note["kind"] for note in report["vlm"]["notes"]}
    assert notes >= NOTES[number]
    roles = [request.role for request in requests]
    assert roles[:3] == ["probe", "scene", "branches"] and "reflect" in roles
    assert report["vlm"]["total"]["requests"] == len(requests)
    for request in requests:
        if request.role in ("scene", "branches", "reflect"):
            assert 1 <= len(request.images) <= 4
        for image in request.images:
            height, width = decode(image).shape[:2]
            assert max(width, height) == side if request.role != "probe" else width == height
    _check_first_frame(number, decode(requests[1].images[0]))


def _check_first_frame(number: int, sent: NDArray[np.uint8]) -> None:
    """The frame is the scene: every object is seen where it is, in its own colours."""
    scene = load_task(TASK_FILES[number]).scene
    simulated = SimulatedWorld(scene)
    simulated.start()
    height, width = sent.shape[:2]
    with WorldRenderer(simulated.world, width, height) as renderer:
        expected = renderer.frame(simulated.data.qpos)
        masks = renderer.visible_pixels(simulated.data.qpos)
    assert (renderer.width, renderer.height) == (width, height)
    assert set(masks) == set(scene.objects)
    empty = np.median(sent.reshape(-1, 3), axis=0)
    for name, mask in masks.items():
        inner = cv2.erode(mask.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
        assert inner.sum() >= 40, f"{name} is hardly visible"
        seen, known = sent[inner].mean(axis=0), expected[inner].mean(axis=0)
        assert np.abs(seen - known).max() < 12, name
        assert np.abs(sent[inner] - empty).max() > 15, f"{name} does not stand out"


def test_frames_of_a_failure_show_what_happens() -> None:
    """The ball is in the first frame, moves, and is gone or elsewhere in the last."""
    _, _, requests = plan(1)
    frames = [decode(image) for image in next(r for r in requests if r.role == "reflect").images]
    assert len(frames) == 4
    centers = []
    for frame in frames:
        hue, saturation, value = np.moveaxis(cv2.cvtColor(frame, cv2.COLOR_RGB2HSV), -1, 0)
        lime = (hue > 28) & (hue < 42) & (saturation > 120) & (value > 70)
        rows, columns = np.nonzero(lime)
        centers.append((rows.mean(), columns.mean(), len(rows)) if len(rows) > 20 else None)
    first, last = centers[0], centers[-1]
    assert first is not None
    assert last is None or np.hypot(last[0] - first[0], last[1] - first[1]) > 60
    text = next(r for r in requests if r.role == "reflect").text
    assert "touches tennis_ball" in text and "Before the action" in text


@pytest.mark.usefixtures("small_frames")
def test_a_recorded_run_is_replayed_to_the_same_tree() -> None:
    first = plan(4, "--record", "tape")
    again = plan(4, "--replay", "tape", rules=[])
    assert first[0] == again[0] == 0 and not again[2]
    trees = []
    for _, report, _ in (first, again):
        for node in report["tree"]["nodes"]:
            del node["wall_s"]
        trees.append((report["tree"], report["vlm"]["notes"]))
    assert trees[0] == trees[1]
    pictures = list(Path("tape/pictures").glob("*.jpg"))
    assert len(pictures) >= 4


def test_marks_and_words_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ETOT_VLM_CACHE", "off")
    monkeypatch.setenv("ETOT_VLM_MARKS", "true")
    _, _, marked = plan(2, "--max-calls", "2")
    assert "Marks in the picture: 1 = " in marked[1].text
    monkeypatch.setenv("ETOT_VLM_MARKS", "false")
    _, _, plain = plan(2, "--max-calls", "2")
    difference = np.abs(
        decode(marked[1].images[0]).astype(int) - decode(plain[1].images[0]).astype(int)
    )
    assert 200 < (difference.max(axis=2) > 60).sum() < 10_000
    monkeypatch.setenv("ETOT_VLM_IMAGES", "0")
    code, report, requests = plan(2)
    assert code == 0 and " ".join(report["plan"]) == PLANS[2]
    assert not any(request.images for request in requests)


def test_no_opengl_is_a_clear_message(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("MUJOCO_GL", "off")
    code = run(["plan", str(TASK_FILES[2]), "--reasoner", "vlm", "--vlm-url", "http://127.0.0.1:9"])
    assert code == 3
    message = capsys.readouterr().err
    assert "OpenGL is missing" in message and "libegl1" in message and message.count("\n") == 1


@pytest.mark.usefixtures("small_frames")
def test_several_worlds_and_jobs_change_no_answer() -> None:
    code, report, _ = plan(2, "--worlds", "2", "--jobs", "2", rules=TASKS[2])
    assert code == 0 and " ".join(report["plan"]) == PLANS[2]
    # Only the nominal world is looked at; the others are judged by their state.
    compared = [note for note in report["vlm"]["notes"] if note["role"] == "compare"]
    assert len(compared) <= report["statistics"]["nodes_evaluated"]


@pytest.mark.usefixtures("small_frames")
def test_a_wrong_pick_is_named_in_the_repair() -> None:
    rules = [
        rule("branches", "1. [PICK UP, stapler]\n2. [PUT INTO, white holder]", turn=0),
        rule("branches", "1. [PICK UP, pen]\n2. [PUT INTO, white holder]", turn=1),
    ]
    code, report, _ = plan(2, rules=rules)
    assert code == 0
    (note,) = [note for note in report["vlm"]["notes"] if note["kind"] == "repair"]
    assert "the scene has no 'stapler'" in note["text"]

"""A video-generation server over a real socket, with a small generated mp4."""

from __future__ import annotations

import base64

import cv2
import numpy as np
import pytest

from etot_cli.benchmark.methods import video_endpoint
from etot_cli.benchmark.methods.video_endpoint import VideoEndpoint, frames_of
from etot_cli.benchmark.methods.video_thinking import VideoFrames, VideoWorldModel
from etot_cli.errors import EtotError, ServiceError
from etot_cli.planning.result import LimitKind
from etot_cli.planning.search import search
from etot_cli.reasoning.protocol import Assignment
from etot_cli.reasoning.vlm.chat import Picture
from etot_cli.reasoning.vlm.frames import Eye
from etot_cli.services import endpoint as services_endpoint
from etot_cli.skills.action import format_plan
from etot_cli.world.snapshot import Memory, Snapshot
from etot_cli.world.state import RolloutRecord, SceneState
from tests.benchmark.video_server import FRAMES, Server, film
from tests.planning.fakes import ToyReasoner, scene

IMAGE = np.full((48, 64, 3), 90, dtype=np.uint8)


def endpoint(server: Server, key: str | None = None) -> VideoEndpoint:
    return VideoEndpoint(server.url, key, deadline_s=10.0)


@pytest.fixture(autouse=True)
def hurry(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(services_endpoint, "FIRST_PAUSE", 0.01)


def test_a_picture_and_a_sentence_become_a_video(server: Server) -> None:
    video = endpoint(server, "vk-1234567890").generate(IMAGE, "The arm opens the box.", 7)
    (request,) = server.requests
    assert request["prompt"] == "The arm opens the box." and request["seed"] == 7
    sent = cv2.imdecode(np.frombuffer(base64.b64decode(request["image"]), np.uint8), 1)
    assert sent.shape == IMAGE.shape and (sent == IMAGE).all()
    assert server.headers[0]["Authorization"] == "Bearer vk-1234567890"
    means = [float(frame.mean()) for frame in frames_of(video, 4)]
    assert means == sorted(means) and means[0] < 40 and means[-1] > 180, "first to last"


@pytest.mark.parametrize("count", [1, 2, 3, 5, 12, 40])
def test_frames_are_spread_from_the_first_to_the_last(count: int) -> None:
    found = frames_of(film(), count)
    assert len(found) == min(count, FRAMES)
    means = [float(frame.mean()) for frame in found]
    assert means == sorted(means) and means[0] < 40
    if count > 1:
        assert means[-1] > 190


def test_a_server_in_trouble_is_asked_again(server: Server) -> None:
    server.replies = [(503, "text/plain", b"busy"), (429, "text/plain", b""), *server.replies]
    assert endpoint(server).generate(IMAGE, "x", 0)
    assert len(server.requests) == 3


@pytest.mark.parametrize(
    ("reply", "told", "requests"),
    [
        ((500, "text/plain", b""), "answers 500 .after 4 attempts", 4),
        (
            (401, "text/plain", b"who are you, vk-1234567890?"),
            r"answers 401: who are you, \[redacted\]",
            1,
        ),
        ((302, "text/plain", b""), "answers 302", 1),
        ((200, "text/html", b"<p>"), "answers text/html; expected video/mp4", 1),
        ((200, "video/mp4", b"0" * 70_000), "larger than 0.0572", 1),
    ],
)
def test_what_is_no_video_is_told_without_secrets(
    server: Server, monkeypatch: pytest.MonkeyPatch, reply: tuple[int, str, bytes], told: str,
    requests: int,
) -> None:  # fmt: skip
    monkeypatch.setattr(video_endpoint, "MAX_BYTES", 60_000)
    server.replies = [reply]
    with pytest.raises(ServiceError, match=told) as error:
        endpoint(server, "vk-1234567890").generate(IMAGE, "x", 0)
    assert "vk-1234567890" not in str(error.value)
    assert len(server.requests) == requests


def test_bounds_of_what_is_decoded(monkeypatch: pytest.MonkeyPatch) -> None:
    for junk in (b"", b"junk" * 100, film()[:300]):
        with pytest.raises(ValueError, match=r"cannot be decoded|no frame|no picture"):
            frames_of(junk, 3)
    monkeypatch.setattr(video_endpoint, "MAX_FRAMES", FRAMES - 1)
    with pytest.raises(ValueError, match="more than 11 frames"):
        frames_of(film(), 3)
    monkeypatch.setattr(video_endpoint, "MAX_PICTURE_SIDE", 63)
    with pytest.raises(ValueError, match="64 × 48"):
        frames_of(film(), 3)
    with pytest.raises(EtotError, match="expected http"):
        VideoEndpoint("ftp://somewhere")


class Desk:
    """Pictures of a desk that always looks the same."""

    def view(self, now: SceneState, *, marks: bool = False) -> list[Picture]:
        return [Picture.of_pixels("The desk now:", IMAGE)]

    def rollout(
        self, record: RolloutRecord, count: int, *, marks: bool = False, hints: bool = True
    ) -> list[Picture]:
        raise AssertionError("only videos tell how an action goes")

    def marks(self, now: SceneState) -> dict[int, str]:
        return {}

    def eye(self, now: SceneState) -> Eye | None:
        return None


def world_model(server: Server) -> tuple[VideoWorldModel, VideoFrames]:
    frames = VideoFrames(Desk())
    model = VideoWorldModel(endpoint(server), frames, seed=3)
    model.begin_from(Snapshot(b"", Memory()), scene())
    return model, frames


def test_a_search_over_videos(server: Server) -> None:
    """Every action considered is one video, and its frames are what a judge gets to see."""
    model, frames = world_model(server)
    result = search(Assignment("Pick up the cup."), model, ToyReasoner(["cup"]))
    assert format_plan(result.plan) == "[PICK UP, cup]"
    (request,) = server.requests
    assert request["prompt"] == "The robot arm picks up the cup." and request["seed"] == 3
    record = result.rollouts[1].record
    shown = frames.rollout(record, 3)
    assert [picture.caption for picture in shown] == [
        "Before the action:", "During the action:", "After the action:"
    ]  # fmt: skip
    assert shown[0].pixels.mean() < shown[1].pixels.mean() < shown[2].pixels.mean()
    assert frames.rollout(RolloutRecord(record.before, record.after, True, None), 3) == []


def test_a_server_that_is_gone_ends_the_search_with_its_reason(server: Server) -> None:
    server.replies = [(200, "video/mp4", b"no film")]
    model, _ = world_model(server)
    result = search(Assignment("Pick up the cup."), model, ToyReasoner(["cup"]))
    assert result.limit is LimitKind.SERVICE and "its video is of no use" in result.stopped

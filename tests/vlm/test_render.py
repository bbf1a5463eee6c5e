"""Pictures and videos of a run, and which moments a model gets to see."""

from __future__ import annotations

from pathlib import Path

import av
import cv2
import numpy as np
import pytest

from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.errors import ServiceError
from etot_cli.reasoning.vlm.frames import draw_marks, moments
from etot_cli.specs.scene import Scene
from etot_cli.world.film import Take, key_moments, write_frames, write_video
from etot_cli.world.recorder import Trajectory
from etot_cli.world.render import WorldRenderer, fit_size
from etot_cli.world.state import Cause, CauseKind, ContactEvent, RolloutRecord
from tests.vlm.scenes import kitchen

SCENE = Scene.model_validate(
    {
        "cameras": {"front": {"position": [1.2, 0.0, 0.8], "look_at": [0.4, 0.0, 0.15],
                              "width": 640, "height": 360, "fx": 304, "fy": 304, "cx": 320,
                              "cy": 180}},
        "objects": {
            "block": {"kind": "box", "at": [0.4, 0.2], "size": [0.06, 0.06, 0.06], "color": "red"},
            "marble": {"kind": "sphere", "at": [0.4, -0.2], "diameter": 0.06, "color": "blue"},
        },
    }
)  # fmt: skip


@pytest.fixture(scope="module")
def trajectory() -> Trajectory:
    """The block moves up by 10 cm in two seconds."""
    simulated = SimulatedWorld(SCENE)
    simulated.start()
    rows = np.repeat(simulated.data.qpos[None].astype(np.float32), 51, axis=0)
    address = int(simulated.world.model.joint("block").qposadr[0])
    rows[:, address + 2] += np.linspace(0.0, 0.1, 51)
    times = np.linspace(3.0, 5.0, 51).astype(np.float32)
    return Trajectory(times, rows, (0.8, 0.8, 1.9999))


@pytest.mark.slow
@pytest.mark.render
def test_frames_have_readable_names(trajectory: Trajectory, tmp_path: Path) -> None:
    moment = Trajectory(trajectory.times[:1], trajectory.qpos[:1])
    files = write_frames(SCENE, [Take(trajectory), Take(moment)], tmp_path / "frames")
    assert [path.name for path in files] == [
        "01-0-start-00.00s.png", "01-1-key-00.80s.png", "01-2-end-02.00s.png",
        "02-0-start-00.00s.png",
    ]  # fmt: skip
    first, last = (cv2.imread(str(files[i])) for i in (0, 2))
    assert first is not None and last is not None and first.shape == (720, 1280, 3)
    red = [
        np.nonzero((image[..., 2] > 90) & (image[..., 1] < 60))[0].mean() for image in (first, last)
    ]
    assert red[1] < red[0] - 20  # the block has gone up in the picture


@pytest.mark.render
@pytest.mark.slow
def test_videos_play_everywhere(trajectory: Trajectory, tmp_path: Path) -> None:
    write_video(
        SCENE, [Take(trajectory)] * 2, tmp_path / "deep" / "run.mp4", size=(320, 180), rate=5
    )
    with av.open(str(tmp_path / "deep" / "run.mp4")) as container:
        stream = container.streams.video[0]
        assert stream.codec_context.name == "h264" and stream.codec_context.pix_fmt == "yuv420p"
        frames = sum(1 for _ in container.decode(stream))
        assert float(stream.average_rate or 0) == 5.0
    assert 20 <= frames <= 24
    (tmp_path / "file").write_text("")
    with pytest.raises(ServiceError, match="cannot write"):
        write_video(SCENE, [Take(trajectory)], tmp_path / "file" / "run.mp4")


@pytest.mark.slow
@pytest.mark.render
def test_every_object_is_seen_with_and_without_a_camera(trajectory: Trajectory) -> None:
    bare = SCENE.model_copy(update={"cameras": {}})
    for scene in (SCENE, bare):
        simulated = SimulatedWorld(scene)
        with WorldRenderer(simulated.world, 320, 180) as renderer:
            image = renderer.frame(trajectory.qpos[0])
            assert image.shape == (180, 320, 3) and image.std() > 15
            masks = renderer.visible_pixels(trajectory.qpos[0])
            # From the front, towards the robot, its left is on the right of the picture.
            columns = {name: np.nonzero(mask)[1].mean() for name, mask in masks.items()}
        assert set(masks) == {"block", "marble"} and columns["block"] > columns["marble"]


def test_pictures_keep_the_proportions_of_their_camera() -> None:
    assert fit_size(SCENE, "front", 768, 768) == (768, 432)
    assert fit_size(SCENE, "front", 1000, 90) == (160, 90)
    assert fit_size(SCENE, None, 301, 201) == (300, 200)


def test_key_moments_are_in_order_and_different(trajectory: Trajectory) -> None:
    assert [word for word, _, _ in key_moments(trajectory)] == ["start", "key", "end"]
    one = Trajectory(trajectory.times[:1], trajectory.qpos[:1])
    assert key_moments(one) == [("start", 0.0, 0)]


def test_the_moments_that_tell_most_come_first() -> None:
    scene = kitchen()
    cause = Cause(CauseKind.BLOCKED, ("ball",), "ball blocks chest", 3.0)
    contacts = (
        ContactEvent(0.5, "gripper", "spoon", 9.0, 9.0),
        ContactEvent(1.0, "chest.top", "ball", 5.0, 2.0),
        ContactEvent(2.0, "desk", "ball", 1.0, 0.1),
    )
    record = RolloutRecord(scene, scene, effect=False, cause=cause, contacts=contacts)
    assert moments(record, [4.0], 5.0, 2) == [(1.2, "chest.top touches ball"), (3.0, "blocked")]
    assert [time for time, _ in moments(record, [4.0], 5.0, 9)] == [1.2, 2.2, 3.0, 4.0]
    assert moments(record, [], 5.0, 0) == []
    assert all(0 < time < 3.1 for time, _ in moments(record, [4.0], 3.1, 9))


def test_marks_lie_on_their_objects() -> None:
    pixels = np.zeros((200, 300, 3), np.uint8)
    mask = np.zeros((200, 300), bool)
    mask[50:150, 100:110] = mask[140:150, 100:200] = True  # bent, its middle is empty
    marked = draw_marks(pixels, {"a": mask, "b": mask, "tiny": mask & False}, {"a": 3, "tiny": 1})
    rows, columns = np.nonzero(marked.max(axis=2))
    assert len(rows) and mask[round(float(rows.mean())), round(float(columns.mean()))]
    assert not pixels.any()

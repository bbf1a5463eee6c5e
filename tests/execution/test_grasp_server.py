"""Grasps from a server over a local socket: checked in the twin, or left for the built-in ones."""

from __future__ import annotations

import base64
import re
from functools import cache

import cv2
import numpy as np
import pytest

from etot_cli.control.robot import RobotState
from etot_cli.execution.believed import BelievedTwin
from etot_cli.execution.grasp_server import GraspServer
from etot_cli.execution.observation import Observation, Sighting
from etot_cli.execution.protocols import Frame
from etot_cli.services import endpoint
from etot_cli.skills.action import parse_plan
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.motion import Motion
from etot_cli.skills.motions import plan_motions
from tests.reconstruction.stage_server import saying, sending, serving
from tests.skills.helpers import BALL
from tests.world.helpers import make_scene

(PICK,) = parse_plan("[PICK UP, ball]")
TO_BASE = np.array([[0, 0.6, -0.8, 1.05], [1, 0, 0, 0], [0, -0.8, -0.6, 0.8], [0, 0, 0, 1.0]])


@cache
def belief() -> Belief:
    twin = BelievedTwin(make_scene(ball=BALL), 0)
    home = np.array(twin.world.robot.spec.home)
    seen = {"ball": Sighting((*BALL["at"], 0.165), (1, 0, 0, 0))}
    _, scene = twin.see(Observation(RobotState(home, home, 0.085, 0.0), seen), None)
    return twin.belief(scene, "test")


@cache
def builtin() -> list[Motion]:
    """A few motions of the sampler's own: grasps that are known to be free."""
    found = plan_motions(belief(), PICK)
    return [motion for motion, _ in zip(found, range(4), strict=False)]


class Shown:
    def picture_of(self, name):
        rng = np.random.default_rng(0)
        mask = np.zeros((12, 16), dtype=bool)
        mask[3:9, 4:12] = True
        frame = Frame(
            rng.integers(0, 255, (12, 16, 3), dtype=np.uint8), np.full((12, 16), 0.9),
            np.array([[20.0, 0, 8], [0, 20, 6], [0, 0, 1]]), TO_BASE, 1.0,
        )  # fmt: skip
        return frame, mask


def tool_of(motion: Motion) -> np.ndarray:
    """Where the hand closes, base frame (4, 4)."""
    pose = belief().object_pose("ball") @ motion.tool_at.pose
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = pose.rotation, pose.position
    return matrix


def said(tool: np.ndarray, score: float, width: float = 0.07) -> dict:
    return {"pose": (np.linalg.inv(TO_BASE) @ tool).tolist(), "score": score, "width": width}


def test_the_best_grasp_that_is_free_in_the_twin_is_taken():
    good, other = tool_of(builtin()[3]), tool_of(builtin()[0])
    buried = good.copy()
    buried[2, 3] -= 0.10  # the hand in the desk
    far = good.copy()
    far[0, 3] += 3.0
    reply = {"grasps": [said(other, 0.5), said(good, 0.8), said(buried, 0.9), said(far, 0.95),
                        said(good, 0.99, width=0.2)]}  # fmt: skip
    with serving(saying(reply)) as (url, requests):
        motion = GraspServer(url, Shown()).motion(belief(), PICK)
    assert tool_of(motion) == pytest.approx(good, abs=2e-3)
    asked = requests[0]
    assert asked["object"] == "ball" and asked["max_width"] == 0.085
    mask = cv2.imdecode(np.frombuffer(base64.b64decode(asked["mask"]), np.uint8), 0)
    assert mask.shape == (12, 16) and (mask > 0).sum() == 48


@pytest.mark.parametrize(
    ("reply", "words"),
    [
        (saying({"grasps": []}), "none of the 0 grasps"),
        (saying({"grasps": "many"}), "no list 'grasps'"),
        (saying({"grasps": [{"score": 1, "width": 0.05, "pose": [[1, 2], [3, 4]]}]}), "4×4"),
        (saying({"grasps": [{"score": 1, "width": 0.05, "pose": np.diag([2, 2, 2, 1]).tolist()}]}),
         "no rigid pose"),
        (saying({"grasps": [{"score": "high", "width": 0.05, "pose": np.eye(4).tolist()}]}),
         r"grasps\[0\].score is high"),
        (saying({"grasps": [{"score": 1, "width": -1, "pose": np.eye(4).tolist()}]}),
         "width is -1"),
        (saying({"error": "out of memory"}), "out of memory"),
        (sending(b"<html>", kind="text/html"), "expected application/json"),
        (saying({}, 404), "answers 404"),
    ],
)  # fmt: skip
def test_a_server_that_fails_leaves_it_to_the_built_in_sampler(reply, words, caplog):
    with serving(reply) as (url, _):
        assert GraspServer(url, Shown()).motion(belief(), PICK) is None
    assert "using own grasps" in caplog.text
    assert "secret" not in caplog.text  # of the URL
    assert re.search(words, caplog.text)


def test_a_server_that_is_not_there(caplog, monkeypatch):
    monkeypatch.setattr(endpoint, "FIRST_PAUSE", 0.01)
    assert GraspServer("http://127.0.0.1:9/grasps", Shown(), 2.0).motion(belief(), PICK) is None
    assert "cannot be reached" in caplog.text


def test_a_grasp_of_the_other_kind_than_asked_for_is_left_out(caplog):
    (sideways,) = parse_plan("[PICK UP, ball] (horizontal)")
    from_above = next(item for item in builtin() if tool_of(item)[2, 2] < -0.9)
    with serving(saying({"grasps": [said(tool_of(from_above), 1.0)]})) as (url, _):
        assert GraspServer(url, Shown()).motion(belief(), sideways) is None


def test_what_is_not_seen_is_not_asked_about(caplog):
    class Blind:
        def picture_of(self, name):
            return None

    assert GraspServer("http://127.0.0.1:9/", Blind()).motion(belief(), PICK) is None
    assert "not seen well enough" in caplog.text

"""Robots in another process, good and bad ones."""

from __future__ import annotations

import io
import json
import shlex
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from etot_cli.control.robot import Contacts, Guards, RobotState
from etot_cli.errors import RobotStoppedError, ServiceError
from etot_cli.execution.observation import Mark, Observation, Sighting
from etot_cli.execution.protocols import Frame
from etot_cli.execution.robots import worker, worker_process
from etot_cli.execution.robots.worker import Episode, WorkerCamera, WorkerEyes, WorkerRobot
from etot_cli.execution.robots.worker_messages import Picture, line_of
from etot_cli.execution.robots.worker_server import Served, serve
from etot_cli.skills.motion.motion import PhaseEnd, Press

ROGUE = Path(__file__).with_name("rogue_worker.py")
JOINTS = ("a", "b", "c", "d", "e", "f")


def rogue(how: str) -> WorkerRobot:
    return WorkerRobot(shlex.join([sys.executable, str(ROGUE), how]), JOINTS, Episode())


def alive(pid: int) -> bool:
    try:
        status = Path(f"/proc/{pid}/stat").read_text().split(")")[1].split()[0]
    except FileNotFoundError:
        return False
    return status != "Z"


def pid_of(robot: WorkerRobot) -> int:
    return robot._process._child.pid


def test_a_worker_that_behaves():
    robot = rogue("well")
    assert "toy" in robot.connect()
    pid = pid_of(robot)
    assert robot.follow(np.zeros((3, 6)), Guards()) is PhaseEnd.DONE
    assert robot.wait(0.1, Guards()) is PhaseEnd.DONE
    last = Observation(robot.state(), {"cup": Sighting((0, 0, 0), (1, 0, 0, 0), Mark.HELD)})
    seen = WorkerEyes(robot).look(robot.state(), last)
    assert seen.objects["ball"].position == (1, 2, 3)
    assert seen.objects["cup"].mark is Mark.HELD  # nothing was said of it
    robot.close()
    robot.close()
    assert not alive(pid)


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ("version", "etot.worker/2.*expected 'etot.worker/1'"),
        ("axes", "7 joints; expected 6"),
        ("chatter", "Welcome to the simulator.*expected replies alone"),
        ("lies", "answers 'state' wrongly: joints"),
        ("nan", "joints.0"),
        ("few", "expected 6 joints"),
        ("die", "ended with code 7; it said: segmentation fault"),
        ("hang", "no answer to 'state' within"),
        ("flood", "more than"),
        ("others", "never made"),
        ("far", "answers 'look' wrongly: objects.ball.position.0: .*100"),
        ("flat", "objects.ball.quaternion: .*its norm is 0, expected a unit quaternion"),
    ],
)
def test_a_worker_that_misbehaves_is_found_out_and_ended(how, words, monkeypatch):
    monkeypatch.setattr(worker, "ANSWERS_WITHIN", 2.0)
    monkeypatch.setattr(WorkerRobot.ask, "__defaults__", (None, 2.0))
    monkeypatch.setattr(worker_process, "ENDS_WITHIN", 0.3)
    monkeypatch.setattr(worker_process, "MAX_LINE", 1 << 22)
    robot = rogue(how)
    begun = time.monotonic()
    with pytest.raises(ServiceError, match=words) as found:
        robot.connect()
        WorkerEyes(robot).look(robot.state(), Observation(robot.state()))
    assert found.value.exit_code == 3
    pid = pid_of(robot)
    robot.close()
    assert time.monotonic() - begun < 6.0
    assert not alive(pid)


def test_a_limit_is_no_lost_robot():
    robot = rogue("limit")
    robot.connect()
    with pytest.raises(RobotStoppedError, match="workspace limit"):
        robot.follow(np.zeros((1, 6)), Guards())
    robot.state()  # it is still there
    robot.close()


@pytest.mark.slow
def test_a_worker_that_does_not_listen_ends_with_the_program():
    command = shlex.join([sys.executable, "-c", "import time; time.sleep(60)"])
    program = (
        "from etot_cli.execution.robots.worker_process import WorkerProcess\n"
        f"import time; print(WorkerProcess({command!r})._child.pid, flush=True); time.sleep(60)"
    )
    parent = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    pid = int(parent.stdout.readline())
    assert alive(pid)
    parent.kill()
    parent.communicate()
    deadline = time.monotonic() + 3
    while alive(pid) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not alive(pid)


def test_its_children_end_with_it():
    robot = rogue("child")
    robot.connect()
    deadline = time.monotonic() + 5
    while not robot._process._errors and time.monotonic() < deadline:
        time.sleep(0.01)
    child = int(robot._process._errors[0])
    assert alive(child)
    robot.close()
    deadline = time.monotonic() + 5
    while alive(child) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not alive(child)


def test_a_command_that_is_none():
    with pytest.raises(ServiceError, match="cannot be started"):
        WorkerRobot("/no/such/program", JOINTS, Episode()).connect()


class Toy:
    """A robot that does what it is told."""

    def __init__(self):
        self.calls = []
        self.sensed = RobotState(np.array([0.1, 1 / 3]), np.array([0.1, 2 / 3]), 0.03, 1.25)

    def connect(self):
        return "toy"

    def state(self):
        return self.sensed

    def follow(self, targets, guards):
        self.calls.append((targets.tolist(), guards))
        return PhaseEnd.BLOCKED

    def set_opening(self, opening):
        self.calls.append(opening)

    def wait(self, seconds, guards, *, until_rest=False):
        self.calls.append((seconds, guards, until_rest))
        return PhaseEnd.SLIPPED

    def contacts(self):
        return Contacts(("ball",), (Press("a", "b", 1.5),))

    def stop(self):
        self.calls.append("stop")

    def close(self):
        self.calls.append("close")


def exchange(robot: Toy, *requests: dict, camera=None) -> list[dict]:
    sink, out = io.BytesIO(), sys.stdout
    hello = {"id": 0, "method": "hello", "protocol": "etot.worker/1"}
    lines = b"".join(line_of(item) for item in [hello, *requests])
    try:
        serve(lambda _: Served(robot, camera=camera), io.BytesIO(lines), sink)
    finally:
        sys.stdout = out
    return [json.loads(line) for line in sink.getvalue().splitlines()][1:]


def test_the_server_hands_everything_on_to_the_last_digit():
    toy = Toy()
    targets = [[0.1, 1 / 3], [0.2, 1e-17]]
    state, follow, wait, hand, contacts, unknown = exchange(
        toy,
        {"id": 1, "method": "state"},
        {"id": 2, "method": "follow", "targets": targets, "holding": 0.01},
        {"id": 3, "method": "wait", "seconds": 0.5, "holding": None, "until_rest": True},
        {"id": 4, "method": "set_opening", "opening": 0.1},
        {"id": 5, "method": "contacts"},
        {"id": 6, "method": "sing"},
    )
    assert state["result"]["joints"] == toy.sensed.joints.tolist()
    assert follow == {"id": 2, "result": {"end": "blocked"}}
    assert wait["result"] == {"end": "slipped"}
    assert hand == {"id": 4, "result": {}}
    assert contacts["result"] == {"touching": ["ball"], "presses": [["a", "b", 1.5]]}
    assert "sing" in unknown["error"]["message"]
    done = [call for call in toy.calls if call not in ("stop", "close")]
    assert done == [(targets, Guards(0.01)), (0.5, Guards(), True), 0.1]
    assert toy.calls[-1] == "close"  # the input ended


class Lens:
    """A camera that took one picture."""

    def __init__(self, taken: Frame):
        self.frame = lambda: taken

    def connect(self):
        return "toy"

    def close(self):
        pass


def test_a_picture_comes_over_the_pipe_as_it_was_taken(monkeypatch):
    color = np.arange(2 * 3 * 3, dtype=np.uint8).reshape(2, 3, 3)
    depth = np.array([[0.0, 0.5, 1.2345], [6.56, 6.5534, 9.0]])
    taken = Frame(color, depth, np.diag([600.0, 600.0, 1.0]), np.eye(4), 1.5)
    (reply,) = exchange(Toy(), {"id": 1, "method": "frame"}, camera=Lens(taken))
    robot = rogue("well")
    robot.offers = frozenset({"frame"})
    monkeypatch.setattr(robot, "ask", lambda *_: Picture.model_validate(reply["result"]))
    seen = WorkerCamera(robot).frame()
    assert np.array_equal(seen.color, color)
    within = [[0.0, 0.5, 1.2345], [0.0, 6.5534, 0.0]]  # what 16 bits hold
    assert seen.depth == pytest.approx(np.array(within), abs=1e-9)
    reply["result"]["camera_to_base"][0][0] = 2.0
    with pytest.raises(ServiceError, match="no rigid pose"):
        WorkerCamera(robot).frame()


def test_nothing_is_done_before_hello():
    sink, out, toy = io.BytesIO(), sys.stdout, Toy()
    try:
        line = line_of({"id": 1, "method": "set_opening", "opening": 0.0})
        serve(lambda _: Served(toy), io.BytesIO(line), sink)
    finally:
        sys.stdout = out
    assert "before 'hello'" in sink.getvalue().decode()
    assert not toy.calls

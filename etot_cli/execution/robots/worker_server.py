"""The other end of the pipe: serves a robot, and its eyes or camera, as a worker.

For simulators and bridges in Python; whoever speaks another language follows docs/worker.md.
"""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass
from queue import SimpleQueue
from typing import Any, BinaryIO

import numpy as np

from etot_cli.control.robot import RobotState
from etot_cli.errors import EtotError, RobotStoppedError
from etot_cli.execution.protocols import Camera, Eyes, RobotDevice
from etot_cli.execution.robots.worker_messages import (
    PROTOCOL,
    Ended,
    Looked,
    Message,
    State,
    Touched,
    guards_of,
    line_of,
    rows_of,
)
from etot_cli.reconstruction.capture.pictures import depth_text, png_text
from etot_cli.specs.bounds import DEPTH_UNIT

NO_STATE = RobotState(np.zeros(1), np.zeros(1), 0.0, 0.0)
"""Stands where a request carries no state of the robot."""


@dataclass(frozen=True)
class Served:
    """What a worker has: a robot, and maybe eyes or a camera."""

    robot: RobotDevice
    eyes: Eyes | None = None
    camera: Camera | None = None
    slower: float = 1.0


Open = Callable[[dict[str, Any]], Served]
"""Opens what is served, from the parameters of ``hello``."""


def serve(open_served: Open, source: BinaryIO | None = None, sink: BinaryIO | None = None) -> None:
    """Answers requests until ``close`` or the end of the input, and leaves the robot stopped.

    Whatever else prints to standard output from now on goes to standard error.
    """
    source, sink = source or sys.stdin.buffer, sink or sys.stdout.buffer
    sys.stdout = sys.stderr
    session = _Session(open_served)
    requests: SimpleQueue[dict[str, Any] | None] = SimpleQueue()

    def read() -> None:
        for line in source:
            try:
                request = json.loads(line)
            except ValueError:
                break
            if not isinstance(request, dict):
                break
            if request.get("method") == "stop":
                session.stop()  # at once, whatever is being answered
            requests.put(request)
        session.stop()
        requests.put(None)

    threading.Thread(target=read, daemon=True).start()
    try:
        while (request := requests.get()) is not None:
            sink.write(line_of(session.answer(request)))
            sink.flush()
            if request.get("method") == "close":
                break
    finally:
        session.close()


class _Session:
    """The robot once it is open, and the answers to requests."""

    def __init__(self, open_served: Open) -> None:
        self._open = open_served
        self._served: Served | None = None

    def stop(self) -> None:
        """Stops the robot if there is one."""
        if self._served is not None:
            self._served.robot.stop()

    def close(self) -> None:
        """Stops the robot and lets go of everything."""
        if self._served is not None:
            self._served.robot.close()
            if self._served.camera is not None:
                self._served.camera.close()

    def answer(self, request: dict[str, Any]) -> dict[str, Any]:
        """The reply to a request."""
        number, method = request.get("id"), str(request.get("method"))
        try:
            result = self._result(method, request)
        except RobotStoppedError as error:
            return {"id": number, "error": {"kind": "stopped", "message": str(error)}}
        except (EtotError, KeyError, TypeError, ValueError) as error:
            return {"id": number, "error": {"kind": "failed", "message": f"{error}"}}
        if isinstance(result, Message):
            result = result.model_dump(mode="json")
        return {"id": number, "result": result}

    def _result(self, method: str, request: dict[str, Any]) -> Message | dict[str, Any]:
        if method == "hello":
            return self._hello(request)
        served = self._served
        if served is None:
            raise ValueError(f"{method!r} before 'hello'")
        robot = served.robot
        if method == "state":
            return State.of(robot.state())
        if method == "follow":
            return Ended(end=robot.follow(rows_of(request["targets"]), guards_of(request)))
        if method == "wait":
            rest = bool(request.get("until_rest", False))
            guards = guards_of(request)
            return Ended(end=robot.wait(float(request["seconds"]), guards, until_rest=rest))
        if method == "set_opening":
            robot.set_opening(float(request["opening"]))
        elif method == "contacts":
            return Touched.of(robot.contacts())
        elif method == "look" and served.eyes is not None:
            last = Looked.model_validate(request.get("last") or {}).observation(NO_STATE)
            return Looked.of(served.eyes.look(robot.state(), last))
        elif method == "frame" and served.camera is not None:
            return _picture(served.camera)
        elif method == "close":
            self.close()
        elif method != "stop":
            raise ValueError(f"no method {method!r} here")
        return {}

    def _hello(self, request: dict[str, Any]) -> dict[str, Any]:
        if request.get("protocol") != PROTOCOL:
            raise ValueError(f"found protocol {request.get('protocol')!r}, expected {PROTOCOL!r}")
        served = self._served = self._open(request)
        offers = {"look": served.eyes, "frame": served.camera}
        name = served.robot.connect()
        if served.camera is not None:
            served.camera.connect()
        return {
            "protocol": PROTOCOL,
            "name": name,
            "joints": len(served.robot.state().joints),
            "offers": [key for key, value in offers.items() if value is not None],
            "slower": served.slower,
        }


def _picture(camera: Camera) -> dict[str, Any]:
    frame = camera.frame()
    return {
        "color": png_text(frame.color[..., ::-1]),
        "depth": depth_text(frame.depth),
        "depth_scale": DEPTH_UNIT,
        "matrix": frame.matrix.tolist(),
        "camera_to_base": frame.camera_to_base.tolist(),
        "taken_s": frame.taken_s,
    }

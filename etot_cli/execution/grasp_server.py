"""Grasps from a server of the AnyGrasp kind: a picture and a mask in, scored grasps out.

docs/grasp_server.md describes request and reply. A grasp is used only when the twin has a free way
to it; where none is, or the server fails, the built-in sampler chooses, and that is said.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from etot_cli.errors import ServiceError
from etot_cli.execution.perception.scan import view_of
from etot_cli.execution.protocols import Frame
from etot_cli.reconstruction.capture.view import Array, Mask
from etot_cli.reconstruction.services import Server, what_is_seen
from etot_cli.skills.action import Action, GraspPose
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.motion import Motion, framed
from etot_cli.skills.motions import plan_motions
from etot_cli.world.pose import Pose

SAID = logging.getLogger(__name__)

DEADLINE_S = 20.0
"""A reply takes no longer, retries included [s]: the robot waits for it."""
MOST_GRASPS = 1000
"""Grasps in a reply; only the first ones are looked at anyway."""
MOST_TRIED = 20
"""Grasps that the twin looks at, best first: about a second's work."""
LEAST_MASK = 30
"""A smaller mask shows too little to grasp by [px]."""
ROOM = 0.03
"""How much further than the grasp's width the fingers open for the approach [m]."""
SAME = 0.001
"""A motion whose tool ends this near to a grasp is a motion to that grasp [m]."""
LEVEL = 0.5
"""Sine of the approach's fall from which a grasp counts as from above."""


class Pictures(Protocol):
    """Who can show what was last seen of an object."""

    def picture_of(self, name: str) -> tuple[Frame, Mask] | None:
        """The last picture and the object's pixels (h, w); None where it was not seen."""
        ...


@dataclass(frozen=True)
class ServerGrasp:
    """``tool`` (4, 4) in the base frame, z the approach, y the closing direction, origin between
    the pads; ``width`` between the surfaces [m]; a higher ``score`` is better.
    """

    tool: Array
    width: float
    score: float


class GraspServer:
    """Asks a server, and has the twin check what it says.

    Args:
        url: of the server.
        pictures: what was seen.
        deadline_s: for a whole reply [s].
    """

    def __init__(self, url: str, pictures: Pictures, deadline_s: float = DEADLINE_S) -> None:
        self._server = Server(url, "grasp", deadline_s)
        self._pictures = pictures

    def motion(self, belief: Belief, action: Action) -> Motion | None:
        """The best of its grasps that the twin has a free way to, as a motion.

        None, with a message, where there is none; the built-in sampler is to choose then.
        """
        name = action.target
        shown = self._pictures.picture_of(name)
        if shown is None or shown[1].sum() < LEAST_MASK:
            SAID.warning("%s is not seen well enough to ask for a grasp; using own grasps", name)
            return None
        opening = belief.world.robot.spec.gripper.opening
        try:
            grasps = self.grasps(*shown, name, opening)
        except ServiceError as error:
            SAID.warning("%s; using own grasps", error)
            return None
        for grasp in grasps[:MOST_TRIED]:
            found = _checked(belief, action, grasp)
            if found is not None:
                return found
        SAID.warning(
            "none of the %d grasps of %s from the server is free in the twin; using own grasps",
            len(grasps), name,
        )  # fmt: skip
        return None

    def grasps(self, frame: Frame, mask: Mask, name: str, opening: float) -> list[ServerGrasp]:
        """Its grasps no wider than the gripper opens, best first.

        Raises:
            ServiceError: no usable reply.
        """
        seen = what_is_seen(frame.color, frame.depth, mask, view_of(frame))
        reply = self._server.ask({**seen, "object": name, "max_width": opening})
        entries = reply.get("grasps")
        if not isinstance(entries, list) or len(entries) > MOST_GRASPS:
            raise self._server.error(f"the answer has no list 'grasps' of at most {MOST_GRASPS}")
        found = [self._grasp(entry, index, frame) for index, entry in enumerate(entries)]
        fitting = [grasp for grasp in found if grasp.width <= opening]
        return sorted(fitting, key=lambda grasp: -grasp.score)

    def _grasp(self, entry: Any, index: int, frame: Frame) -> ServerGrasp:
        where = f"grasps[{index}]"
        if not isinstance(entry, Mapping):
            raise self._server.error(f"{where} is no object")
        score = self._number(entry, "score", where, -1e9, 1e9)
        width = self._number(entry, "width", where, 0.0, 0.5)
        pose = self._server.pose(entry.get("pose"), f"{where}.pose")
        return ServerGrasp(frame.camera_to_base @ pose, width, score)

    def _number(
        self, entry: Mapping[str, Any], key: str, where: str, low: float, high: float
    ) -> float:
        value = entry.get(key)
        if (
            isinstance(value, bool)
            or not isinstance(value, int | float)
            or not low <= value <= high
        ):
            raise self._server.error(
                f"{where}.{key} is {str(value)[:40]}; expected a number from {low:g} to {high:g}"
            )
        return float(value)


def _checked(belief: Belief, action: Action, grasp: ServerGrasp) -> Motion | None:
    """A motion to a grasp, where arm and hand have a free way to it in the twin."""
    tool = Pose(grasp.tool[:3, 3], grasp.tool[:3, :3])
    level = abs(float(tool.rotation[2, 2])) < LEVEL
    if action.pose is not None and (action.pose is GraspPose.HORIZONTAL) != level:
        return None
    largest = belief.world.robot.spec.gripper.opening
    origin = belief.object_pose(action.target)
    wanted = Motion(
        str(action), (), framed(action.target, origin, tool),
        details={"width": grasp.width, "opening": min(largest, grasp.width + ROOM)},
    )  # fmt: skip
    found = next(plan_motions(belief, action, wanted), None)
    if not isinstance(found, Motion) or found.tool_at is None:
        return None
    # The sampler's own grasps follow; one of them means that the way to this one was not free.
    apart = np.linalg.norm((origin @ found.tool_at.pose).position - tool.position)
    return found if apart < SAME else None

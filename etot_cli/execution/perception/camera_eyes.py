"""The eyes ``camera``: where the known objects of a scene are, from one RGB-D picture a look.

Every object is first looked for where it was last; what moved is looked for among the readings that
nothing else explains. What is not seen keeps its last pose and is marked: in the hand, hidden, or
lost. The arm is left out by where its joints are sensed to be; no OpenGL is needed.
"""

from __future__ import annotations

from collections.abc import Mapping

import cv2
import numpy as np
from scipy.spatial import cKDTree

from etot_cli.control.robot import RobotState
from etot_cli.execution.observation import Mark, Observation, Sighting
from etot_cli.execution.perception.following import Following
from etot_cli.execution.perception.furniture import Furniture
from etot_cli.execution.perception.hand import HandContents
from etot_cli.execution.perception.scan import Scan, scan_of, view_of
from etot_cli.execution.perception.support import shown
from etot_cli.execution.perception.twin import KnownScene
from etot_cli.execution.perception.unseen import (
    contradicted,
    out_of_sight,
    slid,
    with_its_container,
)
from etot_cli.execution.protocols import Camera, Frame
from etot_cli.reconstruction.capture.view import Mask
from etot_cli.specs.scene import Scene
from etot_cli.world.pose import Pose

ARM_MARGIN = 0.009
"""Readings this near to the arm's surface are the arm's [m]."""


class CameraEyes:
    """Implements :class:`etot_cli.execution.protocols.Eyes`.

    Args:
        camera: takes the pictures; opened at the first look.
        scene: what is known: shapes, and where things are at the start.

    Raises:
        WorldError: the scene cannot be built.
    """

    def __init__(self, camera: Camera, scene: Scene) -> None:
        self._camera = camera
        self._known = KnownScene(scene)
        self._furniture = Furniture(self._known)
        self._following = Following(self._known)
        self._hand = HandContents(self._known)
        self._frame: Frame | None = None
        self._found: dict[str, Pose] = {}
        self._connected = False

    def look(self, state: RobotState, last: Observation) -> Observation:
        """Looks at the scene.

        Raises:
            ServiceError: the camera gives no picture that can be relied on.
        """
        if not self._connected:
            self._camera.connect()
            self._connected = True
        known = self._known
        known.set_robot(state)
        self._frame = self._camera.frame()
        scan = scan_of(self._frame, known.scene.desk)
        self._leave_out_arm(scan)
        before = {
            name: known.nominal(name)
            if there is None
            else Pose.of(there.position, there.quaternion)
            for name, there in ((name, last.objects.get(name)) for name in known.free)
        }
        moved = self._furniture.look(scan, last.parts)
        carried = self._hand.carried(before, state)
        moved.update(self._put(carried, before))
        expected = {name: with_its_container(known, name, before[name], moved) for name in before}
        expected.update({**self._hand.let_go(state), **carried})
        self._found = self._following.find_all(scan, expected, set(carried))
        seen = {name: (pose, Mark.SEEN) for name, pose in self._found.items()}
        for name, pose in self._found.items():
            if self._hand.grips(name, pose, state):
                self._found[name] = self._hand.between_pads(name, pose, state)
                seen[name] = self._found[name], Mark.HELD
        moved.update(self._put(self._found, before))
        if any(mark is Mark.HELD for _, mark in seen.values()):
            carried = {}  # what the hand holds is seen, and so it holds nothing else
        lost = {name for name, item in last.objects.items() if item.mark is Mark.LOST}
        for name in self._containers_first():
            if name not in seen:
                there = with_its_container(known, name, before[name], moved)
                seen[name] = self._unseen(name, there, carried.get(name), name in lost, scan, state)
                moved.update(self._put({name: seen[name][0]}, before))
        held = {name: pose for name, (pose, mark) in seen.items() if mark is Mark.HELD}
        self._hand.remember(held, state)
        objects = {name: _sighting(*seen[name]) for name in known.free}
        for name, standing in self._furniture.standing.items():
            mark = Mark.SEEN if standing.seen else Mark.HIDDEN
            objects[name] = _sighting(standing.pose, mark)
        return Observation(state, objects, dict(self._furniture.values))

    def _put(self, poses: Mapping[str, Pose], before: Mapping[str, Pose]) -> dict[str, Pose]:
        """Puts objects where they are taken to be; how each one's body has moved to there."""
        for name, pose in poses.items():
            self._known.put(name, pose)
        entries = self._known.world.entries
        return {entries[name].body: pose @ before[name].inverse() for name, pose in poses.items()}

    def _containers_first(self) -> list[str]:
        """Free objects, the larger before the smaller ones, which may be in them."""
        surfaces = self._known.surfaces
        return sorted(
            self._known.free,
            key=lambda name: -surfaces[name].radius if name in surfaces else 0.0,
        )

    def picture_of(self, name: str) -> tuple[Frame, Mask] | None:
        """The last picture and an object's pixels (h, w) in it; None where it was not seen."""
        if self._frame is None or name not in self._found:
            return None
        depth = self._frame.depth
        seen = shown(self._known.surfaces[name], self._found[name], view_of(self._frame), depth)
        own = seen.pixels[~seen.hidden]
        mask = np.zeros(depth.shape, np.uint8)
        mask[own[:, 1], own[:, 0]] = 1
        return self._frame, cv2.morphologyEx(mask, cv2.MORPH_CLOSE, np.ones((5, 5))) > 0

    def close(self) -> None:
        """Lets go of the camera; idempotent."""
        if self._connected:
            self._camera.close()
            self._connected = False

    def _leave_out_arm(self, scan: Scan) -> None:
        tree = cKDTree(self._known.robot_points())
        apart, _ = tree.query(scan.points, distance_upper_bound=ARM_MARGIN)
        scan.unexplained[np.isfinite(apart)] = False

    def _unseen(
        self,
        name: str,
        before: Pose,
        carried: Pose | None,
        lost: bool,
        scan: Scan,
        state: RobotState,
    ) -> tuple[Pose, Mark]:
        """Where an object is taken to be of which nothing was found.

        Args:
            name: of the object.
            before: where it was, or was brought by the container that it is in.
            carried: where the hand has brought it, if it may hold it.
            lost: whether it was lost already.
            scan: the picture.
            state: what the robot senses.
        """
        surface = self._known.surfaces.get(name)
        if surface is None:
            return before, Mark.HIDDEN
        if carried is not None and not contradicted(surface, carried, scan):
            if surface.long_axis is not None:
                carried = slid(self._known, surface, carried, scan)
            return carried, Mark.HELD
        was_held = self._hand.held.get(name)
        if was_held is None and (lost or not contradicted(surface, before, scan)):
            return before, Mark.LOST if lost else Mark.HIDDEN
        tool = self._hand.where_it_let_go(state)
        hidden = out_of_sight(self._known, name, before, was_held, tool, scan)
        return (before, Mark.LOST) if hidden is None else (hidden, Mark.HIDDEN)


def _sighting(pose: Pose, mark: Mark) -> Sighting:
    x, y, z = (float(value) for value in pose.position)
    w, i, j, k = (float(value) for value in pose.quaternion)
    return Sighting((x, y, z), (w, i, j, k), mark)

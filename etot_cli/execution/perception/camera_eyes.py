"""The eyes ``camera``: where the known objects of a scene are, from one RGB-D picture a look.

Every object is first looked for where it was last; what moved is looked for among the readings that
nothing else explains. What is not seen keeps its last pose and is marked: in the hand, hidden, or
lost. The arm is left out by where its joints are sensed to be; no OpenGL is needed.
"""

from __future__ import annotations

import cv2
import mujoco
import numpy as np
from scipy.spatial import cKDTree

from etot_cli.control.robot import Robot, RobotState
from etot_cli.execution.observation import Mark, Observation, Sighting
from etot_cli.execution.perception.fitting import (
    TOLERANCE,
    Freedom,
    Pose,
    Support,
    improved,
    outlined,
    support,
    visible_points,
)
from etot_cli.execution.perception.scan import Scan, scan_of, view_of
from etot_cli.execution.perception.search import NEAR, Match, chroma, find
from etot_cli.execution.perception.surfaces import Surface
from etot_cli.execution.perception.twin import KnownScene
from etot_cli.execution.perception.unseen import (
    LEAST_AGREE,
    STILL_THERE,
    carried,
    contradicted,
    in_the_fingers,
    level_moves,
    out_of_sight,
    slid,
)
from etot_cli.execution.protocols import Camera, Frame
from etot_cli.reconstruction.capture.view import Array, Mask
from etot_cli.specs.scene import Scene

ARM_MARGIN = 0.009
"""Readings this near to the arm's surface are the arm's [m]."""
STANDS = 0.9
"""... and in the same attitude, when that much agrees."""
PLAINLY = 0.25
"""Gain in what agrees for which another height or attitude is believed."""
MOVED_ON = 0.06
"""An object that is still there is this near to its last place [m]; else it was looked for."""
GRIPPED = 0.003
"""Fingers less than this from closed or from fully open hold nothing [m]."""
AT_PADS = 0.014
"""What is in the hand has surface this near to both pads [m]: perception errs by less."""
LET_GO = 0.004
"""Fingers that have opened by more since they held something hold it no longer [m]."""
LEVEL = 0.3
"""Rise of a rod's axis (sine) from which it stands or leans."""
PART_STEPS, PART_ROUNDS = 15, 3
"""Values of a part's joint that are compared, and how often between the two best ones."""
PART_POINTS = 2500
OF_FURNITURE = 0.005
"""Readings this near to furniture are its own [m]; what lies flat on it begins there."""
MATCHED = 0.25
"""Matches with a lower score are none."""


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
        self._colors: dict[str, Array] = {}
        self._held: dict[str, Pose] = {}
        self._grip = 0.0
        self._frame: Frame | None = None
        self._found: dict[str, Pose] = {}
        self._connected = False
        self._parts = {name: self._known.joint_value(name) for name in self._known.parts}

    def look(self, robot: Robot, last: Observation) -> Observation:
        """Looks at the scene.

        Raises:
            ServiceError: the camera gives no picture that can be relied on.
        """
        if not self._connected:
            self._camera.connect()
            self._connected = True
        state = robot.state()
        known = self._known
        known.set_robot(state)
        self._frame = self._camera.frame()
        scan = scan_of(self._frame, known.scene.desk)
        self._leave_out_arm(scan)
        before = {name: _pose(last.objects[name]) if name in last.objects else known.nominal(name)
                  for name in known.free}  # fmt: skip
        place = self._look_at_furniture(scan)
        moved = self._look_at_parts(scan, place, last)
        found = self._still_there(scan, before)
        for match in self._matched(scan, before, [n for n in known.free if n not in found]):
            found[match.name] = match.pose
        self._found = found
        objects: dict[str, Sighting] = {}
        in_hand: dict[str, Pose] = {}
        for name, pose in found.items():
            held = self._in_hand(name, pose, state)
            if held:
                in_hand[name] = known.tool().inverse() @ pose
            objects[name] = _sighting(pose, Mark.HELD if held else Mark.SEEN)
        for name in known.free:
            if name not in found:
                objects[name] = self._unseen(name, before[name], scan, state, in_hand, moved, last)
        if in_hand and not self._held:
            self._grip = state.opening
        self._held = in_hand
        return Observation(state, {name: objects[name] for name in known.free}, dict(self._parts))

    def picture_of(self, name: str) -> tuple[Frame, Mask] | None:
        """The last picture and an object's pixels (h, w) in it; None where it was not seen."""
        if self._frame is None or name not in self._found:
            return None
        view, depth = view_of(self._frame), self._frame.depth
        surface, pose = self._known.surfaces[name], self._found[name]
        points = pose.place(surface.points[visible_points(surface, pose, view)])
        pixels = np.round(view.project(points)).astype(np.int64)
        inside = ((pixels >= 0) & (pixels < [view.width, view.height])).all(axis=1)
        pixels, expected = pixels[inside], view.depth_of(points[inside])
        read = depth[pixels[:, 1], pixels[:, 0]]
        own = pixels[(read == 0) | (read > expected - TOLERANCE)]
        mask = np.zeros(depth.shape, np.uint8)
        mask[own[:, 1], own[:, 0]] = 1
        return self._frame, cv2.morphologyEx(mask, cv2.MORPH_CLOSE, np.ones((5, 5))) > 0

    def close(self) -> None:
        """Lets go of the camera; idempotent."""
        if self._connected:
            self._camera.close()
            self._connected = False

    # -- what stands still ----------------------------------------------------------------------

    def _leave_out_arm(self, scan: Scan) -> None:
        points = self._known.robot_points()
        tree = cKDTree(points)
        apart, _ = tree.query(scan.points, distance_upper_bound=ARM_MARGIN)
        scan.owner[np.isfinite(apart)] = "robot"

    def _look_at_furniture(self, scan: Scan) -> dict[str, Pose]:
        """How far each piece of furniture stands from where the scene has it; explains readings."""
        known, place = self._known, {}
        for name, entry in known.world.entries.items():
            if entry.free or name not in known.surfaces:
                continue
            surface, nominal = known.surfaces[name], known.nominal(name)
            readings = scan.points[scan.unexplained]
            pose = improved(surface, nominal, readings, scan.view, freedom=Freedom.ON_LEVEL)
            place[name] = pose @ nominal.inverse()
            _explain(scan, name, surface, pose)
        return place

    def _look_at_parts(
        self, scan: Scan, place: dict[str, Pose], last: Observation
    ) -> dict[str, Pose]:
        """Finds joint values; how each part's body has moved since the last look."""
        known, moved = self._known, {}
        for address, part in known.parts.items():
            if address not in known.part_surfaces:
                continue
            was = last.parts.get(address, self._parts[address])
            offset = place.get(address.split(".")[0], Pose(np.eye(3), np.zeros(3)))
            before = offset @ known.set_part(address, was)
            surface = known.part_surfaces[address].thinned(PART_POINTS)
            value = self._part_value(address, surface, offset, scan, was)
            self._parts[address] = value
            pose = offset @ known.set_part(address, value)
            moved[part.body] = pose @ before.inverse()
            _explain(scan, address, known.part_surfaces[address], pose)
        return moved

    def _part_value(
        self, address: str, surface: Surface, offset: Pose, scan: Scan, was: float
    ) -> float:
        part = self._known.parts[address]
        low, high = sorted((part.lower, part.upper))

        def worth(value: float) -> float:
            pose = offset @ self._known.set_part(address, value)
            borne = support(surface, pose, scan.view, scan.depth)
            return borne.agree - 2.0 * borne.through

        values = np.unique(np.append(np.linspace(low, high, PART_STEPS), np.clip(was, low, high)))
        worths = np.array([worth(value) for value in values])
        best = int(worths.argmax())
        least = worth(float(np.clip(was, low, high)))
        if worths[best] <= max(least, 0.0) and least > 0:
            best = int(np.abs(values - was).argmin())
        if worths[best] <= 0:
            return was  # nothing of it is to be seen
        value, step = float(values[best]), (high - low) / (PART_STEPS - 1)
        top = worths[best]
        for _ in range(PART_ROUNDS):
            step /= 2.0
            for tried in (value - step, value + step):
                if low <= tried <= high and (found := worth(tried)) > top:
                    value, top = tried, found
        return value

    def _still_there(self, scan: Scan, before: dict[str, Pose]) -> dict[str, Pose]:
        """Objects near where they were, with their poses made exact; explains their readings."""
        known = self._known
        fits: list[tuple[float, str, Pose]] = []
        outlines: set[str] = set()
        for name, pose in before.items():
            surface = known.surfaces.get(name)
            if surface is None:
                continue
            near = scan.unexplained & (
                np.linalg.norm(scan.points - pose.place(surface.middle[None])[0], axis=1)
                < surface.radius + 0.03
            )
            better, borne = self._followed(surface, pose, scan, scan.points[near])
            shift = np.linalg.norm(better.place(surface.middle[None]) - pose.place(
                surface.middle[None]))  # fmt: skip
            like = self._like(name, scan, surface, better)
            thin = surface.long_axis is not None and borne.unread > borne.visible
            share = borne.outlined if thin else borne.share
            read = borne.agree + borne.unread if thin else borne.agree
            if share >= STILL_THERE and read >= LEAST_AGREE and shift < MOVED_ON:
                fits.append((share * like, name, better))
                if thin:
                    outlines.add(name)
        fits.sort(key=lambda item: -item[0])
        return {
            name: pose
            for _, name, pose in fits
            if self._explains(scan, name, pose) or name in outlines
        }

    def _followed(
        self, surface: Surface, pose: Pose, scan: Scan, readings: Array
    ) -> tuple[Pose, Support]:
        """The pose near the last one that is borne out best, with no more freedom than it takes:
        what stands goes on standing at its height unless something else is plainly better.
        """
        best, borne = pose, support(surface, pose, scan.view, scan.depth)
        axis = surface.long_axis
        if (
            axis is not None
            and abs((pose.rotation @ axis)[2]) > LEVEL
            and borne.unread > borne.agree
        ):
            # Outlines tell too little of a leaning rod to move it while it may be where it was.
            return pose, borne
        share = 0.0
        for freedom in Freedom:
            tried = improved(surface, best, readings, scan.view, freedom=freedom)
            found = support(surface, tried, scan.view, scan.depth)
            if found.share > share:
                best, borne, share = tried, found, found.share + PLAINLY
            if borne.share >= STANDS:
                break
        if surface.long_axis is not None and borne.unread > borne.visible:
            if borne.share >= STILL_THERE and borne.agree >= LEAST_AGREE:
                return best, borne
            return outlined(surface, best, scan.view, scan.depth, level_moves(surface, best))
        return best, borne

    def _like(self, name: str, scan: Scan, surface: Surface, pose: Pose) -> float:
        """How much the readings there have the object's colour, 0 to 1; 1 before it is known."""
        if name not in self._colors:
            return 1.0
        apart, _ = surface.tree.query(pose.local(scan.points), distance_upper_bound=NEAR)
        own = np.isfinite(apart)
        if not own.any():
            return 0.0
        unlike = float(np.linalg.norm(chroma(scan.colors[own]) - self._colors[name]))
        return 1.0 / (1.0 + (unlike / 30.0) ** 2)

    def _explains(self, scan: Scan, name: str, pose: Pose) -> bool:
        """Takes the readings of an object's surface, unless others have most of them already."""
        surface = self._known.surfaces[name]
        apart, _ = surface.tree.query(pose.local(scan.points), distance_upper_bound=NEAR)
        own = np.isfinite(apart)
        fresh = own & scan.unexplained
        if fresh.sum() < max(6, 0.3 * own.sum()):
            return False
        scan.owner[fresh] = name
        if name not in self._colors and fresh.sum() >= LEAST_AGREE:
            self._colors[name] = chroma(scan.colors[fresh])
        return True

    # -- what moved -----------------------------------------------------------------------------

    def _matched(self, scan: Scan, before: dict[str, Pose], missing: list[str]) -> list[Match]:
        """Missing objects and clusters of readings, the best pairs first."""
        kept: list[Match] = []
        left = list(missing)
        for _ in range(len(missing)):
            clusters = scan.clusters()
            options = [
                match
                for name in left
                if name in self._known.surfaces
                for match in find(
                    name, self._known.surfaces[name], before[name], scan, clusters,
                    self._colors.get(name),
                )[:1]
                if match.score >= MATCHED
            ]  # fmt: skip
            if not options:
                break
            best = max(options, key=lambda match: match.score)
            left.remove(best.name)
            if self._explains(scan, best.name, best.pose):
                kept.append(best)
            if not left:
                break
        return kept

    # -- what is not seen -----------------------------------------------------------------------

    def _unseen(
        self,
        name: str,
        before: Pose,
        scan: Scan,
        state: RobotState,
        in_hand: dict[str, Pose],
        moved: dict[str, Pose],
        last: Observation,
    ) -> Sighting:
        known = self._known
        closed_on = self._holding(state) and not in_hand
        if closed_on and name in self._held:
            placed = known.tool() @ self._held[name]
            if known.surfaces[name].long_axis is not None:
                placed = slid(known, known.surfaces[name], placed, scan)
            in_hand[name] = known.tool().inverse() @ placed
            return _sighting(placed, Mark.HELD)
        was = last.objects[name].mark if name in last.objects else Mark.SEEN
        if was is Mark.LOST:
            return _sighting(before, Mark.LOST)
        surface = known.surfaces.get(name)
        if surface is None:
            return _sighting(before, Mark.HIDDEN)
        if name not in self._held:
            there = carried(known, name, before, moved)
            if not contradicted(support(surface, there, scan.view, scan.depth)):
                return _sighting(there, Mark.HIDDEN)
            if closed_on:
                pose = in_the_fingers(known, surface, before, scan)
                in_hand[name] = known.tool().inverse() @ pose
                return _sighting(pose, Mark.HELD)
        hidden = out_of_sight(known, name, before, self._held.get(name), scan)
        if hidden is not None:
            return _sighting(hidden, Mark.HIDDEN)
        return _sighting(before, Mark.LOST)

    # -- the hand -------------------------------------------------------------------------------

    def _holding(self, state: RobotState) -> bool:
        """Whether the fingers may hold something: between closed and open, not opened since."""
        opening = self._known.world.robot.spec.gripper.opening
        if state.sent is not None and state.opening < state.sent + GRIPPED:
            return False  # the fingers are where they were sent: nothing keeps them apart
        between = GRIPPED < state.opening < opening - GRIPPED
        return between and (not self._held or state.opening < self._grip + LET_GO)

    def _in_hand(self, name: str, pose: Pose, state: RobotState) -> bool:
        """Whether an object is between the pads and as wide as they are apart."""
        if not self._holding(state):
            return False
        half = np.array([[0.0, state.opening / 2, 0.0]])
        pads = self._known.tool().place(np.vstack([half, -half]))
        apart, _ = self._known.surfaces[name].tree.query(pose.local(pads))
        return bool(apart.max() < AT_PADS)


def _explain(scan: Scan, name: str, surface: Surface, pose: Pose) -> None:
    """Takes the readings of a surface."""
    rest = np.flatnonzero(scan.unexplained)
    apart, _ = surface.tree.query(pose.local(scan.points[rest]), distance_upper_bound=OF_FURNITURE)
    scan.owner[rest[np.isfinite(apart)]] = name


def _pose(sighting: Sighting) -> Pose:
    rotation = np.empty(9)
    mujoco.mju_quat2Mat(rotation, np.array(sighting.quaternion))
    return Pose(rotation.reshape(3, 3), np.array(sighting.position))


def _sighting(pose: Pose, mark: Mark) -> Sighting:
    quaternion = np.empty(4)
    left, _, right = np.linalg.svd(pose.rotation)
    mujoco.mju_mat2Quat(quaternion, np.ascontiguousarray(left @ right).ravel())
    x, y, z = (float(value) for value in pose.position)
    w, i, j, k = (float(value) for value in quaternion)
    return Sighting((x, y, z), (w, i, j, k), mark)

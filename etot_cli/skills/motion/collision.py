"""Collision checks of arm configurations against a frozen scene, object in hand included."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.deadline import Deadline
from etot_cli.skills.motion.frozen import MAX_KNOWN, FrozenScene
from etot_cli.world.arrays import Vector
from etot_cli.world.model import World
from etot_cli.world.pose import Pose
from etot_cli.world.state import owner_of

CLEARANCE = 0.008
"""Distance that transits keep from everything [m]."""
SELF_CLEARANCE = 0.004
"""Distance that links of the robot keep from each other [m]: an arm that follows its targets some
milliradians late must not get stuck on itself."""


class HandPart(Enum):
    """What of the hand is looked at; its fingers are much the same from all sides."""

    ALL = "all"
    FINGERS = "fingers"
    LEFT = "left"
    RIGHT = "right"


@dataclass(frozen=True)
class Attached:
    """An object carried by the hand: its pose in the tool frame."""

    name: str
    in_tool: Pose


class CollisionChecker(FrozenScene):
    """Answers "is this arm configuration free?" for a frozen scene."""

    def __init__(self, world: World, deadline: Deadline | None = None) -> None:
        super().__init__(world)
        self._deadline = deadline or Deadline()
        self._object_names = list(world.entries)
        self._owner = np.array(
            [
                -3 if o == "robot" else -2 if o == "gripper" else -1
                if o not in world.entries else self._object_names.index(o)
                for o in world.geom_object
            ]
        )  # fmt: skip
        self._solid = (world.model.geom_contype | world.model.geom_conaffinity) != 0
        self._carried: int | None = None
        self._within = 0.0
        self._select_pairs(None, CLEARANCE)
        self._hand = np.nonzero(self._owner == -2)[0]
        self._hand_bodies = np.unique(self._model.geom_bodyid[self._hand])
        fingers = np.isin(self._model.geom_bodyid, list(world.robot.finger_side))
        self._finger = fingers & (self._owner == -2)
        self._parts = {geom: self._parts_of(geom) for geom in self._hand.tolist()}
        self._hands: dict[bytes, tuple[Vector, Vector]] = {}
        self._ignored: frozenset[str] = frozenset()
        self._known: dict[tuple[object, ...], tuple[str, ...]] = {}
        self._part_geoms: dict[str, NDArray[np.bool_]] = {}
        self._known_of_hands: dict[tuple[object, ...], dict[HandPart, list[str]]] = {}

    def _select_pairs(self, carried: int | None, within: float) -> None:
        """Makes MuJoCo look only at pairs with the robot or the carried object (its number) in
        them, as far as they are ``within`` a distance [m] of each other: how the other things touch
        each other is none of the robot's business, and most of a hand's surroundings is farther.
        """
        if (carried, within) == (self._carried, self._within):
            return
        self._carried, self._within = carried, within
        model = self._model
        active = self._owner < -1
        if carried is not None:
            active = active | (self._owner == carried)
        model.geom_contype[:] = active & self._solid
        model.geom_conaffinity[:] = self._solid
        model.body_contype[:] = 0
        np.bitwise_or.at(model.body_contype, model.geom_bodyid, model.geom_contype)
        # A pair's margin is the sum of both, and two links have to be told apart by half of theirs.
        margin = max(within, SELF_CLEARANCE / 2)
        model.geom_margin[:] = np.where(active, margin, 0.0)
        # The broad phase looks at bodies' margins, which are fixed when a model is compiled.
        model.body_margin[:] = margin

    @contextmanager
    def without(self, names: Iterable[str]) -> Iterator[None]:
        """Answers as if these objects were not there."""
        before = self._ignored
        self._ignored = before | set(names)
        try:
            yield
        finally:
            self._ignored = before

    def hits(
        self,
        joints: Vector,
        attached: Attached | None = None,
        *,
        clearance: float = CLEARANCE,
        allow: Iterable[str] = (),
        allow_attached: Iterable[str] = (),
        worked: tuple[str, float] | None = None,
    ) -> list[str]:
        """Addresses of what the robot or the attached object would come too close to.

        Args:
            joints: arm joint values (n,).
            attached: the object in the hand.
            clearance: required distance [m].
            allow: objects that the gripper (not the arm) may touch.
            allow_attached: addresses that the attached object may touch.
            worked: joint of the part that the fingers work on, and the distance that they keep
                from it and what it belongs to, other parts left out [m] (negative: it is pressed
                on).

        Returns:
            Addresses as in ``World.geom_address``; ``robot`` for a self-collision. Empty: free.

        Raises:
            OutOfTimeError: the deadline has passed.
        """
        self._deadline.check()
        self._data.qpos[self.world.robot.qpos] = joints
        asked = (clearance, tuple(allow), tuple(allow_attached), worked)
        if attached is not None:
            return self._not_ignored(self._hits(attached, *asked))
        # Looking again without somebody asks the same of the same configurations.
        key = (self._data.qpos.tobytes(), *asked)
        if key not in self._known:
            if len(self._known) >= MAX_KNOWN:
                self._known.clear()
            self._known[key] = tuple(self._hits(None, *asked))
        return self._not_ignored(self._known[key])

    def _not_ignored(self, addresses: Iterable[str]) -> list[str]:
        if not self._ignored:
            return list(addresses)
        return [item for item in addresses if owner_of(item) not in self._ignored]

    def _hits(
        self,
        attached: Attached | None,
        clearance: float,
        allow: tuple[str, ...],
        allow_attached: tuple[str, ...],
        worked: tuple[str, float] | None,
    ) -> list[str]:
        """As :meth:`hits`, of the arm's configuration that is set, nobody being left out."""
        model, data, world = self._model, self._data, self.world
        carried = None if attached is None else self._object_names.index(attached.name)
        self._select_pairs(carried, max(clearance, 0.0 if worked is None else worked[1]))
        if attached is not None:
            mujoco.mj_kinematics(model, data)
            tool = Pose(data.site_xpos[self._tool], data.site_xmat[self._tool].reshape(3, 3))
            pose = tool @ attached.in_tool
            address = data.joint(attached.name).qpos
            address[:3] = pose.position
            mujoco.mju_mat2Quat(address[3:], pose.rotation.ravel())
        self._show()
        mujoco.mj_collision(model, data)
        if data.ncon == 0:
            return []
        contacts = data.contact
        geoms, distances = contacts.geom, contacts.dist
        close = np.flatnonzero(distances < self._required(geoms, clearance, worked))
        if len(close) == 0:
            return []
        held = -9 if carried is None else carried
        hand_may, held_may = set(allow), set(allow_attached)
        found: dict[str, None] = {}
        pairs = geoms[close]
        # Plain numbers: there are too few contacts for arrays to pay.
        for (one, two), (first, second), distance in zip(
            pairs.tolist(), self._owner[pairs].tolist(), distances[close].tolist(), strict=True
        ):
            if first < -1 and second < -1:
                # MuJoCo leaves out pairs of neighbouring links, which the model excludes.
                if distance < SELF_CLEARANCE:
                    found["robot"] = None
                continue
            if not (first < -1 or first == held):
                first, second, one, two = second, first, two, one
            if first == held and second < -1:
                first, second, one, two = second, first, two, one
            # `one` now belongs to the robot if a robot geom is involved, else to the held object.
            if second == held and first < -1:
                if first == -2:
                    continue
                found[world.geom_address[one]] = None
                continue
            touched = {world.geom_address[two], world.geom_object[two]}
            if (first == held and touched & held_may) or (first == -2 and touched & hand_may):
                continue
            found[world.geom_address[two]] = None
        return list(found)

    def _required(
        self, pairs: Vector, clearance: float, worked: tuple[str, float] | None
    ) -> Vector | float:
        """The distance that each contact of geoms (k, 2) has to keep (k,) [m]."""
        if worked is None:
            return clearance
        required = np.full(len(pairs), clearance)
        touched = _either(self._worked_on(worked[0])[pairs])
        required[touched & _either(self._finger[pairs])] = worked[1]
        return required

    def _moved_by(self, joint: str) -> NDArray[np.bool_]:
        """Which geoms a part's joint moves."""
        model = self._model
        welded = model.body_weldid[model.geom_bodyid]
        return np.asarray(welded == model.body_weldid[model.jnt_bodyid[model.joint(joint).id]])

    def _worked_on(self, joint: str) -> NDArray[np.bool_]:
        """Which geoms are a part's, or of what it belongs to and no other part's."""
        if joint not in self._part_geoms:
            own, world = self._moved_by(joint), self.world
            owner = world.geom_object[int(own.argmax())]
            self._part_geoms[joint] = own | [item == owner for item in world.geom_address]
        return self._part_geoms[joint]

    def hand_hits(self, tool: Pose, *, clearance: float, part: HandPart) -> list[str]:
        """Addresses of what the hand alone would come too close to, wherever the arm might be.

        Needs no inverse kinematics, so it is the cheap first look at a tool pose.

        Args:
            tool: tool pose, base frame.
            clearance: required distance [m].
            part: what of the hand is looked at.
        """
        pose = (tool.position.tobytes(), tool.rotation.tobytes())
        key = (self._data.qpos.tobytes(), self._carried, *pose, clearance)
        found = self._known_of_hands.get(key)
        if found is None:
            if len(self._known_of_hands) >= MAX_KNOWN:
                self._known_of_hands.clear()
            found = self._known_of_hands[key] = self._hand_hits(tool, clearance)
        return self._not_ignored(found.get(part, ()))

    def part_hits(self, joint: str) -> list[str]:
        """Objects that a door or drawer overlaps where it stands in the frozen scene, the furniture
        that it belongs to and what rides in it left out.
        """
        model, data = self._model, self._data
        own = self._moved_by(joint)
        model.geom_contype[:], model.geom_conaffinity[:] = own & self._solid, self._solid
        model.body_contype[:] = 0
        np.bitwise_or.at(model.body_contype, model.geom_bodyid, model.geom_contype)
        model.geom_margin[:] = model.body_margin[:] = 0.0
        self._within = -1.0  # whoever looks at the robot next chooses the pairs anew
        self._show()
        mujoco.mj_collision(model, data)
        owners = np.unique(self._owner[data.contact.geom])
        names = [self._object_names[int(index)] for index in owners if index >= 0]
        out = {*self._riders.get(joint, ()), *self._object_names_of(own)}
        return [name for name in names if name not in out]

    def _object_names_of(self, geoms: NDArray[np.bool_]) -> list[str]:
        return [self._object_names[int(index)] for index in np.unique(self._owner[geoms])]

    def _hand_hits(self, tool: Pose, clearance: float) -> dict[HandPart, list[str]]:
        model, data = self._model, self._data
        self._select_pairs(self._carried, clearance)
        points, turns = self._hand_frames()
        # The arm may be anywhere; what else there is has to be where it is.
        if self._shown != data.qpos[self._things].tobytes():
            self._show()
        points = points @ tool.rotation.T + tool.position
        turns = (tool.rotation @ turns).reshape(-1, 9)
        bodies, geoms, count = self._hand_bodies, self._hand, len(self._hand_bodies)
        data.xipos[bodies], data.geom_xpos[geoms] = points[:count], points[count:]
        data.ximat[bodies], data.geom_xmat[geoms] = turns[:count], turns[count:]
        mujoco.mj_collision(model, data)
        if not data.ncon:
            return {}
        found: dict[HandPart, dict[str, None]] = {}
        contacts = data.contact
        pairs = contacts.geom[contacts.dist < clearance]
        owners = self._owner[pairs]
        for (one, two), (first, second) in zip(pairs.tolist(), owners.tolist(), strict=True):
            if (first == -2) == (second == -2) or min(first, second) < -2:
                continue
            own, other = (one, two) if first == -2 else (two, one)
            for part in self._parts[own]:
                found.setdefault(part, {})[self.world.geom_address[other]] = None
        return {part: list(addresses) for part, addresses in found.items()}

    def _parts_of(self, geom: int) -> tuple[HandPart, ...]:
        """The parts of the hand to which one of its geoms belongs."""
        side = self.world.robot.finger_side.get(int(self._model.geom_bodyid[geom]))
        if side is None:
            return (HandPart.ALL,)
        return HandPart.ALL, HandPart.FINGERS, (HandPart.LEFT, HandPart.RIGHT)[side]

    def _hand_frames(self) -> tuple[Vector, Vector]:
        """Where bodies and geoms of the hand are, as the fingers stand now: points (k, 3) and
        rotations (k, 3, 3), tool frame.
        """
        data = self._data
        key = data.qpos[self.world.robot.finger_qpos].tobytes()
        if key not in self._hands:
            if len(self._hands) >= MAX_KNOWN:
                self._hands.clear()
            self._show()
            tool, bodies, geoms = self.tool_pose(), self._hand_bodies, self._hand
            points = np.vstack([data.xipos[bodies], data.geom_xpos[geoms]])
            turns = np.vstack([data.ximat[bodies], data.geom_xmat[geoms]]).reshape(-1, 3, 3)
            self._hands[key] = tool.local(points), tool.rotation.T @ turns
        return self._hands[key]


def _either(pairs: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which rows (k,) of pairs (k, 2) hold; ``any`` takes ten times as long for so little."""
    return np.asarray(pairs[:, 0] | pairs[:, 1])

"""The scene as perception knows it: surfaces of its bodies, where they stood last, and the arm."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np

from etot_cli.control.robot import RobotState
from etot_cli.execution.perception.surfaces import Surface, surface_of
from etot_cli.reconstruction.capture.view import Array
from etot_cli.specs.scene import Scene
from etot_cli.world.index import Part, Region
from etot_cli.world.placing import world_at_start
from etot_cli.world.pose import Pose
from etot_cli.world.rest import settle_objects

PAST = 1e-4
"""A ray goes on this far behind a surface that it passes [m], so that it does not meet it again."""
SETTLE_S = 0.8
"""Simulated time for a new scene to come to rest [s]."""


class KnownScene:
    """Shapes, and a state that is only ever set, never stepped.

    Args:
        scene: nominal shapes and poses.

    Raises:
        WorldError: it cannot be built.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.world, self.data = world_at_start(scene)
        self._other = mujoco.MjData(self.world.model)
        settle_objects(self.world, self.data, SETTLE_S)
        self._nominal = {name: self.body(entry.body) for name, entry in self.world.entries.items()}
        model = self.world.model
        moving = {part.body for entry in self.world.entries.values() for part in entry.parts}
        self._moving = {model.body(name).id for name in moving}
        self.surfaces: dict[str, Surface] = {}
        self.part_surfaces: dict[str, Surface] = {}
        for name, entry in self.world.entries.items():
            root = model.body(entry.body).id
            self._add(self.surfaces, name, self._rigid(root), root)
            for part in entry.parts:
                body = model.body(part.body).id
                self._add(self.part_surfaces, f"{name}.{part.info.name}", self._rigid(body), body)
        self.robot_surfaces: dict[int, Surface] = {}
        for body in range(1, model.nbody):
            geoms = np.flatnonzero(model.geom_bodyid == body)
            if len(geoms) and self.world.geom_object[int(geoms[0])] in ("robot", "gripper"):
                found = surface_of(self.world, [body], body)
                if found is not None:
                    self.robot_surfaces[body] = found

    @property
    def free(self) -> list[str]:
        """Objects that may be anywhere."""
        return [name for name, entry in self.world.entries.items() if entry.free]

    @property
    def parts(self) -> Mapping[str, Part]:
        """Movable parts by ``object.part``."""
        return {
            f"{name}.{part.info.name}": part
            for name, entry in self.world.entries.items()
            for part in entry.parts
        }

    @property
    def regions(self) -> list[Region]:
        """Everything that things can be in."""
        return [region for entry in self.world.entries.values() for region in entry.regions]

    def nominal(self, name: str) -> Pose:
        """Where the scene has an object."""
        return self._nominal[name]

    def put(self, name: str, pose: Pose) -> None:
        """Puts an object, or furniture, where it was seen."""
        entry, quaternion = self.world.entries[name], pose.quaternion
        if entry.free:
            joint = self.data.joint(name).qpos
            joint[:3], joint[3:] = pose.position, quaternion
        else:
            body = self.world.model.body(entry.body)
            body.pos[:], body.quat[:] = pose.position, quaternion
        mujoco.mj_kinematics(self.world.model, self.data)

    def body(self, name: str) -> Pose:
        """Where a body stands now."""
        found = self.data.body(name)
        return Pose(found.xpos.copy(), found.xmat.reshape(3, 3).copy())

    def joint_value(self, address: str) -> float:
        """Joint value of a part ``object.part`` now [m or rad]."""
        return float(self.data.joint(self.parts[address].joint).qpos[0])

    def set_part(self, address: str, value: float) -> Pose:
        """Moves a part; where its body stands then."""
        part = self.parts[address]
        self.data.joint(part.joint).qpos[0] = value
        mujoco.mj_kinematics(self.world.model, self.data)
        return self.body(part.body)

    def set_robot(self, state: RobotState) -> None:
        """Puts the arm and the fingers where they are sensed to be."""
        robot = self.world.robot
        self.data.qpos[robot.qpos] = state.joints
        opening = min(max(state.opening, 0.0), robot.spec.gripper.opening)
        robot.set_opening(self.data, opening)
        mujoco.mj_kinematics(self.world.model, self.data)

    def robot_points(self) -> Array:
        """Points (n, 3) on the arm and the hand, base frame."""
        placed = [
            Pose(self.data.xpos[body], self.data.xmat[body].reshape(3, 3)).place(surface.points)
            for body, surface in self.robot_surfaces.items()
        ]
        return np.vstack(placed)

    def tool(self) -> Pose:
        """Where the tool point is."""
        return self._tool_in(self.data)

    def tool_at(self, joints: Sequence[float]) -> Pose:
        """Where the tool point is with other joint values (n,) [rad]."""
        self._other.qpos[self.world.robot.qpos] = joints
        mujoco.mj_kinematics(self.world.model, self._other)
        return self._tool_in(self._other)

    def ahead(self, point: Array, direction: Array, without: str) -> tuple[str | None, float]:
        """What is next on a ray, the robot aside.

        Args:
            point: where the ray begins (3,), base frame [m].
            direction: unit vector (3,).
            without: a body that it passes through.

        Returns:
            Its owner and how far it is [m]; (None, inf) where nothing is.
        """
        mujoco.mj_kinematics(self.world.model, self.data)
        geom, passed = np.array([-1], dtype=np.int32), 0.0
        body = self.world.model.body(without).id
        # A ray enters and leaves each convex geom at most once.
        for _ in range(2 * self.world.model.ngeom):
            start = point + passed * direction
            far = mujoco.mj_ray(self.world.model, self.data, start, direction, None, 1, body, geom)
            if far < 0:
                break
            passed += far
            owner = self.world.geom_object[int(geom[0])]
            if owner not in ("robot", "gripper"):
                return owner, passed
            passed += PAST
        return None, np.inf

    def _tool_in(self, data: mujoco.MjData) -> Pose:
        site = self.world.robot.tool_site
        return Pose(data.site_xpos[site].copy(), data.site_xmat[site].reshape(3, 3).copy())

    def _add(self, into: dict[str, Surface], name: str, bodies: list[int], frame: int) -> None:
        found = surface_of(self.world, bodies, frame)
        if found is not None:
            into[name] = found

    def _rigid(self, root: int) -> list[int]:
        """A body and what hangs on it without being a movable part."""
        model, found = self.world.model, [root]
        for body in range(root + 1, model.nbody):
            if model.body_parentid[body] in found and body not in self._moving:
                found.append(body)
        return found

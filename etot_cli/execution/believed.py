"""The twin as it is believed to be: brought into the state that a look shows.

What the look leaves open is settled by the twin's own physics: an object seen a few millimetres
inside its support, or beside the wall that it leans on, comes to rest where it can be. Relations
(on, inside, in the hand) are read there, never in the world that was looked at.
"""

from __future__ import annotations

import mujoco
import numpy as np

from etot_cli.control.controller import run_motion
from etot_cli.control.physics_world import PhysicsWorld
from etot_cli.control.robot import Guards, RobotState
from etot_cli.control.simulated_robot import SimulatedRobot
from etot_cli.errors import ServiceError, WorldError
from etot_cli.execution.observation import Mark, Observation
from etot_cli.execution.world import away
from etot_cli.skills.belief import Belief, build_twin
from etot_cli.skills.motion.motion import Motion
from etot_cli.specs.scene import Scene
from etot_cli.world.arrays import Vector
from etot_cli.world.recorder import Recorder, Trajectory
from etot_cli.world.relations import initial_memory, read_scene
from etot_cli.world.robot_index import ROBOT_PREFIX
from etot_cli.world.snapshot import Memory, Snapshot, copy_configuration, save
from etot_cli.world.state import SceneState

CREEP_STEPS = 120
"""Physics steps without momentum, in which overlaps come apart and gaps of 4 mm close."""
SETTLE_S = 0.4
"""Time for what then still is not at rest, at most [s]."""
FELL = 0.03
"""What settles this much lower than it was seen hung in the air [m]."""
GRIP_STEPS = 250
"""Physics steps in which the fingers close on what is held: half a second, as a real grip takes."""
HELD_GAP = 0.002
"""Fingers that stay this much further open than they were told hold something [m]."""
JUMP = 0.03
"""Furniture seen this far from where it was has been moved [m] ..."""
TURN = 0.996
"""... or turned: the cosine of half 10 degrees."""
NEAR_FINGERS = 0.025
"""What is held is seen at most this far from both fingers [m]: perception errs by less."""


class BelievedTwin:
    """A twin of a scene that is put into one observed state after another.

    Args:
        scene: what is believed of shapes, masses and frictions.
        seed: of the motions' random choices.

    Raises:
        WorldError: the scene cannot be built.
    """

    def __init__(self, scene: Scene, seed: int) -> None:
        self._physics = PhysicsWorld(scene, seed, keep_frames=False)
        self.world = self._physics.world
        # What is put in place without momentum must not fall asleep there.
        self.world.model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        self.limits = self._physics.limits
        self.scene = scene
        self._twin = build_twin(self.world, self._physics.arm, self._physics.deadline)
        self._data = self._physics.data
        self._believed = mujoco.MjData(self.world.model)
        self._memory: Memory | None = None
        self._fastened: dict[str, tuple[int, Vector, Vector]] = {}

    def see(self, observation: Observation, command: float | None) -> tuple[Snapshot, SceneState]:
        """The twin's state after a look.

        Args:
            observation: what was seen and sensed.
            command: the opening that the gripper was last sent to [m]; None for wide open.

        Returns:
            The stored state, to plan from, and the same state as relations see it.

        Raises:
            ServiceError: nothing was ever seen of a movable object.
        """
        world, data = self.world, self._data
        self._place_fastened(observation)
        self._put(observation)
        held = self._held(observation.robot, command)
        self._settle(observation, held)
        if held is None and (hanging := self._hanging(observation)):
            self._put(observation)
            near = self._near_fingers(hanging)
            self._settle(observation, min(near, key=near.__getitem__, default=None))
        data.time = 0.0
        data.qvel[:] = 0.0
        mujoco.mj_forward(world.model, data)
        if self._memory is None:
            self._memory = initial_memory(world, data)
        scene, self._memory = read_scene(world, data, self._memory)
        return save(world, data, self._memory), scene

    def _settle(self, observation: Observation, held: str | None) -> None:
        """Lets what was seen come to rest, with something in the hand or not."""
        self._put(observation)
        self._hand(observation.robot, closed=held is not None)
        if held is not None:
            self._grip(held)
        self._creep()
        robot = SimulatedRobot(self.world, self._data)
        robot.wait(SETTLE_S, Guards(), until_rest=True)

    def _hanging(self, observation: Observation) -> list[str]:
        """What was seen in the air and fell in the twin. Between fingers it may be held even where
        these are wide open, as what is a little too wide for them stays stuck.
        """
        return [
            name
            for name, entry in self.world.entries.items()
            if entry.free
            and entry.info.movable
            and (seen := observation.objects.get(name)) is not None
            and seen.mark is not Mark.LOST
            and seen.position[2] - float(self._data.body(entry.body).xpos[2]) > FELL
        ]

    def remember(self, memory: Memory) -> None:
        """Takes over what relations remember from the episode's start, for objects known here."""
        known = {name: up for name, up in memory.up.items() if name in self.world.entries}
        own = {} if self._memory is None else self._memory.up
        self._memory = Memory({**own, **known}, memory.toppled, memory.inside, memory.opened)

    @property
    def memory(self) -> Memory | None:
        """What relations remember; None before the first look."""
        return self._memory

    def belief(self, scene: SceneState, salt: str) -> Belief:
        """The state of the last look, to work a motion out in."""
        self._believed.qpos[:] = self._data.qpos
        self._believed.qvel[:] = 0.0
        self._believed.ctrl[:] = self._data.ctrl
        mujoco.mj_forward(self.world.model, self._believed)
        return Belief(self._twin, self._believed, self._physics.random(salt), scene)

    def foresee(self, motion: Motion) -> Trajectory | None:
        """What the twin does with a motion from the state of the last look, for a film of it."""
        data = mujoco.MjData(self.world.model)
        copy_configuration(self._data, data)
        data.ctrl[:] = self._data.ctrl
        mujoco.mj_forward(self.world.model, data)
        recorder = Recorder(self.world, data)
        try:
            run_motion(motion, SimulatedRobot(self.world, data, recorder), self.limits)
        except WorldError:
            return None
        return recorder.trajectory()

    def working_data(self) -> mujoco.MjData:
        """The state of the last look, to be stepped; the next look overwrites it."""
        return self._data

    def _put(self, observation: Observation) -> None:
        world, data = self.world, self._data
        mujoco.mj_resetData(world.model, data)
        robot, sensed = world.robot, observation.robot
        data.qpos[robot.qpos] = sensed.joints
        data.ctrl[robot.ctrl] = sensed.targets
        robot.set_opening(data, min(max(sensed.opening, 0.0), robot.spec.gripper.opening))
        missing = [name for name, item in world.entries.items() if item.free]
        for rank, (name, entry) in enumerate(world.entries.items()):
            for part in entry.parts:
                value = observation.parts.get(f"{name}.{part.info.name}", part.lower)
                low, high = sorted((part.lower, part.upper))
                data.joint(part.joint).qpos[0] = min(max(value, low), high)
            sighting = observation.objects.get(name)
            if not entry.free or sighting is None:
                continue
            missing.remove(name)
            pose = data.joint(name).qpos
            pose[:3], pose[3:] = sighting.position, sighting.quaternion
            if sighting.mark is Mark.LOST:
                pose[:3] = away(rank)
        if missing:
            raise ServiceError(
                f"the first look says nothing of {', '.join(missing)}; expected every object"
            )
        mujoco.mj_forward(world.model, data)

    def _place_fastened(self, observation: Observation) -> None:
        """Puts furniture where the looks so far have it: what is fastened does not move, so their
        mean is better than the last one; after a jump they begin anew.
        """
        model = self.world.model
        for name, entry in self.world.entries.items():
            sighting = observation.objects.get(name)
            if entry.free or sighting is None or sighting.mark is not Mark.SEEN:
                continue
            position, quaternion = np.array(sighting.position), np.array(sighting.quaternion)
            looks, here, turned = self._fastened.get(name, (0, position, quaternion))
            if float(np.linalg.norm(position - here)) > JUMP or abs(turned @ quaternion) < TURN:
                looks, here, turned = 0, position, quaternion
            looks += 1
            here = here + (position - here) / looks
            turned = turned + (quaternion * np.sign(turned @ quaternion) - turned) / looks
            turned /= np.linalg.norm(turned)
            self._fastened[name] = looks, here, turned
            body = model.body(entry.body)
            body.pos[:], body.quat[:] = here, turned

    def _held(self, robot: RobotState, command: float | None) -> str | None:
        """What is in the hand: the object between fingers that did not close as far as told."""
        if command is None or robot.opening < command + HELD_GAP:
            return None
        near = self._near_fingers(
            [name for name, item in self.world.entries.items() if item.free and item.info.movable]
        )
        return min(near, key=near.__getitem__, default=None)

    def _near_fingers(self, names: list[str]) -> dict[str, float]:
        """Those objects that are seen near both fingers, and how far from the farther one [m]."""
        world, data = self.world, self._data
        sides: tuple[list[int], list[int]] = ([], [])
        for geom in range(world.model.ngeom):
            side = world.robot.finger_side.get(int(world.model.geom_bodyid[geom]))
            if side is not None and world.model.geom_contype[geom]:
                sides[side].append(geom)
        near = {
            name: max(
                min(
                    mujoco.mj_geomDistance(world.model, data, one, int(two), 0.1, None)
                    for one in side
                    for two in world.geoms_of(name)
                )
                for side in sides
            )
            for name in names
        }
        return {name: far for name, far in near.items() if far <= NEAR_FINGERS}

    def _hand(self, robot: RobotState, *, closed: bool) -> None:
        """Sends the twin's gripper where the robot's was sent."""
        twin, opening = self.world.robot, 0.0 if closed else robot.opening
        self._data.ctrl[twin.gripper_ctrl] = twin.spec.gripper.command(opening)

    def _grip(self, name: str) -> None:
        """Closes the fingers on what is held, which only gives way between them."""
        world, data = self.world, self._data
        joint = data.joint(name)
        tool = data.site_xmat[world.robot.tool_site].reshape(3, 3)
        left, right = (data.geom_xpos[pad].copy() for pad in world.robot.pads)
        across = left - right
        norm = float(np.linalg.norm(across))
        across = across / norm if norm > 1e-6 else tool[:, 1].copy()
        start = joint.qpos.copy()
        others = np.ones(world.model.nv, dtype=bool)
        others[world.model.joint(name).dofadr[0] + np.arange(6)] = False
        for finger in world.robot.fingers.joints:
            others[world.model.joint(ROBOT_PREFIX + finger).dofadr[0]] = False
        for _ in range(GRIP_STEPS):
            mujoco.mj_step(world.model, data)
            offset = float((joint.qpos[:3] - start[:3]) @ across)
            joint.qpos[:3] = start[:3] + offset * across
            joint.qpos[3:] = start[3:]
            joint.qvel[:3] = float(joint.qvel[:3] @ across) * across
            joint.qvel[3:] = 0.0
            data.qvel[others] = 0.0
        mujoco.mj_forward(world.model, data)

    def _creep(self) -> None:
        """Steps without momentum, so that what overlaps comes apart without being flung away."""
        model, data = self.world.model, self._data
        for _ in range(CREEP_STEPS):
            mujoco.mj_step(model, data)
            data.qvel[:] = 0.0
        if not np.isfinite(data.qpos).all():
            raise WorldError("the twin cannot be brought into the state that was seen")

"""The world that a simulated robot acts in: of its own making, and never the planner's twin.

Poses, sizes, masses, frictions, servo gains, gripper force and delays are drawn from the scene's
``variation``. The planner learns of it by looking, and in no other way.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping

import mujoco
import numpy as np

from etot_cli.control.physics_world import SETTLE_AT_START
from etot_cli.control.robot import Guards
from etot_cli.control.simulated_robot import SimulatedRobot
from etot_cli.skills.motion.kinematics import Arm
from etot_cli.skills.motion.ready import make_ready
from etot_cli.skills.motion.timing import CONTROL_PERIOD
from etot_cli.specs.objects import SceneObject
from etot_cli.specs.scene import Scene
from etot_cli.specs.vary import vary_truth
from etot_cli.world.model import build_world
from etot_cli.world.recorder import Recorder, Trajectory
from etot_cli.world.relations import initial_memory, read_scene
from etot_cli.world.snapshot import Memory
from etot_cli.world.state import SceneState

AWAY = (3.0, 3.0)
"""What is not on the scene waits on the floor there, x y [m]: beyond every desk."""
AWAY_SPACING = 1.0
"""What is away lies this far apart [m], so that nothing touches."""


def away(rank: int) -> tuple[float, float, float]:
    """The place of what is not on the scene, x y z [m], by its place in a list."""
    return (AWAY[0] + AWAY_SPACING * rank, AWAY[1], 0.0)


class ExecutionWorld:
    """A varied scene in one state, which only goes forward.

    Args:
        scene: the nominal scene.
        seed: what is drawn depends on it alone.
        added: objects that will come onto the scene later, by name.
        keep_frames: keep configurations for rendering.

    Raises:
        WorldError: the scene cannot be built.
    """

    def __init__(
        self,
        scene: Scene,
        seed: int,
        added: Mapping[str, SceneObject] | None = None,
        *,
        keep_frames: bool = False,
    ) -> None:
        self.added = dict(added or {})
        varied = vary_truth(scene, seed)
        # The device itself sends what it is told so many control periods later.
        self.delay = round(varied.actuation.delay_s / CONTROL_PERIOD)
        prompt = varied.actuation.model_copy(update={"delay_s": 0.0})
        waiting = {
            name: item.model_copy(update={"on": None, "inside": None, "at": away(rank)})
            for rank, (name, item) in enumerate(self.added.items())
        }
        self.world = build_world(
            varied.model_copy(
                update={"objects": {**varied.objects, **waiting}, "actuation": prompt}
            )
        )
        self.data = mujoco.MjData(self.world.model)
        self.absent = set(waiting)
        self.memory = Memory()
        self.keep_frames = keep_frames
        self.recorder: Recorder | None = None
        self._begin()

    @property
    def time_s(self) -> float:
        """Simulated time since this world began [s]."""
        return float(self.data.time)

    def read(self) -> SceneState:
        """The true state: for the evaluator, and for eyes that add their own error."""
        mujoco.mj_forward(self.world.model, self.data)
        scene, self.memory = read_scene(self.world, self.data, self.memory)
        there = [name for name in scene.states if name not in self.absent]
        return SceneState(
            infos={name: scene.infos[name] for name in there},
            states={name: scene.states[name] for name in there},
            desk_top=scene.desk_top,
            desk_bounds=scene.desk_bounds,
            holding=scene.holding,
            forward=scene.forward,
        )

    def robot(self) -> SimulatedRobot:
        """The arm in it, as it now stands."""
        return SimulatedRobot(self.world, self.data, self.recorder)

    def watch(self) -> None:
        """Begins the record of a motion, where configurations are kept."""
        if self.keep_frames:
            self.recorder = Recorder(self.world, self.data)

    def watched(self) -> Trajectory | None:
        """Configurations since :meth:`watch`."""
        return None if self.recorder is None else self.recorder.trajectory()

    def random(self, *salt: object) -> np.random.Generator:
        """Random numbers that depend on the state and ``salt`` alone."""
        digest = hashlib.sha256(self.data.qpos.tobytes() + "/".join(map(str, salt)).encode())
        return np.random.default_rng(int.from_bytes(digest.digest()[:8], "little"))

    def take_away(self, name: str) -> None:
        """Takes a free object off the scene."""
        rank = list(self.world.entries).index(name)
        joint = self.data.joint(name)
        joint.qpos[:3] = away(rank)
        joint.qvel[:] = 0.0
        self.absent.add(name)
        mujoco.mj_forward(self.world.model, self.data)

    def _begin(self) -> None:
        world, data = self.world, self.data
        make_ready(world, data, Arm(world.robot.spec))
        SimulatedRobot(world, data).wait(SETTLE_AT_START, Guards(), until_rest=True)
        data.time = 0.0
        mujoco.mj_forward(world.model, data)
        self.memory = initial_memory(world, data)

"""Frames of the planner's own world, rendered from what the simulator recorded."""

from __future__ import annotations

import hashlib
import threading
import time
from concurrent.futures import Future

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.control.simulated import Simulated, Simulator, StateToken, WorldOutcome
from etot_cli.reasoning.vlm.chat import KEY_LENGTH, Picture
from etot_cli.reasoning.vlm.frames import SMALLEST_MARKED, Eye, draw_marks, moments
from etot_cli.skills.action import Action
from etot_cli.skills.deadline import NEVER
from etot_cli.specs.scene import Scene
from etot_cli.world.model import build_world
from etot_cli.world.recorder import Trajectory
from etot_cli.world.render import WorldRenderer
from etot_cli.world.state import RolloutRecord, SceneState

NEVER_BEGAN = "Before the action, which never began: no motion was found for it, nothing moved"
DIGEST_DECIMALS = 2
"""Configurations that differ by less show the same picture [m or rad]."""


class NominalOutcomes:
    """Knows what was simulated in the nominal world, by the identity of its record: equal records
    of other worlds are not meant. An outcome is kept, so that its record's identity stays its own.
    """

    def __init__(self) -> None:
        self._outcomes: dict[int, WorldOutcome] = {}
        self._awaited: list[Future[Simulated]] = []
        self._lock = threading.Lock()

    def expect(self, simulated: Future[Simulated]) -> None:
        """An action is being simulated there."""
        with self._lock:
            self._awaited.append(simulated)

    def remember(self, outcome: WorldOutcome) -> None:
        """An action has been simulated there."""
        self._outcomes[id(outcome.record)] = outcome

    def outcome_of(self, record: RolloutRecord) -> WorldOutcome | None:
        """What a record is of; None where that is another world."""
        with self._lock:
            arrived = [item for item in self._awaited if item.done()]
            self._awaited = [item for item in self._awaited if item not in arrived]
            for item in arrived:
                if not item.cancelled() and item.exception() is None:
                    self.remember(item.result().outcomes[0])
        return self._outcomes.get(id(record))

    def knows(self, record: RolloutRecord) -> bool:
        """Whether a record is of the nominal world."""
        return self.outcome_of(record) is not None


class RenderedFrames(NominalOutcomes):
    """Implements :class:`~etot_cli.reasoning.vlm.frames.FrameSource` for the nominal world.

    Args:
        scene: the scene that is planned in.
        width: longest side of a picture [px].

    Raises:
        ServiceError: there is no OpenGL.
        WorldError: the scene cannot be built.
    """

    def __init__(self, scene: Scene, width: int) -> None:
        super().__init__()
        self._world = build_world(scene)
        self._renderer = WorldRenderer(self._world, width, width)
        self.spent_s = 0.0
        """Wall time that frames have taken so far [s]."""
        look = scene.model_dump_json(exclude={"directory", "name", "description"})
        self._base = hashlib.sha256(
            f"{next(iter(scene.cameras), None)}/{width}/{look}".encode()
        ).digest()

    def close(self) -> None:
        """Frees the graphics context; idempotent."""
        self._renderer.close()

    def view(self, scene: SceneState, *, marks: bool = False) -> list[Picture]:
        """The desk in a scene state, the arm at rest."""
        caption = "The desk now" + (", with numbered marks" if marks else "")
        return [self._picture(caption, self._configuration(scene), scene, marks=marks)]

    def marks(self, scene: SceneState) -> dict[int, str]:
        """Numbers in scene order, from 1, of the objects that can be seen."""
        masks = self._renderer.visible_pixels(self._configuration(scene))
        return {
            number: name
            for number, name in enumerate(scene.states, 1)
            if name in masks and int(masks[name].sum()) >= SMALLEST_MARKED
        }

    def eye(self, scene: SceneState) -> Eye:
        """The camera of the pictures."""
        return Eye(*self._renderer.eye(self._configuration(scene)))

    def rollout(
        self, record: RolloutRecord, count: int, *, marks: bool = False, hints: bool = True
    ) -> list[Picture]:
        """Before, key moments, after; empty for an action of another world."""
        outcome = self.outcome_of(record)
        if outcome is None or count <= 0:
            return []
        trajectory = outcome.trajectory
        before = record.before
        if not isinstance(trajectory, Trajectory) or not len(trajectory.times):
            return [self._picture(NEVER_BEGAN, self._configuration(before), before, marks=marks)]
        if len(trajectory.times) == 1:
            return [self._picture(NEVER_BEGAN, trajectory.qpos[0], before, marks=marks)]
        rows = [(0, "Before the action")]
        for moment, what in moments(
            record, trajectory.key_times, trajectory.seconds, max(count - 2, 0), hints=hints
        ):
            rows.append((trajectory.row_at(moment), f"After {moment:.1f} s, {what}"))
        rows.append((len(trajectory.times) - 1, "After the action"))
        return [
            self._picture(what, trajectory.qpos[row], before, marks=marks)
            for row, what in rows[-count:]
        ]

    def _picture(
        self, caption: str, qpos: NDArray[np.floating], scene: SceneState, *, marks: bool
    ) -> Picture:
        pixels = self._frame(qpos)
        if marks:
            numbers = {name: number for number, name in enumerate(scene.states, 1)}
            pixels = draw_marks(pixels, self._renderer.visible_pixels(qpos), numbers)
        return Picture(f"{caption}:", pixels, self._digest(qpos, "marks" if marks else ""))

    def _frame(self, qpos: NDArray[np.floating]) -> NDArray[np.uint8]:
        begun = time.perf_counter()
        try:
            return self._renderer.frame(qpos)
        finally:
            self.spent_s += time.perf_counter() - begun

    def _digest(self, qpos: NDArray[np.floating], extra: str) -> str:
        rounded = np.round(np.asarray(qpos, dtype=np.float64), DIGEST_DECIMALS) + 0.0
        content = self._base + rounded.tobytes() + extra.encode()
        return hashlib.sha256(content).hexdigest()[:KEY_LENGTH]

    def _configuration(self, scene: SceneState) -> NDArray[np.float64]:
        """The configuration (nq,) of a scene state, the arm at rest and the hand open."""
        world = self._world
        data = mujoco.MjData(world.model)
        data.qpos[world.robot.qpos] = world.robot.spec.home
        world.robot.set_opening(data, world.robot.spec.gripper.opening)
        for name, state in scene.states.items():
            entry = world.entries[name]
            if entry.free:
                data.joint(name).qpos[:] = [*state.position, *state.quaternion]
            for part in entry.parts:
                share = state.openness[part.info.name]
                data.joint(part.joint).qpos[0] = part.lower + share * (part.upper - part.lower)
        return np.array(data.qpos)


class Watched:
    """A simulator whose nominal outcomes are remembered."""

    def __init__(self, simulator: Simulator, outcomes: NominalOutcomes) -> None:
        self._simulator = simulator
        self._outcomes = outcomes

    @property
    def jobs(self) -> int:
        """As the simulator's."""
        return self._simulator.jobs

    @property
    def world_count(self) -> int:
        """As the simulator's."""
        return self._simulator.world_count

    def start(self, until_s: float = NEVER) -> tuple[StateToken, SceneState]:
        """As the simulator's."""
        return self._simulator.start(until_s)

    def submit(
        self, state: StateToken, action: Action, until_s: float = NEVER
    ) -> Future[Simulated]:
        """As the simulator's; the outcome can be looked at once it is there."""
        simulated = self._simulator.submit(state, action, until_s)
        self._outcomes.expect(simulated)
        return simulated

    def close(self) -> None:
        """As the simulator's."""
        self._simulator.close()

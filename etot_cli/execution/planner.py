"""The standard planner of the loop: the tree search over the twin, from what is believed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from etot_cli.control.simulator import ActionSimulator, open_simulator
from etot_cli.execution.protocols import Planned
from etot_cli.planning.options import Limits
from etot_cli.planning.result import SearchResult, SearchStatus
from etot_cli.planning.search import search
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Assignment
from etot_cli.skills.action import Action
from etot_cli.skills.motion.motion import Motion
from etot_cli.specs.scene import Scene
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import SceneState

KEPT = 3
"""Twins that are kept: the task's own, and those of scenes onto which something came."""

CAUSES_TOLD = 2
"""Of a search without a plan; the report of ``etot plan`` has all of them."""


@dataclass
class TreePlanner:
    """Implements :class:`etot_cli.execution.protocols.Planner`.

    Args:
        scene: what the twin is built from; the twin is built when it is first needed.
        seed: of the motions' random choices.
        limits: of each search.
    """

    scene: Scene
    seed: int = 0
    limits: Limits = field(default_factory=Limits)
    _simulator: ActionSimulator | None = None

    def plan(
        self, asked: Assignment, start: Snapshot, scene: SceneState, done: Sequence[Action]
    ) -> Planned:
        """Searches for a plan from the believed state."""
        if self._simulator is None:
            self._simulator = open_simulator(
                self.scene, seed=self.seed, jobs=1, worlds=1, record=False
            )
        self._simulator.begin_from(start, scene)
        reasoner = BuiltinReasoner()
        found = search(asked, self._simulator, reasoner, limits=self.limits, costless=True)
        return planned_by(found)

    def close(self) -> None:
        """Ends worker processes; idempotent."""
        if self._simulator is not None:
            self._simulator.close()


def planned_by(result: SearchResult) -> Planned:
    """What a search came to, as the loop takes it.

    Raises:
        KeyboardInterrupt: the search was interrupted.
    """
    if result.status is SearchStatus.INTERRUPTED:
        raise KeyboardInterrupt
    path = () if result.leaf is None else result.leaf.path
    motions = (result.rollouts[node.id].motion for node in path)
    numbers = result.statistics
    return Planned(
        result.plan,
        tuple(motion if isinstance(motion, Motion) else None for motion in motions),
        result.status.value,
        result.stopped or _why_not(result),
        {
            "nodes": float(numbers.nodes_evaluated),
            "reflections": float(numbers.reflections),
            "simulated_s": numbers.simulated_s,
            "wall_s": numbers.wall_s,
            "physics_s": numbers.physics_s,
            "kinematics_s": numbers.kinematics_s,
        },
    )


def _why_not(result: SearchResult) -> str | None:
    """What keeps everything from working, the first things first; None with a plan."""
    if result.status is not SearchStatus.INFEASIBLE:
        return None
    causes = [
        f"{node.action}: {node.verdict.cause.text}"
        for node in result.tree
        if node.verdict is not None and node.verdict.cause is not None
    ]
    said = list(dict.fromkeys(causes))[:CAUSES_TOLD]
    return "nothing that was tried works in the twin" + (f"; {'; '.join(said)}" if said else "")


class TreePlanners:
    """Makes tree planners for scenes, and keeps them: a twin is built once.

    Args:
        seed: of the motions' random choices.
        limits: of each search.
    """

    def __init__(self, *, seed: int = 0, limits: Limits | None = None) -> None:
        self._seed, self._limits = seed, limits or Limits()
        self._made: list[TreePlanner] = []

    def __call__(self, scene: Scene) -> TreePlanner:
        """The planner of a twin of this scene."""
        known = next((planner for planner in self._made if planner.scene == scene), None)
        if known is not None:
            return known
        made = TreePlanner(scene, seed=self._seed, limits=self._limits)
        self._made.append(made)
        for old in self._made[:-KEPT]:
            old.close()
        del self._made[:-KEPT]
        return made

    def close(self) -> None:
        """Ends worker processes; idempotent."""
        for planner in self._made:
            planner.close()

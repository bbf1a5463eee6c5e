"""The planning ideas that are compared, as planners of the closed loop.

A planner sees the believed twin and the instruction, never the world that the robot acts in.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from etot_cli.benchmark.methods.attention import StaticScene
from etot_cli.benchmark.methods.thinking import Thinking
from etot_cli.control.simulated import Simulator
from etot_cli.errors import InstructionError, ServiceError
from etot_cli.execution.planner import planned_by
from etot_cli.execution.protocols import Planned, Planner
from etot_cli.planning.options import Ablation, Limits
from etot_cli.planning.result import LimitKind, SearchStatus
from etot_cli.planning.search import search
from etot_cli.reasoning.protocol import Assignment, Branch, ReasonerStopped, StopReason
from etot_cli.skills.action import Action
from etot_cli.skills.motion.motion import Motion
from etot_cli.world.model import World
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import SceneState


class WorldModel(Simulator, Protocol):
    """A simulator that begins from any believed state."""

    def begin_from(self, start: Snapshot, scene: SceneState) -> None:
        """Searches begin there from now on."""
        ...


@dataclass
class SearchPlanner:
    """Implements :class:`etot_cli.execution.protocols.Planner` by the tree search.

    Args:
        model: what actions are tried in.
        thinking: who proposes, judges and reflects.
        limits: of each search.
        without: mechanisms that the searches go without.
    """

    model: WorldModel
    thinking: Thinking
    limits: Limits
    without: frozenset[Ablation] = frozenset()

    def plan(
        self, asked: Assignment, start: Snapshot, scene: SceneState, done: Sequence[Action]
    ) -> Planned:
        """Searches from the believed state."""
        self.model.begin_from(start, scene)
        result = search(
            asked,
            self.thinking.watch(self.model),
            self.thinking.reasoner,
            limits=self.limits,
            without=self.without,
            costless=self.thinking.costless,
        )
        if result.limit is LimitKind.SERVICE:
            raise ServiceError(result.stopped)
        return planned_by(result)


@dataclass
class OneShotPlanner:
    """Implements the same protocol with one plan that nothing has been tried for.

    Args:
        choose: the plan for what is asked for and a believed state; None where there is none.
    """

    choose: Callable[[Assignment, Snapshot, SceneState], Branch | None]

    def plan(
        self, asked: Assignment, start: Snapshot, scene: SceneState, done: Sequence[Action]
    ) -> Planned:
        """The plan for what is believed now."""
        begun = time.monotonic()
        reason: str | None = None
        branch: Branch | None = None
        try:
            branch = self.choose(asked, start, scene)
        except (InstructionError, ReasonerStopped) as error:
            if isinstance(error, ReasonerStopped) and error.reason is StopReason.SERVICE:
                raise ServiceError(str(error)) from None
            reason = str(error)
        account = {"wall_s": time.monotonic() - begun}
        if branch is None:
            status = SearchStatus.INFEASIBLE.value
            return Planned((), (), status, reason or "no plan was proposed", account)
        motions: tuple[Motion | None, ...] = (None,) * len(branch.actions)
        return Planned(branch.actions, motions, SearchStatus.FEASIBLE.value, None, account)


@dataclass
class RecoveringPlanner:
    """Implements the same protocol: a plan of one's own, then recoveries by an oracle.

    Args:
        first: plans at the beginning.
        oracle: finds a way on from where things are after a failure, where there is one.
    """

    first: Planner
    oracle: Planner

    def plan(
        self, asked: Assignment, start: Snapshot, scene: SceneState, done: Sequence[Action]
    ) -> Planned:
        """The first plan, or a recovery once something has been done."""
        return (self.oracle if done else self.first).plan(asked, start, scene, done)


def at_once(thinking: Thinking) -> OneShotPlanner:
    """One plan from the scene alone."""
    return OneShotPlanner(lambda asked, start, scene: thinking.at_once(asked, scene))


def by_steps(thinking: Thinking, world: World) -> OneShotPlanner:
    """One plan after thinking about dependencies and hazards in the scene as it stands.

    Args:
        thinking: who thinks.
        world: the twin, of which the geometry is read.
    """

    def choose(asked: Assignment, start: Snapshot, scene: SceneState) -> Branch | None:
        return thinking.by_steps(asked, scene, StaticScene(world, start, scene))

    return OneShotPlanner(choose)

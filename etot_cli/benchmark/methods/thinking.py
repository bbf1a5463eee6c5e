"""Who thinks in a trial: a reasoner in one scene, what it is asked, and what that costs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from etot_cli.benchmark.methods.attention import StaticScene, considered
from etot_cli.benchmark.methods.keypoints import shortest, way_of_the_hand
from etot_cli.control.simulated import Simulator
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Assignment, Branch, Reasoner
from etot_cli.world.state import SceneState


class Thinking(Protocol):
    """A reasoner opened for one scene. Close it when done."""

    @property
    def reasoner(self) -> Reasoner:
        """Proposes, judges and reflects."""
        ...

    @property
    def costless(self) -> bool:
        """Whether it costs nothing and answers the same twice."""
        ...

    @property
    def rendering_s(self) -> float:
        """Wall time that pictures have taken so far [s]."""
        ...

    def watch(self, simulator: Simulator) -> Simulator:
        """The simulator to search with, so that it sees what is simulated."""
        ...

    def at_once(self, assignment: Assignment, scene: SceneState) -> Branch | None:
        """One plan from the scene alone; None when there is none."""
        ...

    def by_steps(
        self, assignment: Assignment, scene: SceneState, static: StaticScene
    ) -> Branch | None:
        """One plan after thinking about dependencies and hazards; None when there is none."""
        ...

    def costs(self) -> Mapping[str, float]:
        """Model calls, tokens and dollars so far, by the names in ``COSTS``; empty for none."""
        ...

    def close(self) -> None:
        """Ends connections; idempotent."""
        ...


class BuiltinThinking:
    """The built-in reasoner, which costs nothing."""

    costless = True
    rendering_s = 0.0

    def __init__(self) -> None:
        self.reasoner: Reasoner = BuiltinReasoner()

    def watch(self, simulator: Simulator) -> Simulator:
        """The same: it sees states, not pictures."""
        return simulator

    def at_once(self, assignment: Assignment, scene: SceneState) -> Branch | None:
        """Of the plans that the instruction leaves open, the one with the shortest way."""
        return shortest(self.reasoner.propose(assignment, scene), scene)

    def by_steps(
        self, assignment: Assignment, scene: SceneState, static: StaticScene
    ) -> Branch | None:
        """Of those, corrected by what asks for attention, the one that leaves least open; of
        equals the one with the shortest way.
        """
        proposed = self.reasoner.propose(assignment, scene)
        plans = considered(proposed, static, scene, self.reasoner)
        best = min(
            plans,
            key=lambda item: (item.open_points, way_of_the_hand(item.branch.actions, scene)),
            default=None,
        )
        return None if best is None else best.branch

    def costs(self) -> Mapping[str, float]:
        """Nothing."""
        return {}

    def close(self) -> None:
        """Nothing to end."""

"""A vision-language model as the reasoner of a trial."""

from __future__ import annotations

from collections.abc import Mapping

from etot_cli.benchmark.methods.attention import StaticScene
from etot_cli.reasoning.protocol import Assignment, Branch
from etot_cli.reasoning.vlm.session import VlmSession
from etot_cli.world.state import SceneState


class ModelThinking(VlmSession):
    """Implements :class:`etot_cli.benchmark.methods.thinking.Thinking` with one session."""

    costless = False

    def at_once(self, assignment: Assignment, scene: SceneState) -> Branch | None:
        """The model's plan from one look."""
        return self.one_shot(assignment, scene).at_once()

    def by_steps(
        self, assignment: Assignment, scene: SceneState, static: StaticScene | None = None
    ) -> Branch | None:
        """The model's plan after a description and points of attention of its own."""
        return self.one_shot(assignment, scene).by_steps()

    def costs(self) -> Mapping[str, float]:
        """What has been asked so far."""
        total = self.account().total
        return {
            "model_calls": float(total.requests + total.cached),
            "model_requests": float(total.requests),
            "input_tokens": float(total.input_tokens),
            "output_tokens": float(total.output_tokens),
            "cost": total.cost or 0.0,
        }

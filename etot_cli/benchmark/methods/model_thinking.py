"""A vision-language model as the reasoner of a trial."""

from __future__ import annotations

from collections.abc import Mapping

from etot_cli.benchmark.methods.attention import StaticScene
from etot_cli.control.simulated import Simulator
from etot_cli.reasoning.protocol import Assignment, Branch, Reasoner
from etot_cli.reasoning.vlm.session import VlmSession
from etot_cli.world.state import SceneState


class ModelThinking:
    """Implements :class:`etot_cli.benchmark.methods.thinking.Thinking` with one session.

    Args:
        session: with the model; closed with this.
    """

    checked = True

    def __init__(self, session: VlmSession) -> None:
        self._session = session
        self.reasoner: Reasoner = session.reasoner

    @property
    def rendering_s(self) -> float:
        """Wall time that pictures have taken so far [s]."""
        return self._session.rendering_s

    def watch(self, simulator: Simulator) -> Simulator:
        """The simulator with a witness: the model sees what happens in it."""
        return self._session.watch(simulator)

    def at_once(self, assignment: Assignment, scene: SceneState) -> Branch | None:
        """The model's plan from one look."""
        return self._session.at_once(assignment, scene)

    def by_steps(
        self, assignment: Assignment, scene: SceneState, static: StaticScene
    ) -> Branch | None:
        """The model's plan after a description and points of attention of its own."""
        return self._session.by_steps(assignment, scene)

    def costs(self) -> Mapping[str, float]:
        """What has been asked so far."""
        total = self._session.account().total
        return {
            "model_calls": float(total.requests + total.cached),
            "model_requests": float(total.requests),
            "input_tokens": float(total.input_tokens),
            "output_tokens": float(total.output_tokens),
            "cost": total.cost or 0.0,
        }

    def close(self) -> None:
        """Ends connections and frees the graphics context; idempotent."""
        self._session.close()

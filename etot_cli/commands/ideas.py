"""What the built-in reasoner makes of a task's instruction, before anything is planned."""

from __future__ import annotations

from dataclasses import dataclass

from etot_cli.errors import EtotError
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Assignment
from etot_cli.specs.task import Task
from etot_cli.world.state import SceneState


@dataclass(frozen=True, slots=True)
class Ideas:
    """``state``: the scene at rest; ``plans``: the branches that the instruction is understood as,
    none when it holds already; ``problem``: why it is not understood, empty when it is.
    """

    state: SceneState
    plans: tuple[str, ...]
    problem: str


def ideas(task: Task) -> Ideas:
    """Settles a task's scene and asks how its instruction is understood.

    Raises:
        EtotError: the scene cannot be built.
    """
    from etot_cli.control.simulated_world import SimulatedWorld

    _, state = SimulatedWorld(task.scene).start()
    try:
        branches = BuiltinReasoner().propose(Assignment(task.instruction, task.goal), state)
    except EtotError as error:
        return Ideas(state, (), str(error))
    return Ideas(state, tuple(" ".join(map(str, branch.actions)) for branch in branches), "")

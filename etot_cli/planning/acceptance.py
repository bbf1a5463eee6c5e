"""What a plan has to bring about, beyond actions that succeed: the check by the world's state."""

from __future__ import annotations

from etot_cli.errors import SpecError
from etot_cli.planning.conditions import holds
from etot_cli.reasoning.builtin.acceptance import doubts_of
from etot_cli.reasoning.protocol import Assignment, Checks, Doubts
from etot_cli.specs.wording import describe
from etot_cli.world.state import SceneState


def check_of(assignment: Assignment, start: SceneState, reasoner: object = None) -> Doubts:
    """The check of a plan's last scene: by the formal goal where there is one, else by what the
    reasoner understood, or by the built-in reading of the instruction where it can be read.
    """
    goal = assignment.goal
    if goal is None and isinstance(reasoner, Checks):
        return reasoner.check(assignment, start)
    if goal is None:
        return doubts_of(assignment, start)

    def formal(scene: SceneState) -> str:
        try:
            missing = [describe(item) for item in goal if not holds(item, scene)]
        except SpecError as error:
            return str(error)
        return f"the goal does not hold then: {'; '.join(missing)}" if missing else ""

    return formal

"""What is asked for, as goals: read once, from the first look at the scene."""

from __future__ import annotations

from etot_cli.reasoning.builtin.conditions import goals_of
from etot_cli.reasoning.builtin.goal import Goal
from etot_cli.reasoning.protocol import Assignment
from etot_cli.world.state import SceneState


def goals_for(assignment: Assignment, scene: SceneState) -> tuple[Goal, ...]:
    """Alternative goals, the preferred one first.

    An instruction is read in the scene that it was given in; conditions name their objects, and are
    to become true of the scene at hand.

    Raises:
        InstructionError: the assignment cannot be understood.
    """
    if assignment.goal is not None:
        return goals_of(assignment.goal, scene)
    # The grammar needs the parser, which only those who read should pay for.
    from etot_cli.reasoning.language.instructions import goal_of

    return (goal_of(assignment.instruction, assignment.given_in(scene)),)

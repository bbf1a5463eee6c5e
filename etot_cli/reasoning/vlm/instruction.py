"""The task as a model is told of it, at first and when it is planned for again."""

from __future__ import annotations

from etot_cli.reasoning.protocol import Assignment
from etot_cli.reasoning.vlm import describe
from etot_cli.specs.wording import describe as describe_condition
from etot_cli.world.state import SceneState


def instruction_of(assignment: Assignment) -> str:
    """The task in words; a formal goal is written out."""
    if assignment.goal is None:
        return assignment.instruction
    return "Reach this state: " + "; ".join(describe_condition(item) for item in assignment.goal)


def as_given(assignment: Assignment, understanding: str = "") -> str:
    """The task in words, with the arrangement that they were said of where that is a past one.

    Args:
        assignment: what is asked for, and what has been seen since.
        understanding: what the model took it for when it was given.
    """
    words = instruction_of(assignment)
    if not assignment.past or assignment.goal is not None:
        return words
    first = assignment.past[0]
    lines = [
        words,
        "",
        "That was said before the robot began, of this arrangement (sizes and positions in cm):",
        *(_line(first, name) for name in first.states),
        "Names and descriptions in the task mean the objects that fitted them there, wherever they "
        "are by now, and no others that have come since. What has been reached since then is not "
        "to be done again.",
    ]
    if understanding:
        lines.append(f"It was then understood as: {understanding}")
    return "\n".join(lines)


def _line(first: SceneState, name: str) -> str:
    entry = describe.entry(first.infos[name], first.states[name])
    return f"- {entry}, {describe.states(first, name)}"

"""From an instruction's text to a goal about a scene, or a message that helps to reword it."""

from __future__ import annotations

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.goal import Goal
from etot_cli.reasoning.builtin.interpretation import interpret
from etot_cli.reasoning.builtin.matching import ReferenceProblem
from etot_cli.reasoning.builtin.reader import UnreadableError, normalized, read
from etot_cli.reasoning.builtin.vocabulary import Vocabulary
from etot_cli.world.state import SceneState

EXAMPLES = (
    "Pick up the red ball.",
    "Put a pen into one of the cups.",
    "Open the top drawer, put the bowl inside and close it.",
    "Put both blocks in either the drawer or the bowl, together or separately.",
    "Make sure the door is closed.",
)
"""Shown with every message; ``docs/instructions.md`` describes the whole language."""


def goal_of(instruction: str, scene: SceneState) -> Goal:
    """Reads an instruction.

    Args:
        instruction: controlled English, as described in ``docs/instructions.md``.
        scene: what it is about.

    Raises:
        InstructionError: what could not be understood and what can be done about it.
    """
    vocabulary = Vocabulary(scene)
    try:
        sentences = read(vocabulary.joined(normalized(instruction)), vocabulary.words())
    except UnreadableError as error:
        raise InstructionError(_unreadable(error)) from None
    try:
        return interpret(sentences, scene, vocabulary)
    except ReferenceProblem as error:
        raise InstructionError(_unresolved(error, instruction)) from None


def _unreadable(error: UnreadableError) -> str:
    lines = [f"cannot read the instruction at {error.words!r}"]
    if error.why:
        lines[0] += f": {error.why}"
    lines.append(f"  understood up to there: {error.understood or 'nothing'}")
    return "\n".join([*lines, *_ways_out()])


def _unresolved(error: ReferenceProblem, instruction: str) -> str:
    return "\n".join(
        [
            f"cannot tell what {error.phrase!r} means in the instruction: {error.why}",
            f"  the sentence itself was understood: {' '.join(instruction.split())}",
            *_ways_out(),
        ]
    )


def _ways_out() -> list[str]:
    return [
        "  what is understood, for example:",
        *(f"    {example}" for example in EXAMPLES),
        "  or write the goal as conditions under 'goal:' in the task file, or let a model read it "
        "with --reasoner vlm",
    ]

"""What is in the hand at the start, told by that: "what you are holding"."""

from __future__ import annotations

import re

from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.world.state import SceneState

_HAND = r"in (?:your|the) (?:hand|gripper)"
_YOU = r"(?:you|the robot|the arm)"
_HOLDING = (
    rf"(?:{_YOU}(?: (?:are|is)| ?['’]re|'s) (?:(?:now|currently|already|still) )?holding"
    rf"(?: {_HAND}| right now| now)?"
    rf"|{_YOU} (?:(?:now|currently|already) )?(?:holds?|have|has) (?:got )?{_HAND}"
    rf"|(?: ?['’]s|is|lies) (?:(?:now|currently|already) )?{_HAND}(?: right now| now)?)"
)
_HELD = Expression(
    rf"\b(?:what(?:ever)?|the (?:thing|object|item)(?: that| which)?) ?{_HOLDING}(?!\w)",
    re.IGNORECASE,
)
_CHANGED = Expression(
    r"\b(?:pick|take|grab|get|fetch|grasp|lift|put|place|drop|release|set|bring|move|hold|swap)\b"
    r".*(?:[.,;:!\n]|\b(?:and|then|before|after)\b)",
    re.IGNORECASE | re.DOTALL,
)
"""What is done before with what is in the hand, or taken into it."""
_ASKED = Expression(r"(?:^|[.;!] )(?:tell me |say |show me )?what [^.;!]*\?", re.IGNORECASE)


def with_held_named(instruction: str, scene: SceneState) -> str:
    """An instruction in which what is in the hand at its start is called by its name.

    Raises:
        ReferenceProblem: nothing is, or something else may be by then.
    """
    found = _HELD.search(instruction)
    if found is None or _ASKED.search(instruction):
        return instruction
    if scene.holding is None:
        raise ReferenceProblem(found[0], "the hand is empty", 3)
    if _CHANGED.search(instruction[: found.start()]):
        raise ReferenceProblem(found[0], "the hand may hold something else by then; name it", 3)
    return _HELD.sub(f"the {scene.holding.replace('_', ' ')}", instruction)

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
    rf"\b(?:(?:what(?:ever)?|the (?:thing|object|item)(?: that| which)?) ?{_HOLDING}"
    r"|the (?:grasped|gripped|held) (?P<noun>\w+)(?= (?:in|on|into|onto|to|down|back|next|beside"
    r"|behind|between|inside|there|at)\b|[.,;!?]|$))(?!\w)",
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
    noun = (found["noun"] or "object").casefold()
    changed = _CHANGED.search(instruction[: found.start()])
    if found["noun"] and changed:
        return instruction  # it was picked up before
    if scene.holding is None:
        raise ReferenceProblem(found[0], "the hand is empty", 3)
    if changed:
        raise ReferenceProblem(found[0], "the hand may hold something else by then; name it", 3)
    called = {*scene.holding.split("_"), *scene.infos[scene.holding].label.split()}
    if noun not in {"object", "thing", "item", *called}:
        raise ReferenceProblem(found[0], f"the hand holds {scene.holding}", 3)
    return _HELD.sub(f"the {scene.holding.replace('_', ' ')}", instruction)

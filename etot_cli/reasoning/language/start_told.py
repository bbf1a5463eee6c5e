"""Instructions that tell how things are at the start before they say how they are to be."""

from __future__ import annotations

import re

from msgspec import Struct

from etot_cli.reasoning.language.words.expressions import Expression

_STATE = "(?:state|configuration|situation|set-?up|scene|conditions?|arrangement|layout)"
_GOAL = (
    r"(?:the )?(?:[a-z]+ )?(?:goal|desired|target|final|end|task|required|wanted|intended|expected"
    rf"|results?|outcome|actions?)(?: (?:{_STATE}|results?|outcome))?(?: is)?\s*:"
)
_START = Expression(
    r"(?P<before>^|[.;!\n]\s*)(?:the )?"
    rf"(?:(?:initial|start(?:ing)?|current|present|original) {_STATE}|start|initially|currently"
    r"|pre-?conditions?(?=\s*:[^.;:\n]+[.;\n]\s*actions?\s*:))"
    rf"\s*:\s*(?P<told>[\s\S]+?)(?:[.;!\n]\s*(?=(?P<goal>{_GOAL}))|[.;!\s]*$)",
    re.IGNORECASE,
)
"""How things are up to where it is said how they are to be, or to the end."""
_GOAL_BEFORE = Expression(rf"(?:^|[.;!\n]\s*){_GOAL}", re.IGNORECASE)


class StartTold(Struct, frozen=True):
    """What an instruction says is so at the start, and what it asks for."""

    start: str
    asked: str
    is_condition: bool
    """Whether it may be what all else hangs on ("initial condition: …")."""


def without_start(instruction: str) -> StartTold | None:
    """An instruction without how things are at the start; None where it does not say that, or has
    no heading for what is to be so, from which alone it is told where that ends.
    """
    found = _START.search(instruction)
    if found is None:
        return None
    before = instruction[: found.start()] + found["before"]
    if found["goal"] is None and _GOAL_BEFORE.search(before) is None:
        return None
    asked = before + instruction[found.end() :]
    return StartTold(found["told"].strip(), asked, "condition" in found[0].casefold())

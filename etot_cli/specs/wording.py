"""Conditions in words, for prompts, reports and messages."""

from __future__ import annotations

from etot_cli.specs.task import Condition


def describe(condition: Condition) -> str:
    """A condition in words, e.g. ``cup on desk`` or ``not (lid open)``."""
    if condition.any is not None:
        return " or ".join(f"({describe(part)})" for part in condition.any)
    if condition.all is not None:
        return " and ".join(f"({describe(part)})" for part in condition.all)
    if condition.not_ is not None:
        return f"not ({describe(condition.not_)})"
    for relation in ("on", "inside"):
        pair = getattr(condition, relation)
        if pair is not None:
            return f"{pair[0]} {relation} {pair[1]}"
    for state in ("in_hand", "open", "closed", "upright", "present"):
        name = getattr(condition, state)
        if name is not None:
            return f"{name} {state.replace('_', ' ')}"
    return "nothing"

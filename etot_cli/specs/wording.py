"""Conditions in words, for prompts, reports and messages."""

from __future__ import annotations

from etot_cli.specs.task import Condition


def describe(condition: Condition) -> str:
    """A condition in words, e.g. ``cup on desk``, ``cup left of box`` or ``not (lid open)``."""
    (key,) = condition.model_fields_set
    said, value = key.replace("_", " "), getattr(condition, key)
    match key:
        case "any" | "all":
            joint = " or " if key == "any" else " and "
            return joint.join(f"({describe(part)})" for part in value)
        case "not_":
            return f"not ({describe(value)})"
        case "between":
            return "{} between {} and {}".format(*value)
        case "at" if not isinstance(value[1], str):
            return f"{value[0]} at {value[1][0]:g} {value[1][1]:g}"
    return f"{value} {said}" if isinstance(value, str) else f"{value[0]} {said} {value[1]}"

"""JSON Schemas of the answers, in the subset that strict servers accept: everything required.

Models write the fields in this order, so what is seen and why comes before what follows from it.
"""

from __future__ import annotations

from typing import Any

from etot_cli.skills.action import Verb


def _object(**fields: Any) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": fields,
        "required": list(fields),
        "additionalProperties": False,
    }


def _list(items: Any) -> dict[str, Any]:
    return {"type": "array", "items": items}


def _one_of(*values: str) -> dict[str, Any]:
    return {"type": "string", "enum": list(values)}


_TEXT: dict[str, Any] = {"type": "string"}
_STEP = _object(
    action=_one_of(*(verb.value for verb in Verb)),
    object=_TEXT,
    pose=_one_of("any", "horizontal", "vertical"),
    note=_TEXT,
)
_STATES = _list(_object(object=_TEXT, state=_TEXT))

SCENE = _object(seen=_TEXT, objects=_STATES, understanding=_TEXT)
BRANCHES = _object(
    reasoning=_TEXT,
    branches=_list(_object(reason=_TEXT, steps=_list(_STEP))),
    goal_holds={"type": "boolean"},
)
COMPARISON = _object(
    before=_STATES,
    after=_STATES,
    explanation=_TEXT,
    outcome=_one_of("success", "failure", "unsafe", "unsure"),
)
REVISION = _object(diagnosis=_TEXT, steps=_list(_STEP))
VERDICT = _object(reason=_TEXT, verdict=_one_of("yes", "no"))

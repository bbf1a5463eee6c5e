"""Where a command's time went, in parts that add up to the whole."""

from __future__ import annotations

from typing import Any

from etot_cli.reporting.models import TimingModel

PHASE_WORDS = {
    "load": "reading files",
    "world": "building the world",
    "search": "searching",
    "simulate": "simulating",
    "execute": "executing",
    "render": "rendering",
    "reconstruct": "reconstructing",
    "write": "writing files",
    "trials": "trying the plan in varied worlds",
}
SMALLEST_S = 0.005
"""Shorter parts are not worth a line [s]."""


def _simulating(wall_s: float, statistics: object) -> list[dict[str, Any]]:
    """The time of simulating, shared out as the processes shared theirs, which run side by side."""
    physics = getattr(statistics, "physics_s", 0.0)
    kinematics = getattr(statistics, "kinematics_s", 0.0)
    worked = physics + kinematics
    if worked <= 0.0:
        return [{"name": "simulating", "seconds": wall_s, "note": ""}]
    return [
        {"name": "physics", "seconds": wall_s * physics / worked, "note": "stepping"},
        {
            "name": "inverse kinematics",
            "seconds": wall_s * kinematics / worked,
            "note": "grasps, places and ways",
        },
    ]


def time_parts(timing: TimingModel, statistics: object = None) -> dict[str, Any]:
    """What the template's time bar takes: ``time_parts`` and ``time_total``."""
    phases = dict(timing.phases)
    parts: list[dict[str, Any]] = []
    search = phases.get("search")
    reasoning = getattr(statistics, "reasoning_s", None)
    if search is not None and reasoning is not None:
        del phases["search"]
        parts.append({"name": "reasoning", "seconds": reasoning, "note": ""})
        parts += _simulating(max(0.0, search - reasoning), statistics)
    for name, seconds in phases.items():
        parts.append({"name": PHASE_WORDS.get(name, name), "seconds": seconds, "note": ""})
    rest = timing.wall_s - sum(part["seconds"] for part in parts)
    parts.append({"name": "other", "seconds": max(0.0, rest), "note": ""})
    parts = [part for part in parts if part["seconds"] >= SMALLEST_S]
    return {"time_parts": parts, "time_total": sum(part["seconds"] for part in parts)}

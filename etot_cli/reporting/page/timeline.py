"""Where a command's time went, in parts that add up to the whole."""

from __future__ import annotations

from typing import Any

from etot_cli.reporting.models import TimingModel

PHASE_WORDS = {
    "load": "reading files",
    "world": "building the world",
    "search": "searching",
    "simulate": "simulating",
    "render": "rendering",
    "reconstruct": "reconstructing",
    "write": "writing files",
}
SHARES = (
    ("physics_s", "physics"),
    ("motion_s", "grasps, paths and inverse kinematics"),
    ("reasoning_s", "reasoning"),
)
"""Parts of the search where the statistics tell them apart."""
SMALLEST_S = 0.005
"""Shorter parts are not worth a line [s]."""


def time_parts(timing: TimingModel, statistics: object = None) -> dict[str, Any]:
    """What the template's time bar takes: ``time_parts`` and ``time_total``."""
    phases = dict(timing.phases)
    parts: list[dict[str, Any]] = []
    search = phases.get("search")
    shares = [(word, getattr(statistics, field, None)) for field, word in SHARES]
    known = [(word, float(value)) for word, value in shares if value is not None]
    if search is not None and known:
        del phases["search"]
        spent = sum(value for _, value in known)
        parts += [{"name": word, "seconds": value, "note": ""} for word, value in known]
        parts.append(
            {"name": "searching, waiting", "seconds": max(0.0, search - spent), "note": ""}
        )
    for name, seconds in phases.items():
        parts.append({"name": PHASE_WORDS.get(name, name), "seconds": seconds, "note": ""})
    rest = timing.wall_s - sum(part["seconds"] for part in parts)
    parts.append({"name": "other", "seconds": max(0.0, rest), "note": ""})
    parts = [part for part in parts if part["seconds"] >= SMALLEST_S]
    return {"time_parts": parts, "time_total": sum(part["seconds"] for part in parts)}

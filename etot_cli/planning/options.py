"""What bounds a search and what may be switched off; free of heavy imports for the command line."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

DEFAULT_MAX_NODES = 200
"""About ten times what a seven-step task with a dozen branches needs."""
DEFAULT_REVISIONS = 8
"""A plan that eight corrections in a row did not save is better tried along another branch."""
DEFAULT_MIN_SURVIVAL = 0.5
"""An action that fails in most varied worlds is a gamble, whatever the nominal world says."""


class Ablation(StrEnum):
    """A mechanism that a search can go without (the paper's ablation study)."""

    PRIORI = "priori"
    """Only the first proposed branch is kept."""
    REFLECTIVE = "reflective"
    """Failed branches are dropped, never revised."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """Bounds of one search; which one stopped it is in the result."""

    max_nodes: int = DEFAULT_MAX_NODES
    """Actions to simulate at most."""
    time_limit_s: float | None = None
    """Wall-clock time from the start of the search; None for none [s]."""
    revisions_per_branch: int = DEFAULT_REVISIONS
    """Reflections in a row between a priori branch and its last revision."""
    min_survival: float = DEFAULT_MIN_SURVIVAL
    """Share of the worlds still alive that an action must succeed in, besides the nominal one."""

"""What bounds a search and what may be switched off; free of heavy imports for the command line."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

DEFAULT_MAX_NODES = 200
"""About ten times what a seven-step task with a dozen branches needs."""
DEFAULT_REVISIONS = 8
"""A plan that eight corrections in a row did not save is better tried along another branch."""
DEFAULT_CORRECTIONS = 12
"""Of one failed step: more than a crowded desk has objects in the way of one action."""
DEFAULT_MAX_REFLECTIONS = 1000
"""Reflecting costs milliseconds; five per action that may be simulated is going in circles."""
BRANCHES_AT_ONCE = 64
"""Proposed branches that enter the tree together; the next ones follow when all of them failed."""
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
    corrections_per_failure: int = DEFAULT_CORRECTIONS
    """Corrections of one branch after one failure that are looked at."""
    max_reflections: int = DEFAULT_MAX_REFLECTIONS
    """Failures of branches that the reasoner is asked about."""
    min_survival: float = DEFAULT_MIN_SURVIVAL
    """Share of all worlds that must still be alive after an action, besides the nominal one."""

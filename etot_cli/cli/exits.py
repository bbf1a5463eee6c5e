"""Exit codes; part of the contract with scripts."""

from __future__ import annotations

OK = 0
"""It worked."""
NO = 1
"""It ran, and the answer is no."""
UNUSABLE = 2
"""Unusable input."""
MISSING = 3
"""A service or device that is needed is not there."""
INTERNAL = 70
"""A defect of this program (EX_SOFTWARE of sysexits.h)."""
INTERRUPTED = 130
"""Stopped by Ctrl-C, SIGTERM or SIGHUP: 128 + SIGINT, as shells say of the first."""

"""Bounds that documents and the command line share; free of imports: ``--help`` is quick."""

MAX_WORLDS = 1000
"""Varied worlds that a plan can be tried in."""
MAX_TRIALS = 10_000
"""Trials of one method on one task; their interval is then within one point of the rate."""

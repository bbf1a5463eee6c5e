"""Bounds that documents and the command line share; free of imports: ``--help`` is quick."""

MAX_WORLDS = 1000
"""Varied worlds that a plan can be tried in."""

"""Random problems that are solvable by construction.

Free floor, widths, clearances and reach decide; nothing here asks the simulator or the planner, and
:mod:`.margins` states what is taken for granted.
Each problem is a task with the plan that a person would give.
"""

from etot_cli.benchmark.problems.catalogue import FAMILIES, problem
from etot_cli.benchmark.problems.problem import Problem

__all__ = ["FAMILIES", "Problem", "problem"]

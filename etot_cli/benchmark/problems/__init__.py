"""Random problems that are solvable, or not, by construction.

Free floor, widths, clearances and reach decide; nothing here asks the simulator or the planner, and
:mod:`.margins` states what is taken for granted.
Each problem is a task with the plan that a person would give, or with the reason why there is none.
"""

from etot_cli.benchmark.problems.catalogue import FAMILIES, INFEASIBLE, problem, problems
from etot_cli.benchmark.problems.problem import Problem, Reason

__all__ = ["FAMILIES", "INFEASIBLE", "Problem", "Reason", "problem", "problems"]

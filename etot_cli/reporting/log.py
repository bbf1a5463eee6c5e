"""Progress as plain lines, for logs and pipes: one line per verdict."""

from __future__ import annotations

from etot_cli.planning.result import SearchObserver
from etot_cli.planning.tree import FAILED, NodeStatus, PlanNode, PlanTree
from etot_cli.reasoning.protocol import Branch
from etot_cli.reporting.simulate_report import StepModel
from etot_cli.reporting.style import Lines, counted, symbol
from etot_cli.skills.action import Action, format_plan


class PlainLog(Lines, SearchObserver):
    """Writes one line per event; observes searches and simulations. ``detailed``: also what is
    tried, what was proposed, and what changed.
    """

    def proposed(self, tree: PlanTree) -> None:
        """Says how large the first tree is."""
        branches = sum(node.end is not None for node in tree)
        self._say(f"{counted(branches, 'branch')} proposed, {counted(len(tree), 'node')}")
        if self._detailed:
            for node in tree:
                if node.end is not None:
                    self._say(f"  {format_plan(node.actions)}  {node.end.reason}".rstrip())

    def started(self, node: PlanNode) -> None:
        """Says what is tried, in detail only."""
        if self._detailed:
            self._say(f"node {node.id}: simulating {format_plan(node.actions)}")

    def judged(self, node: PlanNode) -> None:
        """Says the verdict."""
        line = f"{symbol(node.status.value, self._unicode)} {format_plan(node.actions)}"
        verdict = node.verdict
        if node.status in FAILED:
            line += f"  {node.status.value}"
            if verdict is not None and verdict.cause is not None:
                line += f": {verdict.cause.text}"
        if node.status is NodeStatus.SUCCESS and node.losses and node.survived is not None:
            line += f"  ({counted(len(node.survived), 'world')} left)"
        if self._detailed and verdict is not None:
            changed = ", ".join(verdict.changes) or "nothing"
            line += f"  [{node.simulated_s:.1f} s simulated, changed: {changed}]"
        self._say(line)

    def revised(self, node: PlanNode, branch: Branch | None) -> None:
        """Says what the reasoner made of the failure, in detail only."""
        if self._detailed and branch is None:
            self._say("  no revision")
        elif self._detailed and branch is not None:
            self._say(f"  revised: {format_plan(branch.actions)}  {branch.reason}".rstrip())

    def step_started(self, index: int, action: Action, total: int) -> None:
        """Says what is tried, in detail only."""
        if self._detailed:
            self._say(f"step {index + 1} of {total}: simulating {action}")

    def step_judged(self, step: StepModel) -> None:
        """Says the verdict."""
        line = f"{symbol(step.status, self._unicode)} {step.action}"
        if step.status != "success":
            line += f"  {step.status}"
            if step.cause is not None:
                line += f": {step.cause.text}"
        if self._detailed:
            changed = ", ".join(step.changes) or "nothing"
            line += f"  [{step.simulated_s:.1f} s simulated, changed: {changed}]"
        self._say(line)

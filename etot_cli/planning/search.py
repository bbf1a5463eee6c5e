"""The search: the paper's Algorithm 1, "Planning Tree Construction and Search".

Breadth first: simulate a node from its parent's end state, judge it, go on with its children; on a
failure, take it out of the tree and let the reasoner revise every branch that ran through it.
What goes beyond the algorithm (alternatives, several worlds, known failures, limits) is told in
docs/plan.md.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Iterator
from dataclasses import replace
from itertools import islice

from etot_cli.control.simulated import Simulator
from etot_cli.errors import InstructionError, UnsatisfiableError
from etot_cli.planning.acceptance import check_of
from etot_cli.planning.alternatives import Corrections, best_prefix
from etot_cli.planning.findings import Findings
from etot_cli.planning.lookahead import Lookahead
from etot_cli.planning.options import BRANCHES_AT_ONCE, Ablation, Limits
from etot_cli.planning.result import (
    LimitKind,
    SearchObserver,
    SearchResult,
    SearchStatus,
    told,
)
from etot_cli.planning.tree import NodeStatus, Origin, PlanNode, PlanTree, TreePath
from etot_cli.planning.waiting import Waiting
from etot_cli.reasoning.builtin.openings import kept_open
from etot_cli.reasoning.protocol import (
    Assignment,
    Branch,
    Outcome,
    Reasoner,
    ReasonerStopped,
    StopReason,
    Verdict,
)
from etot_cli.skills.action import Action
from etot_cli.skills.deadline import NEVER, OutOfTimeError
from etot_cli.world.state import CauseKind, RolloutRecord, SceneState

FORESEEN = 4
"""Branches through one failure whose corrections are worked out ahead: jobs are few, and the first
corrections come first in the queue."""


def search(
    assignment: Assignment,
    simulator: Simulator,
    reasoner: Reasoner,
    *,
    limits: Limits | None = None,
    without: frozenset[Ablation] = frozenset(),
    observer: SearchObserver | None = None,
    costless: bool = False,
) -> SearchResult:
    """Looks for a plan that works in the simulator from its first action to its last.

    Ctrl-C (KeyboardInterrupt) does not escape: it ends the search with status ``interrupted``. Nor
    does a reasoner that cannot go on, or that understands what nothing can bring about: the result
    says why it stopped.

    Args:
        assignment: what is asked for.
        simulator: opened on the scene; the caller closes it.
        reasoner: proposes, judges and reflects.
        limits: bounds; the defaults when None.
        without: mechanisms to switch off.
        observer: told of every step.
        costless: the reasoner costs nothing and answers the same twice. So it is asked how it would
            correct failures whose turn has not come, where jobs would be idle; that changes nothing
            but the time. And where a plan works and is not what was asked for, it is asked what is
            still to be done then.

    Raises:
        InstructionError: the assignment cannot be understood against the scene.
    """
    run = _Search(
        assignment, simulator, reasoner, limits or Limits(), without, observer or SearchObserver(),
        costless=costless,
    )  # fmt: skip
    return run.result()


class _Search:
    """One run of the algorithm; the names in capitals of the paper are given in brackets."""

    def __init__(
        self,
        assignment: Assignment,
        simulator: Simulator,
        reasoner: Reasoner,
        limits: Limits,
        without: frozenset[Ablation],
        observer: SearchObserver,
        *,
        costless: bool,
    ) -> None:
        self._assignment = assignment
        self._simulator = simulator
        self._reasoner = reasoner
        self._limits = limits
        self._without = without
        self._observer = observer

        self._tree = PlanTree()  # [T]
        self._queue = Waiting(shortest_first=assignment.goal is not None)  # [Q]
        self._known = Findings(reasoner, simulator.world_count, limits.min_survival)
        self._started = time.monotonic()
        seconds = limits.time_limit_s
        self._until_s = NEVER if seconds is None else self._started + seconds
        self._costless = costless
        ahead = self._foresee if costless and Ablation.REFLECTIVE not in without else None
        self._lookahead = Lookahead(simulator, self._known.start_of, self._until_s, ahead)
        self._proposals: Iterator[Branch] = iter(())
        self._branches: list[Branch] = []
        self._untried: deque[Corrections] = deque()
        self._reflected: set[tuple[int, tuple[Action, ...]]] = set()
        self._limit: LimitKind | None = None
        self._cut: LimitKind | None = None
        self._stopped = ""

    def result(self) -> SearchResult:
        """Runs the search to its end, whatever that is."""
        interrupted = False
        try:
            self._run()
        except KeyboardInterrupt:
            interrupted = True
        except ReasonerStopped as stop:
            self._stopped = str(stop)
            # A reasoner without an answer has given up; any other reason is a limit.
            if stop.reason is not StopReason.NO_ANSWER:
                self._limit = LimitKind(stop.reason.value)
        except UnsatisfiableError as error:
            self._stopped = str(error)
        except OutOfTimeError:
            self._limit = LimitKind.TIME
        finally:
            self._lookahead.cancel()
        known = self._known
        if not known.found:
            self._limit = self._limit or self._cut
        known.statistics.wall_s = time.monotonic() - self._started
        result = SearchResult(
            status=self._status(interrupted),
            leaf=known.best,
            tree=self._tree,
            statistics=known.statistics,
            branches=tuple(self._branches),
            goal_holds=known.goal_holds,
            survival=known.survival(),
            limit=self._limit,
            rollouts=known.rollouts,
            stopped=self._stopped or told(self._limit, self._limits),
            prefix=None if known.found else best_prefix(self._tree),
            final=known.final(),
            doubts=known.doubts,
        )
        self._observer.finished(result)
        return result

    def _run(self) -> None:
        state, scene = self._simulator.start(self._until_s)
        self._known.begin(state, scene)
        self._branch_a_priori(scene)
        self._observer.proposed(self._tree)
        while self._queue or self._widen():
            node = self._queue.pop()
            if not self._known.can_beat_best(node):
                continue
            self._limit = self._limit_reached()
            if self._limit is not None:
                return
            self._observer.started(node)
            simulated = self._lookahead.fetch(
                node,
                (ahead for ahead in self._queue if self._known.can_beat_best(ahead)),
                allowance=self._limits.max_nodes - self._known.statistics.nodes_evaluated,
            )
            self._known.judge(node, simulated)
            self._observer.judged(node)
            if node.status is NodeStatus.SUCCESS:
                self._queue.extend(node.live_children)
                if node.end is not None:
                    self._offer(node)
            else:
                self._revise(node)

    def _branch_a_priori(self, scene: SceneState) -> None:
        """[PrioriBranching] Builds the initial tree."""
        self._proposals = iter(self._reasoner.propose(self._assignment, scene))
        if Ablation.PRIORI in self._without:
            self._proposals = islice(self._proposals, 1)
        # A model may propose anything. And what is beside something in the end is only seen then.
        self._known.check = check_of(self._assignment, scene, self._reasoner)
        self._propose()
        self._known.goal_holds = not self._branches and self._known.does_it((), scene)

    def _propose(self) -> bool:
        """Takes the next of the proposed branches into the tree; False where there are no more."""
        count = len(self._branches)
        try:
            for branch in islice(self._proposals, BRANCHES_AT_ONCE):
                self._branches.append(branch)
                self._insert(TreePath(branch, 0), Origin.PRIORI)
        except ReasonerStopped as stop:
            self._note_cut(stop)
        return len(self._branches) > count

    def _widen(self) -> bool:
        """Takes up what was left aside, now that all in the queue has failed; False at the end.

        First the proposed branches that have not entered the tree yet, then the next corrections
        of every failure in turn, each time one.
        """
        if self._known.found:
            return False
        more = True
        while more and not self._queue and not self._known.found:
            # Whole lots of branches may begin with what has failed already.
            more = self._propose()
            while self._untried and not self._queue and not self._known.found:
                if self._out_of_time():
                    raise OutOfTimeError
                self._take(self._untried.popleft())
        return bool(self._queue)

    def _revise(self, node: PlanNode) -> None:
        """Takes a failed node out and reflects on every branch that ran through it."""
        paths = self._tree.extract_paths(node)  # [P]
        self._tree.remove_subtree(node)
        self._queue.note_failure(node)
        if node.verdict is not None and _is_abandoned(node.verdict):
            self._cut = LimitKind.ABANDONED
            return
        for path in paths:
            self._reflect(node, path)

    def _reflect(self, node: PlanNode, path: TreePath) -> None:
        """[ReflectiveBranching] Revises one branch; its other corrections wait for later.

        A revision that runs into another known failure is revised in turn from the record of that
        failure, which is what simulating the failed action again would lead to.
        """
        if not self._may_reflect(node, path):
            return
        assert node.verdict is not None  # a failed node has been judged
        failed = self._known.failed_step(node, path.branch, self._known.failure(node), node.verdict)
        branches = self._reasoner.reflect(failed)  # [B]
        self._take(Corrections(node, path.revisions + 1, iter(branches)))

    def _may_reflect(self, node: PlanNode, path: TreePath) -> bool:
        """Whether a branch may be revised after a node, once and within the limits; counts it."""
        key = (node.id, path.branch.actions)
        # With a plan in hand, only what the tree already holds is still compared with it.
        if (
            Ablation.REFLECTIVE in self._without
            or self._known.best is not None
            or key in self._reflected
        ):
            return False
        if path.revisions >= self._limits.revisions_per_branch:
            self._cut = LimitKind.REVISIONS
            return False
        if len(self._reflected) >= self._limits.max_reflections:
            self._cut = LimitKind.REFLECTIONS
            return False
        if self._out_of_time():
            raise OutOfTimeError
        self._reflected.add(key)
        self._known.statistics.reflections += 1
        return True

    def _foresee(self, node: PlanNode, record: RolloutRecord) -> Iterator[Branch]:
        """The first corrections of a failure that has not been judged yet.

        In its turn it is judged and reflected on again: 0.2 ms each, of a second's simulation.
        """
        verdict = self._reasoner.judge(node.action, record)
        if verdict.outcome is Outcome.SUCCESS or _is_abandoned(verdict):
            return
        for path in self._tree.extract_paths(node)[:FORESEEN]:
            if path.revisions < self._limits.revisions_per_branch:
                failed = self._known.failed_step(node, path.branch, record, verdict)
                yield from islice(self._reasoner.reflect(failed), 1)

    def _take(self, corrections: Corrections) -> None:
        """Takes the next correction of a failure into the tree, and puts the rest aside."""
        revised = next(corrections.rest, None)
        if revised is None:
            if not corrections.taken:
                self._observer.revised(corrections.node, None)
            return
        if corrections.taken == self._limits.corrections_per_failure:
            self._cut = LimitKind.CORRECTIONS
            return
        corrections.taken += 1
        self._observer.revised(corrections.node, revised)
        self._untried.append(corrections)
        self._insert(TreePath(revised, corrections.revisions), Origin.REFLECTIVE)

    def _insert(self, path: TreePath, origin: Origin) -> None:
        """[mergeBranch, nInQ] Takes a branch into the tree, and what is new of it to the queue."""
        merged, new, blocked = self._tree.merge_branch(path.branch, origin, path.revisions)
        if blocked is not None:
            self._reflect(blocked, path)
        elif new is not None:
            # Behind a node that still waits, the new one gets its turn when that one succeeds.
            if not any(node in self._queue for node in merged):
                self._queue.append(new)
        elif merged and merged[-1].status is NodeStatus.SUCCESS:
            self._offer(merged[-1])  # a plan whose every step has succeeded

    def _offer(self, node: PlanNode) -> None:
        """[extractPath] Takes note of a plan; one that works and is not what was asked for goes on
        with what is still to be done then, as a plan does that is made after a look at the scene.
        """
        self._known.offer(node)
        assert node.end is not None  # otherwise it would be no plan
        path = TreePath(Branch(node.actions, node.end.reason), node.end.revisions)
        if self._costless and self._may_reflect(node, path):
            self._take(Corrections(node, path.revisions + 1, self._continued(node)))

    def _continued(self, node: PlanNode) -> Iterator[Branch]:
        """Plans that begin with one that works; where that only closes too much, less of it.

        What cannot be done any more from there ends this way of doing it, and not the search.
        """
        *past, scene = self._known.scenes(node)
        assignment = replace(self._assignment, past=(*self._assignment.past, *past))
        try:
            for branch in self._reasoner.propose(assignment, scene):
                shorter = kept_open(node.actions, branch.actions)
                if shorter is not None:
                    yield Branch(shorter, branch.reason)
                yield Branch((*node.actions, *branch.actions), branch.reason)
        except (InstructionError, UnsatisfiableError):
            return
        except ReasonerStopped as stop:
            self._note_cut(stop)

    def _note_cut(self, stop: ReasonerStopped) -> None:
        """Takes note that a reasoner has more to propose than it looks at.

        Raises:
            ReasonerStopped: it stopped for another reason.
        """
        if stop.reason is not StopReason.MAX_CHOICES:
            raise stop
        self._cut = LimitKind.MAX_CHOICES

    def _limit_reached(self) -> LimitKind | None:
        if self._known.statistics.nodes_evaluated >= self._limits.max_nodes:
            return LimitKind.MAX_NODES
        return LimitKind.TIME if self._out_of_time() else None

    def _out_of_time(self) -> bool:
        return self._until_s != NEVER and time.monotonic() >= self._until_s

    def _status(self, interrupted: bool) -> SearchStatus:
        if interrupted:
            return SearchStatus.INTERRUPTED
        if self._known.found:
            return SearchStatus.FEASIBLE
        return SearchStatus.INFEASIBLE if self._limit is None else SearchStatus.LIMIT


def _is_abandoned(verdict: Verdict) -> bool:
    """Whether the simulation came to no end: then there is nothing physical to learn from."""
    return verdict.cause is not None and verdict.cause.kind is CauseKind.ABANDONED

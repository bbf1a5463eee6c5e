"""The search against a toy world: the paper's algorithm, step by step."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from etot_cli.control.simulated import Simulated, StateToken, WorldOutcome
from etot_cli.errors import InstructionError, UnsatisfiableError
from etot_cli.planning.options import Ablation, Limits
from etot_cli.planning.result import LimitKind, SearchObserver, SearchResult, SearchStatus
from etot_cli.planning.search import search
from etot_cli.planning.tree import NodeStatus, Origin, PlanNode
from etot_cli.reasoning.protocol import (
    Assignment,
    Branch,
    Doubts,
    FailedStep,
    ReasonerStopped,
    StopReason,
)
from etot_cli.skills.action import Action, format_plan
from etot_cli.specs.task import Condition
from etot_cli.world.state import CauseKind, SceneState
from tests.planning.fakes import (
    STEP_S,
    STEPS,
    ToyReasoner,
    ToySimulator,
    branch,
    cause,
    fails,
    names,
)

ASSIGNMENT = Assignment("do it")


def run(simulator: ToySimulator, reasoner: ToyReasoner, **options: object) -> SearchResult:
    return search(ASSIGNMENT, simulator, reasoner, **options)  # type: ignore[arg-type]


def statuses(result: SearchResult) -> dict[str, str]:
    return {names(node.actions): node.status.value for node in result.tree}


def order(simulator: ToySimulator) -> list[str]:
    """Histories in the order of simulation, in the short form."""
    return [
        f"{history} {action}".replace("[PICK UP, ", "").replace("]", "").strip()
        for history, action in simulator.submitted
    ]


def test_breadth_first_and_the_first_leaf_wins() -> None:
    simulator = ToySimulator(fails())
    result = run(simulator, ToyReasoner(["a b c", "d e", "a f"]))
    assert order(simulator) == ["a", "d", "a b", "a f"]
    assert result.status is SearchStatus.FEASIBLE
    assert names(result.plan) == "a f"
    assert statuses(result)["d e"] == "pending"


def test_counts_what_it_did() -> None:
    result = run(ToySimulator(fails("a")), ToyReasoner(["a", "b"], {"a @ 0": "c a"}))
    assert result.statistics.nodes_evaluated == 2
    assert result.statistics.reflections == 1
    assert result.statistics.simulated_s == pytest.approx(2 * STEP_S)
    assert result.statistics.steps == 2 * STEPS
    assert result.statistics.wall_s > 0


def test_goal_that_holds_needs_no_plan() -> None:
    result = run(ToySimulator(fails()), ToyReasoner([]))
    assert result.status is SearchStatus.FEASIBLE
    assert result.goal_holds and result.plan == () and len(result.tree) == 0


def test_failure_removes_the_subtree() -> None:
    simulator = ToySimulator(fails("a"))
    result = run(simulator, ToyReasoner(["a b", "a c"]))
    assert result.status is SearchStatus.INFEASIBLE
    assert statuses(result) == {"a": "failure", "a b": "removed", "a c": "removed"}
    assert order(simulator) == ["a"]


def test_unsafe_is_a_status_of_its_own() -> None:
    result = run(ToySimulator(fails("a", kind=CauseKind.LOST)), ToyReasoner(["a"]))
    assert statuses(result) == {"a": "unsafe"}
    assert result.status is SearchStatus.INFEASIBLE


def test_every_path_is_revised_and_revisions_share_prefixes() -> None:
    reasoner = ToyReasoner(["a b", "a c"], {"a b @ 0": "x a b", "a c @ 0": "x a c"})
    simulator = ToySimulator(fails("a", "x a b"))
    result = run(simulator, reasoner)
    assert reasoner.reflected[:2] == ["a b @ 0", "a c @ 0"]
    assert order(simulator) == ["a", "x", "x a", "x a b", "x a c"]
    assert names(result.plan) == "x a c"
    assert {node.origin for node in result.tree if node.depth > 2} == {Origin.REFLECTIVE}


def test_revision_goes_on_from_a_node_that_has_succeeded() -> None:
    reasoner = ToyReasoner(["a b"], {"a b @ 1": "a x b"})
    simulator = ToySimulator(fails("a b"))
    result = run(simulator, reasoner)
    assert order(simulator) == ["a", "a b", "a x", "a x b"]
    assert names(result.plan) == "a x b"
    assert statuses(result)["a b"] == "failure"


def test_revision_behind_a_waiting_node_waits_with_it() -> None:
    """The paper's nInQ test: c is not pushed while its parent b still waits in the queue."""
    reasoner = ToyReasoner(["a", "b d"], {"a @ 0": "b c"})
    simulator = ToySimulator(fails("a"))
    result = run(simulator, reasoner)
    assert order(simulator) == ["a", "b", "b d"]
    assert names(result.plan) == "b d"
    assert statuses(result)["b c"] == "pending"


def test_revision_behind_a_waiting_node_falls_with_it() -> None:
    reasoner = ToyReasoner(["a", "b d"], {"a @ 0": "b c"})
    simulator = ToySimulator(fails("a", "b"))
    result = run(simulator, reasoner)
    assert order(simulator) == ["a", "b"]
    assert statuses(result)["b c"] == "removed"
    assert reasoner.reflected == ["a @ 0", "b d @ 0", "b c @ 0"]


def test_revision_that_is_already_a_successful_path_is_the_plan() -> None:
    reasoner = ToyReasoner(["a b"], {"a b @ 1": "a"})
    simulator = ToySimulator(fails("a b"))
    result = run(simulator, reasoner)
    assert result.status is SearchStatus.FEASIBLE
    assert names(result.plan) == "a"
    assert order(simulator) == ["a", "a b"]


def test_known_failures_are_reflected_on_without_simulating_them_again() -> None:
    """The revision of c d starts with a, which has failed: a's own record leads to x a d."""
    reasoner = ToyReasoner(["a b", "c d"], {"c d @ 0": "a d", "a d @ 0": "x a d"})
    simulator = ToySimulator(fails("a", "c"))
    result = run(simulator, reasoner)
    assert reasoner.reflected == ["a b @ 0", "c d @ 0", "a d @ 0"]
    assert order(simulator) == ["a", "c", "x", "x a", "x a d"]
    assert names(result.plan) == "x a d"


def test_reflection_sees_the_failure() -> None:
    reasoner = ToyReasoner(["a b c"])
    run(ToySimulator(fails("a b")), reasoner)
    (step,) = reasoner.failed_steps
    assert step.index == 1
    assert step.branch.actions == branch("a b c").actions
    assert step.branch.reason == "idea 0"
    assert step.verdict.cause == step.record.cause
    assert step.start.states["cup"].on == ("desk",)


def test_repeating_a_failed_branch_ends() -> None:
    reasoner = ToyReasoner(["a"], {"a @ 0": "a"})
    result = run(ToySimulator(fails("a")), reasoner)
    assert result.status is SearchStatus.INFEASIBLE
    assert reasoner.reflected == ["a @ 0"]


def test_revisions_per_branch_are_bounded() -> None:
    def longer(failed: FailedStep) -> Branch:
        actions = failed.branch.actions
        return Branch((*branch("x").actions, *actions))

    simulator = ToySimulator(
        lambda history, action, world: None if action.target == "x" else cause()
    )
    reasoner = ToyReasoner(["a"], longer)
    result = run(simulator, reasoner, limits=Limits(revisions_per_branch=3))
    assert result.status is SearchStatus.LIMIT
    assert result.limit is LimitKind.REVISIONS
    assert "3 corrections in a row" in result.stopped
    assert result.statistics.reflections == 3
    assert max(node.end.revisions for node in result.tree if node.end) == 3


def test_without_priori_only_the_first_branch_is_kept() -> None:
    simulator = ToySimulator(fails("a"))
    result = run(simulator, ToyReasoner(["a", "b"]), without=frozenset({Ablation.PRIORI}))
    assert result.status is SearchStatus.INFEASIBLE
    assert order(simulator) == ["a"]
    assert len(result.branches) == 1


def test_without_reflective_nothing_is_revised() -> None:
    reasoner = ToyReasoner(["a", "b"], {"a @ 0": "x a"})
    result = run(ToySimulator(fails("a", "b")), reasoner, without=frozenset({Ablation.REFLECTIVE}))
    assert result.status is SearchStatus.INFEASIBLE
    assert reasoner.reflected == []
    assert result.statistics.reflections == 0


def test_max_nodes() -> None:
    simulator = ToySimulator(fails(), jobs=4)
    result = run(simulator, ToyReasoner(["a b c d"]), limits=Limits(max_nodes=2))
    simulator.close()
    assert result.status is SearchStatus.LIMIT
    assert result.limit is LimitKind.MAX_NODES
    assert result.statistics.nodes_evaluated == 2
    assert order(simulator) == ["a", "a b"]


def test_plan_found_with_the_last_node_allowed() -> None:
    result = run(ToySimulator(fails()), ToyReasoner(["a b"]), limits=Limits(max_nodes=2))
    assert result.status is SearchStatus.FEASIBLE


def test_time_limit_does_not_wait_for_a_slow_node() -> None:
    simulator = ToySimulator(fails(), jobs=2, delay_s=3.0)
    result = run(simulator, ToyReasoner(["a b"]), limits=Limits(time_limit_s=0.05))
    assert result.status is SearchStatus.LIMIT
    assert result.limit is LimitKind.TIME
    assert result.statistics.wall_s < 1.0


def test_time_limit_of_zero() -> None:
    result = run(ToySimulator(fails()), ToyReasoner(["a"]), limits=Limits(time_limit_s=0.0))
    assert result.limit is LimitKind.TIME and result.statistics.nodes_evaluated == 0


class InterruptAfter(SearchObserver):
    """Presses Ctrl-C at the nth verdict or reflection."""

    def __init__(self, events: int) -> None:
        self._left = events
        self.result: SearchResult | None = None

    def judged(self, node: PlanNode) -> None:
        self._tick()

    def revised(self, node: PlanNode, branch: Branch | None) -> None:
        self._tick()

    def finished(self, result: SearchResult) -> None:
        self.result = result

    def _tick(self) -> None:
        self._left -= 1
        if self._left == 0:
            raise KeyboardInterrupt


@pytest.mark.parametrize("events", [1, 2, 3, 4])
def test_interrupt_keeps_what_was_found(events: int) -> None:
    observer = InterruptAfter(events)
    simulator = ToySimulator(fails("a"))
    reasoner = ToyReasoner(["a", "b c d"], {"a @ 0": "x a"})
    result = run(simulator, reasoner, observer=observer)
    assert result.status is SearchStatus.INTERRUPTED
    assert observer.result is result
    assert statuses(result)["a"] == NodeStatus.FAILURE.value
    assert result.plan == ()


def test_other_errors_are_not_swallowed() -> None:
    def broken(history: str, action: object, world: int) -> None:
        raise TimeoutError("the worker's own")

    with pytest.raises(TimeoutError, match="worker's own"):
        run(ToySimulator(broken), ToyReasoner(["a"]), limits=Limits(time_limit_s=60.0))


class Held(ToySimulator):
    """What an action is about is in the hand after it."""

    def _simulate(self, state: StateToken, action: Action, delay: float) -> Simulated:
        found = super()._simulate(state, action, delay)
        return replace(found, outcomes=[self._held(one, action) for one in found.outcomes])

    @staticmethod
    def _held(outcome: WorldOutcome, action: Action) -> WorldOutcome:
        after = outcome.record.after
        states = {
            name: replace(each, in_hand=name == action.target)
            for name, each in after.states.items()
        }
        return replace(outcome, record=replace(outcome.record, after=replace(after, states=states)))


class GoesOn(ToyReasoner):
    """Proposes something else once something has been seen."""

    def __init__(self, first: str, then: list[str]) -> None:
        super().__init__([first])
        self._then = [branch(text) for text in then]
        self.past: list[int] = []

    def propose(self, assignment: Assignment, scene: SceneState) -> list[Branch]:
        self.past.append(len(assignment.past))
        return self._then if assignment.past else self._branches


GOAL = Assignment("do it", (Condition.model_validate({"in_hand": "cup"}),))


def test_a_plan_that_works_and_is_not_what_was_asked_for_goes_on() -> None:
    reasoner = GoesOn("a b", ["cup"])
    result = search(GOAL, Held(fails()), reasoner, costless=True)
    assert names(result.plan) == "a b cup"
    assert reasoner.past == [0, 2], "asked once, by the scene behind what works"
    assert result.statistics.reflections == 1
    assert not result.doubts, "what the plan begins with is none"


def test_a_plan_that_never_becomes_what_was_asked_for_ends() -> None:
    limits = Limits(revisions_per_branch=3)
    reasoner = GoesOn("a", ["b"])
    result = search(GOAL, Held(fails()), reasoner, limits=limits, costless=True)
    assert result.status is SearchStatus.LIMIT and result.limit is LimitKind.REVISIONS
    assert result.plan == () and len(result.tree) == 4


class Lid(ToySimulator):
    """The lid of the box is as it was turned last."""

    def _simulate(self, state: StateToken, action: Action, delay: float) -> Simulated:
        found = super()._simulate(state, action, delay)
        turned = re.findall(r"\[(OPEN|CLOSE),", f"{state.decode()} {action}")
        return replace(
            found, outcomes=[self._turned(one, turned[-1:] == ["OPEN"]) for one in found.outcomes]
        )

    @staticmethod
    def _turned(outcome: WorldOutcome, opened: bool) -> WorldOutcome:
        after = outcome.record.after
        lid = {"openness": {"lid": float(opened)}, "opened": {"lid": opened}}
        states = {**after.states, "box": replace(after.states["box"], **lid)}
        return replace(outcome, record=replace(outcome.record, after=replace(after, states=states)))


@pytest.mark.parametrize(
    ("works", "failing", "plan", "evaluated"),
    [
        ("OPEN a CLOSE", "", "OPEN a", 3),
        ("OPEN CLOSE a", "", "OPEN a", 4),
        ("OPEN CLOSE a", "OPEN a", "OPEN CLOSE a OPEN", 5),
    ],
)
def test_what_was_closed_and_is_to_be_open_is_not_closed_where_it_need_not_be(
    works: str, failing: str, plan: str, evaluated: int
) -> None:
    def lid(words: str) -> str:
        verbs = {"OPEN": "[OPEN, box.lid]", "CLOSE": "[CLOSE, box.lid]"}
        return " ".join(verbs.get(word, f"[PICK UP, {word}]") for word in words.split())

    goal = Assignment("do it", (Condition.model_validate({"open": "box"}),))
    rule = fails(*([lid(failing)] if failing else []))
    result = search(goal, Lid(rule), GoesOn(lid(works), ["[OPEN, box.lid]"]), costless=True)
    assert format_plan(result.plan) == lid(plan)
    assert result.statistics.nodes_evaluated == evaluated


@pytest.mark.parametrize("without", [frozenset(), frozenset({Ablation.REFLECTIVE})])
def test_a_model_is_not_asked_again_nor_is_anybody_without_reflection(
    without: frozenset[Ablation],
) -> None:
    reasoner = GoesOn("a", ["cup"])
    result = search(GOAL, Held(fails()), reasoner, without=without, costless=bool(without))
    assert result.plan == () and reasoner.past == [0]


@pytest.mark.parametrize(
    ("error", "limit"),
    [
        (InstructionError("the cup is gone"), None),
        (UnsatisfiableError("nothing does it"), None),
        (ReasonerStopped(StopReason.MAX_CHOICES, "too many"), LimitKind.MAX_CHOICES),
    ],
)
def test_what_cannot_go_on_ends_that_way_and_not_the_search(
    error: Exception, limit: LimitKind | None
) -> None:
    class Stuck(GoesOn):
        def propose(self, assignment: Assignment, scene: SceneState) -> list[Branch]:
            if assignment.past:
                raise error
            return [branch("a"), branch("b cup")]

    result = search(GOAL, Held(fails()), Stuck("a", []), costless=True)
    assert names(result.plan) == "b cup"
    alone = Stuck("a", [])
    alone.propose = (
        lambda assignment, scene: (  # type: ignore[method-assign]
            Stuck.propose(alone, assignment, scene)[:1]
        )
    )
    assert search(GOAL, Held(fails()), alone, costless=True).limit is limit


def test_a_reasoner_that_checks_is_asked_instead_of_reading_the_words_again() -> None:
    class Checking(GoesOn):
        def check(self, assignment: Assignment, start: SceneState) -> Doubts:
            return lambda scene: "" if scene.states["cup"].in_hand else "the cup is not held"

    # The words are about something else, and nobody reads them.
    words = Assignment("Open the box.")
    result = search(words, Held(fails()), Checking("a", ["cup"]), costless=True)
    assert names(result.plan) == "a cup"


def test_rollouts_of_the_plan_are_kept() -> None:
    result = run(ToySimulator(fails()), ToyReasoner(["a b"]))
    assert result.leaf is not None
    kept = [result.rollouts[node.id].trajectory for node in result.leaf.path]
    assert kept == [("", "[PICK UP, a]"), ("[PICK UP, a]", "[PICK UP, b]")]

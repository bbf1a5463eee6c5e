"""More jobs change the time, and nothing else."""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest

from etot_cli.control.simulated import Simulated, StateToken
from etot_cli.planning.options import Limits
from etot_cli.planning.result import SearchResult
from etot_cli.planning.search import search
from etot_cli.reasoning.protocol import Assignment, Branch, FailedStep, Outcome, Verdict
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import Cause, CauseKind, RolloutRecord
from tests.planning.fakes import Rule, ToyReasoner, ToySimulator, cause, names, plan

LETTERS = "abcdef"


class SlowSimulator(ToySimulator):
    """Two jobs; one action takes its time, the others none."""

    def __init__(self, rule: Rule, slow: str) -> None:
        super().__init__(rule, jobs=2)
        self._slow = slow

    def _simulate(self, state: StateToken, action: Action, delay: float) -> Simulated:
        return super()._simulate(state, action, 0.3 if action.target == self._slow else 0.0)


def digest(result: SearchResult) -> object:
    """Everything about a result but its wall times."""
    cost = result.statistics
    return (
        result.status,
        result.plan,
        result.survival,
        [
            (n.id, n.parent.id if n.parent else 0, n.action, n.origin, n.status, n.verdict,
             n.survived, n.losses, n.end)
            for n in result.tree
        ],
        (cost.nodes_evaluated, cost.reflections, cost.simulated_s, cost.steps),
    )  # fmt: skip


def random_search(seed: int, jobs: int, worlds: int) -> tuple[SearchResult, ToySimulator]:
    """A search in a world whose rules, branches and revisions all follow from the seed."""

    def rule(history: str, action: Action, world: int) -> Cause | None:
        chance = random.Random(f"{seed} {history} {action} {world if world % 3 == 1 else 0}")
        if chance.random() < 0.45:
            return cause(chance.choice(list(CauseKind)), action.target)
        return None

    def revise(failed: FailedStep) -> Iterator[Branch]:
        chance = random.Random(f"{seed} {failed.branch} {failed.index}")
        for _ in range(chance.choice((0, 1, 1, 3))):
            actions = list(failed.branch.actions)
            spare = Action(Verb.PICK_UP, chance.choice(LETTERS))
            actions.insert(chance.randrange(failed.index + 1), spare)
            yield Branch(tuple(actions), "revised")

    chance = random.Random(seed)
    branches = [
        " ".join(chance.choice(LETTERS) for _ in range(chance.randint(3, 6)))
        for _ in range(chance.randint(1, 5))
    ]
    simulator = ToySimulator(rule, jobs=jobs, worlds=worlds, delay_s=0.001 if jobs > 1 else 0.0)
    result = search(
        Assignment("do it"), simulator, ToyReasoner(branches, revise), limits=Limits(max_nodes=60),
        costless=jobs > 1,
    )  # fmt: skip
    simulator.close()
    return result, simulator


@pytest.mark.parametrize("worlds", [1, 5])
@pytest.mark.parametrize("seed", range(12))
def test_jobs_change_nothing(seed: int, worlds: int) -> None:
    alone, _ = random_search(seed, 1, worlds)
    together, _ = random_search(seed, 4, worlds)
    assert digest(alone) == digest(together)


def test_jobs_really_run_together() -> None:
    simulator = ToySimulator(lambda *_: cause(), jobs=4, delay_s=0.02)
    search(Assignment("do it"), simulator, ToyReasoner(list("abcdefgh")))
    simulator.close()
    assert simulator.most_running > 1


def test_work_ahead_is_not_counted() -> None:
    simulator = ToySimulator(lambda *_: None, jobs=4)
    result = search(Assignment("do it"), simulator, ToyReasoner(list("abcd")))
    simulator.close()
    assert len(simulator.submitted) > 1
    assert result.statistics.nodes_evaluated == 1
    assert [node.status.value for node in result.tree] == ["success", *["pending"] * 3]


def test_jobs_run_ahead_along_a_branch() -> None:
    """While the first branch's slow action runs, the second one goes on behind its own success."""
    simulator = SlowSimulator(lambda *_: None, "a")
    result = search(Assignment("do it"), simulator, ToyReasoner(["a", "b c d e"]))
    simulator.close()
    assert names(result.plan) == "a"
    ahead = [action for _, action in simulator.submitted]
    assert ahead == ["[PICK UP, a]", *(f"[PICK UP, {name}]" for name in "bcde")]
    assert result.statistics.nodes_evaluated == 1
    assert simulator.most_running == 2


def test_nothing_runs_ahead_of_an_action_that_missed_its_effect() -> None:
    simulator = SlowSimulator(lambda h, action, w: cause() if action.target == "b" else None, "a")
    search(Assignment("do it"), simulator, ToyReasoner(["a", "b c"]))
    simulator.close()
    assert [action for _, action in simulator.submitted] == ["[PICK UP, a]", "[PICK UP, b]"]


def test_what_corrects_a_failure_runs_before_the_failure_is_judged() -> None:
    """While the first branch's slow action runs, the correction of the second branch is on."""
    rule = lambda h, action, w: cause() if action.target == "b" else None  # noqa: E731
    revisions = {"d b c @ 1": "d e f"}
    ahead = {}
    for foresee in (False, True):
        simulator = SlowSimulator(rule, "a")
        reasoner = ToyReasoner(["a", "d b c"], revisions)
        result = search(Assignment("do it"), simulator, reasoner, costless=foresee)
        simulator.close()
        assert names(result.plan) == "a"
        assert len(result.tree) == 4, "what was foreseen is not in the tree"
        ahead[foresee] = [names(plan(f"{state} {action}")) for state, action in simulator.submitted]
    assert ahead[False] == ["a", "d", "d b"]
    assert ahead[True] == ["a", "d", "d b", "d e", "d e f"]


def test_the_longest_chain_runs_ahead_first() -> None:
    simulator = SlowSimulator(lambda *_: None, "a")
    search(Assignment("do it"), simulator, ToyReasoner(["a", "b c", "b d e f"]))
    simulator.close()
    ahead = [names(plan(f"{state} {action}")) for state, action in simulator.submitted]
    assert ahead == ["a", "b", "b d", "b d e", "b c", "b d e f"]


def test_running_ahead_keeps_to_the_allowance() -> None:
    simulator = SlowSimulator(lambda *_: None, "a")
    limits = Limits(max_nodes=3)
    search(Assignment("do it"), simulator, ToyReasoner(["a", "b c d e"]), limits=limits)
    simulator.close()
    assert len(simulator.submitted) == 3


def test_what_runs_ahead_below_a_failure_is_dropped() -> None:
    """The judge refuses what had its effect: its child, already under way, is never asked for."""

    class Strict(ToyReasoner):
        def judge(self, action: Action, record: RolloutRecord) -> Verdict:
            if action.target == "b":
                return Verdict(Outcome.FAILURE, cause(CauseKind.COLLISION, "cup"))
            return super().judge(action, record)

    simulator = SlowSimulator(lambda *_: None, "a")
    result = search(Assignment("do it"), simulator, Strict(["a f", "b c d"], {"a f @ 1": None}))
    simulator.close()
    assert ("[PICK UP, b]", "[PICK UP, c]") in simulator.submitted
    assert {names(n.actions): n.status.value for n in result.tree}["b c"] == "removed"
    assert names(result.plan) == "a f"

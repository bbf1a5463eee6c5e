"""More jobs change the time, and nothing else."""

from __future__ import annotations

import random

import pytest

from etot_cli.planning.options import Limits
from etot_cli.planning.result import SearchResult
from etot_cli.planning.search import search
from etot_cli.reasoning.protocol import Assignment, Branch, FailedStep
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import Cause, CauseKind
from tests.planning.fakes import ToyReasoner, ToySimulator, cause

LETTERS = "abcdef"


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

    def revise(failed: FailedStep) -> Branch | None:
        chance = random.Random(f"{seed} {failed.branch} {failed.index}")
        if chance.random() < 0.3:
            return None
        actions = list(failed.branch.actions)
        spare = Action(Verb.PICK_UP, chance.choice(LETTERS))
        actions.insert(chance.randrange(failed.index + 1), spare)
        return Branch(tuple(actions), "revised")

    chance = random.Random(seed)
    branches = [
        " ".join(chance.choice(LETTERS) for _ in range(chance.randint(3, 6)))
        for _ in range(chance.randint(1, 5))
    ]
    simulator = ToySimulator(rule, jobs=jobs, worlds=worlds, delay_s=0.001 if jobs > 1 else 0.0)
    result = search(
        Assignment("do it"), simulator, ToyReasoner(branches, revise), limits=Limits(max_nodes=60)
    )
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

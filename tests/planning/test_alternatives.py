"""What a search tries when the best of each has failed, and what it says when bounds cut it off."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count

import pytest
from hypothesis import given
from hypothesis import strategies as st

from etot_cli.planning.alternatives import best_prefix
from etot_cli.planning.options import BRANCHES_AT_ONCE, Ablation, Limits
from etot_cli.planning.result import LimitKind, SearchStatus
from etot_cli.planning.tree import NodeStatus
from etot_cli.reasoning.protocol import (
    Assignment,
    Branch,
    FailedStep,
    ReasonerStopped,
    StopReason,
)
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import Cause, SceneState
from tests.planning.fakes import ToyReasoner, ToySimulator, branch, cause, fails, names
from tests.planning.test_search import order, run

MANY = [f"branch{number}" for number in range(72)]


def only(*working: str) -> ToySimulator:
    """A world in which only actions with these targets work."""
    return ToySimulator(
        lambda history, action, world: None if action.target in working else cause()
    )


def test_the_next_correction_follows_when_all_before_have_failed() -> None:
    reasoner = ToyReasoner(["a", "b"], {"a @ 0": ["x a", "y a"], "b @ 0": ["z b"]})
    simulator = ToySimulator(fails("a", "b", "x", "z"))
    result = run(simulator, reasoner)
    assert order(simulator) == ["a", "b", "x", "z", "y", "y a"]
    assert names(result.plan) == "y a"
    assert result.statistics.reflections == 4  # a, b, x a, z b: alternatives cost no question


def test_alternatives_cost_nothing_where_the_best_works() -> None:
    asked: list[str] = []

    def corrections(failed: FailedStep) -> Iterator[Branch]:
        for text in ("x a", "y a", "z a"):
            asked.append(text)
            yield branch(text)

    simulator = ToySimulator(fails("a"))
    result = run(simulator, ToyReasoner(["a"], corrections))
    assert names(result.plan) == "x a"
    assert asked == ["x a"]
    assert order(simulator) == ["a", "x", "x a"]


def test_all_failures_take_turns() -> None:
    """Second corrections of every failure come before the third ones of any."""
    reasoner = ToyReasoner(
        ["a", "b"], {"a @ 0": ["p a", "q a", "r a"], "b @ 0": ["s b", "t b", "u b"]}
    )
    simulator = only("u", "b!")
    run(simulator, reasoner)
    assert order(simulator) == ["a", "b", "p", "s", "q", "t", "r", "u", "u b"]


def test_infeasible_means_that_all_corrections_failed() -> None:
    reasoner = ToyReasoner(["a"], {"a @ 0": ["x a", "y a"]})
    result = run(only(), reasoner)
    assert result.status is SearchStatus.INFEASIBLE
    assert result.limit is None and result.stopped == ""
    assert {names(node.actions) for node in result.tree if node.verdict} == {"a", "x", "y"}


def test_corrections_beyond_the_bound_are_a_limit() -> None:
    def endless(failed: FailedStep) -> Iterator[Branch]:
        return (branch(f"x{number} a") for number in count()) if failed.index == 0 else iter(())

    limits = Limits(corrections_per_failure=3, revisions_per_branch=1)
    result = run(only(), ToyReasoner(["a"], endless), limits=limits)
    assert result.status is SearchStatus.LIMIT
    assert result.statistics.nodes_evaluated == 4
    assert result.limit in (LimitKind.CORRECTIONS, LimitKind.REVISIONS)
    assert result.stopped


def test_exactly_as_many_corrections_as_the_bound_are_no_limit() -> None:
    reasoner = ToyReasoner(["a"], {"a @ 0": ["x a", "y a"]})
    result = run(only(), reasoner, limits=Limits(corrections_per_failure=2))
    assert result.status is SearchStatus.INFEASIBLE


def test_reflections_are_bounded() -> None:
    """Every correction runs into the same known failure: nothing is simulated, all is asked."""
    numbers = count()

    def circling(failed: FailedStep) -> Iterator[Branch]:
        return (branch(f"a x{next(numbers)}") for _ in range(3))

    result = run(only(), ToyReasoner(["a"], circling), limits=Limits(max_reflections=50))
    assert result.limit in (LimitKind.REFLECTIONS, LimitKind.REVISIONS)
    assert result.statistics.reflections <= 50


@pytest.mark.parametrize("works", [0, 63, 64, 71])
def test_one_of_72_branches_works(works: int) -> None:
    result = run(only(MANY[works]), ToyReasoner(MANY))
    assert result.status is SearchStatus.FEASIBLE
    assert names(result.plan) == MANY[works]
    assert len(result.branches) == (BRANCHES_AT_ONCE if works < BRANCHES_AT_ONCE else len(MANY))


def test_branches_beyond_the_first_are_worked_out_when_they_are_needed() -> None:
    class Lazy(ToyReasoner):
        def propose(self, assignment: Assignment, scene: SceneState) -> Iterator[Branch]:
            for text in MANY:
                drawn.append(text)
                yield branch(text)

    drawn: list[str] = []
    run(only(MANY[5]), Lazy([]))
    assert drawn == MANY[:BRANCHES_AT_ONCE]


def test_later_branches_run_into_known_failures_and_are_corrected() -> None:
    first = [f"a w{number}" for number in range(BRANCHES_AT_ONCE)]
    reasoner = ToyReasoner([*first, "a b"], {"a b @ 0": "x a b"})
    simulator = ToySimulator(fails("a"))
    result = run(simulator, reasoner)
    assert names(result.plan) == "x a b"
    assert order(simulator) == ["a", "x", "x a", "x a b"]


def test_a_whole_lot_of_branches_may_begin_with_a_known_failure() -> None:
    doomed = [f"a w{number}" for number in range(2 * BRANCHES_AT_ONCE + 1)]
    result = run(ToySimulator(fails("a")), ToyReasoner([*doomed, "b"]))
    assert result.status is SearchStatus.FEASIBLE and names(result.plan) == "b"


def test_more_choices_than_are_looked_at_are_a_limit() -> None:
    class Cut(ToyReasoner):
        def propose(self, assignment: Assignment, scene: SceneState) -> Iterator[Branch]:
            yield branch("a")
            raise ReasonerStopped(StopReason.MAX_CHOICES, "too many")

    result = run(only(), Cut([], {"a @ 0": ["x a", "y a"]}))
    assert result.status is SearchStatus.LIMIT and result.limit is LimitKind.MAX_CHOICES
    assert result.statistics.nodes_evaluated == 3, "corrections are still tried"
    assert run(only("y", "a"), Cut([], {"a @ 0": ["x a"]})).status is SearchStatus.FEASIBLE


def test_without_priori_no_further_branch_is_taken() -> None:
    result = run(only("b"), ToyReasoner(["a", "b"]), without=frozenset({Ablation.PRIORI}))
    assert result.status is SearchStatus.INFEASIBLE and len(result.branches) == 1


@pytest.mark.parametrize("max_nodes", [1, 2, 3])
def test_limit_keeps_the_best_prefix(max_nodes: int) -> None:
    result = run(
        ToySimulator(fails("d")),
        ToyReasoner(["a b c x", "d", "e f g h i j"]),
        limits=Limits(max_nodes=max_nodes),
    )
    assert result.status is SearchStatus.LIMIT and result.limit is LimitKind.MAX_NODES
    assert f"{max_nodes} action" in result.stopped
    assert result.prefix is not None
    assert names(result.prefix.last.actions) == "a"
    assert [node.action.target for node in result.prefix.missing] == ["b", "c", "x"]


def test_no_prefix_where_nothing_worked_or_all_did() -> None:
    assert run(only(), ToyReasoner(["a"])).prefix is None
    assert run(only("a"), ToyReasoner(["a"])).prefix is None


def test_the_final_scene_is_that_after_the_plan() -> None:
    found = run(only("a"), ToyReasoner(["a"]))
    assert found.leaf is not None
    assert found.final is found.rollouts[found.leaf.id].record.after
    assert run(only(), ToyReasoner(["a"])).final is None
    assert run(only(), ToyReasoner([])).final is not None


# -- small worlds, searched for a plan that is known to exist --------------------------------------

BLOCKERS = ["vase", "crate", "lamp", "book"]


@st.composite
def cluttered(draw: st.DrawFn) -> tuple[dict[str, list[str]], set[str]]:
    """What stands in the way of what, without circles, and what cannot be moved at all.

    The lid is what is to be opened; each thing may only be obstructed by later ones.
    """
    things = ["lid", *BLOCKERS]
    ways = {
        thing: draw(st.lists(st.sampled_from(things[place + 1 :]), unique=True, max_size=3))
        if place + 1 < len(things)
        else []
        for place, thing in enumerate(things)
    }
    return ways, set(draw(st.lists(st.sampled_from(BLOCKERS), unique=True, max_size=2)))


def needed(ways: dict[str, list[str]], thing: str) -> set[str]:
    """Everything that has to be moved before a thing can be."""
    found: set[str] = set()
    for other in ways[thing]:
        found |= {other, *needed(ways, other)}
    return found


def clearing(
    ways: dict[str, list[str]], fixed: set[str], names_all: bool
) -> tuple[ToySimulator, ToyReasoner]:
    """A world of things in each other's way, and a reasoner that moves what is named first.

    ``names_all``: a failure names all that is in the way, else only the first of it.
    """

    def rule(history: str, action: Action, world: int) -> Cause | None:
        gone = {name for name in BLOCKERS if f"[PICK UP, {name}]" in history}
        left = [name for name in ways[action.target] if name not in gone]
        if action.target in fixed:
            return cause()
        return None if not left else Cause(cause().kind, tuple(left if names_all else left[:1]), "")

    def corrections(failed: FailedStep) -> Iterator[Branch]:
        why = failed.verdict.cause
        assert why is not None
        for name in why.objects:
            actions = list(failed.branch.actions)
            moved = Action(Verb.PICK_UP, name)
            if moved not in actions[: failed.index]:
                yield Branch((*actions[: failed.index], moved, *actions[failed.index :]))

    return ToySimulator(rule), ToyReasoner(["lid"], corrections)


@given(cluttered(), st.booleans())
@pytest.mark.slow
def test_a_plan_is_found_exactly_where_there_is_one(
    world: tuple[dict[str, list[str]], set[str]], names_all: bool
) -> None:
    ways, fixed = world
    simulator, reasoner = clearing(ways, fixed, names_all)
    result = run(simulator, reasoner)
    solvable = not needed(ways, "lid") & fixed
    assert (result.status is SearchStatus.FEASIBLE) == solvable
    if not solvable:
        assert result.status is SearchStatus.INFEASIBLE and result.limit is None


@given(
    st.lists(st.lists(st.sampled_from("abcd"), min_size=1, max_size=4), min_size=1, max_size=8),
    st.sets(st.sampled_from("abcdvwxyz"), max_size=6),
    st.integers(1, 3),
    st.integers(1, 4),
    st.integers(1, 30),
)
@pytest.mark.slow
def test_infeasible_is_never_said_where_a_bound_cut_something_off(
    texts: Sequence[Sequence[str]], broken: set[str], depth: int, width: int, nodes: int
) -> None:
    """With the bounds out of the way, "infeasible" stays the answer."""

    def corrections(failed: FailedStep) -> Iterator[Branch]:
        actions = failed.branch.actions
        for spare in "vwxyz":
            extra = Action(Verb.PICK_UP, spare)
            if extra not in actions:
                yield Branch((*actions[: failed.index], extra, *actions[failed.index + 1 :]))

    def searched(limits: Limits) -> SearchStatus:
        simulator = ToySimulator(lambda h, action, w: cause() if action.target in broken else None)
        reasoner = ToyReasoner([" ".join(text) for text in texts], corrections)
        return run(simulator, reasoner, limits=limits).status

    bounded = searched(
        Limits(max_nodes=nodes, revisions_per_branch=depth, corrections_per_failure=width)
    )
    free = Limits(max_nodes=10_000, revisions_per_branch=20, max_reflections=100_000)
    if bounded is SearchStatus.INFEASIBLE:
        assert searched(free) is SearchStatus.INFEASIBLE
    if bounded is SearchStatus.FEASIBLE:
        assert searched(free) is SearchStatus.FEASIBLE


@given(cluttered())
@pytest.mark.slow
def test_the_best_prefix_has_succeeded_throughout(
    world: tuple[dict[str, list[str]], set[str]],
) -> None:
    ways, fixed = world
    simulator, reasoner = clearing(ways, fixed, True)
    result = run(simulator, reasoner)
    prefix = best_prefix(result.tree)
    if prefix is not None:
        assert all(node.status is NodeStatus.SUCCESS for node in prefix.last.path)
        ends = [*prefix.missing, prefix.last] if not prefix.missing else prefix.missing
        assert ends[-1].end is not None

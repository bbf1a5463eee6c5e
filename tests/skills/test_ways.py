"""Lanes: candidates dealt out, worked out apart, put together again."""

from __future__ import annotations

import pickle

from hypothesis import given
from hypothesis import strategies as st

from etot_cli.skills.action import parse_plan
from etot_cli.skills.outcome import Evidence, SkillOutcome, failed
from etot_cli.skills.perform import Performed, Workshop, choose
from etot_cli.skills.ways import LANES, NoWay, dealt, lane_of, no_way
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import CauseKind
from tests.skills.helpers import BALL, CUP, Episode, episode

counts = st.dictionaries(st.sampled_from(["apple", "cup", "box"]), st.integers(1, 9))
evidences = st.builds(Evidence, counts, st.integers(0, 9))


@given(st.integers(0, 60))
def test_every_candidate_is_dealt_once_and_in_order(count: int) -> None:
    hands = [list(dealt(range(count), lane)) for lane in range(LANES)]
    assert sorted(item for hand in hands for item in hand) == list(range(count))
    assert all(hand == sorted(hand) for hand in hands)
    assert max(map(len, hands)) - min(map(len, hands)) <= 1


def test_kinds_that_alternate_reach_every_lane() -> None:
    """Upright and leaning candidates in turn: each lane gets some of both."""
    for parity in (0, 1):
        assert {lane_of(index) for index in range(parity, 12, 2)} == set(range(LANES))


@given(evidences, evidences, evidences)
def test_evidence_adds_up_in_any_order(one: Evidence, two: Evidence, three: Evidence) -> None:
    assert (one + two) + three == one + (two + three)
    assert (one + two).most() == (two + one).most()
    assert one + Evidence() == one


def explain(evidence: Evidence) -> SkillOutcome:
    return failed(CauseKind.NO_ROOM, evidence.most(), f"{evidence.unreachable} out of reach")


def test_the_reason_comes_from_all_lanes() -> None:
    first = NoWay(Evidence({"cup": 1}, 2), explain)
    second = NoWay(Evidence({"apple": 5}, 1), explain)
    cause = no_way([first, second]).cause
    assert cause is not None and cause.objects == ("apple", "cup")
    assert cause.text == "3 out of reach"


def in_lanes(workshop: Workshop, start: Snapshot, text: str) -> list[Performed | None]:
    """Each lane by itself, as separate workers would, its result sent on."""
    (action,) = parse_plan(text)
    results: list[Performed | None] = []
    for lane in range(LANES):
        (result,) = workshop.run_lanes(start, action, [lane])
        results.append(pickle.loads(pickle.dumps(result)))
    return results


def same(one: Performed, two: Performed) -> bool:
    return one.record == two.record and one.end.physics == two.end.physics


def check_apart_and_together(run: Episode, text: str) -> list[Performed | None]:
    start = run.snapshot
    apart = in_lanes(run.workshop, start, text)
    assert same(choose(apart), run.do(text))
    return apart


def test_lanes_apart_and_together_agree() -> None:
    run = episode(ball=BALL, cup=CUP | {"diameter": 0.12})
    lanes = check_apart_and_together(run, "[PICK UP, ball]")
    ends = {lane.end.physics for lane in lanes if lane is not None}
    assert len(ends) == LANES, "lanes try different grasps"
    check_apart_and_together(run, "[PUT INTO, cup]")


def test_lanes_without_a_way_give_one_reason() -> None:
    """A ball deep in a narrow cup: every grasp is obstructed, and the cup is named."""
    deep = {"diameter": 0.075, "height": 0.16}
    run = episode(cup=CUP | deep, ball=BALL | {"diameter": 0.055, "inside": "cup", "at": None})
    lanes = check_apart_and_together(run, "[PICK UP, ball]")
    assert all(lane is not None and lane.no_way is not None for lane in lanes)
    cause = run.done[-1].record.cause
    assert cause is not None and cause.kind is CauseKind.NO_GRASP
    assert "cup" in cause.objects and "ball" in cause.objects


def test_a_lane_with_a_way_counts_before_one_without() -> None:
    run = episode(ball=BALL)
    start = run.snapshot
    done = run.do("[PICK UP, ball]")
    nothing = NoWay(Evidence(), explain)
    empty = Performed(done.record, start, None, clean=False, no_way=nothing)
    assert same(choose([empty, done]), done)
    assert same(choose([None, done]), done)

"""What holds for every scene, goal and failure."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin import BuiltinReasoner, check_plan
from etot_cli.reasoning.builtin.revision import cycles, purpose
from etot_cli.reasoning.language.instructions import goal_of
from etot_cli.reasoning.protocol import Assignment, Branch, FailedStep, Outcome
from etot_cli.skills.action import Action, GraspPose, Verb
from etot_cli.specs.task import Condition
from etot_cli.world.state import Cause, CauseKind, SceneState
from tests.reasoning import scenes
from tests.reasoning.records import changed, first_revision, held, record

KITCHEN = scenes.kitchen()
MOVABLE = [name for name, info in KITCHEN.infos.items() if info.movable]
SURFACES = ["desk", "plate", "box", "chest"]
VESSELS = ["bowl_1", "bowl_2", "mug_a", "mug_b", "chest.upper", "chest.lower"]
PARTS = ["chest.upper", "chest.lower"]
QUICK = settings(
    max_examples=40, deadline=None, suppress_health_check=[HealthCheck.too_slow], derandomize=True
)

conditions: st.SearchStrategy[dict[str, Any]] = st.one_of(
    st.tuples(st.sampled_from(MOVABLE), st.sampled_from(SURFACES)).map(lambda p: {"on": list(p)}),
    st.tuples(st.sampled_from(MOVABLE), st.sampled_from(VESSELS)).map(
        lambda p: {"inside": list(p)}
    ),
    st.sampled_from(MOVABLE).map(lambda name: {"in_hand": name}),
    st.sampled_from(PARTS).map(lambda part: {"open": part}),
    st.sampled_from(PARTS).map(lambda part: {"closed": part}),
)
goals = st.lists(
    st.one_of(conditions, st.lists(conditions, min_size=1, max_size=3).map(lambda c: {"any": c})),
    min_size=1,
    max_size=4,
)
actions = st.builds(
    Action,
    st.sampled_from(Verb),
    st.sampled_from([*KITCHEN.infos, *SURFACES, *PARTS, "nothing"]),
    st.sampled_from([None, None, GraspPose.VERTICAL]),
)
causes = st.builds(
    Cause,
    st.sampled_from(CauseKind),
    st.lists(st.sampled_from([*KITCHEN.infos, "desk"]), max_size=4).map(tuple),
    st.just("something went wrong"),
)


def branches(goal: list[dict[str, Any]], scene: SceneState = KITCHEN) -> list[Branch]:
    parsed = tuple(Condition.model_validate(item) for item in goal)
    try:
        return list(BuiltinReasoner().propose(Assignment("", parsed), scene))
    except InstructionError:
        return []


@QUICK
@given(goals)
def test_branches_are_well_formed_and_distinct(goal: list[dict[str, Any]]) -> None:
    found = branches(goal)
    for branch in found:
        assert branch.actions
        assert check_plan(branch.actions, KITCHEN) == []
    assert len({branch.actions for branch in found}) == len(found) <= 64


@QUICK
@given(st.lists(actions, max_size=8), st.sampled_from([KITCHEN, held(KITCHEN, "bottle")]))
def test_rules_look_at_any_sequence(plan: list[Action], scene: SceneState) -> None:
    found = check_plan(plan, scene)
    assert all(0 <= item.index < len(plan) for item in found)
    # A well-formed plan stays one when its end is cut off, cycles kept whole.
    if not found:
        for cycle in cycles(plan):
            assert all(item.rule == 3 for item in check_plan(plan[: cycle.end], scene))


@QUICK
@given(st.lists(actions, max_size=10))
def test_cycles_cover_every_action_once(plan: list[Action]) -> None:
    covered = [index for cycle in cycles(plan) for index in range(cycle.start, cycle.end)]
    assert covered == list(range(len(plan)))


@QUICK
@given(goals, st.lists(st.tuples(st.integers(0, 30), causes), min_size=1, max_size=12), st.data())
@pytest.mark.slow
def test_revisions_are_well_formed_keep_the_purpose_and_stay_short(
    goal: list[dict[str, Any]], failures: list[tuple[int, Cause]], data: st.DataObject
) -> None:
    start = data.draw(st.sampled_from([KITCHEN, held(KITCHEN, "bottle")]))
    found = branches(goal, start)
    if not found:
        return
    first = branch = data.draw(st.sampled_from(found))
    reasoner = BuiltinReasoner()
    for where, reason in failures:
        index = where % len(branch.actions)
        before = state_at(branch, index, start)
        rollout = record(before, effect=False, cause=reason)
        verdict = reasoner.judge(branch.actions[index], rollout)
        assert verdict.outcome is Outcome.FAILURE
        revised = first_revision(reasoner, FailedStep(branch, index, rollout, verdict, start))
        if revised is None:
            break
        assert revised.actions != branch.actions
        assert check_plan(revised.actions, start) == []
        assert purpose(revised.actions, start) == purpose(first.actions, start)
        for name in MOVABLE:
            taken = sum(
                action.safe and previous.target == name
                for previous, action in zip(revised.actions, revised.actions[1:], strict=False)
            )
            assert taken <= 1 + (name == start.holding)
        branch = revised
    limit = len(first.actions) + 2 * len(MOVABLE) + 3 + 4 * len(PARTS)
    assert len(branch.actions) <= max(limit, 64)


def state_at(branch: Branch, index: int, start: SceneState) -> SceneState:
    """Roughly where a branch stands before an action: hand and openings."""
    scene = start
    for action in branch.actions[:index]:
        part = scene.part(action.target)
        if action.verb is Verb.PICK_UP:
            scene = held(scene, action.target)
        elif action.verb in (Verb.PUT_ON, Verb.PUT_INTO) and scene.holding is not None:
            scene = changed(scene, **{scene.holding: {"in_hand": False, "on": ("desk",)}})
        elif part is not None:
            opening = dict(scene.states[part.owner].openness)
            opening[part.name] = 1.0 if action.verb is Verb.OPEN else 0.0
            scene = changed(scene, **{part.owner: {"openness": opening}})
    return scene


WORDS = """
    pick up put place open close the a both all it them apple apples bowl mug drawer top left red
    in into on and then with inside or either of one two next to behind is closed ensure , . not
    together separately from above plate box chest zorp it's 2 reorient
"""
words = st.sampled_from(WORDS.split())


@QUICK
@given(st.lists(words, min_size=1, max_size=14).map(" ".join))
@pytest.mark.slow
def test_any_text_is_read_or_refused(text: str) -> None:
    try:
        goal_of(text, KITCHEN)
        found = list(BuiltinReasoner().propose(Assignment(text), KITCHEN))
    except InstructionError as error:
        assert str(error)
        return
    for branch in found:
        assert check_plan(branch.actions, KITCHEN) == []


@QUICK
@given(st.text(max_size=200))
@pytest.mark.slow
def test_any_characters_are_read_or_refused(text: str) -> None:
    try:
        goal_of(text, KITCHEN)
    except InstructionError as error:
        assert "--reasoner vlm" in str(error)

"""The reasoner with a scripted model and no physics: roles, judges, repairs, screens."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import pytest

from etot_cli.reasoning.protocol import (
    Assignment,
    Branch,
    FailedStep,
    Outcome,
    ReasonerStopped,
    Verdict,
)
from etot_cli.reasoning.vlm.asking import Asker
from etot_cli.reasoning.vlm.baselines import OneShot
from etot_cli.reasoning.vlm.client import ChatClient
from etot_cli.reasoning.vlm.fake_server import FakeServer
from etot_cli.reasoning.vlm.notes import Notebook, NoteKind
from etot_cli.reasoning.vlm.player import Player, Reply
from etot_cli.reasoning.vlm.prompts import Prompts
from etot_cli.reasoning.vlm.reasoner import VlmReasoner
from etot_cli.skills.action import Action, GraspPose, Verb, parse_plan
from etot_cli.world.state import Cause, CauseKind, RolloutRecord, SceneState
from tests.vlm.conftest import Make
from tests.vlm.scenes import kitchen
from tests.vlm.scripts import rule

SCENE = kitchen()
ASSIGNMENT = Assignment("Put the spoon into a cup.")
SCENE_RULE = rule("scene", '{"objects": [], "understanding": "The spoon has to end in a cup."}')
OPEN = Action(Verb.OPEN, "chest")


class StateJudge:
    """Stands for a judge by the world's state."""

    def __init__(self, verdict: Verdict) -> None:
        self.verdict = verdict

    def propose(self, assignment: Assignment, scene: SceneState) -> list[Branch]:
        raise NotImplementedError

    def judge(self, action: Action, record: RolloutRecord) -> Verdict:
        return self.verdict

    def reflect(self, failed: FailedStep) -> list[Branch]:
        raise NotImplementedError


@contextmanager
def model(
    make: Make, rules: list[dict[str, Any]], judge: str = "both", state: Verdict | None = None
) -> Iterator[tuple[VlmReasoner, FakeServer, Notebook]]:
    notes = Notebook()
    with FakeServer(Player(rules)) as server:
        client = ChatClient(make(server.url))
        asker = Asker(client, Prompts(), notes, seed=0)
        reasoner = VlmReasoner(
            asker,
            frames=None,
            judge=judge,  # type: ignore[arg-type]
            state=None if state is None else StateJudge(state),
        )
        try:
            yield reasoner, server, notes
        finally:
            client.close()


def failed(plan: str, index: int, cause: Cause | None) -> FailedStep:
    record = RolloutRecord(SCENE, SCENE, effect=False, cause=cause)
    verdict = Verdict(Outcome.FAILURE, cause)
    return FailedStep(Branch(parse_plan(plan)), index, record, verdict, SCENE)


def kinds(notes: Notebook) -> list[NoteKind]:
    return [note.kind for note in notes.notes]


IN_RED = "[PICK UP, spoon] [PUT INTO, red_cup]"
BLOCKED = Cause(CauseKind.BLOCKED, ("ball", "chest"), "ball blocks chest")
TOO_LIGHT = Cause(CauseKind.TOPPLED, ("red_cup", "spoon"), "red_cup toppled")
CLEARED = "1. [PICK UP, ball]\n2. [PUT ON, desk] (safe place)\n3. [OPEN, chest]"


# -- proposing ---------------------------------------------------------------------------------


def test_all_branches_come_in_order(make_settings: Make) -> None:
    reply = (
        "Branch 1:\n1. [PICK UP, spoon]\n2. [PUT INTO, red cup]\n\nBranch 2:\n"
        "1. [PICK UP, spoon]\n2. [PUT INTO, blue cup]"
    )
    with model(make_settings, [SCENE_RULE, rule("branches", reply)]) as (reasoner, server, _):
        found = reasoner.propose(ASSIGNMENT, SCENE)
    assert [branch.actions for branch in found] == [
        parse_plan(IN_RED),
        parse_plan("[PICK UP, spoon] [PUT INTO, blue_cup]"),
    ]
    scene, branches = server.requests
    assert "Put the spoon into a cup." in scene.text and "chest: on desk, closed" in scene.text
    assert "The spoon has to end in a cup." in branches.text


def test_bad_branches_go_back_and_good_ones_stay(make_settings: Make) -> None:
    first = (
        "Branch 1:\n1. [PICK UP, spoon]\n2. [PUT INTO, red cup]\n\nBranch 2:\n1. [PICK UP, fork]"
    )
    rules = [SCENE_RULE, rule("branches", first)]
    with model(make_settings, rules) as (reasoner, server, notes):
        (branch,) = reasoner.propose(ASSIGNMENT, SCENE)
    assert branch.actions == parse_plan(IN_RED)
    assert kinds(notes) == [NoteKind.REPAIR] * 3 + [NoteKind.DROPPED]
    assert "the scene has no 'fork'" in notes.notes[0].text
    repairs = [r.body["messages"][-1]["content"] for r in server.requests if r.turn]
    assert len(repairs) == 3 and all("branch 2: step 1" in text for text in repairs)


def test_nothing_usable_stops_the_reasoner(make_settings: Make) -> None:
    rules = [SCENE_RULE, rule("branches", "I like cups.")]
    with (
        model(make_settings, rules) as (reasoner, s, notes),
        pytest.raises(ReasonerStopped, match="proposed no plan") as caught,
    ):
        reasoner.propose(ASSIGNMENT, SCENE)
    assert caught.value.exit_code == 1
    assert len(s.requests) == 1 + 4 and kinds(notes)[-1] is NoteKind.DROPPED


def test_nothing_to_do_has_to_be_said_twice(make_settings: Make) -> None:
    done = rule("branches", '{"goal_holds": true, "branches": []}')
    with model(make_settings, [SCENE_RULE, done]) as (reasoner, server, _):
        assert list(reasoner.propose(ASSIGNMENT, SCENE)) == []
        assert len(server.requests) == 3
    wrong = rule("branches", '{"goal_holds": true, "branches": []}', turn=0)
    right = rule("branches", "1. [PICK UP, spoon]\n2. [PUT INTO, red cup]", turn=1)
    with model(make_settings, [SCENE_RULE, wrong, right]) as (reasoner, _, _):
        assert len(reasoner.propose(ASSIGNMENT, SCENE)) == 1


# -- judging -----------------------------------------------------------------------------------

SUCCESS = Verdict(Outcome.SUCCESS, None, ("chest",))
UNSAFE = Verdict(Outcome.UNSAFE, Cause(CauseKind.LOST, ("ball",), "ball is gone"), ("ball",))
SAYS = {
    outcome: json.dumps(
        {
            "before": [{"object": "chest", "state": "closed"}],
            "after": [{"object": "chest", "state": "open"}],
            "outcome": outcome,
            "explanation": "I see it.",
        }
    )
    for outcome in ("success", "failure", "unsafe", "unsure")
}


@pytest.mark.parametrize("judge", ["state", "both", "vlm"])
@pytest.mark.parametrize("said", sorted(SAYS))
@pytest.mark.parametrize("state", [SUCCESS, UNSAFE])
def test_who_decides(make_settings: Make, judge: str, said: str, state: Verdict) -> None:
    record = RolloutRecord(SCENE, SCENE, effect=True, cause=None)
    with model(make_settings, [rule("compare", SAYS[said])], judge, state) as (reasoner, s, notes):
        verdict = reasoner.judge(OPEN, record)
    expected = state.outcome.value if judge != "vlm" or said == "unsure" else said
    assert verdict.outcome.value == expected
    assert len(s.requests) == (judge != "state")
    assert (NoteKind.SETTLED in kinds(notes)) == (said == "unsure" and judge != "state")
    differs = said not in ("unsure", state.outcome.value) and judge != "state"
    assert (NoteKind.DISAGREEMENT in kinds(notes)) == differs
    if differs:
        assert "I see it." in notes.notes[-1].text


def test_unsure_states_are_settled_by_the_world(make_settings: Make) -> None:
    reply = (
        "Before:\n- Chest: closed\n\nAfter:\n- Chest: open\n- The ball is unsure, it may be lost"
    )
    record = RolloutRecord(SCENE, SCENE, effect=True, cause=None)
    with model(make_settings, [rule("compare", reply)], "both", SUCCESS) as (reasoner, _, notes):
        reasoner.judge(OPEN, record)
    assert any("ball after: unsure, it is on desk" in note.text for note in notes.notes)


@pytest.mark.parametrize(
    ("reply", "outcome"),
    [
        (SAYS["success"], Outcome.SUCCESS),
        (SAYS["unsure"], Outcome.FAILURE),
        ("After: \n- Chest: open", Outcome.SUCCESS),
        ("After: \n- Chest: closed", Outcome.FAILURE),
        ("After: \n- Chest: open\n- Ball: fell off the desk", Outcome.UNSAFE),
        ("I cannot say.", Outcome.FAILURE),
    ],
)
def test_alone_the_model_judges(make_settings: Make, reply: str, outcome: Outcome) -> None:
    """As on a real robot, where no exact state is known; doubt is no success."""
    record = RolloutRecord(SCENE, SCENE, effect=True, cause=None)
    with model(make_settings, [rule("compare", reply)]) as (reasoner, _, _):
        verdict = reasoner.judge(OPEN, record)
    assert verdict.outcome is outcome
    assert (verdict.cause is None) == (outcome is Outcome.SUCCESS)


# -- reflecting --------------------------------------------------------------------------------


def reflect(
    make: Make, rules: list[dict[str, Any]], step: FailedStep
) -> tuple[Branch | None, FakeServer, Notebook]:
    with model(make, rules) as (reasoner, server, notes):
        revised = list(reasoner.reflect(step))
        assert len(revised) <= 1
        return (revised[0] if revised else None), server, notes


def test_a_revision(make_settings: Make) -> None:
    rules = [rule("reflect", f"The ball is in the way.\n\n{CLEARED}"), rule("screen", "No.")]
    branch, server, notes = reflect(make_settings, rules, failed("[OPEN, chest]", 0, BLOCKED))
    assert branch is not None and branch.reason == "The ball is in the way."
    assert [str(a) for a in branch.actions] == [
        "[PICK UP, ball]",
        "[PUT ON, desk]",
        "[OPEN, chest]",
    ]
    assert branch.actions[1].safe and branch.actions[1].keepout
    assert "ball blocks chest" in server.requests[0].text
    assert [request.role for request in server.requests] == ["reflect", "screen"]
    assert kinds(notes) == [NoteKind.DIAGNOSIS]


def test_a_trick_is_screened_out(make_settings: Make) -> None:
    rules = [rule("reflect", CLEARED), rule("screen", "Yes, the ball is meant to hold it.")]
    branch, _, notes = reflect(make_settings, rules, failed("[OPEN, chest]", 0, BLOCKED))
    assert branch is None and kinds(notes)[-1] is NoteKind.SCREENED


def test_reordering_needs_no_screen(make_settings: Make) -> None:
    plan = "[PICK UP, ball] [PUT INTO, red_cup] [PICK UP, red_cup] [PUT ON, chest]"
    reply = "[PICK UP, red_cup] -> [PUT ON, chest] -> [PICK UP, ball] -> [PUT INTO, red_cup]"
    cause = Cause(CauseKind.NO_GRASP, ("ball",), "ball covers red_cup")
    branch, server, _ = reflect(make_settings, [rule("reflect", reply)], failed(plan, 2, cause))
    assert branch is not None and len(branch.actions) == 4 and len(server.requests) == 1


def test_a_premature_none_is_questioned_once(make_settings: Make) -> None:
    step = failed("[OPEN, chest]", 0, BLOCKED)
    branch, server, notes = reflect(make_settings, [rule("reflect", "None.")], step)
    assert branch is None and len(server.requests) == 2
    assert kinds(notes) == [NoteKind.QUESTIONED, NoteKind.NO_REVISION]
    assert "the record names ball" in server.requests[1].body["messages"][-1]["content"]
    rules = [
        rule("reflect", "None.", turn=0),
        rule("reflect", CLEARED, turn=1),
        rule("screen", "no"),
    ]
    assert reflect(make_settings, rules, step)[0] is not None


def test_a_mismatch_of_the_two_objects_has_no_revision(make_settings: Make) -> None:
    step = failed(IN_RED, 1, TOO_LIGHT)
    holding = replace(SCENE, holding="spoon")
    step = replace(step, record=replace(step.record, before=holding))
    branch, server, _ = reflect(make_settings, [rule("reflect", "None.")], step)
    assert branch is None and len(server.requests) == 1


@pytest.mark.parametrize(
    ("reply", "reason"),
    [
        ("[PICK UP, ball] [OPEN, chest]", "OPEN needs an empty hand"),
        ("[OPEN, chest]", "this is the plan that failed"),
        ("[PICK UP, spoon] [PUT ON, desk]", "leaves out that chest ends with"),
        ("1. [PICK UP]\n2. [OPEN, chest]", "PICK UP without an object"),
        ("Hm.", "neither a plan in it nor the word none"),
        ('{"steps": [', "damaged or incomplete"),
    ],
)
def test_unusable_revisions_are_bounded(make_settings: Make, reply: str, reason: str) -> None:
    step = failed("[OPEN, chest]", 0, BLOCKED)
    branch, server, notes = reflect(make_settings, [rule("reflect", reply)], step)
    assert branch is None and len(server.requests) == 4
    assert kinds(notes) == [NoteKind.REPAIR] * 3 + [NoteKind.DROPPED]
    assert all(reason in note.text for note in notes.notes)


# -- one-shot planning -------------------------------------------------------------------------


class Marked:
    """Frames without pictures, with marks."""

    def view(self, scene: SceneState, *, marks: bool = False) -> list[Any]:
        return []

    def rollout(self, record: RolloutRecord, count: int) -> list[Any]:
        return []

    def marks(self, scene: SceneState) -> dict[int, str]:
        return {1: "red_cup", 2: "red_cup"}


def test_words_speak_of_the_arrangement_in_which_they_were_said(make_settings: Make) -> None:
    later = scene_without("spoon", SCENE)
    rules = [SCENE_RULE, rule("branches", '{"branches": [["[PICK UP, ball]"]]}')]
    with model(make_settings, rules) as (reasoner, server, _):
        reasoner.propose(ASSIGNMENT, SCENE)
        first = [request.text for request in server.requests]
        reasoner.propose(replace(ASSIGNMENT, past=(SCENE,)), later)
        again = [request.text for request in server.requests[len(first) :]]
    told = ("That was said before the robot began", "then understood as: The spoon has to end in")
    for text in first:
        assert not any(words in text for words in told)
    assert all(told[0] in text and told[1] in text for text in again)
    spoon = re.search(r"arrangement .*?\n- spoon: (.*?)\n", again[0], re.DOTALL)
    assert spoon is not None and "lost" not in spoon[1]


def scene_without(name: str, scene: SceneState) -> SceneState:
    gone = replace(scene.states[name], lost=True, on=(), inside=None)
    return replace(scene, states={**scene.states, name: gone})


@pytest.mark.parametrize("planner", [OneShot.at_once, OneShot.by_steps])
def test_baselines(make_settings: Make, planner: Callable[[OneShot], Branch | None]) -> None:
    asked = Assignment(
        "Take the red cup. Mark 1 means horizontal grasping, mark 2 means vertical grasping."
    )
    plan = "1. pick(2)\n2. place on(chest)"
    rules = [
        rule("oneshot", plan),
        rule("cot_plan", plan),
        rule("cot_scene", "Label: both are the cup.\nStatus: all is well."),
        rule("cot_attention", "- the chest's edge"),
    ]
    notes = Notebook()
    with FakeServer(Player(rules)) as server:
        client = ChatClient(make_settings(server.url))
        asker = Asker(client, Prompts(), notes, seed=0)
        branch = planner(OneShot(asker, Marked(), asked, SCENE))
        client.close()
    assert branch is not None
    assert branch.actions == (
        Action(Verb.PICK_UP, "red_cup", GraspPose.VERTICAL),
        Action(Verb.PUT_ON, "chest"),
    )
    assert "1 = red_cup" in server.requests[-1].text
    if planner is OneShot.by_steps:
        assert [r.role for r in server.requests] == ["cot_scene", "cot_attention", "cot_plan"]
        assert "the chest's edge" in server.requests[-1].text


def test_a_baseline_without_a_plan(make_settings: Make) -> None:
    with FakeServer(lambda _: Reply("pick vertically")) as server:
        client = ChatClient(make_settings(server.url))
        asker = Asker(client, Prompts(), Notebook(), seed=0)
        assert OneShot(asker, None, ASSIGNMENT, SCENE).at_once() is None
        client.close()
    assert len(server.requests) == 4

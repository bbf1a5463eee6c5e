"""What the model is told and shown, and in which order it is asked to answer."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from etot_cli.control.simulated import WorldOutcome
from etot_cli.reasoning.protocol import Assignment, FailedStep
from etot_cli.reasoning.vlm import describe, schemas
from etot_cli.reasoning.vlm.asking import Asker
from etot_cli.reasoning.vlm.chat import Picture
from etot_cli.reasoning.vlm.client import ChatClient
from etot_cli.reasoning.vlm.fake_server import FakeServer
from etot_cli.reasoning.vlm.frames import Eye, moments
from etot_cli.reasoning.vlm.notes import Notebook, NoteKind
from etot_cli.reasoning.vlm.player import Player
from etot_cli.reasoning.vlm.prompts import BUILTIN, Prompts
from etot_cli.reasoning.vlm.reasoner import VlmReasoner
from etot_cli.reasoning.vlm.rendered import NominalOutcomes
from etot_cli.reasoning.vlm.session import VlmSession
from etot_cli.skills.action import Action, GraspPose, Verb, parse_plan
from etot_cli.specs.scene import Scene
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import Cause, CauseKind, ContactEvent, RolloutRecord, SceneState
from tests.vlm.conftest import Make
from tests.vlm.scenes import kitchen
from tests.vlm.scripts import SCENE as SCENE_REPLY
from tests.vlm.scripts import UNSURE, rule
from tests.vlm.test_reasoner import SUCCESS, StateJudge, failed

SCENE = kitchen()
SPOON = Assignment("Put the spoon into a cup.")
IN_RED = "1. [PICK UP, spoon]\n2. [PUT INTO, red cup]"
BLOCKED = Cause(CauseKind.BLOCKED, ("ball", "chest"), "the ball stops the drawer", 1.0)
COMMON = rule("scene", SCENE_REPLY), rule("compare", UNSURE), rule("reflect", "None.")
FROM_THE_FRONT = Eye((1.5, 0.0, 1.2), (0.0, 1.0, 0.0), (-0.6, 0.0, 0.8), (-0.8, 0.0, -0.6))


class Frames:
    """Grey pictures, of as many moments as a test says."""

    def __init__(self, *captions: str) -> None:
        self.captions = captions or ("before the action", "after 1.0 s, hit", "after the action")
        self.marked: list[bool] = []
        self.hinted: list[bool] = []

    def _picture(self, caption: str) -> Picture:
        return Picture.of_pixels(f"{caption}:", np.full((48, 64, 3), 90, np.uint8))

    def view(self, scene: SceneState, *, marks: bool = False) -> list[Picture]:
        self.marked.append(marks)
        return [self._picture("The desk now")]

    def rollout(
        self, record: RolloutRecord, count: int, *, marks: bool = False, hints: bool = True
    ) -> list[Picture]:
        self.marked.append(marks)
        self.hinted.append(hints)
        return [self._picture(caption) for caption in self.captions][-count:]

    def marks(self, scene: SceneState) -> dict[int, str]:
        return dict(enumerate(scene.states, 1))

    def eye(self, scene: SceneState) -> Eye:
        return FROM_THE_FRONT


@contextmanager
def model(
    make: Make, *rules: dict[str, Any], frames: Frames | None = None, images: int = 4, **more: Any
) -> Iterator[tuple[VlmReasoner, FakeServer, Notebook]]:
    notes = Notebook()
    with FakeServer(Player([*rules, *COMMON])) as server:
        client = ChatClient(make(server.url, images=images if frames else 0))
        state = more.pop("state", StateJudge(SUCCESS))
        yield VlmReasoner(Asker(client, Prompts(), notes, 0), frames=frames, state=state, **more), \
            server, notes  # fmt: skip
        client.close()


def renamed(**names: str) -> SceneState:
    """The kitchen with other names."""
    infos = {
        names.get(name, name): replace(info, name=names.get(name, name))
        for name, info in SCENE.infos.items()
    }
    states = {names.get(name, name): state for name, state in SCENE.states.items()}
    return replace(SCENE, infos=infos, states=states)


# -- what is told of the scene -----------------------------------------------------------------


def test_the_object_list_tells_where_how_large_and_which_colour(make_settings: Make) -> None:
    with model(make_settings, rule("branches", IN_RED), frames=Frames()) as (reasoner, server, _):
        reasoner.propose(SPOON, SCENE)
        list(reasoner.reflect(failed("[OPEN, chest]", 0, BLOCKED)))
    for request in server.requests:
        assert "- ball: rubber ball, green, 8 × 8 × 10 cm, at (60, 30, 20)" in request.text
        assert "- desk: the table top, a surface, x 0 to 80, y -60 to 60, its height z 13" in (
            request.text
        )
    assert {request.role for request in server.requests} == {"scene", "branches", "reflect"}
    lost = {**SCENE.states, "ball": replace(SCENE.states["ball"], lost=True)}
    assert "10 cm\n" in describe.catalogue(replace(SCENE, states=lost))


def test_the_cameras_viewpoint_is_told(make_settings: Make) -> None:
    seen_from_the_camera = replace(SCENE, forward=(-1.0, 0.0))
    with model(make_settings, rule("branches", IN_RED), frames=Frames()) as (reasoner, server, _):
        reasoner.propose(SPOON, SCENE)
        reasoner.judge(Action(Verb.OPEN, "chest"), RolloutRecord(SCENE, SCENE, True, None))
        list(reasoner.reflect(failed("[OPEN, chest]", 0, BLOCKED)))
        reasoner.propose(SPOON, seen_from_the_camera)
    for request in server.requests:
        assert "The camera is at (150, 0, 120)" in request.text
        assert "further right lies to the robot's left" in request.text
        assert "further up lies nearer to the robot" in request.text
    assert "In the task, left is to the robot's left" in server.requests[0].text
    assert "In the task, left is to the robot's right" in server.requests[-1].text
    aslant = Eye((0, 0, 1), (0.7, 0.7, 0), (0, 0, 1), (-0.7, 0.7, 0))
    assert "right lies further from the robot and to the robot's left" in describe.viewpoint(
        SCENE, aslant
    )
    assert "camera" not in describe.viewpoint(SCENE, None)


@pytest.mark.parametrize(
    ("names", "marked"),
    [
        ({}, False),
        ({"red_cup": "cup_1", "blue_cup": "cup_2"}, True),
        ({"red_cup": "cup", "blue_cup": "cup_2"}, True),
        ({"red_cup": "object_a", "spoon": "object_b"}, True),
    ],
)
def test_marks_where_names_do_not_tell_things_apart(
    make_settings: Make, names: dict[str, str], marked: bool
) -> None:
    scene, frames = renamed(**names), Frames()
    spoon = names.get("spoon", "spoon")
    cup = list(scene.states).index(names.get("red_cup", "red_cup"))
    called = str(cup + 1) if marked else "red cup"
    rules = [rule("branches", f"1. [PICK UP, {spoon}]\n2. [PUT INTO, {called}]")]
    with model(make_settings, *rules, frames=frames) as (reasoner, server, _):
        (branch,) = reasoner.propose(SPOON, scene)
        record = RolloutRecord(scene, scene, True, None)
        reasoner.judge(branch.actions[1], record)
        list(reasoner.reflect(FailedStep(branch, 1, record, SUCCESS, scene)))
    assert branch.actions[1].target == list(scene.states)[cup]
    assert frames.marked == [marked] * 3
    assert all(("Marks in the picture: 1 = " in r.text) is marked for r in server.requests)


def test_things_of_one_look_are_marked_whatever_their_names() -> None:
    cup = SCENE.infos["red_cup"]
    twins = {**SCENE.infos, "blue_cup": replace(SCENE.infos["blue_cup"], color=cup.color)}
    assert not describe.alike(SCENE) and describe.alike(replace(SCENE, infos=twins))


@pytest.mark.parametrize("wanted", [True, False])
def test_marks_as_the_user_says(make_settings: Make, wanted: bool) -> None:
    frames = Frames()
    rules = rule("branches", IN_RED)
    with model(make_settings, rules, frames=frames, marks=wanted) as (reasoner, _, _):
        reasoner.propose(SPOON, SCENE)
    assert frames.marked == [wanted]


# -- what is told of the pictures --------------------------------------------------------------


@pytest.mark.parametrize("images", [1, 2, 4])
@pytest.mark.parametrize("captions", [(), ("before the action, which never began",)])
def test_the_frames_described_are_the_frames_sent(
    make_settings: Make, images: int, captions: tuple[str, ...]
) -> None:
    rules = [rule("branches", IN_RED)]
    frames = Frames(*captions)
    with model(make_settings, *rules, frames=frames, images=images) as (reasoner, server, _):
        reasoner.propose(SPOON, SCENE)
        reasoner.judge(Action(Verb.OPEN, "chest"), RolloutRecord(SCENE, SCENE, False, BLOCKED))
        list(reasoner.reflect(failed("[OPEN, chest]", 0, BLOCKED)))
    for request in server.requests:
        (told,) = re.findall(r"(?:Pictures, in this order|One picture): (.*)\.", request.text)
        assert told.count(";") + 1 == len(request.images) <= images
        # The captions that stand above the pictures themselves.
        assert all(f"{caption}:" in request.text for caption in told.split("; "))
    reflect = server.requests[-1].text
    assert ("after the action" in reflect) is not bool(captions)


def test_without_pictures_none_are_spoken_of(make_settings: Make) -> None:
    with model(make_settings, rule("branches", IN_RED)) as (reasoner, server, _):
        reasoner.propose(SPOON, SCENE)
    assert all("There are no pictures" in request.text for request in server.requests)
    assert not any("camera" in request.text.lower() for request in server.requests)


# -- reasoning before the verdict --------------------------------------------------------------

ANSWERS = {
    "scene": schemas.SCENE,
    "branches": schemas.BRANCHES,
    "compare": schemas.COMPARISON,
    "reflect": schemas.REVISION,
    "screen": schemas.VERDICT,
}
REASONS = {"seen", "reasoning", "reason", "explanation", "diagnosis", "understanding"}
VERDICTS = {"goal_holds", "outcome", "verdict", "steps", "branches"}


def _objects(schema: dict[str, Any]) -> Iterator[list[str]]:
    """The fields of every object in a schema, in order."""
    if schema.get("type") == "object":
        assert schema["required"] == list(schema["properties"])
        yield list(schema["properties"])
        for field in schema["properties"].values():
            yield from _objects(field)
    elif schema.get("type") == "array":
        yield from _objects(schema["items"])


@pytest.mark.parametrize("role", sorted(ANSWERS))
def test_reasons_come_before_what_follows_from_them(role: str) -> None:
    text = (BUILTIN / f"{role}.md").read_text(encoding="utf-8")
    for fields in _objects(ANSWERS[role]):
        places = [text.find(f'"{field}":') for field in fields]
        assert -1 not in places and places == sorted(places), (role, fields)
        for number, field in enumerate(fields):
            assert field not in VERDICTS or REASONS & set(fields[:number]), (role, field)


# -- ways to hold ------------------------------------------------------------------------------

BOTH_WAYS = (
    "Branch 1:\n1. [PICK UP, red cup] (horizontal)\n\nBranch 2:\n1. [PICK UP, red cup] (vertical)"
)


@pytest.mark.parametrize(
    ("instruction", "poses"),
    [
        ("Pick up the red cup.", [None]),
        ("Pick up the red cup horizontally or vertically.", ["horizontal", "vertical"]),
        ("Take the red cup from the side or from above.", ["horizontal", "vertical"]),
    ],
)
def test_ways_to_hold_are_branches_only_where_the_task_asks(
    make_settings: Make, instruction: str, poses: list[str | None]
) -> None:
    with model(make_settings, rule("branches", BOTH_WAYS)) as (reasoner, _, notes):
        found = reasoner.propose(Assignment(instruction), SCENE)
    assert [branch.actions[0].pose for branch in found] == poses
    assert [note.kind for note in notes.notes] == [NoteKind.DROPPED] * (2 - len(poses))


def test_one_way_to_hold_is_the_models_to_choose(make_settings: Make) -> None:
    only = "1. [PICK UP, red cup] (vertical)"
    with model(make_settings, rule("branches", only)) as (reasoner, _, _):
        (branch,) = reasoner.propose(Assignment("Pick up the red cup."), SCENE)
    assert branch.actions == (Action(Verb.PICK_UP, "red_cup", GraspPose.VERTICAL),)


def test_a_grasp_that_slips_may_be_tried_in_the_other_pose(make_settings: Make) -> None:
    slip = Cause(CauseKind.SLIP, ("red_cup",), "red_cup slipped")
    step = failed("[PICK UP, red_cup] (horizontal)", 0, slip)
    rules = rule("reflect", "It slipped.\n1. [PICK UP, red cup] (vertical)")
    with model(make_settings, rules) as (reasoner, server, _):
        (branch,) = reasoner.reflect(step)
    assert branch.actions[0].pose is GraspPose.VERTICAL
    assert "only when the grasp itself fails" in server.requests[0].text


# -- hazards -----------------------------------------------------------------------------------


def test_what_an_earlier_step_covers_is_questioned_and_taken_out_first(make_settings: Make) -> None:
    """The drawer came out over the ball: the ball waits on the chest while it opens."""
    plan = "[OPEN, chest] [PICK UP, ball] [PUT INTO, chest] [CLOSE, chest]"
    covered = Cause(CauseKind.NO_GRASP, ("chest",), "chest covers ball")
    better = (
        "[PICK UP, ball] [PUT ON, chest] (safe place) [OPEN, chest] [PICK UP, ball] "
        "[PUT INTO, chest] [CLOSE, chest]"
    )
    rules = (
        rule("reflect", "None.", turn=0),
        rule("reflect", better, turn=1),
        rule("screen", "no"),
    )
    with model(make_settings, *rules) as (reasoner, server, notes):
        (branch,) = reasoner.reflect(failed(plan, 1, covered))
    assert [str(action) for action in branch.actions][:2] == ["[PICK UP, ball]", "[PUT ON, chest]"]
    assert "covered, enclosed or hid" in server.requests[0].text
    assert notes.notes[0].kind is NoteKind.QUESTIONED
    assert "[OPEN, chest] came before; if putting ball in a safe place" in notes.notes[0].text
    # The same failure at the first step: nothing came before it.
    with model(make_settings, rule("reflect", "None.")) as (reasoner, server, _):
        assert not reasoner.reflect(failed("[PICK UP, ball]", 0, covered))
    assert len(server.requests) == 1


# -- hints -------------------------------------------------------------------------------------


@pytest.mark.parametrize("told", [True, False])
def test_the_simulators_diagnosis_is_an_option(make_settings: Make, told: bool) -> None:
    frames = Frames()
    contacts = (ContactEvent(0.7, "chest.top", "ball", 9.0, 1.0),)
    moved = replace(SCENE.states["ball"], toppled=True)
    after = replace(SCENE, states={**SCENE.states, "ball": moved})
    step = failed("[OPEN, chest]", 0, BLOCKED)
    step = replace(step, record=RolloutRecord(SCENE, after, False, BLOCKED, contacts))
    with model(make_settings, frames=frames, hints=told) as (reasoner, server, notes):
        assert not reasoner.reflect(step)
    text = server.requests[0].text
    for hint in ("the ball stops the drawer", "chest.top touches ball", "ball: on desk → on desk"):
        assert (hint in text) is told, hint
    assert frames.hinted == [told]
    assert "It counts as failure" in text and "step 1, [OPEN, chest]" in text
    # Nor does the record speak against a model's "none".
    assert len(server.requests) == 1 + told
    assert (NoteKind.QUESTIONED in [note.kind for note in notes.notes]) is told


@pytest.mark.parametrize(
    ("asked", "state", "told"),
    [(None, True, True), (None, False, False), (True, False, True), (False, True, False)],
)
def test_hints_are_for_simulation_unless_asked(
    make_settings: Make, asked: bool | None, state: bool, told: bool
) -> None:
    """A session without exact states is one on a real robot, seen by a camera."""
    settings = make_settings("http://127.0.0.1:9/v1", hints=asked)
    session = VlmSession(settings, Scene(), seed=0, state=StateJudge(SUCCESS) if state else None)
    assert session.account().hints is told
    session.close()


def test_in_words_alone_what_changed_is_all_there_is_to_see(make_settings: Make) -> None:
    with model(make_settings, rule("reflect", "None."), hints=False) as (reasoner, server, _):
        reasoner.reflect(failed("[OPEN, chest]", 0, BLOCKED))
    text = server.requests[0].text
    assert "What changed while it was carried out" in text and BLOCKED.text not in text


def test_moments_without_hints_do_not_follow_the_record() -> None:
    contacts = (ContactEvent(3.1, "chest.top", "ball", 9.0, 1.0),)
    record = RolloutRecord(SCENE, SCENE, False, replace(BLOCKED, time_s=3.0), contacts)
    plain = replace(record, cause=None, contacts=())
    for count in range(5):
        found = moments(record, [4.0], 6.0, count, hints=False)
        assert found == moments(plain, [4.0], 6.0, count, hints=False) and len(found) == count
        assert all(what in ("the gripper acts", "on the way") for _, what in found)
    assert (3.0, "blocked") in moments(record, [4.0], 6.0, 2)


# -- places ------------------------------------------------------------------------------------


def test_every_place_that_plans_know_is_named_and_understood(make_settings: Make) -> None:
    system = Prompts()["system"].text
    for relation in Nearby:
        assert relation is Nearby.AT_POINT or f"({relation.value}" in system
    steps = [
        {"action": "PICK UP", "object": "spoon", "pose": "any", "note": ""},
        {"action": "PUT ON", "object": "desk", "pose": "any", "note": "left of the ball"},
    ]
    plan = {"reasoning": "", "branches": [{"reason": "", "steps": steps}], "goal_holds": False}
    with model(make_settings, rule("branches", json.dumps(plan))) as (reasoner, _, _):
        (branch,) = reasoner.propose(Assignment("Put the spoon left of the ball."), SCENE)
    assert branch.actions == parse_plan("[PICK UP, spoon] [PUT ON, desk] (left of ball)")


# -- several worlds ----------------------------------------------------------------------------


def test_without_pictures_varied_worlds_are_judged_by_their_state(make_settings: Make) -> None:
    """One question for an action, however many worlds it was tried in."""
    rules = [rule("compare", '{"before": [], "after": [], "outcome": "success"}')]
    unseen = NominalOutcomes()
    records = [RolloutRecord(SCENE, SCENE, True, None) for _ in range(5)]
    unseen.remember(WorldOutcome(records[0]))
    with model(make_settings, *rules, nominal=unseen.knows) as (reasoner, server, _):
        verdicts = [reasoner.judge(Action(Verb.OPEN, "chest"), record) for record in records]
    assert verdicts == [SUCCESS] * 5
    assert [request.role for request in server.requests] == ["compare"]

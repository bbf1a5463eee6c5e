"""What each method knows and does, on scenes of a few things and in worlds of a few lines."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from etot_cli.benchmark.methods.attention import StaticScene, considered
from etot_cli.benchmark.methods.keypoints import shortest, way_of_the_hand
from etot_cli.benchmark.methods.kinematic import KinematicSimulator
from etot_cli.benchmark.methods.nominal import predicted
from etot_cli.benchmark.methods.planners import OneShotPlanner, RecoveringPlanner
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.planning.search import search
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.builtin.judging import judge_action
from etot_cli.reasoning.protocol import Assignment, Branch, Outcome
from etot_cli.skills.action import format_plan, parse_plan
from etot_cli.specs.load import load_task
from etot_cli.world.snapshot import Memory, Snapshot
from etot_cli.world.state import CauseKind, RolloutRecord
from tests.planning.fakes import scene

SCENE = """\
instruction: {instruction}
scene:
  objects:
    {objects}
success:
  - present: {thing}
"""
BALL = "ball: {{kind: sphere, diameter: 0.06, at: [{x}, {y}]}}"
TEXTS = st.lists(
    st.sampled_from(
        ["[PICK UP, cup]", "[PICK UP, cup] (vertical)", "[PUT ON, desk]", "[PUT INTO, box]",
         "[OPEN, box]", "[CLOSE, box]", "[PUT ON, desk] (left of box)"]
    ),
    min_size=1, max_size=8,
)  # fmt: skip
ASKED = Assignment("Whatever.")
NOWHERE = Snapshot(b"", Memory())


def world(tmp_path: Path, instruction: str, thing: str, *objects: str) -> SimulatedWorld:
    path = tmp_path / "task.yaml"
    text = SCENE.format(instruction=instruction, objects="\n    ".join(objects), thing=thing)
    path.write_text(text, encoding="utf-8")
    return SimulatedWorld(load_task(path).scene, keep_frames=False)


def test_the_shortest_way_is_taken_and_of_equals_the_first() -> None:
    short, long = parse_plan("[PICK UP, cup]"), parse_plan("[PICK UP, cup] [PUT ON, box]")
    branches = [Branch(long, "long"), Branch(short, "short"), Branch(short, "again")]
    chosen = shortest(branches, scene())
    assert chosen is not None and chosen.reason == "short"
    assert way_of_the_hand(long, scene()) == pytest.approx((0.2**2 + 0.1**2 + 0.25**2) ** 0.5)
    assert shortest([], scene()) is None


@given(TEXTS)
@pytest.mark.slow
def test_what_is_imagined_keeps_the_scene_whole(texts: list[str]) -> None:
    now = scene()
    for action in parse_plan(" ".join(texts)):
        after = predicted(now, action)
        assert after.states.keys() == now.states.keys()
        assert not any(state.lost or state.toppled for state in after.states.values())
        held = [name for name, state in after.states.items() if state.in_hand]
        assert held == ([] if after.holding is None else [after.holding])
        now = after


@pytest.mark.parametrize(
    "plan",
    ["[PICK UP, cup]", "[PICK UP, cup] [PUT ON, desk]", "[OPEN, box]",
     "[OPEN, box] [PICK UP, cup] [PUT INTO, box] [CLOSE, box]",
     "[PICK UP, cup] [PUT ON, desk] (left of box)", "[PICK UP, cup] [PUT ON, desk] (at edge)"],
)  # fmt: skip
def test_the_judge_takes_what_is_imagined_for_success(plan: str) -> None:
    now = scene()
    for action in parse_plan(plan):
        after = predicted(now, action)
        verdict = judge_action(action, RolloutRecord(now, after, True, None))
        assert verdict.outcome is Outcome.SUCCESS, (str(action), verdict.cause)
        now = after


DRAWER = (
    "chest: {kind: drawer_unit, at: [0.5, 0.0], yaw_deg: 180, size: [0.24, 0.18, 0.15], "
    "drawers: [{name: top, height: 0.07, travel: 0.14, open: 0.14, "
    "handle: {width: 0.08, depth: 0.03, thickness: 0.01}}]}"
)
BLOCK = "{name}: {{kind: box, size: [0.04, 0.04, 0.04], at: [0.4, {y}]}}"


@pytest.mark.parametrize(
    ("text", "objects", "plan"),
    [
        # Where physics says otherwise: this ball is far too wide for the gripper.
        (
            "Pick up the ball.",
            [BALL.format(x=0.4, y=0.0).replace("0.06", "0.12")],
            "[PICK UP, ball]",
        ),
        # What stands open is closed once, where that is said.
        (
            "Put the ball and the cube into the chest, then close it.",
            [DRAWER, BLOCK.format(name="ball", y=-0.2), BLOCK.format(name="cube", y=0.2)],
            "[PICK UP, ball] [PUT INTO, chest] [PICK UP, cube] [PUT INTO, chest] [CLOSE, chest]",
        ),
    ],
)
def test_the_kinematic_model_believes_in_the_first_plan(
    tmp_path: Path, text: str, objects: list[str], plan: str
) -> None:
    twin = world(tmp_path, text, "ball", *objects)
    start, seen = twin.start()
    model = KinematicSimulator()
    model.begin_from(start, seen)
    assert format_plan(search(Assignment(text), model, BuiltinReasoner()).plan) == plan


def first_plan(twin: SimulatedWorld, instruction: str) -> tuple[str, int]:
    start, seen = twin.start()
    reasoner = BuiltinReasoner()
    branches = reasoner.propose(Assignment(instruction), seen)
    found = considered(branches, StaticScene(twin.world, start, seen), seen, reasoner)[0]
    return format_plan(found.branch.actions), found.open_points


def test_what_fills_a_mouth_is_taken_out_first(tmp_path: Path) -> None:
    text = "Put the ball into the cup."
    cup = "cup: {kind: cup, diameter: 0.09, height: 0.08, mass: 0.2, at: [0.4, 0.2]}"
    block = "block: {kind: box, size: [0.05, 0.05, 0.05], inside: cup}"
    plain = world(tmp_path, text, "ball", BALL.format(x=0.4, y=-0.1), cup)
    assert first_plan(plain, text) == ("[PICK UP, ball] [PUT INTO, cup]", 0)
    filled = world(tmp_path, text, "ball", BALL.format(x=0.4, y=-0.1), cup, block)
    plan, left = first_plan(filled, text)
    assert plan.startswith("[PICK UP, block] [PUT ON, desk]") and left == 0


def test_what_is_taller_than_the_compartment_is_seen(tmp_path: Path) -> None:
    """And looking leaves the state as it was: the second look sees the same."""
    actions = parse_plan("[CLOSE, chest]")
    for height, blocked in ((0.04, False), (0.12, True)):
        block = (
            f"block: {{kind: box, size: [0.05, 0.05, {height}], inside: chest, at: [0.31, 0.0]}}"
        )
        twin = world(tmp_path, "Close the chest.", "block", DRAWER, block)
        start, seen = twin.start()
        for _ in range(2):
            point = StaticScene(twin.world, start, seen).point(actions, 0)
            assert (point is not None) == blocked
            if point is not None:
                assert point.cause.kind is CauseKind.BLOCKED
                assert point.cause.objects == ("block",)


def test_what_is_wider_than_the_gripper_is_seen(tmp_path: Path) -> None:
    wide = "block: {kind: box, size: [0.12, 0.10, 0.05], at: [0.4, 0.0]}"
    twin = world(tmp_path, "Pick up the block.", "block", wide)
    start, seen = twin.start()
    point = StaticScene(twin.world, start, seen).point(parse_plan("[PICK UP, block]"), 0)
    assert point is not None and point.cause.kind is CauseKind.SLIP
    assert point.cause.objects == ("block",)


def test_a_plan_of_one_shot_and_a_recovery() -> None:
    first = OneShotPlanner(lambda asked, start, seen: Branch(parse_plan("[PICK UP, cup]")))
    oracle = OneShotPlanner(lambda asked, start, seen: Branch(parse_plan("[OPEN, box]")))
    planner = RecoveringPlanner(first, oracle)
    begun = planner.plan(ASKED, NOWHERE, scene(), ())
    assert format_plan(begun.actions) == "[PICK UP, cup]" and begun.motions == (None,)
    assert (
        format_plan(planner.plan(ASKED, NOWHERE, scene(), begun.actions).actions) == "[OPEN, box]"
    )
    none = OneShotPlanner(lambda asked, start, seen: None).plan(ASKED, NOWHERE, scene(), ())
    assert none.status == "infeasible" and none.reason == "no plan was proposed"

"""What somebody does to a simulated scene, and what of it is noticed or held against the robot."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from etot_cli.execution.differences import differences
from etot_cli.execution.disturbing import Roles, disturb, roles_of
from etot_cli.execution.evaluation import HarmWatch, evaluate
from etot_cli.execution.world import ExecutionWorld
from etot_cli.skills.action import parse_plan
from etot_cli.specs.disturbance import Disturbance
from etot_cli.specs.load import load_task
from etot_cli.specs.task import Task
from etot_cli.world.state import SceneState

TASK = """\
instruction: Put the ball into the cup.
scene:
  variation: {position_m: 0.0, yaw_deg: 0.0}
  objects:
    ball: {kind: sphere, diameter: 0.05, mass: 0.05, at: [0.36, 0.12]}
    cup: {kind: cup, diameter: 0.095, height: 0.09, mass: 0.2, at: [0.38, -0.15]}
    chest: {kind: drawer_unit, at: [0.55, 0.3], size: [0.2, 0.15, 0.15], drawers: [{name: top}]}
success:
  - inside: [ball, cup]
"""
EXTRA = "disturbance: {add: brick, object: {kind: box, size: [0.05, 0.05, 0.05], on: cup}}\n"


@pytest.fixture
def task(tmp_path: Path) -> Task:
    file = tmp_path / "task.yaml"
    file.write_text(TASK + EXTRA)
    return load_task(file)


@pytest.fixture
def world(task: Task) -> ExecutionWorld:
    (given,) = task.disturbances
    assert given.add is not None
    assert given.object is not None
    return ExecutionWorld(task.scene, 3, {given.add: given.object})


def after(world: ExecutionWorld, **given: object) -> SceneState:
    disturb(world, Disturbance.model_validate(given), Roles("ball", "cup"))
    return world.read()


@pytest.mark.slow
def test_every_deed(world: ExecutionWorld, task: Task) -> None:
    start = world.read()
    assert "brick" not in start.states
    moved = after(world, move="chosen", by=(0.05, 0.0))
    assert moved.states["ball"].position[0] == pytest.approx(
        start.states["ball"].position[0] + 0.05, abs=0.01
    )
    dropped = after(world, drop="chosen", inside="cup")
    assert dropped.states["ball"].inside == "cup"
    opened = after(world, part="chest", to=0.8)
    assert opened.states["chest"].openness["top"] == pytest.approx(0.8, abs=0.05)
    fallen = after(world, knock_over="cup")
    assert fallen.states["cup"].toppled
    gone = after(world, remove="ball")
    assert "ball" not in gone.states
    (adds,) = task.disturbances
    disturb(world, adds, Roles())
    assert "brick" in world.read().states
    assert not evaluate(task.success, gone, HarmWatch()).success  # what is gone is in no cup


def test_what_is_in_the_way_is_set_down_on_top(world: ExecutionWorld) -> None:
    cup = world.read().states["cup"].position
    there = after(world, move="ball", at=(cup[0], cup[1]))
    assert there.states["ball"].inside == "cup" or there.states["ball"].position[2] > cup[2]
    assert not any(state.lost for state in there.states.values())


def test_nobody_has_a_role_yet(world: ExecutionWorld) -> None:
    given = Disturbance.model_validate({"remove": "chosen"})
    assert "nothing has that role" in disturb(world, given, Roles())
    nowhere = Disturbance.model_validate({"move": "ball", "inside": "desk"})
    assert "there is no room for it" in disturb(world, nowhere, Roles())
    fastened = Disturbance.model_validate({"remove": "chosen"})
    assert "fastened" in disturb(world, fastened, Roles("chest"))


def test_roles_come_from_the_plan() -> None:
    plan = parse_plan("[OPEN, chest] [PICK UP, ball] [PUT INTO, chest.top]")
    assert roles_of(plan, None) == Roles("ball", "chest")
    assert roles_of(plan[2:], "ball") == Roles("ball", "chest")
    assert roles_of((), None) == Roles(None, None)


def test_what_is_noticed(world: ExecutionWorld) -> None:
    start = world.read()
    state = start.states["ball"]

    def with_ball(**changed: object) -> SceneState:
        ball = replace(state, **changed)  # type: ignore[arg-type]
        return replace(start, states={**start.states, "ball": ball})

    x, y, z = state.position
    assert not differences(start, start)
    assert not differences(start, with_ball(position=(x + 0.015, y, z)))
    assert [item.text for item in differences(start, with_ball(lost=True))] == ["is gone"]
    (far,) = differences(start, with_ball(position=(x, y - 0.1, z)))
    assert (far.name, far.text) == ("ball", "stands 10 cm from where it was")
    (fell,) = differences(start, with_ball(toppled=True))
    assert fell.text == "has fallen over"
    fewer = replace(start, states={k: v for k, v in start.states.items() if k != "ball"})
    assert [item.text for item in differences(fewer, start)] == ["is new"]
    (shut,) = differences(after(world, part="chest", to=0.8), after(world, part="chest", to=0.0))
    assert shut.name == "chest"


def test_harm_is_what_the_robot_did_and_did_not_mend(world: ExecutionWorld) -> None:
    start = world.read()
    off = replace(start.states["ball"], lost=True)
    lost = replace(start, states={**start.states, "ball": off})
    watch = HarmWatch()
    watch.motion(start, lost, spare=("ball",))
    assert not watch.harm(lost)  # somebody else's doing
    watch.motion(start, lost)
    assert watch.harm(lost) == ("ball fell off the desk",)
    assert not watch.harm(start)

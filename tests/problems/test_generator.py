"""The random problems themselves: valid, repeatable, and what they are said to be."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path

import mujoco
import pytest

from etot_cli.benchmark.problems import FAMILIES, problem
from etot_cli.benchmark.problems.margins import GRASPABLE, reach_over
from etot_cli.skills.action import parse_plan
from etot_cli.specs.load import load_task
from etot_cli.world.state import CauseKind
from tests.problems.infeasible import COUNTS, INFEASIBLE, Hopeless, any_problem
from tests.world.helpers import set_up


@pytest.mark.parametrize("family", COUNTS)
def test_loads_and_names_what_is_there(family: str, tmp_path: Path) -> None:
    for seed in range(COUNTS[family]):
        made = any_problem(family, seed)
        task = load_task(made.write(tmp_path))
        names = set(task.scene.objects)
        assert bool(made.plan) != isinstance(made, Hopeless), made.id
        if made.plan:
            targets = {action.target.split(".")[0] for action in parse_plan(" ".join(made.plan))}
            assert targets <= names | {"desk"}, made.id
        if isinstance(made, Hopeless):
            assert set(made.reason.objects) <= names, made.id
            assert set(made.reason.kinds) <= {kind.value for kind in CauseKind}, made.id


def test_the_measured_set_is_as_large_as_it_is_said_to_be() -> None:
    assert len(FAMILIES) >= 6
    assert sum(count for _, count in FAMILIES.values()) == 120
    assert INFEASIBLE == 40


@pytest.mark.parametrize("family", COUNTS)
def test_the_same_seed_is_the_same_problem_and_another_is_not(family: str) -> None:
    again = any_problem(family, 3 + COUNTS[family])
    assert any_problem(family, 3) == any_problem(family, 3)
    assert any_problem(family, 3).task["scene"] != again.task["scene"]


def test_crowds_are_crowds() -> None:
    sizes = [len(problem("crowd", seed).task["scene"]["objects"]) for seed in range(10)]
    assert min(sizes) >= 8
    assert max(sizes) <= 12
    assert len(Counter(sizes)) > 2


@pytest.mark.parametrize("family", FAMILIES)
def test_what_a_plan_picks_up_can_be_held_and_reached(family: str) -> None:
    """Widths and distances, read off the finished scene."""
    for seed in range(FAMILIES[family][1]):
        made = problem(family, seed)
        objects = made.task["scene"]["objects"]
        for action in parse_plan(" ".join(made.plan)):
            item = objects.get(action.target)
            if action.verb.value != "PICK UP" or item is None:
                continue
            if item["kind"] == "box":
                assert sorted(item["size"])[0] <= GRASPABLE, made.id
            elif item["kind"] not in ("cup", "bowl"):
                assert item["diameter"] <= GRASPABLE, made.id
            if "at" in item and "inside" not in item:
                assert math.hypot(*item["at"][:2]) < 0.60, made.id


def test_reach_is_that_of_the_arm_as_its_maker_describes_it() -> None:
    """A hand that points down: the wrist within the arm's two segments of the shoulder."""
    upper, fore = math.hypot(0.0535, 0.2845), math.hypot(0.0775, 0.3425)
    for top in (0.05, 0.15, 0.25):
        radius, tool = reach_over(top), 0.13 + top + 0.09
        wrist = math.hypot(radius - 0.076, tool + 0.172 + 0.097 - 0.267)
        assert wrist < upper + fore - 0.02


@pytest.mark.parametrize("family", COUNTS)
@pytest.mark.slow
def test_the_waiting_arm_is_clear_of_everything(family: str, tmp_path: Path) -> None:
    for seed in range(COUNTS[family]):
        stage = set_up(load_task(any_problem(family, seed).write(tmp_path)).scene, settle=0.0)
        model, owner = stage.world.model, stage.world.geom_object
        robot = [index for index, name in enumerate(owner) if name in ("robot", "gripper")]
        model.geom_margin[robot] = model.body_margin[:] = 0.02
        mujoco.mj_forward(model, stage.data)
        for pair in stage.data.contact.geom:
            names = {owner[int(geom)] for geom in pair}
            arm = names & {"robot", "gripper"}
            assert not arm or names == arm, f"{family}:{seed}: {names}"

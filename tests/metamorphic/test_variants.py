"""Nothing knows a task: other names, the mirror image or other wording change no outcome."""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import closing
from functools import cache
from pathlib import Path

import pytest

from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.control.simulator import open_simulator
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Assignment
from etot_cli.reporting.plan_report import PlanReport
from etot_cli.specs.load import load_task
from etot_cli.world.state import SceneState
from tests.metamorphic.variants import document, mirrored, new_words, renamed, reworded, write
from tests.shared import planned

FOLDER = Path(__file__).parents[2] / "tasks"
OTHERS = Path(__file__).parents[1] / "tasks"
TASKS = ("task1", "task2", "task3", "task4", "task5", "task6", "task7", "disturbance")
MORE = ("cupboard", "marker_and_mugs", "three_drawers", "no_grasp", "too_big")
"""Tasks of our own that name no file beside them."""
REWORDINGS = {
    "task1": (
        "Please open the microwave.",
        "Pull the door of the microwave open.",
        "Make sure that the microwave's door is open.",
    ),
    "task2": (
        "Put the pen in one of the holders.",
        "Take any pen and insert it into either the white holder or the black holder.",
        "Pick up the pen, then place it inside a holder.",
    ),
    "task3": (
        "Grab the holder from the side or from above.",
        "Lift up the holder, either horizontally or vertically.",
        "Take the holder that is on the drawer horizontally or vertically.",
    ),
    "task4": (
        "Shut the drawer.",
        "Push the drawer closed, please.",
        "Ensure that the top drawer is closed.",
    ),
    "task5": (
        "Insert the pen into one of the holders.",
        "Please reorient the pen and put it in a holder.",
        "Store the pen in any holder.",
    ),
    "task6": (
        "Put the apple and the holder on the drawer, with the apple in the holder.",
        "Place both the apple and the holder on top of the drawer, with the apple inside the "
        "holder.",
    ),
    "task7": (
        "Place the apple and the ball into either the drawer or the pen holder, together or "
        "separately. Make sure the drawer is closed.",
        "Store the apple and the tennis ball in the drawer or the holder, together or separately, "
        "and make sure that the drawer is closed at the end.",
    ),
    "disturbance": (
        "Grab one of the tennis balls.",
        "Please take either tennis ball.",
        "Lift up any ball.",
    ),
}
"""Other ways to say what the shipped tasks say."""


Outcome = Callable[[str], tuple[str, tuple[str, ...]]]


@pytest.fixture(scope="session")
def outcome(tmp_path_factory: pytest.TempPathFactory) -> Outcome:
    """Status and plan of a task as it is."""

    def read(name: str) -> tuple[str, tuple[str, ...]]:
        report = json.loads((planned(tmp_path_factory, file_of(name)) / "report.json").read_text())
        return report["status"], tuple(report["plan"])

    return read


def _outcome(report: PlanReport) -> tuple[str, tuple[str, ...]]:
    return report.status, tuple(report.plan)


def file_of(name: str) -> Path:
    return (FOLDER if name in TASKS else OTHERS) / f"{name}.yaml"


@pytest.mark.slow
@pytest.mark.parametrize("name", (*TASKS, *MORE))
def test_renamed(name: str, outcome: Outcome, tmp_path: Path) -> None:
    task = document(file_of(name))
    words = new_words(task, seed=sum(name.encode()))
    changed = renamed(task, words)
    assert not set(changed["scene"]["objects"]) & set(task["scene"]["objects"])
    report = plan_task(PlanOptions(task=write(changed, tmp_path), jobs=1)).report
    status, plan = outcome(name)
    assert _outcome(report) == (status, tuple(reworded(action, words) for action in plan))


@pytest.mark.slow
@pytest.mark.parametrize("name", (*TASKS, *MORE))
def test_mirrored(name: str, outcome: Outcome, tmp_path: Path) -> None:
    file = write(mirrored(document(file_of(name))), tmp_path)
    assert _outcome(plan_task(PlanOptions(task=file, jobs=1)).report) == outcome(name)


@cache
def start(name: str) -> SceneState:
    task = load_task(FOLDER / f"{name}.yaml")
    with closing(open_simulator(task.scene, seed=0, jobs=1, worlds=1, record=False)) as simulator:
        return simulator.start()[1]


def branches(instruction: str, scene: SceneState) -> set[tuple[str, ...]]:
    proposed = BuiltinReasoner().propose(Assignment(instruction, None), scene)
    return {tuple(str(action) for action in branch.actions) for branch in proposed}


@pytest.mark.parametrize(
    ("name", "instruction"), [(name, text) for name, texts in REWORDINGS.items() for text in texts]
)
def test_reworded_instruction_branches(name: str, instruction: str) -> None:
    scene = start(name)
    said = load_task(FOLDER / f"{name}.yaml").instruction
    assert branches(instruction, scene) == branches(said, scene)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "instruction"),
    [
        ("task4", "Shut the drawer."),
        # Named in the other order, which happens to be the one that works.
        ("task6", "Put the holder and the apple on the drawer, with the apple in the holder."),
    ],
)
def test_reworded_instruction_plan(
    name: str, instruction: str, outcome: Outcome, tmp_path: Path
) -> None:
    task = document(FOLDER / f"{name}.yaml")
    file = write({**task, "instruction": instruction}, tmp_path)
    assert _outcome(plan_task(PlanOptions(task=file, jobs=1)).report) == outcome(name)

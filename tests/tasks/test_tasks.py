"""Tasks with other objects, furniture and arms than the shipped ones: planned, then simulated."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.commands.simulate import SimulateOptions, run_simulate
from etot_cli.planning.result import SearchStatus
from etot_cli.reporting.plan_report import PlanReport
from tests.metamorphic.variants import document, write
from tests.shared import planned

FOLDER = Path(__file__).parent
LIMIT_S = 60.0
"""Wall time that a whole search may take, on a machine that has other things to do [s]."""

PLANS = {
    "cupboard": ["[PICK UP, vase]", "[PUT ON, *]", "[OPEN, cupboard]"],
    "drawer_to_cabinet": [
        "[OPEN, locker]", "[OPEN, chest]", "[PICK UP, tin] (horizontal)", "[PUT INTO, locker]",
        "[CLOSE, chest]", "[CLOSE, locker]",
    ],
    "drawer_to_rack": [
        "[OPEN, chest]", "[PICK UP, tin] (to put on rack.low)", "[PUT ON, rack.low]",
        "[CLOSE, chest]",
    ],
    "marker_and_mugs": ["[PICK UP, marker]", "[PUT INTO, pink_mug]"],
    "mugs_in_cupboard": [
        *("[PICK UP, red_mug] (horizontal)", "[PUT INTO, cupboard]"),
        *("[PICK UP, green_mug] (horizontal)", "[PUT INTO, cupboard]"),
        *("[PICK UP, blue_mug] (horizontal)", "[PUT INTO, cupboard]", "[CLOSE, cupboard]"),
    ],
    "mujoco_models": [
        "[OPEN, caddy.upper]", "[PICK UP, spool]", "[PUT INTO, caddy.upper]",
        "[CLOSE, caddy.upper]",
    ],
    "nested": [
        "[PICK UP, ball]", "[PUT ON, *]", "[PICK UP, dish]", "[PUT ON, tray]",
        "[PICK UP, ball]", "[PUT INTO, bowl]",
    ],
    "oven": [
        "[OPEN, oven]", "[PICK UP, mug] (horizontal)", "[PUT INTO, oven]", "[CLOSE, oven]",
    ],
    "rack": ["[PICK UP, vase] (horizontal)", "[PUT ON, rack.middle]"],
    "seven_joints": [
        "[PICK UP, carton]", "[PUT ON, rack.high]", "[PICK UP, ball]", "[PUT INTO, bowl]",
    ],
    "take_out": ["[OPEN, oven]", "[PICK UP, mug] (horizontal)", "[PUT ON, desk]"],
    "three_drawers": [
        "[OPEN, dresser]", "[PICK UP, battery]", "[PUT INTO, dresser]", "[CLOSE, dresser]",
    ],
}  # fmt: skip
"""Feasible tasks and their right plans; ``*`` is any surface."""

INFEASIBLE = {"too_big": {"globe"}, "no_grasp": {"wide_crate", "far_crate"}}
"""Tasks without a plan, and what the causes of failure must name between them."""


def report_of(name: str, temporary: pytest.TempPathFactory) -> PlanReport:
    folder = planned(temporary, FOLDER / f"{name}.yaml")
    report = PlanReport.model_validate_json((folder / "report.json").read_text(encoding="utf-8"))
    assert report.statistics.wall_s < LIMIT_S
    assert (folder / "code").read_text() == ("0" if report.status == "feasible" else "1")
    return report


def causes(report: PlanReport) -> str:
    return "; ".join(
        f"{node.action}: {node.cause.text}" for node in report.tree.nodes if node.cause is not None
    )


def matches(plan: list[str], wanted: list[str]) -> bool:
    return len(plan) == len(wanted) and all(
        have == want or have.startswith(want.split("*")[0])
        for have, want in zip(plan, wanted, strict=True)
    )


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(PLANS))
def test_feasible_task(name: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    report = report_of(name, tmp_path_factory)
    assert report.status == SearchStatus.FEASIBLE.value, causes(report)
    assert matches(report.plan, PLANS[name]), report.plan
    written = " ".join(report.plan)
    kept_free = any(node.keepout for node in report.tree.nodes)
    if kept_free:  # what the written form leaves out
        written = str(planned(tmp_path_factory, FOLDER / f"{name}.yaml"))
    options = SimulateOptions(task=FOLDER / f"{name}.yaml", plan=written)
    simulated = run_simulate(options).report
    assert simulated.status == "success", simulated.cause


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(INFEASIBLE))
def test_infeasible_task(name: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    report = report_of(name, tmp_path_factory)
    assert report.status == SearchStatus.INFEASIBLE.value, report.plan
    causes = [node.cause for node in report.tree.nodes if node.cause is not None]
    assert {name for cause in causes for name in cause.objects} >= INFEASIBLE[name]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("hinge", "robot"),
    [("right", "xarm6"), ("left", "robots/heron/robot.yaml")],
    ids=["far hinge", "other arm"],
)
def test_cupboard_otherwise(hinge: str, robot: str, tmp_path: Path) -> None:
    """With a far hinge the hand cannot stay on the handle all the way."""
    shutil.copytree(FOLDER / "robots", tmp_path / "robots")
    task = document(FOLDER / "cupboard.yaml")
    task["scene"]["robot"] = robot
    task["scene"]["objects"]["cupboard"]["door"]["hinge"] = hinge
    report = plan_task(PlanOptions(task=write(task, tmp_path), jobs=1)).report
    assert report.status == SearchStatus.FEASIBLE.value, causes(report)
    assert matches(report.plan, PLANS["cupboard"]), report.plan


def test_every_task_is_tested() -> None:
    assert {path.stem for path in FOLDER.glob("*.yaml")} == {*PLANS, *INFEASIBLE}

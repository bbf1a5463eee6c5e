"""The main job as a user runs it: processes, files, exit codes."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import jsonschema
import pytest
import yaml

from tests.measure.expectations import NAIVE_PLANS, TASKS, is_right_plan
from tests.program import etot
from tests.shared import planned

ROOT = Path(__file__).resolve().parents[2]
SCHEMAS = ROOT / "docs" / "schemas"
TIME_LIMIT_S = 180
"""Generous: the test machine may be busy. Speed itself is measured by ``make bench``."""


def slow(*case: object) -> object:
    """A case that is left out when there is little time."""
    return pytest.param(*case, marks=pytest.mark.slow)


def plan(task: str, out: Path, *extra: str) -> tuple[int, dict]:
    done = etot("plan", f"tasks/{task}.yaml", "--json", "--out", out, *extra)
    assert done.stdout, done.stderr
    return done.returncode, checked(done.stdout, out)


def checked(printed: str, out: Path) -> dict:
    """The report that a plan command printed, which is the one that it wrote, and valid."""
    report = json.loads(printed)
    schema = json.loads((SCHEMAS / "etot.plan-1.json").read_text())
    jsonschema.validate(report, schema)
    assert report == json.loads((out / "report.json").read_text())
    return report


def test_a_scene_and_what_is_wanted_are_enough(tmp_path: Path) -> None:
    """No name, no success conditions, and of instruction and goal only one."""
    ball = {"kind": "sphere", "at": [0.4, -0.1], "diameter": 0.06, "mass": 0.05}
    bowl = {"kind": "bowl", "at": [0.4, 0.2], "diameter": 0.16, "height": 0.06, "mass": 0.2}
    scene = {"objects": {"ball": ball, "bowl": bowl}}
    for number, wanted in enumerate(
        ({"goal": [{"inside": ["ball", "bowl"]}]}, {"instruction": "Put the ball in the bowl."})
    ):
        task = tmp_path / f"task_{number}.yaml"
        task.write_text(yaml.safe_dump(wanted | {"scene": scene}))
        done = etot("plan", task, "--json", "--out", tmp_path / str(number))
        assert done.returncode == 0, done.stderr
        report = checked(done.stdout, tmp_path / str(number))
        assert report["plan"] == ["[PICK UP, ball]", "[PUT INTO, bowl]"]
        assert report["success"] is None
        assert report["task"]["instruction"]
    done = etot("execute", task, "--json", "--out", tmp_path / "execute")
    assert done.returncode == 0, done.stderr
    assert [trial["success"] for trial in json.loads(done.stdout)["trials"]] == [True]


@pytest.mark.parametrize("task", ["task3", *(slow(task) for task in TASKS if task != "task3")])
def test_plan_is_the_right_one_and_its_simulation_agrees(
    task: str, tmp_path: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = planned(tmp_path_factory, ROOT / "tasks" / f"{task}.yaml")
    report = checked((folder / "stdout").read_text(), folder)
    assert (folder / "code").read_text() == "0"
    assert report["status"] == "feasible"
    assert is_right_plan(task, report["plan"])
    done = etot(
        "simulate", f"tasks/{task}.yaml", "--plan", folder / "report.json",
        "--json", "--out", tmp_path / "simulate",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    simulated = json.loads(done.stdout)
    jsonschema.validate(simulated, json.loads((SCHEMAS / "etot.simulate-1.json").read_text()))
    assert simulated["status"] == "success"
    assert [step["action"] for step in simulated["steps"]] == report["plan"]
    assert simulated["success_conditions"]["held"]


@pytest.mark.slow
@pytest.mark.parametrize("naive", NAIVE_PLANS, ids=lambda naive: f"{naive.task}-{naive.blame}")
def test_naive_plan_fails_and_names_the_culprit(naive, tmp_path: Path) -> None:
    done = etot(
        "simulate", f"tasks/{naive.task}.yaml", "--plan", naive.plan, "--json", "--out", tmp_path
    )
    assert done.returncode == 1, done.stderr
    report = json.loads(done.stdout)
    assert report["status"] in ("failure", "unsafe")
    assert naive.blame in report["steps"][-1]["cause"]["objects"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("task", "solved"), [("task1", False), ("task2", True), ("task3", True), ("task6", False)]
)
def test_without_reflective_branching(task: str, solved: bool, tmp_path: Path) -> None:
    code, report = plan(task, tmp_path, "--without", "reflective")
    assert (code == 0) is solved
    assert (report["status"] == "feasible") is solved
    assert not [n for n in report["tree"]["nodes"] if n["origin"] == "reflective"]


@pytest.mark.slow
def test_without_priori_branching_there_is_one_branch(tmp_path: Path) -> None:
    _, report = plan("task7", tmp_path, "--without", "priori", "--without", "reflective")
    parents = [node["parent"] for node in report["tree"]["nodes"]]
    assert len(parents) == len(set(parents))


@pytest.mark.slow
def test_jobs_change_nothing_but_the_time(tmp_path: Path) -> None:
    reports = [plan("task6", tmp_path / jobs, "--jobs", jobs)[1] for jobs in ("1", "2")]
    for report in reports:
        for node in report["tree"]["nodes"]:
            del node["wall_s"]
    one, two = reports
    assert one["plan"] == two["plan"]
    assert one["tree"] == two["tree"]
    assert one["statistics"]["steps"] == two["statistics"]["steps"]


@pytest.mark.slow
def test_same_seed_same_report_other_seed_other_world(tmp_path: Path) -> None:
    def causes(seed: str, name: str) -> list:
        _, report = plan("task2", tmp_path / name, "--vary", "--seed", seed)
        return [(n["action"], n["status"], n["simulated_s"]) for n in report["tree"]["nodes"]]

    first = causes("3", "a")
    assert first == causes("3", "b")
    assert first != causes("4", "c")


@pytest.mark.slow
def test_worlds_give_a_probability(tmp_path: Path) -> None:
    code, report = plan("task2", tmp_path, "--worlds", "4", "--jobs", "2")
    assert code == 0
    survival = report["survival"]
    assert survival["worlds"] == 4
    assert survival["alive"] >= 3
    low, high = survival["ci95"]
    assert 0.0 <= low <= survival["probability"] <= high <= 1.0


def test_limits_end_the_search(tmp_path: Path) -> None:
    code, report = plan("task7", tmp_path, "--max-nodes", "3")
    assert code == 1
    assert report["status"] == "limit"
    assert report["statistics"]["nodes_evaluated"] == 3


@pytest.mark.slow
@pytest.mark.parametrize("choice", ["off", "nonsense"])
def test_planning_needs_no_opengl_and_rendering_says_what_is_missing(
    choice: str, tmp_path: Path
) -> None:
    broken = {"MUJOCO_GL": choice}
    done = etot(
        "plan", "tasks/task3.yaml", "-q", "--out", tmp_path / "plan", env=broken, fresh=True
    )
    assert done.returncode == 0, done.stderr
    done = etot(
        "simulate", "tasks/task3.yaml", "--plan", "[PICK UP, holder] (vertical)", "--video",
        "--out", tmp_path / "simulate", env=broken, fresh=True,
    )  # fmt: skip
    assert done.returncode == 3
    assert f"MUJOCO_GL={choice}" in done.stderr.replace("'", "")
    assert (tmp_path / "simulate" / "report.json").exists()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "code"),
    [(["simulate", "tasks/task3.yaml", "--capture"], 3), (["reconstruct", "docs", "--out"], 2)],
)
def test_an_unknown_opengl_library_is_no_defect(
    arguments: list[str], code: int, tmp_path: Path
) -> None:
    done = etot(*arguments, tmp_path, env={"MUJOCO_GL": "nonsense"}, fresh=True)
    assert done.returncode == code
    assert done.stderr.startswith("error: ") and done.stderr.count("\n") == 1


@pytest.mark.slow
def test_interrupt_leaves_a_valid_report(tmp_path: Path) -> None:
    process = subprocess.Popen(
        [sys.executable, "-m", "etot_cli", "plan", "tasks/task7.yaml", "--jobs", "2",
         "--worlds", "6", "--out", str(tmp_path)],
        cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    assert process.stdout is not None
    for line in process.stdout:
        if "proposed" in line:
            break
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=TIME_LIMIT_S) == 130
    report = json.loads((tmp_path / "report.json").read_text())
    jsonschema.validate(report, json.loads((SCHEMAS / "etot.plan-1.json").read_text()))
    assert report["status"] == "interrupted"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["plan", "tasks/nowhere.yaml"], "nowhere.yaml"),
        (["plan", "tasks"], "tasks"),
        (["simulate", "tasks/task3.yaml", "--plan", "lift it"], "lift it"),
        (["simulate", "tasks/task3.yaml", "--plan", "[PICK UP, nothing]"], "nothing"),
        (["simulate", "tasks/task3.yaml", "--plan", "[PICK UP]"], "PICK UP"),
    ],
)
def test_unusable_input_is_one_clear_error(arguments: list[str], message: str) -> None:
    done = etot(*arguments)
    assert done.returncode == 2
    assert message in done.stderr
    assert done.stderr.count("error:") == 1
    assert "Traceback" not in done.stderr


def test_unreadable_instruction_names_words_and_ways_out(tmp_path: Path) -> None:
    text = (ROOT / "tasks" / "task3.yaml").read_text()
    lines = [
        "instruction: Contemplate the holder philosophically." if line.startswith("instruction:")
        else line.replace("../scenes", str(ROOT / "scenes"))
        for line in text.splitlines()
    ]  # fmt: skip
    (tmp_path / "tasks").mkdir()
    (tmp_path / "scenes").mkdir()
    for scene in (ROOT / "scenes").glob("*.yaml"):
        (tmp_path / "scenes" / scene.name).write_text(scene.read_text())
    task = tmp_path / "tasks" / "odd.yaml"
    task.write_text("\n".join(lines).replace(str(ROOT / "scenes"), "../scenes"))
    done = etot("plan", task, "--out", tmp_path / "out")
    assert done.returncode == 2
    for part in ("ontemplate", "goal", "vlm"):
        assert part in done.stderr

"""The task and scene files of the project, and the examples in its documentation."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from etot_cli.specs.load import load_scene, load_task
from etot_cli.specs.objects import Cup, DrawerUnit, Sphere
from etot_cli.specs.placement import inner_diameter

ROOT = Path(__file__).parents[2]
INSTRUCTIONS = {
    "task1": "Open the door of the microwave oven.",
    "task2": "Reorient a pen and place it into a holder.",
    "task3": "Pick up the holder horizontally or vertically.",
    "task4": "Close the drawer.",
    "disturbance": "Pick up a tennis ball.",
    "task5": "Reorient a pen and place it into a holder.",
    "task6": "Place the apple and the holder on the drawer, with the apple inside the holder.",
    "task7": "Put the apple and the tennis ball in either the drawer or the pen holder, together "
    "or separately. Ensure the drawer is closed.",
}


@pytest.mark.parametrize("name", INSTRUCTIONS)
def test_tasks_load(name: str) -> None:
    task = load_task(ROOT / "tasks" / f"{name}.yaml")
    assert task.name == name
    assert task.instruction == INSTRUCTIONS[name]
    assert task.goal is None
    assert (task.disturbance is not None) == (name == "disturbance")
    assert "front" in task.scene.cameras
    for item in task.scene.objects.values():
        assert item.mass is not None


def test_every_task_is_covered() -> None:
    assert {path.stem for path in (ROOT / "tasks").glob("*.yaml")} == set(INSTRUCTIONS)


@pytest.mark.parametrize("path", sorted((ROOT / "scenes").glob("*.yaml")), ids=lambda p: p.stem)
def test_scenes_load(path: Path) -> None:
    assert load_scene(path).name == path.stem


def test_sizes_that_decide() -> None:
    """What fits and what does not, as the tasks need it."""
    task5 = load_task(ROOT / "tasks/task5.yaml").scene
    holder, apple = task5.objects["white_holder"], task5.objects["apple"]
    assert isinstance(holder, Cup)
    assert isinstance(apple, Sphere)
    assert inner_diameter(holder) < apple.diameter < holder.diameter
    task7 = load_task(ROOT / "tasks/task7.yaml").scene
    unit, ball, apple = (task7.objects[name] for name in ("drawer", "tennis_ball", "apple"))
    assert isinstance(unit, DrawerUnit)
    assert isinstance(ball, Sphere)
    assert isinstance(apple, Sphere)
    clear = unit.compartment_heights()[0] - unit.wall
    assert ball.diameter < clear < apple.diameter


def examples(name: str) -> list[str]:
    text = (ROOT / "docs" / name).read_text()
    return re.findall(r"```yaml\n(.*?)```", text, flags=re.DOTALL)


def shipped_copy(folder: Path) -> Path:
    shutil.copytree(ROOT / "scenes", folder / "scenes")
    (folder / "tasks").mkdir()
    return folder


@pytest.mark.parametrize("text", examples("scene_format.md"))
def test_scene_examples_of_the_documentation(text: str, tmp_path: Path) -> None:
    file = shipped_copy(tmp_path) / "scenes" / "example.yaml"
    file.write_text(text)
    load_scene(file)


@pytest.mark.parametrize("text", examples("task_format.md"))
def test_task_examples_of_the_documentation(text: str, tmp_path: Path) -> None:
    file = shipped_copy(tmp_path) / "tasks" / "example.yaml"
    file.write_text(text)
    load_task(file)


@pytest.mark.slow
def test_loading_needs_no_heavy_library() -> None:
    """Start-up matters: these take hundreds of milliseconds to import."""
    code = (
        "import sys; from etot_cli.specs.load import load_task; import etot_cli.specs.vary; "
        "load_task('tasks/task5.yaml'); "
        "print(*{'numpy', 'mujoco', 'trimesh', 'scipy', 'cv2'} & set(sys.modules))"
    )
    result = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert result.stdout.strip() == ""

"""`etot simulate --capture` tells a task file from a scene file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from etot_cli.commands.capture import run_capture
from etot_cli.errors import SpecError
from tests.opengl import need_opengl

SCENE = {"objects": {"ball": {"kind": "sphere", "at": [0.4, 0.0], "diameter": 0.06, "mass": 0.05}}}
GOAL = [{"in_hand": "ball"}]


@pytest.mark.parametrize(
    "content",
    [SCENE, {"scene": SCENE, "goal": GOAL}, {"scene": SCENE, "instruction": "Pick up the ball."}],
    ids=["scene", "task with a goal", "task with an instruction"],
)
def test_scenes_and_tasks_are_rendered(content: dict[str, Any], tmp_path: Path) -> None:
    need_opengl()
    file = tmp_path / "file.yaml"
    file.write_text(yaml.safe_dump(content))
    folder = run_capture(file, tmp_path / "capture", noisy=False, seed=0, vary=False)
    assert (folder / "depth.png").exists()


@pytest.mark.parametrize(
    ("content", "lacks"),
    [({"goal": GOAL}, "scene"), ({"scene": SCENE}, "instruction"), ({"object": {}}, "object")],
)
def test_a_broken_file_is_told_what_its_kind_lacks(
    content: dict[str, Any], lacks: str, tmp_path: Path
) -> None:
    file = tmp_path / "file.yaml"
    file.write_text(yaml.safe_dump(content))
    with pytest.raises(SpecError, match=f"'{lacks}'"):
        run_capture(file, tmp_path / "capture", noisy=False, seed=0, vary=False)


def test_a_capture_is_only_replaced_when_that_is_asked_for(tmp_path: Path) -> None:
    """A mask that stayed would be an object of the scene that is captured next."""
    need_opengl()
    file, folder = tmp_path / "file.yaml", tmp_path / "capture"
    (folder / "masks").mkdir(parents=True)
    for name in ("color.png", "masks/battery.png"):
        (folder / name).write_text("precious")
    file.write_text(yaml.safe_dump(SCENE))
    with pytest.raises(SpecError, match=r"there is a capture in .*--force to replace it"):
        run_capture(file, folder, noisy=False, seed=0, vary=False)
    assert (folder / "color.png").read_text() == "precious"
    run_capture(file, folder, noisy=False, seed=0, vary=False, force=True)
    assert [path.name for path in (folder / "masks").iterdir()] == ["ball.png"]

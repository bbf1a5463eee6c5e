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

"""``etot new`` and ``etot tasks``: a task of one's own, and the shipped ones."""

from __future__ import annotations

import json
import os
import pty
import subprocess
import sys
import tomllib
from pathlib import Path
from xml.etree import ElementTree

import pytest

from etot_cli.cli.app import run
from etot_cli.commands.new import TEMPLATES, NewOptions, write_task
from etot_cli.errors import EtotError
from etot_cli.reasoning.builtin.demands import demands
from etot_cli.reasoning.language.instructions import goal_of
from etot_cli.specs.load import load_task
from etot_cli.specs.shipped import find_shipped, shipped_files
from tests.reasoning.scenes import ball, cup, drawers, item, scene

ROOT = Path(__file__).parents[2]
SEEN = scene(
    ball("ball", (0.3, 0.1)), cup("cup", (0.3, -0.2)), item("block", at=(0.3, 0.3), label="box"),
    drawers("chest", (0.5, 0.0), {"top": 0.0}),
)  # fmt: skip


def test_new_task_is_ready_to_plan(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "mine.yaml"
    code = run(
        ["new", str(file), "--scene", "pen_and_holders", "--move", "black_holder@0.30,-0.2",
         "--remove", "pen", "--object", "ball=sphere@0.35,0.48,blue",
         "-i", "Put the ball into the white holder."]
    )  # fmt: skip
    assert code == 0
    task = load_task(file)
    assert task.scene.objects["black_holder"].at == (0.30, -0.2)
    assert "pen" not in task.scene.objects
    (demanded,) = task.success
    assert demanded.inside == ("ball", "white_holder"), "what the instruction demands"
    assert "[PICK UP, ball] [PUT INTO, white_holder]" in capsys.readouterr().out
    words = "".join(ElementTree.parse(tmp_path / "mine.svg").getroot().itertext())
    assert "ball" in words and "robot" in words


@pytest.mark.parametrize(
    ("instruction", "demanded"),
    [
        ("Open the drawer, then put the box in it and close it.",
         [{"closed": "chest"}, {"inside": ["block", "chest"]}]),
        ("Put the ball or the box into the cup.",
         [{"any": [{"inside": ["ball", "cup"]}, {"inside": ["block", "cup"]}]}]),
        ("Put the ball and the box on the desk.",
         [{"on": ["ball", "desk"]}, {"on": ["block", "desk"]}]),
        ("Pick up the ball.", [{"in_hand": "ball"}]),
        ("Put the ball to the left of the cup.", []),
    ],
)  # fmt: skip
def test_success_is_what_was_asked_for(instruction: str, demanded: list[dict[str, object]]) -> None:
    assert demands(goal_of(instruction, SEEN)) == demanded


@pytest.mark.parametrize("kind", sorted(TEMPLATES))
def test_every_kind_stands_on_the_desk(kind: str, tmp_path: Path) -> None:
    made = write_task(
        NewOptions(
            file=tmp_path / "one.yaml", instruction="Look around.",
            objects=[f"thing={kind}@0.45,0.1"],
        )
    )  # fmt: skip
    assert "desk" in made.state.states["thing"].on or not made.state.infos["thing"].movable
    assert not made.state.states["thing"].toppled
    assert made.problem, "nobody understands that"


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (["--object", "ball"], r"--object 'ball': expected NAME=KIND@X,Y"),
        (["--object", "ball=tree@0.4,0.1"], "no kind 'tree'; expected sphere"),
        (["--object", "a=box@9,9"], "at"),
        (["--move", "cup@0.4,0.1"], "no object 'cup'"),
        (["--object", "a=box@0.4,0.1", "--object", "a=box@0.4,0.3"], "there is 'a' already"),
        (["--scene", "moon"], "no scene 'moon'; expected a file or one of"),
        ([], "add an object"),
    ],
)
def test_bad_input_gets_one_line(
    flags: list[str], message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["new", str(tmp_path / "x.yaml"), "-i", "Do it.", *flags]) == 2
    error = capsys.readouterr().err
    assert message in error and error.count("\n") == 1


def test_what_cannot_be_leaves_nothing_behind(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """So the same command with a better option needs no --force."""
    file = tmp_path / "mine.yaml"
    command = ["new", str(file), "-i", "Take the box.", "--object", "box=box@0.4,0.1"]
    assert run([*command, "--object", "b=box@0.4,0.1"]) == 2
    said = capsys.readouterr().err
    assert "overlaps" in said and str(file) not in said and not list(tmp_path.iterdir())
    assert run(command) == 0
    text = file.read_text()
    assert run([*command, "--object", "b=box@0.4,0.1", "--force"]) == 2
    assert file.read_text() == text


def test_a_task_begins_with_the_scene_of_another(tmp_path: Path) -> None:
    shipped, own = tmp_path / "one.yaml", tmp_path / "two.yaml"
    made = write_task(
        NewOptions(file=shipped, instruction="Close the drawer.", scene="task4", removals=["toy"])
    )
    assert set(made.state.states) == {"drawer"}
    again = write_task(NewOptions(file=own, instruction="Open the drawer.", scene=str(shipped)))
    assert set(again.state.states) == {"drawer"}


def test_existing_file_is_kept(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text("precious")
    options = NewOptions(file=file, instruction="Go.", objects=["a=box@0.4,0.1"])
    with pytest.raises(EtotError, match="exists already; --force"):
        write_task(options)
    assert file.read_text() == "precious"


@pytest.mark.slow
def test_questions_are_asked_where_somebody_answers(tmp_path: Path) -> None:
    ours, theirs = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "etot_cli", "new", "mine.yaml"],
        stdin=theirs, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )  # fmt: skip
    os.write(ours, b"desk\nball=sphere@0.4,0.2,red\n\nPick up the ball.\n")
    output, _ = process.communicate(timeout=120)
    os.close(ours)
    os.close(theirs)
    assert process.returncode == 0, output.decode()
    assert "idea 1: [PICK UP, ball]" in output.decode()
    assert load_task(tmp_path / "mine.yaml").instruction == "Pick up the ball."


def test_tasks_lists_what_is_shipped(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["tasks", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert [row["name"] for row in rows] == sorted(shipped_files("tasks"))
    assert all(load_task(row["file"]).instruction == row["instruction"] for row in rows)
    assert run(["tasks", rows[0]["name"]]) == 0
    assert capsys.readouterr().out.strip() == rows[0]["file"]
    with pytest.raises(EtotError, match="expected a file or one of"):
        find_shipped("tasks", "nothing")


def test_wheel_takes_tasks_and_scenes_to_where_they_are_looked_for() -> None:
    from etot_cli.specs.shipped import IN_WHEEL

    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    wheel = tomllib.loads(text)["tool"]["hatch"]["build"]["targets"]["wheel"]
    for kind in ("tasks", "scenes"):
        assert (ROOT / kind).is_dir()
        assert ROOT / wheel["force-include"][kind] == IN_WHEEL / kind

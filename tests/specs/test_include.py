"""Scenes that start from other scenes."""

from __future__ import annotations

from pathlib import Path

import pytest

from etot_cli.specs.load import load_scene, load_task
from etot_cli.specs.objects import Box, Sphere
from tests.specs.helpers import scene_error, task_error, write

BASE = """\
description: base
desk: {top: 0.10, color: white}
objects:
  ball: {kind: sphere, diameter: 0.07, at: [0.4, 0.0], mass: 0.05}
  box: {kind: box, size: [0.1, 0.1, 0.1], at: [0.4, 0.3], yaw_deg: 30}
  cup: {kind: cup, diameter: 0.1, height: 0.07, at: [0.4, -0.3]}
variation: {position_m: 0.02, keep: [ball]}
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    inner = tmp_path / "project" / "scenes"
    write(inner, "base.yaml", BASE)
    return inner


def load(folder: Path, text: str) -> dict[str, object]:
    scene = load_scene(write(folder, "scene.yaml", f"include: base.yaml\n{text}"))
    return dict(scene.objects)


def test_keys_are_laid_over(folder: Path) -> None:
    file = write(
        folder,
        "scene.yaml",
        "include: base.yaml\ndesk: {color: black}\nvariation: {yaw_deg: 3}\n"
        "objects:\n  ball: {diameter: 0.06}\n  new: {kind: sphere, diameter: 0.05, on: box}",
    )
    scene = load_scene(file)
    assert scene.name == "scene"
    assert scene.description == "base"
    assert (scene.desk.top, scene.desk.color) == (0.10, "black")
    assert (scene.variation.position_m, scene.variation.yaw_deg) == (0.02, 3.0)
    assert list(scene.objects) == ["ball", "box", "cup", "new"]
    ball = scene.objects["ball"]
    assert isinstance(ball, Sphere)
    assert (ball.diameter, ball.mass, ball.at) == (0.06, 0.05, (0.4, 0.0))


def test_null_removes(folder: Path) -> None:
    items = load(folder, "objects: {box: null, ball: {mass: null}}\nvariation: null")
    assert list(items) == ["ball", "cup"]
    assert items["ball"].mass is None  # type: ignore[attr-defined]


def test_another_kind_replaces_the_object(folder: Path) -> None:
    items = load(folder, "objects: {ball: {kind: box, size: [0.1, 0.1, 0.1], at: [0.3, 0]}}")
    ball = items["ball"]
    assert isinstance(ball, Box)
    assert ball.mass is None


def test_another_support_drops_the_old_place(folder: Path) -> None:
    ball = load(folder, "objects: {ball: {on: box}}")["ball"]
    assert (ball.on, ball.inside, ball.at) == ("box", None, None)  # type: ignore[attr-defined]
    write(folder, "base.yaml", BASE.replace("at: [0.4, 0.0], mass", "on: box, mass"))
    ball = load(folder, "objects: {ball: {inside: cup}}")["ball"]
    assert (ball.on, ball.inside) == (None, "cup")  # type: ignore[attr-defined]


def test_another_orientation_replaces_the_old_one(folder: Path) -> None:
    box = load(folder, "objects: {box: {quaternion: [1, 0, 0, 0]}}")["box"]
    assert box.yaw_deg == 0.0  # type: ignore[attr-defined]


def test_errors_name_the_file_they_are_in(folder: Path) -> None:
    write(folder, "base.yaml", BASE.replace("diameter: 0.07", "diameter: 7"))
    error = scene_error(folder, "include: base.yaml\nobjects: {cup: {mass: 0.1}}")
    assert error.startswith("base.yaml:4: objects.ball.diameter: found 7")
    write(folder, "base.yaml", BASE)
    error = scene_error(folder, "include: base.yaml\nobjects:\n  ball: {mass: -1}")
    assert error.startswith("scene.yaml:3: objects.ball.mass: found -1")
    error = scene_error(folder, "include: base.yaml\nobjects:\n  ball: {at: [0.4, 0.3]}")
    assert error.startswith("base.yaml:5: objects.box.at: overlaps 'ball' by")


def test_errors_in_a_task_name_the_scene_file(folder: Path) -> None:
    write(folder, "base.yaml", BASE.replace("color: white", "colour: white"))
    text = "instruction: x\nscene: ../scenes/base.yaml\nsuccess: [{upright: cup}]"
    task = write(folder.parent / "tasks", "t.yaml", text)
    with pytest.raises(Exception, match=r"base.yaml:2: desk.colour: unknown key 'colour'") as info:
        load_task(task)
    assert "tasks/.." not in str(info.value)


def test_task_overrides(folder: Path) -> None:
    text = (
        "instruction: x\nscene:\n  include: ../scenes/base.yaml\n  objects: {box: null}\n"
        "success: [{upright: cup}]\nvariation: {position_m: 0.005}"
    )
    task = load_task(write(folder.parent / "tasks", "t.yaml", text))
    assert list(task.scene.objects) == ["ball", "cup"]
    assert task.scene.variation.position_m == 0.005
    assert task.scene.variation.keep == ("ball",)
    assert task.scene.directory == str((folder.parent / "tasks").resolve())
    assert (task.name, task.scene.name) == ("t", "t")


@pytest.mark.parametrize(
    ("include", "message"),
    [
        ("nothing.yaml", "scene.yaml:1: include: found 'nothing.yaml', but there is no file"),
        ("../../../etc/x.yaml", "include: '../../../etc/x.yaml' lies outside the project's folder"),
        ("../../out.yaml", "include: '../../out.yaml' lies outside the project's folder project/"),
        ("/etc/passwd.yaml", "include: found '/etc/passwd.yaml', expected a path relative to"),
        ("base.txt", "include: found 'base.txt', expected a file ending in .yaml or .yml"),
        ("[base.yaml]", "include: expected the name of a YAML file"),
        ("5", "include: expected the name of a YAML file"),
        ("''", "include: expected the name of a YAML file"),
        ("scene.yaml", "include: the files include each other: scene.yaml → scene.yaml"),
        ('"a\\0.yaml"', "include: found 'a\\x00.yaml', expected a path relative to this file"),
        ("x" * 3000 + ".yaml", "include: found 'xxx"),
        ("folder.yaml", "is a folder; expected a YAML file"),
        ("link.yaml", "include: 'link.yaml' lies outside the project's folder"),
        ("loop.yaml", "include: found 'loop.yaml', which cannot be followed"),
    ],
)
def test_bad_includes(include: str, message: str, folder: Path) -> None:
    (folder / "folder.yaml").mkdir()
    write(folder.parent.parent, "out.yaml", "name: out")
    (folder / "link.yaml").symlink_to(folder.parent.parent / "out.yaml")
    (folder / "loop.yaml").symlink_to(folder / "loop.yaml")
    assert message in scene_error(folder, f"include: {include}")


def test_circles_and_long_chains(folder: Path) -> None:
    write(folder, "a.yaml", "include: b.yaml")
    write(folder, "b.yaml", "include: c.yaml")
    write(folder, "c.yaml", "name: c\ninclude: b.yaml")
    error = scene_error(folder, "include: a.yaml")
    assert "c.yaml:2: include: the files include each other: b.yaml → c.yaml → b.yaml" in error
    for number in range(9):
        write(folder, f"n{number}.yaml", f"include: n{number + 1}.yaml")
    write(folder, "n9.yaml", "description: end")
    assert "more than 8 files include each other" in scene_error(folder, "include: n0.yaml")
    assert load_scene(folder / "n1.yaml").description == "end"


def test_a_folder_reached_by_a_link(folder: Path) -> None:
    """Includes are taken from where the link leads, and stay within that project."""
    tasks = folder.parent / "tasks"
    text = "instruction: x\nscene: ../scenes/base.yaml\nsuccess: [{upright: cup}]"
    write(tasks, "t.yaml", text)
    elsewhere = folder.parent.parent / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "tasks").symlink_to(tasks)
    assert load_task(elsewhere / "tasks" / "t.yaml").scene.description == "base"


def test_task_scene_that_is_a_task(folder: Path) -> None:
    text = "instruction: x\nscene: task.yaml\nsuccess: []"
    assert "the files include each other: task.yaml → task.yaml" in task_error(folder, text)

"""Names in scenes and tasks must mean something that fits."""

from __future__ import annotations

from pathlib import Path

import pytest

from etot_cli.specs.load import load_scene, load_task
from etot_cli.specs.references import containers, openable, surfaces
from tests.specs.helpers import BALL, objects, scene_error, task_error, write

SCENE = """\
    ball: {kind: sphere, diameter: 0.04, at: [0.25, 0.0]}
    box: {kind: box, size: [0.05, 0.05, 0.05], at: [0.25, 0.2]}
    cup: {kind: cup, diameter: 0.09, height: 0.07, at: [0.25, -0.2]}
    one: {kind: drawer_unit, at: [0.4, 0.0], size: [0.15, 0.12, 0.15],
          drawers: [{name: top}, {name: low, travel: 0.0}]}
    two: {kind: drawer_unit, at: [0.4, 0.2], size: [0.15, 0.12, 0.15],
          drawers: [{name: top}, {name: low}]}
    oven: {kind: cabinet, at: [0.4, 0.4], size: [0.15, 0.12, 0.15]}
    rack: {kind: shelf, at: [0.4, -0.2], size: [0.15, 0.12, 0.15], boards: [low, high]}
"""
TASK = f"instruction: x\nscene:\n  objects:\n{SCENE}success:\n"


def test_what_carries_contains_and_opens(tmp_path: Path) -> None:
    scene = load_task(write(tmp_path, "t.yaml", TASK + "- upright: cup")).scene
    assert surfaces(scene) == (
        ["desk", "box", "cup", "one", "two", "oven", "rack", "rack.low", "rack.high"]
    )
    assert containers(scene) == ["cup", "one", "one.top", "two.top", "two.low", "oven"]
    assert openable(scene) == ["one", "one.top", "two.top", "two.low", "oven", "oven.door"]


@pytest.mark.parametrize(
    ("conditions", "message"),
    [
        ("- in_hand: bal", "success[0].in_hand: the scene has no object 'bal'; expected one of "
         "ball, box, cup, one, two, oven, rack; did you mean 'ball'?"),
        ("- on: [ball, ball]", "success[0].on[1]: 'ball' is no surface; expected one of desk, box"),
        ("- on: [desk, box]", "success[0].on[0]: the scene has no object 'desk'"),
        ("- on: [box, box]", "success[0].on: 'box' cannot be on itself"),
        ("- inside: [ball, box]", "success[0].inside[1]: 'box' is no container; expected one of"),
        ("- inside: [ball, one.low]", "the scene has no container 'one.low'; expected one of cup"),
        ("- inside: [ball, two]", "inside[1]: 'two' is no container; expected one of cup, one,"),
        ("- open: cup", "success[0].open: 'cup' is no part that opens; expected one of one,"),
        ("- closed: two", "success[0].closed: 'two' is no part that opens"),
        ("- closed: one.low", "success[0].closed: the scene has no part that opens 'one.low'"),
        ("- upright: one.top", "success[0].upright: the scene has no object 'one.top'"),
        ("- any: [{upright: cup}, {not: {present: x}}]", "success[0].any[1].not.present: the"),
        ("- all: [{upright: cup}, {open: x}]", "success[0].all[1].open: the scene has no part"),
        ("- upright: cup\ngoal: [{present: x}]", "goal[0].present: the scene has no object 'x'"),
        ("- upright: cup\ndisturbance: {move: bal, inside: cup}", "disturbance.move: the scene has "
         "no loose object 'bal'; expected one of chosen, target, ball"),
        ("- upright: cup\ndisturbance: [{remove: ball}, {part: one.x, to: 1}]",
         "disturbance[1].part: the scene has no part that opens 'one.x'"),
        ("- upright: cup\ndisturbance: {knock_over: oven}", "'oven' is no loose object"),
        ("- upright: cup\ndisturbance: {add: cup, object: {kind: sphere, diameter: 0.1, on: box}}",
         "disturbance.add: 'cup' is in the scene already"),
        ("- upright: cup\ndisturbance: {add: it, object: {kind: sphere, diameter: 0.05, on: x}}",
         "disturbance.object.on: the scene has no surface 'x'"),
        ("- upright: cup\ndisturbance: {inside: box}", "disturbance.inside: 'box' is no container"),
        ("- upright: cup\ndisturbance: {on: ball}", "disturbance.on: 'ball' is no surface"),
        ("- upright: cup\ndisturbance: {move: cup, inside: cup}", "cannot be put on or into"),
        ("- upright: cup\ndisturbance: {at: [2, 0]}", "disturbance.at: found [2.0, 0.0], expect"),
    ],
)  # fmt: skip
def test_bad_references_in_tasks(conditions: str, message: str, tmp_path: Path) -> None:
    assert message in task_error(tmp_path, TASK + conditions)


@pytest.mark.parametrize(
    "conditions",
    [
        "- inside: [ball, one]",
        "- inside: [ball, two.low]",
        "- {on: [ball, rack.low]}\n- on: [ball, desk]",
        "- open: oven\n- closed: oven.door\n- not: {any: [{present: ball}, {upright: one}]}",
        "- present: ball\ndisturbance: {move: ball, on: rack.high}",
        "- present: ball\ndisturbance: {when: after_action, after_action: 2, at: [0.4, 0.1]}",
        "- present: ball\ndisturbance: [{when: planned, part: oven, to: 1}, {drop: ball, on: one}]",
        "- present: ball\ndisturbance: {when: during_action, share: 0.2, move: ball, by: [0.1, 0]}",
        "- present: ball\ndisturbance: [{add: it, object: {kind: sphere, diameter: 0.1, on: desk}},"
        " {when: planned, remove: it}]",
    ],
)
def test_good_references(conditions: str, tmp_path: Path) -> None:
    load_task(write(tmp_path, "task.yaml", TASK + conditions))


@pytest.mark.parametrize(
    ("pose", "message"),
    [
        ("on: tabel", "objects.thing.on: the scene has no surface 'tabel'; expected one of desk"),
        ("on: ball", "objects.thing.on: 'ball' is no surface; expected one of desk, thing"),
        ("inside: thing", "objects.thing.inside: 'thing' is no container"),
        ("inside: ball", "objects.thing.inside: found 'ball', but the scene has no container"),
        ("on: thing", "objects.thing.on: objects support each other in a circle: thing → thing"),
    ],
)
def test_bad_supports(pose: str, message: str, tmp_path: Path) -> None:
    thing = f"{{kind: box, size: [0.05, 0.05, 0.05], {pose}}}"
    error = scene_error(tmp_path, objects(ball=BALL, thing=thing))
    if message.endswith("no container"):
        assert "is no container" in error or "has no container" in error
    else:
        assert f"scene.yaml:3: {message}" in error


def test_support_circles(tmp_path: Path) -> None:
    box = "{{kind: box, size: [0.05, 0.05, 0.05], on: {}}}"
    text = objects(d=box.format("a"), a=box.format("b"), b=box.format("c"), c=box.format("a"))
    error = scene_error(tmp_path, text)
    assert "scene.yaml:3: objects.a.on: objects support each other in a circle: a → b → c → a" in (
        error
    )


def test_keep_names_objects(tmp_path: Path) -> None:
    error = scene_error(tmp_path, objects(ball=BALL) + "variation: {keep: [ball, bell]}")
    assert "scene.yaml:3: variation.keep[1]: the scene has no object 'bell'" in error
    scene = load_scene(write(tmp_path, "s.yaml", objects(ball=BALL) + "variation: {keep: [ball]}"))
    assert scene.variation.keep == ("ball",)


@pytest.mark.parametrize(
    ("keys", "placed", "message"),
    [
        ("container_site: r", "on: it", None),
        ("container_site: r", "inside: it", None),
        ("surface_site: r", "on: it", None),
        ("", "on: it", "add 'container_site: <box site that spans its hollow>' to it or "
         "'surface_site: <box site that things stand on>' to it"),
        ("surface_site: r", "inside: it", "'container_site: <box site that spans its hollow>' to"),
        ("parts: {lid: {joint: h}}", "inside: it", "its hollow>' to a part of it"),
        ("parts: {lid: {joint: h, container_site: r}}", "on: it", "add 'surface_site: <box site"),
    ],
)  # fmt: skip
def test_a_model_carries_and_contains_by_its_sites(
    keys: str, placed: str, message: str | None, tmp_path: Path
) -> None:
    write(tmp_path, "a.xml", "<mujoco/>")
    model = ", ".join(key for key in ("kind: mjcf, file: a.xml, at: [0.4, 0]", keys) if key)
    ball = f"{{kind: sphere, diameter: 0.04, {placed}}}"
    text = objects(it=f"{{{model}}}", ball=ball)
    if message is None:
        load_scene(write(tmp_path, "scene.yaml", text))
    else:
        error = scene_error(tmp_path, text)
        assert error.startswith(f"scene.yaml:3: objects.ball.{placed.split(':')[0]}: ")
        assert message in error

"""What people are told when a value in a document is wrong."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.specs.helpers import BALL, objects, scene_error, task_error

CUP = "kind: cup, at: [0.4, 0.0], diameter: 0.08, height: 0.08"
UNIT = "kind: drawer_unit, at: [0.4, 0.0], size: [0.24, 0.18, 0.15]"


@pytest.mark.parametrize(
    ("item", "message"),
    [
        (
            "{kind: sphere, diameter: 3, at: [0.4, 0]}",
            "scene.yaml:2: objects.it.diameter: found 3, expected a length in metres of at most "
            "0.6 (3 mm is 0.003 and 3 cm is 0.03)",
        ),
        (
            "{kind: sphere, diameter: 76, at: [0.4, 0]}",
            "found 76, expected a length in metres of at most 0.6 (76 mm is 0.076)",
        ),
        (
            "{kind: sphere, diameter: 0, at: [0.4, 0]}",
            "diameter: found 0, expected a length in metres of more than 0.0005",
        ),
        (
            "{kind: sphere, diameter: -0.1, at: [0.4, 0]}",
            "diameter: found -0.1, expected a length in metres of more than 0.0005",
        ),
        (
            "{kind: sphere, diameter: '0.07', at: [0.4, 0]}",
            "diameter: found '0.07', expected a length in metres of more than 0.0005 and at most",
        ),
        (
            "{kind: sphere, diameter: 7 cm, at: [0.4, 0]}",
            "diameter: found '7 cm', expected a length in metres",
        ),
        (
            "{kind: sphere, diameter: true, at: [0.4, 0]}",
            "diameter: found true, expected a length in metres",
        ),
        (
            "{kind: sphere, diameter: null, at: [0.4, 0]}",
            "diameter: found nothing, expected a length in metres",
        ),
        (
            "{kind: sphere, diameter: [0.1], at: [0.4, 0]}",
            "diameter: found a list of 1, expected a length in metres",
        ),
        (
            "{kind: sphere, diameter: {x: 1}, at: [0.4, 0]}",
            "diameter: found a mapping, expected a length in metres",
        ),
        (
            "{kind: sphere, at: [0.4, 0]}",
            "scene.yaml:2: objects.it: missing key 'diameter', a length in metres of more than",
        ),
        (
            "{kind: sphere, diametre: 0.1, at: [0.4, 0]}",
            "scene.yaml:2: objects.it.diametre: unknown key 'diametre' (did you mean 'diameter'?); "
            "allowed keys: kind, at, on, inside,",
        ),
        (
            "{kind: sphere, diameter: 0.1, at: [0.4, 0], zzz: 1}",
            "objects.it.zzz: unknown key 'zzz'; allowed keys: kind, at",
        ),
        ("{kind: sphere, diameter: 0.1, at: [0.4, 0], sphere: {x: 1}}", "it.sphere: unknown key"),
        (
            "{kind: spere, diameter: 0.1, at: [0.4, 0]}",
            "objects.it.kind: found 'spere', expected one of sphere, box, cylinder, capsule, pen, "
            "cup, bowl, drawer_unit, cabinet, shelf, mesh, mjcf; did you mean 'sphere'?",
        ),
        ("{kind: [1], diameter: 0.1}", "objects.it.kind: found [1], expected one of sphere"),
        ("{diameter: 0.1, at: [0.4, 0]}", "objects.it: missing key 'kind', one of sphere, box"),
        ("7", "objects.it: found 7, expected a mapping of keys and values"),
        ("null", "objects.it: found nothing, expected a mapping (null only removes"),
        ("{kind: sphere, diameter: 0.1}", "objects.it: needs a pose: 'at: [x, y]'"),
        (
            "{kind: sphere, diameter: 0.1, at: [0.4]}",
            "objects.it.at: found a list of 1, expected coordinates in metres, [x, y] or [x, y, z]",
        ),
        (
            "{kind: sphere, diameter: 0.1, at: [1, 2, 3, 4]}",
            "objects.it.at: found a list of 4, expected coordinates in metres",
        ),
        ("{kind: sphere, diameter: 0.1, at: here}", "at: found 'here', expected coordinates in"),
        (
            "{kind: sphere, diameter: 0.1, at: [400, 0]}",
            "objects.it.at[0]: found 400, expected a coordinate in metres of at most 3 "
            "(400 mm is 0.4)",
        ),
        ("{kind: sphere, diameter: 0.1, at: [0.4, x]}", "at[1]: found 'x', expected a coordinate"),
        (
            "{kind: box, size: [0.1, 0.1], at: [0.4, 0]}",
            "objects.it.size: found a list of 2, expected a list of 3, each a length in metres",
        ),
        ("{kind: box, size: [0.1, 0.1, 9], at: [0.4, 0]}", "size[2]: found 9, expected a length"),
        (
            "{kind: sphere, diameter: 0.1, at: [0.4, 0], mass: 150}",
            "mass: found 150, expected a mass in kilograms of at most 100 (150 g is 0.15)",
        ),
        (
            "{kind: sphere, diameter: 0.1, at: [0.4, 0], mass: 57}",
            "objects.it.mass: found 57, which is 57000 kg/m³ for the object's size; expected a "
            "mass in kilograms (57 g is 0.057)",
        ),
        (
            "{kind: sphere, diameter: 0.1, at: [0.4, 0], friction: 0}",
            "friction: found 0, expected a coefficient of friction of at least 0.01",
        ),
        (
            "{kind: sphere, diameter: 0.1, at: [0.4, 0], slippery: yes}",
            "slippery: found 'yes', expected true or false",
        ),
        (
            "{kind: sphere, diameter: 0.1, at: [0.4, 0], color: blurple}",
            "objects.it.color: unknown colour 'blurple'; expected one of beech,",
        ),
        (
            "{kind: sphere, diameter: 0.1, at: [0.4, 0], color: [255, 0, 0]}",
            "color[0]: found 255, expected a colour channel from 0 to 1 of at most 1",
        ),
        (
            "{kind: sphere, diameter: 0.1, at: [0.4, 0], color: 5}",
            "color: found 5, expected a colour: a name, '#rrggbb' or [red, green, blue]",
        ),
        (
            "{kind: box, size: [0.1, 0.1, 0.1], at: [0.4, 0], quaternion: [1, 1, 0, 0]}",
            "objects.it.quaternion: its norm is 1.414, expected a unit quaternion w x y z",
        ),
        (
            "{kind: box, size: [0.1, 0.1, 0.1], at: [0.4, 0], quaternion: [1, 0, 0]}",
            "quaternion: found a list of 3, expected a unit quaternion [w, x, y, z]",
        ),
        (
            "{kind: box, size: [0.1, 0.1, 0.1], on: desk, yaw_deg: 5, quaternion: [1, 0, 0, 0]}",
            "give either 'yaw_deg' or 'quaternion', not both",
        ),
        (
            "{kind: box, size: [0.1, 0.1, 0.1], at: [0.4, 0], yaw_deg: 500}",
            "yaw_deg: found 500, expected an angle in degrees of at most 360",
        ),
        (f"{{{CUP}, on: desk, inside: desk}}", "give either 'on' or 'inside', not both"),
        (f"{{{UNIT}, drawers: []}}", "objects.it.drawers: is empty, expected at least 1 entry"),
        (
            f"{{{UNIT}, drawers: [{{name: top, open: 0.2}}]}}",
            "objects.it.drawers[0]: open is 0.2 m, but the drawer travels only 0.14 m",
        ),
        (
            f"{{{UNIT}, drawers: [{{name: a}}, {{name: a}}]}}",
            "objects.it: two drawers of one unit have the same name",
        ),
        (
            f"{{{UNIT}, drawers: [{{name: the top}}]}}",
            "drawers[0].name: found 'the top', expected a name (letters, digits and underscores",
        ),
        (
            "{kind: cabinet, at: [0.4, 0], size: [0.3, 0.4, 0.3], door: {hinge: top}}",
            "objects.it.door.hinge: found 'top', expected left or right",
        ),
        (
            "{kind: shelf, at: [0.4, 0], size: [0.3, 0.4, 0.3], boards: [a, a]}",
            "objects.it: two boards of one shelf have the same name",
        ),
    ],
)
def test_bad_object(item: str, message: str, tmp_path: Path) -> None:
    found = scene_error(tmp_path, objects(it=item))
    assert found.startswith("scene.yaml:2: objects.it")
    assert message in found


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("nmae: x", "scene.yaml:1: nmae: unknown key 'nmae' (did you mean 'name'?); allowed keys"),
        ("directory: /etc", "scene.yaml:1: directory: unknown key 'directory'; allowed keys: name"),
        ("name: ../../x", "name: found '../../x', expected a name (letters, digits, underscores,"),
        ("objects: [1]", "objects: found a list of 1, expected a mapping of keys and values"),
        ("objects: 5", "scene.yaml:1: objects: found 5, expected a mapping of keys and values"),
        ("desk: {top: 13}", "desk.top: found 13, expected a height in metres of at most 1.5"),
        ("desk: {color: whit}", "desk.color: unknown colour 'whit'; expected one of"),
        ("cameras: {c: {}}", "cameras.c: missing key 'position', a list of 3, each a coordinate"),
        ("cameras: {c: {position: [1, 0, 1]}}", "cameras.c: needs either 'look_at: [x, y, z]'"),
        (
            "cameras: {c: {position: [1, 0, 1], look_at: [1, 0, 1]}}",
            "cameras.c: 'look_at' is the camera's own position",
        ),
        (
            "cameras: {c: {position: [1, 0, 1], look_at: [0, 0, 0], width: 640.5}}",
            "cameras.c.width: found 640.5, expected a whole number of pixels",
        ),
        (
            "cameras: {c: {position: [1, 0, 1], look_at: [0, 0, 0], width: 320}}",
            "cameras.c.cx: found 642, which lies outside the image of 320 pixels",
        ),
        ("variation: {position_m: 10}", "found 10, expected a length in metres of at most 0.1 (10"),
        ("variation: {mass: 2}", "variation.mass: found 2, expected a share (0.2 means ±20 %)"),
        ("robot: '../x y'", "robot: found '../x y', expected a file ending in .yaml or .yml"),
        ("robot: a b", "robot: found 'a b', expected a built-in robot's name"),
        ("? {}\n: 1", "scene.yaml:1: a key must be a word"),
    ],
)
def test_bad_scene(text: str, message: str, tmp_path: Path) -> None:
    assert message in scene_error(tmp_path, text)


def test_names_of_objects(tmp_path: Path) -> None:
    error = scene_error(tmp_path, f"objects:\n  the ball: {BALL}")
    assert "scene.yaml:2: objects.the ball: found 'the ball', expected a name (letters" in error
    for name in ("desk", "robot", "gripper", "chosen"):
        error = scene_error(tmp_path, objects(**{name: BALL}))
        assert f"scene.yaml:2: objects.{name}: {name!r} is reserved" in error


def test_too_many_objects(tmp_path: Path) -> None:
    many = {f"ball{n}": BALL for n in range(65)}
    assert "expected at most 64" in scene_error(tmp_path, objects(**many))


def test_the_first_problem_is_named_and_the_others_counted(tmp_path: Path) -> None:
    text = objects(
        a="{kind: sphere, at: [0.4, 0.0]}",
        b="{kind: sphere, diameter: 9, at: [0.4, 0.2]}",
        c="{kind: sphere, diameter: 8, at: [0.4, 0.3]}",
    )
    error = scene_error(tmp_path, text)
    assert "scene.yaml:3: objects.b.diameter: found 9" in error  # missing keys come last
    assert error.endswith("(and 2 more)")


TASK = """\
instruction: Do it.
scene:
  objects:
    ball: {kind: sphere, diameter: 0.07, at: [0.4, 0.0]}
    cup: {kind: cup, diameter: 0.09, height: 0.07, at: [0.4, 0.2]}
success:
"""


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("name: x", "task.yaml:1: missing key 'instruction', text (and 1 more)"),
        ("file: x", "task.yaml:1: file: unknown key 'file'; allowed keys: name, instruction,"),
        ("variations: x", "unknown key 'variations' (did you mean 'variation'?)"),
        (TASK, "task.yaml:6: success: found nothing, expected a list, each entry a mapping"),
        (TASK + "  - on: [ball]", "success[0].on: found a list of 1, expected a list of 2, each"),
        (TASK + "  - on: [ball, 3]", "success[0].on[1]: found 3, expected an object's name"),
        (TASK + "  - on: [ball, a.b.c]", "found 'a.b.c', expected an object's name, or object."),
        (
            TASK + "  - {on: [ball, cup], upright: cup}",
            "task.yaml:7: success[0]: a condition has exactly one key of on, inside, in_hand,",
        ),
        (TASK + "  - {}", "success[0]: a condition has exactly one key"),
        (TASK + "  - upright: null", "success[0]: a condition has exactly one key"),
        (TASK + "  - upwright: cup", "success[0].upwright: unknown key 'upwright' (did you mean"),
        (TASK + "  - any: []", "success[0].any: is empty, expected at least 1 entry"),
        (
            TASK + "  - upright: cup\ngoal: x",
            "task.yaml:8: goal: found 'x', expected a list, each entry a mapping",
        ),
        (TASK.replace("Do it.", "''") + "  - upright: cup", "instruction: is empty, expected at"),
        (TASK.replace("Do it.", "'  '") + "  - upright: cup", "instruction: is blank, expected a"),
        (TASK.replace("Do it.", "5") + "  - upright: cup", "instruction: found 5, expected text"),
        (
            TASK.replace("diameter: 0.07", "diameter: 7") + "  - upright: cup",
            "task.yaml:4: scene.objects.ball.diameter: found 7, expected a length in metres",
        ),
        (
            TASK.replace("  objects:", "  directory: x\n  objects:") + "  - upright: cup",
            "task.yaml:3: scene.directory: unknown key 'directory'",
        ),
        (
            TASK + "  - upright: cup\nvariation: {position: 1}",
            "task.yaml:8: variation.position: unknown key 'position' (did you mean 'position_m'?)",
        ),
        (
            TASK + "  - upright: cup\nvariation: 5",
            "task.yaml:8: variation: found 5, expected a mapping of keys and values",
        ),
        (
            TASK + "  - upright: cup\ndisturbance: {move: ball}",
            "task.yaml:8: disturbance: give one of 'inside', 'on', 'at' and 'by' with 'move'",
        ),
        (
            TASK + "  - upright: cup\ndisturbance: {move: ball, inside: cup, after_action: 2}",
            "'after_action' needs 'when: after_action'",
        ),
        (
            TASK + "  - upright: cup\ndisturbance: {when: now, inside: cup}",
            "disturbance.when: found 'now', expected planned or committed or after_action or",
        ),
        (
            TASK + "  - upright: cup\nworlds: 0",
            "task.yaml:8: worlds: found 0, expected a whole number of at least 1",
        ),
        ("scene: 5\ninstruction: x\nsuccess: []", "task.yaml:1: scene: expected a scene: the name"),
    ],
)
def test_bad_task(text: str, message: str, tmp_path: Path) -> None:
    assert message in task_error(tmp_path, text)

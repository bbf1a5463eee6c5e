"""Geometric checks of scenes."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from etot_cli.errors import SpecError
from etot_cli.specs.checks import check_scene
from etot_cli.specs.load import load_scene
from etot_cli.specs.objects import DrawerUnit, Sphere
from etot_cli.specs.placement import place_all
from etot_cli.specs.protrusions import protrusions
from etot_cli.specs.scene import Scene
from tests.specs.helpers import objects, scene_error, write

BALL = "{{kind: sphere, diameter: 0.07, {}}}"
BOX = "{{kind: box, size: [0.2, 0.1, 0.1], {}}}"
CUP = "{{kind: cup, diameter: 0.09, height: 0.08, wall: 0.005, {}}}"
CHEST = (
    "{{kind: drawer_unit, at: [0.45, 0.0], yaw_deg: -90, size: [0.24, 0.18, 0.16], "
    "drawers: [{{name: top, open: {}}}, {{name: low, travel: 0}}]}}"
)
OVEN = (
    "{{kind: cabinet, at: [0.4, 0.35], yaw_deg: -90, size: [0.3, 0.4, 0.3], "
    "door: {{open_deg: {}, hinge: {}}}}}"
)


def ok(folder: Path, **items: str) -> Scene:
    return load_scene(write(folder, "scene.yaml", objects(**items)))


def test_two_boxes_overlap(tmp_path: Path) -> None:
    one = BOX.format("at: [0.4, 0.0]")
    error = scene_error(tmp_path, objects(one=one, two=BOX.format("at: [0.4, 0.09]")))
    assert (
        "scene.yaml:3: objects.two.at: overlaps 'one' by 10 mm; 'two' is centred at (0.4, 0.09), "
        "'one' at (0.4, 0)" in error
    )
    ok(tmp_path, one=one, two=BOX.format("at: [0.4, 0.0995]"))  # touching
    ok(tmp_path, one=one, two=BOX.format("at: [0.4, 0.16], yaw_deg: 0"))
    assert "overlaps" in scene_error(
        tmp_path, objects(one=one, two=BOX.format("at: [0.4, 0.14], yaw_deg: 90"))
    )
    # A corner that points into the gap: only the turned outlines tell that they are apart.
    ok(tmp_path, one=one, two=BOX.format("at: [0.59, 0.105], yaw_deg: 45"))


def test_round_things(tmp_path: Path) -> None:
    one = BALL.format("at: [0.4, 0.0]")
    ok(tmp_path, one=one, two=BALL.format("at: [0.45, 0.05]"))
    error = scene_error(tmp_path, objects(one=one, two=BALL.format("at: [0.44, 0.05]")))
    assert "overlaps 'one' by 6 mm" in error


def test_heights_matter_for_given_heights(tmp_path: Path) -> None:
    box = BOX.format("at: [0.4, 0.0]")
    ok(tmp_path, box=box, ball=BALL.format("at: [0.4, 0.0, 0.30]"))
    error = scene_error(tmp_path, objects(box=box, ball=BALL.format("at: [0.4, 0.0, 0.25]")))
    assert "overlaps 'box'" in error


def test_what_is_fastened_on_another_thing_says_how_high(tmp_path: Path) -> None:
    box = BOX.format("at: [0.4, 0.0]")
    clock = "{{kind: box, size: [0.04, 0.04, 0.04], fixed: true, {}}}"
    for place, key in (("on: box", "on"), ("on: box, at: [0.41, 0.0]", "at")):
        error = scene_error(tmp_path, objects(box=box, clock=clock.format(place)))
        assert f"scene.yaml:3: objects.clock.{key}: 'clock' is fastened" in error
        assert "expected its centre as 'at: [x, y, z]', or 'fixed: false'" in error
    ok(tmp_path, box=box, clock=clock.format("on: box, at: [0.41, 0.0, 0.25]"))
    ok(tmp_path, box=box, clock=clock.format("on: box").replace("true", "false"))


def test_different_supports_are_compared_in_space(tmp_path: Path) -> None:
    box = BOX.format("at: [0.4, 0.0]")
    top = "{kind: box, size: [0.2, 0.1, 0.05], on: box, at: [0.4, 0.04]}"
    ok(tmp_path, box=box, top=top, ball=BALL.format("at: [0.4, 0.1]"))
    tall = "{kind: cylinder, diameter: 0.04, height: 0.2, at: [0.4, 0.08]}"
    assert "overlaps 'top'" in scene_error(tmp_path, objects(box=box, top=top, tall=tall))


def test_open_drawers_and_doors_take_room(tmp_path: Path) -> None:
    ok(tmp_path, chest=CHEST.format(0.0), can=CUP.format("at: [0.45, -0.20]"))
    ok(tmp_path, chest=CHEST.format(0.13), can=BALL.format("at: [0.45, -0.18]"))  # below it
    tall = "{kind: cylinder, diameter: 0.05, height: 0.12, at: [0.45, -0.20]}"
    ok(tmp_path, chest=CHEST.format(0.02), tall=tall)
    error = scene_error(tmp_path, objects(chest=CHEST.format(0.13), tall=tall))
    assert "objects.tall.at: overlaps 'chest'" in error
    # Ajar, the door stands before the cabinet on the side away from its hinge.
    near = BALL.format("at: [0.25, 0.09]")
    far = BALL.format("at: [0.55, 0.09]")
    ok(tmp_path, oven=OVEN.format(0, "left"), near=near, far=far)
    assert "objects.far.at: overlaps 'oven'" in scene_error(
        tmp_path, objects(oven=OVEN.format(20, "left"), near=near, far=far)
    )
    assert "objects.near.at: overlaps 'oven'" in scene_error(
        tmp_path, objects(oven=OVEN.format(20, "right"), near=near, far=far)
    )


def test_handles_take_room(tmp_path: Path) -> None:
    chest = CHEST.format(0.0).replace("open: 0.0", "handle: {depth: 0.04}")
    tall = "{{kind: box, size: [0.04, 0.04, 0.14], at: [0.45, {}]}}"
    ok(tmp_path, chest=chest, tall=tall.format(-0.185))
    ok(tmp_path, chest=CHEST.format(0.0), tall=tall.format(-0.145))
    error = scene_error(tmp_path, objects(chest=chest, tall=tall.format(-0.145)))
    assert "objects.tall.at: overlaps 'chest'" in error and "a handle of 'chest'" in error
    low = "{kind: box, size: [0.04, 0.04, 0.06], at: [0.45, -0.145]}"
    ok(tmp_path, chest=chest, low=low)  # below it
    # A door's handle is near its free edge, and turns with it.
    handled = OVEN.replace("hinge: {}", "hinge: {}, handle: {{depth: 0.05, vertical: true}}")
    small = "{{kind: box, size: [0.03, 0.03, 0.2], at: [{}, 0.165]}}"
    ok(tmp_path, oven=handled.format(0, "left"), box=small.format(0.24))
    error = scene_error(tmp_path, objects(oven=handled.format(0, "right"), box=small.format(0.24)))
    assert "a handle of 'oven'" in error
    ok(tmp_path, oven=handled.format(60, "right"), box=small.format(0.24))


def test_an_open_door_and_an_open_drawer_overlap(tmp_path: Path) -> None:
    oven, facing = OVEN.format(90, "right"), CHEST.replace("-90", "90")
    apart = facing.replace("at: [0.45, 0.0]", "at: [0.55, -0.35]")
    ok(tmp_path, oven=oven, chest=apart.format(0.0))
    error = scene_error(tmp_path, objects(oven=oven, chest=apart.format(0.13)))
    assert "objects.chest.at: overlaps 'oven'" in error


def test_the_door_is_where_its_hinge_says() -> None:
    text = {
        "kind": "cabinet",
        "at": [0.4, 0.4],
        "size": [0.3, 0.4, 0.3],
        "door": {"open_deg": 90, "hinge": "left"},
    }
    scene = Scene.model_validate({"objects": {"oven": text}})
    (door,) = protrusions(scene.objects["oven"], place_all(scene)["oven"])
    # Facing +x from the front at x = 0.55, left is −y; fully open, the door points along +x.
    assert min(corner[0] for corner in door.footprint.corners) == pytest.approx(0.55)
    assert max(corner[0] for corner in door.footprint.corners) == pytest.approx(0.95)
    assert max(corner[1] for corner in door.footprint.corners) == pytest.approx(0.21)


def test_off_the_desk(tmp_path: Path) -> None:
    error = scene_error(tmp_path, objects(it=BALL.format("at: [0.1, 0.61]")))
    assert "scene.yaml:2: objects.it.at: its centre (0.1, 0.61) is off the desk, which" in error
    assert "spans x 0.02 … 0.82 and y -0.6 … 0.6" in error
    # A fixed object may hang on a wall behind the desk.
    ok(tmp_path, it=BOX.format("at: [0.5, 0.65, 0.6], fixed: true"))


def test_below_the_desk(tmp_path: Path) -> None:
    error = scene_error(tmp_path, objects(it=BALL.format("at: [0.4, 0.0, 0.1]")))
    assert "objects.it.at: its lowest point is at z 0.065, below the desk's top at 0.13" in error
    ok(tmp_path, it=BALL.format("at: [0.4, 0.0, 0.165]"))


@pytest.mark.parametrize(
    ("item", "message"),
    [
        (BALL.format("at: [0.8, 0.5]"), "unreachable placement: 0.943 m from the robot's axis, "),
        (BALL.format("at: [0.05, 0.0]"), "unreachable placement: 0.05 m from the robot's axis is"),
        (BOX.format("at: [0.8, 0.5], fixed: true"), None),
        ("{kind: shelf, size: [0.1, 0.1, 0.1], at: [0.8, 0.55]}", None),
        ("{kind: shelf, size: [0.1, 0.1, 0.1], at: [0.8, 0.55], fixed: false}", "expected at most"),
    ],
)
def test_reach(item: str, message: str | None, tmp_path: Path) -> None:
    if message is None:
        ok(tmp_path, it=item)
    else:
        error = scene_error(tmp_path, objects(it=item))
        assert error.startswith("scene.yaml:2: objects.it.at: unreachable placement")
        assert message in error


def test_reach_of_other_robots(tmp_path: Path) -> None:
    far = objects(it=BALL.format("at: [0.8, 0.5]"))
    write(tmp_path, "arm.yaml", "x: 1")
    load_scene(write(tmp_path, "a.yaml", f"{far}robot: arm.yaml"))
    file = write(tmp_path, "b.yaml", far)
    with pytest.raises(SpecError, match="unreachable placement"):
        load_scene(file)


def test_standing_beyond_the_support(tmp_path: Path) -> None:
    box = BOX.format("at: [0.4, 0.0]")
    error = scene_error(tmp_path, objects(box=box, it=BALL.format("on: box, at: [0.4, 0.06]")))
    assert "objects.it.at: its centre (0.4, 0.06) is beyond the top of 'box'" in error
    ok(tmp_path, box=box, it=BALL.format("on: box, at: [0.4, 0.04]"))


def test_the_mouth_of_a_cup(tmp_path: Path) -> None:
    cup = CUP.format("at: [0.4, 0.0]")  # 80 mm open
    error = scene_error(tmp_path, objects(cup=cup, it=BALL.format("on: cup")))
    assert "objects.it.on: it is 0.07 wide and would fall through the mouth of 'cup'" in error
    assert "expected 'inside: cup'" in error
    scene = ok(tmp_path, cup=cup, it="{kind: sphere, diameter: 0.1, on: cup}")
    # Rim at 0.21; the ball's centre is 3 cm above it (a 3-4-5 triangle), its lowest point below.
    assert place_all(scene)["it"].base == pytest.approx(0.21 + 0.03 - 0.05)
    ok(tmp_path, cup=cup, it="{kind: pen, diameter: 0.01, length: 0.2, on: cup}")


def test_too_large_for_its_container(tmp_path: Path) -> None:
    cup = CUP.format("at: [0.4, 0.2]")
    error = scene_error(
        tmp_path, objects(cup=cup, it="{kind: sphere, diameter: 0.085, inside: cup}")
    )
    assert "objects.it.inside: it is 0.085 × 0.085 and does not fit into 'cup', which is" in error
    ok(tmp_path, cup=cup, it="{kind: sphere, diameter: 0.079, inside: cup}")
    ok(tmp_path, cup=cup, it="{kind: pen, length: 0.2, diameter: 0.02, inside: cup}")
    plank = "{kind: box, size: [0.24, 0.20, 0.02], inside: chest}"
    error = scene_error(tmp_path, objects(chest=CHEST.format(0.1), it=plank))
    assert "it is 0.2 × 0.24 and does not fit into 'chest'" in error


def test_in_a_drawer(tmp_path: Path) -> None:
    chest = CHEST.format(0.10)
    scene = ok(tmp_path, chest=chest, it="{kind: sphere, diameter: 0.05, inside: chest.top}")
    place = place_all(scene)["it"]
    assert (place.x, place.y) == pytest.approx((0.45, -0.10))
    unit = scene.objects["chest"]
    assert isinstance(unit, DrawerUnit)
    # Two compartments of 71 mm; the drawer's floor is 6 mm above the lower end of the upper one.
    assert unit.compartment_heights() == pytest.approx((0.071, 0.071))
    assert place.base == pytest.approx(0.13 + 0.16 - 0.006 - 0.071 + 0.006)
    error = scene_error(
        tmp_path,
        objects(chest=chest, it="{kind: sphere, diameter: 0.05, inside: chest, at: [0.45, 0.1]}"),
    )
    assert "objects.it.at: its centre (0.45, 0.1) is not inside 'chest'" in error
    tall = "{{kind: box, size: [0.04, 0.04, 0.09], inside: chest, at: [0.45, {}]}}"
    ok(tmp_path, chest=chest, it=tall.format(-0.15))
    error = scene_error(tmp_path, objects(chest=chest, it=tall.format(-0.13)))
    assert "objects.it.inside: it is 0.09 high, but only 0.065 is clear where 'chest'" in error


def test_contents_of_one_vessel(tmp_path: Path) -> None:
    bowl = "{kind: bowl, at: [0.4, 0.0], diameter: 0.25, height: 0.06}"
    one, two = BALL.format("inside: bowl"), BALL.format("inside: bowl, at: [0.4, 0.05]")
    assert "overlaps 'one'" in scene_error(tmp_path, objects(bowl=bowl, one=one, two=two))
    ok(tmp_path, bowl=bowl, one=one, two=BALL.format("inside: bowl, at: [0.4, 0.075]"))
    # What is beside the bowl is behind its wall, however long its contents are.
    pen = "{kind: pen, length: 0.25, diameter: 0.01, inside: bowl}"
    ok(tmp_path, bowl=bowl, pen=pen, ball=BALL.format("at: [0.4, 0.17]"))


@pytest.mark.parametrize("heading", [0, 45, 90, 200])
@pytest.mark.parametrize("kind", ["pen", "capsule"])
def test_rods_that_stand_in_one_vessel(kind: str, heading: float, tmp_path: Path) -> None:
    bowl = "{kind: bowl, at: [0.4, 0.0], diameter: 0.12, height: 0.09}"
    stands = "inside: bowl, quaternion: [0.70711, 0, -0.70711, 0]"
    rod = f"{{{{kind: {kind}, diameter: 0.012, length: 0.13, at: [{{}}, {{}}], {stands}}}}}"
    x, y = (0.5 * f(math.radians(heading)) for f in (math.cos, math.sin))
    for apart, fits in ((0.04, True), (0.02, True), (0.008, False)):
        rods = [rod.format(0.4 + sign * apart * x, sign * apart * y) for sign in (-1, 1)]
        scene = objects(bowl=bowl, one=rods[0], two=rods[1])
        if fits:
            ok(tmp_path, bowl=bowl, one=rods[0], two=rods[1])
        else:
            assert "overlaps 'one'" in scene_error(tmp_path, scene)


@pytest.mark.parametrize(
    ("diameter", "at", "fits"),
    [
        (0.035, (0.4, 0.0), True), (0.055, (0.4, 0.0), True), (0.035, (0.41, 0.0), True),
        (0.065, (0.4, 0.0), False), (0.035, (0.42, 0.0), False), (0.035, (0.45, 0.0), False),
    ],
)  # fmt: skip
def test_what_is_under_a_cup(
    diameter: float, at: tuple[float, float], fits: bool, tmp_path: Path
) -> None:
    """It lies clear of the walls; 62 mm are clear in the middle, and the walls are 4 mm thick."""
    cup = "{kind: cup, at: [0.4, 0.0], diameter: 0.07, height: 0.085, wall: 0.004, %s}"
    over, upright = cup % "quaternion: [0, 1, 0, 0]", cup % "yaw_deg: 0"
    ball = f"{{kind: sphere, diameter: {diameter}, at: [{at[0]}, {at[1]}]}}"
    if fits:
        ok(tmp_path, cup=over, ball=ball)
        ok(tmp_path, ball=ball, cup=over)
    else:
        assert "overlaps 'cup'" in scene_error(tmp_path, objects(cup=over, ball=ball))
    assert "overlaps 'cup'" in scene_error(tmp_path, objects(cup=upright, ball=ball))
    low = over.replace("0.085", "0.036")
    assert "overlaps" in scene_error(tmp_path, objects(cup=low, ball=ball))


@pytest.mark.parametrize(
    ("item", "message"),
    [
        ("kind: cup, diameter: 0.04, height: 0.05, wall: 0.02", "wall: twice the wall is 0.04, "),
        ("kind: cup, diameter: 0.04, height: 0.05, floor: 0.05", "floor: found 0.05, expected les"),
        ("kind: cup, diameter: 0.04, height: 0.05, foot_diameter: 0.05", "foot_diameter: found 0"),
        ("kind: cup, diameter: 0.04, height: 0.05, foot_diameter: 0.005", "wall: twice the wall "),
        ("kind: pen, diameter: 0.01, length: 0.1, tip_length: 0.1", "tip_length: found 0.1, expe"),
        ("kind: capsule, diameter: 0.1, length: 0.05", "length: found 0.05, expected at least the"),
        ("kind: shelf, size: [0.2, 0.02, 0.2], wall: 0.01", "wall: twice the wall is 0.02, expec"),
        ("kind: shelf, size: [0.2, 0.2, 0.02], wall: 0.01", "wall: its boards' thickness is 0.02"),
        ("kind: cabinet, size: [0.2, 0.2, 0.2], wall: 0.1", "wall: twice the wall is 0.2, expect"),
        (
            "kind: cabinet, size: [0.2, 0.2, 0.2], door: {thickness: 0.2}",
            "door.thickness: found 0.2, expected less than the depth 0.2",
        ),
        (
            "kind: cabinet, size: [0.2, 0.2, 0.2], door: {handle: {width: 0.3}}",
            "door.handle.width: found 0.3, expected less than the front it is on",
        ),
        (
            "kind: drawer_unit, size: [0.2, 0.2, 0.05], drawers: [{name: a}, {name: b}, {name: c}]",
            "drawers: the stack does not fit: compartments of 0.008667, 0.008667, 0.008667",
        ),
        (
            "kind: drawer_unit, size: [0.2, 0.2, 0.2], drawers: [{name: a, height: 0.3}]",
            "drawers: the stack does not fit: compartments of 0.3 and 2 walls of 0.006",
        ),
        (
            "kind: drawer_unit, size: [0.2, 0.2, 0.2], drawers: [{name: a, travel: 0.2}]",
            "drawers[0].travel: found 0.2, expected less than the depth 0.2",
        ),
        (
            "kind: drawer_unit, size: [0.2, 0.02, 0.2], drawers: [{name: a}]",
            "wall: four times the wall is 0.024, expected less than the width 0.02",
        ),
        (
            "kind: drawer_unit, size: [0.2, 0.2, 0.2], drawers: [{name: a, handle: {width: 0.5}}]",
            "drawers[0].handle.width: found 0.5, expected less than the front it is on",
        ),
    ],
)
def test_inner_dimensions(item: str, message: str, tmp_path: Path) -> None:
    error = scene_error(tmp_path, objects(it=f"{{{item}, at: [0.4, 0.0]}}"))
    assert error.startswith("scene.yaml:2: objects.it.")
    assert message in error


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ("parts: {up: {joint: h}, low: {joint: h}}",
         "parts.low.joint: found 'h', which moves the part 'up' already; expected one part"),
        ("parts: {up: {joint: h, container_site: r}, low: {joint: g, container_site: r}}",
         "parts.low.container_site: found 'r', which is the room of the part 'up' already"),
        ("container_site: r, parts: {up: {joint: h, container_site: r}}",
         "parts.up.container_site: found 'r', which is the room of the object itself already"),
        ("parts: {up: {joint: h, open: 0.1, open_deg: 20}}",
         "parts.up.open_deg: found with 'open'; expected 'open' [m] of a slide"),
    ],
)  # fmt: skip
def test_parts_of_a_model_that_are_one_and_the_same(
    keys: str, message: str, tmp_path: Path
) -> None:
    write(tmp_path, "a.xml", "<mujoco/>")
    error = scene_error(tmp_path, objects(it=f"{{kind: mjcf, file: a.xml, at: [0.4, 0], {keys}}}"))
    assert error.startswith("scene.yaml:2: objects.it.")
    assert message in error
    two = "parts: {up: {joint: h, container_site: r}, low: {joint: g, container_site: s}}"
    apart = objects(it=f"{{kind: mjcf, file: a.xml, at: [0.4, 0], {two}}}")
    load_scene(write(tmp_path, "scene.yaml", apart))


def test_things_of_unknown_size_are_only_placed(tmp_path: Path) -> None:
    write(tmp_path, "a.obj", "x")
    mesh = "{{kind: mesh, file: a.obj, {}}}"
    ok(
        tmp_path,
        one=mesh.format("at: [0.4, 0.0], hollow: true"),
        two=mesh.format("at: [0.4, 0.0]"),
        ball=BALL.format("inside: one"),
        top=BALL.format("on: two"),
    )


def test_what_is_above_a_thing_of_unknown_height_may_be_above_others(tmp_path: Path) -> None:
    """Only what is on the same thing is told apart in the plane, and by heights that it shares."""
    write(tmp_path, "a.xml", "<mujoco/>")
    bench = "{kind: mjcf, file: a.xml, at: [0.4, 0.0], surface_site: top, fixed: true}"
    under = {"bench": bench, "under": BALL.format("at: [0.4, 0.0]")}
    ok(tmp_path, **under, top=BALL.format("on: bench"))
    ok(tmp_path, **under, top=BOX.format("on: bench"), upon=BALL.format("on: top"))
    ok(tmp_path, bench=bench, high=BALL.format("at: [0.4, 0.0, 0.3]"), top=BALL.format("on: bench"))
    beside = {"bench": bench, "one": BALL.format("on: bench"), "two": BALL.format("on: bench")}
    assert "overlaps 'one'" in scene_error(tmp_path, objects(**beside))
    stacked = {"bench": bench, "box": BOX.format("on: bench"),
               "ball": BALL.format("on: box, at: [0.4, 0.04]"),
               "lamp": BOX.format("on: bench, at: [0.4, 0.16]"),
               "globe": BOX.format("on: lamp, at: [0.4, 0.12]")}  # fmt: skip
    assert "overlaps" in scene_error(tmp_path, objects(**stacked))


def test_a_vessel_nests_by_its_foot(tmp_path: Path) -> None:
    plate = "{{kind: bowl, diameter: 0.17, foot_diameter: {}, height: 0.045, {}}}"
    low = plate.format(0.13, "at: [0.4, 0.0]")
    for place in ("inside: low", "on: low"):
        ok(tmp_path, low=low, high=plate.format(0.13, place))
    error = scene_error(tmp_path, objects(low=low, high=plate.format(0.168, "inside: low")))
    assert "does not fit into 'low'" in error


def test_tilted_boxes(tmp_path: Path) -> None:
    # Turned by 90° about y the long side stands up.
    upright = "quaternion: [0.70710678, 0, 0.70710678, 0]"
    scene = ok(tmp_path, it=BOX.format(f"at: [0.4, 0.0], {upright}"))
    place = place_all(scene)["it"]
    assert place.top - place.base == pytest.approx(0.2, abs=1e-6)
    ok(tmp_path, a=BOX.format(f"at: [0.4, 0.0], {upright}"), b=BOX.format("at: [0.56, 0.0]"))


def test_a_scene_without_a_document() -> None:
    ball = Sphere(kind="sphere", diameter=0.1, at=(3.0, 0.0))
    with pytest.raises(SpecError, match=r"^objects\.ball\.at: unreachable") as caught:
        check_scene(Scene(objects={"ball": ball}))
    assert caught.value.line is None

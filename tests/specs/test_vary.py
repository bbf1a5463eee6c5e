"""Varied scenes stay within bounds, valid and reproducible."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from etot_cli.errors import SpecError
from etot_cli.specs.checks import check_scene
from etot_cli.specs.load import load_scene
from etot_cli.specs.objects import Cup, Sphere
from etot_cli.specs.placement import place_all
from etot_cli.specs.resize import LENGTHS
from etot_cli.specs.scene import Actuation, Scene
from etot_cli.specs.vary import MAX_JOINTS, vary, vary_truth
from tests.specs.helpers import objects, write

SCENES = sorted((Path(__file__).parents[2] / "scenes").glob("*.yaml"))
LOADED = [load_scene(path) for path in SCENES]
SEEDS = st.integers(0, 2**63)


def scene(folder: Path, extra: str = "", **items: str) -> Scene:
    return load_scene(write(folder, "scene.yaml", objects(**items) + extra))


@settings(max_examples=40, deadline=None)
@given(st.sampled_from(LOADED), SEEDS)
def test_draws_are_valid_bounded_and_reproducible(nominal: Scene, seed: int) -> None:
    varied = vary(nominal, seed)
    check_scene(varied)
    assert varied == vary(nominal, seed)
    # The models would accept it, too.
    assert Scene.model_validate(varied.model_dump(by_alias=True)) == varied
    bound = nominal.variation
    before, after = place_all(nominal), place_all(varied)
    for name, item in nominal.objects.items():
        other = varied.objects[name]
        assert abs(other.friction - item.friction) <= bound.friction * item.friction + 1e-12
        if item.mass is None:
            assert other.mass is None
        else:
            assert other.mass is not None
            assert abs(other.mass - item.mass) <= bound.mass * item.mass + 1e-12
        if item.on is None and item.inside is None:
            for axis in ("x", "y"):
                shift = getattr(after[name], axis) - getattr(before[name], axis)
                assert abs(shift) <= bound.position_m + 1e-12
            turn = math.remainder(other.yaw_deg - item.yaw_deg, 360)
            assert abs(turn) <= bound.yaw_deg + 1e-9
        lengths = LENGTHS.get(type(item), ())
        for key in lengths:
            one, two = getattr(item, key), getattr(other, key)
            if one is not None:
                assert two == pytest.approx(one, rel=nominal.perception.size + 1e-9)
        same = {"at", "yaw_deg", "quaternion", "friction", "mass", *lengths}
        assert other.model_dump(exclude=same) == item.model_dump(exclude=same)


@settings(max_examples=25, deadline=None)
@given(st.sampled_from(LOADED), SEEDS)
def test_true_worlds_differ_in_what_no_twin_is_told(nominal: Scene, seed: int) -> None:
    twin, truth = vary(nominal, seed), vary_truth(nominal, seed)
    assert twin.actuation == Actuation() and truth == vary_truth(nominal, seed)
    bound, drawn = nominal.variation, truth.actuation
    assert abs(drawn.pad_friction - 1.0) <= bound.pad_friction
    assert abs(drawn.gripper_force - 1.0) <= bound.gripper_force
    assert len(set(drawn.servo)) == len(drawn.servo) == MAX_JOINTS
    assert max(abs(gain - 1.0) for gain in drawn.servo) <= bound.servo
    assert 0.0 <= drawn.delay_s <= bound.delay_s
    for name, item in twin.objects.items():
        other = truth.objects[name]
        same = {"rolling_friction"}
        assert other.model_dump(exclude=same) == item.model_dump(exclude=same)
        if item.rolling_friction is not None:
            assert other.rolling_friction == pytest.approx(
                item.rolling_friction, rel=bound.rolling_friction + 1e-9
            )
    assert Scene.model_validate(truth.model_dump(by_alias=True)) == truth


def test_nothing_else_is_drawn_where_nothing_may_differ() -> None:
    nominal = LOADED[0]
    none = dict.fromkeys(
        ("rolling_friction", "pad_friction", "gripper_force", "servo", "delay_s"), 0.0
    )
    scene = nominal.model_copy(update={"variation": nominal.variation.model_copy(update=none)})
    assert vary_truth(scene, 5) == vary(scene, 5)


def test_the_robot_of_a_file_is_the_one_described(tmp_path: Path) -> None:
    with pytest.raises(SpecError, match="unknown key 'actuation'"):
        scene(
            tmp_path,
            "actuation: {gripper_force: 2}",
            a="{kind: sphere, diameter: 0.05, at: [0.3, 0]}",
        )


def test_seeds_differ_and_spread() -> None:
    nominal = next(item for item in LOADED if item.name == "two_balls")
    found = [vary(nominal, seed).objects["tennis_ball_1"].at for seed in range(60)]
    assert len(set(found)) == 60
    shifts = [at[0] - 0.362 for at in found if at is not None]
    assert min(shifts) < -0.007
    assert max(shifts) > 0.007


def test_order_and_other_objects_do_not_matter(tmp_path: Path) -> None:
    a, b = "{kind: sphere, diameter: 0.05, at: [0.3, 0.1]}", "{kind: sphere, diameter: 0.05, at: "
    one = vary(scene(tmp_path, a=a, b=b + "[0.4, 0.2]}"), 3)
    two = vary(scene(tmp_path, b=b + "[0.4, 0.2]}", a=a), 3)
    alone = vary(scene(tmp_path, a=a), 3)
    assert one.objects == two.objects
    assert one.objects["a"] == alone.objects["a"]
    other = vary(scene(tmp_path, "description: x\ncameras: {}\n", a=a), 3)
    assert other.objects["a"] == alone.objects["a"]


def test_negative_seeds_work(tmp_path: Path) -> None:
    nominal = scene(tmp_path, a="{kind: sphere, diameter: 0.05, at: [0.3, 0.1]}")
    assert vary(nominal, -1) == vary(nominal, -1) != vary(nominal, 1)


STACK = {
    "chest": "{kind: box, size: [0.2, 0.2, 0.1], at: [0.45, 0.1], yaw_deg: 20, mass: 1.0}",
    "tray": "{kind: box, size: [0.1, 0.1, 0.02], on: chest, at: [0.5, 0.1], yaw_deg: 20}",
    "pin": "{kind: sphere, diameter: 0.02, on: tray, at: [0.53, 0.1]}",
    "middle": "{kind: cylinder, diameter: 0.03, height: 0.03, on: chest, at: [0.38, 0.1]}",
}


@settings(max_examples=30, deadline=None)
@given(SEEDS)
def test_things_move_with_what_carries_them(seed: int) -> None:
    nominal = Scene.model_validate(_stack_data())
    varied = vary(nominal, seed)
    before, after = place_all(nominal), place_all(varied)
    own = 0.3 * nominal.variation.position_m
    turn = varied.objects["chest"].yaw_deg - nominal.objects["chest"].yaw_deg
    for name, levels in (("tray", 1), ("pin", 2), ("middle", 1)):
        u, v = before[name].x - before["chest"].x, before[name].y - before["chest"].y
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        x, y = after["chest"].x + c * u - s * v, after["chest"].y + s * u + c * v
        # Own offsets add up along the stack; the tray's own turn moves the pin a little more.
        slack = levels * own * math.sqrt(2) + (0.03 * math.radians(3.0) if levels > 1 else 0.0)
        assert math.hypot(after[name].x - x, after[name].y - y) <= slack + 1e-9


def _stack_data() -> dict[str, object]:
    import yaml

    items = {name: yaml.safe_load(text.replace(" on:", " 'on':")) for name, text in STACK.items()}
    return {"objects": items, "variation": {"position_m": 0.02, "yaw_deg": 10.0}}


def test_contents_of_a_cup_stay_in_its_middle(tmp_path: Path) -> None:
    nominal = scene(
        tmp_path,
        cup="{kind: cup, diameter: 0.09, height: 0.08, at: [0.4, 0.0]}",
        apple="{kind: sphere, diameter: 0.088, on: cup}",
        mug="{kind: cup, diameter: 0.09, height: 0.08, at: [0.4, 0.2]}",
        ball="{kind: sphere, diameter: 0.05, inside: mug, at: [0.41, 0.2]}",
    )
    varied = vary(nominal, 5)
    assert varied.objects["apple"].at is None
    mug, ball = varied.objects["mug"], varied.objects["ball"]
    assert isinstance(mug, Cup)
    assert isinstance(ball, Sphere)
    assert mug.at is not None
    assert ball.at is not None
    distance = math.hypot(ball.at[0] - mug.at[0], ball.at[1] - mug.at[1])
    assert distance == pytest.approx(0.01)


def test_kept_objects_stay(tmp_path: Path) -> None:
    nominal = scene(
        tmp_path,
        "variation: {keep: [a, c], position_m: 0.02}",
        a="{kind: box, size: [0.1, 0.1, 0.1], at: [0.3, 0.0], yaw_deg: 7}",
        b="{kind: sphere, diameter: 0.05, on: a}",
        c="{kind: sphere, diameter: 0.05, on: d, at: [0.4, 0.31]}",
        d="{kind: box, size: [0.1, 0.1, 0.1], at: [0.4, 0.3]}",
    )
    varied = vary(nominal, 2)
    assert varied.objects["a"].at == (0.3, 0.0)
    assert varied.objects["a"].yaw_deg == 7
    assert varied.objects["b"].at is not None  # had no place of its own, but is not kept
    c, d = place_all(varied)["c"], place_all(varied)["d"]
    assert math.hypot(c.x - d.x, c.y - d.y) == pytest.approx(0.01)


def test_heights_and_orientations(tmp_path: Path) -> None:
    nominal = scene(
        tmp_path,
        a="{kind: box, size: [0.1, 0.1, 0.1], at: [0.3, 0.0, 0.4], quaternion: [0.8, 0.6, 0, 0]}",
    )
    item = vary(nominal, 1).objects["a"]
    assert item.at is not None
    assert len(item.at) == 3
    assert item.at[2] == 0.4
    assert item.quaternion is not None
    assert sum(part**2 for part in item.quaternion) == pytest.approx(1)
    assert item.yaw_deg == 0.0


@pytest.mark.slow
def test_crowded_scenes_are_drawn_with_less_amplitude(tmp_path: Path) -> None:
    # Balls that touch each other all around: hardly any draw of ±10 cm parts them.
    balls = {
        f"b{row}{column}": "{kind: sphere, diameter: 0.1, "
        f"at: [{0.3 + 0.101 * row:.3f}, {-0.3 + 0.101 * column:.3f}]}}"
        for row in range(4)
        for column in range(6)
    }
    nominal = scene(tmp_path, "variation: {position_m: 0.1}", **balls)
    varied = vary(nominal, 0)
    check_scene(varied)
    assert varied.objects["b00"].friction != nominal.objects["b00"].friction
    assert vary(nominal, 0) == varied


def test_nothing_to_vary(tmp_path: Path) -> None:
    nominal = scene(
        tmp_path,
        "variation: {position_m: 0, yaw_deg: 0, friction: 0, mass: 0, size: 0}",
        a="{kind: sphere, diameter: 0.05, at: [0.3, 0.1], mass: 0.1}",
    )
    assert vary(nominal, 4) == nominal


def test_an_empty_scene() -> None:
    assert vary(Scene(), 1) == Scene()

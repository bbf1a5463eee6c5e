"""Lines through objects against analytic chords."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from etot_cli.skills.grasps.solids import Solids
from etot_cli.skills.placements.canvas import Canvas, Shape
from etot_cli.world.pose import Pose, rotation_from_axes
from tests.world.helpers import BALL, BOX, CUP, Stage, make_scene, set_up

TURNED = BOX | {"at": [0.4, -0.3], "yaw_deg": 37}
WALL, FLOOR = 0.006, 0.008


@pytest.fixture(scope="module")
def stage() -> Stage:
    rod = {"kind": "cylinder", "diameter": 0.05, "height": 0.1, "at": [0.4, 0.0]}
    capsule = {"kind": "capsule", "diameter": 0.03, "length": 0.1, "at": [0.2, 0.0]}
    return set_up(
        make_scene(
            ball=BALL | {"at": [0.4, 0.3]}, box=TURNED, cup=CUP | {"at": [0.6, 0.0], "wall": WALL,
            "floor": FLOOR}, rod=rod, capsule=capsule,
        )
    )  # fmt: skip


def chords(stage: Stage, name: str, origin: object, direction: object) -> list[tuple[float, float]]:
    """Intervals along a line through ``origin`` in the object's own frame."""
    body = stage.data.body(name)
    rotation = body.xmat.reshape(3, 3)
    start = body.xpos + rotation @ np.array(origin, dtype=float)
    along = rotation @ np.array(direction, dtype=float)
    lines = Solids(stage.world).intervals(stage.data, name, start[None], along[None])
    return [(piece.start, piece.end) for piece in lines[0]]


@given(st.floats(-0.024, 0.024), st.floats(0, 6.28))
@settings(max_examples=30, deadline=None)
def test_sphere(stage: Stage, offset: float, angle: float) -> None:
    direction = np.array([np.cos(angle), np.sin(angle), 0.0])
    ((low, high),) = chords(stage, "ball", offset * np.array([0.0, 0.0, 1.0]), direction)
    half = np.sqrt(0.025**2 - offset**2)
    assert (low, high) == pytest.approx((-half, half), abs=1e-6)


def test_line_beside_an_object_meets_nothing(stage: Stage) -> None:
    assert chords(stage, "ball", [0, 0, 0.026], [1, 0, 0]) == []
    assert chords(stage, "box", [0, 0.031, 0], [1, 0, 0]) == []
    assert chords(stage, "cup", [0, 0, 0.045], [1, 0, 0]) == []


@pytest.mark.parametrize("axis", range(3))
def test_turned_box(stage: Stage, axis: int) -> None:
    direction = np.eye(3)[axis]
    ((low, high),) = chords(stage, "box", 0.3 * direction, direction)
    half = BOX["size"][axis] / 2
    assert (low, high) == pytest.approx((-0.3 - half, -0.3 + half), abs=1e-6)


def test_box_across_its_diagonal(stage: Stage) -> None:
    x, y, _ = BOX["size"]
    direction = np.array([x, y, 0.0]) / np.hypot(x, y)
    ((low, high),) = chords(stage, "box", [0, 0, 0], direction)
    assert high - low == pytest.approx(np.hypot(x, y), abs=1e-6)


@pytest.mark.parametrize("angle", np.radians([0, 11, 45, 100]))
def test_cylinder_and_capsule(stage: Stage, angle: float) -> None:
    direction = [np.cos(angle), np.sin(angle), 0]
    ((low, high),) = chords(stage, "rod", [0, 0, 0.03], direction)
    assert high - low == pytest.approx(0.05, rel=0.01)
    ((low, high),) = chords(stage, "rod", [0, 0, 0], [0, 0, 1])
    assert high - low == pytest.approx(0.10, abs=1e-6)
    ((low, high),) = chords(stage, "capsule", [0.02, 0, 0], [0, np.cos(angle), np.sin(angle)])
    assert high - low == pytest.approx(0.03, rel=0.01)
    ((low, high),) = chords(stage, "capsule", [0, 0, 0], [1, 0, 0])
    assert high - low == pytest.approx(0.10, rel=0.01)


@pytest.mark.parametrize("angle", np.radians([0, 40, 100, 161, 250]))
@pytest.mark.parametrize("level", [-0.02, 0.0, 0.03])
def test_cup_has_two_walls(stage: Stage, angle: float, level: float) -> None:
    direction = [np.cos(angle), np.sin(angle), 0]
    near, far = chords(stage, "cup", [0, 0, level], direction)
    radius = CUP["diameter"] / 2
    for wall in (near, far):
        assert wall[1] - wall[0] == pytest.approx(WALL, rel=0.03)
    assert -near[0] == pytest.approx(radius, rel=0.012)
    assert far[1] == pytest.approx(radius, rel=0.012)


def test_cup_from_above(stage: Stage) -> None:
    half = CUP["height"] / 2
    ((low, high),) = chords(stage, "cup", [0.0, 0.0, 0.0], [0, 0, 1])
    assert (low, high) == pytest.approx((-half, -half + FLOOR), abs=1e-6)
    middle = CUP["diameter"] / 2 - WALL / 2
    ((low, high),) = chords(stage, "cup", [0.0, middle, 0.0], [0, 0, 1])
    assert high - low == pytest.approx(CUP["height"], abs=0.001)


def test_many_lines_at_once_agree_with_one_at_a_time(stage: Stage) -> None:
    rng = np.random.default_rng(2)
    origins = stage.data.body("cup").xpos + rng.uniform(-0.04, 0.04, (20, 3))
    directions = rng.normal(size=(20, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    solids = Solids(stage.world)
    together = solids.intervals(stage.data, "cup", origins, directions)
    for i in range(20):
        alone = solids.intervals(stage.data, "cup", origins[i : i + 1], directions[i : i + 1])
        assert len(together[i]) == len(alone[0])
        for one, other in zip(together[i], alone[0], strict=True):
            assert (one.start, one.end) == pytest.approx((other.start, other.end))
    assert sum(len(line) for line in together) > 10


def test_cuts_are_lines_that_stand_upright(stage: Stage) -> None:
    """Of many solids at once, turned any way, by a grid that is turned itself; a margin makes them
    larger.
    """
    solids, data = Solids(stage.world), stage.data
    turn = rotation_from_axes(np.array([0.3, -0.5, 0.8]), np.array([0.9, 0.2, 0.1]))
    names = ("ball", "box", "rod", "capsule", "cup")
    geoms = [int(geom) for name in names for geom in stage.world.geoms_of(name)]
    shapes = [
        Shape(geom, Pose(np.array([0.01, 0.02, 0.3]), turned @ data.geom_xmat[geom].reshape(3, 3)))
        for geom in geoms
        for turned in (np.eye(3), turn)
    ]
    axes, cell = np.array([[0.6, 0.8], [-0.8, 0.6]]), 0.004
    # No line runs along a side.
    origin = np.array([0.00131, 0.00073])
    canvas = Canvas(origin, axes, cell, np.array([40, 40]))
    wider = canvas.cuts(solids, shapes, 0.002)
    for (number, window, low, high), wide in zip(canvas.cuts(solids, shapes), wider, strict=True):
        index = np.stack(np.meshgrid(*(np.arange(81)[part] for part in window), indexing="ij"), -1)
        places = origin + (index.reshape(-1, 2) - 40) * cell @ axes
        origins = np.column_stack([places, np.zeros(len(places))])
        pose = shapes[number].pose
        ((enters, leaves, *_),) = solids._crossings(
            np.array([shapes[number].geom]), pose.position[None], pose.rotation[None], origins,
            np.array([[0.0, 0.0, 1.0]]),
        )  # fmt: skip
        met = leaves - enters > 1e-6
        assert 2 < met.sum() < met.size
        assert np.array_equal((high - low > 1e-6).ravel(), met)
        assert low.ravel()[met] == pytest.approx(enters[met], abs=1e-9)
        assert high.ravel()[met] == pytest.approx(leaves[met], abs=1e-9)
        assert wide.number == number
        assert (wide.high - wide.low).max() > (high - low).max() + 0.003
    assert len(wider) == len(shapes)
    covered = np.zeros((81, 81), dtype=bool)
    for _, window, low, high in canvas.cuts(solids, shapes):
        covered[window] |= high > low
    assert np.array_equal(canvas.covered(solids, shapes), covered)
    beside = Shape(geoms[0], Pose(np.array([2.0, 0.0, 0.0]), np.eye(3)))
    assert not canvas.cuts(solids, [beside])

"""Free places on desks, tops, boards and in containers, as height maps show them."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import islice
from typing import Any

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.skills.action import Keepout
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.collision import Attached
from etot_cli.skills.placements.judging import DESK_GAP, Quality, Request
from etot_cli.skills.placements.places import Place, PlaceFinder
from etot_cli.skills.placements.relief import free_distance, swept_shapes
from etot_cli.skills.placements.support import (
    DESK_EDGE,
    Support,
    container_support,
    surface_support,
)
from etot_cli.world.pose import Pose
from tests.skills.helpers import BALL, BOX, OVEN, UNIT, drawers
from tests.world.helpers import make_scene

LOOKED_AT = 1500
"""Places of a floor that these tests look at, the best ones."""
HALF = 0.02
BLOCK = {"kind": "box", "size": [2 * HALF] * 3, "mass": 0.06}
BOWL = {"kind": "bowl", "diameter": 0.20, "height": 0.06, "mass": 0.4, "at": [0.42, -0.2]}


class Hand:
    """A block ``thing`` in the hand above the desk, in a scene of these objects."""

    def __init__(self, thing: dict[str, Any] | None = None, **objects: dict[str, Any]) -> None:
        held = (thing or BLOCK) | {"at": [0.3, 0.0]}
        simulated = SimulatedWorld(make_scene(thing=held, **objects))
        snapshot, _ = simulated.start()
        self.belief: Belief = simulated.believe(snapshot)
        data, world = self.belief.data, self.belief.world
        data.qpos[world.robot.finger_qpos] = HALF
        data.joint("thing").qpos[:3] = self.belief.tool().position
        mujoco.mj_kinematics(world.model, data)
        mujoco.mj_comPos(world.model, data)
        turned = self.belief.tool().rotation.T @ np.eye(3)
        self.attached = Attached("thing", Pose(np.zeros(3), turned))

    def support(self, address: str, *, into: bool = False, edge: float = DESK_EDGE) -> Support:
        found = (
            container_support(self.belief, address)
            if into
            else surface_support(self.belief, address, edge)
        )
        assert found is not None
        return found

    def places(self, address: str, *, into: bool = False, **request: Any) -> list[Place]:
        support = self.support(address, into=into)
        finder = PlaceFinder(self.belief, Request(self.attached, support, **request))
        return list(islice(finder.places(), LOOKED_AT))

    def spots(self, address: str = "desk", **request: Any) -> np.ndarray:
        good = [
            place.pose.position[:2]
            for place in self.places(address, **request)
            if place.quality in (Quality.GOOD, Quality.SWEPT)
        ]
        return np.array(good).reshape(-1, 2)


@pytest.fixture(scope="module")
def hand() -> Hand:
    return Hand(
        box=BOX | {"at": [0.4, 0.25]},
        ball=BALL | {"at": [0.35, -0.35]},
        unit=UNIT | {"at": [0.47, 0.0], "yaw_deg": -90, "drawers": drawers()},
    )


@given(
    arrays(bool, array_shapes(min_dims=2, max_dims=2, max_side=30), elements=st.booleans()),
    st.integers(1, 40),
)
@pytest.mark.slow
def test_free_distances_are_exact(mask: NDArray[np.bool_], rarity: int) -> None:
    blocked = mask & (np.arange(mask.size).reshape(mask.shape) % rarity == 0)
    if blocked.any():
        assert np.array_equal(free_distance(blocked, 0.5), distance_transform_edt(~blocked) * 0.5)
    else:
        assert (free_distance(blocked, 0.5) == 10.0).all()


@pytest.mark.slow
def test_places_are_free_and_on_the_desk(hand: Hand) -> None:
    found = hand.spots()
    assert len(found) > 30
    desk = hand.belief.world.scene.desk
    for axis in range(2):
        edge = desk.size[axis] / 2 - DESK_EDGE - HALF
        assert np.abs(found[:, axis] - desk.center[axis]).max() <= edge + 0.005
    for name, half in (("box", 0.025), ("ball", 0.035)):
        center = hand.belief.data.body(name).xpos[:2]
        assert np.linalg.norm(found - center, axis=1).min() >= HALF + half + DESK_GAP - 0.005
    inside = (np.abs(found[:, 0] - 0.47) < 0.09) & (np.abs(found[:, 1]) < 0.12)
    assert not inside.any(), "not in the furniture"
    assert np.hypot(*found.T).min() > 0.1, "not in the robot's foot"


def test_a_place_that_is_asked_for_may_be_near_the_edge() -> None:
    """Nearer than places of free choice, the thing as large as it may be on the desk."""
    for half, margin in ((0.015, 0.01), (0.025, 0.02), (0.05, 0.005)):
        there = (0.30, -0.60 + half + margin)
        hand = Hand(BLOCK | {"size": [2 * half, 2 * half, 0.04]})
        finder = PlaceFinder(
            hand.belief,
            Request(hand.attached, hand.support("desk", edge=0.0), at=(there,)),
        )
        good = [one.pose.position[:2] for one in finder.places(kinds=(Quality.GOOD,))]
        assert min(np.linalg.norm(good - np.array(there), axis=1)) <= 0.005
        assert min(point[1] for point in good) >= -0.60 + half - 0.005, "all of it is on the desk"


@pytest.mark.slow
def test_keepout_is_respected(hand: Hand) -> None:
    first = hand.spots()[0]
    disc = Keepout(float(first[0]), float(first[1]), 0.12)
    found = hand.spots(keepout=(disc,))
    assert len(found) > 5
    assert np.linalg.norm(found - first, axis=1).min() >= disc.radius + HALF
    assert len(hand.spots(keepout=(Keepout(0.4, 0.0, 2.0),))) == 0


def test_preference_shifts_the_choice_and_forbids(hand: Hand) -> None:
    def right_of_the_middle(points: np.ndarray) -> np.ndarray:
        return np.where(points[:, 1] < -0.1, 0.0, np.inf)

    found = hand.spots(preference=right_of_the_middle)
    assert len(found) and (found[:, 1] < -0.1).all()


def sweep_distance(hand: Hand, points: Iterable[np.ndarray]) -> list[float]:
    """Distances of points (2,) from the middles of all that doors and drawers pass through."""
    middles = np.array([shape.pose.position[:2] for shape in swept_shapes(hand.belief)])
    return [float(np.linalg.norm(middles - point, axis=1).min()) for point in points]


@pytest.mark.slow
def test_way_of_the_drawer_stays_free(hand: Hand) -> None:
    """The closed drawer slides 0.14 m towards -y; a safe place is never there, others come last."""
    strict = hand.spots(strict=True)

    def swept(found: np.ndarray) -> np.ndarray:
        across = np.abs(found[:, 0] - 0.47) < 0.09 + HALF
        along = (found[:, 1] < -0.10) & (found[:, 1] > -0.12 - 0.14 - HALF)
        return np.asarray(across & along)

    assert not swept(strict).any()
    beyond = (np.abs(strict[:, 0] - 0.47) < 0.06) & (strict[:, 1] < -0.12 - 0.14 - HALF)
    assert beyond.any(), "but beyond its way"

    def in_front(points: np.ndarray) -> np.ndarray:
        return np.where((points[:, 1] < -0.14) & (points[:, 0] > 0.35), 0.0, np.inf)

    loose = swept(hand.spots(preference=in_front))
    first = int(loose.argmax())
    assert 0 < first < len(loose), "only where no other place is left"
    assert loose[first:].mean() > 0.5


def test_way_of_a_door_stays_free() -> None:
    hand = Hand(oven=OVEN | {"at": [0.45, 0.3], "yaw_deg": -60})
    found = hand.spots(strict=True)
    assert len(found)
    assert min(sweep_distance(hand, found)) > HALF + DESK_GAP


@pytest.mark.slow
def test_places_on_furniture_lie_on_its_top(hand: Hand) -> None:
    found = hand.places("unit")
    assert found
    top = hand.belief.world.scene.desk.top + UNIT["size"][2] + HALF
    for place in found:
        assert place.pose.position[2] == pytest.approx(top, abs=2e-3)
        assert place.bearers == {"unit"}


@pytest.mark.slow
def test_the_middle_of_an_empty_top_comes_first() -> None:
    plate = {"kind": "cylinder", "diameter": 0.16, "height": 0.02, "mass": 0.3, "at": [0.45, 0.1]}
    hand = Hand(plate=plate)
    np.testing.assert_allclose(hand.spots("plate")[0], [0.45, 0.1], atol=0.004)


@pytest.mark.parametrize("size", [0.036, 0.04, 0.05, 0.06])
@pytest.mark.slow
def test_a_top_as_small_as_the_object_has_its_middle(size: float) -> None:
    hand = Hand(base=BLOCK | {"size": [size] * 3, "at": [0.45, 0.1]})
    first = hand.places("base")[0]
    np.testing.assert_allclose(first.pose.position[:2], [0.45, 0.1], atol=0.003)
    assert first.quality in (Quality.GOOD, Quality.PILED)


@pytest.mark.slow
def test_nothing_stays_on_the_edge_of_a_top() -> None:
    """All places offered have the centre of mass well over the top."""
    hand = Hand(base=BLOCK | {"size": [0.04] * 3, "at": [0.45, 0.1]})
    for place in hand.places("base"):
        offset = np.abs(place.pose.position[:2] - [0.45, 0.1])
        assert offset.max() < 0.016


@pytest.mark.slow
def test_what_stands_on_furniture_is_an_obstacle_there() -> None:
    unit = UNIT | {"at": [0.47, 0.0], "yaw_deg": -90, "drawers": drawers()}
    hand = Hand(unit=unit, box=BOX | {"on": "unit", "at": [0.47, 0.06]})
    found = hand.spots("unit")
    assert len(found)
    assert np.linalg.norm(found - [0.47, 0.06], axis=1).min() > HALF + 0.025
    alone = hand.spots("unit", absent=frozenset({"box"}))
    assert np.linalg.norm(alone - [0.47, 0.06], axis=1).min() < HALF


@pytest.mark.slow
def test_nothing_fits_on_a_full_top() -> None:
    lid = {"kind": "box", "on": "unit", "size": [0.22, 0.17, 0.02]}
    hand = Hand(unit=UNIT | {"at": [0.47, 0.0], "drawers": drawers()}, lid=lid)
    assert not hand.places("unit")


@pytest.mark.slow
def test_nearer_places_come_first_other_things_being_equal() -> None:
    left, right = (Hand(thing=BLOCK) for _ in range(2))
    for hand, side in ((left, 0.25), (right, -0.25)):
        hand.belief.data.joint("thing").qpos[:2] = [0.3, side]
        mujoco.mj_kinematics(hand.belief.world.model, hand.belief.data)
    assert left.spots()[0][1] > 0.1 and right.spots()[0][1] < -0.1


@pytest.mark.slow
def test_same_question_same_answer(hand: Hand) -> None:
    np.testing.assert_array_equal(hand.spots(), hand.spots())


@pytest.mark.slow
def test_a_lid_lies_on_the_rim_of_a_cup_and_a_small_block_does_not() -> None:
    cup = {"kind": "cup", "diameter": 0.09, "height": 0.08, "mass": 0.2, "at": [0.42, -0.1]}
    lid = {"kind": "box", "size": [0.11, 0.08, 0.015], "mass": 0.1}
    first = Hand(thing=lid, cup=cup).places("cup")[0]
    np.testing.assert_allclose(first.pose.position[:2], cup["at"], atol=0.006)
    assert first.bearers == {"cup"}
    assert not Hand(cup=cup).places("cup")


# -- containers ------------------------------------------------------------------------------------


@pytest.mark.slow
def test_an_empty_bowl_is_filled_in_the_middle() -> None:
    first = Hand(bowl=BOWL).places("bowl", into=True)[0]
    np.testing.assert_allclose(first.pose.position[:2], BOWL["at"], atol=0.004)
    assert first.quality is Quality.GOOD and first.drop == 0.0


@pytest.mark.parametrize("count", [1, 2, 3])
@pytest.mark.slow
def test_a_bowl_is_filled_beside_what_is_in_it(count: int) -> None:
    offsets = [(0.0, 0.0), (0.0, 0.06), (0.0, -0.06)][:count]
    inside = {
        f"block{i}": BLOCK | {"inside": "bowl", "at": [0.42 + x, -0.2 + y]}
        for i, (x, y) in enumerate(offsets)
    }
    first = Hand(bowl=BOWL, **inside).places("bowl", into=True)[0]
    assert first.quality is Quality.GOOD
    for x, y in offsets:
        away = np.abs(first.pose.position[:2] - [0.42 + x, -0.2 + y]).max()
        assert away > 2 * HALF


@pytest.mark.slow
def test_the_inside_of_a_bowl_is_what_its_walls_leave() -> None:
    wide = BOWL | {"foot_diameter": 0.10}
    found = [p for p in Hand(bowl=wide).places("bowl", into=True) if p.quality is Quality.GOOD]
    assert found
    away = np.array([np.linalg.norm(place.pose.position[:2] - BOWL["at"]) for place in found])
    assert away.max() < 0.05 - HALF


@pytest.mark.slow
def test_a_full_box_takes_another_on_top() -> None:
    """Where the floor is covered and the rim is high, things are piled where they are stable."""
    tray = {"kind": "cup", "diameter": 0.09, "height": 0.12, "mass": 0.4, "at": [0.42, -0.2]}
    below = {"kind": "cylinder", "diameter": 0.078, "height": 0.03, "mass": 0.1, "inside": "tray"}
    first = Hand(tray=tray, below=below).places("tray", into=True)[0]
    assert first.quality is Quality.PILED and first.bearers == {"below"}


@pytest.mark.slow
def test_a_lid_lies_across_the_mouth_of_a_cup_and_nothing_smaller_does() -> None:
    cup = {"kind": "cup", "diameter": 0.064, "height": 0.08, "mass": 0.2, "at": [0.42, -0.2]}
    lid = {"kind": "cylinder", "diameter": 0.070, "height": 0.016, "mass": 0.04}
    best = Hand(lid, cup=cup).places("cup")[0]
    rim = 0.13 + 0.08
    assert np.allclose(best.pose.position, [0.42, -0.2, rim + 0.008], atol=0.004)
    assert best.bearers == {"cup"}
    marble = {"kind": "sphere", "diameter": 0.03, "mass": 0.02}
    assert not Hand(marble, cup=cup).places("cup")

"""Transits around obstacles."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from etot_cli.skills.motion.clearance import BESIDE, CLEARANCES
from etot_cli.skills.motion.collision import Attached, CollisionChecker
from etot_cli.skills.motion.kinematics import Arm
from etot_cli.skills.motion.transit import edge_free, plan_transit
from etot_cli.world.pose import Pose, rotation_from_axes
from tests.skills.helpers import BALL
from tests.world.helpers import make_scene, set_up

DOWN = rotation_from_axes(np.array([0.0, 0.0, -1.0]), np.array([0.0, 1.0, 0.0]))


class Course:
    """A wall between two places."""

    def __init__(self, height: float) -> None:
        wall = {"kind": "box", "size": [0.34, 0.02, height], "at": [0.47, 0.0], "fixed": True}
        ball = BALL | {"at": [0.3, 0.45]}
        self.stage = set_up(make_scene(wall=wall, ball=ball))
        self.arm = Arm(self.stage.world.robot.spec)
        self.checker = CollisionChecker(self.stage.world)
        self.checker.freeze(self.stage.data)
        self.checker.set_fingers(0.06)
        self.start, self.goal = (
            self.arm.reach(Pose(np.array([0.4, y, 0.22]), DOWN), self.arm.home).joints
            for y in (-0.2, 0.2)
        )

    def plan(self, seed: int, attached: Attached | None = None) -> np.ndarray | None:
        rng = np.random.default_rng(seed)
        return plan_transit(self.arm, self.checker, self.start, self.goal, attached, rng)

    def is_free(self, path: np.ndarray, attached: Attached | None = None) -> bool:
        """Checks finely, at half the clearance that was asked for."""
        for a, b in pairwise(path):
            count = int(np.ceil(np.abs(b - a).max() / 0.01))
            for share in np.linspace(0.0, 1.0, count + 1):
                if self.checker.hits(a + share * (b - a), attached, clearance=0.5 * CLEARANCES[1]):
                    return False
        return True


@pytest.fixture(scope="module", params=[0.16, 0.30])
def course(request: pytest.FixtureRequest) -> Course:
    """A low wall, that a lifted way clears, and a high one, that needs a search."""
    return Course(request.param)


def test_straight_way_is_blocked(course: Course) -> None:
    assert not edge_free(course.start, course.goal, lambda q: not course.checker.hits(q))


@pytest.mark.parametrize("seed", range(3))
def test_way_around_is_free(course: Course, seed: int) -> None:
    path = course.plan(seed)
    assert path is not None
    np.testing.assert_array_equal(path[0], course.start)
    np.testing.assert_array_equal(path[-1], course.goal)
    assert course.is_free(path)
    assert np.all(path >= course.arm.lower) and np.all(path <= course.arm.upper)


def test_equal_seeds_give_equal_paths(course: Course) -> None:
    one = course.plan(7)
    np.random.seed(0)
    two = course.plan(7)
    assert one is not None and two is not None
    np.testing.assert_array_equal(one, two)


def test_carried_object_keeps_clear_too(course: Course) -> None:
    carried = Attached("ball", Pose(np.zeros(3), np.eye(3)))
    path = course.plan(1, carried)
    assert path is not None
    assert course.is_free(path, carried)


def test_free_way_is_the_straight_one() -> None:
    course = Course(0.02)
    path = course.plan(0)
    assert path is not None and len(path) == 2


def test_goal_inside_something_has_no_way() -> None:
    course = Course(0.30)
    inside = course.arm.reach(Pose(np.array([0.4, 0.0, 0.22]), DOWN), course.arm.home).joints
    rng = np.random.default_rng(0)
    assert plan_transit(course.arm, course.checker, course.start, inside, None, rng) is None


def test_edge_check_sees_a_short_obstacle() -> None:
    start, end = np.zeros(2), np.array([1.0, 0.3])
    asked = []

    def free(joints: np.ndarray) -> bool:
        asked.append(float(joints[0]))
        return not 0.44 < joints[0] < 0.53

    assert not edge_free(start, end, free)
    asked.clear()
    assert edge_free(start, end, lambda q: bool(asked.append(float(q[0])) or True))
    assert max(asked) == 1.0
    assert np.diff(sorted(asked)).max() <= 0.08 + 1e-9


class Beside(Course):
    """A place a few millimetres beside the wall, to go from, over it, to the other side."""

    def __init__(self, gap: float) -> None:
        super().__init__(0.30)
        for y in np.linspace(-0.12, -0.02, 401):
            start = self.arm.reach(Pose(np.array([0.4, y, 0.22]), DOWN), self.start).joints
            if self.checker.hits(start, clearance=gap):
                break
            self.start = start

    def distances(self, path: np.ndarray) -> list[tuple[float, bool]]:
        """How far each point of a path is from the start [rad], and whether it is near the wall."""
        found = []
        for a, b in pairwise(path):
            count = int(np.ceil(np.abs(b - a).max() / 0.01))
            for share in np.linspace(0.0, 1.0, count + 1):
                joints = a + share * (b - a)
                near = bool(self.checker.hits(joints, clearance=0.4 * CLEARANCES[1]))
                found.append((float(np.abs(joints - self.start).max()), near))
        return found


@pytest.mark.parametrize("gap", [0.001, 0.003])
@pytest.mark.parametrize("seed", range(4))
def test_what_the_hand_is_close_to_is_left_and_not_grazed(gap: float, seed: int) -> None:
    """It is as close to it there, and nowhere else, and never runs into it."""
    course = Beside(gap)
    assert course.checker.hits(course.start, clearance=0.5 * CLEARANCES[1]), "it is close"
    path = course.plan(seed)
    assert path is not None
    assert not any(near for away, near in course.distances(path) if away > BESIDE)
    for a, b in pairwise(path):
        for share in np.linspace(0.0, 1.0, int(np.ceil(np.abs(b - a).max() / 0.01)) + 1):
            assert not course.checker.hits(a + share * (b - a), clearance=0.0)

"""Who is blamed, from what single candidates met."""

from __future__ import annotations

from functools import partial

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from etot_cli.skills.hindrance import Hindrances, Passage
from etot_cli.skills.motion.collision import HandPart
from etot_cli.skills.motion.ready import WAITING_CLEARANCE, ready_pose
from etot_cli.world.pose import Pose, rotation_from_axes
from tests.skills.helpers import BALL, BOX, CUP, UNIT, drawers, episode
from tests.world.helpers import make_scene, set_up

UNIT_CLOSED = UNIT | {"drawers": drawers()}
WORLD = set_up(
    make_scene(ball=BALL, box=BOX, cup=CUP, unit=UNIT_CLOSED | {"at": [0.55, 0.4]})
).world
sets = st.lists(st.frozensets(st.sampled_from(["ball", "box", "cup", "unit"]), min_size=1))


def blamed(*met: frozenset[str]) -> tuple[str, ...]:
    found = Hindrances(WORLD)
    for others in met:
        found.note(others)
    return found.blamed()


@given(sets)
def test_without_the_blamed_something_works(met: list[frozenset[str]]) -> None:
    names = frozenset(blamed(*met))
    assert bool(names) == bool(met)
    assert not met or any(others <= names for others in met)


def test_single_ones_that_suffice_come_by_their_gain() -> None:
    ball, box, both = frozenset({"ball"}), frozenset({"box"}), frozenset({"ball", "cup"})
    assert blamed(box, ball, ball, both) == ("ball", "box")


def test_what_can_be_moved_is_blamed_before_what_is_fastened() -> None:
    assert blamed(frozenset({"unit"}), frozenset({"ball", "cup"})) == ("ball", "cup")


def test_passage_goes_on_past_others_but_not_past_what_it_works_on() -> None:
    passage = Passage(WORLD.entries, {"unit"})
    assert passage.admits(["ball"]) and not passage.free
    assert not passage.admits(["unit.top"])
    assert not passage.admits(["robot"])
    assert not Passage(WORLD.entries).admits(["desk"])


def test_hand_alone_meets_what_the_arm_with_it_meets() -> None:
    run = episode(ball=BALL, box=BOX, unit=UNIT_CLOSED | {"at": [0.5, 0.3]})
    belief = run.simulated.believe(run.snapshot)
    checker, arm = belief.checker, belief.arm
    checker.freeze(belief.data)
    rng = np.random.default_rng(0)
    seen = 0
    for _ in range(300):
        place = rng.uniform([0.25, -0.3, 0.14], [0.6, 0.4, 0.35])
        axis = np.array([*rng.uniform(-0.7, 0.7, 2), -1.0])
        pose = Pose(place, rotation_from_axes(axis, rng.normal(size=3)))
        result = arm.reach(pose, arm.home)
        if not result.reached:
            continue
        tool = arm.forward(result.joints)
        hits = partial(checker.hits, result.joints, clearance=0.001)
        whole, of_arm = set(hits()), set(hits(allow=["ball", "box", "unit", "desk"]))
        hand_hits = partial(checker.hand_hits, tool, clearance=0.001, part=HandPart.ALL)
        assert whole - of_arm <= set(hand_hits()) <= whole
        with checker.without(["box"]):
            assert whole - of_arm - {"box"} <= set(hand_hits()) <= whole - {"box"}
        seen += bool(whole - of_arm)
    assert seen > 20


def test_arm_does_not_wait_astride_of_anything() -> None:
    run = episode(wall=dict(BOX, at=[0.268, 0.0], size=[0.30, 0.02, 0.22]))
    belief = run.simulated.believe(run.snapshot)
    belief.checker.freeze(belief.data)
    for opening in (0.0, belief.opening):
        belief.checker.set_fingers(opening)
        assert not belief.checker.hits(belief.joints)


def test_arm_waits_above_what_stands_at_its_home() -> None:
    tall = UNIT_CLOSED | {"at": [0.34, 0.09], "yaw_deg": -97, "size": [0.24, 0.2, 0.2]}
    for things, free in (({"unit": tall}, False), ({"ball": BALL}, True)):
        run = episode(**things)
        belief = run.simulated.believe(run.snapshot)
        belief.checker.freeze(belief.data)
        assert bool(belief.checker.hits(belief.arm.home)) is not free
        waiting = ready_pose(belief.world, belief.data, belief.arm)
        assert not belief.checker.hits(waiting, clearance=WAITING_CLEARANCE)
        np.testing.assert_allclose(belief.joints, waiting, atol=0.01)
        assert np.array_equal(waiting, belief.arm.home) is free

"""Letting go inside a vessel: the hand must have room to open where it lets go."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.skills.action import Action, Verb
from etot_cli.skills.placements.placement import RELEASES, Placement
from etot_cli.skills.placements.put import put_places
from tests.skills.helpers import Episode, episode
from tests.world.helpers import make_scene

WALL = 0.003


def vessel_for(size: float, clearance: float, height: float) -> dict[str, object]:
    """A cup whose inside is this much wider than a thing."""
    return {"kind": "cup", "diameter": round(size + clearance + 2 * WALL, 4), "wall": WALL,
            "height": height, "mass": 0.25, "at": [0.42, -0.18]}  # fmt: skip


def thing_of(kind: str, size: float) -> dict[str, object]:
    if kind == "sphere":
        return {"kind": kind, "diameter": size, "mass": 0.05, "at": [0.36, 0.15]}
    shape = {"diameter": size, "height": 0.05}
    return {"kind": kind, **shape, "mass": 0.05, "at": [0.36, 0.15]}


@pytest.mark.slow
@settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    kind=st.sampled_from(["sphere", "cylinder"]),
    size=st.integers(30, 70),
    clearance=st.integers(10, 60),
    height=st.integers(45, 100),
)
def test_the_hand_opens_free_of_the_vessel(
    kind: str, size: int, clearance: int, height: int
) -> None:
    """At every clearance there is a placement, and the opened hand touches nothing at its end."""
    cup = vessel_for(size / 1000, clearance / 1000, height / 1000)
    world = SimulatedWorld(
        make_scene(cup=cup, thing=thing_of(kind, size / 1000)), keep_frames=False
    )
    snapshot, _ = world.start()
    picked = world.perform(snapshot, Action(Verb.PICK_UP, "thing"))
    assert picked.record.effect
    belief = world.believe(picked.end)
    first = next(put_places(belief, Action(Verb.PUT_INTO, "cup"), "thing"))
    assert isinstance(first, Placement), first
    assert first.release in RELEASES
    checker = belief.checker
    checker.freeze(belief.data)
    largest = belief.world.robot.spec.gripper.opening
    checker.set_fingers(min(belief.opening + first.release, largest))
    for row in (first.down[-1], *first.back):
        assert not checker.hits(row, clearance=0.0, allow={"thing"})


def put_into_cup(clearance: float, kind: str) -> Episode:
    run = episode(cup=vessel_for(0.05, clearance, 0.07), thing=thing_of(kind, 0.05))
    run.must("[PICK UP, thing]", "[PUT INTO, cup]")
    return run


@pytest.mark.parametrize("clearance", [0.012, 0.022, 0.025, 0.026, 0.027, 0.032, 0.045])
@pytest.mark.parametrize("kind", ["sphere", "cylinder"])
@pytest.mark.slow
def test_what_is_let_go_stays_in_the_vessel(clearance: float, kind: str) -> None:
    after = put_into_cup(clearance, kind).state
    assert after.states["thing"].inside == "cup"
    assert not after.states["cup"].toppled and after.holding is None

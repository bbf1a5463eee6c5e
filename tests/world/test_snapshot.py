"""A stored state continues bit by bit as if nothing had happened."""

from __future__ import annotations

import pickle

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from etot_cli.errors import WorldError
from etot_cli.world.snapshot import Memory, Snapshot, restore, save
from tests.world.helpers import BALL, CUP, PEN, UNIT, Stage, make_scene, set_up

CRATES = {
    "cup": CUP | {"at": [0.40, 0.20]},
    "pen": PEN | {"inside": "cup"},
    "ball": BALL | {"at": [0.40, -0.10]},
    "unit": UNIT | {"at": [0.45, -0.35], "yaw_deg": 90},
}


@pytest.fixture(scope="module")
def stage() -> Stage:
    return set_up(make_scene(**CRATES))


def drive(stage: Stage, controls: np.ndarray, blocks: range) -> None:
    """Ten steps for each row of controls, and a push at the ball so that contacts change."""
    for block in blocks:
        stage.data.ctrl[:] = controls[block]
        stage.data.body("ball").xfrc_applied[:3] = 0.2 * np.sin(controls[block, :3])
        mujoco.mj_step(stage.world.model, stage.data, 10)
    stage.data.xfrc_applied[:] = 0.0


@given(seed=st.integers(0, 2**32 - 1), cut=st.integers(0, 11), pickled=st.booleans())
@settings(max_examples=12, deadline=None)
@pytest.mark.slow
def test_restored_state_continues_byte_for_byte(
    stage: Stage, seed: int, cut: int, pickled: bool
) -> None:
    rng = np.random.default_rng(seed)
    model, data = stage.world.model, stage.data
    low, high = model.actuator_ctrlrange.T
    controls = rng.uniform(low, high, (12, model.nu)) * 0.3
    begin = save(stage.world, data, stage.memory)
    drive(stage, controls, range(cut))
    middle = save(stage.world, data, stage.memory)
    drive(stage, controls, range(cut, 12))
    straight = save(stage.world, data, stage.memory)

    mujoco.mj_resetData(model, data)
    mujoco.mj_step(model, data, 7)
    again = pickle.loads(pickle.dumps(middle)) if pickled else middle
    restore(stage.world, data, again)
    drive(stage, controls, range(cut, 12))
    resumed = save(stage.world, data, stage.memory)
    restore(stage.world, data, begin)

    assert straight.physics != begin.physics, "the controls did nothing, so nothing was tested"
    assert resumed.physics == straight.physics


def test_restoring_into_fresh_data_continues_alike(stage: Stage) -> None:
    begin = save(stage.world, stage.data, stage.memory)
    stage.step(0.1)
    straight = save(stage.world, stage.data, stage.memory)
    fresh = mujoco.MjData(stage.world.model)
    restore(stage.world, fresh, begin)
    mujoco.mj_step(stage.world.model, fresh, 50)
    restore(stage.world, stage.data, begin)
    assert save(stage.world, fresh, stage.memory).physics == straight.physics


def test_restore_brings_derived_quantities_up_to_date(stage: Stage) -> None:
    begin = save(stage.world, stage.data, stage.memory)
    place, contacts = stage.data.body("ball").xpos.copy(), stage.data.ncon
    stage.move("ball", [0.2, 0.5, 0.6])
    mujoco.mj_forward(stage.world.model, stage.data)
    restore(stage.world, stage.data, begin)
    np.testing.assert_array_equal(stage.data.body("ball").xpos, place)
    assert stage.data.ncon == contacts


def test_saving_a_restored_state_gives_the_same_bytes(stage: Stage) -> None:
    memory = Memory(up={"cup": (0.0, 0.0, 1.0)}, toppled=frozenset({"cup"}), inside={"pen": "cup"})
    begin = save(stage.world, stage.data, memory)
    restore(stage.world, stage.data, begin)
    assert save(stage.world, stage.data, begin.memory) == begin


def test_state_of_another_world_is_refused(stage: Stage) -> None:
    other = set_up(make_scene(ball=BALL | {"at": [0.4, 0.0]}), settle=0.0)
    foreign = save(other.world, other.data, other.memory)
    assert isinstance(foreign, Snapshot)
    with pytest.raises(WorldError, match="does not belong to this world"):
        restore(stage.world, stage.data, foreign)

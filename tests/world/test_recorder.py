"""What an action's record says about contacts, ways and frames."""

from __future__ import annotations

import numpy as np
import pytest

from etot_cli.world.recorder import FRAME_PERIOD, MOVED, Recorder
from tests.world.helpers import BALL, BOX, CUP, Stage, make_scene, set_up

PERIOD = 0.02


def run(stage: Stage, recorder: Recorder, seconds: float) -> None:
    for _ in range(round(seconds / PERIOD)):
        stage.step(PERIOD)
        recorder.observe(stage.data)


def pairs(recorder: Recorder) -> set[frozenset[str]]:
    return {frozenset((event.first, event.second)) for event in recorder.contacts()}


def test_resting_scene_has_no_events() -> None:
    stage = set_up(make_scene(box=BOX | {"at": [0.4, 0.0]}), settle=1.0)
    recorder = Recorder(stage.world, stage.data)
    run(stage, recorder, 0.5)
    assert recorder.contacts() == ()
    assert recorder.swept() == ()
    assert recorder.displacement()["box"] < 1e-4


def test_a_falling_ball_strikes_the_box_at_the_right_time() -> None:
    stage = set_up(make_scene(box=BOX | {"at": [0.4, 0.0]}, ball=BALL | {"at": [0.4, 0.3]}))
    height = 0.15
    top = stage.top + BOX["size"][2] + BALL["diameter"] / 2
    stage.move("ball", [0.4, 0.0, top + height])
    stage.look()
    recorder = Recorder(stage.world, stage.data)
    run(stage, recorder, 0.3)
    event = next(e for e in recorder.contacts() if {e.first, e.second} == {"box", "ball"})
    assert event.time_s == pytest.approx(np.sqrt(2 * height / 9.81), abs=2 * PERIOD)
    assert event.peak_force > 2 * BALL["mass"] * 9.81
    times = [e.time_s for e in recorder.contacts()]
    assert times == sorted(times)


def test_impulse_of_a_standing_object_is_its_weight_over_time() -> None:
    stage = set_up(make_scene(box=BOX | {"at": [0.4, 0.0], "mass": 0.5}), settle=0.0)
    stage.move("box", [0.4, 0.0, stage.top + 0.045])
    stage.look()
    recorder = Recorder(stage.world, stage.data)
    run(stage, recorder, 2.0)
    event = next(e for e in recorder.contacts() if {e.first, e.second} == {"box", "desk"})
    assert event.impulse == pytest.approx(0.5 * 9.81 * 2.0, rel=0.05)


def test_old_contact_counts_once_it_is_pressed() -> None:
    stage = set_up(make_scene(box=BOX | {"at": [0.4, 0.0]}), settle=0.5)
    recorder = Recorder(stage.world, stage.data)
    stage.data.body("box").xfrc_applied[2] = -5.0
    run(stage, recorder, 0.2)
    event = recorder.contacts()[0]
    assert {event.first, event.second} == {"box", "desk"}
    assert event.peak_force == pytest.approx(5.0 + BOX["mass"] * 9.81, rel=0.25)


def test_contacts_within_an_object_do_not_count() -> None:
    stage = set_up(
        make_scene(
            cup=CUP | {"at": [0.4, 0.1]},
            oven={"kind": "cabinet", "size": [0.2, 0.3, 0.25], "at": [0.45, -0.3]},
        )
    )
    recorder = Recorder(stage.world, stage.data)
    stage.data.joint("oven.door").qfrc_applied[0] = -2.0
    run(stage, recorder, 0.3)
    assert all("oven" not in {a.split(".")[0] for a in pair} for pair in pairs(recorder))


def test_displacement_is_the_farthest_not_the_last() -> None:
    stage = set_up(make_scene(box=BOX | {"at": [0.4, 0.0]}, other=BOX | {"at": [0.4, 0.3]}))
    recorder = Recorder(stage.world, stage.data)
    home = stage.data.body("box").xpos.copy()
    for y in (0.05, 0.12, 0.03, 0.0):
        stage.move("box", home + np.array([0.0, y, 0.0]))
        stage.look()
        recorder.observe(stage.data)
    assert recorder.displacement()["box"] == pytest.approx(0.12, abs=1e-4)
    assert recorder.displacement()["other"] < MOVED


def test_swept_discs_cover_the_way_of_what_moved_and_no_more() -> None:
    stage = set_up(make_scene(box=BOX | {"at": [0.4, 0.0]}, other=BOX | {"at": [0.4, 0.3]}))
    recorder = Recorder(stage.world, stage.data)
    home = stage.data.body("box").xpos.copy()
    way = [home + s * np.array([0.1, 0.06, 0.0]) for s in np.linspace(0.0, 1.0, 13)]
    for point in way:
        stage.move("box", point)
        stage.look()
        recorder.observe(stage.data)
    discs = recorder.swept()
    assert {disc.name for disc in discs} == {"box"}
    for point in way:
        nearest = min(np.hypot(point[0] - d.x, point[1] - d.y) - d.radius for d in discs)
        assert nearest < 0.0
    for disc in discs:
        assert min(np.hypot(p[0] - disc.x, p[1] - disc.y) for p in way) < 0.06
        assert BOX["size"][1] / 2 - 1e-6 <= disc.radius < 0.15
    assert recorder.swept(held="box") == ()


def test_frames_come_at_their_period_and_start_with_the_start() -> None:
    stage = set_up(make_scene(ball=BALL | {"at": [0.4, 0.0]}))
    before = stage.data.qpos.copy()
    recorder = Recorder(stage.world, stage.data)
    run(stage, recorder, 0.4)
    trajectory = recorder.trajectory([0.4])
    assert trajectory is not None
    assert np.diff(trajectory.times) == pytest.approx(FRAME_PERIOD, abs=1e-4)
    assert trajectory.qpos.shape == (11, stage.world.model.nq)
    np.testing.assert_array_equal(trajectory.qpos[0], before.astype(np.float32))
    assert trajectory.key_times == pytest.approx((0.4,))
    assert Recorder(stage.world, stage.data, keep_frames=False).trajectory() is None

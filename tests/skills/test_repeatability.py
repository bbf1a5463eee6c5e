"""Same inputs, same bytes; and nothing happens but by contact."""

from __future__ import annotations

import pickle
from contextlib import closing

import numpy as np
import pytest

from etot_cli.control.robot import Guards
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.control.simulator import known_targets, open_simulator
from etot_cli.skills.action import parse_plan
from etot_cli.specs.scene import Scene
from etot_cli.world.recorder import FRAME_PERIOD, Trajectory
from etot_cli.world.relations import touched_by_robot
from etot_cli.world.snapshot import Snapshot
from tests.skills.helpers import BALL, CUP, PEN, UNIT, drawers, episode, robot_at
from tests.world.helpers import make_scene

pytestmark = pytest.mark.slow

PLAN = parse_plan(
    "[PICK UP, ball] [PUT ON, desk] [OPEN, unit] [PICK UP, pen] [PUT INTO, cup] [CLOSE, unit]"
)
FASTEST = 1.5
"""Neither the arm (1.6 rad/s at 0.6 m) nor a fall of a hand's breadth is faster [m/s]."""


@pytest.fixture(scope="module")
def scene() -> Scene:
    return make_scene(
        ball=BALL | {"at": [0.32, 0.22], "diameter": 0.06},
        cup=CUP | {"at": [0.36, 0.38], "diameter": 0.12},
        unit=UNIT | {"at": [0.45, 0.02], "yaw_deg": -90, "drawers": drawers(open=0.03)},
        pen=PEN | {"at": [0.30, -0.30]},
    )


def walk(simulated: SimulatedWorld) -> list[Snapshot]:
    snapshot, _ = simulated.start()
    ends = [snapshot]
    for action in PLAN:
        ends.append(simulated.perform(ends[-1], action).end)
    return ends


@pytest.fixture(scope="module")
def ends(scene: Scene) -> list[Snapshot]:
    return walk(SimulatedWorld(scene, 3, keep_frames=False))


def test_another_simulated_does_exactly_the_same(scene: Scene, ends: list[Snapshot]) -> None:
    assert [end.physics for end in walk(SimulatedWorld(scene, 3, keep_frames=True))] == [
        end.physics for end in ends
    ]
    assert len({end.physics for end in ends}) == len(ends), "every action changed something"


def test_an_action_depends_on_its_start_alone(scene: Scene, ends: list[Snapshot]) -> None:
    """Actions repeated in another order, from stored states, end in the same bytes."""
    simulated = SimulatedWorld(scene, 3, keep_frames=False)
    for index in (4, 1, 3, 0):
        start = pickle.loads(pickle.dumps(ends[index]))
        assert simulated.perform(start, PLAN[index]).end.physics == ends[index + 1].physics


def test_number_of_jobs_changes_nothing(scene: Scene, ends: list[Snapshot]) -> None:
    """Two jobs at the same time, from two states, in one and in several worlds."""
    found = {}
    for jobs in (1, 2):
        with closing(open_simulator(scene, seed=3, jobs=jobs, worlds=2, record=False)) as simulator:
            assert simulator.world_count == 2
            start, _ = simulator.start()
            first = simulator.submit(start, PLAN[0])
            other = simulator.submit(start, PLAN[2])
            second = simulator.submit(first.result().end, PLAN[1])
            results = [item.result() for item in (first, other, second)]
            found[jobs] = [
                (pickle.loads(item.end), [o.record for o in item.outcomes]) for item in results
            ]
    assert found[1] == found[2], "states to the byte, and all that is on record"
    worlds, _ = found[1][0]
    assert worlds[0].physics == ends[1].physics
    assert worlds[1].physics != worlds[0].physics


def test_a_defect_reaches_whoever_asks_for_the_result(scene: Scene) -> None:
    for jobs in (1, 2):
        with closing(open_simulator(scene, seed=0, jobs=jobs, worlds=1, record=False)) as simulator:
            start, _ = simulator.start()
            broken = pickle.dumps([Snapshot(b"12345678", pickle.loads(start)[0].memory)])
            with pytest.raises(Exception, match="does not belong to this world"):
                simulator.submit(broken, PLAN[0]).result(timeout=60)


def test_known_targets_are_what_actions_may_name(scene: Scene) -> None:
    with closing(open_simulator(scene, seed=0, jobs=1, worlds=1, record=False)) as simulator:
        _, state = simulator.start()
    assert set(known_targets(state)) >= {"desk", "ball", "cup", "unit", "pen", "unit.top"}
    simulator.close()


def test_seed_changes_the_random_choices_only(scene: Scene, ends: list[Snapshot]) -> None:
    """The start has no random choice in it."""
    assert SimulatedWorld(scene, 4, keep_frames=False).start()[0].physics == ends[0].physics


# -- no teleporting --------------------------------------------------------------------------------


def largest_step(simulated: SimulatedWorld, trajectory: Trajectory, name: str) -> float:
    """Largest displacement of an object between two stored frames [m]."""
    address = int(simulated.world.model.joint(name).qposadr[0])
    places = trajectory.qpos[:, address : address + 3]
    return float(np.linalg.norm(np.diff(places, axis=0), axis=1).max())


def test_objects_move_in_small_steps(scene: Scene) -> None:
    simulated = SimulatedWorld(scene, 3, keep_frames=True)
    snapshot, _ = simulated.start()
    moved = set()
    for action in PLAN:
        performed = simulated.perform(snapshot, action)
        trajectory = performed.trajectory
        assert trajectory is not None
        assert np.diff(trajectory.times).max() < 1.5 * FRAME_PERIOD
        for name, entry in simulated.world.entries.items():
            if not entry.free:
                continue
            step = largest_step(simulated, trajectory, name)
            assert step < FASTEST * 1.5 * FRAME_PERIOD, (str(action), name)
            if step > 0.005:
                moved.add(name)
        snapshot = performed.end
    assert moved == {"ball", "pen"}, "only what was carried moved far"


def test_frames_lead_from_start_to_end(scene: Scene) -> None:
    simulated = SimulatedWorld(scene, 3, keep_frames=True)
    snapshot, _ = simulated.start()
    performed = simulated.perform(snapshot, PLAN[0])
    assert performed.trajectory is not None
    qpos = performed.trajectory.qpos
    states = simulated.world.model.nq
    first = np.frombuffer(snapshot.physics)[1 : 1 + states]
    last = np.frombuffer(performed.end.physics)[1 : 1 + states]
    assert qpos[0] == pytest.approx(first, abs=1e-5)
    assert qpos[-1] == pytest.approx(last, abs=0.05)


def test_arm_stays_within_its_limits_and_speed(scene: Scene) -> None:
    simulated = SimulatedWorld(scene, 3, keep_frames=True)
    robot = simulated.world.robot
    snapshot, _ = simulated.start()
    for action in PLAN:
        performed = simulated.perform(snapshot, action)
        assert performed.trajectory is not None
        joints = performed.trajectory.qpos[:, robot.qpos]
        assert np.all(joints >= robot.lower - 0.02) and np.all(joints <= robot.upper + 0.02)
        times = np.diff(performed.trajectory.times)[:, None]
        assert np.abs(np.diff(joints, axis=0) / times).max() < 3.14
        snapshot = performed.end


def test_held_object_falls_when_the_fingers_let_go() -> None:
    """Nothing but the fingers holds it: opened by hand, without a skill, they drop it."""
    run = episode(ball=BALL)
    run.must("[PICK UP, ball]")
    simulated = run.simulated
    robot = robot_at(simulated, run.snapshot)
    height = float(simulated.data.body("ball").xpos[2])
    robot.wait(0.5, Guards())
    assert simulated.data.body("ball").xpos[2] == pytest.approx(height, abs=0.003)
    robot.set_opening(simulated.world.robot.spec.gripper.opening)
    robot.wait(0.5, Guards())
    assert simulated.data.body("ball").xpos[2] < height - 0.05
    assert not touched_by_robot(simulated.world, simulated.data)


def test_record_counts_its_physics(scene: Scene) -> None:
    simulated = SimulatedWorld(scene, 0, keep_frames=False)
    snapshot, _ = simulated.start()
    record = simulated.perform(snapshot, PLAN[0]).record
    assert record.steps > 500
    assert record.simulated_s == pytest.approx(record.steps * simulated.world.model.opt.timestep)
    names = {event.first for event in record.contacts} | {e.second for e in record.contacts}
    assert {"gripper", "ball"} <= names
    assert record.displacement["ball"] > 0.05
    assert record.displacement["pen"] < 0.001

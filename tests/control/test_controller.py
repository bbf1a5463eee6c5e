"""One motion, run by the same code on three robots: simulated, logging, and one that slips."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, field
from pathlib import Path

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray

from etot_cli.control.controller import replay, run_motion
from etot_cli.control.robot import Contacts, Guards, RobotState
from etot_cli.control.simulated_robot import SimulatedRobot
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.reporting.motion_report import trajectory_model
from etot_cli.reporting.recordings import recorded_plan
from etot_cli.skills.action import parse_plan
from etot_cli.skills.motion.motion import Hand, Motion, Move, PhaseEnd, Trace
from etot_cli.skills.motion.timing import CONTROL_PERIOD, JointLimits, time_path
from etot_cli.skills.motions import plan_motions
from etot_cli.specs.scene import Actuation
from etot_cli.world.relations import touched_by_robot
from etot_cli.world.snapshot import Snapshot, restore
from tests.skills.helpers import BALL, BOX, UNIT, drawers, episode, robot_at
from tests.world.helpers import make_scene

LIMITS = JointLimits(1.0, 20.0, 500.0)


@dataclass
class ScriptedRobot:
    """Does as it is told, except where a phase is scripted to end otherwise; keeps a log."""

    script: dict[int, PhaseEnd] = field(default_factory=dict)
    opening: float = 0.085
    joints: NDArray[np.float64] = field(default_factory=lambda: np.zeros(6))
    held_width: float = 0.0
    time_s: float = 0.0
    calls: int = 0
    log: list[str] = field(default_factory=list)

    def state(self) -> RobotState:
        return RobotState(self.joints.copy(), self.joints.copy(), self.opening, self.time_s)

    def follow(self, targets: NDArray[np.float64], guards: Guards) -> PhaseEnd:
        self.log.append(f"follow to {np.round(targets[-1], 2).tolist()}")
        end = self.script.get(self.calls, PhaseEnd.DONE)
        share = 1.0 if end is PhaseEnd.DONE else 0.5
        self.calls += 1
        self.joints = targets[int(share * (len(targets) - 1))].copy()
        self.time_s += share * len(targets) * CONTROL_PERIOD
        return end

    def set_opening(self, opening: float) -> None:
        self.log.append(f"open to {opening:.3f}")
        self.opening = max(opening, self.held_width)

    def wait(self, seconds: float, guards: Guards, *, until_rest: bool = False) -> PhaseEnd:
        self.time_s += seconds
        slipped = guards.holding is not None and self.opening < guards.holding
        return PhaseEnd.SLIPPED if slipped else PhaseEnd.DONE

    def contacts(self) -> Contacts:
        return Contacts()


@pytest.fixture(scope="module")
def world() -> SimulatedWorld:
    scene = make_scene(
        ball=BALL | {"at": [0.32, 0.22]},
        unit=UNIT | {"at": [0.45, 0.02], "yaw_deg": -90, "drawers": drawers(open=0.03)},
    )
    return SimulatedWorld(scene, 0, keep_frames=False)


@pytest.fixture(scope="module")
def start(world: SimulatedWorld) -> Snapshot:
    return world.start()[0]


@pytest.fixture(scope="module")
def grasp(world: SimulatedWorld, start: Snapshot) -> Motion:
    return motion_of(world, start, "[PICK UP, ball]")


def motion_of(world: SimulatedWorld, start: Snapshot, text: str) -> Motion:
    (action,) = parse_plan(text)
    belief = world.believe(start)
    motion = next(plan_motions(belief, action))
    assert isinstance(motion, Motion), motion
    return motion


def scripted(grasp: Motion, **script: object) -> ScriptedRobot:
    first = grasp.phases[0]
    assert isinstance(first, Move)
    return ScriptedRobot(joints=np.zeros(first.path.shape[1]), **script)  # type: ignore[arg-type]


def names(trace: Trace) -> list[str]:
    return [phase.name for phase in trace.phases]


def ended(trace: Trace, name: str) -> PhaseEnd | None:
    phase = trace.phase(name)
    return None if phase is None else phase.end


def test_the_simulated_robot_lifts_the_ball(
    world: SimulatedWorld, start: Snapshot, grasp: Motion
) -> None:
    restore(world.world, world.data, start)
    trace = run_motion(grasp, SimulatedRobot(world.world, world.data), LIMITS)
    assert names(trace) == ["transit", "approach", "grip", "lift", "hold"]
    assert trace.stopped is None
    assert touched_by_robot(world.world, world.data) == ["ball"]
    assert trace.phases[-1].opening == pytest.approx(BALL["diameter"], abs=0.006)


def test_a_logging_robot_is_told_the_same(grasp: Motion) -> None:
    robot = scripted(grasp, held_width=BALL["diameter"])
    trace = run_motion(grasp, robot, LIMITS)
    assert names(trace) == ["transit", "approach", "grip", "lift", "hold"]
    assert trace.stopped is None
    assert [line.split(" to ")[0] for line in robot.log] == [
        "open", "follow", "follow", "open", "follow"
    ]  # fmt: skip
    ends = [phase.path[-1] for phase in grasp.phases if isinstance(phase, Move)]
    sent = [item.targets[-1] for item in trace.phases if item.targets is not None]
    np.testing.assert_allclose(sent, ends, atol=1e-9)


def test_fingers_that_meet_nothing_end_the_motion(grasp: Motion) -> None:
    robot = scripted(grasp, held_width=0.0)
    trace = run_motion(grasp, robot, LIMITS)
    assert names(trace) == ["transit", "approach", "grip", "settle"]
    assert trace.seconds == trace.phases[2].end_s
    assert ended(trace, "grip") is PhaseEnd.MISSED


def test_a_slip_ends_the_motion(grasp: Motion) -> None:
    robot = scripted(grasp, held_width=BALL["diameter"], script={2: PhaseEnd.SLIPPED})
    trace = run_motion(grasp, robot, LIMITS)
    assert names(trace) == ["transit", "approach", "grip", "lift", "settle"]
    assert trace.stopped is not None and trace.stopped.end is PhaseEnd.SLIPPED


def test_a_drawer_that_stops_is_let_go_and_left_the_way_out_from_there(
    world: SimulatedWorld, start: Snapshot
) -> None:
    motion = motion_of(world, start, "[OPEN, unit]")
    along = next(p for p in motion.phases if isinstance(p, Move) and p.name == "along")
    assert len(along.exits) == len(along.path)
    index = [p for p in motion.phases if isinstance(p, Move)].index(along)
    robot = scripted(motion, script={index: PhaseEnd.BLOCKED})
    trace = run_motion(motion, robot, LIMITS)
    assert ended(trace, "along") is PhaseEnd.BLOCKED
    assert ended(trace, "retreat") is PhaseEnd.DONE
    halted = np.array(next(p for p in trace.phases if p.name == "along").joints)
    nearest = int(np.abs(along.path - halted).max(axis=1).argmin())
    assert 0 < nearest < len(along.path) - 1
    np.testing.assert_allclose(robot.joints, along.exits[nearest][-1], atol=1e-9)
    if any(isinstance(phase, Hand) for phase in motion.phases):
        assert ended(trace, "release") is PhaseEnd.DONE


@pytest.mark.parametrize("delay_s", [0.0, 0.006, 0.01, 0.034])
def test_commands_take_effect_late(world: SimulatedWorld, start: Snapshot, delay_s: float) -> None:
    late = world.world.scene.model_copy(update={"actuation": Actuation(delay_s=delay_s)})
    delayed = SimulatedWorld(late, 0, keep_frames=False)
    restore(delayed.world, delayed.data, start)
    robot = SimulatedRobot(delayed.world, delayed.data)
    arm, before = delayed.world.robot.ctrl, delayed.data.ctrl.copy()
    wanted = before[arm] + 0.001
    robot.follow(wanted[None], Guards())
    periods = 1
    while np.array_equal(delayed.data.ctrl[arm], before[arm]) and periods < 10:
        robot.wait(CONTROL_PERIOD, Guards())
        periods += 1
    assert periods == int(delay_s / CONTROL_PERIOD + 1e-9) + 1
    np.testing.assert_array_equal(robot.state().targets, wanted)
    robot.rest()
    np.testing.assert_array_equal(delayed.data.ctrl[arm], wanted)


def test_planning_steps_nothing(world: SimulatedWorld, start: Snapshot) -> None:
    restore(world.world, world.data, start)
    before = world.data.time, world.data.qpos.tobytes()
    motion_of(world, start, "[PICK UP, ball]")
    restore(world.world, world.data, start)
    assert (world.data.time, world.data.qpos.tobytes()) == before


def test_a_replay_goes_on_whatever_happens_and_tells_what_it_saw(grasp: Motion) -> None:
    recorded = run_motion(grasp, scripted(grasp, held_width=BALL["diameter"]), LIMITS)
    for width, ends in (
        (BALL["diameter"], {PhaseEnd.DONE}),
        (0.0, {PhaseEnd.DONE, PhaseEnd.MISSED, PhaseEnd.SLIPPED}),
    ):
        robot = scripted(grasp, held_width=width)
        again = replay(recorded, robot)
        assert names(again) == names(recorded)
        assert {phase.end for phase in again.phases} == ends
        sent = [phase.targets[-1] for phase in recorded.phases if phase.targets is not None]
        np.testing.assert_array_equal(robot.joints, sent[-1])
    assert ended(again, "grip") is PhaseEnd.MISSED
    assert ended(again, "lift") is PhaseEnd.SLIPPED


def test_a_replay_ends_in_the_same_bytes(world: SimulatedWorld, start: Snapshot) -> None:
    ends = []
    restore(world.world, world.data, start)
    motion = motion_of(world, start, "[OPEN, unit]")
    restore(world.world, world.data, start)
    trace = run_motion(motion, SimulatedRobot(world.world, world.data), LIMITS)
    ends.append(world.data.qpos.tobytes())
    restore(world.world, world.data, start)
    again = replay(trace, SimulatedRobot(world.world, world.data))
    ends.append(world.data.qpos.tobytes())
    assert ends[0] == ends[1]
    assert [phase.end_s for phase in again.phases] == [phase.end_s for phase in trace.phases]


def test_one_recorded_file_on_three_robots(
    world: SimulatedWorld, start: Snapshot, grasp: Motion, tmp_path: Path
) -> None:
    """Written, read back and sent: to the simulated robot, to one that logs, to one that slips."""
    restore(world.world, world.data, start)
    recorded = run_motion(grasp, SimulatedRobot(world.world, world.data), LIMITS)
    end = world.data.qpos.tobytes()
    spec = world.world.robot.spec
    model = trajectory_model(grasp.action, spec.name, list(spec.joints), "0" * 64, recorded)
    text = model.model_dump_json()
    (tmp_path / "001.json").write_text(text)
    entry = {
        "action": grasp.action, "file": "001.json", "details": dict(grasp.details),
        "sha256": hashlib.sha256(text.encode()).hexdigest(),
    }  # fmt: skip
    report = {"schema": "etot.plan/1", "plan": [grasp.action], "motions": [entry]}
    (tmp_path / "report.json").write_text(json.dumps(report))
    (recording,) = recorded_plan(tmp_path / "report.json").recordings

    restore(world.world, world.data, start)
    again = replay(recording.trace, SimulatedRobot(world.world, world.data))
    assert world.data.qpos.tobytes() == end and again.stopped is None

    logging = scripted(grasp, held_width=BALL["diameter"])
    traced = replay(recording.trace, logging)
    assert [line.split(" to ")[0] for line in logging.log] == [
        "open", "follow", "follow", "open", "follow"
    ]  # fmt: skip
    assert names(traced) == names(recorded) and traced.stopped is None

    slips = scripted(grasp, held_width=BALL["diameter"], script={2: PhaseEnd.SLIPPED})
    slipped = replay(recording.trace, slips)
    assert slipped.stopped is not None and slipped.stopped.name == "lift"
    assert ended(slipped, "lift") is PhaseEnd.SLIPPED and names(slipped) == names(recorded)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("turn", [1.4, -1.4])
def test_what_is_carried_stays_where_it_is_in_the_hand(turn: float, seed: int) -> None:
    """Servos that were led in jumps let it creep by 1.3 mm on this way."""
    run = episode(seed, box=BOX | {"at": [0.38, 0.0]})
    run.must("[PICK UP, box]")
    robot, world, data = (
        robot_at(run.simulated, run.snapshot),
        run.simulated.world,
        run.simulated.data,
    )
    start = robot.state().targets

    def in_hand() -> NDArray[np.float64]:
        mujoco.mj_forward(world.model, data)
        site = world.robot.tool_site
        offset = data.body("box").xpos - data.site_xpos[site]
        return np.asarray(data.site_xmat[site].reshape(3, 3).T @ offset)

    before = in_hand()
    spec = world.robot.spec
    fast = JointLimits(spec.speed, spec.limits.acceleration, spec.limits.jerk)
    path = np.stack([start, start + np.array([turn, *[0.0] * (len(start) - 1)])])
    assert robot.follow(time_path(path, fast), Guards()) is PhaseEnd.DONE
    robot.wait(0.2, Guards())
    assert np.linalg.norm(in_hand() - before) < 3e-4

"""The driver with the maker's real SDK, against the controller that the project ships."""

from __future__ import annotations

import io
import itertools
import os
import time

import numpy as np
import pytest

from etot_cli.control.robot import Guards
from etot_cli.errors import RobotStoppedError, ServiceError
from etot_cli.execution.robots.confirmation import NotConfirmedError, ask, assumed
from etot_cli.execution.robots.fake_controller import STOPPED, FakeController, Faults
from etot_cli.execution.robots.xarm6 import XArm6
from etot_cli.skills.motion.motion import PhaseEnd
from etot_cli.skills.motion.timing import JointLimits, time_path
from etot_cli.world.robot import load_robot

SPEC = load_robot("xarm6")
HOME = np.array(SPEC.home)
# The report ports are fixed, so every test listens at a loopback address of its own.
HOSTS = (
    f"127.{os.getpid() % 250 + 1}.{index // 250}.{index % 250 + 1}" for index in itertools.count()
)


def controller(faults: Faults | None = None) -> FakeController:
    return FakeController(next(HOSTS), faults=faults or Faults(), joints=[*HOME, 0.0])


def arm_at(fake: FakeController, confirm=assumed, spec=SPEC) -> XArm6:
    return XArm6(spec, f"{fake.host}:{fake.port}", confirm)


def path(*, turn: float = 0.25) -> np.ndarray:
    goal = HOME.copy()
    goal[0] += turn
    return time_path(np.array([HOME, goal]), JointLimits(0.7, 10.0, 250.0))


def test_it_connects_moves_grips_and_reads_back():
    asked = []
    with controller() as fake:
        arm = arm_at(fake, asked.append)
        said = arm.connect()
        assert "firmware 1.12.10" in said
        assert not asked and not fake.moved and not fake.enabled
        targets = path()
        assert arm.follow(targets, Guards()) is PhaseEnd.DONE
        assert len(asked) == 1 and fake.targets == len(targets)
        assert arm.state().joints == pytest.approx(targets[-1], abs=0.02)
        fake.hand.thing = 400.0  # 4 cm between the pads
        arm.set_opening(0.0)
        assert arm.wait(0.5, Guards()) is PhaseEnd.DONE
        assert arm.state().opening == pytest.approx(0.04, abs=1e-4)
        fake.hand.thing = 0.0  # what was held is gone
        assert arm.wait(1.0, Guards(holding=0.03)) is PhaseEnd.SLIPPED
        assert len(asked) == 1
        arm.close()
        assert fake.state == STOPPED


def test_nothing_moves_before_the_confirmation():
    def refuse(_):
        raise NotConfirmedError("no")

    with controller() as fake:
        arm = arm_at(fake, refuse)
        arm.connect()
        arm.state()
        arm.wait(0.1, Guards())
        with pytest.raises(NotConfirmedError):
            arm.follow(path(), Guards())
        with pytest.raises(ServiceError):
            arm.set_opening(0.0)  # stopped by now
        arm.close()
        assert not fake.moved and not fake.enabled
        assert fake.joints == pytest.approx([*HOME, 0.0])


@pytest.mark.parametrize(
    ("faults", "error", "words"),
    [
        (Faults(after=10, error=31), RobotStoppedError, "error 31 of the controller"),
        (Faults(after=10, error=23), RobotStoppedError, "error 23 of the controller"),
        (Faults(after=10, reset=True), ServiceError, "connection"),
        (Faults(after=10, silent=True), ServiceError, "not answer"),
        (Faults(after=10, frozen=True), ServiceError, "stale"),
    ],
)
def test_every_fault_on_the_way_stops_the_arm(faults, error, words):
    with controller(faults) as fake:
        arm = arm_at(fake)
        arm.connect()
        with pytest.raises(error, match=words) as found:
            arm.follow(path(), Guards())
        assert found.value.exit_code in (1, 3)
        assert found.value.exit_code == (1 if error is RobotStoppedError else 3)
        if not faults.reset:
            assert fake.state == STOPPED
        told = fake.targets
        with pytest.raises(ServiceError):
            arm.follow(path(), Guards())
        assert fake.targets == told < len(path())
        arm.close()


def test_a_blocked_arm_ends_the_move_and_pushes_no_further():
    with controller(Faults(after=10, blocked=True)) as fake:
        arm = arm_at(fake)
        arm.connect()
        assert arm.follow(path(), Guards()) is PhaseEnd.BLOCKED
        assert arm.state().targets == pytest.approx(fake.joints[:6], abs=1e-3)
        arm.close()


def test_a_gripper_fault_stops_the_arm():
    with controller(Faults(gripper=9)) as fake:
        arm = arm_at(fake)
        arm.connect()
        arm.follow(path(turn=0.02), Guards())
        with pytest.raises(ServiceError, match="gripper"):
            arm.set_opening(0.0)
            arm.wait(0.2, Guards(holding=0.01))
        assert fake.state == STOPPED
        arm.close()


def test_limits_are_checked_before_anything_is_sent():
    with controller() as fake:
        arm = arm_at(fake)
        arm.connect()
        beyond = np.linspace(HOME, HOME + np.array([0, 0, 1.2, 0, 0, 0]), 300)[1:]
        with pytest.raises(RobotStoppedError, match="joint limit: joint3"):
            arm.follow(beyond, Guards())
        arm.connect()
        low = np.linspace(HOME, HOME + np.array([0, 0.9, 0, 0, 0, 0]), 300)[1:]
        with pytest.raises(RobotStoppedError, match="workspace limit"):
            arm.follow(low, Guards())
        arm.connect()
        with pytest.raises(RobotStoppedError, match="jumps"):
            arm.follow(HOME[None] + 1.0, Guards())
        arm.close()
        assert not fake.moved


def test_a_path_that_is_too_fast_is_sent_slower_along_the_same_way():
    with controller() as fake:
        arm = arm_at(fake)
        arm.connect()
        quick = np.linspace(HOME, HOME + np.array([0.16, 0, 0, 0, 0, 0]), 11)[1:]  # 1.6 rad/s
        begun = time.monotonic()
        assert arm.follow(quick, Guards()) is PhaseEnd.DONE
        assert time.monotonic() - begun > 0.16 / SPEC.driver.speed - 0.02
        assert arm.state().joints == pytest.approx(quick[-1], abs=0.02)
        assert fake.targets in (20, 21)
        arm.close()


@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("127.0.0.1:1", "no xArm answers"),
        ("arm.local", "no address"),
        ("1.2.3.4:99999", "no address"),
    ],
)
def test_an_arm_that_is_not_there(address, words):
    with pytest.raises(ServiceError, match=words) as found:
        XArm6(SPEC, address, assumed).connect()
    assert found.value.exit_code == 3


def test_an_arm_in_an_error_is_not_used():
    with controller() as fake:
        fake.error = 2
        with pytest.raises(RobotStoppedError, match="error 2 of the controller"):
            arm_at(fake).connect()


def test_the_sdk_writes_nothing_to_standard_output(capfd):
    with controller() as fake:
        arm = arm_at(fake)
        arm.connect()
        arm.follow(path(turn=0.02), Guards())
        arm.close()
    assert capfd.readouterr().out == ""


@pytest.mark.parametrize("answer", ["", "y\n", "no\n", "YES please\n"])
def test_only_yes_is_yes(answer):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    with pytest.raises(NotConfirmedError):
        ask("It moves.", Terminal(answer), io.StringIO())
    ask("It moves.", Terminal("yes\n"), io.StringIO())


def test_without_a_terminal_nobody_is_asked():
    with pytest.raises(NotConfirmedError, match="--yes") as found:
        ask("It moves.", io.StringIO("yes\n"), io.StringIO())
    assert found.value.exit_code == 2

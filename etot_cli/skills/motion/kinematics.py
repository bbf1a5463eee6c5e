"""Forward and inverse kinematics of the robot's arm.

Frames: base frame; tool frame as the robot's ``tool_site`` (z approach, y closing direction).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from etot_cli.skills.deadline import Deadline
from etot_cli.world.arrays import Vector, consecutive
from etot_cli.world.pose import Pose
from etot_cli.world.robot import RobotSpec

POSITION_TOLERANCE = 8e-4
"""Accepted position error of a solution [m]."""
ANGLE_TOLERANCE = POSITION_TOLERANCE / 0.1
"""Accepted orientation error of a solution [rad]: what is 10 cm from the tool point is off by as
much again."""
MAX_ITERATIONS = 25
"""Of a descent; one that stalls stops earlier."""
MAX_SOLVED = 8192
"""Answers that are kept: whoever looks for what is in the way asks the same again."""
MAX_STEP = 0.6
"""Largest joint change in one iteration [rad]."""
IK_DAMPING = 1e-7
"""Keeps the equations solvable where the arm is stretched, and changes nothing elsewhere."""
TURN_WEIGHT = 0.4
"""What a radian counts, in metres: a descent turns and moves the hand much at once."""
JUMP = 0.35
"""Largest joint change between neighbouring points of a straight line [rad]; more is a change of
the arm's branch in the middle of a path."""
RADIUS_STEP = 0.05
"""Spacing at which the range of the arm is looked at [m]."""
FAR, TELLING_SEEDS = 0.05, 2
"""Where so many descents all end farther than this from their target [m], it is out of reach: of
600 random targets with a solution one was lost by it, and of those without 80 % are told early."""
DISTINCT = 0.3
"""Joint difference from which two solutions count as different [rad]."""
_LIMIT_MARGIN = 0.01
"""Descents begin this far inside the limits [rad], so that the first step can go either way."""


@dataclass(frozen=True)
class IkResult:
    """An inverse-kinematics answer; ``joints`` (n,) [rad] is the best found, reached or not."""

    reached: bool
    joints: Vector
    position_error: float


class Arm:
    """Kinematics of one robot, on a model of the robot alone."""

    def __init__(self, spec: RobotSpec, deadline: Deadline | None = None) -> None:
        self.spec = spec
        self._deadline = deadline or Deadline()
        self._model = mujoco.MjModel.from_xml_path(str(spec.model_path))
        model = self._model
        joints = [model.joint(name) for name in spec.joints]
        self._qpos = consecutive(np.array([int(joint.qposadr[0]) for joint in joints]))
        self._dof = np.array([int(joint.dofadr[0]) for joint in joints])
        self.lower, self.upper = np.array([joint.range for joint in joints], dtype=np.float64).T
        self.home = np.array(spec.home, dtype=np.float64)
        self._comfortable: dict[float, float] = {}
        self._solved: dict[tuple[object, ...], IkResult] = {}
        self._site = model.site(spec.tool_site).id
        self._data = data = mujoco.MjData(model)
        # Asking ``data`` for its arrays takes longer than reading them.
        self._values, self._position = data.qpos, data.site_xpos[self._site]
        self._frame = data.site_xmat[self._site].reshape(3, 3)
        self._damping = IK_DAMPING * np.eye(len(joints))
        self._jacobian = np.zeros((6, model.nv))
        self._weights = {free: _weights(free_spin=free) for free in (False, True)}
        self._inner = self.lower + _LIMIT_MARGIN, self.upper - _LIMIT_MARGIN

    def comfortable_radius(self, height: float) -> float:
        """Distance from the base axis at which the arm works best [m]: the middle of where it
        reaches with its hand pointing down.

        Args:
            height: of the tool point, base frame [m].
        """
        key = round(height, 2)

        def reaches(radius: float) -> bool:
            target = Pose(np.array([radius, 0.0, key]), np.diag([1.0, -1.0, -1.0]))
            return self.reach(target, self.home, tries=2).reached

        if key not in self._comfortable:
            middle = self.spec.reach / 2
            radii = np.arange(RADIUS_STEP, self.spec.reach, RADIUS_STEP).tolist()
            # Only the nearest and the farthest count.
            ends = [next(filter(reaches, order), middle) for order in (radii, radii[::-1])]
            self._comfortable[key] = sum(ends) / 2
        return self._comfortable[key]

    def forward(self, joints: Vector) -> Pose:
        """Tool pose at joint values (n,) [rad]."""
        self._set(joints)
        return Pose(self._position.copy(), self._frame.copy())

    def _set(self, joints: Vector) -> None:
        self._values[self._qpos] = joints
        mujoco.mj_kinematics(self._model, self._data)

    def solve(self, target: Pose, seed: Vector, *, free_spin: bool = False) -> IkResult:
        """One inverse-kinematics descent from ``seed`` (n,).

        Args:
            target: tool pose, base frame.
            seed: start of the descent; the solution stays on its branch.
            free_spin: leave the rotation about the tool's z axis free.

        Raises:
            OutOfTimeError: the deadline has passed.
        """
        self._deadline.check()
        key = (target.position.tobytes(), target.rotation.tobytes(), seed.tobytes(), free_spin)
        if key not in self._solved:
            if len(self._solved) >= MAX_SOLVED:
                self._solved.clear()
            self._solved[key] = self._descend(target, seed, free_spin)
        return self._solved[key]

    def _descend(self, target: Pose, seed: Vector, free_spin: bool) -> IkResult:
        wanted, present, error = target.quaternion, np.empty(4), np.empty(6)
        frame = self._frame.ravel()
        joints = _within(seed, *self._inner)
        best = np.inf
        stalled = 0
        for _ in range(MAX_ITERATIONS):
            self._set(joints)
            np.subtract(target.position, self._position, out=error[:3])
            mujoco.mju_mat2Quat(present, frame)
            mujoco.mju_subQuat(error[3:], wanted, present)
            turn = error[3:5] if free_spin else error[3:]
            position_error = math.sqrt(float(error[:3] @ error[:3]))
            angle_error = math.sqrt(float(turn @ turn))
            if position_error < POSITION_TOLERANCE and angle_error < ANGLE_TOLERANCE:
                return IkResult(True, joints, position_error)
            total = position_error + 0.2 * angle_error
            stalled = stalled + 1 if total > 0.97 * best else 0
            best = min(best, total)
            if stalled >= 3:
                break
            step = self._newton_step(error, self._weights[free_spin])
            largest = max(map(abs, step.tolist()))
            joints = _within(
                joints + step * min(1.0, MAX_STEP / max(largest, 1e-9)), self.lower, self.upper
            )
        return IkResult(False, joints, position_error)

    def _newton_step(self, error: Vector, weights: Vector) -> Vector:
        """One damped Gauss-Newton step of the arm's joints (n,) [rad].

        Args:
            error: of the tool's place in the base frame [m], and the turn to the target in its own
                [rad] (6,).
            weights: of these (6, 1).
        """
        jacobian = self._jacobian
        mujoco.mj_comPos(self._model, self._data)
        mujoco.mj_jacSite(self._model, self._data, jacobian[:3], jacobian[3:], self._site)
        own = jacobian[:, self._dof]
        own[3:] = turn_jacobian(error[3:]) @ (self._frame.T @ own[3:])
        weighted = (own * weights).T
        hessian = weighted @ own + self._damping
        step: Vector = weighted @ error
        mujoco.mju_cholFactor(hessian, 0.0)
        mujoco.mju_cholSolve(step, hessian, step)
        return step

    def reach(self, target: Pose, near: Vector, *, tries: int = 4) -> IkResult:
        """Inverse kinematics from a few fixed seeds, nearest to ``near`` first.

        The seeds are ``near`` and the home pose turned towards the target, so the answer depends
        on nothing but the arguments.
        """
        result = self.solve(target, near)
        if result.reached:
            return result
        for rank, seed in enumerate(self._seeds(target)[: tries - 1], 2):
            other = self.solve(target, seed)
            if other.reached:
                return other
            if other.position_error < result.position_error:
                result = other
            if rank >= TELLING_SEEDS and result.position_error > FAR:
                break
        return result

    def solutions(self, target: Pose, near: Vector, *, free_spin: bool = False) -> Iterator[Vector]:
        """Distinct joint solutions (n,) of a tool pose, the one on the present branch first."""
        found: list[Vector] = []
        nearest = np.inf
        for rank, seed in enumerate((near, *self._seeds(target)), 1):
            result = self.solve(target, seed, free_spin=free_spin)
            nearest = min(nearest, result.position_error)
            if rank >= TELLING_SEEDS and nearest > FAR:
                return
            if result.reached and all(
                float(np.abs(result.joints - other).max()) > DISTINCT for other in found
            ):
                found.append(result.joints)
                yield result.joints

    def _seeds(self, target: Pose) -> list[Vector]:
        azimuth = float(np.arctan2(target.position[1], target.position[0]))
        approach = target.rotation[:, 2]
        seeds = []
        heading = float(np.arctan2(approach[1], approach[0]))
        for first, bend in (
            (azimuth, 0.0), (azimuth, -0.6), (heading, -1.0), (azimuth, 0.6), (heading, 0.3)
        ):  # fmt: skip
            seed = self.home.copy()
            seed[0] = np.clip(first, self.lower[0], self.upper[0])
            seed[-2] += bend
            seeds.append(np.clip(seed, self.lower, self.upper))
        return seeds

    def line(
        self, poses: Sequence[Pose], start: Vector, *, free_spin: bool = False
    ) -> tuple[Vector, int]:
        """Joint values along closely spaced tool poses, on one branch of the arm.

        Args:
            poses: the path, first pose near ``forward(start)``.
            start: joint values (n,) before the first pose.
            free_spin: leave the rotation about the tool's z axis free.

        Returns:
            Joint values (k, n) of the first k poses that can be followed, and k.
        """
        rows: list[Vector] = []
        joints = start
        for pose in poses:
            result = self.solve(pose, joints, free_spin=free_spin)
            if not result.reached or float(np.abs(result.joints - joints).max()) > JUMP:
                break
            joints = result.joints
            rows.append(joints)
        return np.array(rows).reshape(len(rows), len(start)), len(rows)


def _weights(*, free_spin: bool) -> Vector:
    """Squared weights (6, 1) of the errors of place and turn."""
    turn = TURN_WEIGHT**2
    return np.array([[1.0], [1.0], [1.0], [turn], [turn], [0.0 if free_spin else turn]])


def turn_jacobian(turn: Vector) -> Vector:
    """By how much a turn (3,) [rad] to a target becomes less as the frame itself turns, (3, 3):
    the inverse of the left Jacobian of SO(3).

    Chirikjian, "Stochastic Models, Information Theory, and Lie Groups", vol. 2 (2011), chapter 10.
    """
    x, y, z = turn.tolist()
    squared = x * x + y * y + z * z
    angle = math.sqrt(squared)
    # For small turns what the expression tends to: there it is a difference of large numbers.
    share = 1 / 12
    if angle > 1e-3:
        share = 1 / squared - 1 / (2 * angle * math.tan(angle / 2))
    a, b, c = share * x, share * y, share * z
    diagonal = 1.0 - share * squared
    return np.array(
        [
            [diagonal + a * x, a * y + z / 2, a * z - y / 2],
            [b * x - z / 2, diagonal + b * y, b * z + x / 2],
            [c * x + y / 2, c * y - x / 2, diagonal + c * z],
        ]
    )


def _within(joints: Vector, lower: Vector, upper: Vector) -> Vector:
    """``np.clip`` with less around it."""
    return np.minimum(np.maximum(joints, lower), upper)

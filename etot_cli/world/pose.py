"""Rigid transforms, rotations and straight ways in space.

Quaternions are w x y z. A tool frame is as the robot's ``tool_site``: z along the approach, y along
the closing direction.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from etot_cli.world.arrays import Vector

LINE_STEP = 0.035
"""Spacing of poses on a straight line [m]; between them joints are interpolated, which at this
spacing strays from the line by less than 0.5 mm."""
ROTATION_TOLERANCE = 0.02
"""Entries of a rotation times its transpose may be off the identity by this much where somebody
wrote it down: rounding to three digits leaves less."""
UP = np.array([0.0, 0.0, 1.0])
"""Away from the floor, base frame."""
LEVEL = 0.5
"""What rises or falls by less than this (sine, 30°) is level, be it a rod, a mouth, a way in or a
hand: nearer to lying than to standing."""


@dataclass(frozen=True)
class Pose:
    """A rigid transform to the base frame: ``position`` (3,) [m], ``rotation`` (3, 3)."""

    position: Vector
    rotation: Vector

    @classmethod
    def of(cls, position: Sequence[float], quaternion: Sequence[float]) -> Pose:
        """From a position [m] and a quaternion w x y z."""
        rotation = np.empty(9)
        mujoco.mju_quat2Mat(rotation, np.array(quaternion))
        return cls(np.array(position), rotation.reshape(3, 3))

    @property
    def quaternion(self) -> Vector:
        """The rotation as a unit quaternion (4,)."""
        return quaternion_of(self.rotation)

    def place(self, points: Vector) -> Vector:
        """Points (n, 3) of the frame in the base frame."""
        return np.asarray(points @ self.rotation.T + self.position)

    def local(self, points: Vector) -> Vector:
        """Points (n, 3) of the base frame in the frame."""
        return np.asarray((points - self.position) @ self.rotation)

    def __matmul__(self, other: Pose) -> Pose:
        return Pose(self.position + self.rotation @ other.position, self.rotation @ other.rotation)

    def inverse(self) -> Pose:
        """The inverse transform."""
        return Pose(-self.rotation.T @ self.position, self.rotation.T)

    def moved(self, offset: Vector) -> Pose:
        """The same orientation, shifted by ``offset`` (3,) in the base frame [m]."""
        return Pose(self.position + offset, self.rotation)


def quaternion_of(rotation: Vector) -> Vector:
    """The unit quaternion (4,) of a rotation matrix (3, 3)."""
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, np.ascontiguousarray(rotation).ravel())
    return quaternion


def is_rigid(transform: Vector) -> bool:
    """Whether a matrix (4, 4) is a rotation, a position and the row 0 0 0 1."""
    rotation = transform[:3, :3]
    skew = float(np.abs(rotation @ rotation.T - np.eye(3)).max())
    last = float(np.abs(transform[3] - [0.0, 0.0, 0.0, 1.0]).max())
    return skew <= ROTATION_TOLERANCE and last <= 1e-6 and bool(np.linalg.det(rotation) > 0)


def rotation_from_axes(approach: Vector, closing: Vector) -> Vector:
    """Tool rotation (3, 3) with z along ``approach`` and y along ``closing`` (made orthogonal)."""
    z = approach / math.sqrt(float(approach @ approach))
    y = closing - z * float(closing @ z)
    y = y / math.sqrt(float(y @ y))
    rotation = np.empty((3, 3))
    rotation[:, 0] = cross(y, z)
    rotation[:, 1] = y
    rotation[:, 2] = z
    return rotation


def cross(first: Vector, second: Vector) -> Vector:
    """Cross product of two vectors (3,); ``np.cross`` takes ten times as long for so little."""
    a, b, c = first.tolist()
    d, e, f = second.tolist()
    return np.array([b * f - c * e, c * d - a * f, a * e - b * d])


def turn_about(axis: Vector, angle: float) -> Vector:
    """Rotation matrix (3, 3) about a unit axis (3,) by an angle [rad]."""
    quaternion, matrix = np.zeros(4), np.zeros(9)
    mujoco.mju_axisAngle2Quat(quaternion, np.asarray(axis, dtype=np.float64), angle)
    mujoco.mju_quat2Mat(matrix, quaternion)
    return matrix.reshape(3, 3)


def rotation_by(turn: Vector) -> Vector:
    """The rotation (3, 3) about the direction of ``turn`` (3,), by its length [rad]."""
    angle = math.sqrt(float(turn @ turn))
    return turn_about(turn / angle, angle) if angle > 1e-12 else np.eye(3)


def rotation_between(source: Vector, target: Vector) -> Vector:
    """The smallest rotation (3, 3) that takes one unit vector (3,) to another; of those to the
    opposite one, that about an axis which is square to x too.
    """
    axis, cosine = cross(source, target), float(source @ target)
    sine = math.sqrt(float(axis @ axis))
    if sine > 1e-9:
        return turn_about(axis / sine, math.atan2(sine, cosine))
    if cosine > 0:
        return np.eye(3)
    square = cross(source, np.eye(3)[1 if abs(source[0]) > 1.0 - 1e-12 else 0])
    return turn_about(square / math.sqrt(float(square @ square)), math.pi)


def straight(start: Pose, end: Pose, step: float = LINE_STEP) -> list[Pose]:
    """Poses along a straight line (spherical interpolation of the rotation), end included."""
    distance = float(np.linalg.norm(end.position - start.position))
    relative = start.rotation.T @ end.rotation
    angle = float(np.arccos(np.clip((np.trace(relative) - 1) / 2, -1.0, 1.0)))
    count = max(int(np.ceil(max(distance / step, angle / 0.12))), 1)
    velocity = np.zeros(3)
    mujoco.mju_quat2Vel(velocity, quaternion_of(relative), 1.0)
    poses = []
    for i in range(1, count + 1):
        share = i / count
        position = start.position + share * (end.position - start.position)
        poses.append(Pose(position, start.rotation @ rotation_by(share * velocity)))
    return poses

"""How a robot's fingers stand at each opening, measured on its model.

Fingers may be slides or linkages, coupled by tendons, equalities or nothing: the gripper is driven
from closed to open in a model of the robot alone, and what its joints and pads do is written down.
"""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path

import mujoco
import numpy as np

from etot_cli.errors import WorldError
from etot_cli.world.arrays import Vector
from etot_cli.world.robot import RobotSpec

SAMPLES = 9
"""Openings that are measured; between them joints are interpolated, which for the four-bar linkages
of common grippers errs by less than 0.2 mm."""
SETTLE_S = 0.6
"""Time that the gripper gets at each of them [s]."""
LINEAR = 1e-4
"""Openings this close to a line in the joints' values are taken to be on it [m]."""
HEAVY = 1e6
"""Inertia of joints that are not to move [kg m²]: 100 N m turn them by 0.02 mrad meanwhile."""
FAR = 1.0
"""Distances between pads are looked for up to this [m]."""
OPENING_TOLERANCE = 0.005
"""The YAML's opening may be wrong by this much [m]."""
TIP_TOLERANCE = 0.005
"""Pads may end this far above the fingertips [m]; with more, what lies flat touches no pad."""


@dataclass(frozen=True)
class Fingers:
    """``joints``: names of the gripper's joints; ``openings`` (k,) between the pads, rising [m];
    ``postures`` (k, m): those joints' values at each.
    """

    joints: tuple[str, ...]
    openings: Vector
    postures: Vector

    @cached_property
    def _line(self) -> tuple[Vector, float] | None:
        """Weights (m,) and offset [m] of the opening where all joints move in proportion to it, as
        slides do; reading a line takes a tenth of the time.
        """
        spans = self.postures[-1] - self.postures[0]
        moving = np.abs(spans) > 1e-6
        slopes = np.zeros(len(spans))
        slopes[moving] = (self.openings[-1] - self.openings[0]) / spans[moving]
        weights = slopes / moving.sum()
        offset = float(self.openings[0] - weights @ self.postures[0])
        said = self.postures @ weights + offset
        return (weights, offset) if np.abs(said - self.openings).max() < LINEAR else None

    def posture(self, opening: float) -> Vector:
        """The gripper's joint values (m,) at an opening [m]."""
        columns = [np.interp(opening, self.openings, joint) for joint in self.postures.T]
        return np.array(columns)

    def opening(self, values: Vector) -> float:
        """The opening [m] at joint values (m,), the mean of what each joint that moves says."""
        if self._line is not None:
            weights, offset = self._line
            return float(weights @ values) + offset
        said = []
        for value, joint in zip(values, self.postures.T, strict=True):
            if abs(joint[-1] - joint[0]) > 1e-6:
                order = slice(None) if joint[-1] > joint[0] else slice(None, None, -1)
                said.append(_extended(float(value), joint[order], self.openings[order]))
        return float(np.mean(said))


def _extended(value: float, at: Vector, heights: Vector) -> float:
    """Linear interpolation that goes on beyond both ends with the slope there."""
    for edge, inner in ((0, 1), (-1, -2)):
        outside = value < at[0] if edge == 0 else value > at[-1]
        if outside:
            slope = (heights[inner] - heights[edge]) / (at[inner] - at[edge])
            return float(heights[edge] + slope * (value - at[edge]))
    return float(np.interp(value, at, heights))


@lru_cache(maxsize=8)
def measure_fingers(spec: RobotSpec, changed_ns: int) -> Fingers:
    """Drives the gripper of a robot's own model from closed to open.

    Args:
        spec: the robot.
        changed_ns: when its model was changed last, so that a changed model is measured anew.

    Raises:
        WorldError: the gripper does not open, the pads do not face each other along the closing
            direction or end too far above the fingertips: it could never grasp anything.
    """
    model = mujoco.MjModel.from_xml_path(str(spec.model_path))
    model.opt.gravity[:] = 0.0
    # As in scenes; with Euler's method stiff servos never come to rest.
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    arm = set(spec.joints)
    scalar = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
    names = tuple(
        model.joint(j).name
        for j in range(model.njnt)
        if int(model.jnt_type[j]) in scalar and model.joint(j).name not in arm
    )
    addresses = [int(model.joint(name).qposadr[0]) for name in names]
    first, second = (int(model.geom(name).id) for name in spec.gripper.pads)
    actuator = int(model.actuator(spec.gripper.actuator).id)
    arm_addresses = [int(model.joint(name).qposadr[0]) for name in spec.joints]
    arm_actuators = [int(model.actuator(name).id) for name in spec.actuators]
    # Only the gripper is to move, whatever the arm's servos are like.
    arm_dofs = [int(model.joint(name).dofadr[0]) for name in spec.joints]
    model.dof_armature[arm_dofs] = HEAVY
    data = mujoco.MjData(model)
    data.qpos[arm_addresses] = spec.home
    data.ctrl[arm_actuators] = spec.home
    openings, postures = [], []
    for share in np.linspace(0.0, 1.0, SAMPLES):
        closed, opened = spec.gripper.command_closed, spec.gripper.command_open
        data.ctrl[actuator] = closed + share * (opened - closed)
        mujoco.mj_step(model, data, round(SETTLE_S / model.opt.timestep))
        mujoco.mj_forward(model, data)
        gap = mujoco.mj_geomDistance(model, data, first, second, FAR, None)
        openings.append(max(float(gap), 0.0))
        postures.append(data.qpos[addresses].copy())
        if share == 0.0:
            _check_tips(model, data, spec, (first, second))
    _check_openings(spec, openings, data, (first, second))
    return Fingers(names, np.maximum.accumulate(openings), np.array(postures))


def fingers_of(spec: RobotSpec) -> Fingers:
    """As :func:`measure_fingers`, measured once for each model file."""
    return measure_fingers(spec, Path(spec.model_path).stat().st_mtime_ns)


def _check_openings(
    spec: RobotSpec,
    openings: list[float],
    data: mujoco.MjData,
    pads: tuple[int, int],
) -> None:
    if abs(openings[-1] - spec.gripper.opening) > OPENING_TOLERANCE:
        raise WorldError(
            f"robot {spec.name}: at command_open the pads are {openings[-1] * 1000:.0f} mm apart, "
            f"but its YAML gives an opening of {spec.gripper.opening * 1000:.0f} mm"
        )
    across = data.geom_xpos[pads[1]] - data.geom_xpos[pads[0]]
    closing = data.site(spec.tool_site).xmat.reshape(3, 3)[:, 1]
    if abs(float(across @ closing)) < 0.9 * float(np.linalg.norm(across)):
        raise WorldError(
            f"robot {spec.name}: the pads do not close along the y axis of {spec.tool_site}"
        )


def _check_tips(
    model: mujoco.MjModel, data: mujoco.MjData, spec: RobotSpec, pads: tuple[int, int]
) -> None:
    """The pads against everything else below the hand: what sticks out beyond them comes first to
    the support of what is to be held.
    """
    hand = int(model.site(spec.tool_site).bodyid[0])
    roots = {int(model.body(name).id) for name in spec.gripper.fingers}
    below = [
        geom
        for geom in range(model.ngeom)
        if (model.geom_contype[geom] or model.geom_conaffinity[geom])
        and root_of(model, int(model.geom_bodyid[geom]), roots | {hand})
    ]
    site = data.site(spec.tool_site)
    approach = site.xmat.reshape(3, 3)[:, 2]

    def tip(geom: int) -> float:
        box, rotation = model.geom_aabb[geom], data.geom_xmat[geom].reshape(3, 3)
        middle = data.geom_xpos[geom] + rotation @ box[:3] - site.xpos
        return float(middle @ approach + np.abs(rotation.T @ approach) @ box[3:])

    pads_end = max(tip(pad) for pad in pads)
    short = max(tip(geom) for geom in (*below, *pads)) - pads_end
    if short > TIP_TOLERANCE:
        raise WorldError(
            f"robot {spec.name}: the pads end {short * 1000:.0f} mm above the fingertips, so "
            "nothing that lies flat can be held; let them reach the tips"
        )
    if pads_end < -TIP_TOLERANCE:
        raise WorldError(
            f"robot {spec.name}: the pads end {-pads_end * 1000:.0f} mm before the tool point "
            f"{spec.tool_site}, so they would never reach what is to be held there"
        )


def root_of(model: mujoco.MjModel, body: int, roots: Container[int]) -> int:
    """The first of a body and those that it hangs on that is one of ``roots``; 0 where none is."""
    while body and body not in roots:
        body = int(model.body_parentid[body])
    return body

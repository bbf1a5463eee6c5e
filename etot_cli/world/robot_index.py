"""Addresses of the robot's joints, actuators and geoms in a compiled model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import WorldError
from etot_cli.specs.scene import Actuation
from etot_cli.world.build.mjcf_check import check_mjcf
from etot_cli.world.fingers import Fingers, fingers_of, root_of
from etot_cli.world.robot import RobotSpec

ROBOT_PREFIX = "robot/"
TIP_MARGIN, FINGER_MARGIN = 0.0005, 0.0015
"""Added to the measured length and thickness of the fingers [m]."""


@dataclass(frozen=True)
class RobotIndex:
    """Addresses of the robot's joints, actuators and geoms in the model."""

    spec: RobotSpec
    qpos: NDArray[np.int64]
    """Joint positions in qpos, (n,)."""
    dof: NDArray[np.int64]
    ctrl: NDArray[np.int64]
    """Arm actuators in ctrl, (n,)."""
    gripper_ctrl: int
    finger_qpos: NDArray[np.int64]
    """Joint positions of the gripper in qpos, (m,)."""
    fingers: Fingers
    tool_site: int
    pads: tuple[int, int]
    lower: NDArray[np.float64]
    """Joint limits [rad], (n,)."""
    upper: NDArray[np.float64]
    tip: float
    """How far the fingertips reach beyond the tool point [m]."""
    finger_half: float
    """Half thickness of the closed fingers, across the approach [m]."""
    finger_side: dict[int, int]
    """Bodies of the two fingers, those that hang on them too, and whether left (0) or right (1)."""

    def opening(self, data: mujoco.MjData) -> float:
        """Distance between the pads [m]."""
        return self.fingers.opening(data.qpos[self.finger_qpos])

    def set_opening(self, data: mujoco.MjData, opening: float) -> None:
        """Puts the fingers where they stand at an opening [m]."""
        data.qpos[self.finger_qpos] = self.fingers.posture(opening)


def add_robot(mj: mujoco.MjSpec, robot: RobotSpec) -> None:
    """Attaches the robot's own model, all names prefixed.

    Raises:
        WorldError: it is no model, or lacks something that the robot's YAML names.
    """
    check_mjcf(robot.model_path)
    try:
        child = mujoco.MjSpec.from_file(str(robot.model_path))
    except ValueError as error:
        raise WorldError(f"{robot.model_path.name}: not a valid MJCF model ({error})") from error
    gripper = robot.gripper
    for key, names, there in (
        ("joints", robot.joints, child.joints), ("actuators", robot.actuators, child.actuators),
        ("tool_site", (robot.tool_site,), child.sites),
        ("gripper.actuator", (gripper.actuator,), child.actuators),
        ("gripper.fingers", gripper.fingers, child.bodies),
        ("gripper.pads", gripper.pads, child.geoms),
    ):  # fmt: skip
        known = {item.name for item in there} - {"", "world"}
        for name in names:
            if name not in known:
                raise WorldError(
                    f"robot {robot.name}: {key}: found {name!r}, expected a name in {robot.model}: "
                    f"{', '.join(sorted(known)) or 'it has none'}"
                )
    mj.attach(child, prefix=ROBOT_PREFIX, frame=mj.worldbody.add_frame())


def actuate(model: mujoco.MjModel, robot: RobotIndex, actuation: Actuation) -> None:
    """Makes the arm's servos and the gripper as strong as a robot really has them."""
    for actuator, gain in zip(robot.ctrl, actuation.servo, strict=False):
        # Force and damping in proportion: a servo as stable as before, only stiffer or softer.
        model.actuator_gainprm[actuator, 0] *= gain
        model.actuator_biasprm[actuator, 1:3] *= gain
    force, gripper = actuation.gripper_force, robot.gripper_ctrl
    model.actuator_gainprm[gripper] *= force
    model.actuator_biasprm[gripper] *= force
    model.actuator_forcerange[gripper] *= force


def robot_index(model: mujoco.MjModel, spec: RobotSpec) -> RobotIndex:
    """Finds everything that the robot's YAML names in the compiled model."""

    def name(item: str) -> str:
        return ROBOT_PREFIX + item

    joints = [model.joint(name(item)) for item in spec.joints]
    actuators = [model.actuator(name(item)) for item in spec.actuators]
    fingers = [model.body(name(item)) for item in spec.gripper.fingers]
    pads = [model.geom(name(item)).id for item in spec.gripper.pads]
    gripper = model.actuator(name(spec.gripper.actuator)).id
    site = model.site(name(spec.tool_site)).id
    _check_joints(spec, joints)
    measured = fingers_of(spec)
    finger_joints = [int(model.joint(name(item)).qposadr[0]) for item in measured.joints]
    sides = _sides(model, [int(body.id) for body in fingers])
    for pad, item in zip(pads, spec.gripper.pads, strict=True):
        if int(model.geom_bodyid[pad]) not in sides:
            raise WorldError(f"robot {spec.name}: the pad {item} is on neither finger nor below it")
    if sides[int(model.geom_bodyid[pads[0]])] == sides[int(model.geom_bodyid[pads[1]])]:
        raise WorldError(f"robot {spec.name}: both pads are on one finger; expected one on each")
    lower, upper = np.array([joint.range for joint in joints]).T
    tip, finger_half = _fingertips(model, int(site), [int(pad) for pad in pads])
    return RobotIndex(
        spec=spec,
        qpos=np.array([int(joint.qposadr[0]) for joint in joints]),
        dof=np.array([int(joint.dofadr[0]) for joint in joints]),
        ctrl=np.array([int(actuator.id) for actuator in actuators]),
        gripper_ctrl=int(gripper),
        finger_qpos=np.array(finger_joints),
        fingers=measured,
        finger_side=sides,
        tool_site=int(site),
        pads=(int(pads[0]), int(pads[1])),
        lower=lower,
        upper=upper,
        tip=tip,
        finger_half=finger_half,
    )


def _check_joints(spec: RobotSpec, joints: Sequence[Any]) -> None:
    """Refuses joints that are no angle or way of an arm, and a home that they cannot reach."""
    for name, joint, home in zip(spec.joints, joints, spec.home, strict=True):
        if int(joint.type[0]) not in (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE):
            raise WorldError(
                f"robot {spec.name}: the joint {name} in {spec.model} neither turns about one axis "
                "nor slides along one"
            )
        lower, upper = joint.range
        if lower < upper and not lower <= home <= upper:
            raise WorldError(
                f"robot {spec.name}: home has {home:g} for the joint {name}, expected a value "
                f"within its limits in {spec.model}, {lower:g} to {upper:g}"
            )


def _sides(model: mujoco.MjModel, fingers: list[int]) -> dict[int, int]:
    """For every body that is a finger or hangs on one, which of the two."""
    roots = ((body, root_of(model, body, fingers)) for body in range(model.nbody))
    return {body: fingers.index(root) for body, root in roots if root}


def _fingertips(model: mujoco.MjModel, site: int, pads: list[int]) -> tuple[float, float]:
    """Reach of the pads beyond the tool point, and their half thickness when closed [m]."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    rotation, point = data.site_xmat[site].reshape(3, 3), data.site_xpos[site]
    corners = []
    for pad in pads:
        box = model.geom_aabb[pad]
        for signs in product((-1, 1), repeat=3):
            local = data.geom_xmat[pad].reshape(3, 3) @ (box[:3] + np.array(signs) * box[3:])
            corners.append(rotation.T @ (data.geom_xpos[pad] + local - point))
    across, tip = np.abs(corners)[:, :2].max(), np.array(corners)[:, 2].max()
    return round(float(tip), 6) + TIP_MARGIN, round(float(across), 6) + FINGER_MARGIN

"""Motions in reports: what the robot was told for each action, and the file with its targets."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from etot_cli.control.simulated import WorldOutcome
from etot_cli.reporting.models import Count, Digest, ExactSeconds, Model, Seconds, rounded
from etot_cli.skills.motion.motion import Motion, PhaseEnd, Trace
from etot_cli.skills.motion.timing import CONTROL_PERIOD, peaks
from etot_cli.world.state import SceneState


class PoseModel(Model):
    """A pose; ``frame`` names the object, part or ``base`` that it is told in."""

    frame: str
    position: tuple[float, float, float]
    """x y z [m]."""
    quaternion: tuple[float, float, float, float]
    """w x y z."""


class PeaksModel(Model):
    """The largest values of a motion's joint targets over all joints."""

    speed: float
    """[rad/s]"""
    acceleration: float
    """[rad/s²]"""
    jerk: float
    """[rad/s³]"""


class MotionModel(Model):
    """What the robot was told for one action of the plan, in the twin."""

    action: str
    node: Count
    file: str
    """The trajectory file, relative to the report."""
    sha256: Digest
    """Of that file."""
    seconds: Seconds
    tool_at: PoseModel | None
    """The tool where it closes on, or first touches, the object or part it is told in."""
    object_at: PoseModel | None
    """Where the held object is let go, in the frame of what it is put on or into."""
    details: dict[str, Annotated[float, rounded(6)]]
    """Figures of the grasp or placement, SI units."""
    peaks: PeaksModel | None
    """Null where the arm did not move."""
    before: dict[str, PoseModel]
    """Every object's pose when the action began, base frame."""
    after: dict[str, PoseModel]
    end_state: str
    """SHA-256 of the twin's physics state after the action: a replay there ends in it."""


class TrajectoryPhaseModel(Model):
    """One phase of a motion, as sent."""

    name: str
    end: PhaseEnd
    """How it ended."""
    start_s: ExactSeconds
    end_s: ExactSeconds
    opening: float | None
    """Distance between the pads that the gripper is sent to as the phase begins [m]."""
    targets: list[list[float]]
    """Joint targets [rad], one row for every control period."""
    waited_s: ExactSeconds
    """Time held still after the targets."""
    holding: float | None
    """With an opening below this [m] what was held is gone; null with empty fingers."""


class TrajectoryModel(Model):
    """Everything a robot is sent for one action, in order."""

    schema_: Literal["etot.trajectory/1"] = Field(default="etot.trajectory/1", alias="schema")
    action: str
    robot: str
    model: str
    """SHA-256 of the twin's model, to tell whether a scene is the one that this was planned in."""
    joints: list[str]
    """Names of the joints, in the order of each row of targets."""
    control_period_s: ExactSeconds
    phases: list[TrajectoryPhaseModel]


def motion_model(
    action: str, node: int, file: str, sha256: str, outcome: WorldOutcome
) -> MotionModel | None:
    """A plan's motion as it stands in reports; None where the rooms below told none."""
    motion, trace = outcome.motion, outcome.trace
    if not isinstance(motion, Motion) or not isinstance(trace, Trace):
        return None
    return MotionModel.of(
        motion,
        action=action,
        node=node,
        file=file,
        sha256=sha256,
        seconds=trace.seconds,
        peaks=_peaks(trace),
        before=_poses(outcome.record.before),
        after=_poses(outcome.record.after),
        end_state=outcome.end_digest,
    )


def trajectory_model(
    action: str, robot: str, joints: list[str], model: str, trace: Trace
) -> TrajectoryModel:
    """What a robot was sent, as it stands in a trajectory file."""
    return TrajectoryModel(
        action=action,
        robot=robot,
        model=model,
        joints=joints,
        control_period_s=CONTROL_PERIOD,
        phases=[
            TrajectoryPhaseModel.of(
                phase,
                opening=phase.command,
                targets=[] if phase.targets is None else phase.targets.tolist(),
            )
            for phase in trace.phases
        ],
    )


def _poses(scene: SceneState) -> dict[str, PoseModel]:
    return {name: PoseModel.of(state, frame="base") for name, state in scene.states.items()}


def _peaks(trace: Trace) -> PeaksModel | None:
    """Over all phases; each begins and ends at rest."""
    found = []
    for phase in trace.phases:
        if phase.targets is not None:
            ends = np.repeat(phase.targets[[0, -1]], 3, axis=0)
            found.append(peaks(np.vstack([ends[:3], phase.targets, ends[3:]])))
    if not found:
        return None
    speed, acceleration, jerk = (round(max(values), 4) for values in zip(*found, strict=True))
    return PeaksModel(speed=speed, acceleration=acceleration, jerk=jerk)

"""Reading the trajectory files of a plan report, to send them to a robot again."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pydantic import Field, ValidationError

from etot_cli.control.replaying import Recording
from etot_cli.errors import PlanSyntaxError, SpecError
from etot_cli.reporting.models import HEX_DIGEST
from etot_cli.reporting.motion_report import TrajectoryModel, TrajectoryPhaseModel
from etot_cli.reporting.replay import Lenient, plan_from_report, read_report
from etot_cli.skills.action import Action, Verb
from etot_cli.skills.motion.motion import Motion, PhaseEnd, PhaseTrace, Trace
from etot_cli.skills.motion.timing import CONTROL_PERIOD
from etot_cli.specs.problems import first_fault
from etot_cli.specs.reading import read_bytes

MAX_TRAJECTORY_BYTES = 16 * 1024 * 1024
"""A long action is some 2,500 rows of six numbers, 200 kB."""
MAX_SECONDS = 120.0
"""Of one action; twice what an action in the twin may take [s]."""


@dataclass(frozen=True, slots=True)
class RecordedPlan:
    """A plan with its recordings; ``drawn_with``: the seed by which the scene was varied that it
    was planned in, None for the task's own scene.
    """

    recordings: tuple[Recording, ...]
    drawn_with: int | None

    @property
    def actions(self) -> tuple[Action, ...]:
        """The plan."""
        return tuple(item.action for item in self.recordings)


class _Motion(Lenient):
    action: str
    file: str
    sha256: str = Field(default="", pattern=HEX_DIGEST)
    details: dict[str, float] = Field(default_factory=dict)
    end_state: str = ""


class _Options(Lenient):
    vary: bool = False


class _Report(Lenient):
    seed: int = 0
    options: _Options = _Options()
    motions: list[_Motion] = Field(default_factory=list)


def recorded_plan(path: Path) -> RecordedPlan:
    """The plan of a report of ``etot plan`` and what its robot was sent.

    Raises:
        PlanSyntaxError: the report or one of its trajectory files cannot be used.
    """
    actions = plan_from_report(path)
    report = read_report(path, _Report)
    if not report.motions:
        raise PlanSyntaxError(
            f"{path}: the report names no trajectories; expected a report with 'motions'"
        )
    written = [item.action for item in report.motions]
    if written != [str(action) for action in actions]:
        raise PlanSyntaxError(
            f"{path}: its trajectories are for {' '.join(written)[:200]}, its plan is another; "
            "expected a report that has not been edited"
        )
    recordings = tuple(
        _recording(path, item, action) for item, action in zip(report.motions, actions, strict=True)
    )
    return RecordedPlan(recordings, report.seed if report.options.vary else None)


def _recording(report: Path, motion: _Motion, action: Action) -> Recording:
    path = _beside(report, motion.file)
    try:
        content = read_bytes(path, MAX_TRAJECTORY_BYTES, "a trajectory file")
    except SpecError as error:
        raise PlanSyntaxError(str(error)) from None
    try:
        model = TrajectoryModel.model_validate_json(content)
    except ValidationError as error:
        raise PlanSyntaxError(f"{path}: not a readable trajectory: {first_fault(error)}") from None
    if hashlib.sha256(content).hexdigest() != motion.sha256:
        raise PlanSyntaxError(
            f"{path}: is not the file that {report} was written with (another SHA-256); expected "
            "it unchanged"
        )
    if model.action != motion.action:
        raise PlanSyntaxError(f"{path}: recorded for {model.action}, expected {motion.action}")
    _check(path, model)
    if action.verb is Verb.PICK_UP and "width" not in motion.details:
        raise PlanSyntaxError(f"{report}: motions: no 'width' in the details of {motion.action}")
    return Recording(
        action,
        Motion(motion.action, (), details=motion.details),
        Trace(tuple(_phase(item, len(model.joints)) for item in model.phases)),
        model.robot,
        tuple(model.joints),
        model.model,
        motion.end_state,
        str(path),
    )


def _beside(report: Path, file: str) -> Path:
    """A file that a report names; never one outside the report's folder."""
    path = report.parent / file
    try:
        inside = path.resolve().is_relative_to(report.parent.resolve())
    except (OSError, RuntimeError, ValueError):
        inside = False
    if not inside:
        raise PlanSyntaxError(f"{report}: found {file[:200]!r}, expected a file below its folder")
    return path


def _check(path: Path, model: TrajectoryModel) -> None:
    """Refuses what no robot was sent, whatever its checksum says."""
    if model.control_period_s != CONTROL_PERIOD:
        raise PlanSyntaxError(
            f"{path}: control_period_s: found {model.control_period_s}, expected {CONTROL_PERIOD}"
        )
    for number, phase in enumerate(model.phases):
        odd = next((row for row in phase.targets if len(row) != len(model.joints)), None)
        if odd is not None:
            raise PlanSyntaxError(
                f"{path}: phases.{number}.targets: found a row of {len(odd)} numbers, expected one "
                f"for each of {len(model.joints)} joints"
            )
    seconds = sum(_seconds(phase) for phase in model.phases)
    if seconds > MAX_SECONDS:
        raise PlanSyntaxError(
            f"{path}: lasts {seconds:.3g} s, expected at most {MAX_SECONDS:.0f} s"
        )


def _seconds(phase: TrajectoryPhaseModel) -> float:
    return len(phase.targets) * CONTROL_PERIOD + phase.waited_s


def _phase(phase: TrajectoryPhaseModel, joints: int) -> PhaseTrace:
    targets: Sequence[Sequence[float]] | None = phase.targets or None
    return PhaseTrace(
        phase.name,
        PhaseEnd(phase.end),
        phase.start_s,
        phase.end_s,
        0.0,
        (0.0,) * joints,
        phase.opening,
        None if targets is None else np.array(targets),
        phase.waited_s,
        phase.holding,
    )

"""The report of ``etot simulate``: schema ``etot.simulate/1``."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from etot_cli.reporting.evidence import JudgedModel
from etot_cli.reporting.models import Count, Metres, Model, Report


class StepModel(JudgedModel):
    """One action of the plan, carried out."""

    index: Count
    """Its place in the plan, from 0."""
    status: Literal["success", "failure", "unsafe"]


class ConditionModel(Model):
    """One of the task's success conditions in the final scene."""

    condition: str
    """In words."""
    held: bool


class SuccessConditionsModel(Model):
    """The task's own success conditions, evaluated after the last action carried out."""

    held: bool
    """All of them hold."""
    conditions: list[ConditionModel]


class StartErrorModel(Model):
    """How far start poses may be off."""

    position_m: Metres
    """In each of x and y."""
    yaw_deg: float


class OpenLoopModel(Model):
    """A plan report's trajectories, sent as they are."""

    error: StartErrorModel | None
    """Of the start poses; null where they were not drawn from an error."""
    end_state: str | None
    """SHA-256 of the physics state at the end; null when nothing was carried out."""
    same_end_state: bool | None
    """It is, to the byte, the one that the plan's report has; null where the world is another, or
    where the plan was not carried out to its end."""


class SimulateReport(Report):
    """What happened when a plan was carried out in the simulator."""

    schema_: Literal["etot.simulate/1"] = Field(default="etot.simulate/1", alias="schema")
    status: Literal["success", "failure", "unsafe", "interrupted"]
    vary: bool
    look: Literal["each", "once"]
    """When the robot looked at the varied world."""
    open_loop: OpenLoopModel | None = None
    """Null unless recorded trajectories were replayed."""
    plan: list[str]
    """The plan asked for."""
    steps: list[StepModel]
    """The actions carried out; the first that does not succeed is the last."""
    cause: str | None
    """Why the status is not success, in one sentence; null on success."""
    success_conditions: SuccessConditionsModel | None
    """Those of `success`, or of `goal` where the task has none; null when it has neither, or when
    the simulation was interrupted before its end."""

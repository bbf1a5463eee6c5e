"""The report of ``etot simulate``: schema ``etot.simulate/1``."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from etot_cli.reporting.evidence import ContactModel, MovedModel
from etot_cli.reporting.models import ActionModel, CauseModel, Count, Model, Report, Seconds


class StepModel(ActionModel):
    """One action of the plan, carried out."""

    index: Count
    """Its place in the plan, from 0."""
    status: Literal["success", "failure", "unsafe"]
    cause: CauseModel | None
    changes: list[str]
    """Objects whose state changed."""
    moved: list[MovedModel] = Field(default_factory=list)
    """What moved or changed, the farthest first."""
    contacts: list[ContactModel] = Field(default_factory=list)
    """Contacts that had to do with it, in order of time."""
    simulated_s: Seconds
    wall_s: Seconds


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


class SimulateReport(Report):
    """What happened when a plan was carried out in the simulator."""

    schema_: Literal["etot.simulate/1"] = Field(default="etot.simulate/1", alias="schema")
    status: Literal["success", "failure", "unsafe", "interrupted"]
    vary: bool
    look: Literal["each", "once"]
    """When the robot looked at the varied world."""
    plan: list[str]
    """The plan asked for."""
    steps: list[StepModel]
    """The actions carried out; the first that does not succeed is the last."""
    cause: str | None
    """Why the status is not success, in one sentence; null on success."""
    success_conditions: SuccessConditionsModel | None
    """Null when the simulation was interrupted before its end."""

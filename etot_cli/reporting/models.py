"""What all reports have in common: their head, and the pieces that several of them use.

A report is the product of a command; its JSON form is a contract with the scripts that read it, so
each model here is also a JSON Schema in ``docs/schemas/``. Times are in seconds. A model
takes what the rooms below hand on as it is, by the names of its attributes.
"""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from etot_cli.skills.action import Action
from etot_cli.world.state import CauseKind

DECIMALS = 6
"""Microseconds are the finest a clock reading means."""


def rounded(decimals: int) -> BeforeValidator:
    """Makes a number's type one that is rounded for people."""
    return BeforeValidator(
        lambda value: round(value, decimals) if isinstance(value, float) else value
    )


def seconds(value: float) -> float:
    """A time rounded for people and never negative [s]."""
    return round(max(value, 0.0), DECIMALS)


def _written(value: Any) -> Any:
    return str(value) if isinstance(value, Action) else value


ExactSeconds = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
Seconds = Annotated[
    ExactSeconds,
    BeforeValidator(lambda value: seconds(value) if isinstance(value, float) else value),
]
ActionText = Annotated[str, BeforeValidator(_written)]
"""As written in plans, e.g. [PUT ON, desk]."""
Metres = Annotated[float, Field(allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]
Count = Annotated[int, Field(ge=0)]
HEX_DIGEST = "^[0-9a-f]{64}$"
Digest = Annotated[str, Field(pattern=HEX_DIGEST)]
"""SHA-256, hexadecimal."""

UNKNOWN = "unknown"
"""The version of a package that is not installed, or that an older report does not tell."""


class Model(BaseModel):
    """Base of everything in a report: no unknown keys.

    A command uses few of these models, which are therefore built when they are first used.
    """

    model_config = ConfigDict(
        extra="forbid",
        defer_build=True,
        validate_by_name=True,
        validate_by_alias=True,
        serialize_by_alias=True,
        allow_inf_nan=False,
        from_attributes=True,
    )

    @classmethod
    def of(cls, source: object, **told: Any) -> Self:
        """What a room below hands on, by the names of its attributes, but for what is told here."""
        for name, field in cls.model_fields.items():
            attribute = str(field.validation_alias or name)
            if name not in told and hasattr(source, attribute):
                told[name] = getattr(source, attribute)
        return cls.model_validate(told)


class VersionsModel(Model):
    """What the result depends on besides input and seed.

    Older reports name libraries that are no longer used.
    """

    model_config = ConfigDict(extra="ignore")

    etot: str
    python: str
    mujoco: str
    numpy: str
    scipy: str = UNKNOWN
    trimesh: str = UNKNOWN
    coacd: str = UNKNOWN
    """Convex pieces of meshes."""
    small_gicp: str = UNKNOWN
    """Where known meshes are in a picture."""
    opencv: str = UNKNOWN
    machine: str = UNKNOWN
    """System and processor: the last bits of a result are the processor's."""


class TimingModel(Model):
    """When the command ran and for how long."""

    started: str
    """Start, ISO 8601 in UTC."""
    wall_s: Seconds
    """From the start of the command to the writing of the report."""
    phases: dict[str, Seconds]
    """Wall time of each phase by name."""


class CauseModel(Model):
    """Why an action failed."""

    kind: CauseKind
    """Physical kind; docs/reports.md tells what each means."""
    objects: list[str]
    """The objects to blame, most important first."""
    text: str
    """One sentence for a person."""
    time_s: Seconds | None = None
    """Simulated time within the action."""


class KeepoutModel(Model):
    """A disc of the desk plane, base frame, that a safe place must not touch."""

    x: Metres
    y: Metres
    radius: Metres
    soft: bool = False
    """It may, where nothing else is free."""


class ActionModel(Model):
    """An action, exactly enough to repeat it."""

    action: ActionText
    """As written in plans, e.g. [PUT ON, desk]."""
    safe: bool
    """It looks for a place that stays clear of everything that moves, see keepout."""
    keepout: list[KeepoutModel]
    """Discs that the place avoids."""


class TaskModel(Model):
    """The task as it was given."""

    name: str
    file: str
    """The task file as named on the command line."""
    instruction: str
    inputs: dict[str, Digest] = Field(default_factory=dict)
    """SHA-256 of every file that the task was read from (documents, meshes, models, a robot's
    YAML), by path from the task file's folder."""


class Report(Model):
    """The head of every report. Each kind of report narrows ``schema`` and ``status``."""

    schema_: str = Field(alias="schema")
    status: str
    seed: Count
    interrupted: bool
    """Stopped by Ctrl-C; the rest of the report holds what was found so far."""
    versions: VersionsModel
    timing: TimingModel
    task: TaskModel
    files: dict[str, str]
    """Other files of this run by purpose, relative to the report's folder."""


def action_fields(action: Action) -> dict[str, object]:
    """The fields of :class:`ActionModel` for an action."""
    return {"action": action, "safe": action.safe, "keepout": action.keepout}

"""What a trial is, and what came of one: plain data, one JSON line each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from enum import StrEnum
from typing import Annotated, Any

from pydantic import ConfigDict, Field, TypeAdapter, ValidationError

from etot_cli.specs.problems import first_fault

COSTS = (
    "planning_s", "nodes", "simulated_s", "model_calls", "model_requests", "input_tokens",
    "output_tokens", "cost",
)  # fmt: skip
"""What planning cost in a trial: wall time [s], nodes, physics time [s], answers of a model, those
of them that no cache had, tokens, US dollars."""
TIMES = ("physics", "inverse_kinematics", "rendering", "reasoning", "other")
"""What the wall time of a trial is split into."""

Amount = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
Count = Annotated[int, Field(ge=0)]


class TrialStatus(StrEnum):
    """How a trial ended."""

    SUCCESS = "success"
    FAILURE = "failure"
    ERROR = "error"
    """It could not be carried out: its process died twice, or the program has a defect."""


@dataclass(frozen=True, slots=True, order=True)
class TrialKey:
    """Which trial: the method, the task by name, and the trial's number from 0."""

    task: str
    number: Count
    method: str

    @property
    def name(self) -> str:
        """``method/task-number``, fit for a file's path."""
        return f"{self.method}/{self.task}-{self.number}"


@dataclass(frozen=True, slots=True)
class ActionTaken:
    """One action of a trial, as written in plans, and what became of it."""

    action: str
    status: str
    cause: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialResult:
    """What came of a trial.

    ``harm``: objects harmed, with how; ``failure_class``: execution, perception, world_model,
    planning or None; ``costs``: by the names in :data:`COSTS`; ``times``: by those in
    :data:`TIMES` [s]; ``report``: the trial's own report, relative to the run's folder.
    """

    __pydantic_config__ = ConfigDict(extra="forbid")

    key: TrialKey
    seed: Count
    status: TrialStatus
    actions: tuple[ActionTaken, ...] = ()
    replans: Count = 0
    harm: tuple[str, ...] = ()
    failure_class: str | None = None
    reason: str = ""
    costs: Mapping[str, Amount] = field(default_factory=dict)
    times: Mapping[str, Amount] = field(default_factory=dict)
    wall_s: Amount = 0.0
    peak_mib: Amount = 0.0
    """Largest resident memory of the worker so far [MiB]."""
    report: str = ""

    @property
    def success(self) -> bool:
        """The task is done and nothing was harmed."""
        return self.status is TrialStatus.SUCCESS

    def outcome(self) -> tuple[object, ...]:
        """All that the seed fixes: the same whenever and wherever the trial is run."""
        return (
            self.key, self.seed, self.status, self.actions, self.replans, self.harm,
            self.failure_class, self.reason, self.costs.get("nodes"), self.costs.get("simulated_s"),
        )  # fmt: skip


_RESULT = TypeAdapter(TrialResult)


def to_document(result: TrialResult) -> dict[str, Any]:
    """A result as JSON has it: flat, the key's fields first."""
    document = asdict(result)
    key = document.pop("key")
    return {"method": key["method"], "task": key["task"], "number": key["number"], **document}


def from_document(document: Mapping[str, Any]) -> TrialResult:
    """The inverse of :func:`to_document`.

    Raises:
        ValueError: something is missing, unknown or of another kind.
    """
    left = dict(document)
    key = {name: left.pop(name) for name in ("method", "task", "number") if name in left}
    try:
        return _RESULT.validate_python({"key": key, **left})
    except ValidationError as error:
        fault = first_fault(error)
        where = fault.path.removeprefix("key.")  # in the document the key's fields stand beside it
        raise ValueError(f"is no trial's result: {where}: {fault.text}") from None

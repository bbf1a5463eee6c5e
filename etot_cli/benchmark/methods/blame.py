"""Whose failure a trial was, in terms of the method's own model of the world.

The closed loop finds out by experiment whether the twin would have foreseen a failure. For a method
that plans in the twin an unforeseen one is the world model's, and a foreseen one happened in
execution. A method that asked no such model, or another one, has itself to blame for what the twin
would have told.
"""

from __future__ import annotations

from enum import StrEnum

from etot_cli.execution.records import FailureClass, Trial


class Foresight(StrEnum):
    """What a method tries its plan in before it acts."""

    NONE = "none"
    IMAGINED = "imagined"
    """A model without contact dynamics."""
    PHYSICS = "physics"


def failure_class(trial: Trial, foresight: Foresight) -> FailureClass | None:
    """The class of a failed trial; None for a success, and where nobody is to blame."""
    found = trial.failure_class
    if foresight is Foresight.PHYSICS or found in (None, FailureClass.PERCEPTION):
        return found
    failed = [item for item in trial.actions if item.failure_class is not None]
    foreseen = found is not FailureClass.WORLD_MODEL or not (failed and failed[-1].motions)
    if not foreseen:
        # The very motion works in the twin: no model would have told.
        return FailureClass.EXECUTION
    return FailureClass.PLANNING if foresight is Foresight.NONE else FailureClass.WORLD_MODEL

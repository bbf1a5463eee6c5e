"""What somebody does to a scene while the robot acts, as data."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Literal

from pydantic import Field, model_validator

from etot_cli.specs.base import Name, Spec
from etot_cli.specs.objects import SceneObject
from etot_cli.specs.quantity import Coordinate, Meaning

MAX_DISTURBANCES = 16
"""Of one task; more is no longer a task that anybody could tell the outcome of."""
Address = Annotated[
    str,
    Field(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,47}(\.[A-Za-z][A-Za-z0-9_]{0,47})?$"),
    Meaning("an object's name, or object.part"),
]
Portion = Annotated[float, Field(ge=0.0, le=1.0), Meaning("a share from 0 to 1")]
DEEDS = ("move", "drop", "remove", "add", "knock_over", "part")


class Role(StrEnum):
    """Stands for an object that only the course of the execution tells."""

    CHOSEN = "chosen"
    """The object that the robot picks first, or has picked."""
    TARGET = "target"
    """What the robot's plan puts that object on or into; else what its first action is about."""


class Disturbance(Spec):
    """One thing that a person does to the scene while the robot acts (used by ``execute``).

    Exactly one of ``move``, ``drop``, ``remove``, ``knock_over``, ``part`` and ``add`` says what.
    An object is given by its name or by its role: ``chosen``, the object that the robot picks
    first, or ``target``, what that object is to be put on or into.
    """

    when: Literal["planned", "committed", "after_action", "during_action"] = "committed"
    """``planned``: the first plan is there; ``committed``: the robot is about to pick something up
    for the first time; ``after_action``: it has carried that many actions out; ``during_action``:
    in the middle of that action."""
    after_action: Annotated[int, Field(ge=0, le=50)] = 0
    """With ``after_action``: the number of actions, 0 before the first."""
    during_action: Annotated[int, Field(ge=1, le=50)] = 1
    """With ``during_action``: which action, from 1."""
    share: Portion = 0.5
    """With ``during_action``: how much of the action's time has passed by then."""
    move: Name | None = None
    """This object is put ``inside``, ``on``, ``at`` or ``by``; ``chosen`` where only a place is
    given."""
    drop: Name | None = None
    """This object falls ``inside``, ``on`` or ``at``, from a hand's breadth above."""
    remove: Name | None = None
    """This object is taken away."""
    knock_over: Name | None = None
    """This object is tipped over."""
    part: Address | None = None
    """This door or drawer is moved ``to`` a share of its travel."""
    add: Name | None = None
    """A new ``object`` of this name comes onto the scene."""
    inside: Address | None = None
    """A container."""
    on: Address | None = None
    """A surface."""
    at: tuple[Coordinate, Coordinate] | None = None
    """x y on the desk."""
    by: tuple[Coordinate, Coordinate] | None = None
    """How far along x and y from where it is [m]."""
    to: Portion | None = None
    """Of its travel, 0 closed, 1 open."""
    object: SceneObject | None = None
    """With ``add``: what it is and where it is put, as in a scene."""

    @model_validator(mode="after")
    def _one_deed(self) -> Disturbance:
        deeds = [key for key in DEEDS if getattr(self, key) is not None]
        placed = any(getattr(self, key) is not None for key in ("inside", "on", "at", "by"))
        if len(deeds) != 1 and (deeds or not placed):
            raise ValueError(
                f"give one of {', '.join(DEEDS)}; found {', '.join(deeds) or 'none of them'}"
            )
        return self

    @model_validator(mode="after")
    def _what_belongs_to_it(self) -> Disturbance:
        deed = self.deed
        wanted = {
            "move": ("inside", "on", "at", "by"), "drop": ("inside", "on", "at"),
            "part": ("to",), "add": ("object",),
        }.get(deed, ())  # fmt: skip
        given = [
            key
            for key in ("inside", "on", "at", "by", "to", "object")
            if getattr(self, key) is not None
        ]
        if wanted and len(given) != 1:
            raise ValueError(f"give one of {_listed(wanted)} with '{deed}'")
        foreign = [key for key in given if key not in wanted]
        if foreign:
            raise ValueError(f"'{foreign[0]}' does not go with '{deed}'")
        return self

    @model_validator(mode="after")
    def _when(self) -> Disturbance:
        if self.when != "after_action" and "after_action" in self.model_fields_set:
            raise ValueError("'after_action' needs 'when: after_action'")
        for key in ("during_action", "share"):
            if self.when != "during_action" and key in self.model_fields_set:
                raise ValueError(f"'{key}' needs 'when: during_action'")
        return self

    @property
    def deed(self) -> str:
        """Which of the deeds it is."""
        return next((key for key in DEEDS if getattr(self, key) is not None), "move")

    @property
    def name(self) -> str:
        """The object, role or part that it is done to."""
        return str(getattr(self, self.deed) or Role.CHOSEN.value)

    def __str__(self) -> str:
        where = [
            f"{key} {_shown(getattr(self, key))}"
            for key in ("inside", "on", "at", "by", "to")
            if getattr(self, key) is not None
        ]
        verb = {"part": "move", "knock_over": "knock over"}.get(self.deed, self.deed)
        return " ".join([verb, self.name, *where])


def _listed(keys: tuple[str, ...]) -> str:
    quoted = [f"'{key}'" for key in keys]
    return quoted[0] if len(quoted) == 1 else f"{', '.join(quoted[:-1])} and {quoted[-1]}"


def _shown(value: object) -> str:
    if isinstance(value, tuple):
        return " ".join(f"{number:g}" for number in value)
    return f"{value:g}" if isinstance(value, float) else str(value)

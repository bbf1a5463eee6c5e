"""What a task is: an instruction about a scene, and how an evaluator tells success."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag, field_validator, model_validator

from etot_cli.specs.base import Name, Spec, Title
from etot_cli.specs.bounds import MAX_WORLDS
from etot_cli.specs.disturbance import MAX_DISTURBANCES, Disturbance
from etot_cli.specs.objects import SceneObject
from etot_cli.specs.quantity import Coordinate, Meaning
from etot_cli.specs.scene import Scene

Reference = Annotated[
    str,
    Field(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,47}(\.[A-Za-z][A-Za-z0-9_]{0,47})?$"),
    Meaning("an object's name, or object.part"),
]
"""An object, or one of its parts as ``object.part``."""


Pair = tuple[Reference, Reference]
Region = Literal["left", "right", "front", "back", "centre", "edge", "corner"]
BESIDE_KEYS = (
    "left_of", "right_of", "in_front_of", "behind", "next_to", "near", "away_from", "between",
)  # fmt: skip
"""Conditions on where an object stands with respect to others, seen from the viewpoint."""


class Condition(Spec):
    """One statement about the world; exactly one key is given.

    ``on: [a, b]`` a rests on b (the desk is ``desk``); ``inside: [a, b]``; ``in_hand: a``;
    ``open: part`` at least 65 % of its travel; ``closed: part``; ``upright: a``; ``present: a``
    still on the desk or on something; ``left_of: [a, b]`` and the like: a stands so with respect
    to b, seen from the scene's viewpoint; ``between: [a, b, c]``; ``at: [a, region or [x, y]]``;
    ``any`` / ``all``: lists of conditions; ``not``: one condition.
    """

    on: Pair | None = None
    inside: Pair | None = None
    in_hand: Reference | None = None
    open: Reference | None = None
    closed: Reference | None = None
    upright: Reference | None = None
    present: Reference | None = None
    left_of: Pair | None = None
    right_of: Pair | None = None
    in_front_of: Pair | None = None
    behind: Pair | None = None
    next_to: Pair | None = None
    near: Pair | None = None
    away_from: Pair | None = None
    between: tuple[Reference, Reference, Reference] | None = None
    at: tuple[Reference, Region | tuple[Coordinate, Coordinate]] | None = None
    any: Annotated[tuple[Condition, ...], Field(min_length=1, max_length=64)] | None = None
    all: Annotated[tuple[Condition, ...], Field(min_length=1, max_length=64)] | None = None
    not_: Condition | None = Field(default=None, alias="not")

    @model_validator(mode="after")
    def _exactly_one(self) -> Condition:
        given = [key for key in self.model_fields_set if getattr(self, key) is not None]
        if len(given) != 1 or len(self.model_fields_set) != 1:
            raise ValueError(
                "a condition has exactly one key of on, inside, in_hand, open, closed, upright, "
                f"present, {', '.join(BESIDE_KEYS)}, at, any, all, not"
            )
        return self


class Task(Spec):
    """A task: the planner sees ``instruction`` (or ``goal``) and ``scene``; ``success`` is the
    evaluator's alone.
    """

    name: Title
    instruction: Annotated[str, Field(min_length=1, max_length=2000)]
    scene: Scene
    success: Annotated[tuple[Condition, ...], Field(min_length=1, max_length=64)]
    goal: Annotated[tuple[Condition, ...], Field(min_length=1, max_length=64)] | None = None
    disturbance: (
        Annotated[
            Annotated[Disturbance, Tag("one")]
            | Annotated[
                tuple[Disturbance, ...],
                Field(min_length=1, max_length=MAX_DISTURBANCES),
                Tag("list"),
            ],
            # Deciding by the form keeps errors to the one that was meant.
            Discriminator(lambda value: "list" if isinstance(value, list | tuple) else "one"),
        ]
        | None
    ) = None
    """What somebody does while the robot acts: one thing, or a list of them."""
    worlds: Annotated[int, Field(ge=1, le=MAX_WORLDS)] = 1
    """In how many varied worlds ``plan`` tries every action, unless told otherwise."""
    file: str = ""
    """The task file as the user named it; set by the loader, refused in YAML."""
    inputs: dict[str, str] = Field(default_factory=dict, exclude=True)
    """SHA-256 of the files that the task was read from, by path from its own; set by the loader."""

    @property
    def disturbances(self) -> tuple[Disturbance, ...]:
        """All that somebody does, in order."""
        given = self.disturbance
        if given is None:
            return ()
        return (given,) if isinstance(given, Disturbance) else given

    @property
    def added_objects(self) -> tuple[SceneObject, ...]:
        """What disturbances bring onto the scene."""
        return tuple(item.object for item in self.disturbances if item.object is not None)

    @field_validator("instruction")
    @classmethod
    def _some_words(cls, value: str) -> str:
        if not value.strip():
            raise ValueError("is blank, expected a sentence that says what to do")
        return value.strip()


__all__ = ["Condition", "Disturbance", "Name", "Reference", "Task"]

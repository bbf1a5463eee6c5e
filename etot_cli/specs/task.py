"""What a task is: an instruction about a scene, and how an evaluator tells success."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag, field_validator, model_validator

from etot_cli.specs.base import Spec, Title
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

    Objects go by their names, parts by ``object.part``, or by the object's name where it has a
    single one. Sides are those of the scene's viewpoint.
    """

    on: Pair | None = None
    """``a`` rests on ``b``, which may be ``desk``."""
    inside: Pair | None = None
    """``a`` lies in the container ``b``: a vessel, a cabinet, a drawer."""
    in_hand: Reference | None = None
    """The gripper holds it."""
    open: Reference | None = None
    """The part is open by at least 65 % of its travel."""
    closed: Reference | None = None
    """The part is closed."""
    upright: Reference | None = None
    """It stands: a vessel on its foot, and what is taller than wide with its own z axis up, however
    they were at the start; all else as it stood then, boxes and cylinders either way round."""
    lying: Reference | None = None
    """It lies: a vessel, and what is taller than wide, on its side, and a rod by its length, to
    within 40°; all else on a side that makes it rather low than high. A ball and a cube cannot."""
    present: Reference | None = None
    """It is still on the desk or on something."""
    left_of: Pair | None = None
    """``a`` stands on that side of ``b``."""
    right_of: Pair | None = None
    """As ``left_of``."""
    in_front_of: Pair | None = None
    """As ``left_of``."""
    behind: Pair | None = None
    """As ``left_of``."""
    next_to: Pair | None = None
    """At most 10 cm are free between the two."""
    near: Pair | None = None
    """At most 20 cm are free between the two."""
    away_from: Pair | None = None
    """At least 20 cm are free between the two."""
    between: tuple[Reference, Reference, Reference] | None = None
    """The first stands between the other two."""
    at: tuple[Reference, Region | tuple[Coordinate, Coordinate]] | None = None
    """It stands there on what it rests on; x y within 3 cm, in the base frame."""
    any: Annotated[tuple[Condition, ...], Field(min_length=1, max_length=64)] | None = None
    """At least one of them holds."""
    all: Annotated[tuple[Condition, ...], Field(min_length=1, max_length=64)] | None = None
    """All of them hold."""
    not_: Condition | None = Field(default=None, alias="not")
    """It does not hold."""

    @model_validator(mode="after")
    def _exactly_one(self) -> Condition:
        given = [key for key in self.model_fields_set if getattr(self, key) is not None]
        if len(given) != 1 or len(self.model_fields_set) != 1:
            raise ValueError(
                "a condition has exactly one key of on, inside, in_hand, open, closed, upright, "
                f"lying, present, {', '.join(BESIDE_KEYS)}, at, any, all, not"
            )
        return self


class Task(Spec):
    """A task: the planner sees ``instruction`` (or ``goal``) and ``scene``; ``success`` is the
    evaluator's alone.
    """

    name: Title
    """Letters, digits, ``_``, ``.`` and ``-``, at most 64."""
    instruction: Annotated[str, Field(min_length=1, max_length=2000)]
    """What to do, in a sentence; this is what the planner gets. May be left out beside a `goal`."""
    scene: Scene
    """A scene file, relative to the task's, or a scene written out."""
    success: Annotated[tuple[Condition, ...], Field(min_length=1, max_length=64)] = ()
    """What must hold at the end; the evaluator alone sees it. `bench` needs it."""
    goal: Annotated[tuple[Condition, ...], Field(min_length=1, max_length=64)] | None = None
    """Replaces the instruction, for those who want to be formal."""
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

"""The roles that the paper gives its VLM, behind one protocol.

Every reasoner (built in, or a VLM) takes and returns the plain data defined here; planning and
execution know nothing else of it. Source: paper, sections "Priori Branching" and "Tree Searching
and Reflective Branching".
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol, runtime_checkable

from etot_cli.errors import EtotError
from etot_cli.skills.action import Action
from etot_cli.specs.task import Condition
from etot_cli.world.state import Cause, RolloutRecord, SceneState


@dataclass(frozen=True, slots=True)
class Assignment:
    """What the planner is asked to do. ``goal``, when given, replaces the instruction.

    ``past``: what has been seen since it was given, the first look first and without the scene at
    hand; empty where it is planned for the first time. Words speak of the first look, whatever has
    become of it: "the cup in the drawer" stays the same cup once it is in the hand, and what was
    reached and has been left behind since is not to be done again.
    """

    instruction: str
    goal: tuple[Condition, ...] | None = None
    past: tuple[SceneState, ...] = ()

    def given_in(self, scene: SceneState) -> SceneState:
        """The scene that its words speak of, when a scene is at hand."""
        return self.past[0] if self.past else scene


@dataclass(frozen=True, slots=True)
class Branch:
    """A full action sequence from the root to a leaf, with a word on its purpose."""

    actions: tuple[Action, ...]
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Understanding:
    """What a reasoner took its assignment for, in formal terms, for people.

    ``choices``: what words were taken for where they could have meant something else.
    """

    goal: str = ""
    choices: tuple[str, ...] = ()


@runtime_checkable
class Explains(Protocol):
    """A reasoner that says what it understood by the assignment of its last proposal."""

    @property
    def understanding(self) -> Understanding:
        """Empty before the first proposal."""
        ...


Doubts = Callable[[SceneState], str]
"""Says why a scene is not what was asked for; empty when it is, or when that cannot be told."""


@runtime_checkable
class Checks(Protocol):
    """A reasoner that tells whether a scene is what it proposed branches for last."""

    def check(self, assignment: Assignment, start: SceneState) -> Doubts:
        """The check for plans that start in a scene; the words are not read again for it."""
        ...


class Outcome(StrEnum):
    """How an action went."""

    SUCCESS = "success"
    FAILURE = "failure"
    UNSAFE = "unsafe"


@dataclass(frozen=True, slots=True)
class Verdict:
    """The judge's decision on one action.

    ``changes``: names of objects whose state changed, the acted-on ones included.
    """

    outcome: Outcome
    cause: Cause | None = None
    changes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class FailedStep:
    """A failed node and the branch it stood in.

    ``branch`` is the whole branch root to leaf; ``index`` the failed action's place in it;
    ``record`` what happened; ``verdict`` why it counts as failed; ``start`` the scene at the root.
    """

    branch: Branch
    index: int
    record: RolloutRecord
    verdict: Verdict
    start: SceneState


class StopReason(StrEnum):
    """Why a reasoner cannot go on."""

    MAX_CALLS = "max_calls"
    MAX_COST = "max_cost"
    MAX_CHOICES = "max_choices"
    """The assignment leaves more choices than it looks at."""
    SERVICE = "service"
    """A service that it needs is not there."""
    NO_ANSWER = "no_answer"
    """What it was told makes no plan, however often it asked."""


class ReasonerStopped(EtotError):
    """The reasoner cannot go on; what was found so far counts.

    Any of a reasoner's methods may raise it. A search ends with it and keeps its tree, but for
    MAX_CHOICES, which only says that no more branches will be proposed.
    """

    def __init__(self, reason: StopReason, message: str) -> None:
        super().__init__(message)
        self.reason = reason
        self.exit_code = 3 if reason is StopReason.SERVICE else 1


class Reasoner(Protocol):
    """Scene and task understanding, branching, judging and reflecting."""

    def propose(self, assignment: Assignment, scene: SceneState) -> Iterable[Branch]:
        """Priori branching: all candidate branches, best first; none when the goal already holds.

        They may be worked out one at a time, as they are asked for.

        Raises:
            InstructionError: the assignment cannot be understood against this scene.
        """
        ...

    def judge(self, action: Action, record: RolloutRecord) -> Verdict:
        """Compares all objects before and after the action."""
        ...

    def reflect(self, failed: FailedStep) -> Iterable[Branch]:
        """All corrected branches from the root, best first; none where no revision keeps the
        purpose. They may be worked out one at a time, as they are asked for.
        """
        ...

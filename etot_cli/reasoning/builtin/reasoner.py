"""The built-in reasoner: the paper's VLM roles done offline, from the world's state."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import chain

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.acceptance import doubts_about
from etot_cli.reasoning.builtin.branching import branches_of
from etot_cli.reasoning.builtin.completion import completed
from etot_cli.reasoning.builtin.constraints import (
    broken_constraint,
    cause_of_breach,
    spares_none,
)
from etot_cli.reasoning.builtin.goal import Constraint, Goal
from etot_cli.reasoning.builtin.judging import judge_action
from etot_cli.reasoning.builtin.loads import unburdened_first
from etot_cli.reasoning.builtin.reflection import reflect_on
from etot_cli.reasoning.builtin.turning import is_hopeless, turned_round
from etot_cli.reasoning.builtin.understanding import goals_for
from etot_cli.reasoning.builtin.wording import formal
from etot_cli.reasoning.protocol import (
    Assignment,
    Branch,
    Doubts,
    FailedStep,
    Outcome,
    Understanding,
    Verdict,
)
from etot_cli.skills.action import Action
from etot_cli.world.state import RolloutRecord, SceneState


class BuiltinReasoner:
    """Reads controlled English, branches, judges and reflects; implements ``Reasoner``.

    It is deterministic and knows no task. Between calls it keeps only the goal that it proposed
    branches for last, so that a revision can bring back what it had to take out of its place.
    """

    def __init__(self) -> None:
        self._goals: tuple[Goal, ...] = ()

    def propose(self, assignment: Assignment, scene: SceneState) -> Iterator[Branch]:
        """Priori branching: all candidate branches, in the order of the instruction's own words.

        Raises:
            InstructionError: the assignment cannot be understood against this scene.
            ReasonerStopped: there are more choices than are looked at; raised behind the last one.
        """
        self._goals = goals_for(assignment, scene)
        return branches_of(self._goals, scene, assignment.past)

    @property
    def understanding(self) -> Understanding:
        """The goal that branches were proposed for last."""
        notes = (note for goal in self._goals for note in goal.notes)
        return Understanding(
            " | ".join(dict.fromkeys(map(formal, self._goals))), tuple(dict.fromkeys(notes))
        )

    def check(self, assignment: Assignment, start: SceneState) -> Doubts:
        """Whether a scene is what branches were proposed for last."""
        return doubts_about(self._goals, assignment, start)

    def judge(self, action: Action, record: RolloutRecord) -> Verdict:
        """Compares all objects before and after the action, and holds it to the constraints."""
        verdict = judge_action(action, record)
        if verdict.outcome is not Outcome.SUCCESS:
            return verdict
        breach = cause_of_breach(record, self._constraints)
        return (
            verdict if breach is None else replace(verdict, outcome=Outcome.FAILURE, cause=breach)
        )

    def reflect(self, failed: FailedStep) -> Iterator[Branch]:
        """All corrected branches from the root, best first, worked out as they are asked for."""
        whole = chain.from_iterable(
            completed(revised, failed, self._goals) for revised in reflect_on(failed)
        )
        revisions = unburdened_first(whole, failed)
        instead = turned_round(failed, self._goals)
        # Of what keeps a thing from its place what can be taken away is, before others go for it.
        first, then = (instead, revisions) if is_hopeless(failed) else (revisions, instead)
        return (
            revised
            for revised in chain(first, then)
            if broken_constraint(revised.actions, self._constraints, failed.start) is None
            and not any(spares_none(revised.actions, goal, failed.start) for goal in self._goals)
        )

    @property
    def _constraints(self) -> tuple[Constraint, ...]:
        """What must not happen on the way, whichever of the alternative goals is followed."""
        return _constraints(self._goals)


def forbidden_by(assignment: Assignment, scene: SceneState) -> tuple[Constraint, ...]:
    """What must not happen on the way, whoever plans; nothing where the words are not understood.

    Args:
        assignment: what is asked for.
        scene: the scene that its words speak of.
    """
    try:
        return _constraints(goals_for(assignment, scene))
    except InstructionError:
        return ()


def _constraints(goals: Iterable[Goal]) -> tuple[Constraint, ...]:
    return tuple(constraint for goal in goals for constraint in goal.constraints)

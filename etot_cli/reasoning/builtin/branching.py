"""Priori branching: every choice that a goal leaves open becomes a branch of its own.

Two categories, as in the paper: instances (which object, which container) and manipulation
parameters (which grasp pose). Source: paper, section "Priori Branching".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice, product
from typing import NamedTuple

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.choices import Choice, choices
from etot_cli.reasoning.builtin.constraints import broken_constraint
from etot_cli.reasoning.builtin.goal import (
    Close,
    Constraint,
    Goal,
    Open,
    Pick,
    Put,
    Relation,
    Step,
    in_final_order,
)
from etot_cli.reasoning.builtin.ordering import Placement, supports_first
from etot_cli.reasoning.builtin.rules import check_plan
from etot_cli.reasoning.builtin.sketch import PUT_DOWN, Sketch
from etot_cli.reasoning.protocol import Branch, ReasonerStopped, StopReason
from etot_cli.skills.action import Action, GraspPose
from etot_cli.world.state import STAYS_OPEN_AT, SceneState

MAX_CHOICES = 4096
"""Ways of resolving a goal that are looked at: half a second's work, and more branches than could
ever be simulated."""


def branches_of(goals: Sequence[Goal], scene: SceneState) -> Iterator[Branch]:
    """All branches that lead to any of the alternative goals, in the instruction's own order.

    Args:
        goals: alternatives, the preferred one first.
        scene: the state in which the branches start.

    Yields:
        Well-formed branches without duplicates, worked out one at a time; none when a goal
        already holds.

    Raises:
        InstructionError: no well-formed plan can do what is asked for.
        ReasonerStopped: more choices are left than are looked at.
    """
    if any(found is not None and not found.branch.actions for found in _looked_at(goals, scene)):
        return
    seen: set[tuple[Action, ...]] = set()
    objection = "nothing fits what was asked for"
    for count, candidate in enumerate(_candidates(goals, scene)):
        if count == MAX_CHOICES:
            raise ReasonerStopped(
                StopReason.MAX_CHOICES,
                f"only the first {MAX_CHOICES} choices that the instruction leaves were looked at",
            )
        if candidate is None or candidate.branch.actions in seen:
            continue
        broken = _objection(candidate, scene)
        if broken is not None:
            objection = broken
            continue
        seen.add(candidate.branch.actions)
        yield candidate.branch
    if not seen:
        raise InstructionError(f"no well-formed plan does what is asked for: {objection}")


class _Candidate(NamedTuple):
    """A branch, the parts that it is to leave open, and what it must not do."""

    branch: Branch
    left_open: tuple[str, ...]
    constraints: tuple[Constraint, ...]


def _objection(candidate: _Candidate, scene: SceneState) -> str | None:
    """Why a branch cannot be followed: a rule or a constraint that it breaks."""
    actions = candidate.branch.actions
    violations = check_plan(actions, scene, candidate.left_open)
    if violations:
        return str(violations[0])
    return broken_constraint(actions, candidate.constraints, scene)


def reached(goals: Sequence[Goal], scene: SceneState) -> Branch | None:
    """What is still to be done for the alternative that asks for least; an empty branch when one
    holds, None where no choice makes sense.

    Raises:
        InstructionError: the goals cannot be worked out in this scene.
    """
    branches = [found.branch for found in _looked_at(goals, scene) if found is not None]
    return min(branches, key=lambda branch: len(branch.actions), default=None)


def _looked_at(goals: Sequence[Goal], scene: SceneState) -> Iterator[_Candidate | None]:
    return islice(_candidates(goals, scene), MAX_CHOICES)


def _candidates(goals: Sequence[Goal], scene: SceneState) -> Iterator[_Candidate | None]:
    """One branch per choice; None where a choice makes no sense."""
    for goal in goals:
        ordered = replace(goal, steps=in_final_order(goal.steps))
        poses = [step.poses if isinstance(step, Pick | Put) else (None,) for step in ordered.steps]
        for choice in choices(ordered, scene):
            if choice is None:
                yield None
                continue
            for selected in product(*poses):
                left_open = _left_open(ordered.steps, choice, scene)
                branch = _branch(ordered.steps, choice, selected, scene, left_open)
                yield _Candidate(branch, left_open, goal.constraints)


def _branch(
    steps: Sequence[Step],
    choice: Choice,
    poses: Sequence[GraspPose | None],
    scene: SceneState,
    left_open: tuple[str, ...],
) -> Branch:
    """The actions of one way of resolving a goal."""
    sketch = Sketch(scene)
    in_hand = [choice.object(step.what) for step in steps if isinstance(step, Pick)]
    words: list[str] = []
    puts = _in_order(steps, choice, poses)
    for index, (step, pose) in enumerate(zip(steps, poses, strict=True)):
        if isinstance(step, Pick):
            name = choice.object(step.what)
            sketch.pick_up(name, pose)
            words.append(f"take {name}" + (f" ({pose.value})" if pose else ""))
        elif isinstance(step, Put):
            for placement, grasp in islice(puts, len(choice.placements[index])):
                name, relation, target, where = placement
                if step.aside:
                    sketch.take_away(name, PUT_DOWN)
                    continue
                sketch.put(name, relation, target, grasp, where, left_open)
                joint = "into" if relation is Relation.INSIDE else "on"
                words.append(" ".join([name, joint, target, *map(str, where)]))
        elif isinstance(step, Open):
            for part in choice.parts(step, scene):
                if not _opened_anyway(part.address, index, choice):
                    sketch.open(part)
                    words.append(f"open {part.address}")
        else:
            for part in choice.parts(step, scene):
                sketch.close(part, in_hand)
                words.append(f"close {part.address}")
    return Branch(tuple(sketch.actions), ", ".join(dict.fromkeys(words)))


def _left_open(steps: Sequence[Step], choice: Choice, scene: SceneState) -> tuple[str, ...]:
    """Parts that are to be opened in so many words and never closed again, and those that stand
    open far enough and that no word is about.
    """
    parts = (part for info in scene.infos.values() for part in info.parts)
    found = {part.address: True for part in parts if scene.openness(part) >= STAYS_OPEN_AT}
    for step in steps:
        if isinstance(step, Open | Close):
            for part in choice.parts(step, scene):
                found[part.address] = isinstance(step, Open)
    return tuple(address for address, open_ in found.items() if open_)


def _in_order(
    steps: Sequence[Step], choice: Choice, poses: Sequence[GraspPose | None]
) -> Iterator[tuple[Placement, GraspPose | None]]:
    """All placements of a choice, each with its grasp; of those that no word puts in an order
    supports come before what stands on them.
    """
    runs: dict[int, list[tuple[Placement, GraspPose | None]]] = {}
    for index, placements in choice.placements.items():
        step = steps[index]
        assert isinstance(step, Put)  # only these have placements
        run = runs.setdefault(step.run, [])
        run += [(placement, poses[index]) for placement in placements]
    for given in runs.values():
        yield from (given[index] for index in supports_first([item for item, _ in given]))


def _opened_anyway(address: str, index: int, choice: Choice) -> bool:
    """Whether an insertion further on opens and closes the part in a cycle of its own."""
    return any(
        placement.relation is Relation.INSIDE and placement.target == address
        for later, placements in choice.placements.items()
        if later > index
        for placement in placements
    )

"""Priori branching: every choice that a goal leaves open becomes a branch of its own.

Two categories, as in the paper: instances (which object, which container) and manipulation
parameters (which grasp pose). Source: paper, section "Priori Branching".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice, product

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.choices import Choice, choices
from etot_cli.reasoning.builtin.goal import (
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
from etot_cli.reasoning.builtin.sketch import Sketch
from etot_cli.reasoning.protocol import Branch, ReasonerStopped, StopReason
from etot_cli.skills.action import Action, GraspPose
from etot_cli.world.state import SceneState

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
    if any(branch is not None and not branch.actions for branch in _looked_at(goals, scene)):
        return
    seen: set[tuple[Action, ...]] = set()
    objection = "nothing fits what was asked for"
    for count, branch in enumerate(_candidates(goals, scene)):
        if count == MAX_CHOICES:
            raise ReasonerStopped(
                StopReason.MAX_CHOICES,
                f"only the first {MAX_CHOICES} choices that the instruction leaves were looked at",
            )
        if branch is None or branch.actions in seen:
            continue
        violations = check_plan(branch.actions, scene)
        if violations:
            objection = str(violations[0])
            continue
        seen.add(branch.actions)
        yield branch
    if not seen:
        raise InstructionError(f"no well-formed plan does what is asked for: {objection}")


def _looked_at(goals: Sequence[Goal], scene: SceneState) -> Iterator[Branch | None]:
    return islice(_candidates(goals, scene), MAX_CHOICES)


def _candidates(goals: Sequence[Goal], scene: SceneState) -> Iterator[Branch | None]:
    """One branch per choice; None where a choice makes no sense."""
    for goal in goals:
        ordered = replace(goal, steps=in_final_order(goal.steps))
        poses = [step.poses if isinstance(step, Pick | Put) else (None,) for step in ordered.steps]
        for choice in choices(ordered, scene):
            if choice is None:
                yield None
                continue
            for selected in product(*poses):
                yield _branch(ordered.steps, choice, selected, scene)


def _branch(
    steps: Sequence[Step], choice: Choice, poses: Sequence[GraspPose | None], scene: SceneState
) -> Branch:
    """The actions of one way of resolving a goal."""
    sketch = Sketch(scene)
    in_hand = [choice.object(step.what) for step in steps if isinstance(step, Pick)]
    words: list[str] = []
    puts = _in_order(choice, poses)
    for index, (step, pose) in enumerate(zip(steps, poses, strict=True)):
        if isinstance(step, Pick):
            name = choice.object(step.what)
            sketch.pick_up(name, pose)
            words.append(f"take {name}" + (f" ({pose.value})" if pose else ""))
        elif isinstance(step, Put):
            for placement, grasp in islice(puts, len(choice.placements[index])):
                sketch.put(*placement, grasp)
                joint = "into" if placement.relation is Relation.INSIDE else "on"
                words.append(f"{placement.name} {joint} {placement.target}")
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


def _in_order(
    choice: Choice, poses: Sequence[GraspPose | None]
) -> Iterator[tuple[Placement, GraspPose | None]]:
    """All placements of a choice, supports before what stands on them, each with its grasp."""
    given = [
        (placement, poses[index])
        for index, placements in choice.placements.items()
        for placement in placements
    ]
    return (given[index] for index in supports_first([placement for placement, _ in given]))


def _opened_anyway(address: str, index: int, choice: Choice) -> bool:
    """Whether an insertion further on opens and closes the part in a cycle of its own."""
    return any(
        placement.relation is Relation.INSIDE and placement.target == address
        for later, placements in choice.placements.items()
        if later > index
        for placement in placements
    )

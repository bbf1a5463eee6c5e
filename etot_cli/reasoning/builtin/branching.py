"""Priori branching: every choice that a goal leaves open becomes a branch of its own.

Two categories, as in the paper: instances (which object, which container) and manipulation
parameters (which grasp pose). Source: paper, section "Priori Branching".
"""

from __future__ import annotations

import logging
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
from etot_cli.reasoning.builtin.rules import check_plan
from etot_cli.reasoning.builtin.sketch import Sketch
from etot_cli.reasoning.protocol import Branch
from etot_cli.skills.action import Action, GraspPose
from etot_cli.world.state import SceneState

MAX_BRANCHES = 64
"""More branches than this are cut, and it is said so."""
MAX_CHOICES = 4096
"""Ways of resolving a goal that are looked at."""

_log = logging.getLogger(__name__)


def branches_of(goals: Sequence[Goal], scene: SceneState) -> tuple[Branch, ...]:
    """All branches that lead to any of the alternative goals, in the instruction's own order.

    Args:
        goals: alternatives, the preferred one first.
        scene: the state in which the branches start.

    Returns:
        Well-formed branches without duplicates; empty when a goal already holds.

    Raises:
        InstructionError: no well-formed plan can do what is asked for.
    """
    found: dict[tuple[Action, ...], Branch] = {}
    objection = "nothing fits what was asked for"
    cut = False
    for branch in islice(_candidates(goals, scene), MAX_CHOICES):
        if not branch.actions:
            return ()
        violations = check_plan(branch.actions, scene)
        if violations:
            objection = str(violations[0])
        elif branch.actions not in found:
            if len(found) == MAX_BRANCHES:
                cut = True
                break
            found[branch.actions] = branch
    if not found:
        raise InstructionError(f"no well-formed plan does what is asked for: {objection}")
    branches = list(found.values())
    if cut:
        note = f"only the first {MAX_BRANCHES} branches are followed"
        _log.warning("the instruction leaves too many choices: %s", note)
        branches[-1] = replace(branches[-1], reason=f"{branches[-1].reason} ({note})")
    return tuple(branches)


def _candidates(goals: Sequence[Goal], scene: SceneState) -> Iterator[Branch]:
    for goal in goals:
        ordered = replace(goal, steps=in_final_order(goal.steps))
        poses = [step.poses if isinstance(step, Pick | Put) else (None,) for step in ordered.steps]
        for choice in choices(ordered, scene):
            for selected in product(*poses):
                yield _branch(ordered.steps, choice, selected, scene)


def _branch(
    steps: Sequence[Step], choice: Choice, poses: Sequence[GraspPose | None], scene: SceneState
) -> Branch:
    """The actions of one way of resolving a goal."""
    sketch = Sketch(scene)
    in_hand = [choice.object(step.what) for step in steps if isinstance(step, Pick)]
    words: list[str] = []
    for index, (step, pose) in enumerate(zip(steps, poses, strict=True)):
        if isinstance(step, Pick):
            name = choice.object(step.what)
            sketch.pick_up(name, pose)
            words.append(f"take {name}" + (f" ({pose.value})" if pose else ""))
        elif isinstance(step, Put):
            for placement in choice.placements[index]:
                sketch.put(*placement, pose)
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


def _opened_anyway(address: str, index: int, choice: Choice) -> bool:
    """Whether an insertion further on opens and closes the part in a cycle of its own."""
    return any(
        placement.relation is Relation.INSIDE and placement.target == address
        for later, placements in choice.placements.items()
        if later > index
        for placement in placements
    )

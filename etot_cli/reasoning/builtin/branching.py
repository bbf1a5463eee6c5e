"""Priori branching: every choice that a goal leaves open becomes a branch of its own.

Two categories, as in the paper: instances (which object, which container) and manipulation
parameters (which grasp pose). Source: paper, section "Priori Branching".
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice, product
from typing import NamedTuple

from etot_cli.errors import UnsatisfiableError
from etot_cli.reasoning.builtin.choices import Choice, choices
from etot_cli.reasoning.builtin.constraints import broken_constraint
from etot_cli.reasoning.builtin.errands import Errand, Fetching, in_order, visiting_orders
from etot_cli.reasoning.builtin.goal import (
    Close,
    Constraint,
    Goal,
    Keep,
    Open,
    Pick,
    Put,
    Relation,
    Step,
    in_final_order,
)
from etot_cli.reasoning.builtin.openings import closed_by_others, reopened, shared
from etot_cli.reasoning.builtin.resuming import Course, what_is_left
from etot_cli.reasoning.builtin.rules import check_plan
from etot_cli.reasoning.builtin.sketch import PUT_DOWN, Sketch
from etot_cli.reasoning.protocol import Branch, ReasonerStopped, StopReason
from etot_cli.skills.action import Action, GraspPose
from etot_cli.world.state import STAYS_OPEN_AT, PartInfo, SceneState, owner_of

MAX_CHOICES = 4096
"""Ways of resolving a goal that are looked at: half a second's work, and more branches than could
ever be simulated."""
MAX_ALTERNATIVES = 256
"""Alternative goals that are followed: a tenth of a second's work, and more branches than a search
of 200 actions tells apart."""


def branches_of(
    goals: Sequence[Goal], scene: SceneState, past: Sequence[SceneState] = ()
) -> Iterator[Branch]:
    """All branches that lead to any of the alternative goals, in the instruction's own order.

    Args:
        goals: alternatives, the preferred one first.
        scene: the state in which the branches start.
        past: what was seen since the goals were understood, the first look first.

    Yields:
        Well-formed branches without duplicates, worked out one at a time; none when a goal
        already holds.

    Raises:
        UnsatisfiableError: no well-formed plan can do what is asked for.
        ReasonerStopped: more choices are left than are looked at.
    """
    if past:
        goals = what_is_left(goals, scene)
    course = Course(past, scene)
    looked_at = islice(_candidates(goals, scene, course, idle=not past), MAX_CHOICES)
    if any(found is not None and not found.branch.actions for found in looked_at):
        return
    seen: set[tuple[Action, ...]] = set()
    objection = "nothing fits what was asked for"
    for count, candidate in enumerate(_candidates(goals, scene, course)):
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
        branch = _shortest(candidate, scene, course).branch
        if branch.actions not in seen:
            yield branch
        seen |= {candidate.branch.actions, branch.actions}
    if len(goals) > MAX_ALTERNATIVES:
        raise ReasonerStopped(
            StopReason.MAX_CHOICES,
            f"only the first {MAX_ALTERNATIVES} ways to make the goal true were looked at",
        )
    if not seen:
        raise UnsatisfiableError(f"no well-formed plan does what is asked for: {objection}")


class _Way(NamedTuple):
    """A way of resolving a goal."""

    goal: Goal
    choice: Choice
    poses: tuple[GraspPose | None, ...]


class _Candidate(NamedTuple):
    """A branch, the parts that its insertions leave open, what it must not do, and the way that it
    follows.
    """

    branch: Branch
    left_open: frozenset[str]
    constraints: tuple[Constraint, ...]
    way: _Way


def _objection(candidate: _Candidate, scene: SceneState) -> str | None:
    """Why a branch cannot be followed: a rule or a constraint that it breaks."""
    actions = candidate.branch.actions
    violations = check_plan(actions, scene, candidate.left_open)
    if violations:
        return str(violations[0])
    return broken_constraint(actions, candidate.constraints, scene)


def reached(goals: Sequence[Goal], scene: SceneState, first: SceneState) -> Branch | None:
    """What is still to be done for the alternative that asks for least; an empty branch when one
    holds, None where no choice makes sense. ``first`` is the scene that the goals' words speak of.

    Raises:
        InstructionError: the goals cannot be worked out in this scene.
    """
    course = Course((first,), scene)
    candidates = islice(_candidates(goals, scene, course), MAX_CHOICES)
    found = [candidate for candidate in candidates if candidate is not None]
    least = min(found, key=lambda candidate: len(candidate.branch.actions), default=None)
    return None if least is None else _shortest(least, scene, course).branch


def _candidates(
    goals: Sequence[Goal], scene: SceneState, course: Course, *, idle: bool = False
) -> Iterator[_Candidate | None]:
    """One branch per choice; None where a choice makes no sense, or (``idle``) has things to move,
    which is told at once.
    """
    sketch = Sketch(scene)
    for goal in goals:
        ordered = replace(goal, steps=in_final_order(goal.steps))
        poses = [step.poses if isinstance(step, Pick | Put) else (None,) for step in ordered.steps]
        for choice in choices(ordered, scene, course.first):
            if choice is None or (idle and _moves_anything(ordered.steps, choice, sketch)):
                yield None
                continue
            for selected in product(*poses):
                way = _Way(ordered, choice, selected)
                branch, left_open = _branch(*way, scene, course)
                constraints = tuple(
                    item if item.referent is None else item.about(choice.things[item.referent])
                    for item in goal.constraints
                )
                yield _Candidate(branch, left_open, constraints, way)


def _shortest(candidate: _Candidate, scene: SceneState, course: Course) -> _Candidate:
    """A branch in the order given, or in one that opens fewer parts again."""
    best = candidate
    if not reopened(best.branch.actions):
        return best
    goal, choice, poses = candidate.way
    left_open = _left_open(goal, choice, course.first)
    for visits in visiting_orders(goal.steps, choice, poses, scene, left_open):
        branch, open_at_last = _branch(*candidate.way, scene, course, visits)
        other = candidate._replace(branch=branch, left_open=open_at_last)
        shorter = len(branch.actions) < len(best.branch.actions)
        if shorter and _objection(other, scene) is None:
            best = other
    return best


def _branch(
    goal: Goal,
    choice: Choice,
    poses: Sequence[GraspPose | None],
    scene: SceneState,
    course: Course,
    visits: Sequence[PartInfo] = (),
) -> tuple[Branch, frozenset[str]]:
    """The actions of one way of resolving a goal, as far as they are still to be done, and the
    parts that insertions do not close again. ``visits``: an order in which parts are visited.
    """
    steps = goal.steps
    sketch = Sketch(scene)
    in_hand = [choice.object(step.what) for step in steps if isinstance(step, Pick)]
    words: list[str] = []
    puts = deque(in_order(steps, choice, poses, scene, visits))
    left_open = _left_open(goal, choice, course.first)
    kept_open = set(left_open)
    behind = course.behind(steps, choice)
    lasting = {put.name: place for place, row in choice.placements.items() for put in row}
    to_shut: dict[str, PartInfo] = {}
    closed_in_words: list[tuple[str, int]] = []
    for index, (step, pose) in enumerate(zip(steps, poses, strict=True)):
        if isinstance(step, Pick):
            _shut(sketch, to_shut, in_hand)
            name = choice.object(step.what)
            sketch.pick_up(name, pose)
            words.append(f"take {name}" + (f" ({pose.value})" if pose else ""))
        elif isinstance(step, Put):
            for _ in choice.placements[index]:
                place, placement, grasp, before = puts.popleft()
                name, relation, target, where = placement
                _prepare(before, behind, choice, sketch, in_hand)
                if (place, name) in behind or name in choice.left:
                    continue
                if step.aside:
                    if _in_the_way(name, choice, sketch):
                        sketch.take_away(name, PUT_DOWN)
                    continue
                if lasting[name] == place:
                    shut = course.to_shut(placement)
                    to_shut |= {p.address: p for p in shut if p.address not in left_open}
                if _is_closed_later(target, steps, index, choice, sketch, puts):
                    kept_open.add(target)
                lift = step.lifted and not course.was_held(name)
                shut_next = _closed_next(steps[index + 1 :], choice, scene)
                sketch.put(
                    name, relation, target, grasp, where, kept_open, stays_closed=shut_next,
                    again=lift,
                )  # fmt: skip
                joint = "into" if relation is Relation.INSIDE else "on"
                words.append(" ".join([name, joint, target, *map(str, where)]))
            if not puts:
                _bring_back(steps, choice, lasting, sketch, kept_open)
        elif isinstance(step, Open):
            for part in choice.parts(step, scene):
                passed = (index, part.address) in behind
                if not passed and not _opened_anyway(part.address, index, choice):
                    sketch.open(part)
                    words.append(f"open {part.address}")
        else:
            for part in choice.parts(step, scene):
                if (index, part.address) not in behind:
                    sketch.close(part, in_hand)
                    closed_in_words.append((part.address, len(sketch.actions)))
                    words.append(f"close {part.address}")
    _shut(sketch, to_shut, in_hand)
    if not in_hand and course.fetched(scene.holding):
        sketch.put_down()
    filled = {
        put.target
        for place, row in choice.placements.items()
        for put in row
        if put.relation is Relation.INSIDE and lasting[put.name] == place
    }
    actions = shared(sketch.actions, filled, closed_in_words)
    kept_open.update(closed_by_others(actions, scene))
    reason = ", ".join(dict.fromkeys(words))
    return Branch(actions, reason), frozenset(kept_open)


def _prepare(
    before: Iterable[Fetching | PartInfo],
    behind: Collection[tuple[int, str]],
    choice: Choice,
    sketch: Sketch,
    in_hand: Sequence[str],
) -> None:
    """Takes things out of a part that is visited now and not again, and shuts what was visited."""
    for item in before:
        if isinstance(item, PartInfo):
            sketch.close(item, in_hand)
            continue
        done = (item.place, item.name) in behind or item.name in choice.left
        if not done and sketch.holds(item.name, Relation.INSIDE, item.part.address):
            sketch.take_away(item.name, PUT_DOWN, item.grasp)


def _bring_back(
    steps: Sequence[Step],
    choice: Choice,
    lasting: Mapping[str, int],
    sketch: Sketch,
    left_open: Collection[str],
) -> None:
    """Puts back what was in its place and left it with what it lay in."""
    for index, placements in choice.placements.items():
        step = steps[index]
        for put in placements:
            rode = put.relation is Relation.INSIDE and not sketch.is_moved(put.name)
            if put.name in choice.left:
                continue
            aside = isinstance(step, Put) and step.aside
            if rode and not aside and lasting[put.name] == index:
                sketch.put(put.name, put.relation, put.target, None, put.where, left_open)


def _moves_anything(steps: Sequence[Step], choice: Choice, sketch: Sketch) -> bool:
    """Whether anything is to be lifted, or is not where it is to be put."""
    placed = (
        (step, placement)
        for index, placements in choice.placements.items()
        if isinstance(step := steps[index], Put) and not step.aside
        for placement in placements
    )
    return any(step.lifted or not sketch.holds(*placement) for step, placement in placed)


def _in_the_way(name: str, choice: Choice, sketch: Sketch) -> bool:
    """Whether a thing stands where something else is to go."""
    return any(
        other != name and sketch.holds(name, relation, target, where)
        for placements in choice.placements.values()
        for other, relation, target, where in placements
    )


def _shut(sketch: Sketch, parts: dict[str, PartInfo], in_hand: Sequence[str]) -> None:
    """Ends the insertions that a plan before this one has left unfinished."""
    while parts:
        sketch.close(parts.popitem()[1], in_hand)


def _left_open(goal: Goal, choice: Choice, scene: SceneState) -> set[str]:
    """Parts that are to be opened in so many words and never closed again, that must not be
    closed, and that stand open far enough without a word about them.
    """
    parts = [part for info in scene.infos.values() for part in info.parts]
    kept = {n for item in goal.constraints if item.keep is Keep.OPEN for n in item.names}
    found = {part.address: True for part in parts if scene.openness(part) >= STAYS_OPEN_AT}
    found |= _last_words(goal.steps, choice, scene)
    found |= {
        part.address: True for part in parts if kept & {part.owner, f"{part.owner}.{part.name}"}
    }
    return {address for address, open_ in found.items() if open_}


def _last_words(steps: Iterable[Step], choice: Choice, scene: SceneState) -> dict[str, bool]:
    """Whether the last of the steps that is about a part opens it, by the part's address."""
    return {
        part.address: isinstance(step, Open)
        for step in steps
        if isinstance(step, Open | Close)
        for part in choice.parts(step, scene)
    }


def _closed_next(steps: Sequence[Step], choice: Choice, scene: SceneState) -> frozenset[str]:
    """Parts, by address, that the first of the steps that is about them closes."""
    first = _last_words(reversed(steps), choice, scene)
    return frozenset(address for address, open_ in first.items() if not open_)


def _is_closed_later(
    address: str,
    steps: Sequence[Step],
    index: int,
    choice: Choice,
    sketch: Sketch,
    following: Iterable[Errand],
) -> bool:
    """Whether an insertion can leave the closing of a part to the words that follow: the part is
    open without it, and no other part of the same piece, which it could cover, is next.
    """
    if _last_words(steps[index + 1 :], choice, sketch.scene).get(address, True):
        return False
    is_open = sketch.is_accessible(address)
    if not _last_words(steps[:index], choice, sketch.scene).get(address, is_open):
        return False
    puts = (errand.placement for errand in following)
    inside = (put.target for put in puts if put.relation is Relation.INSIDE)
    same_piece = (target for target in inside if owner_of(target) == owner_of(address))
    return next(same_piece, address) == address


def _opened_anyway(address: str, index: int, choice: Choice) -> bool:
    """Whether an insertion further on opens and closes the part in a cycle of its own."""
    return any(
        placement.relation is Relation.INSIDE and placement.target == address
        for later, placements in choice.placements.items()
        if later > index
        for placement in placements
    )

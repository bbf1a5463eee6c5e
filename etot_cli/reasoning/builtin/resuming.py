"""What of a goal is left to do when it is planned for again, from where things are by then."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.choices import Choice
from etot_cli.reasoning.builtin.goal import (
    Close,
    Goal,
    Open,
    Pick,
    Put,
    Referent,
    Step,
    referents_of,
    things_in,
)
from etot_cli.reasoning.builtin.ordering import Placement
from etot_cli.reasoning.builtin.relations import enclosing, is_closed, is_open
from etot_cli.reasoning.builtin.sketch import Sketch
from etot_cli.world.state import DESK, PartInfo, SceneState, owner_of


def what_is_left(goals: Iterable[Goal], scene: SceneState) -> list[Goal]:
    """Alternative goals without the things that are gone since they were understood.

    Of a phrase's alternatives those with all their things are left; where there is none, of several
    things that were meant together the rest is.

    Raises:
        InstructionError: in none of them anything is left of what each step is about.
    """
    left: list[Goal] = []
    missing: InstructionError | None = None
    for goal in goals:
        try:
            left.append(_left_of(goal, scene))
        except InstructionError as error:
            missing = error
    if missing is not None and not left:
        raise missing
    return left


def _left_of(goal: Goal, scene: SceneState) -> Goal:
    used = {index for step in goal.steps for index in referents_of(step)}
    referents = (
        _without_gone(referent, scene) if index in used else referent
        for index, referent in enumerate(goal.referents)
    )
    return replace(goal, referents=tuple(referents))


def _without_gone(referent: Referent, scene: SceneState) -> Referent:
    def gone(name: str) -> bool:
        return name != DESK and scene.states[name].lost

    whole = [opt for opt in referent.options if not any(gone(thing.name) for thing in opt)]
    kept = [tuple(t for t in option if not gone(t.name)) for option in referent.options]
    options = tuple(dict.fromkeys(whole or filter(None, kept)))
    if not options:
        missing = " or ".join(dict.fromkeys(t.name for t in things_in(referent.options)))
        raise InstructionError(f"what was asked for cannot be done without {missing}")
    return replace(referent, options=options)


class Course:
    """How far a goal has come.

    Args:
        past: what has been seen since the goal was understood, the first look first.
        scene: what is seen now.
    """

    def __init__(self, past: Sequence[SceneState], scene: SceneState) -> None:
        self.first = past[0] if past else scene
        self._scene = scene
        # What nothing has come before has nothing behind it.
        self._seen = [(seen, Sketch(seen)) for seen in (*past, scene)] if past else []

    def fetched(self, held: str | None) -> bool:
        """Whether what is in the hand was taken since the goal was understood."""
        return held is not None and held != self.first.holding

    def was_held(self, name: str) -> bool:
        """Whether an object has been in the hand since the goal was understood."""
        return any(seen.holding == name for seen, _ in self._seen)

    def behind(self, steps: Sequence[Step], choice: Choice) -> frozenset[tuple[int, str]]:
        """What was reached once and a later step undoes: places of steps, with the object or part.

        Args:
            steps: in the order in which they are done.
            choice: how the goal is resolved.
        """
        found: set[tuple[int, str]] = set()
        demands: dict[str, list[int]] = {}
        for index, step in enumerate(steps if self._seen else ()):
            for about in _about(index, step, choice, self._scene):
                demands.setdefault(about, []).append(index)
        for about, chain in demands.items():
            reached = 0
            for seen, sketch in self._seen:
                while reached < len(chain) - 1 and _is_so(
                    about, chain[reached], steps[chain[reached]], choice, seen, sketch
                ):
                    found.add((chain[reached], about))
                    reached += 1
        return frozenset(found)

    def to_shut(self, placement: Placement) -> Iterator[PartInfo]:
        """Parts in or behind which something was put and that an action was to close after it."""
        if not self._seen:
            return
        owner = owner_of(placement.target)
        outer = enclosing(self._scene, owner) if owner in self._scene.states else ()
        put_since = not self._seen[0][1].holds(*placement)
        for part in filter(None, map(self._scene.part, (placement.target, *outer))):
            known = part.owner in self.first.states
            if part.container and (put_since or (known and is_closed(self.first, part))):
                yield part


def _about(index: int, step: Step, choice: Choice, scene: SceneState) -> tuple[str, ...]:
    if isinstance(step, Put):
        return () if step.aside else tuple(item.name for item in choice.placements[index])
    if isinstance(step, Pick):
        return (choice.object(step.what),)
    return tuple(part.address for part in choice.parts(step, scene))


def _is_so(
    about: str, index: int, step: Step, choice: Choice, seen: SceneState, sketch: Sketch
) -> bool:
    if isinstance(step, Put):
        return all(sketch.holds(*put) for put in choice.placements[index] if put.name == about)
    if isinstance(step, Pick):
        return seen.holding == about
    assert isinstance(step, Open | Close)  # there is no other step
    part = seen.part(about)
    return part is not None and (is_open if isinstance(step, Open) else is_closed)(seen, part)

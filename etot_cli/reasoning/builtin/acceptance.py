"""Whether a scene is what was asked for: the check on plans that somebody else has proposed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.branching import reached
from etot_cli.reasoning.builtin.goal import Close, Goal, Open, Put, Step
from etot_cli.reasoning.builtin.understanding import goals_for
from etot_cli.reasoning.protocol import Assignment, ReasonerStopped
from etot_cli.world.state import SceneState

Doubts = Callable[[SceneState], str]
"""Says why a scene is not what was asked for; empty when it is, or when that cannot be told."""


def doubts_of(assignment: Assignment, start: SceneState) -> Doubts:
    """The check for an assignment and a plan that starts in a scene.

    An instruction beyond the language that is read here leaves nothing to check with.
    """
    try:
        goals = goals_for(assignment, start)
    except InstructionError:
        return lambda scene: ""
    lasting = [replace(goal, steps=_lasting(goal.steps)) for goal in goals]
    given = assignment.given_in(start)
    # Where to is not said of what is only to be taken away: anywhere else will do.
    removed = _removed(goals[0]) if len(goals) == 1 else ()
    asked = "the goal" if assignment.goal is not None else f"{assignment.instruction!r}"

    def doubt(scene: SceneState) -> str:
        missing = _missing(lasting, scene)
        left = [name for name in removed if _place(scene, name) == _place(given, name)]
        if left:
            missing = f"to take {' and '.join(left)} away"
        return f"{asked} does not hold then: still to do is {missing}" if missing else ""

    return doubt


def _missing(goals: Sequence[Goal], scene: SceneState) -> str:
    """What is still to be done, in words; empty when nothing is or nothing can be said."""
    try:
        branch = reached(goals, scene)
    except (InstructionError, ReasonerStopped):
        return ""
    return "" if branch is None or not branch.actions else branch.reason


def _removed(goal: Goal) -> tuple[str, ...]:
    """Objects that are only to be taken away, as far as it is clear which."""
    referents = [
        goal.referents[index]
        for step in goal.steps
        if isinstance(step, Put) and step.removal
        for index in step.what
    ]
    return tuple(
        thing.name for item in referents if len(item.options) == 1 for thing in item.options[0]
    )


def _place(scene: SceneState, name: str) -> object:
    state = scene.states.get(name)
    return None if state is None else (state.inside, state.on)


def _lasting(steps: Sequence[Step]) -> tuple[Step, ...]:
    """The steps whose effect is still to be seen at the end.

    What is opened and closed later, or put somewhere and put elsewhere later, leaves no trace of
    the first step; nor does what only had to wait elsewhere.
    """
    kept: list[Step] = []
    parts: set[int] = set()
    things: set[int] = set()
    for step in reversed(steps):
        about = set(step.what) if isinstance(step, Put) else {step.what}
        later = parts if isinstance(step, Open | Close) else things
        if about <= later or (isinstance(step, Put) and (step.aside or step.removal)):
            continue
        later |= about
        kept.append(step)
    return tuple(reversed(kept))

"""Whether a scene is what was asked for, and what actions that succeeded were to bring about."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.branching import reached
from etot_cli.reasoning.builtin.goal import Close, Goal, Open, Put, Referent, Relation, Step
from etot_cli.reasoning.builtin.sketch import Sketch
from etot_cli.reasoning.builtin.understanding import goals_for
from etot_cli.reasoning.protocol import Assignment, Doubts, ReasonerStopped
from etot_cli.skills.action import PUTS, Action, Verb
from etot_cli.world.state import SceneState


def undone(ends: Iterable[tuple[Action, SceneState]], final: SceneState) -> str:
    """What a plan has put somewhere and is elsewhere in its last scene, in words; mostly nothing.

    A ball that is put into a bowl and falls into a cup that stands there leaves with the cup.

    Args:
        ends: each action with the scene in which it ended.
        final: the last of these.
    """
    placed: dict[str, Action] = {}
    held, last = "", Sketch(final)
    for action, after in ends:
        if action.safe:
            held = ""
        elif action.verb is Verb.PICK_UP:
            held = action.target
            placed.pop(held, None)
        elif action.verb in PUTS and held in final.states:
            placed |= {held: action} if _is_there(Sketch(after), held, action) else {}
    lost = (name for name, put in placed.items() if not _is_there(last, name, put))
    return next((f"{name} does not stay where {placed[name]} brings it" for name in lost), "")


def _is_there(scene: Sketch, name: str, put: Action) -> bool:
    relation = Relation.ON if put.verb is Verb.PUT_ON else Relation.INSIDE
    return scene.holds(name, relation, put.target)


def doubts_of(assignment: Assignment, start: SceneState) -> Doubts:
    """The check for an assignment and a plan that starts in a scene.

    An instruction beyond the language that is read here leaves nothing to check with.
    """
    try:
        goals = goals_for(assignment, start)
    except InstructionError:
        return lambda scene: ""
    return doubts_about(goals, assignment, start)


def doubts_about(goals: Sequence[Goal], assignment: Assignment, start: SceneState) -> Doubts:
    """The same, with what the assignment was understood to ask for."""
    lasting = [_lasting(goal) for goal in goals]
    given = assignment.given_in(start)
    # Where to is not said of what is only to be taken away: anywhere else will do.
    removed = _removed(goals[0]) if len(goals) == 1 else ()
    asked = "the goal" if assignment.goal is not None else f"{assignment.instruction!r}"

    def doubt(scene: SceneState) -> str:
        missing = _missing(lasting, scene, start)
        left = [name for name in removed if _place(scene, name) == _place(given, name)]
        if left:
            missing = f"to take {' and '.join(left)} away"
        return f"{asked} does not hold then: still to do is {missing}" if missing else ""

    return doubt


def _missing(goals: Sequence[Goal], scene: SceneState, start: SceneState) -> str:
    """What is still to be done, in words; empty when nothing is or nothing can be said."""
    try:
        branch = reached(goals, scene, start)
    except (InstructionError, ReasonerStopped):
        return ""
    return "" if branch is None or not branch.actions else branch.reason


def _removed(goal: Goal) -> tuple[str, ...]:
    """Objects that are only to be taken away, as far as it is clear which."""
    puts = [step for step in goal.steps if isinstance(step, Put)]
    referents = [
        goal.referents[index]
        for step in puts
        if step.removal
        for index in step.what
        # What is put elsewhere besides may well end where it was.
        if not any(index in other.what for other in puts if other is not step)
    ]
    return tuple(
        thing.name for item in referents if len(item.options) == 1 for thing in item.options[0]
    )


def _place(scene: SceneState, name: str) -> object:
    state = scene.states.get(name)
    return None if state is None else (state.inside, state.on)


def _lasting(goal: Goal) -> Goal:
    """A goal of the steps whose effect is still to be seen at the end.

    What is opened and closed later, or put somewhere and put elsewhere later, leaves no trace of
    the first step; nor does what only had to wait elsewhere, or was to be lifted.
    """
    referents = [*goal.referents]

    def one_by_one(index: int) -> tuple[int, ...]:
        """Several things by themselves: some of them may be put elsewhere later."""
        (things, *more) = referents[index].options
        if more or len(things) == 1:
            return (index,)
        referents.extend(Referent(((thing,),), thing.name) for thing in things)
        return tuple(range(len(referents) - len(things), len(referents)))

    kept: list[Step] = []
    parts: set[object] = set()
    things: set[object] = set()
    for step in reversed(goal.steps):
        if isinstance(step, Put):
            said = [one for index in step.what for one in one_by_one(index)]
            moved = {one: _meant(referents[one], one) for one in said}
            last = tuple(one for one in said if moved[one] not in things)
            if last and not (step.aside or step.removal):
                kept.append(replace(step, what=last, lifted=False))
            things |= set() if step.aside else {moved[one] for one in last}
            continue
        later = parts if isinstance(step, Open | Close) else things
        meant = _meant(referents[step.what], step.what)
        if meant not in later:
            later.add(meant)
            kept.append(step)
    return replace(goal, referents=tuple(referents), steps=tuple(reversed(kept)))


def _meant(referent: Referent, index: int) -> object:
    """The thing itself where it is clear which; else only the same referent is the same."""
    return referent.options if len(referent.options) == 1 else index

"""From what a model wrote to actions of this scene, or to the exact reasons why not.

Everything a plan may do wrong is checked here by code; the model is never asked whether it was
right.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from etot_cli.reasoning.builtin.rules import check_plan, in_hand
from etot_cli.reasoning.vlm.reading.names import Names, Unresolved
from etot_cli.reasoning.vlm.reading.plans import ReadPlan
from etot_cli.reasoning.vlm.reading.steps import RawStep
from etot_cli.skills.action import PUTS, Action, Verb, read_whereabouts
from etot_cli.world.spatial import Whereabouts
from etot_cli.world.state import DESK, SceneState, owner_of

_SAFE = re.compile(
    r"(?i)\b(safe(?:ly|r)?|out of the way|clear(?:ed)? (?:of|area|spot)|away from|aside|"
    r"(?:different|other|another|free|empty) (?:part|place|spot|area|position|side))\b"
)


@dataclass(frozen=True, slots=True)
class Grounded:
    """Actions, or reasons; one of the two is empty."""

    actions: tuple[Action, ...] = ()
    reasons: tuple[str, ...] = ()


def ground(plan: ReadPlan, scene: SceneState, names: Names) -> Grounded:
    """Resolves the names of a plan and checks it against the rules of a well-formed plan.

    Args:
        plan: as read from a reply.
        scene: where the plan starts.
        names: of that scene.
    """
    reasons = list(plan.problems)
    actions: list[Action] = []
    held = scene.holding
    for number, step in enumerate(plan.steps, 1):
        target = _target(step, names)
        if isinstance(target, Unresolved):
            reasons.append(f"step {number}, {step.verb.value}: {target.text}")
            continue
        if step.moved is not None:
            moved = names.resolve(step.moved)
            if isinstance(moved, str) and moved not in (held, target):
                holds = f"holds {held}" if held else "is empty"
                reasons.append(
                    f"step {number}: {step.verb.value} of {moved}, but the hand {holds} then"
                )
        if step.verb is Verb.PICK_UP:
            held = target
        elif step.verb in PUTS:
            held = None
        words = f"{step.note or ''} {step.target}"
        safe = step.verb is Verb.PUT_ON and bool(_SAFE.search(words))
        pose = step.pose if step.verb is Verb.PICK_UP else None
        where = _where(step, names) if step.verb is Verb.PUT_ON and not safe else ()
        if isinstance(where, Unresolved):
            reasons.append(f"step {number}, {step.verb.value}: {where.text}")
            continue
        actions.append(Action(step.verb, target, pose, safe, where=where))
    if not plan.steps and not reasons:
        reasons.append("the plan has no steps")
    if not reasons:
        reasons += [str(violation) for violation in check_plan(actions, scene)]
    return Grounded((), tuple(reasons)) if reasons else Grounded(tuple(actions))


def _target(step: RawStep, names: Names) -> str | Unresolved:
    found = names.resolve(step.target)
    # "A safe place" names the desk without saying so.
    if isinstance(found, Unresolved) and step.verb is Verb.PUT_ON and _SAFE.search(step.target):
        return DESK
    return found


def _where(step: RawStep, names: Names) -> tuple[Whereabouts, ...] | Unresolved:
    """Where on the surface a note says, its landmarks resolved; other notes say nothing of it."""
    found = []
    for part in (step.note or "").split(","):
        place = read_whereabouts(" ".join(part.replace("the ", " ").split()))
        if place is None:
            continue
        landmarks = []
        for landmark in place.landmarks:
            name = names.resolve(landmark)
            if isinstance(name, Unresolved):
                return name
            landmarks.append(name)
        found.append(replace(place, landmarks=tuple(landmarks)))
    return tuple(found)


@dataclass(frozen=True, slots=True)
class _Ends:
    """What a plan comes to: where things end, what is open or closed, what stays in the hand."""

    placed: dict[str, Action]
    moved: frozenset[str]
    articulated: dict[str, Verb]
    held: str | None


def purpose_reasons(original: Sequence[Action], revised: Sequence[Action]) -> list[str]:
    """Why a revision does not keep the purpose of its plan; empty when it does.

    The same things have to end in the same places; in between, anything may be put aside. Things
    that the plan did not move may only be put down on a surface, never used as a prop.
    """
    if [str(action) for action in original] == [str(action) for action in revised] and [
        action.safe for action in original
    ] == [action.safe for action in revised]:
        return ["this is the plan that failed"]
    before, after = _ends(original), _ends(revised)
    reasons = []
    for name, action in before.placed.items():
        now = after.placed.get(name)
        if action.safe:
            continue  # put aside by an earlier revision, not part of the purpose
        if now is None:
            reasons.append(f"it leaves out that {name} ends with {action}")
        elif (now.verb, now.target, now.where) != (action.verb, action.target, action.where):
            reasons.append(f"it ends with {name} at {now}, the plan was {action}; a revision may "
                           "not choose another place")  # fmt: skip
    for part, verb in before.articulated.items():
        if after.articulated.get(part) is not verb:
            reasons.append(f"it leaves out that {part} ends with [{verb.value}, {part}]")
    if before.held is not None and after.held != before.held:
        reasons.append(f"it does not end with {before.held} in the hand")
    elif before.held is None and after.held is not None:
        reasons.append(f"it ends with {after.held} still in the hand")
    return reasons + _prop_reasons(before, after)


def relocated(original: Sequence[Action], revised: Sequence[Action]) -> frozenset[str]:
    """Things that a revision moves and its plan did not."""
    return _ends(revised).moved - _ends(original).moved


def _prop_reasons(before: _Ends, after: _Ends) -> list[str]:
    reasons = []
    used = {owner_of(action.target) for action in before.placed.values()} | before.moved
    for name in sorted(after.moved - before.moved):
        action = after.placed.get(name)
        if action is None:
            continue
        if action.verb is Verb.PUT_INTO:
            reasons.append(f"{name} is no part of the task and may only be put on a surface, "
                           f"not {action}")  # fmt: skip
        elif action.target in used - set(before.articulated) and action.target in before.moved:
            reasons.append(f"{name} may not be put on {action.target}, which the task needs")
    return reasons


def _ends(actions: Sequence[Action]) -> _Ends:
    placed: dict[str, Action] = {}
    end: str | None = None
    for held, action, end in in_hand(actions, None):  # noqa: B007
        if action.verb in PUTS and held is not None:
            placed[held] = action
    return _Ends(
        placed,
        frozenset(action.target for action in actions if action.verb is Verb.PICK_UP),
        {a.target: a.verb for a in actions if a.verb in (Verb.OPEN, Verb.CLOSE)},
        end,
    )

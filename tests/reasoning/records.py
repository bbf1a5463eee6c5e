"""Rollout records by hand: what was before, what is after, and who touched whom."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Branch, FailedStep, Reasoner
from etot_cli.skills.action import format_plan, parse_plan
from etot_cli.world.state import (
    Cause,
    CauseKind,
    ContactEvent,
    ObjectState,
    RolloutRecord,
    SceneState,
    Swept,
)


def held(scene: SceneState, name: str) -> SceneState:
    """The scene with an object in the hand."""
    state = replace(scene.states[name], on=(), inside=None, in_hand=True)
    return replace(scene, states={**scene.states, name: state}, holding=name)


def changed(scene: SceneState, **objects: dict[str, Any]) -> SceneState:
    """The scene with other states; the hand follows from ``in_hand``."""
    states = {name: replace(state, **objects.get(name, {})) for name, state in scene.states.items()}
    holding = next((name for name, state in states.items() if state.in_hand), None)
    return replace(scene, states=states, holding=holding)


def released(scene: SceneState, **objects: dict[str, Any]) -> SceneState:
    """As :func:`changed`, with what was in the hand let go."""
    name = scene.holding
    assert name is not None
    objects[name] = {"in_hand": False, "on": ("desk",), **objects.get(name, {})}
    return changed(scene, **objects)


def contact(first: str, second: str, impulse: float = 1.0, time_s: float = 1.0) -> ContactEvent:
    return ContactEvent(time_s, first, second, 5.0 * impulse, impulse)


def record(
    before: SceneState,
    after: SceneState | None = None,
    *,
    effect: bool = True,
    cause: Cause | None = None,
    contacts: tuple[ContactEvent, ...] = (),
    swept: tuple[Swept, ...] = (),
    displacement: dict[str, float] | None = None,
) -> RolloutRecord:
    return RolloutRecord(
        before, before if after is None else after, effect, cause, contacts,
        displacement or {}, swept,
    )  # fmt: skip


def cause(kind: CauseKind, *objects: str) -> Cause:
    return Cause(kind, objects, f"{kind.value} of {', '.join(objects)}", 1.0)


def failed(
    start: SceneState,
    plan: str,
    index: int,
    reason: Cause,
    before: SceneState | None = None,
    after: SceneState | None = None,
) -> FailedStep:
    """A failed step whose verdict is the skill's own account."""
    actions = parse_plan(plan)
    rollout = record(before or start, after or before or start, effect=False, cause=reason)
    verdict = BuiltinReasoner().judge(actions[index], rollout)
    return FailedStep(Branch(actions), index, rollout, verdict, start)


def revision(step: FailedStep) -> str | None:
    """What the built-in reasoner makes of a failed step."""
    branch = first_revision(BuiltinReasoner(), step)
    return None if branch is None else format_plan(branch.actions)


def first_revision(reasoner: Reasoner, step: FailedStep) -> Branch | None:
    """The best revision that a reasoner has."""
    return next(iter(reasoner.reflect(step)), None)


def revisions(step: FailedStep) -> list[str]:
    """All that the built-in reasoner makes of a failed step."""
    return [format_plan(branch.actions) for branch in BuiltinReasoner().reflect(step)]


__all__ = ["ObjectState", "cause", "changed", "contact", "failed", "held", "record", "released"]

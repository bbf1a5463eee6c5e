"""From a model's comparison of two pictures to a verdict."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.protocol import Outcome, Verdict
from etot_cli.reasoning.vlm import describe
from etot_cli.reasoning.vlm.reading.states import UNSURE, ReadComparison
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import Cause, CauseKind, RolloutRecord


def settle(
    seen: ReadComparison, record: RolloutRecord, by_state: Verdict
) -> tuple[ReadComparison, list[str]]:
    """Replaces what the model is unsure of by the world's exact state.

    Returns:
        the comparison without doubts, and a sentence for each that was settled.
    """
    sentences = []
    sides = []
    for word, told, scene in (
        ("before", seen.before, record.before),
        ("after", seen.after, record.after),
    ):
        known = dict(told)
        for name, state in told.items():
            if state == UNSURE and name in scene.states:
                known[name] = describe.states(scene, name)
                sentences.append(f"{name} {word}: unsure, it is {known[name]}")
        sides.append(known)
    outcome = seen.outcome
    if outcome in (None, UNSURE):
        outcome = by_state.outcome.value
        sentences.append(f"outcome: unsure, the world's state says {outcome}")
    return replace(seen, before=sides[0], after=sides[1], outcome=outcome), sentences


def verdict_of(seen: ReadComparison, action: Action, record: RolloutRecord) -> Verdict:
    """The verdict that a model's comparison amounts to; doubt counts as failure."""
    changed = tuple(
        name
        for name, state in seen.after.items()
        if name in record.after.states
        and UNSURE not in (state, seen.before.get(name))
        and seen.before.get(name) is not None
        and seen.before[name] != state
    )
    outcome = _outcome(seen, action)
    if outcome is Outcome.SUCCESS:
        return Verdict(outcome, None, changed)
    physical = record.cause
    kind = physical.kind if physical is not None else _kind(seen, outcome)
    objects = physical.objects if physical is not None else changed
    text = seen.explanation or (
        physical.text if physical is not None else "the pictures do not show the action's effect"
    )
    return Verdict(
        outcome, Cause(kind, objects, text, None if physical is None else physical.time_s), changed
    )


def _outcome(seen: ReadComparison, action: Action) -> Outcome:
    """The model's word, or what the states that it saw amount to."""
    if seen.outcome in ("success", "failure", "unsafe"):
        return Outcome(seen.outcome)
    if any(state == "lost" for state in seen.after.values()):
        return Outcome.UNSAFE
    if seen.outcome == UNSURE:
        return Outcome.FAILURE
    expected = {Verb.OPEN: "open", Verb.CLOSE: "closed", Verb.PICK_UP: "in hand"}.get(action.verb)
    if expected is not None:
        reached = expected in seen.after.get(action.target, "").split(", ")
    else:
        word = "inside" if action.verb is Verb.PUT_INTO else "on"
        reached = f"{word} {action.target}" in ", ".join(seen.after.values())
    return Outcome.SUCCESS if reached else Outcome.FAILURE


def _kind(seen: ReadComparison, outcome: Outcome) -> CauseKind:
    states = list(seen.after.values())
    if "lost" in states or outcome is Outcome.UNSAFE:
        return CauseKind.LOST
    return CauseKind.TOPPLED if "toppled" in states else CauseKind.NO_EFFECT

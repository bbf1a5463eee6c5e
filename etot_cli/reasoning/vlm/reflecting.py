"""Reflective branching: diagnosis, corrected plan, and the checks that it has to pass."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

from etot_cli.reasoning.builtin.keepouts import keepouts_of
from etot_cli.reasoning.builtin.rules import in_hand
from etot_cli.reasoning.protocol import Branch, FailedStep
from etot_cli.reasoning.vlm import describe, schemas
from etot_cli.reasoning.vlm.asking import Asker, Reading
from etot_cli.reasoning.vlm.grounding import ground, purpose_reasons, relocated
from etot_cli.reasoning.vlm.notes import NoteKind
from etot_cli.reasoning.vlm.reading.jsons import find_object, text_field
from etot_cli.reasoning.vlm.reading.names import Names
from etot_cli.reasoning.vlm.reading.plans import read_revision
from etot_cli.reasoning.vlm.reading.steps import step_at
from etot_cli.reasoning.vlm.reading.text import bare, lines_of
from etot_cli.reasoning.vlm.reading.verdicts import read_verdict
from etot_cli.reasoning.vlm.sight import Sight
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import DESK, CauseKind, owner_of

MAX_REASON = 300
"""Characters of a diagnosis that go with a branch: two or three sentences."""
NEITHER = "there is neither a plan in it nor the word none"


@dataclass(frozen=True, slots=True)
class _Answer:
    """A usable reply: a plan that passed all checks, or the word that there is none (None)."""

    actions: tuple[Action, ...] | None
    diagnosis: str


class Reflection:
    """Asks for revisions of failed branches.

    Args:
        asker: puts questions to the model.
        sight: pictures of what failed.
        hints: tell what the record knows of the cause; False leaves that to the model.
    """

    def __init__(self, asker: Asker, sight: Sight, *, hints: bool) -> None:
        self._asker = asker
        self._sight = sight
        self._hints = hints

    def revise(self, failed: FailedStep, instruction: str) -> Branch | None:
        """The revised branch, or None.

        Raises:
            ReasonerStopped: a limit was reached, or the service is gone.
        """
        action = failed.branch.actions[failed.index]
        shown = self._sight.action(failed.record)
        reader = _RevisionReader(failed, shown.marks, hints=self._hints)
        values = {**shown.words, **self._values(failed, instruction, bool(shown.pictures))}
        answer = self._asker.ask(
            "reflect", values, shown.pictures, schemas.REVISION, reader.read,
            action=action, objects=values["objects"],
        )  # fmt: skip
        if answer is None:
            return None
        if answer.diagnosis:
            self._asker.notes.add(NoteKind.DIAGNOSIS, "reflect", answer.diagnosis, action)
        if answer.actions is None:
            text = answer.diagnosis or "no correction keeps the purpose"
            self._asker.notes.add(NoteKind.NO_REVISION, "reflect", text, action)
            return None
        if self._is_trick(failed, answer, instruction):
            plan = " ".join(describe.written(item) for item in answer.actions)
            self._asker.notes.add(NoteKind.SCREENED, "screen", plan, action)
            return None
        actions = _with_keepout(answer.actions, failed)
        return Branch(actions, (answer.diagnosis or "revised by the model")[:MAX_REASON])

    def _values(self, failed: FailedStep, instruction: str, pictured: bool) -> dict[str, str]:
        outcome, cause = failed.verdict.outcome.value, failed.verdict.cause
        verdict = f"It counts as {outcome}."
        if self._hints:
            text = "no cause is on record" if cause is None else cause.text
            verdict = f"It counts as {outcome}: {text}."
        return {
            "instruction": instruction,
            # The plan to be corrected begins there, not before the action that failed.
            "catalogue": describe.catalogue(failed.start),
            "relations": describe.relations(failed.start),
            "plan": describe.numbered(failed.branch.actions),
            "number": str(failed.index + 1),
            "action": describe.written(failed.branch.actions[failed.index]),
            "verdict": verdict,
            "changes": describe.changes(failed.record) if self._hints or not pictured else "",
            "events": describe.events(failed.record) if self._hints else "",
        }

    def _is_trick(self, failed: FailedStep, answer: _Answer, instruction: str) -> bool:
        """The screen against propping up and steadying; only what moves bystanders can do that."""
        assert answer.actions is not None  # the caller has looked
        if not relocated(failed.branch.actions, answer.actions):
            return False
        values = {
            "instruction": instruction,
            "failed": describe.numbered(failed.branch.actions),
            "plan": describe.numbered(answer.actions),
            "reason": answer.diagnosis or "(none)",
        }

        def read(reply: str) -> Reading[str]:
            word = read_verdict(reply).verdict
            return Reading(None, ("say yes or no",)) if word is None else Reading(word)

        verdict = self._asker.ask(
            "screen", values, [], schemas.VERDICT, read, action=failed.branch.actions[failed.index]
        )
        return verdict == "yes"


class _RevisionReader:
    """Reads replies to one reflection; a "none" that the record speaks against is asked twice.

    Without ``hints`` the record is not spoken of.
    """

    def __init__(self, failed: FailedStep, marks: Mapping[int, str], *, hints: bool) -> None:
        self._failed = failed
        self._names = Names.of_scene(failed.start, marks)
        self._questioned = not hints

    def read(self, reply: str) -> Reading[_Answer]:
        found = read_revision(reply)
        data = find_object(reply, "diagnosis", "steps")
        diagnosis = text_field(data.get("diagnosis")) if data is not None else _prose(reply)
        if not found.plans:
            if not found.none:
                return Reading(None, found.problems or (NEITHER,))
            doubt = _doubt(self._failed)
            if doubt and not self._questioned:
                self._questioned = True
                return Reading(
                    None,
                    (f"{doubt} keeps the purpose, give that plan; if not, answer again that there "
                     "is none",),
                    NoteKind.QUESTIONED,
                )  # fmt: skip
            return Reading(_Answer(None, diagnosis))
        grounded = ground(found.plans[-1], self._failed.start, self._names)
        reasons = list(grounded.reasons)
        if grounded.actions:
            reasons += purpose_reasons(self._failed.branch.actions, grounded.actions)
        if reasons:
            return Reading(None, tuple(reasons))
        return Reading(_Answer(grounded.actions, diagnosis))


def _doubt(failed: FailedStep) -> str:
    """What the record says against there being no correction, as a condition; empty when nothing.

    It blames a movable thing that is not of the action itself, or one to which an earlier step of
    the plan did something.
    """
    cause = failed.verdict.cause
    if cause is None or cause.kind in (CauseKind.SLIP, CauseKind.UNREACHABLE):
        return ""
    actions = failed.branch.actions[: failed.index + 1]
    target = owner_of(actions[-1].target)
    infos = failed.start.infos
    others = [name for name in cause.objects
              if name in infos and name not in (target, failed.record.before.holding)]  # fmt: skip
    movable = [name for name in others if infos[name].movable]
    if movable:
        return (
            f"the record names {' and '.join(movable)}, which can be moved; if putting it in "
            "a safe place first, or another order of the same actions,"
        )
    earlier = {owner_of(action.target): action for action in actions[:-1]}
    for name in others:
        if name in earlier and target in infos and infos[target].movable:
            return (
                f"the record names {name}, and {earlier[name]} came before; if putting {target} in "
                "a safe place before that step, or another order of the same actions,"
            )
    return ""


def _with_keepout(actions: tuple[Action, ...], failed: FailedStep) -> tuple[Action, ...]:
    """What is moved out of the way goes where the failed rollout shows that nothing hits it."""
    extras = relocated(failed.branch.actions, actions)
    result: list[Action] = []
    for held, action, _ in in_hand(actions, None):
        if action.verb is Verb.PUT_ON and (action.safe or held in extras):
            discs = keepouts_of(failed, held) if held is not None and action.target == DESK else ()
            action = replace(action, safe=True, keepout=discs)
        result.append(action)
    return tuple(result)


def _prose(reply: str) -> str:
    """The sentences of a reply that stand before its plan."""
    kept: list[str] = []
    for line in lines_of(reply):
        if line.number is not None or step_at(line.text, marked=line.marked) is not None:
            break
        # What ends in a colon announces the plan and explains nothing.
        sentences = re.split(r"(?<=[.!?])\s+", line.text)
        kept += [text for text in sentences if text and not text.endswith(":")
                 and bare(text).lower() != "none"]  # fmt: skip
    return " ".join(kept)[:MAX_REASON]

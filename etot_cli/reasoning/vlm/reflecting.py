"""Reflective branching: diagnosis, corrected plan, and the checks that it has to pass."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from etot_cli.reasoning.builtin.keepouts import keepouts_of
from etot_cli.reasoning.protocol import Branch, FailedStep
from etot_cli.reasoning.vlm import describe, schemas
from etot_cli.reasoning.vlm.asking import Asker, Reading
from etot_cli.reasoning.vlm.frames import FrameSource
from etot_cli.reasoning.vlm.grounding import ground, purpose_reasons, relocated
from etot_cli.reasoning.vlm.notes import NoteKind
from etot_cli.reasoning.vlm.reading.jsons import find_object, text_field
from etot_cli.reasoning.vlm.reading.names import Names
from etot_cli.reasoning.vlm.reading.plans import read_revision
from etot_cli.reasoning.vlm.reading.steps import step_at
from etot_cli.reasoning.vlm.reading.text import bare, lines_of
from etot_cli.reasoning.vlm.reading.verdicts import read_verdict
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import DESK, CauseKind

MAX_REASON = 300
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
        frames: pictures of what failed; None for words alone.
    """

    def __init__(self, asker: Asker, frames: FrameSource | None) -> None:
        self._asker = asker
        self._frames = frames

    def revise(self, failed: FailedStep, instruction: str) -> Branch | None:
        """The revised branch, or None.

        Raises:
            ReasonerStopped: a limit was reached, or the service is gone.
        """
        action = failed.branch.actions[failed.index]
        pictures = []
        if self._frames is not None:
            pictures = list(self._frames.rollout(failed.record, self._asker.pictures))
        objects = describe.object_list(failed.start)
        reader = _RevisionReader(failed)
        answer = self._asker.ask(
            "reflect", _values(failed, instruction, objects), pictures, schemas.REVISION,
            reader.read, action=action, objects=objects,
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
    """Reads replies to one reflection; a "none" that the record speaks against is asked twice."""

    def __init__(self, failed: FailedStep) -> None:
        self._failed = failed
        self._names = Names.of_scene(failed.start)
        self._questioned = False

    def read(self, reply: str) -> Reading[_Answer]:
        found = read_revision(reply)
        data = find_object(reply, "diagnosis", "steps")
        diagnosis = text_field(data.get("diagnosis")) if data is not None else _prose(reply)
        if not found.plans:
            if not found.none:
                return Reading(None, found.problems or (NEITHER,))
            blame = _in_the_way(self._failed)
            if blame and not self._questioned:
                self._questioned = True
                doubt = (
                    f"the record names {' and '.join(blame)}, which can be moved; if putting it in "
                    "a safe place first, or another order of the same actions, keeps the purpose, "
                    "give that plan; if not, answer again that there is none"
                )
                return Reading(None, (doubt,), NoteKind.QUESTIONED)
            return Reading(_Answer(None, diagnosis))
        grounded = ground(found.plans[-1], self._failed.start, self._names)
        reasons = list(grounded.reasons)
        if grounded.actions:
            reasons += purpose_reasons(self._failed.branch.actions, grounded.actions)
        if reasons:
            return Reading(None, tuple(reasons))
        return Reading(_Answer(grounded.actions, diagnosis))


def _in_the_way(failed: FailedStep) -> tuple[str, ...]:
    """Movable things, other than those of the action itself, that the record blames."""
    cause = failed.verdict.cause
    if cause is None or cause.kind in (CauseKind.SLIP, CauseKind.UNREACHABLE):
        return ()
    action = failed.branch.actions[failed.index]
    own = {action.target.split(".")[0], failed.record.before.holding}
    infos = failed.start.infos
    return tuple(
        name for name in cause.objects if name in infos and infos[name].movable and name not in own
    )


def _with_keepout(actions: tuple[Action, ...], failed: FailedStep) -> tuple[Action, ...]:
    """What is moved out of the way goes where the failed rollout shows that nothing hits it."""
    extras = relocated(failed.branch.actions, actions)
    result: list[Action] = []
    held = ""
    for action in actions:
        if action.verb is Verb.PICK_UP:
            held = action.target
        elif action.verb is Verb.PUT_ON and (action.safe or held in extras):
            known = held in failed.record.before.states
            discs = keepouts_of(failed, held) if known and action.target == DESK else ()
            action = replace(action, safe=True, keepout=discs)
        result.append(action)
    return tuple(result)


def _values(failed: FailedStep, instruction: str, objects: str) -> dict[str, str]:
    action = failed.branch.actions[failed.index]
    verdict = failed.verdict
    text = "no cause is on record" if verdict.cause is None else verdict.cause.text
    return {
        "instruction": instruction,
        "objects": objects,
        "catalogue": describe.catalogue(failed.start),
        "relations": describe.relations(failed.start),
        "plan": describe.numbered(failed.branch.actions),
        "number": str(failed.index + 1),
        "action": describe.written(action),
        "verdict": f"It counts as {verdict.outcome.value}: {text}.",
        "changes": describe.changes(failed.record),
        "events": describe.events(failed.record),
    }


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

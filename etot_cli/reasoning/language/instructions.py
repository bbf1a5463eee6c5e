"""From an instruction's text to a goal about a scene, or a message that helps to reword it."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import replace
from functools import partial

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.goal import Goal
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.grammar.sentences.reader import (
    UnreadableError,
    normalized,
    slips_in,
)
from etot_cli.reasoning.language.grammar.text.corrections import mark_in
from etot_cli.reasoning.language.in_hand import with_held_named
from etot_cli.reasoning.language.owners import without_owners
from etot_cli.reasoning.language.plainly import is_name, read_plainly, without_corrections
from etot_cli.reasoning.language.reference.naming.vocabulary import Vocabulary
from etot_cli.reasoning.language.viewpoint import without_viewpoint
from etot_cli.world.state import SceneState


def goal_of(instruction: str, scene: SceneState) -> Goal:
    """Reads an instruction.

    Args:
        instruction: controlled English, as described in ``docs/instructions.md``.
        scene: what it is about.

    Raises:
        InstructionError: what could not be understood and what can be done about it.
    """
    vocabulary = Vocabulary(scene)
    try:
        instruction = with_held_named(without_viewpoint(instruction, scene), scene)
    except ReferenceProblem as error:
        raise _refused(error, instruction, scene, vocabulary) from None
    said = without_owners(instruction, partial(is_name, vocabulary=vocabulary))
    text = normalized(said)
    try:
        return read_plainly(text, scene, vocabulary)
    except (UnreadableError, ReferenceProblem) as error:
        try:
            goal = _otherwise(said, text, scene, vocabulary)
        except ReferenceProblem as problem:  # beside an aside, which is not to blame
            if isinstance(error, UnreadableError):
                raise _refused(problem, instruction, scene, vocabulary) from None
            goal = None
        if goal is None:
            raise _refused(error, instruction, scene, vocabulary) from None
        return goal


def _otherwise(said: str, text: str, scene: SceneState, vocabulary: Vocabulary) -> Goal | None:
    with suppress(UnreadableError, ReferenceProblem):
        if mark := mark_in(text):
            return without_corrections(
                text, mark, lambda text: _otherwise(text, text, scene, vocabulary)
            )
        return read_plainly(normalized(said), scene, vocabulary, common=True)
    if slips := slips_in(text, vocabulary.words()):
        # Rewritings that go by a noun only find it where it is spelled as it should be
        plain = re.sub(r"[a-z]+", lambda word: slips.get(word[0], word[0]), text)
        with suppress(UnreadableError, ReferenceProblem):
            goal = read_plainly(normalized(plain), scene, vocabulary)
            notes = (f'read "{word}" as "{meant}"' for word, meant in slips.items())
            return replace(goal, notes=(*notes, *goal.notes))
    # Reading asides is a tenth of the grammar, which few instructions need.
    from etot_cli.reasoning.language.otherwise import read_otherwise

    return read_otherwise(said, scene, vocabulary)


def _refused(
    error: UnreadableError | ReferenceProblem,
    instruction: str,
    scene: SceneState,
    vocabulary: Vocabulary,
) -> InstructionError:
    # Nor does an instruction that is read need what finds other words for it.
    from etot_cli.reasoning.language.refusing import refusal

    return InstructionError(refusal(error, instruction, scene, vocabulary))

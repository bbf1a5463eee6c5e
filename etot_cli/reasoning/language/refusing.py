"""What is said of an instruction that is not read: which words, why, and what would be read."""

from __future__ import annotations

import re
from functools import partial

from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.blame import blamed
from etot_cli.reasoning.language.goals.interpretation import interpret
from etot_cli.reasoning.language.grammar.parsers.input import MAX_WORK
from etot_cli.reasoning.language.grammar.sentences.reader import UnreadableError, normalized, read
from etot_cli.reasoning.language.grammar.text.corrections import mark_in
from etot_cli.reasoning.language.languages import other_language
from etot_cli.reasoning.language.plainly import reads
from etot_cli.reasoning.language.reference.naming.vocabulary import Vocabulary
from etot_cli.reasoning.language.rewording import Refused, rewordings
from etot_cli.world.state import SceneState


def refusal(
    error: UnreadableError | ReferenceProblem,
    instruction: str,
    scene: SceneState,
    vocabulary: Vocabulary,
) -> str:
    """Which words, why, and one way to say it that is read in this scene."""
    joined = set(re.findall(r"\w+_\w+", vocabulary.joined(normalized(instruction))))

    def plain(text: str) -> str:
        """With labels of several words as they were written."""
        return re.sub("|".join(joined) or "$", lambda found: found[0].replace("_", " "), text)

    language = other_language(instruction, vocabulary.words())
    foreign = f"it seems to be in {language}; only English is read" if language else ""
    if isinstance(error, UnreadableError):
        error = blamed(error, partial(_in_vain, scene=scene, vocabulary=vocabulary))
        why = foreign or error.why
        head = f"cannot read the instruction at {error.words!r}" + (f": {why}" if why else "")
        second = f"  understood up to there: {error.understood or 'nothing'}"
        refused = Refused(instruction, error.words, without=error.without)
    else:
        why = foreign or error.why
        phrase = plain(error.phrase)
        head = f"cannot tell what {phrase!r} means in the instruction: {plain(why)}"
        second = f"  the sentence itself was understood: {' '.join(instruction.split())}"
        if foreign:
            second = "  understood up to there: nothing"
        refused = Refused(instruction, phrase, word=error.word, candidates=error.candidates)
    lines = [head, second]
    unclear = mark_in(normalized(instruction))  # nobody knows what of it is taken back
    ways = rewordings(refused, scene, partial(reads, vocabulary=vocabulary))
    example = None if unclear else next(ways, None)
    if example is not None:
        lines.append(f"  what would be read: {plain(example)}")
    lines.append(
        "  or write the goal as conditions under 'goal:' in the task file, or let a model read it "
        "with --reasoner vlm"
    )
    return "\n".join(lines)


def _in_vain(text: str, scene: SceneState, vocabulary: Vocabulary) -> int | None:
    """What it took to read normalized text in vain; None where it is read."""
    try:
        interpret(read(text, vocabulary.words()).sentences, scene, vocabulary)
    except UnreadableError as error:
        return error.unread.effort if error.unread else MAX_WORK // 10
    except ReferenceProblem:
        return MAX_WORK // 100
    return None

"""From an instruction's text to a goal about a scene, or a message that helps to reword it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from functools import partial

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.goal import Goal, Open, Pick, Put
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.builtin.wording import formal
from etot_cli.reasoning.language.blame import blamed
from etot_cli.reasoning.language.goals.interpretation import interpret
from etot_cli.reasoning.language.goals.plausibility import plans_of
from etot_cli.reasoning.language.grammar.asides.asides import without_asides
from etot_cli.reasoning.language.grammar.asides.asking_words import BEFORE_NAMES
from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED
from etot_cli.reasoning.language.grammar.sentences.reader import UnreadableError, normalized, read
from etot_cli.reasoning.language.grammar.text.corrections import mark_in, taken_back
from etot_cli.reasoning.language.grammar.text.splitting import QUESTION, sentences_of, words_in
from etot_cli.reasoning.language.languages import other_language
from etot_cli.reasoning.language.owners import without_owners
from etot_cli.reasoning.language.reference.naming.vocabulary import Vocabulary
from etot_cli.reasoning.language.rewording import Refused, rewordings
from etot_cli.reasoning.language.start_told import without_start
from etot_cli.reasoning.language.viewpoint import without_viewpoint
from etot_cli.reasoning.language.words import manner, verbs
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import OTHER_VERBS, VERB_WORDS, opening_words
from etot_cli.reasoning.language.words.lexicon import (
    DESK_NOUNS,
    LEVELS,
    NUMBERS,
    singular,
    word_set,
)
from etot_cli.reasoning.language.words.nouns import STACK
from etot_cli.reasoning.language.words.patterns import spellings, words_of
from etot_cli.reasoning.protocol import ReasonerStopped
from etot_cli.world.state import OPEN_AT, SceneState

_HEADING = re.compile(r"([^.:;!?\n]+):\s+(\S.*)", re.DOTALL)
_POLITE = Expression(rf"^(?:kindly )?{ASKED}(?:kindly )?")
_TABLE_SET = Expression(
    r"((?:please )?(?:set|lay) the table(?: for [^,.:;!?\n]+)?)[,.]\s+(\S.*)",
    re.IGNORECASE | re.DOTALL,
)
"""Says nothing of what is to stand where, which comes next."""
_DEPENDING = word_set(
    "if when unless once until till after before while as except without but not never no none "
    "neither nor only instead first last end then do t "
    "forbidden prohibited banned unwanted undesired avoid wrong bad current currently initial "
    "initially starting present previous old so far example optional maybe perhaps alternatively "
    "go goes belong belongs stay stays remain remains"
)
"""A heading with such a word says something of what stands below it."""
_REFERRING = word_set(
    "it its them they their these those this that one ones other others another rest else "
    "everything anything all both each every any same here there"
)
"""Below a heading they may speak of what that is about, which is not read."""
_SWEEPING = word_set("other others rest else everything anything")
"""Of a desk."""
_PUT = words_of((verbs.PUT, verbs.BRING))
_WITHIN = word_set("in on into onto inside")
"""A heading by which things are put into or onto others says where, which is to be read."""
_BUILT = words_of((verbs.BUILD,)) - {"them"} | {"on", "in", "onto"}
"""With "stack" they say what is to become of things."""
_ALSO_VERBS = frozenset({"open", "please", "first", "empty", "free", "you"})
"""They begin a request, too, though things are told by them."""
_DECLARED = word_set("is are sits sit stands stand lies lie rests rest")
_OF_ITS_OWN = Expression(
    r"(?:\b(?:all|both|each|every|any)(?: of)? (?=the\b)"
    r"|(?<= )(?:all|both) (?=(?:go|are|should|belong|must|need)\b)"
    r"|(?:when|once|after) (?:you have done (?:that|this|it)|(?:that|this) is done)\b)"
)
"""Such words before a noun, or between that and its verb, speak of what it names, or of what was
asked for before.
"""


_OF_SEVERAL_PARTS = Expression(
    r"^(?:(?!\bone\b).)*\b(?:board|drawer|shelf|level|compartment)\b"
    rf"(?:(?!\bone\b).|\b(?:{'|'.join(LEVELS)}) one\b)*$"
)
"""After a part was named "the upper one" is another one of these."""


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
        instruction = without_viewpoint(instruction, scene)
    except ReferenceProblem as error:
        raise InstructionError(_message(error, instruction, scene, vocabulary)) from None
    said = without_owners(instruction, partial(_is_name, vocabulary=vocabulary))
    text = normalized(said)
    try:
        return _read(text, scene, vocabulary)
    except (UnreadableError, ReferenceProblem) as error:
        if mark_in(text):
            raise InstructionError(_message(error, instruction, scene, vocabulary)) from None
        with suppress(UnreadableError, ReferenceProblem):
            return _read(text, scene, vocabulary, common=True)
        with suppress(UnreadableError, ReferenceProblem):
            return _from_start(said, scene, vocabulary)
        with suppress(UnreadableError, ReferenceProblem):
            return _below_heading(said, scene, vocabulary)
        with suppress(UnreadableError, ReferenceProblem):
            return _as_end_state(text, scene, vocabulary)
        with suppress(UnreadableError, ReferenceProblem):
            return _beside_asides(said, scene, vocabulary)
        raise InstructionError(_message(error, instruction, scene, vocabulary)) from None


def _as_end_state(text: str, scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """What is said to be so, of which something is not, and nothing else: that it is to be so; what
    is "still" so is told of by now.

    Raises:
        UnreadableError, ReferenceProblem: something else is said, or all of it holds.
    """
    sentences = sentences_of(text)
    for sentence in sentences:
        first, *more = sentence.split()
        asked = first in VERB_WORDS | OTHER_VERBS or QUESTION in more
        if asked or not _DECLARED & {*more} or "still" in more:
            raise UnreadableError(sentence, "")
    goal = _read(". ".join(f"in the end {said}" for said in sentences), scene, vocabulary)
    with suppress(InstructionError, ReasonerStopped):
        if not plans_of(goal, scene, ordered=False):
            raise UnreadableError(text, "")
    note = "what is said to be so is taken for what is to be so in the end"
    return replace(goal, notes=(note, *goal.notes))


def _from_start(instruction: str, scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """What is to be so in the end, where it is told as well how things are at the start: that asks
    for nothing, and it is noted where it is not so.

    Raises:
        UnreadableError, ReferenceProblem: no start is told, or the rest is not read.
    """
    told = without_start(instruction)
    if told is None:
        raise UnreadableError(instruction, "")
    notes: list[str] = []
    for sentence in sentences_of(normalized(told.start)):
        first, *more = sentence.split()
        asks = first in VERB_WORDS | OTHER_VERBS | _ALSO_VERBS
        if asks or {"not", "no", "never", "without"} & {first, *more}:
            raise UnreadableError(sentence, "")  # it asks for, or forbids, something
        notes += [] if _holds(sentence, scene, vocabulary) else [f"not so at the start: {sentence}"]
    goal = _read(normalized(told.asked), scene, vocabulary)
    return replace(goal, notes=(*notes, *goal.notes))


def _holds(sentence: str, scene: SceneState, vocabulary: Vocabulary) -> bool:
    """Whether what is said to be so is.

    Raises:
        UnreadableError, ReferenceProblem: it is not understood.
    """
    try:
        goal = _read(f"in the end {sentence}", scene, vocabulary)
    except UnreadableError:
        goal = _read(sentence, scene, vocabulary)
    with suppress(InstructionError, ReasonerStopped):
        return not plans_of(goal, scene, ordered=False)
    return False


def _below_heading(instruction: str, scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """What a colon announces ("season the salad: put the salt next to it"), where the words before
    it ask for nothing that could be read, condition nothing and deny nothing; they are noted.

    Raises:
        UnreadableError, ReferenceProblem: there is no such heading, or nothing to read below it.
    """
    said = _HEADING.match(instruction) or _TABLE_SET.match(instruction)
    words = words_in(_POLITE.sub("", normalized(said[1]))) if said else ()
    # "A stack of three: …", "the tower on the tray: …", "make a pile: …"
    counted = {*spellings(STACK)} & {*words} and (_BUILT | {*NUMBERS}) & {*words}
    if said is None or not words or counted or _DEPENDING & {*words} or ":" in said[2]:
        raise UnreadableError(instruction, "")
    if words[0] in _PUT and _WITHIN & {*words[1:]} - {*DESK_NOUNS}:
        raise UnreadableError(instruction, "")  # "put both on the book: the pen on the left, …"
    on_desk = bool({*DESK_NOUNS} & {*words})
    named = any(_is_name(word, vocabulary) for word in words if word not in DESK_NOUNS)
    heading = words[0] in VERB_WORDS | OTHER_VERBS or words[0] not in opening_words()
    below = {*words_in(_OF_ITS_OWN.sub("", normalized(said[2])))}
    if any(_is_name(word, vocabulary) for word in {*words} & {*below, *map(_several, below)}):
        below -= {"one"}  # "bring the mugs together: put the blue mug next to the red one"
    if _OF_SEVERAL_PARTS.search(normalized(said[2])):
        below -= {"one"}  # "restock the shelf: the soup on the top board, the milk on the low one"
    if not heading or (_REFERRING if named else _SWEEPING if on_desk else set()) & below:
        raise UnreadableError(said[2], "")
    if _reads(said[1], scene, vocabulary):
        raise UnreadableError(said[1], "", "say it in a sentence of its own")
    goal = _read(normalized(said[2]), scene, vocabulary)
    note = f"{said[1].strip()!r} is a heading: what stands below it is done"
    return replace(goal, notes=(note, *goal.notes))


def _beside_asides(instruction: str, scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """What is asked for beside reasons and remarks, which are noted.

    Raises:
        UnreadableError, ReferenceProblem: there are none, or the rest is not read.
    """
    plain = without_asides(
        normalized(instruction),
        partial(_is_name, vocabulary=vocabulary),
        partial(_is_sentence, vocabulary=vocabulary),
    )
    if plain is None:
        raise UnreadableError(instruction, "")
    goal = _read(plain.text, scene, vocabulary)
    ways = ("not asked for: the rest is done", "done where it has to be")
    notes = (
        f"{_as_written(aside, instruction)!r} is {ways[aside in plain.anyway]}"
        for aside in plain.asides
    )
    return replace(goal, notes=(*notes, *goal.notes))


def _several(noun: str) -> str:
    return f"{noun}s"


def _as_written(aside: str, instruction: str) -> str:
    """An aside in the instruction's own words, so far as these are found in it."""
    begun = " ".join(aside.split()[:2])
    # What is named in a clause of its own, and not what is put somewhere in another one
    names = begun.split()[0] in BEFORE_NAMES
    own = r"(?:^|[.,:;!?\n]|\b(?:so|but|because|since|as)\b)\s*" if names else ""
    alike = rf"{own}({re.escape(begun)}\b[^.,:;!?\n]*)"
    for wanted in (f"({re.escape(aside)})", alike):
        if found := re.search(wanted, instruction, re.IGNORECASE):
            return found[1].strip()
    return aside


def _is_sentence(text: str, vocabulary: Vocabulary) -> bool:
    """Whether the grammar reads a sentence, whatever it is about."""
    with suppress(UnreadableError):
        read(vocabulary.joined(text), vocabulary.words())
        return True
    return False


def _is_name(word: str, vocabulary: Vocabulary) -> bool:
    """Whether something in the scene is called by a word."""
    called = (*DESK_NOUNS, *map(singular, vocabulary.words()))
    kind = is_category(word) and bool(vocabulary.of_category(word))
    return kind or singular(word) in called


def _read(text: str, scene: SceneState, vocabulary: Vocabulary, *, common: bool = False) -> Goal:
    """The goal of normalized text; slips of the pen in words that stand in no scene are put right
    where ``common``.
    """
    if mark := mark_in(text):
        return _without_corrections(text, mark, scene, vocabulary)
    found = read(vocabulary.joined(text), vocabulary.words(), common=common)
    goal = interpret(found.sentences, scene, vocabulary)
    slips = tuple(f"read {correction}" for correction in found.corrections)
    return replace(goal, notes=(*slips, *goal.notes, *_said_with_more(text, goal)))


def _without_corrections(
    text: str, mark: re.Match[str], scene: SceneState, vocabulary: Vocabulary
) -> Goal:
    """The goal of a text with words that take something back, which is noted.

    Raises:
        UnreadableError: nothing or several things may be taken back.
    """
    found: dict[str, Goal] = {}
    for way in taken_back(text, mark):
        with suppress(UnreadableError, ReferenceProblem):
            goal = _read(way.text, scene, vocabulary)
            note = f"{way.words!r} is taken back: {way.instead!r} is said instead"
            found.setdefault(formal(goal), replace(goal, notes=(note, *goal.notes)))
    if len(found) != 1:
        ways = " or ".join(goal.notes[0].partition(" is taken")[0] for goal in found.values())
        why = f"it may take back {ways}" if ways else "it is unclear what that takes back"
        raise UnreadableError(mark[0].strip(" ,.!?;\n"), "", f"{why}; say it anew")
    return next(iter(found.values()))


def _said_with_more(text: str, goal: Goal) -> Iterator[str]:
    """What words that ask for more than any skill does were taken for."""
    words = " ".join(["", *re.findall(r"\w+", text), ""])
    for patterns, step, why in (
        (manner.ALL_THE_WAY, Open, f"what is open is so to {OPEN_AT:.0%} of its travel or more"),
        (verbs.TO_SOMEBODY, Pick, verbs.HELD_UP),
        ("as possible", Put, "how near or far is not measured"),
    ):
        said = [text for text in spellings(patterns) if f" {text} " in words]
        if said and any(isinstance(item, step) for item in goal.steps):
            yield f"{said[0]!r}: {why}"


def _message(
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

    language = other_language(instruction, scene)
    foreign = f"it seems to be in {language}; only English is read" if language else ""
    if isinstance(error, UnreadableError):
        error = blamed(error, partial(_fits, scene=scene, vocabulary=vocabulary))
        why = foreign or error.why
        head = f"cannot read the instruction at {error.words!r}" + (f": {why}" if why else "")
        second = f"  understood up to there: {error.understood or 'nothing'}"
        refused = Refused(instruction, error.words, without=error.without)
    else:
        why = foreign or error.why
        phrase = plain(error.phrase)
        head = f"cannot tell what {phrase!r} means in the instruction: {plain(why)}"
        second = f"  the sentence itself was understood: {' '.join(instruction.split())}"
        refused = Refused(instruction, phrase, word=error.word, candidates=error.candidates)
    lines = [head, second]
    unclear = mark_in(normalized(instruction))  # nobody knows what of it is taken back
    ways = rewordings(refused, scene, partial(_reads, vocabulary=vocabulary))
    example = None if unclear else next(ways, None)
    if example is not None:
        lines.append(f"  what would be read: {plain(example)}")
    lines.append(
        "  or write the goal as conditions under 'goal:' in the task file, or let a model read it "
        "with --reasoner vlm"
    )
    return "\n".join(lines)


def _fits(text: str, scene: SceneState, vocabulary: Vocabulary) -> bool:
    """Whether normalized text is read."""
    try:
        interpret(read(text, vocabulary.words()).sentences, scene, vocabulary)
    except (UnreadableError, ReferenceProblem):
        return False
    return True


def _reads(instruction: str, scene: SceneState, vocabulary: Vocabulary) -> bool:
    try:
        _read(normalized(instruction), scene, vocabulary)
    except (UnreadableError, ReferenceProblem):
        return False
    return True

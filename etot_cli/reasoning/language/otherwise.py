"""What an instruction asks for beside what only tells something: a start, a heading, how things
are, reasons and remarks.

Most instructions ask for all that they say, so this is not even loaded for them.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.goal import Goal
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.goals.plausibility import plans_of
from etot_cli.reasoning.language.grammar.asides.asides import only_tells, without_asides
from etot_cli.reasoning.language.grammar.asides.asking_words import BEFORE_NAMES
from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED
from etot_cli.reasoning.language.grammar.sentences.reader import UnreadableError, normalized, read
from etot_cli.reasoning.language.grammar.text.corrections import mark_in
from etot_cli.reasoning.language.grammar.text.splitting import (
    COMMA,
    QUESTION,
    sentences_of,
    words_in,
)
from etot_cli.reasoning.language.plainly import is_name, read_plainly, reads
from etot_cli.reasoning.language.reference.naming.vocabulary import Vocabulary
from etot_cli.reasoning.language.start_told import without_start
from etot_cli.reasoning.language.words import verbs
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import (
    OTHER_VERBS,
    VERB_WORDS,
    all_words,
    opening_words,
)
from etot_cli.reasoning.language.words.lexicon import (
    DESK_NOUNS,
    LEVELS,
    NUMBERS,
    SIDES,
    is_descriptive,
    is_in_lexicon,
    singular,
    word_set,
)
from etot_cli.reasoning.language.words.nouns import STACK
from etot_cli.reasoning.language.words.patterns import spellings, words_of
from etot_cli.reasoning.protocol import ReasonerStopped
from etot_cli.world.state import SceneState

_HEADING = re.compile(r"((?:\b(?:Mr|Mrs|Ms|Dr)\. |[^.:;!?\n])+):\s+(\S.*)", re.DOTALL)
_NUMBERED = Expression(r"\s*([^.:;!?\n]+)[.\n]\s*(\(?1[.)]\s+\S.*)", re.DOTALL)
"""A title before numbered steps, which a full stop may end."""
_POLITE = Expression(rf"^(?:so,? )?(?:(?:it is )?(?:high )?time (?:to|for) )?{ASKED}")
_AS_FOLLOWS = Expression(r",? as follows\s*$", re.IGNORECASE)
_TABLE_SET = Expression(
    r"((?:please )?(?:set|lay) the table(?: for [^,.:;!?\n]+)?)[,.]\s+(\S.*)",
    re.IGNORECASE | re.DOTALL,
)
"""Says nothing of what is to stand where, which comes next."""
_FOR = Expression(
    r"^((?:[Ff]or|[Ii]n preparation for) (?:the|our|my|this|(?:today|tomorrow|tonight)'s)"
    r"(?: (?:next|coming|upcoming))?((?: \w+){1,3}?))(?:, +|"
    r" (?=(?:the|my|both|all|please|put|place|set|move|open|close|shut)\b))(\S[\s\S]*)"
)
"""The same as a heading, of what no scene has ("for the next measurement the cup should …")."""
_ARRANGING = word_set(
    "prepare ready set lay make arrange organise organize pack serve stock restock "
    "fill stage assemble rearrange equip decorate form host declutter straighten gather group"
)
"""What consists of what stands below it; anything else would have to be done besides."""
_PROCEDURE = word_set("protocol procedure plan schedule steps recipe programme program routine")
_IS_DONE = Expression(
    r"\b((?:first|then|afterwards?|finally|lastly|next|after that),? (?:the|my|both|all|it|they)\b"
    r"[^.,;:!?]*?) (is|are) (?=(?:put|placed|set|laid|moved|taken|brought|opened|closed|shut|picked"
    r"|transferred|stored|stacked|lifted|removed|returned|emptied)\b)"
)
"""In a procedure, and its order, this says what is to be done."""
_DEPENDING = word_set(
    "if when unless once until till after before while as except without but not never no none "
    "neither nor only instead first last end then do t "
    "forbidden prohibited banned unwanted undesired avoid wrong bad current currently "
    "initial original initially starting present previous yesterday old so far example "
    "optional maybe perhaps alternatively "
    "go goes belong belongs stay stays remain remains reverse reversed cancel cancelled canceled "
    "undo void rejected completed finished done skip skipped postponed deferred obsolete omitted "
    "mistake mistakes error errors else"
)
"""A heading with such a word says something of what stands below it."""
_REFERRING = word_set(
    "it its them they their these those this that one ones other others another rest else "
    "everything anything all both each every any same here there"
)
"""Below a heading they may speak of what that is about, which is not read."""
_SWEEPING = word_set("other others rest else everything anything")
"""Of a desk."""
_JOBS = word_set(
    "order orders job jobs task tasks work list procedure instruction instructions shift change "
    "routine ticket assignment"
)
"""A heading that ends so only says that something is to be done."""
_PLAN = Expression(
    r"^(?:(?:so|ok|okay|right|now|well|then),? )*(?:(?:here|this|that) (?:is|'s) )?"
    r"(?:the|my|our|today 's|tonight 's) (?:\w+ )?(?:plan|arrangement|set ?up|layout|line ?up"
    r"|list|programme|program|agenda|scheme)(?P<purpose> for [^,]+)?$"
)
"""Likewise, whatever that is for."""
_CODE = r"[a-z]{1,12}(?:\.? ?(?:no\.? ?|number |#)?|-)\d[\w./-]*"
_REFERENCE = Expression(
    r"(?P<before>^\s*|[.!?;\n]\s+)"
    r"(?P<said>(?P<by>(?:as )?per |according to |in accordance with )?"
    rf"{_CODE}(?:,? {_CODE})*)\s*(?(by)[:,]|(?::|,(?=[^,.;:!?\n]+:)))\s+(?=\w)",
    re.IGNORECASE,
)
"""Which item of a document sentences are ("Item 4.1: …", "Per SOP-014, section 3.2, …")."""
_CODED = _JOBS | word_set("item step as per according to in accordance with no number")
"""Words of it that may begin a request as well; no others do."""
_LASTING = word_set(
    "moment second seconds minute minutes hour hours day days week weeks while long later"
)
_PUT = words_of((verbs.PUT, verbs.BRING))
_DONE_TO = VERB_WORDS & (
    _PUT | words_of((verbs.PICK, verbs.REMOVE, verbs.OPEN, verbs.CLOSE, verbs.TURN))
)
"""What is done to things that are named; where these are not spoken of below, it is left undone."""
_WITHIN = word_set("in on into onto inside")
"""A heading by which things are put into or onto others says where, which is to be read."""
_BUILT = words_of((verbs.BUILD,)) - {"them"} | {"on", "in", "onto"}
"""With "stack" they say what is to become of things."""
_ALSO_VERBS = frozenset({"open", "please", "first", "empty", "free", "you"})
"""They begin a request, too, though things are told by them."""
_DECLARED = word_set("is are sits sit stands stand lies lie rests rest")
_VERBLESS = Expression(
    r"\b((?:(?!and\b|is\b|are\b|not\b)\w+ )+?)"
    r"(?=(?:open|closed|shut|empty)(?:$|,| and\b)|(?:in|on|inside) )"
)
"""How something is, without a verb."""
_OF_ITS_OWN = Expression(
    r"(?:\b(?:all|both|each|every|any)(?: of)? (?=the\b)"
    r"|(?<= )(?:all|both) (?=(?:go|are|should|belong|must|need)\b)"
    r"|(?:when|once|after) (?:you have done (?:that|this|it)|(?:that|this) is done)\b)"
)
"""Such words before a noun, or between that and its verb, speak of what it names, or of what was
asked for before.
"""


_IF = r"\b(?:if|unless|provided|when|once|until|till|while|as long as)\b"
_OF_SEVERAL_PARTS = Expression(
    r"^(?:(?!\bone\b).)*\b(?:board|drawer|shelf|level|compartment)\b"
    rf"(?:(?!\bone\b).|\b(?:{'|'.join(LEVELS)}) one\b)*$"
)
"""After a part was named "the upper one" is another one of these."""


def read_otherwise(instruction: str, scene: SceneState, vocabulary: Vocabulary) -> Goal | None:
    """The goal of an instruction, some of whose words only tell something; None where no way to
    leave them out leads to one.

    Raises:
        ReferenceProblem: the rest is understood, but not what it is about.
    """
    ways = (_below_references, _from_start, _below_heading, _as_end_state, _beside_asides)
    problem: ReferenceProblem | None = None
    for way in ways[-1:] if mark_in(normalized(instruction)) else ways:
        try:
            return way(instruction, scene, vocabulary)
        except UnreadableError:
            continue
        except ReferenceProblem as error:
            problem = error
    try:
        if problem:
            raise problem
    finally:
        problem = None  # an error that its own frame holds is freed late, with all that holds it
    return None


def _below_references(instruction: str, scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """What stands behind codes of orders, items and the like, which are noted; they are no things
    of the scene, and told in their order.

    Raises:
        UnreadableError, ReferenceProblem: there are none, or the rest is not read.
    """
    said = [found["said"] for found in _REFERENCE.finditer(instruction)]
    words = {word for code in said for word in re.findall(r"[a-z]+", code.casefold())}
    codes = [[int(part) for part in re.findall(r"\d+", code)] for code in said]
    asking = words & (opening_words() | _DEPENDING) - _CODED
    things = any(
        is_name(word, vocabulary) or is_category(word) or is_in_lexicon(word)
        for word in words - _CODED
    )
    if not said or asking or things or codes != sorted(codes):
        raise UnreadableError(instruction, "")
    rest = _REFERENCE.sub(lambda found: found["before"], instruction)
    goal = _anyhow(rest, scene, vocabulary)
    notes = (f"{code!r} is a heading: what stands below it is done" for code in said)
    return replace(goal, notes=(*notes, *goal.notes))


def _anyhow(text: str, scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """What is asked for below a heading, where something may be told as well.

    Raises:
        UnreadableError, ReferenceProblem: it is not read.
    """
    try:
        return read_plainly(normalized(text), scene, vocabulary)
    except UnreadableError:
        if (found := read_otherwise(text, scene, vocabulary)) is None:
            raise
        return found


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
    start = [*sentences_of(normalized(told.start))]
    for sentence in start:
        first, *more = sentence.split()
        asks = first in VERB_WORDS | OTHER_VERBS | _ALSO_VERBS
        if asks or {"not", "no", "never", "without"} & {first, *more}:
            raise UnreadableError(sentence, "")  # it asks for, or forbids, something
        if not _holds(sentence, scene, vocabulary):
            if told.is_condition:
                raise ReferenceProblem(sentence, "that is not so, and may be what all hangs on", 4)
            notes.append(f"not so at the start: {sentence}")
        elif told.is_condition:
            notes.append(f"{sentence!r}: that is so")
    try:
        goal = read_plainly(normalized(told.asked), scene, vocabulary)
    except ReferenceProblem:
        if notes and not told.is_condition:
            raise
        # "Start: the pen is in the top drawer. Goal: it is in the lower one, both drawers closed"
        named = (_VERBLESS.sub(r"\1is ", sentence) for sentence in start)
        goal = read_plainly(". ".join((*named, normalized(told.asked))), scene, vocabulary)
    return replace(goal, notes=(*notes, *goal.notes))


def _holds(sentence: str, scene: SceneState, vocabulary: Vocabulary) -> bool:
    """Whether what is said to be so is.

    Raises:
        UnreadableError, ReferenceProblem: it is not understood.
    """
    try:
        goal = read_plainly(f"in the end {sentence}", scene, vocabulary)
    except UnreadableError:
        goal = read_plainly(sentence, scene, vocabulary)
    with suppress(InstructionError, ReasonerStopped):
        return not plans_of(goal, scene, ordered=False)
    return False


def _below_heading(instruction: str, scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """What a colon announces ("set the table: put the salt next to it"), where the words before
    it ask for nothing that could be read, condition nothing and deny nothing; they are noted.

    Raises:
        UnreadableError, ReferenceProblem: there is no such heading, or nothing to read below it.
    """
    said = _HEADING.match(instruction) or _TABLE_SET.match(instruction)
    title = None if said else _NUMBERED.match(instruction)
    said = said or title
    if said is None and (found := _FOR.match(instruction)):
        strange = [word.casefold() for word in found[2].split()]
        if not any(word in all_words() or is_name(word, vocabulary) for word in strange):
            said = re.match(rf"({re.escape(found[1])}),? +(\S.*)", instruction, re.DOTALL)
    words = words_in(_POLITE.sub("", normalized(_AS_FOLLOWS.sub("", said[1])))) if said else ()
    # "A stack of three: …", "the tower on the tray: …", "make a pile: …"
    counted = {*spellings(STACK)} & {*words} and (_BUILT | {*NUMBERS}) & {*words}
    if said is None or not words or counted or _DEPENDING & {*words} or ":" in said[2]:
        raise UnreadableError(instruction, "")
    if words[0] in _PUT and _WITHIN & {*words[1:]} - {*DESK_NOUNS}:
        raise UnreadableError(instruction, "")  # "put both on the book: the pen on the left, …"
    on_desk = bool({*DESK_NOUNS} & {*words})
    named = any(is_name(word, vocabulary) for word in words if word not in DESK_NOUNS)
    # "Wipe the table: …", "polish up the cups: …", "clean the cup: …" are something else to do.
    if named and words[:1] == ("clean",) and words[1:2] != ("up",):
        raise UnreadableError("clean", "")
    parts = word_set("up down off out" if words[0] in OTHER_VERBS else "up down")
    deed = {*words[1:2]} & (BEFORE_NAMES | parts) and words[0] not in BEFORE_NAMES
    for joint, verb, behind in zip(words, words[1:], words[2:], strict=False):
        if joint in ("and", "then", COMMA) and (
            verb in OTHER_VERBS or (behind in BEFORE_NAMES and verb not in BEFORE_NAMES)
        ):
            raise UnreadableError(verb, "")  # "prepare the bench and label the cups: …"
    heading = words[0] in VERB_WORDS | _ARRANGING or (
        not deed and (words[0] in OTHER_VERBS or words[0] not in opening_words())
    )
    what = words[: words.index("for")] if "for" in words[1:] and not named else words
    job = {*what[-1:]} <= _JOBS and not {"by", "with", *_WITHIN} & {*words}
    if title and (named or not job or BEFORE_NAMES & {*what[1:]}):
        raise UnreadableError(said[1], "")  # "Wear gloves. 1. …", "Wipe the list. 1. …" ask for it
    planned = _PLAN.match(normalized(said[1])) if not named else None
    heading |= planned is not None and _is_purpose(words_in(planned["purpose"] or ""))
    heading |= job or (words[0] == "for" and not named and _is_purpose(words))
    below = {*words_in(_OF_ITS_OWN.sub("", normalized(said[2])))}
    spoken = {*map(singular, below), *DESK_NOUNS}
    if words[0] in _DONE_TO and any(
        is_name(word, vocabulary) and not (is_category(word) or singular(word) in spoken)
        for word in words
    ):
        raise UnreadableError(said[1], "")  # "pick up the cup: open the drawer"
    if any(is_name(word, vocabulary) for word in {*words} & {*below, *map(_several, below)}):
        below -= {"one"}  # "bring the mugs together: put the blue mug next to the red one"
    if _OF_SEVERAL_PARTS.search(normalized(said[2])):
        below -= {"one"}  # "restock the shelf: the soup on the top board, the milk on the low one"
    if not heading or (_REFERRING if named else _SWEEPING if on_desk else set()) & below:
        raise UnreadableError(said[2], "")
    if reads(said[1], scene, vocabulary):
        raise UnreadableError(said[1], "", "say it in a sentence of its own")
    asked = said[2]
    if _PROCEDURE & {*words}:
        asked = _IS_DONE.sub(r"\1 \2 to be ", normalized(asked))
    goal = _anyhow(asked, scene, vocabulary)
    note = f"{said[1].strip()!r} is a heading: what stands below it is done"
    return replace(goal, notes=(note, *goal.notes))


def _is_purpose(words: Sequence[str]) -> bool:
    """Whether "for …" says what all is done for ("for tomorrow's run"), not of which things it is
    said ("for the red ones"), nor for how long.
    """
    told = {*SIDES, *LEVELS, *NUMBERS, *_REFERRING, *_LASTING, *spellings(STACK)}
    return not told & {*words} and not any(map(is_descriptive, words))


def _as_end_state(instruction: str, scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """What is said to be so, of which something is not, and nothing else: that it is to be so; what
    is "still" so is told of by now.

    Raises:
        UnreadableError, ReferenceProblem: something else is said, or all of it holds.
    """
    sentences = sentences_of(normalized(instruction))
    for sentence in sentences:
        first, *more = sentence.split()
        asked = first in VERB_WORDS | OTHER_VERBS or QUESTION in more
        if asked or not _DECLARED & {*more} or "still" in more:
            raise UnreadableError(sentence, "")
    goal = read_plainly(". ".join(f"in the end {said}" for said in sentences), scene, vocabulary)
    with suppress(InstructionError, ReasonerStopped):
        if not plans_of(goal, scene, ordered=False):
            raise UnreadableError(instruction, "")
    note = "what is said to be so is taken for what is to be so in the end"
    return replace(goal, notes=(note, *goal.notes))


def _beside_asides(instruction: str, scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """What is asked for beside reasons and remarks, which are noted.

    Raises:
        UnreadableError, ReferenceProblem: there are none, or the rest is not read.
    """
    text = normalized(instruction)
    named = partial(is_name, vocabulary=vocabulary)
    if mark := mark_in(text):
        if not only_tells(text[: mark.start()], named):
            raise UnreadableError(instruction, "")
        if "never mind" in mark[0]:  # of what was but told
            text = f"{text[: mark.start()]}. {text[mark.end() :]}"
    plain = without_asides(text, named, partial(_is_sentence, vocabulary=vocabulary))
    if plain is None:
        raise UnreadableError(instruction, "")
    for aside in plain.asides:
        if re.search(rf"{_IF}[^.,:;!?]*? (?:and|or) {re.escape(aside)}", normalized(instruction)):
            raise UnreadableError(aside, "")  # what is asked for hangs on it, too
    goal = read_plainly(plain.text, scene, vocabulary)
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
    # "It is late", written "it's late", is not the end of "leave it where it is"
    begun = " ".join(aside.split()[: 3 if aside.startswith("it is ") else 2])
    # What is named in a clause of its own, and not what is put somewhere in another one
    names = begun.split()[0] in BEFORE_NAMES
    own = r"(?:^|[.,:;!?\n]|\b(?:so|but|because|since|as)\b)\s*" if names else ""
    alike = rf"{own}({re.escape(begun)}\b(?:(?<= [md]r)\. |(?<= m[rs]s)\. |[^.,:;!?\n])*)"
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

"""Words by which a clause may ask for something, and by which it names something of the scene."""

from __future__ import annotations

from collections.abc import Callable

from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import LINKS, OTHER_VERBS, VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    NUMBERS,
    SIDES,
    STATES,
    THING_NOUNS,
    word_set,
)

IsName = Callable[[str], bool]
"""Whether something in the scene is called by a word."""
PROPOSING = word_set(
    """
    suggest recommend propose expect insist demand require request vote choose pick say says tell
    ask beg advise order urge bet mean means vote count rely trust
    """
)
"""What somebody does who asks for something in a roundabout way."""
BIDDING = PROPOSING | word_set(
    """
    asked agreed having decided chosen chose ordered promised arranged suggested recommended voted
    told warned instructed let lets letting
    """
)
"""The same of what he has done or is doing ("we agreed on the cup")."""
ASKING = word_set(
    """
    want wants need needs wanted needed wish like prefer should must shall would could may let ought
    go goes belong belongs hoping wondering please not never no none nothing without if
    unless when until instead except only
    """
)
DECREEING = word_set(
    """
    forbid forbids forbidden prohibit prohibits prohibited ban bans banned bar bars barred taboo
    reserved reserve reserves allow allows allowed permit permits permitted require requires
    required excluded exclude excludes exempt limits bounds mandatory obligatory demands prevents
    prevent avoid avoids deserve deserves await awaits insists expects protected
    """
)
"""Words by which things are ruled out, or meant for something."""
CHANGING = word_set(
    """
    stay stays remain remains live lives come comes join joins move moves leave leaves open opens
    close closes shut shuts swap swaps switch switches return returns replace replaces change
    changes fit fits follow follows end ends better to by than
    """
)
"""What a thing does that somebody asks for, and words before such things."""
DOING = {
    verb
    for verb in VERB_WORDS
    if VERB_WORDS & {f"{verb}ing", f"{verb[:-1]}ing", f"{verb}{verb[-1]}ing"}
} | {"open", "shut", "empty"}
"""What the robot could be asked to do."""
WORK = DOING - {"clean", "tidy"}
"""Those that say nothing else of a thing."""
_ASKED = Expression(rf"\b(?:and|but|then|please) (?:\w+ )?(?:{'|'.join(sorted(DOING))})\b")
REFERRING = word_set(
    "it they them this that these those one ones two three other others another rest everything "
    "anything all both each every any same here there first last which whichever whatever whoever"
)
"""They may speak of what was asked for ("one of them is enough")."""
NO_STRANGERS = (
    REFERRING | LINKS | VERB_WORDS | OTHER_VERBS | {*STATES, *LEVELS, *SIDES, *NUMBERS}
    | {*THING_NOUNS}
)  # fmt: skip
"""None of these is a thing that no scene has."""
BEFORE_NAMES = word_set("the a an my your our his her their this that these those both all")
AS_WELL = word_set("too also well likewise next please ditto instead there then upside")
"""Behind what something is asked for once more ("the spare keys too")."""
PLACED = word_set("in on into onto at next beside near off out")


PLACING = word_set(
    """
    sit stand lie rest hang lean perch nest nestle reside dwell live go come belong get take hold
    contain house accommodate carry store serve count need crown top line flank lead
    """
)
"""What a thing does that is somewhere, or holds something."""


def is_placing(verb: str) -> bool:
    """Whether a verb may say where something is, or is to be, or what it is to hold."""
    stems = {verb, verb.removesuffix("s"), verb.removesuffix("es")}
    return bool((PLACING | WORK | CHANGING) & stems)


def is_doing(word: str) -> bool:
    """Whether a word says what the robot could be asked to do."""
    return word in DOING


def asks_besides(said: str) -> bool:
    """Whether something is asked for behind what is told ("because I need it and put it …")."""
    return bool(_ASKED.search(said))


PRONOUNS = word_set("it they them that this those these he him she her")

"""Whether a whole sentence is but talk: it names nothing of the scene, calls for nothing, and tells
something of people, the weather or what is elsewhere.

A request is about things of the scene. A sentence with a subject and a verb that names none of them
asks for nothing unless somebody wishes or bids by it, or it speaks to the robot.
"""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.asides.asking_words import (
    ASKING,
    BEFORE_NAMES,
    BIDDING,
    CHANGING,
    DECREEING,
    PLACED,
    REFERRING,
    WORK,
    IsName,
    asks_besides,
)
from etot_cli.reasoning.language.grammar.asides.facts import (
    BEFORE_SUBJECT,
    HOLDING_TRUE,
    is_past,
)
from etot_cli.reasoning.language.grammar.asides.people import PEOPLE
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import OTHER_VERBS, VERB_WORDS, all_words
from etot_cli.reasoning.language.words.lexicon import NUMBERS, word_set

_PERSON = Expression(rf"(?:{PEOPLE}|they) ")
_WEATHER = Expression(
    r"it (?:(?:has been|was|is|will be|always|really|just|only|soon) )*"
    r"(?:rain|snow|pour|freez|thunder|hail|drizzl|gets?|grows?|got|grew)\w*\b"
)
_FINITE = word_set(
    """
    is are am has have does did do will can could might says took left kept lay rang paid
    smells looks feels sounds seems tastes means takes costs
    """
)
"""Verbs that a subject goes before, and no list of things."""
_AUXILIARIES = word_set(
    "is are was were am has have had does did do will can could might been not never always usually"
)
_CALLING = (
    (ASKING - word_set("not never no none nothing if when until could only go goes would like"))
    | BIDDING
    | DECREEING
    | (
        CHANGING
        - word_set("come comes to by than better leave leaves end ends stay stays live lives")
    )
    | word_set("you your robot slowly quickly carefully gently fancy fancies require seek after")
)
"""Of a sentence with one of these nothing is passed over."""


def is_talk(sentence: str, is_name: IsName) -> bool:
    """Whether this is what a sentence is.

    Args:
        sentence: normalized, with commas as words of their own.
        is_name: whether something in the scene is called by a word.
    """
    words = sentence.split()
    said = BEFORE_SUBJECT.sub("", sentence)
    named = any(map(is_name, (word for word in words if word != "can")))
    if named or _CALLING & {*words} or asks_besides(said):
        return False
    return _tells(said)


def _tells(said: str) -> bool:
    """Whether a clause has a subject that is no thing of the scene, and a verb."""
    if found := _PERSON.match(said):
        return _is_no_deed(said[found.end() :].split())
    if _WEATHER.match(said) or said.startswith(("there is ", "there was ", "there are ")):
        return True
    first, *more = said.split() or [""]
    verbs = [word for word in more[:5] if word in _FINITE or is_past(word)]
    if first in BEFORE_NAMES:  # "the club is meeting tonight", and not "the spare keys"
        at = next((at for at, word in enumerate(more[:5]) if word in verbs), 0)
        placed = more[at] in ("is", "are") and {*more[at + 1 : at + 2]} & PLACED
        return at > 0 and not placed and more[at - 1] not in all_words()
    stranger = first not in all_words() and first not in NUMBERS
    return stranger and bool(more) and (more[0] in _FINITE or is_past(more[0]) or _does(more[0]))


def _is_no_deed(did: list[str]) -> bool:
    """Whether somebody does something else than what the robot may be to do ("we open at nine"),
    and holds nothing of what was spoken of ("I like them clean").
    """
    first = next((word for word in did if word not in _AUXILIARIES), "with")
    if first == "with":  # "I could do with a pen"
        return False
    if first in HOLDING_TRUE and (REFERRING | {"that"}) & {*did}:
        return False
    going_on = first.endswith("ing") and did[0] in ("am", "is", "are", "was", "were")
    return going_on or first not in (WORK | VERB_WORDS) - OTHER_VERBS - {"hand", "get", "back"}


def _does(word: str) -> bool:
    return word.endswith("s") and not word.endswith("ss") and word not in VERB_WORDS

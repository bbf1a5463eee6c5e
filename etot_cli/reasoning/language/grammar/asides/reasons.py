"""Whether a clause behind "so", "because", "or" or "which" tells but why something is asked for."""

from __future__ import annotations

import re

from etot_cli.reasoning.language.grammar.asides.asking_words import (
    ASKING,
    CHANGING,
    DOING,
    PLACED,
    WORK,
    IsName,
)
from etot_cli.reasoning.language.grammar.asides.facts import verb_of_stranger
from etot_cli.reasoning.language.grammar.asides.mishaps import befalls
from etot_cli.reasoning.language.grammar.asides.people import PEOPLE, is_of_people
from etot_cli.reasoning.language.grammar.asides.remarks import is_remark
from etot_cli.reasoning.language.grammar.asides.told_of_things import is_idle, told_of_thing
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.fillers import TURNED
from etot_cli.reasoning.language.words.known import OTHER_VERBS, VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import STATES, word_set

_GONE_WRONG = Expression(r" (?:go|goes) (?:out|off|wrong|bad|missing|cold|home)$")
_A_PLACE = Expression(r"\b(the|our|my|this|that) place\b")
"""Which is no verb here."""
_THING = r"(?:the|my|our|its|their) (?:\w+ )?\w+"
_SO_OF_ITSELF = Expression(
    rf"^{_THING} (?:(?:stays?|keeps?|remains?) (?:warm|cold|cool|dry|fresh|clean|safe)"
    rf"|(?:do|does|will) not (?:get|go|turn) (?:{TURNED}))$"
)
_SO_IT_CAN = Expression(
    rf"^(?:it|they|{_THING}) (?:(?:can|could|will|may|might) (?:then )?"
    r"(?:be (?:closed|shut|opened)|close|shut|open|fit)|closes|shuts|fits)(?: again| properly)?$"
)
_SO_PEOPLE = Expression(
    rf"^{PEOPLE} (?:can|could|may|might|will|do|does|would|have|has|need not)\b"
)
_ENABLED = word_set("can could may might will do does would")
_THREATENED = word_set("will might may")
_SERVING = word_set("do serve suffice work fit go stay")
"""What something else may do in place of what was named ("or the crate will do")."""
_BEING = word_set("be stand sit lie rest stay remain go end come move open close")
"""What a stranger is enabled to do asks for nothing, unless it is to be somewhere."""
_NEEDED = word_set("need needs want wants use uses like likes")
_HOME = Expression(
    r"(?:it|they) (?:(?:always|really|usually) )?"
    r"(?:belongs?|goes?|lives?|should (?:be|have been)(?: all along| since [^~]+)?)"
)
_SO_NOTHING = Expression(
    r"^(?:(?:it|they) (?:stays?|keeps?|remains?) (?!open$|closed$|shut$|put$)\w+"
    r"(?: from (?:the )?\w+(?: (?:and|or) \w+)?)?"
    r"|nothing (?:gets|can get|is|will be) (?:lost|broken|spilt|spilled|wet|dirty)"
    r"|(?:nobody|no one) [^~]+"
    r"|(?:it|they) (?:do|does|will|can|could|would) not (?:roll|fall|tip|spill|break|get|slip|slide"
    r"|cool|wobble|leak|melt|dry|rot|topple|burn|lie (?:around|about))\b[^~]*)$"
)
_OR_WILL = Expression(rf"^(?:{PEOPLE}|it|they) \w+")
_COMMENT = Expression(r"^(?:is|are|was|were|has|have) ")


def is_purpose(said: str, is_name: IsName, *, where: bool = False) -> bool:
    """Whether this tells what is to be gained, behind "so" ("I can see it") or ``where``."""
    named = any(map(is_name, said.split()))
    if where:
        home = _HOME.fullmatch(said)
        return bool(_SO_PEOPLE.match(said) or home) and not named
    if _SO_PEOPLE.match(said) or (_SO_NOTHING.match(said) and not named):
        return True
    verb = verb_of_stranger(said, is_name, _ENABLED)
    if verb == 1 or (verb and not (named or _BEING & {*said.split()})):
        return True  # "so that Ann can find it", "so the ants do not get in"
    if _SO_OF_ITSELF.match(said) or is_made_possible(said):
        return True
    told_of = told_of_thing(said, is_name)
    return bool(told_of and re.search(r" (?:is|are|looks?|seems?|feels?) ", said))


def is_made_possible(said: str) -> bool:
    """Whether this tells, behind "so that", what can be done then ("the drawer can be closed")."""
    return bool(_SO_IT_CAN.match(said))


def is_warning(said: str, is_name: IsName) -> bool:
    """Whether this tells, behind "or", what else would happen ("it will fall")."""
    will = verb_of_stranger(said, is_name, _THREATENED)
    serves = {*said.split()[will + 1 : will + 2]} & _SERVING
    return befalls(said) or (
        bool(_OR_WILL.match(said) or (will and not serves))
        and not (DOING - {"get"} | ASKING - {"will", "would", "not"}) & {*said.split()}
    )


def is_comment(said: str, is_name: IsName) -> bool:
    """Whether a relative clause behind a comma tells nothing apart ("which is fragile")."""
    if is_of_people(said):
        return is_remark(said, is_name) and not any(map(is_name, said.split()))
    return bool(_COMMENT.match(said)) and is_idle(said, is_name)


_FOR_DOING = Expression(r" for \w+ing$")
_YOU_DO = Expression(r"^you (?:then )?(\w+)")
_IS_OPEN = Expression(
    rf"(?:it|they|{_THING}) (?:is|are|stands?)(?: (?:still|already|now|currently|just|wide|half))* "
    r"(?:open|closed|shut|ajar)"
)


def is_reason(said: str, is_name: IsName) -> bool:
    """Whether this may stand behind "because" and asks for nothing itself."""
    if _IS_OPEN.fullmatch(said):
        return True
    said = _FOR_DOING.sub("", said)
    said = _A_PLACE.sub(r"\1 spot", _GONE_WRONG.sub(" fails", said))
    words = {*said.split()}
    asked = _YOU_DO.match(said)  # "even if you have to move it" asks for nothing
    if asked and asked[1] in VERB_WORDS - OTHER_VERBS - {"have"} and any(map(is_name, words)):
        return False  # "as you move the cup over there, keep it upright"
    if "going" in words and PLACED & words and any(map(is_name, words)):
        return False  # "as it is going in the box"
    needed = "to" not in words and not any(word.endswith("ing") for word in words)
    if not (is_of_people(said) or (needed and verb_of_stranger(said, is_name, _NEEDED))):
        return not (ASKING | CHANGING - {"to", "by", "than"} | WORK) & words
    wanted = {"want", "wants", "like", "prefer", "need", "needs"} & words
    return not (wanted and (PLACED | {*STATES}) & words and any(map(is_name, words)))

"""Whether a clause leaves something open, wonders at how things are, tells what somebody is about
to do, or calls for what is done anyway where it has to be: none of them asks for anything.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from etot_cli.reasoning.language.grammar.remarks import (
    ASKING,
    PLACED,
    REFERRING,
    IsName,
    asks_besides,
)
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS

_I = r"(?:i|we)"
_NOT_CARING = (
    rf"(?:{_I} (?:really )?do not (?:really |much )?(?:care|mind)(?: much)?"
    r"|it (?:really )?does not (?:really )?matter|no matter"
    r"|it is (?:not important|unimportant|up to you|your choice|all the same)"
    r"|it makes no difference)(?: to (?:me|us))?"
)
_NO_MATTER = (
    r"(?:(?:does|do) not (?:really )?matter(?: much| at all)?"
    r"|(?:is|are) (?:not important|unimportant|irrelevant|up to you|your choice|all the same)"
    r"|makes? no difference)(?: to (?:me|us))?"
)
_WORDS = r"(?: (?!(?:not|only|never|no|but|except|unless|if|than|instead|and|or)\b)[^ ~]+)"
"""What is left open with another word may be half of what is asked for."""
_WHAT = (
    rf"(?:(?:where|how){_WORDS}+|how|(?:in )?(?:what|which) order{_WORDS}*"
    rf"|(?:what|which) (?:\w+ ){{0,3}}?(?:it|they|you)\b{_WORDS}*"
    r"|which(?: one| of (?:them|these|those|the \w+))?"
    rf"|what (?:happens to|becomes of){_WORDS}+|whether(?! you\b| i\b| we\b){_WORDS}+)"
)
_MANNER = r"(?:grasp|grip|pose|orientation|order|way)"
_LEFT_OPEN = re.compile(
    rf"{_NOT_CARING}(?: {_WHAT}| which \w+)?"
    rf"|{_WHAT} {_NO_MATTER}|the (?:exact )?{_MANNER} {_NO_MATTER}"
    rf"|(?:any|either) {_MANNER} (?:is fine|is ok|is okay|will do|would do|works)"
    r"(?: (?:for|with|by) me)?"
    r"|(?:the|my|our) (?:(?!not\b)\w+ ){1,3}(?:can|may|might|could)"
    r" (?:go|be|end up|stand|lie|be put) (?:just )?(?:anywhere|wherever)(?: you (?:like|want))?"
    r"|do (?:what|as|it how|it however|whatever) you (?:like|want|please)"
)
_ANY_WILL_DO = re.compile(
    r"(?:any|either) (?:\w+ ){1,4}?(?:will do|would do|is (?:fine|ok|okay)|works)(?: for me)?"
)
_PLANNED = re.compile(
    r"(?:i|we) (?:(?:just|also|still|soon) )?(?:(?:have|need|want|would like|plan|hope) to"
    r"|(?:am|are) (?:going|about) to|will(?: have to| need to)?) (?P<did>\w+(?: [^~]+)?)$"
)
"""What somebody is about to do."""
_WONDERING = re.compile(
    r"(?:why (?:is|are|was|were|has|have|did)|how come|who (?:left|put|opened|closed|moved|took"
    r"|forgot|has left|has put|has moved|has opened|has closed))\b(?!.*\b(?:not|you)\b)"
)
_IT = r"(?:it|them|that)"
_FIRST = r"(?: (?:first|before|beforehand|before that))?"
_OUT = r"(?:out of the way|out|away|aside|to one side|off)"
_TAKE = r"(?:take|move|put|get|lift|push|bring)"
_TAKING = r"(?:taking|moving|putting|getting|lifting|pushing)"
_YOU = r"(?:(?:please|then|just|simply|you (?:can|may|could|should|must|have to)) )*"
_THING = r"(?:the|my|our) (?:\w+ ){0,3}?\w+"
_IN_THE_WAY = r"(?:is|are|gets?|stands?|happens? to be|should be) in the way"
_IF_IN_THE_WAY = re.compile(
    rf"if (?:{_THING}|it|something|anything|one of them) (?:{_IN_THE_WAY}"
    rf"(?: of (?:it|that|{_THING}))?"
    rf"|(?:blocks|obstructs|is blocking|is obstructing) (?:it|that|{_THING}))"
)
_TAKE_IT_AWAY = re.compile(rf"{_YOU}(?:{_TAKE} {_IT} {_OUT}|(?:remove|move) {_IT}){_FIRST}")
_NEEDED = (
    rf"if (?:(?:it is |that is |they are )?(?:necessary|needed|required)|you (?:need|have) to"
    rf"|(?:it|they) {_IN_THE_WAY})"
)
_MAY_HAVE_TO = "(?:may|might|could) (?:have|need) to"
_TAKEN = rf"(?:moved|taken|put|removed)(?: {_OUT})?"
_WHERE_NEEDED = re.compile(
    rf"{_YOU}(?:(?:{_TAKE}|{_TAKING}) {_THING} {_OUT}|(?:remove|removing|move|moving) {_THING})"
    rf"{_FIRST} {_NEEDED}"
    rf"|{_THING} (?:may|might|can|could) be {_TAKEN}{_FIRST} {_NEEDED}"
    rf"|(?:you {_MAY_HAVE_TO} (?:{_TAKE} {_THING} {_OUT}|(?:remove|move) {_THING})"
    rf"|{_THING} {_MAY_HAVE_TO} be {_TAKEN}){_FIRST}(?: {_NEEDED})?"
)


def is_left_open(said: str) -> bool:
    """Whether somebody does not mind what a clause is about ("i do not care where it ends up")."""
    return bool(_LEFT_OPEN.fullmatch(said))


def leaves_choice(said: str) -> bool:
    """Whether behind a clause "as long as" says what is asked for, of whatever is left open."""
    return is_left_open(said) or bool(_ANY_WILL_DO.fullmatch(said))


def is_plan(said: str, is_name: IsName) -> bool:
    """Whether somebody is about to do something himself with what is not in the scene, before "so"
    ("I have to put my lunch in the microwave").
    """
    found = _PLANNED.match(said)
    if not found or asks_besides(said):
        return False
    words = found["did"].split()
    at = next((at for at, word in enumerate(words) if word in PLACED), len(words))
    told = words[1:at]
    vague = (REFERRING | ASKING | {*THING_NOUNS}) - {"something"}
    return not (any(map(is_name, told)) or vague & {*words})


def is_wondering(sentence: str) -> bool:
    """Whether a question only wonders at how things are ("why is it still open")."""
    return bool(_WONDERING.match(sentence))


def done_where_needed(said: Sequence[str]) -> int:
    """How many of the clauses that come next call for taking away what is in the way, where it is:
    every plan does that, and nothing else with it.
    """
    if len(said) > 1 and _IF_IN_THE_WAY.fullmatch(said[0]) and _TAKE_IT_AWAY.fullmatch(said[1]):
        return 2
    return int(bool(said and _WHERE_NEEDED.fullmatch(said[0])))

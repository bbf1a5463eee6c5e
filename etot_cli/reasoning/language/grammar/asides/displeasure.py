"""Whether a clause only tells how things are that somebody does not like so, or that somebody has
left so, or what somebody asked for: a reason for what is asked of the same things next.
"""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.language.grammar.asides.people import ON_ARRIVAL_THEN, PEOPLE
from etot_cli.reasoning.language.words import verbs
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import LINKS
from etot_cli.reasoning.language.words.lexicon import STATES, word_set
from etot_cli.reasoning.language.words.patterns import words_of

_LYING = r"(?:standing|lying|sitting|hanging|rolling|gaping|wide|half|partly|slightly|still|always)"
_SO = (
    r"(?:(?:like (?:this|that)|so|that way|all (?:day|night)(?: long)?|all the time|around|about"
    r"|here|there|loose|again|everywhere|unattended))"
)


def _thing(name: str) -> str:
    """Something named, its last word in a group."""
    return rf"(?:the|that|this|my|our|an?) (?:\w+ ){{0,3}}?(?P<{name}>\w+)"


def _how(name: str) -> str:
    """How a thing is, with at least one word for it."""
    state = rf"(?P<{name}>open|closed|shut|ajar|unclosed)"
    being = r"(?: (?:is|are|stands?|being|be))?"
    return rf"(?:{being}(?=(?: \w+)+$)(?: {_LYING})*(?: {state})?(?: {_SO})*)"


_DISLIKED = Expression(
    r"(?:i|we) (?:(?:really|just|simply|absolutely) )*(?:(?:can|could) not "
    r"(?:have|stand|bear|leave|tolerate)|hate|dislike|loathe|detest|do not like|can hardly bear)"
    rf"(?: it (?:when|that|if)| how| seeing| to see| having| to have)? "
    rf"{_thing('a')}{_how('b')}"
)
_BOTHERING = Expression(
    r"it (?:(?:really|just|always) )*(?P<does>\w+s) "
    rf"(?:me|us|{PEOPLE}|my eyes)(?: (?:mad|crazy|nervous|sad|angry))? "
    rf"(?:that|when|to see|to have|how|if) {_thing('c')}{_how('d')}"
)
_BOTHERS = Expression(
    r"it is (?:the|that|this|my|our) (?:\w+ ){0,6}?(?P<o>\w+)(?P<p>) that "
    rf"(?:bothers?|annoys?|worr(?:y|ies)|disturbs?|irritates?) (?:me|us|{PEOPLE})"
)
_LEFT_SO = Expression(
    rf"(?:{PEOPLE}|they|you) (?:(?:have|has|had|just|again|always|once) )*"
    rf"(?:left|leaves?|forgot|keeps? leaving) {_thing('e')}{_how('f')}"
)
_HALF_DONE = Expression(
    rf"do not (?:just |simply )?(?:leave|keep) {_thing('i')}"
    rf"(?: (?:only|just))?(?: (?:half|partly|slightly))? "
    r"(?P<j>(?<=half )(?:open|closed|shut)|(?<=partly )(?:open|closed|shut)"
    rf"|(?<=slightly )open|ajar)(?: {_SO})*"
)
"""What is not to be left half open is opened, or closed, by what is asked for next."""
_STANDING = (
    r"(?:is|are|stands?|lies?|sits?|rests?|looks?|gets?)"
    r"(?: (?:standing|lying|sitting|resting|placed|still|again|now|just))*"
)
_VERY = (
    r"(?: (?:a (?:bit|little)|far|much|way|rather|really|quite|very|so|dangerously|precariously))*"
)
I_SAY = r"(?:i|we) (?:think|believe|find|feel|fear|notice|noticed|see|guess)(?: that)?"
_NEAR = r"(?:close to|near(?: to)?|by|at|on)"
_MISPLACED = Expression(
    rf"(?:(?:{I_SAY}) )?(?!.*\b(?:not|never|must|should|may|can|(?<!like )that)\b){_thing('k')} "
    rf"{_STANDING}{_VERY} "
    r"(?:too (?:(?:close|near|far)(?: \w+)*|\w+ (?:for|to) \w+(?: \w+)*)"
    rf"|(?:right|almost|nearly|dangerously|precariously|very|too) {_NEAR} the (?:very )?"
    r"(?:edge|rim|border|brink)(?: of (?:the|my|our) \w+)?)(?P<l>)"
)
"""Where something is not to be left, or for what it is too big."""
_MOVED_NEXT = Expression(
    r"(?:(?:please|but|and|so|just|rather|instead|then|(?:can|could|would|will) you) )*"
    r"(?:open|close|shut) (?:it|them|that)\b(?! one\b)"
)
_ASKED_FOR = Expression(
    rf"{PEOPLE} (?:(?:has|have|had|just|also|already|always|often) )*"
    rf"(?:ask(?:ed|s)? for|(?:is|are) waiting for|ordered|requested|chosen) "
    rf"(?:the|that|this|his|her|their) "
    rf"(?:(?!(?:{'|'.join(sorted(LINKS))})\b)\w+ ){{0,3}}?(?P<m>\w+)(?P<n>)"
)
"""Of what was asked for, more is said next; it is neither placed nor told from others by this."""
_HELPING = word_set(
    "helps lets makes needs wants asks tells gets keeps allows means matters is has"
)
_PARTLY = word_set("half partly slightly")
_MOVING = words_of((verbs.OPEN, verbs.CLOSE))
_PRONOUNS = word_set("it them that this those these")


def dislikes(said: str) -> bool:
    """Whether a clause tells such a thing."""
    return _found(said) is not None


def is_misplaced(said: str) -> bool:
    """Whether a clause tells where something is not to be left, or for what it is not fit."""
    return bool(_MISPLACED.fullmatch(said))


def in_state(said: str, phrase: str) -> str:
    """A phrase for the thing with how that is by now ("the open drawer"), where it is said."""
    thing, state = _found(said) or ("", "")
    before, _, named = phrase.partition(" ")
    if not state or phrase.split()[-1] != thing or {*STATES} & {*phrase.split()}:
        return phrase
    opened = state in ("open", "ajar", "unclosed") or _PARTLY & {*said.split()}
    return f"{before} {'open' if opened else 'closed'} {named}"


def is_answered(said: str, rest: Sequence[str]) -> bool:
    """Whether what is asked for besides is about the same thing, and opens or closes it where that
    is why it is not liked; else it may be asked for by this.
    """
    found = _found(said)
    if found is None:
        return True
    if _HALF_DONE.fullmatch(said):  # "…, open the other one" leaves this as it is
        return any(map(_MOVED_NEXT.match, rest[:1]))
    thing, state = found
    words = {word for text in rest for word in text.replace(",", "").split()}
    return bool((_PRONOUNS | {thing}) & words) and not (state and not _MOVING & words)


def _found(said: str) -> tuple[str, str] | None:
    """What a clause is about, and whether it says that it is open or closed."""
    said = ON_ARRIVAL_THEN.sub("", said)
    for pattern in (_DISLIKED, _BOTHERING, _BOTHERS, _LEFT_SO, _HALF_DONE, _MISPLACED, _ASKED_FOR):
        if found := pattern.fullmatch(said):
            told = found.groupdict()
            if told.get("does") in _HELPING:
                return None
            thing, state = (told[name] or "" for name in list(told)[-2:])
            return thing, state
    return None

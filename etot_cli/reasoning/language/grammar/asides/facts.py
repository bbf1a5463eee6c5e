"""Whether a clause tells a fact, which its tense shows: what happened, what is going on, what
somebody does.

Nobody asks for what has been so, nor for what goes on: a request says what to do, what is to be so,
or, in the present, where something is and how. So what is past, perfect or in progress asks for
nothing, nor does what people do that the robot cannot, whatever they do it with.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from etot_cli.reasoning.language.grammar.asides.remarks import (
    ASKING,
    BEFORE_NAMES,
    CHANGING,
    DECREEING,
    PLACED,
    PROPOSING,
    REFERRING,
    WORK,
    IsName,
    asks_besides,
    is_told_apart_by,
    somebody,
)
from etot_cli.reasoning.language.words.known import LINKS, OTHER_VERBS, VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    NUMBERS,
    SIDES,
    STATES,
    THING_NOUNS,
    word_set,
)

_ADVERBS = word_set(
    """
    just already always also really still never often usually hardly rarely soon almost nearly now
    even probably apparently clearly obviously only recently finally once again currently all both
    simply constantly actually sometimes ever not
    """
)
_BE = word_set("is are am was were")
_WAS = word_set("was were been")
_HAVE = word_set("has have had")
_PAST = word_set(
    """
    was were had broke came fell gave began went got sank ran flew died stank hurt burnt grew blew
    froze rose spoke stole tore woke wore ate drank bought brought made lost found saw slept spilt
    felt sent spent sold told taught thought understood forgot knew won met fed heard hid bit shook
    stuck swam threw wrote dropped slipped
    """
)
"""Irregular forms that are no nouns and no present tense."""
_DONE = word_set(
    """
    been fallen broken got gotten gone come become run lost found made bought brought eaten drunk
    seen slept taken given written grown flown laid kept held stuck hidden bitten forgotten chosen
    worn torn stolen woken frozen spoken spilt burnt learnt sent spent built caught taught thought
    felt had heard read sold told stood understood won met fed led paid shut cut set hit hurt burst
    dug hung begun left shaken thrown sunk risen
    """
)
"""Irregular participles."""
_NO_REQUEST = OTHER_VERBS | word_set("fallen had run come")
"""Participles and the like that nobody asks for."""
_LASTING = word_set(
    """
    standing lying sitting resting going staying coming moving joining leaving belonging living
    being having hanging waiting ending blocking obstructing covering holding leaning supporting
    touching facing containing
    """
)
"""What goes on may be said of how something is, or is to be ("the cup is standing on the tray")."""
_WISHING = ASKING | DECREEING | PROPOSING | word_set("supposed meant intended planned hoped to")
_HOLDING_TRUE = word_set(
    """
    think believe guess suppose mean imagine figure reckon know see find feel assume understand
    remember like likes love loves hate hates prefers favour favor thinks believes knows ask tell
    say says asks tells plan plans intend intends decided agreed promised said meant asked chosen
    ordered arranged suggested recommended voted
    """
)
"""What somebody does who may ask for something by what he goes on to say."""
_STRANGE = (
    REFERRING | LINKS | VERB_WORDS | OTHER_VERBS | {*STATES, *LEVELS, *SIDES, *NUMBERS}
    | {*THING_NOUNS}
)  # fmt: skip
"""None of these is a thing that no scene has."""
_MEANT = word_set("going asking telling wanting hoping having planning getting wishing expecting")
"""What somebody is doing who may ask for something by it ("I am having the cup moved")."""
_LONGEST = 5
"""Words of what something is said of, at most."""


def tells_fact(said: str, is_name: IsName) -> bool:
    """Whether this is what a clause does; where something was may be checked and is none."""
    if _WAS & {*said.split()} and PLACED & {*said.split()} and any(map(is_name, said.split())):
        return False
    person = somebody(said)
    if person:
        did = [word for word in person[1].split() if word not in _ADVERBS - {"not"}]
        return not asks_besides(said) and _is_done(person[0], did, is_name)
    words = said.split()
    for end in range(1, min(_LONGEST, len(words) - 1) + 1):
        subject, rest = words[:end], words[end:]
        while rest[:1] and rest[0] in _ADVERBS:
            rest = rest[1:]
        if (happened := _is_told(rest)) is not None:
            return happened and _is_thing(subject, is_name) and not asks_besides(said)
    return False


def _is_thing(words: Sequence[str], is_name: IsName) -> bool:
    """Whether something is told of these: a thing of the scene, one that was spoken of, or a
    stranger with an article.
    """
    if " ".join(words) in ("it", "they", "that", "this"):
        return True
    if words[0] not in BEFORE_NAMES or len(words) == 1:
        return False
    *before, noun = words[1:]
    strange = noun not in _STRANGE
    return (is_name(noun) or strange) and all(
        is_told_apart_by(word, is_name) or word not in _STRANGE for word in before
    )


def _is_told(rest: Sequence[str]) -> bool | None:
    """Whether what is said of a thing is over or goes on; none where no verb is found."""
    verb, *more = rest or [""]
    more = [word for word in more if word not in _ADVERBS]
    then = more[0] if more else ""
    wished = (_WISHING - {"not", "never", "without"} | {*STATES} - _DONE) & {*more}
    if verb in _HAVE and then:
        over = _is_participle(then) and not _is_asked_for([w for w in more if w != "been"][:1])
        return over and not wished
    if verb in _BE and then.endswith("ing") and len(then) > len("thing"):
        return not (wished or then in _LASTING or _is_asked_for({then} - {"getting"}))
    if verb in _PAST:
        return not (wished or (verb in ("was", "were") and _is_asked_for(more[:1])))
    if verb in _BE or verb in _HAVE:
        return False
    return None


def _is_participle(word: str) -> bool:
    return word in _DONE or (word.endswith("ed") and len(word) > len("need"))


def _is_asked_for(words: Iterable[str]) -> bool:
    """Whether these may be what the robot is to do, or how things are to be."""
    return any(
        word in (WORK | VERB_WORDS | CHANGING | DECREEING | {*STATES}) - _NO_REQUEST
        for word in words
    )


def _is_done(who: str, did: Sequence[str], is_name: IsName) -> bool:
    """Whether this is what somebody does or did that is nothing to the robot."""
    if who == "you" or not did or (_WISHING - {"not", "never"}) & {*did}:
        return False
    first, *more = did
    denied = "not" in did
    more = [word for word in more if word != "not"]
    then = more[0] if more else ""
    if first in _HAVE and then and _is_participle(then):
        return not _is_asked_for(more[:1]) and then not in _HOLDING_TRUE
    if first in _BE:
        return then.endswith("ing") and not (then in _MEANT or _is_asked_for({then} - {"coming"}))
    if first in ("do", "does", "did") and denied and then:
        return not (_is_asked_for([then]) or then in _HOLDING_TRUE)
    if first in _HAVE:
        return not any(map(is_name, more)) and not (REFERRING | {"to"}) & {*more}
    return first in _PAST and first not in _HOLDING_TRUE

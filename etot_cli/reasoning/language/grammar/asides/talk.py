"""Whether a sentence, or a clause set off from what is asked for, is but talk: it names nothing of
the scene, calls for nothing, and tells something of people, the weather or what is elsewhere.

A request is about things of the scene. What has a subject and a verb and names none of them asks
for nothing unless somebody wishes or bids by it, or it speaks to the robot.
"""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.language.grammar.asides.asking_words import (
    ASKING,
    BEFORE_NAMES,
    BIDDING,
    CHANGING,
    DECREEING,
    NO_STRANGERS,
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
from etot_cli.reasoning.language.grammar.text.splitting import COMMA
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import OTHER_VERBS, VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    NUMBERS,
    STATES,
    is_descriptive,
    word_set,
)

_REFERRING = REFERRING - {"here"}
_AS_WELL = word_set("too also well likewise next please ditto instead there then")
"""Behind what something is asked for once more ("the spare keys too")."""
_WHERE = word_set("in on into onto beside near off under behind between with from to for of and")
"""They may say where something is to go ("the spare keys in a bag")."""
_BEFORE_VERBS = word_set("just really still already always often soon almost")
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
_TIMES = (
    r"(?:seconds?|minutes?|hours?|days?|weeks?|months?|years?|moments?|o 'clock|noon|midnight"
    r"|dawn|dusk|night|lunch|dinner|work|school|\w+day\w*|\w+time|sharp)"
)
_NUMBER = rf"(?:{'|'.join(sorted({*NUMBERS} - {'a', 'an'}))}|half|a quarter|\d+)"
_WHEN = Expression(
    r" (?:(?:right |just )?now|today|tonight|tomorrow|yesterday|soon|shortly|any (?:\w+ )?"
    rf"{_TIMES}|(?:this|next|last|every|all|the whole) (?:{_TIMES}|morning|afternoon|evening)"
    rf"|(?:at|by|around|until|till|since|after|before)(?: about)? {_NUMBER}(?: (?:past|to) \w+)?"
    r"|(?:at|by|around|until|till|since|after|before|for|in|on|within)(?: about| just)?"
    rf"(?: (?:an?|the|half an|{_NUMBER}|few|couple of|more))* {_TIMES})"
    r"(?= |$)"
)
"""When something is so: a number in it counts nothing that is asked for."""
_HAPPENS = word_set(
    "comes arrives leaves starts begins ends opens closes rings calls visits departs works sleeps"
)
"""What a stranger does, where it is said when ("our cleaner comes on Mondays")."""
_OPENS = word_set("open opens close closes shut shuts")
"""What people do with a shop, where nothing follows ("we close at nine")."""
_SOME_PLACE = Expression(
    r"(?:this|the|our|my) (?:whole |entire )?(?:place|room|world|house) (?:is|looks|smells|feels) "
)
_SIDE = Expression(r"\b(?:(?:on|to|at) (?:the|my|our|his|her|their) )?(?:left|right) (?:hand|side)")
_CALLING = (
    (ASKING - word_set("not never no none nothing if when until could only go goes would like"))
    | BIDDING
    | DECREEING
    | (
        CHANGING
        - word_set("come comes to by than better leave leaves end ends stay stays live lives")
    )
    | ({*NUMBERS} - {"a", "an", "one"})
    | word_set("you your robot slowly quickly carefully gently fancy fancies require seek after")
    | word_set("both other others another")
)
"""Of a sentence with one of these nothing is passed over."""


def is_talk(said: str, is_name: IsName, *, before_so: bool = False, timed: bool = False) -> bool:
    """Whether this is what a sentence or clause is.

    Nobody goes on with "so" behind what is asked for in a clause without a verb ("the spare keys").

    Args:
        said: normalized, with commas as words of their own.
        is_name: whether something in the scene is called by a word.
        before_so: whether the next clause begins with that.
        timed: whether it stands behind "before".
    """
    told = BEFORE_SUBJECT.sub("", said.replace(" 's ", "s "))
    timeless = _WHEN.sub("", told)
    words = timeless.split()
    named = any(map(is_name, (word for word in words if word != "can")))
    timed |= timeless != told
    opens = timed and {*words[-1:]} & _OPENS and words[0] != "they"
    calling = _CALLING & {*words[: -1 if opens else None]}
    if named or calling or _SIDE.search(said) or asks_besides(said):
        return False
    if found := _PERSON.match(timeless):
        return _is_no_deed(timeless[found.end() :].split(), timed=timed)
    if _SOME_PLACE.match(timeless) or _WEATHER.match(timeless):
        return True
    begun = words[: words.index(COMMA)] if COMMA in words else words
    if begun[:1] == ["there"] and {*begun[1:2]} & {"is", "was", "are", "were"}:
        return not (_REFERRING | {*STATES}) & {*begun[2:]}
    return _is_of_stranger(begun, timed=timed, before_so=before_so)


def _is_of_stranger(words: Sequence[str], *, timed: bool, before_so: bool) -> bool:
    """Whether something that is not in the scene is said to be or do something: "the club is
    meeting", and not "the spare keys".
    """
    first = int(words[:1] != [] and words[0] in BEFORE_NAMES)
    for at in range(first + 1, min(first + 5, len(words))):
        subject = [word for word in words[first:at] if word not in _BEFORE_VERBS]
        if not subject or any(word in NO_STRANGERS for word in subject):
            return False
        if is_descriptive(subject[-1]) or not _may_be_verb(words[at], subject[-1]):
            continue
        more = {*words[at + 1 :]}
        placed = words[at] in ("is", "are") and {*words[at + 1 : at + 2]} & PLACED
        if (_REFERRING | _AS_WELL) & more or (placed and not before_so):
            return False
        sure = words[at] in _FINITE or is_past(words[at]) or (timed and words[at] in _HAPPENS)
        return sure or (first + 1 == at and bool(more or before_so) and not _WHERE & more)
    return False


def _may_be_verb(word: str, subject: str) -> bool:
    """Whether a word behind its subject says what that does or did."""
    if word in _FINITE or is_past(word):
        return not is_descriptive(word)
    several = subject.endswith("s") and not subject.endswith(("ss", "us"))
    return word.endswith("s") and not word.endswith(("ss", "us", "is")) and not several


def _is_no_deed(did: list[str], *, timed: bool) -> bool:
    """Whether somebody does something else than what the robot may be to do, and holds nothing of
    what was spoken of ("I like them clean").
    """
    if timed and len(did) == 1 and did[0] in _OPENS:
        return True
    first = next((word for word in did if word not in _AUXILIARIES), "with")
    if first == "with":  # "I could do with a pen"
        return False
    if first in HOLDING_TRUE and (REFERRING | {"that"}) & {*did}:
        return False
    going_on = first.endswith("ing") and did[0] in ("am", "is", "are", "was", "were")
    return going_on or first not in (WORK | VERB_WORDS) - OTHER_VERBS - {"hand", "get", "back"}

"""Whether a sentence, or a clause set off from what is asked for, is but talk: it names nothing of
the scene, calls for nothing, and tells something of people, the weather or what is elsewhere.

A request is about things of the scene. What has a subject and a verb and names none of them asks
for nothing unless somebody wishes or bids by it, or it speaks to the robot, or it says where or how
something is, or is to be, which may be a wrong name for a thing of the scene.
"""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.language.grammar.asides.asking_words import (
    AS_WELL,
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
    is_placing,
)
from etot_cli.reasoning.language.grammar.asides.facts import (
    BEFORE_SUBJECT,
    HOLDING_TRUE,
    goes_on,
    is_asked_for,
    is_past,
)
from etot_cli.reasoning.language.grammar.asides.people import PEOPLE
from etot_cli.reasoning.language.grammar.text.splitting import COMMA
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import OTHER_VERBS, VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    JOINT_NOUNS,
    LEVELS,
    NUMBERS,
    ORDINALS,
    SIDES,
    STATES,
    is_descriptive,
    is_in_lexicon,
    singular,
    word_set,
)

_REFERRING = REFERRING - {"here"}
_WHERE = word_set("in on into onto beside near off under behind between with from to for of and")
"""They may say where something is to go ("the spare keys in a bag")."""
_FURNITURE = {noun for nouns in JOINT_NOUNS.values() for noun in nouns}
"""Not even a word for what may be done stands before these ("the office supplies drawer")."""
_BEFORE_VERBS = word_set("just really still already always often soon almost")
_PERSON = Expression(rf"(?:{PEOPLE}|they) ")
_WEATHER = Expression(
    r"it (?:(?:has been|was|is|will be|always|really|just|only|soon) )*"
    r"(?:rain|snow|pour|freez|thunder|hail|drizzl|gets?|grows?|got|grew|smell|stink|reek)\w*\b"
)
_FINITE = word_set(
    """
    is are am has have does did do will can could might says took left kept lay rang paid
    smells looks feels sounds seems tastes means takes costs keep keeps tend tends
    """
)
"""Verbs that a subject goes before, and no list of things."""
_BEING = word_set("is are was were")
_A_BIT = word_set("bit little touch tad lot")
"""How far something goes to the left."""
_OBJECTS = word_set("it them me us him her my our a an some the everything anything")
"""Behind a word that may be a verb or a noun ("the egg cups") they show that it is a verb."""
_AUXILIARIES = word_set(
    "is are was were am have has had does did do will can could might been not never always usually"
)
_LINKING = _AUXILIARIES | word_set("looks feels smells sounds seems tastes keep keeps tend tends")
_TELLING = _REFERRING | AS_WELL | {*STATES, *LEVELS, *SIDES, *ORDINALS} | word_set("limits bounds")
"""They tell one thing from another, or say how or when one is to be."""
_TIMES = (
    r"(?:seconds?|minutes?|hours?|days?|weeks?|months?|years?|moments?|o 'clock|noon|midnight"
    r"|dawn|dusk|night|morning|evening|afternoon|lunch|dinner|work|school|\w+day\w*|\w+time|sharp)"
)
_NUMBER = rf"(?:{'|'.join(sorted({*NUMBERS} - {'a', 'an'}))}|half|a quarter|\d+)"
WHEN = Expression(
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
_LIKE = Expression(r" (?P<does>looks|smells|feels|sounds|is) like\b")
_ALL_OVER = Expression(r" (?:all (?=over\b|around\b)|running (?=(?:late|short|behind|over)\b))")
"""Words that ask for nothing here, and do elsewhere."""
_SOME_PLACE = Expression(
    r"(?:this|the|our|my) (?:whole |entire )?(?:place|room|world|house) (?:is|looks|smells|feels) "
)
_WHO_DID = Expression(r" who (?:\w+ly |just |only |also |once )?(?P<did>\w+) .*")
"""Behind somebody, who did something with things ("we had a chap in who bought the cups")."""
_OF_IT = Expression(
    r"^(?P<what>(?:the|its|their) \w+) (?:on|in|of|inside|around) (?:it|them) "
    r"(?=(?:is|are|was|were|has|have)\b)"
)
"""Of what a stranger is a part, or where it is ("the paint on them is wet")."""
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


def is_talk(
    said: str,
    is_name: IsName,
    *,
    before_so: bool = False,
    timed: bool = False,
    listed: bool = False,
) -> bool:
    """Whether this is what a sentence or clause is.

    Nobody goes on with "so" behind what is asked for in a clause without a verb ("the spare keys").

    Args:
        said: normalized, with commas as words of their own.
        is_name: whether something in the scene is called by a word.
        before_so: whether the next clause begins with that.
        timed: whether it stands behind "before".
        listed: whether it may be an item of a list, where a word is only sure to be a verb if no
            noun is spelled so.
    """
    if (who := _WHO_DID.search(said)) and is_past(who["did"]) and not asks_besides(said):
        said = said[: who.start()]
    told = _OF_IT.sub(r"\g<what> ", BEFORE_SUBJECT.sub("", said.replace(" 's ", "s ")))
    timeless = _ALL_OVER.sub(" ", _LIKE.sub(r" \g<does>", WHEN.sub("", told)))
    words = timeless.split()
    named = any(map(is_name, (word for word in words if word != "can")))
    timed |= WHEN.search(told) is not None
    opens = timed and {*words[-1:]} & _OPENS and words[0] != "they"
    about = 2 if words[:1] != [] and words[0] in BEFORE_NAMES and {*words[2:3]} & _LINKING else 0
    calling = _CALLING & {*words[about : -1 if opens else None]}  # "the order is important"
    if named or calling or _SIDE.search(said) or asks_besides(said):
        return False
    if found := _PERSON.match(timeless):
        return _is_no_deed(timeless[found.end() :].split(), timed=timed)
    if _SOME_PLACE.match(timeless) or _WEATHER.match(timeless):
        return True
    begun = words[: words.index(COMMA)] if COMMA in words else words
    if begun[:1] == ["there"] and {*begun[1:2]} & _BEING:
        return not (_REFERRING | {*STATES}) & {*begun[2:]}
    if begun[:1] in (["that"], ["this"]) and {*begun[1:2]} & _BEING:
        return _is_so("is", begun[2:], timed=False, listed=listed)
    return _is_of_stranger(begun, timed=timed, before_so=before_so, listed=listed)


def _is_of_stranger(words: Sequence[str], *, timed: bool, before_so: bool, listed: bool) -> bool:
    """Whether something that is not in the scene is said to be or do something: "the club is
    meeting", and not "the spare keys".
    """
    first = int(words[:1] != [] and words[0] in BEFORE_NAMES)
    no_strangers = (
        NO_STRANGERS - OTHER_VERBS - {*STATES} if first else NO_STRANGERS
    )  # "the paint is wet"
    for at in range(first + 1, min(first + 5, len(words))):
        subject = [word for word in words[first:at] if word not in _BEFORE_VERBS]
        doing = {*subject[1:]} & (VERB_WORDS | OTHER_VERBS)  # "night shift"
        if not subject or any(word in no_strangers - doing for word in subject):
            return False
        adjective = is_descriptive(subject[-1]) or subject[-1] in STATES
        left = words[at] == "left" and {*words[at + 1 : at + 2]} & _OBJECTS
        if adjective or not (left or _may_be_verb(words[at], subject[-1])):
            continue
        verb, *more = [word for word in words[at:] if word not in _BEFORE_VERBS]
        did = left or (is_past(verb) and {*more[:1]} & _OBJECTS) or (timed and verb in _HAPPENS)
        if doing and (not did or _A_BIT & {*more[1:2]}):
            continue  # "wagon shift left a bit"
        if verb in _LINKING:
            return _is_so(verb, more, timed=timed or before_so, listed=listed)
        does = more[more[:1] != [] and more[0] in _OBJECTS :]
        if _TELLING & {*does} or (is_placing(verb) and not (timed and verb in _HAPPENS)):
            return False
        sure = verb in _FINITE or (timed and verb in _HAPPENS) or not _OBJECTS.isdisjoint(more[:1])
        sure = sure or (is_past(verb) and not (listed and verb.endswith("ed")))
        plain = first + 1 == at and not listed and bool(more or before_so)
        return sure or (plain and not (_WHERE | _FURNITURE) & {*more})
    return False


def _is_so(verb: str, more: Sequence[str], *, timed: bool, listed: bool) -> bool:
    """Whether what is said behind such a verb asks neither for a place nor for a deed, nor speaks
    of what may be asked for.
    """
    told = [word for word in more if word not in ("not", "never", "been", "being", "be")]
    if verb == "will" and PLACED & {*told[:1]}:
        return False
    if verb in ("tend", "tends") and told[:1] == ["to"]:
        told = told[1:]
    then = told[0] if told else ""
    by_now = timed and then in STATES  # "the shop is shut today"
    if _TELLING & {*told[by_now:]} or then == "to":
        return False
    if then.endswith("ing"):
        coming = then == "coming" and not PLACED & {*told}
        return coming or goes_on(then)
    asked = is_placing(then) or is_asked_for({then} - {"over", "up"}) or (listed and then in PLACED)
    return bool(more or timed) and (by_now or not asked) and verb not in ("keep", "keeps")


def _may_be_verb(word: str, subject: str) -> bool:
    """Whether a word behind its subject says what that does or did."""
    if word in _FINITE | _HAPPENS or is_past(word):
        return not is_descriptive(word)
    several = subject.endswith("s") and not subject.endswith(("ss", "us"))
    does = word.endswith("s") and not word.endswith(("ss", "us", "is"))
    return does and not (several or is_in_lexicon(singular(word)))


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

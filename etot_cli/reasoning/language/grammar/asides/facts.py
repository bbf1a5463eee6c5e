"""Whether a clause tells a fact, which its tense shows: what happened, what is going on, what
somebody does.

Nobody asks for what has been so, nor for what goes on: a request says what to do, what is to be so,
or, in the present, where something is and how. So what is past, perfect or in progress asks for
nothing, nor does what people do that the robot cannot, whatever they do it with.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from msgspec import Struct

from etot_cli.reasoning.language.grammar.asides.asking_words import (
    AS_WELL,
    ASKING,
    BEFORE_NAMES,
    CHANGING,
    DECREEING,
    NO_STRANGERS,
    PLACED,
    PROPOSING,
    REFERRING,
    WORK,
    IsName,
    asks_besides,
    is_placing,
)
from etot_cli.reasoning.language.grammar.asides.people import PEOPLE, somebody
from etot_cli.reasoning.language.grammar.asides.remarks import is_forbidding
from etot_cli.reasoning.language.grammar.asides.told_of_things import is_told_apart_by
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import OTHER_VERBS, VERB_WORDS, all_words
from etot_cli.reasoning.language.words.lexicon import (
    DESK_NOUNS,
    LEVELS,
    SIDES,
    STATES,
    is_in_lexicon,
    singular,
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
PAST = word_set(
    """
    was were had broke came fell gave began went got sank ran flew died stank hurt burnt grew blew
    froze rose spoke stole tore woke wore ate drank bought brought made lost found saw slept spilt
    felt sent spent sold told taught thought understood forgot knew won met fed heard hid bit shook
    built used stuck swam threw wrote dropped slipped sat stood swore chose drew dreamt learnt lit
    rode sang rang rolled toppled slid
    """
)
"""Irregular forms that are no nouns and no present tense."""
_DONE = word_set(
    """
    been fallen broken got gotten gone come become run lost found made bought brought eaten drunk
    seen slept taken given written grown flown laid kept held stuck hidden bitten forgotten chosen
    worn torn stolen woken frozen spoken spilt burnt learnt sent spent built caught taught thought
    felt had heard read sold told stood understood won met fed led paid shut cut set hit hurt burst
    dug hung begun left shaken thrown sunk risen rung sung ridden drawn lit sat stood
    """
)
"""Irregular participles."""
_SEVERAL = Expression(r" (?:\w*[^s]s|\w*children|ladies|people|women|men)$")
_COMPLEMENT = word_set("of to about without")
_NO_REQUEST = OTHER_VERBS | word_set("fallen had run come serve serving sat")
"""Participles and the like that nobody asks for."""
_REQUESTS = (WORK | VERB_WORDS | CHANGING | DECREEING | {*STATES}) - _NO_REQUEST
LASTING = word_set(
    """
    standing lying sitting resting going staying coming moving joining leaving belonging living
    being having hanging waiting ending blocking obstructing covering holding leaning supporting
    touching facing containing
    """
)
"""What goes on may be said of how something is, or is to be ("the cup is standing on the tray")."""
_WISHING = ASKING | DECREEING | PROPOSING | word_set("supposed meant intended planned hoped")
_WISHES = (
    word_set(
        """
        want wants wanted need needs needed wish prefer should must shall would may let lets letting
        ought belong belongs hoping wondering please unless instead except
        """
    )
    | DECREEING
    | PROPOSING
)
"""What people do, or words they use, who ask for something, wherever these stand."""
_TOLD = {*STATES, *LEVELS, *SIDES} | word_set("here there back")
"""How or where things are, and people seldom."""
_HABITUAL = word_set("always usually often never sometimes constantly every whenever")
_ANYBODY = ("i", "we", "one", "people", "nobody", "no one", "everybody", "everyone")
"""What they do as a rule, the robot may be meant to do."""
_ONCE = word_set("once if when until till unless soon provided before after")
BEFORE_SUBJECT = Expression(
    r"^(?:(?:oh|ah|well|sorry|alas|hey|look|honestly|frankly|unfortunately|sadly|luckily|fortunately"
    r"|anyway|and|but|so|now|then|yes|no|dear|goodness|phew|ugh|you know|you see|today|tonight"
    r"|yesterday|tomorrow|nowadays|~comma|(?:earlier|later) on"
    r"|(?:last|this|every|yesterday|tomorrow|all|the other) (?:night|morning|noon|evening|afternoon"
    r"|week|weekend|month|year|day|spring|summer|autumn|winter|time)"
    r"|(?:at|in|for|since|on|during|after|before|until) (?:(?:the|my|our|this|last|a) )?\w+) )+"
    rf"(?=(?:{PEOPLE}|they|it|one|the|my|our|a|an|this|there) )"
)
"""When, and with what sigh, somebody does something."""
HOLDING_TRUE = word_set(
    """
    think believe guess suppose mean imagine figure reckon know see find feel assume understand
    remember like likes love loves hate hates prefers favour favor thinks believes knows ask tell
    say says asks tells plan plans intend intends decided agreed promised said meant asked chosen
    ordered arranged suggested recommended voted hope hopes wish wishes crave craves desire desires
    covet covets seek seeks request requests beg begs claim claims fancy fancies yearn yearns long
    longs pray prays dream dreams
    """
)
"""What somebody does who may ask for something by what he goes on to say."""
_MEANT = word_set(
    """
    going asking telling wanting hoping having planning getting wishing expecting counting relying
    trusting depending
    """
)
"""What somebody is doing who may ask for something by it ("I am having the cup moved")."""
_GONE_AND = Expression(r"\b(?:(?:has|have) gone|went) and \w+")
"""With this people complain of what was done ("he has gone and moved it"), and ask for nothing."""
_LONGEST = 5
"""Words of what something is said of, at most."""


class _Doing(Struct, frozen=True):
    """What is said of somebody: the words for it without adverbs, whether it is denied, and whether
    it is what he does time and again.
    """

    who: str
    did: Sequence[str]
    denied: bool
    habit: bool


def tells_fact(said: str, is_name: IsName) -> bool:
    """Whether this is what a clause does; where something was may be checked and is none."""
    words = said.split()
    placed = _WAS & {*words} and PLACED & {*words} and any(map(is_name, words))
    said = _GONE_AND.sub("found", BEFORE_SUBJECT.sub("", said))
    by_name = _by_name(said, is_name)
    if placed and (by_name is None or _is_placed(words, is_name)):
        return False  # "Doreen has been on at me about the cups" tells of no place
    person = somebody(said) or by_name
    if is_forbidding(said, is_name):
        return False
    if person:
        who, told = person
        did = [word for word in told.split() if word not in _ADVERBS]
        denied = bool({"not", "never"} & {*told.split()[:4]})
        habit = bool(_HABITUAL & {*said.split()}) and who not in _ANYBODY
        doing = _Doing(who, did, denied=denied, habit=habit)
        return not asks_besides(said) and _is_done(doing, is_name)
    words = said.split()
    for end in range(1, min(_LONGEST, len(words) - 1) + 1):
        subject, rest = words[:end], words[end:]
        while rest[:1] and rest[0] in _ADVERBS:
            rest = rest[1:]
        if (happened := _is_told(rest)) is None and rest[:1] and rest[0] in ("will", "does", "do"):
            does = next((word for word in rest[1:] if word not in _ADVERBS), "")
            asked = is_asked_for([does]) or is_placing(does)
            happened = _is_strange(subject, is_name) and not asked
        if happened is not None:
            return happened and _is_thing(subject, is_name) and not asks_besides(said)
    return False


def _by_name(said: str, is_name: IsName) -> tuple[str, str] | None:
    """Who a clause is about by his name, and what it says of him ("Karl never gives it back")."""
    who, *did = said.removeprefix("our ").split() or [""]
    verb = next((word for word in did if word not in _ADVERBS), "")
    stranger = who == "one" or (not is_name(who) and who not in all_words())
    does = verb in (_BE | _HAVE) or (verb.endswith("s") and not verb.endswith("ss"))
    if did[:1] == [verb] and verb not in _BE | _HAVE:  # "wine glasses hang …", "tea bags too"
        following = {*did[1:2]} & (PLACED | AS_WELL) or any(map(is_placing, did[1:2]))
        does &= not (following or is_in_lexicon(singular(verb)))
    does |= verb in PAST and not is_asked_for([verb])  # "Karl nearly sat on it"
    return (who, " ".join(did)) if stranger and does and not is_name(verb) else None


def _is_thing(words: Sequence[str], is_name: IsName) -> bool:
    """Whether something is told of these: a thing of the scene, one that was spoken of, or a
    stranger with an article.
    """
    if " ".join(words) in ("it", "they", "that", "this"):
        return True
    if words[0] not in BEFORE_NAMES or len(words) == 1:
        return False
    *before, noun = words[1:]
    strange = noun not in NO_STRANGERS
    return (is_name(noun) or strange) and all(
        is_told_apart_by(word, is_name) or word not in NO_STRANGERS for word in before
    )


def verb_of_stranger(said: str, is_name: IsName, verbs: frozenset[str]) -> int:
    """Where one of some verbs stands behind somebody or something that is not in the scene, by its
    name or by its noun; 0 where none does.
    """
    words = said.split()
    at = next((at for at, word in enumerate(words[:5]) if word in verbs), 0)
    by_name = at == 1 and not is_name(words[0]) and words[0] not in all_words()
    return at if at and (by_name or _is_strange(words[:at], is_name)) else 0


def _is_strange(subject: Sequence[str], is_name: IsName) -> bool:
    """Whether something is told of what is not in the scene ("the bus will not wait")."""
    known = any(map(is_name, subject)) or {*subject[1:]} & NO_STRANGERS
    return subject[0] in BEFORE_NAMES and len(subject) > 1 and not known


def _is_told(rest: Sequence[str]) -> bool | None:
    """Whether what is said of a thing is over or goes on; none where no verb is found."""
    verb, *more = rest or [""]
    more = [word for word in more if word not in _ADVERBS]
    then = more[0] if more else ""
    wished = (_WISHING - {"not", "never", "without"} | {*STATES} - _DONE) & {*more}
    if verb in _HAVE and then:
        over = _is_participle(then) and not is_asked_for([w for w in more if w != "been"][:1])
        return over and not wished
    if verb in _BE | {"keep", "keeps"} and then.endswith("ing") and len(then) > len("thing"):
        return goes_on(then) and not wished
    if verb in PAST:
        to_be = verb in ("was", "were") and (then == "to" or is_asked_for([then]))
        return not (wished or to_be)
    if verb in _BE or verb in _HAVE:
        return False
    return None


def goes_on(doing: str) -> bool:
    """Whether what is going on is nothing that may be asked for."""
    return not (doing in LASTING or is_asked_for({doing} - {"getting"}))


def _is_participle(word: str) -> bool:
    return word in _DONE or _is_regular(word)


def is_past(word: str) -> bool:
    """Whether a word says what somebody did."""
    return word in PAST or _is_regular(word)


def _is_regular(word: str) -> bool:
    return word.endswith("ed") and len(word) > len("need")


def is_asked_for(words: Iterable[str]) -> bool:
    """Whether these may be what the robot is to do, or how things are to be."""
    stems = {stem for word in words for stem in (word, *map(word.removesuffix, ("d", "ed", "es")))}
    return bool(_REQUESTS & stems)


def _is_done(told: _Doing, is_name: IsName) -> bool:
    """Whether this is what somebody does or did that is nothing to the robot."""
    did = told.did
    if told.who == "you" or not did or _WISHES & {*did} or _goes_somewhere(did):
        return False
    if "you" in did and "to" in did[did.index("you") :]:
        return False  # "I rely on you to keep it closed"
    first, *more = did
    if first in ("told", "warned", "instructed") and {"to", "that"} & {*more}:
        return False
    then = more[0] if more else ""
    on_terms = next((at for at, word in enumerate(did) if word in _ONCE), len(did))
    if any(map(is_name, did[on_terms:])):
        return False  # "I will be happy once the cup is on the tray"
    named = any(map(is_name, did))
    if told.denied and then in ("sure", "certain", "know", "remember"):
        # "I am not sure how Ann left the cabinet"
        unsure = bool({"how", "whether", "if"} & {*more[1:2]}) and not {"to", "you"} & {*more}
        return unsure and not _is_placed(more, is_name)
    if first in _HAVE:
        if _is_participle(then):
            return not is_asked_for(more[:1]) and then not in HOLDING_TRUE
        return not named and not (REFERRING | {"to"}) & {*more}
    if first in _BE:
        if more[:2] == ["going", "to"]:
            return not is_asked_for(more[2:3])
        if then.endswith("ing"):
            asked = (
                then in _MEANT or (named and then == "waiting") or is_asked_for({then} - {"coming"})
            )
            return not (asked or (then == "serving" and _is_placed(more, is_name)))
        over = first in ("was", "were") and not _is_placed(more, is_name)
        named &= not _is_complement(more, is_name)
        return then not in ("to", "after") and (over or not (named or _TOLD & {*more}))
    if first in ("do", "does", "did", "can", "could", "will", "might"):
        able = told.denied or first in ("will", "might")
        bears = then in ("stand", "bear") and not named  # "I can not stand that smell"
        asked = is_asked_for({then} - {"be"}) or then in HOLDING_TRUE
        return able and bool(then) and (bears or not asked)
    if is_past(first):
        return first not in HOLDING_TRUE
    # "Everyone drips on the table" tells of no thing of the scene
    things = any(is_name(word) and word not in DESK_NOUNS for word in more) or REFERRING & {*more}
    return _is_habit(told, first, then) and not (things and _is_placed(more, is_name))


def _is_complement(more: Sequence[str], is_name: IsName) -> bool:
    """Whether things are named only by what somebody is fond, or no fan, of."""
    of = (more[max(at - 3, 0) : at] for at, word in enumerate(more) if is_name(word))
    doing = any(word in VERB_WORDS and word.endswith("ing") for word in more)
    return not doing and all(_COMPLEMENT & {*words} for words in of)


def _is_habit(told: _Doing, verb: str, then: str) -> bool:
    """Whether a verb in the present says what somebody does as people do, and robots do not."""
    if verb in HOLDING_TRUE or verb in NO_STRANGERS - OTHER_VERBS - VERB_WORDS:
        return False
    if verb in ("keep", "keeps"):
        return then.endswith("ing") and then not in _MEANT
    if told.who in ("i", "we", "people") or _SEVERAL.search(told.who):
        return not (is_asked_for([verb]) or verb.endswith("s"))
    stems = {verb.removesuffix("s"), verb.removesuffix("es"), f"{verb.removesuffix('ies')}y"}
    return verb.endswith("s") and (told.habit or not is_asked_for({verb, *stems}))


def _goes_somewhere(did: Sequence[str]) -> bool:
    """Whether somebody, or something, goes where things may go ("it goes in the box")."""
    went = [at for at, word in enumerate(did) if word in ("go", "goes")]
    return any({*did[at + 1 : at + 2]} & (PLACED | {"there", "here", "back"}) for at in went)


def _is_placed(words: Sequence[str], is_name: IsName) -> bool:
    """Whether something of the scene is where another may be."""
    return any(
        word in PLACED and any(map(is_name, words[at + 1 : at + 4]))
        for at, word in enumerate(words)
    )

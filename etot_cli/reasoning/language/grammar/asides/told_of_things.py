"""Whether a clause only tells something of a thing: how it is or gets, and that it cannot stay."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.language.grammar.asides.asking_words import (
    ASKING,
    BEFORE_NAMES,
    CHANGING,
    DECREEING,
    REFERRING,
    WORK,
    IsName,
)
from etot_cli.reasoning.language.grammar.asides.people import PEOPLE
from etot_cli.reasoning.language.words import predicates, verbs
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.fillers import TURNED
from etot_cli.reasoning.language.words.known import VERB_WORDS, all_words
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    NUMBERS,
    SIDES,
    STATES,
    THING_NOUNS,
    is_descriptive,
    word_set,
)
from etot_cli.reasoning.language.words.patterns import words_of

_IN_PASSING = Expression(
    r"(?:(?:it|they) (?:is|are) "
    r"(?:(?:still|quite|very|really|rather|almost|too|nearly|half) )*full"
    r"(?: of \w+| to the (?:brim|rim|top))?"
    r"|(?:it|they) (?:is|are) (?:going|about) to (?:be|get) (?P<done>\w+(?:ed|t|n))"
    r"(?: (?:today|tomorrow|tonight|soon|later|next week|this week|in a (?:minute|moment)))?)"
)
_WHENEVER = Expression(rf" (?:when|whenever|if|as soon as) (?:it|they|one|{PEOPLE}) [^~]+$")
"""When something does what it does ("the tube leaks when it lies down")."""
_YONDER = Expression(
    r"(?: (?:(?:over|up|down|in|out) )?(?:here|there))?(?: since (?:last )?\w+(?: o 'clock)?)?$"
)
_PREDICATE = Expression(
    r"(?:(?:is|are|was|were|has|have|had)(?: not| been| got)?|(?:does|do|did|will|can) not"
    r"|keeps?(?= \w+ing\b)|looks?|seems?|feels?|smells?|takes? up|gets?|got|fell|broke"
    r"|\w+[^s]s|\w+ed)"
    r"(?: (?:still|just|already|always|all|so|very|too|really|a bit|far|badly|quite|less|more))*"
    r"(?= |$)"
)
_A_BIT = Expression(
    r" (?:any ?(?:more|longer)|a (?:little|bit|lot)|quite a bit|by now|all the time|so often"
    r"|every time)(?= |$)"
)
_TOO_SO = Expression(
    r"^(?:is|are|looks?|gets?) (?:far |much |way )?too \w+"
    r"(?: (?:to|for|from) (?:the|my|our|that|its) (?:(?!and\b|or\b|but\b|to\b)\w+ ?){1,3}$)?"
)
_NOT_STAYING = (
    r"(?:can|must|should|may|does|do) not (?:be (?:left|kept)|stay|remain"
    r"|(?:stand|lie|sit|belong|live|be|go)(?= (?:(?:up|down|over|out) )?(?:here|there)$))"
    r"(?: (?:like (?:this|that)|as (?:it is|they are)|that way|so))?"
)
_OVER_THE_EDGE = (
    r"(?:sticking|poking|peeking|hanging|jutting|bulging|spilling|protruding|leaning)"
    r"(?: (?:out|over|up|off|halfway))*(?: (?:of |over |at |from )?(?:the )?"
    r"(?:top|edge|side|rim|front))?"
)
_NO_PLACE = Expression(
    rf"(?:^(?:(?:do|does|did) not )?belong(?:s|ed)? to (?:me|us|him|her|them|{PEOPLE})$"
    rf"|^(?:is|are|was) (?:\w+ )?{_OVER_THE_EDGE}$"
    rf"|^(?:is|are) (?:(?:{PEOPLE}|(?!not\b)\w+) 's|mine|ours|hers|theirs)$"
    r"|^(?:is|are|stands|lies) in (?:the|my|our|your) way(?: (?:here|there))?$"
    r"|^(?:is|are) getting \w+$"
    r"|^(?:is|are) (?:(?:just|much|simply|so much|a lot|also) )*(?:easier|safer|quicker|handier)"
    r"(?: to (?:reach|get at|get to|find|see|grab|use|clean))?(?: (?:there|that way|like that))?$"
    r"|^are (?:in|on|at) (?:each other|one another) 's (?:spot|place|position|seat)s?$"
    r"|^(?:(?:always|constantly|often|just|only|easily) )*(?:roll|slide|slip|fall|tip|topple)s? "
    r"(?:off|over|away|down|around|everywhere|out)(?: (?:again|easily|constantly))?$"
    rf"|^(?:is|are) (?:going|turning) (?:{TURNED})$"
    rf"|^{_NOT_STAYING}$"
    r"|^(?:stick|jam|squeak|creak|rattle|wobble|leak|drip|stain|scratch|chip|crack|break)"
    r"(?: (?:easily|badly|a (?:bit|little|lot)))?$"
    r"|^(?:is|are) not for \w+ing (?:things|stuff|anything|something) (?:in|on|into|onto|under)$"
    r"|^(?:must|should) (?:stay|keep|remain|be kept) (?:warm|cold|cool|fresh)$"
    r"|^(?:needs?|has|have) to (?:stay|keep|remain|be kept) "
    r"(?:warm|cold|cool|dry|fresh|clean|safe)$)"
)
_NEEDED = Expression(r"^needs? (?:a |some )?(?:little |good )?(?P<done>\w+ing)$")
_DONE_TO_THINGS = VERB_WORDS | words_of(
    (verbs.COVER, verbs.UNCOVER, verbs.FILL, verbs.LOAD, verbs.THROW_AWAY, verbs.OPEN, verbs.CLOSE)
)
"""What a thing may need of the robot; whatever else it needs, such as chilling, is a reason."""
_TELLING = (
    word_set("full free clear ready taken occupied") | set(STATES) | set(LEVELS) | set(SIDES)
    | set(NUMBERS) - {"a", "an"} | set(THING_NOUNS) | REFERRING
)  # fmt: skip
"""They tell one thing from another, or say how one is to be."""
_UNFIT_THERE = Expression(
    rf"^(?P<what>it|they|(?:(?:the|my|our) )?(?:\w+ )?\w+) {_NOT_STAYING}"
    r"(?: (?:(?:up|down|over|out) )?(?:here|there))?$"
)
_ONE_IS = Expression(r"(?:the|that) (?P<how>(?:\w+ ){1,2})one (?:is|was)(?: meant| reserved)?")
"""Ahead of whom that is for, where several things were spoken of."""
_TURNING = Expression(
    rf"(?: (?:(?:is|are) (?:getting|going|turning)|(?:has|have) gone) (?:{TURNED})$"
    r"|(?:must|should|(?:needs?|has|have) to) "
    r"(?:stay|keep|remain|be kept) (?:warm|cold|cool|fresh)$)"
)
"""Of whatever it is said, it asks for nothing."""


def is_in_passing(said: str) -> bool:
    """Whether this tells of what was spoken of why some care is taken, or what others will do with
    it ("it is full", "it is going to be painted tomorrow").
    """
    found = _IN_PASSING.fullmatch(said)
    done = (found and found["done"]) or ""
    stems = {done, done[:-1], done[:-2], done[:-3], f"{done[:-3]}y"}
    return found is not None and not stems & (
        _DONE_TO_THINGS | words_of((predicates.BROUGHT,)) | WORK
    )


def is_turning(said: str) -> bool:
    """Whether this tells how something gets by itself, as food that stands in the warmth."""
    return bool(_TURNING.search(said))


def told_of_thing(said: str, is_name: IsName) -> tuple[str, ...]:
    """The words for something in the scene of which this tells what places nothing, singles nothing
    out and speaks of nothing else; none where it does not.
    """
    if unfit := _UNFIT_THERE.match(said):
        what = [word for word in unfit["what"].split() if word not in BEFORE_NAMES]
        named = what and (is_name(what[-1]) or what[-1] in ("it", "they"))  # not "that"
        return tuple(what) if named else ()
    if (one := _ONE_IS.fullmatch(said)) is not None:
        how = one["how"].split()
        return (*how, "one") if all(is_told_apart_by(word, is_name) for word in how) else ()
    words = _YONDER.sub("", _WHENEVER.sub("", said)).split() or [""]
    end = _named_until(words, is_name)
    while words[end : end + 1] == ["and"] and words[end + 1 : end + 2] == ["the"]:
        end += 1 + _named_until(words[end + 1 :], is_name)  # "the tape and the pencil are trash"
    if words[0] in ("it", "they") and is_idle(" ".join(words[1:]), is_name):
        return (words[0],)
    if words[0] not in BEFORE_NAMES or end == 1 or not is_name(words[end - 1]):
        return ()
    return tuple(words[1:end]) if is_idle(" ".join(words[end:]), is_name) else ()


def is_told_apart_by(word: str, is_name: IsName) -> bool:
    """Whether a word may stand in a phrase for something of the scene ("that open drawer")."""
    return is_name(word) or is_descriptive(word) or word in STATES or word in LEVELS


def _named_until(words: Sequence[str], is_name: IsName) -> int:
    """Where a phrase for something of the scene ends, which begins with the first word."""
    end = 1
    while words[end : end + 1] and is_told_apart_by(words[end], is_name):
        end += 1
    return end


def is_idle(predicate: str, is_name: IsName) -> bool:
    """Whether a predicate is such a one."""
    if _TOO_SO.fullmatch(predicate):
        return True
    predicate = _TOO_SO.sub("is so", _A_BIT.sub("", predicate))
    needed = _NEEDED.match(predicate)
    if _NO_PLACE.match(predicate) or (needed and needed["done"] not in _DONE_TO_THINGS):
        return True
    found = _PREDICATE.match(predicate)
    if not found:
        return False
    verb, *_ = found[0].split()
    more = {*predicate[found.end() :].split()}
    stems = {verb, *(verb.removesuffix(ending) for ending in ("s", "es", "d", "ed"))}
    asking = (ASKING | CHANGING | WORK | DECREEING) - {"not"}
    if asking & more or (asking - {"get", "keep"}) & stems or _TELLING & more:
        return False
    if any(is_name(word) or is_descriptive(word) for word in more):
        return False
    return bool(more) or verb not in all_words()

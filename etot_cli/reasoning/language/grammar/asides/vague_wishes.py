"""Whether somebody only wants room, or something of a kind that tells none of the scene's things
from others: a reason why things go elsewhere, or why one of these is asked for next.
"""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.language.grammar.asides.asking_words import (
    ASKING,
    BEFORE_NAMES,
    PLACED,
    REFERRING,
    IsName,
)
from etot_cli.reasoning.language.grammar.asides.people import PEOPLE
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import all_words
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    NUMBERS,
    SIDES,
    STATES,
    is_descriptive,
    word_set,
)

_WANTED = Expression(
    rf"(?:{PEOPLE}|they|(?:the|my|our|some) (?:ladies|girls|boys)) (?:just |also |really )?"
    r"(?:wants?|needs?|would (?:like|love)|fanc(?:y|ies)|(?:has |have )?ordered|ask(?:ed|s)? for) "
    r"(?:something |an? |some |(?:his |her |my |our |their )?"
    r"(?=(?:breakfast|lunch|dinner|supper|dessert)$))"
    r"(?P<what>(?:\w+ ){0,2}?\w+?)(?: ones?| to (?:eat|drink))?(?: (?:later|tonight|today))?"
)
_TELLING = (
    REFERRING | ASKING | PLACED | {*LEVELS, *NUMBERS, *SIDES, *STATES}
    | word_set("of for from with about between under over that which who and or out up away")
)  # fmt: skip


def wants_such_a_thing(said: str, is_name: IsName) -> bool:
    """Whether this is what a clause tells ("they want a cold one", "she wants something sweet")."""
    wanted = _WANTED.fullmatch(said)
    words = wanted["what"].split() if wanted else []
    return bool(words) and not any(
        word in _TELLING or is_descriptive(word) or is_name(word) for word in words
    )


_SEEING = Expression(
    rf"(?!you\b)(?:{PEOPLE}|they|(?!the\b)\w+) would (?:(?:really|so|just) )?(?:love|like) to "
    r"(?:see|hear|watch|admire|look at) (?:it|them|(?:the|my|our) (?P<what>(?:\w+ ){0,2}?\w+))"
    r"(?: (?:up close|again|better|properly|in action|(?:for|by) \w+self))*"
)


def would_see(said: str) -> bool:
    """Whether somebody would like to see something, whatever is done for that next."""
    found = _SEEING.fullmatch(said)
    what = (found["what"] or "").split() if found else []
    asked = any(word in _TELLING - {*LEVELS, *SIDES} or word.endswith("ed") for word in what[1:])
    return found is not None and not asked


_STILL_NEEDED = Expression(
    rf"{PEOPLE} (?:(?P<later>still|soon|will) )?(?:also )?needs? (?:it|them)"
    r"(?P<when> (?:later|tomorrow|tonight|soon|myself|again)(?: on)?)?(?: for (?P<what>[^~]+))?"
)


def still_needs_it(said: str, is_name: IsName, *, for_somebody: bool) -> bool:
    """Whether somebody tells why care is taken of what was spoken of ("I still need it"); "I need
    it" alone asks for that, unless it is said what for.
    """
    found = _STILL_NEEDED.fullmatch(said)
    if found is None:
        return False
    what = [word for word in (found["what"] or "").split() if word not in (*BEFORE_NAMES, "'s")]
    if any(word in all_words() or is_name(word) for word in what):
        return False
    return bool(what or for_somebody or found["later"] or found["when"])


_ROOM = (
    r"(?:(?:(?:some|more|a (?:bit|little|lot)|lots|enough|not enough|no|(?:too )?little|any|much)"
    r"(?: more| extra| free)*(?: of)? |the )?"
    r"(?:(?:elbow|work|bench|desk|counter|table) )?(?:room|space)"
    r"|(?:the|that) (?:whole )?(?:surface|spot|area))"
)
_BESIDE = r"next to|beside|by|near|around|behind|in front of|(?:to the )?(?:left|right) of"
_WHERE = (
    r"(?: (?:left|to (?:work|write|cook|eat|play|breathe)|(?:over |in )?here|there"
    r"|now|later(?: on)?|soon"
    rf"|(?:in|on|at|for|{_BESIDE}) (?:the|a|an|my|our|this|some|another) (?:\w+ ){{0,2}}?\w+"
    r"(?: of (?:the|my|our) \w+)?"
    r"|for (?:something|other things|more things|(?:something|anything) else|\w+ing)))*"
)
_LACKING = Expression(
    rf"(?:(?:{PEOPLE}|they) (?:(?:just|really|also) )?(?:(?:will |could |would )?"
    r"(?:needs?|use|want|like)(?: to have)?|do not have|have|am|are|is)"
    rf"(?: (?:short|(?:running )?out) of| (?:running )?low on)? {_ROOM}{_WHERE}"
    rf"|there is (?:just )?(?:not |hardly |barely )?{_ROOM}{_WHERE}"
    rf"|(?:the |my )?(?:room|space) is (?:tight|short|scarce|limited){_WHERE})"
)


_THERE = Expression(r"\bthere\b")
_ROOM_BESIDE = Expression(rf"{_ROOM} (?:{_BESIDE}) ")


def wants_room_there(said: str, rest: Sequence[str]) -> bool:
    """Whether somebody wants room beside something, which is where what goes "there" next goes, and
    not in or on that.
    """
    beside = lacks_room(said) and _ROOM_BESIDE.search(said)
    return bool(beside) and any(_THERE.search(words) for words in rest)


def lacks_room(said: str) -> bool:
    """Whether this is what a clause tells ("I need some space here")."""
    return bool(_LACKING.fullmatch(said))

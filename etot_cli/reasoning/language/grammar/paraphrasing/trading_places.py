"""Ways of saying that two things take each other's place."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.reasoning.language.words.small_words import NAMED

_ENDS = r"(?=[.,;!?]|$)"
_FLAT = frozenset({"tray", "plate", "saucer", "mat", "board", "shelf", "book", "tile", "coaster"})
_THING = rf"{NAMED}(?: (?!and\b|or\b|in\b|on\b|not\b|should\b)\w+){{1,4}}?"
_GOES = (
    r"(?:belongs|goes|(?:should|must|is to|has to|needs to)"
    r" (?:be|go|stand|lie|end up|belong|come|be (?:put|moved|placed)))"
)
_VERB = r"(?:(?:re)?arrange|swap|exchange|switch|put|move|place|bring|set|shift|transfer|relocate)"
_SPOT = r"(?:places?|positions?|spots?|locations?)"
_EACH = r"(?:both|each(?: one| of them)?|they)"
_ITS_OTHER = (
    rf"(?:(?:in|into|to|at|on) (?:the other(?: one)?|each other|one another) ?'s {_SPOT}"
    r"|(?:to )?where the other(?: one)? (?:is|was|stands|stood|lies|lay)"
    r"(?: (?:lying|standing|now|before))*)"
)


def _swapped(said: re.Match[str]) -> str:
    """What takes each other's place, told by what both are in or on."""
    begun, place = said[1], singular(said[6])
    where = (
        f"that is {'on' if place in _FLAT else 'in'} {'an' if place[0] in 'aeiou' else 'a'} {place}"
    )
    return f"{begun}swap {said[2] or said[4]} {where} and {said[3] or said[5]} {where}"


TRADING_PLACES: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (
        rf"(^|[.;!] )({NAMED} [^.,:;]*?) should (?:trade|swap|switch|change|exchange) places: ",
        r"\1swap \2: ",
    ),
    # "Let the cup and the jar change trays": each has to be on one
    (
        rf"(^|[.;!] |\b(?:and|then) )"
        rf"(?:(?:let|have|make) ({NAMED} [^.,:;]*?) and ({NAMED} [^.,:;]*?)"
        rf"|({NAMED} [^.,:;]*?) and ({NAMED} [^.,:;]*?) (?:should|must|have to|are to)) "
        rf"(?:change|swap|exchange|trade|switch) (?!places|positions|spots)(\w+s){_ENDS}",
        _swapped,
    ),
    # "The cup should be where the jar is now, and vice versa"
    (
        rf"\b(?:(?:i|we) (?:want|would like|need) |{_VERB} )?({_THING})(?: to be| {_GOES})?"
        rf" (?:(?:to )?where ({_THING}) (?:is|was|stands|stood|lies|lay)(?: now)?"
        rf"|in ({_THING}) ?'s {_SPOT}),? and (?:vice versa|the other way a?round){_ENDS}",
        lambda said: f"swap {said[1]} and {said[2] or said[3]}",
    ),
    # "Move the cup and the jar so that each ends up in the other's place"
    (
        rf"\b(?:{_VERB}|make|have|(?:i|we) (?:want|would like)) "
        rf"({_THING},? and {_THING}|{_THING}(?<=[^s]s)|them|both of them)[,:]?"
        rf"(?: (?:so(?: that)?|such that))?(?: {_EACH})?(?: to| must| should| has to)?"
        rf"(?: (?:end up|ends up|is|are|be|goes|go|stands?|lies?|comes to (?:stand|lie)))? "
        rf"{_ITS_OTHER}{_ENDS}",
        r"swap \1",
    ),
    (
        rf"(^|[.;!] )({_THING},? and {_THING})(?: {_EACH})? (?:should|must|are to|have to)"
        rf"(?: {_EACH})? (?:be|go|end up|stand|lie) {_ITS_OTHER}{_ENDS}",
        r"\1swap \2",
    ),
)
"""In order."""

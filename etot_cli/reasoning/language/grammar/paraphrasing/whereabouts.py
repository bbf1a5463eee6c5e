"""Ways of saying where things are, come from and go."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.words.small_words import NAMED

_TAKES_PLACE = r"\b(should|must|is to|has to|needs to) take the place of\b"
_ROOM = r"there is (?:still |enough |some |plenty of )?(?:room|space)"
_AT = rf"(?:on|in|next to|beside|behind|in front of|to the (?:left|right) of) {NAMED}"
_SO_PUT_IT = r"so (?:please )?(put|place|set|lay|stand) (?:it|them) (?:in )?there\b"

_END = r"(?=[.,;!?]|$)"
_STACK = r"(?:pile|stack|tower)"
_ALL_ELSE_THERE = (
    r"(?:the rest(?: of it)?|everything else(?: (?:in|on) it)?|all else|the others"
    r"|(?:whatever|what) else (?:is|there is|was) (?:there|in it|on it|in there|on there))"
)


def _not_unstacked(said: re.Match[str]) -> str:
    """A stack, rather than "it" or "them", unless another one was spoken of before."""
    if re.search(rf"\b{_STACK}s?\b", said.string[: said.start()]):
        return said[0]
    return f"{said[1]}{said[3]} {said[2]}" if said[3] else f"{said[1]}{said[4]} {said[2]} apart"


WHEREABOUTS: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (
        r"\byou (?:will|can|should) find (it|(?:the|my) \w+(?: \w+)?) "
        r"(?=(?:in|on|inside|next|beside|behind|near|at)\b)",
        r"\1 is ",
    ),
    (
        r"(^|[.;!] )where (?:i|we) (?:sit|stand|work|eat|am|are)(?: now)?, "
        r"(?=(?:at|on|in|to|next to|beside|near) )",
        r"\1",
    ),
    (
        r"\bon the (?:\w+ )?(?:shelf|bookcase|rack|unit), "
        r"(?=on the same (?:level|board|shelf) as\b)",
        "",
    ),
    (_TAKES_PLACE, r"\1 go in place of"),
    (
        rf"\breach (?:in|into|inside) ({NAMED} [^.,;]*?) and (grab|take|get|pick up) "
        r"([^.,;]*?)(?=[.,;!?]| and\b|$)",
        r"\2 \3 from \1",
    ),
    (r"\bgo(es)? away (?=(?:in|into|on|onto)\b)", r"go\1 "),
    (rf"(^|[.;!] )({_AT} [^.,;]*?),? {_ROOM} for ({NAMED} [^.,;]*), {_SO_PUT_IT}", r"\1\4 \3 \2"),
    (rf"\b{_ROOM} for ({NAMED} [^.,;]*? {_AT} [^.,;]*), {_SO_PUT_IT}", r"\2 \1"),
    (
        rf"\b{_ROOM} (on|in) "
        rf"({NAMED} [^.,;]*), so (?:please )?(put|place|set|lay|stand) ([^.,;]*?) (?:in )?there\b",
        r"\3 \4 \1 \2",
    ),
    (
        r"\b(nothing (?:should|must) be left) (in|on) ([^.,;]*?) or (in|on) ",
        r"\1 \2 \3 and \1 \4 ",
    ),
    (
        rf"\b(?:bring|carry|take|move) ({NAMED} [^.,;:]*?) (?:over |across )?"
        rf"to ({NAMED} (?:\w+ )?(?:tray|plate|board|mat|shelf)),? and "
        r"(?:put|set|lay|place) it (?:down )?"
        r"(?=(?:next to|beside|behind|in front of|to the (?:left|right) of)\b)",
        r"put \1 on \2 ",
    ),
    (
        rf"\b(?:take|carry|move|bring|shift) ({NAMED} [^.,;:]*?) (?:over |across )?"
        rf"to ({NAMED} [^.,;:]*?), (?:right |just |close )?"
        r"(next to|beside|behind|in front of|to the (?:left|right) of) it(?=[.,;!?]| and\b|$)",
        r"put \1 \3 \2",
    ),
    (
        r"\bwhere ((?:the|my) [^.,;]*?|it|they) (?:stood|lay|sat|used to be|has been|had been)\b",
        r"where \1 was",
    ),
    (r"\bfrom one (\w+) (?:in)?to the other(?=[.,;!?]|$| and\b)", r"to the other \1"),
    (r"\b(?:to )?somewhere (?=(?:behind|next to|beside|near|in front of|between)\b)", ""),
    # "It" is the stack that something goes onto; one that goes somewhere itself is moved
    (
        rf"\b((?:on|onto|on top of|atop) ((?:the|that|this|my) {_STACK}(?: of \w+)?)"
        r",? (?:but |and )?(?:do not|without|never|not) )"
        rf"(?:(unstack(?:ing)?) (?:it|them)|(tak(?:e|ing)) (?:it|them) apart){_END}",
        _not_unstacked,
    ),
    # What is on what is emptied goes to several places
    (
        rf"(^|[.;!] )((?:please |now |then |just )*)(?:clear|empty) ({NAMED} (?:\w+ )??\w+?)"
        rf"(?: off| out| completely| entirely)*[:;,.] ({NAMED} [^.;:!?,]*?,? and )"
        rf"{_ALL_ELSE_THERE} (?=(?:goes|go|belongs|should|must|has to|needs to|in|into|on|onto)\b)",
        r"\1\2\4everything else from \3 ",
    ),
    # Somewhere "there", told next
    (
        r"(?<=\w) (?:up|down|over) there (?=(?:beside|next to|near|between|behind|in front of"
        rf"|(?:to )?the (?:left|right) of|on|in) (?:{NAMED}|it\b|them\b))",
        " ",
    ),
)
"""What they are put into, in order (see ``paraphrases``)."""

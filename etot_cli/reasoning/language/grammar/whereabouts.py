"""Ways of saying where things are, come from and go."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.words.small_words import NAMED

_TAKES_PLACE = r"\b(should|must|is to|has to|needs to) take the place of\b"
_ROOM = r"there is (?:still |enough |some |plenty of )?(?:room|space)"
_AT = rf"(?:on|in|next to|beside|behind|in front of|to the (?:left|right) of) {NAMED}"
_SO_PUT_IT = r"so (?:please )?(put|place|set|lay|stand) (?:it|them) (?:in )?there\b"

WHEREABOUTS: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (
        r"\byou (?:will|can|should) find (it|(?:the|my) \w+(?: \w+)?) "
        r"(?=(?:in|on|inside|next|beside|behind|near|at)\b)",
        r"\1 is ",
    ),
    (
        r"\bthere is nothing (?:left )?(?:in|on|inside) ((?:the|my) \w+(?: \w+)?) (?=and its\b)",
        r"\1 is empty ",
    ),
    (
        r"\bon the (?:\w+ )?(?:shelf|bookcase|rack|unit), "
        r"(?=on the same (?:level|board|shelf) as\b)",
        "",
    ),
    (_TAKES_PLACE, r"\1 go in place of"),
    (r"\b(that|which) (?:has|have) been left (?=open\b)", r"\1 is "),
    (
        rf"\breach (?:in|into|inside) ({NAMED} [^.,;]*?) and (grab|take|get|pick up) "
        r"([^.,;]*?)(?=[.,;!?]| and\b|$)",
        r"\2 \3 from \1",
    ),
    (rf"\band in (its|their) place (put|place) ({NAMED} [^.,;]*)", r"and \2 \3 in \1 place"),
    (
        r"^(next to|beside|behind|in front of|to the (?:left|right) of|where) "
        rf"({NAMED} [^.,;]*?),? "
        rf"(?:i (?:want|would like|need)|there (?:should|must) be) ({NAMED} [^.,;]*)",
        r"put \3 \1 \2",
    ),
    (
        r"(\b(?:and|then)\b[^.;]*?\b)a different "
        r"(?=(?!colou?r|size|kind|way|place|spot|order|one from)\w)",
        r"\1another ",
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
    (r"\b(what is (?:in|on) [^.,;]*?) now (?=(?:should|goes|must|is to)\b)", r"\1 "),
    (r"\b(?:to )?somewhere (?=(?:behind|next to|beside|near|in front of|between)\b)", ""),
)
"""What they are put into, in order (see :mod:`etot_cli.reasoning.language.grammar.paraphrases`)."""

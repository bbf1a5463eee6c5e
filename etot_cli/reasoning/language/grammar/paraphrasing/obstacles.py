"""Ways of speaking of what stands in the way of a drawer or a door, put into plain ones.

Whoever clears the way to it moves all that is blocking it, out of the way of it.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.paraphrasing.corners import TABLE
from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED

_WHAT = r"(?:the|my|our) (?:\w+ ){0,3}?\w+"
_AWAY = r"(?:out of the way(?! of\b)|aside|away(?! from\b))"
_NOT_TO_BE = (
    r"(?:(?:must|should|may|can|shall) not (?:be|stand|get|stay|remain|lie)"
    r"(?: left| standing| lying)?|(?:is|are|has|have) not to be)"
)
_WAY = r"(?:way|path|swing|sweep)"
_ENDS = r"(?=[,.;!?]| (?:and|then|so)\b|$)"
_BLOCKS = (
    r"(?:(?:is |are )?(?:blocking|obstructing)|blocks|obstructs"
    r"|(?:is |are |stands |sits )(?:standing |sitting |lying )?in the way of)"
)
_OPENS = r"(?:open|be opened|be pulled out)"
_HINDERS = (
    rf"(?:{_BLOCKS}|in the way|(?:sticks|sticking|stands|standing|pokes|poking) (?:out|up)"
    r"|(?:can not|will not|does not|not) (?:be )?(?:close|closed|shut|open|opened|fit)"
    r"|(?:keep|prevent|stop)(?:s|ing)|too (?:tall|big|large|high|long))\b"
)
_FIX = (
    r"(?:(?:fix|solve|resolve|sort out|take care of|deal with|do something about|see to)"
    r" (?:it|this|that|the problem))"
)
_TAKE = rf"((?:first )?{ASKED}(?:first )?(?:remove|take away|take out|get rid of) )"
_WHATEVER = r"(?:whatever|what|anything that|everything that|the (?:thing|object) that)"
_KEEPS = r"(?:is |are )?(?:keep|prevent|stop|hinder)(?:s|ing)"
_FROM_CLOSING = r"(?:from )?(?:(?:clos|shutt)ing|being (?:closed|shut))"
_SOMETHING = r"(?:something|a thing|an object)"
_THERE = r"(?:is |stands )?(?:standing |sitting |lying )?(?:in front of it|in the way|blocking it)"


_TURN = "(?:open|opening|close|closing|shut|shutting)"
OBSTACLES: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (
        # Where to is not said
        rf"({_HINDERS}[^.;!?]*(?:[.;!?]+|,) (?:so |and |then )*{ASKED}(?:move|shift) (?:it|them))"
        r"(?=(?: first| beforehand| before\b[^.;!?]*)?(?:[.;!?,]| (?:and|then)\b|$))",
        r"\1 out of the way",
    ),
    (rf"\b(out of|in) ({_WHAT})(?:'s| 's) {_WAY}\b", r"\1 the way of \2"),
    (rf"\b(in|out of) its {_WAY}{_ENDS}", r"\1 the way of it"),
    (
        # "Remove the ball in front of the oven and open it": as it stands there, it is in the way
        rf"\b(?:remove|take away) (?=({_WHAT} (?:in front of|before|{_BLOCKS}) ({_WHAT}))"
        rf",? (?:and |then |and then |before |so that you can )*{_TURN} (?:\2|it)\b)\1",
        r"move \1 out of the way",
    ),
    (
        rf"\b(out of the way(?: of {_WHAT})?),? (?:and|then|and then) (?:set|put|place|lay)"
        rf" (?:it|them)(?: down)? (?:elsewhere|somewhere else)(?: on (?:the|my) {TABLE})?{_ENDS}",
        r"\1",
    ),
    (
        rf"({_WHAT}) {_NOT_TO_BE} in the way(?= of (?:{_WHAT}|it)|{_ENDS})",
        r"move \1 out of the way",
    ),
    # What is asked for next says how
    (
        rf"({_HINDERS}[^.;!?]*)(?:[.;!?]+|,) (?:so |and )*{ASKED}{_FIX}"
        rf"(?: and(?: then)?|[.;:!,](?: then| and)*) (?=\w)",
        r"\1. ",
    ),
    (
        rf"(^|[.;] )(?:({_WHAT}) (?:can not|will not|does not) {_OPENS}"
        rf" because {_SOMETHING} {_THERE}"
        rf"|(?:i|we|you) can not open ({_WHAT}) because {_SOMETHING} {_THERE}"
        rf"|{_SOMETHING} {_BLOCKS} ({_WHAT}))"
        rf"[.;,](?: so)? {ASKED}(move|put|take|bring|place) "
        rf"(?:(?:that|the)(?: thing| object)|that|it) "
        rf"(?=(?:on|in|onto|into|to|next|beside|near|behind|out)\b)",
        lambda said: (
            f"{said[1]}{said[5]} the thing that is blocking {said[2] or said[3] or said[4]} "
        ),
    ),
    (
        rf"(^|[.;] )({_WHAT}) (?:can not|will not|does not) {_OPENS} because ({_WHAT}) {_THERE}"
        rf"(?=[.;,])",
        r"\1\3 is blocking \2",
    ),
    # "Remove whatever keeps the drawer from closing": what is in it, if that is one thing
    (
        rf"\b{_TAKE}{_WHATEVER} ({_KEEPS} ({_WHAT}) {_FROM_CLOSING})(?= (?:and|then)\b|[.;,!]|$)",
        r"the thing in \3 \2. \1it",
    ),
    (
        rf"(^|[.;!] )something ({_KEEPS} ({_WHAT}) {_FROM_CLOSING})(?=[.;,!] )",
        r"\1the thing in \3 \2",
    ),
    # What keeps it from opening stands before it
    (
        rf"\b{_TAKE}{_WHATEVER} {_KEEPS} ({_WHAT}) (?:from )?(?:opening|being opened)"
        r"(?= (?:and|then)\b|[.;,!]|$)",
        r"\1everything that is blocking \2",
    ),
    (
        rf"\b(?:whatever|what|anything|everything)(?: that| which)? {_BLOCKS} (?={_WHAT})",
        "everything that is blocking ",
    ),
    (
        rf"\b(that is blocking) ({_WHAT}) {_AWAY}{_ENDS}",
        r"\1 \2 out of the way of \2",
    ),
    (
        rf"\b(?:clear|free(?: up)?|unblock) "
        rf"(?:the (?:way to|path to|(?:space|area|spot|room) in front of) (?={_WHAT}{_ENDS})"
        rf"|(?=(?:the|my|our) (?:\w+ ){{0,2}}door(?: of {_WHAT})?{_ENDS}))({_WHAT}){_ENDS}",
        r"move everything that is blocking \1 out of the way of \1",
    ),
    (
        rf", but ({_WHAT}) (?:is|are) in the way(?: of it)?[,;.]? (?:so )?{ASKED}"
        rf"(move|put|take|bring|place) (?:it|them) ",
        r", but \2 \1 ",
    ),
)
"""In order, before other ways of speaking."""

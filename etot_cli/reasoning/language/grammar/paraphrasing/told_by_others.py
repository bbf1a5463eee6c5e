"""Things and places told by others that were named: "the latter", "same place", "neither of them",
"one drawer is for the chalk, the other for the pins".
"""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.asides.people import PEOPLE
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.small_words import NAMED

_ONE = r"(?:the|my|our) (?:(?!and\b|or\b|in\b|on\b|to\b|of\b)\w+ ){0,3}?\w+"
_PUT = "put|place|set|lay|stand|move|store|stow"
_BESIDE = "in front of|behind|beside|next to|in|on|on top of|inside"
_BY_MISTAKE = "(?:by (?:mistake|accident)|accidentally|mistakenly|inadvertently|wrongly)"
_LEVEL = r"(?:the )?(?:top|upper|middle|lower|bottom)(?: one)?"
_END = r"(?=[.,;!]|$)"


def _of_the_two(said: re.Match[str]) -> str:
    """What goes to the one or the other of two things that were named before it."""
    meant = said["first"] if said["former"] else said["second"]
    return f"{said['before']}{meant}"


TOLD_BY_OTHERS: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    # "Put the bin in front of the crate and the bell in the latter"
    (
        rf"\b(?P<before>(?:{_PUT}) (?P<first>{_ONE}) (?:{_BESIDE}) (?P<second>{_ONE})"
        rf" and {_ONE} (?:{_BESIDE}|into|onto) )the (?:(?P<former>former)|latter){_END}",
        _of_the_two,
    ),
    # "The pen goes on the tray, then the tray with it goes on the shelf": it comes along
    (
        r"(\b(?:in|into|on|onto) (?:the|my) (?P<told>\w+ )?(?P<what>\w+)(?:[.;]|,? and|,) "
        rf"(?:(?:then|next|after that|afterwards),? )*(?:(?:{_PUT}|bring) )?"
        r"the (?:(?P=told))?(?P=what)) with "
        r"(?:it|them|that)(?: (?:in|on) (?:it|there))? "
        r"(?=(?:goes|should|must|has to|belongs|in|on|to|into|onto|next|beside|behind)\b)",
        r"\1 ",
    ),
    # "Pick up the cup. Put the grasped object on the tray"
    (
        rf"(\b(?:pick up|grasp|grab|lift|take|grip) {_ONE}(?:(?!\b(?:{_PUT}|drop|bring)\b)[^!?])*?"
        rf"(?:[.;,]|,? and) (?:(?:and|then|now|next|please),? )*(?:{_PUT}|drop|bring|insert)) the "
        r"(?:grasped|gripped|held|lifted|picked(?: up)?) (?:(?P<it>object|item|thing)|(?=\w))",
        lambda said: f"{said[1]} {'it' if said['it'] else 'that '}",
    ),
    # "After that comes the duck, same place"
    (
        rf"(^|[.;!] )(?:(?:(?:after that|then|next),? comes? |then )?({_ONE}), )"
        r"(?:in |to |into )?(?:the )?same place(?=[.;!]|$)",
        r"\1then put \2 in the same place",
    ),
    # "Put one reel in the tin: the one on the left"
    (
        rf"\b(?:one|an?) (\w+)(?:(?P<goes>(?: (?:in|into|on|onto|to) {NAMED}[^.,:;!?]*?)?):|,)"
        r" (?:namely )?the one (?:(?:that|which) is )?(?=(?:on|at|in|next|behind|beside|near)\b)"
        rf"([^.,:;!?]*)(?(goes){_END}|(?=[.;!]|$))",
        lambda said: f"the {said[1]} that is {said[3]}{said['goes'] or ''}",
    ),
    # "The drawer that is open, close that one as well"
    (
        rf"(^|[.;!] )({NAMED} [^.,;:!?]+, (?:please )?(?:open|close|shut|take|put|place|move)) "
        r"(?:that|this) one\b",
        r"\1\2 it",
    ),
    # "A reel, which goes in the tin, and the lid, which goes next to it"
    (
        rf"((?:^|[.;!:] |, (?:and )?){NAMED} (?:\w+ ){{0,2}}?\w+), which "
        r"((?:goes|go|belongs?|(?:should|must) (?:go|be)) [^.,;:!?]*?)"
        rf"(?=[.;!]|$|,? and {NAMED} (?:\w+ ){{0,2}}?\w+, which )",
        r"\1 \2",
    ),
    # "Do not worry about the lids, they can stay"
    (
        rf"\bdo not worry about (?P<what>{NAMED} (?:\w+ ){{0,2}}?(?!mess\b"
        r"|clutter\b|chaos\b|muddle\b|noise\b|smell\b|dust\b|time\b|order\b)\w+)"
        rf"(?:[,;] (?:they|it|those|that) (?P<stays>can stay)\b|{_END})",
        lambda said: (
            f"{said['what']} {said['stays']}"
            if said["stays"]
            else f"you do not have to touch {said['what']}"
        ),
    ),
    # "I have put the reel on the tin by mistake. It should be on the shelf": the reel
    (
        rf"((?:put|placed|set|laid) ({NAMED} (?:\w+ ){{0,2}}?\w+) (?:{_BESIDE}|into|onto) {_ONE}"
        rf" {_BY_MISTAKE}[.;,] )it (?=(?:should|must|has to|belongs|goes)\b)",
        r"\1\2 ",
    ),
    (
        rf"(^|[.;!] )((?!you\b|no)(?:{PEOPLE}|they)) (?:(?:have|has|had) (?:{_BY_MISTAKE} )?"
        rf"|{_BY_MISTAKE} |(?=[^.,;:!?]* {_BY_MISTAKE}{_END}))(?:put|placed|set|laid) "
        rf"({NAMED} [^.,;:!?]*?)(?: {_BY_MISTAKE})?{_END}",
        r"\1\2 left \3",
    ),
    # "On the shelf, top or bottom"
    (
        rf"\bon the (shelf|rack|bookcase|bookshelf), ({_LEVEL} or {_LEVEL}){_END}",
        r"on the \2 board of the \1",
    ),
    # "Two reels in the tin, as long as neither of them is white"
    (
        r"\b((?:any )?(?:two|three|four) \w+s) ([^.,;:!?]*?)(?:, (?:whichever|any) you "
        r"(?:like|want|fancy|prefer|choose))?,? (?:as|so) long as (?:neither|none) of "
        r"(?:them|those) is (\w+)(?=[.;!]|$)",
        r"\1 that are not \3 \2",
    ),
    # "One drawer is for the chalk, the other for the pins; put them away like that"
    (
        rf"(^|[.;!] )one (\w+) is (?:meant )?for ({_ONE}),?(?: and)? the other(?: one)?(?: is)?"
        rf"(?: meant)? for ({_ONE})[.;:!,] (?:so )?(?:please )?(?:{_PUT}|sort) (?:them|both)"
        r"(?: away)?(?: (?:like that|that way|accordingly|there))?(?=[.;!]|$)",
        r"\1put \3 in one \2 and \4 in the other \2",
    ),
    # "The bigger of the lids goes in the bowl with the smaller"
    (
        r"(\bof the \w+s\b[^.;!?]*\bthe (?:bigger|smaller|larger|taller|shorter|longer))"
        r"(?=[.;!]|$)",
        r"\1 one",
    ),
    # "Shelve the jars by size: the biggest one on the bottom board, …"
    (
        r"\b((?:put|place|shelve|arrange|sort|store|distribute) [^.,;:!?]*?) (?:by|in order of"
        r"|according to)(?: their)? size: (?=the (?:big|small|larg|tall|short)\w+)",
        r"\1: ",
    ),
    # "The jar on the bottom board, the cup on the top one, and the pot on the board in between"
    (
        r"(\b(?:(top)|bottom) (board|shelf|drawer)\b[^.;!?]*\b(?(2)bottom|top) (?:\3|one)\b[^.;!?]*"
        r"\b(?:on|in|into|onto) )the (?:\3|one) (?:in )?between(?: them)?(?=[.,;!]|$)",
        r"\1the middle \3",
    ),
)
"""In order."""

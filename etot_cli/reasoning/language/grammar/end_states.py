"""How things are to be in the end, told in another order or by other verbs, put into plain words."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.listings import ASKED
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.small_words import NAMED

_MUST = r"should|must|shall|may|can|could|has to|have to|is to|are to|needs? to|ought to"
_SOME = rf"{NAMED}(?: (?!and\b|or\b|in\b|on\b)\w+){{1,4}}?"
_BE = r"be|go|come|stand|lie|sit|rest|end up|move|return|stay|remain|follow"
_ALL_OF = {"any": "none", "either": "neither"}
_LATTER = Expression(
    rf"({_SOME}) and ({_SOME})(?= |[.,;])([^!?]*)\bthe (?:former|latter)\b[^!?]*"
)
"""Two things, and what is said of either by which was named first."""


def _nor(said: re.Match[str]) -> str:
    """What is not to be so either."""
    modal, quantity, them, be = said.groups()
    if quantity:
        return f" and {_ALL_OF[quantity]} of {them} {modal} {be}"
    return f" and {them} {modal} not {be}"


def _named_again(said: re.Match[str]) -> str:
    """The things themselves for "the former" and "the latter"; of which two is clear of a sole pair."""
    pairs = re.findall(rf"\b{_SOME} and {NAMED}", said[0])
    if len(pairs) > 1:
        return said[0]
    return re.sub(
        r"\bthe (former|latter)(?: one)?\b(?! \w+s\b)",
        lambda which: said[1] if which[1] == "former" else said[2],
        said[0],
    )


END_STATES: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    # "Only then should the cup be put there", "after that, and only then, should it …"
    (
        r"(\b(?:after|once|when|as soon as) [^.;]*?),? and only then,? "
        rf"(?:{_MUST}) ({_SOME}|it|they) (?=(?:{_BE})\b)",
        r"\1, \2 should ",
    ),
    (
        r"\b(?:only|and) (?:then|after that|afterwards),? "
        rf"(?:{_MUST}) ({_SOME}|it|they) (?=(?:{_BE})\b)",
        r"then \1 should ",
    ),
    # "…, nor should any of them be open"
    (
        rf",? (?:and )?nor ({_MUST}) (?:(any|either) of )?({_SOME}|it|they|them) ({_BE})\b",
        _nor,
    ),
    # "The blue one, though, should lie there"
    (rf", (?:though|however|on the other hand|in turn|for (?:its|their) part),(?= (?:{_MUST})\b)", ""),
    (
        r"\b(stays?|remains?|be|left|kept|leave (?:it|them)|keep (?:it|them)) "
        r"(?:exactly |just )?as (?:far |wide )?(?:open|closed|shut) as (it is|they are)\b",
        r"\1 as \2",
    ),
    # Places that are left open
    (
        r",? (?:be it|whether|no matter whether) "
        r"(?=(?:in|on|inside|into|onto) [^.,;:]*? or (?:in|on|inside|into|onto) )",
        " either ",
    ),
    (
        rf"^({ASKED}(?:put|store|stow|tidy|clear|pack)(?: away)? "
        r"(?:(?!in\b|on\b|into\b|onto\b|to\b|next\b)\w+,? )+?(?:away)?),? ?using "
        rf"(?=(?:either )?{_SOME}(?:, {_SOME})*,? or )",
        r"\1 in ",
    ),
    (
        rf"\bfor (?:each|every one|either|both) of ({_SOME}(?:(?:,|,? and) {_SOME})*), "
        r"(?:please )?(?:choose|pick|select|decide on) "
        rf"((?:either )?(?:{NAMED} )?\w+(?: \w+)? or (?:{NAMED} )?\w+(?: \w+)?|an? \w+(?: \w+)?),?"
        r" and (?:put|place|set) (?:it|each|that one|the thing) (?:there|in it|into it|inside)\b",
        r"put \1 in \2",
    ),
    # What is to be under a thing that lies on it now bears it
    (
        rf"\b(?:(?:i|we) (?:would )?(?:like|need|want)|put|place|get|set) ({_SOME}) "
        rf"(?:to (?:be|go|lie) )?(?:under|underneath|beneath|below) ({_SOME}),? "
        r"(?:rather than|instead of|and not|not) (?:lying |being )?(?:on(?: top)?(?: of)?|above|over)"
        r"(?: (?:it|them))?(?=[.,;!]|$)",
        r"put \2 on \1",
    ),
    (
        r"\b(instead of|rather than) (?:just )?(?:lying|standing|sitting|being)"
        rf"(?: (?:about|around))? (?=(?:in|on) {NAMED})",
        r"\1 ",
    ),
    (_LATTER, _named_again),
    # "With the cup still on the tray" tells of no tray.
    (
        r"(?<=\w) with (?="
        rf"{_SOME} (?:still|staying|remaining|left) (?:standing |lying |sitting |resting )?"
        rf"(?:on|in|inside|there|where|untouched)\b)(?!{_SOME} still (?:in|on) it\b)",
        ", with ",
    ),
)
"""In order."""

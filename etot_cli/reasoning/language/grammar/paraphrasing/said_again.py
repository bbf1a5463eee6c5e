"""What is said again to make sure which thing is meant ("the jar, namely the big one").

What stands behind a thing to tell it has one plain form, an article and "one" behind a comma.
"""

from __future__ import annotations

import re

from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import LEVELS, is_descriptive
from etot_cli.reasoning.language.words.small_words import NAMED

_TO_BE_EXACT = r"(?:namely|viz\.?|that is to say|to be (?:precise|exact|specific)|i\.e\.),?"
_SO_MANY = r"(?:exactly|only|just) one"
_SHOULD = (
    r"(?:should|must|may|can|shall|will|ought to|has to|needs to|is to|is allowed to)(?= be\b)"
)
_WHICH = r"the (?:(?P<told>\w+)(?: one)?|one (?P<so>(?!of )[^.,;:]+?))"
_NOT_THERE = r"(?! (?:of|drawer|shelf|board))"

_SUNDRY = (
    "tools?|things|objects|items|parts|containers|vessels|utensils|equipment|stuff|supplies"
    "|materials|goods|belongings|tableware|crockery|toys|stationery|groceries"
)
"""What such words mean is whatever is listed behind them."""
_ITEM = Expression(rf"(?:{NAMED}|one\b|two\b|three\b)")
_APART = "all any no both other two three four of but except"
_NOT_COUNTED = "".join(rf"(?<!\b{word} )(?<!\b{word} the )" for word in _APART.split())
"""Behind such words more may be meant than is listed, or less."""
_LISTED = r"(?:(?!not\b|no\b|all\b|in\b|on\b|at\b|from\b|see\b|without\b|e ?\.)[a-z][a-z -]*)"


def _by_list(said: re.Match[str]) -> str:
    """Things of all sorts in brackets, for the word that only sums them up."""
    told = re.split(r",? and |, ?", said["listed"].strip())
    if any(is_descriptive(item.split()[-1]) or item.split()[-1] in LEVELS for item in told):
        return said[0]
    only = "only" in (said["before"], said["behind"])
    told = [f"the {item}" if only and not _ITEM.match(item) else item for item in told]
    return f"{'only ' if only else ''}{', '.join(told[:-1])} and {told[-1]}"


def _without_assurance(said: re.Match[str]) -> str:
    """What is said again, with "one" for the noun that it leaves out."""
    again = said["again"]
    last = again.split()[-1]
    return f"{again} one" if is_descriptive(last) or last in LEVELS else again


def _only_that(said: re.Match[str]) -> str:
    """That one and no other, where it is told which it is ("exactly one pen, the red one, …")."""
    noun = f"{said['told']} {said['noun']}" if said["told"] else f"{said['noun']} {said['so']}"
    if said["told"] in ("same", "other", "rest", "one"):
        return said[0]
    return f"{said['before']}only the {noun} {said['rest']}"


def _state_again(said: re.Match[str]) -> str:
    """What is so of another thing, or is not, with the state that it leaves out."""
    denied = " not" if said["other_not"] else ""
    return f"{said['first']}{said['joint']}{said['other']} is{denied} {said['state']}"


SAID_AGAIN = (
    (
        # "Stow tools only (screwdrivers, loupe) in the drawer"
        rf"{_NOT_COUNTED}\b(?:(?P<before>only) )?(?:(?:the|my|these|those) )?(?:{_SUNDRY})"
        rf"(?: (?P<behind>only))? \((?P<listed>{_LISTED}(?:(?:, ?|,? and ){_LISTED})+)\)",
        _by_list,
    ),
    (
        # "The drawer is not open, the door is"
        r"(?P<first>\bthe [^.,;:]*? is (?P<not>not )?(?P<state>open|closed|shut)(?: again)?)"
        r"(?P<joint>,? (?:and|but) |, )(?P<other>the (?:\w+ ){0,3}?\w+) is(?P<other_not> not)?"
        r"(?=[.,;!?]|$| and\b| but\b)",
        _state_again,
    ),
    (
        r"\b(each|every one|all|both|either|any|one) of (the|my) ((?:\w+ ){0,2}\w+) ?'s "
        r"((?:(?:two|three|four|five) )?\w+s)\b",
        r"\1 of the \4 of \2 \3",
    ),
    (
        r"(\b(?:should|shall|must|will|(?:is|are|has|have) to) [^.;:]*?),? (?:in|at|by) the "
        r"(?:very )?end(?=: )",
        r"\1",
    ),
    (r"\bunstack (the [^.,;:]*?) (?=(?:onto|on to|into) )", r"put \1 "),
    (r", all in (?=(?:exactly |precisely )?(?:that|this) order\b)", ", in "),
    (r", (?:that is|i\.e\.),? (?=nothing\b)", ", "),
    (rf", {_TO_BE_EXACT} (?=(?:the|a|an|one|my|in|on|into|onto|to|next)\b)", ", "),
    (r"(?P<again>\b(?:one|an?) \w+, the \w+)(?=[.,;!?]|$)", _without_assurance),
    (
        r"(?P<again>, (?:the|my) (?:\w+ ){0,2}\w+)(?<! one)(?<! ones),? (?:that is|i mean)"
        r"(?=[.,;!?]|$)",
        _without_assurance,
    ),
    (r"(, (?:the|my) (?:\w+ ){0,2}ones?),? (?:that is|i mean)(?=[.,;!?]|$)", r"\1"),
    (
        r", whose (door|lid|drawer) (?:you|should|must|is to)(?: be)?(?: (?:then|afterwards))? "
        r"(close|shut|open)(?:d|ed|ned)?(?: (?:then|afterwards|again|in the end))?(?=[.,;!?]|$)",
        r", then \2 its \1",
    ),
    (r"(\bwhat(?:ever)? was on (?:top of )?(it|them)\b[^.,;]*? back on top)(?! of)", r"\1 of \2"),
    (
        rf"(?P<before>^|[.;,] )(?:{_SO_MANY}) (?P<noun>\w+(?: \w+)?), {_WHICH},? "
        rf"(?P<rest>{_SHOULD})",
        _only_that,
    ),
    (
        rf"(?P<before>^|[.;,] )(?:{_SO_MANY}) (?P<noun>\w+(?: \w+)?) (?P<rest>{_SHOULD} [^.,;:]+)"
        rf" ?[,:] {_WHICH}(?=[.;!?]|$)",
        _only_that,
    ),
    (
        r"\b((?:that|which) (?:is|are|stands?|lies?|sits?)) (?:up|down|over|right|already) "
        r"(?=there\b)",
        r"\1 ",
    ),
    (
        r"\b((?:tower|stack|pile)\b[^.;]*? )at (?:its|the) (?:very )?(?:foot|base|bottom)\b"
        rf"{_NOT_THERE}",
        r"\1at the bottom",
    ),
)
"""Rewritings, in order."""

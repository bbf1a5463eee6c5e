"""Where the robot is told to go before it does something: an arm reaches there as it is."""

from __future__ import annotations

from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import VERB_WORDS

_GO = r"(?:go|walk|drive|navigate|head|roll)"
_AT = (
    r"(?: (?:over|back|up|across|on|straight|directly))? (?:to|towards)"
    r" (?:the|my|our) (?:\w+ ){0,2}?\w+"
)
_GOING = Expression(rf"(?:and )?(?:then )?{_GO}{_AT}")
_GOING_FIRST = Expression(rf"(?:please )?(?:{_GO}|move){_AT}")
"""After "pick up the cup" who is to "move to the shelf" rather brings it there."""
_THERE = Expression(
    r"(?:\b(?:there|here|down|away|back|in|inside|off|out)$|\b(?:there|here|down|away) and\b)"
)
"""Such a place depends on where that is done."""
_DOING = "|".join(sorted(VERB_WORDS | {"open", "close"}))


def goes_to_it(said: str, behind: str, *, first: bool) -> bool:
    """Whether a clause only tells where the robot does what the next one asks for."""
    going = (_GOING_FIRST if first else _GOING).fullmatch(said)
    return bool(going) and not _THERE.search(behind)


GOING: tuple[tuple[str | Expression, str], ...] = (
    # "Walk to the shelf and take the cup"
    (
        Expression(
            rf"(^|[.;,] |\band |\bthen )((?:please )?(?:{_GO}|move){_AT}),? and (?:then )?"
            rf"(?=(?:{_DOING})\b)"
        ),
        r"\1\2, ",
    ),
    # "Find a cup. Pick up the cup": what is taken has been found
    (
        Expression(
            r"(^|[.;,\n] ?)(?:find|locate|look for|search for) (?:an?|the) (\w+(?: \w+)??)"
            r"[.;,\n]+ ?(?:and |then )*"
            r"(?=(?:pick up|take|grasp|grab|get|fetch|lift) (?:an?|the) \2"
            r"(?:[.;,\n]|$| (?:and|then|from)\b))"
        ),
        r"\1",
    ),
)
"""What is done there stands behind a comma."""

"""What is told of a scene before it is said what is to be done there ("the robot faces a bench with
two cups"): that there are these things, and no more.
"""

from __future__ import annotations

import re

_ROBOT = (
    r"(?:the|a|an|your|our) (?:[\w-]+ ){0,2}?"
    r"(?:robot|arm|manipulator|franka|panda)(?: arm)?"
)
_SURFACE = (
    r"(?:the|a|an) (?:\w+ )??(?:table ?top|table|(?:work ?)?bench|desk|counter|worktop|work ?space"
    r"|work surface|scene|environment|setup)(?: scene)?"
)
_BEFORE = r"(?:before|in front of|at|by|behind)"
_THERE = r"(?:is|are|stands?|lies?|sits?)"
_STANDS = r"(?:is(?: (?:mounted|placed|standing|located|positioned|installed))?|stands|sits)"
_AHEAD = (
    rf"(?:{_ROBOT} (?:faces|is facing|looks at|{_STANDS} {_BEFORE}) {_SURFACE} (?:with|containing)"
    rf"|you (?:are (?:given|shown|presented with|facing|looking at|{_BEFORE})|(?:can )?see|face"
    rf"|observe)(?: {_SURFACE} (?:with|containing))?"
    rf"|{_BEFORE} (?:{_ROBOT}|you),? (?:there )?{_THERE}"
    rf"|on {_SURFACE} {_BEFORE} (?:{_ROBOT}|you),? (?:there )?{_THERE}"
    r"|the (?:(?:current|whole) )?(?:scene|environment|work ?space|set ?up|simulation) "
    r"(?:contains|includes|has|holds|shows|consists of|comprises|features)"
    r"|(?:scene|environment|work ?space|objects?)(?: description)? ?:(?: there (?:is|are))?)"
)
_ASKS = (
    r"(?:to|must|should|shall|not|no|none|if|when|that|which|who|where|please|needs?|want|you|only"
    r"|put|place|move|goes|go|empty|open|closed)"
)
"""With such a word more is said of things than that they are there."""


def _there(said: re.Match[str]) -> str:
    several = said["what"].split()[0] not in ("a", "an", "one", "the")
    return f"there {'are' if several else 'is'} {said['what']}"


SCENE_SETTING = (
    (
        rf"^{_AHEAD} (?P<what>(?:a|an|the|one|two|three|four|five|six|some|\w+s\b)"
        rf"(?:(?!\b{_ASKS}\b)[^.;:!?\n])*?)(?: on (?:it|top))?(?=[.;!]\s*\S)",
        _there,
    ),
    # Where it is told that it is: "you are a household robot in front of a counter"
    (
        r"(^|[.;!] )(you are (?:the|an?|our) (?:[\w-]+ ){0,3}?(?:robot|assistant|helper|manipulator"
        rf"|arm)),? (?:(?:standing|mounted|placed|working) )?(?:{_BEFORE} {_SURFACE}|in an? \w+)"
        r"(?=[.;!]\s*\S)",
        r"\1\2",
    ),
)
"""Rewritings, in order."""

"""From where sides are told: the robot's place, which goes without saying, or somebody else's."""

from __future__ import annotations

import re

from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.grammar.asides.people import PEOPLE
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.world.state import SceneState

_VIEW = r"(?:point of view|viewpoint|perspective|vantage point|view|angle|standpoint|position)"
_SEEN = r"(?:(?:as )?(?:seen|viewed|looked at)|when (?:seen|viewed)|looking|facing (?:it|them))"
_YOURS = (
    rf"(?:{_SEEN} )?from (?:your|the (?:robot|arm)(?:'s|s'|s)?) (?:own )?{_VIEW}"
    rf"|{_SEEN} (?:from|by) (?:you|the (?:robot|arm))(?:'s (?:side|base|place))?"
    rf"|(?:{_SEEN} )?from where (?:you|the (?:robot|arm))"
    r"(?:(?: ?['’](?:re|s)| are| is)(?: (?:standing|sitting|looking))?| stands?| looks?| sits?)"
    r"|(?:(?<=^)|(?<=[.;!?] ))from your side(?=, )"
    r"|(?:the way|as) (?:you|the (?:robot|arm)) sees? (?:it|them|things)"
)
_SIDE = r"(?P<hand>\b(?:to|on) )(?:your|the (?:robot|arm)'s) (?P<side>(?:left|right)(?: side)? of)"
_WHO = (
    r"(?:i|we|he|she|they|(?:some|every|any)(?:body|one)|people"
    r"|(?:my|our|his|her|their|an?|the) (?!robot|arm\b)(?:(?!as\b|and\b)\w+ ){0,2}?\w+)"
)
_WHOSE = rf"(?:my|our|his|her|their|{_WHO}(?:'s|'|s'))"
_OTHERS = (
    rf"(?:{_SEEN} )?from (?:{_WHOSE}|the (?:user|operator|camera)) {_VIEW}"
    rf"|(?:{_SEEN} )?from (?:the |a )?{_VIEW} of {_WHO}"
    rf"|{_SEEN} (?:from|by) (?:me|us|him|her|them|some(?:body|one)|an? \w+"
    r"|(?:my|the (?!robot|arm))[\w ]+?(?=[,.;!?]|$))"
    rf"|(?:{_SEEN} )?from {_WHOSE} side(?! of)"
    rf"|(?:{_SEEN} )?from where (?:{PEOPLE}|they|the (?:user|operator|camera))"
    r"(?: ?['’](?:m|re|s|ll be)| (?:(?:will|would) )?(?:am|are|is|be|stand|look|sit)s?)"
    r"(?: (?:standing|sitting|looking))?"
    rf"|(?:the way|as|how) {_WHO} (?:(?:will|would|can|might|is|are|am) )*"
    r"(?:see(?:s|ing)?|fac(?:es?|ing)|view(?:s|ing)?|look(?:s|ing)? at) (?:it|them|things|this)"
    rf"|(?:the way|as|how) (?:it|they|things|this) (?:looks?|appears?|(?:is|are) seen) "
    rf"(?:to|for|from|by) (?:me|us|him|her|them|{_WHO})"
)
_TOLD = Expression(rf",? ?\b(?P<said>(?P<yours>{_YOURS}|{_SIDE})|{_OTHERS})\b", re.IGNORECASE)
_BEGUN = Expression(r"(?:^|(?<=[.;!?])),")
"""What is left of a comma behind these words where a sentence begins with them."""


def without_viewpoint(instruction: str, scene: SceneState) -> str:
    """An instruction without the words that tell its sides as the robot sees them.

    Raises:
        ReferenceProblem: they are told as somebody else sees them, or the scene's sides are a
            camera's.
    """
    for told in _TOLD.finditer(instruction):
        if not told["yours"]:
            why = "sides are told as the scene's 'viewpoint' has it; say it as the robot sees it"
            raise ReferenceProblem(told["said"], why, 3)
        if scene.forward != (1.0, 0.0):
            why = "the scene is looked at through a camera; say it as that sees it"
            raise ReferenceProblem(told["said"], why, 3)
    plain = _TOLD.sub(
        lambda told: f" {told['hand'].strip()} the {told['side']}" if told["hand"] else "",
        instruction,
    )
    return _BEGUN.sub("", plain)

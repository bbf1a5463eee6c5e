"""What is forbidden in words of everyday speech, put into plain ones."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.small_words import NAMED

_ENDS = r"(?=[.,;:!?]| (?:and|but|while|then|at any|under any)\b|$)"
_SPOT = (
    r"(?:its|their|his|her) (?:\w+ )?(?:spot|spots|place|places|position|positions)"
    r"|(?:the (?:spot|place|position) )?where (?:it is|they are)(?: now| standing| lying)?"
)
_IT = rf"(?:{NAMED}(?: (?!and\b|or\b|in\b|on\b|to\b|not\b)\w+){{1,4}}?|it|they|them)"
_MUST_NOT = r"(?:must|should|may|can|shall|is|are) not(?: to)?"
_MOVING = r"(?:mov(?:e|ing)|touch(?:ing)?|shift(?:ing)?|disturb(?:ing)?|displac(?:e|ing))"
_FROM_THERE = Expression(
    r"\b((?:not|never|without|nor) (?:[^.,;:!?]*? )?"
    r"(?:mov(?:e|ed|ing)|shift(?:ed|ing)?|budg(?:e|ed|ing)|stir|tak(?:e|en|ing)|lift(?:ed|ing)?"
    r"|remov(?:e|ed|ing)|displac(?:e|ed|ing))(?: [^.,;:!?]*?)?)"
    rf" (?:away )?(?:from|off|out of) (?:{_SPOT}){_ENDS}"
)
"""What is not to be moved, with from where: that is where it is by now."""
FORBIDDING: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    (
        r"(?<=\w),? (?:but|(?:but|and) (?:please )?do (?:it|this|that|so)) without (?=\w+ing\b)",
        ", without ",
    ),
    # "Don't you dare touch it", "don't even think of moving it"
    (
        r"\b(do not|never) (?:you )?(?:even |ever )?"
        r"(?:dare(?: to)?|(?:think|dream) (?:of|about)) (?=\w)",
        r"\1 ",
    ),
    # "The cup and the pot on the tray, neither in the other"
    (
        r",? (?:and |with )?neither (?:of (?:them|the two) )?(?:one )?"
        r"(?:stacked |lying |standing )?"
        r"(on(?: top of)?|in|inside) the other(?: one)?(?=[.,;!?]|$)",
        r", not one \1 the other",
    ),
    (_FROM_THERE, r"\1"),
    # "Put it between the cup and the jar without moving either of them"
    (
        rf"\b((?:between|next to|beside|near|behind|in front of) ({_IT}) and ({_IT}),? "
        rf"(?:without|and do not|but do not|but without) {_MOVING}) "
        rf"(?:either|any|both|each)(?: one)?(?: of (?:them|these|those|the two))?{_ENDS}",
        r"\1 \2 or \3",
    ),
    # "Don't leave the door open afterwards"; what stands open on its own account is no such thing
    (
        r"\b(?:do not|never) leave (?!both\b|all\b|any\b|every\b|each\b)"
        rf"({NAMED} (?:\w+ )??\w+) (?:standing )?open"
        rf"(?: (?:afterwards|after that|in the end|at the end|then|when you are done))?(?=[.;!]|$)",
        r"\1 should be closed in the end",
    ),
    # "The pens belong in the cup, and neither the brush nor the knife does"
    (
        rf"\b((?:belongs?|goes?) ((?:in|on|into|onto|inside) {NAMED} (?:\w+ )??\w+)),? "
        rf"(?:and|but) neither ({_IT}) nor ({_IT}) (?:does|do)(?=[.;!]|$)",
        r"\1, but do not put \3 or \4 \2",
    ),
    # "Close it once the pen is in it, and not before"
    (
        r"(\b(?:once|when|after|as soon as) [^.;]*?),? (?:(?:and|but) )?(?:not|never) "
        r"(?:before(?: that| then)?|(?:any )?(?:earlier|sooner))(?=[.;!]|$)",
        r"\1",
    ),
    (rf"\b({_MUST_NOT}) (?:budge|stir|leave (?:{_SPOT})){_ENDS}", "must not be moved"),
    (
        rf"\b({_IT}) (?:must|should|may|shall|is|are) not(?: to)? move{_ENDS}",
        r"\1 must not be moved",
    ),
    (
        rf"\bwithout ({_IT}) (?:moving|budging|stirring|leaving (?:{_SPOT})){_ENDS}",
        r"without moving \1",
    ),
)
"""In order (see :mod:`etot_cli.reasoning.language.grammar.paraphrasing.paraphrases`)."""

"""What is asked for by saying what is not: "not just this, that as well", "instead of putting it
there, put it here", "it is not this that I want but that".
"""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.small_words import NAMED, WHERE

_BEGINS = r"(^|[.;!?] )(?:please,? )?"
_SOME = rf"{NAMED}(?: (?!and\b|or\b|in\b|on\b)\w+){{1,4}}?"
_PUTTING = "dropping|putting|placing|setting|moving|leaving|storing|throwing|standing|laying"
_PUT = "(?:put|place|set|move|drop|store|stand|lay|throw|bring)"
_STATE = r"(?:see|see to it|make sure|ensure|check) that (?:the|my|our|all|both|every)\b"

CONTRASTS: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    (r"(?<!do )\bnot (?:just|only) (the [^.,;:!?]+?),? but (?:also )?(?=the )", r"both \1 and "),
    # "Do not just put the cup in the box; put the pen in as well" asks for both
    (
        rf"{_BEGINS}do not (?:just|only|merely|simply) (?!leave\b|stand\b|sit\b)"
        r"([^.,;:!?]+?)[.,;:!]+ (?:but )?"
        rf"(?=(?:please |also )*(?:{_STATE}|(?!(?:\w+ ){{1,2}}(?:it|them|that|those)\b))"
        r"(?:(?!\b(?:not|never)\b)[^.,;:!?])*?\b"
        r"(?:as well|too|also)\b)",
        r"\1\2; ",
    ),
    # "Do not just open the box, put the pen in it": what is but begun by that
    (
        rf"{_BEGINS}do not (?:just|only|merely|simply) (open {_SOME})[.,;:!]+ (?:but )?(?:also )?"
        rf"(?=(?:{_PUT} {_SOME}(?: and {_SOME})? (?:in|inside|into)(?: it| there)?"
        rf"|(?:take|get) {_SOME}(?: and {_SOME})? out(?: of it)?)(?:[.,;!]| and\b|$))",
        r"\1\2 and ",
    ),
    # "Instead of dropping the cup in the box, put it on the plate"
    (
        rf"{_BEGINS}(?:instead of|rather than) (?:just )?(?:{_PUTTING}) ({_SOME}) "
        rf"((?:in|into|on|onto|inside) {_SOME}), (?:please )?({_PUT}) (it|them) ([^.,;!?]*)",
        r"\1\4 \2 \6 instead of \3",
    ),
    # "Take nothing off the plate except the roll, which goes …", as "do not take anything …"
    (rf"{_BEGINS}(take|remove) nothing (?=(?:off|from|out of) )", r"\1do not \2 anything "),
    # "Do not move anything except the cup, which goes beside the plate"
    (
        rf"\b((?:do not|never) (?:(?:move|touch) anything|(?:take|remove) anything "
        rf"(?:off|from|out of) {_SOME}) (?:except(?: for)?|but|other than|besides) "
        rf"({_SOME})),? (?:and )?which (?=(?:goes|belongs|should|must|is to|has to) )",
        r"\1. \2 ",
    ),
    # "Do not stack the plates; put them side by side on the tray"
    (
        rf"{_BEGINS}do not (?:stack|pile)(?: up)? ({_SOME}(?: and {_SOME})?)[.,;:!]+ (?:but )?"
        rf"(?:please )?({_PUT}) (?:them|both(?: of them)?) (?=side by side |next to each other )",
        r"\1\3 \2 ",
    ),
    # "Put neither cup in the box; put them on the plate instead"
    (
        rf"{_BEGINS}(?:put|place) neither (\w+(?: \w+)?) ((?:in|into|on|onto) {_SOME})[.,;:!]+ "
        rf"(?:but )?(?:please )?({_PUT}) (?:them|both(?: of them)?) ([^.,;!?]*?) instead"
        r"(?=[.;!]|$)",
        r"\1\4 both \2s \5 instead of \3",
    ),
    # "Not the red cup, the other one: put it in the box"
    (rf"{_BEGINS}not ({_SOME}),? (?:but )?({_SOME})(?=: )", r"\1not \2 but \3"),
    # "It is not the cup I want in the box but the pen"
    (
        rf"\bit is not ({_SOME}) (?:that |which )?((?:i|we) (?:want|need|would like)) "
        rf"({WHERE} {_SOME}),? but (?!not\b)({_SOME})(?=[.;!]|$)",
        r"\2 \4 \3, not \1",
    ),
)
"""In order (see ``paraphrases``)."""

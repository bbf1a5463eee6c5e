"""What somebody aims at by a request, told with it or in its place, put plainly."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.paraphrasing.corners import TABLE
from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED
from etot_cli.reasoning.language.words.small_words import NAMED

_ENDS = r"(?=[.,;!?]|$)"
_WISHES = (
    r"(?:want|wants|need|needs|like|love|prefer|wish|expect|is|are|was|has|have|had|ought|supposed"
    r"|meant|it|them|not|going|about|able|ready|allowed)\b"
)
"""Behind these what is "to be" so is part of what they say."""
_STATE = r"(?:state|configuration|situation|arrangement|layout|condition)"


def _to_be_so(said: re.Match[str]) -> str:
    """How a thing is to be, told without a verb; behind a wish or a denial it belongs to that."""
    before = re.split(r"[.;]", said.string[: said.start()])[-1]
    wished = re.search(r"\b(?:want|need|like|not|never|no|without|unless|if|when|until)\b", before)
    return said[0] if wished else f"{said[1]}{said[2]} should be "


AIMS: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    # "Reach a configuration in which the red block is on the blue one"
    (
        rf"(^|[.;!] )({ASKED})(?:(?:reach|achieve|attain|establish|obtain|produce|get to|arrive at"
        rf"|end up in)|(?:bring|get|put|take) (?:the|this) (?:scene|world|workspace|{TABLE})"
        rf" (?:in|into|to)) (?:a|an|the) (?:\w+ )?{_STATE},? (?:in which|where|such that|so that) ",
        r"\1\2make sure that ",
    ),
    # What is held until it is needed is held in the end; what is done then would be waited for
    (
        r"\b((?:hold|hang on ?to|keep hold of|take|pick up|grab|grasp) [^.,;:!?]*?)"
        r"(?: for (?:me|us))? (?:until|till) (?:i|we) (?:(?:need|want|ask for|come for|take) it"
        r"|say (?:so|otherwise)|tell you(?: to| otherwise)?)(?=(?:,? please)?[.!?]*$)",
        r"\1",
    ),
    (
        r"\b((?:put|place|store|stow|tidy|move|drop|lay|goes|go|belongs?)\b[^.;!?]*? (?:in|into|on"
        r"|inside|onto|away)\b[^.;!?]*?)[,;] (it|they) (?:must|should|may|shall) not (?:just )?"
        r"(?:be )?(?:l(?:ie|ying)|sit(?:ting)?|stand(?:ing)?) (?:around|about)"
        rf"(?: (?:here|there|any ?more))?{_ENDS}",
        lambda said: f"{said[1]}, so that {said[2]} do{'es' * (said[2] == 'it')} not lie around",
    ),
    # "Screwdriver needed, please lift it up", "all bolts in the bin, drawer to be shut at the end"
    (
        r"^((?:(?:the|my) )?(?:\w+ )?\w+) needed(?=[,.;:!] (?:(?:so|please|can you|could you) )*"
        r"(?:pick|lift|grab|take|get|fetch|put|bring|place|move)\b[^.;!?]*?\b(?:it|them)\b)",
        r"\1 is needed",
    ),
    (
        rf"([,;.] (?:and )?| and )((?:(?:the|my) )?(?:(?!{_WISHES})\w+ )?(?!{_WISHES})\w+) to be "
        r"(?=(?:left |kept )?(?:shut|closed|open|opened)\b)",
        _to_be_so,
    ),
    # "Two of the bolts are for the customer, put them in the bin", "this one we keep, it goes …"
    (
        r"(^|[.;!] )((?:one|two|three|four|\d) (?:of (?:the|my|our) )?(?:\w+ )?\w+) (?:is|are) "
        rf"(for (?:the|my|our) \w+)[,;.] (?:so )?({ASKED}(?:put|place|bring|move|set|store)) "
        r"(?:it|them) ([^.,;:!?]*)",
        r"\1\4 \2 \5 \3",
    ),
    (
        rf"(^|[.;!,] |\b(?:and|but) )({NAMED} (?:\w+ )?\w+) ((?:i|we) (?:(?:will |still )?keep"
        r"|still need)), (?:so )?it (goes|comes|belongs|should|must|has to) ([^.,;:!?]*)",
        lambda said: (
            f"{said[1]}{said[2]} {said[4].replace('comes', 'goes')} {said[5]} because {said[3]} it"
        ),
    ),
    # "Make some space in front of the oven by moving the jar aside"
    (
        rf"(^|[.;!] )((?:the robot (?:must|should|has to) )?)(?:(?<!\W )first,? )?({ASKED})"
        r"(?:make|create|free(?: up)?|clear) (?:some |more |enough |the "
        r"|a little |a bit of )?(?:room|space|area) (?:(?:on|at|in) the (?:left|right|front|back)"
        r"(?: side| half| part)?(?: of (?:the|my) \w+)?|(?:in front of|next to|beside|behind|around"
        r"|near) (?:the|my) (?:\w+ ){0,2}?\w+) by (?=\w+ing\b)",
        r"\1\2\3make room on the desk by ",
    ),
)
"""In order."""

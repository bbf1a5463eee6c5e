"""Ways of speaking of the table's corners and sides, put into plain ones."""

from __future__ import annotations

from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS

TABLE = f"(?:{'|'.join(DESK_NOUNS)})"
_SIDE = r"(left|right|far|near|front|back)(?: (?:hand )?(?:side|edge|end|part|half))?"
CORNERS_AND_SIDES: tuple[tuple[str, str], ...] = (
    (r"\b(the|my|your|our) work(?:ing)?[ -]?surface\b", r"\1 worktop"),
    # "Cup: back left corner of the table"
    (
        r"(^|[.;\n] ?)((?!(?:take|pick|grab|get|lift|fetch|grasp|hold)\b)"
        r"(?:(?:the|my) )?\w+(?: \w+){0,2})[:,] (?:the )?"
        r"((?:front|back|rear|far|near|upper|lower|top|bottom) (?:left|right) corner|"
        r"(?:left|right|front|back|rear|far|near) edge)"
        rf"( of the {TABLE})?(?=[.;!\n]|$)",
        r"\1\2 at the \3\4",
    ),
    (
        r"\bthe (left|right) corner,? (?:at|on|in|to|towards) the (front|back|rear)"
        r"(?: (?:side|end))?\b",
        r"the \2 \1 corner",
    ),
    (
        r"\b(in|at|to|into) the corner,? (?:at|on|in) the "
        r"((?:front|back|rear)(?: (?:left|right))?)\b",
        r"\1 the \2 corner",
    ),
    (
        r"\b(?:near|close to) (?=the (?:front|back|rear|far|near) (?:left|right) corner"
        rf"(?: of the {TABLE}|(?! of))\b)",
        "at ",
    ),
    # On a picture of the table its far side is on top.
    *(
        (
            rf"\b(in|at|to|into|on|onto|towards?) the (?:{high}) (left|right)"
            rf"(?: (?:side|part|area|end))? of the (?={TABLE}\b)",
            rf"\1 the {side} \2 part of the ",
        )
        for high, side in (("top|upper", "back"), ("bottom|lower", "front"))
    ),
    # What is taken away from the edges of the table is in its middle.
    (
        r"\b((?:move|take|put|bring|shift|set|get) [^.,;]*?) (?:further )?away from "
        rf"the (?:edge|border)s?(?: of (?:the|my) {TABLE})?(?=[.,;!?]|$| (?:and|then|before)\b)",
        r"\1 to the middle of the table",
    ),
    # "From the right to the left" is about the sides of the table.
    (
        rf"\b(?:away )?from the {_SIDE}(?: of the {TABLE})?"
        r"((?:,? and (?:then )?(?:put|place|bring|move|set|lay) (?:it|them))?) (?:over )?"
        rf"(?:to|on|onto|at) the {_SIDE}(?: of the {TABLE})?"
        r"(?=[.,;!?]|$| and\b| then\b)",
        r"on the \1 side of the table\2 to the \3 side of the table",
    ),
)
"""In order."""

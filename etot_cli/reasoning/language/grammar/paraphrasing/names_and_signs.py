"""Ways of naming and counting things, and signs for words, put into plain words."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.words.categories import CATEGORIES
from etot_cli.reasoning.language.words.lexicon import MATERIALS, NUMBERS, SIZES

_HYPHENS = "-\N{NON-BREAKING HYPHEN}\N{HYPHEN}"
_PIECES = r"(?:(?<!the )(?:piece|item|article)|pieces|items|articles) of"
_ARROW = r"(?:[-=]+>|\N{RIGHTWARDS ARROW})"
_STEP = (
    r"(?:put|place|take|move|pick up|grab|close|shut|open (?=the|my))\b"
    r"|(?!fully|completely|wide|all)\w+ (?:\w+ )?(?:open|closed|shut) ?(?:[-=]+>|[.,;\n]|$)"
)
_COMPARED = "|".join(word for word in SIZES if word.endswith("er"))
_OF_MATERIAL = {"wood": "wooden"}


def _sized(said: re.Match[str]) -> str:
    """A size alone ("the medium-sized bolt", "a mid-size box"), as labels have it, too."""
    return "medium" if said[1].startswith("mid") else said[1]


NAMES_AND_SIGNS: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (
        rf"\b(the|that) ({'|'.join(NUMBERS)})[{_HYPHENS} ](\w+)[{_HYPHENS} ](stack|tower|pile)\b"
        r"(?! of\b)",
        r"\1 \4 of \2 \3s",
    ),
    (
        rf"\bthe ((?:{_COMPARED}) (?:{'|'.join(CATEGORIES)}))\b(?! (?:ones|things)\b)",
        r"the 1 \1",
    ),
    (r"\band/or\b", "or"),
    # "Some jar or other"
    (r"\bsome ((?:\w+ )?\w+) or other(?=[,.;!]|$| (?:in|on|into|onto|to|next)\b)", r"any \1"),
    (rf"\b(left|right|top|bottom|front|back|upper|lower)[{_HYPHENS} ]most\b", r"\1most"),
    (r"\bmost (left|right)\b(?! (?:of|over)\b)", r"\1most"),
    (rf"\b(large|big|small|medium|mid|middle)(?:[{_HYPHENS} ]sized|[{_HYPHENS}]size)\b", _sized),
    (
        r"(?:\b(?:that|which) (?:is|are)( not)? |(?<!is )(?<!are )(?<!was )(?<!were )(?<!be )\b)"
        rf"made (?:entirely |completely )?(?:out )?of ({'|'.join(sorted(MATERIALS))})"
        r"(?=[,.;!?]|$| (?:in|into|on|onto|at|to|next|near|beside|behind|between|under|from|off"
        r"|with|and|or|is|are|goes?|belongs?|should|must|has|have|needs?|that|which|but)\b)",
        lambda said: f"that is{said[1] or ''} {_OF_MATERIAL.get(said[2], said[2])}",
    ),
    (rf"\b(left|right)(?:[{_HYPHENS}]hand(?:ed)?\b| hand(?= corner\b))", r"\1"),
    # "All the jars but number 2"
    (r"\b(\w+)s (but|except(?: for)?|apart from) (?=number \w)", r"\1s \2 \1 "),
    (r"(?:\b(?:number|no\.|nr\.?)\s*|#)(?=\d)", ""),
    (rf"\bnumber ({'|'.join(NUMBERS)})\b", lambda said: str(NUMBERS[said[1]])),
    (r"\b(table|counter|work|desk) top\b(?! (?:drawer|shelf|board|level|rack))", r"\1top"),
    (r"\b(mrs?|ms|dr)\. ", r"\1 "),
    (
        r"\b(?:(?:my|our|the) )?(?:gran(?:ny|dma|dpa|d)?|grand(?:mother|father)|mum|mom|dad|sister|"
        r"brother|mother|father|wife|husband|teacher|nurse|guest|boss) 's (?=\w+)",
        "my ",
    ),
    (
        r"\b(?:everything|anything|all things|the things) (?:(?:that )?(?:you|one|i|we) can "
        r"write with|(?:that|which) writes|(?:that is )?for writing)\b",
        "all the writing utensils",
    ),
    (r"(\bthe|\bits|\btheir|'s) content\b(?! with)", r"\1 contents"),
    (rf"\bthe (?:piece|item) of (?=(?:{'|'.join(CATEGORIES)})\b)", "the 1 "),
    (rf"\b({'|'.join(CATEGORIES)}) (?:items|things|products|articles)\b", r"\1"),
    # "A piece of fruit" is one, "the pieces of fruit" are all; "the piece" would be one of them.
    (rf"\b{_PIECES} (?=(?:{'|'.join(CATEGORIES)})\b)", ""),
    (rf"\b([a-z])[{_HYPHENS}](?=[a-z]{{3}})", r"\1"),  # "t-shirt", "x-ray"
    (rf"(?:(?<=\w)[{_HYPHENS}]|/)(?=\w)", " "),
    (r"&", " and "),
    # Steps ("open the drawer -> pen to drawer -> drawer closed"), else places ("pen -> drawer")
    (rf"\b(open|closed|shut) ?{_ARROW}", r"\1, then "),
    (rf" ?{_ARROW} ?(?={_STEP})", ", then "),
    (_ARROW, " to "),
    (r"\s*=\s*(?=\w)", ": "),
)
"""In order, behind all others, which are told by signs as well."""

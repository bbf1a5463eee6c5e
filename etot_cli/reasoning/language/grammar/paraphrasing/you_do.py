"""Requests whose subject is told ("the cup you put …", "I need that you put …"), that are broken up
by "please", or put as in other tongues ("to put the pen …", "without to move the cup").

A verb whose past is spelled like its present ("put") may tell what somebody did, unless something
else shows that it is asked for.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.small_words import NAMED
from etot_cli.reasoning.language.words.verbs import PAST

_DO = "|".join(sorted({verb.split()[0] for verb in PAST.values()}))
DO_OR_DID = rf"(?:{_DO}|put|set|shut|touch)"
_PLEASE = "(?:please|pleas|pls|plz|kindly)"
_TELLS = (
    r"\b(?:goes|go|belongs?|should|must|has|have|had|is|are|was|were|needs?|want|stays?|comes?|did"
    r"|but|instead|already|again|back|still|so|because|although|yesterday|earlier|before|wrong|i"
    r"|we|who|which|that|usually|always|often|sometimes|every|ago|just|when|the other day|on \w+day"
    r"|this (?:morning|afternoon|evening|week)|last (?:night|time|week|month|year|\w+day))\b"
)
"""Words beside which what "you put" somewhere may be what was put there."""
_REST = rf"(?:(?!{_TELLS})[^.;:!?,])*"
_NOW = r"(?:\b(?:then|now|first|next|finally|lastly|afterwards?|please|after (?:that|this)),? )"
_THING = (
    rf"{NAMED}(?: (?!(?:you|i|we|that|which|what|is|are|do|does|in|on|from|put|set|take|open|close"
    r"|move|place|pick|bring|leave|keep|remove|get)\b)\w+){1,7}"
)
_END = (
    r"(?=[.;!]|$|, (?:and|then|but)\b"
    rf"|, {_THING} (?:you|in|on|into|onto)\b(?![^.;:!?]*?{_TELLS}))"
)
_PLACE = (
    r"in|on|into|onto|inside|next to|beside|behind|between|in front of|on top of"
    r"|to the (?:left|right) of"
)
_ASKED = r"(?:must|should|shall|have to|need to|are to|will|then|now|first|please)"
_LED = (
    r"(^|[.;!?,:\n] |\b(?:and|but|then|now|first|next|finally|afterwards?|please"
    r"|after that|after this) )"
)
_WISH = (
    r"(^|[.;!] |, (?:so|and|but) )(?:i|we)(?: do| would)?(?: really| just)? "
    r"(?:want|need|wish|prefer|ask|(?<=would )like)(?: it)?(?: (?:of|from) you)?"
)
_AHEAD = r"(^|[.;!?\n] |, (?:and |but |then )*)((?:(?:first|then|next|now|finally|please),? )*)"


def _asked(said: re.Match[str]) -> str:
    """What is asked of a thing named ahead; what "you can" do with it may be done. In "put the cup
    there, then the pen you take out" the pen goes there, too.
    """
    clause, leading, thing, may, verb, rest = said.groups()
    before = re.split(r"[.;!?\n]", said.string[: said.start()])[-1]
    if "," in clause and not re.search(r"\byou\b", before):
        return said[0]
    if may in ("can", "could"):
        return f"{clause}{leading}you {may} {verb} {thing}{rest}" if rest else said[0]
    return f"{clause}{leading}{'do not ' if may else ''}{verb} {thing}{rest}"


YOU_DO: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    # "Move please the cup", "take the pen please out of it"
    (
        rf"(\b(?:{DO_OR_DID}|empty|belongs?|goes|go|in|into|on|onto)"
        rf"(?: (?:up|out|down|away|back))?)(?: {_PLEASE}|, {_PLEASE},) (?=\w)"
        rf"(?!(?:{DO_OR_DID}|and|but|then|do)\b)",
        r"\1 ",
    ),
    (rf"\bdo not {_PLEASE} ", "do not "),
    (
        rf"(?<=\w)(?<!\byou)(?<!\bi)(?<!\bwe) {_PLEASE} "
        r"(?=(?:out|from|goes|go|belongs?|off|up|down|away|back)\b)",
        " ",
    ),
    # "Without to move the cup", "open it for to put the pen in", as in other tongues
    (r"\bwithout (?:to|that you|you) (?=\w)(?!have\b)", "without "),
    (
        rf"\bwithout that ({_THING}) (?:is|are|gets?|(?:must|will|should) be) "
        r"(?=(?:moved|touched|opened|closed|disturbed|lifted|shifted)\b)",
        r"without \1 being ",
    ),
    (rf"\bfor to (?={DO_OR_DID}\b)", "to "),
    (rf"\b(do not|must|should|could|you can) to (?={DO_OR_DID}\b)", r"\1 "),
    (rf"\b(before|after) to (?={DO_OR_DID}\b)", r"\1 you "),
    (
        rf"(^|[.;!] |\bbut )(?:please )?not (?:to )?(?={DO_OR_DID} (?:{NAMED}|it\b|them\b))",
        r"\1do not ",
    ),
    # "To put the pen in the box", and nothing that it is done for
    (
        rf"(^|[.;!] )to ((?:{DO_OR_DID})\b[^.,;:!?]*(?:, (?:and |then )+to [^.,;:!?]*)*)"
        r"(?=[.;!]|$)",
        lambda said: said[1] + re.sub(r"\b(and|then) to (?=\w)", r"\1 ", said[2]),
    ),
    # "The pen comes in the box"
    (
        rf"{_LED}({_THING}) (?:comes|(come)) (?=(?:back )?(?:{_PLACE}) "
        r"(?:it|them|my|the|our|both)\b(?! (?:morning|evening|afternoon|night|end|way|post)\b))",
        lambda said: f"{said[1]}{said[2]} {'go' if said[3] else 'goes'} ",
    ),
    (r"\b((?:does|do|should|must|may|can|shall) not) come (?=(?:in|on|into|onto)\b)", r"\1 go "),
    # "Let the door open": as it is
    (
        r"\blet (?![^.,;]*? (?:stay|be|remain|stand|lie|sit|rest|go)\b)"
        rf"({_THING}|it|them|everything) "
        r"(?=(?:open|closed|shut|alone|untouched)"
        r"(?:[.,;:!?]|$| (?:and|but|then|for|so|until|when|while|after)\b)"
        rf"|(?:where|as) (?:it|they)\b|there\b(?! (?:be|is)\b)|(?:on|in|inside) {NAMED})",
        r"leave \1 ",
    ),
    # "I need that you put the pen in", "it is necessary to close it"
    (rf"{_WISH} that you (?:do|must|should) not ", r"\1do not "),
    (rf"({_WISH} that [^.;:!?]*?) and that you (?=(?:{DO_OR_DID})\b)", r"\1 and "),
    (
        rf"{_WISH} that (first )?you (first )?(?=(?:{DO_OR_DID})\b)",
        lambda said: f"{said[1]}i want you to {said[2] or said[3] or ''}",
    ),
    (
        r"\b(?:i|we) (?:do not want|would not like) (?:that you|you to) "
        rf"(?=(?:{DO_OR_DID})\b)",
        "do not ",
    ),
    (rf"\b(?:i|we) do not need (?:that you|you to) (?=(?:{DO_OR_DID})\b)", "you need not "),
    (
        r"(^|[.;!] |, (?:so|and|but) )it (?:is|would be) (?:really |very |absolutely )?"
        r"(?:necessary|needed|required|important|essential|vital) (?:(?:for you )?to|that you) "
        rf"(?=(?:first |then )?(?:{DO_OR_DID})\b)",
        r"\1you must ",
    ),
    (
        r"(^|[.;!] |, (?:so|and|but) )it is (?:really |very |absolutely )?"
        rf"(?:necessary|needed|required|important|essential|vital) that (?={NAMED})",
        r"\1make sure that ",
    ),
    # "Make sure that the pen goes into the box"
    (
        r"\b((?:make sure|ensure|see to it|(?:i|we) (?:need|want|would like))(?: that)?"
        rf" {_THING}) (do(?:es)? not )?(?:go|come)(e?s)? (in|on)(?:to|side)?(?= {NAMED})",
        lambda said: (
            f"{said[1]} {'is' if said[3] or said[2] == 'does not ' else 'are'}"
            f"{' not' if said[2] else ''} {said[4]}"
        ),
    ),
    (
        r"\b(it is not (?:necessary|needed|required)) (?:that you|for you to) "
        rf"(?=(?:{DO_OR_DID})\b)",
        r"\1 to ",
    ),
    # "The small cup you put on the tray"
    (
        rf"{_AHEAD}({_THING}) you (?:(?:{_ASKED} )+|(can|could|(?:do|must|should|shall) not) )?"
        rf"({DO_OR_DID})\b(?! it\b| them\b)({_REST}){_END}",
        _asked,
    ),
    # "In the box you put the pen"
    (
        rf"{_AHEAD}((?:in|on|into|onto|inside|beside|behind|next to) {_THING}),? you "
        rf"(?:{_ASKED} )*({DO_OR_DID}) (?={NAMED}{_REST}{_END})",
        r"\1\2\3 \4 ",
    ),
    # "When the lid is off, you put the pen in", "before you open it, you take it out"
    (
        rf"(\b(?:when|once|after|before|if|as soon as) (?:{_THING} (?:is|are|has been|have been) "
        rf"[^.;,:!?]*?|you (?:{_DO})\b[^.;,:!?]*)),? you (?=(?:{DO_OR_DID})\b)",
        r"\1, ",
    ),
    (
        rf"(?:^|(?<=[.;] ))((?:now |first |then )?)you ((?:{_DO})\b{_REST}(?:,| and|, and) )you "
        r"(?=(?:put|set|shut)\b)",
        r"\1\2",
    ),
    # "First you put it there, now take it off" tells what was done.
    (
        rf"((?!first\b[^!?]*[,.;] (?:and |but )?now\b){_NOW})you (?={DO_OR_DID}\b)",
        r"\1",
    ),
    (rf"{_LED}you (?=(?:{_DO})\b(?! (?:at|in|on|by|for|from|to)\b))", r"\1"),
    (rf"^(you )(?=(?:put|set|shut) {_REST}(?:, (?:and|then) {_REST})*[.!]?$)", ""),
    (rf"^({_THING}), you (?=(?:{DO_OR_DID}) (?:it|them) {_REST}{_END})", r"\1, "),
)
"""In order."""

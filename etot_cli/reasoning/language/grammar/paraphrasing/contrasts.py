"""What is asked for by saying what is not: "not just this, that as well", "instead of putting it
there, put it here", "it is not this that I want but that".
"""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.small_words import NAMED, WHERE

_BEGINS = r"(^|[.;!?] )(?:please,? )?"
_SOME = rf"{NAMED}(?: (?!and\b|or\b|in\b|on\b)\w+){{1,4}}?"
_TURNS = r"(?:please )?(?:open|close|shut)\b"
_PUTTING = "dropping|putting|placing|setting|moving|leaving|storing|throwing|standing|laying"
_PUT = "(?:put|place|set|move|drop|store|stand|lay|throw|bring)"
_IN = r"(?:in|on|into|onto|inside)"
_ELSE = r"(?:everything|anything|all) else|(?:all )?the (?:rest|others?)"
_LEVEL = r"(?:top|upper|middle|lower|bottom|highest|lowest|topmost)"
_DO = rf"(?<!not )(?<!never )\b{_PUT}"
_ENDS = r"(?=[.,;!?]|$)"
_STATE = r"(?:see|see to it|make sure|ensure|check) that (?:the|my|our|all|both|every)\b"


def _all_but_those(said: re.Match[str]) -> str:
    """What is "everything else" in something that is for some things, which may not be there yet
    where they have an article.
    """
    begun, where, what, take, out = said.groups()
    if re.match(NAMED, f"{what} "):
        return f"{begun}{where} is for {what}: {take} everything else {out or 'out'} of it"
    return f"{begun}{take} everything but {what} {out or 'out'} of {where}"


CONTRASTS: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    # "To the left of the cup, not to the right like it is now", which has to be so
    (
        rf"({_DO} ({_SOME}) to the (?:left|right) of ({_SOME})),? (?:and )?"
        rf"(not to the (left|right))(?: of it)?,? (?:like|as|where) it is (?:right )?now{_ENDS}",
        r"\1, \4 of it. \2 is to the \5 of \3 now",
    ),
    (
        rf"(\bnot {_IN} {_SOME}),? (?:like|as) (it is|they are) (?:right )?now{_ENDS}",
        r"\1 where \2 now",
    ),
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
    # "Instead of closing the top drawer, open the bottom one"
    *(
        (
            rf"{_BEGINS}(?:instead of|rather than) (?:just )?{doing} ({_SOME}), (?={_TURNS})",
            rf"\1do not {done} \2; ",
        )
        for doing, done in (("opening", "open"), ("closing", "close"), ("shutting", "shut"))
    ),
    # "Instead of dropping the cup in the box, put it on the plate"
    (
        rf"{_BEGINS}(?:instead of|rather than) (?:just )?(?:{_PUTTING}) ({_SOME}) "
        rf"((?:in|into|on|onto|inside) {_SOME}), {ASKED}({_PUT}) (it|them) ([^.,;!?]*)",
        r"\1\4 \2 \6 instead of \3",
    ),
    # "Take nothing off the plate except the roll, which goes …", as "do not take anything …"
    (rf"{_BEGINS}(take|remove) nothing (?=(?:off|from|out of) )", r"\1do not \2 anything "),
    # "The box is for balls: take everything else out", where "else" is other than balls
    (
        rf"{_BEGINS}({_SOME}) (?:is|are) (?:(?:only|just|exclusively|reserved|meant) )*for "
        rf"(?:(?:only|just) )?(\w+(?: (?!only\b)\w+){{0,3}}?)(?: only| exclusively)?"
        rf"[.,;:!]+ (?:so )?({ASKED}(?:take|get|clear|remove|move|bring)) (?:{_ELSE})"
        rf"(?: (out|off)| from)?(?: of)?(?: it| them| there)?{_ENDS}",
        _all_but_those,
    ),
    # "Put nothing in the tin but the spool"
    (
        rf"({_DO}) nothing (?:else )?({_IN} {_SOME}) (?:but|except(?: for)?|other than"
        rf"|besides|apart from) ({_SOME}){_ENDS}",
        r"\1 only \3 \2",
    ),
    # "Take the cup off the tray. Now that it is empty, put …", "It is empty now. Put …"
    (
        r"\b((?:take|remove|get|lift|clear|empty)\b[^.;!]*[.;!]) (?:now that it is (?:now )?empty,"
        rf"|it is (?:now empty|empty now)[.;!]|now it is empty[.;!]) (?={ASKED}{_PUT}\b)",
        r"\1 once it is empty, ",
    ),
    # "One pedal is not in the crate yet. Put it in there"
    (
        rf"^(?:please,? )?(?:the|one|(two|three)) ((?:\w+ )??(?!that\b|which\b)\w+) (is|are) "
        rf"(?:still )?not(?: yet)? ((in|on) {_SOME})(?: yet)?[.,;] "
        rf"(?:so )?{ASKED}({_PUT}) (?:it|them) "
        rf"(?:\5 there|there|\5 it|\5)(?= with\b| too\b| as well\b|{_ENDS})",
        lambda said: (
            f"{said[6]} the {said[1] or ''} {said[2]} that {said[3]} not {said[4]} {said[4]}"
        ),
    ),
    # "Move the bin, but it is the bin that should move and not the bell"
    (
        rf"\b((?:{_PUT}|push|shift) (the (?:\w+ )??\w+)(?: [^.,;]*?)?)[.,;]* (?:but |and )?"
        rf"it is \2 that (?:should|must|has to|is to|needs to) (?:be moved|move|go|give way),? "
        rf"(?:and )?not ({_SOME}){_ENDS}",
        r"\1, but do not move \3",
    ),
    # "Do not put the cup in the box; that is where the pen belongs"
    (
        rf"\b((?:do not|never) {_PUT} [^.,;:]*? ({_IN} {_SOME}))[.,;:]+ (?:because )?that is where "
        rf"({_SOME}|it|they) (?:belongs?|goes|go|lives?|should (?:go|be)|is to go){_ENDS}",
        r"\1; \3 should be \2",
    ),
    (
        rf"({_DO} [^.,;:]*? {_IN} {_SOME})[.,;:]+ (?:because )?"
        rf"that is where (?:it|they) (?:belongs?|goes|go|lives?){_ENDS}",
        r"\1",
    ),
    # "Put the spool in the basket without emptying it", "without emptying the basket, put …"
    (
        rf"({_DO} [^.,;:]*?),? without emptying (it|{_SOME}){_ENDS}",
        r"\1, but leave everything in \2 there",
    ),
    (rf"{_BEGINS}without emptying ({_SOME}), ", r"\1without taking anything out of \2, "),
    # "Put at least one of the cups in the box, but not both"
    (
        rf"\bat least one of the (\w+s)( (?:goes |should go )?{WHERE} [^.,;:]*?)?,? "
        rf"(?:but|and|though) not both{_ENDS}",
        r"exactly one of the two \1\2",
    ),
    # "Somewhere on the shelf is fine for the can, as long as it is not the top board"
    (
        rf"{_BEGINS}(?:some|any)where ({_IN} {_SOME}) (?:is|would be|will be) "
        rf"(?:fine|ok|okay|good|all right|alright) for "
        rf"(the (?:\w+ )??\w+)(?={_ENDS}| as long as\b)",
        r"\1put \3 \2",
    ),
    (
        rf"({_DO} [^.,;:]*? ({_IN}) {_SOME}),? (?:as|so) long as it is not "
        rf"(the {_LEVEL} (?:board|shelf|drawer|level)){_ENDS}",
        r"\1, but not \2 \3",
    ),
    # "Put the pen in the drawer as long as that stays open"
    (
        rf"({_DO} [^.,;:]*?),? (?:as|so) long as (it|{_SOME}) "
        rf"(?:stays|remains|is (?:kept|left)) (open|closed|shut)(?: the whole time)?{_ENDS}",
        r"\1, but keep \2 \3",
    ),
    # "Do not stack the plates; put them side by side on the tray"
    (
        rf"{_BEGINS}do not (?:stack|pile)(?: up)? ({_SOME}(?: and {_SOME})?)[.,;:!]+ (?:but )?"
        rf"{ASKED}({_PUT}) (?:them|both(?: of them)?) (?=side by side |next to each other )",
        r"\1\3 \2 ",
    ),
    # "Put neither cup in the box; put them on the plate instead"
    (
        rf"{_BEGINS}(?:put|place) neither (\w+(?: \w+)?) ((?:in|into|on|onto) {_SOME})[.,;:!]+ "
        rf"(?:but )?{ASKED}({_PUT}) (?:them|both(?: of them)?) ([^.,;!?]*?) instead"
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

"""Ways of saying where things are, come from and go."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.asides.people import PEOPLE
from etot_cli.reasoning.language.grammar.paraphrasing.corners import TABLE
from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED
from etot_cli.reasoning.language.words.small_words import NAMED, WHERE

_SO_NOW = r"(?:not|still|already|left|in|on|out|lying|standing|sitting)\b"
_LYING = r"(?:lying|sitting|standing|left)(?: (?:around|about|there|here|out))+"
_ABOUT = r"(?:still )?(?:left )?(?:lying|scattered|sitting) (?:around|about)(?! (?:the|my|your|of))"
_NO_MORE_SAID = (
    rf"(?: (?:yet|now|right now|at the moment))?(?=[.,;!?]| (?:and|then|please)\b| {WHERE}|$)"
)
_ROOM = r"there is (?:still |enough |some |plenty of )?(?:room|space)"
_AT = rf"(?:on|in|next to|beside|behind|in front of|to the (?:left|right) of) {NAMED}"
_SO_PUT_IT = rf"so {ASKED}(put|place|set|lay|stand) (?:it|them) (?:in )?there\b"

_END = r"(?=[.,;!?]|$)"
_STACK = r"(?:pile|stack|tower)"
_ALL_ELSE_THERE = (
    r"(?:the rest(?: of it)?|everything else(?: (?:in|on) it)?|all else|the others"
    r"|(?:whatever|what) else (?:is|there is|was) (?:there|in it|on it|in there|on there))"
)


def _not_unstacked(said: re.Match[str]) -> str:
    """A stack, rather than "it" or "them", unless another one was spoken of before."""
    if re.search(rf"\b{_STACK}s?\b", said.string[: said.start()]):
        return said[0]
    return f"{said[1]}{said[3]} {said[2]}" if said[3] else f"{said[1]}{said[4]} {said[2]} apart"


_IN_THE = r"\bin(?:to)? the (?:{})\b"
_IN_THE_MIDDLE = rf"({_IN_THE.format('middle')})(?=[,;:.!]| and\b|$)"


def _of_three_drawers(said: re.Match[str]) -> str:
    """In a list that has drawers, the top and the bottom the middle is one of them, too."""
    listed = ("drawers?", _IN_THE.format("top|upper"), _IN_THE.format("bottom|lower"))
    three = all(re.search(rf"{what}", said[0]) for what in listed)
    return re.sub(_IN_THE_MIDDLE, r"\1 one", said[0]) if three else said[0]


_PLAIN_PLACE = rf"(?:(?:the|my) )?(?:(?!{WHERE}|and\b|or\b)\w+ ?){{1,3}}(?=[.!]|$)"
_LEVELLED = r"\b(?:behind|back|bottom|below|beneath|underneath|middle)\b"


def _with_of(said: re.Match[str]) -> str:
    """A preposition without its "of", unless things behind or below may be told by it."""
    return said[0] if re.search(_LEVELLED, said.string) else f"{said[1]} of "


_TOOK = (
    rf"(?!no|any)(?:{PEOPLE}|they) (?:(?:have|has|had|just|already) )*"
    r"(?:took|taken|got|pulled|fetched|lifted|removed)"
)
_A_WHILE_AGO = (
    r"(?: (?:earlier(?: on)?|before|just now|already|yesterday|this morning|today"
    r"|a (?:moment|minute|while|bit) ago|to \w+(?: at)? (?:it|them)))?"
)
_END_BACK = r"(?=[.,;!?]|$| (?:and|then|now|please|again|afterwards)\b)"
_BACK_TO = {"out of": "in", "from": "to", "off": "on"}


def _back_there(said: re.Match[str]) -> str:
    """What goes back to where somebody took it from ("I took the pen out of the drawer earlier. Put
    it back").
    """
    several = said["what"].endswith("s") or " and " in said["what"]
    if (" and " in said["what"] and said["it"] == "it") or (said["it"] == "them" and not several):
        return said[0]
    return f"{said[1]}{said['put']} {said['what']} back {_BACK_TO[said['off']]} {said['place']}"


_THE_ONE = r"(?:the|my) (?:\w+ )?\w+"
WHEREABOUTS: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    # "Put it in the bag and close it, with nothing else inside"
    (
        rf"( in(?:to|side)? {_THE_ONE}),? and (close|shut) it,? with nothing else "
        r"in(?:side|side it| it| there)?(?=[.;!]|$)",
        r"\1, with nothing else in it, and \2 it",
    ),
    # "Close the bag once the pen is out and the key is in"
    (
        rf"\b(close|shut) ({_THE_ONE}) (once|when|after|as soon as) ({_THE_ONE}) is out(?: of it)? "
        rf"and ({_THE_ONE}) is in(?:side)?(?: it)?(?=[.,;!]|$)",
        r"\1 \2 \3 \4 is out of \2 and \5 is in \2",
    ),
    # "Put the soap in the jar if the pen is in there"
    (
        rf"( in(?:to|side)? {_THE_ONE} (?:if|unless) {_THE_ONE} "
        r"(?:is|are)(?: not)?(?: (?:already|still))?) in there(?=[.,;!]|$)",
        r"\1 in it",
    ),
    # "Put the letter that is not in the bag there"
    (
        r"(^(?:please )?(?:put|place|move) (?:the|my|every|all|all the) \w+ (?:that|which) "
        rf"(?:is|are) not (in|on) ({_THE_ONE})) there(?=[.;!]|$|,? (?:and|then)\b)",
        r"\1 \2 \3",
    ),
    # "Open the bag and put the pen in there with the key"
    (
        rf"\b(open ({_THE_ONE}),? and (?:put|place) {_THE_ONE}) in(?:to|side)? (?:it|there) "
        rf"(?=with {_THE_ONE}(?:[.,;!]|$))",
        r"\1 in \2 ",
    ),
    (
        r",? (?:when |if you )?(?:counting|counted|count) from "
        r"(?=(?:the (?:top|bottom|left|right|front|back)|above|below)\b)",
        " from ",
    ),
    # "The pot that is leftmost after that" tells which one, and not when
    (
        r"\b(that|which) (?:is|will be) (?:then )?((?:(?:on|in) the )?\w+) "
        r"(?:after that|afterwards|by then|then)(?=[.,;!]|$| (?:and|in|on|into|onto|to)\b)",
        r"\1 is now \2",
    ),
    (r"\b(that|which) (?:is|will be) (?:by )?then\b", r"\1 is now"),
    (
        rf"(^|[.;!] ){_TOOK} (?P<what>{NAMED} [^.,;:!?]*?) (?P<off>out of|from|off)(?: of)? "
        rf"(?P<place>{NAMED} (?:\w+ ){{0,2}}?\w+?){_A_WHILE_AGO}(?:[.;,!] | and |, so )"
        rf"{ASKED}(?P<put>put|place|bring) (?P<it>it|them) back(?: in(?:side| there)?)?{_END_BACK}",
        _back_there,
    ),
    # Prepositions as in other languages ("behind of", "near from", "in front the box")
    (r"(?<=\w )(?:at )?(behind|beside|alongside|between|near) (?:of|from) (?=\w)", r"\1 "),
    (r"(?<=\w )(?<!the )(?:next of|beside to) (?=\w)", "next to "),
    (rf"(?<=\w )(?<!and )(in front|on top) (?={NAMED} )(?!\w+ (?:other|(?:\w+ )?one)\b)", _with_of),
    (r"(?<=\w )in (left|right) of (?=\w)", r"to the \1 of "),
    (
        rf"^({ASKED}(?:put|place|set|stand|position) (?:(?!(?:{WHERE}|ones?\b|and\b|or\b))\w+ )+)"
        rf"(?:(?:on|at|in) (?:the )?)?(?:(left) (?:from|to)|(right) from) (?={_PLAIN_PLACE})",
        lambda said: f"{said[1]}to the {said[2] or said[3]} of ",
    ),
    (
        r"\byou (?:will|can|should) find (it|(?:the|my) \w+(?: \w+)?) "
        r"(?=(?:in|on|inside|next|beside|behind|near|at)\b)",
        r"\1 is ",
    ),
    (
        r"(^|[.;!] )where (?:i|we) (?:sit|stand|work|eat|am|are)(?: now)?, "
        r"(?=(?:at|on|in|to|next to|beside|near) )",
        r"\1",
    ),
    (
        r"\bon the (?:\w+ )?(?:shelf|bookcase|rack|unit), "
        r"(?=on the same (?:level|board|shelf) as\b)",
        "",
    ),
    (r"\bgo(es)? away (?=(?:in|into|on|onto)\b)", r"go\1 "),
    (rf"(^|[.;!] )({_AT} [^.,;]*?),? {_ROOM} for ({NAMED} [^.,;]*), {_SO_PUT_IT}", r"\1\4 \3 \2"),
    (rf"\b{_ROOM} for ({NAMED} [^.,;]*? {_AT} [^.,;]*), {_SO_PUT_IT}", r"\2 \1"),
    (
        rf"\b{_ROOM} (on|in) "
        rf"({NAMED} [^.,;]*), so {ASKED}(put|place|set|lay|stand) ([^.,;]*?) (?:in )?there\b",
        r"\3 \4 \1 \2",
    ),
    # "The pen was supposed to be in the cup, so put it there"
    (
        rf"(^|[.;!] )({NAMED} (?:\w+ ){{0,2}}?\w+(?: and {NAMED} (?:\w+ )??\w+)?)"
        r" (?:(?:was|were) (?:supposed|meant) to be|(?:should|ought to) have (?:been|gone))"
        rf" (?={WHERE})([^.;!?,]*)[.,;!]? (?:so )?{ASKED}(?:put|place|move|bring|take) (?:it|them)"
        r" (?:in |over |back )?there"
        rf"(?:{_END}|(?P<more>,? and )(?=(?:then )?(?:close|shut|open)\b))",
        lambda said: f"{said[1]}{said[2]} should be {said[3]}{'. ' if said['more'] else ''}",
    ),
    (
        r"\b(nothing (?:should|must) be left) (in|on) ([^.,;]*?) or (in|on) ",
        r"\1 \2 \3 and \1 \4 ",
    ),
    (
        rf"\b(?:bring|carry|take|move) ({NAMED} [^.,;:]*?) (?:over |across )?"
        rf"to ({NAMED} (?:\w+ )?(?:tray|plate|board|mat|shelf)),? and "
        r"(?:put|set|lay|place) it (?:down )?"
        r"(?=(?:next to|beside|behind|in front of|to the (?:left|right) of)\b)",
        r"put \1 on \2 ",
    ),
    (
        rf"\b(?:take|carry|move|bring|shift) ({NAMED} [^.,;:]*?) (?:over |across )?"
        rf"to ({NAMED} [^.,;:]*?), (?:right |just |close )?"
        r"(next to|beside|behind|in front of|to the (?:left|right) of) it(?=[.,;!?]| and\b|$)",
        r"put \1 \3 \2",
    ),
    (
        r"\bwhere ((?:the|my) [^.,;]*?|it|they) (?:stood|lay|sat|used to be|has been|had been)\b",
        r"where \1 was",
    ),
    (r"\bfrom one (\w+) (?:in)?to the other(?=[.,;!?]|$| and\b)", r"to the other \1"),
    (r"\b(?:to )?somewhere (?=(?:behind|next to|beside|near|in front of|between)\b)", ""),
    # "It" is the stack that something goes onto; one that goes somewhere itself is moved
    (
        rf"\b((?:on|onto|on top of|atop) ((?:the|that|this|my) {_STACK}(?: of \w+)?)"
        r",? (?:but |and )?(?:do not|without|never|not) )"
        rf"(?:(unstack(?:ing)?) (?:it|them)|(tak(?:e|ing)) (?:it|them) apart){_END}",
        _not_unstacked,
    ),
    # What is on what is emptied goes to several places
    (
        rf"(^|[.;!] )((?:then )?{ASKED})(?:clear|empty) ({NAMED} (?:\w+ )??\w+?)"
        rf"(?: off| out| completely| entirely)*[:;,.] ({NAMED} [^.;:!?,]*?,? and )"
        rf"{_ALL_ELSE_THERE} (?=(?:goes|go|belongs|should|must|has to|needs to|in|into|on|onto)\b)",
        r"\1\2\4everything else from \3 ",
    ),
    # Somewhere "there", told next
    (
        r"(?<=\w) (?:up|down|over) there (?=(?:beside|next to|near|between|behind|in front of"
        rf"|(?:to )?the (?:left|right) of|on|in) (?:{NAMED}|it\b|them\b))",
        " ",
    ),
    (
        r"\b((?:need|want|have|like|love|is|are) (?:[^.,;]* )?)out "
        rf"(?=on(?:to)? (?:the|my) {TABLE})",
        r"\1",
    ),
    (
        r"\b((?:what|whatever|everything|all)(?: that)? is (?:in|on)) there "
        r"(?=(?:on|in|into|onto|goes|to)\b)",
        r"\1 it ",
    ),
    (r"\bdown here (?=(?:on|in) (?:the|my)\b)", ""),
    (r"\b(come|go) (?:out|over|up) here (?=(?:on|in) (?:the|my)\b)", r"\1 "),
    (rf"\bwhichever (?!of\b)([\w ]+?) is (?={_SO_NOW}|(?:free|empty)\b)", r"whichever \1 that is "),
    (rf"\bwhichever ([\w ]+?) are (?={_SO_NOW})", r"all the \1 that are "),
    (
        rf"\b((?:that|which) (?:is|are)) inside(?= (?:and|then)\b| {WHERE}|[,.;!?]|$)",
        r"\1 in it",
    ),
    (r"\bhidden (?=(?:in|inside|behind) )", ""),
    (
        r"\b((?:next to|beside|behind|in front of|on top of) (?:it|them)) there"
        r"(?=[.,;!?]| and\b| then\b|$)",
        r"\1",
    ),
    (
        r"\b((?:that|which) (?:is|are) (?:still |already |just )?)(?:lying |standing |sitting )?"
        rf"out (?:here|there)\b(?! on (?:the|my) {TABLE}\b)",
        r"\1outside",
    ),
    (
        r"(^|[.;] )(?:since|because|as) ((?:the|my|one) (?:\w+ ){1,3}?(?:is|are) (?:already )?"
        r"(?:taken|occupied|in use|used)(?: by (?:the|a|my) [^.,;]*)?), ",
        r"\1\2, so ",
    ),
    (
        r"\b(that|which) (?:is (?:not (?:currently |yet |already )?(?:being )?"
        r"(?:used|in use|taken|occupied)|unused|free|vacant|unoccupied|still free)"
        rf"|(?:nobody|no one) (?:uses|is using)){_NO_MORE_SAID}",
        r"\1 is empty",
    ),
    (r"\b(?:in|inside)(?: there)? (?=(?:next to|beside|alongside) )", ""),
    (rf"[^.!?]*{_IN_THE_MIDDLE}[^.!?]*", _of_three_drawers),
    (r"\bback down (?=(?:on|onto)\b)", "down "),
    (
        r"\b(?:back down|down back)(?: again)?(?=[.,;!]|$| (?:and|then|afterwards|(?:to )?where"
        r"|(?:in|at|on|to) (?:its|their|the same) (?:\w+ )?(?:place|spot|position)s?)\b)",
        "back",
    ),
    (rf"(\brather [^.;]*?) than (?:just )?{_LYING}(?=[.,;!?]|$)", r"\1"),
    # "Open the drawer, but not with the cup inside": it is not in there by then
    (
        r"(?:,? (?:but )?not with|,? but without|, without(?=[^,]*$)) "
        r"((?:the|my|our) (?:\w+ ){0,2}?\w+) "
        r"(?:still |left )*(?:inside(?: it)?|in there|in it)(?=[.,;!?]|$)",
        r", but first make sure \1 is not in it",
    ),
    (r"(?<=\w) yet(?= (?:in|on|to|into|onto|and|go|goes)\b|[,.;]|$)", ""),
    (rf"\b((?:that|which) (?:is|are) ){_ABOUT}", r"\1loose"),
    # What should not be lying about somewhere should not be there.
    (rf"\bbe {_ABOUT}(?= (?:in|on|inside)\b)", "be"),
    (
        r"(?<!is )(?<!are )(?<!is just )(?<!are just )(?<!be )(?<!business )"
        rf"\b{_ABOUT}",
        "that are loose",
    ),
    (r"\b(it|them) out of there\b", r"\1 out"),
    (r"\b(out of|from|off) there\b", r"\1 it"),
    (
        r"\bstill (?=(?:needs?|has|have|ought) to "
        r"(?!stay\b|remain\b|be (?!\w+ed\b|put\b|shut\b|taken\b))|must go\b|should go\b)",
        "",
    ),
    (r"\b(is|are) (in|on|at) the wrong (?!(?:one|place|spot|side)\b)", r"\1 \2 the "),
)
"""What they are put into, in order (see ``paraphrases``)."""

"""How things are to be in the end, told in another order or by other verbs, put plainly."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import is_descriptive, singular
from etot_cli.reasoning.language.words.small_words import NAMED

_MUST = r"should|must|shall|may|can|could|has to|have to|is to|are to|needs? to|ought to"
_SOME = rf"{NAMED}(?: (?!and\b|or\b|in\b|on\b)\w+){{1,4}}?"
_BE = r"be|go|come|stand|lie|sit|rest|end up|move|return|stay|remain|follow"


_TASK = r"(?:the|your|our|my|this) (?:task|job|work|goal|aim|objective|mission|episode)"
_DONE = (
    r"(?:all )?(?:complete|completed|done|finished|achieved|fulfilled|accomplished|reached|over"
    r"|successful|a success)"
)


def _one(said: str) -> str:
    """A colour alone is the thing of that colour."""
    return f"the {said} one" if is_descriptive(said) else said


_IN_THERE = (
    r"(?:(?:in|on|inside|into) (?:there|it|(?:that|this)(?: same)?(?: \w+){1,2})|there|inside)"
)


_PUT_NOTHING_ELSE = (
    r"(?:and |but )?(?:(?:do not|never) (?:ever )?(?:put|place) (?:anything else|any other things?)"
    r"|(?:put|place) nothing else"
    r"|(?:(?:make sure|be sure|ensure|see to it)(?: that)? )?nothing else"
    r" (?:is|(?:should|must|may|is to|ought to|can) be)(?: ever)? (?:put|placed|set|laid))"
    rf" {_IN_THERE}(?=[.;!]|$)"
)
_LEFT = "(?:,? and|, then)(?: then)? (?:left|kept|(?:to )?(?:stay|remain))"
_KEPT = {"out of": "in", "off": "on"}
_IMPERATIVE = {
    "moving": "move", "putting": "put", "setting": "set", "placing": "place",
    "carrying": "carry", "bringing": "bring",
}  # fmt: skip
_MOVED = f"(?:{'|'.join((*_IMPERATIVE, *_IMPERATIVE.values(), 'take', 'stand'))})"
_ALL_OF = {"any": "none", "either": "neither"}


def _nor(said: re.Match[str]) -> str:
    """What is not to be so either."""
    modal, quantity, them, be, door = said.groups()
    if quantity and door:
        return f" and all of {them} {modal} be {'closed' if door == 'open' else 'open'}"
    if quantity:
        return f" and {_ALL_OF[quantity]} of {them} {modal} {be}"
    return f" and {them} {modal} not {be}{f' {door}' if door else ''}"


_CONTAINER = Expression(
    rf"(?P<what>{_SOME})(?: and|,? together with|,? along with|,? with) its "
    rf"(?:container|vessel|receptacle), (?P<vessel>{_SOME})(?:,(?= )|(?=[.;!]|$))(?P<rest>[^!?]*)"
)
"""A thing and what it is to be in, which is said behind it."""


def _with_it_inside(said: re.Match[str]) -> str:
    """What goes somewhere with its container is in that in the end."""
    what, vessel, rest = said["what"], said["vessel"], said["rest"]
    if re.search(r"\bthe (?:former|latter)\b", rest):
        return f"{what} and {vessel}{rest}"
    what = re.sub("^both (?=the|my)", "", what)
    rest = re.sub("^ are both ", " is ", rest)
    rest = re.sub("^ (should|must|shall|have to|need to|belong|go) both ", r" \1 ", rest)
    return f"{vessel} with {what} in it{rest}"


_LOOKED_AT = Expression(
    rf"(?P<begun>^|[.;!?] )(?:when(?:ever)? (?:i|we) (?:look at|look over at|see|come back to"
    rf"|get back to)|looking at) (?P<where>{_SOME}),? (?:i|we) (?:would |should )?"
    r"(?:want|like|expect|need|wish) to (?:see|find) "
    r"(?P<seen>[^.;!?]*?\b(?:on|in|inside|on top of)) it\b(?! \w*in\b)(?P<rest>[^.;!?]*)"
)
"""What somebody wants to see when he looks at something."""


def _seen_there(said: re.Match[str]) -> str:
    """What is to be seen on or in something is to be there."""
    if re.search(r"\bit\b", said["rest"]):
        return f"{said['begun']}as for {said['where']}, i want {said['seen']} it{said['rest']}"
    return f"{said['begun']}i want {said['seen']} {said['where']}{said['rest']}"


_AT_THE_END = Expression(
    rf"^with (?P<what>{_SOME}) (?P<state>closed|shut|open) (?:(?:at|in) the end|when all is done|"
    r"afterwards), (?P<rest>[^.;!?]*)"
)


def _so_when_done(said: re.Match[str]) -> str:
    """How something is to be "at the end", which is said ahead of all else."""
    what, rest = said["what"], said["rest"]
    if len(re.findall(r"\b(?:it|its)\b", rest)) > 1:
        return said[0]
    rest = re.sub(r"\bit\b", what, rest)
    return f"{rest}, and {what} should be {said['state']} in the end"


def _left_there(said: re.Match[str]) -> str:
    """What is not taken out of something is left in it, what is not taken off on it."""
    done, _, what, away, where = said.groups()
    return f"{done} and leave {what} {_KEPT[away]} {where}"


def _left_while_moved(said: re.Match[str]) -> str:
    """The same ahead of what is done with that."""
    what, away, where, verb, place = said.groups()
    return f"{_IMPERATIVE.get(verb, verb)} {where} {place} and leave {what} {_KEPT[away]} it"


def _as_condition(said: re.Match[str]) -> str:
    """What "should" be so by now, before or behind what is asked for in that case, with "if"."""
    ahead, what, *state = said.groups()
    head = what.split()[-1]
    several = head in ("they", "these") or " and " in what or singular(head) != head
    ahead = f"{ahead} " if ahead.strip(" .;!") else ahead
    return f"{ahead}if {what} {'are' if several else 'is'}{' not' if state[0] else ''} {state[1]}"


_ANYTHING = rf"{_SOME}|it|they|there|(?:any|some|no)(?:thing| \w+)"
_SOME_OF = r"((?:an?|one|two|three|four|some) (?:(?!of\b)\w+ ){0,2}?\w+)"


END_STATES: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    # "Both bowls on the tray, each with a nut inside", "with a nut in each"
    *(
        (
            rf",? (?:and )?{said}(?: of (?:them|these))?(?=[.,;!]|$| (?:and|then)\b)",
            rf", and \1 should be {where} each of them",
        )
        for where, inside in (("in", "in(?:side)?"), ("on", "on(?: top)?(?: of)?"))
        for said in (
            rf"each (?:one )?with {_SOME_OF} {inside}(?: (?:it|them))?",
            rf"with {_SOME_OF} {inside} each",
        )
    ),
    # "Only if the drawer is open should the cup go in it", "should it be open, close it"
    (
        rf"(\bonly if [^.,;:!?]*?),? (?:should|must|shall) ({_SOME}|it|they) (?=(?:{_BE})\b)",
        r"\1, \2 should ",
    ),
    (
        r"\b(?:never|under no circumstances|in no case|on no account) (?:should|must|may|can) "
        rf"({_SOME}|it|they) (?=(?:{_BE})\b)",
        r"\1 should not ",
    ),
    (
        rf"(^|[.;!] )should ({_ANYTHING}) (not )?be (?!in \w+ way)([^.,;:!?]+)"
        r"(?=, [^.;:!?]*(?:[.;!]|$))",
        _as_condition,
    ),
    (
        rf"(^{ASKED}(?:put|place|move|take|open|close|shut|leave|bring|remove) "
        r"(?:(?!\b(?:only|until|once|never|which|what|where)\b)[^.;:!?])*?),? "
        rf"should ({_ANYTHING}) (not )?be ([^.,;:!?]+)(?=[.!]|$)",
        _as_condition,
    ),
    (
        r"\b(?:only|and) (?:then|after that|afterwards),? "
        rf"(?:{_MUST}) ({_SOME}|it|they) (?=(?:{_BE})\b)",
        r"then \1 should ",
    ),
    # "…, nor should any of them be open"
    (
        rf",? (?:and )?nor ({_MUST}) (?:(any|either) of )?({_SOME}|it|they|them) ({_BE})"
        r"\b(?: (open|closed|shut)\b)?",
        _nor,
    ),
    # "The blue one, though, should lie there"
    (
        r", (?:though|however|on the other hand|in turn|for (?:its|their) part),"
        rf"(?= (?:{_MUST}|goes|go|belongs?|(?:i|we) (?:want|need|would like))\b)",
        "",
    ),
    (
        r"\b(stays?|remains?|be|left|kept|leave (?:it|them)|keep (?:it|them)) "
        r"(?:exactly |just )?as (?:far |wide )?(?:open|closed|shut) as (it is|they are)\b",
        r"\1 as \2",
    ),
    # "With the cup still on the box, untouched"
    (
        rf"\bwith ({_SOME}) still ([^,.;]*), (?=(?:untouched|unmoved)(?:[.,;!]|$))",
        r"with \1 \2 ",
    ),
    # What is not taken out of a thing that goes somewhere comes along in it.
    (
        rf"\b({_MOVED} (?P<moved>{_SOME})\b [^.;]*?),? without "
        rf"(?:taking|removing|lifting|getting) ({_SOME}) "
        rf"(out of|off) (it|(?P=moved))(?=[.,;!]|$)",
        _left_there,
    ),
    (
        rf"\b(?:do not|never) (?:take|remove|lift|get) ({_SOME}) (out of|off) ({_SOME}) "
        rf"(?:when|while|as) (?:you )?({_MOVED}) (?:\3|it) ([^.,;]*)",
        _left_while_moved,
    ),
    # "Red should not be on blue, it should be the other way round"
    (
        r"^((?:(?:the|my) )?(?:\w+ )?\w+) (?:should|must|shall) not be (on|in) "
        r"((?:(?:the|my) )?(?:\w+ )?\w+)[,;.:] (?:(?:but|instead|rather) )?"
        r"(?:it (?:should|must) be |it is )?the other way (?:round|around)(?=[.!]|$)",
        lambda said: f"{_one(said[3])} should be {said[2]} {_one(said[1])}",
    ),
    # "Only socks go in the basket. Put both of them in": these, rather than a rule for such things
    (
        r"(^|[.;!] )(?:only|nothing (?:but|except)) (?!the\b)(\w+[^s\W]s) (go|belong)(?:e?s)? "
        rf"(?=(?:in|on|into|onto)\b[^.;!]*[.;!] {ASKED}(?:put|place) (?:both|all) of them\b)",
        r"\1only the \2 \3 ",
    ),
    # "Make room on the lower shelf by moving the cup to the upper"
    (
        r"\b(on the (?:top|bottom|upper|lower|middle) (\w+) by \w+ing [^.,;]*? (?:to|on|onto) the "
        r"(?:top|bottom|upper|lower|middle))(?: one)?(?=[.,;!?]|$| and\b)",
        r"\1 \2",
    ),
    # "The pens are everywhere, aren't they? The cup should …"
    (
        r"(\b(?:is|are|has|have)\b[^.;?!]*), (?:is|are|has|have) not (?:it|they|there)\? (?=\w)",
        r"\1. ",
    ),
    # "What is in the box may stay there, just add the pen"
    (
        rf"(^|[.;!] )(?:(?:whatever|what|everything|all)(?: that)? is|everything|all) (in|on) "
        rf"({NAMED}(?: \w+){{1,3}}?) (?:(?:{_MUST}) )?(?:stays?|remains?) (?:there|(?:in|on) it)"
        rf"[,;.]?(?: (?:but|and|so|you|can|just|simply|please))* add ({_SOME})(?=[.;!]|$)",
        r"\1leave everything that is \2 \3 there and add \4 to \3",
    ),
    # "All of it except the cup goes on the tray", before anything was spoken of
    (
        rf"^({ASKED}(?:(?:put|move|bring|place|set) )?)all of it,? "
        r"(?=(?:except|apart|aside|other than|but)\b)",
        r"\1everything ",
    ),
    # "They should at least be side by side"
    (
        rf"\b({_MUST}) at least (?=(?:{_BE})\b"
        r"(?![^.;!?]*(?:\d|\b(?:two|three|four|five|six)\b)))",
        r"\1 ",
    ),
    # "One walnut in the bowl is enough"
    (
        r"(^|[.;!] )(?:just )?((?:one|two|three|four) (?:\w+ ){1,3}?(?:in|on) "
        r"(?:the|my|our) (?:\w+ ){0,2}?\w+) (?:is|are|would be|will be|should be) "
        r"(?:enough|sufficient|plenty)(?: for (?:me|us|now|today))?(?=[.,;!]|$)",
        r"\1there should be exactly \2",
    ),
    # "One walnut is enough in the bowl"
    (
        r"(^|[.;!] )(?:just )?((?:one|two|three|four) (?:\w+ ){0,2}?\w+) (?:(?:is|are|would be"
        r"|will be|should be) (?:enough|sufficient|plenty)|will do) ((?:in|on) (?:the|my|our) "
        r"(?:\w+ ){0,2}?\w+)(?=[.,;!]|$)",
        lambda said: f"{said[1]}there should be exactly {said[2]} {said[3]}",
    ),
    # "The door is to be opened and left open"
    (
        rf"\b((?:is|are|has|have|needs?) to be|(?:should|must|can|may) be) (?:(opened){_LEFT} open"
        rf"|(closed|shut){_LEFT} (?:closed|shut))\b",
        r"\1 \2\3",
    ),
    # "In the same place as the cup"
    (
        r"\b(?:in|on|to|at) the (?:very )?same (?:place|spot) (?:as|that|where) "
        r"((?:the|my|our) (?:\w+ ){0,3}?\w+)(?: is| are)?(?=[.,;!?]|$)",
        r"where \1 is",
    ),
    # "A cup on every tray would be nice"
    (
        r"(^|[.;!] |, (?:and )?so )((?:an?|one|two|three|some) [^.;,!]*? "
        r"(?:in|on|to the|next to|beside|behind|between|under|by) [^.;,!]*?) would be "
        r"(?:(?:very|really|so) )?(?:nice|lovely|good|great|perfect|ideal|wonderful)(?=[.!]|$)",
        r"\1there should be \2",
    ),
    # What is there already may stay.
    (
        rf"\b(put|place|set|stand|lay) ({_SOME}) ((?:in|on|into|onto|inside) {_SOME})[.;,]? "
        rf"{_PUT_NOTHING_ELSE}",
        r"\1 \2 \3. do not put anything but \2 \3",
    ),
    # "The cup next to the mug, both of them on the tray"
    (
        rf"\b({_SOME}) ((?:(?:should|must) (?:be|stand|go)|goes|belongs) )?"
        rf"(?:next to|beside) ({_SOME}),? (?:and )?both"
        rf"(?: of them)?(?: standing| lying)? (?=on {NAMED})([^.,;]*)",
        lambda said: (
            f"{said[1]} and {said[3]} {'should be ' if said[2] else ''}{said[4]}, "
            "next to each other"
        ),
    ),
    # "The ball alone goes into the box"
    (
        r"(^|[.;!,] |\band )(the|my|our) ((?:\w+ ){1,3})alone "
        r"(?=(?:goes|belongs|should|must|has to|is to|needs to|stays|remains|ends up)\b)",
        r"\1only \2 \3",
    ),
    # Places that are left open
    (
        r",? (?:be it|whether|no matter whether) "
        r"(?=(?:in|on|inside|into|onto) [^.,;:]*? or (?:in|on|inside|into|onto) )",
        " either ",
    ),
    (
        rf"^({ASKED}(?:put|store|stow|tidy|clear|pack)(?: away)? "
        r"(?:(?!in\b|on\b|into\b|onto\b|to\b|next\b)\w+,? )*?\w+),? using "
        rf"(?=(?:either )?{_SOME}(?:, {_SOME})*,? or )",
        r"\1 in ",
    ),
    (
        rf"\bfor (?:each|every one|either|both) of ({_SOME}(?:(?:,|,? and) {_SOME})*), "
        rf"{ASKED}(?:choose|pick|select|decide on) "
        rf"((?:either )?(?:{NAMED} )?\w+(?: \w+)? or (?:{NAMED} )?\w+(?: \w+)?|an? \w+(?: \w+)?),?"
        r" and (?:put|place|set) (?:it|each|that one|the thing) (?:there|in it|into it|inside)\b",
        r"put \1 in \2",
    ),
    # What is to be under a thing that lies on it now bears it
    (
        rf"\b(?:(?:i|we) (?:would )?(?:like|need|want)|put|place|get|set) ({_SOME}) "
        rf"(?:to (?:be|go|lie) )?(?:under|underneath|beneath|below) ({_SOME}),? "
        r"(?:rather than|instead of|and not|not) (?:lying |being )?"
        r"(?:on(?: top)?(?: of)?|above|over)(?: (?:it|them))?(?=[.,;!]|$)",
        r"put \2 on \1",
    ),
    (
        r"\b(instead of|rather than) (?:just )?(?:lying|standing|sitting|being|lie|stand|sit|be)"
        rf"(?: (?:about|around))? (?=(?:in|on|next to|beside|near|behind) {NAMED})",
        r"\1 ",
    ),
    (
        r"(^|[.;!?] )(?:please,? )?(?:no open|((?:i|we) do not want (?:to (?:see|find|have) )?"
        r"(?:any|an) open)) ((?:\w+ )??\w{3,}?)s?(?(2)(?=[.,;!?]|$| when (?:i|we)\b)"
        r"|(?=,? (?:please )?(?:(?:at|in) the end|afterwards|when you are (?:done|finished))\b))",
        r"\1every \3 should be closed",
    ),
    # "The task is complete when the drawer is closed", "the goal is that it is closed"
    (
        rf"(^|[.;!] )(?:{_TASK} (?:is|will be|counts as|is considered)(?: to be)? "
        rf"(?:(?P<not>not) )?{_DONE}|(?:we|you) are (?:(?P<also>not) )?{_DONE}|success is)"
        r"(?: only)? (?(not)(?:until|unless|before)|(?(also)(?:until|unless|before)"
        r"|(?:when|once|if|as soon as)))(?= (?!you\b|i\b|we\b))",
        r"\1in the end",
    ),
    (rf"(^|[.;!] )(?:(?:{_TASK}|the idea) is|success means) that(?= )", r"\1in the end"),
    (r"(^|[.;!] )success means(?= (?:the|my|all|both|every)\b)", r"\1in the end"),
    (rf"(^|[.;!] ){_TASK} is for(?= [^,.;:]* to (?:be|go|stand|lie|sit|end up)\b)", r"\1i want"),
    (_CONTAINER, _with_it_inside),
    (_AT_THE_END, _so_when_done),
    (_LOOKED_AT, _seen_there),
    (
        r"(^|[.;!?] )(?:when(?:ever)? (?:i|we) (?:come back|get back|return|come home|look|am back"
        r"|are back|look again)|(?:once|when) you are (?:done|finished)),? "
        r"(?:i|we) (?:would |should )?(?:want|like|expect|need|wish) to (?:see|find|have) ",
        r"\1i want ",
    ),
    # "A little tower"
    (
        r"\b((?:build|make|form|erect|in|into)(?: me| us)? an?) "
        r"(?:nice )?(?:little|small|tiny|nice|neat|mini) (?=(?:tower|stack|pile)\b)",
        r"\1 ",
    ),
    (
        rf"\b({_SOME}|it) (stays?|remains?|should stay|must stay) (where it is|put),? (?:and )?"
        r"(?:standing |still )?upright(?=[.,;!]|$)",
        r"\1 \2 \3, and \1 \2 upright",
    ),
    # "Open the drawer while the cup stays where it is"; behind "do not" it is a condition
    (
        r"(^|[.;!?] )((?:(?!\b(?:not|never|only|no|without|unless|if|when|until)\b)[^.;!?])*?\w),? "
        rf"while ({_SOME}) (?=(?:stays?|remains?) [^.,;]*(?:, and \3 [^.,;]*)?(?:[.;!]|$))",
        r"\1\2, and \3 ",
    ),
    (
        rf"(?<=\w),? with ({_SOME}) ending (?:up )?(?=(?:on|in|inside|next to|beside|behind)\b)",
        r", with \1 ",
    ),
    # "With the cup still on the tray" tells of no tray.
    (
        r"(?<=\w)(?<!\bnot) with (?="
        rf"{_SOME} (?:still|staying|remaining|left) (?:standing |lying |sitting |resting )?"
        rf"(?:on|in|inside|there|where|untouched)\b)(?!{_SOME} still (?:in|on) it\b)",
        ", with ",
    ),
)
"""In order."""

"""What is forbidden in words of everyday speech, put into plain ones."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.small_words import NAMED
from etot_cli.world.colors import BASIC_COLORS

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
_THEM = rf"{_IT}(?: and {_IT})*"
_ANY = rf"(?:any(?:thing| \w+(?: \w+){{0,2}}?)|{_THEM})"
_NONE = r"(?:nothing|no (?:\w+ ){0,2}?\w+)"
_DONE_TO = {
    "put": "put", "placed": "place", "moved": "move", "shifted": "move", "opened": "open",
    "touched": "touch", "disturbed": "disturb", "taken": "take", "removed": "remove",
    "lifted": "lift", "picked up": "pick up",
}  # fmt: skip
"""What somebody may not want done to a thing, and the verb; "closed" and "left" are how it is."""
_ASKED_TO_BE = (
    *(one for one in _DONE_TO if one not in ("touched", "disturbed")),
    "closed", "shut", "left", "kept", "stored", "transferred", "returned", "brought", "set", "laid",
    "stacked", "emptied", "cleared", "swapped",
)  # fmt: skip
_NO_SUBJECT = (
    r"(?:in|on|into|to|from|up|off|with|at|for|of|by|as|is|are|was|am|ought|that|which|what|who|if"
    r"|open|close|shut|keep|leave|take|put|move|place|pick|make|let|see|ensure|get|everything"
    r"|anything|nothing|i|we|you|they|he|she|want|wants|need|needs|like|wish|prefer|expect|has|have"
    r"|had|going|ready|supposed|meant|due|about|first|next|last|only|thing|things|one|ones)\b"
)
"""Before "to be" these say something else than what is to be done with the thing that they name."""
_TURN = {"opened": "open", "closed": "close", "shut": "close"}


def _neither_turned(said: re.Match[str]) -> str:
    """What must not be opened and must not be closed, each said by itself."""
    begins, things, none, one, two = said.groups()
    some = things or ("anything" if none == "nothing" else none.replace("no ", "any ", 1))
    acts = " and ".join(f"do not {_TURN[act]} {some}" for act in (one, two))
    return f"{begins}{acts}"


def _unwanted(said: re.Match[str]) -> str:
    """What somebody does not want done must not be done."""
    some = said["some"] or re.sub("^(?:nothing|no |none )", _any_of, said["none"])
    return f"do not {_DONE_TO[said['done']]} {some}"


def _any_of(none: re.Match[str]) -> str:
    return {"nothing": "anything", "no ": "any ", "none ": "any "}[none[0]]


def _rather_there(said: re.Match[str]) -> str:
    """Where something goes that is not wanted beside another thing, where "it" is no such one."""
    several = said["what"].endswith("s") or said["what"] == "them"
    clear = several or said["once"] or said["more"] or said["instead"]
    if several is (said["it"] == "it") or not clear or said["mark"] in said["where"]:
        return said[0]
    return f"{said['put']} {said['what']} {said['where']}, not {said['beside']}{said['why'] or ''}"


_KIND = r"(?!objects?\b|things?\b|items?\b|ones?\b)\w+"
_MAY_BE = r"(?:may|must|should|can|shall|is to|are to|has to) be"
FORBIDDING: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    (
        r"(?<=\w),? (?:but|(?:but|and) (?:please )?do (?:it|this|that|so)) without (?=\w+ing\b)",
        ", without ",
    ),
    # "Put the pens in the drawer and keep the cup out": out of where these go
    (
        rf"(\b(?:in|inside|into)(?P<it> it| there|(?<=inside)(?=,? (?:and|but) keep))?\b"
        rf"[^.;:!?]*?),? (?:and|but) (keep {NAMED} [^.,;:!?]*? out)(?=[.;!]|$)",
        lambda said: (
            f"{said[1]}, but {said[3]}" if said["it"] is None else f"{said[1]} and {said[3]} of it"
        ),
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
    # "I do not want the cup by the tray any more. Put it on the shelf instead"
    (
        rf"\b(?:i|we) (?:do not (?:want|like)|(?P<once>no longer) want) (?P<what>{_IT}) "
        rf"(?P<beside>(?:by|near|next to|beside|close to) (?P<mark>{_IT}))"
        rf"(?P<more> any ?more| any longer)?(?P<why>, [^.;!?]*)?[.;,] (?:so )?(?P<put>{ASKED}"
        r"(?:put|place|move|set|stand|bring)) (?P<it>it|them) "
        r"(?P<where>(?:(?!and\b|then\b)[^.,;!?])*?)(?P<instead> instead)?(?=[.;!?]|$)",
        _rather_there,
    ),
    # "I do not want anything put on the tray", "I want nothing moved"
    (
        rf"\b(?:i|we) (?:(?:do not want|would not like|will not have) (?:to (?:see|have) )?"
        rf"(?P<some>{_ANY})|want (?P<none>{_NONE}|none of {_IT})) (?:to be |being )?"
        rf"(?P<done>{'|'.join(_DONE_TO)})\b(?! (?:and|or)\b)"
        r"(?![^.;!?]*\b(?:until|till|before|unless)\b)",
        _unwanted,
    ),
    # "Do not open or close anything", "nothing may be opened or closed"
    (
        rf"\b(do not|never) (open|close|shut) (?:or|nor) (open|close|shut) ({_ANY})"
        rf"(?!, {NAMED}){_ENDS}",
        r"\1 \2 \4 and \1 \3 \4",
    ),
    (
        rf"(^|[.;!,] |\b(?:and|but) )(?:({_THEM}) {_MUST_NOT}|({_NONE}) "
        rf"(?:must|should|may|can|is to|are to)) be (opened|closed|shut) "
        rf"(?:or|nor) (opened|closed|shut){_ENDS}",
        _neither_turned,
    ),
    # "Put it between the cup and the jar without moving either of them"
    (
        rf"\b((?:between|next to|beside|near|behind|in front of) ({_IT}) and ({_IT}),? "
        rf"(?:without|and do not|but do not|but without) {_MOVING}) "
        rf"(?:either|any|both|each)(?: one)?(?: of (?:them|these|those|the two))?{_ENDS}",
        r"\1 \2 or \3",
    ),
    # "The red one you leave where it is", "I want it to stay put"
    (
        rf"(^|[.;!,] |\b(?:and|but) )({_THEM}) you (?:can |may |should |must |just )*leave "
        rf"(?=(?:{_SPOT}|alone|untouched|in peace|as (?:it is|they are))(?:[.,;!]|$))",
        r"\1leave \2 ",
    ),
    (
        rf"\b(?:i|we) (?:want|need|would like) ({_THEM}) to "
        rf"(?=(?:stay|remain) (?:{_SPOT}|put\b|as ))",
        r"\1 should ",
    ),
    (
        rf",? (?:but|only|just) nothing ({'|'.join(BASIC_COLORS)})(?=[.,;!]|$)",
        r", except anything \1",
    ),
    (r"\b(?:keep|take) your (?:hands|paws|fingers) off (?=\w)", "do not touch "),
    # "Only the cup should go in the box, nothing else"
    (
        rf"((?:^|[.;!] )only {NAMED} [^.,;!]*? (?:goes?|belongs?|should|must|is to|are to) "
        r"(?:(?! and )[^.,;!])*?),? (?:and )?nothing else(?=[.;!]|$)",
        r"\1",
    ),
    # "To the right of the cup, not left" of it
    (
        r"(\b(?:left|(right))(?: side)? of (?:(?! and |\bleft\b|\bright\b)[^.,;!])*?),? "
        r"(?:and |but )?not (?:(?:to|at|on) )?(?:the |its )?((?(2)left|right))(?: side)?"
        r"(?=[.;!]|$)",
        r"\1, not to the \3 of it",
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
    # "Circuit board not to be touched", "drawer to be shut afterwards": a verb is left out
    (
        r"(^|[.;:!] ?|(?:^|[.;] )(?:if|once|when|after|before|unless|should)\b[^.,;:!?]*, )"
        rf"((?:(?!{_NO_SUBJECT})\w+ ){{1,5}}?)(?:(not to)|to) be "
        rf"(?(3)(?=(?:{'|'.join(_DONE_TO)}){_ENDS})|(?=(?:{'|'.join(_ASKED_TO_BE)})\b))",
        lambda said: f"{said[1]}{said[2]}must {'not ' if said[3] else ''}be ",
    ),
    # "No other cup may be moved: put just the red one on the tray": others than that
    (
        rf"(^|[.;!] )no other ({_KIND}) {_MAY_BE} (move|touch|disturb)e?d[:.;,] "
        r"(?:so |please )*([^.;:]*?\bthe (?:\w+ )?)one\b([^.;:]*)(?=[.;]|$)",
        r"\1\4\2\5, and do not \3 any other \2",
    ),
    (rf"\bno other ({_KIND}) {_MAY_BE} (move|touch|disturb)e?d\b", r"do not \2 any other \1"),
    (
        rf"\bwithout ({_IT}) (?:moving|budging|stirring|leaving (?:{_SPOT})){_ENDS}",
        r"without moving \1",
    ),
)
"""In order (see :mod:`etot_cli.reasoning.language.grammar.paraphrasing.paraphrases`)."""

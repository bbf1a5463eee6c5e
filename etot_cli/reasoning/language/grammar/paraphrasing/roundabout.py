"""Roundabout ways of saying which things and which places are meant, put plainly."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.asides.people import PEOPLE
from etot_cli.reasoning.language.grammar.paraphrasing.corners import TABLE
from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED
from etot_cli.reasoning.language.words.categories import CATEGORIES
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import LEVELS, SIZES, is_descriptive
from etot_cli.reasoning.language.words.small_words import NAMED

_CATEGORY = "|".join(CATEGORIES)
_COMPARED = "|".join(word for word in SIZES if word.endswith(("er", "est")))
_NOUN = r"(?:the|my|our) (?:\w+ ){0,3}?\w+"
_END = r"(?=[.,;!?]| and\b| then\b|$)"
_YOU = "(?:you|the robot|yourself)"
_FREE = (
    r"where (?:nothing else (?:is|stands|lies)(?: (?:yet|already))?|there is nothing(?: else)?"
    r"|there is (?:still )?(?:room|space)|it is (?:free|empty))"
)
_MUST = r"should|must|shall|has to|have to|is to|are to|needs? to|ought to"
_SOME = rf"{NAMED}(?: (?!and\b|or\b|in\b|on\b)\w+){{1,4}}?"
_THAT = "(?:that one|that|it|this)"
_HAS = "(?:has|have|is|are|was|were)"
_SOMETHING = (
    rf"{PEOPLE} (?:(?:just|also|really|only) )?(?:(?:will )?needs?|wants?|would like"
    r"|(?:have|has|needs?|wants?|would like|(?:am|is|are) (?:going|trying)) to"
    r" (?:get|take|fetch|grab|reach)|(?:am|is|are) looking for)"
    r" (?:something|some (?:things?|stuff)|a thing(?: or two)?|a (?:few|couple of) things)"
    r"(?: else)?"
)
"""What somebody wants who tells why something is to be opened."""

_WORKERS = "shift|user|worker|crew|staff|team|cleaners?|technician|apprentice|trainee|student"
_BY_WHOM = (
    rf"(?!you\b|we\b|nobody\b|no one\b|any)(?:{PEOPLE}|(?:the|a|an|our|my) "
    rf"(?:(?:{_WORKERS})|(?:previous|last|earlier|night|day|morning|late|early) "
    rf"(?:{_WORKERS}|operator|person|experimenter)))"
)
"""Who did what a thing is told by; "you", "we" and "the operator" are the robot, or ask for it."""
_DONE = r"(?:just |already |once )?(?:left|put|placed|set|laid|dropped|forgot|forgotten|stored)"
_BY_NOW = r"(?:that|which) (?:is|are|was|were|has been|have been|had been)"
_WORD = r"(?!(?:that|which|is|are|be|was|were|and|or|to|not|should|must|in|on|by|from|gets?)\b)\w+"
_TURNED = "(?:left )?(?P<state>open|closed|shut|empty|opened)"
_THING = (
    rf"(?<!want )(?<!like )(?<!need )(?<!have )(?<!with )(?<!see )(?<!keep )(?<!leave )"
    rf"(?<!prefer )\b(?P<what>{NAMED} {_WORD}(?: {_WORD}){{0,2}}?) "
)
_STANDS = rf"(?:in|on|inside|under|behind|beside|next to) {NAMED}"


def _by_how_it_is(said: re.Match[str]) -> str:
    """A thing told by who left it so, which shows now in how it is."""
    what, state, place = said["what"], said["state"] or "", said["place"]
    several = what.endswith("s") and not what.endswith("ss")
    now = place or {"opened": "open"}.get(state, state)
    return f"{what} that {'are' if several else 'is'} {now}"


def _of_one_sort(said: re.Match[str]) -> str:
    """Neither of two things of which but the second has its noun ("neither the blue nor the …")."""
    first, word, second, other, noun = said.groups()
    told = all(is_descriptive(item) or item in LEVELS or item in SIZES for item in (word, other))
    return f"neither {first} {noun} nor {second} {noun}" if told else said[0]


def _holding_in_the_end(said: re.Match[str]) -> str:
    """How a thing is to be in the end, told by what is on it."""
    begun, what, upon, at, inner, within, around = said.groups()
    more = f", and {inner} should be {within} {around}" if inner else ""
    return f"{begun}{upon} should be {at} {what}{more}"


ROUNDABOUT: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    # "It is the red cup I need now, so pick it up"
    (
        rf"(^|[.;!?,] )it is ({NAMED} (?:\w+ ){{0,2}}?\w+) (?:that )?((?:i|we) (?:need|want))"
        r"(?=(?: now)?,? so\b)",
        r"\1\3 \2",
    ),
    (r"(^|[.;!?] )(what with [^.,;:]*?) (?=(?:i|we) (?:want|need|would like)\b)", r"\1\2, "),
    (
        r"\b(that (?:is|are) (?:in|on) (?:there|it)) now(?= (?:can|goes|should|must|belongs)\b)",
        r"\1",
    ),
    # "The tray goes on the shelf. Before you lift it, take the cup off"
    (
        r"(\b(?:go|goes|belongs?|put|move|place|set|bring)\b[^.;!?]*? (?:on|in|onto|into|to|next"
        r"|beside|behind)\b[^.;!?]*[.;!] )before (?:you (?:lift|move|shift|take|pick up)"
        r"|(?:lifting|moving|shifting|taking)) it(?: up)?,? ",
        r"\1before you do that, ",
    ),
    (rf"\b(?:pop|fling|swing) (it|them|{NAMED} (?:\w+ ){{0,2}}?\w+) open\b", r"open \1"),
    # "The pen goes up there with it"
    (
        r"\b((?:goes|belongs|put [^.,;:]*?|and [^.,;:]*?)(?: up| in| down| over)? there) "
        r"with (?:it|them)" + _END,
        r"\1 too",
    ),
    # "Somebody, naming no names, …"
    (
        r"\b(some(?:body|one)),(?: and)?(?: i am)? (?:naming|mentioning) no names,(?: \w+,)? "
        r"(?=(?:has|had|is|was|did|keeps?|left|forgot)\b)",
        r"\1 ",
    ),
    # "The drawer left open by the previous shift", "the cup put on the tray by my brother"
    (
        rf"{_THING}(?:{_BY_NOW} )?(?:{_TURNED}|{_DONE} (?P<place>{_STANDS}(?: {_WORD}){{1,3}}?))"
        rf" by {_BY_WHOM}\b",
        _by_how_it_is,
    ),
    # "The drawer that the previous shift left open", "the cup my brother put on the tray"
    (
        rf"{_THING}(?:(?:that|which) )?{_BY_WHOM} (?:has |had |have )?"
        rf"(?:{_TURNED}\b|{_DONE} (?P<place>{_STANDS}))",
        _by_how_it_is,
    ),
    # "The cup, as well as the pen, goes in the box"
    (
        rf"\b({NAMED}(?: \w+){{1,4}}), (?:as well as|along with|together with) "
        rf"({NAMED}(?: \w+){{1,4}}), (?=(?:goes|go|belongs?|should|must|has to|needs to)\b)",
        r"\1 and \2 ",
    ),
    # "Red cup first: put it on the tray"
    (
        r"(^|[.;!] )(?:the )?((?!the\b|do\b|put\b|take\b|open\b)\w+(?: \w+){0,2}?)(?<!s) first: "
        r"(put|place|move|bring|take|set|drop|store|pick|open|close|shut) it\b",
        r"\1first \3 the \2",
    ),
    # "Make sure that in the end the cup is on the tray and neither pen has been moved"
    (
        r"\b((?:(?:at|in) the end|make sure|ensure|see to it)\b[^.;!?]*?)(?:, and|,| and) "
        rf"(?:(neither|no|none of the) (\w+(?: \w+)??) {_HAS}|({_NOUN}) {_HAS} not)(?: been)? "
        r"(mov|touch)ed(?=[.;!]|$)",
        lambda said: (
            f"{said[1]}; do not {'move' if said[5] == 'mov' else 'touch'} "
            f"{said[4] or ('either ' if said[2] == 'neither' else 'any ') + said[3]}"
        ),
    ),
    # "Constraint: the cup may not be moved. Task: …"
    (
        r"(^|[.;\n] ?)(?:hard )?(?:constraint|restriction|rule)s?: ?"
        r"(?:([^.;:]*?) (?:is|are) not (?:to be )?(?=(?:moved|touched|opened|closed)\b)|"
        r"(?=[^.;:]*\b(?:may|can|do|must|never|no|nothing|neither|without|only|keep|off)\b))",
        lambda said: f"{said[1]}{said[2]} must not be " if said[2] else said[1],
    ),
    # "… It can go on the shelf instead, on the top board, and the pen in the cup"
    (
        r"(?<=[.;!] )((?!(?:if|when|once|unless|as)\b)[^.;!?:,]+?) instead"
        r"(?=,? and\b|, (?:in|on|inside)\b)",
        r"instead, \1",
    ),
    # "Starting with the cup and followed by the pen, put both of them in the box"
    (
        rf"(^|[.;!] )(?:starting|beginning) with ({_NOUN}),? (?:and )?(?:followed by|then)"
        rf" ({_NOUN}), (?=[^.;]*\b(?:both|them)\b)",
        r"\1first \2 and then \3, ",
    ),
    # "I would be happy with the cup on the tray"
    (
        r"\b(i|we) would be (?:very |quite |really )?(?:happy|glad|pleased) (?:with|to have) "
        rf"(?=(?:{NAMED}|any|one|two|three)\b[^.;,]*? (?:in|on|inside|next to)\b)",
        r"\1 would like ",
    ),
    # "The red one I would be glad to have on the tray"
    (
        rf"((?:^|[.;!,] |\b(?:and|but) ){_NOUN} (?:i|we) would) be (?:very |quite |really )?"
        r"(?:happy|glad|pleased) to have (?=(?:in|on|inside|next to|behind|to the)\b)",
        r"\1 like to have ",
    ),
    (r"\bany (?=(?:two|three|four) (?:of )?)", ""),
    # "I do not want the cup on the tray, only the pen"
    (
        rf"\b(i|we) do not want ({_NOUN}) ((?:in|on|inside) {_NOUN}), (?:only|just) ({_NOUN})"
        r"(?=[.;!]|$)",
        r"\1 do not want \2 \3, but \1 want \4 \3",
    ),
    # "Neither of the cups should be on the tray, just the pen"
    (
        rf"(?:(?<=^)|(?<=[.;!] ))((?:(?:neither|none) of )?{_NOUN}) ({_MUST}) (not )?"
        rf"((?:be|go|stand|end up) (?:in|on|inside) {_NOUN}), (?:but )?(?:only|just) ({_NOUN})"
        r"(?=[.;!]|$)",
        lambda said: (
            f"{said[1]} {said[2]} {said[3] or ''}{said[4]}, but {said[5]} {said[2]} {said[4]}"
            if bool(said[3]) != (said[1][0] == "n")
            else said[0]
        ),
    ),
    (rf"(, (?:and )?not (?:in|on|into|onto|inside) {_NOUN}) either(?=[.;!]|$)", r"\1"),
    # "It belongs in the fridge, not out here": where it is now, so nowhere else
    (
        rf"\b((?:belongs?|goes|go) (?:in|on|inside|into|onto) {_NOUN}), (?:and )?"
        r"not (?:out |over |up |down )?here(?=[.;!]|$)",
        r"\1",
    ),
    # "The pens must all stay where they are"
    (
        rf"\b({_NOUN}s) ({_MUST}) all (?=(?:remain|stay|be|go|end)\b)",
        lambda said: f"all {said[1]} {said[2]} ",
    ),
    # "Stack the cups. The red one must not be on top"
    (
        rf"^({ASKED}(?:stack|pile)(?: up)? (?:(?:all|both)(?: of)? )?(?:the|these|my) "
        r"(?:\w+ ){0,2}?\w+s(?: up)?(?: on (?:the|my) (?:\w+ )?\w+)?)"
        r"(?:[.;!?] (?:but |and )?|,? and )((?:(?:do not|never) (?:put|place|have) )?"
        rf"the (?:\w+ ){{1,2}}one (?:(?:{_MUST}|goes|belongs)\b )?(?:not )?(?:(?:be|go) )?"
        r"(?:on|at) (?:the )?(?:very )?(?:top|bottom)(?=[.!]|$))",
        r"\1, but \2",
    ),
    # "The tray should end up with the cup on it and the pen inside the cup"
    (
        rf"(^|[.;!] )({_SOME}) (?:{_MUST}) (?:end up|be left|finish up|finish) with ({_SOME}) "
        r"(on(?: top of)?|in|inside) it(?:,? and (?:with )?"
        rf"({_SOME}) (on|in|inside) ({_SOME}))?(?=[.;!]|$)",
        _holding_in_the_end,
    ),
    # "With the cup placed on top of it"
    (
        rf"\bwith ({_SOME}) (?:stacked|placed|put|set|piled|positioned) "
        r"(?=(?:(?:right|directly) )?(?:on|onto|in|into|inside|next to|beside) )",
        r"with \1 ",
    ),
    # "Everything out of the box and into the bin" is moved once
    (
        rf"\b(everything|all of it|all) (?:out of|off(?: of)?) ({_SOME}),? and "
        r"(?=(?:into|onto|in|on|to) )",
        r"everything from \2 ",
    ),
    (
        rf"\b((?P<sort>{_CATEGORY})\b[^.;]*[.;] [^.;]*?\bthe (?:{_COMPARED}) )(?:piece|one)\b"
        r"(?! of\b)",
        lambda said: f"{said[1]}{said['sort']}",
    ),
    # "Blocks of every colour but red"
    (
        r"\b(?:(?:all|the|all the) )?(\w+s) (?:of|in) (?:every|any|all|each) colou?rs? "
        r"(?:but|except(?: for)?|other than|apart from|save) (\w+)\b",
        r"all the \1 except the \2 ones",
    ),
    # "No vial other than the red one is allowed there, so put that one there"
    (
        r"\b(no (\w+) (?:other than|but|except(?: for)?) (the \w+) one (?:is|may be) [^.,;]*, "
        rf"so {ASKED}(?:put|place|set|stand)) (?:that one|that|it) (?=there|in\b|on\b)",
        r"\1 \3 \2 ",
    ),
    # "Neither of the cups on the tray may be moved; the third goes …"
    (
        r"\b((?:neither|both) of (?:the|my) [^.;]*[.;,] (?:but |and )?)the third(?: one)?\b"
        r"(?! (?:cup )?(?:from|of)\b)"
        r"(?= (?:is|goes|should|must|may|can|has|belongs|one)\b)",
        r"\1the other",
    ),
    # "Empty the beaker of its rod"
    (rf"\b((?:empty|clear|free|rid|relieve) {_NOUN} of) its (?=\w)", r"\1 the "),
    # "Staples are kept in the top drawer, so open that one"
    (
        rf"(^|[.;] )(?:(?:the|my|our) )?\w+(?: \w+)? (?:is|are) (?:usually |always |normally )?"
        rf"(?:kept|stored) in ({_NOUN}),? so,? ({ASKED}(?:open|close|shut)) "
        rf"(?:that one|that|it|this one){_END}",
        r"\1\3 \2",
    ),
    # "I need something from the top drawer, so open it": what is in there is not asked for
    (
        rf"(^|[.;!?] ){_SOMETHING} (?:from|out of|in|inside)(?: (?:inside|within))? "
        rf"({_NOUN}(?: of {_NOUN})?)(?:[,.;!]| and)*(?: so)?,? "
        rf"({ASKED})"
        rf"(?:(?:open(?: up)?|unlock) {_THAT}|(?:pull|swing|slide) {_THAT} open)\b",
        r"\1\3open \2",
    ),
    (
        rf"\b((?:open(?: up)?|pull open|unlock) {_NOUN}(?: of {_NOUN})?(?: for me)?)"
        rf"(?:[,.;:!?]+| because| since| as| for)* {_SOMETHING} "
        rf"(?:from|out of|in|inside|from inside)(?: (?:it|there|in there))?{_END}",
        r"\1",
    ),
    # "To the chest's top", "in the desk's far right corner"
    (rf"\b(on|onto|to) ({_NOUN}) ?'s top(?: surface)?{_END}", r"\1 the top of \2"),
    (
        rf"\b(the|my) ({TABLE}) ?'s "
        r"((?:(?:far|near|front|back|rear|left|right|upper|lower|hand) ?)+"
        r"(?:corner|edge|side|end|half))\b",
        r"the \3 of \1 \2",
    ),
    (
        r"\bon(to)? (?=the (?:(?:far|near|front|back|rear|left|right) )*corner\b)",
        lambda said: "to " if said[1] else "at ",
    ),
    (r"\bneither (the (\w+)) nor (the (\w+)) (\w+)\b", _of_one_sort),
    # "Out of the cup and onto the left side of the table"
    (
        rf"(\b(?:out of|off|from) (?:{NAMED}) (?:\w+ ){{0,3}}?\w+),? and (?:then )?"
        r"(?=(?:onto|into|to|on|in|at) the (?:(?:far|near|front|back|rear|left|right) )+"
        r"(?:corner|side|half|edge|end|part)\b)",
        r"\1 ",
    ),
    # "In front of the cup, on the side facing the robot"
    (
        rf"\b(in front of {_NOUN}),? (?:on|at) the side (?:that is |that )?"
        rf"(?:facing|faces|nearest to|closest to|toward|towards|near) {_YOU}{_END}",
        r"\1",
    ),
    # Whatever is put down goes where there is room.
    (rf",? {_FREE},? (?=(?:on|at|in|next to|beside|near) {NAMED})", " "),
)
"""In order."""

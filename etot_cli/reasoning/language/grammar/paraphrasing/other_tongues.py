"""What is asked for in the words and the word order of other tongues ("put me the cup there", "the
left one you let where it is", "the door from the box"), where that can mean but one thing.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.paraphrasing.you_do import DO_OR_DID
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.small_words import NAMED

_NOUN = r"(?!(?:you|i|we|it|that|which|is|are|in|on|from|to|of|and|or|where|as)\b)\w+"
_THING = rf"(?:(?:{NAMED} )?{_NOUN}(?: {_NOUN}){{0,3}}?)"
_END = r"(?=[.,;:!?]|$| (?:and|but)\b)"
_MUST = r"(?:must|should|shall|has to|needs to|have to|need to|is to|are to)"
_PUT = "put|place|set|lay|store|stow|keep|bring|insert|drop|transfer"
_MOST = {
    "big": "biggest", "large": "biggest", "small": "smallest", "little": "smallest",
    "tall": "tallest", "short": "shortest", "long": "longest", "wide": "widest", "low": "lowest",
    "high": "highest", "near": "nearest", "close": "nearest", "far": "farthest",
    "heavy": "heaviest",
}  # fmt: skip
_DONE = r"(?:that|this) (?:is|has been) (?:done|finished|completed?)"


def _stay(said: re.Match[str]) -> str:
    """What is let stand where it is by now."""
    several = said["what"] == "them" or said["what"].endswith("s")
    return f"leave {said['what']} where {'they are' if several else 'it is'}"


def _to_be_done(said: re.Match[str]) -> str:
    """What is "to put" somewhere is to be put there, unless it is the robot that puts."""
    done = {"place": "placed", "store": "stored", "keep": "kept"}.get(said[3], said[3])
    robot = re.search(r"\b(?:robot|arm|gripper|hand)\b", said[2])
    return said[0] if robot else f"{said[1]}{said[2]} be {done} "


def _please(said: re.Match[str]) -> str:
    """What is asked for, or not, by the last word."""
    verb = said[0].split()[-1]
    return f"{said[1]}{'do not ' if said[3] else ''}{verb} {said[2]}"


OTHER_TONGUES: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    (r"\b(my english (?:is|was) [^.,;:!?]*),? sorry ?[:.,!] ", r"\1. "),
    (rf"\b(put|place|set|lay|stand|open|close|shut) me (?:please )?(?={NAMED})", r"\1 "),
    # "The left one you must not touch"
    (
        rf"(^|[.;!,:] |\b(?:and|but) )({NAMED} {_THING}(?: (?:on|at) the (?:left|right))?) you "
        r"((?:must|should|may|shall|can) not (?:touch|move|open|close|disturb))(?=[.,;!]|$)",
        r"\1you \3 \2",
    ),
    (r"(^|[.;!,] |\bbut )(?:attention|caution|careful|beware|note)(?: please)?: ?", r"\1"),
    # "First you open the drawer, …, finally you close"
    (
        r"(?<=[.;!,] )((?:and )?(?:finally|lastly|at last|in the end),? )(?:you )?"
        r"(close|shut)(?: again)?(?=[.;!]|$)",
        r"\1\2 it",
    ),
    # "Two dishes, I want them on the shelf, the black one on the left"
    (
        rf"((?:^|[.;!] )(?:{NAMED}|two|three|four) [^.;:!?,]*?[,:] )(?:i|we) "
        r"(?:want|need|would like) (?:to have )?(?=(?:them|it) (?:in|on|inside|next to|beside)\b)",
        r"\1put ",
    ),
    # "The jar is in wrong place. Correct place is the left side of the box."
    (r"\bis in wrong (place|position|location)\b", r"is in the wrong \1"),
    (
        r"(?<=[.;!] )(?:the |its )?(?:correct|right|proper) (?:place|position|location) is "
        rf"(?:at |to )?(?={NAMED}|left\b|right\b|(?:(?:top|bottom|upper|lower|middle) \w))",
        "it goes to ",
    ),
    (r"\b(first|second|third|fourth|1st|2nd|3rd|4th) (\w+) from below\b", r"\1 \2 from the bottom"),
    (r"\b(first|second|third|fourth|1st|2nd|3rd|4th) (\w+) from above\b", r"\1 \2 from the top"),
    (
        rf"(^|[.;!] )should ({NAMED} (?:\w+ ){{1,3}}?)(contain|hold|have)(?= )",
        r"\1if \2\3s",
    ),
    (r"\b(i|we) (?:am|are) (want|need)ing (?=\w)", r"\1 \2 "),
    (r"(^|[.;!] )you please (?=\w)", r"\1please "),
    (r"\b(if you )will (?=(?:please )?\w+ (?:the|my|it|them|both|all)\b)", r"\1would "),
    (
        rf"(^|[.;!] )((?:the|my) {_NOUN}(?: {_NOUN})?),? it (?={_MUST}\b|goes\b|belongs\b)"
        rf"(?![^.,;:!?]*\b(?:in|into|on|onto|from|to|beside) (?:is|are|was|has|goes|{_MUST})\b)",
        r"\1\2 ",
    ),
    (rf"\b({_MUST}(?: not)?) to (?=(?:be|go|come|stand|stay|lie)\b)", r"\1 "),
    # "The red tube is to put in the rack", "it must be closed the drawer"
    (
        rf"(^|[.;!,] |\band )((?:{NAMED} )?{_THING} (?:{_MUST})) (put|place|store|keep) "
        r"(?=(?:in|on|into|onto|inside|next|beside|behind)\b)",
        _to_be_done,
    ),
    (
        rf"(^|[.;!] )it ({_MUST}) be (closed|shut|opened|put|placed|moved) "
        rf"({NAMED} (?:(?!time\b|while\b|day\b|way\b|moment\b){_NOUN} ?\b){{1,3}}?)"
        r"((?: (?:in|on|into|onto|inside) [^.,;:!?]*)?)(?=[.,;!]|$)",
        r"\1\4 \2 be \3\5",
    ),
    # "The big one, not the more small", "today itself", "may kindly be put", "…, isn't it?"
    (rf"\bthe (?:more|most) ({'|'.join(_MOST)})\b", lambda said: f"the {_MOST[said[1]]}"),
    (r"\b(may|should|must|shall|to) kindly (?=\w)", r"\1 "),
    (r",? (?:is it not|is not it|no|na)(?= ?\?$)", ""),
    # "Take it and put the same there", "close it and after open the other", "in the inside of it"
    (
        rf"\b((?:and|then) (?:(?:then|please|kindly) )*{DO_OR_DID}) the same"
        r"(?= (?:in|on|into|onto|inside|next|beside)\b|[.,;!]|$)",
        r"\1 it",
    ),
    (rf"\b(and|then) after,? (?={DO_OR_DID} (?:{NAMED}|it\b|them\b))", r"\1 then "),
    (rf"(?<!access )\b(?:in|into|to) the (?:inside|interior) of (?={NAMED})", "inside "),
    (
        rf"\b(take|get|bring|pull|fetch) (out|away|off|down) (?:of|from|from out of) "
        rf"({NAMED} {_THING}) ({NAMED} {_THING})(?=[.,;!]|$)",
        r"\1 \2 \4 from \3",
    ),
    (
        rf"\bmake (?:(open|closed|shut) ({NAMED} {_THING})|({NAMED} {_THING}) (open|close|shut))"
        r"(?=[.,;!]|$)",
        lambda said: (
            f"make sure that {said[2]} is {said[1]}" if said[1] else f"{said[4]} {said[3]}"
        ),
    ),
    (r"\bmake (?:it )?so,? that\b", "make sure that"),
    (
        rf"\b(make (?:sure )?that {_THING} )(open|close)s?{_END}",
        lambda said: f"{said[1]}is {said[2].replace('close', 'closed')}",
    ),
    (r"\bexcept of\b", "except"),
    (r"\bapart of (?=the\b)", "apart from "),
    (r"\bthe both\b(?= \w)", "both"),
    (rf"\bmore (?:near|close)(?: to)? (?={NAMED})", "closer to "),
    (rf"\bthere where (?={NAMED}|it\b)", "where "),
    (rf"\bin(?:to)? the table{_END}", "on the table"),
    # "In the lens tray only": there and nowhere else, which is what is asked for anyway
    (
        rf"((?:^|[.;!,:] |\b(?:and|then) )(?:(?:please|kindly),? )*(?:(?:{_PUT})\b|(?:i|we) (?:want"
        rf"|need|would like)\b|{NAMED} [^.,;:!?]*\b(?:goes|go|belongs?|{_MUST})\b|both\b|all\b)"
        r"(?:(?!\b(?:not|no|never|only|an?|any|one|two|three|or|either|when|if)\b)[^.,;:!?])*"
        rf"\b(?:in|on|into|onto|inside|to)(?: of)? (?!it\b|them\b){_THING}) only(?=[.;!]|$)",
        r"\1",
    ),
    # "It must stay on its place"; "in its place" may be in place of it
    (
        r"\b((?:(?:stays?|remains?)\b[^.,;:!?]*? (?:(?:on|at) its|(?:on|at|in) their)"
        rf"|(?:leave|let)\b[^.,;:!?]*? (?:on|at) (?:its|their))) places?{_END}",
        lambda said: (
            f"{said[1].rsplit(' ', 2)[0]} where {'it is' if 'its' in said[1] else 'they are'}"
        ),
    ),
    (
        r"\b((?:leave|keep|let)\b[^.,;:!?]*?) how (?=(?:it|they|everything) (?:is|are)\b)",
        r"\1 as ",
    ),
    (
        r"\bback\b([^.;:!?]*?),? (?:exactly |just )?(?:the )?same as (?=(?:it was|they were)\b)",
        lambda said: f"back{said[1]}, as " if said[1] else "back where ",
    ),
    # "The models you let stand", "let the models stand"
    (r"\byou let (?=(?:where|as) (?:it|they)\b|alone\b|untouched\b)", "you leave "),
    (rf"\b(?P<what>{NAMED} {_THING}) you let (?:stand|lie|be){_END}", _stay),
    (rf"\blet (?P<what>it|them|{NAMED} {_THING}) (?:stand|lie){_END}", _stay),
    # "The two filters of the right side", "the drawer of the middle"
    (
        r"(?<!\btop )(?<!edge )(?<!corner )(?<!end )(?<!middle )(?<!half )(?<!part )(?<!front )"
        r"\bof the (left|right) side(?! of\b)",
        r"on the \1",
    ),
    (
        r"\bthe (drawers?|boards?|shelf|compartment) of the (middle|top|bottom)(?! \w+ of\b)"
        rf"{_END[:-1]}|(?= (?:is|are|in|on|{_MUST})\b))",
        r"the \2 \1",
    ),
    (
        r"\b((?:open|close|shut)(?: please)? the (?:\w+ )?(?:door|drawer)s? )from (?=(?:the|my) "
        r"(?!left|right|top|bottom|front|back|side|inside|outside|above|middle|other)\w)",
        r"\1of ",
    ),
    # "Where already is the tube"
    (
        rf"(?<=[\w,]) where (?:(?:already|now) (?:is|are|lies?|stands?)|(is|are|lies?|stands?)"
        rf"(?: already| now)?) ((?:the|my) {_THING})(?=[.,;!]|$)",
        r" where \2 is",
    ),
    # "Put there also the cup"
    (
        rf"\b(?:(?<=\bso )you )?({_PUT}) (there|inside|in it|on it|in there) also "
        rf"({NAMED} {_THING})(?=[.,;!]|$)",
        r"\1 \3 \2 too",
    ),
    # "The yellow jar, you take it from there and you put it on the shelf"
    (
        rf"((?:^|[.;!:] ){NAMED} {_THING},? you )(?:take|get|fetch|grab) it(?: from there)? and "
        r"(?:then )?(?:you )?(?=(?:put|place|set|lay) it\b)",
        r"\1",
    ),
    # "From the two models, the white one you put it in the drawer"
    (r"(^|[.;!] )from (?=(?:(?:all|both) )?(?:the|these|those) (?:\w+ ){1,3}?\w+s, )", r"\1of "),
    (
        rf"(^|[.;!,] |\band )({NAMED} {_THING}),? you (?:{_MUST} )?({DO_OR_DID}) (?:it|them) "
        r"(?=[^.,;:!?]*(?:[.!]|$|, (?:where|and|but|then)\b))",
        r"\1\3 \2 ",
    ),
    (
        rf"(^|[.;!,] |\b(?:and|but) )({NAMED} {_THING}),? please (?:do )?(?:(not )|to )?"
        r"(?(3)(?:to )?(?:move|touch|open|close|shut)|(?:open|close|shut))(?=[.;!]|$)",
        _please,
    ),
    # "The red one please leave on the desk"
    (
        rf"(^|[.;!] )({NAMED} {_THING}),? please (leave|keep|put|place) "
        r"(?=(?:on|in|at|into|onto|inside|next|beside|behind|where|as|alone|there)\b)",
        r"\1please \3 \2 ",
    ),
    # "After both cups were put inside"
    (
        r"\b((?:after|once|as soon as) (?:the|both|all|my|it|they)\b[^.,;:!?]*?)"
        r" (?:(was)|were) (?=(?:put|placed|set|moved|taken|brought|opened|closed|stored)\b)",
        lambda said: f"{said[1]} {'has' if said[2] else 'have'} been ",
    ),
    (r"\bcomes? (together (?:in|on|into|onto) )", r"go \1"),
    # "Only when that is done may the cup be put in it"; "do not touch it during this"
    (rf"\bonly (?:when|once|if|after) {_DONE},?", "only then"),
    (
        r"\b((?:do not|never|must not|may not|should not)\b[^.;:!?]*?),? (?:during this|in the "
        r"meantime|meanwhile|thereby)(?=[.,;!]|$)",
        r"\1 while doing this",
    ),
    (r"((?:[.;!]|\b(?:and|but)) )(?:meanwhile|in the meantime|during this),? (?=do not )", r"\1"),
)
"""In order."""

"""Ways of saying what goes where in other words than those of putting, put into plain ones."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED
from etot_cli.reasoning.language.grammar.paraphrasing.trading_places import TRADING_PLACES
from etot_cli.reasoning.language.grammar.paraphrasing.turns_of_phrase import TURNS_OF_PHRASE
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import NUMBERS, singular
from etot_cli.reasoning.language.words.small_words import NAMED
from etot_cli.reasoning.language.words.verbs import PAST
from etot_cli.world.colors import BASIC_COLORS

_COLOR = "|".join(BASIC_COLORS)
_FINE = r"(?:is|would be|will be) (?:fine|ok|okay|good|all right|alright)"
_OF_TWO = r"one of (?:the two|them|these|those)"
_NOUNS = r"(?:(?:the|my) )?\w+(?: (?!or\b|and\b)\w+){0,2}"
_LIE = r"(?:(?:be (?:put |placed |moved )?|stay|remain|go|end up|stand|lie) ?)"
_THERE = r"(?:(?:in|on|inside) it|inside|there|(?:in|on|inside) (?!it\b|them\b)\w[^.,;:]*?)"
_SO_MANY = r"(?:one|an?|two|three|four|five|\d)"
_WHICH = r"which(?: (?:ones?|of (?:them|these|those)))?"
_ANY_OF_THEM = (
    r"(?:(?:it (?:really )?(?:does not (?:really )?matter|makes no difference)"
    r"|(?:i|we) do not (?:really )?(?:mind|care)|no matter|you (?:can )?(?:choose|decide|pick)"
    rf"|(?:it is )?(?:up to you|your choice)) {_WHICH}"
    rf"|any (?:{_SO_MANY} )?(?:of them )?(?:will|would) do"
    rf"|any (?:{_SO_MANY} )?(?:of them )?(?:is|are|would be) (?:fine|ok|okay))"
)
"""Which of several things are meant is left open."""
_SAID_OF_IT = (
    r"(?:(?:in|into|on|onto|next to|beside|behind|should|must|needs?|belongs?|goes|go|ha(?:s|ve) to"
    r"|(?:is|are) to|ought to) )"
)
"""What is asked for with some of several things, behind these."""
_STACKED = (
    r"(?:may|must|should|can|shall|is to|are to) (?:be|lie|stand|sit|rest|end up)"
    r"(?: stacked| placed| put| standing| lying| sitting| resting)? on(?: top of)?"
)
_PUT = r"(?:put|bring|move|place|transfer|drop|tip)"
_GO = r"(?:(?:should|must|can|have to|need to|are to) )?(?:go|goes|belong|move|come)"
_GOES = (
    r"(?:goes|belongs?|go|(?:should|must|needs? to|ha(?:s|ve) to|(?:is|are) to|ought to) "
    r"(?:go|come|end up|belong|be (?:put|placed|moved|set|stored)))"
)
"""What asks where a thing is to be; "should be in the box" may say where it is by now."""
_AT = "into|in|onto|on|inside|to|at|near|between|in front of|next to|beside|behind"
_ENDS = r"(?=[.,;!?]|$)"
_ONCE_DONE = Expression(
    rf"^({'|'.join(PAST)}) (?=(?:up |out )?(?:the|a|an|all|both|every|my)\b)([^.:;!?\n]*)[.!]?$"
)
"""All that is told of what was done, as under a picture."""


def _it(named: str) -> str:
    """The pronoun for what a phrase names."""
    head = named.split()[-1]
    several = " and " in named or singular(head) != head
    return "them" if several else "it"


def _to_do(told: re.Match[str]) -> str:
    """What is told as done for what is to be done ("moved the cup to the left of the plate")."""
    done = re.sub(
        rf"\b(and(?: then)?) ({'|'.join(PAST)})\b",
        lambda said: f"{said[1]} {PAST[said[2]]}",
        told[2],
    )
    return f"{PAST[told[1]]} {done}"


def _all_of(what: str) -> str:
    """What comes along with a thing."""
    return what if what.startswith("the ") else "everything"


PLACEMENTS: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    *TRADING_PLACES,
    # "The smaller one underneath, on the bottom board" beside one on the board above that
    *(
        (
            rf"(\b(?:{others}) (?:board|shelf|level|drawer)\b[^.;!?]*?),? (?:right |just )?"
            rf"(?:{side})(?: (?:it|that))?, (?=(?:on|in|into|onto) the (?:{level})\b)",
            r"\1 ",
        )
        for side, others, level in (
            ("underneath|below|beneath|under", "top|upper|middle", "bottom|lowest"),
            ("above|over", "bottom|lower|middle", "top|topmost|highest"),
        )
    ),
    # "Start with the cup: into the box", "… the cup, which goes into the box"
    (
        rf"(^|[.;!] )({ASKED}(?:start|begin) with ((?:the|my) [^.,;:]*?))"
        rf"(?::|, which {_GOES}) (?=(?:{_AT}) )",
        lambda said: (
            said[0]
            if "which" in said[0] and re.search(rf" (?:{_AT}) ", said[3])
            else f"{said[1]}{said[2]}: put {_it(said[3])} "
        ),
    ),
    # "The cup, which goes into the box, comes first"
    (
        rf"(^|[.;!] )((?:the|my) (?:(?!(?:{_AT}) )\w+ )*\w+), which ({_GOES} (?:{_AT}) [^.,;:]*?), "
        r"(?:comes|goes|is) first(?=[.;!]|$)",
        r"\1first \2 \3",
    ),
    # Who learned another tongue may say "him" and "her" of a thing.
    (
        r"^((?:please,? )?(?:take )?(?:the|my|this) (?:(?!and\b|or\b|to\b|for\b)\w+ ){0,3}\w+"
        rf"(?:,| and|, and)(?: then| please)* {_PUT}) (?:him|her) "
        rf"(?=(?:(?:to the )?(?:left|right) (?:of|from)|{_AT}) )",
        r"\1 it ",
    ),
    # "Put the pen, and after that also the book, in the box"
    (
        r"(?<=\w), and (?:then|after (?:that|this)|afterwards|thereafter),? (?:also )?"
        rf"({NAMED} (?:\w+ ){{0,2}}?\w+), (?=(?:in|into|on|onto|at|next|beside|behind|to)\b)",
        r", then \1, ",
    ),
    # What is taken "out onto the desk" goes there, out of whatever it is in
    (
        r"\b(?:take|lift|get|fetch|bring) ((?:the|my|both|all) [^.,;:]*?) out "
        r"(?=(?:onto|on to|on) (?:the|my|our) )",
        r"put \1 ",
    ),
    # What is done "for a moment" is done until what comes next
    (
        r"\b((?:lift|pick|raise|take) [^.,;:]*?) (?:briefly|for (?:just )?a "
        r"(?:moment|second|minute|bit|(?:little |short )?while)),? "
        r"(?=(?:and |then |and then )(?:put|return|place|set) )",
        r"\1, ",
    ),
    # "The cup and the pen on the tray one beside the other"
    (
        r"(?<!the ),? one (?:next to|beside|alongside) the other(?= (?:on|in) |[.;!?]|$)",
        " next to each other",
    ),
    # "Take the box together with the pen in it and put it …", which goes along in any case
    (
        r"\b((?:take|lift|pick up|get|move|grab) (?:the|my) (?:\w+ ){0,2}?\w+),? "
        r"(?:together|along|complete) with (?P<what>everything|all|what is|whatever is"
        r"|the (?:\w+ ){0,2}?\w+) (?P<at>(?:in|on|inside) it)"
        r"(?=,? and (?:then )?(?:put|set|place|move|bring|stand) it\b)",
        lambda said: f"{said[1]} with {_all_of(said['what'])} {said['at']}",
    ),
    # "Put away the cup and the pen, the one in the cupboard and the other in the drawer"
    (
        r"\bput away ((?:the|my) [^.,;:]*? and [^.,;:]*?)"
        r"(?=, (?:the|my) [^.,;:]*? (?:in|on|back) [^.;:]*?\band the )",
        r"put \1 away",
    ),
    # "The cup is to be moved, to the left of the plate"
    (
        r"\b((?:is|are) to be (?:moved|put|placed|brought)), "
        r"(?=(?:to the (?:left|right)|in front|behind|next to|beside|between|onto|into)\b)",
        r"\1 ",
    ),
    (_ONCE_DONE, _to_do),
    (rf"\b(empty(?:ing)?) ({NAMED} (?:\w+ )??\w+) ?'s contents\b", r"\1 the contents of \2"),
    # "Everything in the drawer and in the locker goes into the crate"
    (
        rf"(^|[.;] )(everything|all)( (?:in|on|inside) {NAMED} (?:\w+ )??\w+) and "
        rf"(?=(?:in|on|inside) {NAMED} (?:\w+ ){{1,2}}?(?:goes|go|belongs|should|must)\b)",
        r"\1\2\3 and \2 ",
    ),
    # "Empty the box and the bag; their contents go in the bin"
    (
        rf"\b((?:empty|unload) (?:(?!\band (?!{NAMED}))[^.;,:])*?)[.;,:] "
        rf"(?:and )?(?:(?:then )?{ASKED}{_PUT} )?(?:all )?"
        rf"(?:(?:the|its|their) )?contents (?:(?:{_GO} ))?(?=(?:in|into|on|onto|to) {NAMED})",
        r"\1 ",
    ),
    (
        rf"(^|[.;:,] |\b(?:and|but) )((?:the|my) (?:\w+ ){{0,2}}?\w+|it|\w+) "
        r"(?:can|may|might|could|must|should|has to|have to) "
        rf"{_LIE}(?:({_THERE})|in(?: there)?) or (?:{_LIE})?"
        r"(?=(?:in|on|inside|into|onto) (?!it\b|them\b)\w)",
        lambda said: f"{said[1]}{said[2]} should be {said[3] or 'inside'} or ",
    ),
    # Who may leave it open need not close it
    (
        r"\b(?:you (?:can|may|could)|it (?:is|would be) (?:fine|ok|okay|all right) (?:to|if you))"
        rf" (?:just |also )?(?:leave|keep) ({NAMED} [^.,;]*?|it|them) (?=(?:open|closed|shut)\b)",
        r"\1 may stay ",
    ),
    # Who is left out, told behind what is done with the others
    (
        rf",? (?:with )?({NAMED} (?:(?!and\b|or\b)\w+ ){{1,3}}?)"
        r"(?:excepted|excluded|not included|being the exception)(?=[.,;!]|$)",
        r", except \1",
    ),
    # What is to be out comes out, be it in there now or on what goes there
    (
        r"(\b(?:in|into|inside) (?:the|my) (?:\w+ ){0,2}?\w+), but (?:leave|keep) "
        r"(the (?:\w+ ){0,2}?\w+) out(?=[.;!]|$)",
        r"\1, but not \2; \2 should not be in it",
    ),
    # What is left behind by what it is in or on
    (
        r"(\b(?:put|place|set|move|take|bring) [^.,;:]*?),? (?:but|and|while) leav(?:e|ing) "
        r"((?:the|its|my) (?:\w+ ){0,2}?\w+) behind(?=[.;!]|$)",
        r"\1 without \2",
    ),
    # Where what is left out is or goes
    (
        r"((?:except|but|only not|apart from|other than)(?: for)? "
        r"((?:the|my) (?:(?!and\b|or\b)\w+ ){0,3}?\w+)), which (?=(?:stays|remains|belongs|goes"
        r"|(?:should|must|has to|is to|can|may) (?:stay|remain|go|be))\b)",
        r"\1, \2 ",
    ),
    # A table of sides ("notebook: left side of the desk")
    (
        r": (?:the )?(?=(?:(?:far|near) )?(?:left|right|front|back) (?:side|half|edge|end|(corner))"
        r"(?: of (?:the|my) \w+)?(?:[.;,!\n]|$))",
        lambda said: f": {'in' if said[1] else 'on'} the ",
    ),
    # Which of them "the two others" are
    (
        rf"\bthe ({'|'.join(NUMBERS)}|\d) others(?= (?:in|on|into|onto|to|go|goes|next|out|off|back"
        r"|down|are|should|must|stay|belong|where|behind|beside|there|inside)\b|[.,;!]|$)",
        r"the other \1",
    ),
    (
        r",? whether (?:\w+ )?or not,? "
        r"(?=(?:is|are|goes?|should|must|belongs?|in|on|into|onto)\b)",
        " ",
    ),
    (
        r"((?:behind|beside|next to|in front of|(?:left|right) of) [^.,;]*?),? (?:and )?"
        r"as (close|near) as (?=(?:you can|it gets|possible)\b)",
        r"\1, as \2 to it as ",
    ),
    # "So that they all stand upright"
    (
        r"\b(so(?: that)?|such that|in such a way that) "
        r"(?:(?:all|both|each) of them|they all|they both|all|both) "
        r"(are |stand |lie |fit )?(?=(?:standing |lying )?(?:upright|flat|standing|lying)\b)",
        r"\1 they \2",
    ),
    (
        r"\b((?:so|that) they (?:are|stand|lie)) (?:all|both|each) "
        r"(?=(?:standing |lying )?(?:upright|flat|standing|lying)\b)",
        r"\1 ",
    ),
    (
        r"\bas (close|near)((?: to)? [^.,;]*?)? as (?:you can|it gets|it goes|can be)\b",
        r"as \1\2 as possible",
    ),
    # "Stack the books, black over blue"
    (
        rf"(\b(?:stack|pile|tower|build)\b[^.;]*?[,:] (?:with )?)({_COLOR}) (?:over|above) "
        rf"({_COLOR})(?=[.,;]| and\b| once\b| after\b|$)",
        r"\1\2 on \3",
    ),
    (
        r"\b(to|on|at|in) the (?:immediate|direct) "
        r"(?=(?:left|right|front|back|rear|left (?:hand )?side|right (?:hand )?side) of\b)",
        r"immediately \1 the ",
    ),
    # As many things are different ones anyway
    (
        rf"\b((?:put|place|move|bring|take|pick up|get|grab|fetch|set) (?:{'|'.join(NUMBERS)}) )"
        r"(?:different|distinct|arbitrary|random) (?=(?!colou?r|kind|sort)\w+s\b)",
        r"\1",
    ),
    # Everything that can be eaten
    (
        r"\b(?:everything|anything|whatever)(?: (?:that|which))?(?: is)? (?:edible|eatable)\b",
        "all the food",
    ),
    # Two headlines of one request ("toy out. then close the drawer")
    (
        r"(^|[.;!]\s+)((?:the |my )?(?:\w+ )?\w+ out)[.;!]\s+"
        r"(?=(?:and |then |next |after that )|(?:\w+ ){1,3}(?:closed|shut|open)(?=[.;!]|$))",
        r"\1\2, ",
    ),
    (r"\bone (\w+|\w+ \w+) only(?=[.,;!?]|$)", r"only one \1"),
    (r"\bno longer (?=(?:in|on|inside) )", "not "),
    # What a set of things "needs on the tray" is needed there by whoever asks for it.
    (
        r"(^|[.;!] )(?:this|the|each|our|my) (?:kit|set|assembly|order|customer|guest|recipe) "
        rf"needs (?={NAMED}[^.;]* (?:in|on)\b)",
        r"\1we need ",
    ),
    (
        rf"(^|[.;!] )(?:and )?one (?:more|last) (?:thing|item) for ({NAMED} [^.,:;]*): "
        rf"(?={NAMED}|a\b|an\b)([^.:;]*)",
        r"\1bring \3 to \2",
    ),
    # "The cup and the jar go in the box. The former must be put in last"
    (
        r"\b((?:the|my) [^.,;:]*? and (?:the|my) [^.,;:]*? (?:go|belong|should go|must go) "
        r"(?:in|into|on|onto) [^.,;:]*?)[.;] (?:but )?(the (?:former|latter)) "
        r"(?:goes|(?:must|should|has to|is to) (?:be put|go))(?: in| on| there)? "
        r"(first|last)(?=[.,;!]|$)",
        r"\1, \2 \3",
    ),
    # "So red is in the cup and green on the tray"
    (
        rf"\b(so(?: that)?|and) ({_COLOR}) (?=(?:is|goes|ends up) (?:in|on|next|to)\b)",
        r"\1 the \2 one ",
    ),
    # Either of two
    (
        r"\bone (?:(of the (?:two |2 )?)(\w{3,}s)|(\w{3,})) or (?:the )?other(?: one)?"
        r"(?=[.,;!?]|$| (?:and|then|with|please)\b)",
        lambda said: f"either {said[1] or ''}{said[2] or said[3]}",
    ),
    # Of two things that are named there "one" is either, "the other one" the other.
    (
        rf"\b{_OF_TWO}(?:,| -)? ?\(?({_NOUNS}) or ({_NOUNS})(?:\)|, |(?= (?:should|goes|has)\b))",
        r"either \1 or \2 ",
    ),
    # "Two of the cups, no matter which, should be on the tray"
    (
        rf"\b((?:{_SO_MANY})(?: \w+){{1,5}})(?:,| -| \() ?{_ANY_OF_THEM}(?:,|\)| -) "
        rf"(?={_SAID_OF_IT})",
        r"\1 ",
    ),
    # Of levels "on top" is the upper one.
    (
        r"\b(on each (?:shelf|board|level)(?: of [^.,;:]*)?)[:,] "
        r"(the (?:\w+ )?\w+) on (?:the )?top(?:,| and|, and) "
        r"(the (?:\w+ )?\w+) (?:below|underneath|(?:at|on) the bottom)(?=[.;!?]|$)",
        r"\1: \2 on the upper and \3 on the lower",
    ),
    # What has room in something, where it is put there
    (
        rf"(^|[.;!] )({NAMED} [^.,:;]*?) "
        r"(?:(?:will |would |should |can )?fits?|is (?:small|narrow) enough to fit) "
        rf"(in|into|inside|on|onto) ({NAMED} [^.,:;]*?)[.,;](?: so)? {ASKED}"
        r"(put|place|set|drop) it "
        r"(?:(?:in |inside |on )?(?:there|it)|in|inside)(?=[.,;!?]| and\b|$)",
        r"\1\5 \2 \3 \4",
    ),
    (rf", (?=(?:anywhere|somewhere) [^.,:;]* {_FINE}[.!]?$)", ". "),
    # Of several of which any will do "one" is what is spoken of.
    (
        r"\b((?:either|any)(?: one)? of the [^.,;]*? (?:will do|would do|works|"
        rf"{_FINE})[.,;] (?:so )?{ASKED}(?:put|place|take|pick up|bring|drop)) one\b"
        r"(?! of\b)",
        r"\1 it",
    ),
    (rf"^({ASKED})(just|only) ({NAMED} [^.,:;]*? (?:in|into|on|onto) {NAMED} [^.,:;]*?),? "
     r"(?:and )?nothing else\b", r"\1put just \3, nothing else"),
    (r"\bwill have to (?=(?:go|be)\b)", "must "),
    # What a pronoun means, said behind it
    (
        r"\b(?:it|them)((?: (?!it\b|them\b)[^.,; ]+)*), ((?:the|my) (?:\w+ ){0,2}?\w+),? i mean"
        r"(?=[.,;!?]|$)",
        r"\2\1",
    ),
    (
        r"\b(neither (?:of the )?(\w+?)s? should (?:have|hold|contain) [^.;]*[.,;] [^.;]*? "
        r"(?:in|into|on)) one of them\b",
        r"\1 one of the \2s",
    ),
    (rf"\bneither (?:of the )?(\w+?)s? should (?:have|hold|contain) ({NAMED} [^.,:;]*?)"
     r"(?: in (?:it|them))?(?=[.,;!?]|$| and\b)", r"\2 should not be in either \1"),
    # "… the blocks on the tray; no block may be stacked on another"
    (
        rf"(\b(\w+)s\b[^.;]*)[.;,] (?:but |and )?no \2 {_STACKED} another(?: \2| one)?{_ENDS}",
        r"\1, none on another",
    ),
    (
        rf"[.;,] (?:but |and )?(?:none|neither)(?: of (?:them|the (?:\w+ )?\w+))? {_STACKED} "
        rf"(?:(?:an)?other(?: one)?|the others?|each other|any other(?: one)?){_ENDS}",
        ", none on another",
    ),
    *TURNS_OF_PHRASE,
)  # fmt: skip
"""In order."""

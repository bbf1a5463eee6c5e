"""Ways of speaking, put into the plain ones that the grammar knows, in order."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.asides.going import GOING
from etot_cli.reasoning.language.grammar.asides.remarks import PEOPLE
from etot_cli.reasoning.language.grammar.paraphrasing.asked_otherwise import ASKED_OTHERWISE
from etot_cli.reasoning.language.grammar.paraphrasing.corners import CORNERS_AND_SIDES, TABLE
from etot_cli.reasoning.language.grammar.paraphrasing.end_states import END_STATES
from etot_cli.reasoning.language.grammar.paraphrasing.forbidding import FORBIDDING
from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED, LISTINGS
from etot_cli.reasoning.language.grammar.paraphrasing.obstacles import OBSTACLES
from etot_cli.reasoning.language.grammar.paraphrasing.placements import PLACEMENTS
from etot_cli.reasoning.language.grammar.paraphrasing.roundabout import ROUNDABOUT
from etot_cli.reasoning.language.grammar.paraphrasing.said_again import SAID_AGAIN
from etot_cli.reasoning.language.grammar.paraphrasing.whereabouts import WHEREABOUTS
from etot_cli.reasoning.language.grammar.text.contractions import CONTRACTIONS
from etot_cli.reasoning.language.words.categories import CATEGORIES
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import NUMBERS, SIZES
from etot_cli.reasoning.language.words.small_words import NAMED, WHERE
from etot_cli.reasoning.language.words.verbs import PAST

HYPHENS = "-\N{NON-BREAKING HYPHEN}\N{HYPHEN}"
_MAY_GO = Expression(
    r"(^|[.!?;]\s*)(?:could|can|may|might) ((?:the|my|your|our|both|all)\b[^.!?;,:]*?)"
    r"(?: please)? (go|come|move|return|end up|wind up|live)\b"
)
"""A request in the words of a question."""
_SO_NOW = r"(?:not|still|already|left|in|on|out|lying|standing|sitting)\b"
_ALL_DONE = Expression(
    r"(?<=\w[.,;!? ])((?: |\b)(?:once|when|after|as soon as)) (?:everything|all)"
    r" (is|are|has been|have been) ((?:put |all )?(?:in|on|inside|into)\b)"
)
"""After what is asked for, "once everything is in" is about that."""
_BESIDE = (
    r"(?:next to|beside|near|behind|in front of|between|(?:to the )?(?:left|right) of|on|in)\b"
)
_LYING = r"(?:lying|sitting|standing|left)(?: (?:around|about|there|here|out))+"
_ABOUT = r"(?:still )?(?:left )?(?:lying|scattered|sitting) (?:around|about)(?! (?:the|my|your|of))"
_NO_MORE_SAID = (
    rf"(?: (?:yet|now|right now|at the moment))?(?=[.,;!?]| (?:and|then|please)\b| {WHERE}|$)"
)
_PIECES = r"(?:(?<!the )(?:piece|item|article)|pieces|items|articles) of"

_ARROW = r"(?:[-=]+>|\N{RIGHTWARDS ARROW})"
_STEP = (
    r"(?:put|place|take|move|pick up|grab|close|shut|open (?=the|my))\b"
    r"|(?!fully|completely|wide|all)\w+ (?:\w+ )?(?:open|closed|shut) ?(?:[-=]+>|[.,;\n]|$)"
)
_COMPARED = "|".join(word for word in SIZES if word.endswith("er"))


_NO_NOUN = (
    "in|into|on|onto|by|to|of|from|at|beside|behind|against|within|inside|over|under|near|for|with"
    r"|and|or|so|is|are|be|lets?|\w+ing"
)


_DID = Expression(
    rf"(?:\b(if you )({'|'.join(PAST)})\b"
    rf"|((?:,|\band|\bthen) )({'|'.join(PAST)})(?= (?:up|out|off|it|"
    r"them|him|her|the|this|that|these|those|my|your|our|a|an|both|all|every|everything|each)\b))"
)
_WISHED = Expression(r"\bwould (?:be|appreciate|like|love|prefer)\b[^.;:!?\n]*? if you [^.;:!?\n]*")


def _as_asked(wish: re.Match[str]) -> str:
    """What is wished for in the past tense ("it would be nice if you took it and closed …")."""
    asked = _DID.sub(lambda said: f"{said[1] or said[3]}{PAST[said[2] or said[4]]}", wish[0])
    return re.sub(r"\bif you (?!(?:would|could|can|will)\b)", "if you would ", asked)


_PARAPHRASES: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    # Behind what is asked for: "…, won't you?"
    (
        r", (?:(?:wo|would|could|ca|should|ought|must)n't|(?:would|could|should|ought|must) not"
        r"|will not|can not) (?:you|it|they|we|he|she)\b(?= ?[?.!]|$)",
        "",
    ),
    (
        rf"(^|[.;!] )(?:how|what) about (?={NAMED} (?:\w+ ){{0,2}}?\w+ (?:in|on|into|onto|inside|"
        rf"next to|beside|on top of|behind|in front of|between|near|to the (?:left|right) of) "
        rf"{NAMED})",
        r"\1put ",
    ),
    *CONTRACTIONS,
    *FORBIDDING,
    *END_STATES,
    *ROUNDABOUT,
    *ASKED_OTHERWISE,
    *OBSTACLES,
    *LISTINGS,
    *WHEREABOUTS,
    *PLACEMENTS,
    *GOING,
    *SAID_AGAIN,
    (_WISHED, _as_asked),
    (
        r"(?<! is)(?<! are)(?<! be),? (?:ok|okay|alright|all right|yeah|deal|understood"
        r"|(?:would|will|could|can) you(?: (?:please|love|dear|darling|mate))?)(?:\?|(?=[.!]*$))",
        ".",
    ),
    (
        r"\bi need (it|them|this|that) "
        r"(?=(?:in a|later|soon|tomorrow|tonight|again)\b"
        r"|for (?:(?:my|our|the|a) )?\w+(?:[.,;!]|$))",
        r"i will need \1 ",
    ),
    (
        rf"(?:^|(?<=[.;,] )|(?<=\bso ))({ASKED}leave (?:the|my) [^.,;]*?) in there"
        r"(?= (?:but|and)\b|,)",
        r"\1 alone",
    ),
    (rf"(^|[.,;:] |\b(?:and|then|please|you) )lower (?={NAMED}|(?:it|them)\b)", r"\1set "),
    (
        r"\b(set|put|place|lay) ([^.,;]*?) aside,? "
        r"(?=(?:(?:any|some)where )?(?:on|in|next to|beside|near|behind|to the) )",
        r"\1 \2 ",
    ),
    (r"^(please |(?:could|can) you )?(without \w+ing any other [^,.;]*), ([^.;]*)", r"\1\3 \2"),
    (r"^(?:hi|hello|hey)(?: there)?[!,.] ", ""),
    # A place behind what follows tells which that is: where it goes was said before
    (rf",? followed by (?={NAMED} (?:(?!and\b)\w+ )+{WHERE})", ", then likewise "),
    (
        rf"\b(?:keep|leave) ({NAMED} [^.,;]*?) stacked(?=[.,;]| and\b|$)(?! on)",
        r"leave \1 as they are",
    ),
    (
        rf"^({ASKED})(?:tidy|clean|declutter|neaten|organi[sz]e)(?: up)? (?:the|my) "
        rf"(?:{TABLE}|workspace|workplace|work area)(?: up)?(?:: | by (?=\w+ing ))",
        r"\1tidy up: ",
    ),
    # "By size on the tray"
    (
        r"\b((?:stack|pile)(?: up)? [^.,;:]*?) (by size|in order of size) (on(?:to)? [^.,;:]*)",
        r"\1 \3 \2",
    ),
    # "Take the blocks apart so that each block stands by itself"
    (
        r"(\b(\w{3,})s\b[^.;]*? (?:(?:so|such) that|until)) (?:each|every)(?: single)? \2 "
        r"(?=(?:stands|lies|sits|rests|is)\b)",
        r"\1 each one ",
    ),
    # "The box itself" is the box; "by itself" and "inside itself" are something else.
    (rf"\b({NAMED}(?: (?!(?:{_NO_NOUN})\b)\w+){{0,3}}) (?:itself|themselves)\b", r"\1"),
    (rf"\bbut none of (?={NAMED})", "but not "),
    (r"\bthe pair of them\b", "both of them"),
    (r"\b(?:trade|swap|switch|exchange) places between ", "swap "),
    (r",? (?:anywhere|wherever) (?:there is (?:room|space)|it fits)(?=[.;]|$)", ""),
    (
        rf"\bi (?:want|would like) ({NAMED} [^.,;]*?) to have nothing (?:in|on) it\b",
        r"\1 should be empty",
    ),
    (
        rf"\bmake ({NAMED} [^.,;]*?) (?:stand|sit|lie|rest) (?={_BESIDE}|to\b)",
        r"put \1 ",
    ),
    (
        rf"\b(the|that) ({'|'.join(NUMBERS)})[{HYPHENS} ](\w+)[{HYPHENS} ](stack|tower|pile)\b"
        r"(?! of\b)",
        r"\1 \4 of \2 \3s",
    ),
    (r"\bthe other way round\b", "the other way around"),
    (r"\bwhat (i|we) (?:am|are) after is\b", r"what \1 want is"),
    # What is so the other way around is so no more where it is as it is said
    (
        r",? (?:and |but )?(?:not|rather than|instead of)"
        r" (?:the other way around|vice versa|the reverse)(?=[.,;:!?]|$)",
        "",
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
    (rf"^({ASKED}(?:clean|tidy) up)[.!?] (?=\w)", r"\1: "),
    # To a thing, not to somebody
    (
        rf"\b(?:pass|hand) ({NAMED} [^.,;:]*?) (?:over|across|along) "
        rf"(?=to (?:the|my) )(?!to {PEOPLE}\b)",
        r"bring \1 ",
    ),
    (
        r"\bpass ((?:the|my) [^.,;]*?) (?:down |over |up )?"
        r"(?=(?:from (?:the|my) [^.,;]*? )?(?:onto|into) )",
        r"put \1 ",
    ),
    (r"\b(like|love|prefer) for (?=(?:the|my|both|all) )", r"\1 "),
    (
        r"\b(once|after|when) you (?:have|(?:have )?got) (it|them) out\b",
        r"\1 you have taken \2 out",
    ),
    (
        r"\b(?:leave|keep) (the [^.,;]*?) (closed|shut|open) "
        r"(?:afterwards|(?:at|in) the end|(?:when|once) you are (?:done|finished))\b",
        r"\1 should be \2 in the end",
    ),
    *CORNERS_AND_SIDES,
    (r"\b(?:everything|all) that is an? (?=\w)", "every "),
    (r"\bdown here (?=(?:on|in) (?:the|my)\b)", ""),
    (r"\b(come|go) (?:out|over|up) here (?=(?:on|in) (?:the|my)\b)", r"\1 "),
    (r"(?:,? |^)from now on\b,?", ""),
    (r"(?<=\w) at all(?=[.;,!?]|$)", ""),
    # Whose it is, before what is to be done with it
    (
        r"(?<!that )(?<!which )\b(?:is|are) (?:mine|ours|(?:my|our) favou?rites?) and "
        r"(?=(?:stays?|remains?|goes?|belongs?|must|should|has to|have to|is|are)\b)",
        "",
    ),
    (r"^no, (?!no\b|not\b|but\b)", ""),
    (
        r"(?:(?<=[.;,!] )|(?<=\bthen )|(?<=\band ))(?:then )?(in|on) (?:(it) goes|they go)"
        r"(?=[.,;!]|$)",
        lambda said: f"put {'it' if said[2] else 'them'} {said[1]}",
    ),
    (r"(?<=\w) by (?:tonight|noon|bedtime|dinnertime|lunchtime|tomorrow)(?=, )", ""),
    (
        rf"\b(open (?:the|my) [^.,;]*?), (?!(?:and|then|{'|'.join(VERB_WORDS)})\b)"
        r"([^.,;]*?) (in|inside)(?=,? (?:and )?(?:close|shut)\b)",
        r"\1, put \2 \3",
    ),
    (
        rf"\bthe ((?:{_COMPARED}) (?:{'|'.join(CATEGORIES)}))\b(?! (?:ones|things)\b)",
        r"the 1 \1",
    ),
    (r"(\b(?:no|nothing|neither) [^.;,]*?) any ?(?:more|longer)\b", r"\1"),
    (r"\band/or\b", "or"),
    (rf"\b(left|right|top|bottom|front|back|upper|lower)[{HYPHENS} ]most\b", r"\1most"),
    (rf"\b(left|right)(?:[{HYPHENS}]hand(?:ed)?\b| hand(?= corner\b))", r"\1"),
    (r"(?:\b(?:number|no\.|nr\.?)\s*|#)(?=\d)", ""),
    (rf"\bnumber ({'|'.join(NUMBERS)})\b", lambda said: str(NUMBERS[said[1]])),
    (r"\b(table|counter|work|desk) top\b(?! (?:drawer|shelf|board|level|rack))", r"\1top"),
    (
        r"\bnothing (?:but|except(?: for)?|other than|besides|(?:apart|aside) from"
        r"|with the exception of)\b(?=(?: \w+){1,5})",
        "only",
    ),
    (
        rf"[,.;]? \(?(?:(?:final|exact|target|its) )?(?:position|location|placement) ?: ?"
        rf"(?={_BESIDE})",
        ", ",
    ),
    (r"\bnothing (?:more|besides)\b", "nothing else"),
    # "Sort the two: one of them goes on the tray, the other in the box"
    (r"(?<=: )((?:put )?)one of (?:the two|them)(?= [^.;:]*\bthe other\b)", r"\1one"),
    (_MAY_GO, r"\1\2 should \3"),
    (
        r", (?:say|for example|e\.g\.),? (?=(?:to|in|on|into|onto|at|next|beside|near|behind)\b)",
        ", ",
    ),
    (r"(?<=\w),? (?:please|pls|plz)(?= ?:)", ""),
    (r"(?<=\w)(?<!\byou)(?<!\bi)(?<!\bwe) (?:please|pls|plz)(?=, |[.!;?]|$)", ""),
    (r"(?<! of )(?<!between )\bthe two of (?=(?:them|these|those)\b)", "both of "),
    (rf"\bwhichever (?!of\b)([\w ]+?) is (?={_SO_NOW}|(?:free|empty)\b)", r"whichever \1 that is "),
    (rf"\bwhichever ([\w ]+?) are (?={_SO_NOW})", r"all the \1 that are "),
    (
        rf"\b((?:that|which) (?:is|are)) inside(?= (?:and|then)\b| {WHERE}|[,.;!?]|$)",
        r"\1 in it",
    ),
    (r"\bback (?=(?:(?:in|on) )?there\b)", ""),
    (r"\bhidden (?=(?:in|inside|behind) )", ""),
    (r"\b(should|must|has to|have to) still (?=(?:be|stay|remain|stand|lie)\b)", r"\1 "),
    # What "should first be taken out", and put elsewhere then
    (
        r"^((?:the|my|our|both|all)\b[^.;!?,]*? (?:should|must|has to|have to|needs? to|"
        r"is to|are to)) first (?=be\b)",
        r"first, \1 ",
    ),
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
    (r"(?<=\w )up (?=with\b)", ""),
    (
        r"(^|[.;,] |\b(?:and|but) )only (?:then|afterwards?|thereafter|after (?:that|this)),? "
        r"(?=\w)(?!(?:should|may|can|could|must|shall|will|is|are|has|have|does|do)\b)",
        r"\1then ",
    ),
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
    # A chest's top is where things stand on it
    (r"\b(on|onto|to) the top surface of (?!(?:the|my) (?:desk|table)\b)", r"\1 the top of "),
    (
        r"\b(?:to|in|on|at) (?:a|some|the) (?:free )?(?:spot|place|position|location) "
        r"(?=(?:right |just |directly )?(?:between|next to|beside|near|behind|in front of|on|in"
        r"|close to|(?:to the )?(?:left|right) of)\b)",
        "",
    ),
    (r", (?:you choose|i do not (?:care|mind)|it does not matter) which(?: one)?(?=[,.;!?]|$)", ""),
    (rf"\bthe (?:piece|item) of (?=(?:{'|'.join(CATEGORIES)})\b)", "the 1 "),
    (r"\b(?:in|inside)(?: there)? (?=(?:next to|beside|alongside) )", ""),
    (r"\bback down (?=(?:on|onto)\b)", "down "),
    (rf"(\brather [^.;]*?) than (?:just )?{_LYING}(?=[.,;!?]|$)", r"\1"),
    # "Open the drawer, but not with the cup inside": it is not in there by then
    (
        r",? (?:but )?not with ((?:the|my|our) (?:\w+ ){0,2}?\w+) "
        r"(?:still |left )*(?:inside(?: it)?|in there|in it)(?=[.,;!?]|$)",
        r", but first make sure \1 is not in it",
    ),
    (
        r"(?<=\w)(?<!together)(?<!apart)(?<!separately), "
        r"(?=either (?:in|on|into|onto|inside|next to|beside|at) )",
        " ",
    ),
    # "…, and the right way up"
    (
        r"(?<=\w), and (?=(?:standing )?(?:upright|(?:the )?(?:right (?:way|side) up)"
        r"|lying (?:down|flat)|on (?:its|their) sides?)(?:[.,;!?]|$))",
        ", ",
    ),
    # By then it "is safely on the tray", or "has finally been put there".
    (
        r"(\b(?:once|when|after|before|until|as soon as) [^.,;]*? (?:is|are|has been|have been"
        r"|has|have)) (?:safely|finally|properly|securely|neatly|nicely|firmly|duly)"
        r" (?!(?:closed|shut|open|done|dry|cool)\b)",
        r"\1 ",
    ),
    # "In either bowl as long as it is empty": in one that is
    (
        r"\b((?:either|any|one)(?: of (?:the|my|those|these))?(?: \w+){0,2}? (\w+?)s?),? "
        r"(?:as|so) long as (?:(?:(?:the|that) \2|it|that one) is (?:still )?(?:empty|free)"
        r"|(?:there is )?nothing (?:else )?(?:is )?(?:already )?in (?:it|there)(?: yet| already)?)"
        r"(?=[.,;!?]|$)",
        r"\1 that is empty",
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
    (_ALL_DONE, r"\1 all of that \2 \3"),
    (r", (?:all|everything) (?:but|except(?: for)?) ", ", except "),
    (r"\b(it|them) out of there\b", r"\1 out"),
    (r"\b(out of|from|off) there\b", r"\1 it"),
    (
        r"\bstill (?=(?:needs?|has|have|ought) to "
        r"(?!stay\b|remain\b|be (?!\w+ed\b|put\b|shut\b|taken\b))|must go\b|should go\b)",
        "",
    ),
    (r"\b(is|are) (in|on|at) the wrong (?!(?:one|place|spot|side)\b)", r"\1 \2 the "),
    (
        r"(?:^|(?<=[.!?;]\s))(?:(?:(?:do|can) you )?see|(?:have you|has any(?:one|body)) seen) "
        r"(?=the |that |those )([^.!?;]*?)"
        r"(?: (?:(?:up|over|down|out) )?(?:there|here))?\?",
        r"look at \1,",
    ),
    (r"(?<!do )\bnot (?:just|only) (the [^.,;:!?]+?),? but (?:also )?(?=the )", r"both \1 and "),
    # "Do not just put the cup in the box; put the pen in as well" asks for both
    (
        r"(^|[.;!?] )(?:please )?do not (?:just|only|merely|simply) (?!leave\b|stand\b|sit\b)"
        r"([^.,;:!?]+?)[.,;:!]+ (?:but )?"
        r"(?=(?:please |also )*(?!(?:\w+ ){1,2}(?:it|them|that|those)\b)"
        r"(?:(?!\b(?:not|never)\b)[^.,;:!?])*?\b"
        r"(?:as well|too|also)\b)",
        r"\1\2; ",
    ),
    (r"\bonly (put|place|move|take|pick up) (?=the |a )", r"\1 just "),
    (r"(?<!not )\bonly (?=(?:lift|raise|grab|grasp|fetch|get|pick up|hold) )", "just "),
    # What alone is asked for; with how or until when, "only" is said of that.
    (
        rf"(^|[.;] )(please )?only (?=(?:open|close|shut) {NAMED}"
        r"(?: (?!(?:by|with|from|if|when|once|after|before|until|as|while|to|for|half|and|not)\b)"
        r"\w+){1,4}(?:[.;!]|$))",
        r"\1\2just ",
    ),
    (r",\s*(?:please\s*,|right (?=at\b))", ", "),
    (rf"\b({'|'.join(CATEGORIES)}) (?:items|things|products|articles)\b", r"\1"),
    # "A piece of fruit" is one, "the pieces of fruit" are all; "the piece" would be one of them.
    (rf"\b{_PIECES} (?=(?:{'|'.join(CATEGORIES)})\b)", ""),
    (rf"\b([a-z])[{HYPHENS}](?=[a-z]{{3}})", r"\1"),  # "t-shirt", "x-ray"
    (rf"(?:(?<=\w)[{HYPHENS}]|/)(?=\w)", " "),
    (r"&", " and "),
    # Steps ("open the drawer -> pen to drawer -> drawer closed"), else places ("pen -> drawer")
    (rf"\b(open|closed|shut) ?{_ARROW}", r"\1, then "),
    (rf" ?{_ARROW} ?(?={_STEP})", ", then "),
    (_ARROW, " to "),
    (r"\s*=\s*(?=\w)", ": "),
)


_EXPRESSIONS = tuple(
    (Expression(said) if isinstance(said, str) else said, plain) for said, plain in _PARAPHRASES
)


def in_plain_words(text: str) -> str:
    """Text in lower case with what may be said in several ways said in one."""
    for said, plain in _EXPRESSIONS:
        text = said.sub(plain, text)
    return text

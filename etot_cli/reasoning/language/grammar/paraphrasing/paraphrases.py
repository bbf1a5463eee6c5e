"""Ways of speaking, put into the plain ones that the grammar knows, in order."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.asides.going import GOING
from etot_cli.reasoning.language.grammar.asides.people import PEOPLE
from etot_cli.reasoning.language.grammar.paraphrasing.aims import AIMS
from etot_cli.reasoning.language.grammar.paraphrasing.asked_otherwise import ASKED_OTHERWISE
from etot_cli.reasoning.language.grammar.paraphrasing.contrasts import CONTRASTS
from etot_cli.reasoning.language.grammar.paraphrasing.corners import CORNERS_AND_SIDES, TABLE
from etot_cli.reasoning.language.grammar.paraphrasing.end_states import END_STATES
from etot_cli.reasoning.language.grammar.paraphrasing.forbidding import FORBIDDING
from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED, LISTINGS
from etot_cli.reasoning.language.grammar.paraphrasing.names_and_signs import NAMES_AND_SIGNS
from etot_cli.reasoning.language.grammar.paraphrasing.obstacles import OBSTACLES
from etot_cli.reasoning.language.grammar.paraphrasing.other_tongues import OTHER_TONGUES
from etot_cli.reasoning.language.grammar.paraphrasing.placements import PLACEMENTS
from etot_cli.reasoning.language.grammar.paraphrasing.roundabout import ROUNDABOUT
from etot_cli.reasoning.language.grammar.paraphrasing.said_again import SAID_AGAIN
from etot_cli.reasoning.language.grammar.paraphrasing.scene_setting import SCENE_SETTING
from etot_cli.reasoning.language.grammar.paraphrasing.told_by_others import TOLD_BY_OTHERS
from etot_cli.reasoning.language.grammar.paraphrasing.whereabouts import WHEREABOUTS
from etot_cli.reasoning.language.grammar.paraphrasing.you_do import YOU_DO
from etot_cli.reasoning.language.grammar.text.contractions import CONTRACTIONS
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import VERB_WORDS
from etot_cli.reasoning.language.words.small_words import NAMED, WHERE
from etot_cli.reasoning.language.words.verbs import DOING_OF, PAST

_MAY_GO = Expression(
    r"(^|[.!?;]\s*)(?:could|can|may|might) ((?:the|my|your|our|both|all)\b[^.!?;,:]*?)"
    r"(?: please)? (go|come|move|return|end up|wind up|live)\b"
)
"""A request in the words of a question."""
_MINDED = Expression(
    r"\b(?:would|do) you mind (?:terribly |awfully )?(\w+ing) "
    r"(?![^.;!?]*(?:,|\b(?:and|then)) \w+ing\b)"
)
"""One thing that somebody would not mind doing is what he is asked to do."""
_ALL_DONE = Expression(
    r"(?<=\w[.,;!? ])((?: |\b)(?:once|when|after|as soon as)) (?:everything|all)"
    r" (is|are|has been|have been) ((?:put |all )?(?:in|on|inside|into)\b)"
)
"""After what is asked for, "once everything is in" is about that."""
_BESIDE = (
    r"(?:next to|beside|near|behind|in front of|between|(?:to the )?(?:left|right) of|on|in)\b"
)


_NO_NOUN = (
    "in|into|on|onto|by|to|of|from|at|beside|behind|against|within|inside|over|under|near|for|with"
    r"|and|or|so|is|are|be|lets?|\w+ing"
)


_DID = Expression(
    rf"(?:\b(if you )({'|'.join(PAST)})\b"
    rf"|((?:,|\band|\bthen) )({'|'.join(PAST)})(?= (?:up|out|off|it|"
    r"them|him|her|the|this|that|these|those|my|your|our|a|an|both|all|every|everything|each)\b))"
)
_WISHED = Expression(
    r"\bwould (?:be|appreciate|help|like|love|prefer)\b[^.;:!?\n]*? if you [^.;:!?\n]*"
)


def _as_asked(wish: re.Match[str]) -> str:
    """What is wished for in the past tense ("it would be nice if you took it and closed …")."""
    asked = _DID.sub(lambda said: f"{said[1] or said[3]}{PAST[said[2] or said[4]]}", wish[0])
    return re.sub(r"\bif you (?!(?:would|could|can|will)\b)", "if you would ", asked)


_PARAPHRASES: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    *SCENE_SETTING,
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
    (_MINDED, lambda said: f"could you {DOING_OF[said[1]]} " if said[1] in DOING_OF else said[0]),
    *OTHER_TONGUES,
    *YOU_DO,
    *AIMS,
    *FORBIDDING,
    *CONTRASTS,
    *END_STATES,
    *ROUNDABOUT,
    *ASKED_OTHERWISE,
    *OBSTACLES,
    *LISTINGS,
    *WHEREABOUTS,
    *PLACEMENTS,
    *GOING,
    *SAID_AGAIN,
    *TOLD_BY_OTHERS,
    (_WISHED, _as_asked),
    (
        r"(?<! is)(?<! are)(?<! be),? (?:ok|okay|alright|all right|yeah|deal|understood"
        r"|(?:would|will|could|can) you(?: (?:please|love|dear|darling|mate))?|pretty please)"
        r"(?:\?|(?=[.!]*$))",
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
    (
        r"^(?:(?:(?:oh )?(?:hi|hello|hey)|(?:good )?(?:morning|afternoon|evening|day))"
        r"(?: (?:there|again|all|everybody|everyone))?[!,.] )+",
        "",
    ),
    (r"\bend up (?:sitting|resting) (?=(?:on|in|at|next|beside|behind|to|between) )", "end up "),
    (
        rf"\b((?:done|finished|through) with {NAMED} (?:(?!for\b)\w+ )*\w+) "
        r"for (?:today|tonight|now|the (?:day|moment))(?=[.,;!])",
        r"\1",
    ),
    (r"\b((?:can|could|would|will) you (?:please )?)at least (?!\w+ing\b)", r"\1"),
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
    (r"\bthe other way round\b", "the other way around"),
    (r"\bwhat (i|we) (?:(?:am|are) after|do (?:want|need)) is\b", r"what \1 want is"),
    # What is so the other way around is so no more where it is as it is said
    (
        r",? (?:and |but )?(?:not|rather than|instead of)"
        r" (?:the other way around|vice versa|the reverse)(?=[.,;:!?]|$)",
        "",
    ),
    (
        rf"^({ASKED}(?:clean|tidy) up)(?: for (?:me|us)| here| a (?:bit|little)|,? please)*"
        r"[.!?:] (?=\w)",
        r"\1: ",
    ),
    (
        r"^(?:could|can|would|will) you (?:please )?do (?:me|us) (?:a|one) (?:small |little )?"
        r"favou?r(?:,? please)?[?!.:,] ?",
        "",
    ),
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
    *CORNERS_AND_SIDES,
    (r"\b(?:everything|all) that is an? (?=\w)", "every "),
    (r"(?:,? |^)from now on\b,?", ""),
    (r"(?<=\w) at all(?=[.;,!?]|$)", ""),
    # Whose it is, before what is to be done with it
    (
        r"(?<!that )(?<!which )\b(?:is|are) (?:mine|ours|(?:my|our) favou?rites?) and "
        r"(?=(?:stays?|remains?|go(?:es)?|belongs?|must|should|has to|have to|is|are)\b)",
        "",
    ),
    # "The rose is for my sister and stays where it is"
    (
        rf"(?<!that )(?<!which )\b(is|are) for ({PEOPLE}) and "
        r"(?=(?:stays?|remains?|go(?:es)?|belongs?)\b)",
        lambda said: f"{said[1]} for {said[2]}, so {'it' if said[1] == 'is' else 'they'} ",
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
    (r"(\b(?:no|nothing|neither) [^.;,]*?) any ?(?:more|longer)\b", r"\1"),
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
    (r"(?<=\w),? (?:please|pleas|pls|plz)(?= ?:)", ""),
    (r"(?<=\w)(?<!\byou)(?<!\bi)(?<!\bwe) (?:please|pleas|pls|plz)(?=, |[.!;?]|$)", ""),
    (r"(?<! of )(?<!between )\bthe two of (?=(?:them|these|those)\b)", "both of "),
    # What "should first be taken out", and put elsewhere then
    (
        r"^((?:the|my|our|both|all)\b[^.;!?,]*? (?:should|must|has to|have to|needs? to|"
        r"is to|are to)) first (?=be\b)",
        r"first, \1 ",
    ),
    # "Only when it is open may the pen go in it" gives leave, and asks for nothing before
    (
        r"\bonly (?:when|while|if) ([^.,;!?]*?\b(?:is|are) [^.,;!?]*?),? (may|can|could) "
        rf"(you|it|they|{NAMED}(?: \w+){{1,3}}?) (?=(?:go|be|put|stand|lie|open|close)\b)",
        r"only if \1, \3 \2 ",
    ),
    (
        r"\b(may) (only )?([^.,;!?]*?) (?(2)|only )(?:when|while) "
        rf"(?=(?:it|they|{NAMED}(?: \w+){{1,3}}?) (?:is|are)\b)",
        r"\1 \3 only if ",
    ),
    (
        r"(^|[.;,] |\b(?:and|but) )only (?:then|afterwards?|thereafter|after (?:that|this)),? "
        r"(?=\w)(?!(?:should|may|can|could|must|shall|will|is|are|has|have|does|do)\b)",
        r"\1then ",
    ),
    # A chest's top is where things stand on it
    (r"\b(on|onto|to) the top surface of (?!(?:the|my) (?:desk|table)\b)", r"\1 the top of "),
    (
        r"\b(?:to|in|on|at) (?:a|some|the) (?:free )?(?:spot|place|position|location) "
        r"(?=(?:right |just |directly )?(?:between|next to|beside|near|behind|in front of|on|in"
        r"|close to|(?:to the )?(?:left|right) of)\b)",
        "",
    ),
    (r", (?:you choose|i do not (?:care|mind)|it does not matter) which(?: one)?(?=[,.;!?]|$)", ""),
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
        r"(?:(?:as|so) long as|provided that) "
        r"(?:(?:(?:the|that) \2|it|that one) is (?:still )?(?:empty|free)"
        r"|(?:there is )?nothing (?:else )?(?:is )?(?:already )?in (?:it|there)(?: yet| already)?)"
        r"(?=[.,;!?]|$)",
        r"\1 that is empty",
    ),
    (_ALL_DONE, r"\1 all of that \2 \3"),
    (r", (?:all|everything) (?:but|except(?: for)?) ", ", except "),
    (
        r"(?:^|(?<=[.!?;]\s))(?:(?:(?:do|can) you )?see|(?:have you|has any(?:one|body)) seen) "
        r"(?=the |that |those )([^.!?;]*?)"
        r"(?: (?:(?:up|over|down|out) )?(?:there|here))?\?",
        r"look at \1,",
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
    *NAMES_AND_SIGNS,
)


_EXPRESSIONS = tuple(
    (Expression(said) if isinstance(said, str) else said, plain) for said, plain in _PARAPHRASES
)


def in_plain_words(text: str) -> str:
    """Text in lower case with what may be said in several ways said in one."""
    for said, plain in _EXPRESSIONS:
        text = said.sub(plain, text)
    return text

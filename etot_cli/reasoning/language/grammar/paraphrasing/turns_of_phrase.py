"""Ways of speaking that say no more than plain ones, and what may stay as it is."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.asides.people import PEOPLE
from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED
from etot_cli.reasoning.language.words.small_words import NAMED, WHERE
from etot_cli.world.colors import BASIC_COLORS

_COLOR = "|".join(BASIC_COLORS)
_PREPOSITIONS = "on|in|into|onto|to|next|beside|behind|from|at|near|under|between|with|inside|out"
_COLORS = rf"(?:{_COLOR})(?:(?:,| or| and) (?:{_COLOR}))*"
_NO_NOUN = rf"(?! (?!(?:{_PREPOSITIONS}|and|or|goes|go|belongs?|should|must|is|are)\b)\w)"
"""What a colour is said of has been named before."""
_END = r"(?=[.,;!?]|$)"
_FINE = r"(?:fine|acceptable|ok|okay|all right|alright|no problem)"
_KEPT = r"(?:(?:can |to )?(?:stays?|remains?|is|are|be)(?: (?:left|kept))?)"
_LEFT = r"(?:hanging|standing|sitting|left|still|just)"
_WELL = r"(?:warm|cold|cool|dry|fresh|clean|safe|crisp|hot)"
_HARM = r"(?:the )?(?!(?:the|falling|it|them|being)\b)\w+(?: (?:and|or) \w+)?"
_FROM = rf"(?: from {_HARM})?"
_AFTERWARDS = (
    r"(?:afterwards|after that|(?:at|in) the end|(?:when|once|after) you are (?:done|finished)"
    r"|(?:when|once) you have finished)"
)
_ASKED_FOR = r"([^.;!?]+?)(?=, (?:and )?then\b|[.;!?]|$)"
_NOW = "currently|at present|at the moment|presently|right now|now|still"
_FOUND_THERE = r"(?=(?:between|in|inside|on|behind|beside|under|next to|near)\b)"
_YOU_FIND = r"you (?:will |can |should |may )?(?:find|see)"
_POSED = r"(?:still )?(?:lying|standing|sitting)"
_TAKE = r"grasp|grab|grip|grab hold of|take|take hold of|seize|pick up|pick|lift up|lift|get|fetch"
_LIFT_OR_PUT = r"lift|raise|hold|pick|put|place|set|move|bring|carry|drop|stow|insert|transfer"
_IS_SO = r"(?:(?:wide )?open|closed|shut|empty|ajar)"
_CONDITION = "(?:conditions?|states?|positions?|configurations?)"
_CASE = r"(?:in (?:the )?(?:case|event)|(?:on|under) (?:the )?condition)"
_STAYS = {"it": "it stays", "them": "they stay"}

TURNS_OF_PHRASE: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (r"\bso long as\b", "as long as"),
    (r"\bthereafter\b", "afterwards"),
    (r"\btherein\b", "in it"),
    (
        r"\b(?:(?:upon|on|after|at the end of) (?:the )?(?:completion|execution)"
        r"(?: of (?:this|the) (?:task|job|work|step|plan))?|after (?:the|this) (?:task|run|job))"
        r"(?=[.,;!]|$| (?:close|shut|open|put|the|all|both|every|no|nothing|only)\b)",
        "in the end",
    ),
    # "The operator takes the pen and lays it on the box"
    (
        r"^the (?:operator|technician|assistant|manipulator|agent|system|worker) "
        r"(?=(?:then )?(?:takes|picks|puts|places|opens|closes|shuts|grasps|grabs|moves|removes"
        r"|lifts|sets|lays|transfers|inserts|stacks)\b(?!.*\b(?:so|because|when|if|who|daily|every)\b))",
        "the robot ",
    ),
    # "Somebody left the cup on the tray again, so …": what happened before, nobody does again
    (
        rf"(^|[.;!?,] |\band )(?:({PEOPLE}) (?:(?:has|have) )?)?left ({NAMED} (?:\w+ ){{1,3}}?"
        rf"(?:in|on) {NAMED} (?:\w+ )??\w+) (?:once )?again(?=,? so\b)",
        lambda said: f"{said[1]}{said[2] or 'somebody'} left {said[3]}",
    ),
    # "That row of candles looks crooked" is said of the candles
    (
        r"(^|[.;!?] )(?:the|that|this|my|our) (?:row|line|bunch|lot|set|collection) of (\w+s) "
        r"(look|seem|feel)s ",
        r"\1the \2 \3 ",
    ),
    # "In case that it is open", "if, and only if, it is open"; "that box" may be told by "that"
    (rf"\b{_CASE} that (?={NAMED}|(?:it|they|there|no|one|neither|nothing|any\w*)\b)", "if "),
    (rf"\b{_CASE} (?=that \w)", "if "),
    (r"\b(?:supposing(?: that)?|if,? and only if\b,?|if it is (?:so|true|the case) that) ", "if "),
    (
        rf"\bin (?:the )?(?:case|event) of ({NAMED} (?:\w+ ){{1,3}}?)(not )?being (not )?",
        r"if \1is \2\3",
    ),
    # "If the box would be open, …", "if box open, …", as in other tongues
    (rf"(^|[.;!] )if ([^.,;:]*?) would be (?=(?:\w+ )?{_IS_SO},)", r"\1if \2 is "),
    (
        r"(^|[.;!] |\b(?:and|but) )if ((?:the )?(?!(?:the|it|they|that|there|not|already|still|is"
        r"|possible|needed|necessary|you|i)\b)\w+(?: (?!(?:is|are|not|was|were)\b)\w+)?) "
        rf"(?={_IS_SO}(?:,| then\b))",
        r"\1if \2 is ",
    ),
    (
        rf"(\b(?:any|an?|some|one|either|whichever)\b[^.;!?]*)?"
        rf"(?<!all right )(?<!fine )\bas long as "
        rf"(?=(?:it|{NAMED} (?:\w+ ){{0,2}}?\w+) (?:is|are) (?:already |still |not )?"
        rf"{_IS_SO}{_END}(?!, (?:please )?(?:(?:leave|keep|hold) "
        r"(?!it (?:so|as it is|like|alone)\b)|wait\b|do not\b)))",
        lambda said: said[0] if said[1] else "provided that ",  # else it tells which of them
    ),
    # "The block of red colour", "the red colour block", "in red colour"
    (
        rf"\b(?:which|that) (is|are)( not)? (?:of|in) (?:a |the )?(?:colou?r )?({_COLORS})"
        rf"(?: colou?rs?)?{_NO_NOUN}",
        r"that \1\2 \3",
    ),
    (
        rf"\b(?:of|in|with) (?:an? |the )?(?:colou?r (?P<behind>{_COLORS})"
        rf"|(?P<before>{_COLORS}) colou?rs?){_NO_NOUN}",
        lambda said: f"that is {said['behind'] or said['before']}",
    ),
    (rf"\b({_COLOR}) colou?r (?=(?!and\b|or\b)\w)", r"\1 "),
    # "Keep the drawer in closed position", "bring it into an open position"
    (
        rf"\b(?:bring|get|move|set|put|return) ({NAMED} (?:\w+ ){{1,3}}?)"
        rf"(?:back )?(?:in|into|to) (?:an? |the |its )?(?:fully |completely )?({_IS_SO})"
        rf" {_CONDITION}\b",
        r"make sure that \1is \2",
    ),
    (
        rf"(?<!state )(?<!position )\b(?:in|into|to) (?:an? |the |its |their )?"
        rf"(?:fully |completely )?({_IS_SO}) {_CONDITION}\b",
        r"\1",
    ),
    # "Grasp and lift the cup", "take and put the cup on the tray": the second verb says it all
    (
        rf"\b(?:{_TAKE}) and (?:then )?(?=(?:{_LIFT_OR_PUT}) (?:up )?{NAMED})",
        "",
    ),
    (
        r"\b(i|we) (need|want|would like) (?:easy |free |quick )?access to "
        rf"(?:the (?:inside|interior) of )?(?={NAMED})",
        r"\1 \2 to get into ",
    ),
    (
        rf"\b((?:close|shut) {NAMED} \w+(?: \w+)??) after (it|them){_END}",
        r"\1 behind \2",
    ),
    (rf"(?<=[.;,] )th(?:at|is) one (?=is (?:far |much |way )?too \w+{_END})", "it "),
    (r"\b(?:gripped|grasped|held) (?:by |in )?(?=(?:whichever|whatever|any) way\b)", "in "),
    (
        r"\bha(s|ve) no business (?:(?:being|lying|standing|sitting|about|around) )*"
        r"(?=(?:in|on|inside)\b)",
        lambda said: f"{'does' if said[1] == 's' else 'do'} not belong ",
    ),
    # What several things are to be, one of them standing
    (
        r"\b((?:want|would like|like to see|want to see|make sure|make sure that) "
        r"[^.;!?]*?\b(?:in|on|inside|open|closed|shut)\b[^.;!?,]*?),? and "
        rf"({NAMED} (?:\w+ )??\w+|both (?:the |my )?\w+)"
        r"(?<! tower)(?<! stack)(?<! pile) (?:still )?"
        rf"(?:standing(?: up| upright)?|upright){_END}",
        r"\1, and \2 should be upright",
    ),
    # What somebody "forgot to do", or "did not do", and is asked for next
    (
        rf"(^|[.;!] )(?!nobody\b|no one\b){PEOPLE} (?:did not|(?:has |have )?(?:just )?"
        r"(?:forgot|forgotten) to) "
        rf"((?:open|close|shut|put|place|take|move|bring) [^.;,!?]*?)[.;,!]"
        r" (?:so )?(?:please |kindly |(?:would|do) you mind |(?:could|can|would|will) you "
        r"(?:please )?)*(?:see(?:ing)? to|tak(?:e|ing) care of|deal(?:ing)? with|do(?:ing)?"
        rf"|fix(?:ing)?|sort(?:ing)? out) (?:it|that|this)(?: for (?:me|us|them|him|her))?{_END}",
        r"\1\2",
    ),
    # Who finds it fine if it stays open need not have it so
    (
        rf"\bit (?:is|would be|will be) {_FINE}(?: (?:by|with|for) (?:me|us))? "
        rf"(?:if|for|when) ({NAMED} (?:\w+ )*?\w+|it|they|them) {_KEPT} "
        rf"(?=(?:open|closed|shut)(?: (?:afterwards|after that|in the end))?{_END})",
        r"\1 may stay ",
    ),
    (r"(?<=\w)(?<!\byou)(?<!\bi)(?<!\bwe),? (?:please|pleas|pls|plz)(?= (?:and|then|but)\b)", ""),
    # "There is a drawer hanging open", "shut the drawer that was left open"
    (
        r"(^|[.;!,] )there (is|are) ((?:an?|one|two|some|the) \w+(?: \w+)??) "
        rf"(?:(?:that|which) (?:is|are) )?(?:{_LEFT} )?"
        r"(?=(?:wide )?(?:open|ajar)(?:,|[.;!] | and\b))",
        r"\1there \2 \3 that \2 ",
    ),
    (
        rf"\b((?:close|shut) {NAMED} \w+(?: \w+)??) "
        rf"(?:(?:that|which) (?:is|are|was|were|has been) )?{_LEFT} "
        rf"(?=(?:wide )?(?:open|ajar)(?: and\b|{_END}))",
        r"\1 that is ",
    ),
    # Where it goes, said of what was named before
    (
        rf"(^|[.;!] )((?:now|next|then|and) )*({NAMED} (?:\w+ )*?\w+), "
        rf"(?=(?:into|onto|in|on) {NAMED} (?:\w+ )*?with (?:it|them){_END})",
        r"\1\2\3: ",
    ),
    # Which of the places that were named is none of theirs
    (
        r", (?:and )?(?:neither|none|not one) of them (in|into|on|onto) "
        rf"(?=(?:the|that) \w+ one{_END})",
        r", but not \1 ",
    ),
    # Who opens something again to see that what was put in is there asks for no more than that
    (
        rf"\b(open (?:it|{NAMED} \w+(?: \w+)??)(?: (?:up|again))*),? (?:in order )?to "
        r"(?:verify|check|confirm|see|show|make sure) (?:that|if|whether) (?:it|they) "
        rf"(?:is|are) (?:really |still )?(?:in there|there|inside|in it){_END}",
        r"\1",
    ),
    (rf"\btake (it|them) (?=there{_END}|there (?:and|then)\b)", r"bring \1 "),
    (
        rf"\bha(?:s its|ve its|ve their) (?:home|place|spot)s? (?=(?:in|on|inside) {NAMED})",
        "belong ",
    ),
    # What "comes off first" and goes somewhere
    (
        rf"\b((?:but|and|then) )?({NAMED} (?:\w+ )?\w+) "
        r"(?:comes|goes|gets taken|is taken) off first"
        r"(?: and|, and| and then|, then) (?=(?:goes|is put) )",
        r"\1first \2 ",
    ),
    (rf"(^|[.;!,] )only (?={NAMED} (?:\w+ )*?\w+ (?:has|needs?) to go away: )", r"\1just "),
    (
        rf"\b({NAMED} (?:\w+ )*?\w+) (?:has|have|needs?|must|should|is|are) (?:to )?"
        rf"(?:go|be put|be tidied|be cleared) away: "
        rf"(?=(?:(?:in|into|on|onto) )?{NAMED}|\w+ (?:drawer|shelf|board)\b)",
        r"\1: ",
    ),
    # Of the two that were named it is said which is to be on which
    (
        r"(\bthere (?:is|are) an? [^.;,]*? on (?:top of )?an? [^.;,]*[.;,] )((?:so )?(?:please )*)"
        r"(?:turn|swap|switch|reverse|flip|change) (?:the|their|this) (?:order|stack) "
        r"(?:around |round |over )?(?=so (?:that )?)so (?:that )?",
        r"\1\2make sure that ",
    ),
    (
        rf"\b((?:tidy|clear|put|store|stow|pack) away {NAMED} [^.,:;]*), "
        rf"(?=(?:in|into) {NAMED} \w+(?: (?!or\b)\w+)?(?: or {NAMED} \w+(?: \w+)?)?"
        rf"(?:{_END}(?!,)|,? and (?:then )?(?:close|shut)\b"
        r"|, (?:i do not (?:mind|care)|no matter|it does not matter|whichever)\b))",
        r"\1 ",
    ),
    (
        rf"(^|[.;!] )({ASKED})(?:sort|tidy up|tidy|put away) (?:these|this|the following)"
        rf"(?: away| up)?: (?=[^.:;]* (?:to|in|into|on|onto) {NAMED})",
        r"\1\2",
    ),
    # Where somebody will eat it from, and "there" behind that
    (
        rf"\b((?:i|we) (?:want|would like|need) to (?:eat|drink|serve|cut) {NAMED} (?:\w+ )??\w+) "
        rf"(?:from|off|on|in|out of) ({NAMED} (?:\w+ )??\w+),? so ({ASKED})"
        rf"(?:put|lay|place|set|bring) (it|them) there{_END}",
        r"\1, so \3bring \4 to \2",
    ),
    # "So in the tin it goes"
    (
        rf"(^|[.;!,] |\bso )((?:in|into|on|onto) {NAMED} (?:(?!that\b|which\b|and\b)\w+ ){{1,3}})"
        rf"(it goes|they go|{NAMED} (?:\w+ )??\w+ goe?s?){_END}",
        lambda said: f"{said[1]}{said[3]} {said[2].strip()}",
    ),
    # A reason between two requests
    (
        rf"(,? so (?:that )?(?:it|they) (?:stays?|keeps?|remains?) {_WELL})(?= and (?:then )?\w+)",
        r"\1,",
    ),
    # A reason ahead of a request, or behind it
    (
        rf"\bto (?:protect|shield|guard|save) (it|them|{NAMED} (?:\w+ )??\w+) (?:against|from) "
        rf"(?={_HARM}(?:[.,;!?]|$))",
        r"to keep \1 safe from ",
    ),
    (
        rf"(\b(?:{_PREPOSITIONS}|open|close|shut) {NAMED} (?:\w+ )??"
        rf"(?!(?:is|are|has|needs?|have)\b)\w+),? to keep (it|them) ({_WELL}{_FROM}){_END}",
        lambda said: f"{said[1]}, so that {_STAYS[said[2]]} {said[3]}",
    ),
    (
        rf"(^|[.;!] )(?:in order |so as )?to keep (it|them) ({_WELL}{_FROM}), {_ASKED_FOR}",
        lambda said: f"{said[1]}{said[4]}, so that {_STAYS[said[2]]} {said[3]}",
    ),
    (
        rf"(^|[.;!] )(?:in order |so as )?to keep ({NAMED} (?:\w+ )??\w+?(s?)) ({_WELL}{_FROM}), "
        rf"((?:please )?(?:put|place|store|move|set|leave) )?(it|them) {_ASKED_FOR}",
        lambda said: (
            f"{said[1]}{said[5] or ''}{said[2]} {said[7]}, so that {_STAYS[said[6]]} {said[4]}"
            if bool(said[3]) == (said[6] == "them")
            else said[0]
        ),
    ),
    # Ways of taking hold of a thing, and places, of which any will do
    (
        r"[,;.:] an? (\w+) (grasp|grip) (?:and|or) an? (\w+) \2 "
        rf"(?:is|are|would be) (?:both |equally )?{_FINE}{_END}",
        r" with a \1 \2 or a \3 \2",
    ),
    # What is to be in what "has" it, and by when; all that is so is so in the end
    (
        rf"( in it,? (?:and )?with (?:its|the) door (?:closed|shut)) {_AFTERWARDS}{_END}",
        r"\1",
    ),
    # What goes somewhere first and what goes on top of that
    (
        r"(^|[.;!] )((?:(?!and\b|then\b|not\b|but\b)\w+ ){1,5}?goes (?:in|into|on|onto) "
        rf"{NAMED} \w+(?: \w+)?) first,?"
        rf" (?:and|then|and then) (?={NAMED} [^.,;:]* on top of (?:that|it){_END})",
        r"\1first \2, then ",
    ),
    # What is not somewhere yet and is to go there
    (
        rf"(^|[.;!,] )((?:then )?{ASKED})(?:whatever|whichever) (\w+) (?:is|are) not"
        rf"(?: already| yet)? ((?:in|on) {NAMED} \w+(?: (?!already\b|yet\b)\w+)?)"
        r"(?: already| yet)?, "
        rf"{ASKED}(put|place|bring|move) (?:it|them) there{_END}",
        r"\1\2\5 all the \3 that is not \4 \4",
    ),
    (
        r"\b(the (?:end|final|target|goal) (?:state|situation|arrangement)) (?:that )?"
        r"(?:i|we) (?:want|need|would like)(?= is\b|:)",
        r"\1",
    ),
    (r"\bone of the others(?! \w)", "one of the other ones"),
    # What is not somewhere yet and is to go there, told by one verb
    (
        rf"\b((?:that|which) (?:is|are) not (?:yet |already )?)((?:in|on) {NAMED} \w+(?: \w+)?)"
        r"(?: yet| already)? ((?:now |still )?(?:should|must|shall|needs? to|has to|have to|is to"
        r"|are to|goes|go|belongs?|can)\b(?: (?:be|go|put|placed|moved|brought|too|also))*) there"
        rf"{_END}",
        r"\1\2 \3 \2",
    ),
    (r"\b(?:(?:may|can|could|must|would) i|i (?:would |must )?) ?ask that\b", "make sure that"),
    # How a thing is by now
    (
        rf"\b(that|which) (?:{_NOW}) (?=(?:is|are|stands?|lies?|sits?|rests?) (?:{WHERE}|there\b))",
        r"\1 ",
    ),
    (
        rf"\b((?:that|which) (?:is|are) {_IS_SO}) (?:already|still|currently|now|right now|anyway"
        rf"|at the moment|at present|just now)(?=[.,;!?]|$| (?:and|then)\b)",
        r"\1",
    ),
    # "The knob (which) you will find in the tin"
    (
        r"\b(that|which|whatever) "
        rf"(?:(?:{_YOU_FIND}|(?:can|may) be found)(?: {_POSED})?|is {_POSED}) {_FOUND_THERE}",
        r"\1 is ",
    ),
    (
        rf"\b({NAMED} (?:\w+ )??(?!that\b|which\b)\w+|everything|anything) "
        rf"{_YOU_FIND} (?:{_POSED} )?{_FOUND_THERE}",
        r"\1 that is ",
    ),
    # What was opened is closed
    (
        rf"(^|[.;!,] |\b(?:and|then) )((?:then )?{ASKED})(?:close|shut) up "
        rf"(?=(?:again|after|afterwards|when|once|in the end)\b|{_END})",
        r"\1\2close it ",
    ),
    (rf"(^|[.;!,] |\b(?:and|then) )((?:then )?{ASKED})close up" + _END, r"\1\2close it"),
    # Nothing else is to be done; "only want the cup on the tray" may be: nothing else there
    (
        rf"\b(i|we) only (want|need) (?=you to\b|{NAMED} (?:\w+ )?\w+ (?:closed|shut|open)\b)",
        r"\1 \2 ",
    ),
    (rf"\b(before|after) (closing|shutting|opening)(?: up)?{_END}", r"\1 \2 it"),
    # "Then take the pen back out", "then back where it was", for how long there tells what is next
    (
        rf"\b((?:take|get|lift|bring|pull) (?:it|them|{NAMED}(?: \w+){{1,3}}?)) "
        r"(?<!\bthe )(?<!\bat )back (?=(?:out|off)\b)",
        r"\1 ",
    ),
    (
        r"(, (?:and )?then|\band then) back (?=(?:to )?where (?:(it)|they) (?:was|were)\b"
        r"|to (?:(its)|their) (?:place|spot)\b)",
        lambda said: f"{said[1]} put {'it' if said[2] or said[3] else 'them'} back ",
    ),
    (
        r" for (?:just )?(?:a|one) (?:moment|second)"
        r"(?=,? (?:and )?then (?:return|put|take|bring|move) (?:it|them)\b)",
        "",
    ),
    (r"\b(what|whatever) is in there (?=(?:can|may|should|must) (?:go|be)\b)", r"\1 is in it "),
    (
        r"\b(open(?:ing)? any) more (?=(?!and\b|or\b|then\b|than\b|if\b|before\b|after\b)\w+)",
        r"\1 other ",
    ),
    # "One cup, whichever, goes on the tray": any will do, as "one" says
    (
        r"\b(one (?:\w+ )??\w+), (?:whichever(?: (?:one )?you (?:like|want|prefer))?|any(?: one)?),"
        r"(?= (?:goes|belongs|should|must|has to|is to)\b)",
        r"\1",
    ),
    # Which of several things comes first, in a sentence of its own
    (rf"[.;] (?:and )?{ASKED}(?:start|begin) with (the (?:\w+ )?\w+){_END}", r", \1 first"),
    # What is said of two places goes for both ways
    (
        rf"\b(everything (in|on) ({NAMED}(?: \w+){{1,3}}?)) (belongs|goes|should go|must go) "
        rf"(in|into|on|onto) ({NAMED}(?: \w+){{1,3}}?),? and (?:vice versa|the other way "
        rf"(?:a?round)){_END}",
        lambda said: (
            f"{said[1]} {said[4]} {said[5]} {said[6]} and everything {said[5].removesuffix('to')} "
            f"{said[6]} {said[2]} {said[3]}"
        ),
    ),
)
"""In order."""

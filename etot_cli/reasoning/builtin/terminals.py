"""Terminals of the controlled English: its verbs, prepositions, determiners and other small words.

Regular expressions on normalized text (lower case, single spaces); longer forms stand first.
"""

from __future__ import annotations

from etot_cli.reasoning.builtin.lexicon import NUMBERS


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


_COUNT = "|".join(NUMBERS) + r"|\d{1,2}"
_THE = "the|these|those|my|your|its|their"
_PLACE = "left|right|front|back|rear|middle|cent(?:er|re)"
_POSTURE = "standing|lying|sitting|placed|located|resting|kept|situated|positioned"

TERMINALS: dict[str, str] = {
    "LEAD": r"(?:please|kindly|now|first(?:ly)?|second(?:ly)?|next|then|finally|lastly|afterwards|"
    r"after that|also|and|so|robot|(?:can|could|would|will) you|you (?:should|must|have to|need to)"
    r"|(?:the|your) (?:task|goal|job) is to|i (?:want|need|would like) you to|let us|try to|"
    r"the robot (?:should|must|has to)|(?:make|be) sure to|remember to|(?:do not|don t) forget to|"
    r"go(?: and)?),?",
    "JOINT": r"(?:,\s*)?(?:and|but|then|before|after which|after that|afterwards|to|in order to|"
    r"so as to|by)(?:,?\s+(?:then|also|afterwards|finally|lastly|next|after that))*,?|,",
    "SO_THAT": r"(?:,\s*)?(?:so that|such that|so|until|in such a way that)",
    "SO_THAT_POSE": r"(?:so (?:that )?it (?:fits|stands)(?: upright)?|standing(?: upright| up)?|"
    r"upright)",
    "AFTER": r"(?:,\s*)?(?:once|after|when)(?: you have| having)?",
    "BEFORE": r"before",
    "PICK": r"(?:pick(?:ing)? ?up|pick(?:ing)?|grab(?:bing)?|tak(?:e|ing)(?: hold of)?|"
    r"lift(?:ing)?(?: up)?|fetch(?:ing)?|get(?:ting)?(?: hold of)?|grasp(?:ing)?|grip(?:ping)?|"
    r"hold(?:ing)?(?: up)?|seiz(?:e|ing)|collect(?:ing)?|rais(?:e|ing)|choose and pick up)",
    "UP": r"up",
    "PUT": r"(?:pick(?: up)? and place|put(?:ting)?(?: away)?|plac(?:e|ing)|"
    r"insert(?:ing)?|set(?:ting)?|"
    r"mov(?:e|ing)|stow(?:ing)?(?: away)?|stor(?:e|ing)|deposit(?:ing)?|transfer(?:ring)?|"
    r"drop(?:ping)?|lay(?:ing)?|stick(?:ing)?|slip(?:ping)?|tuck(?:ing)?|stack(?:ing)?|"
    r"position(?:ing)?|load(?:ing)?|relocat(?:e|ing)|carry(?:ing)?|return(?:ing)?|"
    r"stand(?:ing)?|rest(?:ing)?|pack(?:ing)?|bring(?:ing)?|pop|leave)",
    "DROP": r"(?:put(?:ting)? down|set(?:ting)? down|lay(?:ing)? down|releas(?:e|ing)|let go of)",
    "DOWN": r"down",
    "AWAY": r"away",
    "BRING": r"(?:tak(?:e|ing)|get(?:ting)?|lift(?:ing)?|grab(?:bing)?|fetch(?:ing)?|"
    r"pull(?:ing)?|mov(?:e|ing)|bring(?:ing)?|transfer(?:ring)?)",
    "REMOVE": r"(?:remov(?:e|ing)|clear(?:ing)?(?: away)?|unload(?:ing)?|extract(?:ing)?|"
    r"tak(?:e|ing) (?:out|off|away)|get(?:ting)? out|pull(?:ing)? out|clear out)",
    "EMPTY": r"empty(?:ing)?",
    "OUT": r"(?:out|off|away)",
    "SOURCE": r"(?:from|off of|off|out of|away from)",
    "OPEN": r"(?:open(?:ing)?(?: up)?|(?:pull|slide|swing)(?:ing)? open)",
    "CLOSE": r"(?:clos(?:e|ing)(?: up)?|shut(?:ting)?|"
    r"(?:push|slide|swing)(?:ing)? (?:shut|closed))",
    "PULL": r"(?:pull|push|slide|swing|get|have|make)",
    "ENSURE": r"(?:ensur(?:e|ing)|(?:mak(?:e|ing)|be) (?:sure|certain)|check|see to it|see|verify|"
    r"confirm|guarantee|have)(?: that)?",
    "MODAL": r"(?:should|must|has to|have to|needs? to|ought to|shall|is to|are to)"
    r"(?: be| end up| stay| remain| get| finally be| then be)+|goes?|belongs?",
    "BE": r"(?:is|are|be|stays?|remains?|ends? up|gets?)"
    r"(?: left| put| placed| kept| again| properly)?",
    "LEAVE": r"(?:leav(?:e|ing)|keep(?:ing)?)",
    "OPEN_ADJ": r"(?:wide )?open(?:ed)?",
    "CLOSED_ADJ": r"(?:fully |completely |properly )?(?:closed|shut)",
    "STATE": r"(?:ajar|empty|full|toppled|fallen)",
    "REORIENT": r"(?:re ?orient(?:ing|ate)?|rotat(?:e|ing)|tilt(?:ing)?|flip(?:ping)?|upright|"
    r"turn(?:ing)?)",
    "TURN": r"(?:turn(?:ing)?|stand(?:ing)?|set(?:ting)?|put(?:ting)?|bring(?:ing)?|make)",
    "UPRIGHT": r"(?:upright|up|on end|vertical(?:ly)?)",
    "EITHER": r"(?:either|one of|any of)",
    "BOTH": r"both",
    "OR": r"or(?: else)?",
    "AND": r"(?:and(?: also)?|as well as|along with|together with|plus)",
    "INTO": r"(?:in to|into|inside of|inside|in|within)",
    "INTO_DIR": r"(?:in to|into|inside of|inside)",
    "ONTO": r"(?:onto|on to|on top of|on|upon|atop|over)",
    "ONTO_DIR": r"(?:onto|on to|on top of|over)",
    "TO": r"(?:over to|to)",
    "HERE": r"(?:inside|in there|on there|there|on top|in)",
    "WITH": r"with",
    "ANYHOW": r"(?:either )?(?:together|both together) or (?:separately|apart|individually|"
    r"one by one)|(?:either )?(?:separately|apart|individually) or together|in any combination",
    "TOGETHER": r"(?:all |both )?together",
    "SEPARATELY": r"separately|apart from each other|individually|apart",
    "HORIZONTAL": r"(?:horizontally|in a horizontal (?:pose|grasp)|"
    r"with a (?:horizontal|side) grasp|"
    r"(?:from |by )?(?:(?:the|its|a|one) )?sides?|sideways)",
    "VERTICAL": r"(?:vertically|in a vertical (?:pose|grasp)|top down|"
    r"with a (?:vertical|top|top down) grasp|(?:from )?(?:straight )?(?:above|overhead)|"
    r"(?:from )?(?:the |its )?top|by (?:the|its) (?:rim|edge|top))",
    "ADVERB": r"(?:please|carefully|gently|slowly|safely|at the end|in the end|afterwards|finally|"
    r"when (?:you are )?(?:done|finished)|for me|right away|again|first|fully|completely|"
    r"all the way|wide|too|as well|there ?after|in that order|"
    r"one (?:by one|after (?:the )?(?:other|another)))",
    "DET": rf"(?:(?:any|whichever|each|every|all|both|some|either|{_COUNT})"
    rf"(?: one| single)?(?: of)?(?: (?:{_THE}))?(?: other)?(?: (?:{_COUNT}))?|"
    rf"(?:{_THE}|this|that|a|an|another)(?: (?:other|same|single|{_COUNT}))?(?: (?:{_COUNT}))?)",
    "PRONOUN": r"(?:it|them|they|this|that|these|those|its)",
    "POSSESSIVE": r"'s",
    "RELATIVE": rf"(?:(?:that|which|who)(?: (?:is|are|stands?|lies|lie|sits?|rests?))?"
    rf"(?: currently| now| already)?(?: (?:{_POSTURE}))?|(?:{_POSTURE}))",
    "CONTAINING": r"(?:containing|holding|contains?|holds?|has)",
    "SIDE": rf"(?:on|at|to|in|from|towards?)(?: the)?(?: far| very)? (?:{_PLACE})"
    r"(?: hand)?(?: side| end| edge| corner)?(?: of the (?:desk|table|scene|room))?",
    "BETWEEN": r"(?:in )?between",
    "P_ON": r"(?:on top of|on|upon|atop)",
    "P_IN": r"(?:inside of|inside|in|within)",
    "P_FROM": r"(?:from|off of|off|out of)",
    "P_OF": r"(?:of|belonging to)",
    "P_NEAR": r"(?:next to|beside|nearby|near to|near|close to|by|alongside|adjacent to|at)",
    "P_LEFT": r"(?:(?:to|on|at) the left(?: hand)?(?: side)? of|left of)",
    "P_RIGHT": r"(?:(?:to|on|at) the right(?: hand)?(?: side)? of|right of)",
    "P_BEHIND": r"(?:behind|in back of|beyond|at the back of)",
    "P_FRONT": r"(?:in front of|at the front of)",
    "P_UNDER": r"(?:underneath|under|below|beneath)",
    "P_ABOVE": r"(?:above|over)",
    "P_NEAREST": r"(?:closest|nearest)(?: to)?",
    "P_FARTHEST": r"(?:farthest|furthest|far)(?: away)? from",
}  # fmt: skip

FUNCTION_WORDS = _words(
    """
    whichever upside twice thrice times half halfway backwards forwards sideways aside away together
    the a an any some another these those this that my your its their it them they of and or
    then in into inside within on onto upon atop to from off out at by next beside near
    nearby behind beyond under underneath below beneath above over between with without is
    are be was were been should must shall has have which who either both all each every not
    no never neither nor except unless if while until because where so but before after once
    when as please don t do does together separately respectively horizontally vertically
    upright ensure up down there here than instead two three four five six seven eight nine
    ten
    """
)
"""Never part of a noun phrase's words."""
VERBS = _words(
    """
    pick picking grab grabbing take taking lift lifting fetch fetching get getting grasp
    grasping hold holding seize collect raise put putting place placing insert inserting set
    setting move moving stow store storing deposit transfer drop dropping lay stick slip
    tuck stack position load relocate carry return rest pack bring bringing pop leave
    leaving release remove removing clear clearing unload extract opening close closing
    shutting pull push slide swing make check see verify confirm keep keeping reorient
    reorienting rotate rotating tilt flip turn turning let go try remember can could would
    will juggle throw toss kick wash wipe pour cook
    """
)
"""Words for doing; part of a noun phrase only where the scene has a thing called so."""
PREPOSITIONS = _words(
    """
    in into inside within on onto upon atop to from off at by near beside next behind beyond under
    underneath below beneath above over between with of left right front containing holding that
    """
)
"""Words that attach a phrase to another one."""

"""Words for time and order, and what joins things and clauses."""

from __future__ import annotations

from etot_cli.reasoning.language.words.predicates import BROUGHT, RELATIONS
from etot_cli.reasoning.language.words.verbs import THE_ROBOT

NAMED = r"(?:the|a|an|my|our|your|all|both|every|this|that|these|those)\b"
"""What a named thing begins with, as a regular expression."""
WHERE = r"(?:in|on|to|next|inside|onto|into|from|off|out)\b"
"""What a place begins with, as a regular expression."""
AND_NO_MORE = "and nothing else, but nothing else"
"""Behind what alone is to be somewhere."""
ALL_ALONG = """
    at all times, at any (time|point|moment|stage),
    (during|throughout) the [whole|entire]
    (run|task|trial|episode|execution|process|motion|move|experiment|test|procedure|operation),
    (all|the (whole|entire)) [the] (time|while), throughout, all along,
    (while|as) you do (it|so|this|that), (while|in) doing (it|so|this|that)
"""
"""Behind what is to be so not only in the end."""
WHILE = "while [you [are]], whilst [you [are]], as you [are]"
_AT_END = """
    (at|by) the [very] end [of (it all|this|(the|this|your) (episode|task|run|job|turn|day|session|
    shift|experiment|exercise|game|lesson|test|demo|process))], in the end,
    in the (final|end|target|goal) (state|configuration|arrangement)
"""
_WHEN_DONE = f"""
    (when|once|after|by the time)
    (you are [all] (done|finished|through)|you (finish|have finished|finished|stop|have stopped)|
    (everything|all) is (said and done|done|finished)|
    ({THE_ROBOT}) ((is|has) [all] (done|finished|stopped)|finishes|stops)),
    (when|once) (done|finished)
"""
"""Only then; as what is asked for comes to an end then, it is asked for of the end."""
BY_THE_END = f"{_AT_END}, {_WHEN_DONE}"
_SOMEBODY = f"""
    i|we|he|she|they|(the|my|our) ({RELATIONS}|guests|customers|clients|patients|parents|
    colleagues|students|visitors|kids|children|family|team|others|neighbors|neighbours)|
    [my|our] (mum|mom|dad|grandma|grandpa)
"""
_BACK = f"""
    ({_SOMEBODY}) (am|are|is|come[s]|get[s]|return[s]|arrive[s])
    [back|home|in|here|over|round|there] [from (work|school|lunch|dinner)]
    [tonight|tomorrow|later|again|today|in the (morning|evening|afternoon)]
"""
SOMEBODY_COMES = f"(when|before|by the time) ({_BACK})"
"""With how things are to be by then; nobody is to wait for it."""
END_STATE = f"({BY_THE_END}) [~comma]"
"""Before how things are to be by then."""
ANY_MORE = "anymore, any more, any longer, yet, so far"
SAME_AGAIN = """
    do [exactly|just] the same [thing] (with|for|to), ditto [with|for],
    [and] so (do|does|should|must), as (do|does),
    the same [thing] (goes|applies|holds) for, likewise [for|with], [the] same [thing] (with|for),
    (do|treat) likewise (with|for), repeat [(this|that|it)] (with|for)
"""
"""Before things that what was just asked for is asked for, too."""
ALSO = "[~comma] (too|as well|also), likewise, [~comma] ditto"
BEFORE_ALL = "before [(doing|you do)] (anything|everything) else [(is|gets) done|happens]"
LEADING_FIRST = f"""
    first, [but] {BEFORE_ALL}, [but] before all [of] (that|this),
    firstly, first of all, to (begin|start) [off] with, for (a start|starters),
    (start|begin) [off] by,
    [as (a|the|your)|the|your] first (step|thing|task|action) [to do] [is [to]], first things first
"""
_MOVING_IT = "before (you (move|touch)|moving|touching) (it|them)"
"""Whatever "it" is of what was just asked for."""
LEADING_BEFORE = f"""
    [but|though] [even] before (that|this), [but|though] before (doing (so|it|that|this)),
    [but|though] before you do (so|it|that|this|~comma), [but] beforehand,
    [but] prior to (that|this|doing (so|that|this)), [but|though] {_MOVING_IT}
"""
LEADING_BETWEEN = "in between"
LEADING_LAST = f"""
    finally, lastly, last, last of all, last but not least, {_AT_END},
    [as (a|the|your)|the|your] (last|final) (step|thing|task|action) [to do] [is [to]],
    (finish|end) [up|off] by
"""
_THAT_DONE = """
    (once|when|after|as soon as) (that|it|this) (is|has been) [all] done, [with] (that|this) done,
    having done (that|this|so), (once|when|after) you are done [with] (that|this|it),
    (once|when|after|as soon as) (you have done (that|this|so|it)|you do [so|that|this])
"""
LEADING_THEN = f"""
    then, next, after [all [of]] (that|this), afterwards, afterward, after which,
    second, secondly, third, thirdly,
    after doing (so|that|this),
    [the|as (a|the|your)] (next|second|third|fourth) (step|thing|task|action) [to do] [is [to]],
    the (next|second|third|fourth) is to,
    {_THAT_DONE}, {_WHEN_DONE}, and then, subsequently, later
"""
TRAILING_FIRST = f"""
    first, before, beforehand, [even] before that, prior to (that|this|doing so), {BEFORE_ALL},
    as [the|your|a] first (thing|step|action), before you do [so|that|this],
    before doing (so|that|this)
"""
TRAILING_LAST = f"""
    last, as [the|your|a] (last|final) (thing|step|action), {BY_THE_END}, finally, at last,
    (when|once) we are [all] (done|finished|through), when (that|this) is done,
    (when|once|after) (everything|all) is (in place|put away|sorted|set),
    (when|once) you have (put everything (in|away)|everything (in|away))
"""
TRAILING_THEN = "afterwards, afterward, after, after that, next, then, later"
IN_STEAD = "instead of, rather than"
NOT_THERE = f"{IN_STEAD}, not"
"""Before what is not meant, or where something is not to be, ahead of what is."""
INSTEAD = """
    instead, instead of (it|them|that|those), in (exchange|return) [for (it|them|that|those)]
"""
"""What is asked for takes the place of what is taken away, or is not to be done."""
ALONG_WITH = "along with, together with"
IN_ADDITION = "as well as, in addition to, plus"
AS_WELL_AS = f"{ALONG_WITH}, {IN_ADDITION}"
AND = f"and [also|likewise], {AS_WELL_AS}, +"
OR = "or [else]"
EITHER = "either, one of, any of"
JOINTS = "but, ~comma and, ~comma but, ~comma so, [~comma] whereas, ~comma (while|whilst)"
PURPOSE = "to, in order to, so as to"
THEN_JOINTS = f"""
    [and] when you have done, [and] [~comma] ({_THAT_DONE}),
    [and] [~comma] (once|when|after) (it is|they are) (in|on) (it|them|there) [~comma] [you can],
    [and|but] [only] then, [and] after [all [of]] (that|this),
    [and] afterwards, [and] next, [and] (finally|lastly),
    [and] after (them|these|those), and last [of all], after which,
    and later
"""
COUNTED_JOINTS = "[and] [then] (second|secondly|third|thirdly|fourth|fourthly), last"
"""Before what comes next, where something was said to come first."""
COUNTED = "second, third, fourth, next, then, afterwards, last"
"""Behind what comes next there."""
NOT_BEFORE = """
    [but|and] not (before|until) [after], [but|and] not (sooner|earlier) than,
    [but|and] only after
"""
"""Before what goes to the same place earlier; "after the cup" alone may only say when."""
COMES = "comes, come, goes, go"
"""Between a thing and its turn."""
ONWARD = "[and] then [finally], [and] after that, and finally"
"""Before the next place of what was put somewhere."""
EXACTLY = "exactly, precisely, right, directly, immediately, just, straight, off, over"
"""Before where something is or goes: it stands as near as can be anyway."""
BEFORE = "before [you], prior to, by the time [you]"
_ONCE = "[only|right|straight|just|directly|immediately] (once|after|when|as soon as)"
BY_THEN = f"[but] ({_ONCE}|not (before|until))"
AFTER = f"({BY_THEN}) [you have|having|you]"
GONE = f"""
    (has|have) (gone|landed),
    (has|have) been ({BROUGHT}) [down|away],
    (is|are) (put|set|laid) down
"""
"""Between a thing and where it is by then ("after the tuna has gone into the basket")."""
LOOK_FOR = """
    find, locate, look (for|at), search for, identify, choose, select, approach, reach for,
    (go|head|make|aim) for,
    (go|move|drive|walk|navigate) [over] (to|towards)
"""
REACH = "reach[ing], look[ing], go[ing]"
"""Before what something is taken out of."""
SO_THAT = "so that, such that, so, in such a way that"
IF = "if, in case, provided [that], assuming [that]"
ONLY_IF = "[but] only if"
UNLESS = "unless"
OTHERWISE = "otherwise, else, or else"
IF_NOT = """
    if not, if (it|that|this) is not, if they are not, if (it|that|this) is not (so|the case),
    if not so, if no, if there is (not [any|one]|none), if there are (not [any]|none)
"""
IF_SO = """
    if (it|that|this) is, if they are, if so, if (it|that|this) is (so|the case), if yes,
    if there (is|are)
"""
IF_THERE = {
    True: """
        if (it|that) is [already] there [already], if (it|that) already is [there],
        if they are [already] there [already]
    """,
    False: """
        if (it|that) is not [already] there [already|yet], if they are not there [already|yet]
    """,
}
"""Before what is asked for where what a condition says is not so, or is so for all that."""
IN_THAT_CASE = "in (which|that) case"
"""The same behind "unless", of all that it says, be it denied or not."""
DO_NOTHING = """
    [just] (do nothing|do not do anything) [at all], nothing (has|needs|is) to be done,
    there is nothing to do, you are done, leave it at that
"""

"""Words without meaning, words for time and order, and what joins things and clauses."""

from __future__ import annotations

_WILL_DO = "(is|are|would be) (fine|ok|okay|good)|will do|would do|works|work"
ANY_WILL_DO = f"({_WILL_DO}) [for me]"
"""Behind any of several things, before what is to be done with one of them."""
WITHOUT_MEANING = f"""
    please, kindly, [very|really] (carefully|gently|safely|cautiously),
    also, too, as well, just, simply, now, though,
    again,
    immediately, right away, right now, for me, fully, completely, all the way, wide, there after,
    one (by one|after the other|after another), one at a time, in the process, if you please,
    (with|using) (the|your|its|one|a) (gripper|hand|arm|robot hand|robot arm|robotic arm),
    pls, plz, thx, (would|will|could|can) you, any way you like, at the moment, at present, for now,
    mate, buddy, pal, today, tonight, this (morning|afternoon|evening),
    (when|once) you have [got] (it|them),
    (whichever|whatever) [one] you (like|want|prefer|choose|fancy), [it is] your choice,
    [it is] up to you, you (choose|decide), the choice is yours,
    wherever (you (like|want)|there is [some] (room|space)|it fits),
    of your [own] (choice|choosing),
    (it does not|does not|no) matter which [one],
    [please and] thank you [(so|very) much], thanks [a lot|so much], cheers, that is all,
    (either|any|any one|each|both) [of (them|these|those)] ({_WILL_DO}),
    ~comma (any|either) [one] [of (them|these|those)],
    i (do not|don t) (care|mind) [which] [one], whichever, if you can,
    if possible, at all times, properly, neatly, directly, straight,
    behind you, after you, one (by|after) (one|another|the other),
    without (knocking|tipping) anything [else] over, without (breaking|dropping|spilling) anything,
    without (dropping|breaking) (it|them), before i forget, by the way, what a mess,
    (if|when) you (have|get|find) (time|the time|a (moment|minute|second|chance)),
    (nice|well done|perfect|excellent|[very] good|good job|good work) [~comma],
    that would be (great|nice|lovely|perfect|all), (much|very much) appreciated
"""
"""Words that a request may contain without asking for anything more. What "gently" and "safely" ask
for, every plan does: things are set down, and no plan may harm anything."""
ANY_ONE = "(either|any) [one] [of (them|these|those)]"
"""A sentence alone, after one that left it open anyway."""
TIDYING = "[it is] [now] time to (tidy|clean) up, (tidy up|clean up|cleanup) time"
TIDY_UP = "[it is time to|time to|let us] (tidy|clean|clear) up ~comma"
"""Before what is to go where."""
TASK = """
    [your|the] (task|goal|job|target|aim|objective) ~comma,
    [the] (desired|final|goal|target|end) (state|configuration|arrangement|result) ~comma
"""
I_THINK = "(i (think|believe|guess|suppose) [that]|i was thinking [that])"
"""Before what would be good to do."""
WISH_IF = """
    [(it|that)] would (be|make me) (nice|good|great|better|best|lovely|perfect|ideal|happy) if,
    (i|we) would be [very|really|so] (happy|glad|grateful|delighted|pleased|thankful) if,
    (i|we) would (like|love|prefer|appreciate) it if, (i|we) wish [that]
"""
"""Before how things are to be."""
FRAMES = f"""
    robot, hey robot, hello robot, hi robot, hey, ok, okay, hello, hi, sorry, excuse me, well, oh,
    great, um, actually,
    (hang|hold) on [a (second|moment|minute)] ~comma, listen [up] ~comma, [good] morning ~comma,
    (hey|hi|hello) there, alright, all right, so, and, but, go, go and, go ahead and,
    (can|could|would|will) (you|u), (can|could|will) i ask you to,
    (would|will) you be able to, could you possibly,
    [{I_THINK}] you (should|must|[will] have to|[will] need to|can|may|could),
    (the|your) (task|goal|job|aim) is to, your task is, i (want|need|would like|d like) you to,
    i would like [that you], i want, i would (rather|prefer) you [to],
    ({WISH_IF}) you [would|could|can|might], let us, try to, please to, {TASK},
    the robot (should|must|has to|needs to), make sure to,
    be sure to, remember to, (do not|don t) forget to, [would|do] you mind, mind,
    (how|what) about, why do not you, i (wonder|was wondering) if you could,
    (would|is) it [be] possible to, it would be (good|great|nice|better) to,
    i ask you to, your job is, it is time to,
    help me [to|by], help me [to] (tidy|clean) up by, we need to, you are to,
    (would|could) you be so kind as to, (would|could) you be so (good|nice) as to,
    mind [that] you, be so kind as to, be so (good|nice) as to, if you would, do me a favor and,
    do me a favour and, {TIDY_UP},
    be (a|an) (dear|darling|love|angel|star|pal|legend|sport) and
"""
END_STATE = """
    (at|by) the end [of (it all|this|(the|this|your) (episode|task|run|job|turn))] [~comma],
    in the end [~comma], (when|once) you are [all] (done|finished) [~comma]
"""
"""Before how things are to be by then."""
ANY_MORE = "anymore, any more, any longer"
REMARKS = """
    (is|are) [now|already|still|all|no longer|not] [very|too|so|really]
    (dirty|clean|ripe|rotten|ready|done|finished|used|hot|cold|wet|dry|fresh|stale|broken|old|new|mine|yours|washed|cooked|fragile|needed|wanted),
    (is|are) not (needed|wanted|used) [anymore|any more|any longer],
    (is|are|stands|lies) in (my|the) way,
    (is|are) (fine|good|ok|okay|alright) [there|where (it is|they are)],
    (need|needs) (washing|cleaning|a wash), (takes|take) up too much (space|room),
    (is|are) (in|on|at) the wrong (one|place|spot|side),
    (has|have) been (used|washed|cleaned),
    (is|are) (a mess|all over the place|everywhere|all over the (table|desk|floor|counter))
"""
"""What is said of a thing before it is spoken of, and asks for nothing."""
FOUND = """
    (is|are|was|were|has been|have been|got|seem[s] to be)
    [still|just|now|currently|again|all]
    [left|standing|lying|sitting|resting|wide|slightly|partly|half|a (little|bit)]
"""
"""Between a thing and how it is, before something is asked of it."""
BY_NOW = "right now, now, at the moment, currently, still, already, just"
"""With how things are."""
SOMEBODY_LEFT = "(i|we|you|they|he|she|someone|somebody) [have|has|had] [just] left"
DONE_WITH = "(i am|we are|i have|we have) [all] (done|finished|through) with, (i|we) no longer need"
"""Before such a thing."""
SAME_AGAIN = """
    do the same (with|for|to), [and] so (do|does|should|must), as (do|does),
    the same (goes|applies|holds) for, likewise [for|with], same (with|for)
"""
"""Before things that what was just asked for is asked for, too."""
ALSO = "[~comma] (too|as well|also), likewise"
LEADING_FIRST = """
    first, before (anything|everything) else, firstly, first of all, to begin with, to start with,
    (start|begin) [off] by,
    [as a|the|your] first (step|thing|task|action) [to do] [is [to]], first things first
"""
LEADING_BEFORE = "before that, before doing so, before you do so, beforehand, but before that"
LEADING_LAST = """
    finally, lastly, last, last of all, in the end, last but not least,
    (at|by) the end [of (it all|this|(the|this|your) (episode|task|run|job|turn))],
    [as a|the|your] (last|final) (step|thing|task|action) [to do] [is [to]],
    (finish|end) [up|off] by
"""
LEADING_THEN = """
    then, next, after that, afterwards, afterward, after which, second, secondly, third, thirdly,
    after doing so,
    [the|as a] (next|second|third|fourth) (step|thing|task|action) [to do] [is [to]],
    the (next|second|third|fourth) is to,
    once (that is done|done), (when|once) you are [all] (done|finished), when (done|finished),
    and then, subsequently, later
"""
TRAILING_FIRST = "first, before, beforehand, before that, before (anything|everything) else"
TRAILING_LAST = """
    last, at the end, in the end, finally, at last,
    (when|once) [you are|we are] [all] (done|finished|through), when (that|this) is done,
    (by the time|when|once) you (finish|are (done|finished)|have finished),
    (when|once|after) (everything|all) is (done|finished|in place|put away|sorted|set),
    (when|once) you have (put everything (in|away)|everything (in|away))
"""
TRAILING_THEN = "afterwards, afterward, after, after that, next, then, later"
INSTEAD = "instead, instead of (it|them|that|those)"
"""What is asked for takes the place of what is taken away, or is not to be done."""
AND = "and [also|likewise], as well as, along with, together with, plus"
OR = "or [else]"
EITHER = "either, one of, any of"
JOINTS = "but, ~comma and, ~comma but, to, in order to, so as to, by, ~comma so"
THEN_JOINTS = """
    [and] when (that is|you have) done [that], [and] once that is done,
    [and|but] [only] then, [and] after that, [and] afterwards, [and] next, [and] (finally|lastly),
    and last [of all], after which,
    and later
"""
ONWARD = "[and] then [finally], [and] after that, and finally"
"""Before the next place of what was put somewhere."""
EXACTLY = "exactly, right, directly, immediately, just, straight, off, over"
"""Before where something is or goes: it stands as near as can be anyway."""
BEFORE = "before [you], prior to"
AFTER = """
    [but] [only] (once|after|when|as soon as) [you have|having|you],
    [but] not (before|until) [you have|having|you]
"""
BY_THEN = "[but] [only] (once|after|when|as soon as), [but] not (before|until)"
GONE = """
    (has|have) (gone|landed), (has|have) been (put|placed|moved|brought|set|laid) [down|away],
    (is|are) (put|set|laid) down
"""
"""Between a thing and where it is by then ("after the tuna has gone into the basket")."""
LOOK_FOR = """
    find, locate, look (for|at), search for, identify, choose, select, approach, reach for,
    (go|move|drive|walk|navigate) [over] (to|towards)
"""
SO_THAT = "so that, such that, so, in such a way that"

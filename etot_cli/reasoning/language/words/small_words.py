"""Words without meaning, words for time and order, and what joins things and clauses."""

from __future__ import annotations

from etot_cli.reasoning.language.words.manner import BY_HAND, ONE_BY_ONE, THE_ONE_HAND
from etot_cli.reasoning.language.words.verbs import BROUGHT, RELATIONS, THE_ROBOT

NAMED = r"(?:the|a|an|my|our|your|all|both|every|this|that|these|those)\b"
"""What a named thing begins with, as a regular expression."""
WHERE = r"(?:in|on|to|next|inside|onto|into|from|off|out)\b"
"""What a place begins with, as a regular expression."""
_WHICH = """
    which [one|of them|shelf|board|drawer|box|bin|bowl|cup|mug|plate|tray|side]
    [(you (do|move|take|put|handle|start with)|comes|goes|is (done|moved|put)) [first]|first]
"""
_EASIER = """
    (easier|easiest|best|better|possible|simpler|simplest|[more|most] convenient)
    [to (reach|get|grab|get at|grasp|grip|hold|lift|take|pick up|get hold of)]
"""
_WILL_DO = """
    (is|are|would be) [both|equally|all|also|just as]
    (fine|ok|okay|good|acceptable|all right|alright)|
    will do|would do|works|work
"""
ANY_WILL_DO = f"""
    ({_WILL_DO}) [(for|with|by) (me|us|this|now|(the|this) (demo|test|task|experiment|trial|run))]
"""
"""Behind any of several things, before what is to be done with one of them."""
_HOLDING = """
    (approach|grasp|grip|gripper|grasping) (direction|pose|orientation|angle|side)
"""
_I_ASK = "[that] (i|we) (ask [for|of you]|want|need|wish|wanted|would like|am asking [for])"
WITHOUT_MEANING = f"""
    [pretty] please, kindly, ta,
    ~comma there is a ((good|dear|clever) (boy|girl|lad|lass|chap|robot)|dear|love|darling),
    [very|really] (carefully|gently|safely|cautiously),
    while you are (at|about) it,
    also, too, as well, just, simply, now, though, of course, obviously, naturally, evidently,
    needless to say, somehow [or other], in some way [or other], one way or another,
    again, once (more|again),
    immediately, right away, right now, for me, fully, completely, all the way,
    the rest of the way, wide, there after,
    {ONE_BY_ONE}, in the process, if you please,
    {BY_HAND},
    pls, plz, thx, ty, lol, haha, hehe, btw, fyi, (would|will|could|can) you, any way you like,
    at the moment, at present, for now, this time, (this|for) once,
    mate, buddy, pal, today, tonight, this (morning|afternoon|evening),
    (when|once) you have [got] (it|them),
    [[and] that] is (it|all|everything) [{_I_ASK}|[that] there is [to it]],
    ~comma (choose|pick|take|use) (whichever|whatever) [one] (you (like|want|prefer|choose|fancy)|
    suits you [best]|is (easier|easiest|best)),
    [just|simply] choose (whichever|whatever) [one] (you (like|want|prefer|fancy)|suits you),
    [the] ({_HOLDING}) [is] (free|arbitrary|optional|open|unconstrained|irrelevant|up to you|
    [of] your [own] (choice|choosing)),
    (any|whichever) ({_HOLDING}), with (any|whichever|whatever) ({_HOLDING}),
    ({_HOLDING}) (of your [own] (choice|choosing)|as you (like|please|wish|prefer)),
    (whichever|whatever) [one|ones|of (them|these|the two)]
    you (like|want|prefer|choose|fancy|[can] (reach|grasp|get [(at|to)]|find))
    [best|first|[the] (easier|easiest)|(more|most) (easily|comfortably)], [it is] your choice,
    [it is|that is] up to you [{_WHICH}], you (choose|decide|pick) [{_WHICH}|the order],
    the choice is yours,
    wherever (you (like|want)|there is [some] (room|space)|it fits), (it fits|they fit) (in|into),
    (can|will) (take|hold|accommodate) (it|them), has [enough] (room|space) for (it|them),
    of your [own] (choice|choosing),
    (it does not|does not|no) matter {_WHICH},
    [please and] thank you [(so|very) much], thanks [a lot|so much], cheers, that is all,
    (either|any|each|both) [one] [of (them|these|those|the two)] ({ANY_WILL_DO}),
    ~comma (any|either) [one] [of (them|these|those)],
    [i] (do not|don t) (care|mind) [one|{_WHICH}|which of the (two|three|four) [it is]],
    whichever [[comes|goes] first],
    if you can,
    [whether] (together or (apart|separately)|(apart|separately) or together),
    (whichever|whatever) [one] (is|seems|works|fits|suits you) [{_EASIER}],
    (whichever|whatever) [one|of (them|these|the two)]
    (is (easier|easiest|better|best) [for you]|suits you [best|better]|it is|
    [will] (stay|stays|remain|remains) (standing|upright)),
    (in|with|using) (any|either|whatever|whichever) (orientation|pose|way|manner|grasp|grip)
    [you (like|can|want|prefer)], (any|whichever) way you (can|like|want), no matter how,
    however you (like|want|can [(get hold of|reach|grasp|grip|hold|lift) (it|them)]),
    as you (like|wish|prefer|please),
    (whichever|either|any) way (round|around) [you (like|want|prefer|please)],
    you (can|may) start with (either|any) [one|of them],
    [do (it|this|that|them|these|those|both)] [in] (any|whichever|whatever) order
    [you (like|want|prefer|please|choose|see fit|fancy)|[that] suits you [best|{_EASIER}]|
    is (easier|easiest|best) [for you]|seems best [to you]],
    out of sight, (before|after|for) (dinner|lunch|breakfast|supper|bedtime|school|work),
    as wide as it (goes|can|will [go]), until it (will|does) not go any further,
    as far as it (goes|can [go]|will [go]), whatever (it|that|this) takes,
    no matter what, at all costs,
    [in] (whichever|whatever) way (is (easiest|best|possible)|works [best]|suits you),
    without (damaging|hurting|harming|breaking) anything,
    if possible, by all means,
    [and|but] whatever [else] (you do|happens) [~comma],
    properly, neatly, directly, straight,
    ~comma if you would [be so (kind|good|nice)], ~comma shall we, behind you, after you,
    one (by|after) (one|another|the other),
    do not (ask [me] [why|about (it|that)]|worry [about (it|that|a thing)]|mind me),
    if (i|we) (remember|recall) [(it|that)] (rightly|correctly|right|well),
    if memory serves [me] [(right|well|correctly)], to [the best of] my knowledge,
    (if i am not|unless i am) [very much] mistaken, unless i am [quite] wrong,
    as far as i (know|remember|recall|can (tell|see)|am aware),
    without (knocking|tipping) anything [else] over, without (breaking|dropping|spilling) anything,
    without (dropping|breaking) (it|them), before i forget, by the way,
    (never mind|ignore|excuse|pardon|forgive|do not mind|do not worry about|sorry about)
    (the|this|that|my|all the|all this) (mess|clutter|chaos|muddle|noise|smell|dust),
    what a mess [(in|around|over|) here|[over|in|] there|this is],
    (if|when) you (have|get|find) (time|the time|a (moment|minute|second|chance)),
    ~comma i (think|believe|guess|suppose|reckon|would say), maybe, perhaps,
    chop chop, quick march, asap, as soon as (possible|you can),
    (nice|well done|perfect|excellent|[very] good|good job|good work) [~comma],
    that would be (great|nice|lovely|perfect|all), (much|very much) appreciated,
    ~comma [my [dear|good]]
    (dear|friend|love|darling|honey|sweetie|sweetheart|dearest|treasure|fellow|chap|man),
    ~comma (dude|bro|sis|ma am|miss|mister|[good|dear|kind] (sir|madam)|folks|[you] guys|son|boss),
    ~comma [my] (young|good|old|dear|clever) (man|lady|friend|fellow|boy|girl|chap),
    ~comma [my] [little|good|dear|clever] (helper|robot),
    by (tonight|tomorrow [(morning|noon|evening|night)]|noon|midnight|
    lunchtime|dinnertime|bedtime|(this|the) (afternoon|evening)|
    (four|five|six|seven|eight|nine|ten|eleven|twelve) [o 'clock|tonight]),
    before (dark|nightfall|midnight|noon),
    (by the time|before) (i|we) (am|are|come|get|return) [back|home|in|here],
    (by the time|before) (i|we|they|he|she|(the|our|my) (guests|kids|children))
    (sit down|sits down|leave|leaves|arrive|arrives)
"""
"""Words that a request may contain without asking for anything more. What "gently" and "safely" ask
for, every plan does: things are set down, and no plan may harm anything."""
DOES_NOT_MATTER = """
    [(it|that)] (does not matter|makes no difference|is up to you|is all the same) [to (me|us)],
    is your
    (choice|decision), is not important, is (irrelevant|unimportant)
"""
"""Before or behind what is left open."""
ALL_ALONG = """
    at all times, at any (time|point|moment|stage),
    (during|throughout) the [whole|entire]
    (run|task|trial|episode|execution|process|motion|move|experiment|test|procedure|operation),
    (all|the (whole|entire)) [the] (time|while), throughout, all along
"""
"""Behind what is to be so not only in the end."""
ANY_ONE = "(either|any) [one] [of (them|these|those)]"
"""A sentence alone, after one that left it open anyway."""
WHILE = "while [you [are]], whilst [you [are]], as you [are]"
ANNOUNCED = "(two|three|four|five|a few|a couple of) things [to do] [~comma] [(for you|please|now)]"
"""Before what is to be done."""
TIDYING = """
    [it is] [now] time to (tidy|clean) up, (tidy up|clean up|cleanup) time,
    [(can|could|will|would) you] [please] help (me|us)
    [[to] (tidy|clean|clear) up] [here]
"""
LIKE_THIS = "(set|lay|arrange|prepare|organise|organize) [up], i (want|would like)"
"""Before what is to be as the words behind a colon say."""
TIDY_UP = "[it is time to|time to|let us] (tidy|clean|clear) up ~comma"
"""Before what is to go where."""
FROM_HERE = """
    (starting|beginning|start|begin) (from|with|in)
    (the (given|current|present|initial|shown|existing|start|starting)
    (scene|state|situation|configuration|arrangement|setup|layout)|here|the scene as it is)
"""
"""Before what is to be done; nobody starts from anything else."""
TASK = f"""
    {ANNOUNCED} ~comma,
    [this is] what (i|we) (want|need|would like) [to (see|have)] [is (this|the following)] ~comma,
    [your|the] (task|goal|job|target|aim|objective) ~comma, (desired|wanted|required) ~comma,
    [the|a] [desired|required|intended]
    (desired|final|goal|target|end|wanted|required|termination|success)
    (state|configuration|arrangement|result|situation|setup|condition|conditions|layout|
    picture) ~comma,
    [{FROM_HERE} ~comma]
    (achieve|reach|accomplish|obtain|realize|realise|establish|produce)
    (this|the following [state|configuration|result|goal|arrangement|situation|conditions]) ~comma,
    [the] (goal|target|(desired|final|goal|target|end) (state|configuration))
    to (reach|achieve|attain|be (reached|achieved|attained)) ~comma,
    (achieve|reach) [state|configuration|result] ~comma,
    what ((has|needs|is) to|should|must) (hold|be (achieved|reached|attained|so|true))
    [(in|at|by) the end] ~comma,
    [my|our|the|a] [small|little|simple|one] (request|wish|instruction) ~comma,
    [my|our|the|your] (goal|task|job|request|wish|(end|final|goal) state) is
    [very|really|quite] (simple|easy|clear|this|as follows|the following) ~comma
"""
GOAL_IS = """
    [the|our|my|your] [desired|required|intended] (goal|target|(final|end|goal|target)
    (state|configuration|result|situation)|result) (is|should be|must be)
"""
"""Before what is to be so in the end."""
_TRY = "demo|demonstration|trial|experiment|test|benchmark|presentation|recording|video"
FOR_A_TRY = f"""
    (for|in) (the|this|our|today 's) [(first|next|last|current|upcoming)] ({_TRY}|run|task|episode),
    in the next (trial|task|test|run|experiment|episode)
"""
"""With what is done then, which is the same at any time."""
GREETINGS = f"""
    [hey|hi|hello|oh|dear|my dear] (mummy|mommy|mum|mom|mama|daddy|dad|papa|grandma|grandpa|granny|
    grandad|nan|nana|auntie|uncle|darling|love|honey|sweetheart|sweetie|boss|mate|buddy|pal|sir|
    madam) ~comma, (quick|hurry [up]) ~comma,
    [hey|hello|hi|dear|yo] (robot [arm]|arm ~comma|gripper ~comma),
    [hey|hello|hi|dear|yo] [my] [little|good|dear|clever] helper ~comma,
    hand on heart, honestly, to be honest, in all honesty,
    hey, yo, ok, okay, hello, hi, sorry, excuse me, well, oh,
    oh (dear|my), dear me, no (rush|hurry|pressure), (like|as) i (said|told you),
    sorry to (bother|trouble|disturb|interrupt) you [again],
    sorry to be (a|such a) (pain|nuisance|bother|pest), [be] careful ~comma,
    (watch|mind) out ~comma,
    {FROM_HERE} [~comma], {FOR_A_TRY} [~comma],
    for (safety|hygiene|security) reasons, for (heaven|pete|goodness|god) 's sake,
    believe it or not, you will not believe (it|this),
    thanks for (your|the) help [(yesterday|today|earlier|last time)],
    ugh, oops, whoops, ouch, yikes, gosh, phew, aw, hmm,
    great, um, [my] dear ~comma, now then, come on,
    (hang|hold) on [a (second|moment|minute)] ~comma, listen [up] ~comma, [good] morning ~comma,
    (hey|hi|hello) there, alright, all right, so, and, but, {TASK}, {TIDY_UP},
    [just] as a [first|quick|simple|little|short] (warm up|test|exercise|try) [~comma]
"""
WOULD_BE_NICE = """
    (i|we) would (be|feel) [very|really|so|most|much|ever so]
    (glad|happy|happier|grateful|pleased|delighted|thankful|obliged),
    (i|we) would [really] (like|love|appreciate|prefer) it,
    [it|that] would be [very|really|so]
    (good|great|nice|nicer|lovely|kind|helpful|perfect|wonderful|better|best|ideal|preferable|tidier)
    [of you],
    [it|that] would make me happy, it would help [me|us] [a lot|a great deal],
    (i|we) would feel [much|a lot|so much] (better|safer|calmer)
"""
"""Before or behind what it would be nice if somebody did."""
I_THINK = """
    (i|we) (think|believe|guess|suppose|reckon|feel) [that], i was thinking [that]
"""
"""Before what would be good to do."""
IS_ENOUGH = """
    (i|we) (am|are|will be|shall be|would be) [very|quite|perfectly]
    (happy|glad|content|satisfied|pleased), (it|that) (is|will be|would be) enough [for (me|us)],
    that (will|would) do [for (me|us)]
"""
"""Behind or before how things are to be."""
WISH_IF = f"""
    ({WOULD_BE_NICE}) if, (i|we) wish [that], ({IS_ENOUGH}) (if|as long as|so long as|when|once)
"""
"""Before how things are to be."""
FRAMES = f"""
    ({WISH_IF}) (you|someone|somebody) (would|could|can|might),
    {GREETINGS}, actually, go, go and, go ahead and,
    (can|could|would|will) (you|u),
    (can|could|will|may|might) i [please] (ask|trouble|bother) you to,
    (would|will) you be able to, could you possibly,
    [is there] (any|a) (chance|way|possibility) [that] [you (can|could|would|might)],
    (do|would) you think [that] you (can|could|might) [be able to], shall we [please],
    (would|could|can|will) (somebody|someone|anybody|anyone), you (might|may) (want|like|wish) to,
    you (should|must|[will] have to|[will] need to|can|may|had (better|best)), better,
    (the|your) (task|goal|job|aim) is to, your task is,
    (all|what|the only thing) ([that] you (have|need) to do|
    [that] (i|we) (want|need|would like) you to do|[[that] there is] to do) is [to],
    (all|what|the only thing) [that] (i|we) [really|just|only]
    (want|need|would like|ask [for|of you]) is (to|for you to|that you),
    (i|we) [only] (want|need|would like|d like) you to,
    i would like [that you], i want, i would (rather|prefer) you [to], let us, try to, please to,
    (find|work out|figure out|think of|come [up] with) (a|some|any) way (to|of),
    (work|figure|find) out how to,
    (find|make|devise|work out|think of|come [up] with) a [suitable|good] (plan|strategy) (to|for),
    ({THE_ROBOT}) (should|must|will|shall|has to|needs to|is to), make sure to,
    (have|make|let) ({THE_ROBOT}), (can|could|would|will) ({THE_ROBOT}),
    us(e|ing) [only|just] {THE_ONE_HAND} to,
    (get|use|ask|tell|instruct|(i|we) (want|need|would like|d like)) ({THE_ROBOT}) to,
    [it is] ({THE_ROBOT}) 's (task|goal|job) [is] to, the (task|goal|job) of ({THE_ROBOT}) is to,
    be sure to, remember to, (do not|don t) forget to, [would|do] you mind [to], mind,
    (how|what) about [[if] you], why do not you,
    (let (me|us)|(i|we) (want|would (like|love)) to|(may|can|could) (i|we)) (see|watch) you,
    (let (me|us) see|show (me|us)) (if|whether|how|that) you [(can|could|would)],
    i (wonder|was wondering|am wondering) (if|whether) you (could|would|can|might),
    i (was|am) hoping [that] you (could|would),
    (would|is) it [be] possible [for you] to,
    it would be (good|great|nice|kind|lovely|better) [of you] to,
    i [would|must|have to|would like to] ask you to, your job is, it is time to,
    help me [to|by], help me [to] (tidy|clean) up by,
    (i|we) [(really|just|still|also)] ought to, we [(really|just|still|also)] (need|have) to,
    we (had (better|best)|should|must), you are to, if i were you ~comma [i (would|d)],
    would it be (all right|alright|ok|okay) [with you] to,
    would it be (too much|much) (trouble|bother|to ask) [for you] to, you could [(always|just)],
    [it is] [high] time [for you] to,
    (would|could) you be so (kind|good|nice) (as to|and|to), please you,
    mind [that] you, be so (kind|good|nice) (as to|to|and), if you would, do me a favor and,
    do me a favour and,
    be (a|an) (dear|darling|love|angel|star|pal|legend|sport|sweetheart|sweetie|saint|treasure) and,
    be a (good|kind|nice|clever) (boy|girl|lad|lass|dear|robot|fellow|sport|chap|soul) and
"""
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
TURNED = "warm|hot|cold|wet|dry|dirty|dusty|stale|soft|hard|bad|off|flat|mouldy|sour|old"
"""How things get or go by themselves."""
SO_LONG = """
    [for] (long enough|too long|ages|hours|days|weeks|a [long] while|[quite] some time),
    [for] (an hour|a day|a week|all (day|night|morning|week))
"""
"""With how things are by now."""
REMARKS = f"""
    (has|have) been (in|out|up|down|on|over|) (here|there) ({SO_LONG}),
    (is|are) [now|already|still|all|no longer|not] [very|too|so|really]
    (dirty|clean|ripe|rotten|ready|done|finished|used|hot|cold|wet|dry|fresh|stale|broken|old|new|mine|yours|washed|cooked|fragile|needed|wanted),
    (is|are) not (needed|wanted|used) [anymore|any more|any longer],
    (is|are|stands|lies) in (my|the) way [here|there], (is|are) [still] put away,
    (has|have|needs|need) to (move|go),
    (is|are) (fine|good|ok|okay|alright),
    (has|have) gone ({TURNED}), (is|are) (getting|going|turning) ({TURNED}),
    (is|are) (dead|blunt|dull|dusty|sticky|greasy|cracked|chipped|leaking|unwashed),
    (is|are|has been|have been) [just] (lying|standing|sitting) (around|about) [{SO_LONG}],
    (needs|need|has|have) to (stay|be kept|keep|remain) (warm|cold|cool|dry|fresh|clean|safe),
    (must|should) (stay|be kept|keep|remain) (warm|cold|cool|fresh),
    (need|needs) (washing|cleaning|a wash), (takes|take) up too much (space|room),
    (is|are) (in|on|at) the wrong (one|place|spot|side),
    (has|have) been (used|washed|cleaned),
    (is|are) for [my|our|the] ({RELATIONS}|guests|kids|children|grandma|grandpa|mum|mom|dad),
    (is|are) (a mess|all over the place|everywhere|all over the (table|desk|floor|counter))
"""
"""What is said of a thing before it is spoken of, and asks for nothing."""
FOUND = """
    (is|are|was|were|has been|have been|got|seem[s] to be|stands|sits|lies|rests|stand|sit|lie|rest)
    [still|just|now|currently|again|all]
    [left|standing|lying|sitting|resting|wide|slightly|partly|half|a (little|bit)]
"""
"""Between a thing and how it is, before something is asked of it."""
FELL = """
    (fell|rolled|slipped|slid|dropped|went|(has|have|had) (fallen|rolled|slipped|slid|gone)) [down]
"""
"""Between a thing and what it is in or on by now."""
BY_NOW = "right now, now, at the moment, currently, still, already, just, anyway, again, by now"
"""With how things are."""
SOMEBODY_LEFT = f"""
    (i|we|you|they|he|she|someone|somebody|(the|my|our) ({RELATIONS})) [have|has|had] [just] left,
    whoever (was|worked) here [before|last] [has] left,
    (he|she|(the|my|our) ({RELATIONS})) [has] put
"""
DONE_WITH = """
    (i am|we are|i have|we have) [all] (done|finished|through) with, (i|we) no longer need,
    (i|we) have [got] no [more|further] (use|need) for
"""
"""Before such a thing."""
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
LEADING_BEFORE = """
    [but] before [doing|you do] (that|this), [but] before (doing|you do) (so|it), [but] beforehand,
    [but] prior to (that|this|doing so)
"""
LEADING_LAST = f"""
    finally, lastly, last, last of all, last but not least, {_AT_END},
    [as (a|the|your)|the|your] (last|final) (step|thing|task|action) [to do] [is [to]],
    (finish|end) [up|off] by
"""
_THAT_DONE = """
    (once|when|after|as soon as) (that|it|this) (is|has been) [all] done, [with] (that|this) done,
    having done (that|this|so), (once|when) you (are|have) done [with] (that|this)
"""
LEADING_THEN = f"""
    then, next, after [all [of]] (that|this), afterwards, afterward, after which,
    second, secondly, third, thirdly,
    after doing so,
    [the|as (a|the|your)] (next|second|third|fourth) (step|thing|task|action) [to do] [is [to]],
    the (next|second|third|fourth) is to,
    {_THAT_DONE}, {_WHEN_DONE}, and then, subsequently, later
"""
TRAILING_FIRST = f"""
    first, before, beforehand, before that, prior to (that|this|doing so), {BEFORE_ALL},
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
AND = "and [also|likewise], as well as, along with, together with, plus, +"
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

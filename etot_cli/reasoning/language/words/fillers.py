"""Words that ask for nothing: courtesies, what is left open, remarks on how things are."""

from __future__ import annotations

from etot_cli.reasoning.language.words.manner import BY_HAND, ONE_BY_ONE
from etot_cli.reasoning.language.words.predicates import RELATIONS

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
    as (carefully|gently|safely|cautiously|neatly) as (you can|possible),
    while you are (at|about) it,
    also, too, as well, just, simply, now, though, of course, obviously, naturally, evidently,
    needless to say, somehow [or other], in some way [or other], one way or another,
    again, once (more|again),
    immediately, right away, right now, for (me|us), fully, completely, all the way,
    the rest of the way, wide, there after,
    {ONE_BY_ONE}, in the process, if you please,
    {BY_HAND},
    pls, plz, pleas, thx, ty, lol, haha, hehe, btw, fyi, (would|will|could|can) you,
    any way you like, either way, in (any|either) case,
    at the moment, at present, for now, this time, (this|for) once,
    mate, buddy, pal, today, tonight, overnight, this (morning|afternoon|evening),
    (when|once) you have [got] (it|them),
    [[and] that] is (it|all|everything)
    [{_I_ASK}|[that] there is [to it]|for (today|tonight|the (day|moment))],
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
    [please and] thank you [([ever] so|very) much], thanks [a lot|so much], cheers, that is all,
    (either|any|each|both) [one] [of (them|these|those|the two)] ({ANY_WILL_DO}),
    ~comma (any|either) [one] [of (them|these|those)],
    [i] (do not|don t) (care|mind) [one|{_WHICH}|which of the (two|three|four) [it is]],
    whichever [[comes|goes] first],
    if you (can|like|wish),
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
    out of sight, (before|for) (dinner|lunch|breakfast|supper|bedtime|school|work),
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
    (can|could|would) you believe (it|that), [and] [i am] (naming|mentioning) no names,
    do not make me (do (it|that) [myself]|ask (twice|again)|beg),
    if (i|we) (remember|recall) [(it|that)] (rightly|correctly|right|well),
    if memory serves [me] [(right|well|correctly)], to [the best of] my knowledge,
    (if i am not|unless i am) [very much] mistaken, unless i am [quite] wrong,
    as far as i (know|remember|recall|can (tell|see)|am aware),
    without (knocking|tipping) anything [else] over, without dropping anything,
    without (dropping|breaking) (it|them), before i forget, by the way,
    (never mind|ignore|excuse|pardon|forgive|do not mind|do not worry about|sorry (about|for))
    (the|this|that|my|all the|all this) (mess|clutter|chaos|muddle|noise|smell|dust),
    what a mess [(in|around|over|) here|[over|in|] there|this is],
    (if|when) you (have|get|find) (time|the time|a (moment|minute|second|chance)),
    ~comma [as] you [can] (see|know),
    ~comma i (think|believe|guess|suppose|reckon|would say), maybe, perhaps,
    chop chop, quick march, asap, as soon as (possible|you can),
    (nice|well done|perfect|excellent|[very] good|good job|good work) [~comma],
    that would be (great|nice|lovely|perfect|all), (much|very much) appreciated,
    ~comma [my [dear|good]]
    (dear|friend|love|darling|hon|honey|sweetie|sweetheart|dearest|treasure|fellow|chap|man),
    ~comma (dude|bro|sis|ma am|miss|mister|[good|dear|kind] (sir|madam)|folks|[you] guys|son|boss),
    ~comma [my] (young|good|old|dear|clever) (man|lady|friend|fellow|boy|girl|chap),
    ~comma [my] [little|good|dear|clever] (helper|robot),
    by (tonight|tomorrow [(morning|noon|evening|night)]|noon|midnight|
    lunchtime|dinnertime|bedtime|(this|the) (afternoon|evening)|
    (four|five|six|seven|eight|nine|ten|eleven|twelve) [o 'clock|tonight]),
    before (dark|nightfall|midnight|noon),
    (by the time|before) (i|we) (am|are|come|get|return) [back|home|in|here],
    before you (go (home|(to|for) (lunch|dinner|bed))|leave for (today|the (day|night|weekend))|
    finish (work|(your|the) shift)),
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
ANY_ONE = "(either|any) [one] [of (them|these|those)]"
"""A sentence alone, after one that left it open anyway."""
TURNED = "warm|hot|cold|wet|dry|dirty|dusty|stale|soft|hard|bad|off|flat|mouldy|sour|old"
"""How things get or go by themselves."""
SO_LONG = """
    [for] (long enough|too long|ages|hours|days|weeks|a [long] while|[quite] some time),
    [for] (an hour|a day|a week|all (day|night|morning|week)),
    since (yesterday|this morning|last (night|week|month)|monday|tuesday|wednesday|thursday|friday)
"""
"""With how things are by now."""
REMARKS = f"""
    (has|have) been (in|out|up|down|on|over|) (here|there) ({SO_LONG}),
    (is|are) [now|already|still|all|no longer|not] [very|too|so|really]
    (dirty|clean|expired|damaged|defective|faulty|outdated|ripe|rotten|ready|done|finished|used|hot|cold|wet|dry|fresh|stale|broken|old|new|mine|yours|washed|cooked|fragile|needed|wanted),
    (is|are) (not|no longer) (needed|wanted|used|necessary|required)
    [anymore|any more|any longer|now|right now|at the moment|today],
    (is|are|stands|lies) in (my|the) way [here|there], (is|are) [still] put away,
    (has|have|needs|need) to (move|go),
    (is|are) (fine|good|ok|okay|alright),
    (has|have) gone ({TURNED}), (is|are) (getting|going|turning) ({TURNED}),
    (is|are) (dead|blunt|dull|dusty|sticky|greasy|cracked|chipped|leaking|unwashed),
    (is|are|has been|have been) [just] (lying|standing|sitting) (around|about) [{SO_LONG}],
    (needs|need|has|have) to (stay|be kept|keep|remain) (warm|cold|cool|dry|fresh|clean|safe),
    (must|should) (stay|be kept|keep|remain) (warm|cold|cool|fresh),
    (need|needs) (washing|cleaning|a wash), (takes|take) up too much (space|room),
    (is|are|has been|have been) [kept|left|stored|standing|lying] (in|on|at) (the|a)
    wrong (one|place|spot|side) [all along|all this time|again|{SO_LONG}],
    (has|have) been (used|washed|cleaned),
    (is|are) for [my|our|the] ({RELATIONS}|guests|kids|children|grandma|grandpa|mum|mom|dad),
    (is|are) (a mess|all over the place|everywhere|all over the (table|desk|floor|counter))
"""
"""What is said of a thing before it is spoken of, and asks for nothing."""
FOUND = """
    (is|are|was|were|has been|have been|got|seem[s] to be|stands|sits|lies|rests|stand|sit|lie|rest)
    [still|just|now|currently|again|all]
    [left|standing|lying|sitting|resting|parked|located|situated|positioned|
    wide|slightly|partly|half|a (little|bit)]
"""
"""Between a thing and how it is, before something is asked of it."""
FELL = """
    (fell|rolled|slipped|slid|dropped|went|(has|have|had) (fallen|rolled|slipped|slid|gone)) [down]
"""
"""Between a thing and what it is in or on by now."""
BY_NOW = "right now, now, at the moment, currently, still, already, just, anyway, again, by now"
"""With how things are."""
_STRANGER = f"""
    he|she|(the|my|our|a|one of (the|my|our)) ({RELATIONS}|guests|visitors|colleagues|students|
    children|kids|boys|girls|cat|cats|dog|dogs|puppy)
"""
SOMEBODY_LEFT = f"""
    (i|we|you|they|someone|somebody|{_STRANGER}) [have|has|had] [just] (left|dropped),
    whoever (was|worked) here [before|last] [has] left,
    ({_STRANGER}) [have|has] [just] put
"""
"""What somebody did with a thing that is there by now."""
DONE_WITH = """
    (i am|we are|i have|we have) [all] (done|finished|through) with, (i|we) no longer need,
    (i|we) have [got] no [more|further] (use|need) for
"""
"""Before such a thing."""

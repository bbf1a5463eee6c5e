"""Words around what is asked for: greetings, wishes, and who is to do it."""

from __future__ import annotations

from etot_cli.reasoning.language.words.manner import THE_ONE_HAND
from etot_cli.reasoning.language.words.verbs import THE_ROBOT

ANNOUNCED = """
    (two|three|four|five|a few|a couple of) things [to do] [~comma] [(for you|please|now)],
    [just] [a|one] (quick|small|last) (one|thing|request|favour|favor) [for you],
    [kindly] do the needful,
    do (it|this) (the way|as|like) (i|we) (always|usually) (do|like|have|want) [it]
"""
"""Before what is to be done."""
TIDYING = """
    [it is] [now] time to (tidy|clean) up, (tidy up|clean up|cleanup) time,
    [(can|could|will|would) you] [please] help (me|us)
    [[to] (tidy|clean|clear) up] [here]
"""
LIKE_THIS = "(set|lay|arrange|prepare|organise|organize) [up], i (want|would like)"
"""Before what is to be as the words behind a colon say."""
TIDY_UP = """
    [it is time to|time to|let us] (tidy|clean|clear) up ~comma,
    (it is time to|time to|let us) tidy ~comma
"""
"""Before what is to go where."""
FROM_HERE = """
    (starting|beginning|start|begin) (from|with|in)
    (the (given|current|present|initial|shown|existing|start|starting)
    (scene|state|situation|configuration|arrangement|setup|layout)|here|the scene as it is)
"""
"""Before what is to be done; nobody starts from anything else."""
TASK = f"""
    {ANNOUNCED} ~comma,
    [(this|here) is] what (i|we) (want|need|would like) [to (see|have)]
    [is (this|the following)] ~comma,
    [your|the] (task|goal|job|target|aim|objective) ~comma, (desired|wanted|required) ~comma,
    [my|our|the|your] to do [list] ~comma,
    [the|a] [desired|required|intended]
    (desired|final|goal|target|end|wanted|required|termination|success|expected|intended)
    (state|states|configuration|arrangement|result|results|situation|setup|condition|conditions|
    layout|picture|criterion|criteria|outcome|effect|effects) ~comma,
    [the] (effect[s]|outcome|result|postcondition[s]|post condition[s]) ~comma,
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
    (for|in) (the|this|our|today 's|tomorrow 's|tonight 's) [(first|next|last|current|upcoming)]
    ({_TRY}|run|task|episode),
    in the next (trial|task|test|run|experiment|episode)
"""
"""With what is done then, which is the same at any time."""
GREETINGS = f"""
    [hey|hi|hello|oh|dear|my dear] (mummy|mommy|mum|mom|mama|daddy|dad|papa|grandma|grandpa|granny|
    grandad|nan|nana|auntie|uncle|darling|love|honey|sweetheart|sweetie|boss|mate|buddy|pal|sir|
    madam) ~comma, (quick|hurry [up]) ~comma,
    [hey|hello|hi|dear|yo] (robot [arm]|arm ~comma|gripper ~comma),
    [hey|hello|hi|dear|yo] [my] [little|good|dear|clever] helper ~comma,
    [to] (whoever|anyone who|everyone who|anybody who) (reads|finds|sees|is reading) this
    [note|message|list] ~comma,
    [to] whoever is [next] (on duty|on shift|in|around|here|free) [(today|tonight|tomorrow)] ~comma,
    hand on heart, honestly, to be honest, in all honesty,
    hey, yo, ok, okay, hello, hi, sorry, excuse me, well, oh,
    oh (dear|my), dear me, no (rush|hurry|pressure), (like|as) i (said|told you),
    sorry to (bother|trouble|disturb|interrupt) you [again],
    sorry to be (a|such a) (pain|nuisance|bother|pest), [be] careful ~comma,
    (watch|mind) out ~comma,
    do not tell (anyone|anybody|(my|our|the) (boss|wife|husband|mother|mum|father|dad)) ~comma,
    {FROM_HERE} [~comma], {FOR_A_TRY} [~comma],
    for (safety|hygiene|security) reasons, for (heaven|pete|goodness|god) 's sake,
    believe it or not, you will not believe (it|this),
    thanks for (your|the) help [(yesterday|today|earlier|last time)],
    ugh, oops, whoops, ouch, yikes, gosh, phew, aw, hmm, sigh, silly me,
    great, um, uhm, uh, erm, er, [my] dear ~comma, now then, come on,
    (hang on|hold on|wait) [a (second|moment|minute)] ~comma, listen [up] ~comma,
    (hey|hi|hello) there, alright, all right, so, and, but, {TASK}, {TIDY_UP},
    [just] as a [first|quick|simple|little|short] (warm up|test|exercise|try) [~comma]
"""
WOULD_BE_NICE = """
    (i|we) (would|should) (be|feel) [very|really|so|most|much|ever so]
    (glad|happy|happier|grateful|pleased|delighted|thankful|obliged) [to you],
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
    i would like [that you], i want, i would (rather|prefer) you [to], let us, try [to],
    please [~comma] to,
    (find|work out|figure out|think of|come [up] with) (a|some|any) way (to|of),
    (work|figure|find) out how to,
    (find|make|devise|work out|think of|come [up] with) a [suitable|good] (plan|strategy) (to|for),
    ({THE_ROBOT}) (should|must|will|shall|has to|needs to|is to), make sure to,
    (have|make|let) ({THE_ROBOT}), (can|could|would|will) ({THE_ROBOT}),
    us(e|ing) [only|just] {THE_ONE_HAND} to,
    (get|use|ask|tell|instruct|(i|we) (want|need|would like|d like)) ({THE_ROBOT}) to,
    [it is] ({THE_ROBOT}) 's (task|goal|job) [is] to, the (task|goal|job) of ({THE_ROBOT}) is to,
    be sure to, remember to, (do not|don t) forget [to],
    [would|do] you mind [terribly|awfully] [to], mind,
    (how|what) about [[if] you], why do not you,
    (let (me|us)|(i|we) (want|would (like|love)) to|(may|can|could) (i|we)) (see|watch) you,
    (let (me|us) see|show (me|us)) (if|whether|how|that) you [(can|could|would)],
    i (wonder|was wondering|am wondering) (if|whether) you (could|would|can|might),
    i (hope [that] you (can|could|will)|(was|am) hoping [that] you (could|would)),
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
    [i|we] (request|beg|am requesting|are requesting) you [kindly] to [kindly],
    requesting you [kindly] to [kindly], you are [kindly|hereby] requested to [kindly],
    (can|could) you [please] to, i want you, (ensure|take care) to, do one thing ~comma,
    what you do is [~comma] [you],
    mind [that] you, be so (kind|good|nice) (as to|to|and), if you would, do me a favor and,
    do me a favour and,
    be (a|an) (dear|darling|love|angel|star|pal|legend|sport|sweetheart|sweetie|saint|treasure) and,
    be [very|extra|really] careful and,
    be a (good|kind|nice|clever) (boy|girl|lad|lass|dear|robot|fellow|sport|chap|soul) and
"""

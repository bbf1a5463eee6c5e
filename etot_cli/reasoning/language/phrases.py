"""The phrases of the grammar by what they mean: verbs, prepositions, determiners, small words.

Patterns as :func:`etot_cli.reasoning.language.parsing.spellings` reads them. Words that have no
meaning of their own stand in :data:`WITHOUT_MEANING` and :data:`FRAMES`, and nowhere else.
"""

from __future__ import annotations

from etot_cli.reasoning.language.lexicon import NUMBERS, word_set
from etot_cli.reasoning.language.parsing import words_of
from etot_cli.reasoning.language.syntax import Prep
from etot_cli.world.spatial import Nearby

# -- words without meaning, and how a request may begin --------------------------------------------

WITHOUT_MEANING = """
    please, kindly, carefully, gently, safely, cautiously, also, too, as well, just, simply, now,
    again,
    immediately, right away, right now, for me, fully, completely, all the way, wide, there after,
    one (by one|after the other|after another), one at a time, in the process, if you please,
    (with|using) (the|your|its|one|a) (gripper|hand|arm|robot hand|robot arm|robotic arm),
    thank you, thanks, if you can, if possible, at all times, properly, neatly, directly, straight
"""
"""Words that a request may contain without asking for anything more. What "gently" and "safely" ask
for, every plan does: things are set down, and no plan may harm anything."""
FRAMES = """
    robot, hey robot, hello robot, hi robot, hey, ok, okay, so, and, but, go, go and, go ahead and,
    (can|could|would|will) you, you (should|must|have to|need to|can|may), could you possibly,
    (the|your) (task|goal|job|aim) is to, your task is, i (want|need|would like|d like) you to,
    i would like, i want, let us, try to, the robot (should|must|has to|needs to), make sure to,
    be sure to, remember to, (do not|don t) forget to, would you mind, your job is, it is time to,
    i would appreciate it if you could, help me, help me to, we need to, you are to
"""
LEADING_FIRST = "first, firstly, first of all, to begin with, to start with, as a first step"
LEADING_BEFORE = "before that, before doing so, before you do so, beforehand, but before that"
LEADING_LAST = "finally, lastly, last, last of all, at the end, in the end, as a last step"
LEADING_THEN = """
    then, next, after that, afterwards, afterward, after which, second, secondly, third, thirdly,
    after doing so, once (that is done|done|you are done), when done, and then, subsequently, later
"""
TRAILING_FIRST = "first, beforehand, before that, before anything else"
TRAILING_LAST = "last, at the end, in the end, finally, at last, when (done|finished|you are done)"
TRAILING_THEN = "afterwards, afterward, after that, next, then, later"

# -- verbs -----------------------------------------------------------------------------------------

PICK = """
    pick[ing] up, pick[ing], grab[bing] [hold of], tak(e|ing) [hold of], lift[ing] [up], fetch[ing],
    get[ting] [hold of], grasp[ing], grip[ping], hold[ing] [up], seiz(e|ing), collect[ing], hand me,
    rais(e|ing), choose and pick up, bring me, giv(e|ing) me, pass[ing] me, retriev(e|ing),
    gather[ing]
"""
PUT = """
    put[ting] [away], plac(e|ing), pick [up] and place, insert[ing], set[ting], mov(e|ing),
    stow[ing] [away],
    stor(e|ing), deposit[ing], transfer[ring], drop[ping], lay[ing], stick[ing], slip[ping],
    tuck[ing], position[ing], load[ing], relocat(e|ing), carry[ing], return[ing],
    stand[ing], rest[ing], pack[ing], bring[ing], pop[ping], leav(e|ing), slid(e|ing), shift[ing],
    sort[ing], arrang(e|ing), put[ting] together, throw[ing] away, hid(e|ing), deliver[ing],
    add[ing]
"""
PUT_DOWN = "put[ting] down, set[ting] down, lay[ing] down, releas(e|ing), let go of"
PUT_BACK = "put[ting] back, return[ing], mov(e|ing) back"
BRING = """
    tak(e|ing), get[ting], lift[ing], grab[bing], fetch[ing], pull[ing], mov(e|ing), bring[ing],
    transfer[ring]
"""
REMOVE = """
    remov(e|ing), clear[ing] [away], unload[ing], extract[ing], tak(e|ing) (out|off|away),
    get[ting] (out|rid of), pull[ing] out, clear[ing] out, mov(e|ing) away, lift[ing] (out|off)
"""
TIDY = "tidy[ing] [up], tidy[ing] away, clear[ing] [away], clean[ing] up, sort[ing], clear[ing] up"
CLEAR = "clear[ing] [off], tidy[ing] [up], clean[ing] (off|up), clear[ing] out, empty[ing] out"
OPEN = "open[ing] [up], (pull|slide|swing|pulling|sliding|swinging) open"
CLOSE = "clos(e|ing) [up], shut[ting], (push|slide|swing|pushing|sliding|swinging) (shut|closed)"
PULL = "pull[ing], push[ing], slid(e|ing), swing[ing], get[ting], have, make, making"
ENSURE = """
    (ensure|ensuring|check|see|verify|confirm|guarantee|have) [that],
    (make|making|be) (sure|certain) [that], see to it [that]
"""
MODAL = """
    (should|must|shall) (be|end up|stay|remain|get|finally be|then be|go|be put|be
    placed|stand|sit|lie),
    (has to|have to|needs to|need to|ought to|is to|are to|wants to) (be|end up|stay|remain|go|be
    put|be placed),
    (is|are) supposed to be, goes, go, belong[s]
"""
WANT = "i want, i would like, i d like, i need, we want, we need, i would love, i prefer"
BE = """
    is, are, be, (is|are|be) (left|put|placed|kept|again|properly), stay[s], remain[s], end[s] up,
    get[s]
"""
KEEP = "keep[ing], leav(e|ing)"
OPEN_STATE = "[wide] open, opened"
CLOSED_STATE = "[fully|completely|properly] (closed|shut)"
STATES = "open, opened, closed, shut, ajar, empty, full, filled, toppled, fallen, tipped over"
REORIENT = """
    re orient[ing], reorient[ing], rotat(e|ing), tilt[ing], flip[ping], upright, turn[ing],
    re orientate
"""
TURN = "turn[ing], stand[ing], set[ting], put[ting], bring[ing], make"
UPRIGHT = "upright, up, on end, vertical, vertically"
STACK = "stack[ing] [up], pil(e|ing) [up]"
BUILD = "build[ing], mak(e|ing), creat(e|ing), form[ing]"
OUT_OF = "a (tower|stack|pile) (out of|of|from|with|using)"
UPON_EACH_OTHER = """
    on [top of] (each other|one another), one on [top of] (the other|another),
    in a (tower|stack|pile),
    into a (tower|stack|pile), onto each other, up
"""
BOTTOM_UP = """
    (from the|from) bottom (up|to top|to the top), bottom (first|up),
    starting (with|at|from) the bottom,
    [in this order] from bottom to top
"""
TOP_DOWN = "[from the] top (first|down), from (the top|top) to bottom, from top to the bottom"
AT_BOTTOM = "at the bottom, on the bottom, lowest, at the base"
AT_TOP = "at the top, on [the] top, uppermost, highest"
SWAP = "swap[ping], exchang(e|ing), switch[ing], swap the (places|positions) of, interchange"

# -- what must not be done -------------------------------------------------------------------------

DO_NOT = """
    do not, don t, never, you must not, you may not, you should not, must not, avoid,
    but do not, and do not
"""
TOUCH = """
    touch[ing], hit[ting], bump[ing] into, bump[ing], collid(e|ing) with, com(e|ing) near,
    contact[ing]
"""
DISTURB = """
    mov(e|ing), disturb[ing], push[ing], shift[ing], displac(e|ing), knock[ing] over, topple,
    toppling,
    tip[ping] over, lift[ing], relocat(e|ing), knock[ing]
"""
ANYTHING_ELSE = """
    anything else, any other (object|thing|things|objects), other (objects|things),
    the (others|rest)
"""
AS_IT_IS = """
    where (it|they) (is|are|was|were), as (it|they) (is|are), alone, untouched, in place, still,
    unmoved, in its place
"""

# -- small words -----------------------------------------------------------------------------------

AND = "and [also], as well as, along with, together with, plus"
OR = "or [else]"
EITHER = "either, one of, any of"
JOINTS = "and, but, ~comma and, ~comma but, to, in order to, so as to, by, ~comma so"
THEN_JOINTS = """
    [and|but] then, [and] after that, [and] afterwards, [and] next, [and] finally, after which,
    and later
"""
AFTER = "(once|after|when) [you have|having|you]"
SO_THAT = "so that, such that, so, until, in such a way that"
EXCEPT = "except [for], but not, other than, apart from, but, excluding, aside from, save for"
RELATIVE = """
    (that|which|who) (is|are|stands|stand|lies|lie|sits|sit|rests|rest|was|were)
    [currently|now|already],
    (that|which) (is|are) (standing|lying|sitting|placed|located|resting|kept|positioned),
    that, which, standing, lying, sitting, placed, located, resting, kept, situated, positioned,
    currently
"""
RELATIVE_NOT = """
    (that|which|who) (is|are) not [currently|yet], (that|which) do not (stand|lie|sit|rest),
    (that|which) does not (stand|lie|sit|rest), (that|which) isn t, not being
"""
NOT_PLACED = "not"
CONTAINING = """
    containing, holding, contains, contain, holds, hold, has,
    (that|which) (contains|holds|has|contain|hold|have)
"""
SOURCE = "from, off of, off, out of, away from, from (on top of|inside)"
SIDE = """
    (on|at|to|in|from) the (left|right|front|back|rear|middle|centre|center)
    [side|end|edge|corner|hand side],
    (on|at|to|in|from) the (left|right|front|back|rear) (side|end|edge) of the
    (desk|table|scene|room|row),
    (on|at|in) the (middle|centre|center) of the (desk|table|scene|room|row),
    (on|at) the (left|right) of the (desk|table|scene),
    on the far (left|right), in front, in back, at the very (left|right|front|back), in the row
"""
PREPOSITIONS: dict[Prep, str] = {
    Prep.ON: "on [top of], upon, atop, on the top of, (standing|lying|sitting) on",
    Prep.IN: "inside [of], in, within",
    Prep.FROM: "from, off of, off, out of",
    Prep.OF: "of, belonging to",
    Prep.NEAR: "next to, beside, nearby, near [to], close to, by, alongside, adjacent to, at",
    Prep.LEFT: "(to|on|at) the left [hand] [side] of, left of, to the left from",
    Prep.RIGHT: "(to|on|at) the right [hand] [side] of, right of",
    Prep.BEHIND: "behind, in back of, beyond",
    Prep.FRONT: "in front of",
    Prep.UNDER: "underneath, under, below, beneath",
    Prep.ABOVE: "above, over",
    Prep.NEAREST: "(closest|nearest) [to]",
    Prep.FARTHEST: "(farthest|furthest|far) [away] from, away from",
}
INTO = "in to, into, inside [of], in, within"
ONTO = "onto, on to, on [the] top of, on, upon, atop, over"
INTO_DIRECTED = "in to, into, inside [of]"
ONTO_DIRECTED = "onto, on to, on top of, over"
TO = "[over] to"
HERE = "inside, in there, on there, there, on top, in, into it"
HOME = """
    back [to its place], to (its|their|the) [original|old|previous] (place|places|position|spot),
    back to (its|their) [original|old] (place|places|position|spot),
    [back] (to|) where (it|they) (was|were|came from),
    [back] to where (it|they) (was|were) before, to its original position,
    back where (it|they) belong[s]
"""
NEARBY: dict[Nearby, str] = {
    Nearby.LEFT: "(to|on|at) the left [hand] [side] of, left of, to the left from",
    Nearby.RIGHT: "(to|on|at) the right [hand] [side] of, right of",
    Nearby.FRONT: "in front of",
    Nearby.BEHIND: "behind, in back of",
    Nearby.NEXT_TO: "next to, beside, alongside, adjacent to, by, by the side of, right next to",
    Nearby.NEAR: "near [to], close to, nearby, in the vicinity of",
    Nearby.AWAY: "[far] away from, far from",
}
REGIONS: dict[tuple[Nearby, ...], str] = {
    (
        Nearby.AT_LEFT,
    ): "(on|at|to|in|onto|towards) the left (side|end|half|part|edge|border), (on|at) the left",
    (Nearby.AT_RIGHT,): (
        "(on|at|to|in|onto|towards) the right (side|end|half|part|edge|border), (on|at) the right"
    ),
    (Nearby.AT_FRONT,): ("(on|at|to|in|onto|towards) the front [side|end|half|part|edge|border]"),
    (Nearby.AT_BACK,): (
        "(on|at|to|in|onto|towards) the (back|rear) [side|end|half|part|edge|border]"
    ),
    (Nearby.AT_CENTRE,): "(in|at|into|to|on|onto) the (middle|centre|center)",
    (Nearby.AT_EDGE,): "(at|on|near|to|by) (the|an) (edge|border|rim)",
    (Nearby.AT_CORNER,): "(in|at|into|to|on) (the|a) corner",
    (
        Nearby.AT_LEFT,
        Nearby.AT_FRONT,
    ): "(in|at|into|to|on) the (front left|left front|near left) [part|quarter|area]",
    (
        Nearby.AT_LEFT,
        Nearby.AT_FRONT,
        Nearby.AT_CORNER,
    ): "(in|at|into|to|on) the (front left|left front|near left) corner",
    (
        Nearby.AT_RIGHT,
        Nearby.AT_FRONT,
    ): "(in|at|into|to|on) the (front right|right front|near right) [part|quarter|area]",
    (
        Nearby.AT_RIGHT,
        Nearby.AT_FRONT,
        Nearby.AT_CORNER,
    ): "(in|at|into|to|on) the (front right|right front|near right) corner",
    (
        Nearby.AT_LEFT,
        Nearby.AT_BACK,
    ): "(in|at|into|to|on) the (back left|left back|rear left|far left) [part|quarter|area]",
    (
        Nearby.AT_LEFT,
        Nearby.AT_BACK,
        Nearby.AT_CORNER,
    ): "(in|at|into|to|on) the (back left|left back|rear left|far left) corner",
    (
        Nearby.AT_RIGHT,
        Nearby.AT_BACK,
    ): "(in|at|into|to|on) the (back right|right back|rear right|far right) [part|quarter|area]",
    (
        Nearby.AT_RIGHT,
        Nearby.AT_BACK,
        Nearby.AT_CORNER,
    ): "(in|at|into|to|on) the (back right|right back|rear right|far right) corner",
}
ANYHOW = """
    [either] [both] together or (separately|apart|individually|one by one),
    [either] (separately|apart|individually) or together, in any combination
"""
TOGETHER = "[all|both] together"
SEPARATELY = "separately, apart from each other, individually, apart"
BUT_NOT = "but not, and not, not"
STARTING_WITH = "starting with, beginning with"
IN_THIS_ORDER = """
    in (this|that) order, in the (given|same|stated) order,
    one (by one|after the other) in this order
"""
STANDING = """
    so [that] it (fits|stands) [upright], standing [upright|up], upright,
    so that (it|they) (fits|fit)
"""
HORIZONTAL = """
    horizontally, in a horizontal (pose|grasp), with a (horizontal|side) grasp, sideways,
    (from|by) (the|its|a|one) (side|sides), from one side
"""
VERTICAL = """
    vertically, in a vertical (pose|grasp), top down, with a (vertical|top|top down) grasp,
    [from] (above|straight above|overhead), from (the|its) top, from the top,
    by (the|its) (rim|edge|top)
"""
GENERAL_NOUNS = """
    everything, anything, something, everything else, all else, the (rest|others|other ones),
    all (others|the others|the rest)
"""
_COUNT = "|".join(NUMBERS)
_THE = "the|these|those|my|your|its|their|our"
DETERMINERS = (
    f"({_THE}|this|that|a|an|another|only the)",
    f"(the|my|your|this|that) (other|same|single|only|remaining|{_COUNT})",
    f"(the|these|those) (other|remaining|{_COUNT}) (other|remaining|{_COUNT})",
    "another one of the, a single, one single, only a",
    "(any|whichever|each|every|all|both|some|either) [of] [the|these|those|my|your]",
    "(any|each|every|either) (one|single) [of] [the|these|those]",
    f"(all|any) (the|of the|of these|of those|) (other|remaining|{_COUNT})",
    "(every|any|each|some) other",
    f"({_COUNT}) [of] [the|these|those|other|more|of the other]",
    "one of the (other|remaining), [any] one of (the|these|those|my|your|),"
    " any of (the|these|those|)",
    "exactly one, exactly two, just one, half of the, none of the, no",
    "a couple of, a pair of, several, a few, many, most of the",
    "whichever, any",
)

# -- what nouns are not ----------------------------------------------------------------------------

_FUNCTION = """
    the a an any some another these those this that my your its their our it them they of and or
    then in into inside within on onto upon atop to from off out at by next beside near
    nearby behind beyond under underneath below beneath above over between with without is
    are be was were been being am should must shall has have had which who whose whom either both
    all
    each every not non no never neither nor except unless if while until because where so but before
    after once when whenever as please don t do does did together separately respectively
    horizontally
    vertically upright ensure up down there here than instead two three four five six seven eight
    nine ten i we us me you he she what why how whether himself aside away everything anything
    something everyone nothing apart along plus via per using twice thrice times half halfway
    backwards forwards sideways rather also too just simply could would will may might i'd d ll
    ve re 's whichever upside goes go belong belongs want wants need needs like
    such only again now hey hi hello ok okay robot let lets alone untouched unmoved except
    during through across around toward towards against among anyone someone yet still even ever
    most more less few several many much enough half quite very really almost nearly maybe
    perhaps otherwise else other others remaining same single exactly
"""
VERB_WORDS = words_of(
    (PICK, PUT, PUT_DOWN, REMOVE, OPEN, CLOSE, PULL, ENSURE, KEEP, REORIENT, TURN, STACK, BUILD,
     SWAP, TOUCH, DISTURB, TIDY, CLEAR, DO_NOT)
) - {"open", "closed", "shut", "empty", "top", "the", "tower", "hand", "of", "back", "places",
    "positions", "position"}  # fmt: skip
"""Words for doing; part of a noun phrase only where the scene has a thing called so."""
OTHER_VERBS = word_set(
    """
    pour pouring wipe wiping wash washing clean cleaning cook cooking stir stirring cut
    cutting slice slicing press pressing toss tossing throw throwing kick kicking juggle
    juggling shake shaking spin spinning roll rolling squeeze squeezing fold folding fill
    filling peel drink eat light plug unplug screw unscrew twist pinch poke break crush drag
    dragging sweep sweeping dust polish paint draw write hit hammer count find look search
    wait stop follow show tell describe explain say measure weigh heat cool mix blend scoop
    serve feed water inspect scan balance hang catch wave point dance walk drive fly jump
    sing toggle activate
    """
)
"""What no skill does."""
NEVER_NOUNS = frozenset({"the", "a", "an", "and", "or", "in", "on", "of", "not", "~comma", "to"})
GRAMMAR_WORDS = frozenset(_FUNCTION.split()) | VERB_WORDS | OTHER_VERBS | {"~comma"}


def is_adverb(text: str) -> bool:
    """Whether a word looks like one that says how something is done."""
    return len(text) > 4 and text.endswith("ly") and text not in ("jelly", "belly", "lily", "doily")


REASONS = {
    **dict.fromkeys(
        ("if", "unless", "when", "whenever", "while", "until", "once"),
        "conditions and waiting are not supported; say what is to be done",
    ),
    **dict.fromkeys(
        ("twice", "thrice", "times", "repeat", "again"), "repetitions are not supported"
    ),
    **dict.fromkeys(
        ("quickly", "slowly", "fast", "faster", "slower", "quick", "carelessly", "rapidly"),
        "how fast something is done cannot be asked for",
    ),
    **dict.fromkeys(
        ("what", "why", "how", "who", "whose", "is", "are", "does", "did", "do"),
        "questions are not answered; say what is to be done",
    ),
    **dict.fromkeys(
        ("hands", "tongs", "fingers", "tool"), "the robot has one gripper and nothing else"
    ),
    **dict.fromkeys(
        ("halfway", "half", "partially", "slightly", "partly", "little"),
        "things are opened and closed fully",
    ),
    **dict.fromkeys(
        ("push", "pull", "slide", "swing", "shove", "nudge", "drag"),
        "no skill pushes or pulls, but for opening and closing; say where it is to be put",
    ),
    **dict.fromkeys(
        ("hand", "arm", "tong"), "the robot has one gripper and no other tool",
    ),
    **dict.fromkeys(
        ("cm", "mm", "centimeters", "centimetres", "inches", "meters", "metres", "degrees"),
        "distances and angles cannot be asked for; say beside what it is to be",
    ),
    **dict.fromkeys(("row", "line", "circle"), "patterns of several things are not supported"),
    **dict.fromkeys(("same", "likewise", "ditto"), "say again what is to be done"),
    **dict.fromkeys(
        ("under", "underneath", "below", "beneath", "above", "through", "around"),
        "things can be put on, into and beside others, no other way",
    ),
    "rather": "say only what is to be done",
    "instead": "say only what is to be done",
    "upside": "how a thing is to lie cannot be asked for",
    "nothing": "say what is to be done",
    "never": "say first what is to be done",
}  # fmt: skip
"""Why words are not understood, wherever they stand."""
BLAMED = frozenset(
    {"push", "pull", "slide", "swing", "under", "underneath", "below", "beneath", "above"}
)
"""Words that are understood in some places only, and where they are not are what is wrong."""
ALL_WORDS = GRAMMAR_WORDS | words_of(
    (
        WITHOUT_MEANING, FRAMES, LEADING_FIRST, LEADING_BEFORE, LEADING_LAST, LEADING_THEN,
        TRAILING_FIRST, TRAILING_LAST, TRAILING_THEN, MODAL, WANT, BE, UPRIGHT, BUILD, OUT_OF,
        UPON_EACH_OTHER, BOTTOM_UP, TOP_DOWN, AT_BOTTOM, AT_TOP, ANYTHING_ELSE, AS_IT_IS, EXCEPT,
        RELATIVE, RELATIVE_NOT, CONTAINING, SIDE, *PREPOSITIONS.values(), HOME, *NEARBY.values(),
        *REGIONS.values(), ANYHOW, TOGETHER, SEPARATELY, STARTING_WITH, IN_THIS_ORDER, STANDING,
        HORIZONTAL, VERTICAL, GENERAL_NOUNS, *DETERMINERS, STATES,
    )
)  # fmt: skip
"""Every word that the grammar knows."""

"""Whether a reading accounts for every word that changes what is asked for.

The grammar's rules say which words they read; this looks only at the words and at what came of
them. A number, a denial, a word for all or any, for order, colour, size, place or state that has
left no trace in the syntax tree was read over, by whatever rule, and the reading is not one.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from enum import Enum

from msgspec import Struct

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.language.grammar.parsers.combinators import phrase
from etot_cli.reasoning.language.grammar.parsers.input import Input
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Reading, Spoken
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AgainClause,
    Avoid,
    AvoidClause,
    EnsureClause,
    GraspClause,
    MoveClause,
    PickClause,
    PutClause,
    PutGroup,
    RemoveClause,
    ReorientClause,
    SwapClause,
    TowerClause,
    Turns,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    CLEARED,
    Beside,
    Condition,
    Destination,
    Modifier,
    NounPhrase,
    State,
    Things,
    Toward,
    has_choice,
    stance_in,
)
from etot_cli.reasoning.language.words import manner, predicates
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.fillers import SO_LONG, SOMEBODY_LEFT, WITHOUT_MEANING
from etot_cli.reasoning.language.words.frames import FRAMES
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    NUMBERS,
    ORDINALS,
    SIDES,
    STATES,
    is_descriptive,
    word_set,
)
from etot_cli.reasoning.language.words.places import (
    A_SAFE_PLACE,
    FREE_SPOT,
    SAFELY,
    SOMEWHERE_FREE,
    Prep,
)
from etot_cli.reasoning.language.words.small_words import SOMEBODY_COMES
from etot_cli.skills.action import GraspPose
from etot_cli.world.spatial import Nearby

_DENIAL, _ORDER = "a denial", "an order"
_DENIALS = word_set("not never without except excluding non neither no")
_ORDERS = word_set("before after finally beforehand afterwards lastly firstly first last")
_QUANTITIES = word_set("all every each both either any other another same only remaining")
_POSTURES = {
    "upright": ("upright", "vertical"), "vertical": ("vertical", "upright"),
    "vertically": ("vertical", "upright"), "horizontal": ("horizontal",),
    "horizontally": ("horizontal",),
}  # fmt: skip
"""How things stand, or are grasped."""
_SAID_OF_STANCE = {Nearby.UPRIGHT: "upright", Nearby.LYING: "flat"}
_ALIKE = {
    "center": "middle", "centre": "middle", "behind": "back", "far": "back", "near": "front",
    "nearest": "front", "farthest": "back", "opened": "open", "ajar": "open",
}  # fmt: skip
"""Words that a tree may have one for the other."""
_FIXED = f"""
    not (both|all) (in|on) the same (one|place),
    (on|at) the far (left|right), (from|off|off of) the top of,
    on [the] top [of], on top, to the top, from the (top|side|front|left|right), from (top|above),
    (in|at|by|to) the (top|back), back (in|on|into|onto|to|inside|beside|next|where), put back,
    back on [the] top of, back there, right (next|by|behind|beside|in front|after|once|when),
    right (into|onto|on top|(in|inside|on|at|to) (the|a|an|its|my|our|your)),
    not both [of them], (as|so) long as,
    right (above|below|under|underneath|beneath),
    at the very, (first|last) of all, last but not least,
    one (by|after) (one|the other|another), in back, at last,
    each other, one another, (on|over) the other, none of, the other way (around|up),
    not (the other way around|vice versa|the reverse), (no|not) (sooner|earlier),
    at any (point|time|stage|moment), upright [exactly|just] (as|like|the way) (it|they) (is|are),
    one (on [top of]|in|inside|into) (the other|another),
    (to|at) the end, all the rest, (nothing|anything|be|is|are|remains|been|was|were|got) left,
    {manner.KEPT_HELD},
    (near|close|next|closer|nearer) to, near (the|each other|one another),
    left (open|opened|closed|shut|ajar|empty|alone|untouched),
    left [standing|lying|sitting] [exactly|precisely|just|right] (as|where|like) (it|they),
    closer together, a (bit|little) (further|farther), contents and all,
    's (top|surface), in any order, (no|any) longer, any more,
    only (then|once|after|when), any [one] but, any (color|colour), not (before|until),
    (before|after) all [of] (that|this), there (should|must|may|can) not be anything [left],
    there (is not|is no longer) anything [left],
    (when|once|after|by the time) all is, a little open, open a little,
    open (only|just) [slightly|partly|partially|halfway], a little bit,
    before (you touch|touching|you do anything|doing anything) [to|with],
    (i|we) do not want anything [to be] [left|lying|standing|sitting] (in|on),
    all [that] (i|we) [really|just] (need|want|would like|ask), all that (should|must) be,
    (thing|things|one|ones|object|objects|item|items) (left|remaining),
    all [that] (i|we) (need|want) (left|remaining), the right (way|side) up, right (way|side) up,
    all (the (way|time|while)|along), at all times,
    remaining (in|on|where|there|inside|open|closed|shut|put),
    (nearly|almost) (closed|shut), no matter (from|if|whether),
    {manner.AT_NEITHER_END},
    {manner.FROM_STATE}, from [a|the] horizontal [position|pose|orientation] to,
    (is|are) all the same to (me|us),
    not (possible|feasible|doable), (does|do|will) not work,
    the right (home|place|spot) (for|of),
    (standing|upright|stand) [~comma] (and not|not) (lie|lying|on its side) [down|flat],
    (is|are) only [slightly|partly|partially|half|halfway|barely|a (bit|little|crack)]
"""
"""Phrases in which such words say something else, or nothing of their own."""
_SAY_NOTHING = phrase(
    f"{WITHOUT_MEANING}, {FRAMES}, {SOMEBODY_LEFT}, {predicates.OTHERS_WANT}, {_FIXED}"
    f", {predicates.WILL_NEED}"
    f", {manner.NOT_STACKED}, {manner.STANDS_SINGLY}, {manner.ANYHOW}, {SO_LONG}"
    f", {manner.KEPT_UPRIGHT}"
    f", {FREE_SPOT}, {SOMEWHERE_FREE}, {SOMEBODY_COMES}"
    f", {SAFELY}, {A_SAFE_PLACE}, {predicates.OUT_OF_THE_WAY}"
)
_NOT_ONLY = Expression(
    r"\b(?:not|never) (?:\w+ )?(only|just|merely) (?!anywhere\b|once\b|like\b|as\b|where\b)"
)
_NOT_BOTH = Expression(r"\b(?:not|never)\b(?:(?!~comma|~colon|\bbut\b).)*\bboth\b")


_ACROSS = Expression(r"\b(other|opposite) side of\b")
_FROM_ITS_SIDE = Expression(
    r"(?:away )?from (?:the )?(in front|(?:left |right )?side|front|back|rear|left|right) of\b"
)
_DOES_NOT = Expression(r"[^~]*? (?:it|they) \w+ not\b")
"""What is away from a thing, told by where it stood, or by what it does not do to that."""
_LAST_FIRST = Expression(r"\b(first|before|beforehand)(?: that)?(?: ~comma| please)*$")


_ALLOWED_LATER = Expression(
    r"(?:(?:^|~comma |\b(?:and|but|then) )later(?: on)? (?:~comma )?"
    r"(?:(?!~comma|\band\b|\bbut\b).)*"
    r"\b(?:may|can|could|might)\b(?! (?:you|i|we)\b)"
    r"|\b(?:may|can|could|might)\b(?! (?:you|i|we)\b)"
    r"(?:(?!~comma|\band\b|\bbut\b|\bthen\b).)* later\b)"
)
"""What may be done some time is not asked for now."""


def unaccounted(words: Sequence[str], reading: Reading) -> str | None:
    """The first word of a sentence that its reading has read over, None when there is none."""
    left = Counter(_traces(reading))
    text = " ".join(words)
    if any(isinstance(said.clause, AvoidClause) for said in reading):
        if _NOT_BOTH.search(text):
            return "both"  # one of them may go there
        if said := _NOT_ONLY.search(text):
            return said[1]  # it may go there beside others
    if _ALLOWED_LATER.search(text):
        return "later"
    if (said := _LAST_FIRST.search(text)) and _is_first_alone(reading, text):
        return said[1]  # nothing is left that comes after it
    for word in _telling(words):
        kinds = _kinds(word)
        if not kinds:
            continue
        kind = next((item for item in kinds if left[item] > 0), None)
        if kind is None:
            return word
        if kind not in (_DENIAL, _ORDER):  # one of either may take several words
            left[kind] -= 1
    return None


def _is_first_alone(reading: Reading, text: str) -> bool:
    """Whether all that is asked for is to be done first, of which that may be said of the last."""
    if len(reading) > 1 or reading[0].order is not Order.FIRST:
        return False
    match reading[0].clause:
        case PutClause(groups=several) | EnsureClause(states=several):
            return len(several) > 1
        case MoveClause(things=Things(phrases=(_, *_, last))):  # "Open this, that first"
            return re.search(rf"~comma (?:and )?{last.text} first\b", text) is not None
    return False


def _telling(words: Sequence[str]) -> Iterator[str]:
    """Words that stand in no phrase that says nothing."""
    given, at = Input(tuple(words)), 0
    while at < len(words):
        phrases = _SAY_NOTHING.find(given, at)
        if not phrases:
            yield words[at]
        at = phrases[-1][0] if phrases else at + 1  # the longest is the last


def _kinds(word: str) -> tuple[str, ...]:
    """What a word has to leave in the tree, any of these; nothing for most words."""
    if word in _DENIALS:
        return (_DENIAL, word)
    if word in _ORDERS or word in ORDINALS:
        return (word, _ORDER)
    if word in _QUANTITIES or (word in NUMBERS and word != "one") or word.isdigit():
        return (word,)
    if word in _POSTURES:
        return _POSTURES[word]
    if is_descriptive(word) or word in LEVELS or word in STATES:
        return (_canonical(word),)
    return ()


def _canonical(word: str) -> str:
    plain = SIDES.get(word) or LEVELS.get(word) or STATES.get(word) or word
    return _ALIKE.get(plain, plain)


def _traces(node: object) -> Iterator[str]:
    """Every word that a tree keeps, and a word for what else it says."""
    if isinstance(node, str) and not isinstance(node, Enum):
        for word in node.split():
            yield word
            yield from {_canonical(word)} - {word}
    elif isinstance(node, Enum):
        yield from _traces(str(node.value))
    elif isinstance(node, tuple):
        for item in node:
            yield from _traces(item)
    elif isinstance(node, Struct):
        yield from _said(node)
        for field in node.__struct_fields__:
            if field not in ("text", "grouping"):
                yield from _traces(getattr(node, field))


def _all_but(nps: tuple[NounPhrase, ...]) -> bool:
    """Whether some are left out of what is spoken of."""
    return any(item.prep is Prep.EXCEPT for np in nps for item in np.modifiers)


def _said(node: object) -> Iterator[str]:
    """Words for what a node says by what it is."""
    match node:
        case Spoken(order=order, not_before=later) if order is not Order.SAID:
            yield from (_ORDER, *((_DENIAL, "only") if later else ()))
        case Condition(so=so, denied=denied, only=only):
            yield from ("only",) if only else ()
            yield from () if so and not denied else (_DENIAL,)
            yield from () if so else ("open", "closed")  # "…; if it is closed, …"
            yield from () if node.some is None else ("both", "all", "either", "any")
        case Modifier(words=words) if words == CLEARED:
            yield "empty"
        case Modifier(prep=prep, denied=denied):
            if denied or prep in (Prep.EXCEPT, Prep.CONTRAST):
                yield from (_DENIAL, "other")
            if prep in (Prep.MATCHING, Prep.COLORED):
                yield "another" if denied else "same"
        case NounPhrase(as_many_as=NounPhrase()):
            yield "same"
        case NounPhrase(without=without) if without:
            yield _DENIAL
        case RemoveClause(without=without, stacked=stacked):
            yield from ("empty", *((_DENIAL,) if without else ()))
            yield from ("another", "top") if stacked else ()
        case AvoidClause(avoid=avoid, things=things, needless=needless):
            yield from ("open", "closed") if needless else ()
            yield from ("only",) if things and _all_but(things.phrases) else ()
            yield from ("all", "every") if things is None else ()
            yield from (_DENIAL, "other", "any", "after", "afterwards")
            yield from ("empty",) if avoid is Avoid.PUT else ()
        case Beside(text=text) if across := _ACROSS.search(text):
            yield across[1]
        case Beside(relation=Nearby.AWAY, text=text) if side := _FROM_ITS_SIDE.match(text):
            yield from side[1].split()
        case Beside(relation=Nearby.AWAY, text=text) if _DOES_NOT.match(text):
            yield _DENIAL
        case Beside(relation=Nearby.AWAY | Nearby.AT_LEFT | Nearby.AT_RIGHT):
            yield _canonical("far")
        case Beside(relation=Nearby.AT_FRONT | Nearby.AT_BACK as side):
            yield "bottom" if side is Nearby.AT_FRONT else "top"
        case PutGroup(stance=stance) | ReorientClause(stance=stance) if stance is not None:
            yield _SAID_OF_STANCE[stance]
            yield from (_DENIAL,) if isinstance(node, ReorientClause) else ()  # "not tilted"
        case ReorientClause(not_yet=True):
            yield "any"
        case ReorientClause(remark=remark) if "only" in remark.split():
            yield "only"  # it is noted
        case ReorientClause(meanwhile=True):  # "after rotating it"
            yield _ORDER
        case State(denied=True, subjects=subjects):
            yield from ("only",) if _all_but(subjects) else ()
            yield from ("open", "closed", "any", _DENIAL)
        case State(kept=kept, word=word, subjects=subjects, destinations=where, always=always):
            yield from ("all",) if always else ()
            yield from ("empty", "any", "other", _DENIAL) if node.alone else ()
            yield from ("either",) if has_choice(w for w in where if not w.denied) else ()
            each = len(subjects) > 1 or subjects[0].determiner.split()[:1] in (["both"], ["all"])
            yield from ("both", "each", "all") if each else ()
            yield from (_canonical(word), *((_DENIAL,) if kept else ()))
            if stance := stance_in(where):
                yield _SAID_OF_STANCE[stance]
        case MoveClause(opens=opens, guarded=guarded):
            yield "open" if opens else "closed"
            yield from ("open", "closed", _DENIAL) if guarded else ()
            yield from ("open", "all") if node.whatever_opened else ()
        case TowerClause(things=Things(phrases=phrases), not_at=denied):
            yield from (_DENIAL for _ in denied)
            yield from (said for said, count in NUMBERS.items() if count == len(phrases))
            yield from ("stacked", "vertical", _ORDER, "top", "middle", "bottom", "biggest",
                        "largest", "widest", "smallest")  # fmt: skip
        case PickClause(poses=poses) if poses:
            yield from _said_of_grasp(poses)
        case GraspClause(poses=poses):
            yield from (_DENIAL, *_said_of_grasp(poses))
        case Turns() if node != Turns():
            yield _ORDER
        case SwapClause():
            yield from ("other", "round")
        case AgainClause():
            yield "same"
        case Destination(toward=toward, denied=denied) if denied or toward is Toward.HOME:
            yield _DENIAL if denied else "back"
        case PutClause():
            yield from _said_of_put(node)
        case Things(phrases=phrases, either=either):
            counts = [NUMBERS.get(np.determiner.removeprefix("the "), 0) for np in phrases]
            if phrases[1:] and all(counts):
                # "Three cubes, two of them red", "two of the three cubes, one of them the red one"
                known = {sum(counts), *(np.among for np in phrases)}
                yield from (said for said, count in NUMBERS.items() if count in known)
            yield from ("either", "any", "both") if either else ()
            yield from ("both", "all", _ORDER) if len(phrases) > 1 else ()
        case _:
            return


def _said_of_grasp(poses: Sequence[GraspPose]) -> Iterator[str]:
    yield from ("either", "both") if len(poses) > 1 else ("only", _DENIAL)
    yield from ("upright", "top", *GraspPose)  # one may be ruled out by the other


def _said_of_put(clause: PutClause) -> Iterator[str]:
    again = len({group.things for group in clause.groups}) < len(clause.groups)
    if clause.one_each or clause.grouping is Grouping.SEPARATELY or again:
        yield from ("each", "every", "another")
    if clause.grouping is Grouping.TOGETHER:
        yield from ("same", "all")
    (first, *more) = clause.groups
    if more and all(group.destinations is first.destinations for group in more):
        yield from ("both", "all", _ORDER)  # one after the other to one place
    places = [target for group in clause.groups for item in group.destinations for target in
              (item.targets or (item,)) if not item.denied]  # fmt: skip
    if len(places) > 1 or clause.grouping is not Grouping.ANY:
        yield from ("either", "both", "any")

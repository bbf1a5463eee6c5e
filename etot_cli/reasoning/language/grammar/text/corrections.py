"""What a speaker takes back: "put the apple, no wait, the banana, in the bowl".

A text with such words is read only without what they take back, and only where what is said instead
has its one place there.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from msgspec import Struct

from etot_cli.reasoning.language.grammar.text.said_instead import (
    BEFORE_PLACES,
    BEFORE_THINGS,
    JOINTS,
    SETTING,
    also_told,
    called,
    in_its_stead,
    noun_of,
    object_of,
    other_than,
)
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    SIDES,
    is_descriptive,
    word_set,
)

_VERBS = VERB_WORDS - {"to"} | {"open", "shut", "empty"}
_GOES = word_set("go goes belong belongs should must has have needs need lives live")
"""Behind what is to be somewhere."""
_SEQUEL = word_set("first before then after afterwards last finally also too as")
"""With such a word a whole sentence takes back none."""
_NEXT = "|".join(sorted(BEFORE_THINGS))
_PLACES = "|".join(sorted(BEFORE_PLACES))
_SCRATCH = "(?:scratch|scrap|strike) that"
_AGAIN = f"i mean|i meant|{_SCRATCH}|make (?:that|it)(?= (?:{_NEXT}|{_PLACES}) )"
_ALONE = (
    "no|oops|correction|my mistake|(?:never mind|forget)(?: that| it)?|"
    "(?:wait|hold on|hang on)(?: a (?:second|sec|moment|minute))?"
)
_OH = "(?:oh|ah|actually|well|hm+),? "
_MARK = Expression(
    r"[\s,.!?;]{0,4}(?:\b(?:uh+m?|um+|erm*|hm+)\b[\s,.]+)?(?:"
    rf"\b(?:oh,? )?(?:no|sorry|wait),? (?:no|sorry|wait|{_AGAIN})\b"
    rf"|\b(?:i mean|i meant|or rather|or better|or no|{_SCRATCH}|on second thoughts?)\b"
    rf"|(?<=[,.!?;\n] )(?:{_OH})?(?:{_ALONE})(?=\s*[,.!?;\n])"
    r"|(?<=, )no(?= (?:the|my|your|in|on|into|onto|to) )"
    rf"|(?<=, )(?:sorry|actually|{_AGAIN})\b"
    rf"|(?<=[.!?;\n] )actually(?=,? (?:{'|'.join(sorted(_VERBS))}|the other way)\b)"
    # "Sorry, could you …" is but polite.
    rf"|(?<=[.!?;\n] )sorry(?=,? (?:{_NEXT}|{_PLACES}) )"
    rf"|(?<=[.!?;\n] )not(?= (?:the|that|those) [^,.:;!?]+, (?:{_NEXT}|{_PLACES}) )"
    rf")(?:[\s,]*\b(?:no|sorry|wait|actually|{_AGAIN})\b)*[\s,.!?;]*"
)
_NO_REASON = "|".join(sorted(BEFORE_THINGS | BEFORE_PLACES | _VERBS - {"'s", "not"}))
_REASON = Expression(
    r"(?P<so>(?:that|this|it|those|these|they)(?: ones?)? (?:is|are|was|were|'s)"
    rf"(?: the wrong ones?|(?: (?!(?:{_NO_REASON}) |(?:{_NO_REASON}),)[^\s,.!?;]+)+)),"
    rf" (?:(?:{_AGAIN}|sorry),? )*"
)
"""Why something is taken back ("the big bell, no, that one is broken, I mean the small one")."""
_REASON_BEHIND = Expression(
    r"(?:,| because| since| as) (?P<so>(?:the|that) (?P<what>\w+)(?: \w+)? (?:has an? \w+"
    r"|(?:is|are)(?: (?:already|still|almost|nearly|very))* (?:empty|full|broken|cracked|damaged"
    r"|defective|faulty|dirty|dry|wet|hot|cold|expired|rotten|missing|used(?: up)?|too \w+"
    r"|not (?:clean|empty|ready|needed))))[.!]*$"
)
"""Likewise, behind what is said instead."""
_NEARLY = Expression(
    r"^(?P<nearly>i (?:was|am) (?:just )?(?:going|about) to (?:say|suggest|ask (?:you )?for)"
    r"(?: ?:)? [^.:;!?]*?(?=,? but )|i said [^.:;!?]*?(?=,? (?:(?:but|no),? )?i meant?\b))"
    r",? (?:(?:but|no)(?: (?:actually|no|instead))?,? )?(?:i meant? )?"
    r"(?:(?P<why>(?:that|this|it)(?: one)? (?:is|has|was) (?!to\b)[^.:;!?,]*)[;,] )?"
)
"""What was nearly asked for, and what is asked for instead stands behind it."""
_NEARLY_NAMED = Expression(r" (?:say|said|suggest|for) (?:the|my) (?:\w+ ){1,2}(?P<noun>\w+)$")
_MEANT = Expression(r",? i mean(?:t|t to say)?(?=[.!?;]*$)")
"""At the very end it says again what an earlier word said ("no, in the box, I mean")."""
_ALL_OF_IT = Expression(rf"\b(?:never mind|forget|{_SCRATCH}|on second thoughts?)\b")
"""What takes back a whole clause, whatever comes in its place."""
_POINTING = {"that": "it", "this": "it", "those": "them", "these": "them"}
_PRONOUNS = word_set("it them that this those these one there")
_LEFT = frozenset({"leave", "keep"})
_AS_IT_IS = ("where it is", "where they are", "as it is", "as they are", "alone", "be")
"""Behind "leave it": nothing is done with what something was to be done with."""
_OPPOSITES = {"open": ("closed", "shut"), "close": ("open",), "shut": ("open",)}
"""How something is left that is not to be opened, or closed, after all."""
_ONE_AT_A_SIDE = re.compile(
    rf"the one (?:on|at|in) the (?P<side>{'|'.join(sorted({*SIDES, *LEVELS}))})$"
)
_ONE = (("one",), ("ones",))
_SWAPPED = ("the other way around", "the other way round", "vice versa", "the reverse")
MOST_WAYS = 5
"""Phrases that may be taken back at once; of more nobody knows which one is."""
_TOKEN = re.compile(r"\d+\.\d+|[^\s,.!?;]+|[,.!?;\n]")
_ENDS = frozenset(".!?;\n")


class TakenBack(Struct, frozen=True):
    """A way to understand what is taken back: the words, what is said in their place, and all of
    the text without them.
    """

    words: str
    instead: str
    text: str
    alike: bool = False
    """Both are called the same ("the red car", "the blue car")."""


def mark_in(text: str) -> re.Match[str] | None:
    """The first words of a normalized text that take something back."""
    if nearly := _NEARLY.match(text):
        return nearly
    found = _MARK.search(text, 1)
    while found and _of_the_same(text, found):
        found = _MARK.search(text, found.end())
    known = found and (found.end() < len(text) or _ALL_OF_IT.search(found[0]))
    return found if found and known and found.start() else None


def _of_the_same(text: str, mark: re.Match[str]) -> bool:
    """Whether a mark stands between the same word twice, which leaves it open ("nut or no nut")."""
    before, after = text[: mark.start()].split()[-1:], text[mark.end() :].split()[:1]
    alike = [word.strip(",.!?;") for word in (*before, *after)]
    return mark[0].split() == ["or", "no"] and alike[0] == alike[-1]


def taken_back(text: str, mark: re.Match[str]) -> Iterator[TakenBack]:
    """All ways to understand what is taken back; none where more than one thing is."""
    if nearly := mark.groupdict().get("nearly"):
        asked = text[mark.end() :]
        if named := _NEARLY_NAMED.search(nearly):  # "I said the left jar, I meant the right one"
            asked = re.sub(r"^(the [^.,;:!?]*)\. (\w+) it\b", r"\2 \1", asked)
            asked = re.sub(r"^([^.,;:!?]*?\bthe \w+) one\b", rf"\1 {named['noun']}", asked)
        if mark["why"]:
            nearly = f"{nearly}, {mark['why']}"
        yield TakenBack(nearly, asked.rstrip(".!"), asked)
        return
    text = _MEANT.sub("", text) if _MEANT.search(text, mark.end()) else text
    why = _REASON.match(text[mark.end() :])
    begin = mark.end() + (why.end() if why else 0)
    behind = _REASON_BEHIND.search(text, begin)
    if behind and not why and behind["what"] in text[: mark.start()].split():
        why, text = behind, text[: behind.start()]  # "No, the yellow one, the blue is empty"
    if _MARK.search(text, begin) or begin == len(text):
        return
    before, after = (tuple(_TOKEN.findall(part)) for part in (text[: mark.start()], text[begin:]))
    if mark[0].endswith("not "):
        after = ("not", *after)
    denied = frozenset[str]()
    if (
        after[:1] == ("not",)
        and "," in after
        and {*after[1 : after.index(",")]} <= {*before, "one", "ones"}
    ):
        # "The car, no wait, not the car, the ball"
        denied = frozenset(after[1 : after.index(",")]) - BEFORE_THINGS - {"one", "ones"}
        after = after[after.index(",") + 1 :]
    chosen = after[:1] in (("just",), ("only",))  # of the things, not another place
    while after[:1] in (("just",), ("only",), ("please",), ("rather",), ("instead",)):
        after = after[1:]
    start = max((at + 1 for at, token in enumerate(before) if token in _ENDS), default=0)
    stop = next((at for at, token in enumerate(after) if token in _ENDS), len(after))
    end = after.index(",") if "," in after[:stop] else stop
    tail, said, rest = before[start:], after[:end], after[end:]
    if not said:
        return
    if sided := _ONE_AT_A_SIDE.match(" ".join(said)):
        said = ("the", sided["side"], "one")
    several = chosen or (JOINTS & {*said} and said[0] in BEFORE_THINGS)
    if (several and JOINTS & {*tail}) or (said[1:2] in _ONE and {*said[2:3]} & BEFORE_PLACES):
        return  # "the ball and the car, no, just the car"; "on the mat, no, the one by the cup"
    if said[0] in _LEFT and {*said[1:2]} & {*_POINTING}:
        more = said[3:] if said[2:3] in (("one",), ("ones",)) else said[2:]
        left = " ".join(more).startswith(_AS_IT_IS)
        said = (said[0], _POINTING[said[1]], *more) if left else said
    if said[0] == "use":
        said = ("take", *said[1:])
    if said[1:2] in (("it",), ("them",)) and {*said[:1]} & SETTING and {*said[2:3]} & BEFORE_PLACES:
        said = said[2:]  # "on the tray. Actually, put it in the box"
    if {*said} <= {*SIDES} and not {*tail} & {*SIDES}:
        return  # "on the plate, no, left": of it, or of the desk?
    sentence = after[:stop]
    everything = bool(_ALL_OF_IT.search(mark[0]))
    whole = not start and (everything or "instead" in sentence)
    if " ".join(said).removeprefix("do it ") in _SWAPPED:
        for exchanged in _exchanged(tail):
            text = _joined(*before[:start], *exchanged, *rest)
            yield TakenBack(" ".join(tail), " ".join(exchanged), text)
        return
    if said[:1] == ("not",):
        # "Not the pen; put it on the tray"
        for fewer in () if _PRONOUNS & {*rest} else _without(tail, said[1:]):
            text = _joined(*before[:start], *fewer, *rest)
            yield TakenBack(" ".join(said[1:]), " ".join(said), text)
        return
    spans = [
        span
        for span in _spans(tail, said, sentence, everything=everything, whole=whole)
        if denied <= {*tail[slice(*span)]}
        and not (chosen and {*tail[max(span[0] - 1, 0) : span[0]]} & BEFORE_PLACES)
    ]
    if said[-1] in ("one", "ones") and said[1:-1] not in ((), ("other",)):
        # "The black pen in the tray, I mean the blue one" contrasts what has such a word, too.
        plain = not any(
            map(is_descriptive, said)
        )  # "the steel ball in the box, no, the rubber one"
        phrases = [(span, tail[slice(*span)]) for span in spans]
        told = [span for span, np in phrases if plain and len({*np} - BEFORE_THINGS) > 1]
        told += [span for span, np in phrases if not plain and any(map(is_descriptive, np))]
        spans = told or spans
    if said[0] in BEFORE_THINGS:
        # "The cake on the white plate, no, the other plate"
        alike = [s for s in spans if said[-1] in ("one", noun_of(tail[s[0] : s[1]]))]
        # "On the upper board of the shelf, no, the lower board"
        whose = [s for s in spans if tail[s[0] - 1] == "of" and any(a[0] < s[0] for a in alike)]
        spans = alike if "other" in said else [s for s in spans if s not in whose]
    for first, last in spans if len(spans) <= MOST_WAYS else ():
        taken, kept = tail[first:last], tail[last:]
        further = {*rest[1:2]} & {"and", "then", *VERB_WORDS}
        if kept and rest[:1] == (",",) and not further:
            continue  # "the apple in the bowl, no, the banana, in the box"
        noun = said[-1] in ("one", "ones") and len(said) > 1
        # "The green tray, no, the left one": the left green one, or the left of all trays?
        besides = dict.fromkeys((also_told(taken, said), ())) if noun else ()
        ways = [(*said[:-1], *one, *called(taken, said)) for one in besides] or [said]
        if said[-1] == "instead":
            ways = [*in_its_stead(taken, said[:-1])]
        for new in ways:
            instead = _settled(taken, new)
            for more in dict.fromkeys((rest, rest[rest[:1] == (",",) and not kept :])):
                words = _joined(*before[:start], *tail[:first], *instead, *kept, *more)
                same = said[0] in BEFORE_THINGS and noun_of(taken) == said[-1]
                gone = _joined(*taken, *(f", {why['so']}".split() if why else ()))
                yield TakenBack(gone, " ".join(instead), words, same)


def _settled(taken: Sequence[str], new: tuple[str, ...]) -> tuple[str, ...]:
    """What is said instead, without pronouns for what is taken back."""
    mark_at = next((at for at, word in enumerate(taken) if word in BEFORE_THINGS), len(taken))
    if new[-1] == "it" and _is_place(new):  # "on the tray, no, next to it"
        new = (*new[:-1], *taken[mark_at:])
    new = other_than(taken[mark_at:], new)
    if new[0] in _LEFT and new[1:2] in (("it",), ("them",)):
        new = (new[0], *(object_of(taken) or new[1:2]), *new[2:])
    return new


def _is_place(said: Sequence[str]) -> bool:
    """Whether words say where something goes; "left" and "right" do by what they are of."""
    return said[0] in BEFORE_PLACES or (said[0] in ("left", "right") and said[1:2] == ("of",))


def _joined(*words: str) -> str:
    """Words and marks as text."""
    return re.sub(r" (?=[,.!?;])", "", " ".join(words))


def _exchanged(tail: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """A request for two things that go to two places, each to the other one's place; for one of two
    things alike that goes to the other one, the other one to it.
    """
    joints = [at for at, word in enumerate(tail) if word in JOINTS]
    begin = next((at for at, word in enumerate(tail) if word in BEFORE_THINGS), len(tail))
    begin = begin if {*tail[:begin]} & _VERBS else 0  # "red car on the blue one"
    where = [at for at, word in enumerate(tail) if at > begin and word in BEFORE_PLACES]
    if len(where) == 1 and not joints:
        (at,) = where
        goes = next((it for it, word in enumerate(tail[:at]) if it and word in _GOES), at)
        one, other = tail[begin:goes], tail[at + 1 :]
        noun = noun_of(one)
        # No two things: a cup that goes on a plate "the other way round" may be upside down.
        if other[:1] and other[0] in BEFORE_THINGS and other[-1] in ("one", noun):
            yield (*tail[:begin], *other[:-1], noun, *tail[goes : at + 1], *one)
        return
    if len(joints) != 1 or len(where) != 2 or tail[joints[0]] != "and":
        return
    (joint,), (first, second) = joints, where
    if begin and first < joint < second and tail[joint + 1] in BEFORE_THINGS:
        one, other = tail[begin:first], tail[joint + 1 : second]
        yield (*tail[:begin], *other, *tail[first : joint + 1], *one, *tail[second:])


def _without(tail: Sequence[str], named: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """A request without one of several things, and with where that goes, if that is its own."""
    size = len(named)
    at = [n for n in range(len(tail)) if tuple(tail[n : n + size]) == tuple(named)]
    if len(at) != 1 or (named[:1] and named[0] not in BEFORE_THINGS):
        return
    (begin,), end = at, at[0] + size
    if tail[begin - 1] in ("and", ","):
        if any(word in BEFORE_PLACES for word in tail[1:begin]):
            # "The cup in the box and the jar too", "… and the jar on the tray"
            end = next((n for n in range(end, len(tail)) if tail[n] in JOINTS), len(tail))
        begin -= 2 if tail[begin - 2 : begin] == (",", "and") else 1
        yield (*tail[:begin], *tail[end:])
    elif {*tail[end : end + 1]} & {"and", ","} and {*tail[end + 1 : end + 2]} & BEFORE_THINGS:
        yield (*tail[:begin], *tail[end + 1 :])


def _spans(
    tail: Sequence[str],
    said: Sequence[str],
    sentence: Sequence[str],
    *,
    everything: bool,
    whole: bool,
) -> Iterator[tuple[int, int]]:
    """The words of the same sort as what is said instead.

    Args:
        tail: the sentence that something of is taken back.
        said: what is said instead.
        sentence: with what follows it.
        everything: ``tail`` is taken back, as much as it asks for.
        whole: that may have another verb than what is said instead.
    """
    size = len(tail)
    joints = [at for at, word in enumerate(tail) if word in JOINTS]
    where = [at for at, word in enumerate(tail) if at and word in BEFORE_PLACES]
    things = [
        at
        for at, word in enumerate(tail)
        if word in BEFORE_THINGS and tail[at + 1 : at + 3] != ("robot", "'s")
    ]
    goes = [at for at, word in enumerate(tail) if at and word in _GOES]
    bare = where[:1] and not {*tail[: where[0]]} & (_VERBS | JOINTS | BEFORE_THINGS)
    if tail and (is_descriptive(tail[0]) or bare or (goes[:1] == [1] and 0 not in things)):
        things.insert(0, 0)  # "black pen in the tray", "tools go in the tray", "pen in the tray"
    begin = said[0]
    if begin in _VERBS:
        clauses = (0, *(at + 1 for at in joints))
        how = " ".join(said[2:]) if begin in _LEFT and said[1:2] in (("it",), ("them",)) else ""
        undone = any(f"{how} ".startswith(f"{so} ") for so in _AS_IT_IS) and not joints
        alone = {*said[3:4]} <= JOINTS
        if undone or (how and alone and said[2] in _OPPOSITES.get(tail[clauses[-1]], ())):
            yield (clauses[-1], size)
            return
        for at in () if _SEQUEL & {*sentence} else clauses:
            # "Put the cup on the tray and the jar on the mat. No, put …": either of them, or both?
            one = everything or not JOINTS & {*tail[at:]}
            alike = tail[at : at + 1] == (begin,) and "instead" not in sentence
            other = whole and (everything or not joints) and _VERBS & {*tail[at : at + 1]}
            if one and (alike or other):
                yield (at, size)
    elif _is_place(said):
        yield from (
            (at, size)
            for at in where
            if tail[at - 1] not in BEFORE_PLACES and at > max(joints, default=0)
        )
    elif begin in BEFORE_THINGS and BEFORE_PLACES & {*said}:
        named = said[: min(at for at, word in enumerate(said) if word in BEFORE_PLACES)]
        again = [at for at in things if tail[at : at + len(named)] == named]
        for at in again if joints else things:
            # "The pen in the cup and the nut in the box, or rather, the nut in the tray"
            yield (at, min((end for end in joints if end > at), default=size))
    elif begin in BEFORE_THINGS:
        for at in things:
            yield (at, min((end for end in (*where, *joints, *goes) if end > at), default=size))
    elif is_descriptive(begin) or things[-1:] != [size - 1]:
        yield (size - 1, size)
        yield from ((at + 1, size) for at in things[-1:] if at + 1 < size - 1)

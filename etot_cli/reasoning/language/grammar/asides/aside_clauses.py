"""Sentences cut into clauses, of which some may be asides, with what each begins with."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from itertools import takewhile

from msgspec import Struct
from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.asides.left_open import is_left_open, leaves_choice
from etot_cli.reasoning.language.grammar.asides.mishaps import (
    BEFORE_IT_DOES,
    BY_ITSELF,
    THING_WILL,
)
from etot_cli.reasoning.language.grammar.asides.people import ON_ARRIVAL, PEOPLE
from etot_cli.reasoning.language.grammar.asides.where_needed import done_where_needed
from etot_cli.reasoning.language.grammar.text.splitting import COMMA
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.fillers import ANY_ONE, WITHOUT_MEANING
from etot_cli.reasoning.language.words.frames import ANNOUNCED, GREETINGS, TIDYING
from etot_cli.reasoning.language.words.known import VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import NUMBERS, word_set
from etot_cli.reasoning.language.words.patterns import Begun

_DOING = "|".join(sorted(VERB_WORDS | {"open", "close", "shut"}))
_SOME_TIME = (
    rf"(?:{'|'.join(sorted(NUMBERS))}|noon|midnight|\w+day|breakfast|lunch|dinner|last \w+"
    r"|(?:the )?(?:spring|summer|autumn|winter|morning|weekend|holidays?|christmas|easter))"
    rf"(?: o 'clock)?(?:$| {COMMA})"
)
_WITHIN = Expression(
    r"(?:(?P<provided>(?:just )?(?:as|so) long as|provided(?: that)?)\b"
    rf"|(?P<reason>because|since(?! {_SOME_TIME})|now that|given that|seeing (?:as|that)"
    r"|considering that|although|even though|even if|in case"
    rf"|as(?= (?:{PEOPLE}|it) )(?! it is\b| you found\b))\b"
    rf"|(?P<purpose>so that|so|where|before(?= {PEOPLE} )|or else"
    r"|before(?= (?:the|my|our) (?:\w+ ){1,2}(?:arrives?|comes?|starts?|begins?|leaves?)\b)"
    rf"|before(?= {BEFORE_IT_DOES}(?:$| {COMMA}))|or(?= (?:{PEOPLE}|it|they) \w+)"
    rf"|or(?= (?:{THING_WILL}(?:$| {COMMA})|(?:the|my|our) \w+ (?:will|might|may) (?!be\b)\w+)))\b"
    r"|(?P<plain>(?:and|but|without)"
    r"(?= (?:only|do not|you|feel free|leave|move|take|touch|moving|taking|touching)\b"
    r"[^~]* (?:if|unless|when) )"
    r"|and(?= (?:it|there|(?:no|any|some)thing|(?:the|this|my|our) (?:\w+ )?\w+) "
    rf"(?:is|was|will|has|does)\b| there are\b| (?!you\b){PEOPLE} ))\b"
    r"|(?P<meanwhile>while(?= (?:i|we|my|our)\b))\b"
    r"|(?P<polite>if (?:you (?:do not|would not) mind|i may|(?:it|that) is (?:all right|alright"
    r"|ok|okay|fine|possible|not? (?:too much )?(?:to ask|trouble|bother))))\b"
    rf"|(?P<benefit>to(?= {BY_ITSELF}(?:$| {COMMA}| and\b))"
    r"|for(?= later\b| (?!\w*thing)\w+ing\b| (?:lunch|dinner|tea|play|bed)\w* ?time"
    rf"| (?:tonight|tomorrow|now|the (?:night|day|weekend|time being|moment))\b| when {PEOPLE}\b"
    rf"| (?!me\b|us\b|you\b)(?:him|her|{PEOPLE})(?: {ON_ARRIVAL})?(?:$| {COMMA}| who\b"
    rf"| and (?:\w+ )?(?:{_DOING})\b)))\b)"
)
"""Words that a clause begins with wherever they stand."""
_GOES_ON = Expression(r"(?P<plain>and)\b")
"""Behind whom something is for ("get the tape for my sister and put it down")."""
_AHEAD = Expression(
    r"(?:(?P<reason>what with|as"
    r"(?! (?:\w+ as|soon|long|far|well|much|if|it is|they are|seen|viewed|looked|before)\b)"
    r"|as(?= (?:it is|they are) (?:going|\w+ing|not|so|too|very|rather|quite|getting)\b)|though)\b"
    r"|(?P<comment>which|who)\b|(?P<purpose>otherwise)\b"
    r"|(?P<plain>and so|and|but|(?:and )?that is why|therefore|hence)\b)"
)
"""Words that one begins with behind a comma, or as the first of a sentence."""


@cache
def _nothing_said() -> Begun:
    """What asks for nothing; its spellings are too many to be written out."""
    nothing = f"{WITHOUT_MEANING}, {TIDYING}, {ANY_ONE}, {ANNOUNCED}"
    return Begun.of({"wherever": nothing, "outside": GREETINGS})


def says_nothing(said: str, *, outside: bool = True) -> bool:
    """Whether a sentence or clause asks for nothing; "er" does only ``outside`` what is asked for,
    within which it takes something back.
    """
    words = said.replace(",", f" {COMMA}").split()
    for row in (words, [COMMA, *words]):
        at: Begun | None = _nothing_said()
        for word in row:
            at = at and at.following.get(word)
        if words and at and at.values and (outside or "wherever" in at.values):
            return True
    return False


_BEFORE = {
    "for": word_set("not"),
    "so": word_set("is are was were am not feel feels look looks get gets got"),
    "where": word_set("is care mind matter difference important goes go which"),
}
"""Words behind which others begin no clause ("my hands are so dry", "that is where I like it")."""
GRANTED = ("make sure that", "but not")
"""In place of "as long as", where that asks for something."""
_OF_ANY = Expression(r"\b(?:any|either|whichever|one of|an?) (?:\w+ ){0,3}\w+$")
_OTHER_THAN = Expression(r"it is not (?P<one>(?:the|my|our) (?:\w+ ){0,3}\w+)$")


_IN_THE_END = Expression(
    r"(?:\bends? up\b|^(?:neither|none|nothing|no \w+) [^~]*\b(?:stays?|remains?|is left)\b)"
)
"""Of what is to be so when all is done, and was not before."""
_STANDING = Expression(
    r"(?:it|they|(?:the|my|our) (?:\w+ ){1,3})\s?(?:do|does|will) not "
    r"(?:(?:fall|tip|topple)(?: over)?|get knocked over)$"
)
"""Of what is to stand when all is done."""
_LASTING = (["keep"], ["hold"], ["leave"], ["wait"])
"""What is done for a time rather than in a case."""


class Clause(Struct, frozen=True):
    """A piece of a sentence.

    ``comma``: one stands before it. ``joint``: what it begins with, of some ``kind``.
    """

    comma: bool
    kind: str
    joint: str
    said: str

    @property
    def text(self) -> str:
        """As it stands."""
        return " ".join(filter(None, (COMMA * self.comma, self.joint, self.said)))

    @property
    def full(self) -> str:
        """Without the comma."""
        return f"{self.joint} {self.said}".strip()

    @property
    def whole(self) -> str:
        """The clause with the joint that belongs to it."""
        return self.said if self.kind == "plain" else self.full

    @property
    def is_polite(self) -> bool:
        """Whether there is nothing to be told in it."""
        return self.kind in ("polite", "greeting") or says_nothing(self.full, outside=False)


def clauses_of(sentence: str) -> list[Clause]:
    """The clauses of a sentence: what is asked for by "as long as", and what is done anyway."""
    clauses = list(_with_what_is_done(list(_clauses(sentence))))
    for ends in (range(len(clauses)), reversed(range(len(clauses)))):
        for at in takewhile(lambda end: says_nothing(clauses[end].full), ends):
            clauses[at] = replace(clauses[at], kind="greeting")
    return [_asked_for(clauses, at) for at in range(len(clauses))]


def _clauses(sentence: str) -> Iterator[Clause]:
    """The pieces of a sentence."""
    words = sentence.split()
    comma, kind, joint, said = False, "", "", list[str]()
    at = 0
    while at < len(words):
        mark = words[at] == COMMA
        ahead = " ".join(words[at + mark :])
        begun = mark or at == 0
        found = _WITHIN.match(ahead) or (_AHEAD.match(ahead) if begun else None)
        if kind == "benefit" and words[at] == "and":
            found = _GOES_ON.match(ahead)
        if found and found[0] == "who" and not mark:
            found = None  # a question
        if found and kind == "reason" and found.lastgroup == "benefit" and not mark:
            found = None  # "because she needs it for painting"
        if found and not begun and kind != "benefit":
            to_me = found[0] == "where" and words[at - 2 : at] == ["to", "me"]
            found = None if to_me or words[at - 1] in _BEFORE.get(found[0], ()) else found
        if (mark or found) and (said or joint):
            yield Clause(comma, kind, joint, " ".join(said))
            comma, kind, joint, said = mark, "", "", []
        if found:
            kind, joint = str(found.lastgroup), found[0]
            at += mark + len(joint.split())
        else:
            said += [] if mark else [words[at]]
            at += 1
    yield Clause(comma, kind, joint, " ".join(said))


def _with_what_is_done(clauses: Sequence[Clause]) -> Iterator[Clause]:
    """Clauses, those of them in one that call for what is done without them."""
    at = 0
    while at < len(clauses):
        count = done_where_needed([item.said for item in clauses[at:]])
        said = f" {COMMA} ".join(item.said for item in clauses[at : at + count])
        yield replace(clauses[at], kind="anyway", said=said) if count else clauses[at]
        at += count or 1


def _asked_for(clauses: Sequence[Clause], at: int) -> Clause:
    """What is asked for by "as long as" where all else is left open; else the clause as it is."""
    clause = clauses[at]
    if clause.kind != "provided" or len(clauses) < 2:
        return clause
    if not at:  # "As long as it is open, I don't care where the cup goes"
        granted = is_left_open(clauses[1].whole)
        return replace(clause, kind="", joint=GRANTED[0]) if granted else clause
    denied = _OTHER_THAN.match(clause.said)
    if denied and _OF_ANY.search(clauses[at - 1].said):
        return replace(clause, kind="", joint=GRANTED[1], said=denied["one"])
    lasting = clauses[0].said.split()[:1] in _LASTING
    granted = leaves_choice(clauses[at - 1].whole) or (
        bool(_IN_THE_END.search(clause.said) or _STANDING.match(clause.said)) and not lasting
    )
    return replace(clause, comma=True, kind="", joint=GRANTED[0]) if granted else clause

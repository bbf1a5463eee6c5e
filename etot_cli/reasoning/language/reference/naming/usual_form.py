"""Noun phrases put in their usual form, and phrases for the robot itself."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.naming.determiners import is_distributive, quantity_of
from etot_cli.reasoning.language.reference.naming.of_phrases import packed, without_of
from etot_cli.reasoning.language.words.categories import MASS_NOUNS
from etot_cli.reasoning.language.words.lexicon import (
    COMMON_NOUNS,
    LEVELS,
    NUMBERS,
    ORDINALS,
    PAIRED,
    SIDES,
    SIZES,
    is_descriptive,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep

ROBOT_NOUNS = ("robot", "arm", "gripper", "hand", "base", "you", "me")
GENERAL = {
    "everything": "all", "anything": "any", "something": "a", "everything else": "all other",
    "all else": "all other",
}  # fmt: skip
"""Determiners that nouns for anything stand for."""
_OTHERS = frozenset(
    {"the rest", "the others", "the other ones", "all others", "all the others", "all the rest"}
)
"""The others of what was spoken of before."""

_WHERE = (Prep.FROM, Prep.IN, Prep.ON)
_AROUND = (Prep.WITH, Prep.CONTAINING, Prep.BEARING)
_TOLD_BY_ITSELF = {
    **dict.fromkeys(_WHERE, _AROUND),
    **dict.fromkeys((Prep.EXCEPT, Prep.CONTRAST), _WHERE),
}
"""By what a thing is told, where "it" behind that may be the thing itself: "the pen in the cup with
it", "the cup, but not the pen in it".
"""
_LIKE_THAT = frozenset({"colored", "coloured", "shaped"})
"""Behind a word for a colour or shape they say nothing more."""
_EACH_OF = [["each", "of", "the"], ["every", "one", "of", "the"], ["both", "of", "the"]]


def _is_utmost(word: str) -> bool:
    """Whether a word tells those of some things that are so more than the others."""
    return word.endswith(("est", "most")) and (word in SIZES or word in SIDES)


def is_robot(phrase: NounPhrase) -> bool:
    """Whether a phrase means the robot itself, as a landmark."""
    number = phrase.determiner.split()[-1:]
    return phrase.words[-1:] in [(noun,) for noun in ROBOT_NOUNS] and (
        len(phrase.words) == 1 and number not in (["one"], ["two"], ["both"])
    )


def how_many_out(modifier: Modifier) -> int | None:
    """How many are left out of some things ("all but one"), whichever; None where it is said which
    these are.
    """
    (item, *more) = modifier.phrases or (NounPhrase(),)
    number = NUMBERS.get((item.determiner.split() or [""])[0])
    said = modifier.prep is Prep.EXCEPT and not (more or modifier.denied)
    return number if said else None


def usual_form(phrase: NounPhrase) -> NounPhrase:
    """The phrase in the usual form: "the bigger of the mugs" is the bigger mug.

    Raises:
        ReferenceProblem: a phrase that has none ("each two cups", "the bigger of the mug").
    """
    if phrase.head in GENERAL and len(phrase.words) == 1:
        return _in_general(phrase)
    for rewritten in _REWRITINGS:
        plainer = rewritten(phrase)
        if plainer is not None:
            return usual_form(plainer)
    return without_of(_with_its_noun(phrase)) if phrase.words else phrase


def _in_general(phrase: NounPhrase) -> NounPhrase:
    """All objects for "everything", whatever is so for "anything" that is so."""
    determiner = GENERAL[phrase.head]
    if phrase.head == "anything" and phrase.modifiers:
        determiner = "all"
    words = ("objects",) if determiner.startswith("all") else ("object",)
    return replace(phrase, determiner=determiner, words=words)


def _colored_like_that(phrase: NounPhrase) -> NounPhrase | None:
    """As in "the lime coloured ball", "the cup shaped holder"."""
    if not {*phrase.words[1:-1]} & _LIKE_THAT:
        return None
    return replace(phrase, words=tuple(word for word in phrase.words if word not in _LIKE_THAT))


def _counted_from_a_side(phrase: NounPhrase) -> NounPhrase | None:
    """As in "the drawer second from the top"."""
    for item in phrase.modifiers:
        if item.prep is Prep.SIDE and item.words[0] in ORDINALS and phrase.words:
            side = replace(item, words=item.words[1:])
            words = (*phrase.words[:-1], item.words[0], phrase.words[-1])
            modifiers = tuple(side if one is item else one for one in phrase.modifiers)
            return replace(phrase, words=words, modifiers=modifiers)
    return None


def _of_a_number(phrase: NounPhrase) -> NounPhrase | None:
    """As in "either one of the two cups", "each of the two biggest cups" of maybe more."""
    if is_distributive(phrase.determiner) and any(
        NUMBERS.get(w, 1) > 1 for w in phrase.words[1:-1]
    ):
        raise ReferenceProblem(phrase.text, "name them one by one", 3)
    counted = phrase.words[1:] and NUMBERS.get(phrase.words[0], 1) > 1
    if counted and phrase.determiner.endswith((" of the", " of these", " of those", " of my")):
        determiner = f"{phrase.determiner} {phrase.words[0]}"
        return replace(phrase, determiner=determiner, words=phrase.words[1:])
    *each, number = phrase.determiner.split() or [""]
    if each in _EACH_OF and number in NUMBERS and any(map(_is_utmost, phrase.words[:-1])):
        return replace(phrase, determiner=f"all {number}")
    return None


def _of_a_mass(phrase: NounPhrase) -> NounPhrase | None:
    """As in "the leftmost fruit", which is one."""
    mass = phrase.head in MASS_NOUNS and phrase.determiner == "the" and _compares(phrase)
    return replace(phrase, determiner="the 1") if mass else None


def the_others(phrase: NounPhrase) -> NounPhrase | None:
    """As in "the rest of the red cups", which are all other red cups."""
    if phrase.head not in _OTHERS or len(phrase.words) > 1:
        return None
    left = replace(phrase, determiner="all other", words=())
    of = next((m for m in phrase.modifiers if m.prep is Prep.OF and m.phrases[0].words), None)
    if of is None:
        return left
    (whole, *_) = of.phrases
    modifiers = (*whole.modifiers, *left.without_modifier(of).modifiers)
    return replace(left, words=whole.words, modifiers=modifiers, without=whole.without)


def _no_more_than(phrase: NounPhrase) -> NounPhrase | None:
    """As in "only the cups", "a pair of socks", which is one thing."""
    if phrase.determiner.startswith("only "):
        return replace(phrase, determiner=phrase.determiner.removeprefix("only "))
    one = phrase.determiner == "a pair of" and phrase.head in PAIRED
    return replace(phrase, determiner="a") if one else None


def _all_but(phrase: NounPhrase) -> NounPhrase | None:
    """As in "all but one of the red cups on the tray": of the red cups there all but one."""
    out = _left_out_of(phrase)
    if phrase.head or out is None or not out.phrases[0].words:
        return None
    (left_out, *_) = out.phrases
    head = left_out.words[-1]
    plural = head if singular(head) != head else f"{head}s"
    if how_many_out(out) is None:
        return replace(phrase, words=(plural,))
    bare = replace(out, phrases=(NounPhrase(left_out.determiner, text=left_out.text),))
    modifiers = (*left_out.modifiers, *(bare if m is out else m for m in phrase.modifiers))
    return replace(phrase, words=(*left_out.words[:-1], plural), modifiers=modifiers)


def _at_one_end(phrase: NounPhrase) -> NounPhrase | None:
    """As in "the top two drawers", which are the two at the top."""
    first = phrase.words[0] if phrase.words else ""
    several = (quantity_of(phrase.determiner).count or 1) > 1
    if not (several and LEVELS.get(first) in ("top", "bottom") and len(phrase.words) > 1):
        return None
    aside = Modifier(Prep.SIDE, words=(LEVELS[first],))
    return replace(phrase, words=phrase.words[1:], modifiers=(aside, *phrase.modifiers))


_REWRITINGS = (
    _colored_like_that,
    _counted_from_a_side,
    _of_a_number,
    _of_a_mass,
    the_others,
    _no_more_than,
    _all_but,
    packed,
    _at_one_end,
)
"""Each makes a phrase plainer, where it says something of it; the first that does counts."""


def _left_out_of(phrase: NounPhrase) -> Modifier | None:
    return next((item for item in phrase.modifiers if item.prep is Prep.EXCEPT), None)


def _with_its_noun(phrase: NounPhrase) -> NounPhrase:
    """What is left out has the noun, too ("the drawers except those of the chest")."""
    out = _left_out_of(phrase)
    if out is None:
        return phrase
    named = replace(out, phrases=tuple(_named(item, phrase.head) for item in out.phrases))
    modifiers = tuple(named if item is out else item for item in phrase.modifiers)
    return replace(phrase, modifiers=modifiers)


def around_itself(phrase: NounPhrase) -> NounPhrase:
    """A phrase that tells where its thing is by what holds "it", or leaves out what is in or on
    "it", with its own words for that.
    """
    pronouns = ("it",) if singular(phrase.head) == phrase.head else ("they", "them")
    itself = replace(phrase, modifiers=())

    def named(np: NounPhrase) -> NounPhrase:
        return replace(itself, text=np.text) if np.pronoun in pronouns else np

    def inner(np: NounPhrase, preps: tuple[Prep, ...]) -> NounPhrase:
        told = (
            replace(item, phrases=tuple(map(named, item.phrases))) if item.prep in preps else item
            for item in np.modifiers
        )
        return replace(np, modifiers=tuple(told))

    modifiers = (
        replace(item, phrases=tuple(inner(np, _TOLD_BY_ITSELF[item.prep]) for np in item.phrases))
        if item.prep in _TOLD_BY_ITSELF
        else item
        for item in phrase.modifiers
    )
    return replace(phrase, modifiers=tuple(modifiers)) if phrase.words else phrase


def _compares(phrase: NounPhrase) -> bool:
    """Whether one of several things is told by comparing them ("the fruit that is larger")."""
    told = (m.words for m in phrase.modifiers if m.prep is Prep.QUALITY and not m.denied)
    compared = any(word in SIZES and word.endswith(("er", "est")) for said in told for word in said)
    return compared or phrase.words[0].endswith(("most", "est"))


def _named(phrase: NounPhrase, noun: str) -> NounPhrase:
    """What is left out with the noun of what it is left out of ("except those of the chest")."""
    if not phrase.pronoun or not phrase.modifiers:
        return phrase
    determiner = "the" if phrase.pronoun in ("that", "this") else "all"
    return replace(phrase, pronoun="", words=(noun,), determiner=determiner)


def leaves_noun_out(phrase: NounPhrase) -> bool:
    """Whether a phrase has but adjectives ("on the middle board … on the highest")."""
    several = any(item.prep is Prep.OF for item in phrase.modifiers)  # "the left of the cups"
    return (
        bool(phrase.words)
        and not several
        and all(
            (is_descriptive(word) or word in LEVELS) and word not in COMMON_NOUNS
            for word in phrase.words
        )
    )


def chooses(determiner: str) -> bool:
    """Whether a determiner before a pronoun picks some of them ("one of them")."""
    return bool(determiner) and determiner.split()[0] not in ("all", "both", "each", "every")


def one_like(landmark: NounPhrase, phrase: NounPhrase) -> NounPhrase:
    """Of "the crate on the other crate" the other is any crate but that."""
    same = landmark.words in ((), ("one",), (phrase.head,)) and not landmark.modifiers
    if phrase.words and same and quantity_of(landmark.determiner).other:
        return replace(landmark, determiner="a", words=(phrase.head,))
    return landmark

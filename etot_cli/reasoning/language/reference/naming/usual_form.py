"""Noun phrases put in their usual form, and phrases for the robot itself."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.naming.determiners import is_distributive, quantity_of
from etot_cli.reasoning.language.words.categories import MASS_NOUNS
from etot_cli.reasoning.language.words.lexicon import (
    COMMON_NOUNS,
    LEVELS,
    NUMBERS,
    ORDINALS,
    PACKS,
    PAIRED,
    SIDES,
    SIZES,
    is_descriptive,
    singular,
)
from etot_cli.reasoning.language.words.nouns import STACK
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep

ROBOT_NOUNS = ("robot", "arm", "gripper", "hand", "base", "you", "me")
GENERAL = {
    "everything": "all", "anything": "any", "something": "any", "everything else": "all other",
    "all else": "all other",
}  # fmt: skip
"""Determiners that nouns for anything stand for."""
_OTHERS = frozenset(
    {"the rest", "the others", "the other ones", "all others", "all the others", "all the rest"}
)
"""The others of what was spoken of before."""

_WHERE = (Prep.FROM, Prep.IN, Prep.ON)
_AROUND = (Prep.WITH, Prep.CONTAINING, Prep.BEARING)
_ITS_OWNER = NounPhrase(pronoun="it", text="the contents")
"""Of "the contents" of what was spoken of."""


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
    """The phrase in the usual form: "the bigger of the mugs" is the bigger mug."""
    if {*phrase.words[1:-1]} & _LIKE_THAT:  # "the lime coloured ball", "the cup shaped holder"
        said = (word for word in phrase.words if word not in _LIKE_THAT)
        return usual_form(replace(phrase, words=tuple(said)))
    for item in phrase.modifiers:
        if item.prep is Prep.SIDE and item.words[0] in ORDINALS and phrase.words:
            # "The drawer second from the top"
            side = replace(item, words=item.words[1:])
            words = (*phrase.words[:-1], item.words[0], phrase.words[-1])
            modifiers = tuple(side if one is item else one for one in phrase.modifiers)
            return usual_form(replace(phrase, words=words, modifiers=modifiers))
    if is_distributive(phrase.determiner) and any(
        NUMBERS.get(w, 1) > 1 for w in phrase.words[1:-1]
    ):
        raise ReferenceProblem(phrase.text, "name them one by one", 3)
    counted = phrase.words[1:] and NUMBERS.get(phrase.words[0], 1) > 1
    if counted and phrase.determiner.endswith((" of the", " of these", " of those", " of my")):
        # "Either one of the two cups"
        determiner = f"{phrase.determiner} {phrase.words[0]}"
        return usual_form(replace(phrase, determiner=determiner, words=phrase.words[1:]))
    *each, number = phrase.determiner.split() or [""]
    if each in _EACH_OF and number in NUMBERS and any(map(_is_utmost, phrase.words[:-1])):
        # "Each of the two biggest cups", of which there may be more
        return usual_form(replace(phrase, determiner=f"all {number}"))
    last = phrase.head
    if last in GENERAL and len(phrase.words) == 1:
        determiner = GENERAL[last]
        if last == "anything" and phrase.modifiers:
            determiner = "all"  # whatever is so
        words = ("objects",) if determiner.startswith("all") else ("object",)
        return replace(phrase, determiner=determiner, words=words)
    if last in MASS_NOUNS and phrase.determiner == "the" and _compares(phrase):
        return usual_form(replace(phrase, determiner="the 1"))  # "the leftmost fruit"
    if last in _OTHERS and len(phrase.words) == 1:
        of = next((m for m in phrase.modifiers if m.prep is Prep.OF and m.phrases[0].words), None)
        left = replace(phrase, determiner="all other", words=())
        if of is None:
            return left
        (whole, *_) = of.phrases
        modifiers = (*whole.modifiers, *left.without_modifier(of).modifiers)
        return usual_form(
            replace(left, words=whole.words, modifiers=modifiers, without=whole.without)
        )
    if phrase.determiner.startswith("only "):
        phrase = replace(phrase, determiner=phrase.determiner.removeprefix("only "))
    out = next((item for item in phrase.modifiers if item.prep is Prep.EXCEPT), None)
    if not last and out is not None and out.phrases[0].words:
        (left_out, *_) = out.phrases
        head = left_out.words[-1]
        plural = head if singular(head) != head else f"{head}s"
        if how_many_out(out) is None:
            return replace(phrase, words=(plural,))
        # "All but one of the red cups on the tray": of the red cups there all but one
        bare = replace(out, phrases=(NounPhrase(left_out.determiner, text=left_out.text),))
        modifiers = (*left_out.modifiers, *(bare if m is out else m for m in phrase.modifiers))
        return usual_form(
            replace(phrase, words=(*left_out.words[:-1], plural), modifiers=modifiers)
        )
    of = next((item for item in phrase.modifiers if item.prep is Prep.OF), None)
    if of is not None and last and of.phrases[0].words:
        (inner, *_) = of.phrases
        if singular(last) in PACKS and not (
            inner.determiner or inner.modifiers or is_descriptive(inner.words[0])
        ):
            # "The packet of rice" is the rice packet.
            return usual_form(phrase.without_modifier(of).called(*inner.words, last))
        if singular(last) == "pair" and inner.words[-1] in PAIRED and not inner.determiner:
            pair = phrase.without_modifier(of).called(*inner.words)
            return usual_form(replace(pair, modifiers=(*inner.modifiers, *pair.modifiers)))
    if phrase.determiner == "a pair of" and last in PAIRED:
        phrase = replace(phrase, determiner="a")
    first = phrase.words[0] if phrase.words else ""
    several = (quantity_of(phrase.determiner).count or 1) > 1
    if several and LEVELS.get(first) in ("top", "bottom") and len(phrase.words) > 1:
        aside = Modifier(Prep.SIDE, words=(LEVELS[first],))
        modifiers = (aside, *phrase.modifiers)
        return usual_form(replace(phrase, words=phrase.words[1:], modifiers=modifiers))
    if out is not None and last:
        named = replace(out, phrases=tuple(_named(item, last) for item in out.phrases))
        modifiers = tuple(named if item is out else item for item in phrase.modifiers)
        phrase = replace(phrase, modifiers=modifiers)
    if last == "contents" and not phrase.modifiers:
        of = Modifier(Prep.OF, (phrase.owner or _ITS_OWNER,))
        phrase = replace(phrase, owner=None, modifiers=(of,))
    if not last or of is None:
        return phrase
    rest = phrase.without_modifier(of).modifiers
    whole = of.phrases[0]
    if last == "contents":
        inside = Modifier(Prep.IN, (whole,))
        words = (*phrase.words[:-1], "objects")
        return replace(phrase, determiner="all", words=words, modifiers=(inside, *rest))
    told = phrase.words[:-1] if phrase.is_elliptic and phrase.words[1:] else phrase.words
    one = told[-1]
    if whole.words and any(one in table for table in (SIZES, SIDES, ORDINALS, LEVELS)):
        several = singular(whole.words[-1]) != whole.words[-1]
        if whole.head in spellings(STACK):
            return replace(phrase, words=(*told, "object"))
        if not several:
            raise ReferenceProblem(phrase.text, f"{last!r} of one thing is no thing", 1)
        noun = (*whole.words[:-1], singular(whole.words[-1]))
        among = quantity_of(whole.determiner).count or 0
        modifiers = (*whole.modifiers, *rest)
        if noun[-1] in MASS_NOUNS and phrase.determiner == "the":
            phrase = replace(phrase, determiner="the 1")  # "the smaller of the two fruits"
        if one in LEVELS:
            # Of two open drawers the lower one may be the middle one of three.
            told, modifiers = told[:-1], (Modifier(Prep.SIDE, words=(LEVELS[one],)), *modifiers)
        without = (*phrase.without, *whole.without)
        return replace(
            phrase, words=(*told, *noun), modifiers=modifiers, among=among, without=without
        )
    if told != phrase.words and is_descriptive(one) and singular(whole.head) != whole.head:
        # "The blue one of the pill boxes", after which "the white one" is one of these, too
        noun = (*whole.words[:-1], whole.head if last == "ones" else singular(whole.head))
        return replace(phrase, words=(*told, *noun), without=(*phrase.without, *whole.without))
    return phrase


def around_itself(phrase: NounPhrase) -> NounPhrase:
    """A phrase that tells where its thing is by what holds "it", with its own words for that."""
    pronouns = ("it",) if singular(phrase.head) == phrase.head else ("they", "them")
    itself = replace(phrase, modifiers=())

    def named(np: NounPhrase) -> NounPhrase:
        return replace(itself, text=np.text) if np.pronoun in pronouns else np

    def inner(np: NounPhrase) -> NounPhrase:
        told = (
            replace(item, phrases=tuple(map(named, item.phrases))) if item.prep in _AROUND else item
            for item in np.modifiers
        )
        return replace(np, modifiers=tuple(told))

    modifiers = (
        replace(item, phrases=tuple(map(inner, item.phrases))) if item.prep in _WHERE else item
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

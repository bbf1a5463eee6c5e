"""What noun phrases in a row share: an article, a noun, a number."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import (
    COMMON_NOUNS,
    LEVELS,
    NUMBERS,
    ORDINALS,
    is_descriptive,
    singular,
)
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.reasoning.language.words.predicates import OF_SEVERAL


def coordinated(first: NounPhrase, more: tuple[NounPhrase, ...]) -> tuple[NounPhrase, ...] | None:
    """Noun phrases of which all but the last may leave the noun to the next: "the red and the blue
    mug". None where the last one leaves it out, too.
    """
    found = [first, *more]
    for index in range(len(found) - 1, -1, -1):
        item = found[index]
        adjectives = bool(item.words) and all(
            is_descriptive(word) or word in LEVELS for word in item.words
        )
        said = (*item.words, item.determiner)[0]
        number = str(NUMBERS.get(said, said))
        if index and number.isdigit():
            # "Cubes 1, 2 and 4": the numbers of things, no counts of them.
            before = next((np.words for np in found[index - 1 :: -1] if len(np.words) > 1), ("",))
            if before[-1].isdigit() and len(item.words) < 2 and not item.modifiers:
                item = replace(item, determiner="", words=(*before[:-1], number))
        if index and not item.determiner and item.words and first.determiner:
            item = replace(item, loose=True)
        following = found[index + 1] if index + 1 < len(found) else None
        named = bool(item.words) and item.words[-1] in COMMON_NOUNS  # "lime", "orange"
        if adjectives and following is None and not item.determiner and not named:
            return None
        if adjectives and following is not None:
            counted = not item.determiner and item.words[-1] in ORDINALS
            if counted and {*following.words[:1]} - {*ORDINALS}:
                return None  # "second, red mug": what comes second
            noun = "_".join(following.words).split("_")[1:]  # labels of several words are joined
            item = replace(item, words=(*item.words, *noun[-1:]))
            if following.determiner == item.determiner == "the":
                # "The red and the green spools" may be one each, as "the red and green spools"
                found[index + 1] = replace(following, loose=True)
        found[index] = item
    return tuple(found)


def with_noun_of(np: NounPhrase, named: NounPhrase) -> NounPhrase:
    """A noun phrase that leaves its noun to another one ("in the red or in the blue box")."""
    first, *noun = "_".join(named.words).split("_")  # labels of several words are joined
    bare = np.determiner == "the" and np.words and not np.modifiers and np.head not in COMMON_NOUNS
    told = all(is_descriptive(word) or word in LEVELS for word in (first, *np.words))
    return replace(np, words=(*np.words, noun[-1])) if noun and bare and told else np


def of_each(nps: tuple[NounPhrase, ...]) -> tuple[NounPhrase, ...] | None:
    """In "the contents of the red bowl and the blue bowl" and "the blocks in the red bowl and the
    blue bowl" what is in each of the bowls; None where the last ones are no such places.
    """
    first, *more = nps
    *before, where = first.modifiers or (None,)
    if where is None or len(where.phrases) != 1 or where.prep not in (Prep.OF, Prep.IN, Prep.ON):
        return None
    places = coordinated(where.phrases[0], tuple(more))
    alike = first.head == "contents" or len({singular(np.head) for np in places or ()}) == 1
    if places is None or not alike:
        return None
    if not all(place.determiner in THE_WORDS and place.words for place in places):
        return None
    return tuple(
        replace(
            first,
            modifiers=(*before, replace(where, phrases=(place,))),
            text=f"{first.text} and {place.text}" if index else first.text,
        )
        for index, place in enumerate(places)
    )


_ARE = Expression(r"\b(?:that|which) (?:are|stand|lie|sit)\b")


def told_together(nps: tuple[NounPhrase, ...]) -> tuple[NounPhrase, ...]:
    """In "the cup and the plate that are on the tray" both are: one thing is not "are"."""
    *before, last = nps
    single = bool(last.words) and singular(last.head) == last.head and len(last.modifiers) == 1
    alone = all(np.words and not np.modifiers for np in before)
    inner = any(_ARE.search(np.text) for item in last.modifiers for np in item.phrases)
    if not (before and single and alone and _ARE.search(last.text)) or inner:
        return nps
    return tuple(replace(np, modifiers=last.modifiers) for np in nps)


_QUANTITIES = {"both": "both", "all": "all the", "all of it": "all the", "each": "each of the"}


def all_of(nps: tuple[NounPhrase, ...], said: str) -> tuple[NounPhrase, ...]:
    """All of them, as a word beside the verb says."""
    (first, *more) = nps
    if said == "all of it" and not first.may_be_much:
        return nps  # one cup is not all of it
    # "Pens, all of them", "fruit, all of it"
    several = singular(first.head) != first.head or said == "all of it"
    several &= not (first.determiner or first.pronoun)
    if said and not more and (several or first.determiner in THE_WORDS):
        return (replace(first, determiner=_QUANTITIES.get(said, said)),)
    (*_, number) = first.determiner.split() or [""]
    counted = said == "all" and NUMBERS.get(number, 1) > 1
    if not more and (counted or (said, number) == ("both", "two")):  # "the two cups should both"
        return (replace(first, determiner=f"{said} the {number}"),)
    if said in ("both", "all") and not more and first.pronoun in ("they", "them"):
        return (replace(first, determiner=said),)
    if said == "all" and not more and first.pronoun == "it":  # "take the fruit, put it all …"
        return (replace(first, determiner="all", pronoun="them"),)
    return nps


def said_of_all(nps: tuple[NounPhrase, ...], said: str) -> tuple[NounPhrase, ...] | None:
    """Several things, of which a word within the verb may say that all of them are meant."""
    one = len(nps) == 1 and bool(nps[0].words) and singular(nps[0].head) == nps[0].head
    return None if said and (one or (said == "both" and len(nps) > 2)) else all_of(nps, said)


def disagrees(nps: tuple[NounPhrase, ...], verb: str) -> bool:
    """Whether a verb is said of several things, and these are one: in "the cup and the pen beside
    it go in the box" it is not the pen alone that "go".
    """
    (np, *more) = nps
    one = bool(np.words) and singular(np.head) == np.head and np.determiner in ("", *THE_WORDS)
    return one and not (more or is_category(np.head)) and verb.split()[0] in OF_SEVERAL

"""What asides name, which is spoken of before the rest."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise, takewhile

from etot_cli.reasoning.language.grammar.asides.aside_clauses import Clause
from etot_cli.reasoning.language.grammar.asides.asking_words import BEFORE_NAMES, PRONOUNS, IsName
from etot_cli.reasoning.language.grammar.asides.displeasure import in_state, is_misplaced
from etot_cli.reasoning.language.grammar.asides.left_open import is_left_open
from etot_cli.reasoning.language.grammar.asides.people import PEOPLE
from etot_cli.reasoning.language.grammar.asides.told_of_things import is_told_apart_by
from etot_cli.reasoning.language.grammar.text.splitting import ASIDE
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import LINKS, OTHER_VERBS, VERB_WORDS, all_words
from etot_cli.reasoning.language.words.lexicon import (
    DESK_NOUNS,
    JOINT_NOUNS,
    LEVELS,
    NUMBERS,
    SIDES,
    STATES,
    is_descriptive,
    singular,
)

_PARTS = frozenset(noun for nouns in JOINT_NOUNS.values() for noun in nouns)
_LIKED = [["favourite"], ["favorite"], ["best"]]
_IS_ONE = Expression(
    r" (?:is|are|was|were|weighs?|costs?|needs?|makes?|(?:smells?|looks?) like|as) an? "
)
"""Before what is no other thing ("the vase was a gift", "he used it as a hat")."""
_ONE_IS_FOR = Expression(r"one (?:(?:is|was)(?: meant| reserved)?(?: for\b|$)|belongs to\b)")
"""Behind "the little", which may be a child otherwise."""
_BY_MEANS = Expression(r" with (?:my|our|his|her) \w+$")
"""Behind what is spoken of ("I keep knocking it over with my sleeve")."""
_WHICH_ONE = Expression(r"which ((?:\w+ )?(?!of\b)\w+) (?:you|it|they|is) ")
_ON_A_SIDE = Expression(r"(?:(?:that|which) is )?on the (?:left|right)(?: side)?(?= |$)(?! of\b)")
"""Behind a noun ("I forgot the cup on the left side")."""
_HELD = Expression(
    rf"(?:{PEOPLE}|they) (?:\w+ )??(?:has|have|had|took|uses?|needs?|wants?|reserved|got|keeps?)"
    r"(?: (?:got|taken|reserved))? (?:the|my|his|her|our) (?:\w+ ){1,3}?(?P<noun>\w+)"
)
"""What somebody has who tells so, told from others of its kind."""
_NO_NAMES = VERB_WORDS | OTHER_VERBS | {*STATES, *LEVELS, *SIDES}
_COUNTED = BEFORE_NAMES | {*NUMBERS, "which", "what"}
ONES = PRONOUNS | {"one", "other", "another"}


def words_of(said: Iterable[str]) -> set[str]:
    """The words of some sentences."""
    return {word for sentence in said for word in sentence.replace(",", "").split()}


def are_spoken_of(topics: Sequence[tuple[str, ...]], rest: Sequence[str]) -> bool:
    """Whether what is told of things may be why something is asked of them; else it may ask for
    something itself ("the shears are forbidden").
    """
    words = words_of(rest)
    referring = PRONOUNS | {"either", "one", "both"}
    return all(
        (referring | {*topic[-1:]}) & words or topic[-1] in {*DESK_NOUNS, *PRONOUNS}
        for topic in topics
        if topic
    )


def is_of_held_one(said: str, rest: Sequence[str]) -> bool:
    """Whether somebody has one of what is spoken of next by its noun alone, which may be another
    one ("my son has the yellow cup, so put the cup on the plate"); or has reserved what nothing of
    the rest is said to be.
    """
    held = _HELD.fullmatch(said)
    if held is not None and any(re.search(rf"\bthe {held['noun']}\b", words) for words in rest):
        return True
    named = {*PRONOUNS, said.split()[-1]} & {*re.findall(r"\w+", " ".join(rest))}
    return " reserved " in said and not named  # it may be among "the fruit"


def of_which(asides: Sequence[Clause], rest: Sequence[str]) -> Iterator[str]:
    """What asides say; where it is left open which of several things is meant, "one" of the rest is
    one of these.
    """
    one = any("one" in said.split() for said in rest)
    for aside in asides:
        open_one = one and is_left_open(aside.whole) and _WHICH_ONE.match(aside.whole)
        yield f"the {open_one[1]}s" if open_one else aside.said


def named_in(asides: Iterable[str], is_name: IsName, rest: Sequence[str] = ()) -> str:
    """What asides name in the scene, as a remark. Of what stands too close to something else more
    is said next, so that is named last and alone. What is named without an article ("I hate jam")
    may be meant by a pronoun of the rest.
    """
    told = [aside.split() for aside in asides]
    if not any(any(_phrases(words, is_name)) for words in told) and ONES & words_of(rest):
        told = [_with_articles(words, is_name) for words in told]
    phrases, alone = list[str](), list[str]()
    for words in told:
        aside = " ".join(words)
        found = [in_state(aside, phrase) for phrase in _phrases(words, is_name)]
        ones = [phrase for phrase in found if phrase.endswith(" one")]  # of what was named before
        apart = found[:1] if is_misplaced(aside) else ones
        alone += apart
        phrases += [phrase for phrase in found if phrase not in apart]
    remarks = (" and ".join(dict.fromkeys(named)) for named in (phrases, alone))
    return ". ".join(f"{named} {ASIDE}" for named in remarks if named)


def _with_articles(words: Sequence[str], is_name: IsName) -> list[str]:
    """Words with an article before what is named without one ("she cannot sleep without teddy");
    who is said to hate lemons may mean the one that is there. My tea with lemon is no lemon.
    """
    said, at = list[str](), 0
    while at < len(words):
        end = at + 1
        while is_name(words[at]) and end < len(words) and is_name(words[end]):
            end += 1
        bare = is_name(words[at]) and not _NO_NAMES & {*words[at:end]}
        before, behind = (words[at - 1] if at else ""), (words[end] if end < len(words) else "the")
        bare &= not (_COUNTED & {*words[max(at - 2, 0) : at]} or is_descriptive(before))
        if bare and (behind in all_words() or behind == "anymore"):
            said += ["the", *words[at : end - 1], singular(words[end - 1])]
        else:
            said += words[at:end]
        at = end
    return said


def _phrases(words: Sequence[str], is_name: IsName) -> Iterator[str]:
    """Phrases that name something in the scene."""
    for at, word in enumerate(words):
        if word in BEFORE_NAMES:
            counted = words[at + 1 : at + 2] in _LIKED or {*words[at + 1 : at + 2]} & {*NUMBERS}
            end = last = at + 1 + bool(counted)
            while end < len(words) and is_told_apart_by(words[end], is_name):
                end += 1
                last = end if is_name(words[end - 1]) else last
            if at + 1 < last == end < len(words) and words[end] in _PARTS:
                last += 1  # "the bottom drawer"
            if at + 1 < end and _ONE_IS_FOR.match(" ".join(words[end:])):
                yield " ".join((word, *words[at + 1 : end], "one"))
                continue
            if last > at + 1:
                aside = _ON_A_SIDE.match(" ".join(words[last:]))
                last += len(aside[0].split()) if aside else 0
                owner = "the" if word in ("his", "her", "their") else word
                if re.match(rf"{PEOPLE}\b", " ".join(words[at:])):
                    continue  # "my hands" are no hand cream
                yield " ".join((owner, *(w for w in words[at + 1 : last] if [w] not in _LIKED)))


def names_stranger(said: str, is_name: IsName) -> bool:
    """Whether something is named that the scene does not have, and no person."""
    means = _BY_MEANS.search(said)
    if means and any(map(is_name, said[: means.start()].split())):
        said = said[: means.start()]
    words = _IS_ONE.sub(" ", said).split()
    return any(
        word in BEFORE_NAMES
        and words[at + 1] not in all_words()
        and not any(map(is_name, takewhile(lambda it: it not in LINKS, words[at + 1 : at + 4])))
        and not re.match(rf"{PEOPLE}\b", " ".join(words[at:]))
        for at, word in enumerate(words[:-1])
    )


def awaits_name(words: Sequence[str], is_name: IsName) -> bool:
    """Whether what is said next may be meant: by "one" or "there", or by a pronoun, or "both" as
    one, before anything is named ("give it to me, the cup is mine").
    """
    if {"one", "other", "another", "there"} & {*words}:
        return True
    alone = ("both", "all", "each", "either")
    for word, behind in pairwise([*(word.strip(",") for word in words), ""]):
        if word in PRONOUNS or (word in alone and behind in {"", *LINKS}):
            return True
        if is_name(word):
            return False
    return True


def refers_back(words: Sequence[str], is_name: IsName, meaning: frozenset[str]) -> bool:
    """Whether one of some pronouns comes before anything that is named."""
    return next((word in meaning for word in words if word in PRONOUNS or is_name(word)), False)

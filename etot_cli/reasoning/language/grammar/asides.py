"""What is said beside a request and asks for nothing: reasons, and remarks about people and times.

Where an instruction is not read as it stands they are cut off; what they name is spoken of before
the rest.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from etot_cli.reasoning.language.grammar.text import COLON, COMMA, sentences_of, spaced, words_in
from etot_cli.reasoning.language.words.known import (
    ALL_WORDS,
    BEFORE_NOUNS,
    OTHER_VERBS,
    VERB_WORDS,
)
from etot_cli.reasoning.language.words.lexicon import is_descriptive, word_set

ASIDE = "~aside"
"""Stands behind what a remark names, in its place."""
MOST = 3
"""Remarks of one instruction; who has more to tell may be asking for something by it."""
_BECAUSE = r"because|since|as(?! (?:soon|long|far|well|much|if)\b)|now that"
_LEADING = re.compile(
    rf"^(?:{_BECAUSE}|while(?= (?:i|we|my|our)\b)) (?P<said>[^~]+) {COMMA} (?:so )?(?P<rest>.+)$"
)
_TRAILING = re.compile(
    rf"^(?P<rest>.+?) (?:{COMMA} )?(?P<said>(?:because|since|now that|in case|before) [^~]+"
    r"|so (?:that )?(?:i|we) (?:can|could|may) [^~]+"
    r"|so (?:that )?(?:it|they) (?:stays?|keeps?|remains?) (?!open$|closed$|shut$|put$)\w+"
    r"|so (?:that )?nothing (?:gets|can get|is|will be) (?:lost|broken|spilt|spilled|wet|dirty)"
    r"|for (?:later|(?!\w*thing)\w+ing|(?:lunch|dinner|tea|play|bed)\w* ?time))$"
)
_THEREFORE = re.compile(
    rf"^(?P<said>[^~]+?) (?:(?:{COMMA} )?(?:and |that is )?(?:so|therefore|hence|why)|{COMMA}) "
    r"(?P<rest>.+)$"
)
_PEOPLE = (
    r"(?:i|we|you|he|she|somebody|someone|everybody|everyone"
    r"|(?:(?:my|our|your|his|her|the) )(?:kids?|children|guests?|visitors?|boss|sister|brother|"
    r"mother|mom|mum|father|dad|wife|husband|friends?|colleagues?|students?|neighbou?rs?|team|cat|"
    r"dog|baby|family))"
)
_PERSON = re.compile(
    rf"^(?:but |and )?{_PEOPLE} (?:just |already |also |really |always )*(?P<did>.+)$"
)
_HAPPENED = re.compile(
    r"^(?:can not (?:reach|see|find|get at|get to)|do not need)\b"
    r"|^(?:want|need|have|plan|hope|would like|am going|are going|will have) to "
    r"|^(?:have|has|had|am|are|is|was|were|likes|loves?|hates?|broke|bought|left|made|forgot|lost|"
    r"found|got|did|went|came|ate|drank|saw|spilt|felt|will (?:be|need)|hope|think|know|"
    r"(?!(?:want|need|lik|wish|ask|hop|expect|prefer)\w*ed\b)\w+ed)\b"
)
"""What somebody did, is or is about to do."""
_ASKING = word_set(
    "want wants need needs wanted needed wish like prefer should must shall would could may let "
    "go goes belong belongs hoping wondering please not never no none nothing without if "
    "unless when until instead except only"
)
_DOING = {
    verb
    for verb in VERB_WORDS
    if VERB_WORDS & {f"{verb}ing", f"{verb[:-1]}ing", f"{verb}{verb[-1]}ing"}
} | {"open", "shut", "empty"}
"""What the robot could be asked to do."""
_ASKED = re.compile(rf"\b(?:and|but|then|please) (?:\w+ )?(?:{'|'.join(sorted(_DOING))})\b")
_OUTSIDE = re.compile(r"\b(?:is|are|was|were|has|have|had)\b(?! to\b)")
_TOO = re.compile(r"^(?:the|my|your|our) [^~]+ (?:is|are) (?:far |much )?too \w+")
_IN_GENERAL = re.compile(
    r"^it is (?:\w+ing|(?:\w+ )?(?:\w*time|late|early|dark|morning|noon|evening|night))$"
)
_REFERRING = word_set(
    "it they them this that these those one ones two three other others another rest everything "
    "anything all both each every any same here there first last which"
)
"""They may speak of what was asked for ("one of them is enough")."""


@dataclass(frozen=True, slots=True)
class Plain:
    """An instruction without its asides: the text to be read, and what was cut off."""

    text: str
    asides: tuple[str, ...]


def without_asides(
    text: str, is_name: Callable[[str], bool], is_sentence: Callable[[str], bool]
) -> Plain | None:
    """An instruction with every aside replaced by what it names; None where there is none.

    Args:
        text: normalized.
        is_name: whether something in the scene is called by a word.
        is_sentence: whether the grammar reads a sentence as it stands; what it reads stays whole.
    """
    kept: list[str] = []
    asides: list[str] = []
    for sentence in sentences_of(text):
        before, rest, after = _parted(" ".join(words_in(sentence)).replace(COLON, COMMA), is_name)
        # "Dinner is ready" and "the bowl for later" are sentences about things that are not there.
        outside = after.startswith("for ") or not (rest or _PERSON.match(sentence))
        if is_sentence(sentence) and not outside:
            kept.append(sentence)
            continue
        asides += [spaced(said.split()) for said in (before, after) if said]
        kept += [_named(before, is_name), rest, _named(after, is_name)]
    if not 0 < len(asides) <= MOST or not any(kept):
        return None
    return Plain(". ".join(part.replace(f" {COMMA}", ",") for part in kept if part), tuple(asides))


def _parted(sentence: str, is_name: Callable[[str], bool]) -> tuple[str, str, str]:
    """The aside before a sentence, the sentence, and the aside behind it."""
    before, after = "", ""
    found = _LEADING.match(sentence)
    if not found and (therefore := _THEREFORE.match(sentence)):
        found = therefore if _tells(therefore["said"], is_name) else None
    if found:
        before, sentence = found["said"], found["rest"]
    elif _tells(sentence, is_name):
        return sentence, "", ""
    if found := _TRAILING.match(sentence):
        named = any(map(is_name, found["said"].split()))
        asked = _ASKED.search(found["said"])
        if not asked and not (named and found["said"].startswith(("before", "for"))):
            sentence, after = found["rest"], found["said"]
    elif _tells((last := sentence.rpartition(f" {COMMA} "))[2], is_name):
        sentence, after = last[0], last[2]
    return before, sentence, after


def _tells(said: str, is_name: Callable[[str], bool]) -> bool:
    """Whether this tells what somebody did, or how things outside of the scene are."""
    words = said.split()
    person = _PERSON.match(said)
    if person:
        happened = _HAPPENED.match(person["did"])
        if happened is None:
            return False
        did = person["did"].removeprefix(happened[0]).split()
        if happened[0].endswith(" to "):
            return did[0] in OTHER_VERBS or did[0] not in ALL_WORDS
        jointly = {word for word in did if words[0] in ("you", "we") and word in VERB_WORDS}
        return not ((_DOING | _ASKING) & {*did} or any(word.endswith("ing") for word in jointly))
    outside = _TOO.search(said) or (_OUTSIDE.search(said) and not any(map(is_name, words)))
    told = _TOO.sub("", said).split()  # "too close" is no "close"
    asking = (_DOING | _ASKING | _REFERRING) & {*told}
    return bool(_IN_GENERAL.match(said) or (outside and not asking))


def _named(said: str, is_name: Callable[[str], bool]) -> str:
    """What an aside names in the scene, as a remark."""
    words: Sequence[str] = said.split()
    phrases: list[str] = []
    for at, word in enumerate(words):
        if (word,) in BEFORE_NOUNS:
            end = last = at + 1
            while end < len(words) and (is_name(words[end]) or is_descriptive(words[end])):
                end += 1
                last = end if is_name(words[end - 1]) else last
            if last > at + 1:
                phrases.append(" ".join(words[at:last]))
    return f"{' and '.join(dict.fromkeys(phrases))} {ASIDE}" if phrases else ""

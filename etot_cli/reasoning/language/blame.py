"""Which words of a sentence are to blame where none of its readings covers all of them: the fewest
without which the rest is read in this scene, or in whose place a plain one is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import takewhile

from etot_cli.reasoning.language.grammar.parsers.input import Input
from etot_cli.reasoning.language.grammar.sentences.reader import (
    SHOWN_WORDS,
    UnreadableError,
    is_known,
    shown,
)
from etot_cli.reasoning.language.grammar.text.splitting import COLON, COMMA, QUESTION, spaced
from etot_cli.reasoning.language.words import known
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.lexicon import is_descriptive, is_in_lexicon, matches_any
from etot_cli.reasoning.language.words.nouns import BODY_NOUNS, THE_WORDS
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import INTO, NEARBY, ONTO, OVER, TO
from etot_cli.world.state import DESK

MAX_EFFORT_TRIED = 3000
"""Of all ways to mend a sentence that are tried: a third of a second. At half of it five of 996
refusals blame other words; at 2600 one of those of the tests still does."""
_TRY = 8
"""What else a try takes, a millisecond."""
_PLACE = ("on", "the", DESK)
"""Where anything can go in every scene."""
_PLACE_COSTS = 2.5
"""Words that may rather be left out than a place be put in. Of 866 refusals five change at 1.5
("then back" is no longer blamed) and five at 3.5 (an "and the bowl" that lacks its place is)."""
_PLACED = {text.split()[0] for text in spellings(f"{INTO}, {ONTO}, {OVER}, {TO}")} | {
    text.split()[0] for texts in NEARBY.values() for text in spellings(texts)
}
"""What a place begins with."""
_PAUSES = (COMMA, COLON)
_JOINTS = {*_PAUSES, "and", "then", "or", "but"}
_BEFORE_VERBS = _JOINTS | {"to", "not", "you", "please", "while", "by"}
"""What a verb may stand behind; elsewhere a word that is one, too, is a noun ("water bottle")."""
_MISSING = "something is missing, such as into or onto what"


def blamed(error: UnreadableError, vain: Callable[[str], int | None]) -> UnreadableError:
    """An error with the words to blame and a reason, where it has neither.

    Args:
        error: of an instruction that is not read.
        vain: what it took to read a text in the scene in vain; None where it is read.
    """
    if error.unread is None:
        return error
    unread, before = error.unread, error.understood
    words = unread.words
    if words[-1] == QUESTION:
        words = words[:-1]
        if unread.reached >= len(words):
            return UnreadableError(shown(words), before, known.REASONS["what"])
    spent = 0
    for start, end, place in _ways(words, unread):
        mended = (*words[:start], *place, *words[end:])
        text = " ".join(mended).replace(f" {COMMA}", ",").replace(f" {COLON}", ":").strip(" ,:")
        effort = vain(_joined(before, text))
        if effort is None:
            without = "" if place else spaced(mended).strip(" ,:")
            text, why = _reason(unread, words, start, end, replaced=bool(place))
            return UnreadableError(text, _joined(before, spaced(words[:start])), why, without)
        spent += _TRY + effort
        if spent > MAX_EFFORT_TRIED:
            break
    return _unmended(unread, words, before)


def _ways(words: tuple[str, ...], unread: Input) -> Iterator[tuple[int, int, tuple[str, ...]]]:
    """Which words to leave out, from where to where, or to put a place for: the fewest first, and
    of equally many those near the word up to which the sentence was read. No word that things are
    called by is left out alone.
    """
    many, reached = len(words), unread.reached
    joints = [at for at in range(many) if _joins(words[at])]
    names = {at for at in range(many) if words[at] in unread.nouns or is_descriptive(words[at])}
    spans = {(at, at + 1) for at in range(many) if at not in names}
    spans |= {(start, end) for start in (0, *joints) for end in (*joints, many) if start < end}
    ways = [
        (float(_count(words[start:end])), abs(reached - end), start, end, ())
        for start, end in spans
        if _is_whole(words, start, end)
    ]
    places = [
        (_PLACE_COSTS + _count(words[at:]), 0, at, many, _PLACE)
        for at in range(2, many + 1)
        if at == many or (words[at] not in unread.nouns and _ends_phrase(words[at - 1]))
    ]
    for _, _, start, end, place in sorted([*ways, *places]):
        yield start, end, place


def _joins(word: str) -> bool:
    """Whether a phrase may begin with a word: "of" it goes on, at "the" it has begun."""
    inner = word in THE_WORDS or word in ("a", "an", "of", "it", "them")
    return word in (*_PAUSES, "one") or (word in known.GRAMMAR_WORDS and not inner)


def _ends_phrase(word: str) -> bool:
    return word not in known.LINKS and not _joins(word)


def _is_whole(words: tuple[str, ...], start: int, end: int) -> bool:
    """Whether what is left out has what its last word needs behind it, and something is left."""
    if end - start == len(words):
        return False
    following = words[end] if end < len(words) else COMMA
    last = words[end - 1]
    led = start == 0 and following in ("and", "but", "or")
    alone = end - start == 1 and last in ("on", "off")  # of the verb
    return not (led or alone) and (
        start == 0 if last in _PAUSES else last not in known.LINKS or following in _PAUSES
    )


def _count(words: tuple[str, ...]) -> int:
    return sum(word not in _PAUSES for word in words)


def _reason(
    unread: Input, words: tuple[str, ...], start: int, end: int, *, replaced: bool
) -> tuple[str, str]:
    """The words to blame, and why: of those left out the first that no sentence has so."""
    if replaced and all(word in known.LINKS for word in words[start:end]):
        return _missing(unread, words)
    for index in range(start, end):
        if why := _cause(unread, words, index):
            return shown(words[index:end]), why
    if replaced:
        like_place = words[start] in _PLACED
        known_as = "it is not understood as a place" if like_place else "a place is expected here"
        plain = f"{known_as}; say into, onto or beside what"
    else:
        plain = "the rest is understood without it"
    return shown(words[start:end]), plain


def _missing(unread: Input, words: tuple[str, ...]) -> tuple[str, str]:
    """What to say of a sentence that might go on: what is wrong with its verb, if anything is."""
    start = max((at + 1 for at, word in enumerate(words[:-1]) if word in _JOINTS), default=0)
    why = _cause(unread, words, start)
    return (shown(words[start:]), why) if why else (_last(words), _MISSING)


def _unmended(unread: Input, words: tuple[str, ...], before: str) -> UnreadableError:
    """The first word for which there is a reason, else what is read last."""
    stop = unread.reached
    for index, word in enumerate(words):
        why = _cause(unread, words, index)
        odd = not index and word not in known.opening_words()
        odd |= word not in known.all_words() and (known.is_adverb(word) or word in known.REASONS)
        odd |= "use" in words[:index] and matches_any(word, BODY_NOUNS)
        if why and (index >= stop - 1 or odd or word in known.BLAMED):
            without = spaced((*words[:index], *words[index + 1 :]))
            understood = _joined(before, spaced(words[:index]))
            return UnreadableError(shown(words[index:]), understood, why, without)
    understood = _joined(before, spaced(words[:stop]))
    if stop >= len(words):
        text, why = _missing(unread, words)
        return UnreadableError(text, understood if why == _MISSING else before, why)
    small = words[stop] in known.GRAMMAR_WORDS  # it joins others, which need it
    without = "" if small else spaced((*words[:stop], *words[stop + 1 :]))
    stop = stop or (words[0] in known.VERB_WORDS)
    before_it = spaced(words[:stop]).rstrip(",").split()[-1:]
    why = f"it is not understood after {before_it[0]!r}" if before_it else ""
    return UnreadableError(shown(words[stop:]), understood, why, without)


def _cause(unread: Input, words: tuple[str, ...], index: int) -> str:
    """Why a word is none that could be understood here; empty for what may have a place."""
    word, before, following = words[index], words[:index][-1:], words[index + 1 : index + 2]
    acted = following in known.BEFORE_NOUNS
    begins = not before or before[0] in _BEFORE_VERBS or (acted and before[0] not in known.LINKS)
    if word in unread.nouns:
        return known.NO_SKILL if acted and not index else ""
    if word == "do" and acted:  # "do the dishes", and no question
        return known.NO_SKILL
    told = not {"is", "are"} & {word} or not known.VERB_WORDS & {*words[:index]}
    *_, last = (word, *takewhile(lambda item: item not in _JOINTS, words[index + 1 :]))
    for text in (" ".join((word, *following)), f"{word} {last}", word) if told else ():
        if text in known.REASONS:
            return known.REASONS[text]
    if word in known.OTHER_VERBS and begins:
        return known.NO_SKILL
    if known.is_adverb(word):
        return "" if word in known.all_words() else "how something is done cannot be asked for"
    if word in ("i", "we", "you", "they") and {*before} & {*unread.nouns, "that", "which", "one"}:
        return "what somebody has, does or needs is not known; name the thing"
    if word in known.OTHER_VERBS:
        return f"nothing in the scene is called {word!r}"
    if not index:
        if word == "which":
            return known.REASONS["what"]
        return "" if word in known.opening_words() else f"{word!r} is no verb that is known"
    listed = is_known(word, unread.nouns) or is_category(word) or is_in_lexicon(word)
    if not word.isalpha() or listed:
        return ""
    unknown = f"nothing in the scene is called {word!r}"
    named = before in known.BEFORE_NOUNS
    return unknown if named else f"{unknown}, nor is it another word that is known"


def _last(words: tuple[str, ...]) -> str:
    return ("… " if len(words) > SHOWN_WORDS else "") + spaced(words[-SHOWN_WORDS:])


def _joined(before: str, text: str) -> str:
    return ". ".join(part for part in (before, text.strip(" ,")) if part)

"""Ways of saying a refused sentence that would be read: the sentence with the least changed, else
its things and its place in a plain request. Each keeps what was said beside the words to blame,
and speaks of nothing else; where none does, none is shown.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import takewhile

from msgspec import Struct

from etot_cli.reasoning.language.grammar.paraphrasing.normalizing import normalized
from etot_cli.reasoning.language.grammar.text.splitting import sentences_of
from etot_cli.reasoning.language.words import verbs
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import LINKS, VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    DESK_NOUNS,
    KIND_NOUNS,
    LEVELS,
    NUMBERS,
    SIDES,
    is_descriptive,
    singular,
)
from etot_cli.reasoning.language.words.patterns import words_of
from etot_cli.world.state import DESK, PartInfo, SceneState

MAX_TRIES = 16
"""Rewordings that are tried before none is shown: a tenth of a second at the usual time each."""

Reads = Callable[[str, SceneState], bool]

_OPENING, _CLOSING = words_of((verbs.OPEN,)) - {"up"}, words_of((verbs.CLOSE,)) - {"up"}
_DENYING = Expression(
    r"\b(?:not|never|neither|nor|no|non|none|nothing|nowhere|hardly|without|except|but|instead"
    r"|\w+n't|only|if"
    r"|unless|when|while|once|until|free|clear|empty|least|most|same|different|matching|other|respectively|colou?rs?|versa|twice|times|again)\b"
)
"""Words that turn a meaning round or bound it: they stay, and no plain request says the same."""
_ASKED = Expression(r"(?:is|are|was|were|has|have|does|did|where|what|which|who|how|why)\b")
"""Questions, which ask for nothing to be done."""
_BOUND = r"\b(?:every|all|each|any)(?: the)?"
"""Words behind which none can be left out without asking for more."""
_USUAL = (
    ({"in", "into", "inside", "within"}, ("in", "on")),
    ({*SIDES, "beside", "next", "between", "behind", "where"}, ("next to",)),
    ({"on", "onto", "atop", "over", "to"}, ("on", "in")),
)
"""What is said for words for a place where they themselves are not read."""
_AWAY = {"from", "off", "out"}
_PLACING = _AWAY.union({"under", "above", "below"}, *(said for said, _ in _USUAL))
_LINKING = {*LINKS, *SIDES, *_PLACING} - {"and", "the", "a"}
_DETERMINERS = ("the", "a", "an", "all", "both", "any", "each", "every")
_ANYTHING = {"object", "thing", "item", "container", "other", "another"}
_PICKING = words_of((verbs.PICK,))


class Refused(Struct, frozen=True):
    """An instruction that was refused, and at which words.

    ``word``: of the phrase, the words to blame. ``without``: the sentence without them.
    ``candidates``: names that may have been meant.
    """

    instruction: str
    phrase: str
    word: str = ""
    without: str = ""
    candidates: tuple[str, ...] = ()


def rewordings(refused: Refused, scene: SceneState, reads: Reads) -> Iterator[str]:
    """Instructions near the refused one that are read in this scene, the nearest first."""
    text, names = normalized(refused.instruction), _Names(scene)
    if _ASKED.match(text):
        return
    kept = _kept(refused, text)
    least = names.told(text) - names.told(refused.word)
    least -= names.told(refused.phrase) if refused.candidates else set()
    called = " ".join(names.of(name) for name in refused.candidates)
    most = names.told(f"{text} {called}")
    tried = {_sentence(text)}
    for near in (*_changed(refused, text, kept, names), *_plain(text, names)):
        plain = _sentence(near)
        told = names.told(plain)
        denials, before = ([word[0] for word in _DENYING.finditer(t)] for t in (near, text))
        if denials != before or plain in tried or not (told and least <= told <= most):
            continue
        tried.add(plain)
        if len(tried) > MAX_TRIES:
            return
        if reads(plain, scene):
            yield plain


def _kept(refused: Refused, text: str) -> str:
    """What is left of a text without the words to blame."""
    sentences = sentences_of(text.replace(" ,", ","))
    blamed = re.escape(refused.word or refused.phrase.removesuffix(" …"))
    rest = ".*" if refused.phrase.endswith("…") else r"(?!\w)"
    for at, sentence in enumerate(sentences):
        less = re.sub(rf"(?<!\w){blamed}{rest}", "", sentence, count=1)
        if less != sentence:
            sentences[at] = refused.without or less
            break
    return ". ".join(part for item in sentences if (part := item.strip(" ,")))


def _changed(refused: Refused, text: str, kept: str, names: _Names) -> Iterator[str]:
    """The sentence with the words exchanged or left out at which it was refused."""
    part = re.search(rf"\bof\s+{re.escape(refused.phrase)}", text)
    # Several things have no one name; nor is it part of another ("box of plasters").
    single = [name for name in refused.candidates if "," not in name]
    for name in () if part else single[:3]:
        phrase = rf"(?:\b(?:the|a|an) )?(?<!\w){re.escape(refused.phrase)}(?!\w)"
        yield re.sub(phrase, names.of(name), text, count=1)
    if refused.candidates and refused.phrase.startswith("the "):
        yield _any_of(refused.phrase, text)
        told = re.findall(r"\bthe (\w+)", text)
        if len({*told}) == len(told):  # no second one speaks of the first again
            yield _any_of("the ", text)
    if re.search(rf"{_BOUND} {re.escape(refused.word)}(?!\w)", text) or _is_head(
        refused.word, text, names
    ):
        return
    kept = re.sub(r"^(?:(?:and|then|just)\b[ ,]*)+", "", kept)
    begun = kept.partition(" ")[0]
    if not text.startswith(begun) and begun not in VERB_WORDS:  # its verb was to blame
        yield f"put {kept}"
    elif (refused.word or refused.without) and not _DENYING.search(
        text.partition(refused.phrase.removesuffix(" …"))[0]
    ):
        yield kept


def _any_of(phrase: str, text: str) -> str:
    """A text that leaves open which thing is meant where it has a phrase that begins with "the"."""
    behind = re.escape(phrase.removeprefix("the ")) or r"\w"
    return re.sub(
        rf"\bthe (?=({behind}))", lambda found: "an " if found[1][0] in "aeio" else "a ", text
    )


def _is_head(word: str, text: str, names: _Names) -> bool:
    """Whether adjectives say of nothing but a word what it is like ("the red book")."""
    found = re.search(rf"(\w+) {re.escape(word)}(?: (\w+))?(?!\w)", text) if word else None
    if found is None or not (is_descriptive(found[1]) or found[1] in NUMBERS):
        return False
    return not (found[2] and names.calls(found[2]))


def _plain(text: str, names: _Names) -> Iterator[str]:
    """Requests for what a text speaks of, in the words it has for it."""
    mentions = names.mentions(text)
    words = {*re.findall(r"\w+", text)}
    for verb, meant, other in (("open", _OPENING, _CLOSING), ("close", _CLOSING, _OPENING)):
        if words & meant and not words & (other - meant):
            yield from (f"{verb} {mention.phrase}" for mention in mentions)
    held = list(takewhile(lambda item: item.joined, mentions))
    things = " and ".join(item.phrase for item in held)
    begun = held and (text in things or text.startswith(held[0].phrase) or words & _PICKING)
    if begun and len(held) == len(mentions) and not words & (_PLACING | (VERB_WORDS - _PICKING)):
        yield f"pick up {things}"
    for place in mentions[len(held) :] if held else ():
        before = {*place.before}
        usual = next((links for known, links in _USUAL if before & known), ())
        if before & _PLACING and not before & _AWAY:
            for link in dict.fromkeys((" ".join(place.before), *usual)):
                yield f"put {things} {link} {place.phrase}"


class _Mention(Struct, frozen=True):
    """Words for things, with what tells them apart; the place words that they stand behind; and
    whether only a verb or others of the kind stand before them.
    """

    phrase: str
    before: tuple[str, ...]
    joined: bool


class _Names:
    """What people call the things of a scene."""

    def __init__(self, scene: SceneState) -> None:
        self._scene = scene
        own = " ".join(
            f"{info.label} {' '.join(part.name for part in info.parts)} "
            f"{info.name} {' '.join(KIND_NOUNS.get(info.kind, ()))}"
            for info in scene.infos.values()
        )
        words = {singular(word) for word in re.findall(r"[^\W_]+", own.casefold())}
        self._nouns = {word for word in words if not is_descriptive(word)} | {
            *DESK_NOUNS,
            *_ANYTHING,
        }

    def calls(self, word: str) -> bool:
        """Whether something is called so."""
        return singular(word) in self._nouns

    def told(self, text: str) -> set[str]:
        """Words of a text that tell things and places apart, one for those of one meaning."""
        words = re.findall(r"[^\W_]+", text.casefold())
        return {LEVELS.get(word) or SIDES.get(word) or singular(word) for word in words
                if self._tells(word)}  # fmt: skip

    def mentions(self, text: str) -> list[_Mention]:
        """What a text speaks of, in its order."""
        words = re.findall(r"[^\W_]+|[,.]", text)
        kinds = "".join(
            "T" if self._tells(word) else {"of": "o", "the": "t"}.get(word, "-") for word in words
        )
        found: list[_Mention] = []
        done = 0
        for run in re.finditer("T+(?:ot?T+)*", kinds):
            start, end = run.span()
            is_verb = words[end : end + 1] and words[end] in _DETERMINERS  # "hammer the bolt"
            if is_verb or not self._nouns & {singular(word) for word in words[start:end]}:
                continue
            head = start
            while start > done and words[start - 1] in _DETERMINERS:
                start -= 1
            one = singular(words[end - 1]) == words[end - 1] and len(words[end - 1]) > 2
            article = ["the"] if start == head and one and "the" in words else []
            between = words[done:start]
            link = [*takewhile(_LINKING.__contains__, between[::-1])][::-1]
            joined = not link and not (found and {*between} - {",", "and"})
            unknown = {*between[: len(between) - len(link)]} & {*_DETERMINERS}
            if unknown or link[:1] == ["of"] or words[end : end + 1] == ["s"]:
                break  # another thing is meant, too, or instead
            found.append(_Mention(" ".join([*article, *words[start:end]]), tuple(link), joined))
            done = end
        return found

    def _tells(self, word: str) -> bool:
        told = is_descriptive(word) or word in LEVELS or word in NUMBERS or word.isdigit()
        return told or singular(word) in self._nouns

    def of(self, name: str) -> str:
        """An object or part: by its label, with its colour or number where others have the same.

        What is a phrase already stays as it is.
        """
        owner, _, part = name.partition(".")
        info = self._scene.infos.get(owner)
        if info is None:
            return name if " " in name else f"the {DESK}"
        if part:
            found = next((item for item in info.parts if item.name == part), None)
            if found is None:
                return f"the {part} level of {self.of(owner)}"
            return self._of_part(found)
        alike = [other for other in self._scene.infos.values() if other.label == info.label]
        if len(alike) == 1:
            last = info.label.split()[-1]  # "bin 2", "bin B"
            return info.label if last.isdigit() or len(last) == 1 else f"the {info.label}"
        if info.color and sum(other.color == info.color for other in alike) == 1:
            return f"the {info.color} {info.label}"
        called = info.name.replace("_", " ")
        return called if called.split()[-1].isdigit() else f"the {called}"

    def _of_part(self, part: PartInfo) -> str:
        """A drawer or door; the whole thing where it has no other."""
        info = self._scene.infos[part.owner]
        if len(info.parts) == 1:
            return self.of(part.owner)
        noun = " drawer" if part.joint_type == "slide" and " " not in part.name else ""
        return f"the {part.name.replace('_', ' ')}{noun} of {self.of(part.owner)}"


def _sentence(text: str) -> str:
    plain = " ".join(text.split()).strip(" ,.?!")
    begun = re.sub(r"(?:^|\. )\w", lambda found: found[0].upper(), plain)
    return f"{begun}." if plain else plain

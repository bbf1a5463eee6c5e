"""Ways of saying it that would be read: the sentence itself with the least changed, else its verb
and its things in a shape that is read.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher

from etot_cli.reasoning.builtin.relations import container_parts
from etot_cli.reasoning.language.grammar.text import normalized
from etot_cli.reasoning.language.words import verbs
from etot_cli.reasoning.language.words.known import REASONS
from etot_cli.reasoning.language.words.lexicon import (
    COMMON_NOUNS,
    DESK_NOUNS,
    KIND_NOUNS,
    LEVELS,
    is_descriptive,
    singular,
)
from etot_cli.reasoning.language.words.patterns import words_of
from etot_cli.world.state import DESK, ObjectInfo, PartInfo, SceneState

MAX_TRIES = 16
"""Rewordings that are tried before none is shown: a tenth of a second at the usual time each."""

Reads = Callable[[str, SceneState], bool]

_OPENING, _CLOSING = words_of((verbs.OPEN,)) - {"up"}, words_of((verbs.CLOSE,)) - {"up"}
_UNMADE = re.compile(
    r"\b(?:not|never|neither|nor|no|none|nothing|without|except|but|instead|\w+n't)\b",
    re.IGNORECASE,
)
"""Words that turn a meaning round: what they are about is no part of a rewording, nor are they
left out of one."""
_NEARNESS = re.compile(r"\bclose(?:r|st)? (?:to|as)\b")
_BARE = re.compile(r"(?:the|a|an)\b", re.IGNORECASE)
"""What begins so has lost its verb."""
_ATTRIBUTES = ("color", "colour", "size", "shape", "side", "same")
_BESIDE = ("near", "nearest", "beside", "next", "left", "right", "behind", "between", "where")
_PICKING = words_of((verbs.PICK,)) - {"of", "me", "and", "place", "up"}
_INTO = ("in", "into", "inside", "within")
_AWAY = ("from", "off", "out", "away")
_BEFORE_PLACES = (
    *_INTO, *_AWAY, "on", "onto", "atop", "over", "to", "under", "above", "below", "beside",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Refused:
    """An instruction that was refused, and at which words.

    ``word``: of the phrase, the words to blame. ``without``: the sentence without them.
    ``candidates``: names that may have been meant. ``understood``: what comes before the phrase.
    """

    instruction: str
    phrase: str
    word: str = ""
    without: str = ""
    candidates: tuple[str, ...] = ()
    understood: str = ""


def rewordings(refused: Refused, scene: SceneState, reads: Reads) -> Iterator[str]:
    """Instructions near the refused one that are read in this scene, the nearest first."""
    tried: set[str] = set()
    for text in _near(refused, scene):
        plain = _sentence(text)
        if plain in tried or len(tried) >= MAX_TRIES:
            continue
        tried.add(plain)
        if plain != _sentence(refused.instruction) and reads(plain, scene):
            yield plain


def _near(refused: Refused, scene: SceneState) -> Iterator[str]:
    text, names = normalized(refused.instruction), _Names(scene)
    unmade = _UNMADE.findall(text)
    parts = re.split("[;.]", _NEARNESS.sub("near", text))
    meant = ". ".join(part for part in parts if not _UNMADE.search(part))  # others mean another
    mentions = _mentions(meant, scene, names)
    said = [mention.info for mention in mentions]
    yield from (
        near
        for near in _changed(refused, said, names, scene)
        if _UNMADE.findall(normalized(near)) == unmade
    )
    spoken = [mention.info for mention in _mentions(text, scene, names)]
    barred = [info for info in spoken if info not in said]
    yield from _same_shape(meant, mentions, names, scene, barred)


def _changed(
    refused: Refused, said: Sequence[ObjectInfo], names: _Names, scene: SceneState
) -> Iterator[str]:
    """The sentence with the words exchanged or left out at which it was refused."""
    text = refused.instruction
    part = re.search(rf"\bof\s+{re.escape(refused.phrase)}", normalized(text))
    for name in () if part else refused.candidates[:3]:  # no part of a name ("box of plasters")
        yield _replaced(text, refused.phrase, names.of(name))
    if refused.without and not refused.understood:
        yield f"Put {refused.without}"  # in place of a verb that is not known
        if _BARE.match(refused.without):
            yield f"Pick up {refused.without}"
    for shorter in (refused.word and _replaced(text, refused.word, ""), refused.without):
        if shorter and not _BARE.match(shorter):
            yield shorter
    if refused.understood:
        yield refused.understood
    denied = _UNMADE.search(normalized(text)) or refused.word in REASONS
    if refused.word and not (refused.candidates or denied or _is_attribute(refused.word)):
        others = sorted(
            (info for info in scene.infos.values() if info not in said),
            key=lambda info: (
                not info.movable,
                -SequenceMatcher(None, refused.word, info.label).ratio(),
            ),
        )
        for info in others[:4]:
            yield _replaced(text, refused.phrase, names.of(info.name))


@dataclass(frozen=True, slots=True)
class _Mention:
    """An object that a sentence speaks of, what to call it, and the preposition before it."""

    info: ObjectInfo
    name: str
    before: str


def _mentions(text: str, scene: SceneState, names: _Names) -> list[_Mention]:
    """The objects that a sentence speaks of, in its order: those called so, else by their kind."""
    words = re.findall(r"[^\W_]+", text.casefold())
    found: list[tuple[int, _Mention]] = []
    for at, word in enumerate(words):
        if is_descriptive(word) and word not in COMMON_NOUNS:
            continue
        best: tuple[int, ObjectInfo, str] | None = None
        for info in scene.infos.values():
            label = re.findall(r"[^\W_]+", f"{info.label} {info.name}".casefold())
            if singular(word) not in map(singular, (*label[-1:], *label, *_kinds(info))):
                continue
            around = {singular(item) for item in words[max(0, at - 3) : at + 2]}
            look = {info.color} & around if info.color else set()
            fit = len(around & {singular(item) for item in label}) * 2 + len(look)
            if best is None or fit > best[0]:
                best = fit, info, names.of(info.name)
            elif fit == best[0] and singular(word) == word:
                best = fit, best[1], f"the {word}"  # any of them, as it is said
        if best is not None and all(mention.info is not best[1] for _, mention in found):
            before = next((w for w in words[at - 1 :: -1] if w in _BEFORE_PLACES), "") if at else ""
            near = words[max(0, at - 4) : at]
            found.append((at, _Mention(best[1], best[2], before if before in near else "")))
    return [mention for _, mention in found]


def _kinds(info: ObjectInfo) -> tuple[str, ...]:
    return KIND_NOUNS.get(info.kind, ())


def _same_shape(
    text: str,
    mentions: Sequence[_Mention],
    names: _Names,
    scene: SceneState,
    barred: Sequence[ObjectInfo],
) -> Iterator[str]:
    """Requests of the sentence's own kind about what it speaks of, and nothing that is barred."""
    words = set(re.findall(r"[^\W_]+", text))
    infos = [mention.info for mention in mentions]
    called = {mention.info.name: mention.name for mention in mentions}

    def name(info: ObjectInfo) -> str:
        return called.get(info.name) or names.of(info.name)

    for verb, known in (("Open", _OPENING), ("Close", _CLOSING)):
        if words & known and not words & (_CLOSING - known if verb == "Open" else _OPENING):
            for info in (*infos, *scene.infos.values()):
                yield from (f"{verb} {names.part(part)}" for part in info.parts)
    themes = [mention.info for mention in mentions if mention.info.movable]
    held = [item.info for item in mentions if item.info.movable and not item.before] or themes
    if words & _PICKING:
        yield from (f"Pick up {name(info)}" for info in held[:2])
    if words & set(_BESIDE) and held and not words & set(_AWAY):
        others = [info for info in infos if info is not held[0]]
        yield from (f"Put {name(held[0])} next to {name(info)}" for info in others[:1])
    places = [item for item in mentions if _holds(item.info)]
    for place in places[::-1]:
        if place.before in _AWAY or (not place.before and place.info.movable):
            continue
        for info in (*held, *_free((*infos, *barred), scene)):
            if info is not place.info:
                yield f"Put {name(info)} {_preposition(place)} {place.name}"
    if words & set(DESK_NOUNS) and not words & set(_AWAY):
        yield from (f"Put {name(info)} on the desk" for info in held[:2])
    yield from (f"Pick up {name(info)}" for info in (*held, *_free((*infos, *barred), scene))[:3])


def _is_attribute(word: str) -> bool:
    """Whether a word says how or where something is: no other thing stands for it."""
    return word in _ATTRIBUTES or word in LEVELS or is_descriptive(word)


def _free(said: Sequence[ObjectInfo], scene: SceneState) -> list[ObjectInfo]:
    """Movable things that were not spoken of, those last that hold others."""
    others = [info for info in scene.infos.values() if info.movable and info not in said]
    return sorted(others, key=_holds)[:3]


def _holds(info: ObjectInfo) -> bool:
    return info.container or bool(container_parts(info)) or info.surface


def _preposition(place: _Mention) -> str:
    into = place.info.container or bool(container_parts(place.info))
    if place.before in _INTO or (into and place.before not in ("on", "onto", "atop")):
        return "in" if into else "on"
    return "on"


class _Names:
    """What people call the things of a scene."""

    def __init__(self, scene: SceneState) -> None:
        self._scene = scene

    def of(self, name: str) -> str:
        """An object or part: by its label, with its colour or number where others have the same."""
        owner, _, part = name.partition(".")
        info = self._scene.infos.get(owner)
        if info is None:
            return f"the {DESK}"
        if part:
            found = next((item for item in info.parts if item.name == part), None)
            if found is None:
                return f"the {part} level of {self.of(owner)}"
            return self.part(found)
        alike = [other for other in self._scene.infos.values() if other.label == info.label]
        if len(alike) == 1:
            last = info.label.split()[-1]  # "bin 2", "bin B"
            return info.label if last.isdigit() or len(last) == 1 else f"the {info.label}"
        if info.color and sum(other.color == info.color for other in alike) == 1:
            return f"the {info.color} {info.label}"
        return info.name.replace("_", " ")

    def part(self, part: PartInfo) -> str:
        """A drawer or door; the whole thing where it has no other."""
        info = self._scene.infos[part.owner]
        if len(info.parts) == 1:
            return self.of(part.owner)
        noun = " drawer" if part.joint_type == "slide" and " " not in part.name else ""
        return f"the {part.name.replace('_', ' ')}{noun} of {self.of(part.owner)}"


def _replaced(text: str, words: str, name: str) -> str:
    """The text with the first occurrence of some words replaced by a name, article and all."""
    pattern = r"\W+".join(re.escape(word) for word in words.replace(",", " ").split())
    article = r"(?:\b(?:the|a|an)\s+)?" if name else ""
    return re.sub(rf"{article}(?<!\w){pattern}(?!\w)", name, text, count=1, flags=re.IGNORECASE)


def _sentence(text: str) -> str:
    plain = " ".join(text.split()).strip(" ,.?!")
    return f"{plain[:1].upper()}{plain[1:]}." if plain else plain

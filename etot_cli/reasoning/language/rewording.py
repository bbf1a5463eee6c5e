"""Ways of saying it that would be read: built from what was said and from this scene."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from etot_cli.reasoning.builtin.relations import container_parts
from etot_cli.reasoning.language.words.lexicon import KIND_NOUNS
from etot_cli.world.state import ObjectInfo, SceneState

MAX_TRIES = 8
"""Rewordings that are tried before none is shown."""

Reads = Callable[[str, SceneState], bool]


@dataclass(frozen=True, slots=True)
class Refused:
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
    tried: set[str] = set()
    for text in _near(refused, scene):
        plain = _sentence(text)
        if plain in tried or len(tried) >= MAX_TRIES:
            continue
        tried.add(plain)
        if plain != _sentence(refused.instruction) and reads(plain, scene):
            yield plain


def _near(refused: Refused, scene: SceneState) -> Iterator[str]:
    text = refused.instruction
    if refused.word and refused.candidates:
        for name in refused.candidates[:3]:
            yield _replaced(text, refused.phrase, name)
    if refused.word:
        yield _replaced(text, refused.word, "")
    if refused.without:
        yield refused.without
    yield from _of_this_scene(text.casefold(), scene)


def _of_this_scene(text: str, scene: SceneState) -> Iterator[str]:
    """Requests about what is there, those about what was spoken of first."""
    said = set(re.findall(r"[^\W\d_]+", text))

    def mentioned(info: ObjectInfo) -> int:
        words = re.findall(r"[^\W\d_]+", f"{info.label} {info.name}".casefold())
        return -len(said & {*words, *KIND_NOUNS.get(info.kind, ())})

    things = sorted(scene.infos.values(), key=mentioned)
    movable = [info for info in things if info.movable]
    parts = [part for info in things for part in info.parts]
    for verb in ("open", "close"):
        if verb in said and parts:
            yield f"{verb} {parts[0].owner}.{parts[0].name}"
    if {"pick", "take", "grab", "lift", "get"} & said and movable:
        yield f"Pick up {movable[0].name}"
    for info in movable[:2]:
        for other in things:
            if other.name != info.name and (other.container or container_parts(other)):
                yield f"Put {info.name} into {other.name}"
                break
        for other in things:
            if other.name != info.name and other.surface:
                yield f"Put {info.name} on {other.name}"
                break
    if movable:
        yield f"Pick up {movable[0].name}"


def _replaced(text: str, words: str, name: str) -> str:
    """The text with the first occurrence of some words replaced by a name, article and all."""
    pattern = r"\W+".join(re.escape(word) for word in words.replace(",", " ").split())
    article = r"(?:\b(?:the|a|an)\s+)?" if name else ""
    return re.sub(rf"{article}(?<!\w){pattern}(?!\w)", name, text, count=1, flags=re.IGNORECASE)


def _sentence(text: str) -> str:
    plain = " ".join(text.split()).strip(" ,.")
    return f"{plain[:1].upper()}{plain[1:]}." if plain else plain

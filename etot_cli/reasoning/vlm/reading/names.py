"""Which object of the scene a name means: exactly one, or a reason why none."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from etot_cli.reasoning.vlm.reading.text import bare, words
from etot_cli.world.colors import BASIC_COLORS
from etot_cli.world.state import DESK, SceneState

_QUALIFIER = re.compile(
    r"(?i)\s+\b(?:from|inside|within|into|in|onto|on|near|next to|beside|behind|under|at|of|with|"
    r"to|against|above)\b\s+"
)
_ARTICLE = re.compile(r"(?i)^(?:the|a|an|that|this)\s+")
_DESK_WORDS = ("desk", "table", "desktop", "tabletop", "table top", "desk top", "desk surface")
_COLOR_WORDS = {**{word: word for word in BASIC_COLORS}, "grey": "gray"}


@dataclass(frozen=True, slots=True)
class Unresolved:
    """Why a name means nothing in particular, for the model and for people."""

    text: str


class Names:
    """Resolves what models call things. The result is always a name that actions may use.

    Args:
        aliases: what a thing may be called → its name; a name must map to itself.
        colors: known colours of things by name.
        marks: numbered marks in the picture → names.
    """

    def __init__(
        self,
        aliases: Iterable[tuple[str, str]],
        colors: Mapping[str, str] | None = None,
        marks: Mapping[int, str] | None = None,
    ) -> None:
        self._exact: dict[str, set[str]] = {}
        self._phrases: list[tuple[frozenset[str], str]] = []
        pairs = list(aliases)
        # A thing's own name is its own, whatever somebody called another thing.
        own = {" ".join(words(name)): name for alias, name in pairs if alias == name}
        for alias, name in pairs:
            key = " ".join(words(alias))
            if own.get(key, name) != name:
                continue
            if key and name not in self._exact.setdefault(key, set()):
                self._exact[key].add(name)
                self._phrases.append((frozenset(key.split()), name))
        self._colors = dict(colors or {})
        self._marks = dict(marks or {})

    @classmethod
    def of_scene(cls, scene: SceneState, marks: Mapping[int, str] | None = None) -> Names:
        """The names of a scene: objects, their parts, and the desk."""
        aliases = [(word, DESK) for word in _DESK_WORDS]
        colors: dict[str, str] = {}
        for info in scene.infos.values():
            aliases += [(info.name, info.name), (info.label, info.name)]
            if info.color is not None:
                colors[info.name] = info.color
            for part in info.parts:
                for owner in (info.name, info.label):
                    aliases += [(f"{owner} {part.name}", part.address),
                                (f"{part.name} {owner}", part.address)]  # fmt: skip
                aliases.append((f"{part.owner}.{part.name}", part.address))
                aliases.append((part.address, part.address))
                aliases.append((part.name, part.address))
        return cls(aliases, colors, marks)

    def resolve(self, written: str) -> str | Unresolved:
        """The one thing that a text means, or why there is none."""
        text = _ARTICLE.sub("", bare(written[:120]))
        if not text:
            return Unresolved("no object is named")
        mark = re.fullmatch(r"(?:label|mark|marker|keypoint|point)?\s*#?(\d{1,2})", text.lower())
        if mark and int(mark[1]) in self._marks:
            return self._marks[int(mark[1])]
        head = _QUALIFIER.split(text, maxsplit=1)[0]
        for attempt in dict.fromkeys((text, head)):
            found = self._exact.get(" ".join(words(attempt)), set())
            if len(found) == 1:
                return next(iter(found))
            if found:
                return self._several(written, found)
        for attempt in dict.fromkeys((head, text)):
            found = self._mentioned(attempt) or self._abbreviated(attempt)
            if len(found) == 1:
                return next(iter(found))
            if found:
                return self._several(written, found)
        return Unresolved(f"the scene has no {bare(written[:60])!r}")

    def _mentioned(self, text: str) -> set[str]:
        """Things whose whole name occurs in the text, the longest names only."""
        given = set(words(text))
        hits = [
            (len(phrase), name)
            for phrase, name in self._phrases
            if phrase <= given and self._color_fits(name, given - phrase)
        ]
        longest = max((size for size, _ in hits), default=0)
        return {name for size, name in hits if size == longest}

    def _abbreviated(self, text: str) -> set[str]:
        """Things of whose names the text is a part."""
        given = set(words(text)) - {"the", "a", "an"}
        if not given:
            return set()
        return {name for phrase, name in self._phrases if given <= phrase}

    def _color_fits(self, name: str, extra: set[str]) -> bool:
        colors = {_COLOR_WORDS[word] for word in extra if word in _COLOR_WORDS}
        own = self._colors.get(name)
        return not colors or own is None or own in colors

    @staticmethod
    def _several(written: str, found: set[str]) -> Unresolved:
        return Unresolved(f"{bare(written[:60])!r} may mean {' or '.join(sorted(found))}")

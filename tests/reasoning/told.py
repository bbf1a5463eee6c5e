"""Instructions whose meaning is known by construction, in many words.

A thing is described in one of the ways that single it out in its scene, worked out here from
positions, sizes and colours with margins, and asked for in one of the sentences of a family. Beside
it stands the same in plain sentences with the things' own names.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from etot_cli.world.state import SceneState, owner_of

APART = 0.08
"""What is further left, or nearer to something, is so by this at least [m]."""
BIGGER = 1.5
"""What is bigger has so many times the volume."""


@dataclass(frozen=True, slots=True)
class Told:
    """An instruction and what it means: plain sentences; ``ordered`` where their order counts."""

    text: str
    plain: str
    ordered: bool = False


def noun(scene: SceneState, name: str) -> str:
    """The last word of what a thing is called."""
    return scene.infos[name].label.split()[-1]


def several(word: str) -> str:
    """The plural of a noun."""
    if word.endswith(("s", "x", "ch", "sh")):
        return f"{word}es"
    if word.endswith("y") and word[-2] not in "aeiou":
        return f"{word[:-1]}ies"
    return {"knife": "knives", "shelf": "shelves"}.get(word, f"{word}s")


def support(scene: SceneState, name: str) -> str | None:
    """What something is in, or else on."""
    state = scene.states[name]
    return state.inside or (state.on[0] if state.on else None)


def is_unique(scene: SceneState, name: str) -> bool:
    """Whether nothing else is called so."""
    labels = [info.label for info in scene.infos.values()]
    return labels.count(scene.infos[name].label) == 1


def phrases(scene: SceneState, name: str, *, plain: bool = False) -> Iterator[str]:
    """Descriptions that fit one thing alone; ``plain``: none that a place behind it may be
    mistaken for where it goes ("the cup on the tray").
    """
    info, state = scene.infos[name], scene.states[name]
    word = noun(scene, name)
    alike = [other for other in scene.infos if noun(scene, other) == word]
    others = [other for other in alike if other != name]
    if is_unique(scene, name):
        yield f"the {info.label}"
    colored = all(scene.infos[other].plain_color for other in alike) and info.color is not None
    if colored and info.color not in [scene.infos[other].color for other in others]:
        yield f"the {info.color} {word}"
        yield f"the {word} that is {info.color}"
    under = support(scene, name)
    alone = under not in [support(scene, other) for other in others]
    if under in scene.infos and alone and not plain and is_unique(scene, str(under)):
        relation, there = "in" if state.inside else "on", scene.infos[str(under)].label
        yield f"the {word} {relation} the {there}"
        yield f"the {word} that is {relation} the {there}"
    if not others or any(support(scene, other) != "desk" for other in alike):
        return
    sideways = [scene.states[other].position[1] - state.position[1] for other in others]
    for side, away in (("left", max(sideways)), ("right", -min(sideways))):
        if away < -APART:
            yield f"the {side}most {word}"
            if len(others) == 1:
                yield f"the {side} {word}"
    volume = math.prod(info.size)
    volumes = [math.prod(scene.infos[other].size) for other in others]
    if volume > BIGGER * max(volumes):
        yield f"the bigg{'er' if len(others) == 1 else 'est'} {word}"
    if BIGGER * volume < min(volumes):
        yield f"the small{'er' if len(others) == 1 else 'est'} {word}"
    for mark in scene.infos:
        if mark in alike or not is_unique(scene, mark) or support(scene, mark) != "desk":
            continue
        own, *further = (
            math.dist(scene.states[other].position[:2], scene.states[mark].position[:2])
            for other in (name, *others)
        )
        if own + APART < min(further) and not plain:
            yield f"the {word} nearest to the {scene.infos[mark].label}"
            yield f"the {word} that is closest to the {scene.infos[mark].label}"
            yield f"the {word} nearest the {scene.infos[mark].label}"


def begun(sentence: str) -> str:
    """As a sentence begins."""
    return sentence[:1].upper() + sentence[1:]


class Teller:
    """Tells instructions about a scene.

    Args:
        scene: what they are about.
        draw: what is chosen at random.
    """

    def __init__(self, scene: SceneState, draw: random.Random) -> None:
        self.scene, self.draw = scene, draw
        self.movable = [name for name, info in scene.infos.items() if info.movable]

    def named(self, name: str) -> str:
        """A thing's own name."""
        return name.replace("_", " ")

    def phrase(self, name: str, *, plain: bool = False) -> str | None:
        """One of a thing's descriptions."""
        found = list(phrases(self.scene, name, plain=plain))
        return self.draw.choice(found) if found else None

    def things(self, count: int, besides: Sequence[str] = ()) -> list[str] | None:
        """So many things that can be moved, none on or in another one of them."""
        ready = [n for n in self.movable if n not in besides and self.phrase(n, plain=True)]
        found = self.draw.sample(ready, count) if len(ready) >= count else []
        free = not any(owner_of(at) in found for name in found for at in self._below(name))
        return found if found and free else None

    def place(self, besides: Sequence[str]) -> tuple[str, str] | None:
        """Where something can be put: in words, and plainly."""
        infos = self.scene.infos
        ready = [
            name
            for name, info in infos.items()
            if (info.container or (info.surface and info.kind == "box"))
            and not (info.parts or info.boards or name in besides)
            and self.phrase(name)
            and not any(owner_of(at) in besides for at in self._below(name))
        ]
        if not ready:
            return None
        name = self.draw.choice(ready)
        said, plain = (
            (("in", "into", "inside"), "into")
            if infos[name].container
            else (("on", "onto", "on top of"), "onto")
        )
        return f"{self.draw.choice(said)} {self.phrase(name)}", f"{plain} {self.named(name)}"

    def _below(self, name: str) -> list[str]:
        """What something is in or on, all the way down."""
        under = support(self.scene, name)
        if under is None or owner_of(under) not in self.scene.infos:
            return [] if under is None else [under]
        return [under, *self._below(owner_of(under))]

    def beside(self, besides: Sequence[str]) -> tuple[str, str] | None:
        """A place next to something."""
        marks = [
            name
            for name in self.scene.infos
            if name not in besides and support(self.scene, name) == "desk" and self.phrase(name)
        ]
        if not marks:
            return None
        mark = self.draw.choice(marks)
        said, plain = self.draw.choice(
            (
                ("to the left of", "left of"), ("right of", "right of"), ("behind", "behind"),
                ("in front of", "in front of"), ("beside", "next to"), ("close to", "near"),
            )
        )  # fmt: skip
        return f"{said} {self.phrase(mark)}", f"{plain} {self.named(mark)}"

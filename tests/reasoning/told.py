"""Instructions whose meaning is known by construction, in many words.

A thing is described in one of the ways that single it out in its scene, worked out here from
positions, sizes and colours with margins, and asked for in one of the sentences of a family. Beside
it stands the same in plain sentences with the things' own names.
"""

from __future__ import annotations

import math
import random
import re
from collections.abc import Callable, Iterator, Sequence
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


def _support(scene: SceneState, name: str) -> str | None:
    state = scene.states[name]
    return state.inside or (state.on[0] if state.on else None)


def _is_unique(scene: SceneState, name: str) -> bool:
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
    if _is_unique(scene, name):
        yield f"the {info.label}"
    colored = all(scene.infos[other].plain_color for other in alike) and info.color is not None
    if colored and info.color not in [scene.infos[other].color for other in others]:
        yield f"the {info.color} {word}"
        yield f"the {word} that is {info.color}"
    under = _support(scene, name)
    alone = under not in [_support(scene, other) for other in others]
    if under in scene.infos and alone and not plain and _is_unique(scene, str(under)):
        relation, there = "in" if state.inside else "on", scene.infos[str(under)].label
        yield f"the {word} {relation} the {there}"
        yield f"the {word} that is {relation} the {there}"
    if not others or any(_support(scene, other) != "desk" for other in alike):
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
        if mark in alike or not _is_unique(scene, mark) or _support(scene, mark) != "desk":
            continue
        own, *further = (
            math.dist(scene.states[other].position[:2], scene.states[mark].position[:2])
            for other in (name, *others)
        )
        if own + APART < min(further) and not plain:
            yield f"the {word} nearest to the {scene.infos[mark].label}"
            yield f"the {word} that is closest to the {scene.infos[mark].label}"
            yield f"the {word} nearest the {scene.infos[mark].label}"


def _begun(sentence: str) -> str:
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
        """So many things that can be moved."""
        ready = [n for n in self.movable if n not in besides and self.phrase(n, plain=True)]
        return self.draw.sample(ready, count) if len(ready) >= count else None

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
        under = _support(self.scene, name)
        if under is None or owner_of(under) not in self.scene.infos:
            return [] if under is None else [under]
        return [under, *self._below(owner_of(under))]

    def beside(self, besides: Sequence[str]) -> tuple[str, str] | None:
        """A place next to something."""
        marks = [
            name
            for name in self.scene.infos
            if name not in besides and _support(self.scene, name) == "desk" and self.phrase(name)
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


Family = Callable[[Teller], "Told | None"]
_SOMEWHERE = (
    "Put {x} {p}.", "Place {x} {p}.", "Take {x} and put it {p}.", "Pick up {x} and place it {p}.",
    "Pick {x} up and put it {p}.", "Grab {x} and drop it {p}.", "{X} goes {p}.",
    "{X} should be {p}.", "I want {x} {p}.", "Could you put {x} {p}?", "Please put {x} {p}.",
    "Make sure {x} is {p}.", "{X} needs to go {p}.", "{X} belongs {p}.", "Find {x} and put it {p}.",
    "I would like {x} to be {p}.", "{X} has to end up {p}.", "Pick up {x}. Put it {p}.",
    "Take {x}, then place it {p}.", "Have {x} placed {p}.", "I need {x} {p}.", "{P} goes {x}.",
    "{X} must be placed {p}.", "Carry {x} over and set it {p}.", "The robot should put {x} {p}.",
    "Your task is to put {x} {p}.", "Move {x} so that it is {p}.",
)  # fmt: skip
_DOING = (
    "put {x} {p}", "take {x} and put it {p}", "pick up {x} and place it {p}", "place {x} {p}",
    "set {x} {p}", "grab {x} and put it {p}", "bring {x} over and put it {p}",
)  # fmt: skip
_JOINED = (
    ("{a}. {b}.", False), ("{a} and {b}.", False), ("{a}, then {b}.", True),
    ("{a} and then {b}.", True), ("First {a}, then {b}.", True), ("{a}. After that, {b}.", True),
    ("{b}, but first {a}.", True), ("{a} before you {b}.", True), ("{a}; {b}.", False),
    ("After you {a}, {b}.", True), ("{b} after you {a}.", True), ("{a}. Finally, {b}.", True),
    ("{a}. Next, {b}.", True), ("{b}. Before that, {a}.", True),
)  # fmt: skip


def somewhere(tell: Teller) -> Told | None:
    """One thing goes to a place."""
    found = tell.things(1)
    if not found:
        return None
    (name,) = found
    place = tell.beside(found) if tell.draw.random() < 0.3 else tell.place(found)
    said = tell.phrase(name)
    if place is None or said is None:
        return None
    text = tell.draw.choice(_SOMEWHERE)
    text = text.format(x=said, X=_begun(said), p=place[0], P=_begun(place[0]))
    return Told(text, f"Put {tell.named(name)} {place[1]}.")


def one_after_the_other(tell: Teller) -> Told | None:
    """Two things, each to its place, in an order or in none."""
    found = tell.things(2)
    first = found and tell.place(found)
    second = found and tell.place(found)
    said = [tell.phrase(name) for name in found or ()]
    if not found or not first or not second or None in said:
        return None
    a, b = (
        tell.draw.choice(_DOING).format(x=words, p=place[0])
        for words, place in zip(said, (first, second), strict=True)
    )
    joint, ordered = tell.draw.choice(_JOINED)
    text = re.sub(r"\. (\w)", lambda at: f". {at[1].upper()}", _begun(joint.format(a=a, b=b)))
    plain = f"Put {tell.named(found[0])} {first[1]}. Then put {tell.named(found[1])} {second[1]}."
    return Told(text, plain, ordered)


def together(tell: Teller) -> Told | None:
    """Several things go to the same place."""
    found = tell.things(tell.draw.choice((2, 3)))
    place = found and tell.place(found)
    if not found or not place:
        return None
    *some, last = (tell.phrase(name, plain=True) for name in found)
    listed = f"{', '.join(map(str, some))} and {last}"
    text = tell.draw.choice(
        ("Put {x} {p}.", "{X} go {p}.", "Take {x} and put them {p}.", "I want {x} {p}.",
         "Gather {x} and put them {p}.", "{X} should be {p}.", "Pick up {x}. Put them {p}.")
    ).format(x=listed, X=_begun(listed), p=place[0])  # fmt: skip
    return Told(text, " ".join(f"Put {tell.named(name)} {place[1]}." for name in found))


def each_its_own(tell: Teller) -> Told | None:
    """Two things, each to its place, with one verb or none."""
    found = tell.things(2)
    first = found and tell.place(found)
    second = found and tell.place(found)
    if not found or not first or not second or first[1] == second[1]:
        return None
    a, b = (tell.phrase(name, plain=True) for name in found)
    text = tell.draw.choice(
        ("Put {a} {d} and {b} {e}.", "Put {a} {d}, and {b} {e}.", "{A} goes {d} and {b} {e}.",
         "{A} {d}, {b} {e}.", "{A} should be {d} and {b} {e}.", "I want {a} {d} and {b} {e}.",
         "Put {a} {d}. {B} goes {e}.")
    ).format(a=a, b=b, A=_begun(str(a)), B=_begun(str(b)), d=first[0], e=second[0])  # fmt: skip
    plain = f"Put {tell.named(found[0])} {first[1]}. Put {tell.named(found[1])} {second[1]}."
    return Told(text, plain)


def _alike(tell: Teller) -> list[str] | None:
    """Several things of one noun."""
    groups: dict[str, list[str]] = {}
    for name in tell.movable:
        groups.setdefault(noun(tell.scene, name), []).append(name)
    ready = [names for names in groups.values() if len(names) > 1]
    return tell.draw.choice(ready) if ready else None


def all_of_them(tell: Teller) -> Told | None:
    """All of a noun, or all but one."""
    found = _alike(tell)
    place = found and tell.place(found)
    if not found or not place:
        return None
    word = noun(tell.scene, found[0])
    left_out = tell.draw.choice((None, *found))
    but = left_out and tell.phrase(left_out, plain=True)
    if but is None:
        every = tell.draw.choice(
            (f"all the {several(word)}", f"every {word}", f"the {several(word)}", f"each {word}",
             f"all {several(word)}", f"all of the {several(word)}")
        )  # fmt: skip
        if len(found) == 2:
            every = tell.draw.choice((every, f"both {several(word)}", f"the two {several(word)}"))
        return Told(
            f"Put {every} {place[0]}.",
            " ".join(f"Put {tell.named(name)} {place[1]}." for name in found),
        )
    text = tell.draw.choice(
        ("Put all the {s} except {x} {p}.", "Put every {w} but {x} {p}.",
         "Put all the {s} {p}, but not {x}.", "Put the {s} {p}, except for {x}.",
         "Put all {s} other than {x} {p}.", "Put all the {s} {p}, and leave {x} where it is.")
    ).format(s=several(word), w=word, x=but, p=place[0])  # fmt: skip
    rest = [name for name in found if name != left_out]
    return Told(text, " ".join(f"Put {tell.named(name)} {place[1]}." for name in rest))


def the_other_one(tell: Teller) -> Told | None:
    """One of two goes here, the other one there."""
    found = _alike(tell)
    first = found and tell.place(found)
    second = found and tell.place(found)
    if not found or len(found) != 2 or not first or not second or first[1] == second[1]:
        return None
    one, other = tell.draw.sample(found, 2)
    said = tell.phrase(one, plain=True)
    if said is None:
        return None
    text = tell.draw.choice(
        ("Put {x} {d} and the other one {e}.", "Put {x} {d} and the other {w} {e}.",
         "Put {x} {d}. The other one goes {e}.", "Take {x} and put it {d}, then put the other {e}.")
    ).format(x=said, w=noun(tell.scene, one), d=first[0], e=second[0])  # fmt: skip
    plain = f"Put {tell.named(one)} {first[1]}. Put {tell.named(other)} {second[1]}."
    return Told(text, plain)


def with_a_constraint(tell: Teller) -> Told | None:
    """Something is put somewhere while something else is left alone."""
    found = tell.things(2)
    place = found and tell.place(found)
    if not found or not place:
        return None
    (name, kept), (a, b) = found, (tell.phrase(item, plain=True) for item in found)
    form, plain = tell.draw.choice(
        (("Put {a} {p} without touching {b}.", "touch"), ("Don't move {b}. Put {a} {p}.", "move"),
         ("Put {a} {p} without moving {b}.", "move"), ("Put {a} {p}, but don't move {b}.", "move"),
         ("Put {a} {p} and leave {b} where it is.", "move"))
    )  # fmt: skip
    text = form.format(a=a, b=b, p=place[0])
    return Told(text, f"Do not {plain} {tell.named(kept)}. Put {tell.named(name)} {place[1]}.")


def in_the_hand(tell: Teller) -> Told | None:
    """One thing is wanted in the hand."""
    found = tell.things(1)
    said = found and tell.phrase(found[0])
    if not found or not said:
        return None
    text = tell.draw.choice(
        ("Pick up {x}.", "Grab {x}.", "Take {x}.", "Lift {x}.", "Pick {x} up, please.", "Hold {x}.",
         "Could you pick up {x}?", "Get {x} for me.", "Fetch {x}.", "Give me {x}.")
    ).format(x=said)  # fmt: skip
    return Told(text, f"Pick up {tell.named(found[0])}.")


def behind_a_door(tell: Teller) -> Told | None:
    """Something goes into furniture that is opened or closed."""
    infos = tell.scene.infos
    ready = [n for n, i in infos.items() if len(i.parts) == 1 and _is_unique(tell.scene, n)]
    found = tell.things(1)
    if not ready or not found:
        return None
    (name,), owner = found, tell.draw.choice(ready)
    said, under = tell.phrase(name), _support(tell.scene, name)
    if said is None or (under and owner_of(under) == owner) or infos[owner].label in said:
        return None
    text, steps = tell.draw.choice(
        (("Open {o}, put {x} in it and close it.", "oic"), ("Put {x} in {o} and close it.", "ic"),
         ("Open {o}, put {x} inside, and close it again.", "oic"),
         ("Open {o} and put {x} into it.", "oi"), ("After you put {x} in {o}, close it.", "ic"),
         ("Close {o} after putting {x} in it.", "ic"),
         ("{X} goes in {o}. Close it afterwards.", "ic"))
    )  # fmt: skip
    said_owner, own = f"the {infos[owner].label}", tell.named(owner)
    sentences = {
        "o": f"Open {own}.",
        "i": f"Put {tell.named(name)} into {own}.",
        "c": f"Close {own}.",
    }
    plain = " ".join(sentences[step] for step in steps)
    return Told(text.format(o=said_owner, x=said, X=_begun(said)), plain, ordered=True)


FAMILIES: tuple[Family, ...] = (
    somewhere, one_after_the_other, together, each_its_own, all_of_them, the_other_one,
    with_a_constraint, in_the_hand, behind_a_door,
)  # fmt: skip


def terse(text: str) -> str:
    """Without articles, as notes are written."""
    return _begun(re.sub(r"\b[Tt]he ", "", text))

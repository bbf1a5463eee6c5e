"""Families of instructions whose meaning is known by construction (see ``told``)."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.world.state import owner_of
from tests.reasoning.told import Teller, Told, begun, is_unique, noun, several, support

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
    text = text.format(x=said, X=begun(said), p=place[0], P=begun(place[0]))
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
    text = re.sub(r"\. (\w)", lambda at: f". {at[1].upper()}", begun(joint.format(a=a, b=b)))
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
    ).format(x=listed, X=begun(listed), p=place[0])  # fmt: skip
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
    ).format(a=a, b=b, A=begun(str(a)), B=begun(str(b)), d=first[0], e=second[0])  # fmt: skip
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
    plain = " ".join(f"Put {tell.named(name)} {place[1]}." for name in rest)
    if text.endswith("where it is."):
        plain += f" Do not move {tell.named(left_out)}."
    return Told(text, plain)


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
    ready = [n for n, i in infos.items() if len(i.parts) == 1 and is_unique(tell.scene, n)]
    found = tell.things(1)
    if not ready or not found:
        return None
    (name,), owner = found, tell.draw.choice(ready)
    said, under = tell.phrase(name), support(tell.scene, name)
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
    return Told(text.format(o=said_owner, x=said, X=begun(said)), plain, ordered=True)


def between_things(tell: Teller) -> Told | None:
    """Something goes between two others."""
    found = tell.things(3)
    said = [tell.phrase(name, plain=True) for name in found or ()]
    if not found:
        return None
    text = tell.draw.choice(
        ("Put {x} between {a} and {b}.", "{X} should stand between {a} and {b}.",
         "Move {x} so that it is between {a} and {b}.", "Between {a} and {b}, put {x}.")
    ).format(x=said[0], X=begun(str(said[0])), a=said[1], b=said[2])  # fmt: skip
    x, a, b = map(tell.named, found)
    return Told(text, f"Put {x} between {a} and {b}.")


_AREAS = {
    "on the left side of the desk": ("on the left side of the table", "on the left of the desk"),
    "on the right side of the desk": ("on the right half of the desk", "on the right of the table"),
    "at the front of the desk": ("at the front of the table", "on the front part of the table"),
    "at the back of the desk": ("at the back of the table", "at the back of the desk"),
    "in the middle of the desk": ("in the centre of the table", "in the middle of the table"),
    "at the edge of the desk": ("at the edge of the table", "on the edge of the desk"),
    "in a corner of the desk": ("in a corner of the table", "in the corner of the desk"),
}


def in_an_area(tell: Teller) -> Told | None:
    """Something goes to a part of the desk."""
    found = tell.things(1)
    said = found and tell.phrase(found[0], plain=True)
    if not found or not said:
        return None
    area = tell.draw.choice(list(_AREAS))
    text = tell.draw.choice(
        ("Put {x} {p}.", "Move {x} so that it is {p}.", "{X} should be {p}.", "{X} belongs {p}.",
         "Pick up {x} and put it {p}.", "I want {x} {p}.", "Take {x} and place it {p}, please.")
    ).format(x=said, X=begun(said), p=tell.draw.choice(_AREAS[area]))  # fmt: skip
    return Told(text, f"Put {tell.named(found[0])} {area}.")


def one_or_the_other(tell: Teller) -> Told | None:
    """A choice of things, or of places."""
    found = tell.things(2)
    first = found and tell.place(found)
    second = found and tell.place(found)
    if not found or not first or not second or first[1] == second[1]:
        return None
    a, b = (tell.phrase(name, plain=True) for name in found)
    x, y = map(tell.named, found)
    text, plain = tell.draw.choice(
        (("Put {a} or {b} {d}.", f"Put {x} or {y} {first[1]}."),
         ("Put either {a} or {b} {d}.", f"Put {x} or {y} {first[1]}."),
         ("{A} or {b} should be {d}.", f"Put {x} or {y} {first[1]}."),
         ("Put {a} {d} or {e}.", f"Put {x} {first[1]} or {second[1]}."),
         ("Put {a} either {d} or {e}.", f"Put {x} {first[1]} or {second[1]}."))
    )  # fmt: skip
    return Told(text.format(a=a, A=begun(str(a)), b=b, d=first[0], e=second[0]), plain)


def rather_than(tell: Teller) -> Told | None:
    """One thing, and not another one."""
    found = tell.things(2)
    place = found and tell.place(found)
    if not found or not place:
        return None
    a, b = (tell.phrase(name, plain=True) for name in found)
    text = tell.draw.choice(
        ("Put {a}, not {b}, {p}.", "Put {a} {p}, not {b}.", "Not {b} but {a} goes {p}.",
         "{A} goes {p}, not {b}.", "Put {a} instead of {b} {p}.")
    ).format(a=a, A=begun(str(a)), b=b, p=place[0])  # fmt: skip
    return Told(text, f"Put {tell.named(found[0])} {place[1]}.")


def by_then(tell: Teller) -> Told | None:
    """What has to be done, or to be so, before something else is done."""
    found = tell.things(2)
    first = found and tell.place(found)
    second = found and tell.place(found)
    if not found or not first or not second:
        return None
    a, b = (tell.phrase(name, plain=True) for name in found)
    text = tell.draw.choice(
        ("After putting {a} {d}, put {b} {e}.", "Before putting {b} {e}, put {a} {d}.",
         "Put {b} {e} after {a} has been put {d}.", "Having put {a} {d}, put {b} {e}.",
         "Put {a} {d} before {b} goes {e}.", "{A} goes {d} before {b} goes {e}.",
         "Start by putting {a} {d}, then put {b} {e}.", "Put {a} {d}; {b} then goes {e}.")
    ).format(a=a, A=begun(str(a)), b=b, d=first[0], e=second[0])  # fmt: skip
    plain = f"Put {tell.named(found[0])} {first[1]}. Then put {tell.named(found[1])} {second[1]}."
    return Told(text, plain, ordered=True)


FAMILIES: tuple[Family, ...] = (
    somewhere, one_after_the_other, together, each_its_own, all_of_them, the_other_one,
    with_a_constraint, in_the_hand, behind_a_door, between_things, in_an_area, one_or_the_other,
    rather_than, by_then,
)  # fmt: skip


def terse(text: str) -> str:
    """Without articles, as notes are written, but for "the other"."""
    return begun(re.sub(r"\b[Tt]he (?!other)", "", text))

"""A scene and what happened in it, in words for a model. Coarse numbers only: they enter keys."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import combinations

from etot_cli.reasoning.vlm.chat import Picture
from etot_cli.reasoning.vlm.frames import Eye
from etot_cli.skills.action import Action
from etot_cli.world.state import DESK, ObjectInfo, ObjectState, RolloutRecord, SceneState

MAX_EVENTS = 8
"""Contacts that are told, the first ones."""
MAX_LABEL = 80
"""Of a label in a question; it is a noun with a few words [characters]."""
NOTABLE_FORCE = 0.1
"""Contacts with less force tell nothing [N]."""
AT_START_S = 0.05
"""What touches earlier has touched since before the action [s]."""
NOTABLE_WAY = 0.02
"""Objects displaced by less have stayed [m]."""
ASLANT = 0.38
"""A direction is told by two words where the lesser of its parts is more than this share of the
greater one: tan 21°, about halfway between an axis and the diagonal."""
_TELLS_NOTHING = re.compile(r"\d+|\b[a-z]\b")
"""Numbers and single letters in a name, which nobody can see in a picture."""


def object_list(scene: SceneState) -> str:
    """All names that actions may use, in one line."""
    names = []
    for info in scene.infos.values():
        names.append(info.name)
        if len(info.parts) > 1:
            names += [part.address for part in info.parts]
    return ", ".join([*names, DESK])


def catalogue(scene: SceneState) -> str:
    """One line per object: name, what people call it, colour, size, position, what it affords."""
    lines = [f"- {entry(info, scene.states[info.name])}" for info in scene.infos.values()]
    left, right, near, far = (f"{bound * 100:.0f}" for bound in scene.desk_bounds)
    top = f"{scene.desk_top * 100:.0f}"
    return "\n".join(
        [*lines, f"- {DESK}: the table top, a surface, x {left} to {right}, y {near} to {far}, "
                 f"its height z {top}"]
    )  # fmt: skip


def entry(info: ObjectInfo, state: ObjectState) -> str:
    """One object's line of the catalogue."""
    facts = []
    plain = info.name.replace("_", " ").lower()
    label = _one_line(info.label)
    if label != plain:
        facts.append(label)
    if info.color is not None and info.color not in plain and info.color not in info.label:
        facts.append(info.color)
    sides = " × ".join(f"{side * 100:.0f}" for side in info.size)
    facts.append(f"{sides} cm")
    if not state.lost:
        facts.append(f"at {_point(state.position)}")
    if not info.movable:
        facts.append("fixed")
    if info.container:
        facts.append("a container")
    if info.surface and not info.movable:
        facts.append("its top is a surface")
    for part in info.parts:
        what = "drawer" if part.joint_type == "slide" else "door"
        facts.append(f"has a {what} ({part.address})")
    return f"{info.name}: {', '.join(facts)}"


def _point(position: Sequence[float]) -> str:
    """A position in whole centimetres; -0 is 0."""
    return f"({', '.join(str(round(value * 100)) for value in position)})"


def alike(scene: SceneState) -> bool:
    """Whether two objects' names do not tell which is which in a picture.

    So it is with names that differ in a number or a letter only, and with things of one look.
    """
    return any(
        _visible_words(one) == _visible_words(other) or _look(one) == _look(other)
        for one, other in combinations(scene.infos.values(), 2)
    )


def _visible_words(info: ObjectInfo) -> str:
    return " ".join(_TELLS_NOTHING.sub(" ", info.name.replace("_", " ").lower()).split())


def _look(info: ObjectInfo) -> tuple[object, ...]:
    """Kind, colour and size [cm]."""
    return (info.kind, info.color, *(round(side * 100) for side in info.size))


def viewpoint(scene: SceneState, eye: Eye | None) -> str:
    """Where the camera is, and what left and up mean in its pictures and in the task.

    Args:
        scene: knows whose left is meant.
        eye: the camera; None without pictures.
    """
    ahead = scene.forward
    told = (
        f"In the task, left is {_direction((-ahead[1], ahead[0]))} and behind is "
        f"{_direction(ahead)}."
    )
    if eye is None:
        return told
    deeper = (eye.ahead[0] + eye.up[0], eye.ahead[1] + eye.up[1])
    return (
        f"The camera is at {_point(eye.position)}. In its pictures of the desk, what is further "
        f"right lies {_direction(eye.right)}, what is further up lies {_direction(deeper)}. {told}"
    )


def _direction(vector: Sequence[float]) -> str:
    """A horizontal direction of the base frame in words."""
    x, y = float(vector[0]), float(vector[1])
    along = "further from the robot" if x > 0 else "nearer to the robot"
    across = "to the robot's left" if y > 0 else "to the robot's right"
    if min(abs(x), abs(y)) > ASLANT * max(abs(x), abs(y)):
        return f"{along} and {across}"
    return along if abs(x) >= abs(y) else across


def pictures(shown: Sequence[Picture]) -> str:
    """What is sent to be seen, in its order."""
    if not shown:
        return "There are no pictures; what is written here is all that is known."
    captions = "; ".join(picture.caption.rstrip(":") for picture in shown)
    return f"{'Pictures, in this order' if len(shown) > 1 else 'One picture'}: {captions}."


def _one_line(text: str) -> str:
    """A label as part of a line: what looks like another line of the list would forge one."""
    line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return line[:MAX_LABEL].replace("- ", "")


def states(scene: SceneState, name: str) -> str:
    """One object's state, such as ``on desk`` or ``inside cup, toppled``."""
    state, info = scene.states[name], scene.infos[name]
    found = []
    if state.lost:
        found.append("lost")
    elif state.in_hand:
        found.append("in hand")
    elif state.inside is not None:
        found.append(f"inside {state.inside}")
    elif state.on:
        found.append(f"on {' and '.join(state.on)}")
    if state.toppled:
        found.append("toppled")
    if not state.reachable and not state.lost and info.movable:
        found.append("out of reach")
    for part in info.parts:
        share = scene.openness(part)
        if state.opened.get(part.name):
            word = "open"
        else:
            word = "closed" if share <= 0.06 else "ajar" if share < 0.4 else "half open"
        found.append(word if len(info.parts) == 1 else f"{part.name} {word}")
    return ", ".join(found) or "nowhere in particular"


def relations(scene: SceneState) -> str:
    """One line per object with its state."""
    lines = [f"- {name}: {states(scene, name)}" for name in scene.states]
    lines.append(f"- the hand: {'holds ' + scene.holding if scene.holding else 'empty'}")
    return "\n".join(lines)


def changes(record: RolloutRecord) -> str:
    """What is different after an action, one line per object, under a heading."""
    lines = []
    for name in record.before.states:
        before, after = states(record.before, name), states(record.after, name)
        if before != after:
            lines.append(f"- {name}: {before} → {after}")
        elif record.displacement.get(name, 0.0) > NOTABLE_WAY:
            lines.append(f"- {name}: moved by {record.displacement[name] * 100:.0f} cm, {after}")
    return "What changed while it was carried out:\n" + ("\n".join(lines) or "- nothing")


def events(record: RolloutRecord) -> str:
    """The contacts that matter, in order of time; empty without any."""
    lines = [
        f"- {event.time_s:.1f} s: {event.first} touches {event.second}"
        for event in record.contacts
        if event.time_s >= AT_START_S
        and event.peak_force >= NOTABLE_FORCE
        and {event.first, event.second} - {DESK, "robot"}
    ]
    if not lines:
        return ""
    return "What touched what:\n" + "\n".join(lines[:MAX_EVENTS])


def numbered(actions: Sequence[Action]) -> str:
    """A plan, one step per line."""
    return "\n".join(f"{i}. {written(action)}" for i, action in enumerate(actions, 1))


def written(action: Action) -> str:
    """An action with its note."""
    return f"{action} (safe place)" if action.safe else str(action)


def marks_line(marks: Mapping[int, str]) -> str:
    """What the numbered marks in the picture stand for; empty without marks."""
    if not marks:
        return ""
    return "Marks in the picture: " + ", ".join(f"{n} = {name}" for n, name in marks.items())

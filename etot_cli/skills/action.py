"""The five action primitives and how they are written.

Source: paper, section "Action Skills Set". Written form: ``[PICK UP, pen] (vertical)``,
``[PUT ON, desk] (left of plate)``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum

from etot_cli.errors import PlanSyntaxError
from etot_cli.world.spatial import Nearby, Whereabouts


class Verb(StrEnum):
    """An action primitive; the value is its written form."""

    PICK_UP = "PICK UP"
    PUT_ON = "PUT ON"
    PUT_INTO = "PUT INTO"
    OPEN = "OPEN"
    CLOSE = "CLOSE"


PUTS = (Verb.PUT_ON, Verb.PUT_INTO)
"""What empties the hand."""


class GraspPose(StrEnum):
    """How an object is picked up: from the side with level fingers, or from above."""

    HORIZONTAL = "horizontal"
    VERTICAL = "vertical"


@dataclass(frozen=True, slots=True, order=True)
class Keepout:
    """A disc of the desk plane that a safe place must not touch: centre x, y and radius [m].

    ``soft``: it may where nothing else is free.
    """

    x: float
    y: float
    radius: float
    soft: bool = False


@dataclass(frozen=True, slots=True)
class Coming:
    """A thing that is still to come to the same surface, and where on it."""

    name: str
    where: tuple[Whereabouts, ...]


@dataclass(frozen=True, slots=True)
class Action:
    """One action.

    Args:
        verb: the primitive.
        target: object, surface, container or articulated object; ``object`` or ``object.part``.
        pose: grasp pose asked for, None when any will do; of a PUT ON, that in which the thing is
            to be grasped there next, as far as there is a place for that.
        safe: a PUT ON that must also stay clear of everything that moved or swept (a safe place).
        keepout: the discs that such a place, or one that is to leave room for another thing,
            avoids, from the failed rollout; base frame.
        where: of a PUT ON, where on that surface; of a PUT, that it is to stand upright or to lie
            there. All of it must hold afterwards.
        onward: of a PICK UP, the PUT for which the object is taken: so that it goes there as it is
            held.
        coming: of a PUT ON, what comes beside it later, in this order: it takes a place at which
            that has room, and stands beside what it has as its landmark where that will be.
        partly: an OPEN that goes only as far as nothing stands in the part's way.
    """

    verb: Verb
    target: str
    pose: GraspPose | None = None
    safe: bool = False
    keepout: tuple[Keepout, ...] = ()
    where: tuple[Whereabouts, ...] = ()
    onward: Action | None = None
    partly: bool = False
    coming: tuple[Coming, ...] = ()

    @property
    def arrivals(self) -> dict[str, tuple[float, float]]:
        """At which points things will stand that are still to come, where that is told."""
        return {
            thing.name: where.point
            for thing in self.coming
            for where in thing.where
            if where.point is not None and not where.denied
        }

    def __str__(self) -> str:
        text = f"[{self.verb.value}, {self.target}]"
        taken = "" if self.verb is Verb.PICK_UP else "to be taken "
        notes = [*([taken + self.pose.value] if self.pose else []), *map(str, self.where)]
        if self.partly:
            notes.append("partly")
        if self.onward is not None:
            notes.append(f"to {self.onward.verb.value.lower()} {self.onward.target}")
        for thing in self.coming:
            notes += [f"room for {thing.name} {where}" for where in thing.where]
        return f"{text} ({', '.join(notes)})" if notes else text


_ACTION = re.compile(
    r"\s*(?:\d+[.)]\s*)?\[\s*(?P<verb>[A-Za-z][A-Za-z_\s]*),\s*(?P<target>[A-Za-z][\w.]*)\s*\]"
    r"\s*(?:\((?P<note>[^()]*)\))?\s*[,;]?"
)
MAX_PLAN_ACTIONS = 64
"""Longer textual plans are refused."""
MAX_PLAN_TEXT = 20_000
"""So many actions with a note each are a third of it [characters]."""


def parse_plan(text: str, targets: Iterable[str] | None = None) -> tuple[Action, ...]:
    """Reads ``[PICK UP, pen] (vertical) [PUT INTO, holder]`` strictly.

    Args:
        text: the plan; numbering and commas between actions are allowed, nothing else is.
        targets: valid targets; None skips that check.

    Raises:
        PlanSyntaxError: naming the first words that cannot be read and what is expected.
    """
    if len(text) > MAX_PLAN_TEXT:
        raise PlanSyntaxError(f"a plan of {len(text)} characters; expected at most {MAX_PLAN_TEXT}")
    actions: list[Action] = []
    position = 0
    allowed = None if targets is None else set(targets)
    while position < len(text) and text[position:].strip():
        match = _ACTION.match(text, position)
        if match is None:
            found = text[position:].strip()[:60]
            raise PlanSyntaxError(
                f"cannot read {found!r} as an action; expected e.g. [PICK UP, pen] or "
                "[PICK UP, holder] (horizontal)"
            )
        actions.append(_action(match, allowed))
        if len(actions) > MAX_PLAN_ACTIONS:
            raise PlanSyntaxError(f"a plan may have at most {MAX_PLAN_ACTIONS} actions")
        position = match.end()
    if not actions:
        raise PlanSyntaxError("the plan is empty; expected e.g. [PICK UP, pen] [PUT INTO, holder]")
    return tuple(map(_with_what_follows, actions, [*actions[1:], None]))


def _with_what_follows(action: Action, following: Action | None) -> Action:
    """A PICK UP for a PUT that follows is for all that is said of that."""
    onward = action.onward
    if onward is None or following is None:
        return action
    same = (following.verb, following.target) == (onward.verb, onward.target)
    return replace(action, onward=following) if same else action


def _action(match: re.Match[str], allowed: set[str] | None) -> Action:
    written = " ".join(match["verb"].replace("_", " ").upper().split())
    try:
        verb = Verb(written)
    except ValueError:
        expected = ", ".join(item.value for item in Verb)
        raise PlanSyntaxError(
            f"unknown action {match['verb'].strip()[:60]!r}; expected one of {expected}"
        ) from None
    target = match["target"]
    if allowed is not None and target not in allowed:
        raise PlanSyntaxError(
            f"[{verb.value}, {target}]: the scene has no {target!r}; it has "
            f"{', '.join(sorted(allowed))}"
        )
    pose: GraspPose | None = None
    safe = False
    partly = False
    onward: Action | None = None
    where: list[Whereabouts] = []
    coming: dict[str, tuple[Whereabouts, ...]] = {}
    for note in (match["note"] or "").split(","):
        plain = " ".join(note.split())
        if verb is Verb.PICK_UP and (held := _HELD.fullmatch(plain)) is not None:
            pose = GraspPose(held[1].lower())
        elif verb is Verb.PUT_ON and plain.lower() == "safe place":
            safe = True
        elif verb is not Verb.PICK_UP and (taken := _TAKEN.fullmatch(plain)) is not None:
            pose = GraspPose(taken[1].lower())
        elif verb is Verb.OPEN and plain.lower() == "partly":
            partly = True
        elif verb is Verb.PICK_UP and (next_put := _ONWARD.fullmatch(plain)) is not None:
            onward = Action(Verb(f"PUT {next_put[1].upper()}"), next_put[2])
            _check_target(onward.target, allowed, f"[{verb.value}, {target}] ({plain})")
        elif verb is Verb.PUT_ON and (room := _ROOM_FOR.fullmatch(plain)) is not None:
            spot = read_whereabouts(room[2])
            if spot is None:
                raise PlanSyntaxError(f"unknown place ({plain}) after [{verb.value}, {target}]")
            _check_target(room[1], allowed, f"[{verb.value}, {target}] ({plain})")
            _check_landmarks(spot, allowed, f"[{verb.value}, {target}] ({plain})")
            coming[room[1]] = (*coming.get(room[1], ()), spot)
        elif plain:
            place = read_whereabouts(plain)
            if place is None or not _says_where(verb, place):
                raise PlanSyntaxError(
                    f"unknown note ({plain}) after [{verb.value}, {target}]; expected "
                    "(horizontal) or (vertical) after PICK UP, (partly) after OPEN or, after a "
                    "PUT, (upright), (lying) or a place such as (left of plate) or (between cup "
                    "and box), after PUT ON (at edge) or (safe place), too"
                )
            _check_landmarks(place, allowed, f"[{verb.value}, {target}] ({plain})")
            where.append(place)
    later = tuple(Coming(name, spots) for name, spots in coming.items())
    return Action(
        verb, target, pose, safe, where=tuple(where), onward=onward, coming=later, partly=partly
    )


def _says_where(verb: Verb, place: Whereabouts) -> bool:
    """Whether an action may ask for a place: in a container beside what else is in there."""
    told = place.landmarks or place.relation.is_stance
    return verb is Verb.PUT_ON or (verb is Verb.PUT_INTO and bool(told))


_NAME = r"[A-Za-z]\w*(?:\.\w+)?"
_ONWARD = re.compile(rf"(?i:to put (on|into)) ({_NAME})")
_HELD = re.compile(r"(?i:(horizontal|vertical)(?:ly)?)")
_TAKEN = re.compile(r"(?i:to be taken (horizontal|vertical))")
_ROOM_FOR = re.compile(rf"(?i:room for) ({_NAME}) (.+)")
_POINT = re.compile(r"at (-?\d+(?:\.\d+)?) (-?\d+(?:\.\d+)?)")


def read_whereabouts(text: str) -> Whereabouts | None:
    """Reads what :class:`Whereabouts` writes; None for anything else.

    Args:
        text: one relation, single spaces between words; the case of its words does not matter.
    """
    if text.lower().startswith("not "):
        there = read_whereabouts(text[len("not ") :])
        known = there is not None and not there.denied and not there.relation.is_stance
        return replace(there, denied=True) if there is not None and known else None
    point = _POINT.fullmatch(text.lower())
    if point is not None:
        return Whereabouts(Nearby.AT_POINT, point=(float(point[1]), float(point[2])))
    for relation in Nearby:
        head = re.escape(relation.value)
        if relation.landmarks == 0:
            if relation is not Nearby.AT_POINT and text.lower() == relation.value:
                return Whereabouts(relation)
            continue
        names = relation.joint.join([f"({_NAME})"] * relation.landmarks)
        match = re.fullmatch(rf"(?i:{head}) {names}", text)
        if match is not None:
            return Whereabouts(relation, tuple(match.groups()))
    return None


def _check_landmarks(place: Whereabouts, allowed: set[str] | None, written: str) -> None:
    for name in place.landmarks:
        _check_target(name, allowed, written)


def _check_target(name: str, allowed: set[str] | None, written: str) -> None:
    if allowed is not None and name not in allowed:
        raise PlanSyntaxError(
            f"{written}: the scene has no {name!r}; it has {', '.join(sorted(allowed))}"
        )


def format_plan(actions: Iterable[Action]) -> str:
    """Writes a plan on one line, the inverse of :func:`parse_plan`."""
    return " ".join(str(action) for action in actions)

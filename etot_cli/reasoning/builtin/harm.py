"""Undesired changes: every object is compared before and after an action.

Source: paper, "Failure Detection": unsafe is what the skills cannot recover, such as a ball that
rolled off the table or a pen out of the arm's reach.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

from etot_cli.reasoning.builtin.effects import acted_object, carried_along, effect_holds
from etot_cli.reasoning.builtin.relations import can_topple, contents, enclosing, sits_in_mouth
from etot_cli.skills.action import PUTS, Action, Verb
from etot_cli.world.carrying import carried_by
from etot_cli.world.spatial import Nearby
from etot_cli.world.stance import LEANS_DEG
from etot_cli.world.state import CLOSED_AT, DESK, CauseKind, ObjectState, RolloutRecord, owner_of

SHOVED = 0.03
"""An object that ends up further away than this has been disturbed [m]."""
CHANGED = 0.005
"""An object displaced further than this has changed at all [m]."""
FELL = 0.01
"""An object that rests on something else and moved further than this has fallen off [m]."""
PART_MOVED = 0.25
"""A part moved by more than this share of its travel, unasked, has been disturbed."""
AJAR = 2 * CLOSED_AT
"""... and one that was closed by more than this: it is closed no longer, and perhaps is to be."""
LOST_WORDS = {True: "fell off the desk", False: "is gone from the desk"}
"""What is said of what was lost, by whether it was watched."""


class HarmKind(IntEnum):
    """Kinds of harm, the gravest first."""

    LOST = 0
    STRANDED = 1
    TOPPLED = 2
    DISLODGED = 3
    """It left the container or the support that it was in or on."""
    CARRIED = 4
    """It stood on what was picked up, and nobody asked for it to come along."""
    TIPPED = 5
    """It stood, and leans against something now."""
    SHOVED = 6
    PART_MOVED = 7
    """One of its parts was opened or closed unasked."""

    @property
    def unsafe(self) -> bool:
        """Whether the skills cannot recover it."""
        return self in (HarmKind.LOST, HarmKind.STRANDED)

    @property
    def cause(self) -> CauseKind:
        """The physical cause that it is recorded as."""
        kinds = {
            HarmKind.LOST: CauseKind.LOST,
            HarmKind.STRANDED: CauseKind.STRANDED,
            HarmKind.TOPPLED: CauseKind.TOPPLED,
        }
        return kinds.get(self, CauseKind.COLLISION)


@dataclass(frozen=True, slots=True)
class Harm:
    """What happened to an object. ``distance``: how far it was moved [m]; ``left``: the container
    that it is no longer in.
    """

    name: str
    kind: HarmKind
    distance: float
    left: str | None = None
    watched: bool = True
    """Whether how it came about was recorded."""

    def words(self) -> str:
        """What happened, as a clause with the object as its subject."""
        far = f"{self.distance * 100:.0f} cm"
        dislodged = (
            f"came out of {self.left}" if self.left else f"was knocked from its place ({far})"
        )
        return {
            HarmKind.LOST: f"{self.name} {LOST_WORDS[self.watched]}",
            HarmKind.STRANDED: f"{self.name} ended up out of the arm's reach",
            HarmKind.TOPPLED: f"{self.name} toppled",
            HarmKind.DISLODGED: f"{self.name} {dislodged}",
            HarmKind.CARRIED: f"{self.name}, which stood on it, was moved with it",
            HarmKind.TIPPED: f"{self.name} was tipped and leans",
            HarmKind.SHOVED: f"{self.name} was pushed {far}",
            HarmKind.PART_MOVED: f"{self.name} was opened or closed unasked",
        }[self.kind]


def harms(action: Action, record: RolloutRecord) -> tuple[Harm, ...]:
    """All objects harmed by an action, the gravest harm first."""
    found = []
    for name in record.before.states:
        kind = _harm(name, action, record)
        if kind is not None:
            left = record.before.states[name].inside if _has_come_out(name, record) else None
            far = displacement(name, record)
            found.append(Harm(name, kind, far, left, record.watched))
    return tuple(sorted(found, key=lambda harm: (harm.kind, -harm.distance)))


def displacement(name: str, record: RolloutRecord) -> float:
    """The largest known displacement of an object during the action [m]."""
    before, after = record.before.states[name], record.after.states[name]
    return max(record.displacement.get(name, 0.0), math.dist(before.position, after.position))


def changed(record: RolloutRecord) -> tuple[str, ...]:
    """Objects whose state differs afterwards, in scene order."""
    return tuple(name for name in record.before.states if _has_changed(name, record))


def _harm(name: str, action: Action, record: RolloutRecord) -> HarmKind | None:
    info = record.before.infos[name]
    before, after = record.before.states[name], record.after.states[name]
    acted = name == acted_object(action, record)
    if after.lost and not before.lost:
        return HarmKind.LOST
    moved = acted or name in carried_along(action, record)
    left_reach = info.movable and before.reachable and not after.reachable and not after.in_hand
    if left_reach and not (moved and _is_wanted_there(action, record)):
        return HarmKind.STRANDED
    # What was put down may lie as it likes unless it has to hold something, and was not laid down.
    laid = any(where.relation is Nearby.LYING for where in action.where)
    upright = can_topple(info) and not (acted and (laid or not info.container))
    if upright and after.toppled and not before.toppled and not after.in_hand:
        return HarmKind.TOPPLED
    if acted:
        return None
    if _is_dislodged(name, record):
        return HarmKind.DISLODGED
    if action.verb is Verb.PICK_UP and name in _riders(action, record):
        return HarmKind.CARRIED
    if not moved and _is_tipped(name, record):
        return HarmKind.TIPPED
    if _is_shoved(name, action, record):
        return HarmKind.SHOVED
    return HarmKind.PART_MOVED if _is_part_moved(name, action, record) else None


def _is_wanted_there(action: Action, record: RolloutRecord) -> bool:
    """Whether something was put where it was asked for: on or in an object, or at a place on the
    desk. That is no harm, out of the arm's reach either; anywhere on the desk would have done.
    """
    asked = any(not where.relation.is_stance for where in action.where)
    told = owner_of(action.target) != DESK or asked
    return action.verb in PUTS and not action.safe and told and effect_holds(action, record)


def _riders(action: Action, record: RolloutRecord) -> frozenset[str]:
    """What stood on the acted-on object, not in it nor in its mouth, and was moved with it."""
    acted, before = acted_object(action, record), record.before
    if acted is None:
        return frozenset()
    inside = {
        name
        for name in before.states
        if acted in map(owner_of, enclosing(before, name)) or sits_in_mouth(before, name, acted)
    }
    moved = (name for name in carried_by(before, acted) if displacement(name, record) > FELL)
    return frozenset(moved) - inside


def _has_come_out(name: str, record: RolloutRecord) -> bool:
    around = record.before.states[name].inside
    return around is not None and around not in enclosing(record.after, name)


def _is_dislodged(name: str, record: RolloutRecord) -> bool:
    before, after = record.before.states[name], record.after.states[name]
    if _has_come_out(name, record):
        return True
    supports, now = _owners(before), _owners(after)
    elsewhere = bool(supports) and bool(now) and not supports & now
    return elsewhere and before.inside == after.inside and displacement(name, record) > FELL


def _is_tipped(name: str, record: RolloutRecord) -> bool:
    """Whether something that stood by itself leans. In a vessel or drawer things lean as they like,
    and what moved rightly may have been set down so.
    """
    before, after = record.before.states[name], record.after.states[name]
    stood = before.tilt_deg < LEANS_DEG and before.inside is None
    leans = after.tilt_deg >= LEANS_DEG and after.inside is None and not after.in_hand
    return can_topple(record.before.infos[name]) and stood and leans


def _is_shoved(name: str, action: Action, record: RolloutRecord) -> bool:
    if name in carried_along(action, record):
        return False
    # A vessel may shift, and what lies in it give way, when something comes in.
    inserted = action.verb is Verb.PUT_INTO and (
        name == owner_of(action.target) or name in contents(record.before, action.target)
    )
    before, after = record.before.states[name], record.after.states[name]
    # What came along for a moment and is back where it was (a cup that a wedged ball lifts) is
    # none the worse; what fell over or off on the way shows in its relations.
    return not inserted and math.dist(before.position, after.position) > SHOVED


def _is_part_moved(name: str, action: Action, record: RolloutRecord) -> bool:
    if name in carried_along(action, record):
        return False
    before, after = record.before.states[name], record.after.states[name]
    return any(
        abs(after.openness.get(part, value) - value) > (AJAR if value <= CLOSED_AT else PART_MOVED)
        for part, value in before.openness.items()
    )


def _has_changed(name: str, record: RolloutRecord) -> bool:
    before, after = record.before.states[name], record.after.states[name]
    same = (
        before.inside == after.inside
        and before.in_hand == after.in_hand
        and before.toppled == after.toppled
        and before.lost == after.lost
        and before.reachable == after.reachable
        and dict(before.opened) == dict(after.opened)
        and (not _owners(before) or not _owners(after) or _owners(before) == _owners(after))
    )
    openness = any(
        abs(after.openness.get(part, value) - value) > 0.05
        for part, value in before.openness.items()
    )
    return not same or openness or displacement(name, record) > CHANGED


def _owners(state: ObjectState) -> frozenset[str]:
    return frozenset(owner_of(support) for support in state.on)

"""What an action did to the world, as reports tell it: who moved how far, and what touched what."""

from __future__ import annotations

from collections.abc import Iterable
from math import dist
from typing import Annotated

from pydantic import Field

from etot_cli.reasoning.protocol import Verdict
from etot_cli.reporting.models import (
    ActionModel,
    CauseModel,
    Metres,
    Model,
    Seconds,
    action_fields,
    rounded,
)
from etot_cli.skills.action import Action
from etot_cli.world.stance import TOPPLED_DEG
from etot_cli.world.state import DESK, ContactEvent, ObjectState, RolloutRecord, owner_of

SEEN_MOVE_M = 0.005
"""Displacements below this are settling, which nobody sees [m]."""
TOLD_MOVE_M = 0.0005
"""Displacements below this would be told as 0.0 cm [m]."""
MAX_CONTACTS = 8
"""Contacts in a report, the hardest of those that matter; more than a person reads."""
RESTING_S, RESTING_N = 0.05, 5.0
"""A contact seen at the first look is only rest, unless it is pressed harder."""
WEAK_IMPULSE_NS = 0.005
"""Touches that transfer less change nothing: 5 mN for a second [N s]."""


class MovedModel(Model):
    """An object that is not where, or as, it was before an action."""

    object: str
    moved_m: Annotated[Metres, rounded(4)]
    """Distance between its centres before and after [m]."""
    largest_m: Annotated[Metres, rounded(4)]
    """Largest displacement on the way [m]."""
    before: str
    """Where it was, in words, e.g. ``on desk``."""
    after: str
    toppled: bool = False
    """It lies now; before it stood, or was in the hand."""


class ContactModel(Model):
    """A contact that had to do with what changed or failed."""

    time_s: Seconds
    """Simulated time within the action."""
    first: str
    second: str
    peak_force_n: Annotated[float, Field(ge=0.0), rounded(2)] = Field(validation_alias="peak_force")
    """Largest normal force [N]."""
    impulse_ns: Annotated[float, Field(ge=0.0)] = Field(validation_alias="impulse")
    """Normal force integrated over the action [N s]."""


class JudgedModel(ActionModel):
    """An action that was judged, and what it did."""

    cause: CauseModel | None
    changes: list[str]
    """Objects whose state changed, and those that the action is about."""
    moved: list[MovedModel] = Field(default_factory=list)
    """What moved or changed, the farthest first; of a node, in the nominal world."""
    contacts: list[ContactModel] = Field(default_factory=list)
    """Contacts that had to do with it, in order of time; of a node, in the nominal world."""
    simulated_s: Seconds
    """Physics time stepped for it, all worlds together."""
    wall_s: Seconds

    def told(self) -> list[str]:
        """``changes``, for people: what was put down lying is said to lie."""
        lying = {item.object for item in self.moved if item.toppled}
        return [f"{name} (lying)" if name in lying else name for name in self.changes]


def judged_fields(
    action: Action, verdict: Verdict | None, record: RolloutRecord | None
) -> dict[str, object]:
    """The fields of :class:`JudgedModel` but for the times; ``record``: of the nominal world."""
    cause = None if verdict is None else verdict.cause
    changes = () if verdict is None else verdict.changes
    blamed = changes if cause is None else cause.objects
    return {
        **action_fields(action),
        "cause": cause,
        "changes": changes,
        "moved": [] if record is None else moved_models(record, changes),
        "contacts": [] if record is None else contact_models(record, blamed),
    }


def moved_models(record: RolloutRecord, changes: Iterable[str]) -> list[MovedModel]:
    """The objects that moved or changed, the farthest first."""
    found = []
    for name, after in record.after.states.items():
        before = record.before.states.get(name)
        if before is None:
            continue
        moved = dist(before.position, after.position)
        largest = max(record.displacement.get(name, 0.0), moved)
        if name in changes or largest >= SEEN_MOVE_M:
            found.append(
                MovedModel(
                    object=name,
                    moved_m=moved,
                    largest_m=largest,
                    before=whereabouts(before),
                    after=whereabouts(after),
                    toppled=_lies_anew(before, after),
                )
            )
    return sorted(found, key=lambda item: -item.largest_m)


def _lies_anew(before: ObjectState, after: ObjectState) -> bool:
    """Whether something has come to lie. What hangs askew in the hand does not yet, and may stand
    again once it is put down.
    """
    lay = before.toppled and not before.in_hand
    return after.toppled and not after.in_hand and not lay


def moved_text(item: MovedModel) -> str:
    """In words: from where to where, or how far where that stayed the same."""
    if item.before == item.after:
        swayed = item.moved_m < SEEN_MOVE_M < item.largest_m
        if max(item.moved_m or 0.0, item.largest_m) < TOLD_MOVE_M:
            return f"{item.object} stayed where it was"
        way = f"{100 * (item.largest_m if swayed else item.moved_m):.1f} cm"
        return f"{item.object} moved {way}{' and back' if swayed else ''}"
    return f"{item.object}: {item.before} → {item.after}"


def contact_models(record: RolloutRecord, blamed: Iterable[str]) -> list[ContactModel]:
    """The contacts that mattered, in order of time.

    Args:
        record: what happened.
        blamed: objects whose contacts come first, whatever their force.
    """
    culprits = set(blamed)
    concerned = culprits | {n for n, way in record.displacement.items() if way >= SEEN_MOVE_M}

    def ends(event: ContactEvent) -> set[str]:
        return {owner_of(event.first), owner_of(event.second)}

    touching = [
        event
        for event in record.contacts
        if ends(event) & concerned
        and DESK not in ends(event)
        and event.impulse > WEAK_IMPULSE_NS
        and (event.time_s > RESTING_S or event.peak_force > RESTING_N)
    ]
    touching.sort(key=lambda event: (not ends(event) & culprits, -event.impulse))
    return [
        ContactModel.of(event)
        for event in sorted(touching[:MAX_CONTACTS], key=lambda event: event.time_s)
    ]


def whereabouts(state: ObjectState) -> str:
    """Where an object is and how it stands, in words."""
    if state.lost:
        return "off the desk"
    if state.in_hand:
        place = "in the hand"
    elif state.inside is not None:
        place = f"inside {state.inside}"
    elif state.on:
        place = "on " + " and ".join(state.on)
    else:
        place = "in place"  # fastened, or on its way down
    notes = [f"{part} {100 * share:.0f} % open" for part, share in state.openness.items()]
    if state.toppled:
        on_head = state.tilt_deg > 180 - TOPPLED_DEG and not state.in_hand
        notes.insert(0, "upside down" if on_head else f"toppled by {state.tilt_deg:.0f}°")
    return ", ".join([place, *notes])

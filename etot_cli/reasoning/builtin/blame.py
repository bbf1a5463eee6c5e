"""Why an action failed, derived from contacts and states where the skill itself did not say."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from etot_cli.reasoning.builtin.effects import acted_object, effect_holds
from etot_cli.reasoning.builtin.harm import LOST_WORDS, Harm, HarmKind
from etot_cli.reasoning.builtin.relations import container_address, contents, is_on
from etot_cli.skills.action import PUTS, Action, Verb
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK, Cause, CauseKind, ContactEvent, RolloutRecord, owner_of

ROBOT = frozenset({"robot", "gripper"})
GROUND = frozenset({"desk", "floor"})
HELD_UP = 1.0
"""Impulse by which something held up a door or drawer until the fingers slid off [N s]: the hand
pulls with some ten newtons for a tenth of a second; what lies in a drawer only bumps into it."""


def cause_of_failure(action: Action, record: RolloutRecord, harmed: Sequence[Harm]) -> Cause:
    """The physical cause of an action that lacks its effect, with harm to others added to it.

    The skill's own account comes first. Only what was put down may have left its place after the
    skill was done.
    """
    cause = _held_up(action, record) or record.cause
    if cause is None and action.verb in PUTS and record.before.holding is not None:
        cause = _not_put(action, record, record.before.holding, harmed)
    if cause is None:
        cause = Cause(CauseKind.NO_EFFECT, (owner_of(action.target),), f"{action} had no effect")
    return _with_harm(cause, harmed)


def cause_of_harm(action: Action, record: RolloutRecord, harmed: Sequence[Harm]) -> Cause:
    """The cause of a failure by harm alone: the action had its effect."""
    worst, acted = harmed[0], acted_object(action, record)
    times = [
        time
        for harm in harmed
        # The hand has what it puts down from the start.
        if (time := _first_touch(record, harm.name, ROBOT if harm.name == acted else frozenset()))
        is not None
    ]
    return Cause(
        worst.kind.cause,
        tuple(harm.name for harm in harmed),
        f"during {action} {_listed(harm.words() for harm in harmed)}",
        min(times, default=None),
    )


def _held_up(action: Action, record: RolloutRecord) -> Cause | None:
    """What a door or drawer was pressed against though nothing stopped the arm: its fingers slid
    off. None where there is nothing of that.
    """
    if record.cause is None or record.cause.kind is not CauseKind.NO_EFFECT:
        return None
    if action.verb not in (Verb.OPEN, Verb.CLOSE):
        return None
    owner = owner_of(action.target)
    held = _struck_by({owner}, record, excluding=set(ROBOT), least=HELD_UP)
    if not held:
        return None
    text = f"{record.cause.text}: {_listed(held)} blocks it"
    return Cause(CauseKind.BLOCKED, (*held, owner), text, _first_touch(record, held[0]))


def _with_harm(cause: Cause, harmed: Sequence[Harm]) -> Cause:
    """The cause with harmed objects behind those to blame, and the harm in its text."""
    objects = tuple(dict.fromkeys((*cause.objects, *(harm.name for harm in harmed))))
    unsaid = [harm.words() for harm in harmed if harm.words() not in cause.text]
    text = f"{cause.text}; {_listed(unsaid)}" if unsaid else cause.text
    return replace(cause, objects=objects, text=text)


def _not_put(action: Action, record: RolloutRecord, held: str, harmed: Sequence[Harm]) -> Cause:
    target, owner = action.target, owner_of(action.target)
    if any(harm.name == owner and harm.kind is HarmKind.TOPPLED for harm in harmed):
        text = f"{target} toppled when {held} was put into it"
        return Cause(CauseKind.TOPPLED, (owner,), text, _first_touch(record, owner))
    joint = "in" if action.verb is Verb.PUT_INTO else "on"
    if (stance := _stance_missed(action, record)) is not None:
        does = "stand" if stance is Nearby.UPRIGHT else "lie"
        text = f"{held} does not {does} {joint} {target}"
        return Cause(CauseKind.REBOUND, (held,), text)
    struck = _struck_by({held}, record, excluding={owner, *ROBOT})
    resident = [name for name in struck if _is_at(name, action, record)]
    beneath = [name for name in resident if is_on(record.after, held, name)]
    if beneath:
        text = f"{held} came to rest on {_listed(beneath)}, not {joint} {target}"
        return Cause(CauseKind.NO_ROOM, (*beneath, held), text)
    if resident:
        text = f"{held} rebounded off {_listed(resident)} {joint} {target}"
        return Cause(CauseKind.REBOUND, (*resident, held), text, _first_touch(record, resident[0]))
    filling = [name for name in record.before.states if _is_at(name, action, record)]
    if filling and action.verb is Verb.PUT_INTO and not _struck_before(held, owner, struck, record):
        # What else it struck it fell on.
        text = f"there is no room for {held} in {target} beside {_listed(filling)}"
        return Cause(CauseKind.NO_ROOM, (*filling, held), text)
    if struck:
        text = f"{held} struck {_listed(struck)} and did not come to rest {joint} {target}"
        return Cause(CauseKind.COLLISION, (*struck, held), text, _first_touch(record, struck[0]))
    if record.after.states[held].lost:
        return Cause(CauseKind.LOST, (held,), f"{held} {LOST_WORDS[record.watched]}")
    blamed = (owner, held) if owner in record.before.infos else (held,)
    if action.verb is Verb.PUT_INTO and (why := _too_wide(held, owner, record)):
        return Cause(CauseKind.NO_ROOM, blamed, f"{held} does not go into {target}: {why}")
    untouched = owner not in _struck_by({held}, record, excluding=set())
    if target != DESK and untouched and record.watched:
        text = f"{held} came down beside {target} without touching it"
        return Cause(CauseKind.NO_EFFECT, blamed, text)
    if action.verb is Verb.PUT_INTO and is_on(record.after, held, owner):
        text = f"{held} does not go into {target}: it came to rest on its rim"
        return Cause(CauseKind.NO_ROOM, blamed, text)
    return Cause(CauseKind.REBOUND, blamed, f"{held} did not stay {joint} {target}")


def _too_wide(held: str, owner: str, record: RolloutRecord) -> str:
    """That something is wider than a vessel's mouth however it is turned; empty where it is not."""
    info = record.before.infos.get(owner)
    width = sorted(record.before.infos[held].size)[1]
    if info is None or not 0.0 < info.mouth < width:
        return ""
    return f"it is {1000 * width:.0f} mm wide, the mouth {1000 * info.mouth:.0f} mm"


def _stance_missed(action: Action, record: RolloutRecord) -> Nearby | None:
    """How what was put down should stand or lie, where that is all it lacks."""
    wanted = [where.relation for where in action.where if where.relation.is_stance]
    unsaid = tuple(where for where in action.where if not where.relation.is_stance)
    anyhow = replace(action, where=unsaid)
    return wanted[0] if wanted and effect_holds(anyhow, record) else None


def _is_at(name: str, action: Action, record: RolloutRecord) -> bool:
    """Whether an object was in or on the action's target before."""
    if name == acted_object(action, record):
        return False
    address = container_address(record.before, action.target)
    inside = action.verb is Verb.PUT_INTO and address is not None
    if inside and name in contents(record.before, action.target):
        return True
    owner = owner_of(action.target)
    return owner in record.before.infos and is_on(record.before, name, owner)


def _struck_before(held: str, owner: str, struck: Iterable[str], record: RolloutRecord) -> bool:
    """Whether what was put down struck something before it got to what it was put into."""
    there = _first_contact(record, held, owner)
    first = [_first_contact(record, held, name) for name in struck]
    times = [time for time in first if time is not None]
    return bool(times) and (there is None or min(times) < there)


def _first_contact(record: RolloutRecord, one: str, other: str) -> float | None:
    """When two objects first touched [s]; None where they did not."""
    pair = {one, other}
    return min((c.time_s for c in record.contacts if {*_owners(c)} == pair), default=None)


def _struck_by(
    movers: Iterable[str], record: RolloutRecord, excluding: set[str], least: float = 0.0
) -> list[str]:
    """Objects touched by ``movers`` with at least that impulse [N s], the hardest hit first."""
    moving = set(movers)
    known = set(record.before.infos)
    impulses: dict[str, float] = {}
    for contact in record.contacts:
        pair = _owners(contact)
        for one, other in (pair, pair[::-1]):
            if one in moving and other in known - moving - excluding:
                impulses[other] = impulses.get(other, 0.0) + contact.impulse
    hit = (name for name, impulse in impulses.items() if impulse >= least)
    return sorted(hit, key=lambda name: -impulses[name])


def _first_touch(
    record: RolloutRecord, name: str, excluding: frozenset[str] = frozenset()
) -> float | None:
    """When an object was first touched by anything but the desk or the floor [s]."""
    times = [
        contact.time_s
        for contact in record.contacts
        if name in (pair := _owners(contact)) and not (GROUND | excluding) & set(pair)
    ]
    return min(times, default=None)


def _owners(contact: ContactEvent) -> tuple[str, str]:
    return owner_of(contact.first), owner_of(contact.second)


def _listed(items: Iterable[str]) -> str:
    words = list(items)
    return ", ".join(words[:-1]) + (" and " if len(words) > 1 else "") + words[-1]

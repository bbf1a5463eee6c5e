"""OPEN and CLOSE: move a door or drawer through contact, by gripping its handle or edge, or by
pushing one of its faces with the closed fingers.

Every way is prepared kinematically first; how far the arm can follow decides which come first.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from etot_cli.skills.action import Action, Verb
from etot_cli.skills.articulation.part_path import (
    STANDOFF,
    Effort,
    PreparedMove,
    fraction_open,
    way_back,
)
from etot_cli.skills.articulation.search import PartSearch
from etot_cli.skills.belief import Belief
from etot_cli.skills.outcome import DONE, Evidence, SkillOutcome, failed
from etot_cli.skills.pilot import Attempt, PhaseEnd, Pilot
from etot_cli.skills.ways import NoWay, Ways, dealt
from etot_cli.world.index import Part
from etot_cli.world.state import CLOSED_AT, OPEN_AT, CauseKind

EFFORTS = (
    Effort(),
    Effort(thorough=True),
    Effort(lenient=True),
    Effort(lenient=True, thorough=True),
)
"""Looked at in turn until one has a way."""
AJAR_SHARE = 0.08
"""... and the share of the part's travel that must have come of it."""
TOOL_SPEED = 0.16
SETTLE_TIME = 1.2


def articulation_ways(belief: Belief, action: Action) -> Ways | SkillOutcome:
    """Ways to carry out OPEN or CLOSE."""
    part = belief.world.parts.get(action.target)
    if part is None:
        entry = belief.world.entries.get(action.target)
        several = [item.info.address for item in entry.parts] if entry else []
        text = (
            f"{action.target} has several movable parts: {', '.join(several)}"
            if several
            else f"{action.target} has no movable part"
        )
        return failed(CauseKind.PRECONDITION, [action.target], text)
    opening = action.verb is Verb.OPEN
    fraction = fraction_open(part, float(belief.data.joint(part.joint).qpos[0]))
    if (opening and fraction >= 0.98) or (not opening and fraction <= 0.01):
        return lambda lane: dealt([lambda _: DONE], lane)
    return partial(_lane_ways, PartSearch(belief, part, opening))


def _lane_ways(search: PartSearch, lane: int) -> Iterator[Attempt | NoWay]:
    own = list(dealt(range(search.count), lane))
    others = [index for index in range(search.count) if index not in own]
    found = False
    for effort in EFFORTS:
        for move in search.moves(own, effort):
            found = True
            yield partial(carry_out, part=search.part, move=move, opening=search.opening)
        # What another lane finds with this effort is better than what more effort would find.
        if found or next(search.moves(others, effort), None) is not None:
            return
    ajar = search.ajar_moves() if search.opening else []
    for move in dealt(ajar, lane):
        yield partial(_open_in_two, part=search.part, move=move)
    if not ajar:
        info = search.part.info
        verb = "open" if search.opening else "close"
        explain = partial(_no_hold, info.owner, info.address, verb)
        yield NoWay(search.evidence(), explain)


def _no_hold(owner: str, address: str, verb: str, evidence: Evidence) -> SkillOutcome:
    blocking = evidence.most(excluding=[owner])
    if blocking:
        return failed(
            CauseKind.BLOCKED,
            [*blocking, owner],
            f"the hand cannot get to {address} to {verb} it: {', '.join(blocking)} in the way",
        )
    return failed(
        CauseKind.UNREACHABLE, [owner], f"the hand finds no hold within reach to {verb} {address}"
    )


def _open_in_two(pilot: Pilot, part: Part, move: PreparedMove) -> SkillOutcome:
    """One move to leave the part ajar, and the best one from there."""
    outcome = carry_out(pilot, part, move, True)
    value = float(pilot.data.joint(part.joint).qpos[0])
    if outcome.effect or abs(value - part.lower) < AJAR_SHARE * abs(part.upper - part.lower):
        return outcome
    search = PartSearch(pilot, part, True)
    second = next(search.moves(range(search.count), Effort()), None)
    return outcome if second is None else carry_out(pilot, part, second, True)


def carry_out(pilot: Pilot, part: Part, move: PreparedMove, opening: bool) -> SkillOutcome:
    """Carries one prepared move out in physics and sees how far the part has come."""
    recorder, owner = pilot.recorder, part.info.owner
    pilot.command_opening(move.opening)
    end = pilot.transit(move.before)
    if end is None:
        return failed(
            CauseKind.UNREACHABLE, [owner], f"no collision-free way of the arm to {owner}"
        )
    if end is PhaseEnd.DONE:
        end = pilot.follow_line(move.approach, STANDOFF, TOOL_SPEED)
    if end is PhaseEnd.BLOCKED:
        struck = pilot.touched_by_robot()
        return failed(
            CauseKind.BLOCKED,
            [*struck, owner],
            f"the arm was stopped on its way to {part.info.address}",
            pilot.data.time - recorder.start_time,
        )
    if move.grip:
        pilot.grip()
    recorder.mark(pilot.data)
    end = pilot.follow_line(move.along, move.length, TOOL_SPEED)
    pilot.wait(0.15)
    recorder.mark(pilot.data)
    value = float(pilot.data.joint(part.joint).qpos[0])
    obstacles = _obstacles(pilot, part)
    if move.grip:
        pilot.release(move.opening)
    if end is PhaseEnd.DONE:
        pilot.follow_line(move.retreat, STANDOFF, TOOL_SPEED)
    else:
        back = way_back(pilot, pilot.commanded)
        if back is not None:
            pilot.follow_line(back, STANDOFF, TOOL_SPEED)
    pilot.settle(SETTLE_TIME)
    recorder.mark(pilot.data)
    fraction = fraction_open(part, float(pilot.data.joint(part.joint).qpos[0]))
    if (fraction >= OPEN_AT) if opening else (fraction <= CLOSED_AT):
        return SkillOutcome(True, roughness=move.length * (1 - fraction if opening else fraction))
    verb, state = ("open", "open") if opening else ("close", "closed")
    at = pilot.data.time - recorder.start_time
    if obstacles:
        return failed(
            CauseKind.BLOCKED,
            [*obstacles, owner],
            f"{part.info.address} did not {verb}: {obstacles[0]} blocks it "
            f"at {fraction_open(part, value):.0%} of its travel",
            at,
        )
    return failed(
        CauseKind.NO_EFFECT,
        [owner],
        f"{part.info.address} is not {state} ({fraction:.0%} of its travel)",
        at,
    )


def _obstacles(pilot: Pilot, part: Part) -> list[str]:
    """Movable objects that the part presses on, the hardest pressed first."""
    world, data = pilot.world, pilot.data
    address = f"{part.info.owner}.{part.info.name}"
    force: dict[str, float] = {}
    for index, (one, two) in enumerate(data.contact.geom):
        row = int(data.contact.efc_address[index])
        if row < 0:
            continue
        pair = (int(one), int(two))
        for first, second in (pair, pair[::-1]):
            name = world.geom_object[second]
            touches = world.geom_address[first] == address or (
                world.geom_object[first] == part.info.owner
            )
            level = abs(float(data.contact.frame[index][2])) < 0.7
            if touches and level and name in world.entries and world.entries[name].info.movable:
                force[name] = force.get(name, 0.0) + float(data.efc_force[row])
    ranked = sorted(force.items(), key=lambda item: (-item[1], item[0]))
    return [name for name, value in ranked if value > 0.3]

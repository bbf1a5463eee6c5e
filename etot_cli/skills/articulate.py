"""OPEN and CLOSE: move a door or drawer through contact, by gripping its handle or edge, or by
pushing one of its faces with the closed fingers.

Every way is prepared kinematically first; how far the arm can follow decides which come first.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from etot_cli.skills.action import Action, Verb
from etot_cli.skills.grip_part import AJAR, grip_moves
from etot_cli.skills.outcome import DONE, Blockers, SkillOutcome, failed
from etot_cli.skills.part_motion import STANDOFF, Effort, PreparedMove, fraction_open, way_back
from etot_cli.skills.pick import struck_objects
from etot_cli.skills.pilot import Attempt, PhaseEnd, Pilot
from etot_cli.skills.push_part import Push, contact_points, push_move
from etot_cli.world.index import Part
from etot_cli.world.state import CLOSED_AT, OPEN_AT, CauseKind

TILTS = tuple(np.radians((0.0, 20.0, 40.0, 60.0, 80.0)))
CLOSED_ENOUGH, OPEN_ENOUGH = 0.03, 0.12
"""Moves that get the part this close to its end (share of its travel) are tried at once."""
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


def articulation_attempts(pilot: Pilot, action: Action) -> Iterator[Attempt | SkillOutcome]:
    """Ways to carry out OPEN or CLOSE, prepared as they are asked for; a reason when there is none.

    The pilot's world must stand as it did at the first call whenever the next item is asked for.
    """
    part = pilot.world.parts.get(action.target)
    if part is None:
        entry = pilot.world.entries.get(action.target)
        several = [item.info.address for item in entry.parts] if entry else []
        text = (
            f"{action.target} has several movable parts: {', '.join(several)}"
            if several
            else f"{action.target} has no movable part"
        )
        yield failed(CauseKind.PRECONDITION, [action.target], text)
        return
    opening = action.verb is Verb.OPEN
    value = float(pilot.data.joint(part.joint).qpos[0])
    fraction = fraction_open(part, value)
    if (opening and fraction >= 0.98) or (not opening and fraction <= 0.01):
        yield lambda _: DONE
        return
    blockers = Blockers(pilot.world)
    found = False
    for effort in EFFORTS:
        for move in _moves(pilot, part, value, opening, blockers, effort):
            found = True
            yield _attempt(part, move, opening)
        if found:
            return
    if opening:
        for move in _ajar_moves(pilot, part, value, blockers):
            found = True
            yield partial(_open_in_two, part=part, move=move)
    if found:
        return
    owner = part.info.owner
    blocking = blockers.most(excluding=[owner])
    verb = "open" if opening else "close"
    if blocking:
        yield failed(
            CauseKind.BLOCKED,
            [*blocking, owner],
            f"the hand cannot get to {part.info.address} to {verb} it: "
            f"{', '.join(blocking)} in the way",
        )
    else:
        yield failed(
            CauseKind.UNREACHABLE,
            [owner],
            f"the hand finds no hold within reach to {verb} {part.info.address}",
        )


def _moves(
    pilot: Pilot, part: Part, value: float, opening: bool, blockers: Blockers, effort: Effort
) -> Iterator[PreparedMove]:
    """Moves that follow the part to its end at once; then those that at least get far enough,
    the farthest first.
    """
    target = part.upper if opening else part.lower
    wanted = OPEN_AT + 0.04 if opening else CLOSED_AT
    partway: list[tuple[float, int, PreparedMove]] = []
    pilot.checker.freeze(pilot.data)
    for rank, move in enumerate(_candidates(pilot, part, value, target, blockers, effort)):
        missing = abs(move.reached - target) / abs(part.upper - part.lower)
        fraction = fraction_open(part, move.reached)
        if missing < (OPEN_ENOUGH if opening else CLOSED_ENOUGH):
            pilot.checker.freeze(pilot.data)
            yield move
            pilot.checker.freeze(pilot.data)
        elif fraction >= wanted if opening else fraction <= wanted:
            partway.append((round(missing, 2), rank, move))
    pilot.checker.freeze(pilot.data)
    for *_, move in sorted(partway, key=lambda item: item[:2]):
        yield move


def _ajar_moves(
    pilot: Pilot, part: Part, value: float, blockers: Blockers
) -> Iterator[PreparedMove]:
    """Grips that only bring the part far enough for a finger to get behind it, the farthest first.

    The hand often cannot stay on a handle all the way, but can push on from inside.
    """
    pilot.checker.freeze(pilot.data)
    moves = [
        move
        for move in grip_moves(pilot, part, value, part.upper, blockers, Effort())
        if move.length >= AJAR
    ]
    pilot.checker.freeze(pilot.data)
    yield from sorted(moves, key=lambda move: -round(move.length, 2))


def _candidates(
    pilot: Pilot, part: Part, value: float, target: float, blockers: Blockers, effort: Effort
) -> Iterator[PreparedMove]:
    opening = abs(target - part.upper) < abs(target - part.lower)
    if opening:
        yield from grip_moves(pilot, part, value, target, blockers, effort)
    face = part.inner if opening else part.outer
    if face is None:
        return
    for contact in contact_points(part, face):
        for outward in (False, True):
            push = Push(face, contact, outward)
            for tilt in TILTS[1:] if outward else TILTS:
                move = push_move(pilot, part, push, value, target, tilt, blockers, effort)
                if move is not None:
                    yield move
                    break
    if not opening:
        yield from grip_moves(pilot, part, value, target, blockers, effort)


def _attempt(part: Part, move: PreparedMove, opening: bool) -> Attempt:
    def run(pilot: Pilot) -> SkillOutcome:
        return carry_out(pilot, part, move, opening)

    return run


def _open_in_two(pilot: Pilot, part: Part, move: PreparedMove) -> SkillOutcome:
    """One move to leave the part ajar, and the best one from there."""
    outcome = carry_out(pilot, part, move, True)
    value = float(pilot.data.joint(part.joint).qpos[0])
    if outcome.effect or abs(value - part.lower) < AJAR_SHARE * abs(part.upper - part.lower):
        return outcome
    second = next(_moves(pilot, part, value, True, Blockers(pilot.world), Effort()), None)
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
        struck = struck_objects(pilot)
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

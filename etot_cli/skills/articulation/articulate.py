"""OPEN and CLOSE: move a door or drawer through contact, by gripping its handle or edge, or by
pushing one of its faces with the closed fingers.

Every way is prepared kinematically first; how far the arm can follow decides which come first.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from functools import partial

import numpy as np

from etot_cli.skills.action import Action, Verb
from etot_cli.skills.articulation.balance import OPEN_SPARE, Balance
from etot_cli.skills.articulation.part_path import PreparedMove, way_back
from etot_cli.skills.articulation.search import MAX_SINGLE, PartSearch, belief_after
from etot_cli.skills.articulation.stops import Met, closable_stop, first_met, stop_before
from etot_cli.skills.articulation.travel import fraction_open
from etot_cli.skills.belief import Belief
from etot_cli.skills.grasps.approach import STANDOFF
from etot_cli.skills.motion.motion import (
    GRIP_TIME,
    RELEASE_TIME,
    Hand,
    Motion,
    Move,
    Phase,
    Trace,
    Wait,
    framed,
)
from etot_cli.skills.outcome import DONE, SkillOutcome, arm_stopped, failed
from etot_cli.world.arrays import Vector
from etot_cli.world.index import Part
from etot_cli.world.state import CLOSED_AT, OPEN_AT, CauseKind, SceneState, owner_of

ALREADY_OPEN, ALREADY_CLOSED = 0.98, 0.01
"""Shares of its travel from which on a part is left as it is."""
TOOL_SPEED = 0.16
"""Quiet [m/s]: fast motion is where the prototype lost things, see docs/physics.md."""
SETTLE_TIME = 1.2
"""Time for what stands in or on the part to come to rest, at most [s]."""
PRESSED = 0.3
"""An object that the part presses on sideways harder than this is in its way [N]."""
LOOKS_ON_THE_WAY = 12
"""Places on the straight way to a part at which it is seen who stands there: some 8 cm apart."""
HALTED = 0.05
"""Share of the travel by which a part springs back from what it ran into, at most."""
EXIT_SPACING = 3
"""Ways out are worked out for every so many waypoints along the part's path."""


def articulation_motions(
    belief: Belief, action: Action, rehearsed: Motion | None = None
) -> Iterator[Motion | SkillOutcome]:
    """Motions that open or close a part, best first; the reason where there is none.

    The hold of a ``rehearsed`` motion comes first, wherever the part now is.
    """
    part = belief.world.parts.get(action.target)
    if part is None:
        yield _no_part(belief, action)
        return
    opening = action.verb is Verb.OPEN
    fraction = fraction_open(part, float(belief.data.joint(part.joint).qpos[0]))
    open_from = OPEN_AT if action.partly else ALREADY_OPEN
    if (opening and fraction >= open_from) or (not opening and fraction <= ALREADY_CLOSED):
        yield Motion(str(action), ())
        return
    balance = Balance(belief, part) if opening else None
    if balance is not None and balance.stays_open_from is None:
        text = f"{part.info.address} does not stay open"
        text += f": let go of at {1.0 - OPEN_SPARE:.0%} of its travel, it falls shut"
        yield failed(CauseKind.NO_EFFECT, [part.info.owner], text)
        return
    tool_at = None if rehearsed is None else rehearsed.tool_at
    hinged = part.info.joint_type == "hinge"
    target = closable_stop(belief, part, balance) if balance is not None and hinged else None
    met = None if balance is None else first_met(belief, part, 0.0 if action.partly else OPEN_AT)
    if balance is not None and met is not None:
        short = stop_before(belief, part, met, balance, partly=action.partly)
        if short is None and action.partly:
            yield _met_too_early(part, met)
            return
        if short is not None:
            target = (
                short if target is None else min(short, target, key=partial(fraction_open, part))
            )
    hold = None if tool_at is None else tool_at.pose
    search = PartSearch(belief, part, opening, hold, target, balance)
    found = False
    barred: list[tuple[Belief, PreparedMove]] = []
    for move in search.moves():
        phases = _phases(belief, part, move)
        stood, latest = belief, move
        if phases is not None and move.then is not None:
            stood, latest = belief_after(belief, part, move.reached, move.retreat[-1]), move.then
            second = _phases(stood, part, latest)
            phases = None if second is None else (*phases, *second)
        if phases is not None:
            found = True
            yield _motion(belief, action, part, move, phases)
        else:
            barred.append((stood, latest))
    if not found:
        if not search.hindrances.blamed():
            for stood, latest in barred[:1]:
                for others in _bars(stood, part, latest):
                    search.hindrances.note(frozenset(others))
        yield _no_move(search)


def _bars(belief: Belief, part: Part, move: PreparedMove) -> Iterator[Sequence[str]]:
    """Who has to be away for the arm to come to a move that it finds no free way to."""
    belief.checker.freeze(belief.data)
    belief.checker.set_fingers(move.opening)
    way = np.linspace(belief.commanded, move.before, LOOKS_ON_THE_WAY)
    met = dict.fromkeys(owner_of(hit) for row in way for hit in belief.checker.hits(row))
    others = [name for name in met if name in belief.world.entries and name != part.info.owner]

    def goes_without(names: Sequence[str]) -> bool:
        with belief.checker.without(names):
            return belief.plan_transit(move.before, opening=move.opening) is not None

    if others and goes_without(others):
        yield from [[name] for name in others[:MAX_SINGLE] if goes_without([name])] or [others]


def _no_part(belief: Belief, action: Action) -> SkillOutcome:
    entry = belief.world.entries.get(action.target)
    several = [item.info.address for item in entry.parts] if entry else []
    text = (
        f"{action.target} has several movable parts: {', '.join(several)}"
        if several
        else f"{action.target} has no movable part"
    )
    return failed(CauseKind.PRECONDITION, [action.target], text)


def _met_too_early(part: Part, met: Met) -> SkillOutcome:
    """That a part which is to open only as far as it gets does not get far enough."""
    address, first = part.info.address, met.names[0]
    text = f"{address} does not open far enough: {first} is in its way at {met.share:.0%}"
    text += " of its travel"
    return failed(CauseKind.BLOCKED, [*met.names, part.info.owner], text)


def _no_move(search: PartSearch) -> SkillOutcome:
    """Why a search that is exhausted found no move."""
    info, verb = search.part.info, "open" if search.opening else "close"
    blocking = search.hindrances.blamed()
    if blocking:
        return failed(
            CauseKind.BLOCKED,
            [*blocking, info.owner],
            f"the hand cannot get to {info.address} to {verb} it: {', '.join(blocking)} in the way",
        )
    if not search.has_hold:
        handle = "" if any(grasp.bar for grasp in search.part.grasps) else " has no handle and"
        text = f"{info.address}{handle} offers the hand nothing to hold or push to {verb} it"
        return failed(CauseKind.NO_GRASP, [info.owner], text)
    side = ": it faces away from the robot" if search.faces_away else ""
    if (falls_below := search.falls_shut_below) is not None:
        side = f"; let go of below {falls_below:.0%} of its travel, it falls shut"
    return failed(
        CauseKind.UNREACHABLE,
        [info.owner],
        f"the arm cannot move {info.address} far enough with any of its holds to {verb} it{side}",
    )


def _motion(
    belief: Belief, action: Action, part: Part, move: PreparedMove, phases: tuple[Phase, ...]
) -> Motion:
    return Motion(
        str(action),
        (*phases, Wait("rest", SETTLE_TIME, until_rest=True)),
        tool_at=framed(
            part.info.address, belief.object_pose(part.body), belief.arm.forward(move.approach[-1])
        ),
        details={"opening": move.opening, "length": move.length},
    )


def _phases(belief: Belief, part: Part, move: PreparedMove) -> tuple[Phase, ...] | None:
    """The phases of one move; None where the arm finds no free way to it."""
    transit = belief.plan_transit(move.before, opening=move.opening)
    if transit is None:
        return None
    grip = (Hand("grip", 0.0, GRIP_TIME),) if move.grip else ()
    release = (Hand("release", move.opening, RELEASE_TIME),) if move.grip else ()
    return (
        Move("transit", transit[1:], opening=move.opening, dwell=0.05),
        Move("approach", move.approach, STANDOFF, TOOL_SPEED),
        *grip,
        Move(
            "along", move.along, _length_along(belief, part, move), TOOL_SPEED,
            may_block=True, exits=_exits(belief, move), dwell=0.15,
        ),
        *release,
        Move("retreat", move.retreat, STANDOFF, TOOL_SPEED, may_block=True),
    )  # fmt: skip


def _length_along(belief: Belief, part: Part, move: PreparedMove) -> float | Vector:
    """Length of the hand's way with a part [m]; of a drawer (k,), waypoint by waypoint. What stands
    in it falls over where that is faster than meant, and the hand does not move evenly by turns of
    the joints.
    """
    if part.info.joint_type != "slide":
        return move.length
    rows = (move.approach[-1], *move.along)
    tools = np.array([belief.arm.forward(row).position for row in rows])
    return np.asarray(np.linalg.norm(np.diff(tools, axis=0), axis=1))


def _exits(belief: Belief, move: PreparedMove) -> tuple[Vector, ...]:
    """For every waypoint a way straight back from there or from shortly before."""
    exits: list[Vector] = []
    last = move.approach[:1]
    for index, joints in enumerate(move.along):
        if index % EXIT_SPACING == 0:
            back = way_back(belief, joints)
            last = last if back is None else back
        exits.append(last)
    return tuple(exits)


def articulation_outcome(
    belief: Belief, action: Action, trace: Trace, after: SceneState
) -> SkillOutcome:
    """What a look at the part afterwards and the robot's own account say."""
    part = belief.world.parts[action.target]
    opening = action.verb is Verb.OPEN
    owner, address = part.info.owner, part.info.address
    fraction = after.openness(part.info)
    if (fraction >= OPEN_AT) if opening else (fraction <= CLOSED_AT):
        return DONE
    stopped = trace.stopped
    obstacles = _pressed(belief, part, trace) or _carried_along(belief, part, after)
    # A second hold meets on its way what a first one did not get as far as meant.
    if stopped is not None and stopped.name in ("transit", "approach") and not obstacles:
        return arm_stopped(f"on its way to {address}", trace.against(), [owner], trace.seconds)
    obstacles = obstacles or _beyond(belief, part, fraction, opening)
    verb, state = ("open", "open") if opening else ("close", "closed")
    if obstacles:
        backing = _backing(belief, part, obstacles, trace)
        return failed(
            CauseKind.BLOCKED,
            [*obstacles, *backing, owner],
            f"{address} did not {verb}: {obstacles[0]} blocks it at {fraction:.0%} of its travel"
            + (f", held by {', '.join(backing)}" if backing else ""),
            trace.seconds,
        )
    return failed(
        CauseKind.NO_EFFECT,
        [owner],
        f"{address} is not {state} ({fraction:.0%} of its travel)",
        trace.seconds,
        another_way=True,
    )


def _carried_along(belief: Belief, part: Part, after: SceneState) -> list[str]:
    """Other furniture with a door or drawer that the part has moved: the hand slips off then."""
    return [
        name
        for name, entry in belief.world.entries.items()
        if name != part.info.owner
        and any(
            abs(after.openness(other.info) - belief.scene.openness(other.info)) > HALTED
            for other in entry.parts
        )
    ]


def _beyond(belief: Belief, part: Part, fraction: float, opening: bool) -> list[str]:
    """Fastened objects that the part would overlap a little beyond where it came to a halt."""
    further = min(max(fraction + (HALTED if opening else -HALTED), 0.0), 1.0)
    belief.checker.freeze(belief.data)
    belief.checker.set_joint(part.joint, part.lower + further * (part.upper - part.lower))
    entries = belief.world.entries
    return [name for name in belief.checker.part_hits(part.joint) if not entries[name].info.movable]


def _pressed(belief: Belief, part: Part, trace: Trace) -> list[str]:
    """Objects that the part pressed on when it halted, the hardest pressed first; fastened ones
    too, for one with a door or drawer that stands open can be closed.
    """
    owner = part.info.owner
    return _pressed_by({owner}, trace, belief.world.entries.keys() - {owner})


def _backing(belief: Belief, part: Part, obstacles: Sequence[str], trace: Trace) -> list[str]:
    """What the doors and drawers in a part's way are pressed on: without it they might give way."""
    turning = {name for name in obstacles if belief.world.entries[name].parts}
    others = belief.world.entries.keys() - {part.info.owner, *obstacles}
    return _pressed_by(turning, trace, others)


def _pressed_by(names: Collection[str], trace: Trace, others: Collection[str]) -> list[str]:
    """Those of the others that any of some things was pressed on, the hardest pressed first."""
    force: dict[str, float] = {}
    presses = (press for phase in trace.phases if phase.name == "along" for press in phase.presses)
    for press in presses:
        for first, second in ((press.first, press.second), (press.second, press.first)):
            name = owner_of(second)
            if owner_of(first) in names and name in others:
                force[name] = force.get(name, 0.0) + press.sideways
    ranked = sorted(force.items(), key=lambda item: (-item[1], item[0]))
    return [name for name, value in ranked if value > PRESSED]

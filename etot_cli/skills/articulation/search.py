"""The search for holds on a door or drawer: every grip and push, and how far the arm can follow."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, islice

import mujoco
import numpy as np

from etot_cli.skills.articulation.balance import OPEN_SPARE, Balance
from etot_cli.skills.articulation.grips import Grip, grips, spun
from etot_cli.skills.articulation.part_path import (
    Contact,
    PreparedMove,
    approaches,
    away_from,
    backed_out,
    follow,
)
from etot_cli.skills.articulation.pushes import pushes
from etot_cli.skills.articulation.travel import CONTACT_CLEARANCE, PartTravel, fraction_open
from etot_cli.skills.belief import Belief
from etot_cli.skills.hindrance import Hindrances, Passage
from etot_cli.skills.motion.collision import HandPart
from etot_cli.world.arrays import Vector
from etot_cli.world.index import Part
from etot_cli.world.pose import Pose
from etot_cli.world.snapshot import copy_configuration
from etot_cli.world.state import CLOSED_AT, OPEN_AT

NEARLY_CLOSED, NEARLY_OPEN = 0.03, 0.12
"""Moves that get the part this close to its end (share of its travel) come first."""
LEAST = 1e-3
"""Share of the travel that is no distance: a move that has to go to the very end is one then."""
AJAR = 0.05
"""Way of a handle that leaves room for a finger behind the part [m]."""
MAX_FOLLOWED = 120
"""Grips, and pushes, whose kinematics are looked at: twice as many as were ever needed, for a
door that stands open by 118°; where the hand has no room costs little."""
MAX_BETTER = 8
"""Holds that are looked at for a better one once one gets the part far enough, or ajar."""
MAX_HINDERED = 24
"""... and of those that something is in the way of, once nothing else is left."""
MAX_FRUITLESS = 8
"""... when these have shown nobody to blame: looking again without what was met tells more then."""
MAX_SINGLE = 3
"""Things that the search is repeated without, one at a time."""
ALIKE, ALIKE_COSINE = 0.02, 0.9
"""Two holds are alike when the tool is this close [m] and points and closes in much the same
directions (cosine): neighbouring candidates differ by more."""
FACING_COSINE = 0.7
"""A front within 45° of straight away from the base is the far side. Of furniture at three places,
turned in steps of 15°, the arm opened everything from 45° on, and of what was turned by 30° and
less only the three that stood nearest."""
MAX_FIRST_STEPS = 3
"""Moves that leave a part ajar which a second move is looked for from."""


@dataclass(frozen=True)
class _Hold:
    contact: Contact
    met: Passage


@dataclass(frozen=True)
class _Partial:
    """A move that does not go all the way, and how much is missing (share of the travel)."""

    missing: float
    move: PreparedMove


class PartSearch:
    """Moves of one part from where it stands, worked out one at a time, when they are asked for.

    Whenever moves are asked for, the belief's world must stand as it did at first.

    Args:
        belief: state that the moves begin in.
        part: door or drawer.
        opening: whether it is to be opened, else closed.
        rehearsed: tool pose at an earlier first contact, in the part's frame; the hold like it
            comes first.
        target: joint value to bring it to; None for its end [m or rad].
        balance: where it falls shut while it is opened; None where it stays anywhere.
    """

    def __init__(
        self,
        belief: Belief,
        part: Part,
        opening: bool,
        rehearsed: Pose | None = None,
        target: float | None = None,
        balance: Balance | None = None,
    ) -> None:
        self.part, self.opening, self._rehearsed = part, opening, rehearsed
        self.hindrances = Hindrances(belief.world)
        self.has_hold = False
        """Something to hold or to push was found that the hand has room at."""
        self._belief = belief
        self._seen: Counter[str] = Counter()
        end = part.upper if opening else part.lower
        self._travel = PartTravel(belief, part, end if target is None else target)
        goal = fraction_open(part, self._travel.target)
        self._balance = balance
        # What falls shut has to be brought beyond where it does.
        stays_from = (self._balance and self._balance.stays_open_from) or 0.0
        self._enough = max(OPEN_AT, stays_from) + OPEN_SPARE
        self._nearly = min(NEARLY_OPEN, goal - self._enough + LEAST) if opening else NEARLY_CLOSED

    @property
    def _is_shut(self) -> bool:
        """Whether it is to be opened and is shut."""
        return self.opening and fraction_open(self.part, self._travel.value) <= CLOSED_AT

    @property
    def faces_away(self) -> bool:
        """Whether it has handles, on the side of its furniture that faces away from the base."""
        if self.part.outer is None or not any(grasp.bar for grasp in self.part.grasps):
            return False
        front = (self._travel.at(self.part.lower).rotation @ self.part.outer.normal)[:2]
        body = self._belief.world.entries[self.part.info.owner].body
        away = self._belief.object_pose(body).position[:2]
        return bool(front @ away > FACING_COSINE * np.linalg.norm(front) * np.linalg.norm(away))

    @property
    def falls_shut_below(self) -> float | None:
        """Share of the travel that a part which could be opened otherwise falls shut from."""
        stays_from = self._balance and self._balance.stays_open_from
        if not stays_from:
            return None
        lighter = PartSearch(self._belief, self.part, True, target=self._travel.target)
        return stays_from if next(lighter.moves(explain=False), None) is not None else None

    def moves(self, *, in_two: bool = True, explain: bool = True) -> Iterator[PreparedMove]:
        """Moves that follow the part to its end at once; then those that at least get far enough,
        the farthest first; then those in two steps.

        Args:
            in_two: whether moves in two steps are looked for.
            explain: where there is none, find out for ``hindrances`` what is in the way.
        """
        self._belief.checker.freeze(self._belief.data)
        left = {True: MAX_FOLLOWED, False: MAX_FOLLOWED}
        hindered: list[_Hold] = []
        partial: list[_Partial] = []
        found = False
        for hold in self._holds():
            # Nothing that is shut can be pushed open from inside, though its walls have room there.
            self.has_hold = self.has_hold or hold.contact.grip or not self._is_shut
            if not hold.met.free:
                hindered.append(hold)
                self._seen.update(hold.met.others)
                continue
            if not left[hold.contact.grip]:
                continue
            left[hold.contact.grip] -= 1
            for item in self._followed(hold):
                if item.missing < self._nearly:
                    found = True
                    yield item.move
                    self._belief.checker.freeze(self._belief.data)
                else:
                    partial.append(item)
                    if self._suffices(item.move.reached) or self._is_ajar(item.move):
                        left = {kind: min(count, MAX_BETTER) for kind, count in left.items()}
        partial.sort(key=lambda item: round(item.missing, 2))
        for item in partial:
            if self._suffices(item.move.reached):
                found = True
                yield item.move
        if in_two and (self.opening or not found):
            for move in self._in_two(partial):
                found = True
                yield move
            for item in partial:
                reached = fraction_open(self.part, item.move.reached)
                if self._enough - OPEN_SPARE <= reached < self._enough:
                    yield item.move
        if not found and explain:
            self._belief.checker.freeze(self._belief.data)
            for number, hold in enumerate(hindered[:MAX_HINDERED]):
                if number == MAX_FRUITLESS and not self.hindrances.blamed():
                    break
                for _ in self._followed(hold):
                    pass
            if not self.hindrances.blamed():
                self._look_without(self._met())

    def _met(self) -> list[str]:
        """What hands or arm met, the most frequent first, what is fastened behind all else."""
        entries = self._belief.world.entries
        met = [name for name, _ in self._seen.most_common()]
        return sorted(met, key=lambda name: not entries[name].info.movable)

    def _look_without(self, names: Sequence[str]) -> None:
        """Looks again without what was met, all together and then one by one: a way of two moves
        shows only so.
        """
        if not names or not self._works_without(names):
            return
        sufficient = [name for name in names[:MAX_SINGLE] if self._works_without([name])]
        for name in sufficient:
            self.hindrances.note(frozenset({name}))
        if not sufficient:
            self.hindrances.note(frozenset(names))

    def _works_without(self, names: Iterable[str]) -> bool:
        with self._belief.checker.without(names):
            search = PartSearch(
                self._belief,
                self.part,
                self.opening,
                target=self._travel.target,
                balance=self._balance,
            )
            return next(search.moves(explain=False), None) is not None

    def _suffices(self, value: float) -> bool:
        fraction = fraction_open(self.part, value)
        return fraction >= self._enough if self.opening else fraction <= CLOSED_AT

    def _holds(self) -> Iterator[_Hold]:
        """Contacts that the hand has room at, whatever the arm; what it would meet there is noted.

        An opening hand grips rather than pushes, a closing one pushes rather than grips.
        """
        faces = [self.part.inner, self.part.back] if self.opening else [self.part.outer]
        if self._is_shut and not self.part.grasps:
            faces = []  # nothing stands out that a finger could get behind
        pushed: list[Contact] = [
            push for face in faces if face is not None for push in pushes(self._travel, face)
        ]
        hinged = self.part.info.joint_type == "hinge"
        gripped, edges = (
            sorted(
                (
                    grip
                    for grasp in self.part.grasps
                    if (hinged and not grasp.bar) is last
                    for grip in grips(self._travel, grasp)
                ),
                key=lambda grip: grip.cost,
            )
            for last in (False, True)
        )
        kinds: list[Sequence[Contact]] = [gripped, pushed]
        if not self.opening:
            kinds.reverse()
        # Over the edge of a door the hand is held up by the furniture long before it is shut.
        kinds.append(edges)
        for kind in (self._again(chain(*kinds)), *kinds):
            for contact in kind:
                met = self._room(contact)
                if isinstance(contact, Grip) and (met is None or not met.free):
                    narrow = replace(contact, opening=contact.narrow)
                    squeezed = self._room(narrow)
                    if squeezed is not None and (met is None or squeezed.free):
                        contact, met = narrow, squeezed
                if met is not None:
                    yield _Hold(contact, met)

    def _again(self, contacts: Iterable[Contact]) -> list[Contact]:
        """The contact that is most like the rehearsed one, if any is."""
        if self._rehearsed is None:
            return []
        part, wanted = self._travel.at(self._travel.value), self._rehearsed
        ranked: list[tuple[float, float, int, Contact]] = []
        for number, contact in enumerate(contacts):
            tool = part.inverse() @ contact.touching(part)
            off = float(np.linalg.norm(tool.position - wanted.position))
            cosine = float(tool.rotation[:, 2] @ wanted.rotation[:, 2])
            if contact.grip:
                # With the fingers exchanged it is the same hold; closed ones may turn any way.
                cosine = min(cosine, abs(float(tool.rotation[:, 1] @ wanted.rotation[:, 1])))
            if off <= ALIKE and cosine >= ALIKE_COSINE:
                ranked.append((round(off, 4), -cosine, number, contact))
        return [min(ranked, key=lambda item: item[:3])[3]] if ranked else []

    def _room(self, contact: Contact) -> Passage | None:
        """What the hand meets at a contact and before it; None where it has no room."""
        travel, checker = self._travel, self._belief.checker
        tool = contact.touching(travel.at(travel.value))
        checker.set_fingers(contact.opening)
        met = travel.passage()
        before = away_from(tool)
        middle = tool.moved((before.position - tool.position) / 2)
        for pose in (tool, middle, before):
            # Closed fingers may come at a face with the hand turned any way about them.
            part = HandPart.ALL if contact.grip else HandPart.FINGERS
            hits = checker.hand_hits(pose, clearance=CONTACT_CLEARANCE, part=part)
            if not met.admits(hits):
                return None
        return met

    def _followed(self, hold: _Hold) -> Iterator[_Partial]:
        """How far a hold goes, at most one move; notes what keeps it from going far enough."""
        travel = self._travel
        contacts: list[Contact] = [hold.contact]
        if isinstance(hold.contact, Grip):
            contacts.append(spun(hold.contact))
        best: _Partial | None = None
        for contact in contacts:
            reachable = False
            for approach, passage in islice(approaches(travel, contact, hold.met), 2):
                reachable = True
                clear = passage.free
                way = follow(travel, contact, approach[-1], passage)
                self._seen.update(passage.others)
                if not way.rows:
                    continue
                steps = way.clear if clear else 0
                if steps < len(way.rows) and self._suffices(way.values[-1]):
                    self.hindrances.note(passage.others)
                move = backed_out(travel, contact, approach, way, steps)
                if move is None:
                    continue
                missing = abs(move.reached - travel.target) / abs(self.part.upper - self.part.lower)
                if best is None or missing < best.missing:
                    best = _Partial(missing if missing > 1e-9 else 0.0, move)
                if best.missing < self._nearly:
                    yield best
                    return
            if not reachable or best is not None:
                break  # half a turn of the wrist moves no other joint
        if best is not None:
            yield best

    def _is_ajar(self, move: PreparedMove) -> bool:
        """Whether a move leaves room for a second one: a finger's behind the part, or a push's
        before a door that has been pulled towards the arm. What falls shut meanwhile does not.
        """
        second = self.opening or self.part.info.joint_type == "hinge"
        balance = self._balance
        stays = balance is None or balance.stays_at(fraction_open(self.part, move.reached))
        return second and move.grip and move.length >= AJAR and stays

    def _in_two(self, partial: list[_Partial]) -> Iterator[PreparedMove]:
        """Grips that bring the part so far that another hold goes on from there, each with the move
        that does. The hand often cannot stay on a handle all the way.
        """
        ajar = (item.move for item in partial if self._is_ajar(item.move))
        for move in islice(ajar, MAX_FIRST_STEPS):
            after = PartSearch(
                belief_after(self._belief, self.part, move.reached, move.retreat[-1]),
                self.part,
                self.opening,
                target=self._travel.target,
                balance=self._balance,
            )
            second = next(after.moves(in_two=False, explain=False), None)
            self._seen.update(after._seen)
            if second is not None:
                yield replace(move, then=second)


def belief_after(belief: Belief, part: Part, value: float, joints: Vector) -> Belief:
    """The belief with a part at a joint value [m or rad] and the arm at ``joints`` (n,) [rad]."""
    model, checker = belief.world.model, belief.checker
    data = mujoco.MjData(model)
    checker.freeze(belief.data)
    checker.set_joint(part.joint, value)
    copy_configuration(belief.data, data)
    data.qpos[:], data.ctrl[:] = checker.configuration, belief.data.ctrl
    data.qpos[belief.world.robot.qpos] = joints
    data.ctrl[belief.world.robot.ctrl] = joints
    mujoco.mj_forward(model, data)
    return belief.in_state(data)

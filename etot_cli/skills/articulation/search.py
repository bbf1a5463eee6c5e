"""The search for holds on a door or drawer: every grip and push, and how far the arm can follow."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial

import numpy as np

from etot_cli.skills.articulation.grips import AJAR, GRIP_TILTS, grip_move
from etot_cli.skills.articulation.part_path import Effort, PreparedMove, fraction_open
from etot_cli.skills.articulation.pushes import Push, contact_points, push_move
from etot_cli.skills.belief import Belief
from etot_cli.skills.outcome import Blockers, Evidence
from etot_cli.world.index import Part
from etot_cli.world.state import CLOSED_AT, OPEN_AT

PUSH_TILTS = tuple(np.radians((0.0, 20.0, 40.0, 60.0, 80.0)))
"""Leans of the hand along a push [rad], looked at in turn until one goes."""
CLOSED_ENOUGH, OPEN_ENOUGH = 0.03, 0.12
"""Moves that get the part this close to its end (share of its travel) come first."""

Candidate = Callable[[Blockers, Effort], PreparedMove | None]


class PartSearch:
    """Moves of one part from where it stands, worked out once each, when they are asked for.

    Whenever moves are asked for, the belief's world must stand as it did at first.
    """

    def __init__(self, belief: Belief, part: Part, opening: bool) -> None:
        self.part, self.opening = part, opening
        self._belief = belief
        self._value = float(belief.data.joint(part.joint).qpos[0])
        self._target = part.upper if opening else part.lower
        self._grips = self._grip_candidates()
        pushes = self._push_candidates()
        self._candidates = [*self._grips, *pushes] if opening else [*pushes, *self._grips]
        self._known: dict[tuple[int, Effort], tuple[PreparedMove | None, Evidence]] = {}

    @property
    def count(self) -> int:
        """Number of candidates."""
        return len(self._candidates)

    def moves(self, candidates: Iterable[int], effort: Effort) -> Iterator[PreparedMove]:
        """Moves that follow the part to its end at once; then those that at least get far enough,
        the farthest first.

        Args:
            candidates: which ones to look at, by number, in this order.
            effort: how hard a way is looked for.
        """
        part, target = self.part, self._target
        wanted = OPEN_AT + 0.04 if self.opening else CLOSED_AT
        partway: list[tuple[float, int, PreparedMove]] = []
        self._belief.checker.freeze(self._belief.data)
        for index in candidates:
            move = self._move(index, effort)
            if move is None:
                continue
            missing = abs(move.reached - target) / abs(part.upper - part.lower)
            fraction = fraction_open(part, move.reached)
            if missing < (OPEN_ENOUGH if self.opening else CLOSED_ENOUGH):
                yield move
                self._belief.checker.freeze(self._belief.data)
            elif fraction >= wanted if self.opening else fraction <= wanted:
                partway.append((round(missing, 2), index, move))
        for *_, move in sorted(partway, key=lambda item: item[:2]):
            yield move

    def ajar_moves(self) -> list[PreparedMove]:
        """Grips that only bring the part far enough for a finger to get behind it, the farthest
        first. The hand often cannot stay on a handle all the way, but can push on from inside.
        """
        self._belief.checker.freeze(self._belief.data)
        first = 0 if self.opening else self.count - len(self._grips)
        found = (self._move(first + i, Effort()) for i in range(len(self._grips)))
        moves = [move for move in found if move is not None and move.length >= AJAR]
        return sorted(moves, key=lambda move: -round(move.length, 2))

    def evidence(self) -> Evidence:
        """What stood in the way of everything looked at so far."""
        return sum((evidence for _, evidence in self._known.values()), Evidence())

    def _move(self, index: int, effort: Effort) -> PreparedMove | None:
        key = (index, effort)
        if key not in self._known:
            blockers = Blockers(self._belief.world)
            move = self._candidates[index](blockers, effort)
            self._known[key] = move, blockers.evidence()
        return self._known[key][0]

    def _grip_candidates(self) -> list[Candidate]:
        """Fingers closed on the part, upright hands first."""
        return [
            partial(grip_move, self._belief, self.part, grasp, self._value, self._target, tilt)
            for grasp in self.part.grasps
            for tilt in GRIP_TILTS
        ]

    def _push_candidates(self) -> list[Candidate]:
        """Closed fingers against a face; hands that lean outwards reach farther, but seldom."""
        face = self.part.inner if self.opening else self.part.outer
        if face is None:
            return []
        return [
            partial(self._push, Push(face, contact, outward))
            for outward in (False, True)
            for contact in contact_points(self.part, face)
        ]

    def _push(self, push: Push, blockers: Blockers, effort: Effort) -> PreparedMove | None:
        for tilt in PUSH_TILTS[1:] if push.outward else PUSH_TILTS:
            move = push_move(
                self._belief, self.part, push, self._value, self._target, tilt, blockers, effort
            )
            if move is not None:
                return move
        return None

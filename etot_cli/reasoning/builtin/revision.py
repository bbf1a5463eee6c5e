"""Editing branches: cycles, relocations, reordering, and what a branch is for."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from etot_cli.reasoning.builtin.goal import Relation
from etot_cli.reasoning.builtin.relations import is_closed, is_open
from etot_cli.reasoning.builtin.rules import in_hand, left_open
from etot_cli.reasoning.builtin.sketch import Sketch
from etot_cli.skills.action import PUTS, Action, Verb
from etot_cli.world.spatial import Whereabouts
from etot_cli.world.state import SceneState

Actions = tuple[Action, ...]
PurposedPut = tuple[str, Verb, str, tuple[Whereabouts, ...]]
"""What is put, how, to what, and where there."""


@dataclass(frozen=True, slots=True)
class Cycle:
    """Actions that belong together: ``start`` up to, not including, ``end``.

    A pick and its put; an insertion into an articulated container with its open and close; or a
    single action.
    """

    start: int
    end: int

    def __contains__(self, index: int) -> bool:
        return self.start <= index < self.end


@dataclass(frozen=True, slots=True)
class Purpose:
    """What a branch leads to, whatever it does on the way.

    Args:
        places: final put of each object, safe places left out.
        parts: last verb of each part that is not left as it stood at the start.
        held: what is in the hand at the end.
    """

    places: frozenset[PurposedPut]
    parts: frozenset[tuple[str, Verb]]
    held: str | None


def purpose(actions: Sequence[Action], scene: SceneState) -> Purpose:
    """What a branch is for; relocations to a safe place are means and no part of it."""
    end = scene.holding
    places: dict[str, tuple[Verb, str, tuple[Whereabouts, ...]]] = {}
    parts: dict[str, Verb] = {}
    for held, action, end in in_hand(actions, scene.holding):  # noqa: B007
        if action.verb in (Verb.OPEN, Verb.CLOSE):
            parts[action.target] = action.verb
        elif action.verb in PUTS and held is not None and not action.safe:
            places[held] = (action.verb, action.target, action.where)
    return Purpose(
        frozenset((name, *place) for name, place in places.items()),
        frozenset(item for item in parts.items() if not _as_at_first(*item, scene)),
        end,
    )


def _as_at_first(address: str, last: Verb, scene: SceneState) -> bool:
    """Whether a part is left as it stood at the start; opening it was a means then."""
    part = scene.part(address)
    if part is None:
        return False
    return is_open(scene, part) if last is Verb.OPEN else is_closed(scene, part)


def cycles(actions: Sequence[Action]) -> list[Cycle]:
    """Splits a branch into cycles, in order; every action belongs to exactly one."""
    found: list[Cycle] = []
    index = 0
    while index < len(actions):
        end = _insertion_end(actions, index)
        if end is None:
            two = actions[index].verb is Verb.PICK_UP and index + 1 < len(actions)
            end = index + (2 if two else 1)
        found.append(Cycle(index, end))
        index = end
    return found


def _insertion_end(actions: Sequence[Action], start: int) -> int | None:
    """End of the insertion cycle that an OPEN, or a PICK UP before an open drawer, begins."""
    first = actions[start]
    if first.verb is Verb.OPEN:
        for index in range(start + 1, len(actions)):
            action = actions[index]
            if action.target == first.target and action.verb is Verb.CLOSE:
                # An opening that several of them share belongs to none.
                puts = [item for item in actions[start:index] if item.verb in PUTS]
                lasting = [(item.verb, item.target) for item in puts if not item.safe]
                return index + 1 if lasting == [(Verb.PUT_INTO, first.target)] else None
            if action.target == first.target and action.verb is Verb.OPEN:
                return None
        return None
    if first.verb is Verb.PICK_UP and start + 2 < len(actions):
        put, close = actions[start + 1], actions[start + 2]
        ends = (put.verb, close.verb, close.target) == (Verb.PUT_INTO, Verb.CLOSE, put.target)
        # A closing that several insertions share belongs to none of them.
        if ends and (Verb.PUT_INTO, put.target) not in (
            (a.verb, a.target) for a in actions[:start]
        ):
            return start + 3
    return None


def cycle_of(actions: Sequence[Action], index: int) -> Cycle:
    """The cycle that an action belongs to."""
    return next(cycle for cycle in cycles(actions) if index in cycle)


def placed_by(actions: Sequence[Action], name: str, before: int) -> int | None:
    """Index of the last PICK UP of an object before a place in the branch, safe places left out."""
    for index in range(before - 1, -1, -1):
        action = actions[index]
        if action.verb is Verb.PICK_UP and action.target == name:
            put = actions[index + 1] if index + 1 < len(actions) else None
            return None if put is None or put.safe else index
    return None


def relocations(actions: Sequence[Action], name: str) -> int:
    """How often a branch takes an object to a safe place."""
    return sum(
        1
        for pick, put in pairwise(actions)
        if pick.verb is Verb.PICK_UP and pick.target == name and put.safe
    )


def inserted(actions: Actions, index: int, extra: Actions) -> Actions:
    """A branch with actions added before ``index``."""
    return (*actions[:index], *extra, *actions[index:])


def moved_before(actions: Actions, cycle: Cycle, index: int) -> Actions:
    """A branch with a cycle brought forward to ``index``, which lies before it."""
    return (
        *actions[:index],
        *actions[cycle.start : cycle.end],
        *actions[index : cycle.start],
        *actions[cycle.end :],
    )


def without_idle(actions: Actions, scene: SceneState, turned: Collection[str] = ()) -> Actions:
    """The branch without openings of closed parts that are closed again at once, and the other way
    round, without closing what is closed or opening what has been opened, and without waits
    elsewhere that end at once. What is ``turned`` to and fro by request stays so.
    """
    for index, action in enumerate(actions):
        again = [(other.verb, other.target) for other in actions[index : index + 3 : 2]]
        waits = again == 2 * [(Verb.PICK_UP, action.target)] and actions[index + 1].safe
        puts = actions[index + 1 : index + 4 : 2]
        stands = any(where.relation.is_stance for one in puts for where in one.where)
        # Else it is grasped anew.
        if waits and action == actions[index + 2] and not stands:
            return without_idle((*actions[:index], *actions[index + 2 :]), scene, turned)
        part = scene.part(action.target)
        if action.verb not in (Verb.OPEN, Verb.CLOSE) or part is None:
            continue
        before = [other.verb for other in actions[:index] if other.target == action.target]
        turns = [verb for verb in before if verb in (Verb.OPEN, Verb.CLOSE)]
        closed = before[-1] is Verb.CLOSE if before else is_closed(scene, part)
        opened = turns[-1] is Verb.OPEN if turns else is_open(scene, part)
        if before[-1:] == [Verb.PUT_INTO] and action.target in turned:
            opened = False
        following = actions[index + 1 : index + 2]
        undone = following and following[0].target == action.target
        # What stands half open at the start may be opened wider, once.
        if (closed and action.verb is Verb.CLOSE) or turns[-1:] == [action.verb]:
            return without_idle((*actions[:index], *actions[index + 1 :]), scene, turned)
        if undone and following[0].verb is not action.verb and (closed or opened):
            return without_idle((*actions[:index], *actions[index + 2 :]), scene, turned)
    return actions


def taken_at_once(actions: Actions, before: Actions) -> Iterator[Actions]:
    """A revised branch without the first of the objects set down that only are to be grasped anew:
    after other actions than ``before`` the object may well be grasped so at once.
    """
    for index in range(len(actions) - 2):
        pick, put, again = actions[index : index + 3]
        grasps = (pick.verb, again.verb) == (Verb.PICK_UP, Verb.PICK_UP)
        waits = grasps and pick.target == again.target and put.safe
        if waits and actions[: index + 3] != before[: index + 3]:
            yield (*actions[:index], *actions[index + 2 :])
            return


def brought_before(actions: Actions, index: int, before: int) -> Actions | None:
    """A branch with the cycle of ``index`` brought before that of ``before``; None where it is
    there already, or the same. Of what is taken out and what is put in while one part is open for
    both, only the order in there changes.
    """
    own, other = cycle_of(actions, index), cycle_of(actions, before)
    inner = Cycle(index, index + 2)
    pick, put = actions[index], actions[index + 1 : index + 2]
    taken_out = pick.verb is Verb.PICK_UP and any(one.verb in PUTS for one in put)
    if own == other and before < index < own.end - 2 and taken_out:
        return moved_before(actions, inner, before)
    if own.start <= other.start or before in own:
        return None
    return moved_before(actions, own, other.start)


def reachable_throughout(actions: Actions, scene: SceneState) -> Actions:
    """The branch, with a drawer opened and closed again where it would shut away what is needed.

    Bringing a cycle forward may leave a vessel in a drawer by the time something goes into it.
    """
    walk = Sketch(scene)
    for action in actions:
        if not walk.reaches(action):
            return _written_anew(actions, scene)
        walk.do(action)
    return actions


def _written_anew(actions: Actions, scene: SceneState) -> Actions:
    """The same picks, puts, openings and closings with the cycles around them renewed."""
    sketch = Sketch(scene)
    for index, action in enumerate(actions):
        part = scene.part(action.target)
        following = actions[index + 1] if index + 1 < len(actions) else None
        if action.verb is Verb.OPEN and part is not None:
            if _insertion_end(actions, index) is None:
                sketch.open(part)
        elif action.verb is Verb.CLOSE and part is not None:
            sketch.close(part)
        elif action.verb is Verb.PICK_UP and following is None:
            sketch.pick_up(action.target, action.pose)
        elif action.verb is Verb.PICK_UP and following is not None:
            if following.safe:
                sketch.take_away(action.target, following, action.pose)
            else:
                on = following.verb is Verb.PUT_ON
                relation = Relation.ON if on else Relation.INSIDE
                sketch.put(
                    action.target,
                    relation,
                    following.target,
                    action.pose,
                    following.where,
                    left_open(actions, scene),
                    stays_closed=_closed_next(actions[index:], scene),
                )
    return tuple(sketch.actions)


def _closed_next(actions: Sequence[Action], scene: SceneState) -> frozenset[str]:
    """Parts, by address, that the first of these actions that turns them closes."""
    first: dict[str, Verb] = {}
    for action in actions:
        part = scene.part(action.target)
        if part is not None and action.verb in (Verb.OPEN, Verb.CLOSE):
            first.setdefault(part.address, action.verb)
    return frozenset(address for address, verb in first.items() if verb is Verb.CLOSE)


def hand_free_at(actions: Sequence[Action], index: int, scene: SceneState) -> int | None:
    """The latest place at or before ``index`` where the hand is empty; None when there is none."""
    held = [scene.holding, *(after for _, _, after in in_hand(actions[:index], scene.holding))]
    return next((place for place in range(index, -1, -1) if held[place] is None), None)


def opened_before(actions: Sequence[Action], index: int) -> list[int]:
    """Indices of OPEN actions before ``index`` whose part is still open there, latest first."""
    found: list[int] = []
    for place in range(index):
        action = actions[place]
        if action.verb is Verb.OPEN:
            found.append(place)
        elif action.verb is Verb.CLOSE:
            found = [item for item in found if actions[item].target != action.target]
    return found[::-1]

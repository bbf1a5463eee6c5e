"""Two doors or drawers that cannot stand open together: opened by turns.

What goes from behind the one to behind the other waits elsewhere in between. All that leaves or
comes to a part while it stands open does so then, so that none is opened more than twice.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from etot_cli.reasoning.builtin.failed_case import FailedCase
from etot_cli.reasoning.builtin.relations import is_closed, is_inside
from etot_cli.reasoning.builtin.relocation import Correction, set_aside
from etot_cli.reasoning.builtin.revision import Actions
from etot_cli.skills.action import PUTS, Action, Verb
from etot_cli.world.state import STAYS_OPEN_AT, PartInfo, SceneState, owner_of

MOST_STAGES = 4
"""Changes from one part to the other that are made at most: a swap takes three stages, and one
more where another thing is to be where the swap would begin."""


def by_turns(case: FailedCase, part: PartInfo, name: str) -> Iterator[Correction]:
    """The branch with a part, and the one that stands open in its way, never open together.

    Args:
        case: the failed step, an OPEN of the part.
        part: the part.
        name: the object whose part stands open.
    """
    if case.start.holding is not None or case.action.verb is not Verb.OPEN:
        return
    for other in case.scene.infos[name].parts:
        if is_closed(case.scene, other) or other.owner == part.owner:
            continue
        for pair in ((other, part), (part, other)):
            actions = _Turns(case, pair).written()
            if actions is not None:
                yield Correction(
                    actions, f"{other.address} and {part.address} are opened one at a time"
                )


@dataclass
class _Stage:
    """What is done while one of the parts stands open; what is taken out to wait comes first."""

    taken: list[Action] = field(default_factory=list)
    done: list[Action] = field(default_factory=list)


class _Turns:
    """A branch dealt out to stages, in which the parts of a pair stand open by turns."""

    def __init__(self, case: FailedCase, pair: tuple[PartInfo, PartInfo]) -> None:
        self._case, self._pair, self._scene = case, pair, case.start
        self._stages = [_Stage() for _ in range(MOST_STAGES)]
        self._first: list[Action] = []
        """What comes before any of the parts is needed."""
        self._since: dict[str, int] = {}
        """The stage from which on a thing is where the branch has put it."""
        self._within = {
            thing: part
            for thing in self._scene.states
            for part in pair
            if is_inside(self._scene, thing, part.address)
        }
        self._now = -1

    def written(self) -> Actions | None:
        """The branch, or None where it cannot be done so."""
        wanted = [_last_turn(self._case.actions, part, self._scene) for part in self._pair]
        if wanted == [Verb.OPEN, Verb.OPEN]:
            return None
        index = 0
        while index < len(self._case.actions):
            action = self._case.actions[index]
            following = self._case.actions[index + 1 : index + 2]
            if action.verb is Verb.PICK_UP:
                if not following or following[0].verb not in PUTS:
                    return None  # parts are turned with an empty hand
                if not self._deal(action, following[0]):
                    return None
                index += 1
            elif self._turned(action) is None:
                self._add(self._now, action)
            index += 1
        return self._joined(wanted)

    def _turned(self, action: Action) -> PartInfo | None:
        """The part of the pair that an action is about."""
        names = ({part.address, f"{part.owner}.{part.name}"} for part in self._pair)
        return next(
            (part for part, name in zip(self._pair, names, strict=True) if action.target in name),
            None,
        )

    def _deal(self, pick: Action, put: Action) -> bool:
        """Deals out a pick and its put; False where there are not enough stages."""
        name, place = pick.target, owner_of(put.target)
        source = self._within.get(name)
        goal = self._turned(put) if put.verb is Verb.PUT_INTO else self._within.get(place)
        ready = max(self._since.get(name, -1), self._since.get(place, -1))
        if source is None and goal is None:
            stage = max(ready, self._now)
            self._add(stage, pick, put)
        elif source is not None and goal is not None and source != goal:
            out = self._open_at(source, self._since.get(name, -1))
            stage = self._open_at(goal, max(out, ready))
            if stage >= MOST_STAGES:
                return False
            aside = set_aside(self._case.failed, name)[1]
            self._stages[out].taken += [replace(pick, onward=None), aside]
            self._add(stage, pick, put)
        else:
            part = goal if source is None else source
            assert part is not None  # one of them is
            stage = self._open_at(part, ready)
            if stage >= MOST_STAGES:
                return False
            self._add(stage, pick, put)
        self._now = self._since[name] = stage
        self._within.pop(name, None)
        if goal is not None:
            self._within[name] = goal
        return True

    def _add(self, stage: int, *actions: Action) -> None:
        (self._first if stage < 0 else self._stages[stage].done).extend(actions)

    def _open_at(self, part: PartInfo, earliest: int) -> int:
        """The first stage from the earliest one on in which a part stands open."""
        stage = max(earliest, 0)
        return stage if self._pair[stage % 2] == part else stage + 1

    def _joined(self, wanted: Sequence[Verb]) -> Actions | None:
        """All stages, each opened and closed, with the parts left as the branch leaves them."""
        open_ = {part: self._scene.openness(part) >= STAYS_OPEN_AT for part in self._pair}
        actions = list(self._first)

        def turn(part: PartInfo, verb: Verb) -> None:
            if open_[part] != (verb is Verb.OPEN):
                actions.append(Action(verb, part.address))
                open_[part] = not open_[part]

        for number, stage in enumerate(self._stages):
            if stage.taken or stage.done:
                part, other = self._pair[number % 2], self._pair[1 - number % 2]
                turn(other, Verb.CLOSE)
                turn(part, Verb.OPEN)
                actions += [*stage.taken, *stage.done]
        for verb in (Verb.CLOSE, Verb.OPEN):
            for part, last in zip(self._pair, wanted, strict=True):
                if last is verb:
                    turn(part, verb)
        return tuple(actions)


def _last_turn(actions: Actions, part: PartInfo, scene: SceneState) -> Verb:
    """Whether a branch leaves a part open or closed."""
    names = (part.address, f"{part.owner}.{part.name}")
    turns = [
        action.verb
        for action in actions
        if action.target in names and action.verb in (Verb.OPEN, Verb.CLOSE)
    ]
    stood = Verb.CLOSE if is_closed(scene, part) else Verb.OPEN
    return turns[-1] if turns else stood

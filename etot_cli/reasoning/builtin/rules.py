"""The paper's rules of a well-formed plan, checked on any action sequence, whoever wrote it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass

from etot_cli.reasoning.builtin.relations import container_address
from etot_cli.skills.action import MAX_PLAN_ACTIONS, PUTS, Action, Verb
from etot_cli.world.state import DESK, STAYS_OPEN_AT, SceneState, owner_of


@dataclass(frozen=True, slots=True)
class Violation:
    """A broken rule.

    Args:
        index: place of the offending action in the plan.
        rule: number of the rule, as listed in ``docs/reasoners.md``.
        text: what is wrong, and with what.
    """

    index: int
    rule: int
    text: str

    def __str__(self) -> str:
        return f"step {self.index + 1}: {self.text} (rule {self.rule})"


def check_plan(
    actions: Sequence[Action], scene: SceneState, left_open: Collection[str] = ()
) -> list[Violation]:
    """Everything in a plan that breaks a rule; empty for a well-formed plan.

    Physical feasibility is not looked at; that is for the simulation.

    Args:
        actions: the whole plan, from the scene on.
        scene: the state in which the plan starts.
        left_open: addresses of parts that the goal wants open in the end; an insertion into one of
            them needs no CLOSE.
    """
    if len(actions) > MAX_PLAN_ACTIONS:
        return [Violation(MAX_PLAN_ACTIONS, 1, f"more than {MAX_PLAN_ACTIONS} actions")]
    return _Checker(scene, left_open).check(actions)


def in_hand(
    actions: Iterable[Action], held: str | None
) -> Iterator[tuple[str | None, Action, str | None]]:
    """Each action of a plan, between what the hand holds before and after it."""
    for action in actions:
        before = held
        if action.verb is Verb.PICK_UP:
            held = action.target
        elif action.verb in PUTS:
            held = None
        yield before, action, held


def left_open(actions: Sequence[Action], scene: SceneState) -> tuple[str, ...]:
    """Parts of a well-formed plan that are not closed by the insertion into them.

    Its goal wants them open, or closed later, so that a revision of it need not close them either.
    """
    found: dict[str, None] = {}
    waiting: str | None = None
    for action in actions:
        part = scene.part(action.target)
        if part is None or action.verb in (Verb.PICK_UP, Verb.PUT_ON):
            continue
        if waiting is not None and (action.verb, part.address) != (Verb.CLOSE, waiting):
            found[waiting] = None
        waiting = part.address if action.verb is Verb.PUT_INTO else None
    if waiting is not None:
        found[waiting] = None
    return tuple(found)


class _Checker:
    """Follows hand and openings through a plan."""

    def __init__(self, scene: SceneState, left_open: Collection[str]) -> None:
        self._scene = scene
        self._left_open = left_open
        self._held = scene.holding
        self._open = {
            part.address: scene.openness(part) >= STAYS_OPEN_AT
            for info in scene.infos.values()
            for part in info.parts
        }
        self._to_close: str | None = None
        """The articulated container of the insertion cycle that is not finished yet."""
        self._found: list[Violation] = []

    def check(self, actions: Sequence[Action]) -> list[Violation]:
        for index, action in enumerate(actions):
            if action.pose is not None and action.verb not in (Verb.PICK_UP, Verb.PUT_ON):
                self._say(index, 1, "only PICK UP takes a grasp pose, and PUT ON the next one's")
            match action.verb:
                case Verb.PICK_UP:
                    self._pick_up(index, action)
                case Verb.PUT_ON | Verb.PUT_INTO:
                    self._put(index, action)
                case Verb.OPEN | Verb.CLOSE:
                    self._articulate(index, action)
        if self._to_close is not None:
            self._say(
                len(actions) - 1,
                3,
                f"{self._to_close} is left open; an insertion into it ends with [CLOSE, "
                f"{self._to_close}]",
            )
        return self._found

    def _say(self, index: int, rule: int, text: str) -> None:
        self._found.append(Violation(index, rule, text))

    def _pick_up(self, index: int, action: Action) -> None:
        info = self._scene.infos.get(action.target)
        if info is None:
            self._say(index, 1, f"the scene has no object {action.target!r}")
        elif not info.movable:
            self._say(index, 1, f"{action.target} cannot be picked up")
        if self._held is not None:
            self._say(index, 2, f"PICK UP needs an empty hand, but it holds {self._held}")
        self._held = action.target

    def _put(self, index: int, action: Action) -> None:
        if self._held is None:
            self._say(index, 2, f"{action.verb.value} needs something in the hand")
        elif owner_of(action.target) == self._held:
            self._say(index, 1, f"{self._held} cannot be put on or into itself")
        self._held = None
        if action.verb is Verb.PUT_ON:
            self._surface(index, action.target)
        else:
            self._container(index, action.target)

    def _surface(self, index: int, target: str) -> None:
        owner, _, board = target.partition(".")
        info = self._scene.infos.get(owner)
        if target == DESK:
            return
        if info is None:
            self._say(index, 1, f"the scene has no surface {target!r}")
        elif board and board not in info.boards:
            self._say(index, 6, f"{target} is no surface; the top of {owner} is called {owner}")
        elif not info.bears and not board:
            self._say(index, 6, f"{target} has no flat top to put something on")

    def _container(self, index: int, target: str) -> None:
        address = container_address(self._scene, target)
        if address is None:
            self._say(index, 6, f"{target} is no container")
            return
        part = self._scene.part(address)
        if part is None:
            return
        if self._to_close is not None:
            self._say(
                index, 3, f"close {self._to_close} before the next insertion into a drawer or door"
            )
        if not self._open[part.address]:
            self._say(index, 3, f"{part.address} must be opened before something is put into it")
        self._to_close = None if part.address in self._left_open else part.address

    def _articulate(self, index: int, action: Action) -> None:
        verb = action.verb.value
        if self._held is not None:
            self._say(index, 2, f"{verb} needs an empty hand, but it holds {self._held}")
        part = self._scene.part(action.target)
        if part is None:
            info = self._scene.infos.get(action.target)
            if info is not None and info.parts:
                parts = " or ".join(part.address for part in info.parts)
                self._say(index, 1, f"{verb} must say which part of {action.target}: {parts}")
            else:
                self._say(index, 1, f"{action.target} has nothing to open or close")
            return
        self._open[part.address] = action.verb is Verb.OPEN
        if action.verb is Verb.CLOSE and self._to_close == part.address:
            self._to_close = None
        elif self._to_close is not None:
            self._say(index, 3, f"finish with [CLOSE, {self._to_close}] first")

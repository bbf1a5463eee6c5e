"""What a skill reports about itself."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from etot_cli.world.model import World
from etot_cli.world.state import DESK, Cause, CauseKind, owner_of


@dataclass(frozen=True)
class SkillOutcome:
    """``effect``: the motion ran to its end and its effect was seen; else ``cause`` says why not.

    ``another_way``: the failure lies in how it was done (a slip, a missed handle), so that another
    way of doing it may succeed.
    """

    effect: bool
    cause: Cause | None = None
    another_way: bool = False


DONE = SkillOutcome(True)


def failed(
    kind: CauseKind,
    objects: Iterable[str],
    text: str,
    time_s: float | None = None,
    *,
    another_way: bool = False,
    lasting: bool = False,
) -> SkillOutcome:
    """A failure with its physical cause; duplicate and foreign names are dropped."""
    names = tuple(dict.fromkeys(owner_of(name) for name in objects))
    at_s = None if time_s is None else round(time_s, 3)
    cause = Cause(kind, names, text, at_s, lasting)
    return SkillOutcome(False, cause, another_way)


def arm_stopped(
    when: str, against: Sequence[str], own: Sequence[str], time_s: float | None
) -> SkillOutcome:
    """The arm was stopped; another way may get past what stopped it.

    Args:
        when: "on the way to it".
        against: addresses of what it pressed on, the most telling first.
        own: objects that the action is about.
        time_s: since the action began [s].
    """
    text = (
        f"the arm was stopped {when} by {against[0]}"
        if against
        else f"the arm fell behind {when} though nothing touched it: more than its drives can do"
    )
    others = [address for address in against if address not in (DESK, "floor")]
    return failed(CauseKind.BLOCKED, [*others, *own], text, time_s, another_way=True)


class Blockers:
    """Counts what stood in the way of rejected candidates."""

    def __init__(self, world: World) -> None:
        self._known = world.entries
        self._count: Counter[str] = Counter()
        self._candidates = 0

    def add(self, addresses: Iterable[str]) -> None:
        """Notes the addresses that one candidate came too close to."""
        self._candidates += 1
        for name in {owner_of(address) for address in addresses}:
            if name in self._known:
                self._count[name] += 1

    def always(self, name: str) -> bool:
        """Whether every candidate came too close to this one."""
        return 0 < self._candidates == self._count[name]

    def most(self, excluding: Iterable[str]) -> tuple[str, ...]:
        """Object names, the most frequent blocker first."""
        out = set(excluding)
        ranked = sorted(self._count.items(), key=lambda item: (-item[1], item[0]))
        return tuple(name for name, _ in ranked if name not in out)

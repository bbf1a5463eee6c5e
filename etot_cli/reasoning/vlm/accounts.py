"""What the questions cost, per role, and the limits on it."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace

from etot_cli.reasoning.protocol import ReasonerStopped, StopReason
from etot_cli.reasoning.vlm.chat import Usage
from etot_cli.reasoning.vlm.notes import Note

MILLION = 1e6


@dataclass(frozen=True, slots=True)
class RoleAccount:
    """One role's share. ``requests`` went over the network, ``cached`` did not have to."""

    requests: int = 0
    failed: int = 0
    """Requests without a usable response, most of them retried."""
    cached: int = 0
    input_tokens: int = 0
    output_tokens: int = 0
    estimated: int = 0
    """Requests whose tokens the server did not state and that were estimated."""
    cost: float | None = 0.0
    """US dollars; None when no price is known."""

    def __add__(self, other: RoleAccount) -> RoleAccount:
        cost = None if self.cost is None or other.cost is None else self.cost + other.cost
        names = (item.name for item in fields(self) if item.name != "cost")
        return replace(self, **{n: getattr(self, n) + getattr(other, n) for n in names}, cost=cost)


@dataclass(slots=True)
class Accounts:
    """Keeps count and stops the run at its limits. Safe to use from several threads.

    Args:
        prices: US dollars per million input and output tokens, or None.
        max_calls: requests over the network at most.
        max_cost: US dollars at most; the request that crosses it is the last.
    """

    prices: tuple[float, float] | None = None
    max_calls: int | None = None
    max_cost: float | None = None
    _roles: dict[str, RoleAccount] = field(default_factory=dict)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def begin(self, role: str) -> None:
        """Counts a request that is about to be sent.

        Raises:
            ReasonerStopped: a limit has been reached; nothing must be sent.
        """
        with self._lock:
            total = self._total()
            if self.max_calls is not None and total.requests >= self.max_calls:
                raise ReasonerStopped(
                    StopReason.MAX_CALLS, f"stopped by --max-calls {self.max_calls}"
                )
            if self.max_cost is not None and (total.cost or 0.0) >= self.max_cost:
                raise ReasonerStopped(
                    StopReason.MAX_COST,
                    f"stopped by --max-cost {self.max_cost:g}: {total.cost or 0.0:.4f} spent",
                )
            self._book(role, RoleAccount(requests=1))

    def failed(self, role: str) -> None:
        """The request brought no usable response."""
        with self._lock:
            self._book(role, RoleAccount(failed=1))

    def cached(self, role: str) -> None:
        """A question was answered from a cassette or the cache."""
        with self._lock:
            self._book(role, RoleAccount(cached=1))

    def add(self, role: str, usage: Usage) -> None:
        """Books a response."""
        cost = usage.cost
        if cost is None and self.prices is not None:
            cost = (
                usage.input_tokens * self.prices[0] + usage.output_tokens * self.prices[1]
            ) / MILLION
        with self._lock:
            self._book(
                role,
                RoleAccount(
                    input_tokens=usage.input_tokens,
                    output_tokens=usage.output_tokens,
                    estimated=int(not usage.stated),
                    cost=cost,
                ),
            )

    @property
    def roles(self) -> Mapping[str, RoleAccount]:
        """Accounts by role."""
        with self._lock:
            return dict(self._roles)

    @property
    def total(self) -> RoleAccount:
        """All roles together."""
        with self._lock:
            return self._total()

    def _book(self, role: str, more: RoleAccount) -> None:
        self._roles[role] = self._roles.get(role, RoleAccount()) + more

    def _total(self) -> RoleAccount:
        return sum(self._roles.values(), start=RoleAccount())


@dataclass(frozen=True, slots=True)
class VlmAccount:
    """What a run asked a model, and what it cost. Free of secrets."""

    url: str
    model: str
    judge: str
    hints: bool
    """Whether it was told what the simulator knows of failures."""
    replayed: bool
    prompts: Mapping[str, str]
    total: RoleAccount
    roles: Mapping[str, RoleAccount]
    notes: tuple[Note, ...] = ()

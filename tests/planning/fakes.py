"""A toy world with rules in place of physics, and a reasoner with a script in place of a mind.

The world's state is its history, so every outcome is a pure function of where an action starts.
"""

from __future__ import annotations

import random
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor

from etot_cli.control.simulated import Course, Simulated, StateToken, Step, WorldOutcome
from etot_cli.reasoning.protocol import Assignment, Branch, FailedStep, Outcome, Verdict
from etot_cli.skills.action import Action, format_plan, parse_plan
from etot_cli.skills.deadline import NEVER
from etot_cli.world.state import (
    Cause,
    CauseKind,
    ObjectInfo,
    ObjectState,
    PartInfo,
    RolloutRecord,
    SceneState,
)

STEP_S = 1.5
"""Simulated time of every toy action [s]."""
STEPS = 750

Rule = Callable[[str, Action, int], Cause | None]
"""(history as a plan, action, world) → why the action fails, or None."""
UNSAFE_KINDS = frozenset({CauseKind.LOST, CauseKind.STRANDED})


def plan(text: str) -> tuple[Action, ...]:
    """``"a b"`` → [PICK UP, a] [PICK UP, b]; bracketed text is read as a plan."""
    if "[" in text:
        return parse_plan(text)
    return parse_plan(" ".join(f"[PICK UP, {name}]" for name in text.split()))


def branch(text: str, reason: str = "") -> Branch:
    return Branch(plan(text), reason)


def names(actions: Sequence[Action]) -> str:
    """The inverse of :func:`plan` for the short form."""
    return " ".join(action.target for action in actions)


def cause(kind: CauseKind = CauseKind.BLOCKED, *objects: str) -> Cause:
    return Cause(kind, objects, f"it was {kind.value}", 0.5)


def scene() -> SceneState:
    """One cup, one box with a lid; enough for conditions and targets."""
    lid = PartInfo("box", "lid", "box", "hinge", 1.5, True)
    infos = {
        "cup": ObjectInfo(
            "cup", "cup", "cup", "red", (0.08, 0.08, 0.1), 0.1, True, True, False, False
        ),
        "box": ObjectInfo(
            "box", "cabinet", "box", None, (0.3, 0.3, 0.3), 2.0, False, False, True, False, (lid,)
        ),
    }
    states = {
        "cup": ObjectState((0.3, 0.1, 0.2), (1.0, 0.0, 0.0, 0.0), on=("desk",)),
        "box": ObjectState(
            (0.5, 0.0, 0.3), (1.0, 0.0, 0.0, 0.0), on=("desk",),
            openness={"lid": 0.0}, opened={"lid": False},
        ),
    }  # fmt: skip
    return SceneState(infos, states, 0.13, (0.0, 0.8, -0.6, 0.6))


class ToySimulator:
    """Implements the simulator protocol; remembers what was asked of it.

    Args:
        rule: decides what fails.
        jobs: more than one runs submissions on threads, with random delays.
        worlds: varied worlds per state.
        delay_s: longest random delay of a submission.
    """

    def __init__(self, rule: Rule, *, jobs: int = 1, worlds: int = 1, delay_s: float = 0.0) -> None:
        self._rule = rule
        self._jobs = jobs
        self._worlds = worlds
        self._delay_s = delay_s
        self._random = random.Random(0)
        self._pool = ThreadPoolExecutor(jobs) if jobs > 1 else None
        self._lock = threading.Lock()
        self.submitted: list[tuple[str, str]] = []
        self.running = 0
        self.most_running = 0
        self.closed = False

    @property
    def jobs(self) -> int:
        return self._jobs

    @property
    def world_count(self) -> int:
        return self._worlds

    def start(self, until_s: float = NEVER) -> tuple[StateToken, SceneState]:
        return b"", scene()

    def submit(
        self, state: StateToken, action: Action, until_s: float = NEVER
    ) -> Future[Simulated]:
        key = (state.decode(), str(action))
        assert key not in self.submitted, f"simulated twice: {key}"
        self.submitted.append(key)
        delay = self._random.uniform(0, self._delay_s)
        if self._pool is not None:
            return self._pool.submit(self._simulate, state, action, delay)
        future: Future[Simulated] = Future()
        try:
            future.set_result(self._simulate(state, action, delay))
        except Exception as error:
            future.set_exception(error)
        return future

    def trials(self, worlds: int) -> ToyTrials:
        """Worlds 1 to ``worlds`` by the same rule."""
        return ToyTrials(ToySimulator(self._rule, worlds=1 + worlds))

    def close(self) -> None:
        self.closed = True
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)

    def _simulate(self, state: StateToken, action: Action, delay: float) -> Simulated:
        with self._lock:
            self.running += 1
            self.most_running = max(self.most_running, self.running)
        time.sleep(delay)
        history = state.decode()
        outcomes = []
        for world in range(self._worlds):
            why = self._rule(history, action, world)
            view = scene()
            record = RolloutRecord(
                view, view, effect=why is None, cause=why, simulated_s=STEP_S, steps=STEPS
            )
            outcomes.append(WorldOutcome(record, trajectory=(history, str(action))))
        with self._lock:
            self.running -= 1
        end = f"{history} {action}".strip().encode()
        return Simulated(outcomes, end, wall_s=delay)


class ToyTrials:
    """Implements the trials protocol on the worlds of a toy simulator, the nominal one left out."""

    def __init__(self, simulator: ToySimulator) -> None:
        self._simulator = simulator

    def carry_out(self, plan: Sequence[Step], until_s: float = NEVER) -> Iterator[Course]:
        state, start = self._simulator.start()
        records: list[list[RolloutRecord]] = [[] for _ in range(self._simulator.world_count)]
        for step in plan:
            simulated = self._simulator.submit(state, step.action).result()
            state = simulated.end
            for found, outcome in zip(records, simulated.outcomes, strict=True):
                if all(record.effect for record in found):
                    found.append(outcome.record)
        return iter([Course(start, tuple(found)) for found in records[1:]])

    def close(self) -> None:
        self._simulator.close()


class ToyReasoner:
    """Proposes a list, judges by the recorded cause, reflects by a script.

    Args:
        branches: what it proposes.
        revisions: ``"branch @ index"`` → revised branch, or several, best first, or None; in the
            short form. A missing entry means that it knows no revision. Or a function of the
            failed step.
    """

    def __init__(
        self,
        branches: Sequence[str],
        revisions: Mapping[str, str | Sequence[str] | None]
        | Callable[[FailedStep], Branch | Iterable[Branch] | None]
        | None = None,
    ) -> None:
        self._branches = [branch(text, f"idea {number}") for number, text in enumerate(branches)]
        self._revisions = revisions or {}
        self.judged: list[str] = []
        self.reflected: list[str] = []
        self.failed_steps: list[FailedStep] = []
        self.assignment: Assignment | None = None

    def propose(self, assignment: Assignment, scene: SceneState) -> Sequence[Branch]:
        self.assignment = assignment
        return self._branches

    def judge(self, action: Action, record: RolloutRecord) -> Verdict:
        self.judged.append(action.target)
        if record.cause is None:
            return Verdict(Outcome.SUCCESS, None, (action.target,))
        unsafe = record.cause.kind in UNSAFE_KINDS
        return Verdict(Outcome.UNSAFE if unsafe else Outcome.FAILURE, record.cause)

    def reflect(self, failed: FailedStep) -> Iterator[Branch]:
        key = f"{names(failed.branch.actions)} @ {failed.index}"
        self.reflected.append(key)
        self.failed_steps.append(failed)
        if callable(self._revisions):
            found = self._revisions(failed)
            return iter(() if found is None else [found] if isinstance(found, Branch) else found)
        texts = self._revisions.get(key)
        texts = () if texts is None else (texts,) if isinstance(texts, str) else texts
        return (branch(text, "revised") for text in texts)


def fails(*histories: str, kind: CauseKind = CauseKind.BLOCKED) -> Rule:
    """A rule under which exactly the given histories (short form) fail at their last action."""
    bad = {format_plan(plan(text)) for text in histories}

    def rule(history: str, action: Action, world: int) -> Cause | None:
        return cause(kind, action.target) if f"{history} {action}".strip() in bad else None

    return rule

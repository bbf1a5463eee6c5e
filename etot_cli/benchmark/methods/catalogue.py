"""The methods by name: what each plans with, and whether it plans anew after a failure."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from etot_cli.benchmark.methods.blame import Foresight
from etot_cli.benchmark.methods.planners import (
    RecoveringPlanner,
    SearchPlanner,
    WorldModel,
    at_once,
    by_steps,
)
from etot_cli.benchmark.methods.thinking import Thinking
from etot_cli.errors import EtotError
from etot_cli.execution.protocols import Planner
from etot_cli.planning.options import Ablation, Limits
from etot_cli.world.model import World


@dataclass(frozen=True)
class Means:
    """What planners are made of: the same for all methods.

    ``world``: the twin, of which geometry is read; ``physics``: the twin as a world model;
    ``imagined``: a world model without contact dynamics.
    """

    thinking: Thinking
    world: World
    physics: WorldModel
    imagined: WorldModel
    limits: Limits


@dataclass(frozen=True)
class Method:
    """A method.

    ``title`` as in tables; ``summary`` in a sentence; ``replans`` after a failure; ``foresight``:
    what its first plan is tried in.
    """

    name: str
    title: str
    summary: str
    replans: bool
    foresight: Foresight
    planner: Callable[[Means], Planner]


def _search(*without: Ablation) -> Callable[[Means], Planner]:
    def make(means: Means) -> Planner:
        return SearchPlanner(means.physics, means.thinking, means.limits, frozenset(without))

    return make


def _by_steps(means: Means) -> Planner:
    return by_steps(means.thinking, means.world)


def _reflect(means: Means) -> Planner:
    return RecoveringPlanner(_by_steps(means), _search()(means))


METHODS = {
    method.name: method
    for method in (
        Method(
            "rekep", "ReKep", "one plan from the scene, no world model",
            False, Foresight.NONE, lambda means: at_once(means.thinking),
        ),
        Method(
            "rekep_cot", "ReKep, thinking", "one plan after thinking about hazards",
            False, Foresight.NONE, _by_steps,
        ),
        Method(
            "reflect", "Reflect*", "the same, with an oracle's recovery after a failure",
            True, Foresight.NONE, _reflect,
        ),
        Method(
            "etot", "EToT", "tree search over the twin, planning anew",
            True, Foresight.PHYSICS, _search(),
        ),
        Method(
            "etot_without_priori", "without priori", "only the first proposed plan is searched",
            True, Foresight.PHYSICS, _search(Ablation.PRIORI),
        ),
        Method(
            "etot_without_reflective", "without reflective",
            "failed plans are dropped, never revised",
            True, Foresight.PHYSICS, _search(Ablation.REFLECTIVE),
        ),
        Method(
            "etot_without_replan", "without replanning", "the first plan is carried out to its end",
            False, Foresight.PHYSICS, _search(),
        ),
        Method(
            "etot_kinematic", "kinematic model", "tree search over a model without contact",
            True, Foresight.IMAGINED,
            lambda means: SearchPlanner(means.imagined, means.thinking, means.limits),
        ),
    )
}  # fmt: skip
"""In the order of tables."""


def methods_of(names: Sequence[str] | None) -> list[Method]:
    """Methods by name, in the order of tables; all when None.

    Raises:
        EtotError: there is no such method; the message lists them.
    """
    if names is None:
        return [*METHODS.values()]
    unknown = [name for name in names if name not in METHODS]
    if unknown:
        raise EtotError(f"no method {unknown[0]!r}; there are {', '.join(METHODS)}")
    return [method for method in METHODS.values() if method.name in names]

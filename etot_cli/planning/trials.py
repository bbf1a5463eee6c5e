"""How often a plan holds, tried in varied worlds that had no part in choosing it."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.control.simulated import Simulator
from etot_cli.planning.conditions import holds
from etot_cli.planning.survival import NOMINAL, Survival
from etot_cli.reasoning.protocol import Outcome, Reasoner
from etot_cli.skills.action import Action
from etot_cli.skills.deadline import NEVER
from etot_cli.specs.task import Condition

CHOOSING_WORLDS = 4
"""Worlds that a search tries its actions in, the twin counted. Three besides it let one plan in
eight pass that fails in every second world; what it is worth is told by fresh ones."""


def try_plan(
    plan: Sequence[Action],
    simulator: Simulator,
    reasoner: Reasoner,
    success: Sequence[Condition] = (),
    until_s: float = NEVER,
) -> Survival:
    """In how many worlds a plan holds; see :func:`survivors`."""
    alive = survivors(plan, simulator, reasoner, success, until_s)
    return Survival(len(alive), simulator.world_count - 1)


def survivors(
    plan: Sequence[Action],
    simulator: Simulator,
    reasoner: Reasoner,
    success: Sequence[Condition] = (),
    until_s: float = NEVER,
) -> tuple[int, ...]:
    """Carries a plan out in all worlds but the nominal one; the worlds in which it holds.

    Args:
        plan: the actions.
        simulator: opened on fresh worlds.
        reasoner: judges every action in every world that is still alive.
        success: the task's conditions, which have to hold at the end.
        until_s: a reading of ``time.monotonic`` [s].

    Raises:
        OutOfTimeError: not done at ``until_s``.
    """
    state, scene = simulator.start(until_s)
    alive = [world for world in range(simulator.world_count) if world != NOMINAL]
    finals = dict.fromkeys(alive, scene)
    for action in plan:
        simulated = simulator.submit(state, action, until_s).result()
        records = {world: simulated.outcomes[world].record for world in alive}
        finals = {world: record.after for world, record in records.items()}
        alive = [
            world
            for world, record in records.items()
            if reasoner.judge(action, record).outcome is Outcome.SUCCESS
        ]
        state = simulated.end
    return tuple(world for world in alive if all(holds(item, finals[world]) for item in success))

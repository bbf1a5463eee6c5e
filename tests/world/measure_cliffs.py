"""Where the shipped tasks' verdicts turn: ``python -m tests.world.measure_cliffs``.

One parameter at a time is moved through values on both sides, everything else as shipped.
"""

from __future__ import annotations

from dataclasses import dataclass

from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Outcome
from etot_cli.skills.action import parse_plan
from etot_cli.specs.load import load_task
from tests.shared import ROOT


@dataclass(frozen=True)
class Cliff:
    """A parameter (a field of an object; the last entry where it is a tuple) and its values."""

    task: str
    plan: str
    thing: str
    key: str
    values: tuple[float, ...]


CLIFFS = (
    Cliff("task3", "[PICK UP, holder] (horizontal)", "holder", "friction", (0.2, 0.24, 0.27, 0.32)),
    Cliff(
        "task2", "[PICK UP, pen] [PUT INTO, black_holder]", "black_holder", "mass",
        (0.06, 0.09, 0.1, 0.12, 0.15),
    ),
    Cliff("task4", "[CLOSE, drawer]", "toy", "size", (0.074, 0.077, 0.08, 0.086)),
)  # fmt: skip


def verdict(cliff: Cliff, value: float) -> str:
    """What becomes of the plan at a value: success, or the cause of the failure."""
    scene = load_task(ROOT / "tasks" / f"{cliff.task}.yaml").scene
    thing = scene.objects[cliff.thing]
    old = getattr(thing, cliff.key)
    new = (*old[:-1], value) if isinstance(old, tuple) else value
    changed = scene.objects | {cliff.thing: thing.model_copy(update={cliff.key: new})}
    world = SimulatedWorld(scene.model_copy(update={"objects": changed}), 0, keep_frames=False)
    state, _ = world.start()
    for action in parse_plan(cliff.plan):
        done = world.perform(state, action)
        found = BuiltinReasoner().judge(action, done.record)
        if found.outcome is not Outcome.SUCCESS:
            return found.cause.kind.value if found.cause else found.outcome.value
        state = done.end
    return "success"


def main() -> None:
    """Prints a table of every cliff."""
    for cliff in CLIFFS:
        found = [f"{value:g}: {verdict(cliff, value)}" for value in cliff.values]
        print(f"| {cliff.task} | `{cliff.plan}` | {cliff.thing}.{cliff.key} | {', '.join(found)} |",
              flush=True)  # fmt: skip


if __name__ == "__main__":
    main()

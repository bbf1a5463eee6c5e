"""Whether the odds that ``--worlds`` tells are the odds: many plans and worlds, easy to hopeless.

Run with ``make calibrate``. Each setting is a plan and how far worlds may differ; its odds are told
from 16 worlds and looked up in 24 others, and with ``--rounds N`` in N times as many. What the same
code has measured is kept in ``results/calibrate/worlds.jsonl``, so the command may be stopped.
"""

from __future__ import annotations

import argparse
import os
import sys
import zlib
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from typing import Any

from etot_cli.control.simulated import Step
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.control.simulator import world_seed
from etot_cli.control.trial_worlds import ActionTrials
from etot_cli.control.worlds import Recipe
from etot_cli.planning.trials import CHOOSING_WORLDS, try_plan
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.skills.action import Action, parse_plan
from etot_cli.specs.look import Look
from etot_cli.specs.scene import Scene
from etot_cli.specs.vary import vary_truth
from tests.measure.calibration import Pair, bias, coverage, decompose, draw_diagram, explained
from tests.measure.journal import ROOT, Journal, code_digest
from tests.measure.markdown import replace_section, table
from tests.world.helpers import BALL, BOX, CUP, PEN, UNIT, make_scene

STORE = ROOT / "results" / "calibrate" / "worlds.jsonl"
DIAGRAM = ROOT / "docs" / "images" / "calibration.png"
TITLE = "Calibration"
TELLING, UNSEEN = 16, 24
LEAST_SETTINGS, MOST_BEYOND, LEAST_COVERED, MOST_BIAS = 40, 0.01, 0.9, 0.03
BIG_BALL = BALL | {"diameter": 0.065, "mass": 0.057}
SLICK_CUP = CUP | {"diameter": 0.09, "slippery": True}


@dataclass(frozen=True)
class Setting:
    """Plans of which the one that holds most often where it is chosen is taken, and the worlds."""

    name: str
    objects: dict[str, dict[str, Any]]
    plans: tuple[str, ...]
    look: Look = Look.ONCE
    variation: dict[str, float] = field(default_factory=dict)

    def scene(self) -> Scene:
        """The nominal scene with its variation."""
        made = make_scene(**self.objects)
        wider = made.variation.model_copy(update=self.variation)
        return made.model_copy(update={"variation": wider})


def settings() -> Iterator[Setting]:
    """Easy to hopeless: start poses further and further off, frictions towards their cliffs."""
    ajar = [{"name": "top", "travel": 0.14, "open": 0.03}, {"name": "bottom", "travel": 0.0}]
    unit = UNIT | {"at": [0.45, 0.02], "yaw_deg": -90, "drawers": ajar}
    poses = [
        ("ball", {"ball": BALL | {"at": [0.36, 0.15]}}, "[PICK UP, ball]"),
        ("big ball", {"ball": BIG_BALL | {"at": [0.4, -0.1]}}, "[PICK UP, ball]"),
        ("box", {"box": BOX | {"at": [0.36, -0.2]}}, "[PICK UP, box]"),
        ("pen", {"pen": PEN | {"at": [0.4, 0.1]}}, "[PICK UP, pen]"),
        ("drawer ajar", {"unit": unit}, "[OPEN, unit]"),
        ("put", {"box": BOX | {"at": [0.36, -0.2]}, "base": BOX | {
            "size": [0.08, 0.08, 0.05], "at": [0.4, 0.15], "mass": 0.3}},
         "[PICK UP, box] [PUT ON, base]"),
    ]  # fmt: skip
    for name, objects, plan in poses:
        for millimetres in (12, 20, 28, 36, 46, 60):
            wider = {"position_m": millimetres / 1000, "yaw_deg": float(millimetres)}
            yield Setting(f"{name}, ±{millimetres} mm", objects, (plan,), variation=wider)
    near = {"position_m": 0.002, "yaw_deg": 2.0}
    for friction in (0.30, 0.36, 0.44):
        for spread in (0.3, 0.6):
            cup = SLICK_CUP | {"at": [0.4, 0.1], "friction": friction}
            yield Setting(
                f"smooth cup {friction}, ±{spread:.0%}",
                {"cup": cup},
                ("[PICK UP, cup] (horizontal)", "[PICK UP, cup] (vertical)")
                if spread > 0.5
                else ("[PICK UP, cup] (horizontal)",),
                variation=near | {"friction": spread},
            )
    for friction in (0.2, 0.28, 0.36):
        ball = BIG_BALL | {"at": [0.4, 0.1], "friction": friction}
        yield Setting(
            f"smooth ball {friction}, looking",
            {"ball": ball},
            ("[PICK UP, ball]",),
            Look.EACH,
            {"position_m": 0.01, "friction": 0.6, "pad_friction": 0.3},
        )


def rehearsed(twin: SimulatedWorld, plan: tuple[Action, ...]) -> tuple[Step, ...] | None:
    """A plan with the motions that bring it about in the twin; None where they do not."""
    state, _ = twin.start()
    steps = []
    for action in plan:
        performed = twin.perform(state, action)
        if not performed.record.effect:
            return None
        steps.append(Step(action, performed.motion))
        state = performed.end
    return tuple(steps)


def alive_in(job: tuple[str, int, int]) -> int | None:
    """In how many of a setting's worlds its plan holds; None where no plan works in the twin.

    Args:
        job: the setting's name, the first world and the number of worlds. Worlds of one setting
            have numbers, and are those that ``--worlds`` draws.
    """
    name, first, count = job
    (setting,) = (each for each in settings() if each.name == name)
    scene = setting.scene()
    # Settings that share their draws would err together.
    seed = zlib.crc32(name.encode())

    def alive(plan: tuple[Action, ...], kind: str, numbers: range, look: Look) -> int | None:
        truths = tuple(vary_truth(scene, world_seed(seed, kind, number)) for number in numbers)
        trials = ActionTrials(Recipe(scene, truths, seed, record=False, look=look))
        steps = rehearsed(SimulatedWorld(scene, seed, keep_frames=False), plan)
        return None if steps is None else try_plan(steps, trials, BuiltinReasoner()).alive

    plans = [parse_plan(plan) for plan in setting.plans]
    plan = plans[0]
    if len(plans) > 1:
        choosing = range(1, CHOOSING_WORLDS)
        plan = max(plans, key=lambda each: alive(each, "choosing", choosing, Look.ONCE) or 0)
    return alive(plan, "fresh", range(first, first + count), setting.look)


def report(pairs: list[Pair]) -> tuple[str, bool]:
    """The table, and whether every demand is met."""
    parts, chance = decompose(pairs), explained(pairs)
    beyond = parts.reliability - chance.reliability
    covered, off = coverage(pairs), bias(pairs)
    # What the draws of the unseen worlds alone put outside the intervals is not their fault.
    long_run = min(1.0, covered + chance.covered_in_the_long_run - chance.covered)
    between = sum(0.1 < pair.predicted < 0.9 for pair in pairs)
    unseen = pairs[0].unseen
    rows = [
        ["settings", str(len(pairs)), f"at least {LEAST_SETTINGS}"],
        ["of them told odds between 10 and 90 %", str(between), "–"],
        ["unseen worlds of each", str(unseen), f"at least {UNSEEN}"],
        ["Brier score", f"{parts.brier:.3f}", "–"],
        ["its reliability term", f"{parts.reliability:.4f}", "–"],
        ["the same for perfect odds, by the draws alone", f"{chance.reliability:.4f}", "–"],
        ["reliability beyond that", f"{beyond:+.4f}", f"at most {MOST_BEYOND}"],
        [f"intervals that hold the rate of the {unseen} unseen worlds", f"{covered:.0%}", "–"],
        ["the same for perfect odds", f"{chance.covered:.0%}", "–"],
        ["perfect odds: intervals that hold the odds", f"{chance.covered_in_the_long_run:.0%}",
         "–"],
        ["intervals that hold the odds, estimated", f"{long_run:.0%}",
         f"at least {LEAST_COVERED:.0%}"],
        ["told minus observed, mean", f"{off:+.3f}", f"at most {MOST_BIAS}"],
    ]  # fmt: skip
    good = (
        len(pairs) >= LEAST_SETTINGS
        and beyond <= MOST_BEYOND
        and long_run >= LEAST_COVERED
        and off <= MOST_BIAS
    )
    rows.append(["demands met", "yes" if good else "NO", ""])
    return table(["what", "measured", "demanded"], rows), good


def main() -> int:
    """Measures what is missing and writes the section; 0 when every demand is met."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=1, metavar="N", help="of unseen worlds")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N")
    parser.add_argument("--fresh", action="store_true", help="measure all again")
    parser.add_argument("--no-write", action="store_true")
    options = parser.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    if options.fresh:
        STORE.unlink(missing_ok=True)
    names = [setting.name for setting in settings()]
    parts = [(1, TELLING)]
    parts += [(1 + TELLING + UNSEEN * index, UNSEEN) for index in range(options.rounds)]
    jobs = [(name, *part) for part in parts for name in names]
    with ProcessPoolExecutor(options.jobs) as pool:
        alive = Journal(STORE, code_digest()).measure(pool, alive_in, jobs)
    found = dict(zip(jobs, alive, strict=True))
    pairs = []
    for name in names:
        told, *held = (found[name, *part] for part in parts)
        if told is None:
            print(f"{name}: no plan")
            continue
        pairs.append(Pair(name, told, TELLING, sum(held), UNSEEN * options.rounds))
        print(f"{name}: {told} of {TELLING}, {sum(held)} of {UNSEEN * options.rounds}")
    if not pairs:
        return 1
    text, good = report(pairs)
    print(f"\n{text}")
    if not options.no_write:
        replace_section(ROOT / "docs" / "results.md", TITLE, text)
        draw_diagram(pairs, DIAGRAM)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())

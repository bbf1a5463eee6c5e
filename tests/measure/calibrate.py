"""Whether the odds that ``--worlds`` tells are the odds: many plans and worlds, easy to hopeless.

Run with ``make calibrate``. Each setting is a plan and how far worlds may differ; its odds are told
from 16 worlds and looked up in 24 others. Settings already measured are kept in
``results/calibrate/settings.jsonl`` and not measured again, so the command may be stopped.
``--settings N`` measures N further ones at most; ``--fresh`` begins again.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import zlib
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import closing
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from etot_cli.control.simulator import open_simulator
from etot_cli.planning.trials import CHOOSING_WORLDS, survivors
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.skills.action import Action, parse_plan
from etot_cli.specs.look import Look
from etot_cli.specs.scene import Scene
from tests.measure.calibration import Pair, bias, coverage, decompose, draw_diagram, explained
from tests.measure.markdown import replace_section, table
from tests.world.helpers import BALL, BOX, CUP, PEN, UNIT, make_scene

ROOT = Path(__file__).resolve().parents[2]
STORE = ROOT / "results" / "calibrate" / "settings.jsonl"
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


def measure(setting: Setting) -> Pair | None:
    """One setting; None where no plan works in the twin."""
    scene = setting.scene()
    plans = [parse_plan(plan) for plan in setting.plans]
    # Settings that share their draws would err together.
    seed = zlib.crc32(setting.name.encode())
    plan = plans[0] if len(plans) == 1 else max(plans, key=lambda each: _chosen(scene, each, seed))
    alive = _alive(scene, plan, setting.look, 1 + TELLING + UNSEEN, seed, fresh=True)
    if alive is None:
        return None
    told = sum(world <= TELLING for world in alive)
    return Pair(setting.name, told, TELLING, len(alive) - told, UNSEEN)


def _chosen(scene: Scene, plan: tuple[Action, ...], seed: int) -> int:
    alive = _alive(scene, plan, Look.ONCE, CHOOSING_WORLDS, seed, fresh=False)
    return -1 if alive is None else len(alive)


def _alive(
    scene: Scene, plan: tuple[Action, ...], look: Look, worlds: int, seed: int, *, fresh: bool
) -> tuple[int, ...] | None:
    reasoner = BuiltinReasoner()
    simulator = open_simulator(
        scene, seed=seed, jobs=1, worlds=worlds, record=False, fresh=fresh, look=look
    )
    with closing(simulator):
        state, _ = simulator.start()
        first = simulator.submit(state, plan[0]).result().outcomes[0].record
        if not first.effect:
            return None
        return survivors(plan, simulator, reasoner)


def stored() -> list[Pair | str]:
    """What has been measured: pairs, and names of settings without a plan."""
    if not STORE.exists():
        return []
    found: list[Pair | str] = []
    for line in STORE.read_text(encoding="utf-8").splitlines():
        entry = json.loads(line)
        found.append(Pair(**entry) if "alive" in entry else entry["name"])
    return found


def report(pairs: list[Pair]) -> tuple[str, bool]:
    """The table, and whether every demand is met."""
    parts = decompose(pairs)
    chance, chance_covered = explained(pairs)
    beyond = parts.reliability - chance
    covered, off = coverage(pairs), bias(pairs)
    between = sum(0.1 < pair.predicted < 0.9 for pair in pairs)
    rows = [
        ["settings", str(len(pairs)), f"at least {LEAST_SETTINGS}"],
        ["of them told odds between 10 and 90 %", str(between), "–"],
        ["Brier score", f"{parts.brier:.3f}", "–"],
        ["its reliability term", f"{parts.reliability:.4f}", "–"],
        ["the same for perfect odds, by the draws alone", f"{chance:.4f}", "–"],
        ["reliability beyond that", f"{beyond:+.4f}", f"at most {MOST_BEYOND}"],
        ["Wilson intervals that hold the rate of the unseen worlds", f"{covered:.0%}",
         f"at least {LEAST_COVERED:.0%}"],
        ["the same for perfect odds", f"{chance_covered:.0%}", "–"],
        ["told minus observed, mean", f"{off:+.3f}", f"at most {MOST_BIAS}"],
    ]  # fmt: skip
    good = (
        len(pairs) >= LEAST_SETTINGS
        and beyond <= MOST_BEYOND
        and covered >= LEAST_COVERED
        and off <= MOST_BIAS
    )
    rows.append(["demands met", "yes" if good else "NO", ""])
    return table(["what", "measured", "demanded"], rows), good


def main() -> int:
    """Measures what is missing and writes the section; 0 when every demand is met."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--settings", type=int, default=None, metavar="N")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N")
    parser.add_argument("--fresh", action="store_true")
    parser.add_argument("--no-write", action="store_true")
    options = parser.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    STORE.parent.mkdir(parents=True, exist_ok=True)
    if options.fresh:
        STORE.unlink(missing_ok=True)
    known = {item if isinstance(item, str) else item.name for item in stored()}
    missing = [setting for setting in settings() if setting.name not in known]
    chosen = missing[: options.settings]
    with ProcessPoolExecutor(options.jobs) as pool:
        for setting, pair in zip(chosen, pool.map(measure, chosen), strict=True):
            entry = {"name": setting.name} if pair is None else asdict(pair)
            print(f"{setting.name}: {'no plan' if pair is None else pair}", flush=True)
            with STORE.open("a", encoding="utf-8") as stream:
                stream.write(json.dumps(entry) + "\n")
    pairs = [item for item in stored() if isinstance(item, Pair)]
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

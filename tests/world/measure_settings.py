"""Measures what docs/physics.md claims: ``python -m tests.world.measure_settings``.

Picks five things up in three varied worlds under changed physics settings, holds them for three
seconds and says how often they stayed, how far they crept in the fingers, and what a step costs.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import mujoco
import numpy as np

from etot_cli.control.robot import Guards
from etot_cli.control.simulated_robot import SimulatedRobot
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.errors import WorldError
from etot_cli.skills.action import parse_plan
from etot_cli.skills.motion.timing import CONTROL_PERIOD
from etot_cli.specs.load import load_task
from etot_cli.specs.vary import vary
from etot_cli.world.recorder import Recorder
from etot_cli.world.snapshot import restore, save
from tests.skills.helpers import BALL, BOX, CUP, PEN, robot_at
from tests.world.helpers import make_scene

THINGS = {
    "ball": BALL,
    "apple": BALL | {"diameter": 0.085, "mass": 0.15},
    "box": BOX,
    "pen": PEN,
    "cup rim": CUP | {"slippery": True, "friction": 0.4},
}
SEEDS = range(3)
Change = Callable[[mujoco.MjModel], None]


def _set(**options: object) -> Change:
    def change(model: mujoco.MjModel) -> None:
        for name, value in options.items():
            setattr(model.opt, name, value)

    return change


def _soft(model: mujoco.MjModel) -> None:
    model.geom_solref[:] = [0.02, 1.0]
    model.geom_solimp[:, :3] = [0.9, 0.95, 0.001]


SETTINGS: dict[str, Change] = {
    "as shipped": _set(),
    "contacts as soft as MuJoCo's default": _soft,
    "pyramidal cone": _set(cone=mujoco.mjtCone.mjCONE_PYRAMIDAL),
    "impratio 1": _set(impratio=1.0),
    "impratio 100": _set(impratio=100.0),
    "Euler": _set(integrator=mujoco.mjtIntegrator.mjINT_EULER),
    "step 5 ms": _set(timestep=0.005),
}


def _hold(name: str, seed: int, change: Change) -> float | None:
    """Creep in the fingers [m] over three seconds, None when it was not held."""
    scene = make_scene(thing=THINGS[name])
    simulated = SimulatedWorld(vary(scene, seed) if seed else scene, seed, keep_frames=False)
    change(simulated.world.model)
    try:
        start, _ = simulated.start()
        (action,) = parse_plan("[PICK UP, thing]")
        done = simulated.perform(start, action)
        if not done.record.effect:
            return None
        before = simulated.believe(done.end).attach("thing").in_tool.position
        robot_at(simulated, done.end).wait(3.0, Guards())
        memory = done.end.memory
        after = simulated.believe(save(simulated.world, simulated.data, memory))
        if after.held() != "thing":
            return None
        return float(np.linalg.norm(after.attach("thing").in_tool.position - before))
    except WorldError:
        return None


def _speed() -> None:
    simulated = SimulatedWorld(load_task("tasks/task7.yaml").scene, 0, keep_frames=False)
    start, _ = simulated.start()
    model, data = simulated.world.model, simulated.data
    bare, driven, steps = [], [], 10_000
    for _ in range(5):
        restore(simulated.world, data, start)
        begun = time.process_time()
        mujoco.mj_step(model, data, steps)
        bare.append(time.process_time() - begun)
        restore(simulated.world, data, start)
        recorder = Recorder(simulated.world, data, keep_frames=False)
        robot = SimulatedRobot(simulated.world, data, recorder)
        periods = round(steps * model.opt.timestep / CONTROL_PERIOD)
        targets = np.repeat(robot.state().targets[None], periods, axis=0)
        begun = time.process_time()
        robot.follow(targets, Guards())
        driven.append((time.process_time() - begun) * steps / robot.steps)
    each = min(bare) / steps
    print(f"{model.nv} degrees of freedom, {model.ngeom} geoms: {each * 1e6:.1f} µs a step, "
          f"{model.opt.timestep / each:.0f} simulated seconds a second")  # fmt: skip
    print(
        f"with targets, guards and recorder from Python: {min(driven) / min(bare):.2f} times that"
    )
    begun = time.process_time()
    for _ in range(2000):
        stored = save(simulated.world, data, start.memory)
    saved = (time.process_time() - begun) / 2000
    begun = time.process_time()
    for _ in range(2000):
        restore(simulated.world, data, stored)
    restored = (time.process_time() - begun) / 2000
    print(f"save {saved * 1e6:.1f} µs, restore {restored * 1e6:.1f} µs")


def main() -> None:
    """Prints the tables."""
    print(f"| setting | {' | '.join(THINGS)} | median creep in 3 s |")
    print("|---" * (len(THINGS) + 2) + "|")
    for label, change in SETTINGS.items():
        cells, creep = [], []
        for name in THINGS:
            found = [_hold(name, seed, change) for seed in SEEDS]
            kept = [value for value in found if value is not None]
            creep += kept
            cells.append(f"{len(kept)}/{len(found)}")
        middle = f"{np.median(creep) * 1000:.2f} mm" if creep else "–"
        print(f"| {label} | {' | '.join(cells)} | {middle} |", flush=True)
    _speed()


if __name__ == "__main__":
    main()

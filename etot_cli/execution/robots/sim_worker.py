"""The reference worker: the simulated robot, its eyes and its camera, in a process of their own.

``etot execute TASK --robot "worker:python -m etot_cli.execution.robots.sim_worker"`` gives the same
results as ``--robot sim``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from etot_cli.execution.cameras.rendered import RenderedCamera
from etot_cli.execution.cell import TrialOptions, simulated_world
from etot_cli.execution.robots.worker_server import Served, serve
from etot_cli.execution.simulated_device import SimulatedDevice
from etot_cli.execution.state_eyes import StateEyes
from etot_cli.specs.load import load_task


def opened(hello: dict[str, Any]) -> Served:
    """The world of the trial that ``hello`` speaks of.

    Raises:
        SpecError: its task is unusable.
        WorldError: the scene cannot be built.
    """
    task = load_task(Path(str(hello["task"])))
    options = TrialOptions(
        seed=int(hello["seed"]), number=int(hello["trial"]), disturb=bool(hello["disturb"])
    )
    world = simulated_world(task, options)
    noise = np.random.default_rng(world.random("camera").integers(2**63))
    camera = RenderedCamera(world.world.scene, lambda: world.data, noise)
    return Served(
        SimulatedDevice(world), StateEyes(world, task.scene.perception), camera, slower=5.0
    )


if __name__ == "__main__":
    serve(opened)

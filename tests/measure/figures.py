"""Renders the documentation's pictures: ``python -m tests.measure.figures docs/images``.

All scenes, the end of every naive plan beside its moments before, and the README's picture; needs
OpenGL. Nothing is drawn by hand: every picture is a stored configuration of a simulated run.
"""

from __future__ import annotations

import sys
from pathlib import Path

import cv2
import numpy as np

from etot_cli.commands.render import takes
from etot_cli.commands.simulate import SimulateOptions, Simulation, run_simulate
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.specs.load import load_task
from etot_cli.world.film import Take, key_moments
from etot_cli.world.studio import Shot, Studio, take
from etot_cli.world.workers import cores
from tests.measure.expectations import NAIVE_PLANS, TASKS

ROOT = Path(__file__).parents[2]
PANEL = (720, 450)
SMALL = (480, 300)
SAMPLES = 10
QUALITY = 80
PICTURES = 4
"""In a strip."""
APART_S = 0.15
"""Moments closer than this look the same [s]."""
GAP_PX = 6
HERO_TASK = "task5"
HERO = (
    ("[PICK UP, pen] [PUT INTO, black_holder]", -1),
    ("[PICK UP, pen] [PUT INTO, white_holder]", -1),
    ("[PICK UP, apple] [PUT ON, desk] (safe place) [PICK UP, pen] [PUT INTO, white_holder]", 1),
    ("[PICK UP, apple] [PUT ON, desk] (safe place) [PICK UP, pen] [PUT INTO, white_holder]", -1),
)
"""Plan, and the action whose end is shown."""


def main(arguments: list[str]) -> int:
    """Writes all pictures into the folder given as the only argument."""
    if len(arguments) != 1:
        print("usage: python -m tests.measure.figures FOLDER", file=sys.stderr)
        return 2
    folder = Path(arguments[0])
    folder.mkdir(parents=True, exist_ok=True)
    _save(folder / "scenes.webp", _grid([scene(task) for task in TASKS], 4))
    _save(folder / "hero.webp", _grid(hero(), 2))
    for number, naive in enumerate(NAIVE_PLANS, 1):
        name = f"naive-{number:02d}-{naive.task}.webp"
        _save(folder / name, _grid(strip(naive.task, naive.plan), 4))
    return 0


def scene(task: str) -> np.ndarray:
    """A task's start, with its instruction."""
    loaded = load_task(ROOT / "tasks" / f"{task}.yaml")
    world = SimulatedWorld(loaded.scene)
    world.start()
    qpos = np.array(world.data.qpos)
    return _take(loaded.scene, qpos, [Shot(qpos, (), loaded.instruction)], SMALL)[0]


def hero() -> list[np.ndarray]:
    """Two plans that fail, and the one that works."""
    panels = []
    for plan, index in HERO:
        simulation = _simulate(HERO_TASK, plan)
        film = takes(simulation)
        shown = film[index]
        assert simulation.scene is not None
        last = len(shown.trajectory.times) - 1
        panels += _take(simulation.scene, film[0].trajectory.qpos[0], [shown.shot(last)], PANEL)
    return panels


def strip(task: str, plan: str) -> list[np.ndarray]:
    """The last action of a plan that fails, or what led to its being refused; four pictures."""
    simulation = _simulate(task, plan)
    film = takes(simulation)
    assert simulation.scene is not None
    shots = [film[-1].shot(row) for row in _four_rows(film[-1])]
    # An action that is refused has no moments of its own: then how it came to that is shown.
    ends = [(part, len(part.trajectory.times) - 1) for part in film[:-1]]
    wanted = [(film[0], 0), *ends][-(PICTURES - len(shots)) :] if len(shots) < PICTURES else []
    shots = [part.shot(row) for part, row in wanted] + shots
    return _take(simulation.scene, film[0].trajectory.qpos[0], shots, SMALL)


def _four_rows(part: Take) -> list[int]:
    times = part.trajectory.times - part.trajectory.times[0]
    candidates = [row for _, _, row in key_moments(part.trajectory)]
    if 0 < part.since_s < float(times[-1]):
        candidates.append(int(np.argmin(np.abs(times - part.since_s))))
    ordered: list[int] = []
    for row in (*sorted(candidates), *(int(s * (len(times) - 1)) for s in (0.33, 0.67, 0.5, 0.85))):
        enough = row not in candidates and len(ordered) >= PICTURES
        if not enough and all(abs(times[row] - times[other]) >= APART_S for other in ordered):
            ordered.append(row)
    ordered.sort()
    return [*ordered[:1], *ordered[1 - PICTURES :]] if len(ordered) > PICTURES else ordered


def _simulate(task: str, plan: str) -> Simulation:
    file = ROOT / "tasks" / f"{task}.yaml"
    return run_simulate(SimulateOptions(task=file, plan=plan, record=True))


def _take(
    scene: object, framed: np.ndarray, shots: list[Shot], size: tuple[int, int]
) -> list[np.ndarray]:
    studio = Studio(scene, framed, *size, SAMPLES)  # type: ignore[arg-type]
    taken = take(studio, shots, jobs=cores())
    return [image for image in taken if isinstance(image, np.ndarray)]


def _grid(images: list[np.ndarray], columns: int) -> np.ndarray:
    rows = []
    for first in range(0, len(images), columns):
        row = images[first : first + columns]
        row += [np.full_like(row[0], 255)] * (columns - len(row))
        gap = np.full((row[0].shape[0], GAP_PX, 3), 255, np.uint8)
        rows.append(np.hstack([piece for image in row for piece in (image, gap)][:-1]))
        rows.append(np.full((GAP_PX, rows[-1].shape[1], 3), 255, np.uint8))
    return np.vstack(rows[:-1])


def _save(path: Path, image: np.ndarray) -> None:
    options = [cv2.IMWRITE_WEBP_QUALITY, QUALITY]
    if not cv2.imwrite(str(path), cv2.cvtColor(image, cv2.COLOR_RGB2BGR), options):
        raise OSError(f"cannot write {path}")
    print(path)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

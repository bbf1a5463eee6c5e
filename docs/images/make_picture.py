"""Renders the README's picture: two plans that fail and the one that works, from the simulator.

Run with ``python docs/images/make_picture.py`` from the repository's root; needs OpenGL.
"""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.skills.action import parse_plan
from etot_cli.specs.load import load_task
from etot_cli.world.render import render_frames

ROOT = Path(__file__).resolve().parents[2]
PANELS = (
    ("[PICK UP, pen] [PUT INTO, black_holder]", "topples", False),
    ("[PICK UP, pen] [PUT INTO, white_holder]", "rebounds off the apple", False),
    ("[PICK UP, apple] [PUT ON, desk]", "apple to a safe place ...", True),
    (
        "[PICK UP, apple] [PUT ON, desk] [PICK UP, pen] [PUT INTO, white_holder]",
        "... then the pen: it stays",
        True,
    ),
)
SIZE = (1280, 720)


def panel(workshop: SimulatedWorld, plan: str, note: str, good: bool) -> np.ndarray:
    """The end of a plan, with a caption."""
    state, _ = workshop.start()
    actions = parse_plan(plan)
    for action in actions:
        performed = workshop.perform(state, action)
        state = performed.end
    rows = performed.trajectory.qpos[-1:]
    image = render_frames(workshop.world.scene, rows, None, *SIZE)[0]
    image = cv2.cvtColor(np.ascontiguousarray(image), cv2.COLOR_RGB2BGR)[60:620, 140:1140]
    image = cv2.resize(image, (800, 448), interpolation=cv2.INTER_AREA)
    color = (70, 140, 40) if good else (40, 40, 190)
    cv2.rectangle(image, (0, 0), (799, 44), (250, 250, 250), -1)
    cv2.rectangle(image, (0, 0), (12, 44), color, -1)
    text = f"{actions[-1]}: {note}"
    cv2.putText(image, text, (26, 30), cv2.FONT_HERSHEY_SIMPLEX, 0.7, (40, 40, 40), 2, cv2.LINE_AA)
    return image


def main() -> None:
    """Writes the picture beside this file."""
    workshop = SimulatedWorld(load_task(ROOT / "tasks" / "task5.yaml").scene)
    images = [panel(workshop, *item) for item in PANELS]
    picture = np.vstack([np.hstack(images[:2]), np.hstack(images[2:])])
    cv2.imwrite(str(Path(__file__).parent / "task5.png"), picture)


if __name__ == "__main__":
    main()

"""Pages beside reports: pictures rendered from what was simulated, then one HTML file.

Rendering comes after the answer is on record, from stored configurations. A page never changes a
command's answer: without OpenGL it shows drawn views from above, and says what to install.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from etot_cli.commands.plan import Planning
from etot_cli.commands.simulate import Simulation
from etot_cli.control.simulated import WorldOutcome
from etot_cli.errors import EtotError
from etot_cli.reporting.files import write_page
from etot_cli.reporting.page.pictures import Frame, Picture
from etot_cli.reporting.page.plan_page import plan_page
from etot_cli.reporting.page.replay import Track
from etot_cli.reporting.page.simulate_page import simulate_page
from etot_cli.reporting.page.topview import top_view
from etot_cli.reporting.provenance import rendering_phase
from etot_cli.specs.scene import Scene
from etot_cli.world.recorder import Trajectory
from etot_cli.world.state import RolloutRecord
from etot_cli.world.studio import Progress, Shot, Studio, alike, take
from etot_cli.world.workers import cores

PAGE_PICTURES_BYTES = 6_500_000
"""All pictures of a page; in base64, with the rest of the page, they stay below 10 MB."""
WIDEST_PX, NARROWEST_PX = 800, 320
"""Widths of a page's pictures: enough to enlarge one, and enough to see a cup."""
BYTES_PER_PIXEL = 0.06
"""Of a rendered desk as WebP of this quality, measured; a little above the mean."""
QUALITY = 72
"""Of WebP, 0 to 100; what BYTES_PER_PIXEL was measured with."""
RATIO = 16 / 10
"""Of width to height: a desk from the front, with the arm above it."""
SAMPLES = ((12, 4), (24, 3), (10**9, 2))
"""Renders per picture for so many pictures: a page's pictures take about as long as a short plan,
3 s on two cores, and two samples already take the stairs off edges."""
RENDER_SECONDS = 120.0
"""Longest time for a page's pictures; what is left over is drawn from above."""
REPLAY_RATE = 3.0
"""Frames of a replay per second of film: an arm at its 0.4 m/s is followed in steps of a hand's
breadth. Who wants it smooth has ``--video``."""
MAX_REPLAY_FRAMES = 120
"""Frames of a replay at most: nobody steps through more, and each costs a tenth of a second."""
AFTERMATH_S = 0.25
"""A failure is best seen when its effect shows, shortly after its cause [s]."""


@dataclass(frozen=True, slots=True)
class Wanted:
    """A picture that a page wants: what to render, and how to draw it instead, as SVG."""

    key: str
    shot: Shot | None
    drawn: Callable[[], bytes]


def _from_above(record: RolloutRecord, culprits: tuple[str, ...], *, first: bool) -> bytes:
    """The desk before an action, or after it."""
    if first:
        return top_view(record.before)
    return top_view(record.after, before=record.before, culprits=culprits)


def write_plan_page(planning: Planning, folder: Path, progress: Progress | None = None) -> Path:
    """Renders what the search tried and writes the page into ``folder``.

    Args:
        planning: report, scene and what every node did.
        folder: of the report.
        progress: told of every picture.

    Raises:
        EtotError: the page cannot be written.
    """
    report = planning.report
    wanted: list[Wanted] = []
    frames: dict[int, list[Frame]] = {}
    parents = {node.id: node.parent for node in report.tree.nodes}
    for number in _by_importance(planning):
        outcome = planning.result.rollouts[number]
        cause = next(n.cause for n in report.tree.nodes if n.id == number)
        culprits = tuple(cause.objects) if cause is not None else ()
        frames[number] = _frames_of(number, outcome, culprits, cause.time_s if cause else None,
                                    parents[number], planning, wanted)  # fmt: skip
    with rendering_phase(report.timing):
        pictures, notice = take_pictures([(planning.scene, wanted)], progress)
    return write_page(plan_page(report, frames, pictures, notice), folder)


def write_simulate_page(
    simulation: Simulation, folder: Path, progress: Progress | None = None
) -> Path:
    """Renders a simulation as single frames and writes the page into ``folder``.

    Raises:
        EtotError: the page cannot be written.
    """
    report = simulation.report
    films = [t for t in simulation.trajectories if isinstance(t, Trajectory) and len(t.times)]
    whole = len(films) == len(report.steps) and films
    durations = [t.seconds for t in films] if whole else [1.0] * len(report.steps)
    wanted: list[Wanted] = []
    frames: list[tuple[float, str]] = []
    start = 0.0
    rate = min(REPLAY_RATE, MAX_REPLAY_FRAMES / max(sum(durations), 1e-3))
    for index, (record, duration) in enumerate(zip(simulation.records, durations, strict=True)):
        cause = report.steps[index].cause
        culprits = tuple(cause.objects) if cause is not None else ()
        since = duration if cause is None or cause.time_s is None else cause.time_s
        moments = np.linspace(0.0, duration, max(2, round(duration * rate) + 1))
        for time_s in moments if whole else (0.0, duration):
            key = f"f{len(wanted)}"
            shot = None
            if whole:
                row = films[index].row_at(time_s)
                shot = Shot(films[index].qpos[row], culprits if time_s >= since else ())
            last = wanted[-1].shot if wanted else None
            if shot is not None and last is not None and alike(last, shot):
                continue  # what stands still needs no second picture
            first = time_s < duration / 2
            wanted.append(Wanted(key, shot, partial(_from_above, record, culprits, first=first)))
            frames.append((start + float(time_s), key))
        start += duration
    with rendering_phase(report.timing):
        pictures, notice = take_pictures([(simulation.scene, coarse_first(wanted))], progress)
    track = Track("The simulation", frames)
    return write_page(simulate_page(report, durations, [track], pictures, notice), folder)


def coarse_first(wanted: Sequence[Wanted]) -> list[Wanted]:
    """In such an order that those rendered when time is up are evenly spread over the film."""
    order = sorted(range(len(wanted)), key=lambda index: -((index & -index) or len(wanted)))
    return [wanted[index] for index in order]


def _by_importance(planning: Planning) -> list[int]:
    """Evaluated nodes: the plan's, then the failures, then the rest."""
    report, rollouts = planning.report, planning.result.rollouts
    failed = [n.id for n in report.tree.nodes if n.status in ("failure", "unsafe")]
    rest = [node.id for node in report.tree.nodes]
    return [n for n in dict.fromkeys([*report.plan_nodes, *failed, *rest]) if n in rollouts]


def _frames_of(
    number: int,
    outcome: WorldOutcome,
    culprits: tuple[str, ...],
    failed_s: float | None,
    parent: int | None,
    planning: Planning,
    wanted: list[Wanted],
) -> list[Frame]:
    """Before, the key moment and after an action; enters what has to be rendered."""
    record = outcome.record
    trajectory = outcome.trajectory if isinstance(outcome.trajectory, Trajectory) else None
    known = {plan.key for plan in wanted}
    before = f"n{parent}-after" if parent in planning.result.rollouts else "start"
    found = [Frame(before, "Before")]
    rows = trajectory.qpos if trajectory is not None and len(trajectory.times) else None

    def want(key: str, row: int | None, first: bool) -> None:
        if key in known:
            return
        shot = None
        if rows is not None and row is not None:
            shot = Shot(rows[row], () if first else culprits)
        wanted.append(Wanted(key, shot, partial(_from_above, record, culprits, first=first)))

    if before == "start":
        want(before, 0, True)
    if rows is not None and trajectory is not None:
        # Of what went well and is no part of the plan, the end says enough.
        told = failed_s is not None or number in planning.report.plan_nodes
        moment = _key_moment(trajectory, failed_s, trajectory.seconds) if told else None
        if moment is not None:
            want(f"n{number}-key", trajectory.row_at(moment), False)
            what = "when it went wrong" if failed_s is not None else "the key moment"
            found.append(Frame(f"n{number}-key", f"After {moment:.1f} s, {what}"))
    want(f"n{number}-after", -1, False)
    found.append(Frame(f"n{number}-after", "After" if rows is not None else "After, from above"))
    return found


def _key_moment(trajectory: Trajectory, failed_s: float | None, duration: float) -> float | None:
    """The moment that tells most [s]; None when the ends of the action say it all."""
    candidates: Iterable[float]
    if failed_s is not None:
        candidates = [failed_s + AFTERMATH_S]
    else:
        candidates = [float(t) for t in reversed(trajectory.key_times)]
    return next((t for t in candidates if AFTERMATH_S < t < duration - AFTERMATH_S), None)


def take_pictures(
    films: Sequence[tuple[Scene | None, Sequence[Wanted]]], progress: Progress | None
) -> tuple[dict[str, Picture], str]:
    """The pictures by key, rendered where that can be done, and a line on why where it cannot.

    Args:
        films: scenes with what is wanted of each, the most important first.
        progress: told of every picture.
    """
    pictures: dict[str, Picture] = {}
    notice = ""
    count = sum(plan.shot is not None for scene, film in films if scene for plan in film)

    def told(done: int, total: int, before: int) -> None:
        if progress is not None:
            progress(before + done, count)

    deadline = time.monotonic() + RENDER_SECONDS
    try:
        for scene, film in films:
            own = {plan.key: plan.shot for plan in film if plan.shot is not None}
            if scene is None or not own:
                continue
            share = max(deadline - time.monotonic(), 0.0) * len(own) / (count - len(pictures))
            taken = take(
                page_studio(scene, next(iter(own.values())).qpos, count), list(own.values()),
                jobs=cores(), seconds=share, progress=partial(told, before=len(pictures)),
            )  # fmt: skip
            for key, content in zip(own, taken, strict=True):
                if isinstance(content, bytes):
                    pictures[key] = Picture("webp", content)
        if len(pictures) < count:
            notice = f"Only {len(pictures)} of {count} pictures were rendered in time."
    except EtotError as error:
        notice = f"Views from above are drawn instead of pictures: {error}"
    for _, film in films:
        for plan in film:
            if plan.key not in pictures:
                pictures[plan.key] = Picture("svg", plan.drawn())
    return pictures, notice


def page_studio(scene: Scene, framed: NDArray[Any], count: int) -> Studio:
    """Picture size and quality at which ``count`` pictures stay within a page."""
    pixels = PAGE_PICTURES_BYTES / max(count, 1) / BYTES_PER_PIXEL
    width = int(min(WIDEST_PX, max(NARROWEST_PX, sqrt(pixels * RATIO)))) // 16 * 16
    samples = next(samples for most, samples in SAMPLES if count <= most)
    return Studio(
        scene, framed, width, int(width / RATIO) // 2 * 2, samples, encoding="webp", quality=QUALITY
    )

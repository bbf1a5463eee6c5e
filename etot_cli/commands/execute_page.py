"""The page beside an execution's report, and the films of both worlds on demand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from etot_cli.commands.execute import Execution
from etot_cli.commands.pages import (
    MAX_REPLAY_FRAMES,
    Wanted,
    coarse_first,
    take_pictures,
)
from etot_cli.commands.render import rendering
from etot_cli.execution.records import Carried, Trial
from etot_cli.execution.world import AWAY, AWAY_SPACING
from etot_cli.reporting.files import write_page
from etot_cli.reporting.page.execute_page import execute_page
from etot_cli.reporting.page.replay import Track
from etot_cli.reporting.page.topview import top_view
from etot_cli.reporting.provenance import rendering_phase
from etot_cli.specs.scene import Scene
from etot_cli.world.configurations import states_of
from etot_cli.world.recorder import FRAME_PERIOD, Trajectory
from etot_cli.world.state import ObjectState, SceneState
from etot_cli.world.studio import Progress, Shot, alike
from etot_cli.world.workers import cores

if TYPE_CHECKING:
    from etot_cli.world.captions import Tone
    from etot_cli.world.film import Take

FILM_SIZE = (640, 360)
"""Of each of the two films, to be played side by side [px]."""
FRAMES_PER_S = 2.0
"""Of each world in the page's replay: two worlds take twice the pictures of a simulation's."""


def write_films(execution: Execution, folder: Path, progress: Progress | None = None) -> None:
    """Renders the first trial: the world as it went, and what the twin foresaw from what was seen.

    Args:
        execution: recorded.
        folder: of the report; files and time go into the report.
        progress: told of every picture.

    Raises:
        ServiceError: OpenGL, or a library that rendering needs, is not there.
    """
    trial = execution.trials[0]
    with rendering():
        from etot_cli.world.film import write_video
    scenes: list[tuple[str, Scene | None, bool]] = [
        ("world", trial.true_scene, False), ("twin", trial.scene, True),
    ]  # fmt: skip
    with rendering_phase(execution.report.timing):
        for name, scene, foreseen in scenes:
            film = _takes(trial, foreseen=foreseen)
            if scene is None or not film:
                continue
            file = f"{name}.mp4"
            write_video(scene, film, folder / file, size=FILM_SIZE, jobs=cores(), progress=progress)
            execution.report.files[name] = file


def _takes(trial: Trial, *, foreseen: bool) -> list[Take]:
    """The motions of a trial as a film, each named and judged."""
    from etot_cli.world.film import Take

    found = []
    sizes = {len(trajectory.qpos[0]) for item in trial.actions for trajectory in item.foreseen}
    for number, item in enumerate(trial.actions, 1):
        for trajectory in item.foreseen if foreseen else item.trajectories:
            if foreseen and len(trajectory.qpos[0]) != max(sizes):
                continue  # of before something came onto the scene: another model
            verdict = ""
            if item.cause is not None and not foreseen:
                verdict = f"{item.status}: {item.cause.text}"
            tone: Tone = "bad" if verdict else "plain" if foreseen else "good"
            culprits = item.cause.objects if verdict and item.cause else ()
            caption = f"{number}   {item.action}"
            found.append(
                Take(trajectory, caption, verdict, tone, tuple(culprits), trajectory.seconds)
            )
    return found


def write_execute_page(
    execution: Execution, folder: Path, progress: Progress | None = None
) -> Path:
    """Writes the page, with the replay of the first trial where its motions were recorded.

    Raises:
        EtotError: the page cannot be written.
    """
    report = execution.report
    with rendering_phase(report.timing):
        films = _films(execution.trials[0]) if execution.trials else []
        pictures, notice = take_pictures(
            [(film.scene, coarse_first(film.wanted)) for film in films], progress
        )
    tracks = [film.track for film in films]
    return write_page(execute_page(report, execution.trials, tracks, pictures, notice), folder)


@dataclass(frozen=True, slots=True)
class _Film:
    """A world's pictures on the robot's time."""

    scene: Scene
    wanted: Sequence[Wanted]
    track: Track


def _films(trial: Trial) -> list[_Film]:
    """What happened, and what was foreseen, as single frames."""
    named = (
        ("w", "The world, as it went", trial.true_scene, False),
        ("t", "The twin: what was foreseen from what was seen", trial.scene, True),
    )
    there = [
        (letter, name, scene, pieces)
        for letter, name, scene, foreseen in named
        if scene is not None and (pieces := _pieces(trial, foreseen=foreseen))
    ]
    seconds = sum(piece.seconds for *_, pieces in there for piece in pieces)
    rate = min(FRAMES_PER_S, MAX_REPLAY_FRAMES / max(seconds, 1e-3))
    return [_film(letter, name, scene, pieces, rate) for letter, name, scene, pieces in there]


@dataclass(frozen=True, slots=True)
class _Piece:
    """One motion in a world: on the robot's time from ``start`` on, for so many seconds."""

    item: Carried
    trajectory: Trajectory
    start: float
    seconds: float
    foreseen: bool

    @property
    def parted_s(self) -> list[float]:
        """When the worlds parted within it, since its start [s]; empty where they did not."""
        parted = self.item.parted
        since = -1.0 if parted is None else parted.time_s - self.start
        return [since] if 0.0 <= since <= self.seconds else []

    def outlined(self, time_s: float) -> tuple[str, ...]:
        """What failed, at its end, and what has parted from the other world by then."""
        item, names = self.item, []
        if item.parted is not None and time_s >= item.parted.time_s:
            names.append(item.parted.name)
        if item.cause is not None and not self.foreseen and time_s > item.end_s - FRAME_PERIOD:
            names += item.cause.objects
        return tuple(dict.fromkeys(names))


def _pieces(trial: Trial, *, foreseen: bool) -> list[_Piece]:
    """The motions of a trial in one of its worlds, in order of time."""
    found = []
    widths = [len(one.qpos[0]) for item in trial.actions for one in item.foreseen]
    for item in trial.actions:
        start = item.begin_s
        trajectories = item.foreseen if foreseen else item.trajectories
        if len(trajectories) != len(item.traces):
            continue  # which motion was not recorded is not known
        for trace, trajectory in zip(item.traces, trajectories, strict=True):
            lasted = trace.phases[-1].end_s if trace.phases else 0.0
            # Before something came onto the scene, the twin was another model.
            if len(trajectory.times) and (not foreseen or len(trajectory.qpos[0]) == max(widths)):
                # What the twin goes on to do after the robot stopped did not come to pass.
                seconds = min(trajectory.seconds, lasted)
                found.append(_Piece(item, trajectory, start, seconds, foreseen))
            start += lasted
    return found


def _film(letter: str, name: str, scene: Scene, pieces: Sequence[_Piece], rate: float) -> _Film:
    shots: list[Shot] = []
    frames: list[tuple[float, str]] = []
    for piece in pieces:
        even = np.linspace(0.0, piece.seconds, max(2, round(piece.seconds * rate) + 1))
        for moment in np.union1d(even, piece.parted_s):
            now = piece.start + float(moment)
            row = piece.trajectory.row_at(moment)
            shot = Shot(piece.trajectory.qpos[row], piece.outlined(now))
            if shots and alike(shots[-1], shot):
                continue  # what stands still needs no second picture
            frames.append((now, f"{letter}{len(shots)}"))
            shots.append(shot)

    @cache
    def states() -> list[SceneState]:
        found = states_of(scene, [shot.qpos for shot in shots])
        return [
            replace(state, states={n: s for n, s in state.states.items() if not _away(s)})
            for state in found
        ]

    def drawn(index: int) -> bytes:
        return top_view(states()[index], culprits=shots[index].outlined, framed=states()[0])

    wanted = [
        Wanted(key, shot, partial(drawn, index))
        for index, ((_, key), shot) in enumerate(zip(frames, shots, strict=True))
    ]
    return _Film(scene, wanted, Track(name, frames))


def _away(state: ObjectState) -> bool:
    """Whether an object is not on the scene: taken away, or not there yet."""
    return all(
        at > beyond - AWAY_SPACING / 2 for at, beyond in zip(state.position[:2], AWAY, strict=True)
    )

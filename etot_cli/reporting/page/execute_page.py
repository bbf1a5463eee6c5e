"""The page of an execution: a replay, one row per action and per look, and what was believed."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence

from etot_cli.execution.records import Trial
from etot_cli.reporting.execute_report import CLASSES, ExecuteReport, TrialModel
from etot_cli.reporting.page.assemble import assemble
from etot_cli.reporting.page.pictures import Picture
from etot_cli.reporting.page.replay import Block, Event, Replay, Track
from etot_cli.reporting.page.timeline import time_parts
from etot_cli.reporting.page.trial_rows import look_after, look_text, plan_text, shown_trial


def execute_page(
    report: ExecuteReport,
    trials: Sequence[Trial],
    tracks: Sequence[Track] = (),
    filmed: Mapping[str, Picture] | None = None,
    notice: str = "",
) -> str:
    """The page as text.

    Args:
        report: what happened.
        trials: the same with the states that were believed, for the pictures.
        tracks: films of the first trial on the robot's time, shown side by side; none without one.
        filmed: pictures by the keys that the tracks use.
        notice: shown at the top.
    """
    pictures: dict[str, Picture] = {}
    shown = [
        shown_trial(model, trial, pictures)
        for model, trial in zip(report.trials, trials, strict=True)
    ]
    failed = sum(trial.status == "failure" for trial in report.trials)
    first = report.trials[0] if report.trials else None
    replay = None if first is None or not tracks else replay_of(first, tracks)
    return assemble(
        "execute.html.j2",
        scripts=("replay.js",),
        data={} if replay is None else replay.data,
        pictures=pictures | dict(filmed or {}),
        command="execute",
        title=f"{report.task.name}: {report.status}",
        subject=report.task.file,
        heading=report.task.instruction or report.task.name,
        head=report,
        lead=report.reason or f"{report.successes} of {len(report.trials)} succeeded",
        notice=notice,
        trials=shown,
        replay=None if replay is None else replay.shown,
        replayed=0 if first is None else first.number,
        compared=len(tracks) > 1,
        parted=[action.parted for action in first.actions if action.parted] if first else [],
        films=[file for name, file in report.files.items() if name in ("world", "twin")],
        failed=failed,
        classes=[(name.replace("_", " "), getattr(report.attribution, name)) for name in CLASSES]
        + [("nobody's", report.attribution.none)],
        repeat=_command(report),
        **time_parts(report.timing),
    )


def replay_of(trial: TrialModel, tracks: Sequence[Track]) -> Replay:
    """The films with the trial's looks, plans, disturbances and failures; on the robot's time."""
    blocks = []
    # Events of one time in the order in which they came; numbers as for the rows of a trial.
    found: list[tuple[int, Event]] = []
    for look in trial.looks:
        text = f"look {look.why}: {look_text(look)}"
        found.append((4 * look.index + 1, Event(look.time_s, "look", text)))
    for plan in trial.plans:
        why = f"replanned, as {plan.reason}" if plan.index else "planned"
        event = Event(trial.looks[plan.look].time_s, "plan", f"{why}: {plan_text(plan)}")
        found.append((4 * plan.look + 2, event))
    for item in trial.disturbances:
        event = Event(item.time_s, "somebody", f"somebody: {item.text}")
        found.append((4 * look_after(trial, item.time_s), event))
    for action in trial.actions:
        first, last = (action.looks[0], action.looks[-1]) if action.looks else (0, 0)
        blocks.append(Block(action.action, action.status, action.begin_s, action.end_s))
        begun = Event(action.begin_s, "action", f"{action.action} begins")
        found.append((4 * first + 3, begun))
        if action.parted is not None:
            text = f"world and twin part: {action.parted.object} {action.parted.text}"
            found.append((4 * first + 3, Event(action.parted.time_s, "parted", text)))
        ended_s = action.begin_s
        for attempt in action.attempts[:-1]:
            ended_s += attempt.phases[-1].end_s if attempt.phases else 0.0
            event = Event(ended_s, "failure", f"{action.action} came to nothing, and is tried anew")
            found.append((4 * first + 3, event))
        if action.status != "success":
            told = action.cause.text if action.cause else action.status
            event = Event(action.end_s, "failure", f"{action.action} failed: {told}")
            found.append((4 * last + 1, event))
    ended = f"{trial.status}: {trial.reason}" if trial.reason else trial.status
    events = [event for _, event in sorted(found, key=lambda entry: entry[0])]
    events.append(Event(trial.robot_s, "end", ended))
    latest = max((track.frames[-1][0] for track in tracks if track.frames), default=0.0)
    return Replay(tracks, blocks, events, max(trial.robot_s, latest))


def _command(report: ExecuteReport) -> str:
    options = report.options
    words = ["etot", "execute", report.task.file, "--robot", options.robot]
    words += ["--perception", options.perception, "--seed", str(report.seed)]
    words += ["--trials", str(options.trials)] if options.trials > 1 else []
    words += [] if options.disturb else ["--no-disturb"]
    words += [] if options.replan else ["--without", "replan"]
    return shlex.join(words)

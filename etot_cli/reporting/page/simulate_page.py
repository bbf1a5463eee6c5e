"""The page of a simulation: a replay with a slider, and what every action did."""

from __future__ import annotations

import shlex
from collections.abc import Sequence

from etot_cli.reporting.evidence import moved_text
from etot_cli.reporting.page.assemble import assemble
from etot_cli.reporting.page.pictures import Store
from etot_cli.reporting.page.replay import Block, Event, Replay, Track
from etot_cli.reporting.page.timeline import time_parts
from etot_cli.reporting.simulate_report import SimulateReport


def simulate_page(
    report: SimulateReport,
    durations: Sequence[float],
    tracks: Sequence[Track],
    pictures: Store,
    notice: str = "",
) -> str:
    """The page as text.

    Args:
        report: what happened.
        durations: length of each step's film [s].
        tracks: films, shown side by side on one time line.
        pictures: by the keys that the tracks use.
        notice: shown at the top.
    """
    steps = []
    blocks: list[Block] = []
    events: list[Event] = []
    start = 0.0
    for step, duration in zip(report.steps, durations, strict=True):
        cause = step.cause
        steps.append(
            {
                "action": step.action,
                "safe": step.safe,
                "status": step.status,
                "cause": cause.text if cause else "",
                "moved": [moved_text(item) for item in step.moved],
                "simulated_s": step.simulated_s,
            }
        )
        blocks.append(Block(step.action, step.status, start, start + duration))
        events.append(Event(start, "action", f"{step.action} begins"))
        for contact in step.contacts:
            if contact.time_s <= duration:
                text = f"{contact.first} touches {contact.second} ({contact.peak_force_n:.0f} N)"
                events.append(Event(start + contact.time_s, "touch", text))
        if cause is not None:
            when = duration if cause.time_s is None else min(cause.time_s, duration)
            text = f"{cause.kind.value.replace('_', ' ')}: {cause.text}"
            events.append(Event(start + when, "failure", text))
        start += duration
    conditions = report.success_conditions
    replay = Replay([track for track in tracks if track.frames], blocks, events, start)
    return assemble(
        "simulate.html.j2",
        scripts=("replay.js",),
        data=replay.data,
        pictures=pictures,
        command="simulate",
        title=f"{report.task.name}: {report.status}",
        subject=report.task.file,
        heading=report.task.instruction or report.task.name,
        head=report,
        lead=report.cause or " ".join(report.plan),
        notice=notice,
        replay=replay.shown,
        steps=steps,
        untried=report.plan[len(report.steps) :],
        conditions=conditions.conditions if conditions is not None else None,
        repeat=shlex.join(
            ["etot", "simulate", report.task.file, "--plan", " ".join(report.plan)]
            + ["--seed", str(report.seed)]
            + (["--vary"] if report.vary else [])
        ),
        **time_parts(report.timing),
    )

"""One trial as pages show it: a row per plan, look, action and disturbance; views from above."""

from __future__ import annotations

from typing import Any

from etot_cli.execution.records import Trial
from etot_cli.reporting.evidence import moved_text
from etot_cli.reporting.execute_report import LookModel, PlanMadeModel, TrialModel
from etot_cli.reporting.page.pictures import Picture
from etot_cli.reporting.page.topview import top_view
from etot_cli.reporting.style import LOOKS_LIKE

MAX_PICTURES = 200
"""Views from above on one page; of later trials the rows say it in words."""


def shown_trial(model: TrialModel, trial: Trial, pictures: dict[str, Picture]) -> dict[str, Any]:
    """What the template's ``account`` takes.

    Args:
        model: the trial as it stands in reports.
        trial: the same with the states that were believed, for the views from above.
        pictures: of the page; views are added to it.
    """
    keys = _draw(trial, pictures)
    chip = LOOKS_LIKE.get(model.status, model.status)
    rows = _rows(model, keys)
    views = [row for row in rows if row.get("picture")]
    return {"model": model, "chip": chip, "rows": rows, "views": views}


def _draw(trial: Trial, pictures: dict[str, Picture]) -> dict[int, str]:
    """Views of what is believed after a look that changed it; their keys by the look's index."""
    keys: dict[int, str] = {}
    before = None
    for index, look in enumerate(trial.looks):
        if look.scene is None:
            continue
        if len(pictures) < MAX_PICTURES and (before is None or look.differs):
            key = f"t{trial.number}l{index}"
            culprits = [item.name for item in look.differs]
            pictures[key] = Picture("svg", top_view(look.scene, before=before, culprits=culprits))
            keys[index] = key
        before = look.scene
    return keys


def _rows(trial: TrialModel, keys: dict[int, str]) -> list[dict[str, Any]]:
    """Plans, looks, disturbances and actions in the order in which they came."""
    # Four places for every look: what somebody did before it, the action that it comes after,
    # itself, and what was made of it.
    rows = [(look.index * 4 + 2, _look_row(look, keys.get(look.index))) for look in trial.looks]
    for plan in trial.plans:
        row = _row("plan", plan.reason, plan_text(plan), plan.wall_s)
        if plan.status != "feasible":
            row["status"] = "failure"
        rows.append((plan.look * 4 + 3, row))
    for action in trial.actions:
        last = action.looks[-1] if action.looks else 0
        looked_after = len(action.looks) > 1
        moved = "; ".join(map(moved_text, action.moved))
        text = moved if action.cause is None else action.cause.text
        row = _row("action", action.action, text, action.end_s - action.begin_s, action.status)
        rows.append((last * 4 + (1 if looked_after else 3), row))
    rows += [
        (look_after(trial, item.time_s) * 4, _row("somebody", item.text))
        for item in trial.disturbances
    ]
    return [row for _, row in sorted(rows, key=lambda entry: entry[0])]


def look_after(trial: TrialModel, time_s: float) -> int:
    """Index of the first look that could see what happened then."""
    seen = (look.index for look in trial.looks if look.time_s >= time_s)
    return min(seen, default=len(trial.looks))


def look_text(look: LookModel) -> str:
    """What was not as believed."""
    return "; ".join(f"{item.object} {item.text}" for item in look.differs) or "as believed"


def plan_text(plan: PlanMadeModel) -> str:
    """The plan's actions, or why there are none."""
    return " ".join(plan.actions) or plan.stopped or "nothing is to be done"


def _row(
    kind: str, what: str, text: str = "", spent_s: float | None = None, status: str = ""
) -> dict[str, Any]:
    return {"kind": kind, "what": what, "text": text, "seconds": spent_s, "status": status}


def _look_row(look: LookModel, key: str | None) -> dict[str, Any]:
    unseen = [f"{item.object} {item.mark}" for item in look.objects if item.mark != "seen"]
    row = _row("look", look.why, "; ".join([look_text(look), *unseen]), look.wall_s)
    return row | {"picture": key}

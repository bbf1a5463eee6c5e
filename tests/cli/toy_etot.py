"""The program ``etot`` with toy rooms: ``python toy_etot.py ARGUMENTS…``.

The toy world takes its time for an action on ``slow``; actions on ``bad`` fail. ``TOY_BRANCHES``
replaces the branches, one a comma.
"""

from __future__ import annotations

import os
import time

from etot_cli import rooms
from etot_cli.cli import app
from etot_cli.skills.action import Action
from etot_cli.world.state import Cause
from tests.planning.fakes import ToyReasoner, ToySimulator, cause
from tests.reporting.toy_rooms import ToyRooms


def rule(history: str, action: Action, world: int) -> Cause | None:
    if action.target == "slow":
        print("sleeping", flush=True)
        time.sleep(30.0)
    return cause() if action.target == "bad" else None


def toy_rooms() -> rooms.Rooms:
    branches = os.environ.get("TOY_BRANCHES", "bad,good slow").split(",")
    reasoner = ToyReasoner(branches, {"bad @ 0": "good bad"})
    return ToyRooms(ToySimulator(rule), reasoner).rooms()


def main() -> None:
    """The program."""
    rooms.default_rooms = toy_rooms
    app.main()


if __name__ == "__main__":
    main()

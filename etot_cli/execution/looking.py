"""What is believed of the scene: brought up to date by every look."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from etot_cli.execution.account import Account
from etot_cli.execution.acting import handled_at, last_command
from etot_cli.execution.believed import BelievedTwin
from etot_cli.execution.cell import Cell, Describes
from etot_cli.execution.differences import differences
from etot_cli.execution.observation import Observation
from etot_cli.execution.records import Difference, Look
from etot_cli.skills.motion.motion import Trace
from etot_cli.specs.scene import Scene
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import SceneState


class Believed:
    """The twin, and what relations say of it; there is none before the first look.

    Args:
        scene: nominal.
        seed: of the twin.
        cell: whose eyes look.
        account: keeps every look.
        renewed: told of the scene when something new has come onto it.
    """

    def __init__(
        self,
        scene: Scene,
        seed: int,
        cell: Cell,
        account: Account,
        renewed: Callable[[Scene], None],
    ) -> None:
        self._seed, self._cell, self._account, self._renewed = seed, cell, account, renewed
        self.twin = BelievedTwin(scene, seed)
        self.command: float | None = None
        """The opening that the gripper was last sent to [m]."""
        self._handled: tuple[float, ...] | None = None
        self._seen: tuple[Snapshot, SceneState] | None = None

    @property
    def scene(self) -> SceneState:
        """What was seen last, as relations see it."""
        assert self._seen is not None
        return self._seen[1]

    @property
    def snapshot(self) -> Snapshot:
        """The twin's state after the last look."""
        assert self._seen is not None
        return self._seen[0]

    def look(self, why: str) -> tuple[Difference, ...]:
        """Looks, and brings the twin into the state that was seen; what is not as expected."""
        account = self._account
        last = account.looks[-1].observation if account.looks else None
        with account.timed("looking") as spent:
            sensed = self._cell.robot.state()
            state = replace(sensed, sent=self.command, handled=self._handled)
            seen = self._cell.eyes.look(state, last or Observation(state))
            self._meet(seen)
            known = {name: item for name, item in seen.objects.items() if name in self._known}
            seen = replace(seen, objects=known)
            expected = self._seen
            self._seen = self.twin.see(seen, self.command)
        differs = () if expected is None else differences(expected[1], self.scene)
        errors = account.errors(seen)
        account.looks.append(
            Look(account.robot_s(), why, seen, differs, self.scene, errors, spent())
        )
        return differs

    def moved(self, trace: Trace) -> None:
        """Takes note of what the robot was sent."""
        self._handled = handled_at(trace, self.command, self._handled)
        self.command = last_command((trace,), self.command)

    @property
    def _known(self) -> frozenset[str]:
        return frozenset(self.twin.world.entries)

    def _meet(self, seen: Observation) -> None:
        """Takes what is new into the twin."""
        eyes, new = self._cell.eyes, {}
        for name in seen.objects:
            item = eyes.what_is(name) if isinstance(eyes, Describes) else None
            if name not in self._known and item is not None:
                new[name] = item
        if not new:
            return
        scene = self.twin.scene
        scene = scene.model_copy(update={"objects": {**scene.objects, **new}})
        memory = self.twin.memory
        self.twin = BelievedTwin(scene, self._seed)
        if memory is not None:
            self.twin.remember(memory)
        self._renewed(scene)

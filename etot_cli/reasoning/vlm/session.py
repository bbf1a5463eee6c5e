"""Everything that a run with a model needs, opened and closed together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from etot_cli.control.simulated import Simulator
from etot_cli.errors import EtotError
from etot_cli.reasoning.protocol import Reasoner
from etot_cli.reasoning.vlm.accounts import VlmAccount
from etot_cli.reasoning.vlm.asking import Asker
from etot_cli.reasoning.vlm.client import ChatClient
from etot_cli.reasoning.vlm.notes import Notebook
from etot_cli.reasoning.vlm.prompts import Prompts
from etot_cli.reasoning.vlm.reasoner import VlmReasoner
from etot_cli.reasoning.vlm.redact import public_url
from etot_cli.reasoning.vlm.rendered import RenderedFrames, Unseen, Watched
from etot_cli.reasoning.vlm.settings import VlmSettings
from etot_cli.specs.scene import Scene


class VlmSession:
    """A model as the reasoner in one scene. Close it when done.

    Args:
        settings: endpoint, limits, judge.
        scene: what is planned in.
        seed: goes into every question.
        state: judges by the world's exact state.

    Raises:
        EtotError: a setting, a prompt or the cassette cannot be used.
        ServiceError: frames are wanted and there is no OpenGL.
    """

    def __init__(
        self, settings: VlmSettings, scene: Scene, *, seed: int, state: Reasoner | None
    ) -> None:
        if settings.max_cost is not None and settings.prices() is None:
            raise EtotError(
                f"--max-cost needs the price of {settings.model}: set ETOT_VLM_PRICE_INPUT and "
                "ETOT_VLM_PRICE_OUTPUT, in US dollars per million tokens"
            )
        prompts = Prompts(settings.prompts)
        self._settings = settings
        self._prompts = prompts.versions
        self._notes = Notebook()
        self._client = ChatClient(settings)
        self._frames = RenderedFrames(scene, settings.image_width) if settings.images else None
        self._unseen = Unseen()
        # Where no state is known, as on a real robot, there is nothing to hint at.
        self._hints = settings.hints if settings.hints is not None else state is not None
        self.reasoner: Reasoner = VlmReasoner(
            Asker(self._client, prompts, self._notes, seed),
            frames=self._frames,
            judge=settings.judge,
            state=state,
            nominal=None if self._frames is not None else self._unseen.knows,
            marks=settings.marks,
            hints=self._hints,
            probe=settings.probe,
        )

    @property
    def needs_trajectories(self) -> bool:
        """Whether the simulator has to record, so that there are frames."""
        return self._frames is not None

    def watch(self, simulator: Simulator) -> Simulator:
        """The simulator to search with: what it does can be looked at."""
        return Watched(simulator, self._frames or self._unseen)

    def account(self) -> VlmAccount:
        """What has been asked so far."""
        return VlmAccount(
            url=public_url(self._client.url),
            model=self._client.model,
            judge=self._settings.judge,
            hints=self._hints,
            replayed=self._client.replaying,
            prompts=self._prompts,
            total=self._client.accounts.total,
            roles=self._client.accounts.roles,
            notes=self._notes.notes,
        )

    def close(self) -> None:
        """Ends connections and frees the graphics context; idempotent."""
        self._client.close()
        if self._frames is not None:
            self._frames.close()


def open_vlm(
    flags: Mapping[str, Any], scene: Scene, *, seed: int, state: Reasoner | None
) -> VlmSession:
    """A session from command-line flags, the environment and ``.env``.

    Raises:
        EtotError: see :class:`VlmSession`.
    """
    return VlmSession(VlmSettings.load(**flags), scene, seed=seed, state=state)

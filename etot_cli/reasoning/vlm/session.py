"""Everything that a run with a model needs, opened and closed together."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from etot_cli.control.simulated import Simulator
from etot_cli.errors import EtotError
from etot_cli.reasoning.protocol import Assignment, Reasoner
from etot_cli.reasoning.vlm.accounts import VlmAccount
from etot_cli.reasoning.vlm.asking import Asker
from etot_cli.reasoning.vlm.baselines import OneShot
from etot_cli.reasoning.vlm.client import ChatClient
from etot_cli.reasoning.vlm.frames import FrameSource
from etot_cli.reasoning.vlm.notes import Notebook
from etot_cli.reasoning.vlm.prompts import Prompts
from etot_cli.reasoning.vlm.reasoner import VlmReasoner
from etot_cli.reasoning.vlm.rendered import NominalOutcomes, RenderedFrames, Watched
from etot_cli.reasoning.vlm.settings import VlmSettings
from etot_cli.services.redact import public_url
from etot_cli.specs.scene import Scene
from etot_cli.world.state import SceneState


class VlmSession:
    """A model as the reasoner in one scene. Close it when done.

    Args:
        settings: endpoint, limits, judge.
        scene: what is planned in.
        seed: goes into every question.
        state: judges by the world's exact state.
        through: replaces the rendered frames that the model gets to see by others.

    Raises:
        EtotError: a setting, a prompt or the cassette cannot be used.
        ServiceError: frames are wanted and there is no OpenGL.
    """

    def __init__(
        self,
        settings: VlmSettings,
        scene: Scene,
        *,
        seed: int,
        state: Reasoner | None,
        through: Callable[[RenderedFrames], FrameSource] | None = None,
    ) -> None:
        prompts = usable_prompts(settings)
        self._settings = settings
        self._prompts = prompts.versions
        self._notes = Notebook()
        self._client = ChatClient(settings)
        self._frames = RenderedFrames(scene, settings.image_width) if settings.images else None
        shown = self._frames if self._frames is None or through is None else through(self._frames)
        self._outcomes = self._frames or NominalOutcomes()
        # Where no state is known, as on a real robot, there is nothing to hint at.
        self._hints = settings.hints if settings.hints is not None else state is not None
        self._asker = Asker(self._client, prompts, self._notes, seed)
        self.reasoner: Reasoner = VlmReasoner(
            self._asker,
            frames=shown,
            judge=settings.judge,
            state=state,
            nominal=None if self._frames is not None else self._outcomes.knows,
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
        return Watched(simulator, self._outcomes)

    def one_shot(self, assignment: Assignment, scene: SceneState) -> OneShot:
        """A plan from looking at a scene, without any simulation."""
        return OneShot(self._asker, self._frames, assignment, scene)

    @property
    def rendering_s(self) -> float:
        """Wall time that pictures have taken so far [s]."""
        return 0.0 if self._frames is None else self._frames.spent_s

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


def usable_prompts(settings: VlmSettings) -> Prompts:
    """The prompts, where all that a session needs besides a server is there.

    Raises:
        EtotError: a template cannot be used, or a cost is bounded that cannot be told.
    """
    if settings.max_cost is not None and settings.prices() is None:
        raise EtotError(
            f"--max-cost needs the price of {settings.model}: set ETOT_VLM_PRICE_INPUT and "
            "ETOT_VLM_PRICE_OUTPUT, in US dollars per million tokens"
        )
    return Prompts(settings.prompts)


def open_vlm(
    flags: Mapping[str, Any], scene: Scene, *, seed: int, state: Reasoner | None
) -> VlmSession:
    """A session from command-line flags, the environment and ``.env``.

    Raises:
        EtotError: see :class:`VlmSession`.
    """
    return VlmSession(VlmSettings.load(**flags), scene, seed=seed, state=state)

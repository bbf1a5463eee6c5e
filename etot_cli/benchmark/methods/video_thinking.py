"""A video-generation model as the world model: what it shows is what the judge goes by.

Every action is given to the server as a sentence, with a picture of the scene as it is meant to be
before it; the frames of the video go to the vision-language model, which alone decides whether the
action works. Where things are afterwards, a video does not say: the next picture shows them where
the action was meant to bring them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from typing import Any

from etot_cli.benchmark.methods.kinematic import KinematicSimulator
from etot_cli.benchmark.methods.model_thinking import ModelThinking
from etot_cli.benchmark.methods.video_endpoint import Frame, VideoEndpoint, frames_of
from etot_cli.control.simulated import Simulated, Simulator, StateToken
from etot_cli.errors import ServiceError
from etot_cli.reasoning.protocol import ReasonerStopped, StopReason
from etot_cli.reasoning.vlm.chat import Picture
from etot_cli.reasoning.vlm.frames import Eye, FrameSource
from etot_cli.reasoning.vlm.settings import VlmSettings
from etot_cli.skills.action import Action, Verb
from etot_cli.skills.deadline import NEVER
from etot_cli.specs.scene import Scene
from etot_cli.world.state import RolloutRecord, SceneState

FRAMES_KEPT = 8
"""Of a video: more than a question has room for."""
SENTENCES = {
    Verb.PICK_UP: "The robot arm picks up the {}",
    Verb.PUT_ON: "The robot arm puts what it holds on the {}",
    Verb.PUT_INTO: "The robot arm puts what it holds into the {}",
    Verb.OPEN: "The robot arm opens the {}",
    Verb.CLOSE: "The robot arm closes the {}",
}


class VideoFrames:
    """Implements :class:`etot_cli.reasoning.vlm.frames.FrameSource` with generated videos.

    Args:
        rendered: shows the scene before an action.
    """

    def __init__(self, rendered: FrameSource) -> None:
        self._rendered = rendered
        self._videos: dict[int, tuple[RolloutRecord, Sequence[Frame]]] = {}

    def keep(self, record: RolloutRecord, frames: Sequence[Frame]) -> None:
        """The video of an action; the record is kept too, so that its identity stays its own."""
        self._videos[id(record)] = record, frames

    def view(self, scene: SceneState, *, marks: bool = False) -> Sequence[Picture]:
        """The rendered scene."""
        return self._rendered.view(scene, marks=marks)

    def rollout(
        self, record: RolloutRecord, count: int, *, marks: bool = False, hints: bool = True
    ) -> Sequence[Picture]:
        """Frames of the action's video, evenly spread; nothing is known to hint at."""
        _, frames = self._videos.get(id(record), (record, ()))
        if not frames or count <= 0:
            return []
        chosen = [frames[row * (len(frames) - 1) // max(count - 1, 1)] for row in range(count)]
        names = ["Before the action", *["During the action"] * (count - 2), "After the action"]
        return [
            Picture.of_pixels(f"{name}:", frame)
            for name, frame in zip(names[-count:], chosen, strict=True)
        ]

    def marks(self, scene: SceneState) -> Mapping[int, str]:
        """As in the rendered scene."""
        return self._rendered.marks(scene)

    def eye(self, scene: SceneState) -> Eye | None:
        """As of the rendered scene."""
        return self._rendered.eye(scene)


class VideoWorldModel(KinematicSimulator):
    """Implements :class:`etot_cli.control.simulated.Simulator` by asking for videos.

    Args:
        endpoint: generates them.
        frames: keeps them for the judge.
        seed: handed on to the server.
    """

    def __init__(self, endpoint: VideoEndpoint, frames: VideoFrames, seed: int) -> None:
        super().__init__()
        self._endpoint, self._frames, self._seed = endpoint, frames, seed

    def submit(
        self, state: StateToken, action: Action, until_s: float = NEVER
    ) -> Future[Simulated]:
        """Has a video made of the action; the record says where things are meant to go."""
        future = super().submit(state, action, until_s)
        record = future.result().outcomes[0].record
        view = self._frames.view(record.before)
        try:
            video = self._endpoint.generate(view[0].pixels, sentence(action, record), self._seed)
            try:
                self._frames.keep(record, frames_of(video, FRAMES_KEPT))
            except ValueError as error:
                raise self._endpoint.error(f"its video is of no use: {error}") from None
        except ServiceError as error:
            failed: Future[Simulated] = Future()
            failed.set_exception(ReasonerStopped(StopReason.SERVICE, str(error)))
            return failed
        return future


class VideoThinking(ModelThinking):
    """The model that looks at videos; the simulator is not watched, its videos are."""

    def watch(self, simulator: Simulator) -> Simulator:
        """The same."""
        return simulator


def sentence(action: Action, record: RolloutRecord) -> str:
    """An action as a video model is told of it."""
    owner, _, part = action.target.partition(".")
    info = record.before.infos.get(owner)
    thing = " ".join(filter(None, [owner if info is None else info.label, part]))
    is_pick = action.verb is Verb.PICK_UP
    notes = [action.pose.value] if is_pick and action.pose else [str(one) for one in action.where]
    return SENTENCES[action.verb].format(thing) + "".join(f", {note}" for note in notes) + "."


def open_video(
    url: str, flags: Mapping[str, Any], scene: Scene, *, seed: int
) -> tuple[VideoThinking, VideoWorldModel]:
    """A model that plans by videos, and the world model that has them made.

    Raises:
        EtotError: a setting cannot be used.
        ServiceError: there is no OpenGL for the first pictures.
    """
    endpoint = VideoEndpoint(url)
    settings = VlmSettings.load(**{**flags, "judge": "vlm"})
    if not settings.images:
        raise ServiceError("--video-url needs pictures; ETOT_VLM_IMAGES is 0")
    kept: list[VideoFrames] = []

    def through(rendered: FrameSource) -> FrameSource:
        kept.append(VideoFrames(rendered))
        return kept[0]

    thinking = VideoThinking(settings, scene, seed=seed, state=None, through=through)
    return thinking, VideoWorldModel(endpoint, kept[0], seed)

"""What a model gets to see in one question, and the words that go with the pictures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from etot_cli.reasoning.vlm import describe
from etot_cli.reasoning.vlm.chat import Picture
from etot_cli.reasoning.vlm.frames import FrameSource
from etot_cli.world.state import RolloutRecord, SceneState


@dataclass(frozen=True, slots=True)
class Seen:
    """Pictures, the marks on them, and the fields of a prompt that describe scene and pictures."""

    pictures: Sequence[Picture]
    marks: Mapping[int, str]
    words: Mapping[str, str]


class Sight:
    """Takes the pictures of a run.

    Args:
        frames: where they come from; None for words alone.
        count: pictures in one question at most.
        marks: number the objects; None numbers them where names do not tell them apart.
        hints: the choice of moments and their captions may tell what the record knows.
    """

    def __init__(
        self, frames: FrameSource | None, *, count: int, marks: bool | None, hints: bool
    ) -> None:
        self._frames = frames if count else None
        self._count = count
        self._marks = marks
        self._hints = hints

    @property
    def blind(self) -> bool:
        """Whether there are no pictures at all."""
        return self._frames is None

    def desk(self, scene: SceneState) -> Seen:
        """The desk as it is."""
        marks = self._marks_of(scene)
        pictures = [] if self._frames is None else self._frames.view(scene, marks=bool(marks))
        return self._seen(pictures, marks, scene)

    def action(self, record: RolloutRecord, count: int | None = None) -> Seen:
        """An action, before and after it, in ``count`` pictures or as many as are allowed."""
        if self._frames is None:
            return self._seen((), {}, record.before)
        marks = self._marks_of(record.before)
        pictures = self._frames.rollout(
            record, min(count or self._count, self._count), marks=bool(marks), hints=self._hints
        )
        return self._seen(pictures, marks if pictures else {}, record.before)

    def _marks_of(self, scene: SceneState) -> Mapping[int, str]:
        wanted = describe.alike(scene) if self._marks is None else self._marks
        return self._frames.marks(scene) if wanted and self._frames is not None else {}

    def _seen(
        self, pictures: Sequence[Picture], marks: Mapping[int, str], scene: SceneState
    ) -> Seen:
        eye = self._frames.eye(scene) if self._frames is not None and pictures else None
        words = {
            "objects": describe.object_list(scene),
            "catalogue": describe.catalogue(scene),
            "marks": describe.marks_line(marks),
            "viewpoint": describe.viewpoint(scene, eye),
        }
        return Seen(pictures, marks, words)

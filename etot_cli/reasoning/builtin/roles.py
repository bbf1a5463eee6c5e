"""What a thing can be used for, and what is said where a phrase or a name does not fit that."""

from __future__ import annotations

from enum import StrEnum

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.relations import container_parts
from etot_cli.world.state import DESK, SceneState


class ReferenceProblem(Exception):
    """A phrase that cannot be resolved.

    Args:
        phrase: the phrase as written.
        why: what is wrong with it.
        weight: how much of the phrase was understood; of several readings' problems the one with
            the largest weight is shown.
        word: the words to blame, where they are fewer than the phrase.
        candidates: names of things that may have been meant.
    """

    def __init__(
        self,
        phrase: str,
        why: str,
        weight: int = 0,
        *,
        word: str = "",
        candidates: tuple[str, ...] = (),
    ) -> None:
        self.phrase = phrase
        self.why = why
        self.weight = weight
        self.word = word
        self.candidates = candidates
        super().__init__(f"{phrase!r}: {why}")


class Role(StrEnum):
    """What a phrase is used for, which says what may be meant by it."""

    THEME = "picked up"
    SURFACE = "used as a surface"
    CONTAINER = "used as a container"
    PLACE = "used as a place"
    PART = "opened or closed"
    ANY = "mentioned"


def can_be(thing: Thing, role: Role, scene: SceneState) -> bool:
    """Whether a thing can be used so at all."""
    if thing.name == DESK:
        return role in (Role.SURFACE, Role.PLACE, Role.ANY)
    if thing.name not in scene.infos:
        return False  # the robot
    info = scene.infos[thing.name]
    match role:
        case Role.THEME:
            return info.movable and thing.part is None and thing.board is None
        case Role.SURFACE:
            return (info.bears and thing.part is None) or thing.board is not None
        case Role.CONTAINER:
            if thing.part is not None:
                return any(part.name == thing.part for part in container_parts(info))
            return info.container or bool(container_parts(info))
        case Role.PLACE:
            return can_be(thing, Role.SURFACE, scene) or can_be(thing, Role.CONTAINER, scene)
        case Role.PART:
            return bool(info.parts)
        case Role.ANY:
            return True

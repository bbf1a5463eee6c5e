"""The report of ``etot reconstruct``: schema ``etot.reconstruct/1``."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from etot_cli.reporting.models import Metres, Model, Seconds, Share, TimingModel, VersionsModel


class FitModel(Model):
    """How well an object explains what is seen of it."""

    residual_m: float = Field(ge=0)
    """Root mean square distance of depth readings from its surface [m]."""
    silhouette_px: float = Field(ge=0)
    """Root mean square distance of its mask's edge from its outline [px]."""
    explained: Share
    """Share of edge and surface points within tolerance."""


Pose = tuple[
    tuple[float, float, float, float], tuple[float, float, float, float],
    tuple[float, float, float, float], tuple[float, float, float, float],
]  # fmt: skip
"""A rigid pose (4, 4), its position in metres."""


class CameraModel(Model):
    """The camera as it was used."""

    source: Literal["file", "standpoint", "board"]
    """Where its pose comes from: ``camera.json``, ``--camera-at`` or ``--calibrate``."""
    camera_to_base: Pose
    """Levelled to the desk: p_base = T · p_camera, OpenCV's optical frame."""


class KnownModelModel(Model):
    """A known mesh that an object was registered with."""

    source: str
    """Its file, its entry in the library, or the server."""
    metres_per_unit: float = Field(gt=0)
    """Unit of the mesh's file [m]; found from the picture where it was not known."""
    pose: Pose
    """The frame of the mesh's file, scaled to metres, in the base frame."""
    mismatch: float = Field(ge=0)
    """Share of its part of the picture that disagrees with the mesh; 0 is perfect."""


class ReconstructedObjectModel(Model):
    """One object of the twin; base frame."""

    name: str
    kind: str
    position: tuple[Metres, Metres, Metres]
    """Centre."""
    quaternion: tuple[float, float, float, float]
    """w x y z."""
    size: tuple[Metres, Metres, Metres]
    """Extents along its own axes."""
    support: str
    """What it rests on: the desk or an object."""
    fit: FitModel
    settle_m: float | None
    """How far it moved until it lay still; null when the twin could not be built."""
    settle_deg: float | None
    model: KnownModelModel | None
    """The known mesh that gave its shape; null where its shape was fitted."""
    warnings: list[str]
    """What is doubtful about it."""


class JointModel(Model):
    """A joint that two frames, or a server, have shown; base frame."""

    object: str
    type: Literal["slide", "hinge"]
    axis: tuple[float, float, float]
    anchor: tuple[Metres, Metres, Metres]
    values: tuple[float, float]
    """Joint values in the first and the second frame [m or rad]."""


class PiecesModel(Model):
    """Collision pieces of a free-form object."""

    object: str
    count: int
    volume_error: float
    """Volume of the pieces over that of the mesh, less one."""


class ReconstructReport(Model):
    """What was reconstructed from a capture."""

    schema_: Literal["etot.reconstruct/1"] = Field(default="etot.reconstruct/1", alias="schema")
    status: Literal["success", "partial", "interrupted"]
    """Partial: usable, but something is missing or does not lie still; see warnings."""
    seed: int = Field(ge=0)
    interrupted: bool
    versions: VersionsModel
    timing: TimingModel
    capture: str
    """The capture folder as named on the command line."""
    instruction: str | None
    desk_top: Metres | None
    """Null where the work was interrupted before the desk was found."""
    tilt_deg: float = Field(ge=0)
    """By how much the camera's pose was levelled."""
    depth_shift_px: tuple[int, int]
    """By how much depth was moved back onto colour (right, down)."""
    camera: CameraModel | None
    """Null where the work was interrupted before the desk was found."""
    ignored: list[str]
    """Names of what was left out because ``--ignore`` says so."""
    outside_workspace: int = Field(ge=0)
    """How many things were left out because they stand outside ``--workspace``."""
    objects: list[ReconstructedObjectModel]
    joints: list[JointModel]
    pieces: list[PiecesModel]
    scene: str | None
    """The scene file, relative to the report's folder."""
    task: str | None
    """The task file that ``etot plan`` takes; null without an instruction."""
    warnings: list[str]
    files: dict[str, str]
    stages: dict[str, Seconds]
    """Wall time of each stage."""

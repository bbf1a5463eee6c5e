"""What is asked of a reconstruction."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from etot_cli.reconstruction.capture.board import FoundCamera
from etot_cli.reconstruction.capture.standpoint import CameraAt
from etot_cli.reconstruction.capture.workspace import Workspace
from etot_cli.reconstruction.services import DEADLINE


@dataclass(frozen=True, kw_only=True)
class Options:
    """A capture, and how it is to be taken.

    ``auto``: find masks even where the capture has some. ``second``: a capture of the same scene
    with another joint state; by default the folder ``second`` in the capture, where there is one.
    ``meshes``: mesh files by object name. ``library``: a file of known things. The URLs let servers
    take stages over. ``workspace``: what stands elsewhere is left out; ``ignore``: so is what has
    one of these names. ``camera_at``: the camera's pose comes from there and the desk;
    ``camera``: one that counts instead of ``camera.json``.
    """

    capture: Path
    instruction: str | None = None
    auto: bool = False
    second: Path | None = None
    materials: dict[str, str] = field(default_factory=dict)
    meshes: dict[str, Path] = field(default_factory=dict)
    library: Path | None = None
    masks_url: str | None = None
    mesh_url: str | None = None
    pose_url: str | None = None
    articulation_url: str | None = None
    deadline: float = DEADLINE
    workspace: Workspace | None = None
    ignore: tuple[str, ...] = ()
    camera_at: CameraAt | None = None
    camera: FoundCamera | None = None
    seed: int = 0
    settle: bool = True

"""Objects given as MJCF files: checked, then attached to the scene's model."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import mujoco

from etot_cli.errors import WorldError
from etot_cli.specs import scene as specs

MAX_INCLUDES = 32
"""Files that an MJCF object may consist of."""


def attach_mjcf(
    mj: mujoco.MjSpec, body: Any, spec: specs.Mjcf, name: str, directory: str
) -> mujoco.MjSpec:
    """Attaches the file's bodies under ``body``, all names prefixed ``name/``; returns the child.

    Raises:
        WorldError: the file is no valid MJCF, or names a joint or site that it lacks.
    """
    path = Path(directory) / spec.file
    _refuse_outside_files(path)
    try:
        child = mujoco.MjSpec.from_file(str(path))
    except ValueError as error:
        raise WorldError(f"{path.name}: not a valid MJCF model ({error})") from error
    free = [joint for joint in child.joints if joint.type == mujoco.mjtJoint.mjJNT_FREE]
    for joint in free:
        child.delete(joint)
    joints = {joint.name for joint in child.joints}
    sites = {site.name for site in child.sites}
    for part_name, part in spec.parts.items():
        if part.joint not in joints:
            raise WorldError(
                f"{name}.parts.{part_name}: {path.name} has no joint {part.joint!r}; "
                f"it has {', '.join(sorted(joints)) or 'none'}"
            )
    wanted = [spec.container_site, spec.surface_site]
    for part in spec.parts.values():
        wanted += [part.container_site, part.front_site]
    for site in wanted:
        if site is not None and site not in sites:
            raise WorldError(
                f"{name}: {path.name} has no site {site!r}; it has "
                f"{', '.join(sorted(sites)) or 'none'}"
            )
    mj.attach(child, prefix=f"{name}/", frame=body.add_frame())
    return child


def _refuse_outside_files(path: Path) -> None:
    """Files that an MJCF file names, also through includes, must lie below its own folder.

    Raises:
        WorldError: naming the file that does not, or XML that cannot be read.
    """
    base = path.parent.resolve()
    waiting, seen = [path], set[Path]()
    while waiting:
        current = waiting.pop()
        if current.resolve() in seen:
            continue
        seen.add(current.resolve())
        if len(seen) > MAX_INCLUDES:
            raise WorldError(f"{path.name}: includes more than {MAX_INCLUDES} files")
        waiting += _named_files(current, base)


def _named_files(path: Path, base: Path) -> list[Path]:
    """Checks what one file names; returns the files it includes."""
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, OSError) as error:
        raise WorldError(f"{path.name}: not readable as XML ({error})") from error
    folders = {""}
    for element in root.iter():
        for key in ("meshdir", "texturedir", "assetdir"):
            folders.add(element.get(key, ""))
    included = []
    for element in root.iter():
        if element.tag in ("plugin", "extension"):
            raise WorldError(f"{path.name}: plugins are not accepted in object files")
        for key, value in element.attrib.items():
            if not key.startswith("file"):
                continue
            for folder in folders:
                if not (base / folder / value).resolve().is_relative_to(base):
                    raise WorldError(
                        f"{path.name}: <{element.tag}> names {value!r}, which lies outside "
                        "the file's own folder"
                    )
            if element.tag == "include":
                included.append(base / value)
    return included

"""Objects given as MJCF files: checked, then attached to the scene's model."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco

from etot_cli.errors import WorldError
from etot_cli.specs import objects as specs
from etot_cli.world.build.mjcf_check import check_mjcf


def attach_mjcf(
    mj: mujoco.MjSpec, body: Any, spec: specs.Mjcf, name: str, directory: str
) -> mujoco.MjSpec:
    """Attaches the file's bodies under ``body``, all names prefixed ``name/``; returns the child.

    Raises:
        WorldError: the file is no valid MJCF, or names a joint or site that it lacks.
    """
    path = Path(directory) / spec.file
    check_mjcf(path)
    try:
        child = mujoco.MjSpec.from_file(str(path))
    except ValueError as error:
        raise WorldError(f"{path.name}: not a valid MJCF model ({error})") from error
    free = [joint for joint in child.joints if joint.type == mujoco.mjtJoint.mjJNT_FREE]
    for joint in free:
        child.delete(joint)
    # Stored poses have the length of all joints, and nobody asks for them here.
    for key in child.keys:
        child.delete(key)
    # What is known of a body goes by its name.
    for index, part_body in enumerate(child.bodies):
        part_body.name = part_body.name or f"body {index}"
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

"""Shapes, poses and joints that come from outside: mesh files, mesh, pose and joint servers.

Also the completed free-form shape for things that none of the simple kinds explains.
"""

from __future__ import annotations

import base64
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from etot_cli.errors import SpecError
from etot_cli.reconstruction import services
from etot_cli.reconstruction.articulation import Joint
from etot_cli.reconstruction.calibration import Calibrated
from etot_cli.reconstruction.fit.pose import COARSE, FINE, fit_shape, judge
from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.shapes.base import Evidence
from etot_cli.reconstruction.shapes.block import Block
from etot_cli.reconstruction.shapes.free import FreeForm, completed, load_mesh
from etot_cli.reconstruction.shapes.furniture import cabinet_spec, unit_spec

if TYPE_CHECKING:
    from etot_cli.reconstruction.pipeline import Options

POOR = 0.6
"""A simple shape that explains less than this share of what is seen gives way to a free one."""
POOR_EDGE = 5.0
"""… or whose outline is off by more than this [px]."""
MESH_SUFFIXES = {".glb": "glb", ".obj": "obj", ".stl": "stl"}
MAX_MESH_BYTES = 50 * 1024 * 1024


def complete(seen: Calibrated, solid: Solid) -> Solid:
    """The solid as a completed free form, where no simple kind explains it."""
    fit = solid.fit
    if (fit.explained > POOR and fit.edge_rms < POOR_EDGE) or len(solid.observation.points) < 100:
        return solid
    shape = completed(_evidence(seen, solid))
    if shape is None:
        return solid.warned("its shape is poorly explained: treat size and pose with care")
    params = np.array([*_centre_of(shape, solid), solid.observation.base, 0.0, shape.unit])
    free = judge(shape, solid.observation, params)
    return replace(solid, fit=free).warned(
        "free form: its far side is mirrored and its lower part extruded, not seen"
    )


def _centre_of(shape: FreeForm, solid: Solid) -> tuple[float, float]:
    points = solid.observation.points
    low, high = np.percentile(points[:, :2], [1, 99], axis=0)
    middle = (low + high) / 2
    return float(middle[0]), float(middle[1])


def _evidence(seen: Calibrated, solid: Solid) -> Evidence:
    observation = solid.observation
    outline = seen.view.on_plane(observation.edges, observation.base)
    return Evidence(observation.points, observation.base, outline, seen.view)


def given_shapes(seen: Calibrated, solids: list[Solid], options: Options) -> list[Solid]:
    """Solids with meshes that the user or a server gives, and poses that a server gives.

    Raises:
        SpecError: a mesh file is unusable, or is for an object that is not there.
        ServiceError: a server gives no usable answer.
    """
    unknown = set(options.meshes) - {solid.name for solid in solids}
    if unknown:
        raise SpecError(
            f"a mesh is given for {sorted(unknown)[0]!r}, which is not found; objects are "
            f"{', '.join(solid.name for solid in solids)}"
        )
    found = []
    for solid in solids:
        shape = None
        data, kind = b"", "glb"
        if solid.name in options.meshes:
            data, kind = _read(options.meshes[solid.name])
            shape = load_mesh(data, kind, str(options.meshes[solid.name]))
        elif options.mesh_url is not None:
            data, kind = services.ask_mesh(
                options.mesh_url, solid.name, seen.capture.color, solid.segment.mask,
                options.deadline,
            )  # fmt: skip
            try:
                shape = load_mesh(data, kind, "mesh")
            except SpecError as error:
                raise services.Server(options.mesh_url, "mesh").error(str(error)) from None
        if shape is not None:
            solid = _registered(seen, solid, shape, options, data, kind)
        found.append(solid)
    return found


def _read(path: Path) -> tuple[bytes, str]:
    kind = MESH_SUFFIXES.get(path.suffix.lower())
    if kind is None or not path.is_file():
        raise SpecError("expected an existing .glb, .obj or .stl file", file=str(path))
    if path.stat().st_size > MAX_MESH_BYTES:
        raise SpecError(f"larger than {MAX_MESH_BYTES // 2**20} MiB", file=str(path))
    return path.read_bytes(), kind


def _registered(
    seen: Calibrated, solid: Solid, shape: FreeForm, options: Options, data: bytes, kind: str
) -> Solid:
    """The mesh at the scale and pose that depth and silhouette ask for."""
    rng = np.random.default_rng(options.seed)
    observation = solid.observation
    starts = shape.guesses(_evidence(seen, solid))
    if options.pose_url is not None:
        asked = _asked_pose(seen, solid, options, data, kind)
        for start in starts:
            start[:2], start[3] = asked[0], asked[1]
        starts = starts[:1]
    coarse = observation.thinned(*COARSE, rng)
    fits = [judge(shape, coarse, fit_shape(shape, coarse, start, steps=20)) for start in starts]
    best = min(fits, key=lambda fit: fit.score)
    fine = observation.thinned(*FINE, rng)
    params = fit_shape(shape, fine, best.params)
    return replace(solid, fit=judge(shape, fine, params), extra={}).warned(
        "the mesh is given; its scale is from depth and silhouette"
    )


def _asked_pose(
    seen: Calibrated, solid: Solid, options: Options, data: bytes, kind: str
) -> tuple[np.ndarray, float]:
    """Place x y (2,) and yaw that a pose server says, base frame."""
    assert options.pose_url is not None  # asked by the caller
    pose = services.ask_pose(
        options.pose_url,
        {
            "name": solid.name, "mesh": base64.b64encode(data).decode(), "format": kind,
            "color": services.picture(seen.capture.color),
            "depth": services.depth_picture(seen.depth),
            "mask": services.mask_picture(solid.segment.mask),
            "intrinsics": services.intrinsics(seen.view),
        },
        options.deadline,
    )  # fmt: skip
    base = seen.view.camera_to_base @ pose
    return base[:2, 3], float(np.arctan2(base[1, 0], base[0, 0]))


def asked_joints(
    seen: Calibrated, solids: list[Solid], options: Options
) -> tuple[list[Solid], list[Joint]]:
    """Joints of furniture-sized blocks as an articulation server says them.

    Raises:
        ServiceError: it gives no usable answer.
    """
    assert options.articulation_url is not None  # asked by the caller
    found, joints = [], []
    for solid in solids:
        if solid.kind not in ("drawer_unit", "cabinet", "box") or not isinstance(
            solid.fit.family, Block
        ):
            found.append(solid)
            continue
        asked = services.ask_articulation(
            options.articulation_url,
            {
                "name": solid.name,
                "color": services.picture(seen.capture.color),
                "depth": services.depth_picture(seen.depth),
                "mask": services.mask_picture(solid.segment.mask),
                "intrinsics": services.intrinsics(seen.view),
            },
            options.deadline,
        )
        if asked is None:
            found.append(solid)
            continue
        axis = seen.view.rotation @ asked.axis
        anchor = (seen.view.camera_to_base @ np.array([*asked.origin, 1.0]))[:3]
        joint = Joint(
            solid.name, "slide" if asked.type == "prismatic" else "hinge", axis, anchor,
            (asked.value, asked.limits[1]),
        )  # fmt: skip
        joints.append(joint)
        found.append(_with_joint(solid, joint, asked))
    return found, joints


def _with_joint(solid: Solid, joint: Joint, asked: services.AskedJoint) -> Solid:
    """The block as furniture whose front is where the joint says."""
    params = solid.fit.params.copy()
    toward = joint.axis[:2] if joint.type == "slide" else None
    if toward is None or np.linalg.norm(toward) < 1e-6:
        toward = joint.anchor[:2] - params[:2]
    heading = float(np.arctan2(toward[1], toward[0])) - params[3]
    quarter = round(heading / (np.pi / 2)) % 4
    if quarter % 2:
        params[4], params[5] = params[5], params[4]
    params[3] += quarter * np.pi / 2
    turned = replace(solid, fit=replace(solid.fit, params=params))
    if joint.type == "slide":
        extra = unit_spec(turned.size, 2, min(max(asked.value, 0.0), asked.limits[1]))
        extra["drawers"][0]["travel"] = min(asked.limits[1], 0.9 * turned.size[0])
    else:
        extra = cabinet_spec(turned.size, "left", float(np.degrees(max(asked.value, 0.0))))
        extra["door"]["range_deg"] = float(np.degrees(asked.limits[1]))
    return replace(turned, extra=extra).warned("its joint is from the articulation server")

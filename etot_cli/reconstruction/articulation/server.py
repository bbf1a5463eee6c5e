"""Joints of furniture as an articulation server says them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from etot_cli.reconstruction import services
from etot_cli.reconstruction.articulation.furnish import with_front
from etot_cli.reconstruction.articulation.two_frames import Joint
from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.options import Options
from etot_cli.reconstruction.shapes.block import Block
from etot_cli.reconstruction.shapes.furniture import cabinet_spec, unit_spec


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
                **services.what_is_seen(
                    seen.capture.color, seen.depth, solid.segment.mask, seen.view
                ),
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
    params = solid.fit.params
    toward = joint.axis[:2] if joint.type == "slide" else None
    if toward is None or np.linalg.norm(toward) < 1e-6:
        toward = joint.anchor[:2] - params[:2]
    heading = float(np.arctan2(toward[1], toward[0])) - params[3]
    quarter = round(heading / (np.pi / 2)) % 4
    turned = with_front(solid, quarter)
    if joint.type == "slide":
        extra = unit_spec(turned.size, 2, min(max(asked.value, 0.0), asked.limits[1]))
        extra["drawers"][0]["travel"] = min(asked.limits[1], 0.9 * turned.size[0])
    else:
        extra = cabinet_spec(turned.size, "left", float(np.degrees(max(asked.value, 0.0))))
        extra["door"]["range_deg"] = float(np.degrees(asked.limits[1]))
    return replace(turned, extra=extra).warned("its joint is from the articulation server")

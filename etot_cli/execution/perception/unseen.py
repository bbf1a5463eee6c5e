"""Where a thing may be of which nothing is read: in the fingers, below them, or in a container."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from etot_cli.execution.perception.fitting import outlined
from etot_cli.execution.perception.scan import Scan
from etot_cli.execution.perception.search import start
from etot_cli.execution.perception.support import support
from etot_cli.execution.perception.surfaces import Surface
from etot_cli.execution.perception.twin import KnownScene
from etot_cli.reconstruction.capture.view import Array
from etot_cli.world.index import Region
from etot_cli.world.pose import UP, Pose, rotation_between

STILL_THERE = 0.7
"""An object that agrees with so much of what is visible of its last place is still there."""
LEAST_AGREE = 20
"""... in so many points, at least."""
GONE = 0.5
"""With less of it, something else is to be seen where it was."""
HIDDEN = 0.6
"""Share of an object behind nearer things from which it may be there unseen."""
BELOW = 0.02
"""What was let go is in a container rather than on what is below the hand when that container is
this near to the hand [m], seen from above."""
AT_HAND = 0.15
"""The hand that let something go into a container is this near to it [m], seen from above."""
ROOM, LIFTED = 0.003, 0.008
"""A rod in a container may be seen this far inside its walls, and this far above its floor [m]."""
SOMETHING = 60
"""Readings that hang together, belong to nothing, and are no farther than ``AT_HAND`` from where a
missing object was or was let go, may be that object."""
SEEN_INSIDE = 0.01
"""What is in a container may be seen this far in its walls or floor [m]: two looks err by that."""
SLIDE, TURN = 0.012, 0.15
"""First steps in which a rod is moved and turned to fit its outline [m, rad]."""
LEANS = tuple(
    (lean, heading)
    for lean in (0.0, 0.15, 0.35, 0.55, 0.75)
    for heading in np.arange(8) * np.pi / 4
    if lean > 0.0 or heading == 0.0
)
"""How a rod may lean in a container: angles from upright and their directions [rad]."""


def contradicted(surface: Surface, pose: Pose, scan: Scan) -> bool:
    """Whether other things are seen where an object would have to be seen."""
    borne = support(surface, pose, scan.view, scan.depth)
    return borne.covered < HIDDEN and borne.share < GONE and borne.visible > 0


def slid(known: KnownScene, surface: Surface, pose: Pose, scan: Scan) -> Pose:
    """A rod that is held, moved along itself and turned between the pads to fit its outline."""
    assert surface.long_axis is not None
    along = np.concatenate([pose.rotation @ surface.long_axis * SLIDE, np.zeros(3)])
    turn = np.concatenate([np.zeros(3), known.tool().rotation[:, 1] * TURN])
    return outlined(surface, pose, scan.view, scan.depth, [along, turn])[0]


def with_its_container(known: KnownScene, name: str, pose: Pose, moved: Mapping[str, Pose]) -> Pose:
    """Where an object is when the drawer or the vessel that it was in has moved, the smallest of
    those that it was in.

    Args:
        known: the scene, with the containers where they are now.
        name: of the object.
        pose: before they moved.
        moved: how, by body.
    """
    surface = known.surfaces.get(name)
    if surface is None:
        return pose
    placed = pose.place(surface.points)
    # What sticks out of a vessel is in it all the same, with its foot.
    foot = placed[int(placed[:, 2].argmin())]
    around: list[tuple[float, str]] = []
    for region in known.regions:
        if region.body in moved and region.body != known.world.entries[name].body:
            then = moved[region.body].inverse() @ known.body(region.body)
            local = then.local(foot[None])[0] - region.center
            if (np.abs(local) <= np.array(region.half) + SEEN_INSIDE).all():
                around.append((float(np.prod(region.half)), region.body))
    return moved[min(around)[1]] @ pose if around else pose


def out_of_sight(
    known: KnownScene, name: str, before: Pose, held: Pose | None, tool: Pose, scan: Scan
) -> Pose | None:
    """Where an object may be that is nowhere seen; None where it is lost.

    Args:
        known: the scene.
        name: of the object.
        before: its pose at the last look.
        held: how it lay in the hand then, if it did: it was let go in a container that is open, or
            on what is below the hand; what is nearest to the hand comes first.
        tool: where the hand was when it let go.
        scan: what is seen.
    """
    surface = known.surfaces[name]
    options: list[tuple[float, Pose]] = []
    leaning: list[tuple[float, Pose]] = []
    body = known.world.entries[name].body
    narrow = float(np.ptp(surface.points, axis=0).min())
    for region in known.regions if held is not None else ():
        if region.body == body or _covered(known, region, body, narrow):
            continue
        pose = _in_region(known, region, surface, before)
        aside = float(np.linalg.norm((pose.position - tool.position)[:2]))
        if surface.long_axis is not None and region.opening[2] > 0.5 and aside < AT_HAND:
            standing = _standing_in(known, region, surface, before, scan)
            if standing is not None:
                leaning.append(standing)
        options.append((max(0.0, aside - float(max(region.half[:2]))), pose))
    if leaning:
        return max(leaning, key=lambda item: item[0])[1]
    if held is not None:
        let_go = tool @ held
        placed = let_go.place(surface.points)
        lowest = float(placed[:, 2].min())
        _, free = known.ahead(let_go.place(surface.middle[None])[0], -UP, body)
        level = max(float(placed[:, 2].mean()) - free, known.scene.desk.top)
        drop = np.array([0.0, 0.0, lowest - level])
        options.append((BELOW, Pose(let_go.position - drop, let_go.rotation)))
    for _, pose in sorted(options, key=lambda item: item[0]):
        if not contradicted(surface, pose, scan):
            return pose
    places = [before.place(surface.middle[None])[0], *([] if held is None else [tool.position])]
    for cluster in scan.clusters():
        middle = scan.points[cluster].mean(axis=0)
        aside = min(float(np.linalg.norm(middle - place)) for place in places)
        if len(cluster) >= SOMETHING and aside < AT_HAND:
            # Something lies there that nothing else explains, if in no way that was recognized.
            return start(surface, before.rotation, scan.points[cluster], scan.view)
    return None


def _standing_in(
    known: KnownScene, region: Region, surface: Surface, before: Pose, scan: Scan
) -> tuple[float, Pose] | None:
    """A rod that leans in an open container, by its outline, and what that is worth; None where
    there is none.
    """
    assert surface.long_axis is not None
    axis = surface.middle + np.outer((-1.0, 1.0), surface.long_axis * surface.length / 2)
    body = known.body(region.body)
    room = np.array(region.center) - np.array([0.0, 0.0, region.half[2]])
    floor = body.place(room[None])[0]
    best: tuple[float, Pose] | None = None
    few = surface.thinned(400)
    for up in (1.0, -1.0):
        for lean, heading in LEANS:
            flat = np.array([np.cos(heading), np.sin(heading), 0.0])
            wanted = flat * np.sin(lean) + np.array([0.0, 0.0, np.cos(lean)])
            turn = rotation_between(before.rotation @ surface.long_axis * up, wanted)
            rotation = turn @ before.rotation
            placed = few.points @ rotation.T
            foot = placed[int(np.argmin(placed @ wanted))]
            aside = -flat * (np.sin(lean) > 0) * 0.6 * min(region.half[:2])
            pose = Pose(floor + aside - foot, rotation)
            worth = support(few, pose, scan.view, scan.depth).worth
            if best is None or worth > best[0]:
                best = (worth, pose)
    assert best is not None
    moves = [np.eye(6)[axis] * (0.008 if axis < 3 else TURN) for axis in (0, 1, 2, 3, 4)]
    pose, borne = outlined(
        surface,
        best[1],
        scan.view,
        scan.depth,
        moves,
        lambda tried: _stands(tried, axis, body, region),
    )
    shown = borne.agree + borne.unread
    if borne.outlined < GONE or shown < LEAST_AGREE:
        return None
    return borne.worth, pose


def _stands(pose: Pose, axis: Array, body: Pose, region: Region) -> bool:
    """Whether a rod stands on a container's floor and leaves it through its mouth.

    Args:
        pose: of the rod.
        axis: its ends (2, 3), in its own frame.
        body: where the container is.
        region: its inside.
    """
    ends = body.local(pose.place(axis)) - region.center
    foot, head = ends[np.argsort(ends[:, 2])]
    half = np.array(region.half)
    if not -half[2] - ROOM < foot[2] < -half[2] + LIFTED:
        return False
    mouth = foot + (head - foot) * min((half[2] - foot[2]) / max(head[2] - foot[2], 1e-6), 1.0)
    for point in (foot, mouth):
        inside = (
            np.hypot(*point[:2]) < half[0] + ROOM
            if region.round
            else (np.abs(point[:2]) < half[:2] + ROOM).all()
        )
        if not inside:
            return False
    return True


def _covered(known: KnownScene, region: Region, body: str, narrow: float) -> bool:
    """Whether a container is closed to a thing: a drawer in its chest, a vessel with a lid on.

    Args:
        known: the scene.
        region: its inside.
        body: of the thing.
        narrow: its smallest extent [m].
    """
    stands, out = known.body(region.body), np.array(region.opening)
    mouth = stands.place((np.array(region.center) + out * np.array(region.half))[None])[0]
    owner, free = known.ahead(mouth, stands.rotation @ out, body)
    return owner is not None and free < narrow


def _in_region(known: KnownScene, region: Region, surface: Surface, before: Pose) -> Pose:
    """The object on the floor of a container, in the middle."""
    body = known.body(region.body)
    floor = body.place(
        (np.array(region.center) - np.array(region.opening) * np.array(region.half))[None]
    )[0]
    turned = surface.points @ before.rotation.T
    low, high = turned.min(axis=0), turned.max(axis=0)
    middle = np.array([*((low + high) / 2)[:2], low[2]])
    return Pose(floor - middle, before.rotation)


def level_moves(surface: Surface, pose: Pose) -> list[Array]:
    """Ways in which a thing may be elsewhere on its level: a lying rod along and across itself, and
    turned; others along x and y.
    """
    if surface.long_axis is None:
        return [SLIDE * axis for axis in np.eye(6)[:2]]
    along = pose.rotation @ surface.long_axis
    along[2] = 0.0
    along /= max(float(np.linalg.norm(along)), 1e-9)
    across = np.array([-along[1], along[0], 0.0])
    return [
        np.concatenate([along * SLIDE, np.zeros(3)]),
        np.concatenate([across * SLIDE, np.zeros(3)]),
        np.array([0.0, 0.0, 0.0, 0.0, 0.0, TURN]),
    ]

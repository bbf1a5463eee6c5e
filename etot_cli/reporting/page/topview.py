"""The desk from above, drawn as SVG: what a page shows where nothing can be rendered.

Needs no OpenGL and no model: object extents and poses are in the scene state.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from html import escape
from math import hypot

from etot_cli.specs.footprint import box_corners, hull, rotated
from etot_cli.world.state import ROUND_KINDS, ObjectInfo, ObjectState, SceneState

WIDTH_PX, HEIGHT_PX = 640, 400
"""In the proportions of a page's cards, which show the whole of it then."""
MARGIN_M = 0.06
"""Room around the desk, for what fell off it."""
AROUND_M = 0.12
"""Desk that is shown around what stands on it, with room for names."""
ARROW_FROM_M = 0.03
"""Shorter moves get no arrow; it would be longer than the way."""
NAME_PX, LETTER_PX = 22, 12
"""Height of names, to be read in a picture of half the size, and the width of a letter."""
BASE_RADIUS_M = 0.063
"""Half the width of a table-top arm's base, drawn at the frame's origin."""
Project = Callable[[float, float], tuple[float, float]]
"""From the desk plane [m] to the picture [px]."""
PAINT = {
    "white": "#ffffff", "black": "#34363b", "gray": "#9aa0a8", "red": "#d6453d",
    "orange": "#ef8b34", "yellow": "#f2cf45", "green": "#5da35b", "blue": "#4f7fd0",
    "purple": "#9167b7", "pink": "#e79ab5", "brown": "#a87c52",
}  # fmt: skip


def top_view(
    scene: SceneState,
    *,
    before: SceneState | None = None,
    culprits: Iterable[str] = (),
    framed: SceneState | None = None,
) -> bytes:
    """An SVG of the desk seen from above, the robot at the bottom.

    Args:
        scene: what is drawn.
        before: an earlier state; what has moved since is joined to its old place by an arrow.
        culprits: objects drawn in red, with a mark.
        framed: the state whose part of the desk is shown; that of the others where None.
    """
    x_min, x_max, y_min, y_max = scene.desk_bounds
    x_high, y_high, scale = _window([framed] if framed else [scene, *([before] if before else [])])

    # The robot looks up the picture: base x is up, base y is left.
    def at(x: float, y: float) -> tuple[float, float]:
        return (y_high - y) * scale, (x_high - x) * scale

    left, top = at(x_max, y_max)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH_PX} {HEIGHT_PX}" '
        f'width="{WIDTH_PX}" height="{HEIGHT_PX}" font-family="sans-serif">',
        '<defs><marker id="a" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" '
        'markerHeight="7" orient="auto"><path d="M0 0L8 4L0 8z" fill="#2457c5"/></marker></defs>',
        f'<rect width="{WIDTH_PX}" height="{HEIGHT_PX}" fill="#e9eaed"/>',
        f'<rect x="{left:.1f}" y="{top:.1f}" width="{(y_max - y_min) * scale:.1f}" '
        f'height="{(x_max - x_min) * scale:.1f}" fill="#ecd9b6" stroke="#b99a66" rx="4"/>',
        _robot(at(0.0, 0.0), BASE_RADIUS_M * scale),
    ]
    blamed = set(culprits)
    names = sorted(scene.states, key=lambda name: scene.states[name].position[2])
    parts += [
        _shape(scene.infos[name], scene.states[name], at, scale, name in blamed) for name in names
    ]
    if before is not None:
        parts += [
            _way(before.states[name], scene.states[name], at)
            for name in names
            if name in before.states
        ]
    below = {name: _half(scene, name) * scale for name in names}
    parts += _labels(
        [(name, at(*scene.states[name].position[:2]), below[name]) for name in names], blamed
    )
    parts.append("</svg>")
    return "".join(parts).encode()


def _window(scenes: Sequence[SceneState]) -> tuple[float, float, float]:
    """What is shown, robot and things with some desk around them: the largest x and y of the base
    frame [m], and the scale [px/m].
    """
    x_min, x_max, y_min, y_max = scenes[-1].desk_bounds
    xs, ys = [-BASE_RADIUS_M], [-BASE_RADIUS_M, BASE_RADIUS_M]
    for scene in scenes:
        for name, state in scene.states.items():
            half = _half(scene, name)
            xs += [state.position[0] - half, state.position[0] + half]
            ys += [state.position[1] - half, state.position[1] + half]
    # What fell off and rolled away is beyond the picture's edge.
    x_low = max(min(xs) - AROUND_M, min(x_min, -BASE_RADIUS_M) - MARGIN_M)
    x_high = min(max(xs) + AROUND_M, x_max + MARGIN_M)
    y_low = max(min(ys) - AROUND_M, y_min - MARGIN_M)
    y_high = min(max(ys) + AROUND_M, y_max + MARGIN_M)
    scale = min(WIDTH_PX / (y_high - y_low), HEIGHT_PX / (x_high - x_low))
    return x_low + HEIGHT_PX / scale, (y_low + y_high + WIDTH_PX / scale) / 2, scale


def _half(scene: SceneState, name: str) -> float:
    """Half of what an object takes on the desk [m]."""
    return max(scene.infos[name].size[:2]) / 2


def _robot(center: tuple[float, float], radius: float) -> str:
    x, y = center
    return (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}" fill="#c9ced6" stroke="#5d6270" '
        f'stroke-width="2"/><text x="{x:.1f}" y="{y + 4:.1f}" font-size="12" '
        'text-anchor="middle" fill="#3a3e47">robot</text>'
    )


def _shape(
    info: ObjectInfo,
    state: ObjectState,
    at: Project,
    scale: float,
    blamed: bool,
) -> str:
    x, y = at(*state.position[:2])
    fill = PAINT.get(info.color or "", "#b9bdc6")
    edge = "#c3160c" if blamed else "#4a4e57"
    style = (
        f'fill="{fill}" fill-opacity="{0.35 if state.lost else 0.92}" stroke="{edge}" '
        f'stroke-width="{4 if blamed else 1.5}"'
    )
    outline = footprint(info, state)
    if outline is None:
        radius = max(info.size[:2]) / 2 * scale
        hole = (
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{0.82 * radius:.1f}" fill="#0002"/>'
            if info.container
            else ""
        )
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}" {style}/>{hole}'
    points = " ".join("{:.1f},{:.1f}".format(*at(*point)) for point in outline)
    return f'<polygon points="{points}" {style} stroke-linejoin="round"/>'


def footprint(info: ObjectInfo, state: ObjectState) -> Sequence[tuple[float, float]] | None:
    """Outline of an object's box on the desk plane, base frame [m]; None for an upright round one.

    A ball is round however it lies; what leans shows its side.
    """
    if info.kind == "sphere" or (info.kind in ROUND_KINDS and state.tilt_deg < 20.0):
        return None
    x, y, _ = state.position
    points = [rotated(state.quaternion, corner) for corner in box_corners(info.size)]
    return hull((x + point[0], y + point[1]) for point in points).corners


def _way(before: ObjectState, after: ObjectState, at: Project) -> str:
    (x0, y0, _), (x1, y1, _) = before.position, after.position
    if hypot(x1 - x0, y1 - y0) < ARROW_FROM_M:
        return ""
    (ax, ay), (bx, by) = at(x0, y0), at(x1, y1)
    return (
        f'<path d="M{ax:.1f} {ay:.1f}L{bx:.1f} {by:.1f}" stroke="#2457c5" stroke-width="2.5" '
        'stroke-dasharray="6 4" fill="none" marker-end="url(#a)"/>'
    )


def _labels(
    places: Sequence[tuple[str, tuple[float, float], float]], blamed: set[str]
) -> list[str]:
    """Names below their objects, which reach so far down, and none on another name."""
    taken: list[tuple[float, float, float]] = []
    parts = []
    for name, (x, y), reach in places:
        half = LETTER_PX * (len(name) + 2) / 2
        x = min(max(x, half), WIDTH_PX - half)
        line = min(y + reach + NAME_PX * 0.9, HEIGHT_PX - 6.0)
        while any(
            abs(x - other) < half + width and abs(line - row) < NAME_PX
            for other, row, width in taken
        ):
            line += NAME_PX
        taken.append((x, line, half))
        fill, weight = ("#c3160c", "bold") if name in blamed else ("#22242a", "normal")
        mark = " ⚠" if name in blamed else ""
        parts.append(
            f'<text x="{x:.1f}" y="{line:.1f}" font-size="{NAME_PX}" text-anchor="middle" '
            f'fill="{fill}" font-weight="{weight}" stroke="#fff" stroke-width="3" '
            f'paint-order="stroke">'
            f"{escape(name)}{mark}</text>"
        )
    return parts

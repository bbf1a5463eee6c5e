"""The desk from above, drawn as SVG: what a page shows where nothing can be rendered.

Needs no OpenGL and no model: object extents and poses are in the scene state.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from html import escape
from math import hypot

from etot_cli.world.state import ObjectInfo, ObjectState, SceneState

WIDTH_PX = 640
MARGIN_M = 0.06
"""Room around the desk, for what fell off it."""
ARROW_FROM_M = 0.03
"""Shorter moves get no arrow; it would be longer than the way."""
ROUND = frozenset({"sphere", "cylinder", "cup", "bowl"})
NAME_PX, NAME_WIDTH_PX = 19, 120
"""Height of names, to be read in a picture of half the size, and the width of most."""
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
    scene: SceneState, *, before: SceneState | None = None, culprits: Iterable[str] = ()
) -> bytes:
    """An SVG of the desk seen from above, the robot at the bottom.

    Args:
        scene: what is drawn.
        before: an earlier state; what has moved since is joined to its old place by an arrow.
        culprits: objects drawn in red, with a mark.
    """
    x_min, x_max, y_min, y_max = scene.desk_bounds
    x_low, x_high = min(x_min, -BASE_RADIUS_M) - MARGIN_M, x_max + MARGIN_M
    y_low, y_high = y_min - MARGIN_M, y_max + MARGIN_M
    scale = WIDTH_PX / max(y_high - y_low, 1e-3)
    height = (x_high - x_low) * scale

    # The robot looks up the picture: base x is up, base y is left.
    def at(x: float, y: float) -> tuple[float, float]:
        return (y_high - y) * scale, (x_high - x) * scale

    left, top = at(x_max, y_max)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH_PX} {height:.0f}" '
        f'width="{WIDTH_PX}" height="{height:.0f}" font-family="sans-serif">',
        '<defs><marker id="a" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" '
        'markerHeight="7" orient="auto"><path d="M0 0L8 4L0 8z" fill="#2457c5"/></marker></defs>',
        f'<rect width="{WIDTH_PX}" height="{height:.0f}" fill="#e9eaed"/>',
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
    parts += _labels([(name, at(*scene.states[name].position[:2])) for name in names], blamed)
    parts.append("</svg>")
    return "".join(parts).encode()


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


def footprint(info: ObjectInfo, state: ObjectState) -> list[tuple[float, float]] | None:
    """Outline of an object's box on the desk plane, base frame [m]; None for an upright round one.

    A ball is round however it lies; what leans shows its side.
    """
    if info.kind == "sphere" or (info.kind in ROUND and state.tilt_deg < 20.0):
        return None
    w, i, j, k = state.quaternion
    # The first two rows of the rotation matrix: what matters seen from above.
    rows = (
        (1 - 2 * (j * j + k * k), 2 * (i * j - w * k), 2 * (i * k + w * j)),
        (2 * (i * j + w * k), 1 - 2 * (i * i + k * k), 2 * (j * k - w * i)),
    )
    corners = []
    for number in range(8):
        local = [
            side * (0.5 if number >> axis & 1 else -0.5) for axis, side in enumerate(info.size)
        ]
        corners.append(
            tuple(
                center + sum(r * v for r, v in zip(row, local, strict=True))
                for center, row in zip(state.position[:2], rows, strict=True)
            )
        )
    return _hull([(x, y) for x, y in corners])


def _hull(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Convex hull by turning around the outermost points; fine for eight of them."""
    ordered = sorted(set(points))

    def half(sequence: Iterable[tuple[float, float]]) -> list[tuple[float, float]]:
        chain: list[tuple[float, float]] = []
        for x, y in sequence:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-2], chain[-1]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0:
                    break
                chain.pop()
            chain.append((x, y))
        return chain[:-1]

    return half(ordered) + half(reversed(ordered))


def _way(before: ObjectState, after: ObjectState, at: Project) -> str:
    (x0, y0, _), (x1, y1, _) = before.position, after.position
    if hypot(x1 - x0, y1 - y0) < ARROW_FROM_M:
        return ""
    (ax, ay), (bx, by) = at(x0, y0), at(x1, y1)
    return (
        f'<path d="M{ax:.1f} {ay:.1f}L{bx:.1f} {by:.1f}" stroke="#2457c5" stroke-width="2.5" '
        'stroke-dasharray="6 4" fill="none" marker-end="url(#a)"/>'
    )


def _labels(places: Sequence[tuple[str, tuple[float, float]]], blamed: set[str]) -> list[str]:
    """Names beside their objects, those of things on top of each other one below the other."""
    taken: list[tuple[float, float]] = []
    parts = []
    for name, (x, y) in places:
        line = y + 4
        while any(
            abs(x - other) < NAME_WIDTH_PX and abs(line - row) < NAME_PX for other, row in taken
        ):
            line += NAME_PX
        taken.append((x, line))
        fill, weight = ("#c3160c", "bold") if name in blamed else ("#22242a", "normal")
        mark = " ⚠" if name in blamed else ""
        parts.append(
            f'<text x="{x:.1f}" y="{line:.1f}" font-size="{NAME_PX}" text-anchor="middle" '
            f'fill="{fill}" font-weight="{weight}" stroke="#fff" stroke-width="3" '
            f'paint-order="stroke">'
            f"{escape(name)}{mark}</text>"
        )
    return parts

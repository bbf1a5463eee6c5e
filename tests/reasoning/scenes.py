"""Scenes as plain data, put together by hand: the eight tasks' and a few richer ones."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Assignment
from etot_cli.skills.action import format_plan
from etot_cli.world.state import ObjectInfo, ObjectState, PartInfo, SceneState

TOP = 0.13
UPRIGHT = (1.0, 0.0, 0.0, 0.0)

Item = tuple[ObjectInfo, ObjectState]


def item(
    name: str,
    kind: str = "box",
    at: tuple[float, float] = (0.4, 0.0),
    *,
    size: tuple[float, float, float] = (0.06, 0.06, 0.06),
    label: str | None = None,
    color: str | None = None,
    on: str = "desk",
    inside: str | None = None,
    z: float | None = None,
    mass: float = 0.1,
    parts: tuple[PartInfo, ...] = (),
    openness: Mapping[str, float] | None = None,
    boards: tuple[str, ...] = (),
    plain_color: bool = True,
    foot: float = 0.0,
    fixed_on: str | None = None,
) -> Item:
    """An object of a kind, with what follows from the kind."""
    furniture = kind in ("drawer_unit", "cabinet", "shelf")
    info = ObjectInfo(
        name=name,
        kind=kind,
        label=label or name.replace("_", " "),
        color=color,
        size=size,
        mass=mass,
        movable=not furniture and fixed_on is None,
        container=kind in ("cup", "bowl"),
        surface=furniture or kind in ("box", "cylinder"),
        elongated=kind == "pen",
        parts=parts,
        boards=boards,
        mouth=size[0] - 0.006 if kind in ("cup", "bowl") else 0.0,
        plain_color=plain_color,
        foot=foot,
        on=fixed_on,
    )
    opening = dict(openness or {})
    state = ObjectState(
        position=(*at, TOP + size[2] / 2 if z is None else z),
        quaternion=UPRIGHT,
        on=(on,) if on and fixed_on is None else (),
        inside=inside,
        openness=opening,
        opened={part: value >= 0.75 for part, value in opening.items()},
    )
    return info, state


def ball(name: str, at: tuple[float, float], **more: object) -> Item:
    return item(name, "sphere", at, size=(0.07,) * 3, **more)  # type: ignore[arg-type]


def cup(name: str, at: tuple[float, float], **more: object) -> Item:
    more.setdefault("size", (0.09, 0.09, 0.08))
    return item(name, "cup", at, **more)  # type: ignore[arg-type]


def drawers(
    name: str, at: tuple[float, float], openness: Mapping[str, float], **more: object
) -> Item:
    """A drawer unit with one movable drawer for each entry of ``openness``, top to bottom."""
    single = len(openness) == 1
    parts = tuple(
        PartInfo(name, part, name if single else f"{name}.{part}", "slide", 0.14, True)
        for part in openness
    )
    more.setdefault("size", (0.24, 0.18, 0.15))
    return item(name, "drawer_unit", at, parts=parts, openness=openness, **more)  # type: ignore[arg-type]


def cabinet(name: str, at: tuple[float, float], openness: float, **more: object) -> Item:
    parts = (PartInfo(name, "door", name, "hinge", 2.0, True, front=True),)
    more.setdefault("size", (0.36, 0.50, 0.30))
    return item(name, "cabinet", at, parts=parts, openness={"door": openness}, **more)  # type: ignore[arg-type]


def scene(*items: Item, holding: str | None = None) -> SceneState:
    states = {info.name: state for info, state in items}
    if holding is not None:
        states[holding] = replace(states[holding], on=(), inside=None, in_hand=True)
    return SceneState(
        infos={info.name: info for info, _ in items},
        states=states,
        desk_top=TOP,
        desk_bounds=(0.02, 0.82, -0.6, 0.6),
        holding=holding,
    )


# -- the eight tasks -------------------------------------------------------------------------------


def microwave() -> SceneState:
    return scene(
        cabinet("microwave", (0.39, 0.45), 0.1),
        ball("tennis_ball", (0.29, 0.14), label="tennis ball", color="yellow"),
    )


def pens() -> SceneState:
    return scene(
        cup("black_holder", (0.433, -0.332), color="black", size=(0.074, 0.074, 0.062)),
        cup("white_holder", (0.436, 0.315), color="white"),
        drawers("drawer", (0.470, -0.010), {"top": 0.0}, color="orange"),
        item("pen", "pen", (0.481, -0.005), size=(0.195, 0.018, 0.018), on="drawer",
             color="white", z=0.29),
    )  # fmt: skip


def pens_and_apple() -> SceneState:
    plain = pens()
    apple = ball("apple", (0.436, 0.315), color="red", on="white_holder", z=0.24)
    return scene(*((plain.infos[name], plain.states[name]) for name in plain.infos), apple)


def holder_on_drawer() -> SceneState:
    return scene(
        drawers("drawer", (0.472, 0.214), {"top": 0.0}, color="orange"),
        cup("holder", (0.483, 0.200), on="drawer", color="white", z=0.31),
    )


def toy_in_drawer() -> SceneState:
    return scene(
        drawers("drawer", (0.518, 0.130), {"top": 0.93}, color="orange"),
        item("toy", "box", (0.457, -0.026), size=(0.058, 0.057, 0.086), on="drawer",
             inside="drawer", color="yellow"),
    )  # fmt: skip


def two_balls() -> SceneState:
    return scene(
        ball("tennis_ball_1", (0.362, 0.138), label="tennis ball", color="yellow"),
        ball("tennis_ball_2", (0.372, -0.206), label="tennis ball", color="yellow"),
        cup("holder", (0.480, 0.320), label="white holder", color="white"),
    )


def apple_and_holder() -> SceneState:
    return scene(
        cup("holder", (0.406, -0.344), color="white"),
        drawers("drawer", (0.440, -0.010), {"top": 0.0}, color="orange"),
        ball("apple", (0.400, 0.300), color="red"),
    )


def ball_before_drawer() -> SceneState:
    return scene(
        drawers("drawer", (0.407, -0.051), {"top": 0.18}, color="orange"),
        ball("tennis_ball", (0.497, 0.131), label="tennis ball", color="yellow"),
        cup("holder", (0.574, 0.255), color="white", label="white holder"),
        ball("apple", (0.400, 0.270), color="red"),
    )


# -- richer scenes ---------------------------------------------------------------------------------


def kitchen() -> SceneState:
    """Two bowls, a plate, three mugs, a bottle behind a box, two apples, a chest of two drawers."""
    return scene(
        item("bowl_1", "bowl", (0.30, 0.30), size=(0.14, 0.14, 0.05), color="blue"),
        item("bowl_2", "bowl", (0.30, -0.30), size=(0.10, 0.10, 0.04), color="blue"),
        item("plate", "box", (0.42, 0.32), size=(0.16, 0.16, 0.01)),
        cup("mug_a", (0.60, 0.10), color="red"),
        cup("mug_b", (0.35, 0.05), color="green", size=(0.07, 0.07, 0.06)),
        cup("mug_c", (0.36, -0.10), color="green", size=(0.08, 0.08, 0.12)),
        item("box", "box", (0.45, -0.20), size=(0.10, 0.10, 0.12), color="brown"),
        item("bottle", "cylinder", (0.62, -0.20), size=(0.06, 0.06, 0.2)),
        ball("apple_1", (0.25, 0.15), color="red"),
        ball("apple_2", (0.25, -0.15), color="green"),
        drawers("chest", (0.70, 0.40), {"upper": 0.0, "lower": 0.9}, size=(0.24, 0.18, 0.2)),
    )


# -- reading them ----------------------------------------------------------------------------------


def plans(instruction: str, state: SceneState) -> list[str]:
    """The branches proposed for an instruction, written on one line each."""
    branches = BuiltinReasoner().propose(Assignment(instruction), state)
    return [format_plan(branch.actions) for branch in branches]


def short(plan: str) -> str:
    """A plan in shorthand: ``pick up pen, put into cup``."""
    return re.sub(r"\[([A-Z ]+), ([\w.]+)\]", lambda m: f"{m[1].lower()} {m[2]},", plan).strip(",")


def renamed(state: SceneState, names: Mapping[str, str]) -> SceneState:
    """The scene with other names; labels become the new names' words."""

    def place(address: str) -> str:
        owner, dot, part = address.partition(".")
        return names.get(owner, owner) + dot + part

    infos = {}
    states = {}
    for old, info in state.infos.items():
        new = names[old]
        parts = tuple(replace(part, owner=new, address=place(part.address)) for part in info.parts)
        infos[new] = replace(info, name=new, label=new.replace("_", " "), parts=parts)
        before = state.states[old]
        states[new] = replace(
            before,
            on=tuple(place(support) for support in before.on),
            inside=None if before.inside is None else place(before.inside),
        )
    holding = None if state.holding is None else names[state.holding]
    return replace(state, infos=infos, states=states, holding=holding)

"""Small scene states, made by hand: no physics."""

from __future__ import annotations

from etot_cli.world.state import ObjectInfo, ObjectState, PartInfo, SceneState

UP = (1.0, 0.0, 0.0, 0.0)


def _info(
    name: str, kind: str, color: str | None = None, label: str = "", **more: bool
) -> ObjectInfo:
    facts = {"movable": True, "container": False, "surface": False, **more}
    return ObjectInfo(
        name,
        kind,
        label or name.replace("_", " "),
        color,
        (0.08, 0.08, 0.1),
        0.1,
        facts["movable"],
        facts["container"],
        facts["surface"],
        False,
    )


def kitchen() -> SceneState:
    """Two cups, a spoon, a ball, and a chest with one drawer."""
    drawer = PartInfo("chest", "top", "chest", "slide", 0.14, True)
    infos = {
        "red_cup": _info("red_cup", "cup", "red", container=True),
        "blue_cup": _info("blue_cup", "cup", "blue", container=True),
        "spoon": _info("spoon", "pen"),
        "ball": _info("ball", "sphere", "green", "rubber ball"),
        "chest": ObjectInfo(
            "chest",
            "drawer_unit",
            "chest of drawers",
            "brown",
            (0.3, 0.2, 0.2),
            2.0,
            False,
            False,
            True,
            False,
            (drawer,),
        ),
    }
    states = {
        name: ObjectState((0.3 + 0.1 * i, 0.1 * i, 0.2), UP, on=("desk",))
        for i, name in enumerate(infos)
    }
    states["chest"] = ObjectState(
        (0.5, 0.0, 0.2), UP, on=("desk",), openness={"top": 0.0}, opened={"top": False}
    )
    return SceneState(infos, states, 0.13, (0.0, 0.8, -0.6, 0.6))

"""The scenes of the corpus: desks with everyday things, none of them a task's."""

from __future__ import annotations

import math
from dataclasses import replace

from etot_cli.world.state import PartInfo, SceneState
from tests.reasoning.scenes import ball, cabinet, cup, drawers, item, scene

FLAT = (0.16, 0.16, 0.015)
CUBE = (0.04, 0.04, 0.04)
BOWL = (0.14, 0.14, 0.05)


def breakfast() -> SceneState:
    """A plate, a bowl on the right, two cups in different colours, an apple, a banana, a vase."""
    return scene(
        item("plate", "box", (0.42, 0.10), size=FLAT, color="white"),
        item("bowl", "bowl", (0.40, -0.25), size=BOWL, color="blue"),
        cup("red_cup", (0.30, 0.30), color="red"),
        cup("yellow_cup", (0.32, -0.05), color="yellow"),
        ball("apple", (0.55, 0.35), color="red"),
        item("banana", "capsule", (0.58, -0.10), size=(0.15, 0.035, 0.035), color="yellow"),
        item("vase", "cup", (0.60, 0.10), size=(0.08, 0.08, 0.20), color="green"),
    )


def black_bowls() -> SceneState:
    """Three black bowls one behind the other, a plate, a ramekin, a wooden cabinet of drawers."""
    return scene(
        item("bowl_1", "bowl", (0.28, 0.00), size=BOWL, color="black", label="black bowl"),
        item("bowl_2", "bowl", (0.44, 0.02), size=BOWL, color="black", label="black bowl"),
        item("bowl_3", "bowl", (0.60, -0.02), size=BOWL, color="black", label="black bowl"),
        item("plate", "box", (0.40, -0.30), size=FLAT, color="white"),
        item("ramekin", "bowl", (0.42, 0.24), size=(0.08, 0.08, 0.04), color="white"),
        drawers(
            "cabinet", (0.60, 0.45), {"top": 0.0, "middle": 0.0, "bottom": 0.0},
            label="wooden cabinet", color="brown",
        ),
    )  # fmt: skip


def mugs() -> SceneState:
    """A mug that is yellow and white, a white one, a red one, two plates, a microwave."""
    return scene(
        cup("yw_mug", (0.35, 0.00), label="yellow and white mug", color="yellow"),
        cup("white_mug", (0.35, 0.20), color="white"),
        cup("red_mug", (0.35, -0.20), color="red"),
        item("plate_1", "box", (0.50, 0.25), size=FLAT, label="plate", color="white"),
        item("plate_2", "box", (0.50, -0.25), size=FLAT, label="plate", color="white"),
        cabinet("microwave", (0.65, 0.45), 0.0, color="gray"),
    )


def blocks() -> SceneState:
    """Blocks in five colours, cyan and blue among them, and a crate."""
    return scene(
        item("red_block", "box", (0.30, 0.20), size=CUBE, color="red"),
        item("green_block", "box", (0.35, 0.10), size=CUBE, color="green"),
        item("blue_block", "box", (0.40, 0.00), size=CUBE, color="blue"),
        item("cyan_block", "box", (0.45, -0.10), size=CUBE, color="blue"),
        item("yellow_block", "box", (0.50, -0.20), size=(0.06, 0.06, 0.04), color="yellow"),
        item("crate", "bowl", (0.45, 0.35), size=(0.20, 0.20, 0.08), color="brown"),
    )


def near_colors() -> SceneState:
    """A blue dish and a cyan jar, a brown and a beech box, a silver ball, a tray."""
    near = {"plain_color": False}
    return scene(
        item("dish", "box", (0.30, 0.20), size=FLAT, color="blue"),
        item("jar", "cup", (0.40, 0.10), size=(0.08, 0.08, 0.10), color="blue", **near),
        item("box_1", "bowl", (0.45, 0.35), size=(0.20, 0.20, 0.08), label="box", color="brown"),
        item(
            "box_2",
            "bowl",
            (0.45, -0.35),
            size=(0.20, 0.20, 0.08),
            label="box",
            color="brown",
            **near,
        ),
        item("ball", "sphere", (0.30, -0.10), size=(0.04, 0.04, 0.04), color="gray", **near),
        item("tray", "box", (0.60, 0.00), size=(0.25, 0.18, 0.02), color="white"),
    )


def cups_and_balls() -> SceneState:
    """Three cups side by side, balls in three colours, an orange ball, no orange."""
    return scene(
        cup("cup_1", (0.40, 0.25), label="cup", color="blue"),
        cup("cup_2", (0.40, 0.00), label="cup", color="white"),
        cup("cup_3", (0.40, -0.25), label="cup", color="white"),
        ball("orange_ball", (0.55, 0.12), color="orange"),
        ball("blue_ball", (0.55, -0.12), color="blue"),
        ball("golf_ball", (0.28, 0.12), color="white"),
        item("tray", "box", (0.60, 0.40), size=(0.25, 0.18, 0.02), color="gray"),
    )


def drawers_and_desk() -> SceneState:
    """A chest with an open lower drawer that holds a pen, a toy before it, a box, a sponge."""
    return scene(
        drawers("chest", (0.60, 0.20), {"upper": 0.0, "lower": 0.9}, color="brown"),
        item("pen", "pen", (0.58, 0.05), size=(0.15, 0.012, 0.012), on="chest",
             inside="chest.lower", color="black"),
        item("toy", "box", (0.35, 0.10), size=(0.05, 0.05, 0.08), color="yellow"),
        item("box", "box", (0.40, -0.20), size=(0.12, 0.12, 0.08), color="brown"),
        item("sponge", "box", (0.30, -0.35), size=(0.08, 0.05, 0.03), color="green"),
        cup("mug", (0.30, 0.30), color="white"),
    )  # fmt: skip


def pantry() -> SceneState:
    """Soup, sauce, milk, a carton of juice and a basket; a shelf of three boards."""
    return scene(
        item("soup", "cylinder", (0.30, 0.10), size=(0.06, 0.06, 0.09), label="alphabet soup"),
        item("sauce", "cylinder", (0.30, -0.05), size=(0.06, 0.06, 0.09), label="tomato sauce",
             color="red"),
        item("milk", "box", (0.35, -0.20), size=(0.06, 0.06, 0.14), label="milk", color="white"),
        item("juice", "box", (0.45, 0.00), size=(0.06, 0.06, 0.14), label="carton of juice",
             color="orange"),
        item("basket", "bowl", (0.45, 0.30), size=(0.22, 0.22, 0.10), color="brown"),
        item("shelf", "shelf", (0.65, -0.30), size=(0.25, 0.30, 0.4),
             boards=("low", "mid", "high")),
    )  # fmt: skip


def stacked() -> SceneState:
    """A cup on a book, a coin in that cup, a lid on a pot, another book, a tray."""
    return scene(
        item("book", "box", (0.40, 0.20), size=(0.20, 0.14, 0.03), label="red book", color="red"),
        cup("cup", (0.40, 0.20), on="book", z=0.2, color="white"),
        item("coin", "cylinder", (0.40, 0.20), size=(0.02, 0.02, 0.003), on="cup", inside="cup",
             z=0.17, color="yellow"),
        item("pot", "cup", (0.40, -0.20), size=(0.16, 0.16, 0.10), color="gray"),
        item("lid", "cylinder", (0.30, -0.35), size=(0.16, 0.16, 0.02), color="gray"),
        item("atlas", "box", (0.60, 0.00), size=(0.25, 0.20, 0.04), label="blue book",
             color="blue"),
        item("tray", "box", (0.55, 0.35), size=(0.25, 0.20, 0.02), color="black"),
    )  # fmt: skip


def piled() -> SceneState:
    """A block upon another, one on a tray, one on the desk."""
    return scene(
        item("red_block", "box", (0.30, 0.20), size=CUBE, color="red", label="block"),
        item("green_block", "box", (0.30, 0.20), size=CUBE, color="green", label="block",
             on="red_block", z=0.19),
        item("tray", "box", (0.55, 0.35), size=(0.25, 0.20, 0.02), color="black"),
        item("blue_block", "box", (0.55, 0.35), size=CUBE, color="blue", label="block",
             on="tray", z=0.17),
        item("pink_block", "box", (0.40, -0.10), size=CUBE, color="pink", label="block"),
    )  # fmt: skip


def sorting() -> SceneState:
    """Red, green and blue bowls, and for each a cube of the colour; two more red things."""
    return scene(
        item("red_bowl", "bowl", (0.50, 0.30), size=BOWL, color="red"),
        item("green_bowl", "bowl", (0.50, 0.00), size=BOWL, color="green"),
        item("blue_bowl", "bowl", (0.50, -0.30), size=BOWL, color="blue"),
        item("red_cube", "box", (0.30, 0.20), size=CUBE, color="red"),
        item("green_cube", "box", (0.30, 0.00), size=CUBE, color="green"),
        item("blue_cube", "box", (0.30, -0.20), size=CUBE, color="blue"),
        ball("red_ball", (0.25, 0.30), color="red"),
        item("star", "box", (0.25, -0.30), size=CUBE, color="red", label="star"),
    )


def office() -> SceneState:
    """Two pens, a stapler, an eraser, a pen cup, a filing cabinet of two drawers, a caddy."""
    return scene(
        item("pen_1", "pen", (0.30, 0.20), size=(0.15, 0.01, 0.01), label="blue pen",
             color="blue"),
        item("pen_2", "pen", (0.30, -0.20), size=(0.15, 0.01, 0.01), label="black pen",
             color="black"),
        item("stapler", "box", (0.40, 0.05), size=(0.12, 0.04, 0.05), color="red"),
        item("eraser", "box", (0.35, -0.05), size=(0.04, 0.02, 0.015), color="white"),
        cup("pen_cup", (0.50, -0.30), label="pen cup", color="gray"),
        drawers("filing_cabinet", (0.60, 0.25), {"top": 0.0, "bottom": 0.0}, color="gray"),
        item("caddy", "bowl", (0.45, -0.05), size=(0.18, 0.18, 0.1), color="brown"),
    )  # fmt: skip


def cupboard() -> SceneState:
    """A closed cupboard with a jar in it, an open cabinet, a bottle, a glass, a can."""
    return scene(
        cabinet("cupboard", (0.60, 0.35), 0.0, color="white"),
        cabinet("locker", (0.60, -0.35), 0.95, color="blue"),
        item("jar", "cylinder", (0.60, 0.35), size=(0.06, 0.06, 0.1), inside="cupboard",
             on="cupboard", z=0.25),
        item("bottle", "cylinder", (0.35, 0.10), size=(0.06, 0.06, 0.2), color="green"),
        item("glass", "cup", (0.35, -0.10), size=(0.06, 0.06, 0.12), color=None),
        item("can", "cylinder", (0.30, 0.00), size=(0.06, 0.06, 0.1), color="red"),
    )  # fmt: skip


def numbered() -> SceneState:
    """Four cubes that differ in number and size, two boxes with numbers."""
    return scene(
        item("cube_1", "box", (0.30, 0.30), size=(0.03, 0.03, 0.03), color="gray"),
        item("cube_2", "box", (0.30, 0.10), size=(0.04, 0.04, 0.04), color="gray"),
        item("cube_3", "box", (0.30, -0.10), size=(0.05, 0.05, 0.05), color="gray"),
        item("cube_4", "box", (0.30, -0.30), size=(0.06, 0.06, 0.06), color="gray"),
        item("bin_1", "bowl", (0.50, 0.20), size=BOWL, color="gray"),
        item("bin_2", "bowl", (0.50, -0.20), size=BOWL, color="gray"),
    )


def lidded() -> SceneState:
    """A chest with a lid and, beside it, a mug and a plum; seen by a camera from the far side."""
    parts = (PartInfo("chest", "lid", "chest", "hinge", 1.5, True),)
    seen = scene(
        item("chest", "cabinet", (0.60, 0.00), size=(0.3, 0.2, 0.2), parts=parts,
             openness={"lid": 0.0}, color="brown"),
        cup("mug_1", (0.35, 0.25), label="mug", color="white"),
        cup("mug_2", (0.35, -0.25), label="mug", color="white"),
        ball("plum", (0.30, 0.00), color="purple"),
        item("mat", "box", (0.45, 0.02), size=FLAT, color="green"),
    )  # fmt: skip
    return replace(seen, forward=(-1.0, 0.0))


def kitchen() -> SceneState:
    """Two pots, one big, one small and red, a lid for each, a pan, food, a plate, a spatula."""
    return scene(
        item("big_pot", "cup", (0.50, 0.20), size=(0.18, 0.18, 0.12), color="gray"),
        item("small_pot", "cup", (0.50, -0.10), size=(0.12, 0.12, 0.08), color="red"),
        item("big_lid", "cylinder", (0.35, 0.40), size=(0.18, 0.18, 0.02), color="gray"),
        item("small_lid", "cylinder", (0.30, -0.30), size=(0.12, 0.12, 0.02), color="red"),
        item("pan", "bowl", (0.55, -0.40), size=(0.22, 0.22, 0.05), label="frying pan",
             color="black"),
        item("spatula", "capsule", (0.30, 0.20), size=(0.20, 0.03, 0.03), color="black"),
        item("egg", "sphere", (0.28, -0.05), size=(0.05, 0.05, 0.05), color="white"),
        ball("tomato", (0.35, 0.05), color="red"),
        item("plate", "box", (0.68, 0.05), size=FLAT, color="white"),
    )  # fmt: skip


def workshop() -> SceneState:
    """A unit of two drawers, the lower one open with a nut in it, a shelf, tools, a toolbox."""
    return scene(
        drawers("unit", (0.60, 0.30), {"upper": 0.0, "lower": 0.9}, label="drawer unit",
                color="gray"),
        item("shelf", "shelf", (0.65, -0.35), size=(0.25, 0.30, 0.4), boards=("low", "high")),
        item("nut", "cylinder", (0.58, 0.15), size=(0.02, 0.02, 0.01), on="unit",
             inside="unit.lower", color="gray"),
        item("hammer", "capsule", (0.35, 0.00), size=(0.25, 0.04, 0.04), color="brown"),
        item("red_driver", "pen", (0.30, 0.15), size=(0.18, 0.02, 0.02), label="red screwdriver",
             color="red"),
        item("blue_driver", "pen", (0.30, -0.15), size=(0.18, 0.02, 0.02),
             label="blue screwdriver", color="blue"),
        item("tape", "cylinder", (0.40, -0.30), size=(0.08, 0.08, 0.03), color="yellow",
             on="shelf.low", z=0.3),
        item("toolbox", "bowl", (0.45, 0.05), size=(0.25, 0.18, 0.10), color="red"),
        cup("tin", (0.30, 0.35), color="blue"),
    )  # fmt: skip


def stationery() -> SceneState:
    """A notebook with a ruler on it, a pencil, markers, a cup, a mug with a clip in it, trays."""
    return scene(
        item("notebook", "box", (0.45, 0.05), size=(0.20, 0.15, 0.02), color="blue"),
        item("ruler", "capsule", (0.45, 0.05), size=(0.20, 0.02, 0.01), on="notebook", z=0.16,
             color="yellow"),
        item("pencil", "pen", (0.30, 0.25), size=(0.17, 0.01, 0.01), color="yellow"),
        item("red_marker", "pen", (0.30, -0.05), size=(0.13, 0.02, 0.02), color="red"),
        item("green_marker", "pen", (0.30, -0.25), size=(0.13, 0.02, 0.02), color="green"),
        cup("pencil_cup", (0.50, 0.35), color="white"),
        cup("mug", (0.50, -0.30), color="black"),
        item("clip", "box", (0.50, -0.30), size=(0.02, 0.01, 0.01), on="mug", inside="mug",
             z=0.15, color="gray"),
        item("red_tray", "box", (0.65, 0.10), size=(0.20, 0.16, 0.02), color="red"),
        item("green_tray", "box", (0.65, -0.15), size=(0.20, 0.16, 0.02), color="green"),
    )  # fmt: skip


def galley() -> SceneState:
    """Two mugs, a plate, bowls, food; a cabinet of three drawers, a shelf of two boards."""
    return scene(
        item("plate", "box", (0.42, 0.05), size=FLAT, color="white"),
        item("bowl", "bowl", (0.40, -0.20), size=BOWL, color="blue"),
        item("ramekin", "bowl", (0.28, -0.30), size=(0.08, 0.08, 0.04), color="white"),
        cup("red_mug", (0.30, 0.30), color="red"),
        cup("blue_mug", (0.30, 0.15), color="blue"),
        ball("lemon", (0.55, 0.10), color="yellow"),
        item("carrot", "capsule", (0.52, -0.05), size=(0.15, 0.03, 0.03), color="orange"),
        item("spoon", "pen", (0.25, 0.0), size=(0.16, 0.03, 0.02), color="gray"),
        drawers("cabinet", (0.62, 0.42), {"top": 0.0, "middle": 0.9, "bottom": 0.0}, color="brown"),
        item("shelf", "shelf", (0.65, -0.40), size=(0.25, 0.30, 0.4), boards=("lower", "upper")),
    )


def bench() -> SceneState:
    """Three bolts of growing size, bins, a wrench in a toolbox, a drill on a tray, a locker."""
    return scene(
        item(
            "bolt_1", "cylinder", (0.30, 0.30), size=(0.02, 0.02, 0.04), label="bolt", color="gray"
        ),
        item(
            "bolt_2", "cylinder", (0.30, 0.15), size=(0.03, 0.03, 0.06), label="bolt", color="gray"
        ),
        item(
            "bolt_3", "cylinder", (0.30, 0.00), size=(0.04, 0.04, 0.08), label="bolt", color="gray"
        ),
        item("red_bin", "bowl", (0.45, 0.25), size=(0.12, 0.12, 0.06), color="red"),
        item("green_bin", "bowl", (0.45, 0.00), size=(0.18, 0.18, 0.08), color="green"),
        item("toolbox", "bowl", (0.45, -0.25), size=(0.25, 0.18, 0.10), color="blue"),
        item(
            "wrench",
            "capsule",
            (0.45, -0.25),
            size=(0.15, 0.03, 0.02),
            on="toolbox",
            inside="toolbox",
            color="gray",
            z=0.17,
        ),
        item("tray", "box", (0.30, -0.35), size=(0.25, 0.18, 0.02), color="black"),
        item(
            "drill",
            "box",
            (0.30, -0.35),
            size=(0.10, 0.05, 0.08),
            on="tray",
            color="yellow",
            z=0.20,
        ),
        cabinet("locker", (0.65, 0.35), 0.0, color="gray"),
    )


def writing_desk() -> SceneState:
    """Three books, an eraser on the middle one, pens, a cup, a drawer on either side."""
    return scene(
        item(
            "blue_book",
            "box",
            (0.40, 0.25),
            size=(0.20, 0.14, 0.03),
            color="blue",
            label="blue book",
        ),
        item(
            "red_book", "box", (0.40, 0.00), size=(0.20, 0.14, 0.03), color="red", label="red book"
        ),
        item(
            "green_book",
            "box",
            (0.40, -0.25),
            size=(0.22, 0.16, 0.05),
            color="green",
            label="green book",
        ),
        cup("pen_cup", (0.25, 0.10), color="white"),
        item("pen", "pen", (0.25, 0.30), size=(0.15, 0.01, 0.01), color="black"),
        item("marker", "pen", (0.25, -0.10), size=(0.14, 0.02, 0.02), color="red"),
        item(
            "eraser",
            "box",
            (0.40, 0.00),
            size=(0.04, 0.02, 0.015),
            on="red_book",
            color="pink",
            z=0.17,
        ),
        drawers("left_drawer", (0.62, 0.35), {"main": 0.0}, label="left drawer", color="gray"),
        drawers("right_drawer", (0.62, -0.35), {"main": 0.9}, label="right drawer", color="gray"),
        item("stapler", "box", (0.55, 0.0), size=(0.12, 0.04, 0.05), color="black"),
    )


def laboratory() -> SceneState:
    """Beakers and cubes in three colours, a marble in a beaker, a rack of three boards."""
    return scene(
        cup("red_beaker", (0.45, 0.25), color="red"),
        cup("green_beaker", (0.45, 0.00), color="green"),
        cup("blue_beaker", (0.45, -0.25), color="blue"),
        item("red_cube", "box", (0.30, 0.20), size=CUBE, color="red"),
        item("green_cube", "box", (0.30, 0.00), size=(0.05, 0.05, 0.05), color="green"),
        item("blue_cube", "box", (0.30, -0.20), size=(0.06, 0.06, 0.06), color="blue"),
        ball(
            "marble", (0.45, 0.00), on="green_beaker", inside="green_beaker", color="white", z=0.16
        ),
        item(
            "rack", "shelf", (0.65, 0.0), size=(0.25, 0.40, 0.4), boards=("bottom", "middle", "top")
        ),
        item(
            "petri_dish",
            "bowl",
            (0.55, 0.40),
            size=(0.10, 0.10, 0.03),
            color="white",
            label="petri dish",
        ),
    )


def larder() -> SceneState:
    """Two shelves, two red cans and a green one, a jar, two bottles, an egg in a crate."""
    return scene(
        item(
            "left_shelf",
            "shelf",
            (0.65, 0.40),
            size=(0.2, 0.25, 0.4),
            boards=("lower", "upper"),
            label="left shelf",
        ),
        item(
            "right_shelf",
            "shelf",
            (0.65, -0.40),
            size=(0.2, 0.25, 0.4),
            boards=("lower", "upper"),
            label="right shelf",
        ),
        item(
            "can_1", "cylinder", (0.30, 0.25), size=(0.06, 0.06, 0.10), label="red can", color="red"
        ),
        item(
            "can_2", "cylinder", (0.30, 0.10), size=(0.06, 0.06, 0.10), label="red can", color="red"
        ),
        item(
            "can_3",
            "cylinder",
            (0.30, -0.05),
            size=(0.06, 0.06, 0.10),
            label="green can",
            color="green",
        ),
        item("jar", "cylinder", (0.45, 0.20), size=(0.08, 0.08, 0.12), color="yellow"),
        item(
            "big_bottle",
            "cylinder",
            (0.45, 0.00),
            size=(0.08, 0.08, 0.25),
            label="big bottle",
            color="green",
        ),
        item(
            "small_bottle",
            "cylinder",
            (0.45, -0.15),
            size=(0.05, 0.05, 0.15),
            label="small bottle",
            color="blue",
        ),
        item("basket", "bowl", (0.30, -0.30), size=(0.22, 0.22, 0.10), color="brown"),
        item("crate", "bowl", (0.50, -0.30), size=(0.20, 0.20, 0.08), color="gray"),
        ball("egg", (0.50, -0.30), on="crate", inside="crate", color="white", z=0.17),
    )


def repair_shop() -> SceneState:
    """Two toolboxes, a chest of drawers, three screws, a hammer, tape on a mat, a cabinet."""
    return scene(
        item("red_toolbox", "bowl", (0.45, 0.30), size=(0.20, 0.16, 0.10), color="red"),
        item("blue_toolbox", "bowl", (0.45, -0.30), size=(0.20, 0.16, 0.10), color="blue"),
        drawers("chest", (0.65, 0.00), {"top": 0.9, "bottom": 0.0}, color="brown"),
        item(
            "screw_1",
            "cylinder",
            (0.25, 0.20),
            size=(0.01, 0.01, 0.03),
            label="screw",
            color="gray",
        ),
        item(
            "screw_2",
            "cylinder",
            (0.25, 0.00),
            size=(0.01, 0.01, 0.03),
            label="screw",
            color="gray",
        ),
        item(
            "screw_3",
            "cylinder",
            (0.25, -0.20),
            size=(0.01, 0.01, 0.03),
            label="screw",
            color="gray",
        ),
        item("hammer", "capsule", (0.35, 0.10), size=(0.25, 0.04, 0.04), color="brown"),
        item("mat", "box", (0.35, -0.10), size=(0.20, 0.20, 0.01), color="green"),
        item(
            "tape",
            "cylinder",
            (0.35, -0.10),
            size=(0.08, 0.08, 0.03),
            on="mat",
            color="yellow",
            z=0.15,
        ),
        cabinet("cabinet", (0.65, 0.45), 0.0, color="white"),
    )


def bureau() -> SceneState:
    """A mug, a cup, a glass, two notebooks, a folder, a tray, a key, three drawers."""
    return scene(
        cup("mug", (0.30, 0.30), color="blue"),
        cup("cup", (0.30, 0.10), color="white"),
        item("glass", "cup", (0.30, -0.10), size=(0.06, 0.06, 0.12), color=None),
        item(
            "big_notebook",
            "box",
            (0.45, 0.20),
            size=(0.25, 0.18, 0.02),
            label="notebook",
            color="blue",
        ),
        item(
            "small_notebook",
            "box",
            (0.45, -0.10),
            size=(0.15, 0.10, 0.02),
            label="notebook",
            color="blue",
        ),
        item("folder", "box", (0.45, -0.30), size=(0.22, 0.16, 0.01), color="red"),
        item("tray", "box", (0.30, -0.35), size=(0.25, 0.18, 0.02), color="black"),
        cup("organizer", (0.60, -0.10), color="black"),
        item(
            "pencil",
            "pen",
            (0.60, -0.10),
            size=(0.15, 0.01, 0.01),
            on="organizer",
            inside="organizer",
            color="yellow",
            z=0.2,
        ),
        item("key", "box", (0.25, 0.0), size=(0.05, 0.02, 0.01), color="yellow"),
        drawers("drawer", (0.65, 0.30), {"top": 0.0, "middle": 0.0, "bottom": 0.9}, color="gray"),
    )


def counter() -> SceneState:
    """Three plates of growing size, a cup on a saucer, fruit, a fork, a fridge, two drawers."""
    return scene(
        item(
            "small_plate",
            "box",
            (0.30, 0.35),
            size=(0.12, 0.12, 0.015),
            label="plate",
            color="white",
        ),
        item(
            "medium_plate",
            "box",
            (0.30, 0.10),
            size=(0.16, 0.16, 0.015),
            label="plate",
            color="white",
        ),
        item(
            "large_plate",
            "box",
            (0.30, -0.20),
            size=(0.20, 0.20, 0.015),
            label="plate",
            color="white",
        ),
        item("saucer", "box", (0.45, -0.05), size=(0.12, 0.12, 0.01), color="blue"),
        cup("red_cup", (0.45, -0.05), on="saucer", color="red", z=0.18),
        cup("green_cup", (0.45, 0.15), color="green"),
        ball("pear", (0.50, 0.30), color="green"),
        ball("peach_1", (0.55, -0.20), label="peach", color="orange"),
        ball("peach_2", (0.55, 0.05), label="peach", color="orange"),
        item("fork", "pen", (0.25, -0.40), size=(0.16, 0.02, 0.02), color="gray"),
        cabinet("fridge", (0.68, 0.45), 0.0, color="white"),
        drawers(
            "drawers",
            (0.68, -0.35),
            {"upper": 0.0, "lower": 0.0},
            label="drawer unit",
            color="brown",
        ),
    )


def scullery() -> SceneState:
    """A cup and a lime on a tray, more cups, two onions and boxes, three drawers and boards."""
    return scene(
        item("tray", "box", (0.30, -0.30), size=(0.30, 0.22, 0.02), color="black"),
        cup("red_cup", (0.25, -0.25), on="tray", color="red", z=0.18),
        ball("lime", (0.35, -0.35), on="tray", color="green", z=0.17),
        item("plate", "box", (0.40, 0.05), size=(0.18, 0.18, 0.015), color="white"),
        item("bowl", "bowl", (0.42, -0.15), size=(0.14, 0.14, 0.05), color="blue"),
        ball("apple", (0.42, -0.15), on="bowl", inside="bowl", color="red", z=0.17),
        cup("white_cup", (0.30, 0.12), color="white"),
        cup("blue_cup", (0.52, 0.15), color="blue"),
        ball("onion_1", (0.25, 0.35), label="onion", color="brown"),
        ball("onion_2", (0.25, -0.05), label="onion", color="brown"),
        item(
            "small_box", "bowl", (0.45, 0.32), size=(0.10, 0.10, 0.06), label="box", color="brown"
        ),
        item(
            "large_box", "bowl", (0.55, -0.02), size=(0.18, 0.18, 0.10), label="box", color="brown"
        ),
        drawers(
            "dresser", (0.66, 0.25), {"upper": 0.9, "middle": 0.0, "lower": 0.0}, color="white"
        ),
        cabinet("cabinet", (0.66, 0.48), 0.0, color="gray"),
        item(
            "shelf",
            "shelf",
            (0.66, -0.40),
            size=(0.25, 0.30, 0.4),
            boards=("bottom", "middle", "top"),
        ),
        item(
            "tin",
            "cylinder",
            (0.66, -0.40),
            size=(0.06, 0.06, 0.08),
            on="shelf.top",
            color="gray",
            z=0.5,
        ),
    )


def nursery() -> SceneState:
    """Balls and blocks of two colours and more, a crate of each, a duck on a mat, two dressers."""
    return scene(
        ball("ball_1", (0.25, 0.35), label="ball", color="red"),
        ball("ball_2", (0.25, 0.20), label="ball", color="blue"),
        ball("ball_3", (0.40, 0.35), label="ball", color="red"),
        item("block_1", "box", (0.25, 0.00), size=(0.04, 0.04, 0.04), label="block", color="red"),
        item("block_2", "box", (0.25, -0.12), size=(0.05, 0.05, 0.05), label="block", color="blue"),
        item(
            "block_3", "box", (0.40, -0.12), size=(0.06, 0.06, 0.06), label="block", color="green"
        ),
        item(
            "red_crate", "bowl", (0.45, 0.18), size=(0.20, 0.16, 0.08), label="crate", color="red"
        ),
        item(
            "blue_crate",
            "bowl",
            (0.45, -0.32),
            size=(0.20, 0.16, 0.08),
            label="crate",
            color="blue",
        ),
        item(
            "train", "box", (0.40, 0.02), size=(0.12, 0.05, 0.05), label="toy train", color="green"
        ),
        item("red_mat", "box", (0.58, -0.05), size=(0.18, 0.18, 0.01), label="mat", color="red"),
        item(
            "duck",
            "ball",
            (0.58, -0.05),
            size=(0.05, 0.05, 0.05),
            on="red_mat",
            color="yellow",
            z=0.16,
        ),
        drawers(
            "left_dresser",
            (0.68, 0.40),
            {"top": 0.0, "bottom": 0.0},
            label="left dresser",
            color="white",
        ),
        drawers(
            "right_dresser",
            (0.68, -0.42),
            {"top": 0.9, "bottom": 0.0},
            label="right dresser",
            color="white",
        ),
    )


def atelier() -> SceneState:
    """Brushes, tubes on a palette, jars, two canvases, a rag in a basin, a cart, a rack."""
    return scene(
        item(
            "desk_lamp",
            "cylinder",
            (0.60, 0.30),
            size=(0.12, 0.12, 0.30),
            label="lamp",
            color="black",
        ),
        cup("left_jar", (0.45, 0.30), label="jar", color="white"),
        cup("right_jar", (0.45, -0.10), label="jar", color="black"),
        item(
            "thick_brush",
            "pen",
            (0.45, 0.30),
            size=(0.18, 0.02, 0.02),
            label="thick brush",
            on="left_jar",
            inside="left_jar",
            color="brown",
            z=0.2,
        ),
        item(
            "thin_brush",
            "pen",
            (0.25, 0.10),
            size=(0.18, 0.01, 0.01),
            label="thin brush",
            color="brown",
        ),
        item("palette", "box", (0.30, -0.15), size=(0.25, 0.20, 0.01), color="white"),
        item(
            "red_tube",
            "cylinder",
            (0.27, -0.12),
            size=(0.03, 0.03, 0.10),
            label="tube",
            on="palette",
            color="red",
            z=0.18,
        ),
        item(
            "blue_tube",
            "cylinder",
            (0.33, -0.18),
            size=(0.03, 0.03, 0.10),
            label="tube",
            on="palette",
            color="blue",
            z=0.18,
        ),
        item(
            "green_tube",
            "cylinder",
            (0.25, 0.30),
            size=(0.03, 0.03, 0.10),
            label="tube",
            color="green",
        ),
        item("sponge", "box", (0.45, 0.10), size=(0.09, 0.06, 0.03), color="yellow"),
        item("basin", "bowl", (0.50, -0.30), size=(0.22, 0.22, 0.08), color="gray"),
        item(
            "rag",
            "box",
            (0.50, -0.30),
            size=(0.06, 0.06, 0.02),
            on="basin",
            inside="basin",
            color="white",
            z=0.16,
        ),
        item(
            "small_canvas",
            "box",
            (0.30, 0.42),
            size=(0.12, 0.10, 0.01),
            label="canvas",
            color="white",
        ),
        item(
            "large_canvas",
            "box",
            (0.28, -0.40),
            size=(0.24, 0.20, 0.01),
            label="canvas",
            color="white",
        ),
        item("rack", "shelf", (0.66, -0.05), size=(0.25, 0.30, 0.4), boards=("lower", "upper")),
        drawers("cart", (0.66, 0.46), {"top": 0.0, "middle": 0.9, "bottom": 0.0}, color="gray"),
        cabinet("locker", (0.66, -0.46), 0.9, color="blue"),
    )


def canteen() -> SceneState:
    """Two trays, three spoons of growing length, bowls, teacups, a rack, a sideboard of drawers."""
    return scene(
        item("red_tray", "box", (0.32, 0.30), size=(0.26, 0.20, 0.02), color="red"),
        item("green_tray", "box", (0.32, -0.32), size=(0.26, 0.20, 0.02), color="green"),
        item(
            "sugar",
            "box",
            (0.30, 0.32),
            size=(0.06, 0.04, 0.08),
            label="sugar box",
            color="white",
            on="red_tray",
            z=0.2,
        ),
        item("spoon_1", "pen", (0.25, 0.10), size=(0.12, 0.02, 0.02), label="spoon", color="gray"),
        item("spoon_2", "pen", (0.25, 0.00), size=(0.16, 0.02, 0.02), label="spoon", color="gray"),
        item("spoon_3", "pen", (0.25, -0.12), size=(0.20, 0.02, 0.02), label="spoon", color="gray"),
        item("soup_bowl", "bowl", (0.42, 0.08), size=BOWL, color="white"),
        ball("lemon", (0.42, 0.08), on="soup_bowl", inside="soup_bowl", color="yellow", z=0.17),
        item("salad_bowl", "bowl", (0.42, -0.12), size=(0.20, 0.20, 0.08), color="green"),
        cup("teapot", (0.55, 0.15), size=(0.12, 0.12, 0.14), color="blue"),
        cup("teacup_1", (0.55, -0.02), size=(0.08, 0.08, 0.06), label="teacup", color="white"),
        cup("teacup_2", (0.55, -0.18), size=(0.08, 0.08, 0.06), label="teacup", color="white"),
        item("rack", "shelf", (0.68, -0.42), size=(0.25, 0.30, 0.4), boards=("lower", "upper")),
        item(
            "jar",
            "cylinder",
            (0.68, -0.42),
            size=(0.06, 0.06, 0.1),
            on="rack.lower",
            color="red",
            z=0.3,
        ),
        cabinet("cupboard", (0.68, 0.05), 0.0, color="brown"),
        drawers("sideboard", (0.68, 0.45), {"upper": 0.9, "lower": 0.0}, color="white"),
        item(
            "napkin",
            "box",
            (0.60, 0.42),
            size=(0.10, 0.10, 0.01),
            on="sideboard",
            inside="sideboard.upper",
            color="white",
        ),
    )


def study() -> SceneState:
    """A letter on an envelope, scissors in one of two mugs, erasers, a letter tray, a cabinet."""
    return scene(
        item("pencil_case", "bowl", (0.30, 0.30), size=(0.22, 0.10, 0.05), color="blue"),
        item("envelope", "box", (0.30, 0.05), size=(0.22, 0.11, 0.005), color="white"),
        item(
            "letter",
            "box",
            (0.30, 0.05),
            size=(0.20, 0.10, 0.003),
            on="envelope",
            color="white",
            z=0.14,
        ),
        item("sticky_notes", "box", (0.30, -0.15), size=(0.08, 0.08, 0.02), color="yellow"),
        item("glue_stick", "cylinder", (0.40, 0.20), size=(0.03, 0.03, 0.10), color="white"),
        cup("black_mug", (0.42, -0.05), color="black"),
        item(
            "scissors",
            "capsule",
            (0.42, -0.05),
            size=(0.15, 0.05, 0.01),
            on="black_mug",
            inside="black_mug",
            color="red",
            z=0.2,
        ),
        cup("white_mug", (0.42, -0.25), color="white"),
        item("laptop", "box", (0.55, 0.05), size=(0.32, 0.22, 0.02), color="gray"),
        item(
            "letter_tray",
            "shelf",
            (0.66, -0.35),
            size=(0.25, 0.33, 0.20),
            boards=("lower", "upper"),
        ),
        drawers("filing_cabinet", (0.66, 0.40), {"top": 0.0, "bottom": 0.9}, color="gray"),
        item("pink_eraser", "box", (0.25, -0.30), size=(0.04, 0.02, 0.015), color="pink"),
        item("white_eraser", "box", (0.25, -0.40), size=(0.04, 0.02, 0.015), color="white"),
        item("ruler", "capsule", (0.36, -0.36), size=(0.20, 0.02, 0.01), color="yellow"),
    )


def toys() -> SceneState:
    """Blocks, one of them in the open drawer, two cars, a duck on a tray, a teddy on a shelf."""
    return scene(
        item("red_block", "box", (0.30, 0.25), size=CUBE, color="red"),
        item("blue_block", "box", (0.30, 0.10), size=CUBE, color="blue"),
        drawers("drawer", (0.62, 0.10), {"main": 0.9}, color="brown"),
        item(
            "pink_block", "box", (0.55, 0.10), size=CUBE, on="drawer", inside="drawer", color="pink"
        ),
        item("tray", "box", (0.42, -0.15), size=(0.25, 0.18, 0.02), color="green"),
        item(
            "duck",
            "sphere",
            (0.40, -0.12),
            size=(0.05, 0.05, 0.05),
            on="tray",
            color="yellow",
            label="rubber duck",
            z=0.17,
        ),
        item(
            "green_car",
            "box",
            (0.30, -0.05),
            size=(0.10, 0.05, 0.04),
            label="toy car",
            color="green",
        ),
        item(
            "blue_car", "box", (0.30, -0.30), size=(0.10, 0.05, 0.04), label="toy car", color="blue"
        ),
        item("basket", "bowl", (0.48, 0.38), size=(0.22, 0.22, 0.10), color="brown"),
        item("shelf", "shelf", (0.66, -0.40), size=(0.25, 0.30, 0.4), boards=("lower", "upper")),
        item(
            "teddy",
            "box",
            (0.66, -0.40),
            size=(0.08, 0.08, 0.12),
            label="teddy bear",
            color="brown",
            on="shelf.upper",
            z=0.5,
        ),
    )


def garage() -> SceneState:
    """Three batteries alike, tools, pliers in a toolbox, bins, paint cans, a cart of drawers."""
    return scene(
        item(
            "battery_1",
            "cylinder",
            (0.25, 0.30),
            size=(0.03, 0.03, 0.06),
            label="battery",
            color="black",
        ),
        item(
            "battery_2",
            "cylinder",
            (0.25, 0.15),
            size=(0.03, 0.03, 0.06),
            label="battery",
            color="black",
        ),
        item(
            "battery_3",
            "cylinder",
            (0.25, 0.00),
            size=(0.03, 0.03, 0.06),
            label="battery",
            color="black",
        ),
        item(
            "flat_driver",
            "pen",
            (0.30, -0.15),
            size=(0.18, 0.02, 0.02),
            label="flathead screwdriver",
            color="yellow",
        ),
        item(
            "cross_driver",
            "pen",
            (0.30, -0.30),
            size=(0.18, 0.02, 0.02),
            label="phillips screwdriver",
            color="red",
        ),
        item("toolbox", "bowl", (0.45, 0.30), size=(0.25, 0.18, 0.10), color="gray"),
        item(
            "pliers",
            "box",
            (0.45, 0.30),
            size=(0.12, 0.05, 0.02),
            on="toolbox",
            inside="toolbox",
            color="orange",
            z=0.17,
        ),
        item("small_bin", "bowl", (0.45, 0.05), size=(0.12, 0.12, 0.06), label="bin", color="red"),
        item(
            "large_bin", "bowl", (0.45, -0.20), size=(0.18, 0.18, 0.08), label="bin", color="blue"
        ),
        item(
            "paint_1",
            "cylinder",
            (0.58, 0.15),
            size=(0.10, 0.10, 0.12),
            label="paint can",
            color="green",
        ),
        item(
            "paint_2",
            "cylinder",
            (0.58, -0.05),
            size=(0.10, 0.10, 0.12),
            label="paint can",
            color="white",
        ),
        item("lid", "cylinder", (0.45, -0.42), size=(0.10, 0.10, 0.01), color="gray"),
        drawers("cart", (0.68, -0.35), {"upper": 0.0, "lower": 0.0}, color="black"),
    )


def hallway() -> SceneState:
    """A unit called "drawer" with three, the bottom one open, and furniture of everyday names."""
    return scene(
        drawers("drawer", (0.60, 0.40), {"top": 0.0, "middle": 0.0, "bottom": 0.9}, color="brown"),
        item("block", "box", (0.47, 0.38), size=CUBE, on="drawer", inside="drawer.bottom",
             color="yellow"),
        item("tin", "cylinder", (0.30, 0.00), size=(0.06, 0.06, 0.08), color="blue"),
        item("novel", "box", (0.30, -0.20), size=(0.15, 0.10, 0.02), color="green"),
        item("cubby", "shelf", (0.68, -0.05), size=(0.25, 0.30, 0.4), boards=("low", "high")),
        cabinet("cooler", (0.65, -0.42), 0.0, label="refrigerator", color="white"),
        item("waste", "bowl", (0.35, -0.45), size=(0.18, 0.18, 0.14), label="trash can"),
    )  # fmt: skip


def cottage() -> SceneState:
    """Silverware drawers, both open, with a spoon and a fork, and a nightstand with a lamp on."""
    return scene(
        drawers("hutch", (0.60, 0.40), {"top": 0.9, "bottom": 0.9}, label="silverware drawers"),
        item("spoon", "pen", (0.47, 0.38), size=(0.15, 0.02, 0.01), on="hutch",
             inside="hutch.top"),
        item("knife", "pen", (0.47, 0.42), size=(0.15, 0.02, 0.01), on="hutch",
             inside="hutch.top"),
        item("fork", "pen", (0.47, 0.36), size=(0.15, 0.02, 0.01), on="hutch",
             inside="hutch.bottom"),
        drawers("night_stand", (0.60, -0.40), {"top": 0.0, "bottom": 0.0}, label="nightstand"),
        item("lamp", "cylinder", (0.60, -0.40), size=(0.08, 0.08, 0.15), on="night_stand", z=0.355),
        item("clock", "box", (0.35, -0.10), size=(0.08, 0.04, 0.08), label="alarm clock"),
        cabinet("closet", (0.68, 0.0), 0.0, size=(0.2, 0.3, 0.4), color="brown"),
    )  # fmt: skip


def archive() -> SceneState:
    """Books upon each other and one apart, a can that lies, rods, two cups alike, a shelf."""
    info, lying = item("can", "cylinder", (0.30, -0.20), size=(0.06, 0.06, 0.12), color="red")
    return scene(
        item("low_book", "box", (0.40, 0.20), label="red book", color="red",
             size=(0.2, 0.14, 0.03)),
        item("mid_book", "box", (0.40, 0.20), label="blue book", color="blue", on="low_book",
             size=(0.2, 0.14, 0.03), z=0.175),
        item("high_book", "box", (0.40, 0.20), label="green book", color="green", on="mid_book",
             size=(0.2, 0.14, 0.03), z=0.205),
        item("lone_book", "box", (0.30, -0.40), label="white book", color="white",
             size=(0.2, 0.14, 0.03)),
        (info, replace(lying, toppled=True)),
        item("chisel", "pen", (0.25, 0.40), size=(0.18, 0.02, 0.02), color="gray"),
        item("crayon", "pen", (0.25, 0.45), size=(0.10, 0.01, 0.01), color="blue"),
        cup("cup", (0.50, -0.05), color="blue"),
        cup("cup_2", (0.55, -0.25), label="cup", color="blue"),
        item("coin", "cylinder", (0.50, -0.05), size=(0.02, 0.02, 0.003), on="cup", inside="cup"),
        item("die", "box", (0.55, -0.25), size=(0.02, 0.02, 0.02), on="cup_2", inside="cup_2"),
        item("shelf", "shelf", (0.68, 0.0), size=(0.25, 0.30, 0.4), boards=("low", "mid", "high")),
        item("vase", "cup", (0.68, 0.05), size=(0.06, 0.06, 0.1), on="shelf.low", color="white"),
        item("clock", "box", (0.68, -0.05), size=(0.06, 0.06, 0.1), on="shelf.mid"),
        item("basket", "bowl", (0.45, 0.45), size=(0.24, 0.24, 0.10)),
    )  # fmt: skip


def lounge() -> SceneState:
    """Things with a word before their noun: two remote controls, a paper clip, a trash can, ..."""
    return scene(
        item(
            "remote_1", "box", (0.30, 0.36), size=(0.14, 0.04, 0.02), label="remote control",
            color="black",
        ),
        item(
            "remote_2", "box", (0.30, 0.28), size=(0.14, 0.04, 0.02), label="remote control",
            color="white",
        ),
        item(
            "pills_1", "cylinder", (0.42, 0.02), size=(0.05, 0.05, 0.09), label="pill bottle",
            on="tray", z=0.2,
        ),
        item("pills_2", "cylinder", (0.30, 0.12), size=(0.05, 0.05, 0.07), label="pill bottle"),
        item("bear", "capsule", (0.30, 0.02), size=(0.14, 0.06, 0.06), label="teddy bear"),
        item("clip", "box", (0.30, -0.08), size=(0.04, 0.02, 0.01), label="paper clip"),
        item("pudding", "box", (0.30, -0.16), size=(0.08, 0.05, 0.03), label="chocolate pudding"),
        item("key", "box", (0.30, -0.24), size=(0.06, 0.03, 0.01), label="car key"),
        item("sq", "box", (0.48, 0.30), size=(0.14, 0.14, 0.01), label="target square"),
        item("tray", "box", (0.48, 0.02), size=(0.20, 0.26, 0.02), color="gray"),
        item(
            "bandage", "cylinder", (0.48, 0.06), size=(0.06, 0.06, 0.04), on="tray", color="white",
            z=0.2,
        ),
        item("mask", "box", (0.48, -0.04), size=(0.10, 0.07, 0.01), on="tray", z=0.2),
        item("bin", "bowl", (0.50, -0.32), size=(0.18, 0.18, 0.14), label="trash can"),
        cup("mug", (0.32, -0.40), label="tea mug", color="green"),
        drawers("dresser", (0.66, 0.40), {"top": 0.9, "bottom": 0.0}, color="brown"),
    )  # fmt: skip


def grocer() -> SceneState:
    """Fruit on the desk and in a bowl, a vegetable, milk, a bar, a toy car, a plate, a basket."""
    return scene(
        item(
            "basket", "bowl", (0.55, 0.30), size=(0.24, 0.24, 0.10), label="basket", color="brown"
        ),
        item("bowl", "bowl", (0.55, -0.10), size=(0.16, 0.16, 0.06), label="bowl", color="white"),
        ball("pear", (0.55, -0.10), on="bowl", inside="bowl", color="green", z=0.17),
        ball("peach_1", (0.35, 0.20), label="peach", color="orange"),
        ball("peach_2", (0.35, 0.05), label="peach", color="red"),
        ball("leek", (0.35, -0.10), color="green"),
        item("milk", "box", (0.35, -0.22), size=(0.05, 0.05, 0.12), label="milk carton"),
        item("car", "box", (0.35, -0.34), size=(0.08, 0.04, 0.03), label="racing car"),
        item("plate", "cylinder", (0.55, -0.35), size=(0.2, 0.2, 0.015), color="white"),
        item("mug", "cup", (0.35, 0.36), size=(0.08, 0.08, 0.09), label="coffee mug"),
        item("zingo", "box", (0.25, 0.0), size=(0.09, 0.03, 0.02), label="zingo strawberry"),
    )


def post_room() -> SceneState:
    """Trays called in and out, lettered blocks, two rulers, a stapler, a flat board, a flask."""
    return scene(
        item("in_tray", "box", (0.30, 0.30), size=(0.24, 0.20, 0.02), label="in tray"),
        item("out_tray", "box", (0.30, -0.30), size=(0.24, 0.20, 0.02), label="out tray"),
        item("a", "box", (0.45, 0.10), size=CUBE, label="block A", color="red"),
        item("b", "box", (0.45, 0.00), size=CUBE, label="block B", color="green"),
        item("c", "box", (0.45, -0.10), size=CUBE, label="block C", color="blue"),
        item("ruler_1", "box", (0.55, 0.15), size=(0.20, 0.03, 0.01), label="ruler"),
        item("ruler_2", "box", (0.55, -0.15), size=(0.10, 0.03, 0.01), label="ruler"),
        item("stapler", "box", (0.30, 0.00), size=(0.12, 0.04, 0.05), color="black"),
        item("board", "box", (0.65, 0.30), size=(0.20, 0.16, 0.02), color="brown"),
        item("flask", "cylinder", (0.65, -0.30), size=(0.05, 0.05, 0.15), color="white"),
    )


def craft_table() -> SceneState:
    """Balls of one stuff, a basket for it, and a box and a dish that are called after others."""
    return scene(
        ball("wool_r", (0.30, 0.30), label="wool ball", color="red"),
        ball("wool_b", (0.30, 0.20), label="wool ball", color="blue"),
        item("basket", "bowl", (0.48, 0.30), size=(0.20, 0.20, 0.10), label="wool basket"),
        item("tray", "box", (0.48, 0.02), size=(0.20, 0.26, 0.02), color="gray"),
        item("soap", "box", (0.30, 0.05), size=(0.08, 0.05, 0.03), label="bar of soap"),
        item("dish", "bowl", (0.30, -0.10), size=(0.12, 0.12, 0.03), label="soap dish"),
        item("pencil", "pen", (0.30, -0.22), size=(0.15, 0.01, 0.01), color="yellow"),
        item("pencil_box", "bowl", (0.48, -0.25), size=(0.20, 0.10, 0.06)),
        item("shoe_box", "bowl", (0.48, -0.42), size=(0.24, 0.14, 0.10)),
        item("comb", "box", (0.30, -0.32), size=(0.14, 0.03, 0.01), label="barber's comb"),
    )  # fmt: skip


def sideboard() -> SceneState:
    """Two drawers beside each other, the right one open, a coaster, a torch, three mats."""
    return scene(
        drawers("sideboard", (0.62, 0.10), {"left": 0.0, "right": 0.9}, color="brown"),
        item("torch", "cylinder", (0.35, 0.20), size=(0.04, 0.04, 0.12), color="black"),
        item("coaster", "box", (0.30, -0.25), size=(0.10, 0.10, 0.01), color="green"),
        item("mat", "box", (0.42, 0.30), size=FLAT, label="blue mat", color="blue"),
        item("mat_2", "box", (0.42, -0.10), size=FLAT, label="red mat", color="red"),
        item("mat_3", "box", (0.42, -0.35), size=FLAT, label="gray mat", color="gray"),
    )


def break_room() -> SceneState:
    """Cans, one of them for trash; a glass and reading glasses; a tray with two things on it."""
    return scene(
        item("waste", "bowl", (0.60, -0.40), size=(0.18, 0.18, 0.14), label="garbage can"),
        item("bin", "bowl", (0.60, 0.45), size=(0.18, 0.18, 0.14), label="recycling bin"),
        item("cola", "cylinder", (0.30, 0.45), size=(0.06, 0.06, 0.11), label="cola can"),
        item("can_2", "cylinder", (0.30, 0.35), size=(0.06, 0.06, 0.11), label="tuna can"),
        cup("goblet", (0.30, 0.22), label="wine glass"),
        item("specs", "box", (0.30, 0.10), size=(0.07, 0.04, 0.02), label="reading glasses"),
        item("tray", "box", (0.60, 0.05), size=(0.24, 0.30, 0.02), color="brown"),
        cup("jug", (0.60, 0.12), on="tray"),
        item("saucer", "cylinder", (0.60, -0.02), size=(0.10, 0.10, 0.01), on="tray"),
        item("shelf", "box", (0.78, 0.05), size=(0.20, 0.40, 0.05), mass=9, label="window sill"),
        item("plate_1", "cylinder", (0.42, -0.20), size=(0.14, 0.14, 0.015), label="plate"),
        item("plate_2", "cylinder", (0.42, -0.45), size=(0.14, 0.14, 0.015), label="plate"),
        item("fork_1", "box", (0.28, -0.12), size=(0.14, 0.02, 0.01), label="fork"),
        item("fork_2", "box", (0.28, -0.30), size=(0.14, 0.02, 0.01), label="fork"),
    )  # fmt: skip


def greenhouse() -> SceneState:
    """A bench with a pot on its left side and one beside it, two crates, one of them not empty."""
    return scene(
        item("bench", "box", (0.55, -0.20), size=(0.20, 0.34, 0.03), color="brown"),
        cup("pot_1", (0.55, -0.10), size=(0.07, 0.07, 0.08), label="pot", on="bench", z=0.2),
        cup("pot_2", (0.50, 0.06), size=(0.07, 0.07, 0.08), label="pot"),
        item("crate_1", "bowl", (0.60, 0.48), size=(0.20, 0.20, 0.10), label="crate A"),
        item("crate_2", "bowl", (0.60, 0.25), size=(0.20, 0.20, 0.10), label="crate B"),
        item("bulb", "sphere", (0.60, 0.48), size=(0.04,) * 3, on="crate_1", inside="crate_1"),
        item("label", "box", (0.30, 0.10), size=(0.06, 0.03, 0.005), label="plant label"),
        item("seeds", "box", (0.30, 0.25), size=(0.05, 0.05, 0.04), label="seed box"),
        item("tile", "box", (0.30, -0.02), size=(0.15, 0.15, 0.01), color="red"),
        item("mat", "box", (0.30, -0.42), size=(0.20, 0.26, 0.01), color="green"),
        item("shears", "box", (0.30, -0.20), size=(0.18, 0.05, 0.02), label="shears"),
        item("twine", "box", (0.18, 0.00), size=CUBE, label="twine", color="orange"),
        ball("orange_1", (0.18, 0.20), label="orange", color="orange"),
        ball("orange_2", (0.18, -0.20), label="orange", color="orange"),
        item("in_tray", "box", (0.62, -0.52), size=FLAT, label="in tray"),
        item("spade", "box", (0.62, -0.52), size=(0.12, 0.05, 0.01), on="in_tray", z=0.16),
        item("flask_1", "cylinder", (0.30, 0.40), size=(0.06, 0.06, 0.2), label="water bottle"),
    )


def block_field() -> SceneState:
    """Blocks of four colours all over the desk, two of them side by side."""
    places = {
        "green": ((0.22, -0.05), (0.45, 0.065), (0.62, 0.35)),
        "blue": ((0.30, -0.05), (0.45, 0.02), (0.35, 0.35)),
        "yellow": ((0.40, -0.30), (0.60, 0.05), (0.30, 0.20)),
        "orange": ((0.48, -0.30), (0.55, 0.25)),
    }
    return scene(
        *(
            item(f"{color}_{number}", "box", at, size=CUBE, color=color, label=f"{color} block")
            for color, found in places.items()
            for number, at in enumerate(found, 1)
        )
    )


def strongroom() -> SceneState:
    """Three cups, a steak on a grill, a jar and its lid, a safe with boards, an open drawer."""
    return scene(
        cup("red_cup", (0.30, 0.20), color="red"),
        cup("blue_cup", (0.30, 0.00), color="blue"),
        cup("green_cup", (0.30, -0.20), color="green"),
        item("grill", "box", (0.50, 0.00), size=(0.25, 0.20, 0.06)),
        item("steak", "box", (0.50, 0.00), size=(0.08, 0.06, 0.02), on="grill", z=0.2),
        cup("jar", (0.45, 0.35), size=(0.08, 0.08, 0.10), color="gray"),
        item("lid", "cylinder", (0.30, 0.40), size=(0.08, 0.08, 0.02)),
        item("money", "box", (0.25, -0.40), size=(0.10, 0.05, 0.02), label="bank notes"),
        item("safe", "shelf", (0.70, 0.40), size=(0.30, 0.30, 0.40),
             boards=("bottom", "middle", "top")),
        drawers("drawer", (0.65, -0.40), {"top": 0.9}),
    )  # fmt: skip


def tea_table() -> SceneState:
    """Cups in two sizes, two saucers, forks in a caddy, vials by name."""
    return scene(
        cup("cup_1", (0.30, 0.40), size=(0.06, 0.06, 0.07), label="cup", color="white"),
        cup("cup_2", (0.30, 0.28), size=(0.0604, 0.06, 0.07), label="cup", color="blue"),
        cup("cup_3", (0.30, 0.14), size=(0.09, 0.09, 0.1), label="cup", color="white"),
        cup("cup_4", (0.30, 0.00), size=(0.0905, 0.09, 0.1), label="cup", color="blue"),
        item("saucer_1", "cylinder", (0.45, 0.40), size=(0.12, 0.12, 0.01), label="saucer"),
        item("saucer_2", "cylinder", (0.45, 0.25), size=(0.12, 0.12, 0.01), label="saucer"),
        item("caddy", "bowl", (0.60, 0.35), size=(0.20, 0.12, 0.10), color="brown"),
        item("fork_1", "pen", (0.60, 0.33), size=(0.16, 0.02, 0.01), label="fork", on="caddy",
             inside="caddy", z=0.16),
        item("fork_2", "pen", (0.60, 0.37), size=(0.16, 0.02, 0.01), label="fork", on="caddy",
             inside="caddy", z=0.16),
        item("napkin", "box", (0.60, 0.35), size=(0.18, 0.10, 0.005), on="caddy", inside="caddy",
             z=0.15),
        item("spoon", "pen", (0.25, -0.12), size=(0.16, 0.03, 0.02), color="gray"),
        item("rack", "box", (0.50, 0.02), size=(0.20, 0.20, 0.03), color="gray"),
        item("vial_a", "cylinder", (0.40, -0.15), size=(0.03, 0.03, 0.08), label="vial A"),
        item("vial_b", "cylinder", (0.48, 0.00), size=(0.03, 0.03, 0.08), label="vial B",
             on="rack", z=0.2),
        item("vial_c", "cylinder", (0.48, -0.15), size=(0.03, 0.03, 0.08), label="vial C"),
        item("tray", "box", (0.55, -0.40), size=(0.26, 0.20, 0.02), color="black"),
    )  # fmt: skip


def work_cell() -> SceneState:
    """Bolts on a tray and in a bin, parts and tools by it."""
    return scene(
        item("red_bin", "bowl", (0.55, 0.32), size=(0.18, 0.18, 0.09), color="red"),
        item("blue_bin", "bowl", (0.55, -0.32), size=(0.18, 0.18, 0.09), color="blue"),
        item("tray", "box", (0.60, 0.00), size=(0.2, 0.28, 0.015), color="gray"),
        item("bolt_1", "cylinder", (0.60, 0.08), size=(0.03, 0.03, 0.05), color="gray",
             label="bolt", on="tray"),
        item("bolt_2", "cylinder", (0.60, -0.08), size=(0.03, 0.03, 0.05), color="gray",
             label="bolt", on="tray"),
        item("bolt_3", "cylinder", (0.55, -0.32), size=(0.03, 0.03, 0.05), color="gray",
             label="bolt", on="blue_bin", inside="blue_bin"),
        item("gear", "cylinder", (0.38, 0.20), size=(0.07, 0.07, 0.03), color="yellow"),
        item("bracket", "box", (0.38, -0.20), size=(0.06, 0.05, 0.04), color="black"),
        item("screwdriver", "pen", (0.32, 0.00), size=(0.03, 0.16, 0.03), color="orange"),
        cup("holder", (0.30, 0.40), size=(0.09, 0.09, 0.11), color="white"),
        item("marker", "pen", (0.30, 0.40), size=(0.015, 0.015, 0.13), color="green",
             on="holder", inside="holder"),
    )  # fmt: skip


def fruit_counter() -> SceneState:
    """Fruit on a plate and in a bowl, a mug in a closed microwave."""
    return scene(
        cabinet("microwave", (0.66, 0.29), 0.0, color="gray"),
        cup("yellow_mug", (0.66, 0.29), size=(0.09, 0.09, 0.09), color="yellow", on="microwave",
             inside="microwave"),
        item("plate", "box", (0.43, 0.03), size=(0.22, 0.22, 0.02), color="white"),
        item("lemon", "sphere", (0.43, 0.09), size=(0.055, 0.055, 0.055), color="yellow",
             on="plate"),
        item("red_bowl", "bowl", (0.42, -0.18), size=(0.18, 0.18, 0.07), color="red"),
        item("blue_bowl", "bowl", (0.42, -0.37), size=(0.18, 0.18, 0.07), color="blue"),
        item("orange", "sphere", (0.42, -0.37), size=(0.07, 0.07, 0.07), color="orange",
             on="blue_bowl", inside="blue_bowl"),
        item("apple", "sphere", (0.27, -0.08), size=(0.07, 0.07, 0.07), color="red"),
        item("banana", "capsule", (0.27, 0.10), size=(0.04, 0.15, 0.04), color="yellow"),
        cup("red_mug", (0.61, 0.00), size=(0.09, 0.09, 0.09), color="red"),
        cup("blue_mug", (0.61, -0.24), size=(0.09, 0.09, 0.09), color="blue"),
    )  # fmt: skip


def snack_bar() -> SceneState:
    """An open fridge, a closed drawer, two bins, things of no known pack."""
    return scene(
        cabinet("fridge", (0.67, -0.32), 0.95, color="white"),
        item("milk", "box", (0.67, -0.32), size=(0.07, 0.07, 0.16), color="white", on="fridge",
             inside="fridge"),
        drawers("drawer", (0.67, 0.33), {"top": 0.0}, color="brown"),
        item("spoon", "box", (0.67, 0.33), size=(0.14, 0.03, 0.015), color="gray", on="drawer",
             inside="drawer"),
        item("trash_bin", "bowl", (0.63, 0.10), size=(0.16, 0.16, 0.14), color="gray"),
        item("lemonade_can", "cylinder", (0.63, 0.10), size=(0.06, 0.06, 0.11), color="green",
             on="trash_bin", inside="trash_bin"),
        item("recycling_bin", "bowl", (0.63, -0.09), size=(0.16, 0.16, 0.14), color="blue"),
        item("book", "box", (0.44, 0.02), size=(0.14, 0.2, 0.03), color="purple"),
        item("remote", "box", (0.48, 0.02), size=(0.04, 0.12, 0.02), color="black", on="book"),
        item("coke_can", "cylinder", (0.27, 0.24), size=(0.06, 0.06, 0.11), color="red"),
        item("sponge", "box", (0.29, -0.11), size=(0.07, 0.1, 0.03), color="yellow"),
    )  # fmt: skip


def tower_table() -> SceneState:
    """Blocks, one on another, cups of their colours, a car on a shelf."""
    return scene(
        item("shelf", "shelf", (0.66, 0.28), boards=("lower", "upper",), size=(0.22, 0.34, 0.4),
             color="brown"),
        item("toy_car", "box", (0.66, 0.28), size=(0.1, 0.05, 0.05), color="red", on="shelf.upper"),
        item("red_block", "box", (0.30, 0.02), size=(0.045, 0.045, 0.045), color="red"),
        item("yellow_block", "box", (0.30, 0.02), size=(0.045, 0.045, 0.045), color="yellow",
             on="red_block"),
        item("green_block", "box", (0.28, -0.15), size=(0.045, 0.045, 0.045), color="green"),
        item("blue_block", "box", (0.46, -0.02), size=(0.045, 0.045, 0.045), color="blue"),
        item("tray", "box", (0.39, 0.24), size=(0.24, 0.18, 0.02), color="black"),
        item("basket", "bowl", (0.44, -0.34), size=(0.2, 0.2, 0.1), color="brown"),
        item("ball", "sphere", (0.44, -0.34), size=(0.055, 0.055, 0.055), color="yellow",
             on="basket", inside="basket"),
        cup("green_cup", (0.61, -0.09), size=(0.08, 0.08, 0.09), color="green"),
        cup("purple_cup", (0.62, -0.26), size=(0.1, 0.1, 0.1), color="purple"),
    )  # fmt: skip


def kids_room() -> SceneState:
    """A pile of blocks, a toy box, an open drawer with a car in it."""
    return scene(
        item("toy_box", "bowl", (0.55, 0.30), size=(0.24, 0.24, 0.12), color="green"),
        drawers("dresser", (0.62, -0.30), {"top": 0.9, "bottom": 0.0}, color="white"),
        item("teddy", "box", (0.55, 0.30), size=(0.07, 0.06, 0.09), color="brown", on="toy_box",
             inside="toy_box"),
        item("red_block", "box", (0.60, 0.02), size=(0.05, 0.05, 0.05), color="red"),
        item("blue_block", "box", (0.60, 0.02), size=(0.05, 0.05, 0.05), color="blue",
             on="red_block"),
        item("yellow_block", "box", (0.32, 0.27), size=(0.05, 0.05, 0.05), color="yellow"),
        item("ball", "sphere", (0.29, -0.08), size=(0.07, 0.07, 0.07), color="orange"),
        item("book", "box", (0.42, 0.06), size=(0.16, 0.2, 0.02), color="purple"),
        item("red_car", "box", (0.42, 0.06), size=(0.1, 0.05, 0.04), color="red", on="book"),
        item("blue_car", "box", (0.42, -0.30), size=(0.1, 0.05, 0.04), color="blue",
             on="dresser", inside="dresser.top"),
        item("crayon", "pen", (0.30, 0.15), size=(0.015, 0.1, 0.015), color="pink"),
    )  # fmt: skip


def block_lab() -> SceneState:
    """Blocks and bowls of their colours, two blocks of one colour, a tray, a cup."""
    return scene(
        item("red_block", "box", (0.32, 0.26), size=(0.045, 0.045, 0.045), color="red"),
        item("green_block", "box", (0.32, 0.12), size=(0.045, 0.045, 0.045), color="green"),
        item("large_blue_block", "box", (0.34, -0.06), size=(0.07, 0.07, 0.07), color="blue"),
        item("small_blue_block", "box", (0.33, -0.20), size=(0.035, 0.035, 0.035), color="blue"),
        item("yellow_block", "box", (0.56, 0.05), size=(0.045, 0.045, 0.045), color="yellow",
             on="green_bowl", inside="green_bowl"),
        item("red_bowl", "bowl", (0.56, 0.28), size=(0.17, 0.17, 0.06), color="red"),
        item("green_bowl", "bowl", (0.56, 0.05), size=(0.17, 0.17, 0.06), color="green"),
        item("blue_bowl", "bowl", (0.56, -0.17), size=(0.17, 0.17, 0.06), color="blue"),
        item("white_tray", "box", (0.44, -0.35), size=(0.24, 0.18, 0.02), color="white"),
        cup("purple_cup", (0.40, 0.39), size=(0.09, 0.09, 0.1), color="purple"),
    )  # fmt: skip


def cup_lab() -> SceneState:
    """Three cups in a row, cans on a tray, a bowl in a microwave."""
    return scene(
        cup("cup_1", (0.32, 0.28), size=(0.08, 0.08, 0.1), color="white", label="paper cup"),
        cup("cup_2", (0.32, 0.12), size=(0.08, 0.08, 0.1), color="white", label="paper cup"),
        cup("cup_3", (0.32, -0.04), size=(0.08, 0.08, 0.1), color="white", label="paper cup"),
        item("strawberry", "sphere", (0.32, 0.12), size=(0.035, 0.035, 0.035), color="red",
             on="cup_2", inside="cup_2"),
        item("plum", "sphere", (0.43, 0.05), size=(0.05, 0.05, 0.05), color="purple"),
        item("tray", "box", (0.52, 0.29), size=(0.24, 0.28, 0.02), color="black"),
        item("tomato_can", "cylinder", (0.58, 0.38), size=(0.07, 0.07, 0.1), color="red",
             on="tray"),
        item("bean_can", "cylinder", (0.58, 0.29), size=(0.07, 0.07, 0.1), color="green",
             on="tray"),
        item("crate", "bowl", (0.59, 0.03), size=(0.2, 0.2, 0.1), color="brown"),
        cabinet("microwave", (0.60, -0.30), 0.95, color="black"),
        item("yellow_bowl", "bowl", (0.60, -0.30), size=(0.12, 0.12, 0.05), color="yellow",
             on="microwave", inside="microwave"),
    )  # fmt: skip


def hobby_bench() -> SceneState:
    """Paints, brushes, a locomotive on a mat, a chest with an open drawer."""
    return scene(
        drawers("parts_chest", (0.60, -0.30), {"top": 0.0, "bottom": 0.9}, color="gray"),
        item("pliers", "box", (0.60, -0.30), size=(0.13, 0.05, 0.02), color="black",
             on="parts_chest", inside="parts_chest.top"),
        item("glue", "cylinder", (0.45, -0.30), size=(0.035, 0.035, 0.07), color="yellow",
             on="parts_chest", inside="parts_chest.bottom"),
        item("red_paint", "cylinder", (0.36, 0.25), size=(0.045, 0.045, 0.05), color="red"),
        item("blue_paint", "cylinder", (0.36, 0.36), size=(0.045, 0.045, 0.05), color="blue"),
        cup("brush_cup", (0.60, 0.32), size=(0.08, 0.08, 0.1), color="white"),
        item("brush_1", "pen", (0.60, 0.32), size=(0.015, 0.015, 0.17), color="brown",
             label="brush", on="brush_cup", inside="brush_cup"),
        item("brush_2", "pen", (0.52, 0.21), size=(0.17, 0.015, 0.015), color="brown",
             label="brush"),
        item("cutting_mat", "box", (0.36, 0.02), size=(0.2, 0.28, 0.005), color="green"),
        item("locomotive", "box", (0.36, 0.02), size=(0.06, 0.14, 0.07), color="black",
             on="cutting_mat"),
        item("parts_bin", "bowl", (0.63, 0.02), size=(0.18, 0.18, 0.08), color="orange"),
    )  # fmt: skip


def bagel_counter() -> SceneState:
    """A bowl in a microwave, fruit and a bagel, a plate."""
    return scene(
        cabinet("microwave", (0.62, 0.31), 0.0, color="gray"),
        item("green_bowl", "bowl", (0.64, 0.37), size=(0.13, 0.13, 0.06), color="green",
             on="microwave", inside="microwave"),
        cup("red_mug", (0.32, 0.06), size=(0.09, 0.09, 0.09), color="red"),
        cup("blue_mug", (0.32, -0.14), size=(0.09, 0.09, 0.09), color="blue"),
        item("spoon", "pen", (0.32, -0.14), size=(0.02, 0.02, 0.15), color="gray", on="blue_mug",
             inside="blue_mug"),
        item("plate", "box", (0.56, -0.05), size=(0.26, 0.26, 0.015), color="white"),
        item("bagel", "cylinder", (0.56, -0.05), size=(0.08, 0.08, 0.035), color="brown",
             on="plate"),
        item("fruit_bowl", "bowl", (0.60, -0.31), size=(0.2, 0.2, 0.08), color="brown"),
        item("apple", "sphere", (0.60, -0.27), size=(0.07, 0.07, 0.07), color="red",
             on="fruit_bowl", inside="fruit_bowl"),
        item("lemon", "sphere", (0.60, -0.35), size=(0.055, 0.055, 0.055), color="yellow",
             on="fruit_bowl", inside="fruit_bowl"),
        item("banana", "capsule", (0.34, -0.32), size=(0.16, 0.04, 0.04), color="yellow"),
    )  # fmt: skip


def lettered() -> SceneState:
    """Three blocks called by a letter each."""
    return scene(
        item("A", "box", (0.35, 0.20), size=CUBE, color="red"),
        item("B", "box", (0.35, 0.00), size=CUBE, color="blue"),
        item("C", "box", (0.35, -0.20), size=CUBE, color="green"),
        item("tray", "box", (0.55, -0.20), size=(0.2, 0.2, 0.01)),
    )


def pen_desk() -> SceneState:
    """Pens, one of them in a holder, a filing cabinet, an open safe with an envelope."""
    return scene(
        drawers("filing_cabinet", (0.63, 0.34), {"top": 0.0, "bottom": 0.0}, color="gray"),
        item("stapler", "box", (0.63, 0.34), size=(0.12, 0.04, 0.05), color="black",
             on="filing_cabinet", inside="filing_cabinet.top"),
        cabinet("safe", (0.63, -0.34), 0.95, color="black"),
        item("envelope", "box", (0.63, -0.34), size=(0.1, 0.05, 0.015), color="white", on="safe",
             inside="safe"),
        item("notebook", "box", (0.46, 0.12), size=(0.15, 0.09, 0.03), color="red"),
        item("eraser", "box", (0.46, 0.15), size=(0.05, 0.02, 0.015), color="pink", on="notebook"),
        cup("pen_holder", (0.62, -0.02), size=(0.08, 0.08, 0.1), color="black"),
        item("red_pen", "pen", (0.62, -0.02), size=(0.14, 0.012, 0.012), color="red",
             on="pen_holder", inside="pen_holder"),
        item("green_pen", "pen", (0.30, 0.17), size=(0.14, 0.012, 0.012), color="green"),
        item("blue_pen", "pen", (0.30, -0.12), size=(0.14, 0.012, 0.012), color="blue"),
        cup("coffee_cup", (0.28, 0.00), size=(0.075, 0.075, 0.08), color="white"),
    )  # fmt: skip


def playroom() -> SceneState:
    """A chest with a lid, a bookshelf, blocks by the front edge, a ball in a basket."""
    return scene(
        cabinet("toy_chest", (0.63, 0.34), 0.0, color="pink"),
        item("red_car", "box", (0.63, 0.34), size=(0.09, 0.05, 0.04), color="red",
             on="toy_chest", inside="toy_chest"),
        item("bookshelf", "shelf", (0.63, -0.34), boards=("lower", "middle", "upper",),
             size=(0.25, 0.30, 0.40), color="white"),
        item("teddy_bear", "box", (0.63, -0.34), size=(0.06, 0.06, 0.08), color="brown",
             on="bookshelf.middle"),
        item("basket", "bowl", (0.65, 0.03), size=(0.18, 0.18, 0.09), color="brown"),
        item("green_ball", "sphere", (0.65, 0.03), size=(0.05, 0.05, 0.05), color="green",
             on="basket", inside="basket"),
        item("storybook", "box", (0.44, 0.09), size=(0.17, 0.07, 0.03), color="blue"),
        item("blue_block", "box", (0.50, 0.09), size=(0.04, 0.04, 0.04), color="blue",
             on="storybook"),
        item("red_block_1", "box", (0.30, 0.16), size=(0.04, 0.04, 0.04), color="red",
             label="red block"),
        item("yellow_block", "box", (0.26, 0.05), size=(0.045, 0.045, 0.045), color="yellow"),
        item("red_block_2", "box", (0.30, -0.20), size=(0.04, 0.04, 0.04), color="red",
             label="red block"),
    )  # fmt: skip


def mug_shelf() -> SceneState:
    """A bowl in a microwave, cans and jars on a shelf, mugs, fruit."""
    return scene(
        cabinet("microwave", (0.63, 0.32), 0.0, color="gray"),
        item("white_bowl", "bowl", (0.63, 0.32), size=(0.13, 0.13, 0.06), color="white",
             on="microwave", inside="microwave"),
        item("shelf", "shelf", (0.66, -0.32), boards=("lower", "upper",), size=(0.25, 0.30,
             0.40), color="brown"),
        item("coffee_can", "cylinder", (0.66, -0.37), size=(0.07, 0.07, 0.1), color="black",
             on="shelf.upper"),
        item("jam_jar", "cylinder", (0.66, -0.27), size=(0.06, 0.06, 0.08), color="red",
             on="shelf.lower"),
        cup("red_mug", (0.32, 0.05), size=(0.08, 0.08, 0.09), color="red"),
        cup("green_mug", (0.27, -0.27), size=(0.08, 0.08, 0.09), color="green"),
        item("black_bowl", "bowl", (0.29, 0.23), size=(0.14, 0.14, 0.06), color="black"),
        item("lemon", "sphere", (0.29, 0.23), size=(0.05, 0.05, 0.05), color="yellow",
             on="black_bowl", inside="black_bowl"),
        item("apple", "sphere", (0.52, 0.12), size=(0.06, 0.06, 0.06), color="red"),
        item("basket", "bowl", (0.44, -0.12), size=(0.19, 0.19, 0.08), color="brown"),
    )  # fmt: skip


def paper_desk() -> SceneState:
    """Paper balls, pens, sticky notes in a drawer that stands open."""
    return scene(
        drawers("filing_cabinet", (0.63, -0.33), {"top": 0.9, "bottom": 0.0}, color="white"),
        item("sticky_notes", "box", (0.50, -0.33), size=(0.06, 0.06, 0.02), color="pink",
             on="filing_cabinet", inside="filing_cabinet.top"),
        cup("pencil_cup", (0.60, 0.04), size=(0.08, 0.08, 0.1), color="black"),
        item("blue_pen", "pen", (0.60, 0.04), size=(0.14, 0.012, 0.012), color="blue",
             on="pencil_cup", inside="pencil_cup"),
        item("notebook", "box", (0.42, 0.10), size=(0.2, 0.14, 0.02), color="green"),
        item("red_pen", "pen", (0.42, 0.07), size=(0.14, 0.012, 0.012), color="red", on="notebook"),
        item("pencil", "pen", (0.29, 0.24), size=(0.14, 0.01, 0.01), color="yellow"),
        item("stapler", "box", (0.45, -0.12), size=(0.13, 0.04, 0.05), color="orange"),
        item("trash_bin", "bowl", (0.59, 0.34), size=(0.18, 0.18, 0.15), color="gray"),
        item("paper_ball_1", "sphere", (0.38, 0.32), size=(0.05, 0.05, 0.05), color="white",
             label="paper ball"),
        item("paper_ball_2", "sphere", (0.31, -0.22), size=(0.05, 0.05, 0.05), color="white",
             label="paper ball"),
    )  # fmt: skip


def spice_kitchen() -> SceneState:
    """A cabinet with its middle drawer open, tomatoes on a board and on the desk."""
    return scene(
        drawers("kitchen_cabinet", (0.63, -0.32), {"top": 0.0, "middle": 0.9, "bottom": 0.0},
             color="brown", label="cabinet"),
        item("fork", "pen", (0.50, -0.32), size=(0.14, 0.02, 0.015), color="gray",
             on="kitchen_cabinet", inside="kitchen_cabinet.middle"),
        item("knife", "pen", (0.63, -0.32), size=(0.15, 0.02, 0.015), color="gray",
             on="kitchen_cabinet", inside="kitchen_cabinet.top"),
        item("salt_shaker", "cylinder", (0.63, -0.32), size=(0.04, 0.04, 0.07), color="white",
             on="kitchen_cabinet"),
        item("pepper_shaker", "cylinder", (0.30, -0.10), size=(0.04, 0.04, 0.07), color="black"),
        item("frying_pan", "bowl", (0.58, 0.02), size=(0.22, 0.22, 0.05), color="black"),
        item("sponge", "box", (0.58, 0.02), size=(0.09, 0.06, 0.03), color="yellow",
             on="frying_pan", inside="frying_pan"),
        item("cutting_board", "box", (0.40, 0.28), size=(0.18, 0.26, 0.02), color="brown"),
        item("tomato_1", "sphere", (0.40, 0.32), size=(0.06, 0.06, 0.06), color="red",
             label="tomato", on="cutting_board"),
        item("tomato_2", "sphere", (0.30, 0.06), size=(0.06, 0.06, 0.06), color="red",
             label="tomato"),
        cup("green_cup", (0.62, 0.36), size=(0.08, 0.08, 0.1), color="green"),
    )  # fmt: skip


def two_plates() -> SceneState:
    """Plates of two colours, fruit in a basket and on a plate, mugs."""
    return scene(
        item("white_plate", "box", (0.40, 0.24), size=(0.22, 0.22, 0.015), color="white"),
        item("blue_plate", "box", (0.42, -0.28), size=(0.18, 0.18, 0.015), color="blue"),
        item("cereal_bowl", "bowl", (0.40, -0.02), size=(0.14, 0.14, 0.06), color="blue"),
        cup("red_mug_1", (0.60, 0.38), size=(0.1, 0.1, 0.11), color="red", label="red mug"),
        cup("red_mug_2", (0.27, -0.36), size=(0.07, 0.07, 0.07), color="red", label="red mug"),
        item("fruit_basket", "bowl", (0.60, 0.02), size=(0.2, 0.2, 0.08), color="brown"),
        item("green_apple", "sphere", (0.60, 0.02), size=(0.07, 0.07, 0.07), color="green",
             on="fruit_basket", inside="fruit_basket"),
        item("red_apple", "sphere", (0.27, 0.08), size=(0.07, 0.07, 0.07), color="red"),
        item("banana", "capsule", (0.40, 0.29), size=(0.17, 0.04, 0.04), color="yellow",
             on="white_plate"),
        item("spoon", "pen", (0.40, -0.02), size=(0.13, 0.02, 0.015), color="gray",
             on="cereal_bowl", inside="cereal_bowl"),
        item("milk_carton", "box", (0.60, -0.26), size=(0.06, 0.06, 0.16), color="white"),
    )  # fmt: skip


def tower_and_cups() -> SceneState:
    """A tower of three blocks, two green blocks, cups, a tray and a box."""
    return scene(
        item("red_block", "box", (0.42, 0.12), size=(0.05, 0.05, 0.05), color="red"),
        item("blue_block", "box", (0.42, 0.12), size=(0.045, 0.045, 0.045), color="blue",
             on="red_block"),
        item("yellow_block", "box", (0.42, 0.12), size=(0.04, 0.04, 0.04), color="yellow",
             on="blue_block"),
        item("big_green_block", "box", (0.30, -0.06), size=(0.06, 0.06, 0.06), color="green"),
        item("small_green_block", "box", (0.33, 0.28), size=(0.03, 0.03, 0.03), color="green"),
        cup("white_cup", (0.48, -0.12), size=(0.08, 0.08, 0.08), color="white"),
        cup("black_cup", (0.58, 0.04), size=(0.08, 0.08, 0.08), color="black"),
        item("orange_ball", "sphere", (0.58, 0.04), size=(0.035, 0.035, 0.035), color="orange",
             on="black_cup", inside="black_cup"),
        item("purple_ball", "sphere", (0.34, -0.24), size=(0.035, 0.035, 0.035), color="purple"),
        item("tray", "box", (0.58, 0.31), size=(0.22, 0.22, 0.015), color="gray"),
        item("wooden_box", "bowl", (0.58, -0.33), size=(0.18, 0.18, 0.07), color="brown"),
    )  # fmt: skip


def screwdriver_bench() -> SceneState:
    """Screwdrivers, one of them in a drawer that stands open, bins."""
    return scene(
        drawers("tool_chest", (0.63, -0.34), {"top": 0.0, "middle": 0.0, "bottom": 0.9},
             color="red"),
        item("blue_bin", "bowl", (0.56, 0.34), size=(0.17, 0.17, 0.08), color="blue"),
        item("yellow_bin", "bowl", (0.56, 0.08), size=(0.17, 0.17, 0.08), color="yellow"),
        item("bolt", "cylinder", (0.54, 0.31), size=(0.02, 0.02, 0.05), color="gray",
             on="blue_bin", inside="blue_bin"),
        item("nut", "box", (0.58, 0.37), size=(0.03, 0.03, 0.015), color="gray", on="blue_bin",
             inside="blue_bin"),
        item("board", "box", (0.34, 0.14), size=(0.16, 0.22, 0.02), color="brown",
             label="wooden board"),
        item("glue_bottle", "cylinder", (0.37, 0.19), size=(0.05, 0.05, 0.1), color="white",
             on="board"),
        item("red_screwdriver", "pen", (0.28, -0.12), size=(0.15, 0.02, 0.02), color="red"),
        item("yellow_screwdriver", "pen", (0.48, -0.34), size=(0.14, 0.02, 0.02), color="yellow",
             on="tool_chest", inside="tool_chest.bottom"),
        item("tape_measure", "box", (0.44, -0.12), size=(0.06, 0.05, 0.04), color="black"),
        item("pliers", "box", (0.63, -0.34), size=(0.13, 0.05, 0.02), color="black",
             on="tool_chest", inside="tool_chest.top"),
    )  # fmt: skip


def three_cups() -> SceneState:
    """Two cups on a tray and one on the desk, a microwave, a fridge."""
    return scene(
        cabinet("microwave", (0.63, 0.36), 0.0, color="gray"),
        cabinet("fridge", (0.63, -0.36), 0.95, color="white"),
        item("milk", "box", (0.63, -0.36), size=(0.06, 0.06, 0.12), color="white", on="fridge",
             inside="fridge"),
        item("tray", "box", (0.43, 0.00), size=(0.16, 0.3, 0.015), color="gray"),
        cup("red_cup", (0.43, 0.08), size=(0.08, 0.08, 0.09), color="red", on="tray"),
        cup("white_cup", (0.43, -0.08), size=(0.08, 0.08, 0.09), color="white", on="tray"),
        cup("blue_cup", (0.30, 0.29), size=(0.08, 0.08, 0.09), color="blue"),
        item("orange", "sphere", (0.27, 0.02), size=(0.07, 0.07, 0.07), color="orange"),
        item("orange_bowl", "bowl", (0.64, 0.03), size=(0.17, 0.17, 0.07), color="orange"),
        item("apple", "sphere", (0.64, 0.03), size=(0.07, 0.07, 0.07), color="green",
             on="orange_bowl", inside="orange_bowl"),
        item("apple_juice", "box", (0.28, -0.24), size=(0.05, 0.05, 0.11), color="green",
             label="apple juice box"),
    )  # fmt: skip


def sorting_corner() -> SceneState:
    """Blocks of several colours, two on a mat, balls, a bucket, a shelf."""
    return scene(
        item("toy_box", "bowl", (0.60, 0.33), size=(0.22, 0.22, 0.1), color="brown"),
        item("red_ball", "sphere", (0.60, 0.33), size=(0.05, 0.05, 0.05), color="red",
             on="toy_box", inside="toy_box"),
        item("shelf", "shelf", (0.63, -0.32), boards=("lower", "upper",), size=(0.25, 0.30,
             0.40), color="white"),
        item("toy_car", "box", (0.63, -0.32), size=(0.09, 0.05, 0.04), color="yellow",
             on="shelf.upper"),
        item("mat", "box", (0.42, 0.08), size=(0.22, 0.22, 0.01), color="gray"),
        item("blue_block", "box", (0.46, 0.13), size=(0.05, 0.05, 0.05), color="blue", on="mat"),
        item("green_block", "box", (0.46, 0.13), size=(0.05, 0.05, 0.05), color="green",
             on="blue_block"),
        item("big_red_block", "box", (0.30, -0.11), size=(0.07, 0.07, 0.07), color="red"),
        item("small_red_block", "box", (0.29, 0.30), size=(0.04, 0.04, 0.04), color="red"),
        item("blue_ball", "sphere", (0.30, -0.29), size=(0.05, 0.05, 0.05), color="blue"),
        item("bucket", "bowl", (0.63, 0.04), size=(0.16, 0.16, 0.1), color="white"),
    )  # fmt: skip


def egg_table() -> SceneState:
    """Mugs and bowls of two colours, an egg on a plate, fruit in a bowl."""
    return scene(
        item("tray", "box", (0.45, 0.00), size=(0.18, 0.34, 0.015), color="gray"),
        cup("red_mug", (0.45, 0.10), size=(0.08, 0.08, 0.08), color="red", on="tray"),
        cup("blue_mug", (0.32, 0.30), size=(0.1, 0.1, 0.11), color="blue"),
        item("spoon", "pen", (0.32, 0.30), size=(0.14, 0.012, 0.012), color="gray",
             on="blue_mug", inside="blue_mug"),
        item("red_bowl", "bowl", (0.30, -0.29), size=(0.18, 0.18, 0.07), color="red"),
        item("apple", "sphere", (0.30, -0.25), size=(0.065, 0.065, 0.065), color="green",
             on="red_bowl", inside="red_bowl"),
        item("lemon", "sphere", (0.30, -0.33), size=(0.05, 0.05, 0.05), color="yellow",
             on="red_bowl", inside="red_bowl"),
        item("blue_bowl", "bowl", (0.62, -0.22), size=(0.14, 0.14, 0.06), color="blue"),
        item("plate", "box", (0.62, 0.25), size=(0.22, 0.22, 0.015), color="white"),
        item("egg", "sphere", (0.62, 0.30), size=(0.045, 0.045, 0.045), color="white", on="plate"),
        item("fork", "pen", (0.27, 0.05), size=(0.14, 0.012, 0.012), color="gray"),
    )  # fmt: skip


def two_towers() -> SceneState:
    """Two towers, a box with things in it and an empty one."""
    return scene(
        item("red_box", "bowl", (0.60, 0.28), size=(0.2, 0.2, 0.08), color="red"),
        item("green_block_2", "box", (0.60, 0.32), size=(0.04, 0.04, 0.04), color="green",
             label="green block", on="red_box", inside="red_box"),
        item("red_ball", "sphere", (0.60, 0.24), size=(0.05, 0.05, 0.05), color="red",
             on="red_box", inside="red_box"),
        item("blue_box", "bowl", (0.60, -0.28), size=(0.2, 0.2, 0.08), color="blue"),
        item("board", "box", (0.42, 0.03), size=(0.2, 0.22, 0.015), color="brown"),
        item("large_red_block", "box", (0.42, 0.07), size=(0.07, 0.07, 0.07), color="red",
             on="board"),
        item("yellow_block", "box", (0.42, 0.07), size=(0.045, 0.045, 0.045), color="yellow",
             on="large_red_block"),
        item("small_red_block", "box", (0.42, 0.07), size=(0.035, 0.035, 0.035), color="red",
             on="yellow_block"),
        item("mat", "box", (0.30, -0.24), size=(0.2, 0.22, 0.005), color="gray"),
        item("blue_block", "box", (0.30, -0.20), size=(0.055, 0.055, 0.055), color="blue",
             on="mat"),
        item("green_block_1", "box", (0.30, -0.20), size=(0.04, 0.04, 0.04), color="green",
             label="green block", on="blue_block"),
    )  # fmt: skip


def holder_desk() -> SceneState:
    """Pens in one of two holders, a chest with its middle drawer open."""
    return scene(
        drawers("chest", (0.63, -0.34), {"top": 0.0, "middle": 0.9, "bottom": 0.0}, color="brown"),
        item("tape", "cylinder", (0.52, -0.30), size=(0.05, 0.05, 0.025), color="yellow",
             on="chest", inside="chest.middle"),
        item("stapler", "box", (0.52, -0.37), size=(0.1, 0.035, 0.04), color="black", on="chest",
             inside="chest.middle"),
        cup("black_holder", (0.62, 0.08), size=(0.09, 0.09, 0.1), color="black",
             label="black pen holder"),
        item("red_pen", "pen", (0.62, 0.08), size=(0.14, 0.012, 0.012), color="red",
             on="black_holder", inside="black_holder"),
        item("blue_pen", "pen", (0.62, 0.08), size=(0.14, 0.012, 0.012), color="blue",
             on="black_holder", inside="black_holder"),
        cup("white_holder", (0.62, 0.30), size=(0.09, 0.09, 0.1), color="white",
             label="white pen holder"),
        item("notebook", "box", (0.40, -0.04), size=(0.2, 0.22, 0.02), color="blue",
             label="blue notebook"),
        item("green_pen", "pen", (0.40, 0.03), size=(0.14, 0.012, 0.012), color="green",
             on="notebook"),
        item("red_book", "box", (0.36, 0.28), size=(0.17, 0.13, 0.03), color="red"),
        item("eraser", "box", (0.36, 0.28), size=(0.04, 0.02, 0.015), color="pink", on="red_book"),
    )  # fmt: skip


def jar_kitchen() -> SceneState:
    """Jars on two boards and on the desk, fruit in a basket, a cutting board."""
    return scene(
        cabinet("microwave", (0.63, 0.34), 0.0, color="gray"),
        item("shelf", "shelf", (0.63, -0.32), boards=("lower", "upper",), size=(0.25, 0.30,
             0.40), color="brown"),
        cup("jar_1", (0.63, -0.32), size=(0.1, 0.1, 0.12), label="glass jar", on="shelf.upper"),
        cup("jar_2", (0.63, -0.32), size=(0.1, 0.1, 0.12), label="glass jar", on="shelf.lower"),
        cup("jar_3", (0.52, 0.02), size=(0.1, 0.1, 0.12), label="glass jar"),
        item("spatula", "pen", (0.52, 0.02), size=(0.17, 0.015, 0.012), color="red", on="jar_3",
             inside="jar_3"),
        item("basket", "bowl", (0.30, 0.28), size=(0.26, 0.24, 0.09), color="brown"),
        item("orange", "sphere", (0.30, 0.33), size=(0.075, 0.075, 0.075), color="orange",
             on="basket", inside="basket"),
        item("onion", "sphere", (0.30, 0.22), size=(0.06, 0.06, 0.06), color="white",
             on="basket", inside="basket"),
        item("cutting_board", "box", (0.30, -0.12), size=(0.2, 0.28, 0.015), color="brown"),
        item("tomato", "sphere", (0.30, -0.18), size=(0.055, 0.055, 0.055), color="red",
             on="cutting_board"),
    )  # fmt: skip


def tube_lab() -> SceneState:
    """Tubes in a rack, in an open drawer and on the desk, beakers, one of them on a tray."""
    return scene(
        drawers("drawer_unit", (0.63, -0.34), {"top": 0.0, "middle": 0.0, "bottom": 0.9},
             color="gray"),
        item("marker", "pen", (0.63, -0.34), size=(0.13, 0.014, 0.014), color="black",
             on="drawer_unit", inside="drawer_unit.top"),
        item("green_tube", "cylinder", (0.48, -0.34), size=(0.02, 0.02, 0.1), color="green",
             on="drawer_unit", inside="drawer_unit.bottom"),
        item("white_rack", "bowl", (0.57, 0.30), size=(0.09, 0.18, 0.05), color="white"),
        item("blue_tube", "cylinder", (0.57, 0.30), size=(0.02, 0.02, 0.1), color="blue",
             on="white_rack", inside="white_rack"),
        item("black_rack", "bowl", (0.38, 0.30), size=(0.09, 0.18, 0.05), color="black"),
        item("red_tube", "cylinder", (0.29, -0.20), size=(0.02, 0.02, 0.1), color="red"),
        item("tray", "box", (0.44, 0.02), size=(0.2, 0.2, 0.015), color="gray"),
        cup("small_beaker", (0.44, -0.03), size=(0.06, 0.06, 0.07), on="tray"),
        cup("large_beaker", (0.60, 0.06), size=(0.08, 0.08, 0.11)),
        item("waste_bin", "bowl", (0.62, -0.13), size=(0.13, 0.13, 0.08), color="red"),
    )  # fmt: skip


def remote_table() -> SceneState:
    """Remotes, playing cards in an open cabinet, a candle on a tray."""
    return scene(
        cabinet("cabinet", (0.63, 0.34), 0.95, color="brown"),
        item("cards", "box", (0.63, 0.34), size=(0.06, 0.09, 0.02), label="playing cards",
             on="cabinet", inside="cabinet"),
        item("basket", "bowl", (0.60, -0.30), size=(0.2, 0.2, 0.09), color="brown"),
        item("white_remote", "box", (0.60, -0.30), size=(0.045, 0.15, 0.02), color="white",
             on="basket", inside="basket"),
        item("tray", "box", (0.43, 0.02), size=(0.16, 0.26, 0.015), color="brown"),
        item("candle", "cylinder", (0.43, 0.02), size=(0.05, 0.05, 0.09), color="white", on="tray"),
        cup("vase", (0.63, 0.06), size=(0.07, 0.07, 0.15), color="blue"),
        item("coaster", "box", (0.30, 0.16), size=(0.09, 0.09, 0.01), color="green"),
        cup("mug", (0.32, -0.16), size=(0.08, 0.08, 0.09), color="yellow"),
        item("black_remote", "box", (0.29, -0.01), size=(0.045, 0.15, 0.02), color="black"),
        item("magazine", "box", (0.60, -0.13), size=(0.14, 0.08, 0.015), color="red"),
    )  # fmt: skip


def hammer_bench() -> SceneState:
    """Tools on a bench and in the drawers of a chest, bins, a tin with a pencil in it."""
    return scene(
        drawers("tool_chest", (0.63, 0.33), {"top": 0.0, "middle": 0.9, "bottom": 0.0},
             color="gray"),
        item("wrench", "pen", (0.63, 0.33), size=(0.15, 0.03, 0.015), color="gray",
             on="tool_chest", inside="tool_chest.top"),
        item("yellow_screwdriver", "pen", (0.50, 0.33), size=(0.14, 0.025, 0.025),
             color="yellow", on="tool_chest", inside="tool_chest.middle"),
        item("red_bin", "bowl", (0.60, -0.36), size=(0.18, 0.16, 0.1), color="red"),
        item("gray_bin", "bowl", (0.60, -0.08), size=(0.18, 0.16, 0.1), color="gray"),
        item("tape_roll", "cylinder", (0.60, -0.08), size=(0.07, 0.07, 0.04), color="black",
             label="roll of tape", on="gray_bin", inside="gray_bin"),
        item("hammer", "pen", (0.27, 0.16), size=(0.17, 0.03, 0.03), color="brown"),
        item("red_screwdriver", "pen", (0.42, -0.24), size=(0.14, 0.025, 0.025), color="red"),
        item("glue_bottle", "cylinder", (0.42, 0.06), size=(0.05, 0.05, 0.13), color="white"),
        cup("tin", (0.28, -0.12), size=(0.08, 0.08, 0.1)),
        item("pencil", "pen", (0.28, -0.12), size=(0.14, 0.01, 0.01), color="orange", on="tin",
             inside="tin"),
    )  # fmt: skip


def train_room() -> SceneState:
    """Toys on two boards, a toy chest, a tower of two blocks, a basket."""
    return scene(
        item("toy_shelf", "shelf", (0.63, 0.34), boards=("lower", "upper",), size=(0.25, 0.30,
             0.40), color="white"),
        item("toy_car", "box", (0.63, 0.30), size=(0.09, 0.05, 0.05), color="red",
             on="toy_shelf.upper"),
        item("wooden_train", "box", (0.63, 0.38), size=(0.12, 0.04, 0.05), color="brown",
             on="toy_shelf.lower"),
        cabinet("toy_chest", (0.63, -0.34), 0.0, color="brown"),
        item("green_ball", "sphere", (0.63, -0.34), size=(0.06, 0.06, 0.06), color="green",
             on="toy_chest", inside="toy_chest"),
        item("basket", "bowl", (0.62, 0.03), size=(0.2, 0.2, 0.1), color="white"),
        item("rubber_duck", "box", (0.62, 0.03), size=(0.06, 0.05, 0.06), color="yellow",
             on="basket", inside="basket"),
        item("red_block", "box", (0.30, 0.02), size=(0.05, 0.05, 0.05), color="red"),
        item("yellow_block", "box", (0.30, 0.02), size=(0.045, 0.045, 0.045), color="yellow",
             on="red_block"),
        item("big_blue_block", "box", (0.43, 0.16), size=(0.065, 0.065, 0.065), color="blue"),
        item("small_blue_block", "box", (0.36, -0.17), size=(0.035, 0.035, 0.035), color="blue"),
    )  # fmt: skip


def ball_room() -> SceneState:
    """Balls in a basket and on the desk, blocks, a toy chest with its top drawer open."""
    return scene(
        drawers("toy_chest", (0.63, -0.36), {"top": 0.9, "middle": 0.0, "bottom": 0.0},
             color="white"),
        item("basket", "bowl", (0.58, 0.31), size=(0.18, 0.18, 0.08), color="brown"),
        item("crate", "bowl", (0.62, 0.07), size=(0.16, 0.16, 0.08), color="blue"),
        item("mat", "box", (0.42, -0.07), size=(0.2, 0.2, 0.008), color="gray"),
        item("red_block", "box", (0.34, 0.12), size=(0.05, 0.05, 0.05), color="red"),
        item("blue_block", "box", (0.34, 0.12), size=(0.04, 0.04, 0.04), color="blue",
             on="red_block"),
        item("yellow_block", "box", (0.28, -0.14), size=(0.05, 0.05, 0.05), color="yellow"),
        item("green_block", "box", (0.49, -0.36), size=(0.04, 0.04, 0.04), color="green",
             on="toy_chest", inside="toy_chest.top"),
        item("blue_ball", "sphere", (0.56, 0.28), size=(0.05, 0.05, 0.05), color="blue",
             on="basket", inside="basket"),
        item("red_ball", "sphere", (0.60, 0.34), size=(0.05, 0.05, 0.05), color="red",
             on="basket", inside="basket"),
        item("yellow_ball", "sphere", (0.34, 0.27), size=(0.05, 0.05, 0.05), color="yellow"),
    )  # fmt: skip


def pen_nook() -> SceneState:
    """Pens in a holder, on a notebook and on the desk, a bookshelf, a drawer."""
    return scene(
        item("bookshelf", "shelf", (0.63, -0.32), boards=("lower", "upper",), size=(0.25, 0.30,
             0.40), color="brown"),
        drawers("drawer", (0.63, 0.34), {"top": 0.0}, color="white"),
        cup("black_holder", (0.60, 0.10), size=(0.08, 0.08, 0.1), color="black",
             label="black pen holder"),
        cup("white_holder", (0.60, -0.06), size=(0.08, 0.08, 0.1), color="white",
             label="white pen holder"),
        item("red_pen", "pen", (0.60, 0.10), size=(0.14, 0.012, 0.012), color="red",
             on="black_holder", inside="black_holder"),
        item("blue_pen", "pen", (0.30, -0.20), size=(0.14, 0.012, 0.012), color="blue"),
        item("green_pen", "pen", (0.40, 0.08), size=(0.14, 0.012, 0.012), color="green",
             on="notebook"),
        item("notebook", "box", (0.40, 0.08), size=(0.15, 0.11, 0.02), color="blue"),
        item("red_book", "box", (0.63, -0.32), size=(0.11, 0.06, 0.03), color="red",
             on="bookshelf.lower"),
        item("stapler", "box", (0.63, -0.32), size=(0.11, 0.04, 0.04), color="black",
             on="bookshelf.upper"),
        item("eraser", "box", (0.63, 0.34), size=(0.05, 0.025, 0.015), color="pink", on="drawer",
             inside="drawer"),
    )  # fmt: skip


def pot_galley() -> SceneState:
    """A pot and its lid, apples, mugs, one of them in a microwave, a sideboard."""
    return scene(
        cabinet("microwave", (0.63, 0.36), 0.0, color="gray"),
        drawers("sideboard", (0.63, -0.36), {"top": 0.0, "bottom": 0.9}, color="brown"),
        cup("red_mug", (0.63, 0.36), size=(0.08, 0.08, 0.09), color="red", on="microwave",
             inside="microwave"),
        cup("blue_mug", (0.30, 0.30), size=(0.08, 0.08, 0.09), color="blue"),
        item("white_plate", "box", (0.42, 0.10), size=(0.2, 0.2, 0.015), color="white"),
        item("blue_plate", "box", (0.36, -0.12), size=(0.18, 0.18, 0.015), color="blue"),
        item("red_apple", "sphere", (0.42, 0.15), size=(0.07, 0.07, 0.07), color="red",
             on="white_plate"),
        item("green_apple", "sphere", (0.27, 0.12), size=(0.07, 0.07, 0.07), color="green"),
        item("spoon", "pen", (0.48, -0.36), size=(0.14, 0.012, 0.012), color="gray",
             on="sideboard", inside="sideboard.bottom"),
        item("pot", "bowl", (0.62, 0.07), size=(0.18, 0.18, 0.1), color="black"),
        item("pot_lid", "box", (0.62, -0.12), size=(0.16, 0.16, 0.02), color="black"),
    )  # fmt: skip


def turned_fronts() -> SceneState:
    """A microwave whose front faces the right and a drawer that faces the left, each with a ball
    before it, two mugs.
    """
    plain = scene(
        cabinet("microwave", (0.39, 0.45), 0.1, color="gray"),
        ball("tennis_ball", (0.29, 0.14), label="tennis ball", color="yellow"),
        drawers("drawer", (0.45, -0.42), {"top": 0.0}, color="white"),
        ball("golf_ball", (0.49, -0.20), label="golf ball", color="white"),
        cup("red_mug", (0.20, -0.35), color="red"),
        cup("blue_mug", (0.15, 0.40), color="blue"),
    )
    half = math.sqrt(0.5)
    turns = {"microwave": -half, "drawer": half}
    states = {
        name: replace(state, quaternion=(half, 0.0, 0.0, turns[name])) if name in turns else state
        for name, state in plain.states.items()
    }
    return replace(plain, states=states)


def wool_table() -> SceneState:
    """Balls of wool of three colours, one of them in a basket, a jar, a book, a glue stick."""
    return scene(
        item("basket", "bowl", (0.60, 0.28), size=(0.24, 0.24, 0.12), color="brown"),
        ball("blue_wool", (0.60, 0.28), label="blue ball of wool", color="blue", on="basket",
             inside="basket"),
        ball("red_wool", (0.34, 0.36), label="red ball of wool", color="red"),
        ball("yellow_wool", (0.40, 0.12), label="yellow ball of wool", color="yellow"),
        cup("jar", (0.58, -0.02), size=(0.08, 0.08, 0.1)),
        item("glue_stick", "cylinder", (0.34, -0.02), size=(0.03, 0.03, 0.1), label="glue stick"),
        item("book", "box", (0.42, -0.34), size=(0.22, 0.18, 0.02), color="purple"),
    )  # fmt: skip


def coded_bench() -> SceneState:
    """Things whose names have the colour, the size or the side behind the noun."""
    return scene(
        item("block_red", "box", (0.42, 0.18), size=CUBE, color="red"),
        item("block_blue", "box", (0.42, -0.10), size=CUBE, color="blue"),
        item("block_orange", "box", (0.42, 0.04), size=CUBE, color="orange"),
        ball("navel_orange", (0.30, 0.00), color="orange"),
        item("bowl_left", "bowl", (0.54, 0.28), size=BOWL),
        item("bowl_right", "bowl", (0.54, -0.28), size=BOWL),
        cup("cup_big", (0.30, 0.28), size=(0.09, 0.09, 0.11), color="green"),
        cup("cup_small", (0.30, -0.26), size=(0.06, 0.06, 0.07), color="green"),
    )


def coin_nook() -> SceneState:
    """Furniture called a drawer with a die in it and coins on top, a bin, a wrapper."""
    return scene(
        drawers("drawer", (0.60, 0.28), {"top": 0.9}, color="brown"),
        item("die", "box", (0.50, 0.28), size=(0.03, 0.03, 0.03), on="drawer", inside="drawer"),
        item("coins", "box", (0.62, 0.28), size=(0.06, 0.04, 0.02), color="yellow", on="drawer"),
        item("bin", "bowl", (0.44, -0.30), size=(0.18, 0.18, 0.14), color="black"),
        ball("wrapper", (0.34, 0.02), color="white"),
        item("card", "box", (0.44, -0.04), size=(0.12, 0.08, 0.01), color="red"),
    )


def gallery() -> SceneState:
    """A close-up photo, a next-day parcel, a postcard, an album, a frame, a wall cabinet."""
    return scene(
        item("photo", "box", (0.30, 0.20), size=(0.12, 0.09, 0.004), label="close-up photo"),
        item("parcel", "box", (0.30, -0.20), size=(0.08, 0.08, 0.06), label="next-day parcel"),
        item("postcard", "box", (0.32, 0.00), size=(0.10, 0.07, 0.004), color="blue"),
        item("album", "box", (0.50, 0.25), size=(0.20, 0.16, 0.03), color="red"),
        item("tray", "box", (0.50, -0.10), size=(0.25, 0.18, 0.02), color="black"),
        cabinet("cabinet", (0.65, 0.45), 0.0, color="white"),
    )


def game_shelf() -> SceneState:
    """Two dice, two toy mice, three wooden men, a dice cup, a box lid."""
    cube = (0.02, 0.02, 0.02)
    man = (0.02, 0.02, 0.05)
    return scene(
        item("red_die", "box", (0.30, 0.20), size=cube, label="die", color="red"),
        item("white_die", "box", (0.34, 0.20), size=cube, label="die", color="white"),
        item("gray_mouse", "capsule", (0.30, 0.00), size=(0.06, 0.03, 0.03), label="toy mouse"),
        item("brown_mouse", "capsule", (0.36, 0.00), size=(0.06, 0.03, 0.03), label="toy mouse"),
        item("man_1", "cylinder", (0.30, -0.20), size=man, label="wooden man", color="blue"),
        item("man_2", "cylinder", (0.36, -0.20), size=man, label="wooden man", color="green"),
        item("man_3", "cylinder", (0.42, -0.20), size=man, label="wooden man", color="yellow"),
        cup("dice_cup", (0.50, 0.10), label="dice cup", color="black"),
        item("lid", "box", (0.50, -0.10), size=(0.20, 0.20, 0.02), label="box lid", color="brown"),
    )


def clubroom() -> SceneState:
    """A chessboard with a king on it, two pawns, things with British names, a teapot, a dustpan."""
    return scene(
        item("chessboard", "box", (0.45, 0.0), size=(0.24, 0.24, 0.02), color="brown"),
        item("king", "cylinder", (0.45, 0.0), size=(0.03, 0.03, 0.08), color="black",
             on="chessboard"),
        item("pawn_1", "cylinder", (0.25, 0.20), size=(0.03, 0.03, 0.05), label="white pawn",
             color="white"),
        item("pawn_2", "cylinder", (0.30, 0.25), size=(0.03, 0.03, 0.05), label="white pawn",
             color="white"),
        item("doughnut", "cylinder", (0.30, -0.20), size=(0.08, 0.08, 0.03), color="pink"),
        item("lever", "pen", (0.20, 0.0), size=(0.12, 0.02, 0.01), label="tyre lever",
             color="blue"),
        item("jewels", "bowl", (0.40, -0.40), size=(0.16, 0.16, 0.08), label="jewellery dish",
             color="white"),
        item("teapot", "cylinder", (0.60, 0.30), size=(0.10, 0.10, 0.10), color="green"),
        item("dustpan", "box", (0.60, -0.30), size=(0.20, 0.16, 0.02), color="red"),
        item("pineapple", "sphere", (0.25, 0.40), size=(0.10, 0.10, 0.10), color="yellow"),
    )  # fmt: skip


def den() -> SceneState:
    """A shelf with two boards, a chessboard, a clipboard in an open drawer, an axe, a mould."""
    return scene(
        item("shelf", "shelf", (0.68, 0.35), size=(0.25, 0.30, 0.3), boards=("lower", "upper")),
        item("vase", "cup", (0.68, 0.35), size=(0.06, 0.06, 0.1), on="shelf.lower", color="white"),
        item("radio", "box", (0.68, 0.35), size=(0.10, 0.06, 0.06), on="shelf.upper",
             color="gray"),
        drawers("chest", (0.65, -0.35), {"top": 0.9, "bottom": 0.0}),
        item("chessboard", "box", (0.40, 0.0), size=(0.24, 0.24, 0.02), color="brown"),
        item("queen", "cylinder", (0.25, 0.20), size=(0.03, 0.03, 0.07), color="white"),
        item("axe", "pen", (0.20, 0.0), size=(0.16, 0.04, 0.02), color="gray"),
        item("mould", "bowl", (0.35, 0.35), size=(0.14, 0.14, 0.08), label="jelly mould",
             color="blue"),
        item("red_block", "box", (0.60, -0.35), size=CUBE, label="block", color="red",
             inside="chest.top"),
        item("green_block", "box", (0.30, -0.25), size=CUBE, label="block", color="green"),
        item("blue_block", "box", (0.40, 0.05), size=CUBE, label="block", color="blue",
             on="chessboard"),
    )  # fmt: skip


def reel_table() -> SceneState:
    """Two cotton reels, an elastic band, a push pin, a flannel shirt and a kidney dish."""
    reel = (0.04, 0.04, 0.05)
    return scene(
        item("red_reel", "cylinder", (0.30, 0.05), size=reel, label="cotton reel", color="red"),
        item("blue_reel", "cylinder", (0.30, -0.10), size=reel, label="cotton reel", color="blue"),
        item("band", "box", (0.40, 0.20), size=(0.04, 0.04, 0.01), label="elastic band"),
        item("push_pin", "box", (0.45, 0.05), size=(0.02, 0.02, 0.02), label="push pin"),
        item("flannel_shirt", "box", (0.50, -0.15), size=(0.1, 0.1, 0.03), label="flannel shirt"),
        item("kidney_dish", "bowl", (0.45, -0.35), size=(0.2, 0.2, 0.06), label="kidney dish"),
    )


def covered_pot() -> SceneState:
    """A pot under its lid, a mug on a plate, an open locker with a cup in it and one before it that
    holds a nut, a closed drawer with a marker in it, another with a key, a ball.
    """
    return scene(
        cabinet("locker", (0.64, 0.32), 1.0, color="gray"),
        drawers("chest", (0.64, -0.38), {"top": 0.0, "bottom": 0.0}, color="brown"),
        item("pot", "bowl", (0.44, -0.05), size=(0.20, 0.20, 0.10), color="black"),
        item("lid", "cylinder", (0.44, -0.05), size=(0.20, 0.20, 0.02), on="pot", z=0.24,
             color="gray"),
        item("plate", "box", (0.24, -0.10), size=(0.18, 0.18, 0.015), color="white"),
        cup("green_mug", (0.24, -0.10), on="plate", z=0.185, color="green"),
        cup("red_cup", (0.62, 0.30), inside="locker", on="", z=0.18, color="red"),
        cup("blue_cup", (0.36, 0.36), color="blue"),
        item("nut", "cylinder", (0.36, 0.36), size=(0.02, 0.02, 0.02), inside="blue_cup", on="",
             z=0.15, color="gray"),
        item("marker", "pen", (0.62, -0.38), size=(0.13, 0.015, 0.015), inside="chest.top", on="",
             z=0.22, color="black"),
        item("key", "box", (0.62, -0.36), size=(0.06, 0.02, 0.005), inside="chest.bottom", on="",
             z=0.16, color="yellow"),
        ball("ball", (0.28, -0.32), color="yellow"),
    )  # fmt: skip

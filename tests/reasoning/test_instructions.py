"""The controlled English: sentences and the branches that they lead to."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from etot_cli.errors import InstructionError
from tests.reasoning import scenes
from tests.reasoning.scenes import plans

OPEN_DOOR = ["[OPEN, microwave]"]
CLOSE = ["[CLOSE, drawer]"]
PEN_BLACK = "[PICK UP, pen] [PUT INTO, black_holder]"
PEN_WHITE = "[PICK UP, pen] [PUT INTO, white_holder]"
EITHER = [PEN_BLACK, PEN_WHITE]
SIDE, ABOVE = "[PICK UP, holder] (horizontal)", "[PICK UP, holder] (vertical)"
BALLS = ["[PICK UP, tennis_ball_1]", "[PICK UP, tennis_ball_2]"]
TOY_FIRST = ["[PICK UP, toy] [PUT ON, desk] [CLOSE, drawer]"]
APPLE_IN = "[PICK UP, apple] [PUT INTO, holder]"
HOLDER_ON = "[PICK UP, holder] [PUT ON, drawer]"


def store(*names: str) -> str:
    insertions = " ".join(f"[PICK UP, {name}] [PUT INTO, drawer]" for name in names)
    return f"[OPEN, drawer] {insertions} [CLOSE, drawer]"


def left_open(name: str) -> str:
    return f"[OPEN, drawer] [PICK UP, {name}] [PUT INTO, drawer]"


BALL_IN = "[PICK UP, tennis_ball] [PUT INTO, holder]"
ALLOCATIONS = [
    store("apple", "tennis_ball"),
    f"{store('apple')} {BALL_IN}",
    f"{APPLE_IN} {store('tennis_ball')}",
    f"{APPLE_IN} {BALL_IN}",
]
ALLOCATIONS_CLOSED = [*ALLOCATIONS[:3], f"{ALLOCATIONS[3]} [CLOSE, drawer]"]

PAPER = [
    ("microwave", "Open the door of the microwave oven.", OPEN_DOOR),
    ("pens", "Reorient a pen and place it into a holder.", EITHER),
    ("holder_on_drawer", "Pick up the holder horizontally or vertically.", [SIDE, ABOVE]),
    ("toy_in_drawer", "Close the drawer.", CLOSE),
    ("two_balls", "Pick up a tennis ball.", BALLS),
    ("pens_and_apple", "Reorient a pen and place it into a holder.", EITHER),
    (
        "apple_and_holder",
        "Place the apple and the holder on the drawer, with the apple inside the holder.",
        [f"{APPLE_IN} {HOLDER_ON}"],
    ),
    (
        "ball_before_drawer",
        "Put the apple and the tennis ball in either the drawer or the pen holder, together or "
        "separately. Ensure the drawer is closed.",
        ALLOCATIONS_CLOSED,
    ),
]

REWORDED: dict[str, dict[str, list[str]]] = {
    "microwave": {
        "Open the microwave door": OPEN_DOOR,
        "Please open the microwave.": OPEN_DOOR,
        "Could you open the microwave's door?": OPEN_DOOR,
        "Pull the door of the microwave open.": OPEN_DOOR,
        "Make sure the microwave is open": OPEN_DOOR,
        "The microwave door should be open.": OPEN_DOOR,
        "Swing the microwave door open": OPEN_DOOR,
        "Open the door of the silver microwave all the way": OPEN_DOOR,
        "Open the microwave and pick up the ball": ["[OPEN, microwave] [PICK UP, tennis_ball]"],
        "Take the ball and put it in the microwave, then close the door": [
            "[OPEN, microwave] [PICK UP, tennis_ball] [PUT INTO, microwave] [CLOSE, microwave]"
        ],
    },
    "pens": {
        "Put the pen in a pen holder.": EITHER,
        "Insert the pen into one of the holders": EITHER,
        "Turn the pen upright and insert it into either holder.": EITHER,
        "Grab the pen. Put it into either the black or the white holder.": EITHER,
        "Take the pen from the drawer and drop it into whichever holder": EITHER,
        "Put the pen in a holder, standing upright": EITHER,
        "The pen belongs in a holder.": EITHER,
        "Re-orient a pen and place it into any of the cups.": EITHER,
        "Stand the pen upright in the black cup": [PEN_BLACK],
        "Reorient the pen and place it into the white holder": [PEN_WHITE],
        "Put the pen that is lying on the drawer into the left holder": [PEN_WHITE],
        "Put the pen in the holder on the right": [PEN_BLACK],
        "Put the pen into the bigger holder": [PEN_WHITE],
        "Place the pen in the white_holder": [PEN_WHITE],
        "Fetch the pen off the chest and drop it into the black pen holder": [PEN_BLACK],
        "Pick up the pen from above or from the side": [
            "[PICK UP, pen] (vertical)",
            "[PICK UP, pen] (horizontal)",
        ],
    },
    "holder_on_drawer": {
        "Pick up the holder from the side or from above.": [SIDE, ABOVE],
        "Either horizontally or vertically, pick up the holder": [SIDE, ABOVE],
        "Grasp the cup vertically or horizontally": [ABOVE, SIDE],
        "Lift the holder by the rim": [ABOVE],
        "Pick the holder up from the side": [SIDE],
        "Pick up the one on the drawer": ["[PICK UP, holder]"],
        "Take the holder off the drawer": ["[PICK UP, holder] [PUT ON, desk]"],
        "Grasp the holder from above and put it on the desk": [f"{ABOVE} [PUT ON, desk]"],
    },
    "toy_in_drawer": {
        "Shut the drawer": CLOSE,
        "Push the drawer shut, please.": CLOSE,
        "Ensure that the top drawer is closed": CLOSE,
        "Close the upper drawer": CLOSE,
        "Close the open drawer": CLOSE,
        "Make sure the chest is shut": CLOSE,
        "Take the toy out of the drawer and close it": TOY_FIRST,
        "Close the drawer after removing the toy": TOY_FIRST,
        "Before closing the drawer, take out the toy.": TOY_FIRST,
        "Empty the drawer": ["[PICK UP, toy] [PUT ON, desk]"],
        "Pick up the toy and close the drawer": [f"{TOY_FIRST[0]} [PICK UP, toy]"],
        "Leave the drawer open": [],
    },
    "two_balls": {
        "Grab one of the balls": BALLS,
        "Take either tennis ball": BALLS,
        "Lift any ball": BALLS,
        "Pick up the left ball": BALLS[:1],
        "Pick up the second ball": BALLS[1:],
        "Pick up ball 2": BALLS[1:],
        "Pick up tennis_ball_2": BALLS[1:],
        "Pick up the first ball from the right": BALLS[1:],
        "Pick up the ball closest to the holder": BALLS[:1],
        "Put both balls in the holder": [
            "[PICK UP, tennis_ball_1] [PUT INTO, holder] "
            "[PICK UP, tennis_ball_2] [PUT INTO, holder]"
        ],
        "Put a ball into the cup, then pick up the other one.": [
            "[PICK UP, tennis_ball_1] [PUT INTO, holder] [PICK UP, tennis_ball_2]",
            "[PICK UP, tennis_ball_2] [PUT INTO, holder] [PICK UP, tennis_ball_1]",
        ],
    },
    "apple_and_holder": {
        "Put the holder and the apple on the drawer, with the apple in the holder": [
            f"{HOLDER_ON} {APPLE_IN}"
        ],
        "Place the holder on the drawer with the apple inside": [f"{HOLDER_ON} {APPLE_IN}"],
        "Put the holder on top of the chest. Then put the apple into it.": [
            f"{HOLDER_ON} {APPLE_IN}"
        ],
        "Put the holder on the drawer and the apple in the holder.": [f"{HOLDER_ON} {APPLE_IN}"],
        "Put the apple into the holder, then put that holder on the drawer": [
            f"{APPLE_IN} {HOLDER_ON}"
        ],
        "Make sure that the apple is in the cup and the cup is on the drawer": [
            f"{APPLE_IN} {HOLDER_ON}"
        ],
        "Put the holder in the drawer and the apple in the holder": [
            f"{left_open('holder')} {APPLE_IN} [CLOSE, drawer]"
        ],
        "Open the drawer and close it": ["[OPEN, drawer] [CLOSE, drawer]"],
        "Move the apple to the drawer": [store("apple")],
    },
    "ball_before_drawer": {
        "Put the apple and the ball either in the drawer or in the holder": ALLOCATIONS,
        "The apple and the tennis ball should be in the drawer or the holder. Shut the drawer.": (
            ALLOCATIONS_CLOSED
        ),
        "Store the apple and the ball in the drawer or the holder, separately": ALLOCATIONS[1:3],
        "Put the apple and the tennis ball in the same container": [ALLOCATIONS[0], ALLOCATIONS[3]],
        "Open the drawer, put the ball inside, and close it": [store("tennis_ball")],
        "Open the drawer and put the ball inside": [left_open("tennis_ball")],
        "Take the ball, open the drawer and put it inside.": [left_open("tennis_ball")],
        "Open the drawer. Put the ball in it. Leave it open.": [left_open("tennis_ball")],
        "Get the apple into the holder and the ball into the drawer": [ALLOCATIONS[2]],
        "Put the apple into the holder or on the drawer": [
            APPLE_IN,
            "[PICK UP, apple] [PUT ON, drawer]",
        ],
    },
    "kitchen": {
        "Open the top drawer and put the left bowl inside": [
            "[OPEN, chest.upper] [PICK UP, bowl_1] [PUT INTO, chest.upper]"
        ],
        "Close the drawer": ["[CLOSE, chest.lower]"],
        "Close all drawers": ["[CLOSE, chest.lower]"],
        "Open a drawer": ["[OPEN, chest.upper]"],
        "Open the drawer and put the red apple in it": [
            "[OPEN, chest.upper] [PICK UP, apple_1] [PUT INTO, chest.upper]"
        ],
        "Make sure a drawer is closed and a drawer is open": [],
        "Open the closed drawer": ["[OPEN, chest.upper]"],
        "Pick up the mug in front of the box": ["[PICK UP, mug_c]"],
        "Pick up the object between the box and the plate": ["[PICK UP, mug_b]"],
        "Pick up the smaller of the bowls": ["[PICK UP, bowl_2]"],
        "Pick up mug a": ["[PICK UP, mug_a]"],
        "Put mugs B and C in the left bowl": [
            "[PICK UP, mug_b] [PUT INTO, bowl_1] [PICK UP, mug_c] [PUT INTO, bowl_1]"
        ],
        "Put mug C in a lower and B in the upper drawer": [
            "[PICK UP, mug_c] [PUT INTO, chest.lower] [OPEN, chest.upper] "
            "[PICK UP, mug_b] [PUT INTO, chest.upper] [CLOSE, chest.upper]"
        ],
        "Place the red apple in the left bowl and the green apple in the right bowl": [
            "[PICK UP, apple_1] [PUT INTO, bowl_1] [PICK UP, apple_2] [PUT INTO, bowl_2]"
        ],
        "Put the apples in different bowls": [
            "[PICK UP, apple_1] [PUT INTO, bowl_1] [PICK UP, apple_2] [PUT INTO, bowl_2]",
            "[PICK UP, apple_1] [PUT INTO, bowl_2] [PICK UP, apple_2] [PUT INTO, bowl_1]",
        ],
        "Pick up the mugs and stack them on the box": [
            "[PICK UP, mug_a] [PUT ON, box] [PICK UP, mug_c] [PUT INTO, mug_a] "
            "[PICK UP, mug_b] [PUT INTO, mug_c]"
        ],
    },
}

REFUSED: dict[str, dict[str, str]] = {
    "kitchen": {
        "Juggle the apples": "juggle the apples",
        "Do not put the apple in the bowl": "not what to do",
        "Put the red apple in the left bowl without delay": "delay",
        "If the drawer is open, put the bottle in it": "the drawer is open",
        "Put the bottle next to": "something is missing",
        "Put the big bowl upside down on the plate": "upside",
        "Put the apple quickly into the bowl": "quickly",
        "Close the middle drawer": "no 'middle drawer'",
        "Pick up the yellow mug": "no 'yellow mug'",
        "Pick up the spoon": "nothing in the scene is called 'spoon'",
        "Pick up the shiny mug": "'shiny' is not understood",
        "Pick up both apples": "holds one object at a time",
        "Pick up the chest": "chest cannot be picked up",
        "Put it in the bowl": "not clear what this refers to",
        "Put four mugs on the box": "only 3 of them",
        "Reorient the bottle": "no skill of its own",
        "Put the red apple on the green apple": "cannot be used as a surface",
        "": "says nothing",
        "Pick up the apple" + " and the apple" * 60: "over 80 words",
        "x" * 3000: "more than 2000 characters",
    },
}

CASES = [
    *PAPER,
    *((name, text, wanted) for name, texts in REWORDED.items() for text, wanted in texts.items()),
]


@pytest.mark.parametrize(("name", "text", "wanted"), CASES, ids=[case[1][:60] for case in CASES])
def test_branches(name: str, text: str, wanted: list[str]) -> None:
    assert plans(text, getattr(scenes, name)()) == wanted


@pytest.mark.parametrize(
    ("name", "text", "named"),
    [(name, text, named) for name, texts in REFUSED.items() for text, named in texts.items()],
    ids=lambda value: value[:40],
)
def test_refusals_say_what_and_how_to_go_on(name: str, text: str, named: str) -> None:
    with pytest.raises(InstructionError) as raised:
        plans(text, getattr(scenes, name)())
    message = str(raised.value)
    assert named in message
    assert "understood" in message
    for example in re.findall(r"what would be read: (.*)", message):
        plans(example, getattr(scenes, name)())
    assert "goal:" in message
    assert "--reasoner vlm" in message
    assert raised.value.exit_code == 2


def test_message_shows_what_was_understood() -> None:
    with pytest.raises(InstructionError, match="up to there: open the top drawer\\. put the plate"):
        plans("Open the top drawer. Put the plate without delay.", scenes.kitchen())


EXAMPLE = re.compile(r"^\| ([A-Z][^|]*[.]) \| (`.*`) \|$", re.MULTILINE)
DOCUMENT = Path(__file__).parents[2] / "docs" / "instructions.md"


@pytest.mark.parametrize(("text", "branches"), EXAMPLE.findall(DOCUMENT.read_text("utf-8")))
def test_documented_examples(text: str, branches: str) -> None:
    assert plans(text, scenes.kitchen()) == branches.replace("`", "").split("<br>")


def test_document_has_examples() -> None:
    assert len(EXAMPLE.findall(DOCUMENT.read_text("utf-8"))) > 25


# -- nothing knows a task --------------------------------------------------------------------------

NEW_NAMES = {
    "microwave": "zib", "tennis_ball": "round_quop", "black_holder": "black_flum",
    "white_holder": "white_flum", "drawer": "trilk", "pen": "narp", "apple": "jorb",
    "holder": "flum", "toy": "wug",
    "tennis_ball_1": "quop_1", "tennis_ball_2": "quop_2",
}  # fmt: skip
NEW_WORDS = {
    "microwave oven": "zib", "tennis ball": "quop", "pen holder": "flum", "holder": "flum",
    "drawer": "trilk", "pen": "narp", "apple": "jorb",
}  # fmt: skip


@pytest.mark.parametrize(("name", "text", "wanted"), PAPER)
def test_renaming_every_object_changes_nothing(name: str, text: str, wanted: list[str]) -> None:
    state = getattr(scenes, name)()
    names = {old: NEW_NAMES[old] for old in state.infos}
    for old, new in NEW_WORDS.items():
        text = re.sub(rf"\b{old}\b", new, text)
    found = plans(text, scenes.renamed(state, names))
    pattern = re.compile("|".join(sorted(names, key=len, reverse=True)))
    assert found == [pattern.sub(lambda match: names[match[0]], plan) for plan in wanted]


@pytest.mark.parametrize("word", ["left", "right"])
def test_left_is_positive_y(word: str) -> None:
    sign = 1 if word == "left" else -1
    state = scenes.scene(
        scenes.ball("one", (0.4, -0.2 * sign), label="ball"),
        scenes.ball("two", (0.4, 0.2 * sign), label="ball"),
    )
    assert plans(f"Pick up the {word} ball", state) == ["[PICK UP, two]"]


def test_what_holds_needs_no_steps() -> None:
    state = scenes.scene(
        scenes.cup("mug", (0.4, 0.1)),
        scenes.ball("plum", (0.4, 0.1), on="mug", inside="mug"),
        scenes.ball("pear", (0.4, -0.2)),
    )
    assert plans("Put the plum into the mug.", state) == []
    assert plans("Put the plum and the pear into the mug.", state) == [
        "[PICK UP, pear] [PUT INTO, mug]"
    ]


def test_full_hand_at_the_start() -> None:
    state = scenes.scene(
        scenes.cup("mug", (0.4, 0.1)),
        scenes.ball("plum", (0.4, 0.3)),
        scenes.drawers("chest", (0.6, -0.2), {"top": 0.0}),
        holding="plum",
    )
    assert plans("Pick up the plum.", state) == []
    assert plans("Put the plum into the mug.", state) == ["[PUT INTO, mug]"]
    assert plans("Put the plum into the chest.", state) == [
        "[PUT ON, desk] [OPEN, chest] [PICK UP, plum] [PUT INTO, chest] [CLOSE, chest]"
    ]
    assert plans("Pick up the mug.", state) == ["[PUT ON, desk] [PICK UP, mug]"]
    assert plans("Put what you're holding into the mug.", state) == ["[PUT INTO, mug]"]
    assert plans("What's in your hand goes in the mug.", state) == ["[PUT INTO, mug]"]
    assert plans("Place the grasped plum in the mug.", state) == ["[PUT INTO, mug]"]
    with pytest.raises(InstructionError, match="the hand holds plum"):
        plans("Place the grasped mug in the chest.", state)
    with pytest.raises(InstructionError, match="something else by then"):
        plans("Pick up the mug and put what you are holding in the drawer.", state)


def test_open_enough_and_ajar() -> None:
    plum = scenes.ball("plum", (0.4, 0.3))
    wide = scenes.scene(plum, scenes.drawers("chest", (0.6, -0.2), {"top": 0.7}))
    ajar = scenes.scene(plum, scenes.drawers("chest", (0.6, -0.2), {"top": 0.2}))
    insertion = "[PICK UP, plum] [PUT INTO, chest]"
    cycle = f"{insertion} [CLOSE, chest]"
    assert plans("Put the plum into the chest.", wide) == [insertion]
    assert plans("Put the plum into the chest and close it.", wide) == [cycle]
    assert plans("Put the plum into the chest. Ensure the chest is closed.", wide) == [cycle]
    assert plans("Put the plum into the chest.", ajar) == [f"[OPEN, chest] {cycle}"]


def test_what_is_open_is_closed_once_where_that_is_said() -> None:
    state = scenes.scene(
        scenes.drawers("chest", (0.6, -0.2), {"upper": 0.0, "lower": 1.0}),
        scenes.ball("plum", (0.4, 0.3)),
        scenes.ball("pear", (0.4, 0.1)),
    )
    both = " ".join(f"[PICK UP, {name}] [PUT INTO, chest.lower]" for name in ("plum", "pear"))
    upper = both.replace("lower", "upper")
    for last in ("then close it.", "and finally shut it.", "then close the lower drawer."):
        text = f"Put the plum and the pear into the lower drawer, {last}"
        assert plans(text, state) == [f"{both} [CLOSE, chest.lower]"]
    text = "Close the lower drawer last. First put the plum in it and then the pear."
    assert plans(text, state) == [f"{both} [CLOSE, chest.lower]"]
    text = (
        "Put the plum into the lower drawer and the pear on the chest and close the lower drawer."
    )
    (plan,) = plans(text, state)
    assert plan.endswith("[PUT ON, chest] [CLOSE, chest.lower]") and plan.count("CLOSE") == 1
    # What several insertions need open stays so, whether or not that is said.
    said = "Open the upper drawer, put the plum and the pear in it and close it."
    assert plans(said, state) == [f"[OPEN, chest.upper] {upper} [CLOSE, chest.upper]"]
    for text in (
        "Put the plum and the pear into the upper drawer and close it.",
        "Put the plum and the pear into the upper drawer.",
        "Put the plum into the upper drawer. Then put the pear into the upper drawer.",
    ):
        assert plans(text, state) == plans(said, state)
    # It is closed in between where that is asked for.
    text = "Put the plum into the upper drawer, close it and put the pear into the upper drawer."
    (plan,) = plans(text, state)
    assert plan.count("[OPEN, chest.upper]") == plan.count("[CLOSE, chest.upper]") == 2
    # An open drawer covers the one below it.
    text = "Put the plum into the lower drawer, the pear into the upper drawer and close both."
    (plan,) = plans(text, state)
    assert plan.index("[CLOSE, chest.lower]") < plan.index("[OPEN, chest.upper]")


def test_what_goes_in_where_a_vessel_is_taken_out() -> None:
    state = scenes.scene(
        scenes.cabinet("oven", (0.6, -0.2), 0.9),
        scenes.item("bowl", "bowl", (0.6, -0.2), on="oven", inside="oven"),
        scenes.ball("plum", (0.4, 0.3)),
    )
    for text in ("Take the bowl out and put the plum in.", "Oven open, bowl out, plum in."):
        with pytest.raises(InstructionError, match=r"it may mean (the )?bowl or oven"):
            plans(text, state)


def test_what_lies_in_a_closed_drawer_is_uncovered() -> None:
    state = scenes.scene(
        scenes.drawers("chest", (0.6, -0.2), {"top": 0.0}),
        scenes.ball("plum", (0.6, -0.2), on="chest", inside="chest"),
    )
    assert plans("Pick up the plum.", state) == ["[OPEN, chest] [PICK UP, plum]"]


def test_the_one_just_spoken_of_rather_than_the_one_labelled_so() -> None:
    scene = scenes.scene(
        scenes.item("marker", "pen", (0.3, 0.2), size=(0.14, 0.012, 0.012), color="red"),
        scenes.item("green_marker", "pen", (0.3, -0.1), size=(0.14, 0.012, 0.012), inside="mug"),
        scenes.cup("mug", (0.3, -0.1)),
        scenes.item("plate", "box", (0.5, 0.0), size=(0.2, 0.2, 0.01)),
    )  # fmt: skip
    assert plans("Take the marker out of the mug. Put the marker on the plate.", scene) == [
        "[PICK UP, green_marker] [PUT ON, plate]"
    ]
    assert plans("Put the green marker on the plate and the marker in the mug.", scene) == [
        "[PICK UP, green_marker] [PUT ON, plate] [PICK UP, marker] [PUT INTO, mug]"
    ]


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("the blue and green paint cans", {"blue_can", "green_can"}),
        ("all red or blue paint cans", {"red_can", "blue_can"}),
        ("the paint cans", {"red_can", "blue_can", "green_can"}),
    ],
)
def test_colours_of_things_whose_label_has_two_words(said: str, meant: set[str]) -> None:
    cans = [
        scenes.item(
            f"{color}_can", "cylinder", (0.3, 0.1 * place), color=color, label="paint can"
        )
        for place, color in enumerate(("red", "blue", "green"))
    ]  # fmt: skip
    bin_ = scenes.item("bin", "bowl", (0.6, 0.0), size=(0.3, 0.3, 0.1))
    (plan, *_) = plans(f"Put {said} in the bin.", scenes.scene(*cans, bin_))
    assert set(re.findall(r"PICK UP, (\w+)", plan)) == meant


def test_several_that_are_equally_small() -> None:
    sizes = {"pot_1": 0.06, "pot_2": 0.09, "pot_3": 0.06}
    pots = [
        scenes.cup(name, (0.3, 0.1 * place), size=(size, size, size), label="pot")
        for place, (name, size) in enumerate(sizes.items())
    ]
    plate = scenes.item("plate", "box", (0.6, 0.0), size=(0.3, 0.3, 0.01))
    state = scenes.scene(*pots, plate)
    (plan, *_) = plans("Put the small pots on the plate.", state)
    assert re.findall(r"PICK UP, (\w+)", plan) == ["pot_1", "pot_3"]
    with pytest.raises(InstructionError, match="how many"):
        plans("Put the big pots on the plate.", state)


def test_boards_of_a_shelf() -> None:
    state = scenes.scene(
        scenes.item("rack", "shelf", (0.6, 0.3), boards=("low", "mid", "high")),
        scenes.cup("mug", (0.4, 0.0)),
    )
    assert plans("Put the mug on the top shelf.", state) == ["[PICK UP, mug] [PUT ON, rack.high]"]
    assert plans("Put the mug on the bottom board of the rack.", state) == [
        "[PICK UP, mug] [PUT ON, rack.low]"
    ]
    assert plans("Put the mug on the rack.", state) == ["[PICK UP, mug] [PUT ON, rack]"]


def test_many_branches_are_all_there() -> None:
    balls = [scenes.ball(f"ball_{i}", (0.3, 0.1 * i), label="ball") for i in range(5)]
    cups = [scenes.cup(f"cup_{i}", (0.5, 0.1 * i), label="cup") for i in range(3)]
    state = scenes.scene(*balls, *cups)
    from etot_cli.reasoning.builtin import BuiltinReasoner
    from etot_cli.reasoning.protocol import Assignment

    proposed = BuiltinReasoner().propose(Assignment("Put each ball in a cup."), state)
    branches = [branch.actions for branch in proposed]
    assert len(branches) == len(set(branches)) == 3**5

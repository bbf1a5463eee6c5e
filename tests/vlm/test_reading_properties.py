"""Whatever a valid plan is wrapped in, the same plan is read; rubbish is never half a plan."""

from __future__ import annotations

import json

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from etot_cli.reasoning.vlm.grounding import ground
from etot_cli.reasoning.vlm.reading.names import Names
from etot_cli.reasoning.vlm.reading.plans import read_plans, read_revision
from etot_cli.reasoning.vlm.reading.states import read_comparison, read_scene
from etot_cli.reasoning.vlm.reading.text import PAIRS
from etot_cli.reasoning.vlm.reading.verdicts import read_verdict
from etot_cli.skills.action import Verb
from tests.vlm.scenes import kitchen

SCENE = kitchen()
NAMES = Names.of_scene(SCENE)
OBJECTS = ["red_cup", "blue_cup", "spoon", "ball"]
QUICK = settings(max_examples=200, deadline=None)

Step = tuple[Verb, str]

cycles = st.one_of(
    st.builds(
        lambda what, where: [(Verb.PICK_UP, what), (Verb.PUT_INTO, where)],
        st.sampled_from(["spoon", "ball"]),
        st.sampled_from(["red_cup", "blue_cup"]),
    ),
    st.builds(
        lambda what, where: [(Verb.PICK_UP, what), (Verb.PUT_ON, where)],
        st.sampled_from(OBJECTS),
        st.sampled_from(["desk", "chest"]),
    ),
    st.just([(Verb.OPEN, "chest")]),
    st.just([(Verb.CLOSE, "chest")]),
)
plans = st.lists(cycles, min_size=1, max_size=3).map(
    lambda parts: [s for part in parts for s in part]
)

SPELLINGS = {
    Verb.PICK_UP: ["PICK UP", "Pick up", "PICK_UP", "pick up"],
    Verb.PUT_ON: ["PUT ON", "put on", "PUT_ON", "Place on"],
    Verb.PUT_INTO: ["PUT INTO", "put into", "PUT_INTO", "Place in"],
    Verb.OPEN: ["OPEN", "open", "Open"],
    Verb.CLOSE: ["CLOSE", "close"],
}
brackets = st.sampled_from(sorted(PAIRS.items()))
numbering = st.sampled_from(
    ["{n}. ", "{n}) ", "({n}) ", "- ", "* ", "• ", "Step {n}: ", "**{n}.** ", "{n}: ", ""]
)
notes = st.sampled_from(
    [
        "",
        " (safe place)",
        "(safe place)",
        " (as before, but slower)",
        " ",
        ".",
        " - a different part of the desk",
        " (the rim, from above)",
    ]
)
name_styles = st.sampled_from(
    [
        str,
        lambda name: name.replace("_", " "),
        lambda name: f"`{name}`",
        lambda name: "the " + name.replace("_", " "),
        str.upper,
        lambda name: f'"{name}"',
    ]
)
prose = st.lists(
    st.sampled_from(
        [
            "I looked at the images carefully.",
            "The gripper is empty, and no object is lost.",
            "It seems that the first attempt pushed something.",
            "Note that the chest is closed at this point; nothing else changed.",
            "Since step 2 failed before, the approach has to differ.",
            "Yes, this will work.",
            "Here is what I would do.",
            "1. spoon >> red cup",
            "",
        ]
    ),
    max_size=4,
).map("\n".join)
headings = st.sampled_from(
    [
        "",
        "Plan:",
        "Corrected plan:",
        "## Plan",
        "Branch 1:",
        "**Branch 1**",
        "Subtasks of branch 1:",
        "The correct task plan should be:",
        "Branch 1:\nSubtasks of branch 1:",
        "Plan:\nPlan:",
    ]
)
closings = st.sampled_from(
    [
        "",
        "This keeps the ball on the desk.",
        "Nothing else is moved!",
        "With this plan, [PICK UP, spoon] no longer fails because of the cup.",
        "None of the other things is touched.",
    ]
)


@st.composite
def written(draw: st.DrawFn, plan: list[Step]) -> str:
    """A plan in one of the ways that models write."""
    bracket, number = draw(brackets), draw(numbering)
    style = draw(name_styles)
    lines = []
    for n, (verb, name) in enumerate(plan, 1):
        spelling = draw(st.sampled_from(SPELLINGS[verb]))
        note = draw(notes)
        lines.append(f"{number.format(n=n)}{bracket[0]}{spelling}, {style(name)}{bracket[1]}{note}")
    gap = draw(st.sampled_from(["\n", "\n\n", "  \n"]))
    return gap.join(lines)


@st.composite
def wrapped(draw: st.DrawFn) -> tuple[list[Step], str]:
    plan = draw(plans)
    parts = [draw(prose), draw(headings), draw(written(plan)), "", draw(closings)]
    text = "\n".join(parts)
    fence = draw(st.booleans())
    return plan, f"{parts[0]}\n```\n{parts[1]}\n{parts[2]}\n```\n{parts[4]}" if fence else text


def read(reply: str) -> list[Step]:
    found = read_revision(reply)
    assert len(found.plans) == 1, found
    assert not found.plans[0].problems, found
    steps = []
    for step in found.plans[0].steps:
        target = NAMES.resolve(step.target)
        assert isinstance(target, str), (step, target)
        steps.append((step.verb, target))
    return steps


@QUICK
@given(wrapped())
@pytest.mark.slow
def test_wrapping_changes_nothing(case: tuple[list[Step], str]) -> None:
    plan, reply = case
    assert read(reply) == plan


@QUICK
@given(
    plans,
    plans,
    prose,
    st.sampled_from(
        [
            "Branch {n}:",
            "**Branch {n}**",
            "### Branch {n}",
            "Subtasks of branch {n}:",
            "Plan {n}:",
            "Branch {n}:\nSubtasks of branch {n}:",
        ]
    ),
)
@pytest.mark.slow
def test_branches_stay_apart(one: list[Step], two: list[Step], words: str, heading: str) -> None:
    texts = []
    for n, plan in enumerate((one, two), 1):
        steps = "\n".join(f"{i}. [{verb.value}, {name}]" for i, (verb, name) in enumerate(plan, 1))
        texts.append(f"{heading.format(n=n)}\n{steps}")
    found = read_plans("\n\n".join([words, *texts])).plans
    expected = [one] if one == two else [one, two]
    read_as = [[(s.verb, NAMES.resolve(s.target)) for s in plan.steps] for plan in found]
    assert read_as == expected


@QUICK
@given(
    plans,
    plans,
    st.sampled_from(
        [
            "The original plan was",
            "The plan that failed:",
            "I was given the previous plan",
            "Original task plan:",
        ]
    ),
)
@pytest.mark.slow
def test_the_correction_counts_and_not_what_it_quotes(
    old: list[Step], new: list[Step], words: str
) -> None:
    quoted = " ".join(f"{i}. [{verb.value}, {name}]" for i, (verb, name) in enumerate(old, 1))
    listed = "\n".join(f"{i}. [{verb.value}, {name}]" for i, (verb, name) in enumerate(new, 1))
    for before in (f"{words} {quoted}.", f"{words}\n" + quoted.replace(" 2.", "\n2.")):
        assert read(f"{before}\n\nIt hit something.\n\nCorrected plan:\n{listed}") == new


@QUICK
@given(plans, st.booleans(), st.booleans(), st.sampled_from(["", "Here:\n", "```json\n"]))
@pytest.mark.slow
def test_json_in_every_wrapping(plan: list[Step], text: bool, tool: bool, before: str) -> None:
    steps: list[object] = [
        f"[{verb.value}, {name}]"
        if text
        else {"action": verb.value, "object": name, "pose": "any", "note": ""}
        for verb, name in plan
    ]
    data: object = {"diagnosis": "so", "steps": steps}
    if tool:
        data = {"name": "answer", "arguments": data}
    after = "\n```" if before.startswith("```") else "\nThat is all."
    assert read(before + json.dumps(data, indent=1) + after) == plan


@QUICK
@given(wrapped(), st.data())
@pytest.mark.slow
def test_a_cut_json_plan_is_no_plan(case: tuple[list[Step], str], data: st.DataObject) -> None:
    plan, _ = case
    steps = [{"action": verb.value, "object": name} for verb, name in plan]
    whole = json.dumps({"steps": steps})
    cut = whole[: data.draw(st.integers(1, len(whole) - 1))]
    assert not read_revision(cut).plans


@QUICK
@given(plans, st.data())
@pytest.mark.slow
def test_a_missing_object_spoils_the_plan(plan: list[Step], data: st.DataObject) -> None:
    place = data.draw(st.integers(0, len(plan) - 1))
    lines = [f"{i}. [{verb.value}, {name}]" for i, (verb, name) in enumerate(plan, 1)]
    lines[place] = f"{place + 1}. [{plan[place][0].value}]"
    for found in read_plans("\n".join(lines)).plans:
        assert found.problems


@QUICK
@given(wrapped())
@pytest.mark.slow
def test_grounding_never_leaves_the_scene(case: tuple[list[Step], str]) -> None:
    for found in read_plans(case[1]).plans:
        for action in ground(found, SCENE, NAMES).actions:
            assert action.target in {*OBJECTS, "chest", "desk"}


rubbish = st.text(
    alphabet=st.sampled_from(list("[](){}<>,.:;!?*-_#`'\"\n\t 0123abcYyNnoe|→PICKUPOEN")),
    max_size=400,
)


@settings(max_examples=600, deadline=None)
@given(st.one_of(rubbish, st.text(max_size=300)))
@example("[" * 2000)
@example("{" * 2000)
@example('{"steps": ' + "[" * 900)
@example("[PICK UP, " * 300)
@example("1. " * 3000)
@example("yes no " * 2000)
@pytest.mark.slow
def test_rubbish_is_survived(reply: str) -> None:
    for found in (*read_plans(reply).plans, *read_revision(reply).plans):
        ground(found, SCENE, NAMES)
    read_verdict(reply)
    read_comparison(reply, NAMES)
    read_scene(reply, NAMES)


words = st.sampled_from(["yes", "no", "Yes", "NO"])
around = st.sampled_from(
    [
        "{}",
        "{}.",
        "**{}**",
        "{}!!!",
        "Answer: {}",
        "Verdict: {}.",
        '"{}"',
        "The answer is {}.",
        "{}, because it only clears the way.",
        "{}\n\nNo object is leaned on; there is no need to.",
        "Let me see. It is moved, not propped.\n\n{}.",
        "- {}",
        "({})",
    ]
)


@QUICK
@given(words, around)
def test_verdicts_in_every_wrapping(word: str, frame: str) -> None:
    found = read_verdict(frame.format(word))
    assert found.verdict == word.lower()
    assert not found.ambiguous

"""What a scripted model answers in the tests: in the manner of real ones, mistakes included.

Rules as :mod:`etot_cli.reasoning.vlm.player` takes them.
"""

from __future__ import annotations

from textwrap import dedent
from typing import Any

Rules = list[dict[str, Any]]


def rule(role: str, reply: str, **more: Any) -> dict[str, Any]:
    """A rule; the reply may be indented like the code around it."""
    return {"role": role, "reply": dedent(reply), **more}


SCENE = """\
    Here is what the image shows.

    - The desk carries everything.

    The task is about the things it names; whatever is in the way of the arm could be hit.
    """
UNSURE = """\
    {"before": [], "after": [{"object": "desk", "state": "unsure"}], "outcome": "unsure",
     "explanation": "The arm hides what matters."}
    """


def with_common(rules: Rules) -> Rules:
    """The rules of a task, and what is the same for all of them behind these."""
    return [
        *rules,
        rule("scene", SCENE),
        rule("compare", UNSURE),
        rule("screen", "**No.** It only clears the way."),
    ]


TASK_1: Rules = [
    rule(
        "branches",
        """\
        A single thing is to be opened, so there is nothing to choose.

        One branch:
        Subtasks of branch 1:
        1. [OPEN, microwave]
        """,
    ),
    rule(
        "compare",
        """\
        Before the action:
        - Microwave: closed
        - The tennis ball is on the desk.

        After the action:
        - Microwave: open
        - Tennis ball: unsure, the door may be hiding it, or it has been lost
        """,
        contains=["one action: [OPEN, microwave]"],
    ),
    # Too early: the record names what was swept away.
    rule(
        "reflect",
        """\
        The door opened as far as it should, and I see no mistake in the plan.

        None.
        """,
        turn=0,
    ),
    rule(
        "reflect",
        """\
        The ball lay where the door swings and was knocked off. It has to leave first.

        Corrected plan:
        1. [PICK UP, tennis ball]
        2. [PUT ON, desk] (a safe place, away from the door's swing, towards the middle)
        3. [OPEN, microwave]

        Nothing is in the way then.
        """,
        turn=1,
    ),
]
TASK_2: Rules = [
    rule(
        "branches",
        """\
        Two branches:
        1. pen >> black holder
        2. pen >> white holder

        Subtasks of branch 1:
        1. [PICK UP, pen]
        2. [PUT INTO, black holder]

        Subtasks of branch 2:
        1. [PICK UP, pen]
        2. [PUT INTO, white holder]
        """,
    ),
    rule(
        "reflect",
        """\
        The black holder is too light for this pen and tips over with it. They do not fit.

        None.
        """,
    ),
]
TASK_4: Rules = [
    rule(
        "branches",
        """\
        ```json
        {"goal_holds": false, "branches": [{"reason": "push it shut", "steps":
          [{"action": "CLOSE", "object": "drawer", "pose": "any", "note": ""}]}]}
        ```
        """,
    ),
    # Breaks a rule: the hand is full when it closes.
    rule(
        "reflect",
        """\
        The toy sticks out above the drawer.
        1. [PICK UP, toy]
        2. [CLOSE, drawer]
        3. [PUT ON, desk]
        """,
        turn=0,
    ),
    rule(
        "reflect",
        """\
        The task plan was 1. [CLOSE, drawer].

        The toy is taller than the opening.

        The correct plan:
        1. [PICK UP, toy] (it is in the way)
        2. [PUT ON, desk](safe place)
        3. [CLOSE, drawer]
        """,
        turn=1,
    ),
]
TASK_5: Rules = [
    rule(
        "branches",
        """\
        **Two branches:**

        **Branch 1**
        1. `[PICK UP, pen]`
        2. `[PUT INTO, black_holder]`

        **Branch 2**
        1. `[PICK UP, pen]`
        2. `[PUT INTO, white_holder]`
        """,
    ),
    rule(
        "reflect",
        """\
        The black holder toppled under the pen's weight. None of the corrections helps.

        None
        """,
        contains=["step 2, [PUT INTO, black_holder]"],
    ),
    # Unreadable first: steps without objects.
    rule(
        "reflect",
        """\
        move the apple away, then again:
        1. pick up
        2. place
        3. pick up
        4. insert
        """,
        contains=["step 2, [PUT INTO, white_holder]"],
        turn=0,
    ),
    rule(
        "reflect",
        """\
        pen bounced off the apple that covers the white holder. The corrected task plan:

        1. [PICK UP, apple]
        2. [PUT ON, desk]
        3. [PICK UP, pen]
        4. [PUT INTO, white_holder]

        Then the holder is free.
        """,
        contains=["step 2, [PUT INTO, white_holder]"],
        turn=1,
    ),
]
TASK_6: Rules = [
    rule(
        "branches",
        """\
        One branch:
        Subtasks of branch 1:
        1. [PICK UP, apple]
        2. [PUT INTO, holder]
        3. [PICK UP, holder]
        4. [PUT ON, drawer]
        """,
    ),
    # Forgets half of the task.
    rule("reflect", "Revised plan: [PICK UP, holder] -> [PUT ON, drawer]", turn=0),
    rule(
        "reflect",
        """\
        With the apple in it, the rim cannot be grasped. The order has to change:
        1) [PICK UP, holder]
        2) [PUT ON, drawer]
        3) [PICK UP, apple]
        4) [PUT INTO, apple, holder]
        """,
        turn=1,
    ),
]
TASK_7: Rules = [
    rule(
        "branches",
        """\
        One branch is enough.
        Branch 1:
        1. [PICK UP, apple]
        2. [PUT INTO, holder]
        3. [OPEN, drawer]
        4. [PICK UP, tennis_ball]
        5. [PUT INTO, drawer]
        6. [CLOSE, drawer]
        """,
    ),
    # Opens with the ball in the hand.
    rule(
        "reflect",
        """\
        step 4 [PICK UP, tennis_ball] failed because the open drawer covers the ball.

        1. [PICK UP, apple]
        2. [PUT INTO, holder]
        3. [PICK UP, tennis_ball]  (before it is covered)
        4. [OPEN, drawer]
        5. [PUT INTO, drawer]
        6. [CLOSE, drawer]
        """,
        turn=0,
    ),
    rule(
        "reflect",
        """\
        {"diagnosis": "The open drawer covers the ball, so it must wait on the top.",
         "steps": ["[PICK UP, apple]", "[PUT INTO, holder]", "[PICK UP, tennis_ball]",
                   "[PUT ON, drawer] (safe place)", "[OPEN, drawer]", "[PICK UP, tennis_ball]",
                   "[PUT INTO, drawer]", "[CLOSE, drawer]"]}
        """,
        turn=1,
    ),
]

TASKS: dict[int, Rules] = {1: TASK_1, 2: TASK_2, 4: TASK_4, 5: TASK_5, 6: TASK_6, 7: TASK_7}

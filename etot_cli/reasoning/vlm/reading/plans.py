"""Reading plans: which lines are steps, which steps belong together, which plan is meant."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from typing import Any

from etot_cli.reasoning.vlm.reading.jsons import find_object, looks_like_json, text_field
from etot_cli.reasoning.vlm.reading.steps import (
    Misread,
    RawStep,
    bare_step,
    make_step,
    read_pose,
    read_verb,
    skip_connectors,
    step_at,
)
from etot_cli.reasoning.vlm.reading.text import Line, lines_of
from etot_cli.skills.action import MAX_PLAN_ACTIONS

MAX_PLANS = 64
"""Of one reply, more than any is asked for; a bound on what a runaway reply costs."""
_PLAN_WORD = r"(?:plans?|branch(?:es)?|sequences?|steps?|attempts?|actions?|subtasks?|task plan)"
_REJECTED = re.compile(
    r"(?i)\b(?:original|previous|initial|failed|failing|wrong|incorrect|old|rejected|current|given|"
    rf"existing|input|earlier|bad|infeasible|invalid)\b[^.:]{{0,40}}\b{_PLAN_WORD}\b"
    rf"|\b{_PLAN_WORD}\b[^.:]{{0,30}}\b(?:failed|was|were|which failed|does not work|is wrong)\b"
    r"|\b(?:example|for instance|instead of|do not|don't|before):?\s*$"
)
_MEANT = re.compile(
    r"(?i)\b(?:correct(?:ed|ion|ive)?|revis(?:ed|ion)|new|fixed|final|improved|modified|updated|"
    r"adjusted|better|now)\b"
)
_CORRECTED = re.compile(
    rf"(?i)\b(?:corrected|revised|fixed|final|improved|updated)\b[^.:]{{0,30}}\b{_PLAN_WORD}\b"
)
_BRANCH_TITLE = re.compile(
    r"(?i)^(?:subtasks?\s+(?:of|for)\s+)?(?:branch|plan|option|candidate|alternative)"
    r"\s*(?:#?\d{1,2}|[A-H])?\b[^\[\]]{0,60}$"
)
_NONE = re.compile(
    r"(?im)^[\s>*_#\"'`\[(-]*(?:(?:answer|output|plan|correction|corrected (?:task )?plan|result)"
    r"\s*[:=]\s*)?none[\s*_\"'`\])]*(?:[.!]|$)"
)
_NO_PLAN = re.compile(
    r"(?i)\b(?:no (?:feasible |valid |possible )?(?:correction|revision|corrective (?:task )?plan|"
    r"corrected (?:task )?plan)\b|cannot be corrected|none of the (?:corrections?|abilities) )"
)
_NONE_AT_LAST = re.compile(
    r"(?is)\b(?:answer|output|result|correction|corrected (?:task )?plan|verdict)\s*[:=]\s*none"
    r"[\s*_\"'`\])]*[.!]?\s*$"
)
_BRACKETED = re.compile(r"^[\s>*_`]*\[\s*[A-Za-z][A-Za-z _-]{1,30}\s*(?:,[^\[\]]{0,60})?\]")
MOST_WORDS = 8
"""Of a phrase that is an action and nothing else."""
_TITLE_PREFIX = re.compile(r"^(?P<title>[^\[\](){}<>]{1,90}?[:：])\s*(?P<rest>[\[(（{<【「《⟨].*)$")


@dataclass(frozen=True, slots=True)
class ReadPlan:
    """One plan in a reply. ``problems``: what in it could not be read; it must not be used then."""

    steps: tuple[RawStep, ...]
    problems: tuple[str, ...] = ()
    reason: str = ""


@dataclass(frozen=True, slots=True)
class ReadPlans:
    """All plans of a reply.

    ``none``: it says that there is no plan. ``goal_holds``: it says that nothing is to be done.
    """

    plans: tuple[ReadPlan, ...]
    none: bool = False
    goal_holds: bool = False
    problems: tuple[str, ...] = ()


@dataclass
class _Block:
    """Steps that stand together, and the words above them."""

    title: str
    steps: list[RawStep] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    last: int | None = None
    """Number of its last step, in a numbered list."""
    pending: list[str] = field(default_factory=list)
    """List items since the last step that are no steps."""
    doubtful: list[str] = field(default_factory=list)
    """Lines since the last step that look like steps: an action lost in the middle of a plan
    makes another plan of it."""

    def add(self, step: RawStep | Misread) -> None:
        for text in (*self.pending, *self.doubtful):
            self.problems.append(f"cannot read {text[:60]!r} as an action")
        self.pending.clear()
        self.doubtful.clear()
        if isinstance(step, Misread):
            self.problems.append(step.text)
        elif len(self.steps) >= MAX_PLAN_ACTIONS:
            self.problems.append(f"more than {MAX_PLAN_ACTIONS} actions")
        else:
            self.steps.append(step)

    def plan(self) -> ReadPlan:
        problems = list(self.problems)
        # A list item that begins with a verb is a step in all but form, not a closing remark.
        problems += [
            f"cannot read {text[:60]!r} as an action"
            for text in self.pending
            if read_verb(text) is not None
        ]
        return ReadPlan(tuple(self.steps), tuple(dict.fromkeys(problems))[:5], self.title)


def read_plans(reply: str) -> ReadPlans:
    """All different plans that a reply proposes, in order; quoted and rejected ones left out."""
    data = find_object(reply, "branches", "plans", "plan", "steps", "actions", "goal_holds")
    if data is not None:
        return _from_json(data)
    if looks_like_json(reply):
        return ReadPlans((), problems=("the JSON is damaged or incomplete",))
    lines = lines_of(reply)
    blocks = _blocks(lines, loose=False) or _blocks(lines, loose=True)
    kept = [block for block in blocks if not _is_rejected(block.title)]
    if any(_CORRECTED.search(block.title) for block in kept):
        first = next(i for i, block in enumerate(kept) if _CORRECTED.search(block.title))
        kept = kept[first:]
    plans = _distinct(block.plan() for block in kept)
    none = not plans and bool(_NONE.search(reply) or _NO_PLAN.search(reply))
    return ReadPlans(plans[:MAX_PLANS], none)


def read_revision(reply: str) -> ReadPlans:
    """The one plan that a reply comes to, in ``plans``; its last, where it weighs several."""
    found = read_plans(reply)
    lines = reply.strip().splitlines()
    if found.plans and (_NONE_AT_LAST.search(reply) or (lines and _NONE.match(lines[-1]))):
        # What it weighed before is not what it comes to.
        return ReadPlans((), none=True)
    return ReadPlans(found.plans[-1:], found.none, found.goal_holds, found.problems)


def _distinct(plans: Any) -> tuple[ReadPlan, ...]:
    unique: dict[tuple[object, ...], ReadPlan] = {}
    for plan in plans:
        shape = (plan.steps, plan.problems)
        unique.setdefault(shape, plan)
    return tuple(unique.values())


def _is_rejected(title: str) -> bool:
    """Whether a heading says that what follows is not meant; whole sentences are no headings."""
    if title.endswith((".", "!", ";")):
        return False
    return bool(_REJECTED.search(title)) and not _MEANT.search(title)


# -- prose -------------------------------------------------------------------------------------


def _blocks(lines: list[Line], *, loose: bool) -> list[_Block]:
    """Groups the steps of a reply.

    Args:
        lines: of the reply.
        loose: take bare phrases for steps; only when nothing clearer was found.
    """
    blocks: list[_Block] = []
    block: _Block | None = None
    title = ""
    broken = True  # something stood between the last step and this line
    for line in lines:
        if not line.text:
            continue
        prefix, found = _steps_of(line, loose=loose)
        if not found:
            if (
                block is not None
                and line.number is not None
                and line.number == ((block.last or 0) + 1 + len(block.pending))
            ):
                block.pending.append(line.text)
                continue
            if block is not None and not loose and _looks_like_step(line):
                block.doubtful.append(line.text)
                continue
            if _BRANCH_TITLE.match(line.text) or not (line.indented or line.text.startswith("(")):
                broken = True
                title = line.text
            continue
        follows = block is not None and not prefix and _follows(block, line, title, broken)
        if not follows:
            block = _Block(prefix or title)
            blocks.append(block)
        assert block is not None  # made just above when it was not there
        for step in found:
            block.add(step)
        block.last = line.number if line.number is not None else block.last
        broken = False
        title = ""
    return [block for block in blocks if block.steps or block.problems]


def _looks_like_step(line: Line) -> bool:
    """Whether a line that is no step stands where one should, or in the words of one."""
    if line.text.endswith(":") or _BRANCH_TITLE.match(line.text) or line.indented:
        return False
    if _BRACKETED.match(line.text):
        return True
    phrase = bare_step(line.text)
    return phrase is not None and len(line.text.split()) <= MOST_WORDS


def _follows(block: _Block, line: Line, title: str, broken: bool) -> bool:
    """Whether a step goes on with the block before it."""
    if broken and _BRANCH_TITLE.match(title):
        return False
    if line.number is None or block.last is None:
        return not broken
    # Markdown writers number every item 1 and leave the counting to the reader's program.
    return line.number > block.last or (line.number == block.last and not broken)


def _steps_of(line: Line, *, loose: bool) -> tuple[str, list[RawStep | Misread]]:
    """(Title in front, steps) of a line; no steps when it is not made of steps."""
    title, text = "", line.text
    match = _TITLE_PREFIX.match(text)
    if match and read_verb(match["title"]) is None:
        title, text = match["title"], match["rest"]
        text = re.sub(r"^\d{1,2}[.)]\s*", "", text)
    steps: list[RawStep | Misread] = []
    rest = text
    while len(steps) <= MAX_PLAN_ACTIONS:
        found = step_at(rest, marked=line.marked or bool(title))
        if found is None:
            break
        steps.append(found.step)
        rest = skip_connectors(found.rest)
        if not rest:
            break
    if not steps and loose:
        phrase = bare_step(line.text)
        if phrase is not None and (line.marked or len(line.text.split()) <= 8):
            steps.append(phrase)
    return title, steps


# -- JSON --------------------------------------------------------------------------------------


def _from_json(data: dict[str, Any]) -> ReadPlans:
    holds = data.get("goal_holds") is True
    branches = data.get("branches", data.get("plans"))
    if branches is None:
        branches = [data.get("plan", data.get("steps", data.get("actions")))]
    if not isinstance(branches, list):
        branches = [branches]
    none = all(_is_none(branch) for branch in branches)
    plans = [_branch(branch) for branch in branches[:MAX_PLANS] if not _is_none(branch)]
    return ReadPlans(_distinct(plans), none and not holds, holds)


def _is_none(branch: object) -> bool:
    return (
        branch is None
        or branch in ([], {})
        or (isinstance(branch, str) and branch.strip(" .!\"'").lower() in ("", "none", "null"))
    )


def _branch(branch: object) -> ReadPlan:
    reason = ""
    steps: object = branch
    if isinstance(branch, dict):
        reason = text_field(branch.get("reason") or branch.get("explanation"))
        steps = branch.get("steps", branch.get("actions", branch.get("plan")))
    if isinstance(steps, str):
        read = read_plans(steps) if "{" not in steps else ReadPlans(())
        return replace(read.plans[0], reason=reason) if read.plans else ReadPlan((), ("no steps",))
    if not isinstance(steps, list):
        return ReadPlan((), ("the steps are no list",), reason)
    block = _Block(reason)
    for item in steps[: MAX_PLAN_ACTIONS + 1]:
        block.add(_json_step(item))
    return ReadPlan(tuple(block.steps), tuple(dict.fromkeys(block.problems))[:5], reason[:200])


def _json_step(item: object) -> RawStep | Misread:
    if isinstance(item, str):
        line = lines_of(item[:300] or " ")[0]
        found = step_at(line.text, marked=True)
        step = found.step if found else bare_step(line.text)
        return step if step is not None else Misread(f"cannot read {item[:60]!r} as an action")
    if isinstance(item, list):
        item = {"action": item[0] if item else "", "object": item[-1] if len(item) > 1 else ""}
    if not isinstance(item, dict):
        return Misread("a step is neither text nor an object")
    written = text_field(item.get("action") or item.get("verb") or item.get("skill"))
    head = read_verb(written)
    if head is None:
        return Misread(f"{written[:40]!r} is none of the five actions")
    names = [text_field(item.get(key)) for key in ("object", "target", "location", "destination")]
    note = text_field(item.get("note")) or None
    step = make_step(head[0], [name for name in (head[1], *names) if name.strip()], note)
    pose = read_pose(text_field(item.get("pose")))
    if isinstance(step, RawStep) and pose is not None:
        return replace(step, pose=pose)
    return step

"""The paper's roles, played by a vision-language model.

The model proposes, compares and diagnoses; code reads, resolves and checks everything it says. In
simulation the world's exact state has the last word on success and harm unless asked otherwise.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from etot_cli.reasoning.builtin.acceptance import doubts_of
from etot_cli.reasoning.protocol import (
    Assignment,
    Branch,
    FailedStep,
    Reasoner,
    ReasonerStopped,
    StopReason,
    Verdict,
)
from etot_cli.reasoning.vlm import describe, schemas
from etot_cli.reasoning.vlm.asking import Asker, Reading
from etot_cli.reasoning.vlm.comparing import settle, verdict_of
from etot_cli.reasoning.vlm.frames import FrameSource
from etot_cli.reasoning.vlm.grounding import ground
from etot_cli.reasoning.vlm.instruction import as_given, instruction_of
from etot_cli.reasoning.vlm.notes import NoteKind
from etot_cli.reasoning.vlm.probe import check_sight
from etot_cli.reasoning.vlm.reading.names import Names
from etot_cli.reasoning.vlm.reading.plans import read_plans
from etot_cli.reasoning.vlm.reading.states import ReadComparison, read_comparison, read_scene
from etot_cli.reasoning.vlm.reading.steps import names_pose
from etot_cli.reasoning.vlm.reflecting import Reflection
from etot_cli.reasoning.vlm.settings import Judge
from etot_cli.reasoning.vlm.sight import Seen, Sight
from etot_cli.skills.action import Action
from etot_cli.world.state import RolloutRecord, SceneState

MAX_BRANCHES = 16
"""More proposals than this are not branching but guessing; the first ones are kept."""
BEFORE_AND_AFTER = 2
"""Pictures of which a comparison needs no more."""


class VlmReasoner:
    """Implements :class:`~etot_cli.reasoning.protocol.Reasoner`.

    Args:
        asker: puts questions to the model.
        frames: pictures; None plans from words alone.
        judge: who decides whether an action succeeded.
        state: judges by the world's exact state; None where there is none, as on a real robot, and
            then the model judges alone.
        nominal: tells records of the nominal world from those of varied ones, where there are no
            pictures to tell by; None takes all for nominal.
        marks: number the objects in pictures; None numbers them where names do not tell them apart.
        hints: a failure is told with the simulator's own account of its cause.
        probe: before the first question, find out whether the model sees pictures at all.
    """

    def __init__(
        self,
        asker: Asker,
        *,
        frames: FrameSource | None,
        judge: Judge = "both",
        state: Reasoner | None = None,
        nominal: Callable[[RolloutRecord], bool] | None = None,
        marks: bool | None = None,
        hints: bool = True,
        probe: bool = False,
    ) -> None:
        self._asker = asker
        self._judge: Judge = judge if state is not None else "vlm"
        self._state = state
        self._nominal = nominal
        self._sight = Sight(frames, count=asker.pictures, marks=marks, hints=hints)
        self._probe = probe and not self._sight.blind
        self._instruction = ""
        self._understood = ""
        self._reflection = Reflection(asker, self._sight, hints=hints)

    # -- priori branching ----------------------------------------------------------------------

    def propose(self, assignment: Assignment, scene: SceneState) -> Sequence[Branch]:
        """Scene parsing, task understanding, and all candidate branches that are well formed.

        Raises:
            ReasonerStopped: no usable branch came, a limit was reached, or the service is gone.
        """
        self._instruction = as_given(assignment, self._understood)
        if self._probe:
            check_sight(self._asker)
            self._probe = False
        desk = self._sight.desk(scene)
        names = Names.of_scene(scene, desk.marks)
        values = {
            **desk.words,
            "instruction": self._instruction,
            "relations": describe.relations(scene),
        }

        def read_parse(reply: str) -> Reading[str]:
            seen = read_scene(reply, names)
            return Reading(seen.understanding or None)

        understanding = self._asker.ask("scene", values, desk.pictures, schemas.SCENE, read_parse)
        if not assignment.past:
            self._understood = understanding or ""
        values["understanding"] = understanding or "(nothing was said)"
        doubt = doubts_of(assignment, scene)(scene)
        proposals = _Proposals(scene, names, doubt)
        self._asker.ask("branches", values, desk.pictures, schemas.BRANCHES, proposals.read,
                        objects=values["objects"])  # fmt: skip
        if proposals.branches:
            branches = list(proposals.branches.values())
            if not names_pose(instruction_of(assignment)):
                branches = self._without_idle_poses(branches)
            return branches[:MAX_BRANCHES]
        if proposals.goal_holds:
            return []
        why = self._asker.notes.last("branches")
        raise ReasonerStopped(
            StopReason.NO_ANSWER,
            "the model proposed no plan that is well formed in this scene"
            + (f"; its last answer to the question 'branches': {why}" if why else ""),
        )

    def _without_idle_poses(self, branches: list[Branch]) -> list[Branch]:
        """Branches that differ in nothing but ways to hold, for which nobody asked, become one.

        A grasp that is left open is looked for in every pose; a branch for each would only
        simulate the same plan twice.
        """
        groups: dict[tuple[Action, ...], list[Branch]] = {}
        for branch in branches:
            open_ended = tuple(replace(action, pose=None) for action in branch.actions)
            groups.setdefault(open_ended, []).append(branch)
        kept = []
        for actions, group in groups.items():
            kept.append(group[0] if len(group) == 1 else replace(group[0], actions=actions))
            if len(group) > 1:
                text = "branches that differ in the way to hold, for which nobody asked, are one"
                self._asker.notes.add(NoteKind.DROPPED, "branches", text)
        return kept

    # -- judging -------------------------------------------------------------------------------

    def judge(self, action: Action, record: RolloutRecord) -> Verdict:
        """Compares all objects before and after, by state, by picture, or by both.

        In varied worlds, of which there are no pictures, the state decides alone.

        Raises:
            ReasonerStopped: a limit was reached, or the service is gone.
        """
        by_state = None if self._state is None else self._state.judge(action, record)
        if self._judge == "state" and by_state is not None:
            return by_state
        if self._nominal is not None and by_state is not None and not self._nominal(record):
            return by_state
        shown = self._sight.action(record, BEFORE_AND_AFTER)
        if not shown.pictures and not self._sight.blind and by_state is not None:
            return by_state
        seen = self._compare(action, record, shown)
        if by_state is None:
            return verdict_of(seen, action, record)
        seen, settled = settle(seen, record, by_state)
        for text in settled:
            self._asker.notes.add(NoteKind.SETTLED, "compare", text, action)
        by_model = verdict_of(seen, action, record)
        if by_model.outcome is not by_state.outcome:
            cause = "" if by_state.cause is None else f" ({by_state.cause.text})"
            self._asker.notes.add(
                NoteKind.DISAGREEMENT,
                "compare",
                f"the world's state says {by_state.outcome.value}{cause}, the model says "
                f"{by_model.outcome.value}: {seen.explanation or 'without a reason'}",
                action,
            )
        return by_model if self._judge == "vlm" else by_state

    def _compare(self, action: Action, record: RolloutRecord, shown: Seen) -> ReadComparison:
        names = Names.of_scene(record.after, shown.marks)
        values = {
            **shown.words,
            "action": describe.written(action),
            "instruction": self._instruction,
            # Without pictures, words have to do.
            "events": "" if shown.pictures else (
                f"{describe.changes(record)}\n{describe.events(record)}"
            ),
        }  # fmt: skip

        def read(reply: str) -> Reading[ReadComparison]:
            seen = read_comparison(reply, names)
            if seen.outcome is None and not seen.after:
                return Reading(None, ("it does not say how the objects are after the action",))
            return Reading(seen)

        found = self._asker.ask("compare", values, shown.pictures, schemas.COMPARISON, read,
                                action=action, objects=values["objects"])  # fmt: skip
        return found or ReadComparison({}, {})

    # -- reflective branching ------------------------------------------------------------------

    def reflect(self, failed: FailedStep) -> Sequence[Branch]:
        """The model's one revision, when it is well formed, keeps the purpose, leans on no trick.

        Raises:
            ReasonerStopped: a limit was reached, or the service is gone.
        """
        revised = self._reflection.revise(failed, self._instruction)
        return () if revised is None else (revised,)


class _Proposals:
    """Collects well-formed branches over several replies."""

    def __init__(self, scene: SceneState, names: Names, doubt: str) -> None:
        self._doubt = doubt
        self._scene = scene
        self._names = names
        self._claimed = False
        self.branches: dict[tuple[Action, ...], Branch] = {}
        self.goal_holds = False

    def read(self, reply: str) -> Reading[int]:
        """Takes what is usable of a reply; its value is how many branches there are."""
        found = read_plans(reply)
        reasons = list(found.problems)
        for number, plan in enumerate(found.plans, 1):
            grounded = ground(plan, self._scene, self._names)
            if grounded.actions:
                self.branches.setdefault(
                    grounded.actions, Branch(grounded.actions, plan.reason[:200])
                )
            reasons += [f"branch {number}: {reason}" for reason in grounded.reasons]
        if found.goal_holds and not found.plans and not self.branches:
            # Doing nothing is the one plan that no simulation can refute: it is asked twice.
            self.goal_holds, self._claimed = self._claimed, True
            if not self.goal_holds:
                reasons.append(
                    "you say that nothing is to be done; "
                    + (f"but {self._doubt}; " if self._doubt else "")
                    + "check the arrangement again and, if so, give the same answer once more"
                )
        elif not self.branches and not reasons:
            reasons.append("there are no branches in it")
        return Reading(len(self.branches) or None, tuple(reasons))

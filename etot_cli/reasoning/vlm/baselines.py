"""One-shot planning with a model, without any simulation: what the benchmark compares with.

Either it is asked for a plan from a picture with numbered marks, or it first describes the scene,
then names what needs attention, then plans (chain of thought).
"""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.protocol import Assignment, Branch
from etot_cli.reasoning.vlm import describe
from etot_cli.reasoning.vlm.asking import Asker, Reading
from etot_cli.reasoning.vlm.chat import Picture
from etot_cli.reasoning.vlm.frames import FrameSource
from etot_cli.reasoning.vlm.grounding import ground
from etot_cli.reasoning.vlm.instruction import as_given, instruction_of
from etot_cli.reasoning.vlm.reading.names import Names
from etot_cli.reasoning.vlm.reading.plans import ReadPlan, read_revision
from etot_cli.reasoning.vlm.reading.states import read_scene
from etot_cli.reasoning.vlm.reading.steps import read_pose
from etot_cli.skills.action import Action, GraspPose
from etot_cli.world.state import SceneState

NOTHING = "(nothing was said)"


class OneShot:
    """One task in front of the model.

    Its plans are None where no usable one came; a limit that was reached, or a service that is not
    there, raises ``ReasonerStopped``.
    """

    def __init__(
        self, asker: Asker, frames: FrameSource | None, assignment: Assignment, scene: SceneState
    ) -> None:
        self._asker = asker
        self._scene = scene
        self._pictures: list[Picture] = []
        marks = {}
        if frames is not None:
            marks = dict(frames.marks(scene))
            self._pictures = list(frames.view(scene, marks=True))
        self._names = Names.of_scene(scene, marks)
        self._poses = label_poses(instruction_of(assignment))
        self._values = {
            "instruction": as_given(assignment),
            "objects": describe.object_list(scene),
            "marks": describe.marks_line(marks),
        }

    def at_once(self) -> Branch | None:
        """One plan from one look."""
        return self._plan("oneshot", {})

    def by_steps(self) -> Branch | None:
        """One plan after a description and points of attention."""
        analysis = self._say("cot_scene", {})
        attention = self._say("cot_attention", {"analysis": analysis})
        self._note_labels(analysis)
        return self._plan("cot_plan", {"analysis": analysis, "attention": attention})

    def _say(self, role: str, more: dict[str, str]) -> str:
        """Free text in a role."""
        return self._asker.free_text(role, {**self._values, **more}, self._pictures) or NOTHING

    def _note_labels(self, analysis: str) -> None:
        """Marks that the model takes for ways to hold; the instruction's own word comes first."""
        for number, meaning in read_scene(analysis, self._names).labels.items():
            pose = read_pose(meaning)
            if pose is not None:
                self._poses.setdefault(f"label {number}", pose)

    def _plan(self, role: str, more: dict[str, str]) -> Branch | None:
        """The plan in a role's answer."""

        def read(reply: str) -> Reading[tuple[Action, ...]]:
            found = read_revision(reply)
            if not found.plans:
                return Reading(None, found.problems or ("there is no plan in it",))
            grounded = ground(self._posed(found.plans[0]), self._scene, self._names)
            return Reading(grounded.actions or None, grounded.reasons)

        actions = self._asker.ask(role, {**self._values, **more}, self._pictures, None, read,
                                  objects=self._values["objects"])  # fmt: skip
        return None if actions is None else Branch(actions, role)

    def _posed(self, plan: ReadPlan) -> ReadPlan:
        """Marks that stand for ways to hold become poses."""
        steps = tuple(
            step if step.pose is not None else replace(step, pose=self._poses.get(step.target))
            for step in plan.steps
        )
        return replace(plan, steps=steps)


def label_poses(instruction: str) -> dict[str, GraspPose]:
    """Ways to hold that an instruction gives to marks ("mark 1 represents horizontal grasping")."""
    labels = read_scene(instruction, Names([])).labels
    found = {f"label {number}": read_pose(meaning) for number, meaning in labels.items()}
    return {label: pose for label, pose in found.items() if pose is not None}

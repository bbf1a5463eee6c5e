"""What the nodes of a search led to, and the best plan among them."""

from __future__ import annotations

from etot_cli.control.simulated import Simulated, StateToken, WorldOutcome
from etot_cli.planning.result import Statistics
from etot_cli.planning.survival import NOMINAL, Survival, judge_worlds
from etot_cli.planning.tree import NodeStatus, PlanNode
from etot_cli.reasoning.builtin.acceptance import undone
from etot_cli.reasoning.protocol import Branch, Doubts, FailedStep, Reasoner, Verdict
from etot_cli.skills.action import Action
from etot_cli.world.state import RolloutRecord, SceneState


class Findings:
    """Keeps what was found about every node that was tried.

    Args:
        reasoner: judges.
        worlds: how many every action is tried in.
        min_survival: share of them that must still be alive after an action.
    """

    def __init__(self, reasoner: Reasoner, worlds: int, min_survival: float) -> None:
        self._reasoner, self._min_survival = reasoner, min_survival
        self._worlds = tuple(range(worlds))
        self.statistics = Statistics()
        self.rollouts: dict[int, WorldOutcome] = {}
        self.best: PlanNode | None = None
        self.goal_holds = False
        self.check: Doubts = lambda scene: ""
        """Why what plans lead to is not what was asked for."""
        self._root_state: StateToken = b""
        self._root_scene: SceneState | None = None
        self._end_states: dict[int, StateToken] = {}
        self._failures: dict[int, RolloutRecord] = {}
        self._doubted: dict[tuple[Action, ...], str] = {}

    def begin(self, state: StateToken, scene: SceneState) -> None:
        """Takes note of where all starts."""
        self._root_state, self._root_scene = state, scene

    def judge(self, node: PlanNode, simulated: Simulated) -> None:
        """[VLMJudge] Puts the verdict on the node and keeps what later steps need of it."""
        judgement = judge_worlds(
            self._reasoner, node.action, simulated, self._alive(node.parent), self._min_survival
        )
        node.verdict = judgement.verdict
        node.survived = judgement.survived
        node.losses = judgement.losses
        node.simulated_s = sum(outcome.record.simulated_s for outcome in simulated.outcomes)
        node.steps = sum(outcome.record.steps for outcome in simulated.outcomes)
        node.wall_s = simulated.wall_s
        node.status = NodeStatus(judgement.verdict.outcome.value)
        self.rollouts[node.id] = simulated.outcomes[NOMINAL]
        if node.status is NodeStatus.SUCCESS:
            self._end_states[node.id] = simulated.end
        else:
            self._failures[node.id] = judgement.record
        self.statistics.nodes_evaluated += 1
        self.statistics.simulated_s += node.simulated_s
        self.statistics.steps += node.steps
        self.statistics.physics_s += simulated.physics_s
        self.statistics.kinematics_s += simulated.kinematics_s

    def failed_step(
        self, node: PlanNode, branch: Branch, record: RolloutRecord, verdict: Verdict
    ) -> FailedStep:
        """What is reflected on when a node of a branch has failed."""
        assert self._root_scene is not None  # the root was there before any node
        return FailedStep(branch, node.depth - 1, record, verdict, self._root_scene)

    def failure(self, node: PlanNode) -> RolloutRecord:
        """What happened at a node that was judged to have failed."""
        return self._failures[node.id]

    def scenes(self, node: PlanNode) -> tuple[SceneState, ...]:
        """What the actions up to a node lead through, from the root on."""
        assert self._root_scene is not None  # the root was there before any node
        return self._root_scene, *(self.rollouts[one.id].record.after for one in node.path)

    def offer(self, node: PlanNode) -> None:
        """[extractPath] A plan was found; it is kept when it survives in more worlds."""
        _, *after = self.scenes(node)
        ends = list(zip(node.actions, after, strict=True))
        if not self.does_it(node.actions, after[-1], undone(ends, after[-1])):
            return
        if self.best is None or len(self._alive(node)) > len(self._alive(self.best)):
            self.best = node

    def does_it(self, actions: tuple[Action, ...], final: SceneState, lost: str = "") -> bool:
        """Whether actions that have succeeded also did what was asked for; ``lost``: what of it
        a later one undid, in words.
        """
        if actions not in self._doubted:
            self._doubted[actions] = lost or self.check(final)
        return not self._doubted[actions]

    def can_beat_best(self, node: PlanNode) -> bool:
        """Whether a plan through ``node`` could survive in more worlds than the best one.

        Survivors only become fewer along a path. In a single world no plan beats the first.
        """
        return self.best is None or len(self._alive(node.parent)) > len(self._alive(self.best))

    def _alive(self, node: PlanNode | None) -> tuple[int, ...]:
        """The worlds alive after a successful node; all of them at the root (None)."""
        if node is None:
            return self._worlds
        assert node.survived is not None  # only asked of nodes that have been judged
        return node.survived

    def start_of(self, node: PlanNode) -> StateToken:
        """The state in which a node begins: its parent's end."""
        return self._root_state if node.parent is None else self._end_states[node.parent.id]

    @property
    def found(self) -> bool:
        """Whether there is a plan, were it an empty one."""
        return self.best is not None or self.goal_holds

    def final(self) -> SceneState | None:
        """What the best plan leads to; None without a plan."""
        if self.best is not None:
            return self.rollouts[self.best.id].record.after
        return self._root_scene if self.goal_holds else None

    def survival(self) -> Survival | None:
        """Of the best plan; None without a plan."""
        if self.best is not None:
            return Survival(len(self._alive(self.best)), len(self._worlds))
        return Survival(len(self._worlds), len(self._worlds)) if self.goal_holds else None

    @property
    def doubts(self) -> dict[tuple[Action, ...], str]:
        """Plans that worked and are not what was asked for, with why; those apart with which the
        best plan begins.
        """
        best = None if self.best is None else self.best.actions
        return {
            actions: why
            for actions, why in self._doubted.items()
            if why and (best is None or actions != best[: len(actions)])
        }

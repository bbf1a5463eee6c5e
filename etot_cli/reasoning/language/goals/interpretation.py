"""From syntax trees to a goal: every phrase gets its referents, every clause its steps."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.goal import (
    Close,
    Constraint,
    Goal,
    Keep,
    Open,
    Pick,
    Put,
    Referent,
    Step,
    things_in,
)
from etot_cli.reasoning.builtin.relations import parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.builtin.settling import settled
from etot_cli.reasoning.builtin.wording import formal
from etot_cli.reasoning.language.goals.checks import (
    check_circle,
    check_everything,
    check_held,
    check_kept,
    check_run,
    check_shut,
    check_turns,
)
from etot_cli.reasoning.language.goals.clauses import steps_of
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.left_out import without_places, without_ruled_out
from etot_cli.reasoning.language.goals.plausibility import (
    Moves,
    does_as_well,
    guesses,
    holds_roughly,
    plans_of,
)
from etot_cli.reasoning.language.goals.turns import Timed, continued, in_order
from etot_cli.reasoning.language.grammar.reader import Sentence
from etot_cli.reasoning.language.grammar.spoken import Order, Spoken
from etot_cli.reasoning.language.grammar.syntax import (
    AvoidClause,
    Clause,
    EnsureClause,
    PutClause,
    RemoveClause,
    ReorientClause,
)
from etot_cli.reasoning.language.grammar.trees import reading_cost
from etot_cli.reasoning.language.reference.antecedents import AmbiguousReference, UnclearLandmark
from etot_cli.reasoning.language.reference.discourse import Discourse
from etot_cli.reasoning.language.reference.noun_phrases import Resolver
from etot_cli.reasoning.language.reference.opposites import check_opposites
from etot_cli.reasoning.language.reference.vocabulary import Vocabulary
from etot_cli.reasoning.protocol import ReasonerStopped
from etot_cli.world.state import SceneState

MAX_COMPARED = 6
"""Different goals of one sentence that are compared; more are too many to name."""


def interpret(sentences: Sequence[Sentence], scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """The goal of an instruction about a scene.

    Raises:
        ReferenceProblem: no reading of a sentence fits the scene, or several fit that ask for
            different things.
    """
    state = _State(scene, Discourse(scene), Resolver(scene, vocabulary))
    for sentence in sentences:
        state = _best_reading(state, sentence)
    check_kept(state.goal())
    check_shut(state.goal(), scene)
    check_everything(state.goal())
    check_run(state.goal())
    check_circle(state.goal())
    _check_remarks(state.goal(), state.context.discourse)
    check_turns(state.timed, state.context.discourse)
    goal = without_ruled_out(without_places(state.goal(), state.context.discourse), scene)
    goal = settled(goal, scene, state.context.turned)
    check_held(state.timed, goal, scene)
    _check_decided(goal, state.context.discourse)
    last = state.context.last
    named = isinstance(last, ReorientClause) and last.only_named
    wished = isinstance(last, ReorientClause) and " for " in last.remark  # to be put there?
    if wished or not (goal.steps or state.asked or not (goal.constraints or named)):
        said = "how things are" if named else "what not to do"
        text = sentences[-1 if wished else 0].text
        raise ReferenceProblem(text, f"this says {said}, but not what to do", 2)
    return goal


def _used(goal: Goal) -> set[int]:
    """The referents that the steps of a goal are about."""
    puts = [step for step in goal.steps if isinstance(step, Put)]
    used = {step.what for step in goal.steps if not isinstance(step, Put)}
    used |= {index for step in puts for index in step.what}
    return used | {index for step in puts for place in step.places for index in place.referents()}


def _check_decided(goal: Goal, discourse: Discourse) -> None:
    """Whether "the cup" means one thing.

    Raises:
        AmbiguousReference: several things fit, and neither words nor state tell them apart.
    """
    for index in sorted(_used(goal) & discourse.undecided):
        referent = goal.referents[index]
        if len(referent.options) > 1:
            names = [thing.address for thing in things_in(referent.options)]
            raise AmbiguousReference(referent.text, names)


def _check_remarks(goal: Goal, discourse: Discourse) -> None:
    """Whether something was said of one of several things that may be meant ("the red bowl is
    broken; put the pear in a bowl").
    """
    told = {*discourse.things(*discourse.remarked)}
    for index in sorted(_used(goal)):
        referent = goal.referents[index]
        if index in discourse.remarked and len(referent.options) > 1:  # "one of them is dirty"
            raise AmbiguousReference(referent.text, [t.name for t in things_in(referent.options)])
        free = [option for option in referent.options if not told & {*option}]
        if 0 < len(free) < len(referent.options):
            names = [thing.name for thing in things_in((*free, *referent.options))]
            raise AmbiguousReference(referent.text, names, "something was said of one of them:")


def _check_instead(spoken: Spoken, before: Clause | None) -> None:
    """Whether "instead" takes back what was asked for; what is taken away makes room anyway."""
    room = isinstance(before, RemoveClause) and isinstance(spoken.clause, PutClause)
    room |= isinstance(before, ReorientClause) and before.only_named  # how things are
    denied = (isinstance(before, AvoidClause) and before.negated) or (
        isinstance(before, EnsureClause) and all(state.denied for state in before.states)
    )
    if spoken.instead and before is not None and not (room or denied):
        raise ReferenceProblem("instead", "say only what is to be done", 3, word="instead")


class _State:
    """What has been understood up to some point of an instruction."""

    def __init__(self, scene: SceneState, discourse: Discourse, resolver: Resolver) -> None:
        self._scene, self._resolver = scene, resolver
        self.context = Context(scene, resolver, discourse)
        self.timed: list[Timed] = []
        self.sentence = 0

    @property
    def asked(self) -> bool:
        """Whether anything has been asked for, even if it holds already."""
        return any(item.steps for item in self.timed)

    def copy(self) -> _State:
        """An independent copy, for trying a reading."""
        other = _State(self._scene, self.context.discourse.copy(), self._resolver)
        other.context.turned = list(self.context.turned)
        other.context.done = self.context.done
        other.context.constraints = list(self.context.constraints)
        other.timed = list(self.timed)
        other.sentence, other.context.last = self.sentence, self.context.last
        return other

    def read(self, reading: Sequence[Spoken]) -> None:
        """Reads the clauses in the order they are said, and notes when each is to be done."""
        self.sentence += 1
        steps = {}
        for spoken in sorted(reading, key=lambda item: item.position):
            _check_instead(spoken, self.context.last)
            steps[id(spoken)] = steps_of(spoken.clause, self.context)
            self.context.last = spoken.clause
        check_opposites(self.context.discourse)
        for spoken in reading:
            item = Timed(tuple(steps[id(spoken)]), spoken.order, self.sentence)
            if self.timed and (joined := continued(self.timed[-1], item)):
                self.timed[-1] = joined
            else:
                self.timed.append(item)

    def _narrowed(self, step: Step, after: Step | None) -> bool:
        """Whether the next step says more closely where things go ("carry it over to the bag and
        drop it in", "take it to the stand and set it on the lowest shelf").
        """
        if not (isinstance(step, Put) and isinstance(after, Put)) or step.what != after.what:
            return False
        where, closer = (
            {
                (place.relation, thing)
                for place in put.places
                if place.where is not None and not place.beside
                for thing in self.context.discourse.things(place.where)
            }
            for put in (step, after)
        )
        whole = step.run == after.run and not any(t.part or t.board for _, t in where)
        one, other = ({(how, thing.name) for how, thing in at} for at in (where, closer))
        return step == after or (whole and one == other != set())

    def _constraints(self, steps: Sequence[Step]) -> list[Constraint]:
        """Without what is to stay closed, but is to be opened and closed again: it is so after."""
        opened, closed = (
            {
                f"{part.owner}.{part.name}"
                for step in steps
                if isinstance(step, kind)
                for thing in self.context.discourse.things(step.what)
                for part in parts_of(self._scene, thing)
            }
            for kind in (Open, Close)
        )
        return [
            item
            for item in self.context.constraints
            if item.keep is not Keep.CLOSED or not {*item.names} <= opened & closed
        ]

    def goal(self) -> Goal:
        """The goal so far."""
        discourse = self.context.discourse
        steps = [
            step
            for step, after in pairwise((*in_order(self.timed), None))
            if step is not None and not self._narrowed(step, after)
        ]
        return Goal(
            tuple(discourse.referents),
            tuple(steps),
            tuple(dict.fromkeys(self._constraints(steps))),
            tuple(discourse.notes),
        )


def _best_reading(state: _State, sentence: Sentence) -> _State:
    """The simplest reading that fits the scene; of several, the one that asks for something.

    Raises:
        ReferenceProblem: none fits, or equally simple ones ask for different things.
    """
    problem: ReferenceProblem | None = None
    blame = 0
    found: dict[Goal, _State] = {}
    cost, undecided = -1, 0
    unclear: AmbiguousReference | None = None
    for reading in sentence.readings:
        simplicity = reading_cost(reading)
        if found and simplicity > cost and not undecided:
            break
        attempt = state.copy()
        try:
            attempt.read(reading)
            goal = attempt.goal()
        except ReferenceProblem as error:
            strict = not isinstance(error, UnclearLandmark)
            if isinstance(error, AmbiguousReference) and (
                unclear is None or (strict and isinstance(unclear, UnclearLandmark))
            ):
                unclear = error
            # Of a far-fetched reading it says little that some of its phrases are understood.
            if problem is None or error.weight - simplicity > blame:
                problem, blame = error, error.weight - simplicity
            continue
        meaning = _meaning(goal)
        if found and simplicity > cost:
            if len(attempt.context.discourse.undecided) < undecided and meaning not in found:
                # What would tell "the cup" from others may be said of it.
                _only_one_that_asks(state, sentence, {**found, meaning: attempt})
            continue
        cost = simplicity
        found.setdefault(meaning, attempt)
        undecided = min(len(item.context.discourse.undecided) for item in found.values())
        if len(found) > MAX_COMPARED:
            raise ReferenceProblem(sentence.text, "it can be read in too many ways", 4)
    settled_here = isinstance(unclear, UnclearLandmark) and found and not undecided
    if unclear is not None and not settled_here:
        # What is no simpler than a reading that leaves the choice open settles nothing.
        raise unclear
    if not found:
        assert problem is not None  # a sentence has at least one reading
        raise problem
    odd = {meaning: guesses(attempt.context, attempt.timed) for meaning, attempt in found.items()}
    least = min(odd.values())
    found = {meaning: attempt for meaning, attempt in found.items() if odd[meaning] == least}
    if len(found) == 1:
        return next(iter(found.values()))
    return _only_one_that_asks(state, sentence, found)


def _only_one_that_asks(state: _State, sentence: Sentence, found: dict[Goal, _State]) -> _State:
    plans: dict[tuple[Moves, ...], _State] = {}
    scene = state.context.discourse.scene
    for attempt in found.values():
        with suppress(InstructionError, ReferenceProblem, ReasonerStopped):
            ordered = any(item.order is not Order.SAID for item in attempt.timed)
            plan = plans_of(attempt.goal(), scene, ordered=ordered)
            if plan or holds_roughly(attempt.goal()):
                plans.setdefault(plan, attempt)
    alike = {formal(attempt.goal()): key for key, attempt in reversed(plans.items())}
    plans = {key: attempt for key, attempt in plans.items() if key in alike.values()}
    for key in [*plans]:
        if any(does_as_well(other, key) for other in plans if other != key):
            del plans[key]
    if len(plans) > 1:
        goals = (formal(attempt.goal()) for attempt in plans.values())
        ways = [f"{number}) {goal}" for number, goal in enumerate(goals, 1)]
        raise ReferenceProblem(
            sentence.text, f"it can be read in {len(plans)} ways: {'; '.join(ways)}", 4
        )
    return next(iter((plans or found).values()))


def _meaning(goal: Goal) -> Goal:
    """A goal without the words that it was put in and the referents that no step is about."""
    used: dict[int, int] = {}
    referents: list[Referent] = []

    def renumbered(index: int) -> int:
        if index not in used:
            used[index] = len(referents)
            referents.append(replace(goal.referents[index], text="", distinct_from=()))
        return used[index]

    steps: list[Pick | Put | Open | Close] = []
    for step in goal.steps:
        if isinstance(step, Put):
            places = tuple(
                replace(
                    place,
                    where=None if place.where is None else renumbered(place.where),
                    beside=tuple(
                        replace(near, landmarks=tuple(map(renumbered, near.landmarks)))
                        for near in place.beside
                    ),
                )
                for place in step.places
            )
            steps.append(replace(step, what=tuple(map(renumbered, step.what)), places=places))
        else:
            steps.append(replace(step, what=renumbered(step.what)))
    for index, number in used.items():
        apart = goal.referents[index].distinct_from
        distinct = tuple(sorted(used[other] for other in apart if other in used))
        referents[number] = replace(referents[number], distinct_from=distinct)
    return Goal(tuple(referents), tuple(steps), goal.constraints)

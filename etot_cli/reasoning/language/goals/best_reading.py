"""Which of a sentence's readings is meant."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.goal import Close, Goal, Keep, Open, Pick, Put, Referent
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.builtin.wording import formal
from etot_cli.reasoning.language.goals.as_things_are import decided
from etot_cli.reasoning.language.goals.plausibility import (
    Moves,
    does_as_well,
    guesses,
    holds_roughly,
    plans_of,
    taken_up_again,
    told_needlessly,
)
from etot_cli.reasoning.language.goals.understanding import Understanding
from etot_cli.reasoning.language.grammar.parsers.trees import nodes
from etot_cli.reasoning.language.grammar.sentences.reader import Sentence
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Spoken
from etot_cli.reasoning.language.grammar.syntax.clauses import PickClause
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.reference.memory.antecedents import (
    AmbiguousReference,
    UnclearLandmark,
)
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.reasoning.protocol import ReasonerStopped

MAX_COMPARED = 6
"""Different goals of one sentence that are compared; more are too many to name."""


_APPOSED = Expression(r", the (?:\w+ ){0,2}ones?\b")
"""Behind a place, of what goes there or of the place."""


def best_reading(state: Understanding, sentence: Sentence) -> Understanding:
    """The simplest reading that fits the scene; of several, the one that asks for something.

    Raises:
        ReferenceProblem: none fits, or equally simple ones ask for different things.
    """
    problem: ReferenceProblem | None = None
    blame = 0
    found: dict[Goal, Understanding] = {}
    said: dict[Goal, tuple[Spoken, ...]] = {}
    cost, undecided = -1, 0
    unclear: AmbiguousReference | None = None
    open_to: dict[str, int] = {}
    for reading, simplicity in zip(sentence.readings, sentence.costs, strict=True):
        odd = all(taken_up_again(item.timed) for item in found.values())
        if found and simplicity > cost and not undecided and not odd:
            break
        attempt = state.copy()
        attempt.context.sentence = sentence.text
        try:
            attempt.read(decided(attempt, reading))
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
        if found and any(_told_of(text, reading) > told for text, told in open_to.items()):
            found, cost = {}, simplicity
        if found and odd and not taken_up_again(attempt.timed):
            found, cost = {}, simplicity  # "the cup on the left, lift it"
        if found and simplicity > cost:
            if len(attempt.context.discourse.undecided) < undecided and meaning not in found:
                # What would tell "the cup" from others may be said of it.
                _only_one_that_asks(
                    state, sentence, {**found, meaning: attempt}, {**said, meaning: reading}
                )
            continue
        cost = simplicity
        found.setdefault(meaning, attempt)
        said.setdefault(meaning, reading)
        discourse = found[meaning].context.discourse
        if _APPOSED.search(sentence.text):
            # "Put the can on the tray, the one by the box" tells which can, where there is one tray
            texts = (discourse.referents[index].text for index in discourse.undecided)
            open_to = {text: _told_of(text, reading) for text in texts}
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
    if any(
        isinstance(a.context.last, PickClause) and a.context.last.wanted for a in found.values()
    ):
        # "I need the cup on the left" is about that one, where "the cup" alone leaves it open.
        found = {w: a for w, a in found.items() if len(a.context.discourse.undecided) == undecided}
    doubts = {way: guesses(attempt.context, attempt.timed) for way, attempt in found.items()}
    found = {way: found[way] for way in found if doubts[way] == min(doubts.values())}
    if len(found) == 1:
        return next(iter(found.values()))
    return _only_one_that_asks(state, sentence, found, said)


def _told_of(text: str, reading: tuple[Spoken, ...]) -> int:
    """How much a reading takes to be said, behind the place, of what some words name."""
    named = (np for np in nodes(reading) if isinstance(np, NounPhrase) and np.text == text)
    out = (Prep.EXCEPT, Prep.CONTRAST)
    return max((sum(m.prep not in out for m in np.modifiers) for np in named), default=0)


def _only_one_that_asks(
    state: Understanding,
    sentence: Sentence,
    found: dict[Goal, Understanding],
    said: dict[Goal, tuple[Spoken, ...]],
) -> Understanding:
    plans: dict[tuple[Moves, ...], Understanding] = {}
    unclear = False
    scene = state.context.discourse.scene
    for attempt in found.values():
        with suppress(InstructionError, ReferenceProblem, ReasonerStopped):
            ordered = any(item.order is not Order.SAID for item in attempt.timed)
            plan = plans_of(attempt.goal(), scene, ordered=ordered)
            known = plans.get(plan)
            if not (plan or holds_roughly(attempt.goal())):
                continue
            if known is None or _kept(known.goal()) < _kept(attempt.goal()):
                plans[plan] = attempt
            else:
                unclear |= not _kept(attempt.goal()) <= _kept(known.goal())
    if unclear:
        raise ReferenceProblem(sentence.text, "say what is to stay as it is", 4)
    alike = {formal(attempt.goal()): key for key, attempt in reversed(plans.items())}
    plans = {key: attempt for key, attempt in plans.items() if key in alike.values()}
    for key in [*plans]:
        if any(does_as_well(other, key) for other in plans if other != key):
            del plans[key]
    if len(plans) > 1:
        before = state.copy().context
        needless = {
            key: told_needlessly(before, next(said[way] for way in found if found[way] is attempt))
            for key, attempt in plans.items()
        }
        plans = {key: plans[key] for key in plans if needless[key] == min(needless.values())}
    if len(plans) > 1:
        goals = (formal(attempt.goal()) for attempt in plans.values())
        ways = [f"{number}) {goal}" for number, goal in enumerate(goals, 1)]
        raise ReferenceProblem(
            sentence.text, f"it can be read in {len(plans)} ways: {'; '.join(ways)}", 4
        )
    return next(iter((plans or found).values()))


def _kept(goal: Goal) -> frozenset[tuple[Keep, str | int | None]]:
    """What must not happen on the way to what, so that a word for it is lost in no reading. What is
    to be empty in the end takes nothing in meanwhile either way.
    """
    kept = (item for item in goal.constraints if item.keep is not Keep.AWAY)
    return frozenset(
        (item.keep, about) for item in kept for about in item.names or (item.referent,)
    )


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
    constraints = tuple(
        item if item.referent is None else replace(item, referent=renumbered(item.referent))
        for item in goal.constraints
    )
    for index, number in used.items():
        apart = goal.referents[index].distinct_from
        distinct = tuple(sorted(used[other] for other in apart if other in used))
        referents[number] = replace(referents[number], distinct_from=distinct)
    return Goal(tuple(referents), tuple(steps), constraints)

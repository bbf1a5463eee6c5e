"""From syntax trees to a goal: every phrase gets its referents, every clause its steps."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.branching import branches_of
from etot_cli.reasoning.builtin.determiners import is_distributive
from etot_cli.reasoning.builtin.discourse import Discourse
from etot_cli.reasoning.builtin.distribution import distributed
from etot_cli.reasoning.builtin.goal import (
    Close,
    Goal,
    Grouping,
    Open,
    Pick,
    Place,
    Put,
    Relation,
    Step,
)
from etot_cli.reasoning.builtin.matching import ReferenceProblem
from etot_cli.reasoning.builtin.phrases import Phrases
from etot_cli.reasoning.builtin.reader import Sentence
from etot_cli.reasoning.builtin.references import Resolver, Role
from etot_cli.reasoning.builtin.settling import settled
from etot_cli.reasoning.builtin.syntax import (
    Clause,
    EnsureClause,
    Modifier,
    MoveClause,
    PickClause,
    Prep,
    PutClause,
    RemoveClause,
    Spoken,
    State,
    Things,
    modifier_count,
)
from etot_cli.reasoning.builtin.vocabulary import Vocabulary
from etot_cli.world.state import SceneState


def interpret(sentences: Sequence[Sentence], scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """The goal of an instruction about a scene.

    Raises:
        ReferenceProblem: no reading of a sentence fits the scene.
    """
    state = _Interpreter(scene, Resolver(scene, vocabulary), Discourse(scene))
    for sentence in sentences:
        state = _best_reading(state, sentence)
    goal = Goal(tuple(state.discourse.referents), tuple(state.steps))
    return settled(goal, scene, state.turned)


def _best_reading(state: _Interpreter, sentence: Sentence) -> _Interpreter:
    """The simplest reading that fits the scene; of several, one that asks for something."""
    problem: ReferenceProblem | None = None
    found: list[tuple[int, _Interpreter]] = []
    for reading in sentence.readings:
        simplicity = modifier_count(reading)
        if found and simplicity > found[0][0]:
            break
        attempt = state.copy()
        try:
            attempt.clauses(reading)
        except ReferenceProblem as error:
            if problem is None or error.weight > problem.weight:
                problem = error
            continue
        found.append((simplicity, attempt))
    if not found:
        assert problem is not None  # a sentence has at least one reading
        raise problem
    if len(found) > 1:
        for _, attempt in found:
            goal = Goal(tuple(attempt.discourse.referents), tuple(attempt.steps))
            with suppress(InstructionError):
                if any(True for _ in branches_of((goal,), state.discourse.scene)):
                    return attempt
    return found[0][1]


class _Interpreter:
    """Reads clauses one after the other.

    Args:
        scene: what is spoken about.
        resolver: of phrases with a noun.
        discourse: what was spoken of before; it grows.
    """

    def __init__(self, scene: SceneState, resolver: Resolver, discourse: Discourse) -> None:
        self._scene = scene
        self._resolver = resolver
        self.discourse = discourse
        self.phrases = Phrases(scene, resolver, discourse)
        self.steps: list[Step] = []
        self.turned: list[int] = []
        """Referents that were to be reoriented."""

    def copy(self) -> _Interpreter:
        other = _Interpreter(self._scene, self._resolver, self.discourse.copy())
        other.steps = list(self.steps)
        other.turned = list(self.turned)
        return other

    def clauses(self, reading: Sequence[Spoken]) -> None:
        """Reads the clauses in the order they are said, and adds steps in the order to be done."""
        before = self.steps
        steps: dict[int, list[Step]] = {}
        for spoken in sorted(reading, key=lambda item: item.position):
            self.steps = []
            self.clause(spoken.clause)
            steps[spoken.position] = self.steps
        self.steps = [*before, *(step for item in reading for step in steps[item.position])]

    def clause(self, clause: Clause) -> None:
        """Adds a clause's steps."""
        self.discourse.clause += 1
        match clause:
            case PickClause():
                poses = clause.poses or (None,)
                for index in self.phrases.things(clause.things, Role.THEME):
                    self.steps.append(Pick(index, poses))
            case PutClause():
                self._put(clause)
            case RemoveClause():
                self._remove(clause)
            case MoveClause():
                for index in self.phrases.things(clause.things, Role.PART):
                    self.steps.append(Open(index) if clause.opens else Close(index))
            case EnsureClause():
                for state in clause.states:
                    self._ensure(state)
            case _:
                self.turned += self.phrases.things(clause.things, Role.THEME)

    # -- clauses -----------------------------------------------------------------------------------

    def _put(self, clause: PutClause) -> None:
        for group in clause.groups:
            themes = self.phrases.things(group.things, Role.THEME)
            destinations, grouping = distributed(group, clause.grouping)
            places = self.phrases.places(destinations, themes)
            if any(is_distributive(phrase.determiner) for phrase in group.things.phrases):
                places = tuple(self._spread(place) for place in places)
            places_of = dict.fromkeys(themes, places)
            for condition in clause.conditions:
                self._condition(condition, themes, places_of)
            self._add_puts(places_of, grouping)
            self.discourse.last_places = places

    def _spread(self, place: Place) -> Place:
        """A place whose choice is free for each object ("each pear in a mug")."""
        referent = self.discourse.referents[place.where]
        things = self.discourse.things(place.where)
        if len(referent.options) == 1:
            return place
        self.discourse.referents.append(replace(referent, options=(things,)))
        return replace(place, where=len(self.discourse.referents) - 1)

    def _condition(
        self, condition: State, themes: Sequence[int], places_of: dict[int, tuple[Place, ...]]
    ) -> None:
        """Gives some of the things a place of their own ("… with the plum inside the mug")."""
        if condition.word:
            self._ensure(condition)
            return
        subjects = self.phrases.things(Things(condition.subjects), Role.THEME)
        vessels = [theme for theme in themes if theme not in subjects]
        places = self.phrases.places(condition.destinations, subjects, prefer=vessels)
        for subject in subjects:
            places_of[subject] = places

    def _add_puts(self, places_of: dict[int, tuple[Place, ...]], grouping: Grouping) -> None:
        """One step for each run of things with the same places, in the order of the things."""
        run: list[int] = []
        for index, places in places_of.items():
            if run and places_of[run[-1]] != places:
                self._add_put(run, places_of[run[-1]], grouping)
                run = []
            run.append(index)
        if run:
            self._add_put(run, places_of[run[-1]], grouping)

    def _add_put(
        self,
        themes: Sequence[int],
        places: tuple[Place, ...],
        grouping: Grouping,
        *,
        removal: bool = False,
    ) -> None:
        targets = {thing.name for place in places for thing in self.discourse.things(place.where)}
        for theme in themes:
            referent = self.discourse.referents[theme]
            # "Put everything into the box": the box itself is not meant.
            options = tuple(
                tuple(thing for thing in option if thing.name not in targets)
                if len(option) > 1
                else option
                for option in referent.options
            )
            if not all(options):
                raise ReferenceProblem(referent.text, "nothing can be put into or on itself", 2)
            self.discourse.referents[theme] = replace(referent, options=options)
            if len(places) == 1 and places[0].relation is Relation.INSIDE:
                self.discourse.put_into[theme] = places[0].where
            else:
                self.discourse.put_into.pop(theme, None)
        self.steps.append(Put(tuple(themes), places, grouping, removal=removal))

    def _remove(self, clause: RemoveClause) -> None:
        things = clause.things
        if clause.source is not None:
            modifier = Modifier(Prep.FROM, (clause.source,))
            things = replace(
                things,
                phrases=tuple(
                    replace(phrase, modifiers=(*phrase.modifiers, modifier))
                    for phrase in things.phrases
                ),
            )
        themes = self.phrases.things(things, Role.THEME)
        self._add_put(themes, (self.phrases.on_the_desk(),), Grouping.ANY, removal=True)

    def _ensure(self, state: State) -> None:
        if state.word:
            for phrase in state.subjects:
                for index in self.phrases.refer(phrase, Role.PART):
                    step = Open(index, final=True) if state.word == "open" else None
                    self.steps.append(step or Close(index, final=True))
            return
        themes = self.phrases.things(Things(state.subjects), Role.THEME)
        places = self.phrases.places(state.destinations, themes)
        self._add_put(themes, places, Grouping.ANY)
        self.discourse.last_places = places

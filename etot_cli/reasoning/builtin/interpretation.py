"""From syntax trees to a goal: every phrase gets its referents, every clause its steps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from etot_cli.reasoning.builtin.branching import branches_of
from etot_cli.reasoning.builtin.determiners import quantity_of
from etot_cli.reasoning.builtin.discourse import PLURAL_PRONOUNS, Discourse
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
    Thing,
)
from etot_cli.reasoning.builtin.matching import ReferenceProblem
from etot_cli.reasoning.builtin.reader import Sentence
from etot_cli.reasoning.builtin.references import Resolved, Resolver, Role, can_be, is_robot
from etot_cli.reasoning.builtin.relations import is_on
from etot_cli.reasoning.builtin.settling import settled
from etot_cli.reasoning.builtin.syntax import (
    Clause,
    Destination,
    EnsureClause,
    Modifier,
    MoveClause,
    NounPhrase,
    PickClause,
    Prep,
    PutClause,
    RemoveClause,
    State,
    Things,
    Toward,
    modifier_count,
)
from etot_cli.reasoning.builtin.vocabulary import Vocabulary
from etot_cli.world.state import DESK, SceneState

_DESK = Resolved(((Thing(DESK),),), definite=True, other=False, noun=DESK)


def interpret(sentences: Sequence[Sentence], scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """The goal of an instruction about a scene.

    Raises:
        ReferenceProblem: no reading of a sentence fits the scene.
    """
    state = _Interpreter(scene, Resolver(scene, vocabulary), Discourse(scene))
    for sentence in sentences:
        state = _best_reading(state, sentence)
    return settled(Goal(tuple(state.discourse.referents), tuple(state.steps)), state.turned)


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
            for clause in reading:
                attempt.clause(clause)
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
            if branches_of((goal,), state.discourse.scene):
                return attempt
    return found[0][1]


class _Interpreter:
    def __init__(self, scene: SceneState, resolver: Resolver, discourse: Discourse) -> None:
        self._scene = scene
        self._resolver = resolver
        self.discourse = discourse
        self.steps: list[Step] = []
        self.turned: list[int] = []
        """Referents that were to be reoriented."""

    def copy(self) -> _Interpreter:
        other = _Interpreter(self._scene, self._resolver, self.discourse.copy())
        other.steps = list(self.steps)
        other.turned = list(self.turned)
        return other

    def clause(self, clause: Clause) -> None:
        self.discourse.clause += 1
        match clause:
            case PickClause():
                poses = clause.poses or (None,)
                for index in self._things(clause.things, Role.THEME):
                    self.steps.append(Pick(index, poses))
            case PutClause():
                self._put(clause)
            case RemoveClause():
                self._remove(clause)
            case MoveClause():
                for index in self._things(clause.things, Role.PART):
                    self.steps.append(Open(index) if clause.opens else Close(index))
            case EnsureClause():
                for state in clause.states:
                    self._ensure(state)
            case _:
                self.turned += self._things(clause.things, Role.THEME)

    # -- clauses -----------------------------------------------------------------------------------

    def _put(self, clause: PutClause) -> None:
        for group in clause.groups:
            themes = self._things(group.things, Role.THEME)
            places = self._places(group.destinations, themes)
            places_of = dict.fromkeys(themes, places)
            for condition in clause.conditions:
                self._condition(condition, themes, places_of)
            self._add_puts(places_of, clause.grouping)
            self.discourse.last_places = places

    def _condition(
        self, condition: State, themes: Sequence[int], places_of: dict[int, tuple[Place, ...]]
    ) -> None:
        """Gives some of the things a place of their own ("… with the plum inside the mug")."""
        if condition.word:
            self._ensure(condition)
            return
        subjects = [
            index for phrase in condition.subjects for index in self._refer(phrase, Role.THEME)
        ]
        vessels = [theme for theme in themes if theme not in subjects]
        places = self._places(condition.destinations, subjects, prefer=vessels)
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
        self, themes: Sequence[int], places: tuple[Place, ...], grouping: Grouping
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
            self.discourse.referents[theme] = replace(referent, options=options)
            if len(places) == 1 and places[0].relation is Relation.INSIDE:
                self.discourse.put_into[theme] = places[0].where
            else:
                self.discourse.put_into.pop(theme, None)
        self.steps.append(Put(tuple(themes), places, grouping))

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
        themes = self._things(things, Role.THEME)
        for index in themes:
            if all(is_on(self._scene, t.name, DESK) for t in self.discourse.things(index)):
                text = self.discourse.referents[index].text
                raise ReferenceProblem(text, "it stands on the desk; say where it is to go", 2)
        desk = self.discourse.add(_DESK, DESK, Role.SURFACE)
        self._add_put(themes, (Place(Relation.ON, desk),), Grouping.ANY)

    def _ensure(self, state: State) -> None:
        if state.word:
            for phrase in state.subjects:
                for index in self._refer(phrase, Role.PART):
                    step = Open(index, final=True) if state.word == "open" else None
                    self.steps.append(step or Close(index, final=True))
            return
        themes = [index for phrase in state.subjects for index in self._refer(phrase, Role.THEME)]
        places = self._places(state.destinations, themes)
        self._add_put(themes, places, Grouping.ANY)
        self.discourse.last_places = places

    # -- phrases -----------------------------------------------------------------------------------

    def _things(self, things: Things, role: Role) -> list[int]:
        """Referents of coordinated phrases; alternatives become one referent."""
        if not things.either:
            found = [index for phrase in things.phrases for index in self._refer(phrase, role)]
            return list(dict.fromkeys(found))
        resolved = [self._resolved(phrase, role) for phrase in things.phrases]
        options = tuple(dict.fromkeys(option for item in resolved for option in item.options))
        either = Resolved(options, definite=False, other=False, noun=resolved[-1].noun)
        text = " or ".join(phrase.text for phrase in things.phrases)
        return [self.discourse.add(either, text, role)]

    def _refer(
        self, phrase: NounPhrase, role: Role, excluded: Sequence[int] = ()
    ) -> tuple[int, ...]:
        """The referents of a phrase, none of ``excluded``; a plural pronoun may have several."""
        plain_pronoun = phrase.pronoun and not phrase.modifiers
        if plain_pronoun and not _chooses(phrase.determiner):
            found = self.discourse.antecedents(
                "them" if phrase.determiner else phrase.pronoun, role, phrase.text, excluded
            )
            for index in found:
                self.discourse.mention_again(index, role)
            return found
        index = self.discourse.add(self._resolved(phrase, role), phrase.text, role)
        self._note_landmarks(phrase)
        return (index,)

    def _note_landmarks(self, phrase: NounPhrase) -> None:
        """Things that were only mentioned to tell others by can be spoken of later on."""
        owner = () if phrase.owner is None else (phrase.owner,)
        named = [item for modifier in phrase.modifiers for item in modifier.phrases]
        for landmark in (*owner, *named):
            if landmark.words and not is_robot(landmark):
                resolved = self._resolver.resolve(landmark, Role.ANY, pronoun=self._pronoun_things)
                self.discourse.add(resolved, landmark.text, Role.ANY)

    def _resolved(self, phrase: NounPhrase, role: Role) -> Resolved:
        discourse = self.discourse
        if phrase.pronoun and not phrase.modifiers:  # "one of them"
            indices = discourse.antecedents("them", role, phrase.text)
            things = dict.fromkeys(thing for i in indices for thing in discourse.things(i))
            options = tuple((thing,) for thing in things)
            noun = discourse.last_noun(role) or ""
            return Resolved(options, definite=False, other=False, noun=noun)
        if phrase.pronoun:  # "those on the desk"
            noun = discourse.last_noun(role) or "object"
            plural = phrase.pronoun in PLURAL_PRONOUNS
            phrase = replace(
                phrase, pronoun="", determiner="all" if plural else "the", words=(noun,)
            )
        if phrase.determiner.startswith("its"):
            owner = Modifier(Prep.OF, (NounPhrase(pronoun="it", text="its"),))
            phrase = replace(phrase, modifiers=(owner, *phrase.modifiers))
        noun_before = discourse.last_noun(role)
        return self._resolver.resolve(
            phrase,
            role,
            noun=noun_before,
            excluded=discourse.mentioned_like(noun_before),
            pronoun=self._pronoun_things,
        )

    def _pronoun_things(self, phrase: NounPhrase) -> tuple[Thing, ...]:
        indices = self.discourse.antecedents(phrase.pronoun, Role.ANY, phrase.text)
        return tuple(thing for index in indices for thing in self.discourse.things(index))

    def _places(
        self,
        destinations: Sequence[Destination],
        themes: Sequence[int],
        prefer: Sequence[int] = (),
    ) -> tuple[Place, ...]:
        """Alternative places. ``prefer``: referents that "inside" means before any other."""
        places: dict[Place, None] = {}
        for destination in destinations:
            if destination.toward is Toward.HERE:
                places.update(dict.fromkeys(self._here(destination.word, themes, prefer)))
                continue
            for phrase in destination.targets:
                places.update(dict.fromkeys(self._targets(destination.toward, phrase, themes)))
        return tuple(places)

    def _targets(self, toward: Toward, phrase: NounPhrase, themes: Sequence[int]) -> list[Place]:
        role = {Toward.INSIDE: Role.CONTAINER, Toward.ON: Role.SURFACE}.get(toward, Role.PLACE)
        found = []
        for index in self._refer(phrase, role, themes):
            options = self.discourse.referents[index].options
            if quantity_of(phrase.determiner).every and any(len(option) > 1 for option in options):
                raise ReferenceProblem(phrase.text, "say what is to go into or on which", 2)
            if index in themes and len(self.discourse.referents[index].options) == 1:
                raise ReferenceProblem(phrase.text, "nothing can be put into or on itself", 2)
            things = self.discourse.things(index)
            fits_in = any(can_be(thing, Role.CONTAINER, self._scene) for thing in things)
            fits_on = any(can_be(thing, Role.SURFACE, self._scene) for thing in things)
            if fits_in and (toward is not Toward.ON or not fits_on):
                found.append(Place(Relation.INSIDE, index))
            if fits_on and toward is not Toward.INSIDE:
                found.append(Place(Relation.ON, index))
        return found

    def _here(self, word: str, themes: Sequence[int], prefer: Sequence[int]) -> tuple[Place, ...]:
        discourse = self.discourse
        if word == "down":
            return (Place(Relation.ON, discourse.add(_DESK, DESK, Role.SURFACE)),)
        if word == "there" and discourse.last_places:
            return discourse.last_places
        relation = Relation.ON if word in ("on there", "on top") else Relation.INSIDE
        for index in prefer:
            if any(can_be(t, Role.CONTAINER, self._scene) for t in discourse.things(index)):
                return (Place(relation, index),)
        return (discourse.latest_place(relation, themes, word),)


def _chooses(determiner: str) -> bool:
    """Whether a determiner before a pronoun picks some of them ("one of them")."""
    return bool(determiner) and determiner.split()[0] not in ("all", "both", "each", "every")

"""What each kind of clause asks for: its phrases' referents, and steps about them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from etot_cli.reasoning.builtin.goal import (
    Close,
    Constraint,
    Grouping,
    Keep,
    Near,
    Open,
    Pick,
    Place,
    Put,
    Referent,
    Relation,
    Step,
    Thing,
)
from etot_cli.reasoning.builtin.relations import is_closed, is_open
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.syntax import (
    Avoid,
    AvoidClause,
    Clause,
    Destination,
    EnsureClause,
    Modifier,
    MoveClause,
    NounPhrase,
    PickClause,
    PutClause,
    PutGroup,
    RemoveClause,
    State,
    SwapClause,
    Things,
    Toward,
    TowerClause,
)
from etot_cli.reasoning.language.reference.coreference import Discourse
from etot_cli.reasoning.language.reference.determiners import is_distributive
from etot_cli.reasoning.language.reference.distribution import distributed
from etot_cli.reasoning.language.reference.noun_phrases import Resolved, Resolver
from etot_cli.reasoning.language.reference.referents import Phrases, lies_on
from etot_cli.reasoning.language.words.lexicon import is_descriptive, singular
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK, SceneState

_KEEPS = {
    Avoid.TOUCH: Keep.UNTOUCHED,
    Avoid.MOVE: Keep.UNMOVED,
    Avoid.OPEN: Keep.CLOSED,
    Avoid.CLOSE: Keep.OPEN,
}


class Clauses:
    """Reads clauses one after the other.

    Args:
        scene: what is spoken about.
        resolver: of phrases with a noun.
        discourse: what was spoken of before; it grows.
    """

    def __init__(self, scene: SceneState, resolver: Resolver, discourse: Discourse) -> None:
        self._scene = scene
        self.discourse = discourse
        self.phrases = Phrases(scene, resolver, discourse)
        self.turned: list[int] = []
        """Referents that were to be reoriented."""
        self.constraints: list[Constraint] = []
        self._steps: list[Step] = []

    def read(self, clause: Clause) -> list[Step]:
        """A clause's steps.

        Raises:
            ReferenceProblem: a phrase of it cannot be resolved, or it asks for what no skill does.
        """
        self.discourse.clause += 1
        self._steps = []
        match clause:
            case PickClause():
                poses = clause.poses or (None,)
                for index in self.phrases.things(clause.things, Role.THEME):
                    self._steps.append(Pick(index, poses))
            case PutClause():
                self._put(clause)
            case RemoveClause():
                self._remove(clause)
            case MoveClause():
                for index in self.phrases.things(clause.things, Role.PART):
                    self._steps.append(Open(index) if clause.opens else Close(index))
            case EnsureClause():
                for state in clause.states:
                    self._ensure(state)
            case TowerClause():
                self._tower(clause)
            case SwapClause():
                self._swap(clause)
            case AvoidClause():
                self._avoid(clause)
            case _:
                self.turned += self.phrases.things(clause.things, Role.THEME)
        return self._steps

    # -- putting -----------------------------------------------------------------------------------

    def _put(self, clause: PutClause) -> None:
        if clause.first and len(clause.groups) > 1:
            text = " and ".join(phrase.text for phrase in clause.first)
            raise ReferenceProblem(text, "say the order in a sentence of its own", 2)
        for group in clause.groups:
            themes = self._in_said_order(group, clause.first)
            if any(item.toward is Toward.HOME for item in group.destinations):
                self._put_back(themes, group)
                continue
            destinations, grouping = distributed(group, clause.grouping)
            places = self.phrases.places(destinations, themes)
            if any(is_distributive(phrase.determiner) for phrase in group.things.phrases):
                places = tuple(self._spread(place) for place in places)
            places_of = dict.fromkeys(themes, places)
            for condition in clause.conditions:
                self._condition(condition, themes, places_of)
            self._add_puts(places_of, grouping)
            self.discourse.last_places = places
            if clause.ruled_out:
                self._rule_out(themes, clause.ruled_out)

    def _rule_out(self, themes: Sequence[int], destinations: Sequence[Destination]) -> None:
        """Says where things must not be put."""
        names = {thing.name: None for index in themes for thing in self.discourse.things(index)}
        text = " and ".join(self.discourse.referents[index].text for index in themes)
        places: list[tuple[Relation, str]] = []
        for place in self.phrases.places(destinations, themes):
            if place.beside or place.where is None:
                raise ReferenceProblem(text, "only containers and surfaces can be ruled out", 2)
            for thing in self.discourse.things(place.where):
                places += [(place.relation, item) for item in self._addresses(thing, place)]
        self.constraints.append(Constraint(Keep.AWAY, tuple(names), tuple(places)))

    def _in_said_order(self, group: PutGroup, first: Sequence[NounPhrase]) -> list[int]:
        """The things of a group, those that are to go first before the others."""
        themes = self.phrases.things(group.things, Role.THEME)
        if not first:
            return themes
        noun = group.things.phrases[-1].words[-1:]
        ahead: list[Thing] = []
        for phrase in first:
            spoken = phrase if phrase.words[-1:] == noun else self._with_noun(phrase, noun)
            resolved = self.phrases.meaning(spoken, Role.THEME)
            if len(resolved.options) != 1:
                raise ReferenceProblem(phrase.text, "say which one goes first", 2)
            ahead += resolved.options[0]
        things = [thing for index in themes for thing in self._only(index, "say which ones")]
        if not all(thing in things for thing in ahead):
            raise ReferenceProblem(first[0].text, "it is none of what is to be put", 2)
        ordered = [*ahead, *(thing for thing in things if thing not in ahead)]
        text = " and ".join(phrase.text for phrase in group.things.phrases)
        return [self._single(thing, text) for thing in ordered]

    def _with_noun(self, phrase: NounPhrase, noun: tuple[str, ...]) -> NounPhrase:
        """An elliptic phrase ("blue first") with the noun that it leaves out."""
        single = tuple(map(singular, noun))
        if phrase.words[-1:] in (("one",), ("ones",)):
            kept = single if phrase.words[-1] == "one" else noun
            return replace(phrase, words=(*phrase.words[:-1], *kept))
        # An adjective alone leaves its noun out; anything else is a noun of its own.
        descriptive = phrase.words and all(map(is_descriptive, phrase.words))
        return replace(phrase, words=(*phrase.words, *single)) if descriptive else phrase

    def _single(self, thing: Thing, text: str) -> int:
        """A referent for one thing."""
        alone = Resolved(((thing,),), definite=True, other=False, noun=thing.name)
        return self.discourse.add(alone, text, Role.THEME)

    def _only(self, index: int, why: str) -> tuple[Thing, ...]:
        """What a referent stands for, where there must be no choice."""
        referent = self.discourse.referents[index]
        if len(referent.options) != 1:
            raise ReferenceProblem(referent.text, why, 2)
        return referent.options[0]

    def _put_back(self, themes: Sequence[int], group: PutGroup) -> None:
        """Puts things back to where they are at the start."""
        if len(group.destinations) > 1:
            raise ReferenceProblem(group.destinations[0].word or "back", "say one place only", 2)
        for index in themes:
            for thing in self._only(index, "say which one goes back"):
                place = self._home(thing)
                self._steps.append(Put((self._single(thing, thing.name),), (place,)))

    def _home(self, thing: Thing) -> Place:
        """Where a thing is at the start; on the desk the very spot."""
        state = self._scene.states[thing.name]
        if state.inside is not None:
            owner, _, part = state.inside.partition(".")
            return Place(Relation.INSIDE, self._referent(Thing(owner, part or None)))
        if not state.on:
            raise ReferenceProblem(thing.name, "it is not known where it was", 2)
        owner, _, board = state.on[0].partition(".")
        info = self._scene.infos.get(owner)
        surface = Thing(owner, board=board if info is not None and board in info.boards else None)
        if owner != DESK:
            return Place(Relation.ON, self._referent(surface))
        point = (round(state.position[0], 3), round(state.position[1], 3))
        return Place(Relation.ON, self._referent(surface), (Near(Nearby.AT_POINT, point=point),))

    def _referent(self, thing: Thing) -> int:
        referent = Referent(((thing,),), thing.name)
        if referent not in self.discourse.referents:
            self.discourse.referents.append(referent)
        return self.discourse.referents.index(referent)

    def _spread(self, place: Place) -> Place:
        """A place whose choice is free for each object ("each pear in a mug")."""
        if place.where is None:
            return place
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
        discourse = self.discourse
        targets = {
            thing.name
            for place in places
            for index in place.referents()
            for thing in discourse.things(index)
        }
        for theme in themes:
            referent = discourse.referents[theme]
            # "Put everything into the box": the box itself is not meant.
            options = tuple(
                tuple(thing for thing in option if thing.name not in targets)
                if len(option) > 1
                else option
                for option in referent.options
            )
            if not all(options):
                raise ReferenceProblem(referent.text, "nothing can be put into or on itself", 2)
            discourse.referents[theme] = replace(referent, options=options)
            where = places[0].where if len(places) == 1 else None
            if where is not None and places[0].relation is Relation.INSIDE:
                discourse.put_into[theme] = where
            else:
                discourse.put_into.pop(theme, None)
        self.discourse.put |= {*themes}
        self._steps.append(Put(tuple(themes), places, grouping, removal=removal))

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
                    if state.kept:
                        self._keep(index, state.word)
                    step = Open(index, final=True) if state.word == "open" else None
                    self._steps.append(step or Close(index, final=True))
            return
        themes = self.phrases.things(Things(state.subjects), Role.THEME)
        if any(item.toward is Toward.HOME for item in state.destinations):
            self._put_back(themes, PutGroup(Things(state.subjects), state.destinations))
            return
        places = self.phrases.places(state.destinations, themes)
        again = [index for index in themes if index in self.discourse.put]
        if again and any(place.beside for place in places):
            text = self.discourse.referents[again[0]].text
            why = "say where it goes in one: 'on the tray, next to the cup'"
            raise ReferenceProblem(text, why, 3)
        self._add_put(themes, places, Grouping.ANY)
        self.discourse.last_places = places

    def _keep(self, index: int, word: str) -> None:
        """What is open or closed by now, and is to stay so, must not be moved in between."""
        opened = word == "open"
        for thing in self.discourse.things(index):
            for part in self._scene.infos[thing.name].parts:
                if thing.part not in (None, part.name):
                    continue
                if (is_open if opened else is_closed)(self._scene, part):
                    keep = Keep.OPEN if opened else Keep.CLOSED
                    name = f"{part.owner}.{part.name}"
                    self.constraints.append(Constraint(keep, (name,)))

    # -- larger commands ---------------------------------------------------------------------------

    def _tower(self, clause: TowerClause) -> None:
        """Everything upon each other, from the bottom up; the bottom one stays where it is."""
        themes = self.phrases.things(clause.things, Role.THEME)
        things = [
            thing for index in themes for thing in self._only(index, "say which ones to stack")
        ]
        text = " and ".join(phrase.text for phrase in clause.things.phrases)
        if len(things) < 2 and not clause.base:
            raise ReferenceProblem(text, "a stack needs at least two things", 2)
        if len(things) > 1:
            things = self._upward(things, clause, text, listed=len(themes) > 1)
        indices = [self._single(thing, thing.name) for thing in things]
        bottom = indices[0]
        if clause.base:
            places = self.phrases.places(clause.base, indices)
            self._steps.append(Put((indices[0],), places))
            under = places[0].where
            if len(things) == 1 and len(places) == 1 and under is not None:
                bottom = under
        for below, above in pairwise(indices):
            lower, upper = things[indices.index(below)], things[indices.index(above)]
            self._steps.append(Put((above,), (self._upon(lower, upper, below),)))
        self.discourse.stacks[self.discourse.clause] = bottom

    def _upon(self, thing: Thing, upper: Thing, index: int) -> Place:
        """On a thing, or into a vessel whose mouth is wider than what goes there."""
        on = can_be(thing, Role.SURFACE, self._scene)
        if on and lies_on([upper], thing, self._scene):
            return Place(Relation.ON, index)
        if can_be(thing, Role.CONTAINER, self._scene):
            return Place(Relation.INSIDE, index)
        raise ReferenceProblem(thing.name, "nothing can stand on it", 2)

    def _upward(
        self, things: list[Thing], clause: TowerClause, text: str, *, listed: bool
    ) -> list[Thing]:
        """The things of a tower from the bottom up, as it is said or by size."""
        ordered = list(things)
        if clause.upward is not None:
            if not listed:
                raise ReferenceProblem(text, "name them one by one to say their order", 2)
            return ordered if clause.upward else ordered[::-1]
        ends = {"bottom": clause.bottom, "top": clause.top}
        named = {end: self._end(phrase, things) for end, phrase in ends.items() if phrase}
        rest = [thing for thing in ordered if thing not in named.values()]
        if len(rest) > 1 or (rest and not named):
            # The widest below, and of equals the one that is named first.
            rest.sort(key=lambda thing: -max(self._scene.infos[thing.name].size[:2]))
            order = ", ".join(thing.name for thing in rest)
            self.discourse.notes.append(f"stack from the bottom up, by width: {order}")
        bottom = [named["bottom"]] if "bottom" in named else []
        top = [named["top"]] if "top" in named else []
        return [*bottom, *rest, *top]

    def _end(self, phrase: NounPhrase, things: Sequence[Thing]) -> Thing:
        resolved = self.phrases.meaning(phrase, Role.THEME)
        found = [option[0] for option in resolved.options if option[0] in things]
        if len(found) != 1:
            raise ReferenceProblem(phrase.text, "it is not one of what is to be stacked", 2)
        return found[0]

    def _swap(self, clause: SwapClause) -> None:
        """Each of two things to the other's place; the first one waits on the desk."""
        themes = self.phrases.things(clause.things, Role.THEME)
        things = [thing for index in themes for thing in self._only(index, "say which two")]
        text = " and ".join(phrase.text for phrase in clause.things.phrases)
        if len(things) != 2:
            raise ReferenceProblem(text, "two things can be swapped, no more and no less", 2)
        homes = [self._home(thing) for thing in things]
        if self._carries(things[0], things[1]) or self._carries(things[1], things[0]):
            raise ReferenceProblem(text, "one of them is in or on the other", 2)
        if homes[0] == homes[1]:
            raise ReferenceProblem(text, "they are in the same place", 2)
        first, second = (self._single(thing, thing.name) for thing in things)
        self._steps += [
            Put((first,), (self.phrases.on_the_desk(),), aside=True),
            Put((second,), (homes[0],)),
            Put((first,), (homes[1],)),
        ]

    def _carries(self, below: Thing, above: Thing) -> bool:
        state = self._scene.states[above.name]
        around = [*state.on, *([state.inside] if state.inside else [])]
        return any(item.partition(".")[0] == below.name for item in around)

    # -- what must not be done ---------------------------------------------------------------------

    def _avoid(self, clause: AvoidClause) -> None:
        if clause.things is None:
            self._avoid_others(clause)
            return
        role = Role.PART if clause.avoid in (Avoid.OPEN, Avoid.CLOSE) else Role.ANY
        before = len(self.discourse.mentions)
        indices = self.phrases.things(clause.things, role)
        # "Without touching a cup" is about all of them.
        things = {thing: None for index in indices for thing in self.discourse.things(index)}
        names = tuple(dict.fromkeys(self._address(thing, role) for thing in things))
        if DESK in names:
            raise ReferenceProblem("desk", "the desk cannot be left untouched", 2)
        if clause.avoid is Avoid.PUT:
            self._rule_out(indices, clause.destinations)
            del self.discourse.mentions[before:]
            return
        # What must not be done is not what "it" speaks of afterwards.
        del self.discourse.mentions[before:]
        self.constraints.append(Constraint(_KEEPS[clause.avoid], names))

    def _avoid_others(self, clause: AvoidClause) -> None:
        """Nothing but what was spoken of may be touched or moved."""
        spoken = {
            thing.name
            for referent in self.discourse.referents
            for option in referent.options
            for thing in option
        }
        others = tuple(
            name for name, info in self._scene.infos.items() if name not in spoken and info.movable
        )
        if others:
            self.constraints.append(Constraint(_KEEPS[clause.avoid], others))

    def _address(self, thing: Thing, role: Role) -> str:
        if role is Role.PART and thing.part is not None:
            return f"{thing.name}.{thing.part}"
        return thing.name

    def _addresses(self, thing: Thing, place: Place) -> list[str]:
        if place.relation is Relation.ON or thing.name == DESK:
            return [f"{thing.name}.{thing.board}" if thing.board else thing.name]
        info = self._scene.infos[thing.name]
        parts = [part.address for part in info.parts if thing.part in (None, part.name)]
        return [thing.name, *parts] if thing.part is None else parts

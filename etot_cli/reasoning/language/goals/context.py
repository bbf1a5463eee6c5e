"""What has been understood so far, which every clause reads and adds to."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial

from msgspec import Struct, structs

from etot_cli.reasoning.builtin.goal import (
    Constraint,
    Near,
    Place,
    Put,
    Referent,
    Relation,
    Step,
    Thing,
)
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.sentences.spoken import Order
from etot_cli.reasoning.language.grammar.syntax.clauses import Clause
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, NounPhrase, Things
from etot_cli.reasoning.language.reference.choosing.noun_phrases import Resolver
from etot_cli.reasoning.language.reference.geometry.space import rests_in_mouth, touches
from etot_cli.reasoning.language.reference.memory.antecedents import Mention
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.states import state_holds
from etot_cli.reasoning.language.reference.naming.usual_form import the_others
from etot_cli.reasoning.language.reference.places.places import Places
from etot_cli.reasoning.language.reference.several import Phrases
from etot_cli.reasoning.language.words.lexicon import JOINT_NOUNS, same_noun, singular
from etot_cli.skills.action import GraspPose
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK, SceneState


class InTheWay(Struct, frozen=True):
    """What is where something is to go instead of it, so that it has to go elsewhere.

    ``text``: the words, and ``why`` they are not read where it goes nowhere. ``off``: the step that
    takes it away where nothing else that is asked for does. ``lent``: what goes to the ``spot``
    where it is, if something else takes it away; there is room beside it otherwise.
    """

    text: str
    things: frozenset[Thing]
    why: str = "it is there; say where that is to go"
    off: Put | None = None
    lent: tuple[int, ...] = ()
    spot: Place | None = None


class Alone(Struct, frozen=True):
    """Where nothing else is to be in the end but its ``own`` objects, as ``text`` says."""

    thing: Thing
    own: frozenset[str]
    text: str


class Grasp(Struct, frozen=True):
    """A way to grasp a referent, or (None) what is taken at all."""

    what: int | None
    poses: tuple[GraspPose, ...]
    text: str


class Context:
    """What clauses have in common: the scene, what was spoken of, steps and constraints.

    Args:
        scene: what is spoken about.
        resolver: of phrases with a noun.
        discourse: what was spoken of before; it grows.
    """

    def __init__(self, scene: SceneState, resolver: Resolver, discourse: Discourse) -> None:
        self.scene = scene
        self.discourse = discourse
        self.phrases = Phrases(scene, resolver, discourse)
        self.places = Places(scene, self.phrases, discourse)
        self.turned: list[int] = []
        """Referents that were to be reoriented."""
        self.toppling: set[str] = set()
        """What must not fall over, even where it is put somewhere itself."""
        self.within: list[Put] = []
        """What must not be taken out of what it is in, as what keeps it there."""
        self.grasps: list[Grasp] = []
        """How things are grasped, where it is said by itself."""
        self.constraints: list[Constraint] = []
        self.steps: list[Step] = []
        """Of the clause that is being read."""
        self.done: tuple[Step, ...] = ()
        """Of the last clause that asked for something."""
        self.puts: tuple[Put, ...] = ()
        """All that put something somewhere so far."""
        self.taken: frozenset[int] = frozenset()
        """What was taken off or out of something so far."""
        self.in_the_way: list[InTheWay] = []
        self.alone: list[Alone] = []
        self.cleared: list[Put] = []
        """What the clause before took out of what it empties."""
        self.last: Clause | None = None
        """The clause before."""
        self.order = Order.SAID
        """When the clause that is being read is to be done."""
        self.sentence = ""
        """The text of the sentence that is being read."""

    def single(self, thing: Thing, text: str, noun: str = "") -> int:
        """A referent for one thing, for which "one" may stand by its name or another noun."""
        alone = Resolved(((thing,),), definite=True, noun=noun or thing.name)
        return self.discourse.add(alone, text, Role.THEME)

    def tell_others(self, things: Things, destinations: Sequence[Destination]) -> None:
        """Before anything is spoken of, "the other cups" are those that go on "the red cup", and
        "the other glove" that goes on the bench is the one that is not there.
        """
        targets = [np for item in destinations for np in item.targets if np.words]
        for np in targets:
            self._tell_holding(np, things)
        marks = (np for item in destinations for near in item.beside for np in near.phrases)
        targets += [np for np in marks if np.words]
        for np in (np for np in things.phrases if np.words):
            rest = the_others(np)  # "the rest of the cups"
            phrase = rest if rest and rest.words else np
            noun = phrase.head
            others = quantity_of(phrase.determiner).other
            if others and self.phrases.spoken_of(phrase, Role.THEME) is None:
                for at in targets:
                    named = at.called(singular(noun)) if at.head == "one" else at
                    called = named.words[-2] if named.words[1:] and named.head.isdigit() else ""
                    if same_noun(called or named.head, noun):
                        self.phrases.refer(named, Role.ANY)
                    else:
                        self._tell_there(phrase, at)

    def _tell_holding(self, place: NounPhrase, things: Things) -> None:
        """Behind "the apple stays where it is" "the other holder" is one that the apple is not in,
        if what goes there is in none.
        """
        before = {item.referent for item in self.discourse.mentions}
        spoken = self.discourse.things(*before)
        if not (quantity_of(place.determiner).other and spoken):
            return
        with suppress(ReferenceProblem):
            named = self.all_called(place, Role.PLACE)
            going = [self.phrases.meaning(np, Role.THEME).options for np in things.phrases]
            away = {thing for options in going for option in options for thing in option}
            held = [any(touches(thing, at, self.scene) for thing in away) for at in named]
            if self.phrases.spoken_of(place, Role.PLACE) is None and not any(held):
                self._tell(
                    place,
                    Role.PLACE,
                    lambda at: any(touches(thing, at, self.scene) for thing in spoken),
                )

    def _tell_there(self, phrase: NounPhrase, place: NounPhrase) -> None:
        """Speaks of those of some things that are at a place already."""
        with suppress(ReferenceProblem):
            marks = self.phrases.meaning(place, Role.PLACE).options
            self._tell(
                phrase,
                Role.THEME,
                lambda thing: (
                    len(marks) == 1 and any(touches(thing, mark, self.scene) for mark in marks[0])
                ),
            )

    def _tell(self, phrase: NounPhrase, role: Role, so: Callable[[Thing], bool]) -> None:
        """Speaks of those of some things that are so."""
        every = structs.replace(phrase, determiner="all", modifiers=())
        with suppress(ReferenceProblem):
            named = self.phrases.meaning(every, role)
            there = tuple(thing for thing in named.options[0] if so(thing))
            plural = singular(phrase.words[-1]) != phrase.words[-1]
            if there and len(named.options[0]) - len(there) > plural:
                here = structs.replace(named, options=(there,), definite=False)
                self.discourse.add(here, phrase.text, Role.ANY)

    def tell_so(self, things: Things, *, opens: bool) -> None:
        """Before anything is spoken of, "open the other drawer" is about what is not open."""
        so = partial(state_holds, "open" if opens else "closed", scene=self.scene)
        for phrase in (np for np in things.phrases if np.words and not np.is_elliptic):
            others = quantity_of(phrase.determiner).other
            if others and self.phrases.spoken_of(phrase, Role.PART) is None:
                self._tell(phrase, Role.PART, so)

    def all_called(self, phrase: NounPhrase, role: Role) -> tuple[Thing, ...]:
        """All that is called by a phrase's noun."""
        every = structs.replace(phrase, determiner="all", words=phrase.words[-1:], modifiers=())
        return self.phrases.meaning(every, role).options[0]

    def only(self, index: int, why: str) -> tuple[Thing, ...]:
        """What a referent stands for, where there must be no choice."""
        referent = self.discourse.referents[index]
        if len(referent.options) != 1:
            raise ReferenceProblem(referent.text, why, 2)
        return referent.options[0]

    def home(self, thing: Thing, *, exact: bool = False) -> Place:
        """Where a thing is at the start; the very spot on the desk, or (``exact``) on furniture, or
        beside others on something that stays where it is.
        """
        state = self.scene.states.get(thing.name)
        if state is None:
            raise ReferenceProblem(thing.name, "it has no place where it could be put", 2)
        if state.inside is not None:
            owner, _, part = state.inside.partition(".")
            return Place(Relation.INSIDE, self._referent(Thing(owner, part or None)))
        if not state.on:
            raise ReferenceProblem(thing.name, "it is not known where it was", 2)
        owner, _, board = state.on[0].partition(".")
        info = self.scene.infos.get(owner)
        surface = Thing(owner, board=board if info is not None and board in info.boards else None)
        fixed = info is not None and not info.movable
        shared = fixed or any(
            other != thing.name and state.on[0] in self.scene.states[other].on
            for other in self.scene.states
        )
        moved = any(item.name == owner for item in self.discourse.things(*self.discourse.put))
        if owner != DESK and (moved or not (exact and shared)):
            return Place(Relation.ON, self._referent(surface))
        return self.spot(thing, Place(Relation.ON, self._referent(surface)))

    def spot(self, thing: Thing, place: Place) -> Place:
        """The very spot of a surface where a thing is at the start."""
        x, y, _ = self.scene.states[thing.name].position
        near = Near(Nearby.AT_POINT, point=(round(x, 3), round(y, 3)))
        return replace(place, beside=(near,))

    def source(self, themes: Sequence[int]) -> tuple[Place, ...]:
        """The one place that things are at before they are moved, for "there"; else none."""
        things = dict.fromkeys(self.discourse.things(*themes))
        places: list[Place] = []
        with suppress(ReferenceProblem):
            places = [self.home(thing) for thing in things]
        at = dict.fromkeys(
            (place, self.discourse.things(place.where))
            for place in places
            if place.where is not None
        )
        outer = [(place, on[0]) for place, on in at if on[0] not in things]
        if len(outer) != 1 or self.discourse.put & {*themes}:
            return ()
        ((place, below),) = outer
        place = self.entered(place, things)
        fits = place.relation is Relation.INSIDE or can_be(below, Role.SURFACE, self.scene)
        return (place,) if fits and below.name != DESK else ()

    def entered(self, place: Place, things: Iterable[Thing]) -> Place:
        """The place that things leave for others: what rests in a vessel's mouth leaves that."""
        below = () if place.where is None else self.discourse.things(place.where)
        in_it = any(rests_in_mouth(thing, at, self.scene) for thing in things for at in below)
        return replace(place, relation=Relation.INSIDE) if in_it else place

    def mention_part(self, place: Place) -> None:
        """After "take the key out" "the drawer" is the one that it was in, if none was named."""
        assert place.where is not None  # what has a source
        said = [item for item in self.discourse.mentions if item.clause == self.discourse.clause]
        if any(item.role is Role.ANY for item in said):
            return
        for thing in self.discourse.things(place.where):
            for part in self.scene.infos[thing.name].parts if thing.part else ():
                if part.name == thing.part:
                    noun = JOINT_NOUNS[part.joint_type][0]
                    mention = Mention(place.where, Role.ANY, self.discourse.clause, noun)
                    self.discourse.mentions.append(mention)

    def _referent(self, thing: Thing) -> int:
        referent = Referent(((thing,),), thing.name)
        if referent not in self.discourse.referents:
            self.discourse.referents.append(referent)
        return self.discourse.referents.index(referent)

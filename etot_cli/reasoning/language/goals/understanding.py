"""What has been understood of an instruction up to some sentence."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from msgspec import structs

from etot_cli.reasoning.builtin.goal import Close, Goal, Near, Place, Put, Relation, Step, Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.goals.clauses import steps_of
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.fetched import set_down
from etot_cli.reasoning.language.goals.grasps import grasped
from etot_cli.reasoning.language.goals.sided import beside_each_other
from etot_cli.reasoning.language.goals.turned import in_turn
from etot_cli.reasoning.language.goals.turns import Timed, continues, in_order
from etot_cli.reasoning.language.grammar.parsers.trees import pronouns
from etot_cli.reasoning.language.grammar.requests.emptying import is_emptying
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Spoken
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AvoidClause,
    Clause,
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    RemoveClause,
    ReorientClause,
)
from etot_cli.reasoning.language.reference.choosing.noun_phrases import Resolver
from etot_cli.reasoning.language.reference.choosing.opposites import check_opposites
from etot_cli.reasoning.language.reference.geometry.space import touches
from etot_cli.reasoning.language.reference.memory.by_now import note_turned
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK, SceneState


def _check_instead(spoken: Spoken, before: Clause | None, *, room: bool) -> None:
    """Whether "instead" takes back what was asked for; what is taken away makes ``room`` anyway."""
    room |= isinstance(before, RemoveClause) and isinstance(spoken.clause, PutClause)
    taken = isinstance(before, PickClause) and isinstance(spoken.clause, PutClause)
    room |= taken and {*pronouns(spoken.clause)} == {"it"}  # not where it is
    room |= isinstance(before, ReorientClause) and before.only_named  # how things are
    denied = (isinstance(before, AvoidClause) and before.negated) or (
        isinstance(before, EnsureClause) and all(state.denied for state in before.states)
    )
    if spoken.instead and before is not None and not (room or denied):
        raise ReferenceProblem("instead", "say only what is to be done", 3, word="instead")


def _says_what_stays(clause: Clause) -> bool:
    """Whether a clause says that things stay, or are left, where they are."""
    if isinstance(clause, EnsureClause):
        return all(state.kept and not (state.denied or state.allowed) for state in clause.states)
    return isinstance(clause, PutClause) and clause.stays


def _lying(step: Put) -> Put:
    """The same without that things are to stand there."""
    near = Near(Nearby.UPRIGHT)
    places = (replace(p, beside=tuple(n for n in p.beside if n != near)) for p in step.places)
    return replace(step, places=tuple(places))


def _stood_there(steps: Iterable[Step]) -> tuple[Step, ...]:
    """Steps, without what only says later that a thing is to stand where it was put ("the jar on
    the tray, the spoon in it, and the jar upright").
    """
    told: list[Step] = []
    for step in steps:
        plain = _lying(step) if isinstance(step, Put) else step
        if plain != step and plain in told:
            told[told.index(plain)] = step
        else:
            told.append(step)
    return tuple(told)


class Understanding:
    """What has been understood up to some point of an instruction."""

    def __init__(self, scene: SceneState, discourse: Discourse, resolver: Resolver) -> None:
        self._scene, self._resolver = scene, resolver
        self.context = Context(scene, resolver, discourse)
        self.timed: list[Timed] = []
        self.sentence = 0
        self._turned_before: dict[Thing, bool] = {}
        """What was open or closed before the sentence."""
        self.conditional = False
        """Something was asked for only if things are so by now."""
        self.undone = False
        """It was not so, and nothing was asked for otherwise."""
        self.let_be = False
        """As things are they are to be left alone, where more was asked for otherwise."""

    @property
    def asked(self) -> bool:
        """Whether anything has been asked for, even if it holds already."""
        return self.undone or self.let_be or any(item.steps for item in self.timed)

    def copy(self) -> Understanding:
        """An independent copy, for trying a reading."""
        other = Understanding(self._scene, self.context.discourse.copy(), self._resolver)
        other.context.turned = list(self.context.turned)
        other.context.toppling = set(self.context.toppling)
        other.context.within = list(self.context.within)
        other.context.grasps = list(self.context.grasps)
        other.context.done, other.context.cleared = self.context.done, self.context.cleared
        other.context.taken, other.context.puts = self.context.taken, self.context.puts
        other.context.in_the_way = list(self.context.in_the_way)
        other.context.alone = list(self.context.alone)
        other.context.constraints = list(self.context.constraints)
        other.timed = list(self.timed)
        other.conditional, other.undone = self.conditional, self.undone
        other.let_be = self.let_be
        other.sentence, other.context.last = self.sentence, self.context.last
        return other

    def read(self, reading: Sequence[Spoken]) -> None:
        """Reads the clauses in the order they are said, and notes when each is to be done."""
        self.sentence += 1
        self._turned_before = dict(self.context.discourse.turned)
        timed: dict[int, Timed] = {}
        before: int | None = None
        placed: list[tuple[Spoken, dict[Thing, tuple[Place | None, ...]]]] = []
        asked: list[tuple[Clause, tuple[Step, ...]]] = []

        def ahead(spoken: Spoken) -> bool:
            later = reading[reading.index(spoken) + 1 :]
            return any(item.position < spoken.position for item in later)

        for spoken in sorted(reading, key=lambda item: item.position):
            moved = self.context.discourse.things(*self.context.discourse.put)
            self.context.order = spoken.order
            self.context.discourse.replaced = (
                frozenset(self.context.discourse.put) if spoken.instead else frozenset()
            )
            said = len(self.context.discourse.mentions)
            before_it = {mention.referent for mention in self.context.discourse.mentions}
            steps = self._at_its_time(spoken, reading, placed)
            further = spoken is not reading[0] or spoken.order is Order.THEN
            # "Take the dish out of the oven … Put the pan in the oven instead"
            named = {*self.context.discourse.things(*before_it)}
            room = any(
                touches(thing, at, self._scene)
                for step in steps
                if isinstance(step, Put)
                for place in step.places
                if place.where is not None
                for at in self.context.discourse.things(place.where)
                for thing in moved
                if further or at in named
            )
            _check_instead(spoken, self.context.last, room=room)
            closing = isinstance(spoken.clause, MoveClause) and not spoken.clause.opens
            told = isinstance(spoken.clause, EnsureClause)
            told |= is_emptying(spoken.clause)
            if (closing or told) and ahead(spoken):
                # "Open the bottom drawer after closing the top one and put the pen inside"
                self.context.discourse.step_back(said)
            last = self.context.last
            if isinstance(last, PickClause) and last.fetched and spoken.order is Order.THEN:
                if before is not None:
                    timed[before] = set_down(self.context, timed[before], steps)
                elif self.timed:
                    self.timed[-1] = set_down(self.context, self.timed[-1], steps)
            self.context.last = spoken.clause
            order = Order.THEN if self._comes_next(spoken, steps, asked) else spoken.order
            said_before = [*self.timed, *timed.values()]
            if said_before and self._is_out_by_then(spoken, steps, said_before[-1]):
                order = Order.BEFORE_THAT
            asked.append((spoken.clause, steps))
            stays = _says_what_stays(spoken.clause)
            item = Timed(steps, order, self.sentence, stays=stays, led=spoken.led)
            if before is not None and continues(timed[before], item, self.context.discourse):
                timed[before] = structs.replace(timed[before], steps=(*timed[before].steps, *steps))
            else:
                before = id(spoken)
                timed[before] = item
        check_opposites(self.context.discourse)
        self.timed += [timed[id(spoken)] for spoken in reading if id(spoken) in timed]

    def _comes_next(
        self,
        spoken: Spoken,
        steps: Sequence[Step],
        before: Sequence[tuple[Clause, tuple[Step, ...]]],
    ) -> bool:
        """Whether what goes somewhere goes there from where it was put before something was opened
        ("put the ball aside, open the drawer, put the ball in"), or is taken out from there again.
        """
        out = isinstance(spoken.clause, RemoveClause)
        if spoken.order is not Order.SAID or not (out or isinstance(spoken.clause, PutClause)):
            return False
        opened = [at for at, (said, _) in enumerate(before) if isinstance(said, MoveClause)]
        earlier = before if out else before[: opened[-1]] if opened else ()
        put = [step for said, done in earlier if isinstance(said, PutClause) for step in done]
        moved, now = (
            {
                thing
                for step in found
                if isinstance(step, Put) and (removed or not step.removal)
                for thing in self.context.discourse.things(*step.what)
            }
            for found, removed in ((put, False), (steps, out))
        )
        return bool(moved & now)

    def _is_out_by_then(self, spoken: Spoken, steps: Sequence[Step], before: Timed) -> bool:
        """Whether something is only told not to be in what the clause before closes: it is taken
        out ahead ("close the drawer; the cup must not be in it").
        """
        clause = spoken.clause
        told = isinstance(clause, AvoidClause | EnsureClause) or is_emptying(clause)
        if spoken.order is not Order.SAID or not told:
            return False
        discourse, states = self.context.discourse, self._scene.states
        shut = [step.what for step in before.steps if isinstance(step, Close)]
        closed = {thing.address for thing in discourse.things(*shut)}
        taken = [s.what if isinstance(s, Put) and s.removal else () for s in steps]
        around = {states[t.name].inside or "" for at in taken for t in discourse.things(*at)}
        return (
            bool(around)
            and all(taken)
            and all({name, name.partition(".")[0]} & closed for name in around)
        )

    def _at_its_time(
        self,
        spoken: Spoken,
        reading: Sequence[Spoken],
        before: list[tuple[Spoken, dict[Thing, tuple[Place | None, ...]]]],
    ) -> tuple[Step, ...]:
        """A clause's steps. What was said ``before`` it but is to be done after it has not been put
        anywhere by then ("put the pen in the cup after emptying the cup"), and nothing has where it
        comes first ("put the bowl on the tray; the tray has to be cleared first").
        """
        discourse, at = self.context.discourse, reading.index(spoken)
        later = (was for said, was in before if reading.index(said) > at)
        now, then = dict(discourse.placed), next(later, None)
        then = {} if spoken.order is Order.FIRST else then
        before.append((spoken, now))
        moved = spoken.clause if isinstance(spoken.clause, MoveClause) else None
        if moved and not moved.whatever_opened and spoken.order is Order.SAID:
            # "Close the drawers that are open and open the one that is closed"
            turned, discourse.turned = discourse.turned, dict(self._turned_before)
            steps = tuple(steps_of(spoken.clause, self.context))
            discourse.turned = turned
            for step in steps:
                note_turned(discourse, step)
            return steps
        if then is None:
            return tuple(steps_of(spoken.clause, self.context))
        discourse.placed = dict(then)
        steps = tuple(steps_of(spoken.clause, self.context))
        done_later = {thing: at for thing, at in now.items() if then.get(thing) != at}
        discourse.placed = {**discourse.placed, **done_later}
        return steps

    def _narrowed(self, step: Step, after: Step | None) -> bool:
        """Whether the next step says more closely where things go ("carry it over to the bag and
        drop it in", "take it to the stand and set it on the lowest shelf").
        """
        if not (isinstance(step, Put) and isinstance(after, Put)) or step.what != after.what:
            return False
        after = _lying(after)
        where, closer = (
            {
                (place.relation, thing)
                for place in put.places
                if place.where is not None and not place.beside
                for thing in self.context.discourse.things(place.where)
            }
            for put in (step, after)
        )
        desk = {(place.relation, *place.beside) for place in step.places if self._is_desk(place)}
        if desk == {(Relation.ON,)} and all(place.beside for place in after.places):
            # "Bring it to the table and put it to the right of the box", which stands there
            marks = [i for place in after.places for near in place.beside for i in near.landmarks]
            known = self.context.discourse.things(*marks)
            return all(
                place.where is None or self._is_desk(place) for place in after.places
            ) and all(touches(thing, Thing(DESK), self._scene) for thing in known)
        whole = step.run == after.run and not any(t.part or t.board for _, t in where)
        one, other = ({(how, thing.name) for how, thing in at} for at in (where, closer))
        return step == replace(after, run=step.run) or (whole and one == other != set())

    def _is_left_so(self, before: Step | None, step: Step) -> bool:
        """Whether a thing is to be left where it has just been laid down, or stood up ("tip it onto
        its side, but leave it on the shelf").
        """
        if not (isinstance(before, Put) and isinstance(step, Put)):
            return False
        things = self.context.discourse.things
        own, left = (
            [(p.relation, () if p.where is None else things(p.where)) for p in put.places]
            for put in (before, step)
        )
        stances = [near.relation.is_stance for place in before.places for near in place.beside]
        plain = not any(place.beside for place in step.places) and all(stances)
        same = own == left and things(*before.what) == things(*step.what)
        return bool(stances) and plain and same

    def _kept_away(self, said: Sequence[Step]) -> list[Step]:
        """With one place for what goes away from something and, in the same breath, to a place on
        the desk ("keep the cup away from the jug and put it to the left of the tray").
        """
        steps = list[Step]()
        for step in said:
            before = steps[-1] if steps else None
            if isinstance(before, Put) and isinstance(step, Put) and self._both(before, step):
                away = before.places[0].beside
                places = tuple(replace(at, beside=(*at.beside, *away)) for at in step.places)
                steps[-1] = replace(step, places=places)
            else:
                steps.append(step)
        return steps

    def _both(self, away: Put, step: Put) -> bool:
        """Whether one step takes away from something what goes elsewhere on the desk at once."""
        things, nears = self.context.discourse.things, away.places[0].beside
        there = [near for place in step.places for near in place.beside]
        marks, at = (things(*(i for n in of for i in n.landmarks)) for of in (nears, there))
        kinds = {near.relation for near in nears}
        same = (away.what, away.run) == (step.what, step.run) and len(away.places) == 1
        desk = all(place.where is None or self._is_desk(place) for place in step.places)
        apart = not {*marks} & {*at} and Nearby.AT_POINT not in {near.relation for near in there}
        return same and desk and apart and kinds == {Nearby.AWAY}

    def _is_desk(self, place: Place) -> bool:
        return place.where is not None and self.context.discourse.is_desk(place.where)

    def goal(self, *, complete: bool = False) -> Goal:
        """The goal so far; ``complete``: nothing more is asked for.

        Raises:
            ReferenceProblem: a part is to be both open and closed.
        """
        discourse = self.context.discourse
        said = self._kept_away(_stood_there(in_order(self.timed, discourse)))
        steps = [
            step
            for before, step, after in zip((None, *said), said, (*said[1:], None), strict=False)
            if not (self._narrowed(step, after) or self._is_left_so(before, step))
        ]
        steps = beside_each_other(steps, discourse.referents)
        steps = grasped(steps, self.context.grasps, complete=complete)
        steps, constraints = in_turn(
            steps, self.context.constraints, discourse.referents, self._scene
        )
        return Goal(
            tuple(discourse.referents),
            tuple(steps),
            tuple(dict.fromkeys(constraints)),
            tuple(discourse.notes),
        )

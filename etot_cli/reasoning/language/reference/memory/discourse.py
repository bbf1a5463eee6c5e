"""What has been spoken of so far: referents, and how and by which words they were mentioned."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, field, replace

from msgspec import structs

from etot_cli.reasoning.builtin.goal import Place, Referent, Thing, things_in
from etot_cli.reasoning.builtin.relations import parts_of
from etot_cli.reasoning.builtin.roles import Role
from etot_cli.reasoning.language.grammar.syntax.phrases import Toward
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference, Mention
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.words.categories import members_of
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    STATES,
    THING_NOUNS,
    matches_any,
    same_noun,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK, PartInfo, SceneState


@dataclass
class Discourse:
    """Referents and mentions up to some point of an instruction.

    Args:
        scene: what is spoken about.
        clause: number of the clause being read.
        last_place: the latest destination, for "there".
    """

    scene: SceneState
    referents: list[Referent] = field(default_factory=list)
    mentions: list[Mention] = field(default_factory=list)
    clause: int = 0
    last_places: tuple[Place, ...] = ()
    put_upon: dict[Thing, tuple[Thing, ...]] = field(default_factory=dict)
    """What was put anywhere → what it was put onto last, if that is one place."""
    placed: dict[Thing, tuple[Place | None, ...]] = field(default_factory=dict)
    """Where things have been put, one of several places; None is where one was at the start."""
    turned: dict[Thing, bool] = field(default_factory=dict)
    """What has been opened, or closed (False), be it to put something into it."""
    moved_on: frozenset[Thing] = frozenset()
    """What has been put somewhere and then somewhere else, so that "where it was" may be either."""
    put_into: dict[int, int] = field(default_factory=dict)
    """Referent → the referent that it was to be put into last."""
    notes: list[str] = field(default_factory=list)
    """What words were taken for, where that was a choice."""
    put: frozenset[int] = frozenset()
    """Referents that have been given a place."""
    lifted: frozenset[int] = frozenset()
    """Referents that were to be picked up."""
    last_landmark: tuple[int, int, Nearby] = (-1, -1, Nearby.NEAR)
    """Number of a clause, the referent that something is put beside there, and how it is to be."""
    stacks: dict[int, tuple[int, int]] = field(default_factory=dict)
    """Number of the clause that built a stack → the referents at its bottom and on top."""
    left_out: dict[int, tuple[Thing, ...]] = field(default_factory=dict)
    """Referent → what its phrase leaves out of it."""
    fitting: dict[int, tuple[Thing, ...]] = field(default_factory=dict)
    """Referent → what its phrase is true of as well, though it fits another thing better."""
    among: dict[int, tuple[Thing, ...]] = field(default_factory=dict)
    """Referent → what its words for side and size single it out of."""
    sides: dict[int, tuple[str, ...]] = field(default_factory=dict)
    """Referent → words for the sides of other things that its phrase says it is on."""
    undecided: frozenset[int] = frozenset()
    """Referents of "the …" where several things fit and nothing tells them apart."""

    swept: frozenset[int] = frozenset()
    """Referents of everything that is to be taken off the desk, which needs another place."""
    replaced: frozenset[int] = frozenset()
    """Referents that the clause that is being read puts something else in the place of."""
    emptied: int = -1
    """Number of the latest clause after which something is to be empty."""
    cleared: frozenset[Thing] = frozenset()
    """What the clause before took out of what it empties."""
    emptied_of: dict[int, dict[int, Prep]] = field(default_factory=dict)
    """Number of a clause → what it takes everything out of or off, and the word that says so."""
    roomy: int | None = None
    """The referent of what room is made on or in, which "there" means then."""
    told_at: tuple[int, Toward | None, int] = (-1, None, -1)
    """Number of a clause that only names something by where it is, how it is to what, and that;
    "there" means that then. None for how where it is beside something.
    """
    abreast: frozenset[Thing] = frozenset()
    """What was put next to each other last."""
    left_alone: frozenset[int] = frozenset()
    """Referents that must not be moved or touched."""
    spared: tuple[int, tuple[int, ...]] = (-1, ())
    """Number of the latest clause that leaves something as it is, and what that spoke of."""
    spared_alone: bool = False
    """It does so by itself ("leave the cup where it is"), not beside something else ("without")."""
    compared: frozenset[int] = frozenset()
    """Referents that were but named to compare others with, of which they may be one."""
    returning: bool = False
    """Something is to be put back in the end, so that it is what other things are put into."""
    remarked: frozenset[int] = frozenset()
    """Referents of which something was said that is neither known of a thing nor asked for."""

    def copy(self) -> Discourse:
        """An independent copy, for trying a reading."""
        return replace(
            self,
            referents=list(self.referents),
            mentions=list(self.mentions),
            put_upon=dict(self.put_upon),
            placed=dict(self.placed),
            turned=dict(self.turned),
            put_into=dict(self.put_into),
            notes=list(self.notes),
            stacks=dict(self.stacks),
            left_out=dict(self.left_out),
            fitting=dict(self.fitting),
            among=dict(self.among),
            sides=dict(self.sides),
            emptied_of=dict(self.emptied_of),
        )

    def each(self, referent: int) -> tuple[int, ...]:
        """All that a phrase may mean, each a referent of its own: beside neither of two cups, away
        from either of them.
        """
        options = self.referents[referent].options
        if len(options) == 1:
            return (referent,)
        return tuple(self.alone(thing, Role.ANY) for thing in things_in(options))

    def alone(self, thing: Thing, role: Role) -> int:
        """A referent for one thing, spoken of in a role."""
        single = Resolved(((thing,),), definite=True, noun=thing.name)
        return self.add(single, thing.name, role)

    def add(
        self,
        resolved: Resolved,
        text: str,
        role: Role,
        *,
        several: bool = False,
        whatever: bool = False,
        collective: bool = False,
    ) -> int:
        """Notes what a phrase means and returns its referent; ``several``: no "it" means that,
        unless it is ``collective``.

        A definite phrase with the same meaning as an earlier one speaks of the same choice.
        """
        self.notes += [note for note in resolved.notes if note not in self.notes]
        index = len(self.referents)
        mention = Mention(
            index, role, self.clause, resolved.noun, several, resolved.adjectives, whatever,
            resolved.idle, resolved.either, collective,
        )  # fmt: skip
        if resolved.definite and not resolved.other:
            empty = {STATES.get(word) for word in text.split()} & {"empty", "full"}
            for earlier in range(index - 1, -1, -1):
                if self._is_again(earlier, resolved):
                    if empty and len(resolved.options) > 1:  # rather not what was just filled
                        named = things_in(resolved.options)
                        raise AmbiguousReference(text, [thing.address for thing in named])
                    self.mentions.append(structs.replace(mention, referent=earlier))
                    if resolved.left_out:
                        self.left_out[earlier] = resolved.left_out
                    return earlier
        distinct = self._told_from(resolved, role)
        if resolved.definite and not resolved.other and len(resolved.options) > 1:
            self._check_among_spoken(resolved, text)
            self.undecided |= {index}
        self.referents.append(Referent(resolved.options, text, distinct))
        self.left_out[index], self.fitting[index] = resolved.left_out, resolved.others
        self.among[index], self.sides[index] = resolved.among, resolved.sides
        self.mentions.append(mention)
        return index

    def _told_from(self, resolved: Resolved, role: Role) -> tuple[int, ...]:
        """Referents that a phrase means none of: "another cup", and "a cup" of which one has been
        given a place before ("a cup on the tray and a cup on the shelf").
        """
        things = set(things_in(resolved.options))
        shared = [
            earlier
            for earlier, referent in enumerate(self.referents)
            if things & set(things_in(referent.options))
        ]
        if resolved.other:
            choices = [index for index in shared if len(self.referents[index].options) > 1]
            return tuple(choices if resolved.again else shared)
        known = resolved.definite and (len(things) > 1 or len(resolved.options) > 1)
        if known or resolved.again or role is not Role.THEME:
            return ()
        moved = {mention.referent for mention in self.mentions if mention.role is Role.THEME}
        return tuple(
            index
            for index in shared
            if index in moved
            and (len(resolved.options) > 1 or len(self.referents[index].options) > 1)
            and not any(things <= set(option) for option in self.referents[index].options)
        )

    def _check_among_spoken(self, resolved: Resolved, text: str) -> None:
        """After "the black things" "the jar" may be the black one, or any.

        Raises:
            AmbiguousReference: some of what a definite phrase fits was spoken of, and some not.
        """
        if matches_any(resolved.noun, THING_NOUNS):
            return
        sets = [referent.options[0] for referent in self.referents if len(referent.options) == 1]
        spoken = {thing for things in sets if len(things) > 1 for thing in things}
        fitting = things_in(resolved.options)
        if spoken & set(fitting) and set(fitting) - spoken:
            raise AmbiguousReference(text, [thing.name for thing in fitting])

    def _is_again(self, referent: int, resolved: Resolved) -> bool:
        """Whether a definite phrase speaks of an earlier referent.

        It does when it means the same, and when it means, among others, what was spoken of by the
        same noun ("the red plum … the plum"), or what something was just taken out of ("that pot").
        """
        earlier, now = set(self.referents[referent].options), set(resolved.options)
        if earlier == now:
            return True
        nouns = {mention.noun for mention in self.mentions if mention.referent == referent}
        again = any(same_noun(noun, resolved.noun) for noun in nouns)
        source = not nouns and any(place.where == referent for place in self.last_places)
        swept = any(matches_any(noun, THING_NOUNS) for noun in nouns)  # off the plate: "the roll"
        return earlier < now and (again or source or swept)

    def as_it_stands(
        self,
        referent: int,
        so: Callable[[SceneState, PartInfo], bool],
        called: str = "",
        word: str = "open",
    ) -> None:
        """Of a chest of drawers that is spoken of, keeps the drawers that are so now; all, if none
        or all of them are. Where it is ``called`` one drawer it is noted which one that is.
        """
        (option, *more) = self.referents[referent].options
        parts = [part for thing in option for part in parts_of(self.scene, thing)]
        now = tuple(Thing(part.owner, part.name) for part in parts if so(self.scene, part))
        if not more and 0 < len(now) < len(parts):
            options = tuple((thing,) for thing in now) if len(option) == 1 else (now,)
            self.referents[referent] = replace(self.referents[referent], options=options)
            if called and len(now) == 1:
                self.notes.append(f"{called!r} is {now[0].address}, which is {word}")

    def is_spoken(self, referent: int) -> bool:
        """Whether a referent was mentioned more than once."""
        return sum(mention.referent == referent for mention in self.mentions) > 1

    def mention_again(self, referent: int, role: Role) -> None:
        """Notes that a pronoun spoke of a referent."""
        said = [item for item in self.mentions if item.referent == referent]
        last = said[-1] if said else Mention(referent, role, self.clause, "object")
        again = Mention(
            referent, role, self.clause, last.noun, last.collective, last.adjectives,
            collective=last.collective,
        )  # fmt: skip
        self.mentions.append(again)

    def is_about(self, topic: Collection[int]) -> None:
        """Of what a clause mentions "it" is what that is about, rather than what tells where."""
        self.mentions[:] = [
            structs.replace(mention, role=Role.THEME)
            if mention.referent in topic and mention.clause == self.clause
            else mention
            for mention in self.mentions
        ]

    def is_told_by(self, told_by: Collection[int], first: int) -> None:
        """What a clause mentions is but told by some of it, and by all from ``first`` on."""
        self.mentions[:] = [
            structs.replace(mention, role=Role.ANY)
            if at >= first or (mention.referent in told_by and mention.clause == self.clause)
            else mention
            for at, mention in enumerate(self.mentions)
        ]

    def step_back(self, first: int, meant: Collection[int] = ()) -> None:
        """What was mentioned from ``first`` on is what "it" speaks of only if nothing else is, what
        was ``meant`` rather than what that was told by.
        """
        said = [
            structs.replace(mention, role=Role.ANY, clause=0) for mention in self.mentions[first:]
        ]
        said.sort(key=lambda mention: mention.referent in meant)
        self.mentions[:] = [*said, *self.mentions[:first]]

    def things(self, *referents: int) -> tuple[Thing, ...]:
        """Everything that referents may stand for."""
        return things_in(option for i in referents for option in self.referents[i].options)

    def last_noun(self, role: Role) -> str | None:
        """The noun that "one" or "the other" stands for in a role; never the desk, which is one."""
        said = [mention for mention in self.mentions if self._lends_noun(mention)]
        mentions = [mention for mention in said if _alike(mention.role, role)] or said
        return mentions[-1].noun if mentions else None

    def noun_of(self, thing: Thing) -> str:
        """The noun that a thing was last called by."""
        said = [m.noun for m in self.mentions if self.things(m.referent) == (thing,)]
        return said[-1] if said else ""

    def nouns(self) -> tuple[str, ...]:
        """All nouns that "one" may stand for."""
        said = (item.noun for item in self.mentions if self._lends_noun(item))
        return tuple(dict.fromkeys(said))

    def _lends_noun(self, mention: Mention) -> bool:
        """Whether "one" may stand for a noun: not for the desk, nor for what a thing is but told
        by ("the drawer is occupied": by an object); "the lower" has none.
        """
        telling = mention.role is Role.ANY and matches_any(mention.noun, THING_NOUNS)
        telling |= mention.noun in LEVELS
        return not (telling or self.is_desk(mention.referent))

    def is_desk(self, referent: int) -> bool:
        """Whether a referent is the desk."""
        return all(thing.name == DESK for thing in self.things(referent))

    def mentioned_like(self, noun: str | None) -> tuple[Thing, ...]:
        """Single things spoken of by a noun, or put somewhere: "the other" is none of them, but one
        of several that were but named before one of these was spoken of.
        """
        found: dict[Thing, None] = {}
        for at, mention in enumerate(self.mentions):
            options = self.referents[mention.referent].options
            later = (self.referents[item.referent].options for item in self.mentions[at + 1 :])
            since = {t for many in later for own in many if {*own} < {*options[0]} for t in own}
            dealt_with = {*self.put, *self.left_alone}  # "the apple and another fruit"
            # "Take both apples out. The red one goes on the plate, the other one in the bowl"
            waits = all(self.is_off(thing) for thing in {*options[0]} - since)
            if since and (waits or mention.several or mention.referent not in self.put):
                continue
            if mention.referent in self.compared - dealt_with and mention.role is Role.ANY:
                continue
            said = (mention.noun, *mention.noun.split("_"))  # "vial C" is a noun of one label
            here = mention.role is Role.THEME and mention.clause == self.clause
            alike = (
                here
                or mention.referent in dealt_with
                or any(same_noun(word, noun or "") for word in said)
                or any(singular(word) in members_of(noun or "") for word in said)
            )
            if noun is not None and alike and len(options) == 1:
                found.update(dict.fromkeys(options[0]))
        # What was but taken away may be told a place yet.
        return tuple(thing for thing in found if thing not in self.cleared)

    def is_off(self, thing: Thing) -> bool:
        """Whether a thing has been taken from somewhere and waits on the desk."""
        places = self.placed.get(thing, (None,))
        return all(place is not None and self.is_anywhere(place) for place in places)

    def is_anywhere(self, place: Place) -> bool:
        """Whether a place is but the desk, such as where what is taken away waits."""
        return place.where is not None and self.is_desk(place.where) and not place.beside

    def left_open(self) -> tuple[tuple[Thing, ...], ...]:
        """What may be meant by what was but named last, where that is one of several phrases ("the
        apple or the pear: put one of them …").
        """
        last = self.mentions[-1] if self.mentions else None
        choice = last is not None and last.either and last.referent not in self.put
        return self.referents[last.referent].options if last is not None and choice else ()

    def is_landmark(self, noun: str) -> bool:
        """Whether a noun was last said of what but told something else ("the can in the box")."""
        roles = [mention.role for mention in self.mentions if same_noun(mention.noun, noun)]
        return roles[-1:] == [Role.ANY]

    def but_named(self, noun: str) -> tuple[Thing, ...]:
        """Several things that were but named by a noun ("there are two red cups"): "the left one",
        "one" and "the other" are of these. Of what has been moved "the big one" may be another.
        """
        since: set[Thing] = set()
        mentions = (item for item in self.mentions if item.role is not Role.ANY)
        said = [item for item in mentions if same_noun(item.noun, noun)]
        for clause in dict.fromkeys(item.clause for item in reversed(said)):
            last = {item.referent for item in said if item.clause == clause}
            things = self.things(*last)
            sets = [self.referents[index].options for index in last]
            if any(len(options[0]) > 1 for options in sets):
                known = all(len(options) == 1 for options in sets) and not last & self.put
                return things if known and since <= {*things} else ()
            since |= {*things}
        return ()

    def is_about_parts(self, noun: str | None) -> bool:
        """Whether what was spoken of last by a noun is part of something ("one drawer")."""
        for mention in reversed(self.mentions):
            if noun is not None and same_noun(mention.noun, noun):
                things = self.things(mention.referent)
                return all(thing.part or thing.board for thing in things)
        return False


def _alike(first: Role, second: Role) -> bool:
    """Whether two roles speak of the same side of an action: what is moved, or where to."""
    moved = (Role.THEME, Role.PART)
    return (first in moved) == (second in moved)

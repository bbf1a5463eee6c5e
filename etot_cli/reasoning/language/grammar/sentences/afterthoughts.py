"""Rules for what stands behind a request, or before the next one, and tells where things are.

"Take the pen, it is on the tray" tells which pen; "move the cup out of the way and open the oven"
tells out of whose way.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from operator import add

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    sequence,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import COMMA, OPTIONAL_COMMA, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.contrasts import CONTRASTED, OF_ALL, excepting
from etot_cli.reasoning.language.grammar.phrases.descriptions import DESCRIBED, quality_alone
from etot_cli.reasoning.language.grammar.phrases.exclusions import changed, excluding
from etot_cli.reasoning.language.grammar.phrases.modifiers import ONE_SUCH
from etot_cli.reasoning.language.grammar.sentences.chains import CHAIN
from etot_cli.reasoning.language.grammar.sentences.clauses import LEFT_OUT
from etot_cli.reasoning.language.grammar.sentences.spoken import Reading
from etot_cli.reasoning.language.grammar.sentences.topics import AS_IT_IS
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Clause,
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    PutGroup,
    RemoveClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    Things,
)
from etot_cli.reasoning.language.words import fillers
from etot_cli.reasoning.language.words.lexicon import STATES, singular
from etot_cli.reasoning.language.words.places import Prep


def _told(things: Things, said: Modifier, number: str) -> Things | None:
    """The one phrase for what is moved, with what is said of it."""
    (np, *more) = things.phrases
    plural = singular(np.head) != np.head
    fits = np.words and not more and plural == (number == "they")
    told = replace(np.told_by(said), text=f"{np.text} that is there")
    return replace(things, phrases=(told,)) if fits else None


def _of(said: Modifier, mark: NounPhrase) -> Modifier:
    """What is said, with a name for what "it" is in that."""
    return replace(said, phrases=tuple(mark if np.pronoun else np for np in said.phrases))


def _marks(group: PutGroup) -> list[NounPhrase]:
    """What things go in, on or beside."""
    beside = [near for item in group.destinations for near in item.beside]
    targets = [np for item in group.destinations for np in item.targets]
    return [*targets, *(np for near in beside for np in near.phrases)]


def told_behind(rest: Reading, number: str, said: Modifier) -> list[Reading]:
    """A request with what is said behind it of what it moves, or of where that goes."""
    clause = rest[-1].clause
    found: list[Clause] = []
    match clause:
        case PutClause(groups=(group,)):
            groups = _groups_told(group, number, said)
            found += (replace(clause, groups=(told,)) for told in groups)
        case EnsureClause(states=(state,)) if state.destinations and not state.denied:
            group = PutGroup(Things(state.subjects), state.destinations)
            for told in _groups_told(group, number, said):
                so = replace(state, subjects=told.things.phrases, destinations=told.destinations)
                found.append(replace(clause, states=(so,)))
        case PickClause(things=things) | RemoveClause(things=things) | MoveClause(things=things):
            if told_things := _told(things, said, number):
                found.append(replace(clause, things=told_things))
    return [(*rest[:-1], replace(rest[-1], clause=item)) for item in found]


def _groups_told(group: PutGroup, number: str, said: Modifier) -> Iterator[PutGroup]:
    """Things and where they go, with what is said of either."""
    marks = _marks(group)
    named = _of(said, marks[0]) if len(marks) == 1 else said
    vessel = said.prep is Prep.QUALITY and any(word in STATES for word in said.words)
    if not vessel and (things := _told(group.things, named, number)):
        yield replace(group, things=things)
    for mark in marks if len(group.things.phrases) == 1 else ():
        told = mark.told_by(_of(said, group.things.phrases[0]))
        if mark.words:
            where = tuple(_with(item, mark, told) for item in group.destinations)
            yield replace(group, destinations=where)


def _with(where: Destination, mark: NounPhrase, told: NounPhrase) -> Destination:
    """The same place with more said of what it is in, on or beside."""

    def named(np: NounPhrase) -> NounPhrase:
        return told if np is mark else np

    beside = tuple(replace(b, phrases=tuple(map(named, b.phrases))) for b in where.beside)
    return replace(where.going_to(named), beside=beside)


_CHOICE = frozenset({"a", "an", "any", "one", "any one", "some"})
"""Before one of several things, whichever it is."""


def any_such(rest: Reading, said: NounPhrase) -> Reading | None:
    """A request about one of some things, with which of them will do ("…, any small one will do");
    where it is about a choice of places as well, that may be meant.
    """
    clause = rest[-1].clause
    marks = _marks(clause.groups[0]) if isinstance(clause, PutClause) else []
    if said.determiner != "any" or any(np.determiner in _CHOICE for np in marks):
        return None

    def told(np: NounPhrase) -> NounPhrase | None:
        # Of "a red cup, any cup" it is open whether it has to be red.
        of_these = said.is_elliptic or (np.head == said.head and {*np.words} <= {*said.words})
        fits = np.determiner in _CHOICE and np.words and of_these
        more = tuple(word for word in said.words[:-1] if word not in np.words)
        return replace(np.told_by(*said.modifiers), words=(*more, *np.words)) if fits else None

    new = changed(clause, told)
    return None if new is None else (*rest[:-1], replace(rest[-1], clause=new))


def _open_choice(np: NounPhrase) -> bool:
    """Whether a phrase leaves open which one of several things is meant."""
    first = np.determiner.removeprefix("just ").removeprefix("only ").split()[:1]
    return first in (["a"], ["an"], ["any"], ["one"]) and bool(np.words or np.pronoun == "them")


def choosing(rest: Reading, denied: bool, said: NounPhrase | Modifier) -> Reading | None:
    """A request about one of several things, with what is said behind it of the one that is chosen
    ("put one pen in the cup, and it must not be a red one"); None where it is no choice, or where
    the place is one, too.
    """
    taken = rest[-1].clause
    again = isinstance(taken, PutClause) and taken.groups[0].things.phrases[0].pronoun == "it"
    at = -2 if again and rest[1:] else -1
    marks = _marks(taken.groups[0]) if isinstance(taken, PutClause) else []
    if any(map(_open_choice, marks)):
        return None

    def told(np: NounPhrase) -> NounPhrase | None:
        return _chosen(np, denied, said) if _open_choice(np) else None

    new = changed(rest[at].clause, told)
    done = [*rest]
    if new is not None:
        done[at] = replace(rest[at], clause=new)
    return None if new is None else tuple(done)


def _chosen(np: NounPhrase, denied: bool, said: NounPhrase | Modifier) -> NounPhrase | None:
    """One of several things, with what it is, or is not."""
    if isinstance(said, Modifier):
        so = any(word in STATES for word in said.words)  # what is to be empty is emptied
        return None if so else np.told_by(replace(said, denied=denied))
    if not said.determiner:
        return None
    if denied:
        out = excepting((said,))
        return None if out is None else np.told_by(out)
    fits = said.is_elliptic or said.head == np.head
    if np.pronoun or not fits or said.determiner not in ("a", "an", "the"):
        return None
    of = said.determiner == "the" or np.determiner.endswith("the")
    words = (*np.words[:-1], singular(np.head)) if of else np.words
    determiner = said.determiner if of else np.determiner
    more = tuple(word for word in said.words[:-1] if word not in np.words)
    told = replace(np, determiner=determiner, words=(*more, *words))
    return told.told_by(*said.modifiers)


def _so_of_things(rest: Reading, so: Modifier, *, each: bool) -> Reading | None:
    """A request with what is said, behind the place, of ``each`` of the things or of the one that
    goes there ("two pens in the cup, neither of them red", "a pen in the cup, one that is red").
    """

    def told(np: NounPhrase) -> NounPhrase | None:
        several = singular(np.head) != np.head
        fits = several if each else not several and np.determiner in (*_CHOICE, "another")
        return np.told_by(so) if fits and np.words else None

    vessel = so.prep is Prep.QUALITY and any(word in STATES for word in so.words)
    new = None if vessel else changed(rest[-1].clause, told)
    return None if new is None else (*rest[:-1], replace(rest[-1], clause=new))


_IT_IS = sequence(
    OPTIONAL_COMMA,
    "[and|but] it (must|should|has to|needs to|ought to|may|can|is to)",
    either(phrase("not be", True), phrase("be", False)),
    either(noun_phrase, quality_alone),
    build=lambda denied, said: (denied, said),
)
"""Behind a choice, what the one that is chosen is, or is not."""


def but_not(rest: Reading, out: Modifier) -> Reading | None:
    """What is left out behind "it", of a choice before ("pick any cup and put it there, but not the
    red one"); where it is about a choice of places as well, that may be meant.
    """
    if len(rest) < 2:
        return None
    match rest[-2].clause, rest[-1].clause:
        case (
            PickClause(things=Things(phrases=(np,))),
            PutClause(groups=(PutGroup(things=Things(phrases=(NounPhrase(pronoun="it"),))) as to,)),
        ) if np.determiner in _CHOICE:
            if any(mark.determiner in _CHOICE for mark in _marks(to)):
                return None
            new = excluding(rest[-2].clause, out)
            return None if new is None else (*rest[:-2], replace(rest[-2], clause=new), rest[-1])
    return None


_BY_NOW = optional(fillers.BY_NOW)
TOLD_BEHIND = either(
    variants(
        sequence(CHAIN, COMMA, _BY_NOW, phrase("it is, they are"), _BY_NOW, DESCRIBED, _BY_NOW),
        lambda found: told_behind(found[0], found[1].split()[0], found[2]),
    ),
    sequence(CHAIN, COMMA, AS_IT_IS, build=add),
    sequence(CHAIN, COMMA, noun_phrase, fillers.ANY_WILL_DO, build=any_such),
    sequence(CHAIN, OPTIONAL_COMMA, either(LEFT_OUT, CONTRASTED), build=but_not),
    sequence(CHAIN, OF_ALL, build=partial(_so_of_things, each=True)),
    sequence(CHAIN, ONE_SUCH, build=partial(_so_of_things, each=False)),
    sequence(CHAIN, _IT_IS, build=lambda rest, said: choosing(rest, *said)),
)
"""A request, with what is said behind it of what it speaks of."""

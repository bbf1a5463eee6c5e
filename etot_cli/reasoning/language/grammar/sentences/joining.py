"""How clauses that are joined become one reading, in the order in which they are to be done."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.ensuring import OF_SEVERAL
from etot_cli.reasoning.language.grammar.parsers.combinators import Parser, Part, sequence
from etot_cli.reasoning.language.grammar.parsers.trees import nodes
from etot_cli.reasoning.language.grammar.requests.emptying import is_emptying
from etot_cli.reasoning.language.grammar.requests.taking import DESKS
from etot_cli.reasoning.language.grammar.sentences.before_and_after import (
    ahead_of,
    once_done,
    then_done,
)
from etot_cli.reasoning.language.grammar.sentences.passives import goes_on
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Reading
from etot_cli.reasoning.language.grammar.sentences.topics import sources
from etot_cli.reasoning.language.grammar.sentences.which_clauses import held_by, named_last
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AgainClause,
    AvoidClause,
    Clause,
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    PutGroup,
    RemoveClause,
    TowerClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words.nouns import THE_WORDS

Joined = tuple[tuple[str, Reading], ...]
"""Readings with what joins them."""


def joint(name: str, *parts: Part) -> Parser:
    """What goes on a sentence, with a name for what joins it."""
    return sequence(*parts, build=lambda reading: (name, reading))


_LATER = frozenset({"then", "counted", "passive, then", "which", "before"})


def _maybe_denied(done: Reading, clause: Reading) -> Reading:
    """In "do not touch the cup and open the drawer" the drawer may be denied, too; nobody wants it
    not to be kept closed.
    """
    before, after = done[-1].clause, clause[0].clause
    kept = isinstance(after, EnsureClause) and all(
        state.kept and state.word == "closed" for state in after.states
    )
    if not isinstance(before, AvoidClause) or not before.negated:
        return done
    if kept or isinstance(after, AvoidClause):
        return done
    return (*done[:-1], replace(done[-1], clause=replace(before, goes_on=True)))


def _also_left(before: Clause, clause: Reading) -> Reading:
    """In "the cup stays where it is, the pen too" the pen does, whatever was asked for before."""
    too = clause[0].clause
    if not (isinstance(before, AvoidClause) and isinstance(too, AgainClause) and too.things):
        return clause
    return (replace(clause[0], clause=replace(before, things=too.things)), *clause[1:])


def _is_told_of(before: Clause, joint: str, after: Clause) -> bool:
    """Whether a clause says of a stack, which one before it takes apart or turns over, what its own
    rules have to understand.
    """
    match before:
        case TowerClause(reverses=True):
            return joint == "so that"
        case RemoveClause(stacked=True):
            return any(np.determiner == "its" for np in nodes(after) if isinstance(np, NounPhrase))
    return False


def _is_denied(clause: Clause) -> bool:
    """Whether a clause says what is not to be done, or not to be so."""
    match clause:
        case AvoidClause():
            return clause.negated and not clause.needless
        case EnsureClause(states=states):
            return any(state.denied for state in states)
    return False


def _done_after(done: Reading, clause: Reading) -> Reading:
    """What was asked for, after something else. That comes before all of it, but for what speaks of
    what was done with the same things ("put the pen in and close it once the pen is in").
    """
    *before, last = done
    put = clause[0].clause
    same = isinstance(put, PutClause) and any(
        isinstance(said.clause, PutClause)
        and [np.words for np in said.clause.groups[0].things.phrases]
        == [np.words for np in put.groups[0].things.phrases]
        for said in before
    )
    if before and len(clause) == 1 and same:
        return (*before, *then_done(clause), *then_done((last,)))
    return once_done(clause, done)


def _brought_beside(before: Clause, clause: Clause) -> PutClause | None:
    """What is brought to a thing and then left beside "that" goes beside that thing at once."""
    match before, clause:
        case (
            PutClause(
                groups=(PutGroup(destinations=(Destination(toward=Toward.TO) as to,)) as put,)
            ),
            PutClause(
                groups=(PutGroup(destinations=(Destination(beside=(near,)) as there,)) as left,)
            ),
        ) if len(put.things.phrases) == len(to.targets) == 1 and not there.targets:
            (theme, *more), marks = left.things.phrases, near.phrases
            of_that = len(marks) == 1 and marks[0].text in ("it", "that") and not marks[0].modifiers
            if theme.text != "it" or more or not of_that:
                return None
            where = replace(there, beside=(replace(near, phrases=to.targets),))
            return replace(clause, groups=(replace(put, destinations=(where,)),), stays=False)
    return None


def _where_on_the_desk(before: Clause, clause: Clause) -> PutClause | None:
    """Where exactly on the desk stands what goes there ("take the cup to the desk and set it down
    next to the plate"), which is one place; what stands on a tray may be told to go beside it.
    """
    match before, clause:
        case (
            PutClause(groups=(PutGroup(destinations=(Destination(beside=()) as desk,)) as put,)),
            PutClause(groups=(PutGroup(destinations=(Destination(targets=()) as there,)) as left,)),
        ) if clause == PutClause((left,)) and there.toward is Toward.BESIDE:
            at = [np.words in DESKS and not np.modifiers for np in desk.targets]
            again = [np.text for np in left.things.phrases] in (["it"], ["them"])
            if at != [True] or desk.denied or not again:
                return None
            where = replace(desk, beside=there.beside, stance=there.stance or desk.stance)
            return replace(before, groups=(replace(put, destinations=(where,)),))
    return None


def _into_what_is_closed(before: Clause, clause: Clause) -> Clause:
    """Where something goes "in", if nothing was spoken of before: into what is closed then."""
    match before, clause:
        case (
            PutClause(
                groups=(PutGroup(destinations=(Destination(Toward.HERE, word="in") as at,)) as put,)
            ),
            MoveClause(things=Things(phrases=(np,), either=False), opens=False),
        ) if np.determiner in THE_WORDS and np.words:
            where = (replace(at, targets=(np,)),)
            return replace(before, groups=(replace(put, destinations=where),))
    return before


def _is_terse(before: Clause, clause: Clause) -> bool:
    """Whether what goes somewhere behind what is opened has no article ("open box, pen in box")."""
    groups = clause.groups if isinstance(clause, PutClause) else ()
    phrases = [np for group in groups for np in group.things.phrases]
    return isinstance(before, MoveClause) and all(not np.determiner for np in phrases)


def _is_of_nothing_else(clause: Clause) -> bool:
    """Whether what has been put somewhere is to be alone there."""
    if not isinstance(clause, AvoidClause) or not clause.not_left or clause.things is None:
        return False
    return [np.text for np in clause.things.phrases] == ["nothing else"]


def chained(first: Reading, more: Joined) -> Reading | None:
    """Clauses in the order in which they are to be done, by what joins them."""
    done = first
    for said, clause in more:
        beside = _brought_beside(done[-1].clause, clause[0].clause)
        if beside is None and said.endswith("and") and clause[0].order is Order.SAID:
            beside = _where_on_the_desk(done[-1].clause, clause[0].clause)
        if beside is not None and len(clause) == 1:
            done = (*done[:-1], replace(done[-1], clause=beside))
            continue
        if said.endswith(("and", "then")):
            closed = _into_what_is_closed(done[-1].clause, clause[0].clause)
            done = (*done[:-1], replace(done[-1], clause=closed))
        put = done[-1].clause if said == "listed" else None
        put = None if isinstance(clause[0].clause, RemoveClause) else put
        if isinstance(put, PutClause) and not any(sources(item.things) for item in put.groups):
            return None  # several things with their places are one clause
        if said == "turned" and not _is_terse(done[-1].clause, clause[0].clause):
            return None  # "open the drawer, the box in the cupboard" opens both
        if said == "emptied" and not is_emptying(done[-1].clause):
            return None  # behind another verb that may be said of this, too
        if said.startswith("passive") and not goes_on(done[-1].clause, clause[0].clause):
            return None
        before = done[-1].clause
        guarded = isinstance(before, MoveClause) and before.guarded
        if guarded and said != "then" and isinstance(clause[0].clause, EnsureClause):
            return None  # "open it if it is closed and the cup is on the tray"
        if said == "by" and isinstance(clause[0].clause, PickClause):
            return None  # "put it there by gripping it from above" says how it is held meanwhile
        wanted = isinstance(before, PickClause) and before.wanted
        if wanted and _is_of_nothing_else(clause[0].clause):
            return None  # "I want the cup and nothing else on the tray" does not ask to hold it
        if said == "purpose" and isinstance(before, PickClause) and before.wanted:
            return None  # "I want the box to have the cup in it" does not ask for the box
        if said == "while" and not any(
            isinstance(item, EnsureClause | AvoidClause) for item in (before, clause[0].clause)
        ):
            return None  # "keep it open while you …"; else the hand would do two things
        if _is_told_of(done[-1].clause, said, clause[0].clause):
            return None
        if said not in _LATER and len(done) == 1:
            clause = _also_left(before, clause)
        if said == "mere and":
            further = clause[0].clause
            if isinstance(further, EnsureClause) and further.far_fetched == OF_SEVERAL:
                return None  # "the cup on the tray and the pen in it go in the box"
            done = _maybe_denied(done, clause)
        if said == "verbless and" and _is_denied(before):
            return None  # "the cup should not be on the tray and the pen in the box": nor the pen?
        if said == "before" and _is_denied(before):
            return None  # "do not put it there before …" rather asks for both
        if said == "before" and (ahead := ahead_of(clause, done)):
            done = ahead
            continue
        if said in ("which", "which in turn"):
            named = named_last if said == "which" else held_by
            goes_there = named(before, clause[0].clause)
            if goes_there is None:
                return None
            clause = (replace(clause[0], clause=goes_there),)
        if said == "after" and is_emptying(before) and is_emptying(clause[0].clause):
            return None  # "clear it; when it is empty, …" goes on with something else
        if said == "after":
            done = _done_after(done, clause)
        else:
            done = (*done, *(then_done(clause) if said in _LATER else clause))
        if said == "counted":
            done = (*done[:-1], replace(done[-1], far_fetched=1))
    return done

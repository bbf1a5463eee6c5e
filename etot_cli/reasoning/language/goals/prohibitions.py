"""What must not be done, or must stay as it is, as constraints on every step."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from operator import attrgetter

from msgspec import structs

from etot_cli.reasoning.builtin.goal import Close, Constraint, Goal, Keep, Open, Put, Thing
from etot_cli.reasoning.builtin.relations import carriers, is_closed, is_open, parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.alone import check_alone, leave_alone_there
from etot_cli.reasoning.language.goals.choosing import leave_among
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.knocked_over import keep_it_standing
from etot_cli.reasoning.language.goals.left_alone import (
    boards_left_alone,
    in_part,
    is_of_boards,
    what_is_there,
)
from etot_cli.reasoning.language.goals.ruled_out import rule_out_things
from etot_cli.reasoning.language.goals.turned import leave_among_turned
from etot_cli.reasoning.language.goals.unchosen import is_not_chosen, keep_others
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Avoid,
    AvoidClause,
    EnsureClause,
    MoveClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.usual_form import leaves_noun_out
from etot_cli.reasoning.language.words.lexicon import (
    JOINT_NOUNS,
    LEVELS,
    THING_NOUNS,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.nouns import is_only
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import DESK

_KEEPS = {
    Avoid.TOUCH: Keep.UNTOUCHED,
    Avoid.MOVE: Keep.UNMOVED,
    Avoid.HIT: Keep.UNHIT,
    Avoid.OPEN: Keep.CLOSED,
    Avoid.CLOSE: Keep.OPEN,
}
_LEAVING = (Avoid.TOUCH, Avoid.MOVE, Avoid.HIT)
_THE_REST = (("the rest",), ("all the rest",), ("the others",))
_THINGS = ("thing", "object", "item")
_TARGETS = (Role.CONTAINER, Role.SURFACE, Role.PLACE)


def avoid(context: Context, clause: AvoidClause) -> None:
    """Adds what a clause forbids, or calls needless, to the constraints."""
    before = len(context.constraints)
    things = clause.things
    if things and things.either and clause.avoid in _LEAVING:
        # Neither "the cup or anything on it": the one after the other, as "it" may be the first.
        clause = structs.replace(clause, things=structs.replace(things, either=False))
    _forbid(context, clause)
    if clause.needless:
        new = context.constraints[before:]
        context.constraints[before:] = [replace(item, needless=True) for item in new]


def _left_by_what_moves(context: Context, clause: AvoidClause) -> tuple[int, ...]:
    """What "it" is in "put the pen in the mug without knocking it over": the pen is in the hand;
    "them" of one thing is what a plural is said of ("beside the scissors without moving them").
    """
    step = context.done[-1] if context.done else None
    (np, *more) = clause.things.phrases if clause.things else (NounPhrase(),)
    alone = np.pronoun in ("it", "them") and not more
    if not alone or clause.avoid not in _LEAVING or clause.negated or not isinstance(step, Put):
        return ()
    there = {place.where for place in step.places}
    there |= {mark for place in step.places for near in place.beside for mark in near.landmarks}
    if np.pronoun == "them":
        plural = {m.referent for m in context.discourse.mentions if singular(m.noun) != m.noun}
        several = plural & {*step.what} or len(step.what) > 1
        found = tuple(index for index in there if index in plural)
        return found if len(found) == 1 and not several else ()
    with suppress(ReferenceProblem):
        found = context.phrases.refer(np, Role.ANY, step.what)
        return found if {*found} <= there else ()
    return ()


def _forbid(context: Context, clause: AvoidClause) -> None:
    """Adds what a clause forbids to the constraints, or notes that no plan does it anyway.

    Raises:
        ReferenceProblem: it is not clear what is meant, or no plan can be kept from it.
    """
    things = clause.things
    if clause.goes_on:
        last = things.phrases[-1].text if things else "anything else"
        why = "'not' may be said of what follows by 'and', too; say that in a sentence of its own"
        raise ReferenceProblem(last, why, 4)
    if things is None:
        if clause.avoid is Avoid.HARM:
            context.discourse.notes.append("no plan may harm anything")
        else:
            _avoid_others(context, clause)
        return
    if keep_it_standing(context, clause):
        return
    _check_moves(context, clause.by)
    leaves = clause.avoid in _LEAVING
    if any(_is_the_rest(np, any_thing=leaves) and not np.modifiers for np in things.phrases):
        if clause.avoid is Avoid.PUT:
            leave_alone_there(context, clause.destinations)
            return
        others = _others_like_what_turns(context, things)
        if others is None:
            _avoid_others(context, clause)
        else:
            _forbid(context, structs.replace(clause, things=others))
    elif clause.avoid is Avoid.PUT:
        _rule_out(context, clause, things)
    else:
        _keep(context, clause, things)


def _is_the_rest(np: NounPhrase, *, any_thing: bool) -> bool:
    """Whether a phrase is all that is left ("the rest"), with "any of the other things", too."""
    other = any_thing and bool(np.words) and quantity_of(np.determiner).other
    return np.words in _THE_REST or (other and " ".join(map(singular, np.words)) in _THINGS)


def _rule_out(context: Context, clause: AvoidClause, things: Things) -> None:
    """Places where things must not be put. "Do not put the plum there, put it here" speaks of the
    plum, and "in the red one" of what "there" is.
    """
    before = len(context.discourse.mentions)
    rule_out_things(context, clause)
    said = context.discourse.mentions[before:]
    # After others "it" is the plum, too, where that has to come out of there.
    own = not before or any(isinstance(step, Put) and step.removal for step in context.steps)
    kept = [mention for mention in said if mention.role is Role.THEME and own]
    targets = [structs.replace(m, role=Role.ANY) for m in said if m.role in _TARGETS]
    kept += [structs.replace(m, clause=0) for m in targets] if before else targets
    # "Nothing but the cups may be there, so put them there"; behind "no cup but the white one"
    # "the other" is one of the cups.
    general = all({*np.words} & {"", "anything", *THING_NOUNS} for np in things.phrases)
    left_out = context.discourse.left_out if general else {}
    spared = [thing for m in said for thing in left_out.get(m.referent, ())]
    context.discourse.mentions[before:] = [] if spared else kept
    for thing in sorted(spared, key=attrgetter("address")):
        context.discourse.alone(thing, Role.THEME)


def _keep(context: Context, clause: AvoidClause, things: Things) -> None:
    """Things that are kept as they are: as the clause says, or as it is understood of those that
    are moved, opened or taken along anyway.
    """
    before = len(context.discourse.mentions)
    role = _role_of_kept(context, clause, things)
    indices = _left_by_what_moves(context, clause) or context.phrases.things(things, role)
    kept = context.discourse.things(*indices)
    for np in things.phrases if len(kept) == 1 else ():
        if np.determiner == "either" and not np.modifiers and np.head in ("", "one"):
            raise ReferenceProblem(np.text, "say which two", 3)
    if clause.avoid is Avoid.HARM:
        harmed = " and ".join(thing.address for thing in kept)
        context.discourse.notes.append(f"no plan may harm {harmed}")
        return
    if clause.over and not things.are_any:
        context.toppling |= {thing.name for thing in kept}
    if clause.taken or (clause.avoid is Avoid.MOVE and _is_out_of_something(things)):
        context.within += [
            Put((context.single(thing, thing.name),), (context.home(thing),)) for thing in kept
        ]
    one_way = all(len(context.discourse.referents[index].options) == 1 for index in indices)
    if clause.avoid is Avoid.MOVE and role is not Role.PART and one_way:
        leave_among(context, indices, but_for_counted=not clause.left)
    if all(is_not_chosen(context, index) for index in indices) and role is not Role.PART:
        if clause.avoid in _LEAVING:
            context.constraints += (
                Constraint(_KEEPS[clause.avoid], (), referent=index) for index in indices
            )
        return
    if clause.avoid is Avoid.MOVE and any(is_only(np.determiner) for np in things.phrases):
        check_alone(context, things.phrases, indices, [context.home(thing) for thing in kept])
    for index in indices if clause.avoid in (Avoid.OPEN, Avoid.CLOSE) else ():
        if clause.avoid is Avoid.CLOSE and not context.discourse.is_spoken(index):
            context.discourse.as_it_stands(index, is_open)
        leave_among_turned(context, index, opens=clause.avoid is Avoid.CLOSE)
    done = [s for s in context.done if isinstance(s, Open | Close) and s.what in indices]
    if clause.avoid is Avoid.MOVE and done:  # "open it and leave it as it is"
        context.steps += [replace(step, final=True) for step in done]
        return
    # "Without touching a cup" is about all of them, told again by what was made of them above.
    kept = context.discourse.things(*indices)
    names = _names_of_kept(context, clause, kept, by_part=role is Role.PART)
    said = (mention.referent for mention in context.discourse.mentions[before:])
    context.discourse.spared = context.discourse.clause, tuple(dict.fromkeys(said))
    turning = clause.avoid in (Avoid.OPEN, Avoid.CLOSE)
    context.discourse.spared_alone = clause.left or clause.negated or turning
    context.discourse.step_back(before, indices)
    if clause.avoid in _LEAVING:
        context.discourse.left_alone |= {*indices}
        out = [thing for i in indices for thing in context.discourse.left_out.get(i, ())]
        # "All as it is except for the cup; that goes on the tray"
        for thing in sorted(out, key=attrgetter("address")):
            context.discourse.alone(thing, Role.THEME)
    context.constraints += _as_constraints(context, clause, things, kept, names)


def _role_of_kept(context: Context, clause: AvoidClause, things: Things) -> Role:
    """What the things that are kept as they are are among."""
    if clause.avoid in (Avoid.OPEN, Avoid.CLOSE):
        return Role.PART
    elliptic = (
        np.is_elliptic or leaves_noun_out(np) or not (np.words or np.pronoun)
        for np in things.phrases
    )
    return _role_of_one(context, things) if any(elliptic) else Role.ANY


def _names_of_kept(
    context: Context, clause: AvoidClause, kept: Sequence[Thing], *, by_part: bool
) -> tuple[str, ...]:
    """The names that a constraint has things by; of what is not to be opened only what is shut, as
    what stands open is neither opened nor to be closed.

    Raises:
        ReferenceProblem: nothing can be kept from the desk, or from one board.
    """
    names = tuple(dict.fromkeys(t.address if by_part and t.part else t.name for t in kept))
    if clause.avoid is Avoid.OPEN:
        own = [part for thing in kept for part in parts_of(context.scene, thing)]
        shut = [part for part in own if not is_open(context.scene, part)]
        if shut != own:
            names = tuple(f"{part.owner}.{part.name}" for part in shut) or names
    if DESK in names:
        raise ReferenceProblem("desk", "the desk cannot be left untouched", 2)
    board = next((t for t in kept if t.board), None)
    if clause.avoid is Avoid.TOUCH and board and not is_of_boards(clause, kept):
        why = "one board alone is not kept from being touched; say that nothing is put on it"
        raise ReferenceProblem(board.address, why, 2)
    return names


def _as_constraints(
    context: Context,
    clause: AvoidClause,
    things: Things,
    kept: Sequence[Thing],
    names: tuple[str, ...],
) -> Iterator[Constraint]:
    """How things are kept as they are; a drawer moves by being opened or closed, not with its
    chest.
    """
    if is_of_boards(clause, kept):
        yield from boards_left_alone(context, kept, _KEEPS[clause.avoid])
        return
    joints = sum(JOINT_NOUNS.values(), ())
    drawers = all(np.words and matches_any(np.head, joints) for np in things.phrases)
    moving = {t: parts_of(context.scene, t) for t in kept if t.part or drawers}
    parts = [part for found in moving.values() for part in found]
    ways = [
        is_open(context.scene, p) or (is_closed(context.scene, p) and Keep.CLOSED) for p in parts
    ]
    addresses = tuple(f"{part.owner}.{part.name}" for part in parts)
    turning = clause.avoid in _LEAVING and all(moving.get(t) for t in kept)
    if turning and all(ways):
        for address, way in zip(addresses, ways, strict=True):
            yield Constraint(Keep.OPEN if way is True else Keep.CLOSED, (address,))
        if clause.avoid is Avoid.TOUCH:
            yield Constraint(Keep.UNTOUCHED, addresses)
        if clause.as_it_is and (inside := in_part(context, addresses)):
            yield Constraint(Keep.UNMOVED, inside)
        return
    names = addresses if turning else names  # one that is ajar, not its chest
    there = what_is_there(context, names) if clause.as_it_is else ()
    yield Constraint(_KEEPS[clause.avoid], (*names, *there))


def _check_moves(context: Context, by: Sequence[NounPhrase]) -> None:
    """Whether that by which something must not be touched is a door or drawer.

    Raises:
        ReferenceProblem: it is none, but something that is itself put somewhere.
    """
    before = [*context.discourse.mentions]
    for np in by:
        index = context.phrases.things(Things((np,)), Role.PART)
        if not all(parts_of(context.scene, t) for t in context.discourse.things(*index)):
            raise ReferenceProblem(np.text, "only doors and drawers can be kept from things", 4)
    if context.done:  # "it" is what was asked for
        context.discourse.mentions = before


def _role_of_one(context: Context, things: Things) -> Role:
    """What "the red one" is among: it speaks of what was moved rather than of where to, unless that
    is moved anyway.
    """
    if isinstance(context.last, MoveClause):
        return Role.PART
    if not _moves_anyway(context, things):
        return Role.PLACE if _is_of_places(context, things) else Role.THEME
    with suppress(ReferenceProblem):
        for np in things.phrases:
            context.phrases.meaning(np, Role.PART)
        return Role.PART
    return Role.PLACE


def _is_of_places(context: Context, things: Things) -> bool:
    """Whether "the upper one" is a board or drawer, as it is none of what could be put anywhere."""
    if not all({*np.words} & LEVELS.keys() for np in things.phrases):
        return False
    with suppress(ReferenceProblem):
        themes = [context.phrases.meaning(np, Role.THEME) for np in things.phrases]
        found = [thing for theme in themes for option in theme.options for thing in option]
        if not any(thing.part or thing.board for thing in found):
            return False
    return True


def _moves_anyway(context: Context, things: Things) -> bool:
    """Whether "the right one" cannot be one of the things that are put somewhere: it is moved."""
    if any(quantity_of(np.determiner).other for np in things.phrases):
        return False
    surely = [
        index
        for index in context.discourse.put
        if max(map(len, context.discourse.referents[index].options)) < 2  # else it is left out
    ]
    moved = context.discourse.things(*surely)
    with suppress(ReferenceProblem):
        found = [context.phrases.meaning(np, Role.THEME).options for np in things.phrases]
        return all({*option} <= {*moved} for options in found for option in options)
    return False


def _is_out_of_something(things: Things) -> bool:
    """Whether it is said out of what; "the mug there" is but told from others by that."""
    sources = [m for np in things.phrases for m in np.modifiers if m.prep is Prep.FROM]
    return any(np.text != "there" for source in sources for np in source.phrases)


def gone_along(context: Context, goal: Goal) -> Goal:
    """With what must not be taken out of something in that in the end, where that goes elsewhere
    itself, or something else is put into it, by which it may be moved.
    """
    steps, constraints = list(goal.steps), list(goal.constraints)
    for put in context.within:
        (thing,) = context.discourse.things(*put.what)
        around = carriers(context.scene, thing.name)
        for at, step in enumerate(goal.steps):
            where = [p.where for p in step.places] if isinstance(step, Put) else []
            moved = (*step.what, *where) if isinstance(step, Put) else ()
            names = {t.name for i in moved if i is not None for t in context.discourse.things(i)}
            if names & around:
                steps.insert(at + 1 + len(steps) - len(goal.steps), put)
                constraints = [
                    replace(item, names=tuple(n for n in item.names if n != thing.name))
                    if item.keep is Keep.UNMOVED
                    else item
                    for item in constraints
                ]
                break
    kept = tuple(item for item in constraints if item.names or item.referent is not None)
    return replace(goal, steps=tuple(steps), constraints=kept)


def _others_like_what_turns(context: Context, said: Things) -> Things | None:
    """Behind "close the top drawer", "the others" are the other drawers, where there are any."""
    others = said.phrases[0].words == ("the others",)
    if not isinstance(context.last, MoveClause) or not others:
        return None
    noun = singular(context.last.things.phrases[-1].head)
    phrase = NounPhrase("all the other", (f"{noun}s",), text="the others")
    try:
        found = context.phrases.meaning(phrase, Role.PART)
    except ReferenceProblem:
        return None
    return Things((phrase,)) if found.options[0] else None


def _avoid_others(context: Context, clause: AvoidClause) -> None:
    """Nothing but what was spoken of may be touched or moved; where things are to be with "nothing
    else", without a word for moving, says what is to be there.
    """
    ensured = context.last.states if isinstance(context.last, EnsureClause) else ()
    if ensured and clause.not_left and not any(state.word for state in ensured):
        only = (NounPhrase("only", text="nothing else"),)
        for step in context.done:
            if isinstance(step, Put):
                check_alone(context, only, step.what, step.places, in_the_end=True)
        return
    text = clause.things.phrases[0].text if clause.things else ""
    keep_others(context, _KEEPS[clause.avoid], text)

"""A clause with some of its things left out, or changed otherwise."""

from __future__ import annotations

from collections.abc import Callable

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.phrases.contrasts import excepting
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
    Modifier,
    NounPhrase,
    State,
    Things,
)
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS, matches_any, singular
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.places import Prep


def excluding(clause: Clause, left_out: Modifier, at: int = -1) -> Clause | None:
    """A clause without some of the things that it is about ("…, except the blue one"), of those
    that its last phrase means, or that ``at`` an index.
    """
    some = left_out.prep is Prep.EXCEPT and not left_out.denied
    if only := only_there(clause, left_out):
        return only
    match clause:
        case PutClause(groups=(_, *_, last) as groups) if some:
            # "The red cup in the box and the others on the tray, except the blue one"
            alone = all(_is_one(np) for group in groups[:-1] for np in group.things.phrases)
            rest = excluding(replace(clause, groups=(last,)), left_out, at) if alone else None
            if not isinstance(rest, PutClause):
                return None
            return replace(rest, groups=(*groups[:-1], *rest.groups))

    def without(np: NounPhrase) -> NounPhrase | None:
        # "Any cup, put it there, but not the red one" is said of what "it" was chosen from.
        single = (some or (left_out.prep is Prep.QUALITY and left_out.denied)) and _is_one(np)
        return None if np.pronoun == "it" or single else np.told_by(left_out)

    return changed(clause, without, at)


def only_there(clause: Clause, left_out: Modifier) -> EnsureClause | None:
    """What is excepted where nothing is to be in the end ("nothing should be on the tray except the
    cup") is to be there, alone; what alone "may" be there need not be. None where no such thing is
    said.
    """
    if not isinstance(clause, AvoidClause) or clause.negated or not clause.not_left:
        return None
    phrases = clause.things.phrases if clause.things else ()
    nothing = [np.words for np in phrases] == [("anything",)]
    return alone_there(clause.destinations, left_out) if nothing else None


def alone_there(where: tuple[Destination, ...], left_out: Modifier) -> EnsureClause | None:
    """What alone is to be somewhere: what is excepted where nothing is to be there."""
    (first, *more), the = left_out.phrases, left_out.phrases[0].determiner or "the"
    excepted = left_out.prep is Prep.EXCEPT and not left_out.denied and the in THE_WORDS
    if not excepted or first.pronoun:
        return None
    only = replace(first, determiner=f"only {the}")
    return EnsureClause((State((only, *more), where, alone=True),))


def changed(
    clause: Clause, change: Callable[[NounPhrase], NounPhrase | None], at: int = -1
) -> Clause | None:
    """A clause with one of the phrases for what it is about changed, the last one by default; None
    where that cannot be changed.
    """

    def without(things: Things) -> Things | None:
        phrases = [*things.phrases]
        new = change(phrases[at])
        if new is None:
            return None
        phrases[at] = new
        return replace(things, phrases=tuple(phrases))

    match clause:
        case PutClause(groups=(group,)) if rest := without(group.things):
            return replace(clause, groups=(replace(group, things=rest),))
        case EnsureClause(states=(state,)) if rest := without(Things(state.subjects)):
            return EnsureClause((replace(state, subjects=rest.phrases),))
        case (
            PickClause(things=things)
            | RemoveClause(things=things)
            | MoveClause(things=things)
            | TowerClause(things=things)
            | AgainClause(things=Things() as things)
            | AvoidClause(things=Things() as things)
        ) if rest := without(things):
            return replace(clause, things=rest)
    return None


def of_the_things(clause: Clause, said: Modifier) -> Clause | None:
    """What stands behind a place is said of what goes there only if it cannot be of the place; of
    one of several ("one apple in the basket, namely the green one") it may be as well.
    """
    match found := excluding(clause, said):
        case (
            PutClause(groups=(PutGroup(things=Things(phrases=(np,))),))
            | EnsureClause(states=(State(subjects=(np,)),))
        ):
            one = np.determiner.split()[-1:] in (["a"], ["an"], ["one"], ["any"])
            return replace(found, far_fetched=int(not one or said.prep is Prep.CONTRAST))
        case PutClause() | EnsureClause():
            return replace(found, far_fetched=1)
    return found


def but_some(clause: PutClause, group: PutGroup, *, set_off: bool) -> Clause | None:
    """All of them go to one place but for some that go to another. Where no comma sets these off,
    "everything on the shelf but the cup" may as well be what is on the shelf. Of one thing nothing
    is left out: "the cup on the shelf but the pen in it".
    """
    match clause.groups:
        case (PutGroup(things=Things(phrases=(np,), either=False)),) if _is_one(np):
            return replace(clause, groups=(*clause.groups, group))
    out = excepting(group.things.phrases)
    found = None if out is None or group.things.either else excluding(clause, out)
    if not isinstance(found, PutClause):
        return None
    doubt = found.far_fetched + (not set_off)
    return replace(found, groups=(*found.groups, group), far_fetched=doubt)


def _is_one(np: NounPhrase) -> bool:
    """Whether a phrase means one thing, of which nothing can be left out."""
    several = not np.words or singular(np.head) != np.head or matches_any(np.head, THING_NOUNS)
    known = np.determiner in ("", "the", "this", "that", "my")
    return known and not (several or is_category(np.head))

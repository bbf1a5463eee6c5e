"""What is emptied, cleared or tidied, or is to be without what is in or on it."""

from __future__ import annotations

from functools import partial
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    one_of,
    optional,
    phrase,
    sequence,
    silent,
    valued,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.phrases.coordination import all_of
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS, DIRECTED
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.phrases.turns import TURN, turns_of
from etot_cli.reasoning.language.grammar.phrases.where_not import ELSEWHERE, WHERE
from etot_cli.reasoning.language.grammar.requests.additions import EXTRAS, put_of
from etot_cli.reasoning.language.grammar.requests.taking import DESKS, REMOVE, SOURCE
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Avoid,
    AvoidClause,
    Clause,
    PutClause,
    PutGroup,
    RemoveClause,
    Turns,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    CLEARED,
    Destination,
    Modifier,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import manner, predicates, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import (
    KIND_NOUNS,
    OPEN_SURFACES,
    OPEN_VESSELS,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep


def contents_of(np: NounPhrase, where: Prep, part: tuple[str, ...] = ()) -> NounPhrase:
    """What is in or on something, or on a ``part`` of it, whatever it is."""
    modifier = Modifier(where, (np,), part if where is Prep.ON else CLEARED)
    upon = where is Prep.ON or np.words[-1:] in DESKS
    text = f"everything {'on' if upon else 'in'} {np.text}"
    return NounPhrase("all", ("objects",), (modifier,), text=text)


def emptied(
    things: Things,
    where: Any = None,
    *,
    held: Prep | None = None,
    part: tuple[str, ...] = (),
    told: bool = False,
) -> Clause:
    """What takes all out of things, or off a ``part`` of them, and brings it somewhere; ``told``:
    it is said how they are to be.
    """
    where_from = partial(contents_of, where=held or Prep.FROM, part=part)
    contents = Things(tuple(map(where_from, things.phrases)))
    if where is None:
        return RemoveClause(contents, told=told)
    # "Empty the box on the right" rather says which box.
    which = all(item.toward is Toward.BESIDE and not item.beside[0].phrases for item in where)
    return replace(put_to(contents, where), far_fetched=2 * which)


def _emptied_in_turn(things: Things, where: Any, turn: Any) -> Clause | None:
    """What takes all out of things, some of it first or last."""
    clause, turns = emptied(things, where), turns_of((turn,))
    return replace(clause, turns=turns) if turns and isinstance(clause, PutClause) else None


ANYTHING = Things((NounPhrase(words=("anything",), text="anything"),))


def stays_empty(
    np: NounPhrase, far_fetched: int = 0, toward: Toward = Toward.INSIDE, *, negated: bool = False
) -> AvoidClause:
    """Nothing is to be put into what stays empty, or is to be so and is already."""
    where = Destination(toward, (np,))
    return AvoidClause(
        Avoid.PUT, ANYTHING, (where,), negated=negated, not_left=True, far_fetched=far_fetched
    )


def to_be_empty(things: Things) -> tuple[Clause, ...]:
    """What is to be empty is emptied, or stays so where nothing is in it."""
    stays = (stays_empty(np, 1) for np in things.phrases[:1])
    return emptied(things, told=True), *stays


def is_emptying(clause: Clause) -> bool:
    """Whether things are to be without what is in or on them, wherever that goes."""
    return isinstance(clause, RemoveClause) and all(
        [item.words for item in np.modifiers] == [CLEARED] for np in clause.things.phrases
    )


_HOLDERS = (*OPEN_VESSELS, *OPEN_SURFACES, *KIND_NOUNS["cup"], *KIND_NOUNS["bowl"])
"""What is cleared of what is in or on it, rather than away."""


def _tidied(verb: str, things: Things, away: str, where: Any, extras: Any) -> PutClause | None:
    """Who tidies a place brings away what is there; several things are tidied away themselves.
    "Tidy up everything on the tray" does not say where to.
    """
    put = put_of((PutGroup(things, where),), extras)
    if (things.are_any and not away) or put is None:
        return None
    bare = verb in ("clear", "clearing") and not away
    if (
        bare
        and put.turns != Turns()
        and any(matches_any(np.head, _HOLDERS) for np in things.phrases)
    ):
        return None  # "clear the bowls onto the tray, the red one first" is about what is in them
    plural = any(np.words and singular(np.words[-1]) != np.words[-1] for np in things.phrases)
    things_said = verb.startswith("tidy") and (plural or len(things.phrases) > 1)
    cost = 1 if verb.startswith("tidy") else 2  # who clears a plate rather means what is on it
    return replace(put, far_fetched=put.far_fetched + (0 if things_said else cost))


def _to_be_bare(
    found: tuple[Prep | None, tuple[str, ...], Things], *, negated: bool = False
) -> tuple[Clause, ...]:
    """What takes all off things, or out of them; the one thing that is so already stays so."""
    at, part, things = found
    (np, *more) = things.phrases
    toward = Toward.ON if at else Toward.INSIDE
    stays = () if part or more or np.modifiers else (stays_empty(np, 1, toward, negated=negated),)
    return emptied(things, held=at, part=part, told=True), *stays


_IN_OR_ON: dict[tuple[Prep | None, tuple[str, ...]], str] = {
    (None, ()): "in, inside", (Prep.ON, ()): "on",
}  # fmt: skip


def _nothing_there(said: str) -> Parser:
    """Where there is nothing, behind words for that."""
    return sequence(
        said,
        one_of({**_IN_OR_ON, (Prep.ON, _TOP): "on [the] top of"}),
        ALL_THINGS,
        silent(optional(small_words.ANY_MORE)),
        build=lambda at, things: (*at, things),
    )


def _has_nothing(*said: Any) -> Parser:
    """The same, said of the thing ("the tray has nothing on it")."""
    return sequence(
        *said,
        silent(optional("left, lying, standing, sitting")),
        one_of(_IN_OR_ON),
        "it, them",
        silent(optional(small_words.ANY_MORE)),
        build=lambda things, at: (*at, things),
    )


_HOLDS_NOTHING = "(contains|contain|holds|hold|carries|carry|bears|bear|supports|support) nothing"
_TOP = ("top",)


_TOP_OF = sequence("the (top|surface) of", ALL_THINGS)
_ON_IT = "((on [top of]|in|inside) (it|them|there)|there|on top|inside)"
_OF_ALL_ON_IT = f"""
    of (what|whatever|everything [(that|which)]|anything [(that|which)]|all (that|which))
    (is|lies|stands|rests|sits) [still] [lying|standing|sitting|resting|left] {_ON_IT},
    of everything [lying|standing|sitting|left] {_ON_IT}, of everything
"""
_ALL_THAT_IS = "[all] the contents of, (everything|all) (in|inside), what is (in|inside)"


_IS_TO_BE = either(
    sequence(ALL_THINGS, predicates.MODAL),
    sequence(verbs.ENSURE, ALL_THINGS, predicates.BE),
    sequence(predicates.WANTED, ALL_THINGS, optional("to be")),
    sequence("let, have", ALL_THINGS, "be"),
)
TO_BE_EMPTY = either(
    sequence(
        either(_IS_TO_BE, sequence(ALL_THINGS, "is, are, (has|have) been")),
        "emptied [out], cleared [out], unloaded",
        DESTINATIONS,
        build=emptied,
    ),
    variants(
        sequence(
            _IS_TO_BE,
            optional(phrase("both, all"), ""),
            manner.EMPTIED,
            silent(optional(_OF_ALL_ON_IT)),
            build=lambda things, said: Things(all_of(things.phrases, said)),
        ),
        to_be_empty,
    ),
    variants(
        sequence(
            predicates.CAN,
            ALL_THINGS,
            "[please] be (cleared|emptied) [out]",
            silent(optional(_OF_ALL_ON_IT)),
        ),
        to_be_empty,
    ),
    variants(
        either(
            _nothing_there(predicates.NOTHING_IS),
            _has_nothing(
                ALL_THINGS, "(must|should|shall|has to|have to|is to|are to) have nothing"
            ),
            _has_nothing(
                either(verbs.ENSURE, predicates.WANTED),
                ALL_THINGS,
                "(has|have|with|to have) nothing",
            ),
        ),
        _to_be_bare,
    ),
    variants(_nothing_there(predicates.NOTHING_MAY_BE), partial(_to_be_bare, negated=True)),
)
"""What is said of how things are to be, rather than of what is to be done."""


EMPTY = either(
    sequence(
        "empty[ing] [out], unload[ing]",
        optional(_ALL_THAT_IS),
        THINGS,
        optional(WHERE, None),
        build=emptied,
    ),
    sequence(
        # "Empty the basket into the box, the pear last"
        f"empty[ing] [out], unload[ing], {verbs.CLEAR}",
        THINGS,
        DESTINATIONS,
        OPTIONAL_COMMA,
        TURN,
        build=_emptied_in_turn,
    ),
    sequence(
        either(verbs.BRING, verbs.REMOVE),
        "[all] (the|its) contents",
        SOURCE,
        optional(DIRECTED, None),
        build=lambda np, where: emptied(Things((np,)), where),
    ),
    sequence(
        phrase(verbs.TIDY),
        THINGS,
        optional(phrase("away, up"), ""),
        DESTINATIONS,
        EXTRAS,
        build=_tidied,
    ),
    sequence(
        verbs.TIDY,
        THINGS,
        DIRECTED,
        build=lambda things, where: put_to(things, where) if things.are_any else None,
    ),
    sequence(
        verbs.CLEAR,
        ALL_THINGS,
        silent(optional(_OF_ALL_ON_IT)),
        optional(WHERE, None),
        build=partial(emptied, held=Prep.FROM),
    ),
    sequence(
        either(
            sequence(verbs.CLEAR, _TOP_OF),
            sequence(_TOP_OF, predicates.MODAL, manner.EMPTIED),
            sequence(verbs.ENSURE, _TOP_OF, predicates.BE, manner.EMPTIED),
            sequence(predicates.WANTED, _TOP_OF, optional("to be"), manner.EMPTIED),
        ),
        optional(DESTINATIONS, None),
        build=partial(emptied, held=Prep.ON, part=_TOP),
    ),
    sequence(
        verbs.GET_OUT,
        "everything, it all, all things",
        "out of, off [of]",
        sequence(NP_LIST, build=lambda nps: Things(nps) if nps[1:] else None),
        optional(DIRECTED, None),
        build=emptied,
    ),
    sequence(
        "clear[ing], clean[ing], empty[ing]",
        ALL_THINGS,
        "out",
        optional(DESTINATIONS, None),
        build=emptied,
    ),
    TO_BE_EMPTY,
    variants(sequence("mak(e|ing)", ALL_THINGS, manner.EMPTIED), to_be_empty),
    variants(sequence(verbs.ENSURE, ALL_THINGS, _HOLDS_NOTHING), to_be_empty),
)


NOT_INTO = sequence(
    either(EMPTY, REMOVE),
    ELSEWHERE,
    build=lambda clause, where: (
        put_to(clause.things.taken_from(clause.source), where)
        if isinstance(clause, RemoveClause)
        else None
    ),
)
"""What is emptied or taken out, "but not into the box"."""
IS_EMPTY = variants(
    sequence(
        ALL_THINGS,
        either(
            sequence(predicates.BE, silent(optional("then, all")), manner.EMPTIED),
            _HOLDS_NOTHING,
        ),
    ),
    to_be_empty,
)
"""What something is done for ("so that the box is empty")."""
_NOTHING_IS_THERE = either(
    _nothing_there(predicates.NOTHING_IS_SO), _has_nothing(ALL_THINGS, "(has|have) nothing")
)
NOTHING_THERE = variants(_NOTHING_IS_THERE, _to_be_bare)
"""The same, said of the place; it stays so where it is so already."""
NOTHING_LEFT_THERE = valued(
    _NOTHING_IS_THERE,
    lambda found: emptied(found[2], held=found[0], part=found[1]),
)
"""What has been taken from there by then ("once there is nothing left in the box")."""

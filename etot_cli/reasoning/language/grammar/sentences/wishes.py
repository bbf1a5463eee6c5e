"""Rules for what is wanted or wished for, and for what is said to be what goes somewhere."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    phrase,
    quiet,
    sequence,
    silent,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    EMPTY_WORDS,
    LIST,
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.parsers.trees import nodes
from etot_cli.reasoning.language.grammar.phrases.being_so import PREDICATE, state_of
from etot_cli.reasoning.language.grammar.phrases.coordination import all_of
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, NP_LIST
from etot_cli.reasoning.language.grammar.phrases.states import being, containing
from etot_cli.reasoning.language.grammar.phrases.where_not import WHERE
from etot_cli.reasoning.language.grammar.requests.additions import EXTRAS
from etot_cli.reasoning.language.grammar.requests.taking import SOURCE
from etot_cli.reasoning.language.grammar.sentences.passives import PASSIVE
from etot_cli.reasoning.language.grammar.sentences.verbless import put_down
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Clause,
    EnsureClause,
    PickClause,
    PutClause,
    PutGroup,
    RemoveClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    FILLED,
    Destination,
    NounPhrase,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import frames, predicates, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import word_set

_MOVED = word_set("off out gone farther further closer nearer")
"""Of what is wanted they tell where it is to be."""


def _wanted_in_hand(things: Things) -> PickClause | None:
    """Who wants something off the tray, or farther from it, does not say that it is to be held, nor
    who wants all, or one in each of several.
    """
    away = any(_MOVED & {*np.text.split()} for np in things.phrases)
    said = {word for np in nodes(things) if isinstance(np, NounPhrase)
            for word in np.determiner.split()}  # fmt: skip
    every = {"all", "both", "each", "every"} & said
    return None if away or every else PickClause(things, wanted=True)


def _shared(things: Things, place: NounPhrase) -> PutClause | None:
    """Several things that have one place."""
    put = put_to(things, (Destination(Toward.TO, (place,), FILLED),))
    return replace(put, grouping=Grouping.TOGETHER) if things.may_be_several else None


def _shared_with(things: Things, place: NounPhrase, others: tuple[NounPhrase, ...]) -> PutClause:
    """What has one place with others, all of which are there then."""
    together = replace(things, phrases=(*things.phrases, *others))
    return put_to(together, (Destination(Toward.TO, (place,), FILLED),))


def _its_own(things: Things, place: NounPhrase) -> PutClause | None:
    """Things of which each is to have a place "of its own"."""
    own = place.determiner == "a" and place.words[:1] == ("different",)
    return put_to(things, (Destination(Toward.TO, (place,), FILLED),)) if own else None


def _in_company(things: Things, np: NounPhrase, where: tuple[Destination, ...]) -> PutClause | None:
    """What joins a thing where that is, or what is to be with it at a place."""
    if not where:
        return put_to(things, (Destination(Toward.WITH, (np,), "join"),))
    together = replace(things, phrases=(*things.phrases, np))
    return None if things.either else put_to(together, where)


WANTED = either(
    PASSIVE,
    sequence(
        either(
            sequence(ALL_THINGS, predicates.TO_HAVE),
            sequence(
                NP_LIST, predicates.TO_EACH_HAVE, build=lambda nps: Things(all_of(nps, "each"))
            ),
        ),
        noun_phrase,
        build=_its_own,
    ),
    sequence(
        either(sequence(verbs.LET, ALL_THINGS, predicates.LET_BE), sequence("have", ALL_THINGS)),
        WHERE,
        EXTRAS,
        build=lambda things, where, extras: put_down((PutGroup(things, where),), extras),
    ),
    sequence(
        either(
            sequence(f"have, let, {predicates.CAN}", ALL_THINGS, "[please] join"),
            sequence(ALL_THINGS, predicates.JOIN),
        ),
        noun_phrase,
        silent(optional("there")),
        build=lambda things, np: put_to(things, (Destination(Toward.WITH, (np,), "join"),)),
    ),
    sequence(
        # "Let the pen keep the cap company (in the cup)"
        either(
            sequence(f"have, let, {predicates.CAN}", ALL_THINGS, "[please] keep"),
            sequence(ALL_THINGS, predicates.KEEP_COMPANY),
        ),
        noun_phrase,
        "company",
        optional(DESTINATIONS, ()),
        build=_in_company,
    ),
    sequence(
        noun_phrase,
        predicates.JOINED_BY,
        ALL_THINGS,
        build=lambda np, things: put_to(things, (Destination(Toward.WITH, (np,), "join"),)),
    ),
    sequence(optional("have, let, make"), ALL_THINGS, predicates.SHARE, noun_phrase, build=_shared),
    sequence(
        # "The oil should share the shelf with the jar", which is there or goes there, too
        optional("have, let, make"),
        ALL_THINGS,
        predicates.SHARE,
        noun_phrase,
        "with",
        NP_LIST,
        build=_shared_with,
    ),
    sequence(
        # "The pen I want in the cup"
        ALL_THINGS,
        predicates.WANTED,
        optional("it, them"),
        DESTINATIONS,
        build=put_to,
    ),
    quiet(
        sequence(
            # "On the tray I want the cup with the pen in it"
            DESTINATIONS,
            OPTIONAL_COMMA,
            either(
                sequence(f"{predicates.WANTED}, {predicates.STANDS_THERE}", NP_LIST),
                sequence(NP_LIST, predicates.IS_THERE),
            ),
            build=lambda where, nps: EnsureClause((State(nps, where),)),
        )
    ),
    sequence(predicates.WANTED, ALL_THINGS, predicates.GONE, noun_phrase, build=RemoveClause),
    sequence(
        ALL_THINGS,
        f"{predicates.MODAL}, {predicates.COME_AWAY}",
        optional("gone"),
        SOURCE,
        build=RemoveClause,
    ),
    sequence(ALL_THINGS, predicates.COME_AWAY, "out, off, down", build=RemoveClause),
    sequence(
        predicates.WANT,
        ALL_THINGS,
        optional("[to be] (picked up|lifted [up])"),
        build=_wanted_in_hand,
    ),
)
_WERE_SO = either(being(predicates.WERE), containing(predicates.CONTAINED))
_SO_WISHED = sequence(
    _WERE_SO,
    some(
        sequence(
            LIST,
            optional("if, that"),
            either(
                _WERE_SO,
                # "… and the vase on the plate": the verb is left out.
                sequence(NP_LIST, PREDICATE, build=state_of),
            ),
        ),
        most=5,
    ),
    build=lambda first, more: EnsureClause((first, *more)),
)
WISHED = either(
    sequence(frames.WISH_IF, EMPTY_WORDS, _SO_WISHED),
    quiet(
        sequence(
            # "As long as the pen is in a cup, I am happy"
            "if, as long as, so long as, once, when",
            _SO_WISHED,
            silent(optional(small_words.BY_THE_END)),
            COMMA,
            f"[then] ({frames.WOULD_BE_NICE}|{frames.IS_ENOUGH})",
        )
    ),
)
"""How it would be nice for things to be."""
_THING = "(thing|things|object|objects|item|items)"
_ONE = "one"
_LEFT = silent(optional("[to be] (left|remaining)"))
_WHAT_GOES = either(
    sequence(
        either(phrase(f"the only {_THING}", True), phrase("the only (one|ones)", _ONE)),
        optional(f"[that|which] ({predicates.MODAL}|i want|we want|i need), that, which"),
        _LEFT,
    ),
    sequence(phrase("all", True), f"that ({predicates.MODAL}), [that] (i|we) (want|need)", _LEFT),
    sequence(
        phrase(f"what, the {_THING} (that|which)", False), f"{predicates.MODAL}, (i|we) (want|need)"
    ),
)
"""What is there, or alone is there (True), be it of its sort (:data:`_ONE`)."""
_IT_IS = "it is, it 's"
_IS = f"{predicates.BE}, should be, must be, has to be, needs to be, shall be"


def _there(things: Things, only: bool | str, where: tuple[Destination, ...]) -> Clause | None:
    """What is to be there, or (``only``) alone in the end; "the only one" is so of its sort."""
    if not only:
        return put_to(things, where)
    (first, *more) = things.phrases
    alone = (replace(first, determiner="only the"), *more)
    state = State(alone, where, going=only == _ONE)
    return None if things.either else EnsureClause((state,))


def _at(place: NounPhrase) -> tuple[Destination, ...]:
    return (Destination(Toward.TO, (place,)),)


def _belonging(things: Things, where: tuple[Destination, ...]) -> EnsureClause:
    """Where things have their place."""
    return EnsureClause((State(things.phrases, where),))


_PLACE_FOR = "the [proper|right|correct|best|usual|natural] (home|place|spot) (for|of)"
_ENSURED = silent(optional(verbs.ENSURE))
_THE_ONE = "is the one [that|which]"
_POINTED_OUT = either(
    phrase("that, it, this", NounPhrase(pronoun="it", text="that")),
    noun_phrase,
)
TOLD_APART = either(
    # "The cup is the only thing that goes on the tray", "what belongs there is the cup"
    sequence(_ENSURED, ALL_THINGS, _IS, _WHAT_GOES, DESTINATIONS, build=_there),
    sequence(
        _ENSURED,
        _WHAT_GOES,
        DESTINATIONS,
        _IS,
        ALL_THINGS,
        build=lambda only, where, things: _there(things, only, where),
    ),
    sequence(
        # "The cup and nothing else should be on the tray", "there should only be the cup"
        either(
            sequence(
                _ENSURED,
                ALL_THINGS,
                OPTIONAL_COMMA,
                small_words.AND_NO_MORE,
                OPTIONAL_COMMA,
                f"{predicates.MODAL}, {predicates.BE}",
            ),
            sequence(predicates.THERE_BE_ONLY, ALL_THINGS),
            sequence("mak(e|ing)", ALL_THINGS, f"the only {_THING}", _LEFT),
        ),
        DESTINATIONS,
        build=lambda things, where: _there(things, True, where),
    ),
    sequence(
        # "It is the cup that goes in the box", "it's the cup I want in the box"
        _IT_IS,
        ALL_THINGS,
        either(
            sequence("that, which", f"{predicates.MODAL}, {predicates.WANTED}"),
            f"{predicates.WANTED}",
            sequence(optional("that, which"), predicates.TO_BE_DONE_BY_YOU, verbs.SET_DOWN),
        ),
        DESTINATIONS,
        build=put_to,
    ),
    sequence(
        # "The left ball is the one that you should pick up"
        either(sequence(_POINTED_OUT, _THE_ONE), sequence("it is", noun_phrase, "that, which")),
        predicates.TO_BE_DONE_BY_YOU,
        verbs.PICK,
        build=lambda np: PickClause(Things((np,))),
    ),
    sequence(
        _POINTED_OUT,
        _THE_ONE,
        "i want, i need, we want, we need, to be picked up, to be lifted",
        build=lambda np: PickClause(Things((np,)), wanted=True),
    ),
    sequence(
        _POINTED_OUT,
        _THE_ONE,
        ALL_THINGS,
        predicates.MODAL,
        one_of({Toward.INSIDE: "in, into, inside", Toward.ON: "on, onto"}),
        build=lambda np, things, toward: put_to(things, (Destination(toward, (np,)),)),
    ),
    sequence(
        # "The spoon's home is the drawer", "the best place for the spoon is the drawer"
        either(
            sequence(ALL_THINGS, "'s (home|place|spot) is"),
            sequence(_PLACE_FOR, ALL_THINGS, "is, would be"),
        ),
        either(DESTINATIONS, sequence(noun_phrase, build=_at)),
        build=_belonging,
    ),
    sequence(
        # "The bowl and the tray are where they may go": into either
        NP_LIST,
        "are where",
        ALL_THINGS,
        predicates.BELONG,
        build=lambda places, things: _belonging(things, (Destination(Toward.TO, places),)),
    ),
    sequence(
        # "The tray is where the cup goes", "… where I want the cup"
        noun_phrase,
        either(
            sequence("is where", ALL_THINGS, predicates.BELONG),
            sequence(
                "is where you [(should|must|will|can|have to|need to|are to)]",
                verbs.SET_DOWN,
                ALL_THINGS,
            ),
            sequence("is where", predicates.WANTED, ALL_THINGS, optional("to (be|go|stand|lie)")),
            sequence(
                f"(is|would be) {_PLACE_FOR}",
                ALL_THINGS,
            ),
        ),
        build=lambda np, things: _belonging(things, _at(np)),
    ),
)
"""What goes somewhere, said so that it stands out."""

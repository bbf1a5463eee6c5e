"""Rules for what has been done or is so by then, and for what is being done."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    either,
    one_of,
    optional,
    phrase,
    sequence,
    silent,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import noun_phrase
from etot_cli.reasoning.language.grammar.phrases.being_so import OPEN_OR_CLOSED
from etot_cli.reasoning.language.grammar.phrases.coordination import said_of_all
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.requests.arrangements import HAVING_TURNED, STANDS_UP
from etot_cli.reasoning.language.grammar.requests.carrying import OUT_AND_INTO, brought
from etot_cli.reasoning.language.grammar.requests.emptying import NOTHING_LEFT_THERE, emptied
from etot_cli.reasoning.language.grammar.requests.taking import SOURCE
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    RemoveClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Beside,
    Destination,
    Modifier,
    NounPhrase,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import manner, predicates, small_words
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby

SO = sequence(
    ALL_THINGS,
    optional(f"{predicates.BE}, {predicates.LIES}, (has|have) been"),
    OPEN_OR_CLOSED,
    build=lambda things, word: MoveClause(things, word == "open"),
)
_HAS_COME = "(has|have) (come|gone)|come[s]"
_TAKEN_BY_THEN = (
    f"{predicates.BE}, (is|are|has been|have been) (taken|removed|moved|cleared|lifted|gone),"
    f" ({_HAS_COME})"
)
_TAKEN_AWAY = predicates.TAKEN_AWAY.replace(",", "|")
_NO_MORE = Parser(lambda given, at: [(at, NOTHING)] if given.ahead[at] != "and" else [])
"""Not before what has been done with it next ("taken out and put on the tray")."""


def _freed(said: str, np: NounPhrase) -> PutClause:
    """What blocks something has gone out of the way of it by then."""
    blocking = Modifier(Prep.BLOCKING, (np,))
    things = NounPhrase("all", ("objects",), (blocking,), text=f"everything blocking {np.text}")
    way = "from in front of" if said.endswith("front of") else "out of the way of"
    away = Beside(Nearby.AWAY, (np,), f"{way} {np.text}")
    return put_to(Things((things,)), (Destination(Toward.BESIDE, beside=(away,)),))


_ALL_OF_THEM = valued(
    sequence(NP_LIST, "are, have", phrase("both, all"), build=said_of_all), Things
)
_ALL_SO_BY_THEN = either(
    sequence(
        _ALL_OF_THEM,
        optional(f"{predicates.BEING}, [been] ({predicates.DONE_WITH_IT}) [down|away|over]"),
        DESTINATIONS,
        build=put_to,
    ),
    sequence(
        _ALL_OF_THEM,
        optional("been"),
        OPEN_OR_CLOSED,
        build=lambda things, word: MoveClause(things, word == "open"),
    ),
    sequence(_ALL_OF_THEM, optional("been"), manner.EMPTIED, build=emptied),
    sequence(
        _ALL_OF_THEM, "[been] (taken|removed|moved|cleared|lifted)", SOURCE, build=RemoveClause
    ),
    sequence(_ALL_OF_THEM, f"[been] ({_TAKEN_AWAY}), out, off", _NO_MORE, build=RemoveClause),
)
"""What has been done by then with all of them ("once the cup and the pen are both on the tray")."""
SO_BY_THEN = either(
    _ALL_SO_BY_THEN,
    sequence(
        ALL_THINGS,
        f"{predicates.BE}, (is|are) {predicates.BEING}, {predicates.LIES}, {small_words.GONE},"
        " (is|are) out [of the way], (is|are) (up|down|back|away),"
        f" (is|are|gets|get|has been|have been) ({predicates.DONE_WITH_IT}) [down|away|over]",
        DESTINATIONS,
        build=put_to,
    ),
    sequence(
        ALL_THINGS,
        _TAKEN_BY_THEN,
        OUT_AND_INTO,
        build=lambda things, moved: PutClause((brought(things, *moved),)),
    ),
    sequence(ALL_THINGS, "(is|are) (out|off|away) and", DESTINATIONS, build=put_to),
    sequence(ALL_THINGS, _TAKEN_BY_THEN, SOURCE, build=RemoveClause),
    sequence(
        ALL_THINGS,
        f"(is|are|{_HAS_COME}) (out|off), (is|are) gone,"
        f" (is|are|has been|have been) ({_TAKEN_AWAY})",
        _NO_MORE,
        build=RemoveClause,
    ),
    sequence(
        ALL_THINGS,
        predicates.OUT_OF_THE_WAY,
        _NO_MORE,
        build=lambda things: RemoveClause(things, aside=True),
    ),
    sequence(
        ALL_THINGS,
        _TAKEN_BY_THEN,
        silent(either("out, off, away, down", SOURCE)),
        "and [then] [been]",
        predicates.DONE,
        DESTINATIONS,
        build=put_to,
    ),
    STANDS_UP,
    SO,
    sequence(ALL_THINGS, f"{predicates.BE}, (has|have) been", manner.EMPTIED, build=emptied),
    NOTHING_LEFT_THERE,
    sequence(
        phrase(predicates.NOTHING_BLOCKS),
        noun_phrase,
        silent(optional(small_words.ANY_MORE)),
        build=_freed,
    ),
    sequence(
        # "Once the plate has been cleared of the cup"
        noun_phrase,
        "(is|has been|gets) (cleared|emptied|freed|rid|relieved) of, is (free|clear|empty) of",
        ALL_THINGS,
        build=lambda source, things: RemoveClause(things, source),
    ),
    sequence(
        noun_phrase,
        "(holds|contains|has [got]) [now]",
        ALL_THINGS,
        build=lambda np, held: put_to(held, (Destination(Toward.INSIDE, (np,)),)),
    ),
)
"""What has been done or is so by then ("once the pear has been put into the bowl")."""
UNDER_WAY = either(
    sequence(
        ALL_THINGS,
        f"(is|are|gets|get) [being] ({predicates.DONE_WITH_IT}) [down|away|over]",
        DESTINATIONS,
        build=put_to,
    ),
    sequence(
        ALL_THINGS,
        "(is|are) being",
        one_of({True: "opened", False: "closed, shut"}),
        build=MoveClause,
    ),
)
"""What is being done at the time ("while the pen is being put on the tray")."""
HAVING_DONE = either(
    *(
        sequence(said, ALL_THINGS, build=lambda things, opens=opens: MoveClause(things, opens))
        for said, opens in (("opened, pulled open", True), ("closed, shut, pushed shut", False))
    ),
    *(
        sequence(
            said, ALL_THINGS, particle, build=lambda things, opens=opens: MoveClause(things, opens)
        )
        for said, particle, opens in (
            ("pulled, slid", f"{manner.OPEN_STATE}, out", True),
            ("pulled, pushed, slid", f"{manner.CLOSED_STATE}, in", False),
        )
    ),
    sequence(f"{predicates.DONE}, {predicates.BROUGHT}", ALL_THINGS, DESTINATIONS, build=put_to),
    sequence(
        "left, kept",
        NP_LIST,
        OPEN_OR_CLOSED,
        build=lambda nps, word: EnsureClause((State(nps, word=word, kept=True),)),
    ),
    sequence(predicates.PICKED_UP, THINGS, build=PickClause),
    HAVING_TURNED,
    sequence("emptied [out], cleared [out], unloaded", THINGS, build=emptied),
    sequence(
        f"{predicates.TAKEN_AWAY}, took (out|off|away), cleared away",
        ALL_THINGS,
        optional(SOURCE, None),
        build=RemoveClause,
    ),
    sequence(
        "taken, took, removed, moved, cleared, lifted, got, pulled",
        ALL_THINGS,
        either(SOURCE, phrase("out, off, away", "")),
        build=lambda things, source: RemoveClause(things, source or None),
    ),
)

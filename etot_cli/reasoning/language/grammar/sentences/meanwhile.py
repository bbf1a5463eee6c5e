"""Rules for what stays so while something else is done ("keep it upright as you move it …")."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    located,
    optional,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import COMMA, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.requests.arrangements import KEPT_UPRIGHT
from etot_cli.reasoning.language.grammar.sentences.chains import CHAIN
from etot_cli.reasoning.language.grammar.sentences.led_clauses import LED_CLAUSE
from etot_cli.reasoning.language.grammar.sentences.past import UNDER_WAY
from etot_cli.reasoning.language.grammar.sentences.spoken import Reading, Spoken, plain
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    PickClause,
    PutClause,
    PutGroup,
    RemoveClause,
    ReorientClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import Things
from etot_cli.reasoning.language.words import manner, small_words
from etot_cli.world.spatial import Nearby


def _meanwhile(first: Reading, rest: Reading) -> Reading | None:
    """What stays so while something else is done; nothing is done with something in the hand."""
    held = any(isinstance(said.clause, PickClause) for said in first)
    return None if held else (*first, *rest)


def _kept_upright(kept: tuple[int, Things], rest: Reading) -> Reading | None:
    """What is kept upright while it, or something else, is put somewhere."""
    at, things = kept
    put = rest[0].clause
    match put:
        case (
            PutClause(groups=(PutGroup(things=what),))
            | RemoveClause(things=what)
            | PickClause(things=what)
        ):
            moved = what.phrases
        case _:
            return None
    if not all(np.pronoun or np.words == things.phrases[0].words for np in moved):
        alike = {np.head for np in things.phrases} & {np.head for np in moved}
        if alike or any(np.pronoun or np.is_elliptic for np in (*moved, *things.phrases)):
            return None
        return (Spoken(ReorientClause(things, Nearby.UPRIGHT), at), *rest)
    if not isinstance(put, PutClause):
        return None
    again = ReorientClause(what, Nearby.UPRIGHT, meanwhile=True)
    if all(np.pronoun for np in moved):
        put = replace(put, groups=(replace(put.groups[0], things=things),))
    return (replace(rest[0], clause=put), Spoken(again, rest[0].position), *rest[1:])


def _of_the_same(kept: ReorientClause, rest: Reading) -> Reading | None:
    """What is put somewhere as "it", which was named where it was said how it is kept."""
    put = rest[0].clause
    if not isinstance(put, PutClause) or any(np.pronoun for np in kept.things.phrases):
        return None
    group, *more = put.groups
    if more or not all(np.pronoun for np in group.things.phrases):
        return None
    return (replace(rest[0], clause=put_to(kept.things, group.destinations)), *rest[1:])


_KEPT = either(
    sequence("[always] (keep|hold)", THINGS),
    sequence(
        ALL_THINGS,
        "(must|should|has to|have to|needs to|need to|is to|are to) [always]"
        " (be kept|be held|stay|remain)",
    ),
)
_UPRIGHT_WHILE = sequence(
    located(_KEPT, lambda at, things: (at, things)),
    f"{manner.ERECT}, {manner.LEVELED}, standing",
    silent(optional(small_words.ALL_ALONG)),
    OPTIONAL_COMMA,
    f"{small_words.WHILE}, when [you [are]], and, and then, throughout as you",
    CHAIN,
    build=_kept_upright,
)
MEANWHILE = either(
    sequence(
        small_words.WHILE,
        either(LED_CLAUSE, plain(UNDER_WAY)),
        COMMA,
        CHAIN,
        build=_meanwhile,
    ),
    _UPRIGHT_WHILE,
    sequence(
        # "The cup must not tip, so keep it upright while you set it on the tray"
        KEPT_UPRIGHT,
        "~comma, ~colon",
        optional("so, and [so]"),
        _UPRIGHT_WHILE,
        build=_of_the_same,
    ),
)

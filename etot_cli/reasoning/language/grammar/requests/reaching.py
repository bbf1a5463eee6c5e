"""Rules for where the robot reaches to take something ("reach into the box and grab the pen")."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Rule,
    either,
    optional,
    phrase,
    sequence,
)
from etot_cli.reasoning.language.grammar.parsers.common import noun_phrase
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS
from etot_cli.reasoning.language.grammar.requests.putting import PUT
from etot_cli.reasoning.language.grammar.requests.taking import PICK, REMOVE
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Clause,
    PickClause,
    PutClause,
    PutGroup,
    RemoveClause,
    ReorientClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, NounPhrase, Toward
from etot_cli.reasoning.language.words import fillers, small_words


def _taken_there(there: NounPhrase, clause: Clause) -> Clause | None:
    """What is taken is taken from there; what is put in there is not."""
    match clause:
        case PickClause(things=things):
            return replace(clause, things=things.taken_from(there))
        case RemoveClause(things=things, source=None):
            return RemoveClause(things, there)
        case PutClause(groups=(PutGroup(things=things, destinations=where) as group,)):
            if all(map(_is_elsewhere, where)):
                taken = replace(group, things=things.taken_from(there))
                return replace(clause, groups=(taken,))
    return None


def _is_elsewhere(where: Destination) -> bool:
    """Whether a place is told by a thing that is named."""
    return where.toward in (Toward.INSIDE, Toward.ON, Toward.TO, Toward.BESIDE) and not any(
        np.pronoun for np in where.targets
    )


REACHED = Rule(
    sequence(
        small_words.REACH,
        either(
            sequence("into, in, inside [of]", noun_phrase),
            phrase("in, inside", NounPhrase(pronoun="it", text="it")),
        ),
        "and, and then, then, ~comma, ~comma and, to, ~comma then",
        optional(fillers.WITHOUT_MEANING),
        either(PICK, REMOVE, PUT),
        build=_taken_there,
    )
)
SEPARATING = sequence(
    "separat(e|ing), detach[ing]",
    ALL_THINGS,
    "from",
    noun_phrase,
    build=lambda things, np: ReorientClause(things.taken_from(np), only_named=True),
)
"""What is done by what is said behind it ("separate the cup from the tray by putting it …")."""

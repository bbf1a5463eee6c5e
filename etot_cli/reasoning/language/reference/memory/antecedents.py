"""What was spoken of, and what is said of words that may mean several things, or nothing."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct

from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role

UNCLEAR = "it is not clear what this refers to"


class AmbiguousReference(ReferenceProblem):
    """Words that may mean several things; no far-fetched reading of the sentence undoes that.

    Args:
        text: as written.
        named: what may be meant, in the sentence's words.
        why: what to say before these.
    """

    def __init__(self, text: str, named: Sequence[str], why: str = "it may mean") -> None:
        found = tuple(dict.fromkeys(named))
        super().__init__(text, f"{why} {' or '.join(found)}; name it", 4, candidates=found)


class UnclearLandmark(AmbiguousReference):
    """Words that are told by others that may mean several things; where these are told from each
    other by what another reading takes with the first ("the ball behind the cup on the left"),
    that reading is right.
    """


class NothingThere(ReferenceProblem):
    """Words for all that is somewhere, from where it has been moved."""


class EmptyAlready(ReferenceProblem):
    """Words for all that is in or on something, where nothing is."""


class Mention(Struct, frozen=True):
    """A referent spoken of in a clause, in a role."""

    referent: int
    role: Role
    clause: int
    noun: str
    several: bool = False
    """It speaks of all that fit, even where that is one."""
    adjectives: tuple[str, ...] = ()
    """The words before the noun."""
    whatever: bool = False
    """It speaks of whatever is somewhere, which nothing is put into or onto."""
    idle: tuple[str, ...] = ()
    """Its words for a side or size that tell one thing from no other."""
    either: bool = False
    """It is one of several phrases ("the apple or the pear")."""
    collective: bool = False
    """It speaks of ``several`` in the singular ("the fruit", "each cup"), as "it" may do again."""

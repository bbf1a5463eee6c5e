"""What is said of words that may mean several things, or nothing."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.roles import ReferenceProblem

UNCLEAR = "it is not clear what this refers to"


class AmbiguousReference(ReferenceProblem):
    """Words that may mean several things; no far-fetched reading of the sentence undoes that.

    Args:
        text: as written.
        named: what may be meant, in the sentence's words.
        why: what to say before these.
    """

    def __init__(self, text: str, named: Sequence[str], why: str = "it may mean") -> None:
        super().__init__(text, f"{why} {' or '.join(dict.fromkeys(named))}; name it", 4)

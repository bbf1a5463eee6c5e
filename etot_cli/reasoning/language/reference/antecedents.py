"""What is said of a pronoun that may mean several things, or nothing."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.roles import ReferenceProblem

UNCLEAR = "it is not clear what this refers to"


class AmbiguousReference(ReferenceProblem):
    """A pronoun that may mean several things; no far-fetched reading of the sentence undoes that.

    Args:
        text: as written.
        named: what it may mean, in the sentence's words.
    """

    def __init__(self, text: str, named: Sequence[str]) -> None:
        super().__init__(text, f"it may mean {' or '.join(dict.fromkeys(named))}; name it", 4)

"""Why the words of a noun phrase fit nothing, and what is called nearly so."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.reference.entries import Entry
from etot_cli.reasoning.language.reference.vocabulary import Vocabulary
from etot_cli.reasoning.language.words.known import REASONS
from etot_cli.reasoning.language.words.lexicon import MATERIALS


def names_of(entries: Iterable[Entry]) -> str:
    """What entries are called, as alternatives."""
    return " or ".join(dict.fromkeys(entry.exact[0] for entry in entries))


def not_understood(word: str, entries: Sequence[Entry], phrase: str) -> ReferenceProblem:
    """An adjective that says nothing of what its noun may mean."""
    names = names_of(entries)
    if word in MATERIALS:
        why = f"the scene does not say what {names} is made of"
    else:
        why = f"no word of {names}, and no word for a place, size or state"
    return ReferenceProblem(phrase, f"{word!r} is not understood: {why}", 3, word=word)


def nothing_fits(
    head: str,
    adjectives: Sequence[str],
    number: str | None,
    vocabulary: Vocabulary,
    phrase: str,
) -> ReferenceProblem:
    """A noun that nothing is called by, or by which nothing is with these adjectives."""
    everything = (*vocabulary.objects, *vocabulary.parts, *vocabulary.boards)
    alike = [entry for entry in everything if entry.grade(head) is not None]
    what = " ".join((*adjectives, head, *((number,) if number else ())))
    if alike:
        names = ", ".join(dict.fromkeys(entry.exact[0] for entry in alike))
        return ReferenceProblem(
            phrase, f"there is no {what!r}; what fits {head!r}: {names}", 1, word=what,
            candidates=tuple(dict.fromkeys(entry.exact[0] for entry in alike)),
        )  # fmt: skip
    known = REASONS.get(head)
    if known:
        return ReferenceProblem(phrase, f"{head!r}: {known}", 3, word=head)
    near = vocabulary.nearest(head)
    return ReferenceProblem(
        phrase,
        f"nothing in the scene is called {head!r}; "
        + (f"nearest: {', '.join(near)}" if near else f"it has {vocabulary.names()} and the desk"),
        word=head,
        candidates=tuple(near),
    )

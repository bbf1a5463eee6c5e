"""Whose things are, and whom an instruction is written to and by: people of whom a scene knows
nothing ("Emma's cup", "my son's cup", "Hi Anna, …", "Thanks, Marek").
"""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import all_words
from etot_cli.reasoning.language.words.lexicon import is_descriptive, singular, word_set
from etot_cli.reasoning.language.words.nouns import STACK
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.predicates import RELATIONS

_KIN = "|".join(spellings(RELATIONS.replace("|", ",")))
_OWNED = Expression(
    rf"(?:(?<=[\w,] )(?P<who>[A-Z][a-z]+)|\b(?:[Mm]y|[Oo]ur|[Hh]is|[Hh]er) (?P<kin>{_KIN}))"
    "['\N{RIGHT SINGLE QUOTATION MARK}]s"
    r"(?= (?P<first>\w+)(?: (?P<second>\w+))?)"
)
"""Within a sentence; what it begins with has a capital anyway."""
_WANTS = Expression(
    r"(?<!Mr\. )(?<!Ms\. )(?<!Mrs\. )(?<!Dr\. )(?:^|(?<=[.!?;,] )|(?<=\b(?:so|as) ))"
    r"(?:(?:(?:Mr|Ms|Mrs|Dr)\. )?(?P<who>[A-Z][a-z]+)"
    r"|(?:[Tt]he|[Oo]ur|[Mm]y) (?P<job>[a-z]+(?:man|woman|master|er|or|ist|ess|ant|ian)))"
    r"(?= (?:wants|needs|would like|asked for|asks for) (?:to have )?"
    r"(?:the|my|his|her|both|all|an?)\b)"
)
"""Who asks for things that are not for "me", by name or by what is his job."""
_NO_NAMES = word_set("nobody none neither nothing few everybody everyone anybody anyone most many")
"""They may stand where somebody's name does, and some of them deny what is wanted."""

_ADDRESSED = "colleague, colleagues, team, everyone, everybody, all, friend, friends, assistant"
_CALLS_OFF = word_set("cancel abort undo halt cease disregard")
_TITLE = r"(?:(?:Mr|Mrs|Ms|Miss|Dr|Prof|Professor)\.? )?"
_TO_SOMEBODY = Expression(
    r"^\s*(?:(?:[Oo]h,? )?(?:[Dd]ear|[Hh]i|[Hh]ello|[Hh]ey|(?:[Gg]ood )?"
    r"(?:[Mm]orning|[Aa]fternoon|[Ee]vening|[Dd]ay))(?: there| dear)?,? "
    rf"(?P<titled>{_TITLE})(?P<who>\w+))\s*[,!:]\s+"
)
"""Before what is asked for, as in a letter."""
_FROM_SOMEBODY = Expression(
    r"(?P<end>[.!?;\n])\s*(?:(?:[Mm]any )?[Tt]hanks?(?: you)?(?: (?:(?:so |very )?much|a lot"
    r"|in advance))*|(?:[Ww]ith )?(?:[Bb]est|[Kk]ind|[Ww]arm)(?: (?:regards|wishes))?|[Rr]egards"
    rf"|[Cc]heers|[Ss]incerely|[Yy]ours(?: \w+)?)[,.!\s-]\s*{_TITLE}(?P<who>[A-Z][a-z]*)"
    r"(?: [A-Z][a-z]*)?\s*[.!]?\s*$"
)
"""At its end."""


def without_owners(instruction: str, is_name: Callable[[str], bool]) -> str:
    """An instruction in which things of the scene that belong to somebody by name are "mine", who
    wants something by name is "somebody", and to and by whom it is written is left out.

    Args:
        instruction: as typed: names of people have capitals.
        is_name: whether something in the scene is called by a word.
    """

    def is_stranger(who: str) -> bool:
        known = is_name(who) or who in all_words() or is_descriptive(who)
        return not (known or who in _NO_NAMES)

    def told(found: re.Match[str]) -> str:
        who, kin, first, second = (
            (found[part] or "").casefold() for part in ("who", "kin", "first", "second")
        )
        noun = second if is_descriptive(first) else first
        known = is_name(noun) or singular(noun) in spellings(STACK)
        owned = not is_name(kin) if kin else is_stranger(who)
        return "my" if known and owned else found[0]

    def wanting(found: re.Match[str]) -> str:
        who = (found["who"] or found["job"]).casefold()
        return "somebody" if is_stranger(who) else found[0]

    def written(found: re.Match[str]) -> str:
        parts = found.groupdict()
        who = found["who"].casefold()
        stranger = (is_stranger(who) and who not in _CALLS_OFF) or (
            not is_name(who) and who in spellings(_ADDRESSED)
        )
        return (parts.get("end") or "") if parts.get("titled") or stranger else found[0]

    instruction = _FROM_SOMEBODY.sub(written, _TO_SOMEBODY.sub(written, instruction))
    return _WANTS.sub(wanting, _OWNED.sub(told, instruction))

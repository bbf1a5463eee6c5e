"""Whose things are, by people of whom a scene knows nothing ("Emma's cup", "my son's cup")."""

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


def without_owners(instruction: str, is_name: Callable[[str], bool]) -> str:
    """An instruction in which things of the scene that belong to somebody by name are "mine", and
    who wants something by name is "somebody".

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

    return _WANTS.sub(wanting, _OWNED.sub(told, instruction))

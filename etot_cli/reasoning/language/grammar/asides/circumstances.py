"""Phrases at the end of a request that say what it is good for: "for inspection", "as a surprise",
"out of the children's reach".

They ask for nothing where all their words are of what no scene has, and where they can neither tell
one thing from another ("a bowl for fruit") nor say how several are to stand ("as a triangle").
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.asides.aside_clauses import Clause
from etot_cli.reasoning.language.grammar.asides.asking_words import (
    BEFORE_NAMES,
    DOING,
    PLACED,
    IsName,
)
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import all_words
from etot_cli.reasoning.language.words.lexicon import JOINT_NOUNS, STATES, is_descriptive, word_set

KIND = "circumstance"
_PHRASE = Expression(
    r"(?:(?P<asked>.+?) )?(?P<joint>for|as(?= an? )|out of) (?P<said>(?:(?!and\b)[\w']+ ?){1,6}?)"
    rf"(?P<more> and (?:then )?(?:{'|'.join(sorted(DOING))})\b.*)?"
)
_AWAY = Expression(r"(?:(?:the |my |our )?\w+ 's )?(?:reach|sight|way)(?: of (?:the |my )?\w+)?")
_UNDER_COVER = word_set("top upper high highest in into inside")
"""What is put there is out of reach, or sight, as far as it can be."""
_OF_ROBOT = word_set("robot gripper arm hand your")
_DEED = Expression(
    r"(?!instance$|\w*(?:station|lotion|potion|section|mission)$)(?:\w{3,}(?:tion|sion|ance|ysis)"
    r"|storage|transport|disposal|delivery|dispatch|review|repair|reference|safety)"
)
"""Behind the name of a place this says what is done next, and not what the place is for."""
_LASTING = Expression(
    r"\w*(?:time|day|while|second|minute|hour|week|month|year|moment|age|ever|example|instance)s?"
)
_THIS = word_set("it there here") | {*STATES}
_SEVERAL = word_set("them they both all each every everything two three four five and")
OF_A_CASE = word_set(
    "need needs swap exchange trade replace change substitute switch mistake treat use or"
    " not only just never nobody nothing alternative option fallback backup replacement default"
)
"""With these "for" and "as" are about what is asked for, or when, or tell why."""


def circumstances_apart(clauses: Iterable[Clause], is_name: IsName) -> Iterator[Clause]:
    """Clauses, and apart from each such a phrase and what is asked for behind that."""
    before = ""
    for clause in clauses:
        found = None if clause.kind or clause.joint else _PHRASE.fullmatch(clause.said)
        asked = f"{before} {found['asked'] or ''}".strip() if found else ""
        before = f"{before} {clause.said}".strip()
        if not found or not _is_circumstance(asked, found, is_name):
            yield clause
            continue
        set_off = found["asked"] is None
        if not set_off:
            yield replace(clause, said=found["asked"])
        comma = clause.comma and set_off
        yield Clause(comma=comma, kind=KIND, joint=found["joint"], said=found["said"])
        if found["more"]:
            yield Clause(comma=False, kind="", joint="", said=found["more"].strip())


def _is_circumstance(asked: str, found: re.Match[str], is_name: IsName) -> bool:
    """Whether a phrase behind what is asked for asks for nothing."""
    before, words = asked.split(), found["said"].split()
    what = [word for word in words[words[0] in BEFORE_NAMES :] if word != "'s"]
    own = {*(found["asked"] or asked).split(), what[-1] if what else ""}
    if not before or not what or any(map(is_name, what)) or own & OF_A_CASE:
        return False
    if found["joint"] == "out of":
        away = _AWAY.fullmatch(found["said"]) and not _OF_ROBOT & {*what}
        return bool(away and _UNDER_COVER & {*before})
    known = [word in all_words() for word in what]
    if found["joint"] == "as":
        several = any(word.endswith("s") and not word.endswith("ss") for word in before)
        told = all(is_descriptive(word) for word in what if word in all_words())
        placed = PLACED & {*before}  # "I would like it as a lid" says where it is to be
        return bool(told and placed) and not (known[-1] or several or _SEVERAL & {*before})
    if any(known) or _LASTING.fullmatch(what[-1]) or words[0] in ("a", "an"):
        return False
    if found["asked"] is None or before[-1] in _THIS:
        return True
    # "Into the box for zorps" may be one of several boxes, "the pens for review" some of the pens
    whole = bool(PLACED & {*before}) or not before[-1].endswith("s")
    named = is_name(before[-1]) or any(before[-1] in nouns for nouns in JOINT_NOUNS.values())
    return whole and named and len(what) == 1 and bool(_DEED.fullmatch(what[0]))

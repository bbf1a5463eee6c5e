"""Which clauses of a sentence ask for nothing, by what they say and by what joins them."""

from __future__ import annotations

import re
from collections.abc import Sequence

from etot_cli.reasoning.language.grammar.asides.aside_clauses import GRANTED, Clause
from etot_cli.reasoning.language.grammar.asides.asking_words import (
    BEFORE_NAMES,
    IsName,
    asks_besides,
    is_doing,
)
from etot_cli.reasoning.language.grammar.asides.displeasure import dislikes
from etot_cli.reasoning.language.grammar.asides.facts import tells_fact
from etot_cli.reasoning.language.grammar.asides.going import goes_to_it
from etot_cli.reasoning.language.grammar.asides.left_open import is_desk_wish, is_left_open, is_plan
from etot_cli.reasoning.language.grammar.asides.mishaps import (
    befalls,
    fears_for,
    is_unspoilt,
    may_befall,
)
from etot_cli.reasoning.language.grammar.asides.people import is_of_people, is_of_relative
from etot_cli.reasoning.language.grammar.asides.reasons import (
    is_comment,
    is_made_possible,
    is_purpose,
    is_reason,
    is_warning,
)
from etot_cli.reasoning.language.grammar.asides.remarks import is_remark, is_unused
from etot_cli.reasoning.language.grammar.asides.telling import (
    exclaims,
    goes_there,
    goes_there_later,
    goes_with_somebody,
    is_about_to,
    stranger_is_there,
    tells_of_others,
    there_is_such,
)
from etot_cli.reasoning.language.grammar.asides.told_of_things import (
    is_in_passing,
    is_not_to_stay,
    told_of_thing,
)
from etot_cli.reasoning.language.grammar.asides.vague_wishes import lacks_room, wants_such_a_thing
from etot_cli.reasoning.language.grammar.asides.where_needed import is_hindering
from etot_cli.reasoning.language.words.known import all_words

_PLACES = ("in ", "on ", "at ", "next ", "beside ", "behind ", "near ", "to ", "left ", "right ")
_IN_THE_WAY = tuple(f" in {whose} way" for whose in ("the", "my", "our", "your"))


def is_no_phrase(aside: Clause, is_name: IsName) -> bool:
    """Whether an aside is one even where the grammar finds a phrase in it, such as a thing called
    "seed box leaks".
    """
    words = () if not told_of_thing(aside.said, is_name) else aside.said.split()
    strange = any(word not in all_words() and not is_name(word) for word in words)
    first, verb = (*aside.said.split(), "", "")[:2]
    outside = (
        first not in all_words() and not is_name(first) and verb in ("is", "are", "has", "have")
    )
    told = aside.is_polite or aside.kind == "benefit" or aside.said.endswith(_IN_THE_WAY)
    told = told or is_not_to_stay(aside.said) or is_desk_wish(aside.said) or lacks_room(aside.said)
    told = told or (
        aside.kind == "purpose" and (is_made_possible(aside.said) or befalls(aside.said))
    )
    told = told or stranger_is_there(aside.said, is_name)
    told = told or goes_to_it(aside.said, "", first=True) or goes_there(aside.said, is_name)
    told = told or is_unspoilt(aside.said) or goes_with_somebody(aside.said, is_name)
    told = told or wants_such_a_thing(aside.said, is_name)
    told = told or is_in_passing(aside.said) or tells_fact(_whole_of(aside), is_name)
    somebody = is_of_people(aside.said) and not re.match(r"(?:you|we|i)\b", aside.said)
    told = told or (aside.joint == "before" and somebody) or is_of_relative(aside.said, is_name)
    told = told or " or no " in aside.said or dislikes(aside.said) or is_hindering(aside.said)
    told = (
        told
        or exclaims(aside.said, is_name)
        or tells_of_others(aside.said, is_name, before_so=True)
    )
    return told or strange or outside or _is_of_own_body(aside.said, is_name)


def _whole_of(clause: Clause) -> str:
    """What a clause says, as a sentence of its own where "which" stands for what it is about."""
    told = clause.kind == "comment" and not is_of_people(clause.said)
    return f"it {clause.said}" if told else clause.said


def _is_of_own_body(said: str, is_name: IsName) -> bool:
    """Whether a clause is about somebody's hands or the like ("my hands are full")."""
    mine = said.startswith(("my ", "our ")) and is_of_people(said)
    return mine and not any(map(is_name, said.split()))


def is_aside(clauses: Sequence[Clause], at: int, is_name: IsName) -> bool:
    """Whether one of a sentence's clauses asks for nothing."""
    clause = clauses[at]
    behind = "" if at + 1 == len(clauses) else clauses[at + 1].said.removeprefix("then ")
    last = all(item.is_polite for item in clauses[at + 1 :])
    last = last or is_doing((behind.split() or [""])[0])
    trailing = at > 0 and last and not asks_besides(clause.said)
    if clause.joint == "where" and not last:
        trailing = clauses[at + 1].comma and clauses[at + 1].said.startswith(_PLACES)
    if clause.is_polite and len(clauses) > 1:
        return not clause.said or clause.kind != "polite"
    if clause.joint in GRANTED:
        return False
    if clause.kind == "anyway" or is_left_open(clause.whole):
        return True
    match clause.kind, clause.joint:
        case _ if not clause.said:
            return False
        case "provided", _:
            return False
        case (("reason" | "meanwhile"), _):
            reason = (
                is_reason(clause.said, is_name)
                or may_befall(clause.said)
                or lacks_room(clause.said)
                or bool(told_of_thing(clause.said, is_name))
                or tells_fact(clause.said, is_name)
                or goes_there(clause.said, is_name, whose=BEFORE_NAMES)
            )
            return reason and (trailing or (at == 0 and clauses[1:] != []))
        case "comment", "who":
            of_somebody = at > 0 and clauses[at - 1].kind == "benefit"
            return of_somebody and is_remark(f"she {clause.said}", is_name)
        case "benefit", _:
            _, _, does = clause.said.partition(" who ")
            if does and not is_remark(f"she {does}", is_name):
                return False
            apart = at > 0 and (last or clauses[at + 1].comma or clauses[at + 1].joint == "and")
            return apart and not any(map(is_name, clause.said.split()))
        case "purpose", "before":
            # "…, but before you do that, close it" says when.
            named = clause.said.startswith("you do ") or any(map(is_name, clause.said.split()))
            if at == 0 and not all(item.is_polite for item in clauses[1:]):
                # "Before you do that, …" is about an order.
                told = not re.match(r"(?:you|we|i)\b", clause.said)
                return befalls(clause.said) or (
                    told and not named and is_remark(clause.said, is_name)
                )
            return trailing and (befalls(clause.said) or not named)
        case "purpose", ("so" | "so that" | "where"):
            where = clause.joint == "where"
            # "So that you can open it, …" and "so that it stands, …" may ask for that.
            ahead = at == 0 and clause.joint == "so that" and clauses[1:] != []
            ahead = ahead and is_of_people(clause.said) and not clause.said.startswith("you ")
            if clause.joint == "so" and (
                tells_fact(clause.said, is_name) or is_unused(clause.said)
            ):
                return True  # "We had soup, so I am not hungry"
            return (trailing or ahead) and is_purpose(clause.said, is_name, where=where)
        case "purpose", _:
            return trailing and is_warning(clause.said)
        case "comment", _:
            return clause.comma and (
                is_comment(clause.said, is_name) or tells_fact(_whole_of(clause), is_name)
            )
    so = at + 1 < len(clauses) and clauses[at + 1].joint in ("so", "and so")
    planned = so and (
        is_desk_wish(clause.said)
        or is_plan(clause.said, is_name)
        or goes_there(clause.said, is_name)
        or stranger_is_there(clause.said, is_name)
    )
    if at == 0 and exclaims(clause.said, is_name):
        return True
    if at + 1 < len(clauses) and goes_to_it(clause.said, behind, first=at == 0):
        return True
    if (at or _is_whole(clauses, at)) and goes_with_somebody(clause.said, is_name):
        return True
    if _is_whole(clauses, at) and (
        fears_for(clause.said)
        or may_befall(clause.said)
        or goes_there_later(clause.said, is_name)
        or tells_of_others(clause.said, is_name, before_so=so)
    ):
        return True
    if (
        trailing
        and clause.comma
        and (
            goes_there(clause.said, is_name)
            or is_about_to(clause.said, is_name)
            or there_is_such(clause.said, is_name)
        )
    ):
        return True
    if dislikes(clause.said) or is_hindering(clause.said):
        return True
    if is_not_to_stay(clause.said) and told_of_thing(clause.said, is_name):
        return True
    if trailing and is_unspoilt(clause.said):
        return True
    if planned or wants_such_a_thing(clause.said, is_name):
        return True
    return (
        is_remark(clause.said, is_name)
        or bool(told_of_thing(clause.said, is_name))
        or tells_fact(clause.said, is_name)
    )


def _is_whole(clauses: Sequence[Clause], at: int) -> bool:
    """Whether a clause may be a sentence rather than an item of a list ("the pens, the keys")."""
    alone = all(item.is_polite for at_, item in enumerate(clauses) if at_ != at)
    behind = clauses[at + 1] if at + 1 < len(clauses) else None
    asked = behind is not None and (
        behind.joint in ("so", "and so", "but", "that is why", "therefore", "hence")
        or (not behind.joint and at == 0 and is_doing((behind.said.split() or [""])[0]))
        or (behind.is_polite and at == 0)
    )
    return alone or asked

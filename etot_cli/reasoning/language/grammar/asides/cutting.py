"""Which clauses of a sentence ask for nothing, by what they say and by what joins them."""

from __future__ import annotations

import re
from collections.abc import Sequence

from msgspec import Struct
from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.asides.aside_clauses import GRANTED, Clause
from etot_cli.reasoning.language.grammar.asides.asking_words import (
    BEFORE_NAMES,
    IsName,
    asks_besides,
    is_doing,
)
from etot_cli.reasoning.language.grammar.asides.circumstances import KIND, OF_A_CASE
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
from etot_cli.reasoning.language.grammar.asides.people import HEARSAY, is_of_people
from etot_cli.reasoning.language.grammar.asides.reasons import (
    is_comment,
    is_purpose,
    is_reason,
    is_warning,
)
from etot_cli.reasoning.language.grammar.asides.remarks import is_remark, is_unused
from etot_cli.reasoning.language.grammar.asides.talk import is_talk
from etot_cli.reasoning.language.grammar.asides.telling import (
    exclaims,
    goes_there,
    goes_there_later,
    goes_with_somebody,
    stranger_is_there,
    there_is_such,
)
from etot_cli.reasoning.language.grammar.asides.told_of_things import (
    told_of_thing,
)
from etot_cli.reasoning.language.grammar.asides.vague_wishes import (
    lacks_room,
    still_needs_it,
    wants_such_a_thing,
    would_see,
)
from etot_cli.reasoning.language.grammar.asides.where_needed import is_hindering
from etot_cli.reasoning.language.words.expressions import Expression

_PLACES = ("in ", "on ", "at ", "next ", "beside ", "behind ", "near ", "to ", "left ", "right ")
_ASKED = Expression(r"(?:(?:so|please|kindly|but|and) )*(?:can|could|would|will|please|kindly)\b")
"""What begins a request."""
_COMPOUND = Expression(
    r"(?:the|my|our|your|his|her|some) \w+ (?!sleeps|cries|barks|insists|complains|snores)\w+[^s]s"
)
"""What may be a noun with another one before it ("the dog treats")."""
_NEXT = Expression(
    r"^(?:(?:then|afterwards|after that|next|please|also|you can|(?:can|could|would) you) )+"
)
_OWNED = Expression(r" (?:is|are) (?:(?:\w+ )?\w+ 's|mine|hers|theirs)$")
_NOT_OURS = Expression(r"(?:(?:it|they) (?:is|are) )?not (?:ours|mine|yours|his|hers|theirs)")
"""Behind whose something is."""
_DOES_WITH_IT = Expression(r"you \w+ (?:up )?(?:it|them|either|both|any|anything)\b")
"""What the robot does comes later than what is done before it."""


def _whole_of(clause: Clause) -> str:
    """What a clause says, as a sentence of its own where "which" stands for what it is about."""
    told = clause.kind == "comment" and not is_of_people(clause.said)
    return f"it {clause.said}" if told else clause.said


class _Place(Struct, frozen=True):
    """A clause where it stands in its sentence."""

    clauses: Sequence[Clause]
    at: int
    is_name: IsName

    @property
    def clause(self) -> Clause:
        """The clause itself."""
        return self.clauses[self.at]

    @property
    def said(self) -> str:
        """What it says behind its joint."""
        return self.clause.said

    @property
    def behind(self) -> str:
        """What the next clause says."""
        after = self.clauses[self.at + 1 : self.at + 2]
        return _NEXT.sub("", after[0].said) if after else ""

    @property
    def is_last(self) -> bool:
        """Whether nothing that asks for anything else follows."""
        polite = all(item.is_polite for item in self.clauses[self.at + 1 :])
        first = (self.behind.split() or [""])[0]
        goes_on = first == "with" and not any(map(self.is_name, self.said.split()))
        return polite or is_doing(first) or self.behind.startswith("do not ") or goes_on

    @property
    def trails(self) -> bool:
        """Whether it follows what is asked for, and nothing but what that goes on with is next."""
        if self.clause.joint == "where" and not self.is_last:
            following = self.clauses[self.at + 1]
            return following.comma and following.said.startswith(_PLACES)
        return self.at > 0 and self.is_last and not asks_besides(self.said)

    @property
    def leads(self) -> bool:
        """Whether it is the first of several."""
        return self.at == 0 and self.clauses[1:] != []


def is_aside(clauses: Sequence[Clause], at: int, is_name: IsName) -> bool:
    """Whether one of a sentence's clauses asks for nothing."""
    clause = clauses[at]
    if clause.is_polite and len(clauses) > 1:
        return not clause.said or clause.kind != "polite"
    if clause.joint in GRANTED:
        return False
    if clause.kind == "anyway" or is_left_open(clause.whole):
        return True
    if not clause.said or clause.kind == "provided":
        return False
    place = _Place(clauses, at, is_name)
    match clause.kind, clause.joint:
        case (("reason" | "meanwhile"), _):
            return (place.trails or place.leads) and _gives_a_reason(place)
        case "comment", "who":
            of_somebody = at > 0 and clauses[at - 1].kind == "benefit"
            return of_somebody and _tells_of_her(clause.said, is_name)
        case "comment", _:
            return clause.comma and (
                is_comment(clause.said, is_name) or tells_fact(_whole_of(clause), is_name)
            )
        case kind, _ if kind == KIND:
            return at > 0
        case "benefit", _:
            return _is_for_somebody(place)
        case "purpose", "before":
            return _is_for_later(place)
        case "purpose", ("so" | "so that" | "where"):
            return _tells_what_for(place)
        case "purpose", _:
            return place.trails and is_warning(clause.said, is_name)
        case _:
            return _only_tells(place)


def _gives_a_reason(place: _Place) -> bool:
    """Whether a clause behind "because", "as" or "while" says how things are."""
    said, is_name = place.said, place.is_name
    if place.clause.joint == "what with":  # "the open day"
        return place.leads and not any(map(is_name, said.split()))
    if re.match("an? ", said) and any(is_name(it) or it in OF_A_CASE for it in said.split()):
        return False  # "as a backup the banana"
    of_people = is_of_people(said) and not said.startswith("you ")
    if place.clause.joint == "in case" and any(map(is_name, said.split())) and not of_people:
        return False  # "in case the box is full, put it on the tray" is a condition
    return (
        is_reason(said, is_name)
        or may_befall(said)
        or lacks_room(said)
        or bool(told_of_thing(said, is_name))
        or tells_fact(said, is_name)
        or goes_there(said, is_name, whose=BEFORE_NAMES)
        or is_talk(said, is_name)
    )


def _tells_of_her(does: str, is_name: IsName) -> bool:
    """Whether it asks for nothing that somebody is or does this."""
    return is_remark(f"she {does}", is_name) or tells_fact(f"she {does}", is_name)


def _is_for_somebody(place: _Place) -> bool:
    """Whether a clause says no more than for whom something is done, and what that one does."""
    _, _, does = place.said.partition(" who ")
    if does and not _tells_of_her(does, place.is_name):
        return False
    set_off = place.is_last or place.clauses[place.at + 1].comma
    apart = place.at > 0 and (set_off or place.clauses[place.at + 1].joint == "and")
    return apart and not any(map(place.is_name, place.said.split()))


def _is_for_later(place: _Place) -> bool:
    """Whether a clause behind "before" tells what comes later; "before you do that, close it" says
    when something is done.
    """
    said = place.said
    does = f"{said} ".startswith("you do ") or _DOES_WITH_IT.match(said)
    named = does or any(map(place.is_name, said.split()))
    if all(item.is_polite for item in place.clauses[: place.at]) and not all(
        item.is_polite for item in place.clauses[1:]
    ):
        # "Before you do that, …" is about an order.
        told = not re.match(r"(?:you|we|i)\b", said)
        told = told and (is_remark(said, place.is_name) or is_talk(said, place.is_name, timed=True))
        return befalls(said) or (told and not named)
    return place.trails and (befalls(said) or not named)


def _tells_what_for(place: _Place) -> bool:
    """Whether a clause behind "so", "so that" or "where" says what something is done for; "so that
    you can open it, …" and "so that it stands, …" may ask for that.
    """
    said, joint = place.said, place.clause.joint
    told = tells_fact(said, place.is_name) or (place.leads and is_talk(said, place.is_name))
    if joint == "so" and (told or is_unused(said)):
        return True  # "We had soup, so I am not hungry"
    ahead = place.leads and joint == "so that"
    ahead = ahead and is_of_people(said) and not said.startswith("you ")
    return (place.trails or ahead) and is_purpose(said, place.is_name, where=joint == "where")


def _only_tells(place: _Place) -> bool:
    """Whether a clause without such a joint only tells something."""
    said, is_name, at, clauses = place.said, place.is_name, place.at, place.clauses
    if said.startswith(("says ", "said ")) and at and is_aside(clauses, at - 1, is_name):
        said = f"she {said}"  # "Ann was here, says it is late"
    if heard := HEARSAY.match(said):
        told = replace(place.clause, said=said[heard.end() :])
        clauses = [*clauses[:at], told, *clauses[at + 1 :]]
        return _is_whole(clauses, at) and _only_tells(_Place(clauses, at, is_name))
    first, whole = at == 0, _is_whole(clauses, at)
    so = at + 1 < len(clauses) and clauses[at + 1].joint in ("so", "and so")
    if not so and _COMPOUND.fullmatch(said):
        return False
    for_somebody = any(item.kind == "benefit" for item in clauses[at + 1 : at + 2])
    wanted_for = so and (is_desk_wish(said) or is_plan(said, is_name) or would_see(said))
    is_there = so and (goes_there(said, is_name) or stranger_is_there(said, is_name))
    on_the_way = at + 1 < len(clauses) and goes_to_it(said, place.behind, first=first)
    feared = whole and (fears_for(said) or may_befall(said))
    set_off = whole or is_of_people(said) or _is_set_off(clauses, at, is_name)
    of_others = (whole and goes_there_later(said, is_name)) or is_talk(
        said, is_name, before_so=so, listed=not set_off
    )
    added = place.trails and (
        is_unspoilt(said)
        or (place.clause.comma and (goes_there(said, is_name) or there_is_such(said, is_name)))
    )
    return (
        (wanted_for or is_there or on_the_way or feared or of_others or added)
        or (sum(len(item.said.split()) for item in clauses[:at]) < 2 and exclaims(said, is_name))
        or ((not first or whole) and goes_with_somebody(said, is_name))
        or (at > 0 and _NOT_OURS.fullmatch(said) and bool(_OWNED.search(clauses[at - 1].said)))
        or dislikes(said)
        or is_hindering(said)
        or wants_such_a_thing(said, is_name)
        or still_needs_it(said, is_name, for_somebody=for_somebody)
        or is_remark(said, is_name)
        or bool(told_of_thing(said, is_name))
        or tells_fact(said, is_name)
    )


def _is_set_off(clauses: Sequence[Clause], at: int, is_name: IsName) -> bool:
    """Whether a clause may be a sentence, as may all that is told before a request."""
    behind = clauses[at + 1] if at + 1 < len(clauses) else None
    if behind and behind.joint == "and" and is_talk(behind.said, is_name):
        return _is_set_off(clauses, at + 1, is_name)
    return _is_whole(clauses, at) or (
        behind is not None
        and bool(_ASKED.match(f"{behind.joint} {behind.said}".strip()))
        and (at == 0 or clauses[at].joint == "and")
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

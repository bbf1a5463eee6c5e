"""Whom a clause is about: people, who are nothing that is in a scene."""

from __future__ import annotations

from etot_cli.reasoning.language.words.expressions import Expression

_RELATIONS = (
    "kids?|children|guests?|visitors?|boss|sister|brother|mother|mom|mum|father|dad|wife|husband|hubby|"
    "friends?|colleagues?|students?|neighbou?rs?|team|cat|dog|baby|family|customers?|clients?|"
    "lads?|lass(?:es)?|kidd(?:y|ies|os?)|folks?|guys|girls|boys|chaps?|patients?|grand(?:ma|pa)|granny|grandad|uncle|aunt|cousin|niece|nephew|parents|toddler|grandchild(?:ren)?|lady|ladies|gentlem[ae]n|wom[ae]n|son|daughter|grand(?:mother|father|son|daughter)|flatmate|teacher|doctor|nurse|roommate"
)
OWN = (
    "hands?|feet|foot|back|eyes|knees?|arms?|legs?|head|fingers|throat|nose|shins?|elbows?|toes?|hips?"
    "|ankles?|wrists?|shoulders?|bus|train|taxi|shift"
)
"""Of people, and of nothing that is in a scene."""
PEOPLE = (
    r"(?:i|we|you|he|she|nobody|no one|somebody|someone|anybody|anyone|everybody|everyone|people"
    r"|guests|visitors|customers|friends|colleagues|students"
    r"|grand(?:ma|pa)|granny|grandad|nan|mum|mom|dad|mummy|mommy|daddy|hubby"
    r"|(?:mr|mrs|ms|dr|miss|prof|professor|aunt|auntie|uncle) \w+"
    rf"|(?:(?:my|our|your|his|her|the|an?|one|another) )"
    rf"(?:(?:old|little|young|elder|dear|poor|older|younger|first|next|last|new) )?"
    rf"(?:{_RELATIONS}|little ones?)"
    rf"|(?:my|our) (?:{OWN}))"
)
ON_ARRIVAL = (
    r"(?:when(?:ever)?|once|after|before|until|till|by the time|as soon as|every time"
    r"|the (?:minute|moment|second|instant)) "
    rf"(?:{PEOPLE}|they) (?:(?:finally|first|next) )?(?:gets?|comes?|arrives?|returns?|wakes?|"
    r"(?:is|are|am) (?=back|home|up|here|done|in))"
    r"(?: (?:back|home|in|up|here|done|down|over|out|around|tonight|tomorrow|later|today|again)"
    r"| (?:from|for|to) (?:the |my |our |his |her |their )?\w+)*"
)
"""When something is so with people."""
ON_ARRIVAL_THEN = Expression(rf" {ON_ARRIVAL}$")
"""Behind what somebody is or does it is no condition for what is asked for."""
_PERSON = Expression(
    rf"^{PEOPLE} (?:just |already |also |really |always |still |usually |often |"
    r"never |hardly |rarely )*(?P<did>.+)$"
)
_SOMEBODY = Expression(rf"^(?P<who>{PEOPLE}) ")


_NAME = r"(?!(?:it|that|this|which|who|what|one|never|none|just)\b)\w+(?<!ly)"
HEARSAY = Expression(
    rf"^(?:(?:{PEOPLE}|they) say|(?:{PEOPLE}|they|{_NAME}) (?:says|said|told (?:me|us))) "
    r"(?:that )?(?!to\b)"
)
"""Before what somebody else says."""


def deed_of(said: str) -> str | None:
    """What a clause says that somebody does or is; None where it is about no person."""
    found = _PERSON.match(said)
    return found["did"] if found else None


def is_of_people(said: str) -> bool:
    """Whether a clause is about somebody."""
    return deed_of(said) is not None


def somebody(said: str) -> tuple[str, str] | None:
    """Who a clause is about, and what it says of him; none where it is about no person."""
    found = _SOMEBODY.match(said)
    return (found["who"], said[found.end() :]) if found else None

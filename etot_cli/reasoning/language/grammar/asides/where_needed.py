"""Whether clauses call for, or allow, what is done anyway where it has to be.

Every plan moves what is in the way of something, and nothing else that is not asked for. Who allows
that, calls for it in that case or forbids it in any other asks for nothing by it.
"""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.language.words.expressions import Expression

_IT = r"(?:it|them|that)"
_THING = rf"(?:(?:just )?(?:(?:the|my|our) (?:\w+ ){{0,3}}?\w+|{_IT}|anything|something))"
_FIRST = r"(?: (?:first|before|beforehand|before that|for (?:that|this)|to do (?:so|that|this)))*"
_OUT = r"(?:out of (?:the|your) way|out|away|aside|to (?:one|the) side|off|up)"
_ELSEWHERE = (
    r"(?:(?:to )?(?:somewhere|some place|someplace) else|elsewhere|(?:to )?another (?:place|spot)"
    r"|(?:wherever|anywhere) you (?:like|want)|around|about)"
)
_TAKE = r"(?:take|move|put|get|lift|push|bring|pick|set)"
_TAKING = r"(?:taking|moving|putting|getting|lifting|pushing|picking|setting)"
_TOUCH = r"(?:remove|move|touch|shift|disturb|relocate)"
_TOUCHING = r"(?:removing|moving|touching|shifting|disturbing|relocating)"
_TAKEN = (
    rf"(?:(?:moved|taken|put|picked|set) (?:{_OUT}|{_ELSEWHERE})"
    r"|moved|removed|touched|shifted|disturbed|relocated)"
)
_YOU = (
    r"(?:(?:please|then|just|simply|also|only|but|and"
    r"|you (?:can|may|could|should|must|have to)) )*"
)
_IN_THE_WAY = (
    r"(?:is|are|gets?|stands?|happens? to be|should be|would be) (?:really |actually )?"
    r"in (?:the|your|its) way"
)
_BLOCKS = r"(?:blocks|obstructs|is blocking|is obstructing|would block|hinders)"
_SO = (
    rf"(?:{_THING} (?:{_IN_THE_WAY}(?: of {_THING})?|{_BLOCKS} (?:you|{_THING}))"
    rf"|one of them {_IN_THE_WAY})"
)
_HAVE_TO = (
    r"(?:(?:(?:it is|that is|this is|they are) )?(?:really |absolutely |strictly )?"
    r"(?:necessary|needed|required|unavoidable)"
    r"|you (?:really |absolutely )?(?:need|have|must)(?: to)?)"
)
_NEEDED = rf"(?:only )?(?:if|when|where|in case|as|should) (?:{_HAVE_TO}|{_SO})"
_UNLESS = rf"(?:unless|except (?:if|when)) (?:{_HAVE_TO}|{_SO})"
_MAY_HAVE_TO = "(?:may|might|could|will probably) (?:have|need) to"
_TAKE_IT = rf"(?:{_TAKE} {_THING} (?:{_OUT}|{_ELSEWHERE})|{_TOUCH} {_THING}(?: {_ELSEWHERE})?)"
_TAKING_IT = (
    rf"(?:{_TAKING} {_THING} (?:{_OUT}|{_ELSEWHERE})|{_TOUCHING} {_THING}(?: {_ELSEWHERE})?)"
)
_AND_LEAVE_IT = (
    rf"(?: and (?:leave {_IT} there|(?:leave|put|lay|set|place|stand|keep) {_IT} "
    r"on (?:the|my|our) (?:desk|table|counter|worktop|bench)))"
)
_LEAVE_IT = rf"leave {_THING} (?:alone|untouched)"
_FINE = r"(?:fine|ok|okay|all right|alright|allowed|permitted|no problem)"
_ALLOWED = (
    rf"(?:you may|(?:you are |feel )?(?:free|allowed|permitted|welcome) to"
    rf"|(?:it is|it would be) (?:{_FINE} (?:to|if you)|{_FINE} for you to))"
)
_IF_IN_THE_WAY = Expression(
    rf"(?:if {_SO}|(?:should {_THING}|were {_THING} to) (?:be|get|stand) in (?:the|your|its) way)"
)
_TAKE_IT_AWAY = Expression(rf"{_YOU}(?:{_TAKE} {_IT} {_OUT}|{_TOUCH} {_IT}){_FIRST}")
_WHATEVER = (
    r"(?:(?:first )?(?:move|remove|clear|take|shift)(?: away| aside)?"
    rf" (?:whatever|what|(?:anything|everything)(?: that)?) {_IN_THE_WAY}(?: of {_THING})?"
    rf"(?: {_OUT})?)"
)
_WHERE_NEEDED = Expression(
    rf"(?:{_YOU}{_WHATEVER}{_FIRST}|{_YOU}(?:{_TAKE_IT}|{_TAKING_IT}){_FIRST} {_NEEDED}"
    rf"|you (?:can|could) {_TAKE} {_THING} {_ELSEWHERE}{_FIRST}"
    rf"|{_ALLOWED} {_TAKE_IT}{_FIRST}(?: {_NEEDED})?"
    rf"|it (?:is|would be) {_FINE} (?:for you to|to|if you) {_TAKE_IT}{_AND_LEAVE_IT}"
    rf"|{_TAKING_IT} (?:is|would be) {_FINE}(?: {_NEEDED})?"
    rf"|{_THING} (?:may|might|can|could) be {_TAKEN}{_FIRST}(?: {_NEEDED})?"
    rf"|(?:you {_MAY_HAVE_TO} {_TAKE_IT}|{_THING} {_MAY_HAVE_TO} be {_TAKEN}){_FIRST}"
    rf"(?: {_NEEDED})?"
    rf"|(?:please )?(?:(?:do not|never) {_TAKE_IT}|{_LEAVE_IT}"
    rf"|(?:without |avoid )?{_TAKING_IT}) {_UNLESS})"
)


def done_where_needed(said: Sequence[str]) -> int:
    """How many of the clauses that come next ask for nothing else."""
    if len(said) > 1 and _IF_IN_THE_WAY.fullmatch(said[0]) and _TAKE_IT_AWAY.fullmatch(said[1]):
        return 2
    return int(bool(said and _WHERE_NEEDED.fullmatch(said[0])))


_HINDERING = Expression(
    r"there (?:is|are) (?:still )?(?:an?|the|some|two|my) (?:\w+ ){1,3}"
    r"(?:(?:standing |lying |sitting )?in (?:the|your|its) way|blocking it)"
    r"(?: (?:in|on|inside|on top of) (?:the|that|my) (?:\w+ ){0,3}\w+)?"
)


def is_hindering(said: str) -> bool:
    """Whether a clause tells what is in the way, which every plan sees for itself."""
    return bool(_HINDERING.fullmatch(said))

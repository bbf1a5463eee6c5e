"""Whether somebody only tells that there is no room, or that some is needed: a reason why things go
elsewhere, and no thing.
"""

from __future__ import annotations

from etot_cli.reasoning.language.words.expressions import Expression

_ROOM = (
    r"(?:(?:(?:some|more|a (?:bit|little|lot)|lots|enough|not enough|no|(?:too )?little|any|much)"
    r"(?: more| extra| free)*(?: of)? |the )?(?:elbow )?(?:room|space)"
    r"|(?:the|that) (?:whole )?(?:surface|spot|area))"
)
_WHERE = (
    r"(?: (?:left|to (?:work|write|cook|eat|play|breathe)|(?:over |in )?here|there|now"
    r"|(?:in|on|for) (?:the|a|an|my|our|this|some|another) (?:\w+ ){0,2}?\w+"
    r"|for (?:something|other things|more things|(?:something|anything) else|\w+ing)))*"
)
_LACKING = Expression(
    rf"(?:(?:i|we) (?:(?:just|really|also) )?(?:(?:will |could |would )?(?:need|use|want|like)"
    rf"(?: to have)?|do not have|have|am|are)(?: (?:short|out) of)? {_ROOM}{_WHERE}"
    rf"|there is (?:just )?(?:not |hardly |barely )?{_ROOM}{_WHERE}"
    rf"|(?:the |my )?(?:room|space) is (?:tight|short|scarce|limited){_WHERE})"
)


def lacks_room(said: str) -> bool:
    """Whether this is what a clause tells ("I need some space here")."""
    return bool(_LACKING.fullmatch(said))

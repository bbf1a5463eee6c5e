"""What happens to a thing by itself where nothing is done about it: it melts, spoils, rolls off."""

from __future__ import annotations

from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.fillers import TURNED

_DOES = (
    "melt|spoil|rot|perish|leak|spill|fall|roll|tip|topple|wilt|burn|cool|warm|dry|dries|break|"
    "crack|slip|slide|shatter|curdle|evaporate|freeze|thaw|defrost|sour|harden|wither|slosh|"
    "tumble|blow|vanish|crumble|clot|spoilt"
)
_GETS = (
    f"{TURNED}|lost|broken|damaged|stolen|spoilt|spoiled|squashed|crushed|ruined|scratched|stained|"
    "spilt|spilled|messy|lukewarm|sticky|rusty|knocked (?:over|down|off)|stepped on|sat on"
)
BEFALLS = (
    rf"(?:(?:just|only|all|quickly|soon) )?"
    rf"(?:(?:{_DOES})(?:e?s)?(?: (?:off|over|down|away|up|out)"
    r"(?: (?:of )?(?:the|my|our) (?:\w+ )?\w+)?| (?:on|onto|to) the (?:floor|ground|rug|carpet))?"
    rf"|(?:gets?|goes|go|turns?|becomes?) (?:too )?(?:{_GETS}|missing)"
    r"|(?:falls?|goes|go) to (?:waste|pieces)"
    r"|catch(?:es)? fire|(?:goes|go) up in flames)"
    r"(?: again| everywhere| in (?:the (?:sun|heat)|here))?"
)
"""As a regular expression, behind what it happens to."""
_THING = r"(?:it|they|something|anything|(?:the|my|our) (?:\w+ )?\w+)"
BY_ITSELF = (
    "(?:dry|cool|soak|thaw|defrost|charge|warm|set|harden|ripen|drain|air|chill|settle|marinate)"
    "(?: (?:off|down|out|up|overnight|again|there|properly|a bit|a little)){0,2}"
)
"""What a thing is left somewhere to do, of which the robot does nothing ("on the rack to dry")."""
_MIGHT = r"(?:will|would|might|may|could|can|is going to|are going to)"
_KNOCKED = (
    r"(?:hit|struck|swept|knocked|pushed|dragged|bumped|caught|crushed|squashed|damaged|broken)"
    r"(?: (?:off|over|down|away|out)(?: of)?(?: (?:the|my|our) (?:\w+ )?\w+)?)?"
    r"(?: by (?:it|(?:the|my|our) (?:\w+ )?\w+))?"
)
THING_WILL = rf"{_THING} {_MIGHT} (?:{BEFALLS}|(?:be|get) {_KNOCKED})"
"""What is only told of things: nobody asks for that, nor for the contrary alone."""
BEFORE_IT_DOES = rf"{_THING} (?:{BEFALLS})"
_FULL = Expression(rf"(?:{BEFORE_IT_DOES}|{THING_WILL})")


def befalls(said: str) -> bool:
    """Whether a clause tells what happens to a thing by itself ("it will melt")."""
    return bool(_FULL.fullmatch(said))


_WILL = Expression(
    rf"(?:{THING_WILL}|{_THING} {_MIGHT} (?:hit|strike|sweep|knock|push|drag|bump into|catch|crush"
    r"|squash|damage|break) (?:it|them|(?:the|my|our) (?:\w+ )??\w+)"
    r"(?: (?:off|over|down|away|out)(?: of)?(?: (?:the|my|our) (?:\w+ )?\w+)?)?"
    rf"|{_THING} can not (?:yet )?be (?:reached|seen|found|got at|gripped|grasped|lifted))"
)


def may_befall(said: str) -> bool:
    """Whether a clause tells what might happen to a thing that nobody asks for ("it might fall",
    "the door would hit it").
    """
    return bool(_WILL.fullmatch(said))


_FEARED = Expression(
    r"(?:i|we) (?:(?:really|just) )?(?:(?:do|would) not (?:want|like) to|(?:would )?hate to"
    r"|(?:must|can|should) not|(?:am|are) (?:afraid|scared|worried) (?:of|about|(?:that )?i might)"
    r"|(?:can not|do not want to) risk|(?:might|may|could|will) (?:easily )?)"
    r" ?(?:los(?:e|ing)|break(?:ing)?|damag(?:e|ing)|spill(?:ing)?|scratch(?:ing)?|ruin(?:ing)?"
    r"|crush(?:ing)?|squash(?:ing)?|forget(?:ting)?|wast(?:e|ing)|trip(?:ping)? over"
    rf"|step(?:ping)? on|sit(?:ting)? on) (?:{_THING}|that (?:\w+ ){{0,2}}?\w+)"
    r"(?: (?:again|by accident|in here|somewhere|either))?"
)


def fears_for(said: str) -> bool:
    """Whether somebody tells what he does not want to happen to a thing by himself ("I do not want
    to lose the bolt"), as before "so".
    """
    return bool(_FEARED.fullmatch(said))


_UNSPOILT = Expression(
    rf"{_THING} (?:should|must|may|do|does|will) not (?:(?:smell|taste|reek) (?:of|like) "
    rf"(?:the |my |our )?\w+|(?:get|become|turn|go) (?:too |all )?(?:{_GETS}|muddy|greasy))"
)


def is_unspoilt(said: str) -> bool:
    """Whether a clause tells why, behind a request: what must not become of a thing ("it should
    not smell of them").
    """
    return bool(_UNSPOILT.fullmatch(said))

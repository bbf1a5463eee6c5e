"""The words for what stands in the way, and for what does not open, close or fit."""

from __future__ import annotations

_NOW = "[still|now|currently|just]"
BLOCKING = "blocking, obstructing, covering, [right] in the way of"
BLOCKS = f"""
    (is|are) {_NOW} (blocking|obstructing|covering|[right] in the way of),
    (would|will|might|could) (block|obstruct|be in the way of),
    blocks, obstructs, covers, block, obstruct, (stands|lies|sits|gets) [right] in the way of
"""
BLOCKED_BY = f"(is|are) {_NOW} (blocked|obstructed|covered) by"
"""Between what is hindered and what hinders it."""
KEEPS = f"""
    keeps, keep, (is|are) {_NOW} (keeping|preventing|stopping|hindering), prevents, prevent, stops,
    stop, hinders, (would|will|might|could) (keep|prevent|stop|hinder)
"""
_PROPERLY = "properly|fully|completely|all the way|yet|again"
PROPERLY = _PROPERLY.replace("|", ",")
FROM_MOVING = f"[from] (opening|closing|shutting|being (opened|closed|shut)) [{_PROPERLY}]"
"""Behind what something keeps so."""
_MOVE = f"[{_PROPERLY}] (open|close|shut|be (opened|closed|shut)) [{_PROPERLY}]"
TO_MOVE = f"to {_MOVE}"
WILL_NOT_MOVE = f"(can|will|does|could|would) not {_MOVE}, (fails|refuses) to {_MOVE}"
MOVE = "open, close, shut"
CAN_NOT_MOVE = "(i|we|you|one) can not (open|close|shut), it is impossible to (open|close|shut)"
DOES_NOT_MOVE = "(will|does|did|would) not (open|close|shut), (fails|refuses) to (open|close|shut)"
"""What cannot be opened may rather be left so."""
THERE = "in it, inside, in there, on it, in the way"
AS_LONG_AS = "because, as, since, as long as, while, when"
_STICKING = "sticking|standing|poking|jutting|peeking|peeping|looking"
STANDS_OUT = f"""
    (is|are) {_NOW} ({_STICKING}) (out|up|above), (is|are) {_NOW} protruding,
    (sticks|pokes|stands|juts|peeks|peeps) (out|up), protrudes
"""
STANDING_OUT = f"({_STICKING}) (out|up), protruding"
STUCK = "(is|are|got) [still] (stuck|jammed|wedged|caught)"
TOO_FAR = (
    "[a bit|much|far] too (far|high|much), at the top, a (bit|little), over the (top|edge|rim)"
)
TOO_BIG = "(is|are) [a bit|far|much] too (tall|big|large|high|long|wide|thick) [for it]"
IS_THERE = """
    (is|are) [still|standing|lying|sitting] (in it|inside|in there|on it|in the way|in front of it),
    (stands|lies|sits) (in it|inside|in there|in the way|in front of it)
"""
UNFIT = "(does|do|will|can|would) not fit"
_SOMEBODY = "(somebody|someone|i|we|they|he|she)"
SOMEBODY_DID_NOT = f"""
    {_SOMEBODY} [has|have|had] [just] (forgot|forgotten) to (close|shut|open),
    {_SOMEBODY} did not [properly|fully|completely] (close|shut|open),
    {_SOMEBODY} (has|have|had) not [yet] (closed|shut|opened),
    (nobody|no one) [has] (closed|shut|opened)
"""
_A_BIT = "slightly|partly|partially|halfway|half way|a ([little|tiny] bit|little|crack)"
_BY_NOW = "only|just|already|still|now"
SLIGHTLY_OPEN = f"""
    (is|are) (only|just) [{_A_BIT}|half] (open|ajar), (is|are) [just|only] barely open,
    (is|are) [{_BY_NOW}] ({_A_BIT}|half) (open|ajar),
    (is|are) [{_BY_NOW}] open [only|just] ({_A_BIT})
"""
NOT_QUITE = f"""
    (is|are) not [quite|fully|completely|entirely|properly|really|yet]
    (open|opened|closed|shut|free) [{_PROPERLY}], (is|are) (stuck|jammed),
    (has|have) not been (opened|closed|shut) [{_PROPERLY}]
"""
FREE = "(is|are) [still] (free|available|unoccupied)"
ROOM_FOR_ONE = """
    [only] (has|have) [only] (room|space) for [only] (one|a single) [one|of them|thing|object]
"""

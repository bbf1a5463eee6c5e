"""The words for what must not be done, or must not happen to things on the way."""

from __future__ import annotations

from etot_cli.reasoning.language.words.verbs import SHIFT, THE_ROBOT

DO_NOT = f"""
    (do not|don t|never|at no (point|time|stage|moment)) [(let|have|make) ({THE_ROBOT})],
    must not, avoid,
    (you|{THE_ROBOT}) (must|may|should) not, ({THE_ROBOT}) is not to,
    [you had] better not, but do not, and do not, [but|and] (make|be) sure not to,
    [but|and] be careful not to, [but|and] take care not to
"""
NEED_NOT_BE = """
    (does|do) not (need|have) to (move|be moved|be touched|be picked up|go anywhere),
    need not (move|be moved|be touched|go anywhere)
"""
"""Behind what may be left as it is."""
MAY_GO = "(can|may|could|might) [just] (go|end up|stand|lie|be|stay|be (put|placed))"
NEED_NOT_GO = """
    (does|do) not (need|have) to (go|be [put]|stay|remain), need not (go|be [put]|stay|remain)
"""
NEED_NOT = """
    [but|and] [there is] no need to, [but|and] you (need not|do not (need|have) to),
    [but] do not bother (to|with|), [but|and] (it is|it 's|it s) not necessary to
"""
NOT_TO_BE = """
    (must|should|may|can|shall|could) (not|never) be, (is|are) (not|never) to be
"""
TOUCHED = """
    [so much as] touched, handled, [so much as] grazed, brushed [against], contacted, gone near,
    messed with, interfered with, fiddled with
"""
WAS_HIT = """
    [so much as] (hit|struck|bumped [into]|nudged|jostled), knocked [over|into], pushed [over],
    tipped over, toppled
"""
DISTURBED = """
    moved [around|about|away], disturbed, lifted [up|off|out], picked up, shifted, displaced,
    budged, removed, taken [away|out|off|down]
"""
"""Behind what must not be."""
MAY = "may, can, could, should, must, shall, (is|are) to, (is|are) (allowed|permitted|supposed) to"
"""Before what may be done with some things alone."""
MOVED_ONLY = "moved [around|about|away]|disturbed|lifted [up]|picked up|shifted|displaced"
TOUCHED_ONLY = "touched"
WITHOUT = """
    without [ever], [while] (making|being) sure not to, [while] [being] careful not to,
    [while] taking care not to, so as not to
"""
_BARELY = "[even|so much as|as much as]"
TOUCH = f"""
    {_BARELY} touch[ing], (com(e|ing)|go|going|get|getting) [anywhere] near [to],
    contact[ing], {_BARELY} (graz(e|ing)|brush[ing]) [against|past], lay[ing] [a] (hand|finger) on,
    (make|making|come into|coming into) [any] contact with,
    mess[ing] with, fiddl(e|ing) with, meddl(e|ing) with, interfer(e|ing) with
"""
HIT = f"""
    {_BARELY} (hit[ting]|bump[ing] [against]|nudg(e|ing)|jostl(e|ing)), (bang|banging) against,
    (bump|knock|bang|crash|bumping|knocking|banging|crashing|run|running) into,
    collid(e|ing) with, strik(e|ing), knock[ing] [over], push[ing] [over], topple, toppling,
    tip[ping] over
"""
"""What is carried elsewhere before is not met so."""
MEETS = f"{TOUCH}, {HIT}"
"""What a door does to what stands in its way."""
MET = "hit, touched, struck, bumped [into], knocked [into|over], pushed [over|away|aside]"
NO_TOUCH = "[any|all] [physical] contact with, touching of"
NO_HIT = "[any|all] (collision|collisions) with, (hitting|bumping|nudging) of"
"""The same as nouns, behind "no", "avoid" and "without"."""
HARM = "damag(e|ing), harm[ing], crush[ing], squash[ing], break[ing]"
"""What no plan may do to anything."""
HARMED = "damaged|harmed|crushed|squashed|broken|spilled|spilt|lost"
"""What no plan may let become of anything."""
TO_THE_FLOOR = """
    (fall|drop|roll|slip|tumble|land|end up|hit|go|crash) [down] [(on|onto|to)] the (floor|ground)
"""
"""What no plan may let happen to anything, either."""
GETTING_TO_THE_FLOOR = """
    (falling|dropping|rolling|slipping|tumbling|landing|ending up|going|crashing) [down]
    (on|onto|to) the (floor|ground), hitting the (floor|ground),
    (falling|rolling|slipping|sliding|tumbling|dropping) (off [of]|from) the (desk|table)
"""
TOPPLES = """
    falls [over|down], topples [over], tips [over], tumbles [over|down], keels over,
    gets knocked over, is knocked over
"""
NOTHING = "nothing|no (object|thing|item)|none of the (objects|things|items)"
EVERYTHING = "(everything|(all [of] [the]|every) (objects|things|items|object|thing|item))"
MUST = "must|may|should|shall|can|could|will|is to|is allowed to|has to|have to"
"""In what is said of all things alike."""
FALLS_DOWN = """
    (falls|drops|rolls|slips|tumbles|spills|tips|topples|breaks)
    [(out|off|over|down|away)] [(of|from) it]
"""
FALL_DOWN = """
    (fall|drop|roll|slip|tumble|spill|tip|topple|break) [(out|off|over|down|away)] [(of|from) it]
"""
DISTURB = f"""
    {SHIFT},
    disturb[ing], displac(e|ing), budg(e|ing), lift[ing]
"""
UPSET = "knock[ing], tip[ping], push[ing], throw[ing], sweep[ing]"
TOPPLE = """
    fall [off|over|down], drop, topple [over], tip over, slide off, roll off,
    tumble [over|down], keel over, get knocked over
"""
TOPPLING = """
    falling [off|over|down], dropping, toppling [over], tipping over, sliding off,
    rolling (off|away), tumbling [over|down], keeling over, being knocked over
"""
FALLING = (
    "falling|rolling|slipping|sliding|dropping|tumbling|toppling|coming|being (pushed|knocked)"
)
FALLING_TO_THE_FLOOR = """
    (falling|rolling|slipping|dropping|tumbling|landing|ending up|going|crashing) [down]
    (on|onto|to) the (floor|ground), hitting the (floor|ground)
"""
ANYTHING_ELSE = """
    anything else, any other (object|thing|things|objects), other (objects|things)
"""

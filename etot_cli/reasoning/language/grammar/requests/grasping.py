"""Rules for how things are grasped: from above, from the side, or by whichever grasp."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    optional,
    phrase,
    quiet,
    sequence,
    silent,
    spanned,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    EMPTY_WORDS,
    OPTIONAL_COMMA,
    alternatives,
)
from etot_cli.reasoning.language.grammar.parsers.input import Input, Result
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.syntax.clauses import GraspClause
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things
from etot_cli.reasoning.language.words import (
    fillers,
    forbidden,
    manner,
    predicates,
    verbs,
)
from etot_cli.reasoning.language.words.lexicon import word_set
from etot_cli.reasoning.language.words.patterns import words_of
from etot_cli.skills.action import GraspPose

_WAY = either(
    phrase(manner.HORIZONTAL, GraspPose.HORIZONTAL), phrase(manner.VERTICAL, GraspPose.VERTICAL)
)
_HAND = words_of((manner.GRIPPER,))


def _grasped(given: Input, at: int) -> list[Result]:
    """A way to grasp; "with the hand level" where nothing in the scene is called "hand"."""
    found = _WAY.find(given, at)
    return [(end, way) for end, way in found if not _HAND & given.nouns & {*given.words[at:end]}]


_POSE = Parser(_grasped, lambda: _WAY.first)


def _other(pose: GraspPose) -> GraspPose:
    """The pose that is left where one is ruled out."""
    return next(item for item in GraspPose if item is not pose)


def _ruled_out(given: Input, at: int) -> list[Result]:
    """A way not to grasp; behind "from the shelf" "not from the top" may say from where instead."""
    said = any(
        word in ("off", "out") or (word == "from" and not _POSE.find(given, index))
        for index, word in enumerate(given.words[:at])
    )
    return [
        (end, _other(pose))
        for end, pose in _POSE.find(given, at)
        if not (said and given.words[at] == "from" and given.words[at + 1] in ("the", "its"))
    ]


_OTHER_POSE = sequence("not, no", Parser(_ruled_out, lambda: _POSE.first), optional("one"))
POSE = either(
    sequence(
        optional("only, just, exclusively, solely, purely"),
        _POSE,
        optional("only, exclusively, alone"),
    ),
    _OTHER_POSE,
    sequence(
        _POSE,
        OPTIONAL_COMMA,
        optional("and, but"),
        _OTHER_POSE,
        build=lambda pose, left: pose if pose is left else None,
    ),
    sequence(
        _POSE,
        "[~comma] (rather than|instead of)",
        _POSE,
        optional("one"),
        build=lambda pose, other: None if pose is other else pose,
    ),
)
_BOTH = (GraspPose.VERTICAL, GraspPose.HORIZONTAL)
POSES = either(alternatives(POSE, 1), phrase(manner.EITHER_WAY, _BOTH))
_OR_BOTH = either(
    POSES,
    sequence("both", _POSE, "and", _POSE, build=lambda one, other: (one, other)),
)
_GRASPS = word_set("grasp grip pick approach grasps grips picks approaches")
_SAID = _GRASPS | {"from", "by", "down"}


def _in_so_many_words(text: str, poses: Any) -> Any:
    """What is said of a grasp; "vertically" alone may be how something is put down."""
    both = isinstance(poses, tuple) and len({*poses}) > 1
    return poses if both or _SAID & {*text.split()} else None


def _written(text: str, clause: GraspClause) -> GraspClause:
    return replace(clause, text=text)


def _with_a_grasp(text: str, poses: Any) -> Any:
    """The grasp that something is done with; "insert it from above" says no such thing."""
    told = _GRASPS & {*text.split()} and text.startswith(("with ", "using ", "by "))
    return GraspClause(None, poses) if told else None


def _named_grasp(text: str, poses: Any) -> Any:
    """A grasp that is called one; "from above" alone may be said of a place."""
    return poses if _GRASPS & {*text.replace(":", "").replace(",", "").split()} else None


_NAMED_GRASP = sequence(
    spanned(sequence(optional("(grasp|grip) [~comma]"), POSES), _named_grasp),
    build=lambda poses: poses,
)
_A_GRASP, _NO_SUCH_GRASP = (
    sequence(spanned(said, _named_grasp), build=lambda poses: poses)
    for said in (
        alternatives(_POSE, 1),
        valued(_OTHER_POSE, lambda pose: (pose,)),
    )
)


def _told(parser: Parser) -> Parser:
    return sequence(spanned(parser, _in_so_many_words), build=lambda poses: poses)


_NOT_WITH = sequence(
    forbidden.WITHOUT,
    either(
        sequence(
            "grasping, gripping, holding, picking, lifting, taking, approaching",
            optional("it, them"),
            optional("up"),
            _POSE,
        ),
        sequence("using", _POSE),
    ),
    build=lambda pose: (_other(pose),),
)
_GRIPPING_HARD = "grasping|gripping|grabbing|approaching"
_GRIPPING = f"({_GRIPPING_HARD}|holding|picking|lifting|taking)"
_IMPOSSIBLE = """
    (is|are) (not (possible|feasible|doable)|impossible), (does|do|will) not work, (is|are) no good,
    fails, can not be done
"""
_IF_YOU_MUST = "if (you must|you have to|need be|necessary|needed)"
_IF_YOU_CAN = "if (you can|possible|at all possible|feasible)"
_AT_WORST = either(
    # "vertically if gripping it horizontally is not possible"
    sequence(
        _POSE,
        OPTIONAL_COMMA,
        f"(if|when|where|in case) [{_GRIPPING} [(it|them)] [up]]",
        _POSE,
        _IMPOSSIBLE,
        build=lambda worse, better: (better, worse),
    ),
    # "vertically if you must, horizontally if you can", and the other way around
    sequence(
        _POSE,
        _IF_YOU_MUST,
        OPTIONAL_COMMA,
        optional("but, and"),
        _POSE,
        optional(_IF_YOU_CAN),
        build=lambda worse, better: (better, worse),
    ),
    sequence(
        _POSE,
        optional(_IF_YOU_CAN),
        OPTIONAL_COMMA,
        optional("but, and"),
        _POSE,
        _IF_YOU_MUST,
        build=lambda better, worse: (better, worse),
    ),
    # "from the side, or if that is not possible from above", "from the side if possible, else …"
    sequence(
        _POSE,
        OPTIONAL_COMMA,
        either(
            sequence(
                optional("or"),
                OPTIONAL_COMMA,
                f"if (that|this|it) ({_IMPOSSIBLE.replace(',', '|')})",
            ),
            sequence(
                "if (possible|you can|feasible), preferably, ideally",
                OPTIONAL_COMMA,
                "else, otherwise, or else, or, if not",
            ),
            "failing (that|this|which), [or|and] otherwise, or else",
        ),
        OPTIONAL_COMMA,
        _POSE,
        build=lambda better, worse: (better, worse),
    ),
)
"""One way to grasp, and another where that is not possible: either, the better one first."""
_ONE_OR_WORSE = valued(_AT_WORST, lambda poses: poses if poses[0] is not poses[1] else None)
GRASPED = sequence(
    OPTIONAL_COMMA,
    either(
        sequence(
            optional(
                "but, with, using, being, [being] (grasped|gripped|held|approached),"
                "[while|by] (grasping|gripping|holding|approaching) (it|them),"
                f"[while|by] coming [in|at it], approaching, ({manner.HAND_COMES}),"
                "(grasp|grip) [~comma]"
            ),
            either(POSES, _ONE_OR_WORSE),
        ),
        _NOT_WITH,
        phrase(f"with {manner.HAND_EITHER_WAY}", _BOTH),
        sequence(
            "[no matter] whether, no matter if",
            POSES,
            optional(f"[that] ({fillers.DOES_NOT_MATTER})"),
        ),
        sequence(
            "[while|by] (keeping|holding)",
            either(
                phrase(manner.HAND_LEVEL, (GraspPose.HORIZONTAL,)),
                phrase(manner.HAND_DOWN, (GraspPose.VERTICAL,)),
            ),
        ),
    ),
)
"""Behind what is picked up."""
KEPT_SO = silent(
    optional(sequence(OPTIONAL_COMMA, manner.KEPT_HELD, optional(manner.UNTIL_TOLD)), "")
)
"""The same, for how long, which asks for nothing else."""
WITH_A_GRASP = spanned(
    either(
        sequence(spanned(POSES, _with_a_grasp), build=lambda clause: clause),
        valued(
            either(
                _NOT_WITH,
                sequence(f"[by|while] ({_GRIPPING_HARD}) (it|them)", POSES),
                sequence(
                    "(by|while) (holding|picking|lifting|taking) (it|them) [up]", _told(POSES)
                ),
            ),
            lambda poses: GraspClause(None, poses),
        ),
    ),
    _written,
)
"""Behind what is put somewhere."""
HELD_SO = either(
    sequence(f"us(e|ing), try[ing], coming [in|down], {manner.HAND_COMES}", POSES),
    sequence(
        "[by|while] (keep|keeping|hold|holding)",
        either(
            phrase(manner.HAND_LEVEL, (GraspPose.HORIZONTAL,)),
            phrase(manner.HAND_DOWN, (GraspPose.VERTICAL,)),
        ),
    ),
)
"""Before what is picked up ("use a vertical grasp to …", "keep the gripper level while you …")."""


def _so(poses: tuple[GraspPose, ...], things: Things | None = None) -> GraspClause:
    """How things are grasped; "it" is what is taken, wherever it goes."""
    again = things is None or all(np.pronoun for np in things.phrases)
    return GraspClause(None if again else things, poses)


def _asked(things: Things, poses: tuple[GraspPose, ...]) -> GraspClause:
    return GraspClause(things, poses, asks=True)


def _not_so(things: Things, pose: GraspPose) -> GraspClause:
    return _so((_other(pose),), things)


def _anyhow(things: Things) -> GraspClause:
    return _so((), things)


_IT = Things((NounPhrase(pronoun="it", text="it"),))
_BY_THE_HAND = "grasped, gripped, held, grabbed"
_COME_AT = "approach|(come|go) (at|for)|reach for"
_HOW = sequence(
    "how, in (what|which) way",
    either(
        sequence(
            ALL_THINGS,
            "(is|are|gets|get) [to be] (grasped|gripped|held|grabbed|picked up|taken|lifted)",
        ),
        sequence("you [are to|should]", f"{verbs.PICK}, {_COME_AT}", THINGS, optional("up")),
    ),
)
_WHETHER = sequence(
    "whether, if",
    either(
        sequence(f"you [are to|should] ({verbs.PICK}|{_COME_AT})", THINGS, optional("up")),
        sequence(
            f"(it|{verbs.THE_ROBOT}) "
            "(grasps|grips|grabs|holds|takes|lifts|picks up|approaches|(comes|goes) (at|for))",
            THINGS,
        ),
        sequence(f"(you|it|{verbs.THE_ROBOT}) (come|comes) [in|down]", build=lambda: _IT),
        sequence(
            ALL_THINGS, f"(is|are|gets|get) ({_BY_THE_HAND}|approached|picked up|taken|lifted)"
        ),
        sequence("it is, you do (it|so)", build=lambda: _IT),
    ),
    POSES,
    build=lambda things, poses: things if len({*poses}) > 1 else None,
)
GRASP = quiet(
    spanned(
        either(
            # "Use a side grasp on the holder", "side grasp on the holder"
            sequence(
                optional(f"us(e|ing), try[ing], {verbs.PERFORM}"),
                _A_GRASP,
                "on, for, with, of, at",
                ALL_THINGS,
                build=lambda poses, things: _asked(things, poses),
            ),
            sequence(_NO_SUCH_GRASP, "on, for, with, of, at", ALL_THINGS, build=_so),
            sequence("us(e|ing), try[ing]", _told(POSES), build=_so),
            sequence(
                "us(e|ing) (whichever|whatever|any) (grasp|grip|approach)",
                "[that] you (like|want|prefer|choose), works [best], is (easiest|best), suits you",
                build=lambda: _so(()),
            ),
            sequence(
                optional("(grasping|gripping|holding|grabbing|taking|lifting) (it|them)"),
                _told(_OR_BOTH),
                optional("[~comma] (either|any|both) [one|of them|way|grasp|grasps]"),
                fillers.ANY_WILL_DO,
                build=_so,
            ),
            sequence(
                # "A side grip is fine, so is one from above"
                _told(_POSE),
                fillers.ANY_WILL_DO,
                OPTIONAL_COMMA,
                either(
                    sequence("[and] so (is|would be|will|does) [one]", _POSE, optional("one")),
                    sequence("and [one]", _POSE, optional("one"), "too, as well, also"),
                ),
                build=lambda one, other: None if one is other else _so((one, other)),
            ),
            sequence(_NAMED_GRASP, build=_so),
            sequence(_told(_OR_BOTH), "~comma", fillers.DOES_NOT_MATTER, build=_so),
            sequence(
                "the (grasp|grip)", "(should|must|may|can|has to|needs to) be", POSES, build=_so
            ),
            sequence(_told(valued(_OTHER_POSE, lambda pose: (pose,))), build=_so),
            sequence(
                f"{forbidden.DO_NOT}, {forbidden.WITHOUT}, avoid[ing]",
                optional("us(e|ing)"),
                _told(_POSE),
                build=lambda pose: _so((_other(pose),)),
            ),
            sequence(
                ALL_THINGS,
                forbidden.NOT_TO_BE,
                f"{_BY_THE_HAND}, {predicates.TAKEN_UP}, lifted",
                _POSE,
                build=_not_so,
            ),
            sequence(_BY_THE_HAND, POSES, build=_so),
            # "Gripping it from above, carry it there"
            sequence("[by] (grasping|gripping|grabbing) (it|them)", POSES, build=_so),
            sequence(
                "approach[ing], com(e|ing) at",
                THINGS,
                POSES,
                build=lambda things, poses: _so(poses, things),
            ),
            # "If it cannot be done from the side, do it from above"
            sequence(
                f"if (it|this|that) ({_IMPOSSIBLE.replace(',', '|')})",
                _POSE,
                OPTIONAL_COMMA,
                f"[then] (do|try|{verbs.PICK.replace(',', '|')}) (it|so) [up]",
                _POSE,
                build=lambda better, worse: None if better is worse else _so((better, worse)),
            ),
            sequence("approach[ing]", _told(POSES), build=_so),
            sequence(
                f"{forbidden.DO_NOT}, {forbidden.WITHOUT}",
                verbs.PICK,
                THINGS,
                optional("up"),
                _POSE,
                build=_not_so,
            ),
            sequence(
                either(
                    sequence(ALL_THINGS, predicates.TO_BE_DONE),
                    sequence(predicates.WANTED, ALL_THINGS, optional("to be")),
                    sequence(ALL_THINGS, OPTIONAL_COMMA, EMPTY_WORDS, OPTIONAL_COMMA),
                ),
                f"{_BY_THE_HAND}, {predicates.TAKEN_UP}, lifted",
                OPTIONAL_COMMA,
                POSES,
                build=_asked,
            ),
            sequence(
                f"[i] do not (care|mind), {fillers.DOES_NOT_MATTER}, no matter",
                either(_HOW, _WHETHER),
                build=_anyhow,
            ),
            sequence(either(_HOW, _WHETHER), fillers.DOES_NOT_MATTER, build=_anyhow),
            # "Whether you come at it from above or from the side, …"
            sequence(_WHETHER, build=lambda things: _so((), things)),
        ),
        _written,
    )
)
"""How things are grasped, and no more."""

"""Rules for how things are grasped: from above, from the side, or by whichever grasp."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    optional,
    quiet,
    sequence,
    spanned,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    EMPTY_WORDS,
    OPTIONAL_COMMA,
    alternatives,
)
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.requests.poses import (
    IMPOSSIBLE,
    NOT_WITH,
    ONE_OR_BOTH,
    ONE_WAY,
    OTHER_WAY,
    POSES,
    other_way,
)
from etot_cli.reasoning.language.grammar.syntax.clauses import GraspClause
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things
from etot_cli.reasoning.language.words import fillers, forbidden, predicates, verbs
from etot_cli.reasoning.language.words.lexicon import word_set
from etot_cli.skills.action import GraspPose

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
        alternatives(ONE_WAY, 1),
        valued(OTHER_WAY, lambda pose: (pose,)),
    )
)


def _told(parser: Parser) -> Parser:
    return sequence(spanned(parser, _in_so_many_words), build=lambda poses: poses)


WITH_A_GRASP = spanned(
    either(
        sequence(spanned(POSES, _with_a_grasp), build=lambda clause: clause),
        valued(
            either(
                NOT_WITH,
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


def _so(poses: tuple[GraspPose, ...], things: Things | None = None) -> GraspClause:
    """How things are grasped; "it" is what is taken, wherever it goes."""
    again = things is None or all(np.pronoun for np in things.phrases)
    return GraspClause(None if again else things, poses)


def _asked(things: Things, poses: tuple[GraspPose, ...]) -> GraspClause:
    return GraspClause(things, poses, asks=True)


def _not_so(things: Things, pose: GraspPose) -> GraspClause:
    return _so((other_way(pose),), things)


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
                _told(ONE_OR_BOTH),
                optional("[~comma] (either|any|both) [one|of them|way|grasp|grasps]"),
                fillers.ANY_WILL_DO,
                build=_so,
            ),
            sequence(
                # "A side grip is fine, so is one from above"
                _told(ONE_WAY),
                fillers.ANY_WILL_DO,
                OPTIONAL_COMMA,
                either(
                    sequence("[and] so (is|would be|will|does) [one]", ONE_WAY, optional("one")),
                    sequence("and [one]", ONE_WAY, optional("one"), "too, as well, also"),
                ),
                build=lambda one, other: None if one is other else _so((one, other)),
            ),
            sequence(_NAMED_GRASP, build=_so),
            sequence(_told(ONE_OR_BOTH), "~comma", fillers.DOES_NOT_MATTER, build=_so),
            sequence(
                "the (grasp|grip)", "(should|must|may|can|has to|needs to) be", POSES, build=_so
            ),
            sequence(_told(valued(OTHER_WAY, lambda pose: (pose,))), build=_so),
            sequence(
                f"{forbidden.DO_NOT}, {forbidden.WITHOUT}, avoid[ing]",
                optional("us(e|ing)"),
                _told(ONE_WAY),
                build=lambda pose: _so((other_way(pose),)),
            ),
            sequence(
                ALL_THINGS,
                forbidden.NOT_TO_BE,
                f"{_BY_THE_HAND}, {predicates.TAKEN_UP}, lifted",
                ONE_WAY,
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
                f"if (it|this|that) {IMPOSSIBLE}",
                ONE_WAY,
                OPTIONAL_COMMA,
                f"[then] (do|try|{verbs.PICK.replace(',', '|')}) (it|so) [up]",
                ONE_WAY,
                build=lambda better, worse: None if better is worse else _so((better, worse)),
            ),
            sequence("approach[ing]", _told(POSES), build=_so),
            sequence(
                f"{forbidden.DO_NOT}, {forbidden.WITHOUT}",
                verbs.PICK,
                THINGS,
                optional("up"),
                ONE_WAY,
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

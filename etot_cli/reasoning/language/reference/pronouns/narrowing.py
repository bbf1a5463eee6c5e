"""What a phrase means, narrowed by what was spoken of before it."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Thing, things_in
from etot_cli.reasoning.builtin.relations import is_inside
from etot_cli.reasoning.builtin.roles import Role
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.usual_form import usual_form
from etot_cli.reasoning.language.words.lexicon import (
    BOARD_NOUNS,
    JOINT_NOUNS,
    LEVELS,
    ORDINALS,
    SIDES,
    SIZES,
    matches_any,
    same_noun,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import SceneState

_CONTRASTED = (SIZES, SIDES, LEVELS)
"""Words of which one thing of a pair has one and the other thing another."""


def spoken_part(resolved: Resolved, discourse: Discourse, *, own_name: bool) -> Resolved:
    """After "the lower drawer" "the drawer" is that one, not the whole chest; ``own_name``: unless
    the whole is what is called so.
    """
    named = {(thing.name, thing.part) for thing in things_in(resolved.options)}
    if own_name or not resolved.definite or resolved.other or any(part for _, part in named):
        return resolved
    owners = {owner for owner, _ in named}
    for mention in reversed(discourse.mentions):
        things = discourse.things(mention.referent)
        parts = things and all(thing.name in owners and thing.part for thing in things)
        if parts and same_noun(mention.noun, resolved.noun):
            return replace(resolved, options=discourse.referents[mention.referent].options)
    return resolved


def part_around(resolved: Resolved, inner: Sequence[Thing], scene: SceneState) -> Resolved:
    """Of a chest's drawers "the drawer" that things are taken out of is the one they all lie in."""
    things = set(things_in(resolved.options))
    infos = [scene.infos[t.name] for t in things if t.part is None and t.name in scene.infos]
    for info in infos if len(things) == 1 else ():
        around = [
            part
            for part in info.parts
            if matches_any(resolved.noun, JOINT_NOUNS.get(part.joint_type, ()))
            and all(is_inside(scene, thing.name, part.address) for thing in inner)
        ]
        if len(around) == 1 and len(info.parts) > 1:
            return replace(resolved, options=((Thing(info.name, around[0].name),),))
    return resolved


def of_spoken_owner(resolved: Resolved, discourse: Discourse) -> Resolved:
    """Of several pieces' doors "the door" is that of the piece that was spoken of last, and so is
    "the upper board" of two shelves.
    """
    parts = all(
        len(option) == 1 and option[0].address != option[0].name for option in resolved.options
    )
    if not (resolved.definite and parts and len(resolved.options) > 1):
        return resolved
    for mention in reversed(discourse.mentions):
        named = {thing.name for thing in discourse.things(mention.referent)}
        own = tuple(option for option in resolved.options if {option[0].name} == named)
        if own:
            return replace(resolved, options=own)
    return resolved


def of_last_choice(resolved: Resolved, discourse: Discourse) -> Resolved:
    """After "a green cup", of two, "the other one" is green, too."""
    for referent in reversed(discourse.referents):
        if len(referent.options) == 2 and {*referent.options} < {*resolved.options}:
            return replace(resolved, options=referent.options)
    return resolved


def one_of_several(phrase: NounPhrase, role: Role, discourse: Discourse) -> Resolved | None:
    """After "the pen and the key on the shelf" of the same clause, or named before it, "one" is one
    of these, and "the other" what is left of two after "one of them" or "the pen or the key"; None
    where that is not said.
    """
    said = [item for item in discourse.mentions if item.role is role is Role.THEME]
    rest = quantity_of(usual_form(phrase).determiner)
    bare = phrase.words in ((), ("one",)) or (rest.other and not usual_form(phrase).words)
    if phrase.modifiers or not bare or not said:
        return None
    noun, chosen = said[-1].noun, discourse.referents[said[-1].referent].options
    known = {item.referent for item in said if len(discourse.referents[item.referent].options) == 1}
    spoken = {thing for index in known for thing in discourse.things(index)}
    choice = said[-1].either or (
        len(chosen) > 1 and {*discourse.things(said[-1].referent)} <= spoken
    )
    if phrase.determiner == "the other" and choice and len(chosen) == 2:
        return Resolved(chosen, definite=True, other=True, noun=noun, again=True)
    all_others = rest.other and (rest.every or rest.count == len(chosen) - 1)
    if all_others and said[-1].either and len(chosen) > 1:
        left = tuple(tuple(t for o in chosen if o != option for t in o) for option in chosen)
        return Resolved(left, definite=True, other=True, noun=noun, every=True, again=True)
    if rest.other and rest.every:
        return None
    here = {item.referent for item in said if item.clause == discourse.clause} & known
    if not here and said[-1].clause == discourse.clause - 1:
        # "Take the pens out and put one into the cup"; of several cups "one" may be any cup,
        # unless these were but named ("the red cup and the blue cup: one …").
        last = [item for item in said if item.clause == said[-1].clause]
        alike = all(same_noun(item.noun, noun) for item in last)
        alike = alike and any(item.referent in discourse.put for item in last)
        here = {item.referent for item in (last[-1:] if alike else last)} & known
    things = dict.fromkeys(thing for index in sorted(here) for thing in discourse.things(index))
    again = choice and said[-1].clause == discourse.clause
    if phrase.determiner == "one" and again and len(chosen) > 1:
        # "One in the drawer, one in the holder": each is another one.
        return Resolved(chosen, other=True, noun=noun, again=True)
    if phrase.determiner not in ("one", "") or len(things) < 2:
        return None
    options = tuple((thing,) for thing in things)
    return Resolved(options, definite=False, other=choice, noun=noun, again=True)


def pair_spoken_of(phrase: NounPhrase, role: Role, discourse: Discourse) -> Resolved | None:
    """After "the red cup next to the blue one" of three cups "the two" and "those two cups" are
    these; None where that is not said, or others were spoken of as well.
    """
    noun = phrase.head if phrase.words and not phrase.is_elliptic else ""
    told = phrase.modifiers or phrase.words[1:]
    if phrase.determiner not in _TWO or told or role is Role.PART:
        return None
    themes = [item for item in discourse.mentions if item.role is Role.THEME]
    going = themes[-1:] if role is not Role.THEME else []  # what goes between them
    named = dict.fromkeys(
        thing
        for item in discourse.mentions
        if item not in going and (not noun or same_noun(item.noun, noun))
        for thing in discourse.things(item.referent)
    )
    if len(named) != 2:
        return None
    last = noun or discourse.mentions[-1].noun
    return Resolved((tuple(named),), definite=True, noun=last, every=True, again=True)


_TWO = ("the two", "these two", "those two")


def other_board(phrase: NounPhrase, role: Role, discourse: Discourse) -> Resolved | None:
    """After "off the upper board" "the other one", where something goes, is the other board of that
    shelf; None where that is not said.
    """
    targets = (Role.SURFACE, Role.PLACE, Role.CONTAINER)
    said = [m for m in discourse.mentions if m.role in (*targets, Role.ANY)]
    said = [m for m in said if not discourse.is_desk(m.referent)]
    alike = phrase.head in ("", "one") or matches_any(phrase.head, BOARD_NOUNS)
    bare = len(phrase.words) < 2 and not (phrase.modifiers or phrase.without or phrase.owner)
    asked = alike and bare and phrase.determiner == "the other"
    if not asked or not said or role not in targets[:2]:
        return None
    things = discourse.things(said[-1].referent)
    if not all(thing.board for thing in things):
        return None
    owner, *more = {thing.name for thing in things}
    left = [b for b in discourse.scene.infos[owner].boards if Thing(owner, board=b) not in things]
    if more or len(left) != 1:
        return None
    meant = ((Thing(owner, board=left[0]),),)
    return Resolved(meant, definite=True, noun=said[-1].noun, again=True)


def spared_one(phrase: NounPhrase, discourse: Discourse) -> Resolved | None:
    """After "all drawers except the middle one" "that one" is the one that is left out; None where
    that is not said.
    """
    alone = phrase.determiner in ("that", "this") and phrase.words == ("one",)
    if not alone or phrase.modifiers or not discourse.mentions:
        return None
    last = discourse.mentions[-1]
    spared = [t for t in discourse.left_out.get(last.referent, ()) if t not in discourse.placed]
    options = ((spared[0],),) if len(spared) == 1 else ()
    return Resolved(options, definite=True, noun=last.noun) if options else None


def others(resolved: Resolved, discourse: Discourse) -> Resolved:
    """All others of a choice made before: which they are depends on it."""
    things = resolved.options[0]
    for referent in reversed(discourse.referents):
        chosen = [set(option) for option in referent.options]
        if len(chosen) > 1 and all(option <= set(things) for option in chosen):
            left = (tuple(t for t in things if t not in option) for option in chosen)
            return replace(resolved, options=tuple(option for option in left if option))
    return resolved


def check_count(phrase: NounPhrase, noun: str, discourse: Discourse) -> None:
    """After "two cups … the third" is the one that is left, not the third from the left."""
    if not any(word in ORDINALS for word in phrase.words):
        return
    for mention in discourse.mentions:
        referent = discourse.referents[mention.referent]
        if same_noun(mention.noun, noun) and len(referent.options) > 1:
            raise AmbiguousReference(phrase.text, [f"what {referent.text} leave", "a number"])


def check_one_left(phrase: NounPhrase, resolved: Resolved, discourse: Discourse) -> None:
    """Whether "the other one" is one: as many are left as have not been chosen before."""
    if any(len(option) != 1 for option in resolved.options):
        return
    things = set(things_in(resolved.options))
    chosen = sum(
        len(referent.options[0])
        for referent in discourse.referents
        if len(referent.options) > 1 and set(things_in(referent.options)) <= things
    )
    if len(things) - chosen > 1:
        raise AmbiguousReference(phrase.text, sorted(thing.name for thing in things))


def as_contrasted(phrase: NounPhrase, noun: str | None, discourse: Discourse) -> NounPhrase | None:
    """After "the larger clay pot" "the smaller one" may be one of clay, too, and so may "the one on
    the desk": the phrase with the words that the earlier one has besides those that are contrasted.
    """
    own = phrase.words[:-1]
    quantity = quantity_of(phrase.determiner)
    known = quantity.definite and not quantity.every and phrase.head in ("", "one")
    if noun is None or not (own or known):
        return None
    for mention in reversed(discourse.mentions):
        if not same_noun(mention.noun, noun):
            continue
        before = mention.adjectives
        contrasted = not own or are_contrasted(own, before)
        kept = [w for w in before if w not in own and not any(w in t for t in _CONTRASTED)]
        words = (*own, *kept, phrase.head or "one")
        return replace(phrase, words=words) if contrasted and kept else None
    return None


def singled_out_of(phrase: NounPhrase, noun: str | None, discourse: Discourse) -> tuple[Thing, ...]:
    """After "the left cup on the tray" "the right one" is one of those on the tray, too: what the
    earlier phrase singles out one of, none where nothing is contrasted.

    Raises:
        AmbiguousReference: the earlier phrase tells a side of something else.
    """
    asides = (word for m in phrase.modifiers if m.prep is Prep.SIDE for word in m.words)
    own = [*phrase.words, *asides]
    for mention in reversed(discourse.mentions):
        if noun is None or not same_noun(mention.noun, noun):
            continue
        sides = discourse.sides.get(mention.referent, ())
        if any(are_contrasted(own, (side,)) and side not in own for side in sides):
            # "The cup on the left of the plate … the right one": on the right of that, or of all?
            raise AmbiguousReference(phrase.text, ["one of all", "one beside the same"])
        contrasted = are_contrasted(own, mention.adjectives)
        among = discourse.among.get(mention.referent, ())
        # "Small" may be part of what the one thing that it tells is called.
        return among if contrasted and len(among) > 1 else ()
    return ()


def are_contrasted(words: Collection[str], others: Collection[str]) -> bool:
    """Whether words of both tell things apart by the same quality."""
    return any(
        any(word in table for word in words) and any(word in table for word in others)
        for table in _CONTRASTED
    )


def narrowed_to(
    narrower: Resolved, plain: Resolved, phrase: NounPhrase, discourse: Discourse
) -> Resolved:
    """Of two meanings the narrower one, unless that was spoken of before.

    Raises:
        AmbiguousReference: neither is part of the other.
    """
    if narrower.options == plain.options or any(
        referent.options == narrower.options for referent in discourse.referents
    ):
        return plain
    if {*narrower.options} <= {*plain.options}:
        return narrower
    named = [thing.name for item in (plain, narrower) for thing in things_in(item.options)]
    raise AmbiguousReference(phrase.text, named)


def as_rest(phrase: NounPhrase, noun: str | None, discourse: Discourse) -> NounPhrase:
    """After "two of the cups" of three "the third" or "the last" is the other one."""
    alone = phrase.words[1:] in ((), ("one",), (noun,)) and not phrase.modifiers
    said = phrase.words[0] if alone and phrase.words and phrase.determiner == "the" else ""
    number = ORDINALS.get(said, -1)
    for mention in discourse.mentions:
        options = discourse.referents[mention.referent].options
        left = {len(set(discourse.things(mention.referent))) - len(option) for option in options}
        counted = said == "last" or {len(option) for option in options} == {number}
        if noun and same_noun(mention.noun, noun) and left == {1} and len(options) > 1 and counted:
            return replace(phrase, determiner="the other", words=(singular(noun),))
    return phrase

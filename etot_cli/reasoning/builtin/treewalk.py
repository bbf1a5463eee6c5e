"""From the parser's trees to the syntax tree's dataclasses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.builtin.syntax import (
    Clause,
    Destination,
    EnsureClause,
    Modifier,
    MoveClause,
    NounPhrase,
    PickClause,
    Prep,
    PutClause,
    PutGroup,
    RemoveClause,
    ReorientClause,
    Spoken,
    State,
    Things,
    Toward,
)
from etot_cli.skills.action import GraspPose

_POSES = {"HORIZONTAL": GraspPose.HORIZONTAL, "VERTICAL": GraspPose.VERTICAL}
_GROUPINGS = {
    "ANYHOW": Grouping.ANY,
    "TOGETHER": Grouping.TOGETHER,
    "SEPARATELY": Grouping.SEPARATELY,
}
_ADJECTIVES = {"OPEN_ADJ": "open", "CLOSED_ADJ": "closed"}


def clauses_of(tree: Any, text: str) -> tuple[Spoken, ...]:
    """The clauses of an unambiguous tree of one sentence, in the order they are to be done.

    Args:
        tree: a Lark tree of the rule ``start``.
        text: what was parsed.
    """
    walk = _Walk(text)
    return walk.sequence(_subtrees(tree)[0])


def _subtrees(tree: Any) -> list[Any]:
    return [child for child in tree.children if hasattr(child, "data")]


def _tokens(tree: Any) -> list[Any]:
    return [child for child in tree.children if not hasattr(child, "data")]


class _Walk:
    def __init__(self, text: str) -> None:
        self._text = text

    def sequence(self, tree: Any) -> tuple[Spoken, ...]:
        children = _subtrees(tree)
        match tree.data:
            case "first":
                return (self._spoken(children[0]),)
            case "then":
                return (*self.sequence(children[0]), self._spoken(children[1]))
            case "result":
                return (
                    *self.sequence(children[0]),
                    Spoken(EnsureClause(self.states(children[1])), children[1].meta.start_pos),
                )
            case "in_order":
                return (self._spoken(children[0]), *self.sequence(children[1]))
            case _:  # "A after B", "before B, A": the clause and the sequence change places
                sequence = next(child for child in children if child.data in _SEQUENCES)
                clause = next(child for child in children if child.data not in _SEQUENCES)
                if children[0] is sequence:
                    return (self._spoken(clause), *self.sequence(sequence))
                return (*self.sequence(sequence), self._spoken(clause))

    def _spoken(self, tree: Any) -> Spoken:
        return Spoken(self.clause(tree), tree.meta.start_pos)

    def clause(self, tree: Any) -> Clause:
        read: dict[str, Callable[[Any], Clause]] = {
            "pick": self._pick,
            "put": self._put,
            "put_down": lambda tree: PutClause(
                (PutGroup(self._things_in(tree), (Destination(Toward.HERE, word="down"),)),)
            ),
            "remove": self._remove,
            "empty": self._empty,
            "open": lambda tree: MoveClause(self._things_in(tree), opens=True),
            "close": lambda tree: MoveClause(self._things_in(tree), opens=False),
            "ensure": lambda tree: EnsureClause(self.states(_child(tree, "states"))),
            "leave": self._leave,
            "should": lambda tree: EnsureClause((self._state(tree),)),
            "reorient": lambda tree: ReorientClause(self._things_in(tree)),
        }
        return read[tree.data](tree)

    # -- clauses -----------------------------------------------------------------------------------

    def _pick(self, tree: Any) -> PickClause:
        poses = [child for child in _subtrees(tree) if child.data == "poses"]
        selected = tuple(
            _POSES[_tokens(pose)[0].type] for group in poses for pose in _subtrees(group)
        )
        things = self._things_in(tree)
        source = self._source(tree)
        if source is not None:
            modifier = Modifier(Prep.FROM, (source,))
            things = replace(
                things,
                phrases=tuple(
                    replace(phrase, modifiers=(*phrase.modifiers, modifier))
                    for phrase in things.phrases
                ),
            )
        return PickClause(things, tuple(dict.fromkeys(selected)))

    def _put(self, tree: Any) -> PutClause:
        groups = tuple(
            PutGroup(self._things_in(child), self._destinations(_child(child, "destinations")))
            for child in _subtrees(tree)
            if child.data == "put_group"
        )
        grouping, conditions = Grouping.ANY, []
        for extra in _subtrees(tree):
            if extra.data != "extra":
                continue
            for token in _tokens(extra):
                grouping = _GROUPINGS.get(token.type, grouping)
            conditions += [
                self._state(_subtrees(child)[0])
                for child in _subtrees(extra)
                if child.data == "condition"
            ]
        return PutClause(groups, grouping, tuple(conditions))

    def _remove(self, tree: Any) -> RemoveClause:
        return RemoveClause(self._things_in(tree), self._source(tree))

    def _empty(self, tree: Any) -> RemoveClause:
        contents = (
            NounPhrase("all", ("objects",), (Modifier(Prep.IN, (vessel,)),), text=vessel.text)
            for vessel in self._things_in(tree).phrases
        )
        return RemoveClause(Things(tuple(contents)))

    def _source(self, tree: Any) -> NounPhrase | None:
        for child in _subtrees(tree):
            if child.data == "source":
                return self._phrase(_subtrees(child)[0])
        return None

    def _leave(self, tree: Any) -> EnsureClause:
        phrase = next(child for child in _subtrees(tree) if child.data in _PHRASES)
        word = next(_ADJECTIVES[token.type] for token in _tokens(tree) if token.type in _ADJECTIVES)
        return EnsureClause((State((self._phrase(phrase),), word=word),))

    def states(self, tree: Any) -> tuple[State, ...]:
        return tuple(self._state(child) for child in _subtrees(tree) if child.data == "state")

    def _state(self, tree: Any) -> State:
        subjects = self._things(_child(tree, "np_list")).phrases
        predicate = _child(tree, "predicate")
        for token in _tokens(predicate):
            if token.type in _ADJECTIVES:
                return State(subjects, word=_ADJECTIVES[token.type])
        return State(subjects, self._destinations(predicate))

    # -- phrases -----------------------------------------------------------------------------------

    def _things_in(self, tree: Any) -> Things:
        return self._things(
            next(child for child in _subtrees(tree) if child.data in ("things", "either"))
        )

    def _things(self, tree: Any) -> Things:
        if tree.data == "things":
            tree = _subtrees(tree)[0]
        phrases = tuple(self._phrase(c) for c in _subtrees(tree) if c.data in _PHRASES)
        return Things(phrases, either=tree.data == "either")

    def _destinations(self, tree: Any) -> tuple[Destination, ...]:
        found = []
        for child in _subtrees(tree):
            if child.data == "here":
                found.append(Destination(Toward.HERE, word=str(_tokens(child)[0])))
                continue
            toward = {"into": Toward.INSIDE, "onto": Toward.ON, "to": Toward.TO}[child.data]
            targets = _child(child, "targets")
            found.append(
                Destination(
                    toward,
                    tuple(self._phrase(c) for c in _subtrees(targets) if c.data in _PHRASES),
                )
            )
        return tuple(found)

    def _phrase(self, tree: Any) -> NounPhrase:
        children, tokens = _subtrees(tree), _tokens(tree)
        # The parser's own positions are those of an ambiguous tree, all of its readings together.
        spoken = list(tree.scan_values(lambda value: True))
        text = self._text[spoken[0].start_pos : spoken[-1].end_pos]
        determiner = next((str(token) for token in tokens if token.type == "DET"), "")
        pronoun = next((str(token) for token in tokens if token.type == "PRONOUN"), "")
        words = [
            tuple(str(token) for token in _tokens(child))
            for child in children
            if child.data == "words"
        ]
        modifiers = tuple(self._modifier(child) for child in children if child.data in _MODIFIERS)
        owner = None
        if tree.data == "owned":
            owner = NounPhrase(determiner, words[0], text=" ".join(words[0]))
            determiner = "the"
        return NounPhrase(determiner, words[-1] if words else (), modifiers, pronoun, owner, text)

    def _modifier(self, tree: Any) -> Modifier:
        phrases = tuple(self._phrase(c) for c in _subtrees(tree) if c.data in _PHRASES)
        tokens = {token.type: str(token) for token in _tokens(tree)}
        match tree.data:
            case "related":
                token = _tokens(_child(tree, "prep"))[0]
                return Modifier(_PREPOSITIONS[token.type], phrases)
            case "between":
                return Modifier(Prep.BETWEEN, phrases)
            case "containing":
                return Modifier(Prep.CONTAINING, phrases)
            case "bearing":
                return Modifier(Prep.BEARING, phrases)
            case "side":
                return Modifier(Prep.SIDE, word=tokens["SIDE"])
            case _:
                word = next(value for kind, value in tokens.items() if kind != "RELATIVE")
                return Modifier(Prep.STATE, word=word.split()[-1])


_SEQUENCES = frozenset({"first", "then", "result", "after", "in_order"})
_PHRASES = frozenset({"noun", "bare", "owned", "pronoun", "of_pronoun"})
_MODIFIERS = frozenset({"related", "between", "side", "state_of", "containing", "bearing"})
_PREPOSITIONS = {
    "P_ON": Prep.ON,
    "P_IN": Prep.IN,
    "P_FROM": Prep.FROM,
    "P_OF": Prep.OF,
    "P_NEAR": Prep.NEAR,
    "P_LEFT": Prep.LEFT,
    "P_RIGHT": Prep.RIGHT,
    "P_BEHIND": Prep.BEHIND,
    "P_FRONT": Prep.FRONT,
    "P_UNDER": Prep.UNDER,
    "P_ABOVE": Prep.ABOVE,
    "P_NEAREST": Prep.NEAREST,
    "P_FARTHEST": Prep.FARTHEST,
}


def _child(tree: Any, rule: str) -> Any:
    return next(child for child in _subtrees(tree) if child.data == rule)

"""The planning tree as a data structure."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from etot_cli.planning.tree import FAILED, LIVE, NodeStatus, Origin, PlanNode, PlanTree
from etot_cli.reasoning.protocol import Branch
from etot_cli.skills.action import Action, Keepout, Verb
from tests.planning.fakes import branch, names

ACTIONS = st.sampled_from([Action(Verb.PICK_UP, name) for name in "abc"])
BRANCHES = st.lists(
    st.lists(ACTIONS, min_size=1, max_size=5).map(lambda actions: Branch(tuple(actions))),
    min_size=1,
    max_size=12,
)


def grow(*branches: str) -> PlanTree:
    tree = PlanTree()
    for text in branches:
        tree.merge_branch(branch(text), Origin.PRIORI)
    return tree


def live_roots(tree: PlanTree) -> list[PlanNode]:
    return [node for node in tree if node.parent is None and node.status in LIVE]


def find(tree: PlanTree, text: str) -> PlanNode:
    return next(node for node in tree if names(node.actions) == text)


def test_common_prefixes_are_shared() -> None:
    tree = grow("a b c", "a b d", "e")
    assert [names(node.actions) for node in tree] == ["a", "a b", "a b c", "a b d", "e"]
    assert [node.id for node in tree] == [1, 2, 3, 4, 5]
    assert names([node.action for node in live_roots(tree)]) == "a e"


def test_merge_tells_prefix_and_first_new_node() -> None:
    tree = grow("a b c")
    merge = tree.merge_branch(branch("a b d e"), Origin.REFLECTIVE)
    assert [names(node.actions) for node in merge.merged] == ["a", "a b"]
    assert merge.new is not None and names(merge.new.actions) == "a b d"
    assert merge.new.origin is Origin.REFLECTIVE
    assert merge.blocked is None
    assert find(tree, "a b").origin is Origin.PRIORI


def test_known_branch_adds_nothing() -> None:
    tree = grow("a b")
    merge = tree.merge_branch(branch("a b"), Origin.REFLECTIVE)
    assert merge.new is None and len(merge.merged) == 2 and len(tree) == 2


def test_prefix_of_a_branch_marks_its_end() -> None:
    tree = grow("a b")
    assert find(tree, "a").end is None
    tree.merge_branch(branch("a"), Origin.REFLECTIVE, revisions=2)
    end = find(tree, "a").end
    assert end is not None and end.revisions == 2
    tree.merge_branch(branch("a"), Origin.PRIORI, revisions=0)
    end = find(tree, "a").end
    assert end is not None and end.revisions == 0


def test_actions_with_other_places_to_avoid_are_other_nodes() -> None:
    tree = PlanTree()
    near = Action(Verb.PUT_ON, "desk", safe=True, keepout=(Keepout(0.1, 0.2, 0.3),))
    far = Action(Verb.PUT_ON, "desk", safe=True, keepout=(Keepout(0.4, 0.2, 0.3),))
    tree.merge_branch(Branch((near,)), Origin.PRIORI)
    assert tree.merge_branch(Branch((far,)), Origin.REFLECTIVE).new is not None


def test_paths_through_a_node() -> None:
    tree = grow("a b c", "a b d", "a e", "f")
    paths = [names(path.branch.actions) for path in tree.extract_paths(find(tree, "a b"))]
    assert paths == ["a b c", "a b d"]
    assert len(tree.extract_paths(find(tree, "a"))) == 3


def test_failed_node_blocks_and_its_subtree_is_removed() -> None:
    tree = grow("a b c", "a d")
    failed = find(tree, "a b")
    failed.status = NodeStatus.UNSAFE
    tree.remove_subtree(failed)
    assert failed.status is NodeStatus.UNSAFE
    assert find(tree, "a b c").status is NodeStatus.REMOVED
    assert find(tree, "a d").status is NodeStatus.PENDING
    merge = tree.merge_branch(branch("a b e"), Origin.REFLECTIVE)
    assert merge.new is None and merge.blocked is failed
    assert [names(node.actions) for node in merge.merged] == ["a"]
    assert len(tree) == 4


def test_untried_removed_nodes_are_not_reused() -> None:
    tree = grow("a b")
    removed = find(tree, "a")
    tree.remove_subtree(removed)
    merge = tree.merge_branch(branch("a b"), Origin.REFLECTIVE)
    assert merge.merged == () and merge.new is not None and merge.new is not removed


@given(BRANCHES)
def test_tree_holds_exactly_the_branches(branches: list[Branch]) -> None:
    tree = PlanTree()
    for item in branches:
        tree.merge_branch(item, Origin.PRIORI)
    prefixes = {item.actions[:n] for item in branches for n in range(1, len(item.actions) + 1)}
    assert {node.actions for node in tree} == prefixes
    assert len(tree) == len(prefixes)
    found = [path.branch.actions for root in live_roots(tree) for path in tree.extract_paths(root)]
    assert len(found) == len(set(found))
    assert set(found) == {item.actions for item in branches}


@given(BRANCHES)
def test_merging_again_changes_nothing(branches: list[Branch]) -> None:
    tree = PlanTree()
    for item in branches:
        tree.merge_branch(item, Origin.PRIORI)
    size = len(tree)
    for item in branches:
        merge = tree.merge_branch(item, Origin.REFLECTIVE)
        assert merge.new is None
        assert tuple(node.action for node in merge.merged) == item.actions
    assert len(tree) == size


@given(BRANCHES, BRANCHES, st.integers(0, 1000))
def test_nothing_lives_below_a_failure(
    branches: list[Branch], later: list[Branch], pick: int
) -> None:
    tree = PlanTree()
    for item in branches:
        tree.merge_branch(item, Origin.PRIORI)
    failed = list(tree)[pick % len(tree)]
    paths = tree.extract_paths(failed)
    failed.status = NodeStatus.FAILURE
    tree.remove_subtree(failed)
    assert all(path.branch.actions[: failed.depth] == failed.actions for path in paths)
    for item in later:
        before = len(tree)
        merge = tree.merge_branch(item, Origin.REFLECTIVE)
        through = item.actions[: failed.depth] == failed.actions
        assert (merge.blocked is failed) == through
        if through:
            assert len(tree) == before
    for node in tree:
        lineage = node.path[:-1]
        if any(ancestor.status in FAILED for ancestor in lineage):
            assert node.status is NodeStatus.REMOVED
        if node.status in LIVE:
            assert all(ancestor.status in LIVE for ancestor in lineage)

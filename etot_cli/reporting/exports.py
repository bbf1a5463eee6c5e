"""A plan in the formats of other programs: a behaviour tree, and a ground plan of PDDL tools."""

from __future__ import annotations

import re
from collections.abc import Sequence
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from etot_cli.reporting.plan_report import PlanReport
from etot_cli.skills.action import Action, Verb, parse_plan

FORMAT = "4"
"""Format of BehaviorTree.CPP's files."""
NODES: dict[Verb, tuple[str, tuple[tuple[str, str], ...]]] = {
    Verb.PICK_UP: ("PickUp", (
        ("object", "What to pick up."),
        ("pose", "horizontal, vertical or any: how it is grasped."),
    )),
    Verb.PUT_ON: ("PutOn", (
        ("object", "What is in the hand."),
        ("surface", "What to put it on."),
        ("safe", "true: at a place that stays clear of what moves."),
    )),
    Verb.PUT_INTO: ("PutInto", (
        ("object", "What is in the hand."),
        ("container", "What to put it into."),
    )),
    Verb.OPEN: ("Open", (("target", "The part to open."),)),
    Verb.CLOSE: ("Close", (("target", "The part to close."),)),
}  # fmt: skip
"""Node and its ports, per action."""


def behavior_tree(report: PlanReport) -> str:
    """The plan as a BehaviorTree.CPP 4 file: a sequence of actions, and the model of each node."""
    root = Element("root", {"BTCPP_format": FORMAT, "main_tree_to_execute": "Plan"})
    tree = SubElement(root, "BehaviorTree", {"ID": "Plan"})
    sequence = SubElement(tree, "Sequence", {"name": _printable(report.task.instruction) or "plan"})
    for action, ports in _with_ports(report):
        SubElement(sequence, NODES[action.verb][0], {"name": str(action), **ports})
    model = SubElement(root, "TreeNodesModel")
    for node, ports_of in NODES.values():
        entry = SubElement(model, "Action", {"ID": node})
        for port, meaning in ports_of:
            given = SubElement(entry, "input_port", {"name": port, "type": "std::string"})
            given.text = meaning
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(
        root, encoding="unicode"
    ) + "\n"  # fmt: skip


def ground_plan(report: PlanReport) -> str:
    """The plan as PDDL tools write theirs: one ground action per line, then its cost."""
    lines = [f"; {_printable(report.task.instruction)}"]
    for action, ports in _with_ports(report):
        names = [
            ports[port] for port in ("object", "surface", "container", "target") if port in ports
        ]
        words = [str(action.verb.value).lower().replace(" ", "-"), *map(_symbol, names)]
        lines.append(f"({' '.join(words)})")
    lines.append(f"; cost = {len(report.plan)} (unit cost)")
    return "\n".join(lines) + "\n"


def _with_ports(report: PlanReport) -> list[tuple[Action, dict[str, str]]]:
    """The plan's actions, what is in the hand filled in."""
    nodes = {node.id: node for node in report.tree.nodes}
    safe = [nodes[number].safe for number in report.plan_nodes]
    held = ""
    found = []
    for action, place in zip(_actions(report.plan), safe, strict=True):
        if action.verb is Verb.PICK_UP:
            held = action.target
            pose = action.pose.value if action.pose is not None else "any"
            ports = {"object": held, "pose": pose}
        elif action.verb is Verb.PUT_ON:
            ports = {"object": held, "surface": action.target, "safe": str(place).lower()}
        elif action.verb is Verb.PUT_INTO:
            ports = {"object": held, "container": action.target}
        else:
            ports = {"target": action.target}
        found.append((action, ports))
    return found


def _actions(plan: Sequence[str]) -> tuple[Action, ...]:
    return tuple(parse_plan(written)[0] for written in plan)


def _symbol(name: str) -> str:
    """A name as PDDL allows it."""
    return re.sub(r"[^a-z0-9_-]", "-", name.lower())


def _printable(text: str) -> str:
    """One line without characters that XML cannot hold."""
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())

"""The built-in reasoner: offline, from the world's state alone."""

from etot_cli.reasoning.builtin.reasoner import BuiltinReasoner
from etot_cli.reasoning.builtin.rules import Violation, check_plan

__all__ = ["BuiltinReasoner", "Violation", "check_plan"]

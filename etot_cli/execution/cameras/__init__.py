"""Cameras behind the protocol of :mod:`etot_cli.execution.protocols`."""

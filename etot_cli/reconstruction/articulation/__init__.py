"""Movable parts, their joints and limits."""

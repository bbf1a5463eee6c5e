"""Solids for what no family of shapes explains."""

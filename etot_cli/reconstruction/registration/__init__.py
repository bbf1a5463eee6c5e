"""Poses of known meshes."""

"""Pose and size: silhouette, depth and support relations in one fit."""

"""Runs trials in processes or on a cluster, and keeps what came of each."""

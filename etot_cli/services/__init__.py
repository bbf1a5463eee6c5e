"""Servers over HTTP: one bounded request, retries, and secrets that stay secret."""

"""Rates with their intervals, and methods compared on the same trials."""

"""Rules for noun phrases, places and states: which things, where, and how they are."""

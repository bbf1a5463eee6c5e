"""Phrases that lean on earlier ones: pronouns, nouns that are left out, "the other"."""

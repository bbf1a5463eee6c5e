"""Rules that join requests and conditions into sentences, and the reader of a whole text."""

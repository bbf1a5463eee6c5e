"""The parser combinators, their input, and the small words that all rules share."""
